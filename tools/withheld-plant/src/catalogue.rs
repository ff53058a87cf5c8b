//! What can be wrong with the rig, where, and how much of it is much.
//!
//! A strength from 0 (nothing) to 1 (the most that is drawn) goes into the parameters by a law for each. What begins with
//! `x-` no file of the library describes.

use crate::chance::Dice;
use crate::quirk::Quirk;

/// How a parameter grows with the strength.
#[derive(Clone, Copy, Debug)]
pub enum Law {
    /// `most·strength`, in the spot's scale.
    Grows(&'static str, f64),
    /// 1 ± `most·strength`.
    About1(&'static str, f64),
    /// ± `most·strength`, in the spot's scale.
    Either(&'static str, f64),
    /// `1 − most·strength` of the spot's scale.
    Below(&'static str, f64),
    /// `least/strength`, in the spot's scale: what does nothing when it is infinite.
    Above(&'static str, f64),
    /// 1 ± `most·strength` of the spot's scale: a nominal parameter that is wrong.
    Wrong(f64),
    /// `most·strength`, whatever the spot's scale.
    Share(&'static str, f64),
    /// Always so much, in the spot's scale.
    Is(&'static str, f64),
    /// Somewhere between the two, in the spot's scale.
    Within(&'static str, f64, f64),
    /// One of several, whatever the strength.
    OneOf(&'static str, &'static [f64]),
}

use Law::{About1, Above, Below, Either, Grows, Is, OneOf, Share, Within, Wrong};

/// A device, perhaps a part of it, and the scale of what is wrong there.
pub type Spot = (&'static str, &'static str, f64);

/// An effect, its place, where it can be, and how much.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub effect: &'static str,
    pub place: &'static str,
    pub spots: &'static [Spot],
    pub laws: &'static [Law],
    /// A measure within its tolerance does the same: below this strength nobody can tell.
    pub tolerated: f64,
}

const fn entry(effect: &'static str, place: &'static str, spots: &'static [Spot], laws: &'static [Law]) -> Entry {
    Entry { effect, place, spots, laws, tolerated: 0.0 }
}

const fn tolerated(entry: Entry, tolerated: f64) -> Entry {
    Entry { tolerated, ..entry }
}

const COMMAND: &str = "command-link";
const REPORT: &str = "report-link";
const ACTUATOR: &str = "actuator";
const MECHANICS: &str = "mechanics";
const TRANSMISSION: &str = "transmission";
const LOAD: &str = "load";
const SENSOR: &str = "sensor";
const PROCESS: &str = "process";

const ALL: &[Spot] = &[
    ("Belt", "", 1.0),
    ("Pusher", "", 1.0),
    ("Robot", "", 1.0),
    ("Gripper", "", 1.0),
    ("Axis", "", 1.0),
    ("Motor", "", 1.0),
];
/// Numbers that are commanded; the scale is how large they are.
const TARGETS: &[Spot] = &[
    ("Belt", "velocityTarget", 0.4),
    ("Robot", "XTarget", 0.4),
    ("Robot", "RTarget", 1.2),
    ("Axis", "positionTarget", 0.1),
    ("Motor", "speedTarget", 15.0),
];
/// Numbers that are reported.
const READINGS: &[Spot] = &[
    ("Belt", "velocityActual", 0.4),
    ("Robot", "actualPosY", 0.4),
    ("Robot", "actualPosR", 1.2),
    ("Axis", "position", 0.1),
    ("Axis", "velocity", 0.3),
    ("Axis", "force", 100.0),
    ("Motor", "speedActual", 15.0),
];
/// Switches; the scale is a way on which they look.
const SWITCHES: &[Spot] = &[
    ("Belt", "lightBarrierA", 0.1),
    ("Belt", "lightBarrierB", 0.1),
    ("Pusher", "limitExtended", 0.1),
    ("Pusher", "limitRetracted", 0.1),
];
const FLAGS: &[Spot] = &[
    ("Belt", "lightBarrierA", 1.0),
    ("Belt", "lightBarrierB", 1.0),
    ("Pusher", "limitExtended", 1.0),
    ("Pusher", "limitRetracted", 1.0),
    ("Gripper", "vacuumOn", 1.0),
    ("Robot", "cartesianArrived", 1.0),
];
/// By their speeds.
const BY_SPEED: &[Spot] =
    &[("Belt", "", 0.55), ("Pusher", "", 0.5), ("Robot", "X", 1.0), ("Robot", "Z", 1.0), ("Motor", "", 22.0)];
/// By their accelerations.
const BY_SLOPE: &[Spot] = &[
    ("Belt", "", 1.0),
    ("Robot", "X", 2.0),
    ("Robot", "Y", 2.0),
    ("Robot", "R", 8.0),
    ("Axis", "", 15.0),
    ("Motor", "", 20.0),
];
const RAMPED: &[Spot] = &[("Belt", "", 1.0), ("Robot", "Y", 2.0), ("Robot", "R", 8.0), ("Motor", "", 20.0)];
const DRIVES: &[Spot] = &[
    ("Belt", "", 1.0),
    ("Pusher", "", 1.0),
    ("Robot", "X", 1.0),
    ("Robot", "R", 1.0),
    ("Axis", "", 1.0),
    ("Motor", "", 1.0),
];
/// By their ways.
const BY_WAY: &[Spot] = &[
    ("Belt", "", 0.5),
    ("Pusher", "", 0.3),
    ("Robot", "Y", 0.3),
    ("Robot", "R", 1.0),
    ("Axis", "", 0.1),
    ("Motor", "", 10.0),
];
const SLIPPING: &[Spot] = &[("Belt", "", 1.0), ("Robot", "X", 2.0), ("Axis", "", 15.0), ("Motor", "", 20.0)];
const SWITCHED: &[Spot] = &[("Belt", "", 1.0), ("Pusher", "", 1.0), ("Gripper", "", 1.0), ("Motor", "", 1.0)];
const AXIS: &[Spot] = &[("Axis", "", 1.0)];
const BELT: &[Spot] = &[("Belt", "", 1.0)];
const GRIPPER: &[Spot] = &[("Gripper", "", 1.0)];
const FEED: &[Spot] = &[("Feed", "", 1.0)];
const PUSHER: &[Spot] = &[("Pusher", "", 1.0)];
const MOTOR: &[Spot] = &[("Motor", "", 1.0)];
const ROBOT_X: &[Spot] = &[("Robot", "X", 1.0)];
const ROBOT: &[Spot] = &[("Robot", "", 1.0)];
/// By their nominal values.
const PARAMETERS: &[Spot] = &[
    ("Belt", "acceleration", 1.0),
    ("Belt", "barrierB", 1.7),
    ("Pusher", "extendSpeed", 0.5),
    ("Pusher", "retractSpeed", 0.5),
    ("Robot", "maxVelocityX", 1.0),
    ("Robot", "maxAccelerationR", 8.0),
    ("Gripper", "buildUpTime", 0.15),
    ("Gripper", "releaseTime", 0.08),
    ("Axis", "Fv", 50.0),
    ("Axis", "positionGain", 25.0),
    ("Axis", "velocityGain", 800.0),
    ("Motor", "acceleration", 20.0),
];

/// Whether no file of the library describes an effect.
pub fn is_outside(effect: &str) -> bool {
    effect.starts_with("x-")
}

impl Entry {
    /// Whether its strength changes anything: a signal is inverted, or it is not.
    pub fn has_strength(&self) -> bool {
        self.laws.iter().any(|law| !matches!(law, Is(..) | OneOf(..) | Within(..)))
    }

    /// The effect at `spot` with this strength, above 0 and at most 1. What else there is to choose, `dice` choose.
    pub fn quirk(&self, spot: Spot, strength: f64, dice: &mut Dice) -> Quirk {
        let (device, component, scale) = spot;
        let mut sign = || if dice.is_so(0.5) { 1.0 } else { -1.0 };
        let mut parameters = Vec::new();
        for law in self.laws {
            parameters.push(match *law {
                Grows(name, most) => (name, scale * most * strength),
                Share(name, most) => (name, most * strength),
                About1(name, most) => (name, 1.0 + sign() * most * strength),
                Either(name, most) => (name, scale * sign() * most * strength),
                Below(name, most) => (name, scale * (1.0 - most * strength)),
                Above(name, least) => (name, scale * least / strength),
                Wrong(most) => ("value", scale * (1.0 + sign() * most * strength)),
                Is(name, value) => (name, scale * value),
                Within(..) | OneOf(..) => continue,
            });
        }
        for law in self.laws {
            match *law {
                Within(name, low, high) => parameters.push((name, scale * dice.between(low, high))),
                OneOf(name, all) => parameters.push((name, *dice.one_of(all))),
                _ => {}
            }
        }
        Quirk {
            device: device.to_owned(),
            component: (!component.is_empty()).then(|| component.to_owned()),
            effect: self.effect.to_owned(),
            place: self.place.to_owned(),
            parameters: parameters.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
            with: None,
        }
    }
}

/// Everything.
pub const ENTRIES: &[Entry] = &[
    entry(
        "inverted",
        COMMAND,
        &[("Robot", "YTarget", 1.0), ("Axis", "positionTarget", 1.0), ("Motor", "speedTarget", 1.0)],
        &[],
    ),
    entry(
        "inverted",
        REPORT,
        &[("Belt", "lightBarrierA", 1.0), ("Pusher", "limitExtended", 1.0), ("Gripper", "vacuumOn", 1.0)],
        &[],
    ),
    entry("stuck", REPORT, FLAGS, &[OneOf("value", &[0.0, 1.0]), Within("from", 0.0, 20.0)]),
    entry("intermittent", REPORT, FLAGS, &[Grows("probability", 0.3), Is("time", 0.1)]),
    entry("intermittent", REPORT, READINGS, &[Share("probability", 0.3), OneOf("time", &[0.1])]),
    entry("wrong-unit", COMMAND, TARGETS, &[OneOf("factor", &[0.1, 0.0254, 2.54, 0.304_8])]),
    entry("wrong-unit", REPORT, READINGS, &[OneOf("factor", &[1000.0, 0.1, 10.0, 57.295_779_513_082_32])]),
    entry("input-filter", COMMAND, TARGETS, &[Share("time_constant", 0.2)]),
    entry("dead-time", COMMAND, ALL, &[Grows("time", 0.2)]),
    entry("dead-time", REPORT, ALL, &[Grows("time", 0.2)]),
    entry("sampling-jitter", COMMAND, ALL, &[Grows("sigma", 0.05)]),
    entry("lost-messages", REPORT, ALL, &[Grows("probability", 0.4)]),
    entry("clock-drift", REPORT, ALL, &[Grows("rate", 0.01)]),
    entry("stale-hold", REPORT, ALL, &[Grows("time", 0.4)]),
    entry("first-order-lag", ACTUATOR, DRIVES, &[Grows("time_constant", 0.15)]),
    entry("second-order-lag", ACTUATOR, RAMPED_LAG, &[Above("natural_frequency", 12.0), Within("damping", 0.3, 0.8)]),
    entry("gain-error", ACTUATOR, DRIVES, &[About1("gain", 0.3)]),
    tolerated(entry("velocity-limit", ACTUATOR, BY_SPEED, &[Below("limit", 0.6)]), 0.08),
    tolerated(entry("acceleration-limit", ACTUATOR, BY_SLOPE, &[Below("limit", 0.6)]), 0.08),
    entry("jerk-limit", ACTUATOR, RAMPED, &[Above("limit", 2.5)]),
    entry("force-limit", ACTUATOR, &[("Axis", "", 450.0)], &[Below("limit", 0.8)]),
    entry(
        "dead-band",
        ACTUATOR,
        &[("Belt", "", 0.8), ("Robot", "Y", 0.2), ("Axis", "", 0.02), ("Motor", "", 20.0)],
        &[Grows("width", 1.0)],
    ),
    entry(
        "direction-asymmetry",
        ACTUATOR,
        &[("Belt", "", 1.0), ("Motor", "", 1.0), ("Axis", "", 1.0)],
        &[Grows("asymmetry", 0.4)],
    ),
    tolerated(
        entry("direction-asymmetry", ACTUATOR, &[("Pusher", "", 1.0), ("Robot", "X", 1.0)], &[Grows("asymmetry", 0.4)]),
        0.1,
    ),
    entry(
        "supply-drop",
        ACTUATOR,
        &[("Belt", "", 1.0), ("Pusher", "", 1.0), ("Motor", "", 1.0)],
        &[Grows("fraction", 0.1)],
    ),
    entry("switch-on-delay", ACTUATOR, SWITCHED, &[Grows("time", 0.2)]),
    entry("switch-off-delay", ACTUATOR, SWITCHED, &[Grows("time", 0.2)]),
    entry("load-dependent-speed", ACTUATOR, BELT, &[Grows("coefficient", 0.3)]),
    entry("coasting", ACTUATOR, &[("Belt", "", 0.9), ("Motor", "", 18.0)], &[Below("deceleration", 0.8)]),
    entry("end-cushioning", ACTUATOR, PUSHER, &[Grows("length", 0.15), Within("ratio", 0.3, 0.6)]),
    entry("settling-time", ACTUATOR, ROBOT_X, &[Grows("time", 0.3)]),
    entry("coulomb-friction", MECHANICS, AXIS, &[Grows("force", 60.0)]),
    tolerated(entry("viscous-friction", MECHANICS, AXIS, &[Grows("coefficient", 100.0)]), 0.05),
    entry("stribeck-friction", MECHANICS, AXIS, &[Grows("force", 60.0), Within("velocity", 0.02, 0.1)]),
    entry("breakaway-friction", MECHANICS, AXIS, &[Grows("force", 60.0)]),
    entry("load-dependent-friction", MECHANICS, AXIS, &[Grows("coefficient", 0.4)]),
    entry("backlash", TRANSMISSION, BY_WAY, &[Grows("gap", 0.15)]),
    entry(
        "compliance",
        TRANSMISSION,
        &[("Belt", "", 1.0), ("Robot", "X", 1.0), ("Motor", "", 1.0)],
        &[Above("stiffness", 150.0), Within("damping", 2.0, 6.0)],
    ),
    entry(
        "compliance",
        TRANSMISSION,
        &[("Axis", "", 10.0)],
        &[Above("stiffness", 600.0), Within("damping", 5.0, 20.0)],
    ),
    entry("belt-slip", TRANSMISSION, SLIPPING, &[Share("ratio", 0.2)]),
    entry("scale-error", TRANSMISSION, BY_WAY_1, &[Either("ratio", 0.2)]),
    entry("belt-slip-above-acceleration", TRANSMISSION, SLIPPING, &[Below("acceleration", 0.7)]),
    entry(
        "once-per-revolution-error",
        TRANSMISSION,
        BY_WAY,
        &[Grows("amplitude", 0.05), Within("period", 0.3, 0.8), Within("phase", 0.0, 0.0)],
    ),
    tolerated(entry("added-mass", LOAD, AXIS, &[Grows("mass", 15.0)]), 0.05),
    entry("constant-force", LOAD, AXIS, &[Either("force", 80.0)]),
    entry("offset", SENSOR, READINGS, &[Either("offset", 0.3)]),
    entry("gain", SENSOR, READINGS, &[About1("gain", 0.3)]),
    entry("drift", SENSOR, READINGS, &[Either("rate", 0.01)]),
    entry("quantisation", SENSOR, READINGS, &[Grows("step", 0.2)]),
    entry("noise", SENSOR, READINGS, &[Grows("sigma", 0.1)]),
    entry("hysteresis", SENSOR, READINGS_OF_WAYS, &[Grows("width", 0.2)]),
    entry("on-delay", SENSOR, FLAGS, &[Grows("time", 0.2)]),
    entry("off-delay", SENSOR, FLAGS, &[Grows("time", 0.2)]),
    entry("hysteresis", SENSOR, SWITCHES, &[Grows("width", 1.0)]),
    entry("blind-range", SENSOR, SWITCHES, &[Grows("length", 1.0)]),
    entry("part-slip", PROCESS, BELT, &[Below("acceleration", 0.8)]),
    tolerated(entry("part-length-error", PROCESS, FEED, &[Either("length", 0.08)]), 0.15),
    entry("part-spacing-error", PROCESS, FEED, &[Either("time", 1.5)]),
    entry("vacuum-build-up", PROCESS, GRIPPER, &[Grows("time", 0.2)]),
    entry("leak", PROCESS, GRIPPER, &[Grows("rate", 3.0)]),
    tolerated(entry("parameter-error", "any", PARAMETERS, &[Wrong(0.4)]), 0.12),
    // Outside of the library.
    entry("x-friction-warms-up", MECHANICS, AXIS, &[Grows("force", 40.0), Is("rise", 1.5), Within("time", 12.0, 25.0)]),
    entry("x-drags-with-the-square", MECHANICS, AXIS, &[Grows("coefficient", 300.0)]),
    entry("x-cogs", MECHANICS, AXIS, &[Grows("force", 60.0), Within("period", 0.02, 0.06)]),
    entry("x-iron-saturates", ACTUATOR, AXIS, &[Above("force", 120.0)]),
    entry(
        "x-coupling-slips-each-turn",
        TRANSMISSION,
        &[("Belt", "", 0.5), ("Axis", "", 0.1), ("Motor", "", 10.0)],
        &[Grows("slip", 0.1), Is("turn", 1.0)],
    ),
    entry(
        "x-grows-with-heat",
        TRANSMISSION,
        &[("Robot", "X", 1.0), ("Robot", "Z", 1.0)],
        &[Grows("share", 0.1), Within("time", 10.0, 20.0)],
    ),
    entry("x-axes-are-not-square", TRANSMISSION, ROBOT, &[Either("share", 0.1)]),
    entry(
        "x-fades-with-heat",
        ACTUATOR,
        &[("Belt", "", 1.0), ("Motor", "", 1.0)],
        &[Grows("share", 0.4), Within("time", 5.0, 20.0)],
    ),
    entry(
        "x-beats-with-the-mains",
        ACTUATOR,
        &[("Belt", "", 1.0), ("Motor", "", 1.0)],
        &[Grows("share", 0.2), Within("frequency", 0.2, 0.9)],
    ),
    entry("x-rests-before-it-turns", ACTUATOR, &[("Belt", "", 1.0), ("Motor", "", 1.0)], &[Grows("time", 0.5)]),
    entry("x-sticks-after-a-rest", ACTUATOR, PUSHER, &[Grows("rate", 0.4), Is("most", 0.4)]),
    entry("x-supply-sags-with-use", ACTUATOR, PUSHER, &[Grows("share", 0.15), Within("time", 4.0, 9.0)]),
    entry("x-filter-clogs", PROCESS, GRIPPER, &[Grows("share", 0.1), Is("most", 4.0)]),
    entry("x-boxes-stick", PROCESS, BELT, &[Grows("time", 0.8)]),
    entry(
        "x-is-half-hidden",
        SENSOR,
        &[("Belt", "lightBarrierA", 1.0), ("Belt", "lightBarrierB", 1.0)],
        &[Grows("length", 0.1)],
    ),
    entry("x-encoder-skips", SENSOR, MOTOR, &[Within("speed", 8.0, 14.0), Grows("rate", 400.0)]),
];

const RAMPED_LAG: &[Spot] = &[("Belt", "", 1.0), ("Robot", "Y", 1.0), ("Motor", "", 1.0)];
const BY_WAY_1: &[Spot] =
    &[("Belt", "", 1.0), ("Pusher", "", 1.0), ("Robot", "Z", 1.0), ("Axis", "", 1.0), ("Motor", "", 1.0)];
const READINGS_OF_WAYS: &[Spot] = &[("Robot", "actualPosY", 0.1), ("Axis", "position", 0.1)];
