//! A bay reports nothing: what it makes of its parts, and when, is told by the light barriers of the belt that it feeds.

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::gap::report::{Report, Verdict};
use kinetwin::run::model;
use machine::{case, record};

/// What is said of the rig with an effect of its bay, asked of a few that could be it, of these devices.
fn said(meant: &[&str], effect: &'static str, parameter: &'static str, value: f64) -> Report {
    const ASKED: [&str; 6] =
        ["part-length-error", "part-spacing-error", "hysteresis", "blind-range", "on-delay", "off-delay"];
    let plant = model::load("models/rig").expect("the rig");
    let case = case("Feed", ("process", effect, ""), parameter, value);
    let [train, held_out] = [60, 30].map(|seconds| [record("models/rig", &plant, Some(&case), seconds)]);
    let is_meant = |name: &str| meant.contains(&name);
    let is_asked = |id: &str| ASKED.contains(&id);
    let options = Options { is_asked: &is_asked, is_meant: &is_meant, is_stopped: &|| false, tell: &|_| {} };
    diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report
}

fn check(meant: &[&str], effect: &'static str, parameter: &'static str, value: f64, off: f64) {
    let report = said(meant, effect, parameter, value);
    let [cause] = report.cause.as_slice() else { panic!("{}", report.to_json()) };
    let named = (cause.device.as_str(), cause.effect.as_str());
    assert_eq!((report.verdict, named), (Verdict::Effect, ("Feed", effect)), "{}", report.to_json());
    assert!((cause.parameters[0].value - value).abs() < off, "{}", report.to_json());
    assert_eq!(report.devices.iter().map(|gap| gap.device.as_str()).collect::<Vec<_>>(), ["Feed"]);
}

#[test]
fn parts_that_come_further_apart_than_scheduled_are_the_bays() {
    check(&["Belt", "Feed"], "part-spacing-error", "time", 0.15, 0.01);
}

#[test]
fn parts_that_darken_both_barriers_for_less_are_shorter() {
    check(&["Belt", "Feed"], "part-length-error", "length", -0.04, 0.004);
}

/// They are shorter by more than a part of one length may be off.
#[test]
fn a_bay_alone_may_be_meant() {
    check(&["Feed"], "part-length-error", "length", -0.1, 0.004);
}

#[test]
fn a_bay_in_order_is_measured_on_its_belt() {
    let report = said(&["Feed"], "part-length-error", "length", 0.0);
    assert_eq!(report.verdict, Verdict::NoGap, "{}", report.to_json());
    assert_eq!((report.shrink.holdout_before, report.shrink.holdout_after), (Some(1.0), Some(1.0)));
}
