//! How far a signal may be off where nothing is wrong: rounding, noise, and the uncertainty of its instants.

use super::cost;
use super::grid::{Grid, median};

/// The floor of a level in one recording, found in the recording itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Floor {
    /// What values are rounded to, SI: the smallest step between two of them.
    pub step: f64,
    /// Noise before rounding, standard deviation, SI; 0 where none shows.
    pub noise: f64,
    /// How far an instant may be off, standard deviation, s.
    pub timing: f64,
    /// How far even a good model is off, standard deviation, SI: of a device that is taken up again and again, whose errors
    /// grow from one time to the next. It belongs to the cost, not to the floor. 0 of every other.
    pub reach: f64,
    /// How far a law that is not all of the truth stays off where nothing else is wrong, standard deviation, SI: 0 of a law
    /// that explains the recording. Part of what a fit weighs differences by, and of no figure that is reported.
    pub misfit: f64,
}

/// Of a step, how much of it is taken for noise at least: far less does not show.
const LEAST_NOISE: f64 = 0.2;
/// Of a signal's range, what nothing is claimed about.
const RESOLUTION: f64 = 1e-6;
/// From which noise on, in steps, samples differ where nothing moves.
const SHOWN_NOISE: f64 = 0.1;
/// Above this noise, in steps, differences of neighbours tell it.
const HIDDEN_NOISE: f64 = 0.7;
/// How many samples an estimate of noise needs.
const ENOUGH: usize = 40;

impl Floor {
    /// The standard deviation that a cost is computed with, where the signal changes by `slope` in a second.
    pub fn sigma(&self, slope: f64) -> f64 {
        let noise = self.noise.max(LEAST_NOISE * self.step);
        let law = self.reach.hypot(self.misfit);
        (noise * noise + (slope * self.timing).powi(2) + law * law).sqrt()
    }

    /// The root mean square of the difference where nothing is wrong and the signal moves with `slope`, SI.
    pub fn rms(&self, slope: f64) -> f64 {
        (self.noise * self.noise + self.step * self.step / 12.0 + (slope * self.timing).powi(2)).sqrt()
    }

    /// Whether neighbouring samples are off independently of each other. Without noise a rest, and whatever moves by whole
    /// steps, repeats one rounding error.
    pub fn shows_noise(&self) -> bool {
        self.noise > SHOWN_NOISE * self.step
    }

    /// What a sample costs where nothing is wrong. Noise that does not show at rest may be there in motion.
    pub fn costs(&self) -> FloorCosts {
        let sigma = self.sigma(0.0);
        FloorCosts::new((self.noise / self.step).max(LEAST_NOISE), sigma / self.step)
    }

    /// The floor of a recorded level that was predicted to be `predicted`, sample by sample.
    pub fn of(grid: &Grid, recorded: &[f64], predicted: &[f64], timing: f64, is_count: bool) -> Floor {
        let step = if is_count { 1.0 } else { step_of(recorded) };
        if is_count {
            return Floor { step, timing, ..Floor::default() };
        }
        let still = at_rest(grid, recorded, predicted, step);
        let noise = if still.is_nan() { moving(recorded, predicted, step) } else { still };
        Floor { step, noise, timing, ..Floor::default() }
    }
}

/// Mean and variance of the cost of a sample where nothing is wrong, by where the true value lies between two steps: at rest it
/// lies at one place for long, and there the cost may be twice what it is on the average of all places.
#[derive(Clone, Debug)]
pub struct FloorCosts {
    by_place: Vec<(f64, f64)>,
}

impl FloorCosts {
    const PLACES: u32 = 32;

    /// Of a `noise` evaluated with `sigma`, both in steps.
    fn new(noise: f64, sigma: f64) -> FloorCosts {
        let reach = (6.0 * noise + 1.0).ceil() as i32;
        let at = |place: u32| {
            let value = (f64::from(place) + 0.5) / f64::from(Self::PLACES) - 0.5;
            let (mut mean, mut square) = (0.0, 0.0);
            for seen in -reach..=reach {
                let seen = f64::from(seen);
                let share = cost::normal((seen + 0.5 - value) / noise) - cost::normal((seen - 0.5 - value) / noise);
                let cost = cost::level(seen, value, 1.0, sigma);
                mean += share * cost;
                square += share * cost * cost;
            }
            (mean, (square - mean * mean).max(1e-6))
        };
        FloorCosts { by_place: (0..Self::PLACES).map(at).collect() }
    }

