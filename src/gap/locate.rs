//! Which devices part from the machine by themselves, and which only pass on what came to them.
//!
//! A device has a gap of its own if what it predicts alone, driven by the recorded commands and by what its neighbours
//! reported, is not what it reported. Five questions are asked of each of its signals, each with a threshold that the
//! greatest of 400 chances would pass once in a hundred times (χ² with one degree of freedom: 17.8):
//!
//! - Is the cost above its floor, by more than the floor itself is uncertain?
//! - Does what is left go with the motion: with the value, its slope, the sign of that, its curvature, the time, the way gone?
//!   A level that is off by a tenth of its noise shows so, though its cost does not.
//! - Do a few samples in a row cost far more than as many do elsewhere? What happens once or twice is nothing among thousands of samples.
//! - Does what is left remember itself for longer than noise does? What lies within the noise for seconds shows in no sample, and in their sums.
//! - Do more edges lie outside of their cycles than strays would?
//!
//! What differs in a replay of the whole plant and not alone is inherited.

use serde::Serialize;

use super::floor::{FLOOR_UNCERTAINTY, Floor};
use super::prediction::{Predicted, Prediction};
use super::regimes::regimes;
use super::report::Regime;
use super::score::{LevelScore, Score, SignalScore};
use super::study::Study;
use super::subject::Subject;
use super::track::Track;
use crate::replay::Report;
use crate::signal_map::Kind;

/// A statistic above this is no chance: χ² with one degree of freedom at 1 % over 400 tests.
pub const THRESHOLD: f64 = 17.8;
/// How far beyond chance a gap is one though it is less than noise and rounding are, where it goes with the motion.
pub const FAR_BEYOND: f64 = 5.0;
/// How many samples in a row are looked at for whether they stand out.
const ROWS: [usize; 3] = [4, 8, 16];
/// By how many standard deviations of what so many samples cost a row must stand out. (Of 789 levels of devices with which nothing was wrong the
/// costliest row of one did by 14.4, that of another by 10.7, and those of all others by less than 8.)
const STANDS_OUT: f64 = 16.0;
/// Over how many samples what is left is summed to see whether it remembers itself.
const SUMMED: [usize; 2] = [16, 32];
/// What a sample counts at most in such a sum, in standard deviations: one that is far off is none that remembers.
const CLIPPED: f64 = 3.0;
/// How many times more such sums may scatter than noise of the memory that was found has it, which rounding hides a part of; and by how many standard
/// deviations more than that they must. (Of 430 levels of devices with which nothing was wrong the sums of four scattered by more than twice as much, at
/// most by 2.4 times.)
const MAY_SCATTER: f64 = 2.5;
const REMEMBERS: f64 = 5.0;
/// How far what a level costs that shows no noise may be from what its rounding does, standard deviation as a share of it; and of how many samples. (Of 555
/// levels of 55 machines with nothing wrong and no noise half cost from 0.51 to 0.54 of the floor, and none more than 0.6.)
const ROUNDED: f64 = 0.04;
const LEAST_ROUNDED: f64 = 100.0;
/// What moves by less than this share of a step says nothing of a device.
const LEAST_OF_STEP: f64 = 0.1;

/// Where the gaps are.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Location {
    /// All devices that were compared: those with a gap of their own first, the largest share first; then by name.
    pub devices: Vec<Located>,
}

/// What is known of one device.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Located {
    pub device: String,
    /// Whether it has a gap of its own.
    pub own: bool,
    /// Whether it differs in a replay of the whole plant and not alone; `None` until a replay was looked at.
    pub inherited: Option<bool>,
    /// Its part of all own gaps, 0 to 1; 0 without one.
    pub share: f64,
    /// The greatest of its statistics, which a chance keeps below [`THRESHOLD`].
    pub evidence: f64,
    pub signals: Vec<LocatedSignal>,
    /// In which regimes its gap lies; empty without a gap of its own.
    pub regimes: Vec<Regime>,
}

