//! The de-palletization line with an effect on one of its devices: where it is found, and what it is taken for.
//!
//! The machine is our own engine with the effect added; what is diagnosed knows its signals alone. The table of all effects that
//! the line can show is printed by
//!
//!     cargo test --release --test gap_line -- --ignored --nocapture

mod machine;

use kinetwin::gap::diagnosis::{Options, diagnose, kept_back};
use kinetwin::gap::report::{Report, Verdict};
use kinetwin::gap::{Recording, Study, locate};
use kinetwin::plant::Plant;
use kinetwin::run::model;
use machine::{Case, case};

const LINE: &str = "models/depalletizer";

/// The line under its automation for some seconds.
fn record(plant: &Plant, case: Option<&Case>, seconds: u64) -> Recording {
    machine::record(LINE, plant, case, seconds)
}

/// The devices that have a gap of their own.
fn located(case: Option<&Case>, seconds: u64) -> Vec<String> {
    let plant = model::load(LINE).expect("the line");
    let study = Study::new(&plant, &[record(&plant, case, seconds)]).expect("a study");
    let located = locate(&study).devices.into_iter().filter(|device| device.own);
    located.map(|device| device.device).collect()
}

#[track_caller]
fn check_where(cases: &[Case], seconds: u64) {
    for case in cases {
        assert_eq!(located(Some(case), seconds), [case.device], "{case:?}");
    }
}

fn diagnosed(case: &Case, seconds: u64, effects: &[&str]) -> Report {
    let plant = model::load(LINE).expect("the line");
    let split = kept_back(&[record(&plant, Some(case), seconds)]);
    let options = Options {
        is_asked: &|id| effects.is_empty() || effects.contains(&id),
        is_meant: &|name| name == case.device,
        is_stopped: &|| false,
        tell: &|_| {},
    };
    let report = diagnose(&plant, &split.train, &split.held_out, &options).expect("a diagnosis").report;
    assert_eq!(report.flaws(), Vec::<String>::new(), "{case:?}: {}", report.to_json());
    report
}

/// Whether the effect stands in the answer's class.
fn is_named(report: &Report, case: &Case) -> bool {
    let is_it = |component: &Option<String>| component.as_deref().unwrap_or_default() == case.component;
    let of_class = report.cause.iter().flat_map(|cause| &cause.class);
    of_class.into_iter().any(|member| member.effect == case.effect && is_it(&member.component))
}

/// What a belt may do that its barriers see later.
const LATE: [&str; 5] = ["belt-slip", "dead-time", "on-delay", "off-delay", "transfer-slip"];

#[track_caller]
fn check_cause(case: &Case) {
    let report = diagnosed(case, 40, &LATE);
    assert!(is_named(&report, case) && report.verdict != Verdict::Partial, "{case:?}: {}", report.to_json());
    let found = report.cause.iter().filter(|cause| cause.effect == case.effect).flat_map(|cause| &cause.parameters);
    let found = found.into_iter().find(|found| found.name == case.parameter).expect("its parameter").value;
    assert!((found - case.value).abs() < 0.05 * case.value, "{case:?}: {found}");
    assert!(report.shrink.ratio.is_some_and(|ratio| ratio < 0.1), "{case:?}: {}", report.to_json());
}

#[test]
fn three_minutes_of_a_line_as_its_model_has_it_show_no_gap() {
    assert_eq!(located(None, 180), [""; 0]);
}

const SLIP: Case = case("Conveyor5", ("transmission", "belt-slip", ""), "ratio", 0.06);
const LATE_SENSOR: Case = case("Conveyor6", ("sensor", "on-delay", "lightBarrierB"), "time", 0.08);

#[test]
fn a_belt_that_slips_is_no_late_barrier() {
    check_cause(&SLIP);
}

#[test]
fn a_late_barrier_is_no_belt_that_slips() {
    check_cause(&LATE_SENSOR);
}

#[test]
fn who_is_late_upstream_is_named_and_nobody_who_follows() {
    check_where(
        &[
            case("Conveyor3", ("actuator", "first-order-lag", ""), "time_constant", 0.15),
            case("Conveyor3", ("command-link", "dead-time", ""), "time", 0.12),
            case("Conveyor3", ("actuator", "coasting", ""), "deceleration", 0.4),
            case("Conveyor3", ("process", "part-slip", ""), "acceleration", 0.4),
            case("Conveyor4", ("transmission", "scale-error", ""), "ratio", 0.04),
        ],
        45,
    );
}

#[test]
fn neither_a_curve_nor_a_sensor_is_taken_for_its_neighbour() {
    check_where(
        &[
            case("Curve1", ("transmission", "belt-slip", ""), "ratio", 0.06),
            case("Curve1", ("sensor", "on-delay", "lightBarrierB"), "time", 0.08),
            case("Conveyor5", ("sensor", "off-delay", "lightBarrierB"), "time", 0.08),
            case("Conveyor6", ("actuator", "velocity-limit", ""), "limit", 0.5),
        ],
        45,
    );
}

/// A pusher takes parts out of a beam of the belt that it stands beside: when it is late, they leave late.
#[test]
fn a_late_pusher_is_not_taken_for_the_belt_that_it_pushes_from() {
    check_where(
        &[
            case("Pusher1", ("actuator", "velocity-limit", ""), "limit", 1.7),
            case("Pusher2", ("command-link", "dead-time", ""), "time", 0.06),
        ],
        45,
    );
}
