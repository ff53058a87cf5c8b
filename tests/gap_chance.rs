//! What draws anew each time is named with its law, and what it drew is no gap of anything else.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::{Cause, Report, Verdict};
use kinetwin::run::model;
use machine::{Case, case, record};

const ASKED: &[&str] = &["intermittent", "lost-messages", "noise", "gain", "dead-time"];

/// What is said of a rig with these effects of its axis, where these are asked for, by so many seconds of it.
fn diagnosed(cases: &[Case], asked: &[&str], seconds: u64) -> Report {
    let plant = model::load("models/rig").expect("the rig");
    let [train, held_out] = [seconds, 12].map(|seconds| [record("models/rig", &plant, cases, seconds)]);
    let options = Options {
        is_asked: &|id| asked.contains(&id),
        is_meant: &|name| name == "Axis",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report
}

/// The one cause that is named of a rig whose axis has this effect of a signal, with this parameter.
fn named(effect: (&'static str, &'static str, &'static str), parameter: &'static str, value: f64) -> Cause {
    let report = diagnosed(&[case("Axis", effect, parameter, value)], ASKED, 20);
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    assert_eq!(report.verdict, Verdict::Effect, "{}", report.to_json());
    assert_eq!((cause.effect.as_str(), cause.component.as_deref()), (effect.1, Some(effect.2)));
    cause.clone()
}

fn is_within(cause: &Cause, parameter: &str, value: f64) -> bool {
    cause.parameters.iter().any(|found| found.name == parameter && (found.ci95[0]..=found.ci95[1]).contains(&value))
}

#[test]
fn a_loose_contact_is_told_with_its_share_and_its_window() {
    let cause = named(("report-link", "intermittent", "velocity"), "probability", 0.2);
    assert!(is_within(&cause, "probability", 0.2) && is_within(&cause, "time", 0.1), "{:?}", cause.parameters);
}

#[test]
fn a_sensor_that_scatters_is_told_with_its_sigma() {
    let cause = named(("sensor", "noise", "position"), "sigma", 0.002);
    assert!(is_within(&cause, "sigma", 0.002), "{:?}", cause.parameters);
}

#[test]
fn a_sensor_that_scatters_is_told_beside_a_loose_contact_of_another() {
    let contact = case("Axis", ("report-link", "intermittent", "force"), "probability", 0.2);
    let scatters = case("Axis", ("sensor", "noise", "velocity"), "sigma", 0.05);
    let report = diagnosed(&[contact, scatters], ASKED, 20);
    let found: Vec<_> = report.cause.iter().map(|cause| (cause.effect.as_str(), cause.component.as_deref())).collect();
    let expected = [("intermittent", Some("force")), ("noise", Some("velocity"))];
    assert_eq!((report.verdict, found.as_slice()), (Verdict::Effect, &expected[..]), "{}", report.to_json());
    assert!(is_within(&report.cause[1], "sigma", 0.05), "{:?}", report.cause[1].parameters);
}

/// What each of them does to the reports hides the other: neither has a prediction that it could be read beside.
#[test]
fn a_loose_contact_is_read_off_the_recording_where_another_effect_moves_all_of_it() {
    let contact = case("Axis", ("report-link", "intermittent", "position"), "probability", 0.2);
    let filter = case("Axis", ("command-link", "input-filter", "positionTarget"), "time_constant", 0.1);
    let report = diagnosed(&[contact, filter], &["intermittent", "lost-messages", "input-filter", "gain-error"], 60);
    let found: Vec<&str> = report.cause.iter().map(|cause| cause.effect.as_str()).collect();
    assert_eq!(
        (report.verdict, found.as_slice()),
        (Verdict::Effect, &["intermittent", "input-filter"][..]),
        "{}",
        report.to_json()
    );
    for (cause, (parameter, value)) in report.cause.iter().zip([("probability", 0.2), ("time_constant", 0.1)]) {
        assert!(is_within(cause, parameter, value), "{parameter}: {:?}", cause.parameters);
    }
}

/// Reports that are held in turn are no lost ones, and an axis that is slow one way loses none.
#[test]
fn what_comes_in_turn_is_not_lost_by_chance() {
    let held = case("Axis", ("report-link", "stale-hold", ""), "time", 0.03);
    let slower = case("Axis", ("actuator", "direction-asymmetry", ""), "asymmetry", 0.2);
    for cases in [&[held, slower][..], &[slower][..]] {
        let report = diagnosed(cases, &["lost-messages", "intermittent", "gain-error"], 60);
        assert!(report.cause.iter().all(|cause| cause.effect == "gain-error"), "{}", report.to_json());
    }
}
