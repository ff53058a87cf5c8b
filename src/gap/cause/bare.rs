//! The model as well as its tolerances let it stand: its nominal parameters fitted, and no effect added.

use std::sync::Arc;

use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use super::ladder::anew;
use super::nuisance::{Nuisance, nuisances};
use crate::gap::fit::{spread, sum_of_squares};
use crate::gap::{Overrides, Prediction, Subject, THRESHOLD, evidence};

/// What is known of a device before any effect is looked for.
#[derive(Clone, Debug)]
pub struct Bare {
    /// The nominal parameters that may be off, and what they were fitted to be.
    pub nuisances: Vec<Nuisance>,
    pub at: Vec<f64>,
    /// The same by name.
    pub overrides: Overrides,
    /// What the device then predicts.
    pub prediction: Prediction,
}

/// How many standard deviations off each nominal parameter is tried: where edges alone are reported, nothing has a slope far from where it
/// fits.
const TRIED: [f64; 6] = [-2.0, -1.0, -0.5, 0.5, 1.0, 2.0];
/// By how many standard deviations each is moved from where the fit ended, one after the other.
const NEARER: [f64; 6] = [0.5, 0.25, 0.12, 0.06, 0.03, 0.015];
/// How often all are gone through.
const ROUNDS: usize = 2;

/// Where the nominal parameters are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Search {
    /// Everywhere, before there is said to be a gap.
    All,
    /// Where they begin, and near to where that leads; everywhere where edges alone are reported, which have no slopes to lead there.
    Near,
    /// As near, and of a device that reports edges alone by walkers.
    Widely,
    /// Downhill from where they begin.
    Downhill,
}

impl Bare {
    /// Fits the nominal parameters of a device whose nominal prediction is known.
    pub fn new(subject: &Subject, nominal: &Prediction) -> Bare {
        Bare::from(subject, nominal, &Overrides::none(), Search::All)
    }

    /// The same downhill from nominal alone: what the devices say together bears that one of them stays where it is.
    pub fn roughly(subject: &Subject, nominal: &Prediction) -> Bare {
        Bare::from(subject, nominal, &Overrides::none(), Search::Downhill)
    }

    /// The same, once the device's floors are known better: the fit begins at what was found before.
    pub fn again(&self, subject: &Subject, nominal: &Prediction) -> Bare {
        Bare::from(subject, nominal, &self.overrides, Search::Near)
    }

    /// The same as widely as can be, where edges alone are reported: once all that is common to the devices is known, before there is said to be a gap.
    pub fn widely(&self, subject: &Subject, nominal: &Prediction) -> Bare {
        Bare::from(subject, nominal, &self.overrides, Search::Widely)
    }

    fn from(subject: &Subject, nominal: &Prediction, known: &Overrides, search: Search) -> Bare {
        let stop = || false;
        let bench = Bench::new(subject, nuisances(subject, nominal), &stop);
        let begin = |nuisance: &Nuisance| {
            let found = known.0.get(nuisance.name).or_else(|| subject.likely.0.get(nuisance.name));
            found.copied().unwrap_or(nuisance.nominal)
        };
        let start = bench.nuisances.iter().map(begin).collect();
        let fitted = (!bench.nuisances.is_empty()).then(|| fit(&bench, start, search)).flatten();
        let known = fitted.and_then(|(at, overrides)| Some((bench.predict(&[], &at)?, at, overrides)));
        let (prediction, at, overrides) =
            known.unwrap_or_else(|| (Arc::new(nominal.clone()), bench.nominal(&[]), Overrides::none()));
        Bare { nuisances: bench.nuisances, at, overrides, prediction: Arc::unwrap_or_clone(prediction) }
    }

    /// The same parameters, once the device is looked at otherwise.
    pub fn held(&self, subject: &Subject) -> Bare {
        let prediction = subject.predict(&[], &self.overrides).unwrap_or_else(|_| self.prediction.clone());
        Bare { prediction, ..self.clone() }
    }

    /// The same parameters in other recordings of the device.
    pub fn beside(&self, subject: &Subject, nominal: &Prediction) -> Bare {
        let prediction = match self.overrides.0.is_empty() {
            true => None,
            false => subject.predict(&[], &self.overrides).ok(),
        };
        Bare { prediction: prediction.unwrap_or_else(|| nominal.clone()), ..self.clone() }
    }
}

