//! The ladder: the best effect, then a second and a third beside it, as long as each is worth having.

use std::sync::Arc;

use rayon::prelude::*;

use super::again::{exchange_first, seek_again};
use super::bare::about;
use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use super::class::coincidence;
use super::dropped::{drop_idle, drop_unknown, leave_alone_what_lets_go};
use super::glance::Sought;
use super::remainder::{Left, left_by};
use super::rung::{beneath, beneath_others, rung};
use super::two::step_by_two;
use super::unseen::{Folds, unseen};
use crate::gap::fit::{Effort, Range, Spread, spread, sum_of_squares};
use crate::gap::locate::beyond_rounding;
use crate::gap::statistics::{Draws, SAME_CLASS, least_gain, quantile, standing_out};
use crate::gap::{FAR_BEYOND, Prediction, Score, Subject, THRESHOLD, evidence, evidence_all_along, gains_with_motion};

/// The most effects of one device: a late, slow, limited drive with play, and a sensor that is off.
pub const MOST_EFFECTS: usize = 6;
/// Of the excess, what an effect must explain at least: the lower bound of it.
const LEAST_SHARE: f64 = 0.03;
/// The same of what the effects before it leave.
const LEAST_SHARE_OF_REST: f64 = 0.2;
/// Draws of the block bootstrap.
pub const DRAWS: usize = 400;
/// What share of the best one's gain a candidate must have for it to rival it once all is fitted anew.
pub const NEAR_THE_BEST: f64 = 0.3;

/// How far a search is.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Candidates tried so far on this device, and how many there are.
    pub tried: usize,
    pub of: usize,
    pub device: String,
    /// The best candidate so far, and which share of the excess it explains.
    pub best: String,
    pub explains: f64,
}

/// Where progress is told.
pub type Tell<'a> = dyn Fn(&Progress) + Sync + 'a;

/// What climbing found.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// The model with its nuisances fitted and no effect added, weighed by noise alone.
    pub bare: Trial,
    /// What its deviance would be where nothing is wrong, and the variance of that.
    pub floor: (f64, f64),
    /// What is to be had of the bare model at least: of what stands out, or, where nothing is off, of what goes with an effect.
    pub beneath: f64,
    /// Of that, what levels that show no noise cost more than their rounding, where nothing else shows that anything is off; 0 otherwise.
    pub beyond_rounding: f64,
    /// The best set; the bare model where no effect is worth having.
    pub best: Trial,
    /// How far each of its parameters may go, as far as walkers went; `None` where slopes say that.
    pub ends: Option<Vec<[f64; 2]>>,
    /// The device, weighed by what the best set leaves: what `best` and `singles` were scored with.
    pub subject: Subject,
    /// Where the best set is of one effect, every candidate alone, the best first.
    pub singles: Vec<Trial>,
    /// Candidates that were worth a part of what the best was, on any rung: what may rival an effect of the best set.
    pub near: Vec<Candidate>,
    /// How many candidates were tried in all.
    pub tried: usize,
    /// In how many blocks of time the gap lies that an effect would explain, where they are too few to be sure of it.
    pub too_few_blocks: Option<f64>,
    /// On which blocks that were not seen an effect has to be worth having.
    pub folds: Folds,
}

impl Ladder {
    /// What the bare model costs above the floor.
    pub fn excess(&self) -> f64 {
        self.bare.cost - self.floor.0
    }
}

/// What it takes to fit so many parameters from where they nearly are: a dozen steps downhill, each with as many differences.
pub fn anew(free: usize) -> Effort {
    const STEPS: u32 = 20;
    Effort { starts: 1, budget: (STEPS * (free as u32 + 1)).max(60) }
}

/// How many times more than the greatest of many chances takes away a witness must, where nothing else is evident. (With 2.8 none of the levels of
/// 67 machines with nothing wrong had a gap.)
const BENEATH: f64 = 3.0;

