//! An axis whose load hangs on a spring, from one that sways to one that hardly gives: found wherever its search begins, and told from a
//! drive that lags.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose, kept_back};
use kinetwin::gap::report::Verdict;
use kinetwin::run::model;
use machine::{Case, case};

/// N/m, of an axis of 20 kg.
#[track_caller]
fn check(stiffness: f64) {
    let plant = model::load("models/rig").expect("the rig");
    let spring = case("Axis", ("transmission", "compliance", ""), "stiffness", stiffness);
    let case = Case { beside: &[("damping", 50.0)], ..spring };
    let split = kept_back(&[machine::record("models/rig", &plant, Some(&case), 20)]);
    let options = Options {
        is_asked: &|id| ["compliance", "first-order-lag", "second-order-lag"].contains(&id),
        is_meant: &|name| name == "Axis",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    let report = diagnose(&plant, &split.train, &split.held_out, &options).expect("a diagnosis").report;
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    assert_eq!((report.verdict, cause.effect.as_str()), (Verdict::Effect, "compliance"), "{}", report.to_json());
    let found = cause.parameters.iter().find(|found| found.name == "stiffness").expect("it").value;
    assert!((found / stiffness - 1.0).abs() < 0.05, "{found} of {stiffness}");
}

#[test]
fn an_axis_that_sways() {
    check(600.0);
}

#[test]
fn an_axis_on_a_soft_coupling() {
    check(9_700.0);
}

#[test]
fn an_axis_that_hardly_gives() {
    check(250_000.0);
}
