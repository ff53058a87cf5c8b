//! One rung of the ladder: what each candidate of the library explains beside the effects that are there already.
//!
//! A replay costs a millisecond, a fit a hundred of them, and a device has a hundred candidates. So each is glanced at first: a start
//! of its parameters moves the residuals along a direction, and along that direction alone it could take away
//! (d·r)²/|d|², how far it moves them being a matter of its parameter. Starts that move them next to nothing, or further than the
//! whole gap, are not looked at. Only what promises something is fitted, and only what then explains a part of what the best
//! explains is fitted closely. Where the first part of the recordings shows enough of the gap, all of that is done on it alone, and what is
//! found there is fitted to the whole.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::bench::{Bench, Trial};
use super::blur;
use super::candidate::Candidate;
use super::ladder::{NEAR_THE_BEST, Progress, Standing, Tell, anew};
use super::library;
use super::starts::UNLIMITED;
use super::tangent::{Beside, Tangent, product};
use crate::gap::fit::{Effort, least_squares, search, sum_of_squares};
use crate::gap::{Prediction, Score, Subject};
use crate::plant::EffectPlace;

/// What a candidate must explain to be looked at closely.
const PROMISING: f64 = 0.02;
/// What a glance must promise of that: several parameters together may do more than each start says.
const AT_A_GLANCE: [f64; 2] = [0.5, 0.2];
/// The same of what the most promising one promises.
const BESIDE_THE_BEST: [f64; 2] = [0.1, 0.03];
/// Squared, how far a start must move the residuals, in what is worth having, and how far it may, in all there is to explain.
const LEAST_MOVED: f64 = 0.05;
const MOST_MOVED: f64 = 4.0;

