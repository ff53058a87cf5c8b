//! `stale-hold`: a signal is refreshed only every `time`, and stands in between.
//!
//! Source: the sampler with a zero-order hold (K. J. Åström, B. Wittenmark, Computer-Controlled Systems, Prentice Hall 1997,
//! section 2.3).

use super::table::{BASE, time};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "stale-hold",
    summary: "a signal is refreshed only now and then, and stands in between",
    equation: "y(t) = x(k·time), k·time ≤ t < (k + 1)·time",
    source: "Åström, Wittenmark, Computer-Controlled Systems, Prentice Hall 1997, 2.3",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[time("time", 0.1, "from one refresh to the next")],
    excited_by: "changes of the signal",
    build: Build::Stage(|values, _| Box::new(StaleHold { time: values[0], window: None, held: 0.0 })),
    ..BASE
};

/// What is refreshed more often, s, is so whenever it is looked at: at 10 m/s nothing goes 0.1 mm meanwhile, and a stop at each refresh
/// would have a second take forever.
const SHORTEST_S: f64 = 1e-5;

#[derive(Clone, Debug)]
struct StaleHold {
    time: f64,
    /// The window that the signal was refreshed in.
    window: Option<u64>,
    held: f64,
}

impl Stage for StaleHold {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn next_change(&self) -> Option<f64> {
        self.window.filter(|_| self.time >= SHORTEST_S).map(|window| (window + 1) as f64 * self.time)
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        if self.time == 0.0 {
            return value;
        }
        let window = ((moment.now + SAME_INSTANT_S) / self.time) as u64;
        if self.window != Some(window) {
            (self.window, self.held) = (Some(window), value);
        }
        self.held
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.held);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_stands_between_refreshes() {
        let hold = spec("report-link", "stale-hold", Some("velocityActual"), &[("time", 0.1)]);
        let mut belt = with("StraightConveyor", &[], &[hold]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 0.15, &[("velocityActual", 0.1)]);
        belt.check(&[], 0.0499, &[("velocityActual", 0.1)]);
        belt.check(&[], 0.0002, &[("velocityActual", 0.2)]);
    }

    /// One that would be refreshed a thousand million times in this second.
    #[test]
    fn refreshes_that_nobody_sees_take_no_time() {
        let hold = spec("report-link", "stale-hold", Some("velocityActual"), &[("time", 1e-9)]);
        let mut belt = with("StraightConveyor", &[], &[hold]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 0.15, &[("velocityActual", 0.15)]);
        belt.check(&[], 0.85, &[("velocityActual", 0.5)]);
    }
}
