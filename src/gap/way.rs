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