/// Every candidate that is admitted beside the effects of `below`, those held as they are; the best first.
pub fn rung(
    bench: &Bench<'_>,
    below: &Trial,
    excess: f64,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    is_admitted: &dyn Fn(&Candidate) -> bool,
    tell: &Tell<'_>,
) -> Vec<Trial> {
    let Some(prediction) = bench.predict(&below.set, &below.at) else { return Vec::new() };
    let Some(tangent) = Tangent::new(bench, below) else { return Vec::new() };
    let score = bench.subject.score(&prediction);
    let mut library = candidates_beside(bench, below, (&prediction, &score), is_asked);
    library.retain(is_admitted);
    let blurred = blur::blurred(bench.subject, &score);
    let is_smooth = !bench.is_rugged() && is_in_levels(&score, excess);
    let afar = blurred.first().filter(|_| !is_smooth).map(|subject| (subject, subject.residuals(&prediction)));
    let whole = Looks { bench, below, tangent, blurred: &blurred, afar, excess, is_smooth };
    let early = is_smooth.then(|| Early::of(bench, below, excess)).flatten();
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
    let most = glances.iter().map(|glance| glance.promise).fold(0.0, f64::max);
    let is_worth_a_fit = |glance: &Glance| {
        let share = BESIDE_THE_BEST[usize::from(glance.candidate.free.len() > 1)];
        glance.is_promising && glance.promise >= share * most
    };
    let fitted = glances.into_par_iter().with_max_len(1).filter_map(|glance| match is_worth_a_fit(&glance) {
        true => {
            let fitted = looks.fit(glance)?;
            counter.count(Some((&fitted.candidate, fitted.gain / looks.excess)));
            Some(fitted)
        }
        false => {
            if glance.is_promising {
                counter.count(None);
            }
            Some(Glance { is_promising: false, ..glance })
        }
    });
    let fitted: Vec<Glance> = fitted.collect();
    let most = fitted.iter().map(|glance| glance.gain).fold(0.0, f64::max);
    // Where slopes lead nowhere, what a few steps downhill gain says little.
    let is_near = |glance: &Glance| glance.is_promising && (bench.is_rugged() || glance.gain > NEAR_THE_BEST * most);
    let trials = fitted.into_par_iter().with_max_len(1).filter_map(|glance| {
        let is_near = is_near(&glance);
        let glance = match is_part {
            true => whole.again(if is_near { looks.closely(glance)? } else { glance }),
            false => glance,
        };
        match is_near {
            true => whole.fit_closely(glance, is_part),
            false if glance.candidate.free.is_empty() => whole.trial_at(&glance, &[]),
            // What promised little gets no nominal parameters of its own.
            false => bench.trial(&glance.set, whole.all(&glance, &glance.at)),
        }
    });
    // Weighed by what the effects so far leave, ten times as much is hardly anything else than 60/2π times as much.
    let by_noise = bench.subject.weighed_by_noise();
    let by_noise = bench.with(&by_noise);
    distinct(trials.collect(), &|trial| {
        by_noise.trial(&trial.set, trial.at.clone()).map_or(f64::INFINITY, |trial| trial.cost)
    })
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

/// What an effect takes away of a device's deviance though nothing that is asked of all motions shows that anything is off: the greatest
/// gain of the witnesses that promise the most, each fitted with all nominal parameters beside it. `None` where nothing promises as much as
/// `least`.
pub fn beneath(bench: &Bench<'_>, bare: &Trial, least: f64, is_asked: &(dyn Fn(&str) -> bool + Sync)) -> Option<f64> {
    /// The square of a whitened distance that shows clearly: a start that moves the levels by much more says nothing of one.
    const CLEAR: f64 = 1000.0;
    /// How many are fitted.
    const FITTED: usize = 3;
    let prediction = bench.predict(&[], &bare.at)?;
    let score = bench.subject.score(&prediction);
    if bench.is_rugged() || !score.are_levels().contains(&true) {
        return None;
    }
    let tangent = Tangent::new(bench, bare)?;
    let looks = Looks { bench, below: bare, tangent, blurred: &[], afar: None, excess: CLEAR, is_smooth: true };
    let is_asked = |id: &str| is_asked(id) && WITNESSES.contains(&id);
    let mut library = candidates_beside(bench, bare, (&prediction, &score), &is_asked);
    library.retain(|candidate| candidate.place != EffectPlace::ReportLink && candidate.place != EffectPlace::Sensor);
    let glances = library.into_par_iter().with_max_len(1).filter_map(|candidate| looks.glance(candidate));
    let mut glances: Vec<Glance> = glances.filter(|glance| glance.promise > least).collect();
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
        fitted.is_some_and(|fitted| bare.cost - fitted.cost > least)
    };
    let glances: Vec<Glance> = glances.into_par_iter().with_max_len(1).filter(is_kept).collect();
    if glances.is_empty() {
        return None;
    }
    let fit = |set: &[Candidate], at: Vec<f64>| bench.fit(set, std::slice::from_ref(&at), anew(at.len()));
    // An effect is no better for what the nominal parameters alone would do.
    let without = fit(&[], bare.at.clone()).map_or(bare.cost, |fitted| fitted.cost.min(bare.cost));
    let with = glances.par_iter().with_max_len(1).filter_map(|glance| {
        let fitted = fit(&glance.set, looks.all(glance, &glance.at))?;
        let there = bench.predict(&fitted.set, &fitted.at)?;
        bench.differ(&prediction, &there).then_some(fitted.cost)
    });
    Some(without - with.reduce(|| without, f64::min))
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
    excess: f64,
}

impl Early {
    /// `None` where it does not show enough of what there is to explain.
    fn of(bench: &Bench<'_>, below: &Trial, excess: f64) -> Option<Early> {
        let all = Standing::of_trial(bench, below)?.excess(below.cost);
        let subject = bench.subject.early(EARLY);
        let there = bench.of_part(&subject);
        let first = there.trial(&below.set, below.at.clone())?;
        let share = Standing::of_trial(&there, &first)?.excess(first.cost) / all;
        let shows = share >= LEAST_EARLY && share * excess >= ENOUGH_EARLY;
        shows.then_some(Early { subject, below: first, excess: share * excess })
    }

    /// The looks at it; `bench` is of its subject.
    fn looks<'a>(&'a self, bench: &'a Bench<'a>) -> Option<Looks<'a>> {
        let tangent = Tangent::new(bench, &self.below)?;
        let excess = self.excess;
        Some(Looks { bench, below: &self.below, tangent, blurred: &[], afar: None, excess, is_smooth: true })
    }
}