/// How far a device's report is off.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LocatedSignal {
    pub name: String,
    /// `level` or `edge`.
    pub kind: &'static str,
    /// The SI unit of a level, `s` of an edge.
    pub unit: String,
    /// How many samples or edges were compared, in all recordings.
    pub compared: usize,
    /// RMS of the difference in `unit`; of an edge, of how far it lies outside of the cycle that showed it.
    pub before: f64,
    /// What that would be where nothing is wrong.
    pub floor: f64,
    /// Recorded edges that the model does not make, and those that it alone makes.
    pub missing: usize,
    pub extra: usize,
    pub evidence: f64,
    /// Its squared gap above the floor, in floors; what shares are made of.
    pub excess: f64,
}

impl LocatedSignal {
    /// Whether it is no chance.
    pub fn is_off(&self) -> bool {
        self.evidence > THRESHOLD
    }
}

impl Location {
    /// Looks at a replay of the whole plant: a device whose edges differ there and that has no gap of its own inherits one.
    /// (Levels are the drives' own: what a drive reports comes from nobody else.)
    pub fn inherit(&mut self, replay: &Report) {
        let differing: Vec<&str> =
            replay.edges.iter().filter(|edge| edge.differs).map(|edge| edge.name.as_str()).collect();
        for device in &mut self.devices {
            let differs = device.signals.iter().any(|signal| differing.contains(&signal.name.as_str()));
            device.inherited = Some(differs && !device.own);
        }
    }
}

/// Looks where the gaps are.
pub fn locate(study: &Study) -> Location {
    let scores = study.scores();
    let each = study.subjects.iter().zip(&study.bare).zip(&scores);
    let mut devices: Vec<Located> =
        each.map(|((subject, bare), score)| located(subject, &bare.prediction, score)).collect();
    let excess = |device: &Located| device.signals.iter().map(|signal| signal.excess).sum::<f64>();
    let total: f64 = devices.iter().filter(|device| device.own).map(excess).sum();
    for device in devices.iter_mut().filter(|device| device.own) {
        device.share = if total > 0.0 { excess(device) / total } else { 0.0 };
    }
    devices.sort_by(|a, b| b.own.cmp(&a.own).then(b.share.total_cmp(&a.share)).then(a.device.cmp(&b.device)));
    Location { devices }
}

/// The greatest of a device's statistics under a prediction, which a chance keeps below [`THRESHOLD`].
pub fn evidence(subject: &Subject, prediction: &Prediction) -> f64 {
    let score = subject.score(prediction);
    signals(subject, prediction, &score).iter().map(|signal| signal.evidence).fold(0.0, f64::max)
}

/// The same of what is left beside an effect, all along: a law that is not all of the truth is off for a moment here and there.
pub fn evidence_all_along(subject: &Subject, prediction: &Prediction) -> f64 {
    let score = subject.score(prediction);
    score.signals.iter().map(|signal| all_along(subject, prediction, signal)).fold(0.0, f64::max)
}

/// That of each of its signals, in the order of [`Subject::signals`]; 0 of one that is not in the recordings.
pub(super) fn evidences(subject: &Subject, prediction: &Prediction) -> Vec<f64> {
    let located = signals(subject, prediction, &subject.score(prediction));
    let of = |name: &str| located.iter().find(|signal| signal.name == name).map_or(0.0, |signal| signal.evidence);
    subject.signals.iter().map(|info| of(&info.name)).collect()
}

/// That of one of its signals.
pub(super) fn evidence_of(place: usize, subject: &Subject, prediction: &Prediction) -> f64 {
    evidences(subject, prediction)[place]
}

/// Whether a level is off that a device reports.
pub(super) fn are_levels_off(subject: &Subject, prediction: &Prediction) -> bool {
    let score = subject.score(prediction);
    signals(subject, prediction, &score).iter().any(|signal| signal.kind == "level" && signal.is_off())
}

