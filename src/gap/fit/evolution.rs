//! The least value of a function that is rugged: a cloud of trials that learns where it is good.
//!
//! Source: N. Hansen, The CMA Evolution Strategy: a tutorial, arXiv:1604.00772 (2016), with its default constants.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::{Fitted, Range};

/// Searches from `start`, the first cloud as wide as the ranges' scales, computing the cost about `budget` times; trials outside
/// the bounds are moved onto them, and cost what lies there. The result is never worse than `start`. What it draws follows from
/// `seed`.
pub fn evolve(
    cost: &(dyn Fn(&[f64]) -> Option<f64> + Sync),
    start: &[f64],
    ranges: &[Range],
    seed: u64,
    budget: u32,
) -> Fitted {
    let mut cloud = Cloud::new(start, ranges);
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    let mut best = (cost(start).unwrap_or(f64::INFINITY), start.to_vec());
    let mut evaluations = 1;
    while evaluations < budget && cloud.width > 1e-9 {
        let Some(mut trials) = cloud.trials(&mut dice) else { break };
        trials.par_iter_mut().for_each(|trial| {
            trial.cost = cost(&cloud.point(&trial.step)).filter(|cost| !cost.is_nan()).unwrap_or(f64::INFINITY);
        });
        evaluations += trials.len() as u32;
        for trial in &trials {
            if trial.cost < best.0 {
                best = (trial.cost, cloud.point(&trial.step));
            }
        }
        cloud.learn(trials);
    }
    Fitted { at: best.1, cost: best.0, curvature: Vec::new(), evaluations }
}

/// A trial: its step from the mean, in widths of the cloud.
struct Trial {
    step: DVector<f64>,
    cost: f64,
}

/// The distribution of the trials, each parameter in its range's scale.
struct Cloud<'a> {
    ranges: &'a [Range],
    mean: DVector<f64>,
    width: f64,
    covariance: DMatrix<f64>,
    /// What takes a step back to a round cloud.
    whitening: DMatrix<f64>,
    path: DVector<f64>,
    width_path: DVector<f64>,
    generation: u32,
}

