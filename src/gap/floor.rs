//! How far a signal may be off where nothing is wrong: rounding, noise, and the uncertainty of its instants.

use super::cost;
use super::grid::{Grid, median};

/// The floor of a level in one recording, found in the recording itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// What values are rounded to, SI: the smallest step between two of them.
    pub step: f64,
    /// Noise before rounding, standard deviation, SI; 0 where none shows.
    pub noise: f64,
    /// How far an instant may be off, standard deviation, s.
    pub timing: f64,
}

/// Of a step, how much of it is taken for noise at least: far less does not show.
const LEAST_NOISE: f64 = 0.2;
/// Of a signal's range, what nothing is claimed about.
const RESOLUTION: f64 = 1e-6;
/// How many samples an estimate of noise needs.
const ENOUGH: usize = 40;

impl Floor {
    /// The standard deviation that a cost is computed with, where the signal changes by `slope` in a second.
    pub fn sigma(&self, slope: f64) -> f64 {
        let noise = self.noise.max(LEAST_NOISE * self.step);
        (noise * noise + (slope * self.timing).powi(2)).sqrt()
    }

    /// The root mean square of the difference where nothing is wrong and the signal moves with `slope`, SI.
    pub fn rms(&self, slope: f64) -> f64 {
        (self.noise * self.noise + self.step * self.step / 12.0 + (slope * self.timing).powi(2)).sqrt()
    }

    /// Mean and variance of the cost of a sample where nothing is wrong: noise as found, rounded to the step, its true value
    /// anywhere within one.
    pub fn cost(&self) -> (f64, f64) {
        const PLACES: i32 = 16;
        let sigma = self.sigma(0.0);
        // In units of the step.
        let (noise, sigma) = ((self.noise / self.step).max(1e-3), sigma / self.step);
        let (mut mean, mut square) = (0.0, 0.0);
        for place in 0..PLACES {
            let value = (f64::from(place) + 0.5) / f64::from(PLACES) - 0.5;
            let reach = (6.0 * noise + 1.0).ceil() as i32;
            for seen in -reach..=reach {
                let seen = f64::from(seen);
                let share = cost::normal((seen + 0.5 - value) / noise) - cost::normal((seen - 0.5 - value) / noise);
                let cost = cost::level(seen, value, 1.0, sigma);
                mean += share * cost / f64::from(PLACES);
                square += share * cost * cost / f64::from(PLACES);
            }
        }
        (mean, (square - mean * mean).max(1e-6))
    }

    /// The floor of a recorded level that was predicted to be `predicted`, sample by sample.
    pub fn of(grid: &Grid, recorded: &[f64], predicted: &[f64], timing: f64, is_count: bool) -> Floor {
        let step = if is_count { 1.0 } else { step_of(recorded) };
        if is_count {
            return Floor { step, noise: 0.0, timing };
        }
        let noise = at_rest(grid, recorded, predicted, step).max(moving(recorded, predicted, step));
        Floor { step, noise, timing }
    }
}

/// The lattice that values lie on: the smallest step between two distinct ones, at least a millionth of their range.
fn step_of(values: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let (Some(least), Some(most)) = (sorted.first(), sorted.last()) else { return RESOLUTION };
    let range = (most - least).max(most.abs()).max(least.abs());
    let same = (RESOLUTION * range).max(1e-12);
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > same);
    steps.fold(f64::INFINITY, f64::min).min(range.max(1e-9)).max(same)
}

/// Noise where nothing moves: from differences of neighbours, clipped where they are no noise.
fn at_rest(grid: &Grid, recorded: &[f64], predicted: &[f64], step: f64) -> f64 {
    let still = |k: usize| (predicted[k] - predicted[k - 1]).abs() < step / 3.0;
    let differences: Vec<f64> = (2..recorded.len())
        .filter(|&k| grid.cycle > 0.0 && still(k) && still(k - 1))
        .map(|k| (recorded[k] - recorded[k - 1]).abs())
        .collect();
    if differences.len() < ENOUGH {
        return 0.0;
    }
    let clip = 4.0 * (1.4826 * median(&differences).unwrap_or(0.0) + 0.5 * step);
    let variance = differences.iter().map(|d| d.min(clip).powi(2)).sum::<f64>() / differences.len() as f64;
    // A median of differences would be of no use on a lattice; rounding adds its own variance to each of the two.
    (variance / 2.0 - step * step / 12.0).max(0.0).sqrt()
}

/// Noise where it moves: third differences of what is left, in which nothing smooth remains.
fn moving(recorded: &[f64], predicted: &[f64], step: f64) -> f64 {
    let rest: Vec<f64> = recorded.iter().zip(predicted).map(|(a, b)| a - b).collect();
    let moves = |k: usize| (predicted[k] - predicted[k - 1]).abs() >= step;
    let thirds: Vec<f64> = (3..rest.len())
        .filter(|&k| (k - 2..=k).all(moves))
        .map(|k| (rest[k] - 3.0 * rest[k - 1] + 3.0 * rest[k - 2] - rest[k - 3]).abs())
        .collect();
    if thirds.len() < 5 * ENOUGH {
        return 0.0;
    }
    let deviation = 1.4826 * median(&thirds).unwrap_or(0.0);
    // 1 + 9 + 9 + 1: the squares of the weights.
    (deviation * deviation / 20.0 - step * step / 12.0).max(0.0).sqrt()
}