/// Downhill from `start`; where that leaves a gap, or slopes lead nowhere, from the best of what is tried about it, and nearer and nearer to
/// where that ends, before there is said to be one.
fn fit(bench: &Bench<'_>, start: Vec<f64>, search: Search) -> Option<(Vec<f64>, Overrides)> {
    let downhill = |at: Vec<f64>| {
        let effort = anew(at.len());
        bench.fit(&[], std::slice::from_ref(&at), effort).or_else(|| bench.trial(&[], at))
    };
    let is_off = |trial: &Trial| Some(evidence(bench.subject, &*bench.predict(&[], &trial.at)?) > THRESHOLD);
    let mut best = match bench.is_rugged() {
        true => downhill(about(bench, &[], &start))?,
        false => downhill(start.clone())?,
    };
    let lower = |begin: Vec<f64>, best: Trial| downhill(begin).filter(|again| again.cost < best.cost).unwrap_or(best);
    if search == Search::Downhill || bench.is_rugged() || !is_off(&best)? {
        return Some((best.at, best.overrides));
    }
    let has_slopes = bench.subject.score(&*bench.predict(&[], &best.at)?).are_levels().contains(&true);
    if search == Search::All || !has_slopes {
        best = lower(about(bench, &[], &start), best);
    }
    if is_off(&best)? {
        best = lower(nearer(bench, &best.at), best);
    }
    if search == Search::Widely && !has_slopes && is_off(&best)? {
        best = lower(walked(bench, &best), best);
    }
    Some((best.at, best.overrides))
}

fn cost(bench: &Bench<'_>, set: &[Candidate], at: &[f64]) -> f64 {
    bench.residuals(set, at).map_or(f64::INFINITY, |residuals| sum_of_squares(&residuals))
}

/// The best of each nominal parameter at some standard deviations from nominal, one after the other, beside a set of candidates that are held.
pub fn about(bench: &Bench<'_>, set: &[Candidate], start: &[f64]) -> Vec<f64> {
    let own: usize = set.iter().map(|candidate| candidate.free.len()).sum();
    let mut best = start.to_vec();
    let mut least = cost(bench, set, &best);
    for _ in 0..ROUNDS {
        let before = least;
        for (place, nuisance) in bench.nuisances_beside(set).enumerate() {
            for strain in TRIED {
                let mut there = best.clone();
                there[own + place] = nuisance.at(strain);
                let cost = cost(bench, set, &there);
                if cost < least {
                    (best, least) = (there, cost);
                }
            }
        }
        if before - least < 1.0 {
            break;
        }
    }
    best
}

/// The best that walkers find from where a fit of edges alone ended: what is late by one parameter and early by another has no way out along
/// either.
fn walked(bench: &Bench<'_>, best: &Trial) -> Vec<f64> {
    const SEED: u64 = 1;
    const RISE: f64 = 3.84;
    let cost = |at: &[f64]| Some(cost(bench, &[], at));
    spread(&cost, &best.fitted(), &best.ranges, 0, (RISE, SEED)).best.at
}

/// The best of each parameter moved a little and ever less: of a count that is many off in the end nothing has a slope.
fn nearer(bench: &Bench<'_>, start: &[f64]) -> Vec<f64> {
    let mut best = start.to_vec();
    let mut least = cost(bench, &[], &best);
    for strain in NEARER {
        for (place, nuisance) in bench.nuisances.iter().enumerate() {
            for by in [-strain, strain] {
                let mut there = best.clone();
                there[place] += nuisance.at(by) - nuisance.nominal;
                let cost = cost(bench, &[], &there);
                if cost < least {
                    (best, least) = (there, cost);
                }
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Task;
    use crate::gap::recorded_tests::{ORDERLY_PUSHER, study};

    /// Moved one by one, its speeds and its stroke leave an edge late.
    #[test]
    fn flags_are_explained_by_parameters_that_only_go_together() {
        let mut pusher = study(ORDERLY_PUSHER).subject("Pusher").expect("it moves").clone();
        pusher.set_task(0, Task { filter_s: 0.0, ..pusher.runs[0].task });
        let nominal = pusher.predict(&[], &Overrides::none()).expect("a prediction");
        let bare = Bare::new(&pusher, &nominal);
        let is_off = |bare: &Bare| evidence(&pusher, &bare.prediction) > THRESHOLD;
        assert!(is_off(&bare) && !is_off(&bare.widely(&pusher, &nominal)));
    }
}
