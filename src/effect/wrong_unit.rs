//! `wrong-unit`: a number is sent in one unit and read in another: y = factor·x.
//!
//! Source: the ratio of two units (BIPM, The International System of Units, 9th edition).

use super::proportion::Proportion;
use super::table::{BASE, ONE, parameter};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "wrong-unit",
    summary: "a number is sent in one unit and read in another",
    equation: "y = factor·x",
    source: "BIPM, The International System of Units, 9th edition",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Number)],
    parameters: &[parameter("factor", ONE, (-1e6, 1e6), 1.0, 1000.0, "one unit in the other")],
    excited_by: "numbers other than 0",
    build: Build::Stage(|values, site| Proportion::stage(values[0], site)),
    ..BASE
};

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn revolutions_a_minute_are_read_as_radians_a_second() {
        let factor = std::f64::consts::TAU / 60.0;
        let unit = spec("command-link", "wrong-unit", Some("speedTarget"), &[("factor", factor)]);
        let mut motor = with("EncoderMotor", &[], &[unit]);
        motor.check(&[("enable", 1.0), ("speedTarget", 60.0)], 9.0, &[("speedActual", std::f64::consts::TAU)]);
    }
}