fn signals(subject: &Subject, nominal: &Prediction, score: &Score) -> Vec<LocatedSignal> {
    let of = |place: usize| {
        let of: Vec<&SignalScore> = score.signals.iter().filter(|signal| signal.signal == place).collect();
        (!of.is_empty()).then(|| signal(subject, nominal, place, &of))
    };
    (0..subject.signals.len()).filter_map(of).collect()
}

fn located(subject: &Subject, nominal: &Prediction, score: &Score) -> Located {
    let signals = signals(subject, nominal, score);
    let evidence = signals.iter().map(|signal| signal.evidence).fold(0.0, f64::max);
    let own = evidence > THRESHOLD;
    let regimes = if own { regimes(subject, nominal, score) } else { Vec::new() };
    Located { device: subject.name.clone(), own, inherited: None, share: 0.0, evidence, signals, regimes }
}

fn signal(subject: &Subject, nominal: &Prediction, place: usize, scores: &[&SignalScore]) -> LocatedSignal {
    let info = &subject.signals[place];
    let compared = |score: &SignalScore| score.level.as_ref().map_or(score.edges.len(), |level| level.at.len());
    let total: usize = scores.iter().map(|score| compared(score)).sum();
    let mean = |of: fn(&SignalScore) -> f64| {
        let sum: f64 = scores.iter().map(|score| of(score).powi(2) * compared(score) as f64).sum();
        (sum / total.max(1) as f64).sqrt()
    };
    let (before, floor) = (mean(|score| score.rms), mean(|score| score.floor));
    let evidence = |score: &&SignalScore| {
        let of_samples = Beside::of(subject, nominal, score)
            .map_or(0.0, |beside| in_a_row(&beside, score.floor_cost).max(remembered(&beside)));
        all_along(subject, nominal, score).max(of_samples)
    };
    let evidence = scores.iter().map(evidence).fold(0.0, f64::max);
    let (missing, extra) = scores.iter().fold((0, 0), |(m, e), score| (m + score.missing(), e + score.extra()));
    let alone = (missing + extra) as f64 / total.max(1) as f64;
    let width = scores.iter().map(|score| cycle(subject, place, score)).fold(1e-6, f64::max) / 12.0_f64.sqrt();
    let excess = match info.kind {
        Kind::Level => (before / floor.max(f64::MIN_POSITIVE)).powi(2) - 1.0,
        // An edge alone is as far off as one by ten cycles.
        Kind::Edge => (before / width).powi(2) + alone * 1200.0,
    };
    LocatedSignal {
        name: info.name.clone(),
        kind: if info.kind == Kind::Level { "level" } else { "edge" },
        unit: if info.kind == Kind::Level { info.unit.clone() } else { "s".to_owned() },
        compared: total,
        before,
        floor,
        missing,
        extra,
        evidence,
        excess: if evidence > THRESHOLD { excess.max(0.0) } else { 0.0 },
    }
}

fn cycle(subject: &Subject, place: usize, score: &SignalScore) -> f64 {
    subject.runs[score.run].tracks[place].as_ref().map_or(0.0, |track| track.grid.cycle)
}

/// How far the cost is above its floor: for a level as the square of a normal deviate, for edges as a deviance.
fn above_floor(score: &SignalScore) -> f64 {
    let (mean, variance) = score.floor_cost;
    let above = score.cost - mean;
    if above <= THRESHOLD {
        return above.max(0.0);
    }
    match score.level {
        None => above,
        Some(_) => above * above / (variance + (FLOOR_UNCERTAINTY * mean).powi(2)).max(1.0),
    }
}

/// By how much its cost is above its floor, or goes with the motion.
fn all_along(subject: &Subject, prediction: &Prediction, score: &SignalScore) -> f64 {
    above_floor(score).max(with_motion(subject, prediction, score).evidence)
}

