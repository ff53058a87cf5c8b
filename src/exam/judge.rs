//! One report beside the truth.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use super::answer::{Answer, Magnitude, Sort, TrueEffect};
use super::class;
use crate::gap::report::{Cause, Member, Report, Rival, Verdict};

/// What one report got right. What does not apply to a case is absent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judged {
    pub case: String,
    pub sort: Sort,
    pub magnitude: Magnitude,
    /// The truth in words: `Axis: coulomb-friction`.
    pub truth: Vec<String>,
    /// The kind of the device of the first of them, where that is not its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// The model that it was diagnosed by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// What was answered: the verdict, and its causes in words.
    pub verdict: String,
    pub answered: Vec<String>,
    /// As many devices as have something wrong stand first in the report's `where`, and are those.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device_right: Option<bool>,
    /// One effect: named alone and surely where nothing else could be it, else as `ambiguous` with just its class. Where its class was
    /// not computed, as `truth_in_class`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub single_right: Option<bool>,
    /// One effect, named alone and surely, or in the class that is named, whatever else that holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truth_in_class: Option<bool>,
    /// It stands among causes, their classes or the rivals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truth_named: Option<bool>,
    /// Two effects: each is the answer of a cause of its own, by its own name or by that of one that the recording cannot tell from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub both_right: Option<bool>,
    /// Of the parameters with a truth: how many lie in their interval, and how many there are.
    pub covered: [usize; 2],
    /// The weight of the first cause and of all that is in its class.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
    /// The members of the class that was named.
    pub class_size: usize,
    /// Those of the true one, where it was computed: without parameters that are other names of its effects.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub true_class_size: Option<usize>,
    /// The same in words, where there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub true_class: Vec<String>,
    /// The part of the gap that is gone on the held-out recording.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shrink: Option<f64>,
    /// The same for the oracle: a fit that was told the effect.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub oracle_shrink: Option<f64>,
    pub seconds: f64,
}

/// Holds `report` beside `answer`.
pub fn judge(answer: &Answer, report: &Report, seconds: f64) -> Judged {
    let truths = &answer.effects;
    let is_single = answer.sort == Sort::Single;
    let is_two = matches!(answer.sort, Sort::TwoOnOneDevice | Sort::OneOnEachOfTwo);
    let named = |truth: &TrueEffect| report.cause.iter().any(|cause| of_class(cause, truth));
    let names_something = matches!(report.verdict, Verdict::Effect | Verdict::Ambiguous);
    let in_class = || names_something && report.cause.len() == 1 && truths.iter().all(named);
    let single = || if answer.class.is_empty() { in_class() } else { class::is_just(answer, report) };
    let members = class::answers(&answer.class);
    let rival = |truth: &TrueEffect| {
        report.rivals.iter().any(|rival| is_same(truth, &rival.device, rival.component.as_deref(), &rival.effect))
    };
    Judged {
        case: answer.case.clone(),
        sort: answer.sort,
        magnitude: answer.magnitude,
        truth: truths.iter().map(|truth| in_words(&truth.device, truth.component.as_deref(), &truth.effect)).collect(),
        kind: answer.kind.clone(),
        model: answer.model.clone(),
        verdict: report.verdict.name().to_owned(),
        answered: report.cause.iter().map(|c| in_words(&c.device, c.component.as_deref(), &c.effect)).collect(),
        device_right: (!truths.is_empty()).then(|| devices_are_right(truths, report)),
        single_right: is_single.then(single),
        truth_in_class: is_single.then(in_class),
        truth_named: is_single.then(|| truths.iter().all(|truth| named(truth) || rival(truth))),
        both_right: is_two.then(|| each_is_named(answer, 0, &report.cause.iter().collect::<Vec<_>>())),
        covered: if is_single && in_class() { covered(&truths[0], report) } else { [0, 0] },
        weight: report.cause.first().map(|cause| weight_of_class(cause, report)),
        class_size: report.cause.first().map_or(0, |cause| cause.class.len()),
        true_class_size: (!members.is_empty()).then_some(members.len()),
        true_class: match members.as_slice() {
            [] | [_] => Vec::new(),
            several => several.iter().map(|one| in_words(&one.device, one.component.as_deref(), &one.effect)).collect(),
        },
        shrink: report.shrink.ratio.map(|ratio| 1.0 - ratio),
        oracle_shrink: None,
        seconds,
    }
}

