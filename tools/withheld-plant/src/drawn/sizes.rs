//! How large a device is beside the rig's: so that what is much for the rig becomes as much for it.
//!
//! The catalogue says of every effect how much of it is much for the rig's device. A device of another size is that device
//! drawn larger, faster or heavier: each parameter of an effect grows by the ratio of what it measures.

use crate::quirk::Quirk;
use crate::rig::RigParameters;
use crate::robot::AXES;

use super::unit::Figures;

/// What a device moves by, in SI units; of what it has not, 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// How far it goes.
    pub way: f64,
    /// The fastest that it goes.
    pub speed: f64,
    /// How steeply its speed changes.
    pub slope: f64,
    /// What it moves, kg.
    pub mass: f64,
    /// What it exerts at most, N.
    pub force: f64,
    /// Encoder counts of a turn.
    pub counts: f64,
    /// Of the boxes on it, m.
    pub length: f64,
    /// From one box to the next, s.
    pub interval: f64,
}

const NONE: Sizes =
    Sizes { way: 1.0, speed: 1.0, slope: 1.0, mass: 1.0, force: 1.0, counts: 1.0, length: 1.0, interval: 1.0 };

impl Sizes {
    /// Those of a device, of a robot those of the axis or signal `component`.
    pub fn of(figures: &Figures, component: &str) -> Sizes {
        match figures {
            Figures::Belt { parameters, top, .. } => Sizes {
                way: parameters.barriers[1] - parameters.barriers[0],
                speed: *top,
                slope: parameters.acceleration,
                length: parameters.box_length,
                interval: parameters.interval,
                ..NONE
            },
            Figures::Pusher(pusher) => {
                Sizes { way: pusher.stroke, speed: pusher.extend_speed.min(pusher.retract_speed), ..NONE }
            }
            Figures::Robot { parameters, reach } => {
                // X, XTarget and actualPosX are of one axis; what is of none is taken for X.
                let axis = component.strip_suffix("Target").unwrap_or(component);
                let at = AXES.iter().position(|name| axis.ends_with(name)).unwrap_or(0);
                Sizes { way: reach[at], speed: parameters.fastest[at], slope: parameters.steepest[at], ..NONE }
            }
            Figures::Gripper(_) => NONE,
            Figures::Servo { parameters, reach, .. } => Sizes {
                way: *reach,
                speed: *reach * parameters.position_gain,
                slope: parameters.force_limit / parameters.mass,
                mass: parameters.mass,
                force: parameters.force_limit,
                ..NONE
            },
            Figures::Motor { parameters, top } => {
                Sizes { way: *top, speed: *top, slope: parameters.acceleration, counts: parameters.counts, ..NONE }
            }
        }
    }

    /// Those of the rig's device of that kind.
    pub fn of_rig(kind: &str, component: &str) -> Sizes {
        of_rig(kind).map_or(NONE, |figures| Sizes::of(&figures, component))
    }

    /// How long it takes for its way at its speed, s.
    pub fn time(self) -> f64 {
        self.way / self.speed
    }

    /// How long it takes there and back from rest to rest, s.
    pub fn trip(self) -> f64 {
        2.0 * self.way / self.speed + self.speed / self.slope
    }
}

/// The rig's device of a kind.
pub fn of_rig(kind: &str) -> Option<Figures> {
    let rig = RigParameters::nominal();
    Some(match kind {
        "Belt" | "Feed" => Figures::Belt { parameters: rig.belt, feed: "Feed".to_owned(), top: 0.6 },
        "Pusher" => Figures::Pusher(rig.pusher),
        "Robot" => Figures::Robot { parameters: rig.robot, reach: [0.5, 0.5, 0.35, 1.4] },
        "Gripper" => Figures::Gripper(rig.gripper),
        "Axis" => Figures::Servo { parameters: rig.servo, reach: 0.45, newton: 0.5 },
        "Motor" => Figures::Motor { parameters: rig.motor, top: 24.0 },
        _ => return None,
    })
}

