//! What a device may be built to: figures as manufacturers offer them, drawn at random.

use crate::belt::BeltParameters;
use crate::chance::Dice;
use crate::gripper::GripperParameters;
use crate::motor::MotorParameters;
use crate::pusher::PusherParameters;
use crate::robot::RobotParameters;
use crate::servo::ServoParameters;

use super::unit::Figures;

/// All kinds of devices, as the rig calls them.
pub const KINDS: [&str; 6] = ["Belt", "Pusher", "Robot", "Gripper", "Axis", "Motor"];

impl Figures {
    /// A device of `kind`, fed by the bay `feed` where boxes pass it. Every figure has three digits, so that a plant's file says all
    /// of it.
    pub fn draw(kind: &str, feed: String, dice: &mut Dice) -> Figures {
        match kind {
            "Belt" => belt(feed, dice),
            "Pusher" => Figures::Pusher(pusher(dice)),
            "Robot" => robot(dice),
            "Gripper" => Figures::Gripper(GripperParameters {
                build_up: digits(dice.log_between(0.06, 0.4)),
                release: digits(dice.log_between(0.04, 0.2)),
            }),
            "Axis" => servo(dice),
            _ => Figures::Motor {
                parameters: MotorParameters {
                    acceleration: digits(dice.log_between(6.0, 60.0)),
                    counts: *dice.one_of(&[512.0, 1000.0, 1024.0, 2048.0, 2500.0, 4096.0, 8192.0]),
                },
                top: digits(dice.log_between(10.0, 40.0)),
            },
        }
    }
}

/// Boxes are put where they cut no beam yet, and seldom enough that the one before has left its place even at the slowest speed.
fn belt(feed: String, dice: &mut Dice) -> Figures {
    let length = digits(dice.between(1.4, 4.0));
    let top = digits(dice.log_between(0.4, 1.0));
    let box_length = digits(dice.between(0.12, (0.4 * top).min(0.2 * length)));
    let box_at = digits(0.5 * box_length + dice.between(0.01, 0.1));
    let front = box_at + 0.5 * box_length;
    let barrier_a = digits(front + dice.between(0.05, 0.15 * length));
    let barrier_b = digits(dice.between((barrier_a + 1.5 * box_length).max(0.6 * length), 0.92 * length));
    // The slowest that a belt is told is a fifth of its top.
    let interval = digits(dice.between(4.0, 8.0).max(2.4 * box_length / (0.2 * top)));
    let parameters = BeltParameters {
        length,
        acceleration: digits(dice.log_between(0.5, 3.0)),
        barriers: [barrier_a, barrier_b],
        box_length,
        box_at,
        first: digits(dice.between(0.5, 2.0)),
        interval,
    };
    Figures::Belt { parameters, feed, top }
}

fn pusher(dice: &mut Dice) -> PusherParameters {
    let stroke = digits(dice.log_between(0.2, 0.9));
    let speed = dice.log_between(0.3, 1.2);
    PusherParameters {
        stroke,
        extend_speed: digits(speed),
        retract_speed: digits(speed * dice.between(0.8, 1.25)),
        limit_tolerance: digits(dice.log_between(1e-3, 5e-3)),
    }
}

fn robot(dice: &mut Dice) -> Figures {
    // One tolerance for the three ways, one for the turn.
    let near = digits(dice.log_between(2e-4, 1.5e-3));
    let near_turn = digits(dice.log_between(2e-4, 1.5e-3));
    let mut fastest = [0.0; 4].map(|_: f64| digits(dice.log_between(0.5, 2.0)));
    let mut steepest = [0.0; 4].map(|_: f64| digits(dice.log_between(1.2, 6.0)));
    let mut reach = [0.0; 4].map(|_: f64| digits(dice.between(0.25, 0.7)));
    fastest[3] = digits(dice.log_between(1.2, 5.0));
    steepest[3] = digits(dice.log_between(4.0, 20.0));
    reach[3] = digits(dice.between(0.8, 2.4));
    let parameters = RobotParameters { fastest, steepest, tolerance: [near, near, near, near_turn] };
    Figures::Robot { parameters, reach }
}

/// A drive that fits its load: gains and limit by the mass that they move.
fn servo(dice: &mut Dice) -> Figures {
    let mass = digits(dice.log_between(5.0, 80.0));
    let parameters = ServoParameters {
        mass,
        viscous: digits(mass * dice.log_between(1.0, 5.0)),
        position_gain: digits(dice.between(12.0, 30.0)),
        velocity_gain: digits(mass * dice.between(30.0, 60.0)),
        force_limit: digits(mass * dice.between(15.0, 35.0)),
    };
    // A thousandth of what it can exert, as on the rig.
    let newton = digits(1e-3 * parameters.force_limit);
    Figures::Servo { parameters, reach: digits(dice.between(0.25, 0.8)), newton }
}

/// To three digits.
fn digits(value: f64) -> f64 {
    let grid = 10.0_f64.powi(value.abs().log10().floor() as i32 - 2);
    let rounded = (value / grid).round() * grid;
    // The nearest number of so many decimals, and not one that a product leaves beside it.
    format!("{rounded:.7}").parse().unwrap_or(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        assert_eq!([1.23456, 0.0012345, 812.3, 80.06].map(digits), [1.23, 0.00123, 812.0, 80.1]);
    }

    #[test]
    fn a_box_is_put_before_the_first_beam_and_leaves_before_the_next_comes() {
        let mut dice = Dice::new(5, 0);
        for _ in 0..200 {
            let Figures::Belt { parameters: belt, top, .. } = Figures::draw("Belt", "F".to_owned(), &mut dice) else {
                panic!("a belt");
            };
            let half = 0.5 * belt.box_length;
            assert!(belt.box_at >= half && belt.box_at + half < belt.barriers[0] - 0.04, "{belt:?}");
            assert!(belt.barriers[0] + belt.box_length < belt.barriers[1], "{belt:?}");
            assert!(belt.barriers[1] < 0.95 * belt.length, "{belt:?}");
            assert!(belt.interval * 0.2 * top > 2.0 * belt.box_length, "{belt:?} {top}");
        }
    }
}