/// Climbs from the model with its nominal parameters at `at`; where it is not evident that anything is wrong, and no witness takes anything
/// away (`beneath`), nothing is looked for.
/// `is_asked` says which effects are; `tick`: within what the machine looks at its commands, s, 0 for none.
pub fn climb(
    bench: &Bench<'_>,
    (at, tick): (&[f64], f64),
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    tell: &Tell<'_>,
) -> Option<Ladder> {
    let bare = bench.trial(&[], at.to_vec())?;
    let prediction = bench.predict(&[], &bare.at)?;
    let score = bench.subject.score(&prediction);
    let floor = floor(&score);
    let subject = bench.subject.clone();
    let mut ladder = Ladder {
        best: bare.clone(),
        bare,
        floor,
        beneath: 0.0,
        beyond_rounding: 0.0,
        ends: None,
        subject,
        singles: vec![],
        near: vec![],
        tried: 0,
        too_few_blocks: None,
        folds: Folds::Long,
    };
    if evidence(bench.subject, &prediction) <= THRESHOLD {
        let least = BENEATH * THRESHOLD * ladder.bare.inflation();
        let found = beneath(bench, &ladder.bare, least, is_asked).unwrap_or(0.0);
        if found > least {
            ladder.beneath = found;
        } else {
            ladder.beyond_rounding = beyond_rounding(bench.subject, &prediction);
            ladder.beneath = ladder.beyond_rounding;
        }
        if ladder.beneath == 0.0 {
            return Some(ladder);
        }
    } else if Standing::of_trial(bench, &ladder.bare)?.excess(ladder.bare.cost) < least_excess(&ladder.bare) {
        ladder.beneath = evidence(bench.subject, &prediction).max(standing_out(&ladder.bare.blocks));
    }
    ladder.subject = bench.subject.tolerant(&prediction);
    ladder.best = bench.with(&ladder.subject).trial(&[], ladder.bare.at.clone())?;
    loop {
        let mut end = Rung::Taken;
        while end == Rung::Taken && ladder.best.set.len() < MOST_EFFECTS && !bench.is_stopped() {
            end = step(bench, &mut ladder, is_asked, tell);
            if end == Rung::Taken {
                seek_again(bench, &mut ladder);
                exchange_first(bench, &mut ladder);
            }
        }
        let is_dropped = drop_idle(bench, &mut ladder);
        // Of what reports states alone two delays that take each other's place say nothing before both give way; it is replayed in no time.
        let is_open = is_dropped || end == Rung::Unsure || ladder.best.set.is_empty() || !bench.subject.has_levels();
        if !is_open || !step_by_two(bench, &mut ladder, is_asked, tell) {
            break;
        }
    }
    while drop_unknown(bench, &mut ladder, tick) {}
    leave_alone_what_lets_go(bench, &mut ladder);
    if ladder.best.parameters() > 1 && !bench.subject.has_levels() {
        spread_out(bench, &mut ladder);
    }
    if ladder.best.set.len() == 1 {
        weigh_singles(bench, &mut ladder);
    }
    Some(ladder)
}

/// Looks where else the best set of a device that reports states alone costs less: of several parameters slopes do not lead there.
fn spread_out(bench: &Bench<'_>, ladder: &mut Ladder) {
    let subject = ladder.subject.clone();
    let weighed = bench.with(&subject);
    let best = &ladder.best;
    let cost = |at: &[f64]| weighed.residuals(&best.set, at).map(|residuals| sum_of_squares(&residuals));
    let rise = 3.84 * best.inflation();
    let Spread { best: found, ends } = spread(&cost, &best.fitted(), &best.ranges, best.parameters(), (rise, SEED));
    ladder.ends = Some(ends);
    if let Some(better) = weighed.trial(&best.set, found.at).filter(|better| better.cost < best.cost) {
        ladder.best = better;
    }
}

/// What walkers draw by.
const SEED: u64 = 1;

/// The deviance where nothing is wrong, and its variance.
pub fn floor(score: &Score) -> (f64, f64) {
    let sum = |of: fn(&(f64, f64)) -> f64| score.signals.iter().map(|signal| of(&signal.floor_cost)).sum();
    (sum(|floor| floor.0), sum(|floor| floor.1))
}

/// How a rung ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rung {
    /// With another effect.
    Taken,
    /// Without one, though one would explain much of what is left.
    Unsure,
    /// Without one.
    Left,
}

/// From which excess on an effect is looked for. What remembers itself may be what an effect leaves of itself: whether one is worth having is asked of what is
/// left with it.
fn least_excess(trial: &Trial) -> f64 {
    least_gain(1, 1) * trial.inflation().min(MOST_INFLATED)
}

