//! What is found of one device.

use std::sync::Arc;

use super::Options;
use super::scheduled::tell_by_schedule;
use crate::gap::age::older;
use crate::gap::cause::{
    Alternative, Answer, Bare, Bench, Bounds, Candidate, Ladder, MOST_INFLATED, Nuisance, Remainder, Standing, Trial,
    anew, answers, climb, intervals, is_laws_own, is_part, lets_go_at_once, misfit, of_each, plainness, remainder,
};
use crate::gap::chance::{self, Chance};
use crate::gap::fit::Effort;
use crate::gap::schedule::PART_SPACING;
use crate::gap::task::{MOST_AGE_S, Task};
use crate::gap::{FAR_BEYOND, Score, Study, Subject, THRESHOLD, evidence};
use crate::plant::{EffectPlace, EffectSpec};

/// What a device's recordings say of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conclusion {
    /// The model explains them down to the noise, within its tolerances.
    NoGap,
    /// They hold a gap that something in the library explains, in too little motion to be sure of it.
    TooShort,
    /// They hold a gap of which nothing in the library explains a part worth having.
    Unknown,
    /// An effect explains a part, and a remainder is left.
    Partial,
    /// The answer's effects explain them.
    Explained,
}

/// What was found of one device.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The device's place among the study's subjects.
    pub subject: usize,
    pub conclusion: Conclusion,
    pub ladder: Ladder,
    /// One for each effect of the best set.
    pub answers: Vec<Answer>,
    /// One for each free parameter of the best set, in its order.
    pub bounds: Vec<Bounds>,
    pub remainder: Remainder,
    /// Its gap's squares above the floor, in units of the floor.
    pub misfit: f64,
    /// How often the device was replayed to find it.
    pub replays: usize,
    /// An effect that draws anew each time, beside those of the best set.
    pub chance: Option<Arc<Chance>>,
}

impl Finding {
    /// With how many effects that draw nothing it would be explained as plainly, where it may be: what stands still, as a joint does that holds, is reported the
    /// same again and again as if reports were lost; and of flags that are late, each by some cycles or not, reports seem to be lost, or commands to come late by
    /// times of their own.
    fn may_draw_nothing(&self, subject: &Subject) -> Option<usize> {
        let own = self.ladder.best.set.len();
        match self.chance.as_ref()?.candidate.effect.id {
            "lost-messages" => Some(own.max(1)),
            "sampling-jitter" if !subject.has_levels() => Some(own + 1),
            _ => None,
        }
    }

    /// How old its reports are, s, where an effect beside others says so that delays all of them by so little: no other device says how old the machine's
    /// are, and this one was too far off to.
    fn seeming_age(&self, study: &Study) -> Option<f64> {
        const DELAYS: [&str; 2] = ["dead-time", "input-filter"];
        let best = &self.ladder.best;
        if best.set.len() < 2 || study.tasks.iter().any(|task| *task != Task::default()) {
            return None;
        }
        let is_delay = |candidate: &Candidate| {
            let is_whole = candidate.place == EffectPlace::ReportLink && candidate.component.is_none();
            is_whole && DELAYS.contains(&candidate.effect.id)
        };
        // Which of those that nobody can tell apart is named says nothing of which of them it is.
        let same = self.answers.iter().flat_map(|answer| &answer.alternatives).filter(|other| other.is_same);
        let same = same.filter_map(|other| other.trial.values().last());
        let (_, delay) = best.values().chain(same).find(|(candidate, _)| is_delay(candidate))?;
        delay.first().copied().filter(|age_s| *age_s <= MOST_AGE_S)
    }

    /// The effects that it adds: none where nothing is explained.
    pub fn specs(&self) -> Vec<EffectSpec> {
        match self.conclusion {
            Conclusion::Partial | Conclusion::Explained => self.ladder.best.specs(),
            Conclusion::NoGap | Conclusion::TooShort | Conclusion::Unknown => Vec::new(),
        }
    }
}

/// What of a gap must be explained for the answer to be more than unknown.
const WORTH_HAVING: f64 = 0.3;

