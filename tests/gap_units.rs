//! An axis that reports in another unit: its loop is as stiff as ever, and no place that it reports is one that it could begin at.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::{Report, Verdict};
use kinetwin::run::model;
use machine::{case, record};

/// What is answered of a machine whose axis reports its position as so many times what it is.
fn diagnosed(factor: f64) -> Report {
    let plant = model::load("models/rig").expect("the rig");
    let case = case("Axis", ("report-link", "wrong-unit", "position"), "factor", factor);
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
    let report = diagnosed(1000.0);
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    assert_eq!((report.verdict, cause.effect.as_str()), (Verdict::Effect, "wrong-unit"), "{}", report.to_json());
    assert_eq!(cause.component.as_deref(), Some("position"));
    assert!(cause.parameters.iter().any(|found| found.name == "factor" && found.value == 1000.0));
}
