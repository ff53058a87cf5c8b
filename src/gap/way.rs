//! How far a belt has gone.

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
}

#[cfg(test)]
mod tests {
    use super::*;

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
