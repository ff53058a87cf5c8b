//! One rung of the ladder: what each candidate of the library explains beside the effects that are there already.
//!
//! A replay costs a millisecond, a fit a hundred of them, and a device has a hundred candidates. So each is glanced at first: a start
//! of its parameters moves the residuals along a direction, and along that direction alone it could take away
//! (d·r)²/|d|², how far it moves them being a matter of its parameter. Starts that move them next to nothing, or further than the
//! whole gap, are not looked at. Only what promises something is fitted, and only what then explains a part of what the best
//! explains is fitted closely. Where the first part of the recordings shows enough of the gap, all of that is done on it alone, and what is
//! found there is fitted to the whole. Where a nominal parameter stands at the end of its tolerance, it has made up for an effect and holds it
//! back: then all that promises something has the nominal parameters follow it.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::bench::{Bench, Trial};
use super::blur;
use super::candidate::Candidate;
use super::glance::{Glance, Looks, Sought};
use super::ladder::{NEAR_THE_BEST, Progress, Standing, Tell, anew};
use super::library;
use super::masked::masked;
use super::remainder::{LAWS_OWN, misfit};
use super::tangent::Tangent;
use crate::gap::fit::{Effort, least_squares};
use crate::gap::{FAR_BEYOND, Prediction, Score, Subject, THRESHOLD};
use crate::plant::EffectPlace;

/// Which share of what the most promising one promises a candidate must promise to be fitted, of one parameter and of several.
const BESIDE_THE_BEST: [f64; 2] = [0.1, 0.03];

/// Which share of what slopes say that it gains a trial must gain, for its nominal parameters to be where they should.
const FALLS_SHORT: f64 = 0.5;

/// Every candidate that is admitted beside the effects of `below`, those held as they are; the best first.
pub fn rung(
    bench: &Bench<'_>,
    below: &Trial,
    sought: Sought,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    is_admitted: &dyn Fn(&Candidate) -> bool,
    tell: &Tell<'_>,
) -> Vec<Trial> {
    let Some(prediction) = bench.predict(&below.set, &below.at) else { return Vec::new() };
    let Some(tangent) = Tangent::new(bench, below) else { return Vec::new() };
    let score = bench.subject.score(&prediction);
    let mut library = candidates_beside(bench, below, (&prediction, &score), is_asked);
    library.retain(is_admitted);
    let hidden = masked(bench, below, sought.excess, &library);
    let blurred = blur::blurred(bench.subject, &score);
    let is_smooth = !bench.is_rugged() && is_in_levels(&score, sought.excess);
    let afar = blurred.first().filter(|_| !is_smooth).map(|subject| (subject, subject.residuals(&prediction)));
    let whole = Looks { bench, below, tangent, blurred: &blurred, afar, sought, is_smooth };
    let early = is_smooth.then(|| Early::of(bench, below, sought)).flatten();
    let early_bench = early.as_ref().map(|early| bench.of_part(&early.subject));
    let early_looks = early.as_ref().zip(early_bench.as_ref()).and_then(|(early, bench)| early.looks(bench));
    let (looks, is_part) = (early_looks.as_ref().unwrap_or(&whole), early_looks.is_some());
    let counter = Counter { device: &bench.subject.name, of: library.len(), tell, told: Default::default() };
    // One candidate may take as long as many others: each is a piece of work of its own.
    let glances: Vec<Glance> = library
        .into_par_iter()
        .with_max_len(1)
        .filter_map(|candidate| {
            let glance = looks.glance(candidate);
            if !glance.as_ref().is_some_and(|glance| glance.is_promising) {
                counter.count(glance.as_ref().map(|glance| (&glance.candidate, 0.0)));
            }
            glance
        })
        .collect();
    let promised = glances.iter().map(|glance| glance.promise).fold(0.0, f64::max);
    let is_beside_the_best = |glance: &Glance| {
        let share = BESIDE_THE_BEST[usize::from(glance.candidate.free.len() > 1)];
        glance.promise >= share * promised
    };
    let is_worth_a_fit = |glance: &Glance| glance.is_promising && is_beside_the_best(glance);
    let fitted = glances.into_par_iter().with_max_len(1).filter_map(|glance| match is_worth_a_fit(&glance) {
        true => {
            let fitted = looks.fit(glance)?;
            counter.count(Some((&fitted.candidate, fitted.gain / looks.sought.excess)));
            Some(fitted)
        }
        false => {
            if glance.is_promising {
                counter.count(None);
            }
            Some(glance.left())
        }
    });
    let fitted: Vec<Glance> = fitted.collect();
    let most = fitted.iter().map(|glance| glance.gain).fold(0.0, f64::max);
    // Where slopes lead nowhere, what a few steps downhill gain says little.
    let is_near = |glance: &Glance| glance.is_promising && (bench.is_rugged() || glance.gain > NEAR_THE_BEST * most);
    let nuisances = below.at.iter().zip(&below.ranges).skip(below.parameters());
    let is_strained = is_smooth && nuisances.into_iter().any(|(at, range)| *at <= range.least || *at >= range.greatest);
    let is_answer = |glance: &Glance| !sought.is_of_one() || glance.is_promising || glance.gain > sought.least();
    let trials = fitted.into_par_iter().with_max_len(1).filter(is_answer).filter_map(|glance| {
        let is_near = is_near(&glance);
        let glance = match is_part {
            true => whole.again(if is_near { looks.closely(glance)? } else { glance }),
            false => glance,
        };
        let follows = is_strained && !glance.candidate.free.is_empty() && is_beside_the_best(&glance);
        let gain = glance.gain;
        let trial = match is_near {
            true => whole.fit_closely(glance, is_part),
            false if glance.candidate.free.is_empty() => whole.trial_at(&glance, &[]),
            // What promised little gets no nominal parameters of its own.
            false => bench.trial(&glance.set, whole.all(&glance, &glance.at)),
        }?;
        // Where the nominal parameters do not go along their slopes so far, it takes away less than it did with them going there.
        let falls_short = is_smooth && is_near && below.cost - trial.cost < FALLS_SHORT * gain;
        Some((trial, follows || falls_short))
    });
    let trials: Vec<Trial> = followed(bench, looks.bench, below, trials.collect()).into_iter().chain(hidden).collect();
    // Weighed by what the effects so far leave, ten times as much is hardly anything else than 60/2π times as much.
    let by_noise = bench.subject.weighed_by_noise();
    let by_noise = bench.with(&by_noise);
    distinct(trials, &|trial| by_noise.trial(&trial.set, trial.at.clone()).map_or(f64::INFINITY, |trial| trial.cost))
}

