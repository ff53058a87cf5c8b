//! An axis that reports in another unit: its loop is as stiff as ever, and no place that it reports is one that it could begin at.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::{Report, Verdict};
use kinetwin::run::model;
use machine::{case, record};

/// What is answered of a machine whose axis makes so many times what it is of one of its reports.
fn diagnosed(component: &'static str, factor: f64) -> Report {
    let plant = model::load("models/rig").expect("the rig");
    let case = case("Axis", ("report-link", "wrong-unit", component), "factor", factor);
    let [train, held_out] = [20, 12].map(|seconds| [record("models/rig", &plant, Some(&case), seconds)]);
    let options = Options {
        is_asked: &|id| ["wrong-unit", "inverted", "gain", "gain-error", "coulomb-friction"].contains(&id),
        is_meant: &|name| name == "Axis",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report
}

#[test]
fn millimetres_for_metres_are_found_as_a_unit() {
    let report = diagnosed("position", 1000.0);
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    assert_eq!((report.verdict, cause.effect.as_str()), (Verdict::Effect, "wrong-unit"), "{}", report.to_json());
    assert_eq!(cause.component.as_deref(), Some("position"));
    assert!(cause.parameters.iter().any(|found| found.name == "factor" && found.value == 1000.0));
}

/// A gain of a sensor that happens to be a thousandth would do the same: it is no rival of what needs no number.
#[test]
fn kilonewtons_for_newtons_are_a_unit_and_no_gain() {
    let report = diagnosed("force", 1e-3);
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    assert_eq!((report.verdict, cause.effect.as_str()), (Verdict::Effect, "wrong-unit"), "{}", report.to_json());
    assert_eq!((cause.component.as_deref(), cause.class.len()), (Some("force"), 1), "{}", report.to_json());
}
