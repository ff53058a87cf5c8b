//! How far a belt has gone, and what lies on it.

use crate::device::law::follower::{Slider, Stretch};

/// How far a belt has gone by when.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Way {
    /// Instants, s, ascending.
    pub instants: Vec<f64>,
    /// How far it has gone by each, m.
    pub metres: Vec<f64>,
}

impl Way {
    /// That of a speed, m/s, as it was reported at some instants; where they are further apart than a cycle, s, nothing changed until one before
    /// the next.
    pub fn of_reports(reported: &[f64], speeds: &[f64], cycle: f64) -> Way {
        let (mut instants, mut metres) = (Vec::with_capacity(reported.len()), Vec::with_capacity(reported.len()));
        let mut way = 0.0;
        instants.extend(reported.first());
        metres.extend(reported.first().map(|_| way));
        for (at, speed) in reported.windows(2).zip(speeds.windows(2)) {
            let mut rest = at[1] - at[0];
            if rest > 1.5 * cycle {
                way += speed[0] * (rest - cycle);
                rest = cycle;
                instants.push(at[1] - cycle);
                metres.push(way);
            }
            way += 0.5 * (speed[0] + speed[1]) * rest;
            instants.push(at[1]);
            metres.push(way);
        }
        Way { instants, metres }
    }

    /// How far what lies on it has gone where friction gives that at most `grip`, m/s²; what is `put` there at some instants, s, ascending,
    /// takes the belt's speed, and is what is followed from then on.
    pub fn of_parts(&self, grip: f64, put: &[f64]) -> Way {
        let speed_between = |from: usize, to: usize| {
            let span = (self.instants[to] - self.instants[from]).max(1e-9);
            (self.metres[to] - self.metres[from]) / span
        };
        let last = self.instants.len().saturating_sub(1);
        let speed_at = |index: usize| speed_between(index.saturating_sub(1), (index + 1).min(last));
        let (mut slider, mut put) = (Slider::default(), put.iter().peekable());
        let mut gone = self.metres.first().copied().unwrap_or_default();
        let mut metres: Vec<f64> = self.metres.first().copied().into_iter().collect();
        for next in 1..self.instants.len() {
            let (from, to) = (self.instants[next - 1], self.instants[next]);
            while put.next_if(|at| **at <= from).is_some() {
                slider = Slider::default();
            }
            let way = self.metres[next] - self.metres[next - 1];
            gone += slider.ride(grip, &Stretch { way, speeds: [speed_at(next - 1), speed_at(next)], span: to - from });
            metres.push(gone);
        }
        Way { instants: self.instants.clone(), metres }
    }

    /// How far it has gone by an instant, m: straight between two instants, and before and behind them all as at the nearest.
    pub fn at(&self, instant: f64) -> f64 {
        let (Some(&first), Some(&last)) = (self.metres.first(), self.metres.last()) else { return 0.0 };
        let after = self.instants.partition_point(|at| *at <= instant);
        if after == 0 || after == self.instants.len() {
            return if after == 0 { first } else { last };
        }
        let (from, to) = (self.instants[after - 1], self.instants[after]);
        let share = (instant - from) / (to - from).max(1e-12);
        self.metres[after - 1] + share * (self.metres[after] - self.metres[after - 1])
    }

    /// The last instant before `at` at which it still had so much further to go, m; less than 0: so much further back.
    pub fn before(&self, at: f64, metres: f64) -> Option<f64> {
        let (goal, sign) = (self.at(at) - metres, metres.signum());
        let mut after = (at, self.at(at));
        let behind = self.instants.partition_point(|instant| *instant < at);
        for place in (0..behind).rev() {
            let now = (self.instants[place], self.metres[place]);
            if sign * (now.1 - goal) <= 0.0 {
                let share = (goal - now.1) / (after.1 - now.1);
                return Some(now.0 + share * (after.0 - now.0));
            }
            after = now;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On at 0.5 m/s until 2 s, back until 3 s, and on again: at 4 s it is where it was at 2 s, 0.25 m before that at 3.5 s, and 0.75 m before it at 0.5 s; it was
    /// never more than a metre behind.
    #[test]
    fn it_is_known_when_a_belt_was_so_far_behind() {
        let way = Way { instants: vec![0.0, 2.0, 3.0, 5.0], metres: vec![0.0, 1.0, 0.5, 1.5] };
        let before = |at: f64, metres: f64| way.before(at, metres).map(|at| (1e9 * at).round() / 1e9);
        assert_eq!([0.25, 0.75, 1.1].map(|metres| before(4.0, metres)), [Some(3.5), Some(0.5), None]);
        assert_eq!([-0.25, -0.5].map(|metres| before(3.0, metres)), [Some(2.5), Some(2.0)]);
    }

    /// 0.5 m/s from 1 s on; what lay there loses half of 0.5 m/s times 2 s on the way, what was put there at 3 s no more than it has lost by then.
    #[test]
    fn what_lies_on_a_belt_that_starts_too_fast_stays_behind() {
        let instants: Vec<f64> = (0..=500).map(|k| 0.01 * f64::from(k)).collect();
        let metres = instants.iter().map(|at| 0.5 * (at - 1.0).max(0.0)).collect();
        let belt = Way { instants, metres };
        let behind = |grip: f64, put: &[f64]| belt.at(5.0) - belt.of_parts(grip, put).at(5.0);
        assert!((behind(0.25, &[]) - 0.5).abs() < 0.01, "{}", behind(0.25, &[]));
        assert!((behind(0.25, &[2.0]) - 0.375).abs() < 0.01, "{}", behind(0.25, &[2.0]));
        assert_eq!(behind(f64::INFINITY, &[]), 0.0);
    }

    /// A speed of which only changes are told stands in between: 0.5 m/s for 1.9 s, and down to nothing within the last cycle.
    #[test]
    fn a_speed_that_is_told_when_it_changes_stands_in_between() {
        let way = Way::of_reports(&[1.0, 3.0, 3.1], &[0.5, 0.0, 0.0], 0.1);
        let check = |at: f64, metres: f64| assert!((way.at(at) - metres).abs() < 1e-12, "{at}: {}", way.at(at));
        check(2.0, 0.5);
        check(2.9, 0.95);
        check(3.0, 0.975);
        check(9.0, 0.975);
    }

    #[test]
    fn a_speed_that_is_told_in_every_cycle_goes_straight_from_one_to_the_next() {
        let way = Way::of_reports(&[0.0, 0.1, 0.2], &[0.0, 0.4, 0.4], 0.1);
        assert!((way.at(0.2) - 0.06).abs() < 1e-12 && way.instants.len() == 3, "{way:?}");
    }
}