/// Looks at one device. `None` where its reports are not in the recordings.
pub(super) fn find(
    place: usize,
    subject: &Subject,
    bare: &Bare,
    study: &Study,
    options: &Options<'_>,
) -> Option<Finding> {
    if subject.is_bay() {
        let is_asked = |id: &str| id == PART_SPACING && (options.is_asked)(id);
        let options = Options { is_asked: &is_asked, ..*options };
        return conclude(place, (subject, bare), None, study, &options).filter(explains_all);
    }
    let chance = chance::find(place, study, options.is_asked, options.is_stopped).map(Arc::new);
    let finding = conclude(place, (subject, bare), chance, study, options)?;
    let finding = read_again(&finding, (subject, bare), study, options).unwrap_or(finding);
    let aged = || {
        let (subject, nominal) = older(subject, finding.seeming_age(study)?)?;
        let bare = Bare::new(&subject, &nominal);
        let aged = conclude(place, (&subject, &bare), None, study, options).filter(explains_all)?;
        (aged.ladder.best.set.len() < finding.ladder.best.set.len()).then_some(aged)
    };
    let finding = aged().unwrap_or(finding);
    let Some(most) = finding.may_draw_nothing(subject) else { return Some(finding) };
    let plain = conclude(place, (subject, bare), None, study, options).filter(explains_all);
    Some(plain.filter(|plain| plain.ladder.best.set.len() <= most).unwrap_or(finding))
}

/// The same once what was drawn is read beside the effects that were found: where it had been read off the recording by itself, and where they do not
/// explain all.
fn read_again(
    finding: &Finding,
    (subject, bare): (&Subject, &Bare),
    study: &Study,
    options: &Options<'_>,
) -> Option<Finding> {
    let best = &finding.ladder.best;
    let known = finding.chance.as_deref();
    if best.set.is_empty() || known.is_none() && explains_all(finding) {
        return None;
    }
    let specs = best.specs();
    let (device, found) = ((subject, bare), (specs.as_slice(), &best.overrides));
    let late = || chance::late_beside(device, found, options.is_asked, options.is_stopped);
    let chance = chance::beside(device, found, known, options.is_asked);
    let chance = chance.or_else(|| if known.is_none() { late() } else { None })?;
    let anew = conclude(finding.subject, (subject, bare), Some(Arc::new(chance)), study, options)?;
    (known.is_some() || explains_all(&anew)).then_some(anew)
}

/// Whether its effects explain all of a gap.
fn explains_all(finding: &Finding) -> bool {
    finding.conclusion == Conclusion::Explained
}

