//! A sensor that reads in steps, behind a report that could show finer ones.
//!
//! Every report is rounded, and a sensor whose report has the steps that it was given is in order. One that reads in steps of its own
//! leaves another mark: what it reports lies about the multiples of a step, though the report's own lattice, which noise or the
//! rounding of those multiples shows, is several times finer. Noise never does that, and no law: a motion passes all values alike, and
//! the difference to what is predicted is spread evenly over a step. Where the report shows no lattice but that of its number
//! format, an encoder's counts would look the same, and nothing is claimed; nor where the like of it read in such steps everywhere.
//!
//! Whether values lie about the multiples of a step s is asked of the mean of cos 2πy/s over samples that move (the periodogram of a
//! point process: M. S. Bartlett, J. R. Stat. Soc. B 25, 1963), beside that of what is predicted, which rests at round numbers now
//! and then. Noise of half a step behind the sensor hides that, and so does a lattice of nearly the step. But where nothing else is wrong it is known
//! from the prediction what the sensor should read, and what is left of it goes to and fro as a saw along the way, whose first harmonic is looked for (a
//! matched filter: G. L. Turin, IRE Transactions on Information Theory 6, 1960).

use std::f64::consts::{PI, TAU};

use crate::gap::cause::Bounds;
use crate::gap::floor::Floor;
use crate::gap::locate::{THRESHOLD, evidence_of};
use crate::gap::prediction::{Predicted, Prediction};
use crate::gap::study::Study;
use crate::gap::subject::Subject;

/// How many times the report's own step the sensor's must be: two and less leave no more than the rounding does. Readings on a lattice gather about
/// the multiples of 1/f as about those of 1/(1/own − f), so that one of up to three times may be one of less than two: it is believed where it is also what
/// is predicted to be read.
const COARSER: f64 = 2.0;
const ALIASED: f64 = 3.0;
/// Rounding to a step leaves it over √12, as its differences are spread evenly. Between which multiples of what that makes of them it is
/// looked for: noise, parameters that are fitted to it, and what else is wrong with the device add to it or take away.
const ABOUT: [f64; 2] = [0.2, 1.6];
/// Noise behind the sensor spreads readings about its steps, and the mean of their cosines is then exp(−2π²σ²/s²): which share of that
/// it must be at least, the noise being known from rests. What sticks at one value while it should move gathers, but not so nearly.
const AS_NEAR: f64 = 0.5;
/// Multiples of a step are multiples of its half and its third, too: the longest that gathers as well is the step. How many are tried, and
/// how well is as well.
const MULTIPLES: u32 = 8;
const AS_WELL: f64 = 0.8;
/// How many steps are tried for one that differs by a whole turn of the furthest value.
const FINELY: f64 = 4.0;
/// How many times the step of the like of it may differ to be the same.
const ALIKE: f64 = 2.0;
/// How much coarser than its report's own step one must be that is told by what was to be read, and between which multiples of what rounding makes of the
/// differences it is looked for: noise may add three times as much.
const COARSER_THAN_FORESEEN: f64 = 1.05;
const ABOUT_FORESEEN: [f64; 2] = [0.3, 1.6];
/// How many times the square of noise and rounding such a step may leave.
const LEFT: f64 = 2.0;
/// How much the likelihood of steps may fall, times 2: what it is made of jumps where a sample comes to another step, so that it falls by twice as much
/// as a smooth one within the same bounds.
const FALLS: f64 = 7.7;
/// How many standard deviations of the noise behind the sensor a reading may be off the step that it is predicted to show.
const GATE: f64 = 4.0;

/// The steps of a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Steps {
    /// From one reading to the next, SI, and how well that is known, standard deviation.
    pub step: f64,
    pub deviation: f64,
    /// What its reports are rounded to, SI.
    own: f64,
    /// How far they lie off the multiples of the step, standard deviation, SI: noise behind the sensor, and that rounding.
    noise: f64,
}

