//! What befalls one axis of a robot is told with its axis, though only that the robot has arrived shows it.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::Verdict;
use kinetwin::run::model;
use machine::{case, record};

#[test]
fn an_axis_that_has_to_settle_is_named() {
    let plant = model::load("models/rig").expect("the rig");
    let slow = case("Robot", ("actuator", "settling-time", "X"), "time", 0.3);
    let [train, held_out] = [40, 20].map(|seconds| [record("models/rig", &plant, Some(&slow), seconds)]);
    let options = Options {
        is_asked: &|id| ["settling-time", "on-delay", "off-delay", "dead-time"].contains(&id),
        is_meant: &|name| name == "Robot",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    let report = diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report;
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    assert!(matches!(report.verdict, Verdict::Effect | Verdict::Ambiguous), "{}", report.to_json());
    assert_eq!((cause.effect.as_str(), cause.component.as_deref()), ("settling-time", Some("X")));
}