/// One rung.
fn step(bench: &Bench<'_>, ladder: &mut Ladder, is_asked: &(dyn Fn(&str) -> bool + Sync), tell: &Tell<'_>) -> Rung {
    let below = ladder.best.clone();
    let Some(plain) = bench.trial(&below.set, below.at.clone()) else { return Rung::Left };
    let is_evident = |prediction: Arc<Prediction>| evidence_all_along(bench.subject, &prediction) > THRESHOLD;
    let (left, beneath) = match () {
        () if below.set.is_empty() => (Left::Much, ladder.beneath),
        () if bench.predict(&below.set, &below.at).is_some_and(is_evident) => {
            (left_by(bench, &below, &ladder.bare.at), 0.0)
        }
        () => match beneath_others(bench, &plain, &ladder.bare.at, is_asked) {
            Some(found) => (Left::Much, found),
            None => (Left::Nothing, 0.0),
        },
    };
    if left == Left::Nothing {
        return Rung::Left;
    }
    let Some(standing) = Standing::of_trial(bench, &plain) else { return Rung::Left };
    let least = if beneath > 0.0 { least_gain(1, 1) } else { least_excess(&plain) };
    if standing.excess(plain.cost).max(beneath) < least {
        return Rung::Left;
    }
    let subject = ladder.subject.clone();
    let weighed = bench.with(&subject);
    let Some(standing) = Standing::of_trial(&weighed, &below) else { return Rung::Left };
    let excess = standing.excess(below.cost).max(beneath);
    // Where nothing but its rounding shows that anything is off, the first effect must be the cause of most of that.
    let beyond = if below.set.is_empty() { ladder.beyond_rounding } else { 0.0 };
    let sought = if beyond > 0.0 { Sought::of_one(excess, MOST_OF_IT) } else { Sought::in_parts(excess) };
    let rivals = rung(&weighed, &below, sought, is_asked, &|_| true, tell);
    ladder.tried += rivals.len();
    let choices = choose(bench, &weighed, &below, &rivals);
    let gain = |trial: &Trial| below.cost - trial.cost;
    let most = rivals.first().map_or(0.0, gain);
    let near = rivals.iter().filter(|trial| gain(trial) > NEAR_THE_BEST * most);
    ladder.near.extend(near.filter_map(|trial| trial.set.last().cloned()));
    if below.set.is_empty() {
        ladder.singles = rivals;
    }
    let takes_most = |next: &Trial| {
        let next = bench.trial(&next.set, next.at.clone());
        next.is_some_and(|next| plain.cost - next.cost >= MOST_OF_IT * beyond)
    };
    // Of two that explain about as much, one may do so all along and the other in a few moments.
    let is_worth = |(next, subject): &(Trial, Subject)| {
        let as_left = bench.with(subject);
        is_worth_having(&as_left, &below, next, ladder)
            && (left == Left::Much || takes_nearly_all(&as_left, &below, next))
            && (beyond == 0.0 || takes_most(next))
    };
    let worth = choices.iter().position(is_worth);
    if let Some(place) = worth {
        (ladder.best, ladder.subject) = choices.into_iter().nth(place).expect("the place of one of them");
        return Rung::Taken;
    }
    let Some((next, subject)) = choices.first() else { return Rung::Left };
    if below.set.is_empty() {
        ladder.too_few_blocks = too_few_blocks(&bench.with(subject), &below, next, ladder);
    }
    if gain(next) >= LEAST_SHARE_OF_REST * excess { Rung::Unsure } else { Rung::Left }
}

/// Of what is little, an effect has to take away so much to be its cause. (Four that were one took away 0.88, 0.94, 0.97 and all; four that were none 0.76, 0.83,
/// 0.86 and 0.93.)
const NEARLY_ALL: f64 = 0.87;

/// The same of what a level that shows no noise costs more than its rounding.
const MOST_OF_IT: f64 = 0.5;

/// Whether `next` takes away nearly all that `below` leaves above the floor.
fn takes_nearly_all(bench: &Bench<'_>, below: &Trial, next: &Trial) -> bool {
    let Some(below) = bench.trial(&below.set, below.at.clone()) else { return false };
    let left = Standing::of_trial(bench, &below).map(|standing| standing.excess(below.cost));
    left.is_some_and(|left| below.cost - next.cost >= NEARLY_ALL * left)
}

/// How a trial's deviance stands to where nothing is wrong.
#[derive(Clone, Copy, Debug)]
pub struct Standing {
    /// What it would be there, and the variance of that.
    pub floor: (f64, f64),
    /// The same of the signal that costs the most above it, and by how much it does: late edges, beside thousands of samples of a
    /// level whose noise is known to a few per cent.
    pub worst: (f64, f64),
    pub above: f64,
}

impl Standing {
    /// As a device was scored.
    pub fn of(score: &Score) -> Standing {
        let each = score.signals.iter().map(|signal| (signal.cost - signal.floor_cost.0, signal.floor_cost));
        let (above, worst) = each.fold((0.0, (0.0, 0.0)), |most, next| if next.0 > most.0 { next } else { most });
        Standing { floor: floor(score), worst, above }
    }