/// What all candidates of a rung have in common.
struct Looks<'a> {
    bench: &'a Bench<'a>,
    below: &'a Trial,
    tangent: Tangent,
    blurred: &'a [Subject],
    /// The device with its edges least well known, and its residuals without the candidate: where the gap lies in edges, those that are
    /// known to the millisecond move with nothing.
    afar: Option<(&'a Subject, Vec<f64>)>,
    excess: f64,
    /// Whether the gap lies in levels, which move with a parameter from its first trace on.
    is_smooth: bool,
}

/// A candidate, and what is known of it so far.
struct Glance {
    candidate: Candidate,
    set: Vec<Candidate>,
    beside: Beside,
    /// Where it stands.
    at: Vec<f64>,
    /// Other places to begin at, the best first.
    others: Vec<Vec<f64>>,
    /// Where a search among edges that are seen from afar begins, the best first; empty where it need not.
    afar: Vec<Vec<f64>>,
    /// By how much it costs less there than nothing.
    gain: f64,
    /// By how much it might.
    promise: f64,
    is_promising: bool,
}

impl Glance {
    /// The same, standing where `looks` cost least.
    fn at_the_best_of(mut self, mut looks: Vec<Look>) -> Option<Glance> {
        looks.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let mut looks = looks.into_iter();
        let first = looks.next()?;
        (self.at, self.gain) = (first.at, sum_of_squares(&self.beside.here) - first.cost);
        self.others = looks.take(2).map(|look| look.at).collect();
        Some(self)
    }
}

/// The device as it is looked at: its residuals without the candidate, and how much there is to explain.
struct Sight<'a> {
    bench: &'a Bench<'a>,
    here: &'a [f64],
    excess: f64,
}

/// What a candidate's starts promise together.
struct Promise {
    most: f64,
    is_kept: bool,
}

impl Sight<'_> {
    /// What looks promise, and whether that is worth a fit.
    fn promise(&self, glance: &Glance, looks: &[Look]) -> Promise {
        let worth = PROMISING * self.excess * AT_A_GLANCE[usize::from(glance.candidate.free.len() > 1)];
        let most = looks.iter().map(|look| look.promise).fold(0.0, f64::max);
        Promise { most, is_kept: most > worth }
    }
}

/// A start that was looked at.
struct Look {
    at: Vec<f64>,
    cost: f64,
    /// How far it moves the residuals, squared.
    moved: f64,
    /// What it could take away along the way that it moves them, and by which multiple of that.
    promise: f64,
    multiple: f64,
}

