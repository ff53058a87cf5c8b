//! Motions as power series in time, and the first instant at which one crosses a level.
//!
//! A motion whose equation is linear, or a pendulum's, is computed by its Taylor series: each coefficient follows from
//! the ones before. Within the step that [`ORDER`] allows, the series is the exact solution but for rounding, and
//! events are found on the motion itself instead of between samples of it. (A. Jorba, M. Zou, A software package for the
//! numerical integration of ODEs by means of high-order Taylor methods, Experimental Mathematics 14, 2005.)

/// How many intervals a step is looked at in for crossings, turning points in each included: within a step the motions
/// here turn two or three times at most.
const INTERVALS: u32 = 8;

/// A power series in time, in seconds from the start of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series<const COUNT: usize = { ORDER + 1 }> {
    /// By power.
    pub coefficients: [f64; COUNT],
    /// The highest power in use, at least 1 and below `COUNT`.
    pub order: usize,
}

/// The highest power of all. With a step of 2 / ρ, where ρ bounds the motion's rates, the first neglected term is below
/// 2²¹ / 21! = 4·10⁻¹⁴ of the motion.
pub const ORDER: usize = 20;

/// The highest power that a step needs: `reach` is its length times a bound of the motion's rates. Where [`ORDER`] allows,
/// reachⁿ / n! is below 10⁻¹⁷; three powers more hold what enters from outside, which no rate bounds: a constant force
/// moves the position with the square of the time, its integral with the cube.
pub fn order_for(reach: f64) -> usize {
    let mut term = reach;
    let mut order = 1;
    while order < ORDER - 3 && term > 1e-17 {
        order += 1;
        term *= reach * RECIPROCALS[order];
    }
    order + 3
}

/// 1 / n; that of 0 is never used.
pub const RECIPROCALS: [f64; ORDER + 1] = {
    let mut reciprocals = [0.0; ORDER + 1];
    let mut n = 1;
    while n <= ORDER {
        reciprocals[n] = 1.0 / n as f64;
        n += 1;
    }
    reciprocals
};

impl<const COUNT: usize> Series<COUNT> {
    /// No motion yet, in powers up to `order`.
    pub fn zero(order: usize) -> Self {
        Series { coefficients: [0.0; COUNT], order }
    }

    /// The value after `seconds`.
    pub fn at(&self, seconds: f64) -> f64 {
        self.coefficients[..=self.order].iter().rev().fold(0.0, |sum, coefficient| sum * seconds + coefficient)
    }

    /// The rate of change after `seconds`.
    pub fn rate_at(&self, seconds: f64) -> f64 {
        let powers = self.coefficients[..=self.order].iter().enumerate().skip(1);
        powers.rev().fold(0.0, |sum, (power, coefficient)| sum * seconds + coefficient * power as f64)
    }

    /// The first instant within `seconds` at which the series passes `level`, upwards or downwards as asked for. A series
    /// that starts on the level (within rounding) and moves away from that side has not passed it.
    pub fn crossing(&self, level: f64, upwards: bool, seconds: f64) -> Option<f64> {
        let side = if upwards { 1.0 } else { -1.0 };
        if side * (self.coefficients[0] - level) + self.reach(seconds) < 0.0 {
            return None;
        }
        let beyond = |time: f64| side * (self.at(time) - level);
        let leaving = |time: f64| side * self.rate_at(time);
        let mut start = 0.0;
        for interval in 1..=INTERVALS {
            let end = seconds * f64::from(interval) / f64::from(INTERVALS);
            if beyond(end) > 0.0 {
                // On the level and moving inwards at first: it passes the level after it has turned.
                let inside = if beyond(start) >= 0.0 && leaving(start) < 0.0 && leaving(end) > 0.0 {
                    root(leaving, start, end)
                } else {
                    start
                };
                return Some(if beyond(inside) < 0.0 { root(beyond, inside, end) } else { inside });
            }
            if leaving(start) > 0.0 && leaving(end) < 0.0 {
                let turn = root(|time| -leaving(time), start, end);
                if beyond(turn) > 0.0 {
                    return Some(if beyond(start) < 0.0 { root(beyond, start, turn) } else { start });
                }
            }
            start = end;
        }
        None
    }

    /// How far the series can get from its start within `seconds`, at most.
    fn reach(&self, seconds: f64) -> f64 {
        self.coefficients[1..=self.order].iter().rev().fold(0.0, |sum, coefficient| (sum + coefficient.abs()) * seconds)
    }
}

/// Where `function` turns positive between `low`, where it is not, and `high`, where it is: bisection, on the positive
/// side by no more than rounding.
fn root(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rounding = f64::EPSILON * high;
    while high - low > rounding {
        let middle = low + (high - low) / 2.0;
        if function(middle) > 0.0 { high = middle } else { low = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    /// amplitude · sin(rate · t + phase).
    fn sine(amplitude: f64, rate: f64, phase: f64) -> Series {
        let mut series = Series::zero(ORDER);
        let mut factor = amplitude;
        for (k, coefficient) in series.coefficients.iter_mut().enumerate() {
            let turned = phase + std::f64::consts::FRAC_PI_2 * k as f64;
            *coefficient = factor * turned.sin();
            factor *= rate / (k + 1) as f64;
        }
        series
    }

    fn check(series: &Series, level: f64, upwards: bool, expected: Option<f64>) {
        let found = series.crossing(level, upwards, 2.0);
        let same = match (found, expected) {
            (Some(found), Some(expected)) => (found - expected).abs() < 1e-9,
            (found, expected) => found == expected,
        };
        assert!(same, "{found:?} instead of {expected:?}");
    }

    #[test]
    fn a_series_is_its_function() {
        let series = sine(2.0, 1.0, 0.3);
        for time in [0.0, 0.1, 1.0, 2.0_f64] {
            assert!((series.at(time) - 2.0 * (time + 0.3).sin()).abs() < 1e-13);
            assert!((series.rate_at(time) - 2.0 * (time + 0.3).cos()).abs() < 1e-12);
        }
    }

    #[test]
    fn crossings_are_found_where_they_are() {
        check(&sine(1.0, 1.0, 0.0), 0.5, true, Some(0.5_f64.asin()));
        check(&sine(1.0, 1.0, 0.0), 1.1, true, None);
        check(&sine(1.0, 1.0, 1.0), 0.5, false, Some(std::f64::consts::PI - 0.5_f64.asin() - 1.0));
    }

    #[test]
    fn a_short_visit_beyond_the_level_is_found() {
        // The top, at π/2, lies between two of the looked-at instants.
        check(&sine(1.0, 1.0, 0.0), 0.9999, true, Some(0.9999_f64.asin()));
    }

    #[test]
    fn a_start_on_the_level_counts_when_it_comes_back() {
        let down_and_up = sine(-1.0, 1.8, 0.0);
        check(&down_and_up, 0.0, true, Some(std::f64::consts::PI / 1.8));
    }
}