impl Steps {
    /// The steps in which a level is read; `None` where it shows none.
    pub fn of(subject: &Subject, prediction: &Prediction, signal: usize) -> Option<Steps> {
        if subject.signals[signal].is_count {
            return None;
        }
        let (mut values, mut pairs) = (Vec::new(), Vec::new());
        for (run, predicted) in subject.runs.iter().zip(&prediction.runs) {
            if let (Some(track), Predicted::Level(predicted)) = (&run.tracks[signal], &predicted[signal]) {
                let (recorded, predicted) = track.evident(predicted);
                values.extend_from_slice(&recorded);
                pairs.push((recorded, predicted));
            }
        }
        let own = lattice(values)?;
        let floors = || subject.runs.iter().map(|run| run.floors[signal]);
        let noise = floors().map(|floor| floor.noise).fold(f64::INFINITY, f64::min);
        let share = floors().map(|floor| floor.share()).fold(1.0, f64::min);
        let moving = pairs.iter().flat_map(|(recorded, predicted)| moving(recorded, predicted, 0.5 * COARSER * own));
        let moving: Vec<(f64, f64)> = moving.collect();
        let is_off = || evidence_of(signal, subject, prediction) > THRESHOLD;
        Steps::among(&moving, own, noise)
            .or_else(|| if is_off() { Steps::foreseen(&moving, own, (noise, share)) } else { None })
    }

    /// The steps that what is predicted says should be read, as they are read: from the same pairs; `share`: what share of an independent observation each is.
    fn foreseen(moving: &[(f64, f64)], own: f64, (noise, share): (f64, f64)) -> Option<Steps> {
        const FEWEST: usize = 3;
        let count = moving.len() as f64;
        let before = off(moving);
        let [least, most] = ABOUT_FORESEEN.map(|share| share * (12.0 * before / count.max(1.0)).sqrt());
        let sought = Sought::between(moving, least.max(COARSER_THAN_FORESEEN * own), most)?;
        let rate = sought.best(moving)?;
        let after = left(moving, rate);
        let is_no_chance = count * share * (before / after).ln() > THRESHOLD + 2.0 * (sought.tried as f64).ln();
        let is_all = after <= LEFT * count * (noise * noise + own * own / 12.0);
        let mut multiples: Vec<f64> = moving.iter().map(|(_, p)| (p * rate).round()).collect();
        multiples.sort_by(f64::total_cmp);
        multiples.dedup();
        if !is_no_chance || !is_all || multiples.len() < FEWEST || !sought.is_borne_out(moving) {
            return None;
        }
        let falls = FALLS * after / (count * share);
        let is_within = |off: &f64| [rate - off, rate + off].iter().any(|rate| left(moving, *rate) <= after + falls);
        // From afar, so that what lies between two jumps is within as well.
        let finely = sought.finely;
        let offs = std::iter::successors(Some(2.0 * finely), |off| Some(off / 1.2));
        let off = offs.take_while(|off| *off > 1e-6 * finely).find(is_within).unwrap_or(1e-6 * finely);
        let step = 1.0 / rate;
        Some(Steps { step, deviation: off * step * step / 1.96, own, noise: (after / count).sqrt() })
    }

    /// How well it is known where one step ends, standard deviation, SI.
    pub fn sharpness(&self) -> f64 {
        self.noise.max(self.own / 12.0_f64.sqrt())
    }

    /// The same from pairs of what was recorded and predicted in motion, on the lattice `own` of the report, whose noise at rest is
    /// `noise`.
    fn among(moving: &[(f64, f64)], own: f64, noise: f64) -> Option<Steps> {
        let count = moving.len() as f64;
        let rms = (moving.iter().map(|(y, p)| (y - p).powi(2)).sum::<f64>() / count.max(1.0)).sqrt();
        let [least, most] = ABOUT.map(|share| share * rms * 12.0_f64.sqrt());
        let least = least.max(COARSER * own);
        let furthest = moving.iter().map(|(y, _)| y.abs()).fold(0.0, f64::max);
        if least >= most.min(furthest) {
            return None;
        }
        let finely = 1.0 / (FINELY * furthest);
        let tried = ((1.0 / least - 1.0 / most) / finely).ceil() as usize + 1;
        let read = once(moving, 0.5 * COARSER * own);
        let predicted: Vec<f64> = moving.iter().map(|(_, p)| *p).collect();
        let rates = (0..tried).map(|k| 1.0 / most + k as f64 * finely);
        let rates = gathered_at_each(&read, 1.0 / most, finely, tried).into_iter().zip(rates);
        let (seen, rate) = rates.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let longer = (2..=MULTIPLES).rev().map(|times| rate / f64::from(times));
        let longer = longer.map(|rate| (gathered(&read, rate), rate)).find(|longer| longer.0 > AS_WELL * seen);
        let (seen, rate) = longer.unwrap_or((seen, rate));
        let beyond = seen - gathered(&predicted, rate).max(0.0);
        // By chance a mean of cosines beyond c is as rare as exp(−n·c²), one beyond another's as exp(−n·c²/2), in each try.
        if beyond <= 0.0 || read.len() as f64 * beyond * beyond <= THRESHOLD + 2.0 * (tried as f64).ln() {
            return None;
        }
        let spread = TAU * rate * (noise * noise + own * own / 12.0).sqrt();
        if seen < AS_NEAR * (-0.5 * spread * spread).exp() {
            return None;
        }
        let steps = Steps::fitted(moving, &read, rate, own)?;
        let is_sure = steps.step > ALIASED * own || steps.is_foreseen(moving, noise);
        is_sure.then_some(steps)
    }