/// The same trials with all that is free fitted in those that are said to follow: by a few steps on a `part` of the recordings, and to the end where that
/// comes near the best.
fn followed(bench: &Bench<'_>, part: &Bench<'_>, below: &Trial, trials: Vec<(Trial, bool)>) -> Vec<Trial> {
    /// As often as so many differences are taken.
    const STEPS: u32 = 6;
    let fit = |bench: &Bench<'_>, trial: &Trial, effort| bench.fit(&trial.set, std::slice::from_ref(&trial.at), effort);
    let cheaper = |trial: Trial, other: Option<Trial>| other.filter(|other| other.cost < trial.cost).unwrap_or(trial);
    let begun = trials.into_par_iter().with_max_len(1).map(|(trial, follows)| {
        let few = Effort { starts: 1, budget: STEPS * (trial.at.len() as u32 + 1) };
        let led = follows.then(|| fit(part, &trial, few)).flatten();
        let led = led.and_then(|led| bench.trial(&led.set, led.at));
        (cheaper(trial, led), follows)
    });
    let begun: Vec<(Trial, bool)> = begun.collect();
    let least = begun.iter().map(|(trial, _)| trial.cost).fold(below.cost, f64::min);
    let ended = begun.into_par_iter().with_max_len(1).map(|(trial, follows)| {
        let is_near = below.cost - trial.cost > NEAR_THE_BEST * (below.cost - least);
        let all = (follows && is_near).then(|| fit(bench, &trial, anew(trial.at.len()))).flatten();
        cheaper(trial, all)
    });
    ended.collect()
}

/// Effects of one parameter that move levels each in a way of its own; what others do goes with one of them, or with the motion itself.
const WITNESSES: [&str; 11] = [
    "acceleration-limit",
    "backlash",
    "breakaway-friction",
    "constant-force",
    "coulomb-friction",
    "dead-band",
    "direction-asymmetry",
    "first-order-lag",
    "input-filter",
    "jerk-limit",
    "load-dependent-friction",
];

