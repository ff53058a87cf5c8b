//! The least sum of squares downhill from a start, within bounds.
//!
//! Source: D. W. Marquardt, An algorithm for least-squares estimation of nonlinear parameters, J. SIAM 11 (1963); parameters
//! at a bound that the gradient pushes outward are held there (C. Kanzow, N. Yamashita, M. Fukushima, J. Comput. Appl. Math.
//! 172 (2004)). Derivatives are differences over a step in which the deviance changes by a few hundredths: a model that is
//! rounded or stepped shows no derivative over a smaller one. Once they are known they are kept up with what each step shows, and
//! differences are taken anew only where that does not do: the secant version of the method, K. Madsen, H. B. Nielsen, O. Tingleff,
//! Methods for non-linear least squares problems, Technical University of Denmark 2004, section 3.5, after C. G. Broyden, Math.
//! Comp. 19 (1965).

use nalgebra::{DMatrix, DVector};

use super::{Fitted, Range, Residuals, sum_of_squares};

/// Changes of the deviance below this are none.
const ENOUGH: f64 = 1e-3;
/// A step of a difference, in spreads of the parameter.
const DIFFERENCE: f64 = 0.2;
/// How much damping is too much: nothing is found downhill.
const MOST_DAMPING: f64 = 1e9;
/// Which share of what a step changes, squared, its derivatives may miss and still do for another.
const MISSED: f64 = 0.05;
/// Which share they may miss for what they are to be kept up at all.
const MUCH_MISSED: f64 = 0.5;

/// A model's residuals at a point, and their derivatives there.
#[derive(Clone)]
pub struct Slopes {
    here: Vec<f64>,
    /// A column for each parameter.
    each: DMatrix<f64>,
    steps: Vec<f64>,
}

impl Slopes {
    /// Those at `at`. `None` where the model cannot be computed there.
    pub fn of(residuals: &Residuals<'_>, at: &[f64], ranges: &[Range]) -> Option<Slopes> {
        let mut descent = Descent::new(residuals, at, ranges)?;
        // The first differences say how wide the second ones have to be.
        let rough = descent.slopes()?;
        descent.fit_steps(&(rough.transpose() * &rough));
        let each = descent.slopes()?;
        Some(Slopes { here: descent.here, each, steps: descent.steps })
    }

    /// The residuals that they are of.
    pub fn here(&self) -> &[f64] {
        &self.here
    }

    /// How each residual changes with a parameter.
    pub fn column(&self, parameter: usize) -> Vec<f64> {
        self.each.column(parameter).iter().copied().collect()
    }

    /// The same where each of the first residuals has a weight of its own, and what lies behind them that of 1.
    pub fn weighted(&self, weights: &[f64]) -> Slopes {
        let weights = || weights.iter().copied().chain(std::iter::repeat(1.0));
        let mut each = self.each.clone();
        each.row_iter_mut().zip(weights()).for_each(|(mut row, weight)| row *= weight);
        let here = self.here.iter().zip(weights()).map(|(here, weight)| here * weight).collect();
        Slopes { here, each, steps: self.steps.clone() }
    }
}

/// Goes downhill from `start`, computing the model at most `budget` times. `None` where the model cannot be computed at the
/// start.
pub fn least_squares(residuals: &Residuals<'_>, start: &[f64], ranges: &[Range], budget: u32) -> Option<Fitted> {
    Some(Descent::new(residuals, start, ranges)?.run(None, budget))
}

/// The same from where the derivatives are known already.
pub fn least_squares_from(
    known: Slopes,
    residuals: &Residuals<'_>,
    start: &[f64],
    ranges: &[Range],
    budget: u32,
) -> Fitted {
    let Slopes { here, each, steps } = known;
    Descent { steps, ..Descent::at(residuals, start, ranges, here) }.run(Some(each), budget)
}

/// What became of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    Downhill,
    /// It led, or would have led, to next to no less.
    Enough,
    /// None was found that cost less, or none was left to try.
    Nowhere,
}

/// Derivatives that are kept up.
struct Kept {
    slopes: DMatrix<f64>,
    /// Whether they were taken here.
    is_fresh: bool,
    /// Whether all steps since they were taken went as they said.
    is_good: bool,
}

impl Kept {
    fn fresh(slopes: DMatrix<f64>) -> Kept {
        Kept { slopes, is_fresh: true, is_good: true }
    }