    /// As `trial` leaves a device; what goes with the motion far beyond chance is above the floor, however high that is thought to be.
    pub fn of_trial(bench: &Bench<'_>, trial: &Trial) -> Option<Standing> {
        let prediction = bench.predict(&trial.set, &trial.at)?;
        let score = bench.subject.score(&prediction);
        let along = gains_with_motion(bench.subject, &prediction, &score);
        let standing = Standing::of(&score);
        Some(Standing { above: along.into_iter().fold(standing.above, f64::max), ..standing })
    }

    /// What `cost` is above the floor, in all or by one signal alone.
    pub fn excess(&self, cost: f64) -> f64 {
        (cost - self.floor.0).max(self.above)
    }
}

/// By no more than this what remembers itself weighs less, before it is known what it is.
pub const MOST_INFLATED: f64 = 10.0;

/// Below this share of the excess an effect would not be the answer, however sure.
const SHARE_OF_AN_ANSWER: f64 = 0.3;
/// In fewer blocks than this a gain is not sure: by the bootstrap, of k blocks among many all are missed with the chance e^-k, and a
/// lower bound of 2.5 % needs k = 3.7.
const LEAST_BLOCKS: f64 = 3.7;

/// In more blocks than this a device moves enough: a gap that shows in few of them is no lack of motion, but something that is there only
/// now and then.
const MOVES_ENOUGH: usize = 8;

/// How many blocks hold what `next` gains over `below`, where it gains enough to be the answer, they are too few to be sure, and the device
/// hardly moves in others.
fn too_few_blocks(bench: &Bench<'_>, below: &Trial, next: &Trial, ladder: &Ladder) -> Option<f64> {
    let below = &bench.trial(&below.set, below.at.clone())?;
    let (_, blocks) = gains(&below.blocks, &next.blocks);
    let further = next.parameters() - below.parameters();
    let gains_enough = below.cost - next.cost >= least_gain(further, ladder.tried) * next.inflation();
    let (floor, _) = Standing::of_trial(bench, below)?.floor;
    let explains = (below.cost - next.cost) / (below.cost - floor).max(1.0);
    let is_short = gains_enough && explains > SHARE_OF_AN_ANSWER && blocks < LEAST_BLOCKS;
    (is_short && bench.moving_blocks(&*bench.predict(&below.set, &below.at)?) <= MOVES_ENOUGH).then_some(blocks)
}

/// What share of the best one's gain one has to have that is taken where the best is not sure.
const NEARLY_THE_BEST: f64 = 0.8;

/// How many of a rung are refitted with everything free, and how many of the first of a device that reports states alone.
const SETTLED: usize = 3;
const SETTLED_AMONG_EDGES: usize = 8;

/// Those of the rung that are refitted with everything free, the best first.
fn settled_first<'a>(
    below: &Trial,
    rivals: &'a [Trial],
    most: usize,
    handicapped: &dyn Fn(&Trial) -> f64,
) -> Vec<&'a Trial> {
    let mut order: Vec<&Trial> = rivals.iter().collect();
    order.sort_by(|a, b| handicapped(a).total_cmp(&handicapped(b)));
    let mut first: Vec<&Trial> = order.into_iter().take(most).collect();
    let is_cheaper = |a: &&Trial, b: &&Trial| a.cost.total_cmp(&b.cost);
    // Weighed by what no effect leaves, one that leaves nothing may seem not to be worth its parameters.
    let closest = rivals.iter().min_by(is_cheaper);
    // What has no number fits all at once or not at all, and may do so once the nominal parameters follow it.
    let has_none = |trial: &&Trial| trial.set.last().is_some_and(|candidate| candidate.numbers() == 0);
    let gains = |trial: &&Trial| below.cost - trial.cost > least_gain(1, rivals.len());
    let plain = rivals.iter().filter(has_none).min_by(is_cheaper).filter(gains);
    for further in closest.into_iter().chain(plain) {
        if !first.iter().any(|trial| std::ptr::eq(*trial, further)) {
            first.push(further);
        }
    }
    first
}