/// What an effect beside those of `below` takes away of a device's deviance though nothing that is asked of all motions shows that anything is off: the
/// greatest gain of the witnesses that promise the most, each fitted with all that is free beside it. `None` where nothing promises as much as
/// `least`.
pub fn beneath(bench: &Bench<'_>, below: &Trial, least: f64, is_asked: &(dyn Fn(&str) -> bool + Sync)) -> Option<f64> {
    /// The square of a whitened distance that shows clearly: a start that moves the levels by much more says nothing of one.
    const CLEAR: f64 = 1000.0;
    /// What a witness must promise on the first part of the recordings: of those whose part there has a mean of a third of `least` 993 of a thousand do.
    const PROMISED_EARLY: f64 = 3.0;
    /// Of its part of all moving blocks, how many that part must hold.
    const ALIKE: f64 = 0.6;
    /// How many are fitted.
    const FITTED: usize = 3;
    let prediction = bench.predict(&below.set, &below.at)?;
    let score = bench.subject.score(&prediction);
    if bench.is_rugged() || !score.are_levels().contains(&true) {
        return None;
    }
    let tangent = Tangent::new(bench, below)?;
    let looks =
        Looks { bench, below, tangent, blurred: &[], afar: None, sought: Sought::in_parts(CLEAR), is_smooth: true };
    let is_asked = |id: &str| is_asked(id) && WITNESSES.contains(&id);
    let mut library = candidates_beside(bench, below, (&prediction, &score), &is_asked);
    library.retain(|candidate| candidate.place != EffectPlace::ReportLink && candidate.place != EffectPlace::Sensor);
    // Most are seen on the first part of the recordings to promise nothing, where the device moves there as it does later.
    let subject = bench.subject.early(EARLY);
    let there = bench.of_part(&subject);
    let moves = |bench: &Bench<'_>| Some(bench.moving_blocks(&*bench.predict(&below.set, &below.at)?) as f64);
    let is_alike = moves(&there).zip(moves(bench)).is_some_and(|(first, all)| first >= ALIKE * EARLY * all);
    let first = there.trial(&below.set, below.at.clone()).filter(|_| is_alike);
    let early = first.as_ref().and_then(|below| {
        let tangent = Tangent::new(&there, below)?;
        Some(Looks {
            bench: &there,
            below,
            tangent,
            blurred: &[],
            afar: None,
            sought: Sought::in_parts(CLEAR),
            is_smooth: true,
        })
    });
    let promising = |candidate| {
        let glance = match &early {
            Some(early) => {
                let glance = early.glance(candidate)?;
                let is_kept = glance.promise > PROMISED_EARLY * early.below.inflation();
                is_kept.then(|| looks.promised(glance)).flatten()?
            }
            None => looks.glance(candidate)?,
        };
        Some(glance).filter(|glance| glance.promise > least)
    };
    let mut glances: Vec<Glance> = library.into_par_iter().with_max_len(1).filter_map(promising).collect();
    glances.sort_by(|a, b| b.promise.total_cmp(&a.promise));
    glances.truncate(FITTED);
    if glances.is_empty() {
        return None;
    }
    // A few steps downhill show whether there is anything in a promise: mostly there is not.
    let is_kept = |glance: &Glance| {
        let all = looks.all(glance, &glance.at);
        let ranges = bench.ranges(&glance.set);
        let residuals = |at: &[f64]| bench.residuals(&glance.set, at);
        let fitted = least_squares(&residuals, &all, &ranges, anew(all.len()).budget);
        fitted.is_some_and(|fitted| below.cost - fitted.cost > least)
    };
    let glances: Vec<Glance> = glances.into_par_iter().with_max_len(1).filter(is_kept).collect();
    if glances.is_empty() {
        return None;
    }
    let fit = |set: &[Candidate], at: Vec<f64>| bench.fit(set, std::slice::from_ref(&at), anew(at.len()));
    // An effect is no better for what the nominal parameters alone would do.
    let without = fit(&below.set, below.at.clone()).map_or(below.cost, |fitted| fitted.cost.min(below.cost));
    let with = glances.par_iter().with_max_len(1).filter_map(|glance| {
        let fitted = fit(&glance.set, looks.all(glance, &glance.at))?;
        let there = bench.predict(&fitted.set, &fitted.at)?;
        bench.differ(&prediction, &there).then_some(fitted.cost)
    });
    Some(without - with.reduce(|| without, f64::min))
}