/// The same once it is known whether something was drawn of its signals.
fn conclude(
    place: usize,
    (subject, bare): (&Subject, &Bare),
    chance: Option<Arc<Chance>>,
    study: &Study,
    options: &Options<'_>,
) -> Option<Finding> {
    let gap = subject.score(&bare.prediction);
    // What is left beside what was drawn may be no more than its law is off by.
    let is_drawn_by_all =
        chance.as_ref().is_some_and(|chance| is_laws_own(&chance.subject, &chance.bare.prediction, &gap));
    let nothing = |_: &str| false;
    let is_asked: &(dyn Fn(&str) -> bool + Sync) = if is_drawn_by_all { &nothing } else { options.is_asked };
    let (subject, bare) = chance.as_ref().map_or((subject, bare), |chance| (&chance.subject, &chance.bare));
    let bench = Bench::new(subject, bare.nuisances.clone(), options.is_stopped);
    let tick = study.ticks.iter().copied().fold(0.0, f64::max);
    let mut ladder = climb(&bench, (&bare.at, tick), is_asked, options.tell)?;
    if let Some(at) = fitted_better(&bench, &ladder) {
        ladder = climb(&bench, (&at, tick), is_asked, options.tell)?;
    }
    let prediction = bench.predict(&[], &ladder.bare.at)?;
    let bare = subject.score(&prediction);
    let mut finding = Finding {
        subject: place,
        conclusion: Conclusion::NoGap,
        answers: Vec::new(),
        bounds: Vec::new(),
        remainder: Remainder::default(),
        misfit: chance.as_ref().map_or_else(|| misfit(&bare), |chance| misfit(&gap).max(chance.misfit)),
        replays: 0,
        ladder,
        chance: chance.clone(),
    };
    let beyond_chance = evidence(subject, &prediction);
    let has_gap =
        beyond_chance > FAR_BEYOND * THRESHOLD || (beyond_chance > THRESHOLD && is_significant(&finding.ladder, &bare));
    if finding.ladder.best.set.is_empty() {
        if has_gap && !is_drawn_by_all {
            finding.remainder = remainder(&bench, &finding.ladder)?;
            let is_too_short = finding.ladder.too_few_blocks.is_some();
            finding.conclusion = match finding.chance {
                Some(_) => Conclusion::Partial,
                None if is_too_short => Conclusion::TooShort,
                None => Conclusion::Unknown,
            };
        } else if finding.chance.is_some() {
            finding.conclusion = Conclusion::Explained;
        }
        finding.replays = bench.replays();
        return Some(finding);
    }
    finding.remainder = remainder(&bench, &finding.ladder)?;
    let weighing = finding.ladder.subject.clone();
    let weighed = bench.with(&weighing);
    finding.answers = answers(&weighed, &finding.ladder, options.is_asked, options.tell);
    tell_by_schedule(subject, &mut finding);
    name_the_plainest(&weighed, &mut finding);
    name_what_lets_go_at_once(&weighed, &mut finding);
    finding.bounds = intervals(&weighed, &finding.ladder.best, finding.ladder.ends.as_deref(), tick);
    finding.conclusion = match () {
        () if finding.remainder.is_large && 1.0 - finding.remainder.share < WORTH_HAVING => Conclusion::Unknown,
        // What is left may go with nothing that is looked for.
        () if finding.remainder.is_large || finding.remainder.is_significant => Conclusion::Partial,
        () if may_do_nothing(&finding.ladder.best.set, &finding.bounds) => Conclusion::Partial,
        () => Conclusion::Explained,
    };
    finding.replays = bench.replays();
    Some(finding)
}

/// Whether one of several effects may be none: something else then takes part in what it seems to explain beside the others.
fn may_do_nothing(set: &[Candidate], bounds: &[Bounds]) -> bool {
    set.len() > 1 && of_each(set, bounds).any(|(candidate, own)| candidate.may_do_nothing(own))
}

/// Where the nominal parameters alone explain much of what an effect seemed to: the search for it moved them out of a false minimum.
fn fitted_better(bench: &Bench<'_>, ladder: &Ladder) -> Option<Vec<f64>> {
    const MOST: usize = 3;
    const MUCH: f64 = 0.3;
    if ladder.best.set.is_empty() || bench.nuisances.is_empty() || bench.is_rugged() {
        return None;
    }
    let begin = |trial: &Trial| -> Vec<f64> {
        let named = |nuisance: &Nuisance| trial.overrides.0.get(nuisance.name).copied();
        let own = bench.nuisances.iter().zip(&ladder.bare.at);
        own.map(|(nuisance, bare)| named(nuisance).unwrap_or(*bare)).collect()
    };
    let starts: Vec<Vec<f64>> = std::iter::once(&ladder.best).chain(&ladder.singles).take(MOST).map(begin).collect();
    let trial = bench.fit(&[], &starts, anew(bench.nuisances.len()))?;
    (ladder.bare.cost - trial.cost > (MUCH * ladder.excess()).max(THRESHOLD)).then_some(trial.at)
}

/// Whether the bare model costs more than noise and the estimate of it allow: all its signals together, or one by itself.
fn is_significant(ladder: &Ladder, bare: &Score) -> bool {
    let least = |(floor, variance): (f64, f64)| {
        18.0 * ladder.bare.inflation().min(MOST_INFLATED) + 5.0 * variance.sqrt() + 0.1 * floor
    };
    let Standing { worst, above, .. } = Standing::of(bare);
    ladder.excess() > least(ladder.floor) || above > least(worst)
}

