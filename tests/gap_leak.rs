//! A gripper that loses what it holds: nothing shows it but grips that last longer than the leak lets them.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::Verdict;
use kinetwin::run::model;
use machine::{case, record};

#[test]
fn a_leak_is_found_that_lets_go_within_the_grips_of_this_recording() {
    let plant = model::load("models/rig").expect("the rig");
    let case = case("Gripper", ("process", "leak", ""), "rate", 1.95);
    let [train, held_out] = [40, 20].map(|seconds| [record("models/rig", &plant, Some(&case), seconds)]);
    let options =
        Options { is_asked: &|_| true, is_meant: &|name| name == "Gripper", is_stopped: &|| false, tell: &|_| {} };
    let report = diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report;
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    assert_eq!((report.verdict, cause.effect.as_str()), (Verdict::Effect, "leak"), "{}", report.to_json());
    assert!((cause.parameters[0].value - 1.95).abs() < 0.03, "{}", report.to_json());
}