/// The best of the rung, refitted with everything free: what costs least, where a further parameter and a nominal parameter that
/// is wrong have to be worth it; with the device as it weighs it. After it those that are nearly as good.
fn choose(bench: &Bench<'_>, weighed: &Bench<'_>, below: &Trial, rivals: &[Trial]) -> Vec<(Trial, Subject)> {
    // What remembers itself is what a trial leaves, and not what another does.
    let handicapped = |trial: &Trial| trial.cost + handicap(trial, below.set.len()) * trial.inflation();
    // Among edges a search may end far beside its goal.
    let is_first_among_edges = below.set.is_empty() && !bench.subject.has_levels();
    let most = if is_first_among_edges { SETTLED_AMONG_EDGES } else { SETTLED };
    let first = settled_first(below, rivals, most, &handicapped);
    let settled: Vec<(Trial, Subject)> =
        first.par_iter().filter_map(|trial| settle(bench, weighed, trial, below.set.is_empty())).collect();
    // They are compared as the one of them weighs the device that leaves the least.
    let left = |(trial, _): &(Trial, Subject)| {
        weighed.trial(&trial.set, trial.at.clone()).map_or(f64::INFINITY, |trial| trial.cost)
    };
    let left: Vec<f64> = settled.iter().map(left).collect();
    let Some(closest) = (0..settled.len()).min_by(|a, b| left[*a].total_cmp(&left[*b])) else { return Vec::new() };
    let common = bench.with(&settled[closest].1);
    let score = |(trial, _): &(Trial, Subject)| {
        let scored = common.trial(&trial.set, trial.at.clone());
        scored.map_or(f64::INFINITY, |scored| handicapped(&scored))
    };
    let scores: Vec<f64> = settled.iter().map(score).collect();
    let without = common.trial(&below.set, below.at.clone()).map_or(f64::INFINITY, |below| below.cost);
    let mut scored: Vec<(f64, (Trial, Subject))> = scores.into_iter().zip(settled).collect();
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    let best = scored[0].0;
    let is_near = |score: f64| score == best || without - score >= NEARLY_THE_BEST * (without - best);
    scored.into_iter().filter(|(score, _)| is_near(*score)).map(|(_, settled)| settled).collect()
}

/// Refits a trial with everything free, the device weighed by what the trial leaves, until that is one.
pub fn settle(bench: &Bench<'_>, weighed: &Bench<'_>, trial: &Trial, is_first: bool) -> Option<(Trial, Subject)> {
    // A delay that is a cycle of a task off leaves much, by which all is weighed until it is found.
    let rounds = if bench.times_of_commands(&trial.set).is_empty() { 3 } else { 6 };
    let (mut trial, mut subject) = (trial.clone(), weighed.subject.clone());
    // Among edges that came late by something that is known by itself, nominal parameters went where they made up for it, and no slope leads back.
    if trial.set.last().is_some_and(|candidate| !candidate.shown.is_empty()) {
        let at = about(weighed, &trial.set, &trial.at);
        trial = weighed.trial(&trial.set, at).unwrap_or(trial);
    }
    // Alone and weighed as it is, everything was free already; what a rugged deviance was fitted to was as well.
    let mut is_fitted = bench.is_rugged() || (is_first && bench.nuisances.is_empty());
    for _ in 0..rounds {
        let there = bench.with(&subject);
        let fit = |trial: Trial| {
            let fitted = there.fit(&trial.set, std::slice::from_ref(&trial.at), anew(trial.at.len()));
            fitted.unwrap_or(trial)
        };
        if !is_fitted {
            trial = fit(trial);
        }
        let periods = bench.periods(&trial.set);
        if !periods.is_empty() {
            trial = there.following(&trial, &periods).unwrap_or(trial);
        }
        while let Some(across) = there.across_cycles(&trial).filter(|across| trial.cost - across.cost > 1.0) {
            trial = fit(across);
        }
        let next = bench.tolerant(&trial)?;
        if next.weighs_as(&subject) {
            break;
        }
        (subject, is_fitted) = (next, false);
    }
    let trial = bench.with(&subject).trial(&trial.set, trial.at)?;
    Some((trial, subject))
}

/// How much less, in deviance, what acts by the same numbers must cost than the answer to be it.
const SURELY_LESS: f64 = 2.0;

/// What nominal parameters must gain, in deviance, to have followed.
const GAINED_BY_FOLLOWING: f64 = 1.0;

