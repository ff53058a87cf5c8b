//! What these recordings cannot tell from the answer, and how heavy everything else is.

use rayon::prelude::*;

use super::bench::{BLOCK_S, Bench, Trial};
use super::candidate::Candidate;
use super::glance::Sought;
use super::ladder::{DRAWS, Ladder, Tell, anew, handicap};
use super::remainder::misfit;
use super::rhythm::PART;
use super::rung::rung;
use super::unseen::unseen;
use crate::gap::fit::{Range, sum_of_squares};
use crate::gap::statistics::{SAME_CLASS, wins};
use crate::plant::EffectPlace;

/// Something else that could stand in the place of an effect of the answer.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// The answer with this candidate, the last of the set, in the effect's place.
    pub trial: Trial,
    /// How far its output lies from the answer's once fitted to it, whitened and squared.
    pub distance: f64,
    /// Whether these recordings cannot tell it from the effect.
    pub is_same: bool,
    pub weight: f64,
}

impl Alternative {
    /// The candidate that stands in the effect's place.
    pub fn candidate(&self) -> &Candidate {
        &self.trial.set[self.trial.set.len() - 1]
    }
}

/// One effect of the answer, with all that rivals it.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Its place in the set of the best trial.
    pub place: usize,
    pub weight: f64,
    /// Those of its class first, then by their cost.
    pub alternatives: Vec<Alternative>,
}

/// How much more than the answer a candidate may cost and still be looked at: where a class ends, and as much again for what
/// noise does to the difference.
const NEAR: f64 = 4.0 * SAME_CLASS;

/// How much more than the answer, in deviance, what explains the recordings as well costs at most.
const AS_WELL: f64 = 1.0;

/// Of how many that are not so near, the best first, it is asked whether the other effects of the answer bring them there.
const REFITTED: usize = 4;

/// Which of several effects that give the same motion is named: one inside the device before one of its commands, that before one
/// of its sensors, and last one of the link behind them; a plain delay before a filter.
pub fn plainness(candidate: &Candidate) -> u32 {
    let place = match candidate.place {
        EffectPlace::CommandLink => 1,
        EffectPlace::Sensor => 2,
        EffectPlace::ReportLink => 3,
        _ => 0,
    };
    let is_filter = ["input-filter", "stale-hold", "clock-drift", "wrong-unit"].contains(&candidate.effect.id);
    20 * u32::from(candidate.is_parameter_error()) + 10 * u32::from(is_filter) + place
}

/// The answers of a ladder: for each effect of its best set the class and the rivals.
pub fn answers(
    bench: &Bench<'_>,
    ladder: &Ladder,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    tell: &Tell<'_>,
) -> Vec<Answer> {
    (0..ladder.best.set.len()).map(|place| answer(bench, ladder, place, is_asked, tell)).collect()
}

fn answer(
    bench: &Bench<'_>,
    ladder: &Ladder,
    place: usize,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    tell: &Tell<'_>,
) -> Answer {
    let best = &ladder.best;
    let named = &best.set[place];
    let mut others = if best.set.len() == 1 {
        ladder.singles.clone()
    } else {
        let without = without(bench, best, place);
        let is_near = |candidate: &Candidate| ladder.near.iter().any(|near| near.is_same(candidate));
        without
            .map_or_else(Vec::new, |below| rung(bench, &below, Sought::in_parts(below.cost), is_asked, &is_near, tell))
    };
    others.retain(|trial| trial.set.last().is_some_and(|last| !last.is_same(named)));
    let inflation = best.inflation();
    let near = near(bench, best, others);
    let most = most_left(bench, ladder);
    let alternative = |trial: Trial| {
        let found = alternative(bench, (best, place), trial)?;
        let is_same = found.is_same && left(bench, &found.trial).is_none_or(|left| left <= most);
        Some(Alternative { is_same, ..found })
    };
    let mut alternatives: Vec<Alternative> = near.into_par_iter().filter_map(alternative).collect();
    alternatives.sort_by(|a, b| b.is_same.cmp(&a.is_same).then(a.trial.cost.total_cmp(&b.trial.cost)));
    // An effect that holds the answer as a special case explains no less: it is no rival. A nominal parameter that gives the
    // same motion is another name for it.
    alternatives.retain(|alternative| {
        let candidate = alternative.candidate();
        let holds_it = alternative.distance < SAME_CLASS * inflation && candidate.numbers() > named.numbers();
        let is_alias = candidate.is_parameter_error() && !named.is_parameter_error() && alternative.is_same;
        let is_part = alternative.is_same && is_part(candidate, named);
        !holds_it && !is_alias && !is_part
    });
    weigh(bench, ladder, Answer { place, weight: 0.0, alternatives })
}