    /// Whether its readings are the steps that are predicted, but for noise and rounding.
    fn is_foreseen(&self, moving: &[(f64, f64)], noise: f64) -> bool {
        let left = left(moving, 1.0 / self.step);
        left <= LEFT * moving.len() as f64 * (noise * noise + self.own * self.own / 12.0)
    }

    /// The step about whose multiples readings gather the most, from a rate in steps per unit that is nearly its own: where the sum of
    /// cos 2πyf has no slope, with the variance of such an estimate (P. J. Huber, Robust Statistics, Wiley 1981, section 6.4). Readings
    /// of one multiple are rounded alike, so that all of them tell as much as one. `None` where the sum rises to no such rate nearby, or
    /// readings are of less than three multiples: what is off by one number lies between two of some step, too.
    fn fitted(moving: &[(f64, f64)], read: &[f64], first: f64, own: f64) -> Option<Steps> {
        const ITERATIONS: usize = 6;
        const FEWEST: usize = 3;
        let (mut rate, mut deviation) = (first, 0.0);
        let furthest = read.iter().map(|y| y.abs()).fold(0.0, f64::max);
        for _ in 0..ITERATIONS {
            let mut slopes: Vec<(f64, f64)> =
                read.iter().map(|y| ((y * rate).round(), TAU * y * (TAU * y * rate).sin())).collect();
            slopes.sort_by(|a, b| a.0.total_cmp(&b.0));
            let bend: f64 = read.iter().map(|y| (TAU * y).powi(2) * (TAU * y * rate).cos()).sum();
            let of_one = |same: &[(f64, f64)]| same.iter().map(|of| of.1).sum::<f64>();
            let each: Vec<f64> = slopes.chunk_by(|a, b| a.0 == b.0).map(of_one).collect();
            rate -= each.iter().sum::<f64>() / bend;
            // Within the summit that was found: it is as wide as the rate at which the furthest reading is a step further.
            let is_within = (rate - first).abs() * furthest < 0.5;
            if each.len() < FEWEST || !is_within {
                return None;
            }
            deviation = each.iter().map(|slope| slope * slope).sum::<f64>().sqrt() / bend.abs();
        }
        let step = 1.0 / rate;
        let off = |(y, _): &(f64, f64)| (y - step * (y / step).round()).powi(2);
        let noise = (moving.iter().map(off).sum::<f64>() / moving.len() as f64).sqrt();
        // No better than the rounding of the furthest reading lets it be.
        let furthest = moving.iter().map(|(y, _)| (y * rate).abs()).fold(1.0, f64::max);
        let least = own / (12.0_f64.sqrt() * furthest * (furthest / 3.0).sqrt().max(1.0));
        Some(Steps { step, deviation: (deviation * step * step).max(least), own, noise })
    }

    /// What is known of the step, with 95 %.
    pub fn bounds(&self) -> Bounds {
        let off = 1.96 * self.deviation;
        Bounds { value: self.step, interval: [self.step - off, self.step + off], is_identifiable: true }
    }

    /// Whether the like of it read in the same steps.
    fn is_like(&self, other: &Steps) -> bool {
        (1.0 / ALIKE..ALIKE).contains(&(self.step / other.step))
    }

