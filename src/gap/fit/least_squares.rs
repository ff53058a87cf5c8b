//! The least sum of squares downhill from a start, within bounds.
//!
//! Source: D. W. Marquardt, An algorithm for least-squares estimation of nonlinear parameters, J. SIAM 11 (1963); parameters
//! at a bound that the gradient pushes outward are held there (C. Kanzow, N. Yamashita, M. Fukushima, J. Comput. Appl. Math.
//! 172 (2004)). Derivatives are differences over a step in which the deviance changes by a few hundredths: a model that is
//! rounded or stepped shows no derivative over a smaller one.

use nalgebra::{DMatrix, DVector};

use super::{Fitted, Range, Residuals, sum_of_squares};

/// Changes of the deviance below this are none.
const ENOUGH: f64 = 1e-3;
/// A step of a difference, in spreads of the parameter.
const DIFFERENCE: f64 = 0.2;
/// How much damping is too much: nothing is found downhill.
const MOST_DAMPING: f64 = 1e9;

/// Goes downhill from `start`, computing the model at most `budget` times. `None` where the model cannot be computed at the
/// start.
pub fn least_squares(residuals: &Residuals<'_>, start: &[f64], ranges: &[Range], budget: u32) -> Option<Fitted> {
    let at: Vec<f64> = start.iter().zip(ranges).map(|(value, range)| range.clamp(*value)).collect();
    let here = residuals(&at)?;
    let mut descent = Descent {
        residuals,
        ranges,
        cost: sum_of_squares(&here),
        steps: ranges.iter().map(|range| 1e-3 * range.scale).collect(),
        at,
        here,
        damping: 1e-3,
        evaluations: 1,
    };
    let mut curvature = Vec::new();
    while descent.evaluations + ranges.len() as u32 <= budget {
        let Some(slopes) = descent.slopes() else { break };
        let squares = slopes.transpose() * &slopes;
        curvature = squares.iter().copied().collect();
        descent.fit_steps(&squares);
        if !descent.step(&slopes, &squares, budget) {
            break;
        }
    }
    Some(Fitted { at: descent.at, cost: descent.cost, curvature, evaluations: descent.evaluations })
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

impl Descent<'_> {
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

    /// One step downhill, as long as the damping lets it be; whether another may follow.
    fn step(&mut self, slopes: &DMatrix<f64>, squares: &DMatrix<f64>, budget: u32) -> bool {
        let gradient = slopes.transpose() * DVector::from_column_slice(&self.here);
        while self.damping < MOST_DAMPING && self.evaluations < budget {
            let Some(there) = self.proposal(&gradient, squares) else { return false };
            let moved =
                there.iter().zip(&self.at).enumerate().map(|(j, (a, b))| (a - b).abs() * squares[(j, j)].sqrt());
            if moved.fold(0.0, f64::max) < ENOUGH {
                return false;
            }
            let found = self.residuals(&there).map(|residuals| (sum_of_squares(&residuals), residuals));
            match found {
                Some((cost, residuals)) if cost < self.cost => {
                    let gained = self.cost - cost;
                    (self.at, self.here, self.cost) = (there, residuals, cost);
                    self.damping = (self.damping / 5.0).max(1e-9);
                    return gained > ENOUGH;
                }
                _ => self.damping *= 6.0,
            }
        }
        false
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

    #[test]
    fn what_cannot_be_computed_is_gone_around() {
        let residuals = |at: &[f64]| (at[0] < 2.0).then(|| vec![10.0 * (at[0] - 1.9)]);
        let fitted = least_squares(&residuals, &[0.0], &[free(1.0)], 100).unwrap();
        assert!((fitted.at[0] - 1.9).abs() < 1e-3, "{fitted:?}");
        assert_eq!(least_squares(&residuals, &[3.0], &[free(1.0)], 100), None);
    }
}
