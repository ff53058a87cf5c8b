//! How much a candidate must gain to be more than chance, the best of many candidates being looked at.

/// Two models are one class when their outputs lie no further apart than this, whitened and squared: a test of 1 % error (both
/// sides) would tell them apart with less than 95 % power: (2.576 + 1.645)².
pub const SAME_CLASS: f64 = 17.8;

/// The candidates for which [`least_gain`]'s constant holds.
const USUAL: f64 = 400.0;

/// The least gain in deviance that the best of `candidates` must have to be believed, with `parameters` more than what it is
/// compared with: 18 for one parameter among 400 candidates (the 1 % point of the maximum of as many χ² of one degree is 17.8), 4
/// more for each further parameter, and 2·ln for more candidates, as χ²'s tail falls.
pub fn least_gain(parameters: usize, candidates: usize) -> f64 {
    let further = parameters.saturating_sub(1) as f64;
    18.0 + 4.0 * further + 2.0 * (candidates as f64 / USUAL).max(1.0).ln()
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};

    use super::*;

    /// The largest of 400 χ² of one degree reaches the threshold in about 1 % of the trials.
    #[test]
    fn chance_reaches_it_once_in_a_hundred() {
        let mut dice = rand_chacha::ChaCha8Rng::seed_from_u64(11);
        let mut chi = || {
            let (u, v): (f64, f64) = (dice.random(), dice.random());
            -2.0 * (1.0 - u).ln() * (std::f64::consts::TAU * v).cos().powi(2)
        };
        let reached = (0..2000).filter(|_| (0..400).any(|_| chi() > least_gain(1, 400))).count();
        assert!((5..=35).contains(&reached), "{reached}");
        assert!(least_gain(2, 400) == 22.0 && least_gain(1, 4000) > 22.0);
    }
}