    /// Takes up what a step showed; which share of it, squared, they had missed. `squares`: their products.
    fn keep_up(
        &mut self,
        squares: &DMatrix<f64>,
        (before, from): (&[f64], &[f64]),
        (at, here): (&[f64], &[f64]),
    ) -> f64 {
        let moved = DVector::from_iterator(at.len(), at.iter().zip(before).map(|(at, before)| at - before));
        let changed = DVector::from_iterator(here.len(), here.iter().zip(from).map(|(here, from)| here - from));
        let missed = &changed - &self.slopes * &moved;
        let share = missed.norm_squared() / changed.norm_squared().max(f64::MIN_POSITIVE);
        (self.is_fresh, self.is_good) = (false, self.is_good && share < MISSED);
        // Parameters of different units: each counts by how much it moves the residuals.
        let along = moved.component_mul(&squares.diagonal());
        let length = along.dot(&moved);
        if length > 0.0 {
            self.slopes.ger(1.0 / length, &missed, &along, 1.0);
        }
        share
    }
}

struct Descent<'a> {
    residuals: &'a Residuals<'a>,
    ranges: &'a [Range],
    at: Vec<f64>,
    here: Vec<f64>,
    cost: f64,
    /// Of each parameter: over what its derivative is a difference.
    steps: Vec<f64>,
    damping: f64,
    evaluations: u32,
}