impl<'a> Cloud<'a> {
    fn new(start: &[f64], ranges: &'a [Range]) -> Cloud<'a> {
        let n = start.len();
        Cloud {
            ranges,
            mean: DVector::from_iterator(n, start.iter().zip(ranges).map(|(value, range)| value / range.scale)),
            width: 1.0,
            covariance: DMatrix::identity(n, n),
            whitening: DMatrix::identity(n, n),
            path: DVector::zeros(n),
            width_path: DVector::zeros(n),
            generation: 0,
        }
    }

    fn point(&self, step: &DVector<f64>) -> Vec<f64> {
        let at = &self.mean + step * self.width;
        at.iter().zip(self.ranges).map(|(value, range)| range.clamp(value * range.scale)).collect()
    }

    /// `None` where the cloud has collapsed.
    fn trials(&mut self, dice: &mut ChaCha8Rng) -> Option<Vec<Trial>> {
        let n = self.mean.len();
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(self.covariance.clone());
        if !eigenvalues.iter().all(|value| *value > 0.0) {
            return None;
        }
        let roots = eigenvalues.map(f64::sqrt);
        let colouring = &eigenvectors * DMatrix::from_diagonal(&roots);
        self.whitening = &eigenvectors * DMatrix::from_diagonal(&roots.map(f64::recip)) * eigenvectors.transpose();
        let population = 4 + (3.0 * (n as f64).ln()) as usize;
        let draw = |dice: &mut ChaCha8Rng| DVector::from_fn(n, |_, _| gauss(dice));
        Some((0..population).map(|_| Trial { step: &colouring * draw(dice), cost: f64::INFINITY }).collect())
    }

    /// Equations (41) to (47) of the tutorial.
    fn learn(&mut self, mut trials: Vec<Trial>) {
        trials.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        self.generation += 1;
        let n = self.mean.len() as f64;
        let chosen = trials.len() / 2;
        let raw: Vec<f64> = (0..chosen).map(|i| (chosen as f64 + 0.5).ln() - (i as f64 + 1.0).ln()).collect();
        let sum: f64 = raw.iter().sum();
        let weights: Vec<f64> = raw.iter().map(|weight| weight / sum).collect();
        let effective = weights.iter().map(|weight| weight * weight).sum::<f64>().recip();
        let step_rate = (effective + 2.0) / (n + effective + 5.0);
        let damping = 1.0 + 2.0 * (((effective - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + step_rate;
        let path_rate = (4.0 + effective / n) / (n + 4.0 + 2.0 * effective / n);
        let one_rate = 2.0 / ((n + 1.3).powi(2) + effective);
        let many_rate =
            (1.0 - one_rate).min(2.0 * (effective - 2.0 + effective.recip()) / ((n + 2.0).powi(2) + effective));
        let expected = n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
        let zero = DVector::zeros(self.mean.len());
        let step = weights.iter().zip(&trials).fold(zero, |sum, (weight, trial)| sum + &trial.step * *weight);
        self.mean += &step * self.width;
        let push = (step_rate * (2.0 - step_rate) * effective).sqrt();
        self.width_path = &self.width_path * (1.0 - step_rate) + &self.whitening * &step * push;
        let length = self.width_path.norm();
        let settled = (1.0 - (1.0 - step_rate).powi(2 * self.generation as i32)).sqrt();
        let goes_on = if length / settled < (1.4 + 2.0 / (n + 1.0)) * expected { 1.0 } else { 0.0 };
        let push = goes_on * (path_rate * (2.0 - path_rate) * effective).sqrt();
        self.path = &self.path * (1.0 - path_rate) + &step * push;
        let kept = 1.0 - one_rate - many_rate + (1.0 - goes_on) * one_rate * path_rate * (2.0 - path_rate);
        self.covariance = &self.covariance * kept + &self.path * self.path.transpose() * one_rate;
        for (weight, trial) in weights.iter().zip(&trials) {
            self.covariance += &trial.step * trial.step.transpose() * (many_rate * weight);
        }
        self.width *= ((step_rate / damping) * (length / expected - 1.0)).min(1.0).exp();
    }
}

/// A draw from the normal distribution (Box and Muller).
fn gauss(dice: &mut impl Rng) -> f64 {
    let (u, v): (f64, f64) = (dice.random(), dice.random());
    (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bent_valley_is_followed() {
        let ranges = [Range { least: -5.0, greatest: 5.0, scale: 0.5 }; 2];
        let cost = |at: &[f64]| Some(100.0 * (at[1] - at[0] * at[0]).powi(2) + (1.0 - at[0]).powi(2));
        let found = evolve(&cost, &[-1.0, 1.0], &ranges, 1, 3000);
        assert!((found.at[0] - 1.0).abs() < 1e-3 && (found.at[1] - 1.0).abs() < 1e-3, "{found:?}");
    }

    #[test]
    fn ruggedness_does_not_hold_it_up() {
        let ranges = [Range { least: -20.0, greatest: 20.0, scale: 3.0 }; 3];
        let cost = |at: &[f64]| Some(at.iter().map(|x| x * x + 3.0 * (1.0 - (3.0 * x).cos())).sum());
        let found = evolve(&cost, &[4.0, -5.0, 6.0], &ranges, 3, 4000);
        assert!(found.cost < 13.0, "{found:?}");
    }

    #[test]
    fn the_same_seed_finds_the_same() {
        let ranges = [Range { least: 0.0, greatest: 1.0, scale: 0.2 }; 2];
        let find = |seed| evolve(&|at: &[f64]| Some(at[0] - at[1]), &[0.5, 0.5], &ranges, seed, 200).at;
        assert_eq!(find(7), find(7));
        assert_eq!(find(7), [0.0, 1.0]);
    }
}