/// How much more of the gap than the answer what nobody can tell from it leaves at most. (Where much is left, all that was recorded weighs little: beside a dead band
/// of a belt that left a fifth its speed in other units, which left more than a third, seemed the same.)
const LEAVES_MORE: f64 = 0.1;

/// What an alternative may leave of the gap's squares.
fn most_left(bench: &Bench<'_>, ladder: &Ladder) -> f64 {
    let gap = bench.predict(&[], &ladder.bare.at).map(|bare| misfit(&bench.subject.score(&bare)));
    left(bench, &ladder.best).zip(gap).map_or(f64::INFINITY, |(left, gap)| left + LEAVES_MORE * gap)
}

fn left(bench: &Bench<'_>, trial: &Trial) -> Option<f64> {
    Some(misfit(&bench.subject.score(&*bench.predict(&trial.set, &trial.at)?)))
}

/// Those of `others` that cost little more than `best`. Where that is of several effects, so do some whose other effects are fitted anew: what is told
/// of a play by a gain that is too small is a smaller play behind a scale that is.
fn near(bench: &Bench<'_>, best: &Trial, others: Vec<Trial>) -> Vec<Trial> {
    let is_near = |trial: &Trial| trial.cost - best.cost < NEAR * best.inflation();
    let (mut near, mut further): (Vec<Trial>, Vec<Trial>) = others.into_iter().partition(is_near);
    if best.set.len() > 1 {
        further.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        further.truncate(REFITTED);
        let anew = |trial: &Trial| bench.fit(&trial.set, std::slice::from_ref(&trial.at), anew(trial.at.len()));
        near.extend(further.par_iter().filter_map(anew).filter(is_near).collect::<Vec<_>>());
    }
    near
}

/// Whether one of the two is an effect of a link as a whole and the other the same of one of its signals.
pub fn is_part(one: &Candidate, other: &Candidate) -> bool {
    one.effect.id == other.effect.id && one.place == other.place && one.component.is_some() != other.component.is_some()
}

/// The best set without one of its effects, the others as they are.
fn without(bench: &Bench<'_>, best: &Trial, place: usize) -> Option<Trial> {
    let mut set = best.set.clone();
    let before: usize = set[..place].iter().map(|candidate| candidate.free.len()).sum();
    let removed = set.remove(place);
    let mut at = best.at[..best.parameters()].to_vec();
    at.drain(before..before + removed.free.len());
    at.extend(bench.nominal(&set));
    bench.trial(&set, at)
}

/// Fits the candidate with all else to the answer's own output.
fn alternative(bench: &Bench<'_>, (best, place): (&Trial, usize), trial: Trial) -> Option<Alternative> {
    let distance = distance(bench, best, &trial.set, &starts(bench, (best, place), &trial))?;
    let (named, last) = (&best.set[place], trial.set.last()?);
    let last_of = trial.set.len() - 1;
    let by_chance = if named.effect.id == last.effect.id { 0.0 } else { coincidence(&trial, last_of) };
    let is_near = |distance: f64| distance + by_chance * best.inflation() < SAME_CLASS * best.inflation();
    let is_near = is_near(distance) || reversed(bench, (best, place), &trial).is_some_and(is_near);
    let is_same = is_near && last.numbers() <= named.numbers();
    Some(Alternative { trial, distance, is_same, weight: 0.0 })
}

/// How far the answer's effect comes from what a candidate does that explains the recordings as well as the answer. Among flags that are seen in cycles an effect
/// costs as much over a span of its numbers: the answer stands somewhere in its own, where the candidate may not follow it, and may well do what that does.
fn reversed(bench: &Bench<'_>, (best, place): (&Trial, usize), trial: &Trial) -> Option<f64> {
    if trial.cost - best.cost > AS_WELL * best.inflation() || bench.subject.has_levels() {
        return None;
    }
    let answer = best.clone().with_last(place);
    distance(bench, trial, &answer.set, &starts(bench, (trial, trial.set.len() - 1), &answer))
}

