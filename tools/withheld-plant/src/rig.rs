//! The rig: one of each, none touching another, as the table of the devices has it.

use crate::belt::{Belt, BeltParameters};
use crate::chance::Dice;
use crate::gripper::{Gripper, GripperParameters};
use crate::motor::{Motor, MotorParameters};
use crate::plant::{Device, Kind, Plant, Signal};
use crate::ports;
use crate::pusher::{Pusher, PusherParameters};
use crate::quirk::Quirk;
use crate::robot::{Robot, RobotParameters};
use crate::servo::{Servo, ServoParameters};

/// What the rig is built to.
#[derive(Clone, Debug)]
pub struct RigParameters {
    pub belt: BeltParameters,
    pub pusher: PusherParameters,
    pub robot: RobotParameters,
    pub gripper: GripperParameters,
    pub servo: ServoParameters,
    pub motor: MotorParameters,
}

impl RigParameters {
    /// As the table has it.
    pub fn nominal() -> RigParameters {
        RigParameters {
            belt: BeltParameters {
                length: 2.0,
                acceleration: 1.0,
                barriers: [0.3, 1.7],
                box_length: 0.3,
                box_at: 0.15,
                first: 1.0,
                interval: 6.0,
            },
            pusher: PusherParameters { stroke: 0.5, extend_speed: 0.5, retract_speed: 0.5, limit_tolerance: 0.002 },
            robot: RobotParameters {
                fastest: [1.0, 1.0, 1.0, 2.0],
                steepest: [2.0, 2.0, 2.0, 8.0],
                tolerance: [5e-4; 4],
            },
            gripper: GripperParameters { build_up: 0.15, release: 0.08 },
            servo: ServoParameters {
                mass: 20.0,
                viscous: 50.0,
                position_gain: 25.0,
                velocity_gain: 800.0,
                force_limit: 500.0,
            },
            motor: MotorParameters { acceleration: 20.0, counts: 4096.0 },
        }
    }

    /// As one is built: every measure anywhere within its `tolerance`, a share of itself. What is counted or scheduled
    /// (an encoder's lines, the instants of the boxes) is exact.
    pub fn built(tolerance: f64, dice: &mut Dice) -> RigParameters {
        let mut built = RigParameters::nominal();
        for (_, measure) in built.all_measures() {
            *measure *= 1.0 + dice.between(-tolerance, tolerance);
        }
        built
    }

    /// All measures that are built to a tolerance, each with its device.
    pub fn all_measures(&mut self) -> Vec<(&'static str, &mut f64)> {
        let RigParameters { belt, pusher, robot, gripper, servo, motor } = self;
        let mut belts = vec![&mut belt.acceleration, &mut belt.box_length];
        belts.extend(&mut belt.barriers);
        let pushers =
            vec![&mut pusher.stroke, &mut pusher.extend_speed, &mut pusher.retract_speed, &mut pusher.limit_tolerance];
        let robots = robot.fastest.iter_mut().chain(&mut robot.steepest).chain(&mut robot.tolerance).collect();
        let grippers = vec![&mut gripper.build_up, &mut gripper.release];
        let servos = vec![
            &mut servo.mass,
            &mut servo.viscous,
            &mut servo.position_gain,
            &mut servo.velocity_gain,
            &mut servo.force_limit,
        ];
        let each: [(&'static str, Vec<&mut f64>); 6] = [
            ("Belt", belts),
            ("Pusher", pushers),
            ("Robot", robots),
            ("Gripper", grippers),
            ("Motor", vec![&mut motor.acceleration]),
            ("Axis", servos),
        ];
        each.into_iter().flat_map(|(device, all)| all.into_iter().map(move |measure| (device, measure))).collect()
    }

    /// The plant with `quirks`; `seed` is that of what befalls its boxes.
    pub fn plant(&self, quirks: &[Quirk], seed: u64) -> Plant {
        let RigParameters { belt, pusher, robot, gripper, servo, motor } = self;
        let devices: [(&str, Box<dyn Device>); 6] = [
            ("Belt", Box::new(Belt::new(belt, quirks, "Belt", "Feed", seed))),
            ("Pusher", Box::new(Pusher::new(pusher, quirks, "Pusher"))),
            ("Robot", Box::new(Robot::new(robot, quirks, "Robot"))),
            ("Gripper", Box::new(Gripper::new(gripper, quirks, "Gripper"))),
            ("Axis", Box::new(Servo::new(servo, quirks, "Axis"))),
            ("Motor", Box::new(Motor::new(motor, quirks, "Motor"))),
        ];
        let devices = devices.into_iter().map(|(name, device)| (name.to_owned(), device)).collect();
        Plant::new(devices, commands(), signals(), quirks)
    }
}

/// All commands, in the order of the first message.
pub fn commands() -> Vec<(String, Kind)> {
    let each = [
        ("Belt", ports::BELT),
        ("Pusher", ports::PUSHER),
        ("Robot", ports::ROBOT),
        ("Gripper", ports::GRIPPER),
        ("Axis", ports::SERVO),
        ("Motor", ports::MOTOR),
    ];
    each.into_iter().flat_map(|(name, ports)| ports::commands(name, ports)).collect()
}

/// All reports, in the order in which the devices read them.
pub fn signals() -> Vec<Signal> {
    let (belt, pusher, robot) = (ports::belt("Belt"), ports::pusher("Pusher"), ports::robot("Robot"));
    let (gripper, servo, motor) = (ports::gripper("Gripper"), ports::servo("Axis", 0.5), ports::motor("Motor"));
    [belt, pusher, robot, gripper, servo, motor].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_read_as_many_values_as_there_are_signals() {
        let plant = RigParameters::nominal().plant(&[], 1);
        let mut values = Vec::new();
        plant.devices.iter().for_each(|(_, device)| device.read(0.0, &mut values));
        assert_eq!(values.len(), plant.signals.len());
        let at_start: Vec<&str> = plant
            .signals
            .iter()
            .zip(&values)
            .filter(|(_, value)| **value != 0.0)
            .map(|(s, _)| s.name.as_str())
            .collect();
        assert_eq!(at_start, ["Pusher.limitRetracted", "Robot.cartesianArrived"]);
    }

    #[test]
    fn a_built_rig_keeps_to_its_tolerance_and_is_no_other_twice() {
        let [one, two] = [1, 2].map(|seed| RigParameters::built(0.01, &mut Dice::new(seed, 0)));
        assert!((one.servo.mass / 20.0 - 1.0).abs() <= 0.01 && one.servo.mass != two.servo.mass);
        assert_eq!(one.motor.counts, 4096.0);
    }
}
