//! What a residual depends on: shares explained in bins, and ranks.

use super::blocks::quantile;

/// Which share of the variance of `values` the means over `bins` bins of `by` explain: R² of a regression on the bins, which hold
/// equally many values each. What chance explains is taken off (the adjusted R²), `each_counts` being how much of an
/// independent observation every value is. 0 where nothing varies.
pub fn binned_share(values: &[f64], by: &[f64], bins: usize, each_counts: f64) -> f64 {
    let count = values.len() as f64;
    let ends: Vec<f64> = (1..bins).map(|bin| quantile(by, bin as f64 / bins as f64)).collect();
    let mut sums = vec![(0.0, 0.0); bins];
    for (value, by) in values.iter().zip(by) {
        let bin = ends.partition_point(|end| end < by);
        sums[bin].0 += value;
        sums[bin].1 += 1.0;
    }
    let mean = values.iter().sum::<f64>() / count.max(1.0);
    let total: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let filled = sums.iter().filter(|(_, count)| *count > 0.0);
    let between: f64 = filled.clone().map(|(sum, count)| count * (sum / count - mean).powi(2)).sum();
    let used = filled.count() as f64;
    let independent = count * each_counts;
    if total <= 0.0 || independent <= used + 1.0 {
        return 0.0;
    }
    (1.0 - (1.0 - between / total) * (independent - 1.0) / (independent - used)).max(0.0)
}

/// How far one is monotone in the other, from −1 to 1: Spearman's correlation of ranks; 0 where one does not vary.
pub fn rank_correlation(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (ranks(a), ranks(b));
    let mean = (a.len() as f64 - 1.0) / 2.0;
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>();
    let both = (product(&a, &a) * product(&b, &b)).sqrt();
    if both > 0.0 { product(&a, &b) / both } else { 0.0 }
}

/// Each value's place in their order; equal values share the middle of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let below = |value: f64| values.iter().filter(|other| **other < value).count() as f64;
    let equal = |value: f64| values.iter().filter(|other| **other == value).count() as f64;
    values.iter().map(|value| below(*value) + (equal(*value) - 1.0) / 2.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_depends_on_the_regressor_is_explained() {
        let by: Vec<f64> = (0..1300).map(f64::from).collect();
        let values: Vec<f64> =
            by.iter().map(|t| t / 1300.0 + if (*t as u32).is_multiple_of(2) { 0.1 } else { -0.1 }).collect();
        let share = binned_share(&values, &by, 13, 1.0);
        // The variance of the ramp is 1/12, of the alternation 1/100; within a bin a 169th of the ramp's is left.
        let expect = 1.0 - (0.01 + 1.0 / 12.0 / 169.0) / (0.01 + 1.0 / 12.0);
        assert!((share - expect).abs() < 0.01, "{share} {expect}");
    }

    #[test]
    fn what_does_not_is_not() {
        let by: Vec<f64> = (0..1300).map(f64::from).collect();
        let values: Vec<f64> = by.iter().map(|t| (t * 7.77).sin()).collect();
        assert!(binned_share(&values, &by, 13, 1.0) < 0.02);
        assert_eq!(binned_share(&[1.0; 50], &by[..50], 13, 1.0), 0.0);
    }

    #[test]
    fn ranks_see_what_is_monotone() {
        let a = [1.0, 2.0, 3.0, 4.0, 5.0];
        assert_eq!(rank_correlation(&a, &[1.0, 8.0, 27.0, 64.0, 125.0]), 1.0);
        assert_eq!(rank_correlation(&a, &[5.0, 4.0, 3.0, 2.0, 1.0]), -1.0);
        assert_eq!(rank_correlation(&a, &[2.0; 5]), 0.0);
    }
}