/// How far `set` comes from what `of` does, from the nearest of these starts, whitened and squared.
fn distance(bench: &Bench<'_>, of: &Trial, set: &[Candidate], starts: &[Vec<f64>]) -> Option<f64> {
    let output = bench.predict(&of.set, &of.at)?;
    let apart = |at: &Vec<f64>| bench.apart(&output, set, at).map(|apart| (sum_of_squares(&apart), at.clone()));
    let (_, nearest) = starts.iter().filter_map(apart).min_by(|a, b| a.0.total_cmp(&b.0))?;
    // Of the price of nominal parameters that are off, `of` has paid its own.
    let paid = sum_of_squares(&bench.strain(&of.set, &of.at));
    Some((bench.distance(&output, set, &nearest)? - paid).max(0.0))
}

/// Where the fit of a candidate to the answer's output may begin: where it costs least by the recordings, the same beside all else as the answer has
/// it, and with the answer's own numbers, which a play of a sensor has in common with one of what it looks at.
fn starts(bench: &Bench<'_>, (best, place): (&Trial, usize), trial: &Trial) -> Vec<Vec<f64>> {
    let carried = bench.carried(&trial.set, &best.overrides);
    let all: Vec<&[f64]> = best.values().map(|(_, own)| own).collect();
    let others = [&all[..place], &all[place + 1..]].concat().concat();
    let Some((candidate, own)) = trial.values().last() else { return vec![trial.at.clone()] };
    let with = |own: &[f64]| [&others, own, &carried].concat();
    let is_within = |(range, value): (Range, &f64)| (range.least..=range.greatest).contains(value);
    let fits = candidate.free.len() == all[place].len() && candidate.ranges().zip(all[place]).all(is_within);
    [trial.at.clone(), with(own)].into_iter().chain(fits.then(|| with(all[place]))).collect()
}

/// What a period of a candidate beside `below` others gains by having been looked for among so many: as many as differ by a part of themselves over the
/// recording, of which one is that of the machine's own reports or commands, by which all of them wait alike, as behind a dead time.
pub fn coincidence(trial: &Trial, below: usize) -> f64 {
    let long = trial.blocks.len() as f64 * BLOCK_S;
    let periods = trial.values().skip(below).filter(|(candidate, _)| candidate.effect.id == "stale-hold");
    periods.filter_map(|(_, own)| own.first()).map(|period| 2.0 * (long / (PART * period)).max(1.0).ln()).sum()
}