    /// By how many floors of its report squared a signal is off by its steps.
    fn misfit(&self, subject: &Subject, prediction: &Prediction, signal: usize) -> f64 {
        let floor = self.sharpness();
        let of = |(run, predicted): (&crate::gap::Run, &Vec<Predicted>)| match (&run.tracks[signal], &predicted[signal])
        {
            (Some(track), Predicted::Level(predicted)) => {
                track.values.iter().zip(predicted).map(|(y, p)| ((y - p) / floor).powi(2)).sum()
            }
            _ => 0.0,
        };
        subject.runs.iter().zip(&prediction.runs).map(of).sum()
    }

    /// Takes out of a signal what its report adds to what its sensor reads, so that its values are whole steps.
    pub fn take_out(&self, subject: &mut Subject, prediction: &Prediction, signal: usize) {
        for (run, predicted) in subject.runs.iter_mut().zip(&prediction.runs) {
            if let (Some(track), Predicted::Level(predicted)) = (&mut run.tracks[signal], &predicted[signal]) {
                track.values.iter_mut().zip(predicted).for_each(|(value, predicted)| {
                    *value = self.read(*value, *predicted);
                });
            }
        }
    }

    /// What the sensor read: the step that is nearest to what is predicted where noise may have made it what is recorded, else to that.
    fn read(&self, recorded: f64, predicted: f64) -> f64 {
        let nearest = |value: f64| self.step * (value / self.step).round();
        let foreseen = nearest(predicted);
        if (recorded - foreseen).abs() <= GATE * self.noise { foreseen } else { nearest(recorded) }
    }

    /// The floor of a signal whose sensor had no steps but those of its report.
    pub fn without(&self, floor: Floor) -> Floor {
        let noise = (self.noise.powi(2) - self.own.powi(2) / 12.0).max(0.0).sqrt();
        Floor { step: self.own, noise, timing: floor.timing, ..Floor::default() }
    }
}

/// Of the levels of the device at `place` the one that is read in the most coarse steps, how it was predicted to be off by them, and the steps.
pub(super) fn find(place: usize, study: &Study) -> Option<(usize, Steps, f64)> {
    let of = |at: usize, signal: usize| Steps::of(&study.subjects[at], &study.bare[at].prediction, signal);
    let subject = &study.subjects[place];
    let each = (0..subject.signals.len()).filter_map(|signal| Some((signal, of(place, signal)?)));
    let (signal, steps) = each.max_by(|a, b| (a.1.step / a.1.own).total_cmp(&(b.1.step / b.1.own)))?;
    let property = &subject.signals[signal].property;
    let others = study.subjects.iter().enumerate().filter(|(at, _)| *at != place);
    let mut likes = others.flat_map(|(at, other)| {
        let is_like = |signal: &usize| other.signals[*signal].property == *property;
        let moves = move |signal: &usize| {
            other
                .runs
                .iter()
                .flat_map(|run| &run.tracks[*signal])
                .any(|track| track.values.windows(2).any(|two| two[0] != two[1]))
        };
        (0..other.signals.len()).filter(is_like).filter(moves).map(move |signal| (at, signal)).collect::<Vec<_>>()
    });
    let has_like = likes.clone().next().is_some();
    let is_usual = has_like && likes.all(|(at, signal)| of(at, signal).is_some_and(|other| steps.is_like(&other)));
    let misfit = || steps.misfit(subject, &study.bare[place].prediction, signal);
    (!is_usual).then(|| (signal, steps, misfit()))
}

/// Which steps are looked for by what is predicted, as rates in steps per unit.
#[derive(Clone, Copy, Debug)]
struct Sought {
    /// That of the longest.
    least: f64,
    /// From one to the next.
    finely: f64,
    tried: usize,
}

impl Sought {
    /// Those between two lengths; `None` where nothing went so far.
    fn between(moving: &[(f64, f64)], least: f64, most: f64) -> Option<Sought> {
        let furthest = moving.iter().map(|(_, p)| p.abs()).fold(0.0, f64::max);
        let finely = 1.0 / (FINELY * furthest);
        let tried = ((1.0 / least - 1.0 / most) / finely).ceil() as usize + 1;
        (least < most.min(furthest)).then_some(Sought { least: 1.0 / most, finely, tried })
    }

