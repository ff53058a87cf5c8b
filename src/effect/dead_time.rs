//! `dead-time`: a signal arrives later by a constant time: y(t) = x(t − time).
//!
//! Source: the transport delay of linear control theory, e^(−s·time) (K. J. Åström, T. Hägglund, Advanced PID Control,
//! ISA 2006, section 2.5). Before the first input the signal holds what it held at the start.

use std::collections::VecDeque;

use crate::device::path::{Moment, Stage};
use crate::effect::{EffectDescriptor, EffectParameter, Fit, SignalClass};
use crate::plant::EffectPlace;
use crate::value::Quantity;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "dead-time",
    summary: "a signal arrives later by a constant time",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[EffectParameter {
        name: "time",
        quantities: &[Quantity::Time],
        range: (0.0, 10.0),
        nominal: 0.0,
        typical: 0.05,
        summary: "how much later",
    }],
    excited_by: "changes of the signal",
    build: |values| Box::new(DeadTime::new(values[0])),
};

/// A signal on its way.
#[derive(Clone, Debug)]
struct DeadTime {
    time: f64,
    /// What went in and has not come out: when it will, and its value.
    under_way: VecDeque<(f64, f64)>,
    exit: Option<f64>,
    entry: Option<f64>,
}

impl DeadTime {
    fn new(time: f64) -> DeadTime {
        DeadTime { time, under_way: VecDeque::new(), exit: None, entry: None }
    }
}

impl Stage for DeadTime {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        if self.entry != Some(value) {
            self.under_way.push_back((moment.now + self.time, value));
            self.entry = Some(value);
        }
        let exit = self.exit.get_or_insert(value);
        // Half a nanosecond: an instant computed in two ways is still one instant.
        while let Some((_, arrived)) = self.under_way.pop_front_if(|(due, _)| *due <= moment.now + 0.5e-9) {
            *exit = arrived;
        }
        *exit
    }

    fn next_change(&self) -> Option<f64> {
        self.under_way.front().map(|(due, _)| *due)
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        for (due, value) in &self.under_way {
            visit(*due);
            visit(*value);
        }
        self.exit.into_iter().for_each(visit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_in_comes_out_later_and_in_order() {
        let mut link = DeadTime::new(0.25);
        let mut check = |now: f64, value: f64, exit: f64| {
            assert_eq!(link.signal(value, Moment { now, span: 0.0 }), exit, "at {now}");
        };
        check(0.0, 0.0, 0.0);
        check(1.0, 5.0, 0.0);
        check(1.1, 7.0, 0.0);
        check(1.2499, 7.0, 0.0);
        check(1.25, 7.0, 5.0);
        check(1.35, 7.0, 7.0);
        check(9.0, 7.0, 7.0);
    }

    #[test]
    fn it_says_when_it_will_change() {
        let mut link = DeadTime::new(0.25);
        link.signal(0.0, Moment::default());
        link.signal(1.0, Moment { now: 2.0, span: 0.0 });
        link.signal(1.0, Moment { now: 2.1, span: 0.1 });
        assert_eq!(link.next_change(), Some(2.25));
    }
}
