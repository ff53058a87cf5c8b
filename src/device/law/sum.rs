//! A running total that does not lose what single additions round away.

/// The total of many small increments, with the rounding error of each kept beside it (two-sum: D. E. Knuth, The Art of
/// Computer Programming, vol. 2, 4.2.2, theorem B). A position summed over an hour of 1 ms steps stays exact to the
/// last bit of its value, so that an encoder at a whole count does not depend on the step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    total: f64,
    error: f64,
}

impl Sum {
    /// Adds `increment`.
    pub fn add(&mut self, increment: f64) {
        let total = self.total + increment;
        let taken = total - self.total;
        self.error += (self.total - (total - taken)) + (increment - taken);
        self.total = total;
    }

    /// The total, rounded once.
    pub fn value(&self) -> f64 {
        self.total + self.error
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.total);
        visit(self.error);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_milliseconds_are_a_thousand_seconds() {
        let (mut sum, mut plain) = (Sum::default(), 0.0);
        for _ in 0..1_000_000 {
            sum.add(0.001);
            plain += 0.001;
        }
        assert!(plain != 1000.0, "the plain sum shows what is guarded against");
        assert!((sum.value() - 1000.0).abs() < 1e-12, "{}", sum.value());
    }

    #[test]
    fn there_and_back_is_where_it_was() {
        let mut sum = Sum::default();
        for k in 0..1000 {
            sum.add(f64::from(k) * 0.1);
        }
        for k in (0..1000).rev() {
            sum.add(f64::from(k) * -0.1);
        }
        assert_eq!(sum.value(), 0.0);
    }
}
