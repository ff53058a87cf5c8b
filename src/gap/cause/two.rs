//! Two effects at once, where one that seemed to explain much turned out not to be worth having, or where none is alone: it may have stood for two that are.
//!
//! A ladder that adds the best effect, then the best beside it, ends where only two together say more. A drive that eases into its
//! target by a lag and accelerates no faster than it can is one: beside a dead time as long as both take, the lag gains
//! nothing until the dead time gives way, the acceleration nothing that lasts without the lag, and a limit of speed that is
//! not there stands for both. So here what each candidate gains is asked with all that was found given free, and the best of them are
//! stones to step on to a second one; or one is enough, where all gives way to it.
//!
//! Such a motion comes once in many a recording. That no long span without it can predict it is no wonder: from here on an effect has
//! to be worth having on blocks of the same span that its fit did not see.

use rayon::prelude::*;

use super::bench::{Bench, Trial};
use super::candidate::{Candidate, Free};
use super::glance::Sought;
use super::ladder::{Ladder, MOST_EFFECTS, MOST_INFLATED, Standing, Tell, anew, is_worth_having, settle};
use super::rung::{library_beside, rung};
use super::tangent::{orthonormal, product, take_out};
use super::unseen::Folds;
use crate::gap::fit::{Fitted, Slopes, least_squares, sum_of_squares};
use crate::gap::statistics::least_gain;
use crate::gap::{FAR_BEYOND, THRESHOLD, evidence};

/// Of the excess, what must be left.
const LEAST_LEFT: f64 = 0.1;
/// How many candidates are stepped on.
const STONES: usize = 4;
/// How many are where nothing was found: what explained the most alone, though that was not worth having.
const FIRST_STONES: usize = 1;
/// How many go a few steps downhill for that: those that promise to leave the least.
const LOOKED_AT: usize = 32;
/// How many of them are fitted.
const FITTED: usize = 16;
/// How many steps downhill, beside those that tell two slopes of each parameter.
const STEPS: u32 = 6;

/// Adds two effects to the best set if together they are worth having; whether they were.
pub fn step_by_two(
    bench: &Bench<'_>,
    ladder: &mut Ladder,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    tell: &Tell<'_>,
) -> bool {
    let below = ladder.best.clone();
    let is_first = below.set.is_empty();
    if is_first && !bears_two(bench, ladder) || below.set.len() + 2 > MOST_EFFECTS || bench.is_stopped() {
        return false;
    }
    let subject = ladder.subject.clone();
    let weighed = bench.with(&subject);
    let Some(standing) = Standing::of_trial(&weighed, &below) else { return false };
    let Some(bare) = weighed.trial(&[], ladder.bare.at.clone()) else { return false };
    if standing.excess(below.cost) < LEAST_LEFT * (bare.cost - standing.floor.0) {
        return false;
    }
    let beside =
        |stone: &Trial| rung(&weighed, stone, Sought::in_parts(standing.excess(stone.cost)), is_asked, &|_| true, tell);
    let stones = if is_first {
        stones(&ladder.singles, FIRST_STONES)
    } else {
        let Some((free, tried)) = beside_what_was_found(&weighed, &below, is_asked) else { return false };
        ladder.tried += tried;
        // One may be enough where all that was found gives way to it.
        if free.first().is_some_and(|alone| takes(bench, ladder, &weighed, &below, alone)) {
            return true;
        }
        stones(&free, STONES)
    };
    let mut pairs: Vec<Trial> = Vec::new();
    for stone in stones {
        pairs.extend(beside(&stone));
        // What is left of a swing remembers itself as long as that: it would be nothing by a hundred times its noise.
        let leaves_nothing =
            |pair: &Trial| standing.excess(pair.cost) < least_gain(1, 1) * pair.inflation().min(MOST_INFLATED);
        if pairs.iter().any(leaves_nothing) {
            break;
        }
    }
    ladder.tried += pairs.len();
    let pair = pairs.iter().min_by(|a, b| a.cost.total_cmp(&b.cost));
    pair.is_some_and(|pair| takes(bench, ladder, &weighed, &below, pair))
}

