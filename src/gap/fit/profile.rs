//! Intervals of parameters by profile likelihood: a parameter is moved away, the others follow, until the deviance has risen.
//!
//! Source: W. Q. Meeker, L. A. Escobar, Teaching about approximate confidence regions based on maximum likelihood estimation,
//! The American Statistician 49 (1995). Where the end lies beyond what the parameter may be, the data do not say it: it is
//! not identifiable on that side.
//!
//! The others set out from where the slopes at the best say that they follow to, and are fitted from there: across a valley that is a
//! thousand times steeper than it falls along, a deviance that is rounded leads nowhere. Source of the path: D. J. Venzon,
//! S. H. Moolgavkar, A method for computing profile-likelihood-based confidence intervals, Applied Statistics 37 (1988).

use nalgebra::{DMatrix, DVector};

use super::{Fitted, Range, Residuals, least_squares, sum_of_squares};

/// How often an end is looked for.
const LOOKS: u32 = 12;
/// A direction of which less than this share is left beside the others is none of its own.
const LEAST_OWN: f64 = 1e-9;

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
    let walk = Walk { residuals, fitted, ranges, parameter, rise, valley: Valley::of(fitted, parameter) };
    let (from, to) = rayon::join(|| walk.end(-1.0), || walk.end(1.0));
    Interval { from, to }
}

struct Walk<'a> {
    residuals: &'a Residuals<'a>,
    fitted: &'a Fitted,
    ranges: &'a [Range],
    parameter: usize,
    rise: f64,
    valley: Valley,
}

/// How the others follow a parameter to first order, and how far it may go with them until the deviance has risen by 1.
struct Valley {
    /// For each other parameter, in their order: its change for each unit of the parameter's.
    follow: Vec<f64>,
    /// Infinite where nothing is known of it.
    spread: f64,
}

impl Valley {
    /// With C = Jᵀ·J divided into the parameter p and the others o the deviance is least along −C(o,o)⁻¹·C(o,p), and rises there with
    /// C(p,p) − C(p,o)·C(o,o)⁻¹·C(o,p).
    fn of(fitted: &Fitted, parameter: usize) -> Valley {
        let count = fitted.at.len();
        let stiff = Valley { follow: vec![0.0; count - 1], spread: fitted.spread(parameter) };
        if count == 1 || fitted.curvature.len() != count * count {
            return stiff;
        }
        let squares = DMatrix::from_column_slice(count, count, &fitted.curvature);
        // In spreads of each alone: their units are as far apart as can be.
        let scales = squares.diagonal().map(|along| if along > 0.0 { along.sqrt().recip() } else { 0.0 });
        let scaled = |row: usize, column: usize| squares[(row, column)] * scales[row] * scales[column];
        let others: Vec<usize> = (0..count).filter(|other| *other != parameter).collect();
        let among = DMatrix::from_fn(count - 1, count - 1, |row, column| scaled(others[row], others[column]));
        let across = DVector::from_fn(count - 1, |row, _| scaled(others[row], parameter));
        let Ok(follow) = among.svd(true, true).solve(&across, LEAST_OWN) else { return stiff };
        let left = 1.0 - across.dot(&follow);
        let follow = others.iter().zip(follow.iter()).map(|(other, by)| match scales[parameter] {
            0.0 => 0.0,
            scale => -by * scales[*other] / scale,
        });
        Valley { follow: follow.collect(), spread: stiff.spread / left.max(LEAST_OWN).sqrt() }
    }
}

impl Walk<'_> {
    fn end(&self, way: f64) -> Side {
        let Range { least, greatest, scale } = self.ranges[self.parameter];
        let bound = if way > 0.0 { greatest } else { least };
        let best = self.fitted.at[self.parameter];
        let room = (bound - best).abs();
        let spread = self.valley.spread;
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
        let further = value - others[self.parameter];
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
        start.iter_mut().zip(&self.valley.follow).for_each(|(other, by)| *other += by * further);
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
    fn along_a_steep_valley_in_small_steps_the_others_follow() {
        // Only the sum shows, in steps of a half; what is known of the other beforehand, 0.25, is all that is known of it.
        let residuals = |at: &[f64]| {
            let seen = (1..=50).map(|k| (200.0 * (at[0] + at[1] - 1.0) * f64::from(k) / 50.0).round() * 0.5);
            Some(seen.chain([at[1] / 0.25]).collect())
        };
        let along = (1..=50).map(|k| (2.0 * f64::from(k)).powi(2)).sum::<f64>();
        let curvature = vec![along, along, along, along + 16.0];
        let fitted = Fitted { at: vec![1.0, 0.0], cost: 0.0, curvature, evaluations: 0 };
        let Interval { from, to } = profile(&residuals, &fitted, &[FREE; 2], 0, 3.84);
        let half = 0.25 * 3.84_f64.sqrt();
        assert!(
            (to.value() - 1.0 - half).abs() < 0.1 * half && (1.0 - from.value() - half).abs() < 0.1 * half,
            "{from:?} {to:?}"
        );
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
