//! The noise of a level: how much of it there is, and how long it remembers.
//!
//! Noise is rarely white. What passes a filter before it is sampled is still there a few samples later: differences of neighbours
//! then show too little of it, and so many samples tell less than as many independent ones. Both are found from how differences
//! of what a law leaves grow with their lag, which for a process of first order, and a law's own error that is slow beside it, is
//!
//! ```text
//! E[(x(k+j) − x(k))²]/2 = σ²·(1 − r^j) + c·j² + q²/12
//! ```
//!
//! Source: the variogram of a process of first order with a nugget (N. A. C. Cressie, Statistics for Spatial Data, Wiley 1993,
//! section 2.3); the nugget is what rounding adds.

use super::cost;
use super::grid::{Grid, median};

/// Noise before rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Noise {
    /// Standard deviation, in the signal's unit.
    pub sigma: f64,
    /// How much of it is still in the next sample, 0 to 1.
    pub memory: f64,
    /// By how much its variance, with that of rounding, may be more than this: standard deviation as a share of it.
    pub scatter: f64,
}

/// Above this noise, in steps, differences tell it.
const HIDDEN_NOISE: f64 = 0.7;
/// How many samples an estimate of noise needs.
const ENOUGH: usize = 40;
/// How many differences over the longest lag tell how noise remembers.
const MANY: usize = 200;
/// Lags of the differences, samples.
const LAGS: [usize; 6] = [1, 2, 3, 5, 8, 13];
/// A median of so many times less is a standard deviation of normal differences; those beyond so many of them are no noise.
const DEVIATION: f64 = 1.4826;
const CLIP: f64 = 4.0;
/// How far half the mean square of differences may be from that at rest, as a factor.
const AS_AT_REST: std::ops::Range<f64> = 0.6..1.6;
/// How much of the noise's variance what is slow may grow by from one sample to the next.
const SLOW: f64 = 0.1;
/// Memories that are tried; the steps between them are about what can be told apart.
const MEMORIES: [f64; 14] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.76, 0.82, 0.87, 0.91, 0.94, 0.97];
/// The longest of them that is noise: differences that still grow over the longest lag are those of a model that wanders off.
const MOST_MEMORY: f64 = 0.92;

/// The noise of `recorded` values that lie on steps of `step`, where `predicted` says what moves.
pub(super) fn of(grid: &Grid, recorded: &[f64], predicted: &[f64], step: f64) -> Noise {
    let (white, scatter) = at_rest(grid, recorded, predicted, step);
    if white <= HIDDEN_NOISE * step {
        let (sigma, scatter) = likeliest(recorded, predicted, step);
        return Noise { sigma, memory: 0.0, scatter };
    }
    let still = if white.is_nan() { moving(recorded, predicted, step) } else { white };
    // Where what the prediction leaves differs from one sample to the next by more than it does at rest, that is a gap and no noise.
    let is_alike = |noise: &Noise| AS_AT_REST.contains(&(noise.fresh() / still.powi(2)));
    // At rest a gap stands still, however fast it comes and goes in motion.
    let resting = |from: usize, to: usize| (from + 1..=to).all(|k| is_still(predicted, step, k));
    let found =
        coloured(recorded, predicted, step, &resting).or_else(|| coloured(recorded, predicted, step, &|_, _| true));
    found.filter(is_alike).unwrap_or(Noise { sigma: still, memory: 0.0, scatter })
}

/// Whether a signal hardly moves from the sample before to the `k`th.
fn is_still(predicted: &[f64], step: f64, k: usize) -> bool {
    (predicted[k] - predicted[k - 1]).abs() < step / 3.0
}

impl Noise {
    /// Half the mean square of its differences from one sample to the next.
    fn fresh(&self) -> f64 {
        self.sigma.powi(2) * (1.0 - self.memory)
    }
}

