//! The class of effects that a recording cannot tell apart, as the independent plants computed it, beside the class that was named.

use super::answer::{Answer, ClassMember, TrueEffect};
use crate::effect::EFFECTS;
use crate::gap::report::{Cause, Member, Report, Verdict};

/// The id of a nominal parameter that is wrong.
const PARAMETER_ERROR: &str = "parameter-error";

/// The members of the true class that are answers of their own: a nominal parameter that gives the same motion as an effect is another
/// name for it, and no rival. Where the class holds nothing but parameters, they are the answers.
pub fn answers(class: &[ClassMember]) -> Vec<&ClassMember> {
    let effects: Vec<&ClassMember> = class.iter().filter(|member| member.effect != PARAMETER_ERROR).collect();
    if effects.is_empty() { class.iter().collect() } else { effects }
}

/// The members that must be named: of an effect with more numbers than another of the class, which does the same with fewer, a recording knows no more
/// than that one says. A lag of the second order stands in the class of one of the first only where it is the truth, and nobody sees which it is.
fn asked_for(class: &[ClassMember]) -> Vec<&ClassMember> {
    let all = answers(class);
    let fewest = all.iter().map(|member| numbers(&member.effect)).min();
    all.into_iter().filter(|member| Some(numbers(&member.effect)) == fewest).collect()
}

/// How many numbers an effect has.
fn numbers(effect: &str) -> usize {
    EFFECTS.iter().find(|known| known.id == effect).map_or(1, |known| known.parameters.len())
}

/// What a nominal parameter's name begins with, before its axis, and the effect at its place that a lower or a higher value of it is: permanent
/// classes of the diagnosis.
const PERMANENT: [(&str, &str, &str); 5] = [
    ("maxVelocity", "velocity-limit", "actuator"),
    ("maxAcceleration", "acceleration-limit", "actuator"),
    ("acceleration", "acceleration-limit", "actuator"),
    ("buildUpTime", "vacuum-build-up", "process"),
    ("Fv", "viscous-friction", "mechanics"),
];

/// Whether one of two is a nominal parameter that, for every recording, is another name of the other: where no class was computed, as of two
/// effects at once, this is known of it.
pub fn is_another_name(truth: &TrueEffect, member: &Member) -> bool {
    let is = |parameter: Option<&str>, (effect, place, axis): (&str, &str, Option<&str>)| {
        PERMANENT.iter().any(|(stem, of, at)| {
            let rest = parameter.and_then(|parameter| parameter.strip_prefix(stem));
            (effect, place) == (*of, *at) && rest == Some(axis.unwrap_or_default())
        })
    };
    let (one, other) = (truth.component.as_deref(), member.component.as_deref());
    let named = match (truth.effect == PARAMETER_ERROR, member.effect == PARAMETER_ERROR) {
        (true, false) => is(one, (&member.effect, member.place.name(), other)),
        (false, true) => is(other, (&truth.effect, &truth.place, one)),
        _ => false,
    };
    truth.device == member.device && named
}

/// Whether `report` says of `answer`, whose class is known, just what can be known of it: one cause; a sure `effect` where nothing else
/// could be it, else `ambiguous` with the same class, all that are asked for in it. Of two sets, each member of the one must stand in the other, by device, effect, place and
/// component; where one of the two names no component the device says enough, and a parameter is wrong at any place.
pub fn is_just(answer: &Answer, report: &Report) -> bool {
    let [cause] = report.cause.as_slice() else { return false };
    let expected = asked_for(&answer.class);
    match (report.verdict, answers(&answer.class).len()) {
        // An alias is as good a name.
        (Verdict::Effect, _) if expected.len() == 1 => answer.class.iter().any(|member| is_same(member, &named(cause))),
        (Verdict::Ambiguous, 2..) => {
            let has_effects = expected.iter().any(|member| member.effect != PARAMETER_ERROR);
            let is_alias = |member: &&Member| has_effects && member.effect == PARAMETER_ERROR;
            let found: Vec<&Member> = cause.class.iter().filter(|member| !is_alias(member)).collect();
            expected.iter().all(|member| found.iter().any(|one| is_same(member, one)))
                && found.iter().all(|one| answer.class.iter().any(|member| is_same(member, one)))
        }
        _ => false,
    }
}

/// Whether a cause, or one that the report cannot tell from it, is one of a true class.
pub fn holds(class: &[ClassMember], cause: &Cause) -> bool {
    let own = named(cause);
    let mut all = std::iter::once(&own).chain(&cause.class);
    all.any(|member| class.iter().any(|truth| is_same(truth, member)))
}

