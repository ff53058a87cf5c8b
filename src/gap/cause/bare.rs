//! The model as well as its tolerances let it stand: its nominal parameters fitted, and no effect added.

use super::bench::{Bench, Trial};
use super::ladder::anew;
use super::nuisance::{Nuisance, nuisances};
use crate::gap::fit::sum_of_squares;
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

/// How many standard deviations off each nominal parameter is tried before all are fitted together: where edges alone are reported,
/// nothing has a slope far from where it fits.
const TRIED: [f64; 6] = [-2.0, -1.0, -0.5, 0.5, 1.0, 2.0];
/// By how many standard deviations each is moved from where the fit ended, one after the other.
const NEARER: [f64; 6] = [0.5, 0.25, 0.12, 0.06, 0.03, 0.015];
/// How often all are gone through.
const ROUNDS: usize = 2;

impl Bare {
    /// Fits the nominal parameters of a device whose nominal prediction is known.
    pub fn new(subject: &Subject, nominal: &Prediction) -> Bare {
        Bare::from(subject, nominal, &Overrides::none())
    }

    /// The same, once the device's floors are known better: the fit begins at what was found before.
    pub fn again(&self, subject: &Subject, nominal: &Prediction) -> Bare {
        Bare::from(subject, nominal, &self.overrides)
    }

    fn from(subject: &Subject, nominal: &Prediction, known: &Overrides) -> Bare {
        let stop = || false;
        let bench = Bench::new(subject, nuisances(subject, nominal), &stop);
        let begin = |nuisance: &Nuisance| known.0.get(nuisance.name).copied().unwrap_or(nuisance.nominal);
        let start = bench.nuisances.iter().map(begin).collect();
        let fitted = (!bench.nuisances.is_empty()).then(|| fit(&bench, start)).flatten();
        let known = fitted.and_then(|(at, overrides)| Some((bench.predict(&[], &at)?, at, overrides)));
        let (prediction, at, overrides) =
            known.unwrap_or_else(|| (nominal.clone(), bench.nominal(&[]), Overrides::none()));
        Bare { nuisances: bench.nuisances, at, overrides, prediction }
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

fn fit(bench: &Bench<'_>, start: Vec<f64>) -> Option<(Vec<f64>, Overrides)> {
    let cost = |at: &[f64]| bench.residuals(&[], at).map_or(f64::INFINITY, |residuals| sum_of_squares(&residuals));
    let mut best = start;
    let mut least = cost(&best);
    for _ in 0..ROUNDS {
        let before = least;
        for (place, nuisance) in bench.nuisances.iter().enumerate() {
            for strain in TRIED {
                let mut there = best.clone();
                there[place] = nuisance.at(strain);
                let cost = cost(&there);
                if cost < least {
                    (best, least) = (there, cost);
                }
            }
        }
        if before - least < 1.0 {
            break;
        }
    }
    let fit = |best: Vec<f64>| {
        let effort = anew(best.len());
        bench.fit(&[], std::slice::from_ref(&best), effort).or_else(|| bench.trial(&[], best))
    };
    let mut trial = fit(best)?;
    let is_off = |trial: &Trial| Some(evidence(bench.subject, &bench.predict(&[], &trial.at)?) > THRESHOLD);
    if is_off(&trial)? && !bench.is_rugged() {
        // Of a count that is many off in the end nothing has a slope either: nearer and nearer, before there is said to be a gap.
        let mut near = trial.at.clone();
        let mut least = cost(&near);
        for strain in NEARER {
            for (place, nuisance) in bench.nuisances.iter().enumerate() {
                for by in [-strain, strain] {
                    let mut there = near.clone();
                    there[place] += nuisance.at(by) - nuisance.nominal;
                    let cost = cost(&there);
                    if cost < least {
                        (near, least) = (there, cost);
                    }
                }
            }
        }
        if near != trial.at
            && let Some(again) = fit(near)
            && again.cost < trial.cost
        {
            trial = again;
        }
    }
    Some((trial.at, trial.overrides))
}
