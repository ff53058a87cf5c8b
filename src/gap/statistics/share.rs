//! How well a share is known from what was counted.

/// The interval that holds a share with 95 %, `yes` of `n` having been seen, `n` > 0 (E. B. Wilson, J. Am. Stat. Assoc. 22, 1927).
pub fn wilson(yes: f64, n: f64) -> [f64; 2] {
    let z = 1.959_963_984_540_054;
    let p = yes / n;
    let centre = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + z * z / n;
    [((centre - half) / scale).max(0.0), ((centre + half) / scale).min(1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilsons_interval_is_the_one_of_the_books() {
        // 8 of 10: 0.4902 to 0.9433 (E. B. Wilson's formula, by hand).
        let [low, high] = wilson(8.0, 10.0);
        assert!((low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4, "{low} {high}");
        let [low, high] = wilson(0.0, 20.0);
        assert!(low == 0.0 && (high - 0.1611).abs() < 1e-4, "{high}");
    }
}
