//! How much neighbours know of each other: residuals that are correlated are fewer than they look.

/// The correlation of each value with the next; 0 where nothing varies.
pub fn lag_one(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let variance: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let products: f64 = values.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum();
    if variance > 0.0 { products / variance } else { 0.0 }
}

/// How many times too large a gain in deviance is that ignores a correlation `lag_one` of the residuals: (1 + r)/(1 − r), from 0.2
/// on (below, chance is as large); at least 1.
///
/// Source: G. V. Bayley, J. M. Hammersley, The effective number of independent observations in an autocorrelated time series, J. R.
/// Stat. Soc. Suppl. 8 (1946), for a process of first order.
pub fn inflation(lag_one: f64) -> f64 {
    if lag_one > 0.2 { (1.0 + lag_one.min(0.999)) / (1.0 - lag_one.min(0.999)) } else { 1.0 }
}

/// How many independent values are worth as much as these.
pub fn effective_number(values: &[f64]) -> f64 {
    values.len() as f64 / inflation(lag_one(values))
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};

    use super::*;

    /// A process of first order.
    fn process(correlation: f64, count: usize) -> Vec<f64> {
        let mut dice = rand_chacha::ChaCha8Rng::seed_from_u64(4);
        let mut value = 0.0;
        let step = |value: &mut f64| {
            *value = correlation * *value + dice.random::<f64>() - 0.5;
            Some(*value)
        };
        let mut step = step;
        std::iter::from_fn(|| step(&mut value)).take(count).collect()
    }

    #[test]
    fn the_correlation_of_a_known_process_is_found() {
        for correlation in [0.0, 0.5, 0.95] {
            let found = lag_one(&process(correlation, 20_000));
            assert!((found - correlation).abs() < 0.02, "{found} {correlation}");
        }
        assert_eq!(lag_one(&[1.0; 9]), 0.0);
    }

    #[test]
    fn correlated_samples_are_fewer() {
        let number = effective_number(&process(0.95, 20_000));
        assert!((number / 20_000.0 * 39.0 - 1.0).abs() < 0.2, "{number}");
        assert_eq!(inflation(0.1), 1.0);
    }
}