    /// For a true value that lies `steps` steps from a value that can be recorded.
    pub fn at(&self, steps: f64) -> (f64, f64) {
        let place = (steps - steps.round() + 0.5) * f64::from(Self::PLACES);
        self.by_place[(place as usize).min(self.by_place.len() - 1)]
    }
}

/// The lattice that values lie on: the smallest step between two distinct ones, at least a millionth of their range.
pub(super) fn step_of(values: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let (Some(least), Some(most)) = (sorted.first(), sorted.last()) else { return RESOLUTION };
    let range = (most - least).max(most.abs()).max(least.abs());
    let same = (RESOLUTION * range).max(1e-12);
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > same);
    steps.fold(f64::INFINITY, f64::min).min(range.max(1e-9)).max(same)
}

/// Noise where nothing moves: from differences of neighbours, clipped where they are no noise. NaN where nothing rests.
fn at_rest(grid: &Grid, recorded: &[f64], predicted: &[f64], step: f64) -> f64 {
    let still = |k: usize| (predicted[k] - predicted[k - 1]).abs() < step / 3.0;
    let differences: Vec<f64> = (2..recorded.len())
        .filter(|&k| grid.cycle > 0.0 && still(k) && still(k - 1))
        .map(|k| (recorded[k] - recorded[k - 1]).abs())
        .collect();
    if differences.len() < ENOUGH {
        return f64::NAN;
    }
    let clip = 4.0 * (1.4826 * median(&differences).unwrap_or(0.0) + 0.5 * step);
    let variance = differences.iter().map(|d| d.min(clip).powi(2)).sum::<f64>() / differences.len() as f64;
    // A median of differences would be of no use on a lattice; rounding adds its own variance to each of the two.
    let noise = (variance / 2.0 - step * step / 12.0).max(0.0).sqrt();
    if noise > HIDDEN_NOISE * step { noise } else { likeliest(recorded, predicted, step) }
}

/// Noise of less than a step, from how often a signal at rest leaves its step: whether it ever does hangs on where between two
/// steps it rests, which is latent, rest by rest.
fn likeliest(recorded: &[f64], predicted: &[f64], step: f64) -> f64 {
    const NOISES: [f64; 14] = [0.0, 0.03, 0.06, 0.09, 0.12, 0.16, 0.2, 0.25, 0.3, 0.37, 0.45, 0.55, 0.7, 0.9];
    const PLACES: i32 = 24;
    let rests = rests(recorded, predicted, step);
    let likelihood = |noise: f64| -> f64 {
        let of = |counts: &Vec<(f64, f64)>| {
            let at = |place: i32| {
                let value = (f64::from(place) + 0.5) / f64::from(PLACES) - 0.5;
                let chance = |seen: f64| {
                    let noise = noise.max(1e-3);
                    cost::normal((seen + 0.5 - value) / noise) - cost::normal((seen - 0.5 - value) / noise)
                };
                counts.iter().map(|(seen, count)| count * chance(*seen).max(1e-12).ln()).sum::<f64>()
            };
            // The counts are of steps above the rest's own most frequent one: the place may be beside it.
            let each: Vec<f64> = (-PLACES / 2..PLACES + PLACES / 2).map(at).collect();
            let most = each.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            most + (each.iter().map(|each| (each - most).exp()).sum::<f64>() / f64::from(PLACES)).ln()
        };
        rests.iter().map(of).sum()
    };
    let best = NOISES.into_iter().max_by(|a, b| likelihood(*a).total_cmp(&likelihood(*b)));
    best.unwrap_or(0.0) * step
}

/// How often each value was recorded in each rest, the values in steps from the most frequent.
fn rests(recorded: &[f64], predicted: &[f64], step: f64) -> Vec<Vec<(f64, f64)>> {
    const LEAST: usize = 8;
    let mut rests = Vec::new();
    let mut from = 0;
    for k in 1..=recorded.len() {
        if k < recorded.len() && (predicted[k] - predicted[from]).abs() < 0.02 * step {
            continue;
        }
        if k - from >= LEAST {
            let mut counts: Vec<(f64, f64)> = Vec::new();
            for value in &recorded[from..k] {
                let steps = ((value - recorded[from]) / step).round();
                match counts.iter_mut().find(|(seen, _)| *seen == steps) {
                    Some((_, count)) => *count += 1.0,
                    None => counts.push((steps, 1.0)),
                }
            }
            let most = counts.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0.0, |(seen, _)| *seen);
            counts.iter_mut().for_each(|(seen, _)| *seen -= most);
            rests.push(counts);
        }
        from = k;
    }
    rests
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