/// A level with its track and what was predicted of it, sample beside sample.
struct Beside<'a> {
    level: &'a LevelScore,
    track: &'a Track,
    predicted: &'a [f64],
    floor: Floor,
}

impl<'a> Beside<'a> {
    /// `None` of edges, and of a recording with blind spans: there samples are left out, and nobody knows what the last before a span was of.
    fn of(subject: &'a Subject, prediction: &'a Prediction, score: &'a SignalScore) -> Option<Beside<'a>> {
        let run = &subject.runs[score.run];
        let (level, track) = (score.level.as_ref()?, run.tracks[score.signal].as_ref()?);
        let Predicted::Level(predicted) = &prediction.runs[score.run][score.signal] else { return None };
        let is_whole = [track.values.len(), predicted.len()] == [level.at.len(); 2];
        is_whole.then_some(Beside { level, track, predicted, floor: run.floors[score.signal] })
    }
}

/// By how much the samples of the costliest row stand out, as a statistic that a chance keeps below [`THRESHOLD`]. Behind the last change of a level its
/// reports may have ended, sooner than the recording did.
fn in_a_row(beside: &Beside<'_>, floor_cost: (f64, f64)) -> f64 {
    let Beside { level, track, .. } = beside;
    let changes = track.values.windows(2).rposition(|pair| pair[0] != pair[1]);
    let told = changes.map_or(0, |at| at + 2);
    stands_out(&level.cost[..told], counted(&level.cost), floor_cost)
}

/// The same of `costs`; `floor` is what so many as are `counted` cost where nothing is wrong, and the variance of it.
fn stands_out(costs: &[f64], counted: f64, floor: (f64, f64)) -> f64 {
    let (mean, variance) = (floor.0 / counted.max(1.0), floor.1 / counted.max(1.0));
    let by = |row: usize| {
        let most = costs.windows(row).map(|costs| costs.iter().sum::<f64>()).fold(0.0, f64::max);
        (most - row as f64 * mean) / (row as f64 * variance).sqrt()
    };
    let most = ROWS.into_iter().map(by).fold(0.0, f64::max);
    if most.is_finite() { THRESHOLD * (most / STANDS_OUT).powi(2) } else { 0.0 }
}

/// By how much a level that shows no noise costs more than its rounding does. Its floor is as high as if noise of a fifth of a step hid in it.
#[derive(Clone, Copy, Debug, Default)]
struct Unrounded {
    /// In deviance.
    excess: f64,
    /// As a statistic that a chance keeps below [`THRESHOLD`].
    evidence: f64,
}

impl Unrounded {
    /// Of what so many as are `counted` cost; `floor_cost` is what they do by their floor, and the variance of it.
    fn of(cost: f64, counted: f64, floor: &Floor, floor_cost: (f64, f64)) -> Unrounded {
        if floor.shows_noise() || floor.misfit > 0.0 || floor.reach > 0.0 || counted < LEAST_ROUNDED {
            return Unrounded::default();
        }
        let share = floor.share_of_rounding();
        let (mean, variance) = (share * floor_cost.0, share * share * floor_cost.1);
        let unsure = variance + mean * mean * (ROUNDED.powi(2) + floor.uncertainty.powi(2));
        let excess = (cost - mean).max(0.0);
        Unrounded { excess, evidence: excess * excess / unsure }
    }