/// Takes a set, settled, in the place of the best one `below`, if it is worth having; whether it was.
fn takes(bench: &Bench<'_>, ladder: &mut Ladder, weighed: &Bench<'_>, below: &Trial, set: &Trial) -> bool {
    let settled = settle(bench, weighed, set, false).and_then(|(set, subject)| {
        let deeper = deepest(&bench.with(&subject), &set, below.parameters());
        settle(bench, &bench.with(&subject), &deeper, false)
    });
    let Some((set, subject)) = settled else { return false };
    let before = std::mem::replace(&mut ladder.folds, Folds::Short);
    let is_worth = is_worth_having(&bench.with(&subject), below, &set, ladder);
    match is_worth {
        true => (ladder.best, ladder.subject) = (set, subject),
        false => ladder.folds = before,
    }
    is_worth
}

/// Whether a gap of which no effect explains enough may be asked for two at once. They explain more by chance than one: it has to be a gap though nothing
/// explains it, and to show in enough motion for one.
fn bears_two(bench: &Bench<'_>, ladder: &Ladder) -> bool {
    let bare = bench.predict(&[], &ladder.bare.at);
    let is_a_gap = bare.is_some_and(|bare| evidence(bench.subject, &bare) > FAR_BEYOND * THRESHOLD);
    is_a_gap && ladder.too_few_blocks.is_none()
}

/// What each candidate leaves beside the effects of `below` with all of those given free, the best first; and how many there are.
fn beside_what_was_found(
    weighed: &Bench<'_>,
    below: &Trial,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
) -> Option<(Vec<Trial>, usize)> {
    let library = library_beside(weighed, below, is_asked)?;
    let tried = library.len();
    let about = About::new(weighed, below)?;
    let promised = library.into_par_iter().with_max_len(1).map(|candidate| (about.leaves(&candidate), candidate));
    let mut promised: Vec<(f64, Candidate)> = promised.collect();
    promised.sort_by(|a, b| a.0.total_cmp(&b.0));
    promised.truncate(LOOKED_AT);
    let alone = promised.into_par_iter().with_max_len(1);
    let mut begun: Vec<Begun> = alone.filter_map(|(_, candidate)| giving_way(weighed, below, candidate)).collect();
    begun.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    begun.truncate(FITTED);
    let fit = |Begun { set, at, .. }: Begun| {
        let found = weighed.fit(&set, std::slice::from_ref(&at), anew(at.len()))?;
        Some(in_their_place(weighed, &found, below.parameters()).unwrap_or(found))
    };
    let mut free: Vec<Trial> = begun.into_par_iter().with_max_len(1).filter_map(fit).collect();
    free.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    Some((free, tried))
}

/// A set where a few steps downhill led.
struct Begun {
    set: Vec<Candidate>,
    at: Vec<f64>,
    cost: f64,
}

/// Which starts of a candidate are tried, the near ones and the far ones.
fn places(candidate: &Candidate) -> Vec<usize> {
    let count = candidate.starts.len();
    let mut places = vec![count / 4, count / 2, (3 * count) / 4];
    places.dedup();
    places
}

/// A trial, and how what it leaves changes with all that is free.
struct About<'a> {
    bench: &'a Bench<'a>,
    below: &'a Trial,
    /// How many residuals the recordings have: tolerances' come behind.
    rows: usize,
    basis: Vec<Vec<f64>>,
    left: Vec<f64>,
}