    /// The rate of the steps that leave the least of what was recorded.
    fn best(&self, moving: &[(f64, f64)]) -> Option<f64> {
        const ZOOMS: u32 = 6;
        const PLACES: i32 = 32;
        let gain = |(place, swings): (usize, &f64)| {
            let rate = self.least + place as f64 * self.finely;
            let amplitude = 1.0 / (PI * rate);
            (-2.0 * amplitude * swings - 0.5 * amplitude * amplitude * moving.len() as f64, rate)
        };
        let swings = swings_at_each(moving, self.least, self.finely, self.tried);
        let (_, mut rate) = swings.iter().enumerate().map(gain).max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut apart = self.finely / f64::from(PLACES);
        for _ in 0..ZOOMS {
            let places = (-PLACES..=PLACES).map(|place| rate + f64::from(place) * apart);
            let lefts = places.map(|rate| (left(moving, rate), rate));
            rate = lefts.min_by(|a, b| a.0.total_cmp(&b.0))?.1;
            apart *= 4.0 / f64::from(PLACES);
        }
        Some(rate)
    }

    /// Whether the steps that one half of the motion shows explain the other half, either way (two-fold cross-validation: M. Stone, J. R. Stat. Soc. B 36, 1974):
    /// one of as many as are tried follows by chance what a law leaves, way for way, of the half that it was found in. Within a way that is alike, so
    /// that each block tells as much as one reading (Student's ratio of sums to squares: B. Efron, J. Am. Stat. Assoc. 64, 1969).
    fn is_borne_out(&self, moving: &[(f64, f64)]) -> bool {
        const BLOCKS: usize = 24;
        const BEYOND: f64 = 3.5;
        let long = moving.len().div_ceil(BLOCKS).max(1);
        let half = |which: usize| moving.chunks(long).skip(which).step_by(2);
        let gains = |found: usize| {
            let rate = self.best(&half(found).flatten().copied().collect::<Vec<_>>());
            let gain = move |block| rate.map_or(0.0, |rate| off(block) - left(block, rate));
            half(1 - found).map(gain)
        };
        let gains: Vec<f64> = gains(0).chain(gains(1)).collect();
        gains.iter().sum::<f64>() > BEYOND * gains.iter().map(|gain| gain * gain).sum::<f64>().sqrt()
    }
}

/// By how much readings are off what is predicted, squared.
fn off(moving: &[(f64, f64)]) -> f64 {
    moving.iter().map(|(y, p)| (y - p).powi(2)).sum()
}

/// By how much readings are off the steps, 1/`rate` each, that are predicted, squared.
fn left(moving: &[(f64, f64)], rate: f64) -> f64 {
    moving.iter().map(|(y, p)| (y - (p * rate).round() / rate).powi(2)).sum()
}

/// What was recorded and predicted wherever the prediction is at least `apart` from where it was taken before: all values alike, and a
/// rest once.
fn moving(recorded: &[f64], predicted: &[f64], apart: f64) -> Vec<(f64, f64)> {
    let mut last = f64::INFINITY;
    let mut taken = Vec::new();
    for (y, p) in recorded.iter().zip(predicted) {
        if (p - last).abs() >= apart {
            last = *p;
            taken.push((*y, *p));
        }
    }
    taken
}

/// What was recorded, what stays within `apart` of one value counting once, as its mean: a drive may stick where it should move.
fn once(moving: &[(f64, f64)], apart: f64) -> Vec<f64> {
    let mut first = f64::INFINITY;
    let mut stays: Vec<(f64, f64)> = Vec::new();
    for (y, _) in moving {
        match stays.last_mut().filter(|_| (y - first).abs() < apart) {
            Some((sum, count)) => (*sum, *count) = (*sum + y, *count + 1.0),
            None => {
                first = *y;
                stays.push((*y, 1.0));
            }
        }
    }
    stays.into_iter().map(|(sum, count)| sum / count).collect()
}

/// How nearly values lie about the multiples of 1/`rate`: the mean of their cosines.
fn gathered(values: &[f64], rate: f64) -> f64 {
    values.iter().map(|value| (TAU * rate * value).cos()).sum::<f64>() / values.len() as f64
}