    fn of_level(beside: &Beside<'_>, score: &SignalScore) -> Unrounded {
        Unrounded::of(score.cost, counted(&beside.level.cost), &beside.floor, score.floor_cost)
    }
}

/// What the levels that show no noise cost more than their rounding, where it is no chance. It is no gap by itself: what rests in the middle of a step hides noise
/// that shows in motion.
pub(super) fn beyond_rounding(subject: &Subject, prediction: &Prediction) -> f64 {
    let score = subject.score(prediction);
    let each = score.signals.iter().filter_map(|score| {
        let unrounded = Unrounded::of_level(&Beside::of(subject, prediction, score)?, score);
        (unrounded.evidence > THRESHOLD).then_some(unrounded.excess)
    });
    each.sum()
}

/// How much longer what is left remembers itself than noise does, as a statistic that a chance keeps below [`THRESHOLD`].
///
/// Sums of w samples of a noise with memory r scatter with w·σ²·(1 + r)/(1 − r), so that the squares of n of them, in units of that, are χ² with n degrees
/// of freedom. σ is that of the samples themselves, whatever the floor is thought to be.
fn remembered(beside: &Beside<'_>) -> f64 {
    let Beside { level, predicted, floor, .. } = beside;
    // What shows no noise repeats its rounding.
    if !floor.shows_noise() {
        return 0.0;
    }
    let slopes = slopes(&level.at, predicted);
    let off = level.difference.iter().zip(&slopes).map(|(off, slope)| off / floor.rms(*slope));
    remembers(&off.map(|off| off.clamp(-CLIPPED, CLIPPED)).collect::<Vec<f64>>(), *floor)
}

/// The same of how far samples are off in units of their floor.
fn remembers(off: &[f64], floor: Floor) -> f64 {
    let square = off.iter().map(|off| off * off).sum::<f64>() / off.len().max(1) as f64;
    let by = |summed: usize| {
        let unit = MAY_SCATTER * square * summed as f64 / floor.share();
        let (squares, count) = off.chunks_exact(summed).fold((0.0, 0.0), |(squares, count), samples| {
            (squares + samples.iter().sum::<f64>().powi(2) / unit.max(f64::MIN_POSITIVE), count + 1.0)
        });
        (squares - count) / f64::max(2.0 * count, 1.0).sqrt()
    };
    let most = SUMMED.into_iter().map(by).fold(0.0, f64::max);
    THRESHOLD * (most / REMEMBERS).powi(2)
}

/// What goes with the motion in one signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Along {
    /// What of the cost a multiple of the best regressor would take away.
    gain: f64,
    /// The same as a statistic that a chance keeps below [`THRESHOLD`].
    evidence: f64,
}

/// What of each signal's cost surely goes with the motion, in the order of `score`'s: what a multiple of it would take away, 0 where
/// that is not far beyond chance. A floor that is estimated a few per cent too high hides so much from the cost alone.
pub fn gains_with_motion(subject: &Subject, prediction: &Prediction, score: &Score) -> Vec<f64> {
    let of = |score: &SignalScore| {
        let along = with_motion(subject, prediction, score);
        if along.evidence > FAR_BEYOND * THRESHOLD { along.gain } else { 0.0 }
    };
    score.signals.iter().map(of).collect()
}

/// The greatest gain by one regressor of the motion.
fn with_motion(subject: &Subject, prediction: &Prediction, score: &SignalScore) -> Along {
    Beside::of(subject, prediction, score).map_or_else(Along::default, |beside| along(&beside, score.floor_cost))
}

fn along(beside: &Beside<'_>, floor_cost: (f64, f64)) -> Along {
    let Beside { level, predicted, floor, .. } = beside;
    let count = level.residual.len();
    if count < 50 {
        return Along::default();
    }
    // Noise that remembers goes further with a motion than it looks: each sample counts less, and their sum scatters more.
    let unit = (floor_cost.0 / counted(level.cost.as_slice()).max(1.0) / floor.share()).max(0.02);
    let gain = |regressor: &[f64]| {
        let mean = regressor.iter().sum::<f64>() / count as f64;
        let pairs = || regressor.iter().zip(&level.residual).map(|(x, r)| (x - mean, *r));
        let (xx, xr) = pairs().fold((0.0, 0.0), |(xx, xr), (x, r)| (xx + x * x, xr + x * r));
        if xx <= 0.0 {
            return 0.0;
        }
        // As a difference of the level: it must be worth a part of a step.
        let differences = regressor.iter().zip(&level.difference).map(|(x, d)| (x - mean) * d).sum::<f64>();
        let moves = (differences * differences / xx / count as f64).sqrt();
        if moves > LEAST_OF_STEP * floor.step { xr * xr / xx } else { 0.0 }
    };
    let gain = regressors(&level.at, predicted).iter().map(|regressor| gain(regressor)).fold(0.0, f64::max);
    Along { gain, evidence: gain / unit }
}