/// What was drawn for the rig's device, as it is for one with these figures; its names stay those of the rig's.
pub fn fitted(mut quirk: Quirk, figures: &Figures) -> Quirk {
    let component = quirk.component.clone().unwrap_or_default();
    let (own, rig) = (Sizes::of(figures, &component), Sizes::of_rig(&quirk.device, &component));
    let ratio = |of: &dyn Fn(Sizes) -> f64| of(own) / of(rig);
    if quirk.effect == "parameter-error" {
        let nominal = |figures: &Figures| nominal(figures, &component);
        let ratio = of_rig(&quirk.device).map_or(1.0, |rig| nominal(figures) / nominal(&rig));
        quirk.parameters.iter_mut().for_each(|(_, value)| *value *= ratio);
        return quirk;
    }
    for (name, value) in &mut quirk.parameters {
        *value *= match measures(&quirk.effect, name, &quirk.device, &component) {
            Measure::Pure => 1.0,
            Measure::Way => ratio(&|it| it.way),
            Measure::Speed => ratio(&|it| it.speed),
            Measure::Slope => ratio(&|it| it.slope),
            Measure::Mass => ratio(&|it| it.mass),
            Measure::Force => ratio(&|it| it.force),
            Measure::ForceBySpeed => ratio(&|it| it.force / it.speed),
            Measure::ForceBySquare => ratio(&|it| it.force / (it.speed * it.speed)),
            Measure::Counts => ratio(&|it| it.counts),
            Measure::Length => ratio(&|it| it.length),
            Measure::Interval => ratio(&|it| it.interval),
        };
    }
    quirk
}

/// What a parameter measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measure {
    Pure,
    Way,
    Speed,
    Slope,
    Mass,
    Force,
    ForceBySpeed,
    ForceBySquare,
    Counts,
    Length,
    Interval,
}

fn measures(effect: &str, parameter: &str, device: &str, component: &str) -> Measure {
    match (effect, parameter) {
        ("velocity-limit", _) | ("x-encoder-skips", "speed") | ("stribeck-friction", "velocity") => Measure::Speed,
        ("dead-band", _) if matches!(device, "Belt" | "Motor") => Measure::Speed,
        ("dead-band", _) => Measure::Way,
        ("acceleration-limit" | "jerk-limit" | "belt-slip-above-acceleration" | "part-slip" | "coasting", _) => {
            Measure::Slope
        }
        ("offset" | "drift" | "quantisation" | "noise", _) => reading(component),
        ("hysteresis" | "blind-range" | "backlash" | "end-cushioning", "width" | "length" | "gap") => Measure::Way,
        ("once-per-revolution-error", "amplitude" | "period") | ("x-coupling-slips-each-turn", _) => Measure::Way,
        ("x-cogs", "period") => Measure::Way,
        ("viscous-friction", _) => Measure::ForceBySpeed,
        ("x-drags-with-the-square", _) => Measure::ForceBySquare,
        ("compliance", _) if device == "Axis" => Measure::Mass,
        ("added-mass", _) => Measure::Mass,
        ("force-limit", _) | (_, "force") => Measure::Force,
        ("x-encoder-skips", "rate") => Measure::Counts,
        ("part-length-error" | "x-is-half-hidden", _) => Measure::Length,
        ("part-spacing-error", _) => Measure::Interval,
        _ => Measure::Pure,
    }
}

/// What a reported number measures.
fn reading(component: &str) -> Measure {
    match component {
        "velocityActual" | "velocity" | "speedActual" => Measure::Speed,
        "force" => Measure::Force,
        _ => Measure::Way,
    }
}

/// A device's nominal parameter, by the name that the catalogue has for it; 1 where it has none of that name.
fn nominal(figures: &Figures, name: &str) -> f64 {
    match (figures, name) {
        (Figures::Belt { parameters, .. }, "acceleration") => parameters.acceleration,
        (Figures::Belt { parameters, .. }, "barrierA") => parameters.barriers[0],
        (Figures::Belt { parameters, .. }, "barrierB") => parameters.barriers[1],
        (Figures::Pusher(parameters), "stroke") => parameters.stroke,
        (Figures::Pusher(parameters), "extendSpeed") => parameters.extend_speed,
        (Figures::Pusher(parameters), "retractSpeed") => parameters.retract_speed,
        (Figures::Robot { parameters, .. }, name) => {
            let limits = [("maxVelocity", &parameters.fastest), ("maxAcceleration", &parameters.steepest)];
            let of = |(limit, all): (&str, &[f64; 4])| {
                let axis = name.strip_prefix(limit)?;
                AXES.iter().position(|one| *one == axis).map(|at| all[at])
            };
            limits.into_iter().find_map(of).unwrap_or(1.0)
        }
        (Figures::Gripper(parameters), "buildUpTime") => parameters.build_up,
        (Figures::Gripper(parameters), "releaseTime") => parameters.release,
        (Figures::Servo { parameters, .. }, "Fv") => parameters.viscous,
        (Figures::Servo { parameters, .. }, "positionGain") => parameters.position_gain,
        (Figures::Servo { parameters, .. }, "velocityGain") => parameters.velocity_gain,
        (Figures::Motor { parameters, .. }, "acceleration") => parameters.acceleration,
        _ => 1.0,
    }
}