impl Looks<'_> {
    /// What a candidate's starts promise.
    fn glance(&self, candidate: Candidate) -> Option<Glance> {
        let set: Vec<Candidate> = self.below.set.iter().chain([&candidate]).cloned().collect();
        let beside = self.tangent.beside(self.bench, &set);
        let mut glance = Glance {
            candidate,
            set,
            beside,
            at: Vec::new(),
            others: Vec::new(),
            afar: Vec::new(),
            gain: 0.0,
            promise: 0.0,
            is_promising: false,
        };
        if glance.candidate.free.is_empty() {
            glance.gain = sum_of_squares(&glance.beside.here) - sum_of_squares(&self.residuals(&glance, &[])?);
            return Some(glance);
        }
        let near = Sight { bench: self.bench, here: &glance.beside.here, excess: self.excess };
        let mut promise = None;
        let looks = match (&self.afar, self.is_smooth) {
            (_, true) => self.look_about(&near, &glance),
            (None, false) => self.look_at_all(&near, &glance),
            (Some((subject, residuals)), false) => {
                let strain =
                    self.bench.strain(&glance.set, &self.all(&glance, &vec![0.0; glance.candidate.free.len()]));
                let here = glance.beside.left_of([residuals.as_slice(), &strain].concat());
                let sight = Sight { bench: &self.bench.with(subject), excess: sum_of_squares(&here), here: &here };
                let mut looks = self.look_about(&sight, &glance);
                looks.sort_by(|a, b| a.cost.total_cmp(&b.cost));
                promise = Some(sight.promise(&glance, &looks));
                if promise.as_ref().is_some_and(|promise| promise.is_kept) {
                    glance.afar = looks.iter().map(|look| look.at.clone()).collect();
                }
                looks.first().and_then(|look| self.look(&near, &glance, &look.at)).into_iter().collect()
            }
        };
        let promise = promise.unwrap_or_else(|| match self.is_smooth {
            true => near.promise(&glance, &looks),
            // What costs the same wherever it is begun has nothing to act on in these recordings.
            false => Promise { most: 0.0, is_kept: looks.iter().any(|look| look.moved > 1e-9) },
        });
        Glance { is_promising: promise.is_kept, promise: promise.most, ..glance }.at_the_best_of(looks)
    }

    /// All parameters of a candidate at `at`, the nuisances where they are held.
    fn all(&self, glance: &Glance, at: &[f64]) -> Vec<f64> {
        [&self.below.at[..self.below.parameters()], at, &glance.beside.carried].concat()
    }

    fn residuals(&self, glance: &Glance, at: &[f64]) -> Option<Vec<f64>> {
        Some(glance.beside.left_of(self.bench.residuals(&glance.set, &self.all(glance, at))?))
    }

    fn look(&self, sight: &Sight<'_>, glance: &Glance, at: &[f64]) -> Option<Look> {
        let there = glance.beside.left_of(sight.bench.residuals(&glance.set, &self.all(glance, at))?);
        let here = sight.here;
        let cost = sum_of_squares(&there);
        if there.len() != here.len() {
            return Some(Look { at: at.to_vec(), cost, moved: f64::INFINITY, promise: 0.0, multiple: 1.0 });
        }
        let moved: Vec<f64> = there.iter().zip(here).map(|(there, here)| there - here).collect();
        let squared = sum_of_squares(&moved);
        let along = product(&moved, here);
        let multiple = if squared > 0.0 { -along / squared } else { 0.0 };
        Some(Look { at: at.to_vec(), cost, moved: squared, promise: multiple * multiple * squared, multiple })
    }

    /// Of a single parameter the starts that move the residuals by more than nothing and by less than the whole gap, either way from
    /// where it does nothing; of several, all.
    fn look_about(&self, sight: &Sight<'_>, glance: &Glance) -> Vec<Look> {
        let candidate = &glance.candidate;
        let [free] = candidate.free.as_slice() else {
            let mut looks: Vec<Look> =
                candidate.starts.iter().filter_map(|start| self.look(sight, glance, start)).collect();
            looks.extend(self.look_ahead_of_several(sight, glance, &looks));
            return looks;
        };
        let parameter = candidate.effect.parameters.iter().find(|of| of.name == free.name);
        let nominal = match (candidate.is_parameter_error(), parameter) {
            (false, Some(parameter)) => parameter.nominal,
            _ => return candidate.starts.iter().filter_map(|start| self.look(sight, glance, start)).collect(),
        };
        let mut looks = Vec::new();
        for side in [1.0, -1.0] {
            let mut starts: Vec<f64> =
                candidate.starts.iter().map(|start| start[0]).filter(|at| side * (at - nominal) > 0.0).collect();
            starts.sort_by(|a, b| (a - nominal).abs().total_cmp(&(b - nominal).abs()));
            self.look_outward(sight, glance, &starts, &mut looks);
        }
        looks.extend(self.look_ahead(sight, glance, nominal, &looks));
        looks
    }

    /// Looks where the most promising look says that the least cost is, if the effect is a multiple of its parameter; from there again as
    /// long as that costs more than no effect: of a start that is a hundred times too far such a step is off by more than what there is.
    fn look_ahead(&self, sight: &Sight<'_>, glance: &Glance, nominal: f64, looks: &[Look]) -> Vec<Look> {
        const STEPS: usize = 3;
        let range = glance.candidate.free[0].range;
        let without = sum_of_squares(sight.here);
        let mut ahead: Vec<Look> = Vec::new();
        // What is nominally without limit is no multiple of anything.
        let most = if nominal.abs() < UNLIMITED { STEPS } else { 0 };
        while ahead.len() < most {
            let of_starts =
                || looks.iter().filter(|look| look.moved > 0.0).max_by(|a, b| a.promise.total_cmp(&b.promise));
            let Some(from) = ahead.last().or_else(of_starts) else { break };
            let at = nominal + from.multiple * (from.at[0] - nominal);
            if !from.multiple.is_finite() || !(range.least..=range.greatest).contains(&at) {
                break;
            }
            let Some(look) = self.look(sight, glance, &[at]) else { break };
            let is_there = look.cost < without;
            ahead.push(look);
            if is_there {
                break;
            }
        }
        ahead
    }

    /// The same of several parameters, the first of which says how much there is of an effect, such as the force of a friction that falls
    /// with speed: for the others as they are where a look promises the most.
    fn look_ahead_of_several(&self, sight: &Sight<'_>, glance: &Glance, looks: &[Look]) -> Vec<Look> {
        const MOST: usize = 3;
        let candidate = &glance.candidate;
        let Some(amount) = candidate.free.first() else { return Vec::new() };
        let parameter = candidate.effect.parameters.iter().find(|of| of.name == amount.name);
        if parameter.is_none_or(|parameter| parameter.nominal != 0.0) {
            return Vec::new();
        }
        let mut best: Vec<&Look> = looks.iter().filter(|look| look.moved > 0.0 && look.multiple > 0.0).collect();
        best.sort_by(|a, b| b.promise.total_cmp(&a.promise));
        let ahead = best.into_iter().take(MOST).filter_map(|look| {
            let mut at = look.at.clone();
            at[0] = (look.multiple * at[0]).clamp(amount.range.least, amount.range.greatest);
            self.look(sight, glance, &at)
        });
        ahead.collect()
    }

    /// Looks at starts that move the residuals the more the later they come.
    fn look_outward(&self, sight: &Sight<'_>, glance: &Glance, starts: &[f64], looks: &mut Vec<Look>) {
        let (least, most) = (LEAST_MOVED * PROMISING * sight.excess, MOST_MOVED * sight.excess);
        let (mut low, mut high) = (0, starts.len());
        let mut seen: Vec<Option<Look>> = starts.iter().map(|_| None).collect();
        while low < high {
            let middle = (low + high) / 2;
            let Some(look) = self.look(sight, glance, &[starts[middle]]) else { return };
            if look.moved < least {
                low = middle + 1
            } else {
                high = middle
            }
            seen[middle] = Some(look);
        }
        for (place, start) in starts.iter().enumerate().skip(low) {
            if seen[place].is_none() {
                seen[place] = self.look(sight, glance, &[*start]);
            }
            if seen[place].as_ref().is_none_or(|look| look.moved > most) {
                break;
            }
        }
        looks.extend(seen.into_iter().flatten());
    }

    /// All starts. Those of a single parameter go from small effects to large ones: once some in a row cost far more than no effect at
    /// all, the larger ones are not tried.
    fn look_at_all(&self, sight: &Sight<'_>, glance: &Glance) -> Vec<Look> {
        const HOPELESS: f64 = 2.0;
        const IN_A_ROW: usize = 3;
        let without = sum_of_squares(sight.here);
        let mut looks: Vec<Look> = Vec::with_capacity(glance.candidate.starts.len());
        let mut hopeless = 0;
        for look in glance.candidate.starts.iter().filter_map(|start| self.look(sight, glance, start)) {
            hopeless = if look.cost > HOPELESS * without { hopeless + 1 } else { 0 };
            looks.push(look);
            if glance.candidate.free.len() == 1 && hopeless == IN_A_ROW {
                break;
            }
        }
        looks
    }

    /// A candidate where edges that are seen from afar, and then nearer and nearer, lead it.
    fn sharpened(&self, glance: Glance) -> Option<Glance> {
        if glance.afar.is_empty() {
            return Some(glance);
        }
        let all = |at: &[f64]| self.all(&glance, at);
        let of = (glance.set.as_slice(), &glance.candidate);
        let starts = blur::sharpened(self.bench, self.blurred, of, &glance.afar, &all);
        let near = Sight { bench: self.bench, here: &glance.beside.here, excess: self.excess };
        let starts = starts.unwrap_or_else(|| vec![glance.at.clone()]);
        let looks = starts.iter().filter_map(|start| self.look(&near, &glance, start)).collect();
        glance.at_the_best_of(looks)
    }

    /// A few steps downhill, and whether that is worth a closer look.
    fn fit(&self, glance: Glance) -> Option<Glance> {
        let glance = self.downhill(self.sharpened(glance)?)?;
        Some(Glance { is_promising: glance.gain > PROMISING * self.excess, ..glance })
    }

    /// Where it costs least of what is found from its best starts.
    fn closely(&self, glance: Glance) -> Option<Glance> {
        let ranges: Vec<_> = glance.candidate.ranges().collect();
        let residuals = |at: &[f64]| self.residuals(&glance, at);
        let starts: Vec<Vec<f64>> = [&glance.at].into_iter().chain(&glance.others).cloned().collect();
        let effort = Effort { starts: 2, budget: 20 + 12 * ranges.len() as u32 };
        let at = search(&residuals, &starts, &ranges, effort)?.at;
        Some(Glance { at, ..glance })
    }

    /// What was found on a part of the recordings, as these are looked at.
    fn again(&self, glance: Glance) -> Glance {
        Glance { beside: self.tangent.beside(self.bench, &glance.set), ..glance }
    }

    /// The candidate with the nuisances beside it; `is_near`: a part of the recordings has led it to where a few steps are enough.
    fn fit_closely(&self, glance: Glance, is_near: bool) -> Option<Trial> {
        if self.bench.is_rugged() {
            let start = self.all(&glance, &glance.at);
            return self.bench.fit(&glance.set, &[start], anew(self.bench.ranges(&glance.set).len()));
        }
        let glance = if is_near { self.downhill(glance)? } else { self.closely(glance)? };
        self.trial_at(&glance, &glance.at)
    }

    /// A few steps downhill from where it stands.
    fn downhill(&self, glance: Glance) -> Option<Glance> {
        let ranges: Vec<_> = glance.candidate.ranges().collect();
        let residuals = |at: &[f64]| self.residuals(&glance, at);
        let fitted = least_squares(&residuals, &glance.at, &ranges, 4 + 4 * ranges.len() as u32)?;
        let gain = sum_of_squares(&glance.beside.here) - fitted.cost;
        Some(Glance { at: fitted.at, gain, ..glance })
    }

    /// With the nuisances at their nominal values: of an effect without a parameter, which leaves next to nothing or nearly everything, so
    /// that nuisances fitted to the machine without it say nothing.
    fn afresh(&self, glance: &Glance) -> Option<Vec<f64>> {
        let is_first = glance.candidate.free.is_empty() && self.below.set.is_empty();
        is_first.then(|| self.bench.nominal(&glance.set))
    }

    fn cheapest(&self, places: impl Iterator<Item = Vec<f64>>, glance: &Glance) -> Option<Trial> {
        let trials = places.filter_map(|at| self.bench.trial(&glance.set, at));
        trials.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// With the nuisances as they follow, or where they are held, whichever costs less.
    fn trial_at(&self, glance: &Glance, at: &[f64]) -> Option<Trial> {
        let held = self.all(glance, at);
        let there = self.cheapest([held.clone()].into_iter().chain(self.afresh(glance)), glance)?;
        let followed = glance.beside.follow(&self.bench.residuals(&glance.set, &held)?);
        if followed == glance.beside.carried {
            return Some(there);
        }
        let own = held.len() - followed.len();
        let other = self.bench.trial(&glance.set, [&held[..own], &followed].concat());
        Some(match other {
            Some(other) if other.cost < there.cost => other,
            _ => there,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::THRESHOLD;
    use crate::gap::cause::axis_tests::{report_as, rubbing_axis};
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
}