/// The same at `count` rates, from `first` on every `apart`: each value's phase turns by as much from one rate to the next.
fn gathered_at_each(values: &[f64], first: f64, apart: f64, count: usize) -> Vec<f64> {
    let mut sums = vec![0.0; count];
    for value in values {
        let (mut sin, mut cos) = (TAU * first * value).sin_cos();
        let (turn_sin, turn_cos) = (TAU * apart * value).sin_cos();
        for sum in &mut sums {
            *sum += cos;
            (sin, cos) = (sin * turn_cos + cos * turn_sin, cos * turn_cos - sin * turn_sin);
        }
    }
    sums.iter().map(|sum| sum / values.len() as f64).collect()
}

/// How what was recorded goes with a wave along what is predicted, less that, at `count` rates as above: the sums of their products with its sine.
fn swings_at_each(moving: &[(f64, f64)], first: f64, apart: f64, count: usize) -> Vec<f64> {
    let mut sums = vec![0.0; count];
    for (y, p) in moving {
        let (mut sin, mut cos) = (TAU * first * p).sin_cos();
        let (turn_sin, turn_cos) = (TAU * apart * p).sin_cos();
        for sum in &mut sums {
            *sum += (y - p) * sin;
            (sin, cos) = (sin * turn_cos + cos * turn_sin, cos * turn_cos - sin * turn_sin);
        }
    }
    sums
}

