//! What a law that is not all of the truth leaves, and how much each sample then counts.
//!
//! Where a law explains a recording, what is left is noise, and every sample of it tells anew. Where it does not, what is left is
//! mostly the law's own error: far above the noise, and the same for as long as nothing moves. A likelihood that knew of noise alone
//! would then be flat wherever a prediction is off, and a fit would make some samples perfect at the cost of all others. So
//! differences are weighed by how large they are on the whole ([`Floor::misfit`], found anew for each answer), and a rest counts as
//! one observation a second.
//!
//! Source: quasi-likelihood, whose dispersion is estimated from what the richest model leaves (R. W. M. Wedderburn, Biometrika 61
//! (1974)), with the median in place of the mean (P. J. Huber, Robust Statistics, Wiley 1981, section 6.7).

use super::floor::Floor;
use super::grid::median;
use super::prediction::{Predicted, Prediction};
use super::samples::Samples;
use super::subject::{Run, Subject};
use super::track::Track;

/// From how many floors on what is left is a law's error and no noise.
const ABOVE_NOISE: f64 = 2.0;
/// A median of so many times less is a standard deviation of normal errors.
const DEVIATION: f64 = 1.4826;
/// How many moving samples tell how large differences are.
const ENOUGH: usize = 40;
/// How long an observation lasts at rest, s, and how many steps a rest may move in that time.
const OBSERVATION_S: f64 = 1.0;
const STILL: f64 = 1.5;

/// A level's floor, and how much each of its samples counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weighed<'a> {
    pub floor: Floor,
    rests: &'a [bool],
    repeated: &'a [bool],
    at_rest: f64,
}

impl Weighed<'_> {
    /// Whether the track's `k`th sample repeats the one before it, where that is settled.
    pub fn is_repeated(&self, k: usize) -> Option<bool> {
        self.repeated.get(k).copied()
    }

    /// What share of an observation the track's `k`th sample is: of noise that remembers less than 1; of a law with an error of its
    /// own, which hides the noise, less at rest.
    pub fn weight(&self, k: usize) -> f64 {
        match self.floor.misfit > 0.0 {
            true if self.rests.get(k) == Some(&true) => self.at_rest,
            true => 1.0,
            false => self.floor.share(),
        }
    }
}

impl Run {
    /// The floor and the weights of one of its levels.
    pub(super) fn weighed(&self, signal: usize) -> Weighed<'_> {
        let cycle = self.tracks[signal].as_ref().map_or(0.0, |track| track.grid.cycle);
        let at_rest = (cycle / OBSERVATION_S).min(1.0);
        Weighed { floor: self.floors[signal], rests: &self.rests[signal], repeated: &self.repeated[signal], at_rest }
    }
}

/// Where a recorded level rests: it stays as it was the cycle before, and by the nominal law it would hardly move in a second.
pub(super) fn rests(track: &Track, nominal: &[f64], step: f64) -> Vec<bool> {
    let still = STILL * step / OBSERVATION_S * track.grid.cycle;
    let rests =
        |k: usize| k > 0 && track.values[k] == track.values[k - 1] && (nominal[k] - nominal[k - 1]).abs() <= still;
    (0..track.values.len().min(nominal.len())).map(rests).collect()
}

impl Subject {
    /// The same device, differences being weighed by what `prediction` leaves of each level where that is far above its noise.
    pub fn tolerant(&self, prediction: &Prediction) -> Subject {
        let mut tolerant = self.clone();
        // What is taken up again and again is weighed by how far it is off from one time to the next.
        if self.is_weighed_already() {
            return tolerant;
        }
        for signal in 0..self.signals.len() {
            let misfit = self.misfit(signal, prediction);
            tolerant.runs.iter_mut().for_each(|run| run.floors[signal].misfit = misfit);
        }
        tolerant
    }

    /// The same device weighed by noise alone.
    pub fn weighed_by_noise(&self) -> Subject {
        let mut plain = self.clone();
        plain.runs.iter_mut().flat_map(|run| &mut run.floors).for_each(|floor| floor.misfit = 0.0);
        plain
    }

    /// The same device, whose samples repeat each other where they do under `prediction`: its deviance has no steps then, as it has
    /// where each prediction comes to rest at samples of its own.
    pub fn repeating_as(&self, prediction: &Prediction) -> Subject {
        let mut settled = self.clone();
        for (run, predicted) in settled.runs.iter_mut().zip(&prediction.runs) {
            for (signal, info) in self.signals.iter().enumerate() {
                let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &predicted[signal]) else {
                    continue;
                };
                let mut repeated = vec![false; track.values.len()];
                Samples::new(track, values, &run.weighed(signal), info.is_count)
                    .each(|sample| repeated[sample.index - track.first] = sample.is_rest);
                run.repeated[signal] = repeated;
            }
        }
        settled
    }

    /// Whether how far even a good model is off is known of it.
    pub(super) fn is_weighed_already(&self) -> bool {
        self.runs.iter().flat_map(|run| &run.floors).any(|floor| floor.reach > 0.0)
    }

    /// Whether both weigh the device alike: what their laws leave differs by no more than a twentieth.
    pub fn weighs_as(&self, other: &Subject) -> bool {
        let misfits =
            |of: &Subject| of.runs.iter().flat_map(|run| &run.floors).map(|floor| floor.misfit).collect::<Vec<_>>();
        let is_alike = |(a, b): (&f64, &f64)| (a - b).abs() <= 0.05 * a.max(*b);
        misfits(self).iter().zip(&misfits(other)).all(is_alike)
    }

    /// How far a level is off where it moves, in all runs, beyond what noise explains; 0 where noise explains it.
    fn misfit(&self, signal: usize, prediction: &Prediction) -> f64 {
        let half = if self.signals[signal].is_count { 0.5 } else { 0.0 };
        let (mut all, mut moving, mut floor): (Vec<f64>, Vec<f64>, f64) = Default::default();
        for (run, predicted) in self.runs.iter().zip(&prediction.runs) {
            let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &predicted[signal]) else { continue };
            floor = floor.max(run.floors[signal].rms(0.0));
            for (k, (recorded, predicted)) in track.values.iter().zip(values).enumerate() {
                if track.is_blind(track.first + k) {
                    continue;
                }
                let off = (recorded + half - predicted).abs();
                all.push(off);
                if run.rests[signal].get(k) != Some(&true) {
                    moving.push(off);
                }
            }
        }
        let differences = if moving.len() < ENOUGH { all } else { moving };
        let scale = DEVIATION * median(&differences).unwrap_or(0.0);
        if scale > ABOVE_NOISE * floor { (scale * scale - floor * floor).sqrt() } else { 0.0 }
    }
}
