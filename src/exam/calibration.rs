//! Whether the weights mean what they say: how often an answer is right beside how much it weighs.

use serde::{Deserialize, Serialize};

use super::rates::Rate;

/// Bins of equal width.
const BINS: usize = 10;

/// The answers of about one weight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bin {
    /// From this weight to that one.
    pub weights: [f64; 2],
    /// Their mean weight.
    pub weight: f64,
    /// How many of them are right.
    pub right: Rate,
}

/// The calibration curve of weights and whether what weighs so is right: the bins that hold any.
pub fn curve(answers: impl Iterator<Item = (f64, bool)>) -> Vec<Bin> {
    let mut bins: Vec<Vec<(f64, bool)>> = vec![Vec::new(); BINS];
    for (weight, is_right) in answers {
        bins[((weight * BINS as f64) as usize).min(BINS - 1)].push((weight, is_right));
    }
    let edge = |at: usize| at as f64 / BINS as f64;
    let held = bins.into_iter().enumerate().filter(|(_, all)| !all.is_empty());
    held.map(|(at, all)| Bin {
        weights: [edge(at), edge(at + 1)],
        weight: all.iter().map(|(weight, _)| weight).sum::<f64>() / all.len() as f64,
        right: Rate::share(all.iter().map(|(_, is_right)| *is_right)),
    })
    .collect()
}

/// The calibration error: the root of the mean squared distance between weight and share of right answers, less what chance adds to it
/// (A. Kumar, P. Liang, T. Ma, Verified Uncertainty Calibration, NeurIPS 2019, section 5). It is no share and has no interval of Wilson's: by the
/// delta method a squared distance d² of a share that is known to a variance v has the variance 4 d² v + 2 v², v being that of Laplace's share, as all of a
/// bin being right does not make it certain.
pub fn error(curve: &[Bin]) -> Rate {
    let n: usize = curve.iter().map(|bin| bin.right.n).sum();
    if n == 0 {
        return Rate::default();
    }
    let (mut squared, mut variance) = (0.0, 0.0);
    for Bin { weight, right, .. } in curve.iter().filter(|bin| bin.right.n > 1) {
        let (part, share) = (right.n as f64 / n as f64, right.value.unwrap_or_default());
        let apart = (weight - share).powi(2);
        let chance = share * (1.0 - share) / (right.n - 1) as f64;
        let all = right.n as f64;
        let laplace = (share * all + 1.0) / (all + 2.0);
        let known = laplace * (1.0 - laplace) / all;
        squared += part * (apart - chance);
        variance += part * part * (4.0 * apart * known + 2.0 * known * known);
    }
    let root = |squared: f64| squared.max(0.0).sqrt();
    let half = 1.96 * variance.sqrt();
    Rate { value: Some(root(squared)), n, ci95: Some([root(squared - half), root(squared + half)]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `n` answers of a weight, of which `right` are right.
    fn answers(weight: f64, right: usize, n: usize) -> impl Iterator<Item = (f64, bool)> {
        (0..n).map(move |k| (weight, k < right))
    }

    #[test]
    fn a_curve_holds_the_bins_that_have_answers() {
        let curve = curve(answers(0.95, 9, 10).chain(answers(1.0, 10, 10)).chain(answers(0.2, 1, 4)));
        let told: Vec<_> = curve.iter().map(|bin| (bin.weights, bin.weight, bin.right.value, bin.right.n)).collect();
        assert_eq!(told, [([0.2, 0.3], 0.2, Some(0.25), 4), ([0.9, 1.0], 0.975, Some(0.95), 20)]);
    }

    #[test]
    fn weights_that_mean_what_they_say_have_no_error() {
        // 80 of 100 at 0.8: chance alone would make more of a distance than there is.
        assert_eq!(error(&curve(answers(0.8, 80, 100))).value, Some(0.0));
        assert_eq!(error(&curve(std::iter::empty())), Rate::default());
        // 60 of 100 at 0.8: (0.2² − 0.24 / 99)^½ = 0.19384, its square known to ± 0.03901.
        let rate = error(&curve(answers(0.8, 60, 100)));
        let [low, high] = rate.ci95.expect("an interval");
        let near = |value: f64, expected: f64| (value - expected).abs() < 1e-4;
        assert!(near(rate.value.expect("an error"), 0.193_84) && near(low, 0.0) && near(high, 0.276_75), "{rate:?}");
    }
}