impl<'a> About<'a> {
    fn new(bench: &'a Bench<'a>, below: &'a Trial) -> Option<About<'a>> {
        let slopes = Slopes::of(&|at: &[f64]| bench.residuals(&below.set, at), &below.at, &below.ranges)?;
        let rows = slopes.here().len() - bench.names_beside(&below.set).count();
        let column = |place: usize| slopes.column(place)[..rows].to_vec();
        let basis = orthonormal(&(0..below.ranges.len()).map(column).collect::<Vec<_>>());
        let mut left = slopes.here()[..rows].to_vec();
        take_out(&mut left, &basis);
        Some(About { bench, below, rows, basis, left })
    }

    /// About how much a candidate would leave if all gave way, to first order: at the best of its starts, or where that points to.
    fn leaves(&self, candidate: &Candidate) -> f64 {
        let set: Vec<Candidate> = self.below.set.iter().chain([candidate]).cloned().collect();
        let carried = self.bench.carried(&set, &self.below.overrides);
        let leaves = |place: usize| {
            let at = [&self.below.at[..self.below.parameters()], &candidate.starts[place], &carried].concat();
            let mut there = self.bench.residuals(&set, &at)?;
            there.truncate(there.len() - carried.len());
            if there.len() != self.rows {
                return Some(sum_of_squares(&there));
            }
            take_out(&mut there, &self.basis);
            let moved: Vec<f64> = there.iter().zip(&self.left).map(|(there, left)| there - left).collect();
            let (along, squared) = (product(&moved, &self.left), sum_of_squares(&moved));
            let gain = if squared > 0.0 && along < 0.0 { along * along / squared } else { 0.0 };
            Some(sum_of_squares(&there).min(sum_of_squares(&self.left) - gain))
        };
        places(candidate).into_iter().filter_map(leaves).fold(f64::INFINITY, f64::min)
    }
}

/// A candidate beside those of `below` with everything free, from near and far: what does nearly what one of them does (a lag, and a
/// dead time) shows nothing until that gives way.
fn giving_way(bench: &Bench<'_>, below: &Trial, candidate: Candidate) -> Option<Begun> {
    let starts: Vec<Vec<f64>> = places(&candidate).into_iter().map(|place| candidate.starts[place].clone()).collect();
    let set: Vec<Candidate> = below.set.iter().cloned().chain([candidate]).collect();
    let ranges = bench.ranges(&set);
    let carried = bench.carried(&set, &below.overrides);
    let fitted = starts.into_iter().filter_map(|own| {
        let at = [&below.at[..below.parameters()], &own, &carried].concat();
        least_squares(&|at: &[f64]| bench.residuals(&set, at), &at, &ranges, STEPS + 2 * ranges.len() as u32)
    });
    let Fitted { at, cost, .. } = fitted.min_by(|a, b| a.cost.total_cmp(&b.cost))?;
    Some(Begun { set, at, cost })
}

/// A trial whose last effect, a delay, takes as much of the place of one of the others, the first `known` figures, where that costs less: of edges that come later by
/// both, no slope leads there while each of the two alone explains some of them to the moment.
fn in_their_place(bench: &Bench<'_>, trial: &Trial, known: usize) -> Option<Trial> {
    let free: Vec<&Free> = trial.set.iter().flat_map(|candidate| &candidate.free).collect();
    let new: Vec<usize> = (known..free.len()).filter(|place| free[*place].is_time).collect();
    let [new] = new.as_slice() else { return None };
    let instead = |place: usize| {
        let mut at = trial.at.clone();
        at[place] -= trial.at[*new];
        bench.trial(&trial.set, at)
    };
    let others = (0..known).filter(|place| free[*place].is_time && trial.at[*place] > trial.at[*new]);
    let cheapest = others.filter_map(instead).min_by(|a, b| a.cost.total_cmp(&b.cost))?;
    let fitted = bench.fit(&trial.set, std::slice::from_ref(&cheapest.at), anew(cheapest.at.len()))?;
    (fitted.cost < trial.cost).then_some(fitted)
}

/// A drive whose speed may not follow its loop swings, and its deviance has false minima side by side along each of its figures: where
/// one is deeper a little further on, from there downhill. The figures after the first `known` are tried.
fn deepest(bench: &Bench<'_>, trial: &Trial, known: usize) -> Trial {
    const FACTORS: [f64; 8] = [0.7, 0.8, 0.87, 0.94, 1.06, 1.13, 1.25, 1.4];
    const ROUNDS: u32 = 3;
    let mut best = trial.clone();
    for _ in 0..ROUNDS {
        let aside = |place: usize, factor: f64| {
            let mut at = best.at.clone();
            let range = best.ranges[place];
            at[place] = (at[place] * factor).clamp(range.least, range.greatest);
            bench.trial(&best.set, at)
        };
        let places: Vec<usize> = (known..best.parameters()).collect();
        let tried = places.par_iter().flat_map_iter(|place| FACTORS.map(|factor| aside(*place, factor)));
        let Some(lower) = tried.flatten().min_by(|a, b| a.cost.total_cmp(&b.cost)) else { break };
        if bench.is_stopped() || lower.cost >= best.cost {
            break;
        }
        let fitted = bench.fit(&lower.set, std::slice::from_ref(&lower.at), anew(lower.at.len()));
        best = fitted.filter(|fitted| fitted.cost < lower.cost).unwrap_or(lower);
    }
    best
}

/// Those of the sorted trials that another effect is looked for beside: the first of each kind of effect, so many at most.
fn stones(trials: &[Trial], most: usize) -> Vec<Trial> {
    let mut stones: Vec<Trial> = Vec::new();
    for trial in trials {
        let Some(candidate) = trial.set.last() else { continue };
        let is_there = |stone: &Trial| stone.set.last().is_some_and(|other| other.effect.id == candidate.effect.id);
        let is_one = !candidate.is_parameter_error() && !candidate.free.is_empty();
        if is_one && stones.len() < most && !stones.iter().any(is_there) {
            stones.push(trial.clone());
        }
    }
    stones
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Subject;
    use crate::gap::cause::axis_tests::{ending_at, report_as, rubbing_axis};
    use crate::gap::cause::ladder::climb;
    use crate::gap::recorded_tests::study_of_folder;

    /// An axis that rubs has a gap, whatever explains it; one that reports what is predicted has none.
    #[test]
    fn only_what_is_a_gap_though_nothing_explains_it_bears_two_effects() {
        let (mut subject, nominal, _) = rubbing_axis();
        let bears = |subject: &Subject, too_few_blocks: Option<f64>| {
            let stop = || false;
            let bench = Bench::new(subject, Vec::new(), &stop);
            let ladder = ending_at(&bench, &nominal, bench.trial(&[], Vec::new()).expect("a trial"));
            bears_two(&bench, &Ladder { too_few_blocks, ..ladder })
        };
        assert!(bears(&subject, None) && !bears(&subject, Some(2.0)));
        report_as(&mut subject, &nominal);
        assert!(!bears(&subject, None));
    }

    /// Vacuum comes after 0.2 s, and all that the gripper is told 0.13 s late: a build-up of 0.33 s alone explains when it comes, and a dead time beside that when it goes.
    #[test]
    fn a_delay_takes_as_much_of_anothers_place() {
        let study = study_of_folder("tests/data/gripper-with-two-delays");
        let subject = study.subject("Vacuum_46").expect("it moves");
        let stop = || false;
        let bench = Bench::new(subject, Vec::new(), &stop);
        let asked = |id: &str| ["vacuum-build-up", "dead-time"].contains(&id);
        let ladder = climb(&bench, (&[], 0.0), &asked, &|_| {}).expect("a ladder");
        let found: Vec<(&str, f64)> =
            ladder.best.values().map(|(candidate, at)| (candidate.effect.id, at[0])).collect();
        let near = |(id, at): (&str, f64), (told, time): (&str, f64)| id == told && (at - time).abs() < 0.015;
        let [one, other] = found.as_slice() else { panic!("{found:?}") };
        assert!(near(*one, ("vacuum-build-up", 0.2)) && near(*other, ("dead-time", 0.13)), "{found:?}");
    }
}