/// A cause as a member, its parameter's name as its component.
pub fn named(cause: &Cause) -> Member {
    let member = cause.member();
    match cause.texts.get("parameter") {
        Some(parameter) => Member { component: Some(parameter.clone()), ..member },
        None => member,
    }
}

fn is_same(truth: &ClassMember, member: &Member) -> bool {
    let part = truth.component.as_deref().zip(member.component.as_deref()).is_none_or(|(one, other)| one == other);
    let place = truth.effect == PARAMETER_ERROR || truth.place == member.place.name();
    truth.device == member.device && truth.effect == member.effect && part && place
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::exam::{Magnitude, Sort, TrueEffect, judge};
    use crate::plant::EffectPlace;

    /// Effect, place and component.
    type One<'a> = (&'a str, &'a str, Option<&'a str>);

    const SWITCH: One<'static> = ("switch-on-delay", "actuator", None);
    const BUILD_UP: One<'static> = ("vacuum-build-up", "process", None);
    const ON_DELAY: One<'static> = ("on-delay", "sensor", Some("vacuumOn"));
    const TIME: One<'static> = ("parameter-error", "any", Some("buildUpTime"));

    fn answer(class: &[One<'_>]) -> Answer {
        let (effect, place, component) = class[0];
        let device = || "Gripper".to_owned();
        let member = |&(effect, place, component): &One<'_>| ClassMember {
            device: device(),
            component: component.map(str::to_owned),
            effect: effect.to_owned(),
            place: place.to_owned(),
        };
        let truth = TrueEffect {
            device: device(),
            component: component.map(str::to_owned),
            effect: effect.to_owned(),
            place: place.to_owned(),
            parameters: Vec::new(),
        };
        let class = class.iter().map(member).collect();
        Answer {
            case: "1".to_owned(),
            sort: Sort::Single,
            magnitude: Magnitude::Clear,
            effects: vec![truth],
            class,
            classes: Vec::new(),
            kind: None,
            model: None,
        }
    }

    /// One cause, its class in this order.
    fn report(verdict: Verdict, class: &[One<'_>]) -> Report {
        let places = EffectPlace::ALL;
        let place = |name: &str| places.into_iter().find(|place| place.name() == name).unwrap_or(EffectPlace::Actuator);
        let member = |&(effect, at, component): &One<'_>| Member {
            device: "Gripper".to_owned(),
            component: component.map(str::to_owned),
            effect: effect.to_owned(),
            place: place(at),
        };
        let class: Vec<Member> = class.iter().map(member).collect();
        let Member { device, component, effect, place } = class[0].clone();
        let (parameters, texts) = (Vec::new(), BTreeMap::new());
        let mut report = Report::new(verdict);
        report.cause.push(Cause { device, component, effect, place, weight: 0.5, class, parameters, texts });
        report
    }

    #[track_caller]
    fn check(truth: &[One<'_>], verdict: Verdict, named: &[One<'_>], is_right: bool) {
        let judged = judge(&answer(truth), &report(verdict, named), 1.0);
        assert_eq!(judged.single_right, Some(is_right), "{judged:?}");
    }

    #[test]
    fn an_effect_alone_in_its_class_must_be_named_surely() {
        check(&[SWITCH], Verdict::Effect, &[SWITCH], true);
        check(&[SWITCH], Verdict::Effect, &[BUILD_UP], false);
        // The truth is in it, and the recording says more.
        check(&[SWITCH], Verdict::Ambiguous, &[SWITCH, BUILD_UP], false);
        let judged = judge(&answer(&[SWITCH]), &report(Verdict::Ambiguous, &[SWITCH, BUILD_UP]), 1.0);
        assert_eq!((judged.truth_in_class, judged.true_class_size, judged.class_size), (Some(true), Some(1), 2));
    }

    #[test]
    fn of_a_class_of_several_just_all_must_be_named() {
        let class = [SWITCH, BUILD_UP, ON_DELAY];
        check(&class, Verdict::Ambiguous, &[ON_DELAY, SWITCH, BUILD_UP], true);
        check(&class, Verdict::Ambiguous, &[ON_DELAY, SWITCH], false);
        check(&class[..2], Verdict::Ambiguous, &class, false);
        check(&class, Verdict::Effect, &[SWITCH], false);
        check(&class, Verdict::Partial, &class, false);
        // Where one of the two names no component, the device says enough.
        check(&class, Verdict::Ambiguous, &[SWITCH, BUILD_UP, ("on-delay", "sensor", None)], true);
        check(&class, Verdict::Ambiguous, &[SWITCH, BUILD_UP, ("on-delay", "sensor", Some("blowOn"))], false);
        // Another place is another effect.
        check(&class, Verdict::Ambiguous, &[SWITCH, BUILD_UP, ("on-delay", "report-link", Some("vacuumOn"))], false);
    }

    #[test]
    fn a_parameter_is_another_name_of_the_effect_with_the_same_motion() {
        check(&[BUILD_UP, TIME], Verdict::Effect, &[BUILD_UP], true);
        check(&[TIME, BUILD_UP], Verdict::Effect, &[BUILD_UP], true);
        check(&[TIME, BUILD_UP], Verdict::Effect, &[TIME], true);
        check(&[BUILD_UP, SWITCH, TIME], Verdict::Ambiguous, &[SWITCH, BUILD_UP], true);
        check(&[BUILD_UP, SWITCH, TIME], Verdict::Ambiguous, &[SWITCH, BUILD_UP, TIME], true);
        // No effect does what the parameter does: it is the answer.
        check(&[TIME], Verdict::Effect, &[TIME], true);
        check(&[TIME], Verdict::Effect, &[BUILD_UP], false);
        assert_eq!(
            judge(&answer(&[BUILD_UP, TIME]), &report(Verdict::Effect, &[BUILD_UP]), 1.0).true_class_size,
            Some(1)
        );
    }

    /// A lag of the second order that one of the first cannot be told from: the second is one number more.
    #[test]
    fn what_fewer_numbers_do_as_well_is_what_must_be_named() {
        const SECOND: One<'static> = ("second-order-lag", "actuator", None);
        const FIRST: One<'static> = ("first-order-lag", "actuator", None);
        const LATE: One<'static> = ("dead-time", "report-link", None);
        let class = [SECOND, FIRST, LATE];
        check(&class, Verdict::Ambiguous, &[FIRST, LATE], true);
        check(&class, Verdict::Ambiguous, &[LATE, FIRST, SECOND], true);
        check(&class, Verdict::Ambiguous, &[SECOND, FIRST], false);
        check(&class, Verdict::Ambiguous, &[FIRST, LATE, SWITCH], false);
        check(&class, Verdict::Effect, &[FIRST], false);
        check(&class[..2], Verdict::Effect, &[FIRST], true);
        check(&class[..2], Verdict::Effect, &[SECOND], true);
        check(&class[..2], Verdict::Ambiguous, &[FIRST, SECOND], true);
        check(&class[..2], Verdict::Effect, &[LATE], false);
        check(&[FIRST, LATE], Verdict::Ambiguous, &[FIRST, LATE, SECOND], false);
    }

    #[test]
    fn answers_without_a_class_are_judged_by_the_one_that_was_named() {
        let older = Answer { class: Vec::new(), ..answer(&[SWITCH]) };
        let judged = judge(&older, &report(Verdict::Ambiguous, &[BUILD_UP, SWITCH]), 1.0);
        assert_eq!((judged.single_right, judged.true_class_size), (Some(true), None));
        let text = r#"{"case":"1","sort":"single","magnitude":"clear","effects":[]}"#;
        assert_eq!(serde_json::from_str::<Answer>(text).map(|answer| answer.class).ok(), Some(Vec::new()));
    }

    #[test]
    fn an_exam_tells_how_large_the_classes_are() {
        use crate::exam::{Exam, Spread, page};
        let judged = vec![
            judge(&answer(&[SWITCH, BUILD_UP, TIME]), &report(Verdict::Ambiguous, &[BUILD_UP, SWITCH]), 1.0),
            judge(&answer(&[SWITCH]), &report(Verdict::Ambiguous, &[SWITCH, BUILD_UP, ON_DELAY]), 1.0),
        ];
        let exam = Exam::new(7, "2026-01-31".to_owned(), judged, BTreeMap::new());
        let spread = |median, counts| Spread { n: 2, median: Some(median), counts: BTreeMap::from(counts) };
        assert_eq!(
            (&exam.true_classes, &exam.named_classes),
            (&spread(1, [(1, 1), (2, 1)]), &spread(2, [(2, 1), (3, 1)]))
        );
        assert_eq!((exam.rates.single_right.value, exam.rates.truth_in_class.value), (Some(0.5), Some(1.0)));
        assert!(page(&exam).contains("Gripper: switch-on-delay (or Gripper: vacuum-build-up)"));
    }
}