/// The candidates alone as the device is weighed at last; those fitted anew that explain the most, or did as much as the answer before it was fitted so.
fn weigh_singles(bench: &Bench<'_>, ladder: &mut Ladder) {
    const MOST: usize = 12;
    let weighed = bench.with(&ladder.subject);
    // Where the answer gained by nominal parameters that follow it, its rivals have to have them follow as well.
    let of_answer = ladder.singles.iter().find(|trial| {
        trial.set.last().zip(ladder.best.set.last()).is_some_and(|(single, answer)| single.is_same(answer))
    });
    let as_single = of_answer.and_then(|trial| weighed.trial(&trial.set, trial.at.clone()));
    let has_followed = as_single.is_some_and(|there| there.cost - ladder.best.cost > GAINED_BY_FOLLOWING);
    let answer = &ladder.best.at[..ladder.best.parameters()];
    let fitted = ladder.singles.par_iter().enumerate().filter_map(|(rank, trial)| {
        let there = weighed.trial(&trial.set, trial.at.clone())?;
        let is_near = ladder.bare.cost - there.cost > NEAR_THE_BEST * (ladder.bare.cost - ladder.best.cost)
            || of_answer.is_some_and(|answer| trial.cost < answer.cost + SAME_CLASS);
        let is_fitted = there.cost == trial.cost && !has_followed && !acts_alike(trial, &ladder.best);
        if rank >= MOST || !is_near {
            return Some(there);
        }
        let as_answer = weighed.carried(&trial.set, &ladder.best.overrides);
        if is_fitted {
            return Some(nearer(&weighed, &there, &as_answer).unwrap_or(there));
        }
        // Also from where they went for the answer: among times that are known within cycles no slope leads there. What acts by the same numbers
        // may be where the answer is.
        let is_within = |(range, value): (&Range, &f64)| (range.least..=range.greatest).contains(value);
        let may_be_there = acts_alike(trial, &ladder.best) && trial.ranges.iter().zip(answer).all(is_within);
        let same = may_be_there.then(|| [answer, &as_answer].concat());
        let starts = [trial.at.clone(), [&trial.at[..trial.parameters()], &as_answer].concat()];
        let starts: Vec<Vec<f64>> = starts.into_iter().chain(same).collect();
        weighed.fit(&trial.set, &starts, anew(trial.at.len())).or(Some(there))
    });
    let mut fitted: Vec<Trial> = fitted.collect();
    fitted.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let handicapped = |trial: &Trial| trial.cost + handicap(trial, 0) * trial.inflation();
    let is_better = |trial: &&Trial| {
        acts_alike(trial, &ladder.best) && handicapped(trial) < handicapped(&ladder.best) - SURELY_LESS
    };
    if let Some(better) = fitted.iter().find(is_better).cloned() {
        (ladder.best, ladder.ends) = (better, None);
    }
    ladder.singles = fitted;
}

/// Where a single number costs less about where it is, with nominal parameters that are `carried`: among flags alone no slope leads from one to the next.
fn nearer(bench: &Bench<'_>, trial: &Trial, carried: &[f64]) -> Option<Trial> {
    const STEP: f64 = 0.001;
    const STEPS: i32 = 30;
    let ([range], [number]) = (&trial.ranges[..trial.parameters()], &trial.at[..trial.parameters()]) else {
        return None;
    };
    if bench.subject.has_levels() {
        return None;
    }
    let each =
        (-STEPS..=STEPS).map(|step| (number * (1.0 + STEP * f64::from(step))).clamp(range.least, range.greatest));
    let tried = each.filter_map(|number| bench.trial(&trial.set, [&[number], carried].concat()));
    tried.filter(|other| other.cost < trial.cost).min_by(|a, b| a.cost.total_cmp(&b.cost))
}

/// Whether two single effects say what they do by numbers of the same names: a belt's slip and its parts' both by an acceleration.
fn acts_alike(one: &Trial, other: &Trial) -> bool {
    let names =
        |trial: &Trial| trial.set.iter().flat_map(|of| of.free.iter().map(|free| free.name)).collect::<Vec<_>>();
    let own = names(one);
    !own.is_empty() && own == names(other)
}

/// What a candidate beside `below` others has to gain over one with one parameter that is an effect.
pub fn handicap(trial: &Trial, below: usize) -> f64 {
    let new = trial.set.iter().skip(below);
    let further = new.clone().map(|candidate| candidate.free.len().max(1)).sum::<usize>().saturating_sub(1) as f64;
    let is_error = new.into_iter().any(Candidate::is_parameter_error);
    18.0 * further + if is_error { 18.0 } else { 0.0 } + coincidence(trial, below)
}

/// Whether `next` gains over `below` more than chance, a share worth having, and moves anything at all. The device is weighed by
/// what `next` leaves.
pub fn is_worth_having(bench: &Bench<'_>, below: &Trial, next: &Trial, ladder: &Ladder) -> bool {
    is_worth(bench, (below, next), ladder, 1.0)
}

/// An effect that stands is worth keeping by this part of the share that it takes to be taken up: two that need one another would come and go
/// where their shares lie about that.
pub const TO_STAY: f64 = 0.5;

