//! `gain`: a sensor reads a multiple: y = gain·x.
//!
//! Source: the multiplicative fault of a sensor (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2).

use super::proportion::Proportion;
use super::table::{BASE, ONE, parameter};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "gain",
    summary: "a sensor reads a multiple",
    equation: "y = gain·x",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 5.2",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Number)],
    parameters: &[parameter("gain", ONE, (0.01, 100.0), 1.0, 1.02, "how many times")],
    excited_by: "readings other than 0",
    build: Build::Stage(|values, site| Proportion::stage(values[0], site)),
    ..BASE
};

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_named_signal_is_read_in_proportion() {
        let gain = spec("sensor", "gain", Some("force"), &[("gain", 1.1)]);
        with("ServoAxis", &[("load", "50")], &[gain]).check(&[], 5.0, &[("position", -0.0025), ("force", 55.0)]);
    }
}
