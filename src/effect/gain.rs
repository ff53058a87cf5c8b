//! `gain`: a sensor reads a multiple: y = gain·x.
//!
//! Source: the multiplicative fault of a sensor (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2).

use super::table::{BASE, ONE, parameter};
use crate::device::law::encoder::SAME_COUNT;
use crate::device::path::{Moment, Stage};
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
    build: Build::Stage(|values, site| Box::new(Gain { gain: values[0], is_whole: site.is_whole(), is_fine: false })),
    ..BASE
};

#[derive(Clone, Debug)]
struct Gain {
    gain: f64,
    is_whole: bool,
    /// Whether parts of a count pass, which are no part of what is told in proportion.
    is_fine: bool,
}

impl Stage for Gain {
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
            return value + ((self.gain - 1.0) * (value + SAME_COUNT).floor()).round();
        }
        let value = self.gain * value;
        if self.is_whole { value.round() } else { value }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_named_signal_is_read_in_proportion() {
        let gain = spec("sensor", "gain", Some("force"), &[("gain", 1.1)]);
        with("ServoAxis", &[("load", "50")], &[gain]).check(&[], 5.0, &[("position", -0.0025), ("force", 55.0)]);
    }
}