/// Noise with a memory, from differences over several lags of what the prediction leaves between samples that `is_asked` for;
/// `None` where they are few, where it leaves more than noise and what is slow beside it, or where noise does not show.
fn coloured(recorded: &[f64], predicted: &[f64], step: f64, is_asked: &dyn Fn(usize, usize) -> bool) -> Option<Noise> {
    let rest: Vec<f64> = recorded.iter().zip(predicted).map(|(a, b)| a - b).collect();
    let apart = |lag: usize| {
        let pairs = (0..rest.len().saturating_sub(lag)).filter(|from| is_asked(*from, from + lag));
        pairs.map(|from| (rest[from + lag] - rest[from]).abs()).collect::<Vec<f64>>()
    };
    let apart = LAGS.map(apart);
    if apart.iter().any(|differences| differences.len() < MANY) {
        return None;
    }
    let fewest = apart.iter().map(Vec::len).min().unwrap_or(0);
    let grown = apart.map(|differences| {
        // What jumps is no noise. (A median of differences on a lattice is known to a step.)
        let clip = CLIP * (DEVIATION * median(&differences).unwrap_or(0.0) + 0.5 * step);
        let squares: f64 = differences.iter().map(|difference| difference.min(clip).powi(2)).sum();
        0.5 * squares / differences.len().max(1) as f64 - step * step / 12.0
    });
    // Of each memory the best variance, and the best slowness beside it.
    let fit = |memory: f64| {
        let rows = LAGS.map(|lag| [1.0 - memory.powi(lag as i32), (lag as f64).powi(2)]);
        let product = |a: &dyn Fn(usize) -> f64, b: &dyn Fn(usize) -> f64| -> f64 {
            (0..LAGS.len()).map(|k| a(k) * b(k) / grown[k].max(step * step).powi(2)).sum()
        };
        let (first, slow) = (|k: usize| rows[k][0], |k: usize| rows[k][1]);
        let seen = |k: usize| grown[k];
        let (aa, ab, bb) = (product(&first, &first), product(&first, &slow), product(&slow, &slow));
        let (ay, by) = (product(&first, &seen), product(&slow, &seen));
        let determinant = aa * bb - ab * ab;
        let both = ((ay * bb - by * ab) / determinant, (by * aa - ay * ab) / determinant);
        let (variance, slowness) = if both.1 > 0.0 && both.0 > 0.0 { both } else { ((ay / aa).max(0.0), 0.0) };
        let off = |k: usize| grown[k] - variance * first(k) - slowness * slow(k);
        (product(&off, &off), variance, slowness, memory)
    };
    let (_, variance, slowness, memory) = MEMORIES.map(fit).into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    let is_noise = variance > (HIDDEN_NOISE * step).powi(2) && slowness < SLOW * variance && memory < MOST_MEMORY;
    is_noise.then(|| Noise { sigma: variance.sqrt(), memory, scatter: scatter(fewest) })
}

/// Where a prediction rests, from one sample to the one behind its last, for at least so many samples.
fn spans(predicted: &[f64], step: f64, least: usize) -> Vec<(usize, usize)> {
    let mut spans = Vec::new();
    let mut from = 0;
    for k in 1..=predicted.len() {
        if k < predicted.len() && (predicted[k] - predicted[from]).abs() < 0.02 * step {
            continue;
        }
        if k - from >= least {
            spans.push((from, k));
        }
        from = k;
    }
    spans
}

/// By how much half the mean square of so many differences of neighbours scatters, as a share of it: with white noise each two of them that
/// share a sample have a quarter of their variance in common, so that it is 3/n.
fn scatter(differences: usize) -> f64 {
    (3.0 / differences.max(1) as f64).sqrt()
}

/// Noise where nothing moves, and its [`scatter`]: from differences of neighbours, clipped where they are no noise. NaN where nothing rests.
fn at_rest(grid: &Grid, recorded: &[f64], predicted: &[f64], step: f64) -> (f64, f64) {
    let still = |k: usize| is_still(predicted, step, k);
    let differences: Vec<f64> = (2..recorded.len())
        .filter(|&k| grid.cycle > 0.0 && still(k) && still(k - 1))
        .map(|k| (recorded[k] - recorded[k - 1]).abs())
        .collect();
    if differences.len() < ENOUGH {
        return (f64::NAN, 0.0);
    }
    let clip = 4.0 * (1.4826 * median(&differences).unwrap_or(0.0) + 0.5 * step);
    let variance = differences.iter().map(|d| d.min(clip).powi(2)).sum::<f64>() / differences.len() as f64;
    // A median of differences would be of no use on a lattice; rounding adds its own variance to each of the two.
    ((variance / 2.0 - step * step / 12.0).max(0.0).sqrt(), scatter(differences.len()))
}

/// Noise of less than a step, from how often a signal at rest leaves its step: whether it ever does hangs on where between two
/// steps it rests, which is latent, rest by rest. And by how much more its variance with that of rounding may be, standard deviation as a share
/// of it: by all greater noises that are as likely, or nearly.
fn likeliest(recorded: &[f64], predicted: &[f64], step: f64) -> (f64, f64) {
    const NOISES: [f64; 14] = [0.0, 0.03, 0.06, 0.09, 0.12, 0.16, 0.2, 0.25, 0.3, 0.37, 0.45, 0.55, 0.7, 0.9];
    const PLACES: i32 = 24;
    /// How likely it is beforehand that it rests where it is predicted to.
    const FORESEEN: f64 = 0.75;
    let rests = rests(recorded, predicted, step);
    let likelihood = |noise: f64| -> f64 {
        let of = |Rest { counts, place }: &Rest| {
            let at = |value: f64| {
                let chance = |seen: f64| {
                    let noise = noise.max(1e-3);
                    cost::normal((seen + 0.5 - value) / noise) - cost::normal((seen - 0.5 - value) / noise)
                };
                counts.iter().map(|(seen, count)| count * chance(*seen).max(1e-12).ln()).sum::<f64>()
            };
            // The counts are of steps above the rest's own most frequent one: the place may be beside it.
            let places =
                (-PLACES / 2..PLACES + PLACES / 2).map(|place| (f64::from(place) + 0.5) / f64::from(PLACES) - 0.5);
            let each: Vec<(f64, f64)> = places.map(|place| (at(place), (1.0 - FORESEEN) / f64::from(PLACES))).collect();
            let foreseen = (at(*place), FORESEEN);
            let all = || each.iter().chain([&foreseen]);
            let most = all().map(|(likely, _)| *likely).fold(f64::NEG_INFINITY, f64::max);
            most + all().map(|(likely, weight)| weight * (likely - most).exp()).sum::<f64>().ln()
        };
        rests.iter().map(of).sum()
    };
    let each = NOISES.map(|noise| (likelihood(noise), noise));
    let (most, best) =
        each.into_iter().fold((f64::NEG_INFINITY, 0.0), |best, next| if next.0 > best.0 { next } else { best });
    let variance = |noise: f64| noise * noise + 1.0 / 12.0;
    let greater = each.into_iter().filter(|(_, noise)| *noise >= best);
    let (whole, off) = greater.fold((0.0, 0.0), |(whole, off), (likely, noise)| {
        let weight = (likely - most).exp();
        (whole + weight, off + weight * (variance(noise) / variance(best) - 1.0).powi(2))
    });
    (best * step, (off / whole).sqrt())
}