/// The lattice that values are rounded to: the greatest length of which all differences of neighbours are multiples; `None` where that is what
/// single precision makes of any values.
fn lattice(mut values: Vec<f64>) -> Option<f64> {
    /// In units of what single precision leaves unsure: how well a difference is known, and how much longer a lattice must be.
    const UNSURE: f64 = 4.0;
    const SURELY: f64 = 8.0;
    /// Of longer ones that many times the uncertainty of the lattice counts.
    const SHORT: f64 = 8.0;
    values.sort_by(f64::total_cmp);
    values.dedup();
    let furthest = values.first()?.abs().max(values.last()?.abs());
    let unit = furthest * f64::from(f32::EPSILON);
    let differences: Vec<f64> =
        values.windows(2).map(|pair| pair[1] - pair[0]).filter(|apart| *apart > UNSURE * unit).collect();
    let least = differences.iter().copied().fold(f64::INFINITY, f64::min);
    let mut found = least;
    for apart in differences.iter().filter(|apart| **apart < SHORT * least) {
        let (mut long, mut short) = (*apart, found);
        // Euclid's algorithm, to the nearest multiple.
        while short > UNSURE * unit {
            (long, short) = (short, (long - (long / short).round() * short).abs());
        }
        found = long;
    }
    (found.is_finite() && found > SURELY * unit).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sweep to and fro over `span`, never twice at the same values, and what is made of it.
    fn sweep(span: f64, made: impl Fn(f64, usize) -> f64) -> Vec<(f64, f64)> {
        let at = |k: usize| span * (0.5 - 0.5 * (0.011 * k as f64).cos());
        (0..3000).map(|k| (made(at(k), k), at(k))).collect()
    }

    fn rounded(value: f64, step: f64) -> f64 {
        step * (value / step).round()
    }

    /// Evenly spread over ±√3, with a variance of 1.
    fn noise(k: usize) -> f64 {
        3.0_f64.sqrt() * (((k * 1238) % 2003) as f64 / 1001.0 - 1.0)
    }

    fn found(pairs: &[(f64, f64)], noise: f64) -> Option<Steps> {
        let own = lattice(pairs.iter().map(|pair| f64::from(pair.0 as f32)).collect())?;
        let (recorded, predicted): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
        Steps::among(&moving(&recorded, &predicted, 0.5 * COARSER * own), own, noise)
    }

    /// Steps of 7.3 lattices, without noise and with that of one and a half lattices.
    #[test]
    fn steps_behind_a_finer_report_are_found_with_their_interval() {
        for scatter in [0.0, 1.5e-4] {
            let pairs = sweep(0.8, |x, k| rounded(rounded(x, 7.3e-4) + scatter * noise(k), 1e-4));
            let steps = found(&pairs, scatter).expect("steps");
            let Bounds { interval: [least, most], .. } = steps.bounds();
            assert!(least < 7.3e-4 && 7.3e-4 < most && most - least < 1e-6, "{steps:?}");
            assert!((steps.own - 1e-4).abs() < 1e-7, "{steps:?}");
        }
    }

    /// Steps of 7.3 lattices of a drive that is off by up to 12 of them.
    #[test]
    fn steps_are_found_beside_what_else_is_off() {
        let off = |x: f64, k: usize| x + 1.2e-3 * (0.05 * k as f64).sin();
        let pairs = sweep(0.8, |x, k| rounded(rounded(off(x, k), 7.3e-4), 1e-4));
        let steps = found(&pairs, 0.0).expect("steps");
        assert!((steps.step - 7.3e-4).abs() < 1e-6, "{steps:?}");
    }

    fn foreseen(pairs: &[(f64, f64)], noise: f64) -> Option<Steps> {
        let own = lattice(pairs.iter().map(|pair| f64::from(pair.0 as f32)).collect())?;
        let (recorded, predicted): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
        Steps::foreseen(&moving(&recorded, &predicted, 0.5 * COARSER * own), own, (noise, 1.0))
    }

    /// Steps that noise of nearly half of one hides, and steps of one and a half lattices and of one and a quarter, of which some readings are on the next lattice point.
    #[test]
    fn steps_that_readings_do_not_gather_about_are_found_by_what_should_be_read() {
        for (step, scatter) in [(7.3e-4, 3.2e-4), (1.61e-4, 0.0), (1.23e-4, 0.0)] {
            let pairs = sweep(0.8, |x, k| rounded(rounded(x, step) + scatter * noise(k), 1e-4));
            assert_eq!(found(&pairs, scatter), None);
            let steps = foreseen(&pairs, scatter).unwrap_or_else(|| panic!("no steps of {step}"));
            let Bounds { interval: [least, most], .. } = steps.bounds();
            assert!(least < step && step < most && most - least < 2e-2 * step, "{steps:?}");
        }
    }

    /// Noise, gains, an offset, a drive that sticks, and a wave along the way whose period is long beside it.
    #[test]
    fn what_else_is_off_is_no_foreseen_step() {
        let stick = |x: f64| if (10.0 * x).rem_euclid(2.0) < 0.7 { 0.1 * (10.0 * x).floor() } else { x };
        let wave = |x: f64| x - 2e-4 * (TAU * x / 3e-3).sin();
        let made: [&dyn Fn(f64, usize) -> f64; 5] =
            [&|x, k| x + 4e-4 * noise(k), &|x, _| 1.01 * x, &|x, _| x - 3e-4, &|x, _| stick(x), &|x, _| wave(x)];
        for (place, made) in made.into_iter().enumerate() {
            let noise = if place == 0 { 4e-4 } else { 0.0 };
            assert_eq!(foreseen(&sweep(0.8, |x, k| rounded(made(x, k), 1e-4)), noise), None, "{place}");
        }
    }

    /// A belt whose speeds beat: of all the steps that are tried there are some that follow what is left, and not that of another hour.
    #[test]
    fn what_beats_is_no_foreseen_step() {
        for beat in (0..40).map(|k| 0.9 + 0.0137 * f64::from(k)) {
            let mut pairs = Vec::new();
            let mut speed: f64 = 0.0;
            for place in 0..40 {
                let goal = 0.1 + 0.4 * (0.618 * f64::from(place)).rem_euclid(1.0);
                for _ in 0..30 {
                    speed += f64::clamp(goal - speed, -0.02, 0.02);
                    let k = pairs.len();
                    pairs.push((rounded(speed + 1.5e-3 * (beat * k as f64).sin() + 4e-4 * noise(k), 1e-3), speed));
                }
            }
            assert_eq!(foreseen(&pairs, 1.1e-3), None, "{beat}");
        }
    }

    /// Steps of 2.3 lattices, behind noise of a third of one, gather as those of 1.77 would.
    #[test]
    fn steps_of_more_than_two_lattices_are_told_from_those_of_less() {
        let pairs = |step: f64| sweep(0.8, |x, k| rounded(rounded(x, step) + 3e-5 * noise(k), 1e-4));
        let Bounds { interval: [least, most], .. } = found(&pairs(2.3e-4), 3e-5).expect("steps").bounds();
        assert!(least < 2.3e-4 && 2.3e-4 < most && most - least < 1e-6, "{least} to {most}");
        let alias = 1.0 / (1.0 / 1e-4 - 1.0 / 2.3e-4);
        assert_eq!(found(&pairs(alias), 3e-5), None);
    }

    /// A report with its own steps alone, with noise of several of them, or with a wrong gain.
    #[test]
    fn rounding_noise_and_gains_are_no_steps() {
        assert_eq!(found(&sweep(0.8, |x, _| rounded(x, 1e-4)), 0.0), None);
        assert_eq!(found(&sweep(0.8, |x, k| rounded(x + 4e-4 * noise(k), 1e-4)), 4e-4), None);
        assert_eq!(found(&sweep(0.8, |x, _| rounded(1.01 * x, 1e-4)), 0.0), None);
    }

    /// A drive that sticks at four speeds on its way, which are multiples of a tenth of its highest.
    #[test]
    fn what_sticks_while_it_should_move_shows_no_steps() {
        let stick = |x: f64| if (10.0 * x).rem_euclid(2.0) < 0.7 { 0.1 * (10.0 * x).floor() } else { x };
        assert_eq!(found(&sweep(0.8, |x, k| rounded(stick(x) + 1e-4 * noise(k), 1e-4)), 1e-4), None);
    }

    /// A belt's speeds, each reached by a ramp, all of them told 0.108 m/s too low.
    #[test]
    fn what_is_off_by_one_number_shows_no_steps() {
        let mut pairs = Vec::new();
        let mut speed = 0.0;
        for goal in [0.3, 0.5, 0.2, 0.5, 0.0, 0.4, 0.5, 0.0, 0.25, 0.5].repeat(3) {
            for _ in 0..80 {
                speed += f64::clamp(goal - speed, -0.02, 0.02);
                pairs.push((rounded(speed - 0.108 + 1e-3 * noise(pairs.len()), 1e-3), speed));
            }
        }
        assert_eq!(found(&pairs, 1e-3), None);
    }

    /// Noise of a fifth of a step: where a reading lies about its step is not sure, and the interval says so.
    #[test]
    fn the_interval_of_steps_in_noise_is_wide() {
        let pairs = sweep(0.04, |x, k| rounded(rounded(x, 7.3e-4) + 1.5e-4 * noise(k), 1e-4));
        let steps = found(&pairs, 1.5e-4).expect("steps");
        let Bounds { interval: [least, most], .. } = steps.bounds();
        assert!(least < 7.3e-4 && 7.3e-4 < most && most - least > 2e-7 && most - least < 2e-5, "{steps:?}");
    }

    /// An encoder's counts in all digits of single precision: nobody knows what it was to be read to.
    #[test]
    fn a_report_without_a_lattice_of_its_own_shows_no_steps() {
        assert_eq!(found(&sweep(0.8, |x, _| f64::from(rounded(x, TAU / 4096.0) as f32)), 0.0), None);
    }

    #[test]
    fn what_gathers_at_many_rates_is_what_gathers_at_each() {
        let values: Vec<f64> = (0..500).map(|k| 0.731 * f64::from(k) + noise(k as usize)).collect();
        let (first, apart) = (0.8, 3e-4);
        let all = gathered_at_each(&values, first, apart, 20_000);
        for (k, all) in all.iter().enumerate().step_by(997) {
            let one = gathered(&values, first + k as f64 * apart);
            assert!((all - one).abs() < 1e-9, "{k}: {all} {one}");
        }
        assert!(all.iter().any(|all| *all > 0.3) && all.iter().any(|all| *all < -0.01));
    }

    #[test]
    fn a_reading_is_a_whole_step_again() {
        let steps = Steps { step: 1.0, deviation: 0.0, own: 0.01, noise: 0.1 };
        assert_eq!(steps.read(2.1, 2.3), 2.0);
        // On the verge between two steps the prediction has no say.
        assert_eq!(steps.read(2.1, 2.55), 2.0);
        assert_eq!(steps.read(2.1, 7.0), 2.0);
        let floor = steps.without(Floor { step: 1.0, timing: 1e-5, ..Floor::default() });
        assert!(floor.step == 0.01 && floor.timing == 1e-5 && (floor.noise - 0.1).abs() < 1e-3);
    }
}
