use std::collections::BTreeMap;

use super::*;
use crate::gap::report::{Cause, DeviceGap, FittedParameter, Report, Rival, Verdict};
use crate::plant::EffectPlace;

fn truth(device: &str, effect: &str, place: &str) -> TrueEffect {
    TrueEffect {
        device: device.to_owned(),
        component: None,
        effect: effect.to_owned(),
        place: place.to_owned(),
        parameters: vec![("force".to_owned(), 10.0)],
    }
}

fn answer(case: &str, sort: Sort, magnitude: Magnitude, effects: Vec<TrueEffect>) -> Answer {
    let (class, classes) = (Vec::new(), Vec::new());
    Answer { case: case.to_owned(), sort, magnitude, effects, class, classes, kind: None, model: None }
}

fn report(verdict: Verdict, causes: &[(&str, &str, EffectPlace)]) -> Report {
    let mut report = Report::new(verdict);
    for (device, effect, place) in causes {
        let parameter = FittedParameter {
            name: "force".to_owned(),
            value: 10.1,
            unit: "N".to_owned(),
            ci95: [9.9, 10.3],
            not_identifiable: false,
        };
        let mut cause = Cause {
            device: (*device).to_owned(),
            component: None,
            effect: (*effect).to_owned(),
            place: *place,
            weight: 0.9,
            class: Vec::new(),
            parameters: vec![parameter],
            texts: BTreeMap::new(),
        };
        cause.class.push(cause.member());
        report.cause.push(cause);
        let device = (*device).to_owned();
        report.devices.push(DeviceGap { device, share: 0.5, signals: Vec::new(), regimes: Vec::new() });
    }
    report
}

#[test]
fn an_effect_is_right_on_its_device_at_its_place() {
    let coulomb = answer("1", Sort::Single, Magnitude::Clear, vec![truth("Axis", "coulomb-friction", "mechanics")]);
    let check = |device: &str, effect: &str, place, device_right: bool, right: bool| {
        let judged = judge(&coulomb, &report(Verdict::Effect, &[(device, effect, place)]), 1.0);
        assert_eq!((judged.device_right, judged.single_right), (Some(device_right), Some(right)), "{judged:?}");
        assert_eq!(judged.covered, if right { [1, 1] } else { [0, 0] });
    };
    check("Axis", "coulomb-friction", EffectPlace::Mechanics, true, true);
    check("Axis", "viscous-friction", EffectPlace::Mechanics, true, false);
    check("Axis", "coulomb-friction", EffectPlace::Load, true, false);
    check("Belt", "coulomb-friction", EffectPlace::Mechanics, false, false);
    // A second cause beside the truth is one too many.
    let two = [("Axis", "coulomb-friction", EffectPlace::Mechanics), ("Belt", "belt-slip", EffectPlace::Transmission)];
    assert_eq!(judge(&coulomb, &report(Verdict::Effect, &two), 1.0).single_right, Some(false));
    assert_eq!(judge(&coulomb, &report(Verdict::NoGap, &[]), 1.0).single_right, Some(false));
}

#[test]
fn a_class_that_holds_the_truth_is_right_and_both_of_two_must_be_found() {
    let late = answer("1", Sort::Single, Magnitude::Gross, vec![truth("Gripper", "dead-time", "report-link")]);
    let mut ambiguous = report(Verdict::Ambiguous, &[("Gripper", "dead-time", EffectPlace::CommandLink)]);
    assert_eq!(judge(&late, &ambiguous, 1.0).single_right, Some(false));
    let mut member = ambiguous.cause[0].member();
    member.place = EffectPlace::ReportLink;
    ambiguous.cause[0].class.push(member);
    assert_eq!(judge(&late, &ambiguous, 1.0).single_right, Some(true));
    // What the class weighs stands beside whether the truth is in it: the rival that is in it counts, another does not.
    let rival = |effect: &str, weight: f64| Rival {
        device: "Gripper".to_owned(),
        component: None,
        effect: effect.to_owned(),
        place: EffectPlace::ReportLink,
        weight,
        told_apart_by: String::new(),
        set: None,
        parameters: Vec::new(),
        texts: BTreeMap::new(),
    };
    ambiguous.cause[0].weight = 0.5;
    ambiguous.rivals = vec![rival("dead-time", 0.3), rival("stale-hold", 0.2)];
    assert_eq!(judge(&late, &ambiguous, 1.0).weight, Some(0.8));

    let effects = vec![truth("Axis", "backlash", "transmission"), truth("Belt", "belt-slip", "transmission")];
    let two = answer("2", Sort::OneOnEachOfTwo, Magnitude::Clear, effects);
    let [one, other] = [("Axis", "backlash"), ("Belt", "belt-slip")].map(|(d, e)| (d, e, EffectPlace::Transmission));
    assert_eq!(judge(&two, &report(Verdict::Effect, &[other, one]), 1.0).both_right, Some(true));
    assert_eq!(judge(&two, &report(Verdict::Effect, &[one]), 1.0).both_right, Some(false));

    // What nobody can tell from the one is as good a name of it, but not of both.
    let scale = ("Belt", "scale-error", EffectPlace::Transmission);
    let member = |device: &str, effect: &str| ClassMember {
        device: device.to_owned(),
        component: None,
        effect: effect.to_owned(),
        place: "transmission".to_owned(),
    };
    assert_eq!(judge(&two, &report(Verdict::Effect, &[one, scale]), 1.0).both_right, Some(false));
    let classes =
        vec![vec![member("Axis", "backlash")], vec![member("Belt", "belt-slip"), member("Belt", "scale-error")]];
    let known = Answer { classes, ..two.clone() };
    assert_eq!(judge(&known, &report(Verdict::Effect, &[one, scale]), 1.0).both_right, Some(true));
    assert_eq!(judge(&known, &report(Verdict::Effect, &[scale]), 1.0).both_right, Some(false));
    let classes = vec![known.classes[1].clone(), known.classes[1].clone()];
    let alike = Answer { classes, effects: vec![two.effects[1].clone(), two.effects[1].clone()], ..two };
    assert_eq!(judge(&alike, &report(Verdict::Effect, &[other]), 1.0).both_right, Some(false));
    assert_eq!(judge(&alike, &report(Verdict::Effect, &[other, scale]), 1.0).both_right, Some(true));
}