/// In which share of the draws of blocks kept back each wins; a class shares its weight evenly among its members, as nothing tells them apart.
fn weigh(bench: &Bench<'_>, ladder: &Ladder, mut answer: Answer) -> Answer {
    let best = &ladder.best;
    let inflation = best.inflation();
    let below = best.set.len() - 1;
    let rivals: Vec<usize> = (0..answer.alternatives.len()).filter(|at| !answer.alternatives[*at].is_same).collect();
    let trials: Vec<&Trial> =
        std::iter::once(best).chain(rivals.iter().map(|at| &answer.alternatives[*at].trial)).collect();
    // On blocks that their parameters did not see; where the answer is wanted now, on all.
    let costs = |trial: &&Trial| unseen(bench, trial, ladder.folds).unwrap_or_else(|| trial.blocks.clone());
    let scaled: Vec<Vec<f64>> =
        trials.iter().map(|trial| costs(trial).into_iter().map(|cost| cost / inflation).collect()).collect();
    let blocks: Vec<&[f64]> = scaled.iter().map(Vec::as_slice).collect();
    let handicaps: Vec<f64> = trials.iter().map(|trial| handicap(trial, below)).collect();
    let wins = wins(&blocks, &handicaps, DRAWS, 2);
    let members = 1 + answer.alternatives.len() - rivals.len();
    let each = wins[0] / members as f64;
    answer.weight = each;
    for alternative in answer.alternatives.iter_mut().filter(|alternative| alternative.is_same) {
        alternative.weight = each;
    }
    for (at, win) in rivals.iter().zip(&wins[1..]) {
        answer.alternatives[*at].weight = *win;
    }
    answer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::cause::axis_tests::{ending_at, report_as, rubbing_axis};
    use crate::gap::cause::library::candidates;
    use crate::gap::cause::nuisance::Nuisance;
    use crate::gap::recorded_tests::study_of_folder;

    /// In a recording of a minute there are 25 000 periods of 20 ms that differ by a part of themselves at its end; a delay is one of few.
    #[test]
    fn a_period_may_fit_by_chance() {
        let (subject, nominal, _) = rubbing_axis();
        let of = |id: &str| candidates(&subject, &nominal, &subject.score(&nominal), &|of| of == id).swap_remove(0);
        let stop = || false;
        let bare = Bench::new(&subject, Vec::new(), &stop).trial(&[], Vec::new()).expect("a trial");
        let trial = |id: &str| Trial { set: vec![of(id)], at: vec![0.02], blocks: vec![0.0; 30], ..bare.clone() };
        assert!((handicap(&trial("stale-hold"), 0) - 2.0 * 25_000.0_f64.ln()).abs() < 1e-9);
        assert_eq!((handicap(&trial("dead-time"), 0), handicap(&trial("stale-hold"), 1)), (0.0, 0.0));
    }

    /// A machine whose mass is five deviations off pays for that whatever is named beside it: the same friction is no other for it, wherever
    /// its own fit has ended.
    #[test]
    fn what_the_answers_own_machine_pays_parts_it_from_nothing() {
        let (subject, _, rubs) = rubbing_axis();
        let stop = || false;
        let mass = Nuisance { name: "M", nominal: 20.0, deviation: 0.1, reach: 6.0 };
        let bench = Bench::new(&subject, vec![mass], &stop);
        let best = bench.trial(&rubs, vec![30.0, 20.5]).expect("a trial");
        let other = bench.trial(&rubs, vec![90.0, 20.0]).expect("a trial");
        let found = alternative(&bench, (&best, 0), other).expect("an alternative");
        assert!(found.is_same && found.distance < 1.0, "{}", found.distance);
    }

    /// A gripper that is switched on 36 ms late, reported every 20 ms: a switch that is 41.7 ms late explains as much, and would show a short grip that being switched
    /// on so late would not make. By 36.8 ms they do the same.
    #[test]
    fn what_does_the_same_elsewhere_in_its_span_is_the_same() {
        let study = study_of_folder("tests/data/gripper-told-briefly");
        let place = study.subjects.iter().position(|subject| subject.name == "Vacuum_21").expect("it grips");
        let (subject, bare) = (&study.subjects[place], &study.bare[place]);
        let stop = || false;
        let bench = Bench::new(subject, bare.nuisances.clone(), &stop);
        let trial = |id: &str, time: f64| {
            let all = candidates(subject, &bare.prediction, &subject.score(&bare.prediction), &|known| known == id);
            let at = [&[time], bare.at.as_slice()].concat();
            bench.trial(&[all.into_iter().next().expect("a candidate")], at).expect("a trial")
        };
        let (best, other) = (trial("on-delay", 0.041_69), trial("switch-on-delay", 0.036_79));
        assert!((best.cost - other.cost).abs() < AS_WELL, "{} {}", best.cost, other.cost);
        let found = alternative(&bench, (&best, 0), other).expect("an alternative");
        assert!(found.is_same && found.distance > SAME_CLASS, "{}", found.distance);
        // What explains less is not asked for where it would do the same.
        let worse = alternative(&bench, (&best, 0), trial("switch-on-delay", 0.06)).expect("an alternative");
        assert!(!worse.is_same, "{}", worse.distance);
    }

    /// What explains next to nothing of a gap that friction explains is not the same as friction, however little all that was recorded weighs.
    #[test]
    fn what_leaves_a_gap_is_told_from_what_explains_it() {
        let (mut subject, nominal, rubs) = rubbing_axis();
        let stop = || false;
        let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&rubs, &[30.0]).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let trial = |force: f64| bench.trial(&rubs, vec![force]).expect("a trial");
        let ladder = ending_at(&bench, &nominal, trial(30.0));
        let most = most_left(&bench, &ladder);
        let leaves = [30.0, 25.0, 10.0].map(|force| left(&bench, &trial(force)).expect("something") <= most);
        assert_eq!(leaves, [true, true, false], "{most}");
    }
}