/// What was recorded while a machine rested.
struct Rest {
    /// How often each value, in steps from the most frequent.
    counts: Vec<(f64, f64)>,
    /// Where the prediction rests, by the same measure.
    place: f64,
}

fn rests(recorded: &[f64], predicted: &[f64], step: f64) -> Vec<Rest> {
    const LEAST: usize = 8;
    let counts = |(from, to): (usize, usize)| {
        let mut counts: Vec<(f64, f64)> = Vec::new();
        for value in &recorded[from..to] {
            let steps = ((value - recorded[from]) / step).round();
            match counts.iter_mut().find(|(seen, _)| *seen == steps) {
                Some((_, count)) => *count += 1.0,
                None => counts.push((steps, 1.0)),
            }
        }
        let most = counts.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0.0, |(seen, _)| *seen);
        counts.iter_mut().for_each(|(seen, _)| *seen -= most);
        Rest { counts, place: (predicted[from] - recorded[from]) / step - most }
    };
    spans(predicted, step, LEAST).into_iter().map(counts).collect()
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

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};

    use super::*;

    /// Noise of first order about a motion that rests now and then, rounded.
    #[test]
    fn noise_that_remembers_is_found_with_its_memory() {
        let mut dice = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let mut normal = || (0..12).map(|_| dice.random::<f64>()).sum::<f64>() - 6.0;
        for (sigma, memory) in [(2.0, 0.0), (1.5, 0.5), (3.0, 0.82)] {
            let predicted: Vec<f64> = (0..6000).map(|k| 40.0 * f64::from((k / 300) % 2 * (k % 300))).collect();
            let mut noise = 0.0;
            let recorded: Vec<f64> = predicted
                .iter()
                .map(|value| {
                    noise = memory * noise + (1.0_f64 - memory * memory).sqrt() * sigma * normal();
                    (value + noise).round()
                })
                .collect();
            let found = of(&Grid::of_steps(0.01, 59.99), &recorded, &predicted, 1.0);
            assert!((found.sigma / sigma - 1.0).abs() < 0.12, "{found:?} for {sigma} {memory}");
            assert!((found.memory - memory).abs() < 0.11, "{found:?} for {sigma} {memory}");
        }
    }

    /// A signal that rests on a step of its lattice leaves it the more often the more noise it has: 0.3 steps, two times in 21.
    #[test]
    fn noise_below_a_step_is_found_where_the_law_says_that_it_rests() {
        let mut dice = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut normal = || (0..12).map(|_| dice.random::<f64>()).sum::<f64>() - 6.0;
        let predicted: Vec<f64> = (0..1200).map(|k| f64::from(50 * (k / 100))).collect();
        let recorded: Vec<f64> = predicted.iter().map(|value| (value + 0.3 * normal()).round()).collect();
        let found = of(&Grid::of_steps(0.01, 11.99), &recorded, &predicted, 1.0);
        assert!((found.sigma - 0.3).abs() < 0.04, "{found:?}");
    }

    /// Of sixty samples at rest nobody knows the noise to a few per cent.
    #[test]
    fn how_uncertain_noise_is_hangs_on_how_many_samples_tell_it() {
        let mut dice = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        let mut normal = || (0..12).map(|_| dice.random::<f64>()).sum::<f64>() - 6.0;
        for sigma in [0.3, 3.0] {
            let [few, many] = [60, 3000].map(|count| {
                let predicted: Vec<f64> = (0..count).map(|k| f64::from(50 * (k / 20))).collect();
                let recorded: Vec<f64> = predicted.iter().map(|value| (value + sigma * normal()).round()).collect();
                of(&Grid::of_steps(0.01, 0.01 * f64::from(count - 1)), &recorded, &predicted, 1.0).scatter
            });
            assert!(few > 0.15 && many < 0.07 && many > 0.0, "{few} {many} of {sigma}");
        }
    }
}
