//! Reports that bring something new, or fail to: each by itself, as chance has it.

/// By how many standard deviations two shares of what is late or lost may differ.
pub(super) const ALIKE: f64 = 2.5;

/// Reports that should have brought something new.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tries {
    made: usize,
    /// How many of them did not.
    failed: usize,
}

impl Tries {
    pub fn made(&self) -> usize {
        self.made
    }

    pub fn failed(&self) -> usize {
        self.failed
    }

    pub fn count(&mut self, is_failed: bool) {
        self.made += 1;
        self.failed += usize::from(is_failed);
    }

    /// Whether as many of them failed as of others, as far as chance lets them: what fails once and never again comes late.
    pub fn is_like(&self, other: &Tries) -> bool {
        let [own, others] = [self, other].map(|tries| tries.made.max(1) as f64);
        let share = (self.failed + other.failed) as f64 / (own + others);
        let deviation = (share * (1.0 - share) * (1.0 / own + 1.0 / others)).sqrt();
        (self.failed as f64 / own - other.failed as f64 / others).abs() <= ALIKE * deviation.max(1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_once_and_never_again_is_not_lost() {
        let tries = |made, failed| Tries { made, failed };
        assert!(tries(80, 32).is_like(&tries(32, 12)));
        assert!(!tries(80, 32).is_like(&tries(32, 0)));
        assert!(!tries(80, 75).is_like(&tries(120, 45)));
        assert!(tries(80, 0).is_like(&tries(0, 0)));
    }
}
