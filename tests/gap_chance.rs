//! What draws anew each time is named with its law, and what it drew is no gap of anything else.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::{Cause, Verdict};
use kinetwin::run::model;
use machine::{case, record};

/// The one cause that is named of a rig whose axis has this effect of a signal, with this parameter.
fn named(effect: (&'static str, &'static str, &'static str), parameter: &'static str, value: f64) -> Cause {
    let plant = model::load("models/rig").expect("the rig");
    let case = case("Axis", effect, parameter, value);
    let [train, held_out] = [20, 12].map(|seconds| [record("models/rig", &plant, Some(&case), seconds)]);
    let options = Options {
        is_asked: &|id| ["intermittent", "lost-messages", "noise", "gain", "dead-time"].contains(&id),
        is_meant: &|name| name == "Axis",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    let report = diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report;
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
