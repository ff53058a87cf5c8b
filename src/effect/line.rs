//! Signals on their way, for the effects that make them late.

use std::collections::VecDeque;

use crate::device::law::SAME_INSTANT_S;
use crate::device::law::encoder::SAME_COUNT;

/// Values that each arrive at an instant of their own, in the order they were sent.
#[derive(Clone, Debug, Default)]
pub(super) struct Mail {
    /// What was sent and has not arrived: when it will, and its value.
    under_way: VecDeque<(f64, f64)>,
    sent: Option<f64>,
    arrived: Option<f64>,
}

impl Mail {
    /// Whether `value` is news. What stands there at the very start has arrived.
    pub fn is_new(&mut self, value: f64) -> bool {
        self.arrived.get_or_insert(value);
        self.sent.replace(value).is_some_and(|before| before != value)
    }

    /// Sends `value`, to arrive at `due`, or when what was sent before arrives if that is later.
    pub fn send(&mut self, value: f64, due: f64) {
        let due = self.under_way.back().map_or(due, |(before, _)| due.max(*before));
        self.under_way.push_back((due, value));
    }

    /// What has arrived last.
    pub fn arrived(&mut self, now: f64) -> f64 {
        while let Some((_, value)) = self.under_way.pop_front_if(|(due, _)| *due <= now + SAME_INSTANT_S) {
            self.arrived = Some(value);
        }
        self.arrived.unwrap_or(0.0)
    }

    /// When the next arrives.
    pub fn next(&self) -> Option<f64> {
        self.under_way.front().map(|(due, _)| *due)
    }

    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        for (due, value) in &self.under_way {
            visit(*due);
            visit(*value);
        }
        self.sent.into_iter().chain(self.arrived).for_each(visit);
    }
}

/// What a signal was at past instants: on straight lines between samples where it is smooth, else as it stood.
#[derive(Clone, Debug)]
pub(super) struct History {
    samples: VecDeque<(f64, f64)>,
    is_smooth: bool,
    /// A count: what lies between two samples is rounded down as a counter would.
    is_whole: bool,
}

impl History {
    pub fn new(is_smooth: bool, is_whole: bool) -> History {
        History { samples: VecDeque::new(), is_smooth, is_whole }
    }

    /// What lies between two samples of a count is no longer rounded.
    pub fn count_finely(&mut self) {
        self.is_whole = false;
    }

    /// The signal is `value` now.
    pub fn note(&mut self, now: f64, value: f64) {
        match self.samples.back() {
            Some((_, last)) if !self.is_smooth && *last == value => {}
            Some((at, last)) if *at == now && *last == value => {}
            _ => self.samples.push_back((now, value)),
        }
    }

    /// What it was at `instant`; what it was at first where that lies before all samples. Samples that are of no use for
    /// any instant after `oldest` are forgotten.
    pub fn at(&mut self, instant: f64, oldest: f64) -> f64 {
        while self.samples.len() > 1 && self.samples[1].0 <= oldest {
            self.samples.pop_front();
        }
        let after = self.samples.partition_point(|(at, _)| *at <= instant + SAME_INSTANT_S);
        let (Some(&before), next) = (self.samples.get(after.saturating_sub(1)), self.samples.get(after)) else {
            return 0.0;
        };
        let value = match next {
            Some(next) if self.is_smooth && after > 0 => {
                before.1 + (next.1 - before.1) * ((instant - before.0) / (next.0 - before.0)).clamp(0.0, 1.0)
            }
            _ => before.1,
        };
        if self.is_whole { (value + SAME_COUNT).floor() } else { value }
    }

    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        for (at, value) in &self.samples {
            visit(*at);
            visit(*value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mail_arrives_when_due_and_in_order() {
        let mut mail = Mail::default();
        assert!(!mail.is_new(0.0));
        assert!(mail.is_new(5.0) && !mail.is_new(5.0));
        mail.send(5.0, 1.0);
        mail.send(7.0, 0.5);
        assert_eq!((mail.arrived(0.9), mail.next()), (0.0, Some(1.0)));
        assert_eq!(mail.arrived(1.0), 7.0);
    }

    #[test]
    fn a_smooth_signal_is_looked_up_between_its_samples() {
        let mut ramp = History::new(true, false);
        let mut stairs = History::new(false, false);
        let mut count = History::new(true, true);
        for k in 0..10 {
            ramp.note(f64::from(k), f64::from(2 * k));
            stairs.note(f64::from(k), f64::from(2 * k));
            count.note(f64::from(k), f64::from(2 * k));
        }
        assert_eq!((ramp.at(3.25, 3.0), stairs.at(3.25, 3.0), count.at(3.75, 3.0)), (6.5, 6.0, 7.0));
        assert_eq!((ramp.at(-1.0, -1.0), ramp.at(99.0, 3.0)), (6.0, 18.0));
    }
}
