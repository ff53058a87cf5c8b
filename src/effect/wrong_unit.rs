//! `wrong-unit`: a number is sent in one unit and read in another: y = factor·x.
//!
//! Source: the ratio of two units (BIPM, The International System of Units, 9th edition).

use super::table::{BASE, ONE, parameter};
use crate::device::law::encoder::SAME_COUNT;
use crate::device::path::{Moment, Stage};
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
    build: Build::Stage(|values, site| {
        Box::new(WrongUnit { factor: values[0], is_whole: site.is_whole(), is_fine: false })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct WrongUnit {
    factor: f64,
    is_whole: bool,
    /// Whether parts of a count pass, which are no part of what is told in proportion.
    is_fine: bool,
}

impl Stage for WrongUnit {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn count_finely(&mut self) {
        self.is_fine = self.is_whole;
    }

    fn signal(&mut self, value: f64, _moment: Moment) -> f64 {
        if self.is_fine {
            return value + ((self.factor - 1.0) * (value + SAME_COUNT).floor()).round();
        }
        let value = self.factor * value;
        if self.is_whole { value.round() } else { value }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

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
