//! `stuck`: a signal stands at one value, from the start or from an instant on.
//!
//! Source: the stuck-at fault (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2).

use super::table::{BASE, ONE, TIME, parameter};
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "stuck",
    summary: "a signal stands at one value",
    equation: "t ≥ from: y = value",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 5.2",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[
        parameter("value", ONE, (-1e9, 1e9), 0.0, 0.0, "where it stands, in the signal's SI unit; a BOOL at 0 or 1"),
        parameter("from", TIME, (0.0, 1e9), 0.0, 0.0, "from when on, after the start").or(0.0),
    ],
    acts_always: true,
    excited_by: "the signal being anything but that value",
    build: Build::Stage(|values, _| Box::new(Stuck { value: values[0], from: values[1], now: 0.0 })),
    ..BASE
};

#[derive(Clone, Debug)]
struct Stuck {
    value: f64,
    from: f64,
    now: f64,
}

impl Stage for Stuck {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn next_change(&self) -> Option<f64> {
        (self.now < self.from).then_some(self.from)
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        self.now = moment.now;
        if moment.now >= self.from { self.value } else { value }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_stands_from_its_instant_on() {
        let stuck = spec("report-link", "stuck", Some("position"), &[("value", 0.05), ("from", 2.0)]);
        let mut axis = with("ServoAxis", &[], &[stuck]);
        axis.check(&[("positionTarget", 0.1)], 1.9, &[("position", 0.1)]);
        axis.check(&[], 0.2, &[("position", 0.05), ("force", 0.0)]);
    }
}