/// The weight of a cause with that of the rivals that are in its class: what stands beside [`Judged::truth_in_class`].
fn weight_of_class(cause: &Cause, report: &Report) -> f64 {
    let is_member = |rival: &&Rival| {
        let is_rival = |member: &Member| {
            (&member.device, &member.component, &member.effect, member.place)
                == (&rival.device, &rival.component, &rival.effect, rival.place)
        };
        cause.class.iter().any(is_rival)
    };
    let rivals = report.rivals.iter().filter(is_member).map(|rival| rival.weight).sum::<f64>();
    (cause.weight + rivals).min(1.0)
}

/// A case that no report answers: wrong in all that applies to it.
pub fn unanswered(answer: &Answer, seconds: f64) -> Judged {
    let judged = judge(answer, &Report::new(Verdict::NotTestable), seconds);
    Judged { verdict: "no answer".to_owned(), shrink: None, ..judged }
}

impl Judged {
    /// Whether the answer is one of those that the targets forbid. Of an effect that is faint, or lies below the noise, nobody has to
    /// know: only a sure answer that is not the truth is wrong.
    pub fn is_wrong(&self) -> bool {
        match self.sort {
            Sort::None => self.verdict != Verdict::NoGap.name(),
            Sort::Outside => !self.is_unknown(),
            _ if self.magnitude.counts() => self.single_right == Some(false) || self.both_right == Some(false),
            _ => self.verdict == Verdict::Effect.name() && self.single_right == Some(false),
        }
    }

    /// Whether it says that the library does not explain all of it.
    pub fn is_unknown(&self) -> bool {
        [Verdict::Unknown, Verdict::Partial].iter().any(|verdict| self.verdict == verdict.name())
    }

    /// How much an answer about one effect weighs with its class, and whether that holds the truth.
    pub fn weighed(&self) -> Option<(f64, bool)> {
        Some((self.weight?, self.truth_in_class?))
    }

    /// With what an oracle's report shrank.
    pub fn beside(self, oracle: Option<&Report>) -> Judged {
        let shrink = oracle.and_then(|report| report.shrink.ratio).map(|ratio| 1.0 - ratio);
        Judged { oracle_shrink: shrink, ..self }
    }
}

fn in_words(device: &str, component: Option<&str>, effect: &str) -> String {
    component.map_or_else(|| format!("{device}: {effect}"), |component| format!("{device}.{component}: {effect}"))
}

fn devices_are_right(truths: &[TrueEffect], report: &Report) -> bool {
    let wrong: BTreeSet<&str> = truths.iter().map(|truth| truth.device.as_str()).collect();
    let first: BTreeSet<&str> = report.devices.iter().take(wrong.len()).map(|gap| gap.device.as_str()).collect();
    wrong == first
}

/// Whether each of the effects from the one at `from` on is the answer of one of `causes` of its own: its name, or that of another of its class, in the cause or
/// in its class.
fn each_is_named(answer: &Answer, from: usize, causes: &[&Cause]) -> bool {
    let Some(truth) = answer.effects.get(from) else { return true };
    let is_of_class = |cause: &Cause| answer.classes.get(from).is_some_and(|class| class::holds(class, cause));
    (0..causes.len()).any(|at| {
        let others = [&causes[..at], &causes[at + 1..]].concat();
        (of_class(causes[at], truth) || is_of_class(causes[at])) && each_is_named(answer, from + 1, &others)
    })
}

fn of_class(cause: &Cause, truth: &TrueEffect) -> bool {
    class::holds(&[truth.member()], cause) || class::is_another_name(truth, &class::named(cause))
}

/// Where one of the two names no part of the device, the device says enough.
fn is_same(truth: &TrueEffect, device: &str, component: Option<&str>, effect: &str) -> bool {
    let part = truth.component.as_deref().zip(component).is_none_or(|(one, other)| one == other);
    truth.device == device && truth.effect == effect && part
}

/// How many parameters of the effect's own cause have their truth in their interval, and how many have one.
fn covered(truth: &TrueEffect, report: &Report) -> [usize; 2] {
    let cause = report.cause.iter().find(|cause| cause.effect == truth.effect && cause.device == truth.device);
    let mut counts = [0, 0];
    for parameter in cause.iter().flat_map(|cause| &cause.parameters) {
        if let Some((_, value)) = truth.parameters.iter().find(|(name, _)| *name == parameter.name) {
            counts[1] += 1;
            counts[0] += usize::from((parameter.ci95[0]..=parameter.ci95[1]).contains(value));
        }
    }
    counts
}