/// The same where `part` of the shares is enough.
pub fn is_worth(bench: &Bench<'_>, (below, next): (&Trial, &Trial), ladder: &Ladder, part: f64) -> bool {
    let Some(below) = bench.trial(&below.set, below.at.clone()) else { return false };
    let gain = below.cost - next.cost;
    let further = next.parameters() - below.parameters();
    if gain < least_gain(further, ladder.tried) * next.inflation() || !is_a_share(bench, (&below, next), ladder, part) {
        return false;
    }
    let predictions = bench.predict(&below.set, &below.at).zip(bench.predict(&next.set, &next.at));
    predictions.is_some_and(|(below, next)| bench.differ(&below, &next))
}

/// Whether `next` surely takes away a share worth having beyond `below`: of the bare model's excess, or, where that is explained but
/// for a part of the motion, of what `below` leaves; on blocks that the parameters of neither
/// saw; where `part` of such a share is enough. By block bootstrap.
fn is_a_share(bench: &Bench<'_>, (below, next): (&Trial, &Trial), ladder: &Ladder, part: f64) -> bool {
    /// How many deviations of the floor an excess must be for the draws of it to say what a share of it is.
    const PLAIN: f64 = 5.0;
    let Some(bare) = bench.trial(&[], ladder.bare.at.clone()) else { return false };
    let Some(Standing { floor: (floor, variance), above, .. }) = Standing::of_trial(bench, &bare) else { return false };
    let is_plain = bare.cost - floor > PLAIN * variance.sqrt();
    let draws = Draws::new(below.blocks.len(), DRAWS, 1);
    let kept_back = |trial: &Trial| unseen(bench, trial, ladder.folds).unwrap_or_else(|| trial.blocks.clone());
    let (before, after) = (kept_back(below), kept_back(next));
    let surely = |whole: &[f64]| {
        let shares = draws.each(&[whole, &before, &after], |sums| {
            let excess = if is_plain { sums[0] - floor } else { above };
            (sums[1] - sums[2]) / excess.max(1.0)
        });
        quantile(&shares, 0.025)
    };
    let further = next.parameters() - below.parameters();
    let (sum, blocks) = gains(&before, &after);
    let is_confirmed = above > 0.0
        && (sum > EXPLAINED * above && blocks > FEWEST_BLOCKS * further as f64
            || sum > EXPLAINS_ALL * above && is_a_moments(bench, (below, next), sum, ladder));
    is_confirmed
        || surely(&bare.blocks) >= part * LEAST_SHARE
        || (!bench.is_rugged() && surely(&before) >= part * LEAST_SHARE_OF_REST)
}

/// An effect in a few rare events is believed where it explains so much of them, each by what the others say, and where they lie in so
/// many blocks for each of its parameters.
const EXPLAINED: f64 = 0.7;
const FEWEST_BLOCKS: f64 = 1.9;
/// One that has a single number is believed in a single event where it explains all of it, far beyond chance, and the device moves at many other times,
/// at which what it would do did not happen.
const EXPLAINS_ALL: f64 = 0.9;

/// Whether `next` is the first effect, has one number, gains `sum` far beyond chance and leaves nothing of a device that moves at many other times.
fn is_a_moments(bench: &Bench<'_>, (below, next): (&Trial, &Trial), sum: f64, ladder: &Ladder) -> bool {
    let further = next.parameters() - below.parameters();
    let least = FAR_BEYOND * least_gain(further, ladder.tried) * next.inflation();
    let moves_elsewhere = |below: Arc<Prediction>| bench.moving_blocks(&below) > MOVES_ENOUGH;
    let leaves_nothing = |next: Arc<Prediction>| evidence(bench.subject, &next) <= THRESHOLD;
    below.set.is_empty()
        && further <= 1
        && sum > least
        && bench.predict(&below.set, &below.at).is_some_and(moves_elsewhere)
        && bench.predict(&next.set, &next.at).is_some_and(leaves_nothing)
}

