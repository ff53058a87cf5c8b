//! What a difference between a recording and a prediction costs: −2 ln of a likelihood that knows of rounding.
//!
//! A report is rounded to a step `q`; its noise is often far below that. So what was recorded says no more than that the
//! true value lay in an interval, and the likelihood is that of the interval, for levels and for edges alike. With squared
//! errors and q²/12 as a variance an encoder at rest would give the same rounding error thousands of times, and "find" a
//! scale error of 5·10⁻⁷.

use std::f64::consts::SQRT_2;

/// How likely it is that an edge has nothing to do with its prediction.
pub const STRAY: f64 = 0.005;
/// Over how long a stray edge is spread, s.
pub const STRAY_SPAN_S: f64 = 20.0;

/// What an edge costs that only one side has: −2 ln([`STRAY`] / [`STRAY_SPAN_S`]).
pub fn unmatched() -> f64 {
    -2.0 * (STRAY / STRAY_SPAN_S).ln()
}

/// The distribution of Student's t with four degrees of freedom: F(t) = 1/2 + 3/8·u·(1 − u²/12), u = t/√(1 + t²/4).
pub fn student(t: f64) -> f64 {
    let u = t / (1.0 + t * t / 4.0).sqrt();
    0.5 + 0.375 * u * (1.0 - u * u / 12.0)
}

/// Its probability below −`x`, `x` at or above 0, without subtraction from one: with c = x/√(4 + x²) it is (1 − c)²·(2 + c)/4.
fn tail(x: f64) -> f64 {
    let c = x / (4.0 + x * x).sqrt();
    let rest = 4.0 / ((4.0 + x * x) * (1.0 + c));
    0.25 * rest * rest * (2.0 + c)
}

/// Its probability between `low` and `high`.
fn student_between(low: f64, high: f64) -> f64 {
    match (low > 0.0, high < 0.0) {
        (true, _) => tail(low) - tail(high),
        (_, true) => tail(-high) - tail(-low),
        _ => student(high) - student(low),
    }
}

/// The cost of having recorded `recorded` where `predicted` was to be seen: 0 where they are one, never below. `step` is what
/// the record is rounded to, `sigma` the noise before that (standard deviation, above 0).
pub fn level(recorded: f64, predicted: f64, step: f64, sigma: f64) -> f64 {
    let off = (recorded - predicted).abs();
    let half = 0.5 * step;
    let there = student_between((off - half) / sigma, (off + half) / sigma);
    let best = 2.0 * (student(half / sigma) - 0.5);
    (-2.0 * (there / best).ln()).max(0.0)
}

/// The normal distribution.
pub fn normal(z: f64) -> f64 {
    0.5 * erfc(-z / SQRT_2)
}

/// The complementary error function, to 1.2·10⁻⁷ (W. H. Press et al., Numerical Recipes, 3rd ed., section 6.2.2).
fn erfc(x: f64) -> f64 {
    let z = x.abs();
    let t = 2.0 / (2.0 + z);
    let poly = [
        -1.26551223,
        1.00002368,
        0.37409196,
        0.09678418,
        -0.18628806,
        0.27886807,
        -1.13520398,
        1.48851587,
        -0.82215223,
        0.17087277,
    ];
    let sum = poly.iter().rev().fold(0.0, |sum, factor| sum * t + factor);
    let tail = t * (-z * z + sum).exp();
    if x >= 0.0 { tail } else { 2.0 - tail }
}

/// The cost of an edge that was first seen at `seen`, not yet at `before`, where it was predicted at `predicted`; `sigma` is
/// how far a sensor may be off in time. All s.
pub fn edge(before: f64, seen: f64, predicted: f64, sigma: f64) -> f64 {
    let within = normal((seen - predicted) / sigma) - normal((before - predicted) / sigma);
    -2.0 * ((1.0 - STRAY) * within.max(0.0) + STRAY / STRAY_SPAN_S).min(1.0).ln()
}

/// A cost as a residual of least squares: its square is the cost, its sign that of the difference.
pub fn residual(cost: f64, difference: f64) -> f64 {
    cost.max(0.0).sqrt().copysign(difference)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_distribution_is_the_tables() {
        // Abramowitz and Stegun, table 26.10: t for 4 degrees of freedom at 0.95 and 0.995.
        assert!((student(2.132) - 0.95).abs() < 1e-4);
        assert!((student(4.604) - 0.995).abs() < 1e-4);
        assert_eq!(student(0.0), 0.5);
    }

    #[test]
    fn the_normal_distribution_is_the_tables() {
        assert!((normal(1.96) - 0.975).abs() < 1e-4 && (normal(-1.0) - 0.158_655).abs() < 1e-6);
        assert!(normal(8.0) <= 1.0 && normal(-8.0) < 1e-14);
    }

    #[test]
    fn rounding_costs_next_to_nothing_and_a_step_much() {
        let cost = |off: f64| level(off, 0.0, 1.0, 0.2);
        assert_eq!(cost(0.0), 0.0);
        assert!(cost(0.3) < 0.5 && cost(0.5) > 1.0 && cost(1.0) > 5.0, "{} {} {}", cost(0.3), cost(0.5), cost(1.0));
        // It grows without end and without a jump where the tail begins.
        let far: Vec<f64> = (1..400).map(|k| cost(0.01 * f64::from(k) + 1.0)).collect();
        assert!(far.windows(2).all(|pair| pair[1] > pair[0] && pair[1] - pair[0] < 0.5));
        assert_eq!(cost(2.5), level(-2.5, 0.0, 1.0, 0.2));
    }

    #[test]
    fn an_edge_is_known_to_lie_in_its_cycle() {
        let cost = |at: f64| edge(1.00, 1.02, at, 3e-4);
        assert!(cost(1.01) < 0.02 && cost(1.002) < 0.02 && cost(1.021) > 10.0 && cost(0.5) > 16.0);
        assert!((cost(9.0) - unmatched()).abs() < 1e-9 && (unmatched() - 16.6).abs() < 0.05);
    }
}
