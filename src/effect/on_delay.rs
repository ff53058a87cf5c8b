//! `on-delay`: a switch reports late that it is on: only after it has been for `time`.
//!
//! Source: the timer TON of IEC 61131-3:2013, 6.6.3.5.5, on what the sensor sees.

use super::table::{BASE, time};
use super::timer::{Late, Timer};
use crate::device::path::{Moment, STEPS_STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "on-delay",
    summary: "a switch reports late that it is on",
    equation: "y = x has been true since t − time",
    source: "IEC 61131-3:2013, 6.6.3.5.5 (TON)",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Boolean)],
    parameters: &[time("time", 0.05, "how much later")],
    excited_by: "rising edges of the signal",
    build: Build::Stage(|values, _| Box::new(OnDelay { timer: Timer::new(values[0], Late::On, None) })),
    ..BASE
};

#[derive(Clone, Debug)]
struct OnDelay {
    timer: Timer,
}

impl Stage for OnDelay {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        STEPS_STRETCH_S
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        f64::from(u8::from(self.timer.pass(value != 0.0, moment.now)))
    }

    fn next_change(&self) -> Option<f64> {
        self.timer.next()
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.timer.state(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn one_edge_is_late_and_the_other_is_not() {
        let late = spec("sensor", "on-delay", Some("lightBarrierB"), &[("time", 0.05)]);
        let mut belt = with("StraightConveyor", &[], &[late]);
        belt.check(&[], 0.1, &[("lightBarrierB", 0.0)]);
        belt.cut(true, true);
        belt.check(&[], 0.0499, &[("lightBarrierA", 1.0), ("lightBarrierB", 0.0)]);
        belt.check(&[], 0.0001, &[("lightBarrierB", 1.0)]);
        belt.cut(false, false);
        belt.check(&[], 0.0, &[("lightBarrierB", 0.0)]);
    }
}