#[test]
fn a_limit_is_another_name_of_a_lowered_greatest() {
    let of = |component: &str, effect: &str, place: &str| TrueEffect {
        component: Some(component.to_owned()),
        ..truth("Robot", effect, place)
    };
    let check = |true_one: TrueEffect, component: &str, named: (&'static str, EffectPlace), is_right: bool| {
        let two = answer("2", Sort::TwoOnOneDevice, Magnitude::Clear, vec![true_one]);
        let mut report = report(Verdict::Effect, &[("Robot", named.0, named.1)]);
        match named.0 {
            "parameter-error" => drop(report.cause[0].texts.insert("parameter".to_owned(), component.to_owned())),
            _ => report.cause[0].component = Some(component.to_owned()),
        }
        assert_eq!(judge(&two, &report, 1.0).both_right, Some(is_right), "{report:?}");
    };
    let limit = ("velocity-limit", EffectPlace::Actuator);
    check(of("maxVelocityX", "parameter-error", "any"), "X", limit, true);
    check(of("maxVelocityX", "parameter-error", "any"), "Y", limit, false);
    check(of("maxAccelerationX", "parameter-error", "any"), "X", limit, false);
    check(
        of("R", "acceleration-limit", "actuator"),
        "maxAccelerationR",
        ("parameter-error", EffectPlace::Actuator),
        true,
    );
    check(of("R", "acceleration-limit", "actuator"), "maxVelocityR", ("parameter-error", EffectPlace::Actuator), false);
}

#[test]
fn what_nobody_has_to_know_is_wrong_only_where_it_is_answered_surely() {
    let check = |sort, magnitude, verdict, causes: &[(&str, &str, EffectPlace)], is_wrong: bool| {
        let effects = match sort {
            Sort::None => Vec::new(),
            _ => vec![truth("Axis", "coulomb-friction", "mechanics")],
        };
        let judged = judge(&answer("1", sort, magnitude, effects), &report(verdict, causes), 1.0);
        assert_eq!(judged.is_wrong(), is_wrong, "{judged:?}");
    };
    let viscous = [("Axis", "viscous-friction", EffectPlace::Mechanics)];
    let coulomb = [("Axis", "coulomb-friction", EffectPlace::Mechanics)];
    check(Sort::Single, Magnitude::Clear, Verdict::NoGap, &[], true);
    check(Sort::Single, Magnitude::Clear, Verdict::Effect, &coulomb, false);
    for magnitude in [Magnitude::Faint, Magnitude::BelowNoise] {
        check(Sort::Single, magnitude, Verdict::NoGap, &[], false);
        check(Sort::Single, magnitude, Verdict::Ambiguous, &viscous, false);
        check(Sort::Single, magnitude, Verdict::Effect, &viscous, true);
    }
    check(Sort::None, Magnitude::None, Verdict::NoGap, &[], false);
    check(Sort::None, Magnitude::None, Verdict::Ambiguous, &viscous, true);
    check(Sort::Outside, Magnitude::Gross, Verdict::Partial, &coulomb, false);
    check(Sort::Outside, Magnitude::Gross, Verdict::Ambiguous, &coulomb, true);
}