/// What is gained in all, and in how many blocks that lies.
fn gains(before: &[f64], after: &[f64]) -> (f64, f64) {
    let gains = before.iter().zip(after).map(|(before, after)| (before - after).max(0.0));
    let (sum, squares) = gains.fold((0.0, 0.0), |(sum, squares), gain| (sum + gain, squares + gain * gain));
    (sum, sum * sum / f64::max(squares, f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::cause::axis_tests::{report_as, rubbing_axis};
    use crate::gap::cause::library::candidates;

    /// Metres told as millimetres and as inches have nothing in common to be tried.
    #[test]
    fn what_has_no_number_acts_like_nothing() {
        let (subject, _, rubs) = rubbing_axis();
        let stop = || false;
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let [bare, rubbing] =
            [(vec![], vec![]), (rubs, vec![30.0])].map(|(set, at)| bench.trial(&set, at).expect("a trial"));
        assert!(acts_alike(&rubbing, &rubbing));
        assert!(!acts_alike(&bare, &bare) && !acts_alike(&rubbing, &bare));
    }

    /// A position that is always reported a little too great leaves the same from one sample to the next: what it is is looked for all the same.
    #[test]
    fn what_is_left_is_looked_into_though_it_remembers_itself() {
        let (mut subject, nominal, _) = rubbing_axis();
        let offsets = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "offset");
        let offset = offsets.into_iter().find(|of| of.component.as_deref() == Some("position")).expect("an offset");
        let stop = || false;
        let set = [offset];
        let by = subject.runs[0].floors.iter().map(|floor| floor.step).fold(f64::INFINITY, f64::min);
        let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&set, &[by]).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let bare = bench.trial(&[], Vec::new()).expect("a trial");
        let excess = Standing::of_trial(&bench, &bare).expect("a standing").excess(bare.cost);
        assert!(excess < least_gain(1, 1) * bare.inflation(), "{excess} {}", bare.inflation());
        let ladder = climb(&bench, (&[], 0.0), &|id| id == "offset", &|_| {}).expect("a ladder");
        let [found] = ladder.best.set.as_slice() else { panic!("{:?}", ladder.best.specs()) };
        assert!(found.is_same(&set[0]), "{}", found.name());
        assert!((ladder.best.at[0] / by - 1.0).abs() < 0.05, "{:?}", ladder.best.at);
    }

    /// An inverted report that gains something is fitted anew though three others gain more; one that gains nothing is not.
    #[test]
    fn what_has_no_number_is_fitted_anew() {
        let (subject, nominal, rubs) = rubbing_axis();
        let score = subject.score(&nominal);
        let inverted = candidates(&subject, &nominal, &score, &|id| id == "inverted").swap_remove(0);
        let stop = || false;
        let bare = Bench::new(&subject, Vec::new(), &stop).trial(&[], Vec::new()).expect("a trial");
        let trial = |candidate: &Candidate, cost: f64| Trial { set: vec![candidate.clone()], cost, ..bare.clone() };
        let below = Trial { cost: 1000.0, ..bare.clone() };
        let first = |gain: f64| {
            let costs = [500.0, 600.0, 700.0, 800.0].map(|cost| trial(&rubs[0], cost));
            let rivals: Vec<Trial> = costs.into_iter().chain([trial(&inverted, 1000.0 - gain)]).collect();
            let first = settled_first(&below, &rivals, SETTLED, &|trial| trial.cost);
            first.into_iter().map(|trial| trial.cost).collect::<Vec<_>>()
        };
        assert_eq!(first(40.0), [500.0, 600.0, 700.0, 960.0]);
        assert_eq!(first(1.0), [500.0, 600.0, 700.0]);
    }

    /// Beside friction a sensor's offset is a second effect, of which all that is left comes; half of it, which leaves a quarter, would be how joints bend.
    #[test]
    fn of_what_friction_leaves_an_effect_takes_nearly_all_or_is_none() {
        let (mut subject, nominal, rubs) = rubbing_axis();
        let offsets = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "offset");
        let offset = offsets.into_iter().find(|of| of.component.as_deref() == Some("position")).expect("an offset");
        let stop = || false;
        let set = [rubs[0].clone(), offset];
        let by = 3.0 * subject.runs[0].floors.iter().map(|floor| floor.step).fold(f64::INFINITY, f64::min);
        let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&set, &[80.0, by]).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let below = bench.trial(&set[..1], vec![80.0]).expect("a trial");
        assert_eq!(left_by(&bench, &below, &[]), Left::Little);
        let takes = |share: f64| {
            let next = bench.trial(&set, vec![80.0, share * by]).expect("a trial");
            takes_nearly_all(&bench, &below, &next)
        };
        assert_eq!([1.0, 0.9, 0.5].map(takes), [true, true, false]);
        let asked = |id: &str| id == "offset" || id == "coulomb-friction";
        let ladder = climb(&bench, (&[], 0.0), &asked, &|_| {}).expect("a ladder");
        let found: Vec<&str> = ladder.best.set.iter().map(|candidate| candidate.effect.id).collect();
        assert_eq!(found, ["coulomb-friction", "offset"]);
    }
}