/// What another effect takes away beneath what those of `below` leave, which is not evident: where it is far beyond chance, and more of the gap that is there with
/// the nominal parameters at `bare` than a law may be off by.
pub fn beneath_others(
    bench: &Bench<'_>,
    below: &Trial,
    bare: &[f64],
    is_asked: &(dyn Fn(&str) -> bool + Sync),
) -> Option<f64> {
    let gap = misfit(&bench.subject.score(&*bench.predict(&[], bare)?));
    let least = (FAR_BEYOND * THRESHOLD * below.inflation()).max(LAWS_OWN * gap);
    beneath(bench, below, least, is_asked).filter(|found| *found > least)
}

/// All candidates that the library has beside the effects of `below`.
pub fn library_beside(
    bench: &Bench<'_>,
    below: &Trial,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
) -> Option<Vec<Candidate>> {
    let prediction = bench.predict(&below.set, &below.at)?;
    let score = bench.subject.score(&prediction);
    Some(candidates_beside(bench, below, (&prediction, &score), is_asked))
}

fn candidates_beside(
    bench: &Bench<'_>,
    below: &Trial,
    (prediction, score): (&Prediction, &Score),
    is_asked: &(dyn Fn(&str) -> bool + Sync),
) -> Vec<Candidate> {
    let mut library = library::candidates(bench.subject, prediction, score, &|id| is_asked(id));
    library.retain(|candidate| !below.set.iter().any(|there| there.is_same(candidate)));
    library
}

/// Whether more of an `excess` lies in levels than in edges. What goes with a motion beneath its noise is none of a level's cost above the
/// floor, and no edge's either.
fn is_in_levels(score: &Score, excess: f64) -> bool {
    let above = |is_level: bool| -> f64 {
        let of = score.signals.iter().filter(|signal| signal.level.is_some() == is_level);
        of.map(|signal| (signal.cost - signal.floor_cost.0).max(0.0)).sum()
    };
    let (levels, edges) = (above(true), above(false));
    let beneath = if score.are_levels().contains(&true) { excess - edges } else { 0.0 };
    levels.max(beneath) > edges
}

/// The best first; of several choices of one effect, which have no number to be found, the effect is the one that costs least by noise alone.
fn distinct(mut trials: Vec<Trial>, by_noise: &dyn Fn(&Trial) -> f64) -> Vec<Trial> {
    trials.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut distinct: Vec<(Trial, Option<f64>)> = Vec::with_capacity(trials.len());
    for trial in trials {
        let is_there = |other: &Trial| other.set.last().zip(trial.set.last()).is_some_and(|(a, b)| a.is_same(b));
        let Some((other, cost)) = distinct.iter_mut().find(|(other, _)| is_there(other)) else {
            distinct.push((trial, None));
            continue;
        };
        if trial.set.last().is_some_and(|candidate| candidate.free.is_empty()) {
            let before = *cost.get_or_insert_with(|| by_noise(other));
            let after = by_noise(&trial);
            if after < before {
                (*other, *cost) = (trial, Some(after));
            }
        }
    }
    let mut distinct: Vec<Trial> = distinct.into_iter().map(|(trial, _)| trial).collect();
    distinct.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    distinct
}

/// Tells how far a rung is.
struct Counter<'a> {
    device: &'a str,
    of: usize,
    tell: &'a Tell<'a>,
    told: (AtomicUsize, Mutex<(f64, Option<String>)>),
}

impl Counter<'_> {
    /// Another candidate is done, and explains so much.
    fn count(&self, done: Option<(&Candidate, f64)>) {
        let mut best = self.told.1.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((candidate, explains)) = done.filter(|(_, explains)| *explains > best.0) {
            *best = (explains, Some(candidate.name()));
        }
        (self.tell)(&Progress {
            tried: self.told.0.fetch_add(1, Ordering::Relaxed) + 1,
            of: self.of,
            device: self.device.to_owned(),
            best: best.1.clone().unwrap_or_else(|| "none yet".to_owned()),
            explains: best.0,
        });
    }
}

/// Which part of each recording a rung begins with; the share of the gap that it must show, and how much that must be at least, as a square in
/// standard deviations: what is there from the beginning shows its part there, what comes later does not.
const EARLY: f64 = 1.0 / 3.0;
const LEAST_EARLY: f64 = 0.2;
const ENOUGH_EARLY: f64 = 300.0;

/// The first part of a device's recordings.
struct Early {
    subject: Subject,
    below: Trial,
    sought: Sought,
}