#[test]
fn rates_count_what_they_are_about() {
    let none = |case: &str| answer(case, Sort::None, Magnitude::None, Vec::new());
    let outside = answer("3", Sort::Outside, Magnitude::Clear, vec![truth("Axis", "x-cogs", "mechanics")]);
    let faint = answer("4", Sort::Single, Magnitude::Faint, vec![truth("Axis", "backlash", "transmission")]);
    let sure = report(Verdict::Effect, &[("Axis", "coulomb-friction", EffectPlace::Mechanics)]);
    let judged = vec![
        judge(&none("1"), &report(Verdict::NoGap, &[]), 1.0),
        judge(&none("2"), &sure, 3.0),
        judge(&outside, &report(Verdict::Unknown, &[]), 2.0),
        judge(&faint, &sure, 2.0),
        unanswered(&none("5"), 2.0),
    ];
    let failed = BTreeMap::from([("5".to_owned(), "no report".to_owned())]);
    let exam = Exam::new(7, "2026-01-31".to_owned(), judged, failed);
    let Rates { false_alarm, outside_right, outside_sure_wrong, single_right, faint_sure_wrong, .. } = exam.rates;
    // What has no answer is wrong.
    assert_eq!((false_alarm.value, false_alarm.n), (Some(2.0 / 3.0), 3));
    assert_eq!((outside_right.value, outside_sure_wrong.value), (Some(1.0), Some(0.0)));
    assert_eq!((single_right.value, faint_sure_wrong.value), (None, Some(1.0)), "faint ones have a rate of their own");
    assert_eq!((exam.cases, exam.seconds_per_case), (5, Some(2.0)));
    let html = page(&exam);
    assert!(
        html.contains("outside of the library: unknown or partial") && html.contains("5 has no verdict: no report")
    );
}

#[test]
fn sealed_answers_are_read_and_what_is_none_is_said_to_be_none() {
    let text = br#"{"schema":"kinetwin-answers/1","exam":"short","seed":7,"cases":[{"case":"case-001","model":"models/rig",
        "sort":"one-on-each-of-two","magnitude":"below-noise","distance":0.5,"effects":[{"device":"Axis","effect":"backlash",
        "place":"transmission","parameters":[["gap",0.001]]}],"surroundings":{"cycle":0.02}}]}"#;
    let (seed, answers) = read_answers(text).expect("answers");
    assert_eq!(answers[0].kind, None, "answers that name no kind are read too");
    assert_eq!((seed, answers[0].sort, answers[0].magnitude), (7, Sort::OneOnEachOfTwo, Magnitude::BelowNoise));
    assert!(read_answers(b"{}").expect_err("none").to_string().contains("expected what withheld-plant sealed"));
}

#[test]
fn an_exam_is_told_by_magnitude_by_device_by_plant_and_effect_by_effect() {
    let on = |case: &str, model: &str, effect: &str| Answer {
        kind: Some("Feed".to_owned()),
        model: Some(model.to_owned()),
        ..answer(case, Sort::Single, Magnitude::Clear, vec![truth("Axis7", effect, "mechanics")])
    };
    let named = |effect| report(Verdict::Effect, &[("Axis7", effect, EffectPlace::Mechanics)]);
    let outside = Answer { sort: Sort::Outside, ..on("4", "models/rig-toleranced", "x-cogs") };
    let judged = vec![
        judge(&on("1", "models/rig-toleranced", "coulomb-friction"), &named("coulomb-friction"), 1.0),
        judge(&on("2", "models/rig-toleranced", "coulomb-friction"), &named("viscous-friction"), 3.0),
        judge(&on("3", "plant.xml", "viscous-friction"), &report(Verdict::Partial, &[]), 5.0),
        judge(&outside, &report(Verdict::Unknown, &[]), 2.0),
    ];
    let exam = Exam::new(7, "2026-01-31".to_owned(), judged, BTreeMap::new());
    let value = |groups: &Groups, group: &str, rate: &str| groups[group].get(rate).and_then(|rate| rate.value);
    assert_eq!(value(&exam.by_device, "Feed", "single_right"), Some(1.0 / 3.0));
    assert_eq!(value(&exam.by_magnitude, "clear", "outside_right"), Some(1.0));
    assert_eq!(value(&exam.by_effect, "coulomb-friction", "single_right"), Some(0.5));
    assert_eq!(value(&exam.by_effect, "x-cogs", "single_right"), None);
    assert_eq!(value(&exam.by_effect, "x-cogs", "outside_right"), Some(1.0));
    assert_eq!(value(&exam.by_plant, "drawn at random", "single_right"), Some(0.0));
    assert_eq!(exam.seconds["rig-toleranced"].value, Some(2.0));
    // Both answers weigh 0.9; one of the two is right.
    let [bin] = exam.calibration.as_slice() else { panic!("{:?}", exam.calibration) };
    assert_eq!((bin.right.n, bin.right.value), (2, Some(0.5)));
    let html = page(&exam);
    let matrix = &html[html.find("Confusion matrix").expect("a matrix")..];
    for cell in
        ["<span>right</span>", "<span>viscous-friction</span>", "<span>partial</span>", "<td class=\"met\">1</td>"]
    {
        assert!(matrix.contains(cell), "{cell}: {matrix}");
    }
    assert!(html.contains("share of right answers over their weight") && html.contains("at least 95 %"), "{html}");
}
