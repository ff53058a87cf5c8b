//! `offset`: a sensor reads so much too much, its homing included: y = x + offset, in the signal's own unit.
//!
//! Source: the additive fault of a sensor (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2).

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "offset",
    summary: "a sensor reads so much too much, its homing included",
    equation: "y = x + offset",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 5.2",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Number)],
    parameters: &[parameter(
        "offset",
        ONE,
        (-1e9, 1e9),
        0.0,
        0.005,
        "how much, in the signal's SI unit; counts of an encoder",
    )],
    excited_by: "any reading",
    build: Build::Stage(|values, site| {
        Box::new(Offset { offset: if site.is_whole() { values[0].round() } else { values[0] } })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Offset {
    offset: f64,
}

impl Stage for Offset {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn signal(&mut self, value: f64, _moment: Moment) -> f64 {
        value + self.offset
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_position_is_read_too_high_and_nothing_else_is() {
        let offset = spec("sensor", "offset", None, &[("offset", 0.003)]);
        let mut axis = with("ServoAxis", &[], &[offset]);
        axis.check(&[("positionTarget", 0.1)], 5.0, &[("position", 0.103), ("velocity", 0.0), ("force", 0.0)]);
    }
}
