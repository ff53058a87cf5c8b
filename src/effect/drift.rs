//! `drift`: a sensor's reading wanders off as time goes: y = x + rate·t.
//!
//! Source: the drift fault of a sensor (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2).

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "drift",
    summary: "a sensor's reading wanders off as time goes",
    equation: "y = x + rate·t",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 5.2",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Number)],
    parameters: &[parameter("rate", ONE, (-1e9, 1e9), 0.0, 1e-4, "how much for each second, in the signal's SI unit")],
    excited_by: "time",
    build: Build::Stage(|values, site| Box::new(Drift { rate: values[0], is_whole: site.is_whole() })),
    ..BASE
};

#[derive(Clone, Debug)]
struct Drift {
    rate: f64,
    is_whole: bool,
}

impl Stage for Drift {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        let more = self.rate * moment.now;
        value + if self.is_whole { more.round() } else { more }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn after_a_while_it_is_off_by_rate_times_time() {
        let drift = spec("sensor", "drift", None, &[("rate", 1e-3)]);
        with("ServoAxis", &[], &[drift]).check(&[("positionTarget", 0.1)], 20.0, &[("position", 0.12)]);
    }
}