impl<'a> Descent<'a> {
    fn new(residuals: &'a Residuals<'a>, start: &[f64], ranges: &'a [Range]) -> Option<Descent<'a>> {
        let at: Vec<f64> = start.iter().zip(ranges).map(|(value, range)| range.clamp(*value)).collect();
        let here = residuals(&at)?;
        Some(Descent { evaluations: 1, ..Descent::at(residuals, &at, ranges, here) })
    }

    /// One whose residuals at its start are known.
    fn at(residuals: &'a Residuals<'a>, start: &[f64], ranges: &'a [Range], here: Vec<f64>) -> Descent<'a> {
        Descent {
            residuals,
            ranges,
            cost: sum_of_squares(&here),
            steps: ranges.iter().map(|range| 1e-3 * range.scale).collect(),
            at: start.to_vec(),
            here,
            damping: 1e-3,
            evaluations: 0,
        }
    }

    /// Downhill until nothing more is gained: what differences say that were taken where it ends, or what was kept up of earlier ones as
    /// long as the steps went as that said.
    fn run(mut self, known: Option<DMatrix<f64>>, budget: u32) -> Fitted {
        let mut curvature = Vec::new();
        let mut next = known.map(Kept::fresh);
        loop {
            let mut kept = match next.take() {
                Some(kept) => kept,
                None if self.evaluations + self.ranges.len() as u32 > budget => break,
                None => match self.slopes() {
                    Some(slopes) => Kept::fresh(slopes),
                    None => break,
                },
            };
            let squares = kept.slopes.transpose() * &kept.slopes;
            curvature = squares.iter().copied().collect();
            if kept.is_fresh {
                self.fit_steps(&squares);
            }
            let (before, from) = (self.at.clone(), self.here.clone());
            match self.step(&kept, &squares, budget) {
                Step::Nowhere if kept.is_fresh => break,
                Step::Nowhere => {}
                Step::Enough if kept.is_good => break,
                Step::Enough => {}
                Step::Downhill => {
                    let missed = kept.keep_up(&squares, (&before, &from), (&self.at, &self.here));
                    next = (missed < MUCH_MISSED).then_some(kept);
                }
            }
        }
        Fitted { at: self.at, cost: self.cost, curvature, evaluations: self.evaluations }
    }

    fn residuals(&mut self, at: &[f64]) -> Option<Vec<f64>> {
        self.evaluations += 1;
        (self.residuals)(at).filter(|there| there.len() == self.here.len())
    }

    /// The derivatives of all residuals: a column for each parameter.
    fn slopes(&mut self) -> Option<DMatrix<f64>> {
        let mut slopes = DMatrix::zeros(self.here.len(), self.at.len());
        for parameter in 0..self.at.len() {
            let mut column = self.slope(parameter)?;
            // Where nothing changes, a parameter's step was too small, or it does not matter here.
            for _ in 0..2 {
                if column.iter().any(|slope| *slope != 0.0) {
                    break;
                }
                self.steps[parameter] *= 30.0;
                column = self.slope(parameter)?;
            }
            slopes.set_column(parameter, &DVector::from_vec(column));
        }
        Some(slopes)
    }

    fn slope(&mut self, parameter: usize) -> Option<Vec<f64>> {
        let Range { least, greatest, .. } = self.ranges[parameter];
        let step = self.steps[parameter].min(0.5 * (greatest - least));
        let value = self.at[parameter];
        let step = if value + step <= greatest { step } else { -step };
        let mut there = self.at.clone();
        there[parameter] = value + step;
        // The step that was made, rounding included.
        let step = there[parameter] - value;
        let there = self.residuals(&there)?;
        Some(
            there
                .iter()
                .zip(&self.here)
                .map(|(there, here)| if step == 0.0 { 0.0 } else { (there - here) / step })
                .collect(),
        )
    }

    fn fit_steps(&mut self, squares: &DMatrix<f64>) {
        for (parameter, range) in self.ranges.iter().enumerate() {
            let along = squares[(parameter, parameter)];
            if along > 0.0 {
                self.steps[parameter] = (DIFFERENCE / along.sqrt()).clamp(1e-7 * range.scale, 0.1 * range.scale);
            }
        }
    }

    /// One step downhill, as short as the damping makes it be; by derivatives that were not taken here, only the first that is tried.
    fn step(&mut self, kept: &Kept, squares: &DMatrix<f64>, budget: u32) -> Step {
        let gradient = kept.slopes.transpose() * DVector::from_column_slice(&self.here);
        while self.damping < MOST_DAMPING && self.evaluations < budget {
            let Some(there) = self.proposal(&gradient, squares) else { return Step::Nowhere };
            let moved =
                there.iter().zip(&self.at).enumerate().map(|(j, (a, b))| (a - b).abs() * squares[(j, j)].sqrt());
            if moved.fold(0.0, f64::max) < ENOUGH {
                return Step::Enough;
            }
            let found = self.residuals(&there).map(|residuals| (sum_of_squares(&residuals), residuals));
            match found {
                Some((cost, residuals)) if cost < self.cost => {
                    let gained = self.cost - cost;
                    (self.at, self.here, self.cost) = (there, residuals, cost);
                    self.damping = (self.damping / 5.0).max(1e-9);
                    return if gained > ENOUGH { Step::Downhill } else { Step::Enough };
                }
                _ => self.damping *= 6.0,
            }
            if !kept.is_fresh {
                break;
            }
        }
        Step::Nowhere
    }

    /// Where the damped step leads; `None` where no parameter can move.
    fn proposal(&self, gradient: &DVector<f64>, squares: &DMatrix<f64>) -> Option<Vec<f64>> {
        let free: Vec<usize> = (0..self.at.len())
            .filter(|&j| {
                let (value, range) = (self.at[j], self.ranges[j]);
                let is_held =
                    (value <= range.least && gradient[j] > 0.0) || (value >= range.greatest && gradient[j] < 0.0);
                squares[(j, j)] > 0.0 && !is_held
            })
            .collect();
        let mut matrix = squares.select_rows(&free).select_columns(&free);
        for j in 0..free.len() {
            matrix[(j, j)] *= 1.0 + self.damping;
        }
        let step = matrix.cholesky()?.solve(&gradient.select_rows(&free));
        let mut there = self.at.clone();
        for (j, step) in free.iter().zip(step.iter()) {
            there[*j] = self.ranges[*j].clamp(self.at[*j] - step);
        }
        (!free.is_empty()).then_some(there)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free(scale: f64) -> Range {
        Range { least: -1e9, greatest: 1e9, scale }
    }

    #[test]
    fn a_known_truth_is_found() {
        // y = a·e^(−b·t), noiseless.
        let model = |a: f64, b: f64| (0..50).map(move |i| 1e3 * a * (-b * f64::from(i) * 0.1).exp());
        let truth: Vec<f64> = model(2.0, 0.7).collect();
        let residuals = |at: &[f64]| Some(model(at[0], at[1]).zip(&truth).map(|(a, b)| a - b).collect());
        let fitted = least_squares(&residuals, &[1.0, 0.1], &[free(1.0), free(1.0)], 200).unwrap();
        assert!((fitted.at[0] - 2.0).abs() < 1e-5 && (fitted.at[1] - 0.7).abs() < 1e-5, "{fitted:?}");
    }

    #[test]
    fn the_valley_of_rosenbrock_is_followed_to_its_end() {
        let residuals = |at: &[f64]| Some(vec![10.0 * (at[1] - at[0] * at[0]), 1.0 - at[0]]);
        let fitted = least_squares(&residuals, &[-1.2, 1.0], &[free(1.0), free(1.0)], 500).unwrap();
        assert!((fitted.at[0] - 1.0).abs() < 0.05, "{fitted:?}");
    }

    #[test]
    fn a_bound_holds_and_the_others_go_on() {
        let residuals = |at: &[f64]| Some(vec![100.0 * (at[0] + 1.0), 100.0 * (at[1] - 3.0 + 0.1 * at[0])]);
        let ranges = [Range { least: 0.0, greatest: 5.0, scale: 1.0 }, free(1.0)];
        let fitted = least_squares(&residuals, &[2.0, 0.0], &ranges, 200).unwrap();
        assert_eq!(fitted.at[0], 0.0);
        assert!((fitted.at[1] - 3.0).abs() < 1e-4, "{fitted:?}");
    }

    #[test]
    fn a_model_in_steps_is_fitted_to_within_a_step() {
        let residuals = |at: &[f64]| {
            Some((0..100).map(|i| ((at[0] * f64::from(i)).floor() - (0.37 * f64::from(i)).floor()) * 2.0).collect())
        };
        let fitted = least_squares(&residuals, &[0.3], &[free(0.1)], 200).unwrap();
        assert!((fitted.at[0] - 0.37).abs() < 0.01, "{fitted:?}");
    }

    /// Of a model that is straight in its eight parameters one set of differences is enough.
    #[test]
    fn derivatives_that_hold_are_not_taken_anew() {
        let model = |at: &[f64]| -> Vec<f64> {
            let row =
                |i: usize| at.iter().enumerate().map(move |(j, value)| value * (0.1 * (i * (j + 1)) as f64).sin());
            (0..100).map(|i| 10.0 * row(i).sum::<f64>()).collect()
        };
        let truth = model(&[1.0, -2.0, 3.0, 0.5, 0.1, -0.7, 2.0, 1.0]);
        let residuals = |at: &[f64]| Some(model(at).iter().zip(&truth).map(|(a, b)| a - b).collect());
        let fitted = least_squares(&residuals, &[0.0; 8], &[free(1.0); 8], 200).unwrap();
        assert!(fitted.cost < 1e-6 && fitted.evaluations < 2 * 8, "{fitted:?}");
    }

    #[test]
    fn from_where_derivatives_are_known_the_way_is_shorter() {
        let model = |a: f64, b: f64| (0..50).map(move |i| 1e3 * a * (-b * f64::from(i) * 0.1).exp());
        let truth: Vec<f64> = model(2.0, 0.7).collect();
        let residuals = |at: &[f64]| Some(model(at[0], at[1]).zip(&truth).map(|(a, b)| a - b).collect());
        let ranges = [free(1.0), free(1.0)];
        let known = || Slopes::of(&residuals, &[1.99, 0.69], &ranges).unwrap();
        let from = least_squares_from(known(), &residuals, &[1.99, 0.69], &ranges, 200);
        let afresh = least_squares(&residuals, &[1.99, 0.69], &ranges, 200).unwrap();
        assert!((from.at[0] - 2.0).abs() < 1e-5 && (from.at[1] - 0.7).abs() < 1e-5, "{from:?}");
        assert!(from.evaluations < afresh.evaluations, "{from:?} {afresh:?}");
        // Half of the residuals alone say the same here.
        let half: Vec<f64> = (0..25).map(|i| f64::from(i % 2)).collect();
        let weights = |i: usize| half.get(i).copied().unwrap_or(1.0);
        let residuals = |at: &[f64]| Some(residuals(at)?.iter().enumerate().map(|(i, a)| a * weights(i)).collect());
        let of_half = least_squares_from(known().weighted(&half), &residuals, &[1.99, 0.69], &ranges, 200);
        assert!((of_half.at[0] - 2.0).abs() < 1e-5 && (of_half.at[1] - 0.7).abs() < 1e-5, "{of_half:?}");
    }

    #[test]
    fn what_cannot_be_computed_is_gone_around() {
        let residuals = |at: &[f64]| (at[0] < 2.0).then(|| vec![10.0 * (at[0] - 1.9)]);
        let fitted = least_squares(&residuals, &[0.0], &[free(1.0)], 100).unwrap();
        assert!((fitted.at[0] - 1.9).abs() < 1e-3, "{fitted:?}");
        assert_eq!(least_squares(&residuals, &[3.0], &[free(1.0)], 100), None);
    }
}
