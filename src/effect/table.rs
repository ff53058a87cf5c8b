//! Short forms for the effects' lines in the registry.

use super::{Build, EffectDescriptor, EffectParameter, Fit, Needs};
use crate::value::Quantity;

/// Quantities of a device that is linear or rotary.
pub(super) const TRAVEL: &[Quantity] = &[Quantity::Length, Quantity::Angle];
pub(super) const SPEED: &[Quantity] = &[Quantity::Velocity, Quantity::AngularVelocity];
pub(super) const ACCELERATION: &[Quantity] = &[Quantity::Acceleration, Quantity::AngularAcceleration];
pub(super) const EFFORT: &[Quantity] = &[Quantity::Force, Quantity::Torque];
pub(super) const DAMPING: &[Quantity] = &[Quantity::LinearDamping, Quantity::AngularDamping];
pub(super) const INERTIA: &[Quantity] = &[Quantity::Mass, Quantity::Inertia];
pub(super) const STIFFNESS: &[Quantity] = &[Quantity::LinearStiffness, Quantity::AngularStiffness];
/// Quantities of every device.
pub(super) const LENGTH: &[Quantity] = &[Quantity::Length];
pub(super) const LINEAR_ACCELERATION: &[Quantity] = &[Quantity::Acceleration];
pub(super) const RATE: &[Quantity] = &[Quantity::Rate];
pub(super) const TIME: &[Quantity] = &[Quantity::Time];
pub(super) const FREQUENCY: &[Quantity] = &[Quantity::AngularVelocity];
pub(super) const ANGLE: &[Quantity] = &[Quantity::Angle];
/// A ratio, or the unit of the signal that the effect stands at.
pub(super) const ONE: &[Quantity] = &[Quantity::One];

/// Kinds of devices, by the last word of their names.
pub(super) const SERVO: &[&str] = &["ServoAxis"];
/// Every kind with a drive.
pub(super) const DRIVES: &[&str] =
    &["StraightConveyor", "ConveyorCurve", "Pusher", "CartesianRobot", "ServoAxis", "EncoderMotor"];
/// Those that are switched on and off.
pub(super) const SWITCHED: &[&str] =
    &["StraightConveyor", "ConveyorCurve", "Pusher", "SuctionCapGripper", "EncoderMotor", "ServoAxis"];

/// The limit that limits nothing, SI.
pub(super) const UNLIMITED: f64 = 1e9;

/// What an effect is that says nothing else of itself.
pub(super) const BASE: EffectDescriptor = EffectDescriptor {
    id: "",
    summary: "",
    equation: "",
    source: "",
    places: &[],
    fits: &[Fit::Drives(DRIVES)],
    needs: Needs::Nothing,
    parameters: &[],
    texts: &[],
    acts_always: false,
    excited_by: "",
    build: Build::Parameters,
};

/// A parameter from `least` to `greatest` that does nothing at `nominal`.
pub(super) const fn parameter(
    name: &'static str,
    quantities: &'static [Quantity],
    range: (f64, f64),
    nominal: f64,
    typical: f64,
    summary: &'static str,
) -> EffectParameter {
    EffectParameter { name, quantities, range, nominal, typical, default: None, options: &[], summary }
}

impl EffectParameter {
    /// The same, with the value it has where a model does not give it.
    pub(super) const fn or(mut self, default: f64) -> EffectParameter {
        self.default = Some(default);
        self
    }

    /// The same, one of these values only.
    pub(super) const fn one_of(mut self, options: &'static [f64]) -> EffectParameter {
        self.options = options;
        self
    }
}

/// The parameter of an effect that is a time.
pub(super) const fn time(name: &'static str, typical: f64, summary: &'static str) -> EffectParameter {
    parameter(name, TIME, (0.0, 10.0), 0.0, typical, summary)
}
