//! Intervals of parameters by profile likelihood: a parameter is moved away, the others follow, until the deviance has risen.
//!
//! Source: W. Q. Meeker, L. A. Escobar, Teaching about approximate confidence regions based on maximum likelihood estimation,
//! The American Statistician 49 (1995). Where the end lies beyond what the parameter may be, the data do not say it: it is
//! not identifiable on that side.

use super::{Fitted, Range, Residuals, least_squares, sum_of_squares};

/// How often an end is looked for.
const LOOKS: u32 = 12;

/// An end of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// Here the deviance has risen enough.
    At(f64),
    /// Here the parameter may go no further, and the deviance has not risen enough.
    Bound(f64),
}

impl Side {
    pub fn value(self) -> f64 {
        match self {
            Side::At(value) | Side::Bound(value) => value,
        }
    }
}

/// Where a parameter lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub from: Side,
    pub to: Side,
}

impl Interval {
    /// Whether the data hold it on both sides.
    pub fn is_identifiable(&self) -> bool {
        matches!((self.from, self.to), (Side::At(_), Side::At(_)))
    }
}

/// The interval of `parameter` about `fitted`, in which the deviance has not risen by more than `rise` (3.84 for 95 %, times
/// what correlated residuals exaggerate).
pub fn profile(residuals: &Residuals<'_>, fitted: &Fitted, ranges: &[Range], parameter: usize, rise: f64) -> Interval {
    let walk = Walk { residuals, fitted, ranges, parameter, rise };
    let (from, to) = rayon::join(|| walk.end(-1.0), || walk.end(1.0));
    Interval { from, to }
}

struct Walk<'a> {
    residuals: &'a Residuals<'a>,
    fitted: &'a Fitted,
    ranges: &'a [Range],
    parameter: usize,
    rise: f64,
}

impl Walk<'_> {
    fn end(&self, way: f64) -> Side {
        let Range { least, greatest, scale } = self.ranges[self.parameter];
        let bound = if way > 0.0 { greatest } else { least };
        let best = self.fitted.at[self.parameter];
        let room = (bound - best).abs();
        let spread = self.fitted.spread(self.parameter);
        let mut others = self.fitted.at.clone();
        let (mut inside, mut inside_rise) = (0.0, 0.0);
        let mut outside: Option<(f64, f64)> = None;
        let first = if spread.is_finite() { spread * self.rise.sqrt() } else { 0.01 * scale };
        let mut step = first.max(1e-12 * scale).min(room);
        for _ in 0..LOOKS {
            if room <= 0.0 {
                return Side::Bound(bound);
            }
            let Some(rise) = self.rise_at(best + way * step, &mut others) else { break };
            if rise < self.rise {
                if step >= room {
                    return Side::Bound(bound);
                }
                (inside, inside_rise) = (step, rise);
            } else {
                outside = Some((step, rise));
            }
            if (rise / self.rise - 1.0).abs() < 0.05 {
                return Side::At(best + way * step);
            }
            step = match outside {
                // Where a parabola through both would be at the rise; in steps it is halved.
                Some((outside, outside_rise)) => {
                    let (near, far) = (inside_rise.max(0.0).sqrt(), outside_rise.sqrt());
                    let share = ((self.rise.sqrt() - near) / (far - near).max(1e-12)).clamp(0.1, 0.9);
                    inside + share * (outside - inside)
                }
                None => (step * (self.rise / rise.max(0.01 * self.rise)).sqrt().clamp(1.5, 8.0)).min(room),
            };
        }
        match outside {
            Some((outside, _)) => Side::At(best + way * outside),
            None => Side::Bound(best + way * step),
        }
    }

    /// How much the deviance has risen with the parameter at `value`, the others fitted anew from `others`.
    fn rise_at(&self, value: f64, others: &mut Vec<f64>) -> Option<f64> {
        others[self.parameter] = value;
        if self.ranges.len() == 1 {
            return Some(sum_of_squares(&(self.residuals)(others)?) - self.fitted.cost);
        }
        let mut ranges = self.ranges.to_vec();
        ranges.remove(self.parameter);
        let with = |rest: &[f64]| {
            let mut at = rest.to_vec();
            at.insert(self.parameter, value);
            at
        };
        let mut start = others.clone();
        start.remove(self.parameter);
        let residuals = |rest: &[f64]| (self.residuals)(&with(rest));
        let found = least_squares(&residuals, &start, &ranges, 12 + 6 * ranges.len() as u32)?;
        *others = with(&found.at);
        Some(found.cost - self.fitted.cost)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: Range = Range { least: -1e3, greatest: 1e3, scale: 1.0 };

    #[test]
    fn of_a_straight_line_it_is_the_textbooks() {
        // y = a + b·t at t = −2..2, sigma 1: var(a) = 1/5, var(b) = 1/10.
        let residuals = |at: &[f64]| Some((-2..=2).map(|t| at[0] + at[1] * f64::from(t) - 0.3).collect());
        let fitted = least_squares(&residuals, &[0.0, 0.0], &[FREE; 2], 100).unwrap();
        for (parameter, variance) in [(0, 0.2_f64), (1, 0.1)] {
            let Interval { from, to } = profile(&residuals, &fitted, &[FREE; 2], parameter, 3.84);
            let half = (3.84 * variance).sqrt();
            assert!((to.value() - from.value() - 2.0 * half).abs() < 0.1 * half, "{from:?} {to:?} {half}");
        }
    }

    #[test]
    fn what_moves_together_widens_it() {
        // Only the sum is seen well, the difference hardly.
        let residuals = |at: &[f64]| Some(vec![100.0 * (at[0] + at[1] - 1.0), at[0] - at[1]]);
        let fitted = least_squares(&residuals, &[0.2, 0.1], &[FREE; 2], 100).unwrap();
        let interval = profile(&residuals, &fitted, &[FREE; 2], 0, 3.84);
        assert!((interval.to.value() - 0.5 - 0.98).abs() < 0.06, "{interval:?}");
        assert!(interval.is_identifiable());
    }

    #[test]
    fn what_the_data_do_not_hold_runs_into_its_bound() {
        let residuals = |at: &[f64]| Some(vec![at[0].max(0.0)]);
        let range = [Range { least: -2.0, greatest: 9.0, scale: 1.0 }];
        let fitted = least_squares(&residuals, &[1.0], &range, 100).unwrap();
        let interval = profile(&residuals, &fitted, &range, 0, 3.84);
        assert_eq!(interval.from, Side::Bound(-2.0));
        assert!(!interval.is_identifiable());
    }

    #[test]
    fn a_cost_in_steps_has_an_interval_too() {
        // Edges seen in cycles: every value from 0.2 to 0.4 is as good as any.
        let residuals = |at: &[f64]| Some(vec![if (0.2..0.4).contains(&at[0]) { 0.0 } else { 5.0 }]);
        let range = [Range { least: 0.0, greatest: 1.0, scale: 0.1 }];
        let fitted = Fitted { at: vec![0.3], cost: 0.0, curvature: Vec::new(), evaluations: 0 };
        let interval = profile(&residuals, &fitted, &range, 0, 3.84);
        assert!((interval.from.value() - 0.2).abs() < 0.01 && (interval.to.value() - 0.4).abs() < 0.01, "{interval:?}");
    }
}
