//! `parameter-error`: a parameter of the device is not what the model says. Its component, or its property `parameter`, is the
//! parameter's name; `value` is what it is, in SI units. The device is then built with that value, and is the nominal law of
//! another machine.
//!
//! Source: parametric faults (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2).

use super::table::{BASE, ONE, parameter};
use crate::effect::{Build, EffectDescriptor, EffectText, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "parameter-error",
    summary: "a parameter of the device is not what the model says",
    equation: "p = value",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 5.2",
    places: &EffectPlace::ALL,
    fits: &[Fit::Drives(&[
        "StraightConveyor",
        "ConveyorCurve",
        "Pusher",
        "CartesianRobot",
        "SuctionCapGripper",
        "LoadingBay",
        "UnloadingBay",
        "ServoAxis",
        "EncoderMotor",
    ])],
    parameters: &[parameter("value", ONE, (-1e12, 1e12), 0.0, 1.0, "what it is, in the parameter's SI unit")],
    texts: &[EffectText {
        name: "parameter",
        required: false,
        summary: "the parameter's name, if the component is not",
    }],
    acts_always: true,
    excited_by: "what the parameter is seen by",
    build: Build::Parameters,
    ..BASE
};

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};
    use crate::plant::ParameterValue;

    #[test]
    fn the_device_is_the_nominal_law_with_that_value() {
        let mut by_property = spec("actuator", "parameter-error", None, &[("value", 0.8)]);
        by_property.parameters.insert("parameter".to_owned(), ParameterValue::Text("acceleration".to_owned()));
        let by_component = spec("actuator", "parameter-error", Some("acceleration"), &[("value", 0.8)]);
        for error in [by_property, by_component] {
            let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
            with("StraightConveyor", &[], &[error]).check(&run, 0.5, &[("velocityActual", 0.4)]);
        }
    }
}
