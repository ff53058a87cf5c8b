//! What draws anew each time is named with its law, and what it drew is no gap of anything else.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::{Cause, Report, Verdict};
use kinetwin::run::model;
use machine::{Case, case, record};

/// What is said of a rig with these effects of its axis.
fn diagnosed(cases: &[Case]) -> Report {
    let plant = model::load("models/rig").expect("the rig");
    let [train, held_out] = [20, 12].map(|seconds| [record("models/rig", &plant, cases, seconds)]);
    let options = Options {
        is_asked: &|id| ["intermittent", "lost-messages", "noise", "gain", "dead-time"].contains(&id),
        is_meant: &|name| name == "Axis",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report
}

/// The one cause that is named of a rig whose axis has this effect of a signal, with this parameter.
fn named(effect: (&'static str, &'static str, &'static str), parameter: &'static str, value: f64) -> Cause {
    let report = diagnosed(&[case("Axis", effect, parameter, value)]);
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
    let report = diagnosed(&[contact, scatters]);
    let found: Vec<_> = report.cause.iter().map(|cause| (cause.effect.as_str(), cause.component.as_deref())).collect();
    let expected = [("intermittent", Some("force")), ("noise", Some("velocity"))];
    assert_eq!((report.verdict, found.as_slice()), (Verdict::Effect, &expected[..]), "{}", report.to_json());
    assert!(is_within(&report.cause[1], "sigma", 0.05), "{:?}", report.cause[1].parameters);
}