/// A friction that lets go at once is told without the speed that it falls within. Each time that it lets go is an event of its own, and among
/// those no slope leads far: it is looked for from about the force on.
fn name_what_lets_go_at_once(bench: &Bench<'_>, finding: &mut Finding) {
    const ABOUT: [f64; 7] = [0.9, 0.95, 1.0, 1.05, 1.1, 1.2, 1.35];
    let Ladder { best, singles, .. } = &mut finding.ladder;
    let [named] = best.set.as_slice() else { return };
    let is_plain = |trial: &&Trial| trial.set.iter().all(|candidate| candidate.effect.id == "breakaway-friction");
    let Some(plain) = singles.iter().find(is_plain).filter(|_| lets_go_at_once(named, &best.at)) else { return };
    let carried = bench.carried(&plain.set, &best.overrides);
    let about = ABOUT.iter().map(|share| [&[share * best.at[0]], carried.as_slice()].concat());
    let starts: Vec<Vec<f64>> = about.chain([plain.at.clone()]).collect();
    let effort = Effort { starts: 3, ..anew(plain.at.len()) };
    *best = bench.fit(&plain.set, &starts, effort).unwrap_or_else(|| plain.clone());
}

/// Of the effects that give the same motion one without any number is named, such as metres that are told as millimetres: that a number
/// could be what does the same is no chance. Else it is the plainest; a nominal parameter that gives it too is another name for it. Beside others
/// it is fitted anew with them.
fn name_the_plainest(bench: &Bench<'_>, finding: &mut Finding) {
    let rank = |candidate: &Candidate| (candidate.numbers() > 0, plainness(candidate));
    for answer in &mut finding.answers {
        let best = &mut finding.ladder.best;
        let named = rank(&best.set[answer.place]);
        let same = answer.alternatives.iter().enumerate().filter(|(_, other)| other.is_same);
        let plainest = same.min_by_key(|(_, other)| rank(other.candidate()));
        let Some(at) = plainest.filter(|(_, other)| rank(other.candidate()) < named).map(|(at, _)| at) else {
            continue;
        };
        // The candidate of an alternative is the last of its set.
        let plainest = answer.alternatives[at].trial.clone().with_last_at(answer.place);
        answer.alternatives[at].trial = std::mem::replace(best, plainest).with_last(answer.place);
        if best.set.len() > 1 {
            let anew = bench.fit(&best.set, std::slice::from_ref(&best.at), anew(best.at.len()));
            *best = anew.filter(|anew| anew.cost < best.cost).unwrap_or_else(|| best.clone());
        }
        finding.ladder.ends = None;
        let named = &best.set[answer.place];
        if !named.is_parameter_error() {
            let is_certain = named.numbers() == 0;
            let holds_it = |other: &Alternative| is_certain && other.candidate().numbers() > 0;
            let is_alias = |other: &Alternative| {
                let candidate = other.candidate();
                let is_other_name = candidate.is_parameter_error() || is_part(candidate, named);
                other.is_same && (is_other_name || holds_it(other))
            };
            let aliases: f64 =
                answer.alternatives.iter().filter(|other| is_alias(other)).map(|other| other.weight).sum();
            answer.alternatives.retain(|other| !is_alias(other));
            answer.weight += aliases;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::effect::EFFECTS;
    use crate::gap::cause::{Free, candidates};
    use crate::gap::fit::Range;
    use crate::gap::recorded_tests::{
        LAGGING_ROBOT, LATE_GRIPPER, LATE_PUSHER, LEAKING_GRIPPER, OFF_LATE, PULLED_AXIS, RUBBING_AXIS, SLIPPING_PARTS,
        STARTS_LATE, STICKING_AXIS, TOLD_LATE, study,
    };

    fn candidate(id: &str) -> Candidate {
        let effect = EFFECTS.iter().find(|effect| effect.id == id).expect("an effect");
        let free = |name| Free { name, range: Range { least: 0.0, greatest: 1.0, scale: 1.0 }, is_time: false };
        Candidate {
            effect,
            place: EffectPlace::Mechanics,
            component: None,
            texts: BTreeMap::new(),
            fixed: Vec::new(),
            free: effect.parameters.iter().map(|parameter| free(parameter.name)).collect(),
            starts: Vec::new(),
            shown: Vec::new(),
        }
    }

    /// Reports of a pusher whose clock is slow come when others are due, and seem to be lost: the clock alone explains them.
    #[test]
    fn reports_that_come_late_are_not_lost() {
        let study = study(LATE_PUSHER);
        let place = study.subjects.iter().position(|subject| subject.name == "Pusher").expect("it moves");
        let is_asked = |id: &str| ["lost-messages", "clock-drift", "dead-time"].contains(&id);
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let found = find(place, &study.subjects[place], &study.bare[place], &study, &options).expect("a finding");
        let named: Vec<&str> = found.ladder.best.set.iter().map(|candidate| candidate.effect.id).collect();
        assert!(found.conclusion == Conclusion::Explained && found.chance.is_none(), "{named:?}");
        assert_eq!(named, ["clock-drift"]);
    }

    /// A short lag is what a lower speed and acceleration nearly are: they have to go back for it to show what it takes away, and further than their slopes say.
    #[test]
    fn a_lag_that_nominal_limits_make_up_for_is_found() {
        let named = named(LAGGING_ROBOT, "Robot", &["first-order-lag", "dead-time"]);
        assert!(
            matches!(named.as_slice(), [("dead-time" | "first-order-lag", time)] if (time - 2.31e-4).abs() < 1e-5),
            "{named:?}"
        );
    }

    /// Parts that slip and the belt that does are alike where a search ended on the way; where it ends at last the parts cost less.
    #[test]
    fn of_two_slips_the_one_that_costs_less_is_named() {
        let named = named(SLIPPING_PARTS, "Belt", &["part-slip", "belt-slip-above-acceleration"]);
        assert!(matches!(named.as_slice(), [("part-slip", limit)] if (limit - 0.2).abs() < 0.01), "{named:?}");
    }

    /// A force that is a twentieth too great or too small costs more than none, and a dead band explains a part.
    #[test]
    fn a_force_that_no_slope_leads_to_is_found() {
        let named = named(STICKING_AXIS, "Axis", &["breakaway-friction", "dead-band"]);
        assert!(
            matches!(named.as_slice(), [("breakaway-friction", force)] if (force / 3.529 - 1.0).abs() < 0.02),
            "{named:?}"
        );
    }

    /// Beside friction a tenth of a newton shows in no level.
    #[test]
    fn a_weak_force_is_found_beside_friction() {
        let named = named(PULLED_AXIS, "Axis", &["viscous-friction", "constant-force"]);
        assert!(
            matches!(named.as_slice(), [("viscous-friction", rubs), ("constant-force", pulls)]
                if (rubs / 32.52 - 1.0).abs() < 0.02 && (pulls / 0.0993 - 1.0).abs() < 0.1),
            "{named:?}"
        );
    }

    /// A belt that starts late says nothing of its gain while that is not known, nor of what it is late by.
    #[test]
    fn two_effects_of_which_neither_is_worth_having_alone_are_found() {
        let named = named(STARTS_LATE, "Belt", &["gain", "offset", "switch-on-delay"]);
        assert!(
            matches!(named.as_slice(), [("switch-on-delay", late), ("gain", gain)]
                if (late - 0.111).abs() < 1e-3 && (gain - 1.195).abs() < 1e-3),
            "{named:?}"
        );
    }

    /// Alone a filter explains more than the dead time, which has false minima.
    #[test]
    fn what_stood_for_two_effects_gives_way_to_one_of_them() {
        let named = named(TOLD_LATE, "Motor", &["dead-time", "input-filter", "parameter-error"]);
        assert!(
            matches!(named.as_slice(), [("dead-time", late), ("parameter-error", limit)]
                if (late - 0.0992).abs() < 1e-3 && (limit - 26.6).abs() < 0.1),
            "{named:?}"
        );
    }

    /// Each time it goes off late, by five cycles of the reports or six.
    #[test]
    fn reports_that_are_all_late_are_not_lost() {
        let named = named(OFF_LATE, "Pusher", &["off-delay", "lost-messages"]);
        assert!(matches!(named.as_slice(), [("off-delay", late)] if (late - 0.0548).abs() < 3e-3), "{named:?}");
    }

    /// By what they are late on average there seems to be a delay.
    #[test]
    fn commands_that_jitter_are_found_beside_a_leak() {
        let study = study(LEAKING_GRIPPER);
        let place = study.subjects.iter().position(|subject| subject.name == "Gripper").expect("it grips");
        let is_asked = |id: &str| ["dead-time", "leak", "sampling-jitter"].contains(&id);
        let drawn = chance::find(place, &study, &is_asked, &|| false);
        assert!(drawn.is_none(), "{:?}", drawn.map(|drawn| drawn.candidate.name()));
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let found = find(place, &study.subjects[place], &study.bare[place], &study, &options).expect("a finding");
        let chance = found.chance.as_ref().expect("jitter");
        let [least, most] = chance.bounds[0].interval;
        assert!(chance.candidate.effect.id == "sampling-jitter" && least < 0.0211 && 0.0211 < most, "{least} {most}");
        let best = &found.ladder.best;
        let named: Vec<&str> = best.set.iter().map(|candidate| candidate.effect.id).collect();
        assert!(named == ["leak"] && (best.at[0] / 1.409 - 1.0).abs() < 0.03, "{named:?} {:?}", best.at);
        assert_eq!(found.conclusion, Conclusion::Explained);
    }

    /// What alone explains a device, with its first number.
    fn named(recording: &str, device: &str, asked: &[&str]) -> Vec<(&'static str, f64)> {
        let study = study(recording);
        let place = study.subjects.iter().position(|subject| subject.name == device).expect("it moves");
        let is_asked = |id: &str| asked.contains(&id);
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let found = find(place, &study.subjects[place], &study.bare[place], &study, &options).expect("a finding");
        assert!(found.conclusion == Conclusion::Explained && found.chance.is_none());
        found.ladder.best.values().map(|(candidate, own)| (candidate.effect.id, own[0])).collect()
    }

    /// Of a gripper that is switched on late few reports are late, each by a whole cycle, as if some commands came late by times of their own.
    #[test]
    fn what_is_late_by_a_cycle_or_not_has_one_delay() {
        let study = study(LATE_GRIPPER);
        let place = study.subjects.iter().position(|subject| subject.name == "Gripper").expect("it grips");
        let drawn = chance::find(place, &study, &|id| id == "sampling-jitter", &|| false);
        assert!(drawn.is_some_and(|drawn| drawn.candidate.effect.id == "sampling-jitter"));
        let is_asked = |id: &str| ["sampling-jitter", "switch-on-delay"].contains(&id);
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let found = find(place, &study.subjects[place], &study.bare[place], &study, &options).expect("a finding");
        let named: Vec<&str> = found.ladder.best.set.iter().map(|candidate| candidate.effect.id).collect();
        assert!(found.conclusion == Conclusion::Explained && found.chance.is_none(), "{named:?}");
        assert_eq!(named, ["switch-on-delay"]);
        let late = found.ladder.best.at[0];
        assert!((late - 4.1e-3).abs() < 1e-3, "{late}");
    }

    /// A delay of all reports beside an effect may be their age where no device says how old they are, and is no longer than they may be.
    #[test]
    fn a_delay_of_all_reports_beside_an_effect_may_be_their_age() {
        let mut study = study(RUBBING_AXIS);
        let place = study.subjects.iter().position(|subject| subject.name == "Axis").expect("it moves");
        let is_asked = |id: &str| id == "coulomb-friction";
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let found = conclude(place, (&study.subjects[place], &study.bare[place]), None, &study, &options);
        let found = found.expect("a finding");
        assert_eq!(found.ladder.best.set.len(), 1, "{:?}", found.ladder.best.specs());
        study.tasks = vec![Task::default()];
        let beside = |id: &str, place: EffectPlace, time: f64| {
            let mut finding = found.clone();
            finding.ladder.best.set.insert(0, Candidate { place, ..candidate(id) });
            finding.ladder.best.at.insert(0, time);
            finding
        };
        let link = EffectPlace::ReportLink;
        assert_eq!(found.seeming_age(&study), None);
        assert_eq!(beside("dead-time", link, 2.2e-4).seeming_age(&study), Some(2.2e-4));
        assert_eq!(beside("input-filter", link, 2.2e-4).seeming_age(&study), Some(2.2e-4));
        assert_eq!(beside("dead-time", EffectPlace::CommandLink, 2.2e-4).seeming_age(&study), None);
        assert_eq!(beside("clock-drift", link, 2.2e-4).seeming_age(&study), None);
        // Named as a delay of the commands, which nobody can tell from one of the reports.
        let mut told = beside("dead-time", EffectPlace::CommandLink, 2.2e-4);
        let trial = beside("dead-time", link, 2.2e-4).ladder.best.with_last(0);
        let same = Alternative { trial, distance: 0.0, is_same: true, weight: 0.5 };
        told.answers = vec![Answer { place: 0, weight: 0.5, alternatives: vec![same] }];
        assert_eq!(told.seeming_age(&study), Some(2.2e-4));
        assert_eq!(beside("dead-time", link, 2.0 * MOST_AGE_S).seeming_age(&study), None);
        study.tasks = vec![Task { age_s: 1e-4, ..Task::default() }];
        assert_eq!(beside("dead-time", link, 2.2e-4).seeming_age(&study), None);
    }

    /// An axis that rubs and cannot push as hard as it declares, whose limit was found as another nominal one: the effect that does the same is named, at its
    /// place beside friction.
    #[test]
    fn of_two_effects_each_has_its_plainest_name() {
        let study = study(RUBBING_AXIS);
        let place = study.subjects.iter().position(|subject| subject.name == "Axis").expect("it moves");
        let (subject, bare) = (&study.subjects[place], &study.bare[place]);
        let is_asked = |id: &str| id == "coulomb-friction";
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let mut found = conclude(place, (subject, bare), None, &study, &options).expect("a finding");
        let stop = || false;
        let bench = Bench::new(subject, bare.nuisances.clone(), &stop);
        let one = |id: &str, of: &str| {
            let all = candidates(subject, &bare.prediction, &subject.score(&bare.prediction), &|known| known == id);
            all.into_iter().find(|found| found.name().contains(of)).expect("a candidate")
        };
        let best = &mut found.ladder.best;
        let (friction, force) = (best.set[0].clone(), best.at[0]);
        let of = |set: Vec<Candidate>, own: [f64; 2]| {
            let at = [own.to_vec(), bench.carried(&set, &best.overrides)].concat();
            bench.trial(&set, at).expect("a trial")
        };
        let limit = 300.0;
        let (wrong, limited) = (one("parameter-error", "forceLimit"), one("force-limit", ""));
        let other = of(vec![friction.clone(), limited], [force, limit]);
        *best = of(vec![wrong, friction], [limit, force]);
        let answer = |place: usize, alternatives: Vec<Alternative>| Answer { place, weight: 0.5, alternatives };
        let same = Alternative { trial: other, distance: 0.0, is_same: true, weight: 0.5 };
        found.answers = vec![answer(0, vec![same]), answer(1, Vec::new())];
        name_the_plainest(&bench, &mut found);
        let named: Vec<&str> = found.ladder.best.set.iter().map(|candidate| candidate.effect.id).collect();
        assert_eq!(named, ["force-limit", "coulomb-friction"]);
        // Fitted anew to what was recorded, in which no limit shows, each has its own number still.
        let forces = &found.ladder.best.at;
        assert!(forces[0] > limit && forces[1] < 0.1 * limit, "{forces:?} {force}");
        // A nominal parameter is but another name.
        assert!(found.answers[0].alternatives.is_empty() && (found.answers[0].weight - 1.0).abs() < 1e-9);
    }

    /// By itself an effect was worth having; of two, one whose interval holds 0 newtons, or a gain of 1, may be none.
    #[test]
    fn one_of_two_may_do_nothing() {
        let within = |interval: [f64; 2]| Bounds { value: 0.5, interval, is_identifiable: true };
        let both = [candidate("coulomb-friction"), candidate("gain-error")];
        let bounds = |force: [f64; 2], gain: [f64; 2]| [within(force), within(gain)];
        assert!(!may_do_nothing(&both, &bounds([1.0, 2.0], [0.7, 0.9])));
        assert!(may_do_nothing(&both, &bounds([0.0, 2.0], [0.7, 0.9])));
        assert!(may_do_nothing(&both, &bounds([1.0, 2.0], [0.9, 1.1])));
        assert!(!may_do_nothing(&both[..1], &[within([0.0, 2.0])]));
    }
}