impl Early {
    /// `None` where it does not show enough of what there is to explain.
    fn of(bench: &Bench<'_>, below: &Trial, sought: Sought) -> Option<Early> {
        let all = Standing::of_trial(bench, below)?.excess(below.cost);
        let subject = bench.subject.early(EARLY);
        let there = bench.of_part(&subject);
        let first = there.trial(&below.set, below.at.clone())?;
        let share = Standing::of_trial(&there, &first)?.excess(first.cost) / all;
        let shows = share >= LEAST_EARLY && share * sought.excess >= ENOUGH_EARLY;
        shows.then_some(Early { subject, below: first, sought: Sought { excess: share * sought.excess, ..sought } })
    }

    /// The looks at it; `bench` is of its subject.
    fn looks<'a>(&'a self, bench: &'a Bench<'a>) -> Option<Looks<'a>> {
        let tangent = Tangent::new(bench, &self.below)?;
        let sought = self.sought;
        Some(Looks { bench, below: &self.below, tangent, blurred: &[], afar: None, sought, is_smooth: true })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::THRESHOLD;
    use crate::gap::cause::axis_tests::{report_as, rubbing_axis};
    use crate::gap::cause::bare::Bare;
    use crate::gap::cause::library::candidates;

    /// What a load lets rub moves an axis whose noise hides it in a way that no other witness does.
    #[test]
    fn friction_by_load_is_seen_beneath_the_noise() {
        let (mut subject, nominal, _) = rubbing_axis();
        let is_meant = |id: &str| id == "load-dependent-friction";
        let set = [candidates(&subject, &nominal, &subject.score(&nominal), &is_meant).swap_remove(0)];
        let stop = || false;
        let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&set, &[0.02]).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let bare = bench.trial(&[], Vec::new()).expect("a trial");
        let found = beneath(&bench, &bare, THRESHOLD, &is_meant).unwrap_or(0.0);
        assert!(found > THRESHOLD, "{found}");
    }

    /// Of two units the one that costs less by noise alone, though not as the gap weighs it; of friction's places the cheapest.
    #[test]
    fn of_several_units_that_is_named_which_fits_to_the_noise() {
        let (subject, nominal, rubs) = rubbing_axis();
        let units = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "wrong-unit");
        let (one, other) =
            (&units[0], units.iter().skip(1).find(|unit| unit.is_same(&units[0])).expect("another unit"));
        let stop = || false;
        let bare = Bench::new(&subject, Vec::new(), &stop).trial(&[], Vec::new()).expect("a trial");
        let trial = |candidate: &Candidate, cost: f64| Trial { set: vec![candidate.clone()], cost, ..bare.clone() };
        let trials = vec![trial(one, 100.0), trial(other, 101.0), trial(&rubs[0], 50.0), trial(&rubs[0], 60.0)];
        let by_noise = |trial: &Trial| if trial.cost == 100.0 { 9000.0 } else { 8.0 };
        let left = distinct(trials, &by_noise);
        assert_eq!(left.iter().map(|trial| trial.cost).collect::<Vec<_>>(), [50.0, 101.0]);
        assert_eq!(left[1].set[0].fixed, other.fixed);
    }

    /// An axis that rubs by its speed more than it declares, and whose declared friction and force limit stand at the ends of their tolerances for that:
    /// with these there, a little more of it gains nothing.
    #[test]
    fn what_made_up_for_an_effect_follows_it() {
        let (mut subject, nominal, _) = rubbing_axis();
        let rubs = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "viscous-friction");
        let stop = || false;
        for coefficient in [5.0, 10.0, 30.0] {
            let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&rubs[..1], &[coefficient]);
            report_as(&mut subject, &recorded.expect("a prediction"));
            let bare = Bare::new(&subject, &nominal);
            let bench = Bench::new(&subject, bare.nuisances.clone(), &stop);
            let below = bench.trial(&[], bare.at.clone()).expect("a trial");
            let rivals =
                rung(&bench, &below, Sought::in_parts(below.cost), &|id| id == "viscous-friction", &|_| true, &|_| {});
            let [found] = rivals.as_slice() else { panic!("{}", rivals.len()) };
            let is_found = found.cost < 0.05 * below.cost && (found.at[0] / coefficient - 1.0).abs() < 0.1;
            assert!(is_found, "{coefficient}: {:?} {} of {}", found.at, found.cost, below.cost);
        }
    }
}