fn counted(costs: &[f64]) -> f64 {
    costs.iter().filter(|cost| **cost > 0.0).count() as f64
}

/// How fast a motion is, at each sample.
fn slopes(at: &[f64], value: &[f64]) -> Vec<f64> {
    let count = value.len();
    (0..count)
        .map(|k| {
            let (low, high) = (k.saturating_sub(1), (k + 1).min(count - 1));
            (value[high] - value[low]) / (at[high] - at[low]).max(1e-9)
        })
        .collect()
}

/// What of a motion an effect's trace may go with, at each sample.
fn regressors(at: &[f64], value: &[f64]) -> [Vec<f64>; 6] {
    let count = value.len();
    let slope = slopes(at, value);
    let curve: Vec<f64> = (0..count).map(|k| slope[(k + 1).min(count - 1)] - slope[k.saturating_sub(1)]).collect();
    let steepest = slope.iter().map(|slope| slope.abs()).fold(0.0, f64::max);
    let sign = slope.iter().map(|s| if s.abs() > 0.01 * steepest { s.signum() } else { 0.0 }).collect();
    let mut way = 0.0;
    let ways = value.windows(2).map(|pair| {
        way += (pair[1] - pair[0]).abs();
        way
    });
    let ways: Vec<f64> = std::iter::once(0.0).chain(ways).collect();
    [value.to_vec(), slope, curve, sign, at.to_vec(), ways]
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gap::Grid;

    /// A level that swings slowly, recorded with noise of half of what its floor is thought to be, and `share` of it too much: as its score.
    fn scored(share: f64) -> Along {
        let law: Vec<f64> = (0..4000).map(|k| (0.01 * f64::from(k)).sin()).collect();
        let noise = |k: usize| 0.5e-3 * (((k * 7919) % 1009) as f64 / 504.0 - 1.0) * 3.0_f64.sqrt();
        let difference: Vec<f64> = law.iter().enumerate().map(|(k, x)| share * x + noise(k)).collect();
        let floor = Floor { step: 1e-4, noise: 1e-3, ..Floor::default() };
        let residual: Vec<f64> = difference.iter().map(|x| x / floor.sigma(0.0)).collect();
        let cost: Vec<f64> = residual.iter().map(|x| x * x).collect();
        let grid = Arc::new(Grid::of_steps(0.01, 39.99));
        let score = SignalScore {
            signal: 0,
            run: 0,
            cost: cost.iter().sum(),
            floor_cost: (4000.0, 8000.0),
            rms: 0.5e-3,
            floor: 1e-3,
            level: Some(LevelScore { at: grid.instants[..4000].to_vec(), cost, residual, difference }),
            edges: Vec::new(),
        };
        let track = Track {
            grid,
            first: 0,
            values: law.clone(),
            initial: 0.0,
            edges: Vec::new(),
            origins: Vec::new(),
            tolerance: 0.0,
            blind: Vec::new(),
            anew: Vec::new(),
        };
        assert!(score.cost < score.floor_cost.0 && above_floor(&score) == 0.0);
        let level = score.level.as_ref().expect("a level");
        along(&Beside { level, track: &track, predicted: &law, floor }, score.floor_cost)
    }

    /// Two bad samples among thousands are a chance, eight in a row are none, though all of them together cost what they do by chance.
    #[test]
    fn what_is_off_for_a_moment_stands_out() {
        let evidence = |off: &[(usize, usize)]| {
            let mut cost: Vec<f64> = (0..3000).map(|k| 2.0 * ((k * 7919) % 1009) as f64 / 1009.0).collect();
            off.iter().for_each(|(from, count)| cost[*from..from + count].fill(16.0));
            let total = cost.iter().sum::<f64>();
            assert!((total - 3000.0) / (3900.0 + (FLOOR_UNCERTAINTY * 3000.0_f64).powi(2)).sqrt() < 1.0, "{total}");
            stands_out(&cost, 3000.0, (3000.0, 3900.0))
        };
        assert!(evidence(&[]) < 0.1 * THRESHOLD && evidence(&[(700, 1), (2200, 1)]) < THRESHOLD);
        assert!(evidence(&[(1500, 8)]) > THRESHOLD);
    }

    /// What is a sixth of a step off as it moves costs less than its floor, in which noise may hide, and more than its rounding alone; what is noisy is held
    /// against its noise.
    #[test]
    fn what_shows_no_noise_is_held_against_its_rounding() {
        let evidence = |off: f64, noise: f64| {
            let floor = Floor { step: 1.0, noise, ..Floor::default() };
            let costs = floor.costs();
            let law = |k: u32| 40.0 * (0.01 * f64::from(k)).sin();
            let each = (0..4000).map(|k| {
                let predicted = law(k) + off * (0.37 * f64::from(k)).sin().signum();
                (super::super::cost::level(law(k).round(), predicted, 1.0, floor.sigma(0.0)), costs.at(predicted))
            });
            let sum = |(cost, mean, variance): (f64, f64, f64), (next, at): (f64, (f64, f64))| {
                (cost + next, mean + at.0, variance + at.1)
            };
            let (cost, mean, variance) = each.fold((0.0, 0.0, 0.0), sum);
            assert!(cost < mean, "{cost} {mean}");
            Unrounded::of(cost, 4000.0, &floor, (mean, variance)).evidence
        };
        assert!(evidence(0.0, 0.0) < 0.2 * THRESHOLD, "{}", evidence(0.0, 0.0));
        assert!(evidence(0.17, 0.0) > 2.0 * THRESHOLD, "{}", evidence(0.17, 0.0));
        assert_eq!(evidence(0.17, 0.3), 0.0);
    }

    /// A swing that is as large as the noise for seconds is in no sample and in their sums, the more so the less noise remembers; noise that remembers itself as it was found to is in neither.
    #[test]
    fn what_remembers_itself_for_longer_than_noise_does_is_none() {
        let mut state = 1_u64;
        let mut noise = || {
            let uniform = |state: &mut u64| {
                *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                (*state >> 11) as f64 / (1_u64 << 53) as f64
            };
            (0..12).map(|_| uniform(&mut state)).sum::<f64>() - 6.0
        };
        let evidence = |memory: f64, swing: f64, noise: &mut dyn FnMut() -> f64| {
            let mut last = 0.0;
            let off: Vec<f64> = (0..2700)
                .map(|k| {
                    last = memory * last + (1.0_f64 - memory * memory).sqrt() * noise();
                    last + swing * (0.022 * f64::from(k)).sin()
                })
                .collect();
            remembers(&off, Floor { step: 1.0, noise: 1.0, memory, ..Floor::default() })
        };
        for (memory, swing) in [(0.0, 0.7), (0.5, 1.6)] {
            assert!(evidence(memory, 0.0, &mut noise) < 0.5 * THRESHOLD);
            assert!(evidence(memory, swing, &mut noise) > THRESHOLD);
        }
    }

    /// What costs less than its floor may go with the motion: the floor was thought too high.
    #[test]
    fn what_goes_with_the_motion_is_off_below_the_floor() {
        let off = scored(4e-4);
        // A multiple of the law takes away (4e-4)²/2 for each of 4000 samples, in floors squared.
        assert!(off.evidence > FAR_BEYOND * THRESHOLD && (off.gain - 320.0).abs() < 20.0, "{off:?}");
        assert!(scored(0.0).evidence < THRESHOLD);
    }
}
