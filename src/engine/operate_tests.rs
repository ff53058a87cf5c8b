//! What an operator does, on plants built by hand.

use super::bench::{Bench, Driven};
use super::*;

fn belt() -> Driven {
    let bench =
        Bench::default().add("Belt", "StraightConveyor", [0.0; 4], &[("length", "2.0"), ("acceleration", "1.0")]).add(
            "Feed",
            "LoadingBay",
            [0.0; 4],
            &[("belt", "Belt"), ("at", "0.15"), ("firstTime", "1.0"), ("interval", "6.0")],
        );
    let mut driven = bench.engine(1000);
    driven.set("Belt.velocityTarget", 0.5);
    driven.set("Belt.motorDirection", 1.0);
    driven.run_to(1.0);
    driven
}

fn register(driven: &Driven, name: &str) -> RegisterId {
    driven.register(name)
}

#[test]
fn a_forced_command_holds_against_the_automation_and_gives_way_to_it_after() {
    let mut driven = belt();
    let signal = register(&driven, "Belt.velocityTarget");
    driven.engine.operate(&Act::Force { signal, value: Value::Real(0.1) }).expect("a number");
    driven.run_to(3.0);
    assert_eq!(
        (driven.get("Belt.velocityTarget"), driven.get("Belt.velocityActual")),
        (f64::from(0.1_f32), f64::from(0.1_f32))
    );
    driven.set("Belt.velocityTarget", 0.3);
    driven.run_to(4.0);
    assert_eq!(driven.get("Belt.velocityActual"), f64::from(0.1_f32), "what the automation sends waits");
    driven.engine.operate(&Act::Release { signal }).expect("it is forced");
    driven.run_to(5.0);
    assert_eq!(driven.get("Belt.velocityActual"), f64::from(0.3_f32), "and counts from the release on");
    assert_eq!(driven.engine.operate(&Act::Release { signal }), Err(ActError::NotHeld));
}

#[test]
fn a_forced_report_and_one_that_sticks_cover_what_the_device_says() {
    let mut driven = belt();
    let [a, b] = ["Belt.lightBarrierA", "Belt.lightBarrierB"].map(|name| register(&driven, name));
    driven.engine.operate(&Act::Force { signal: a, value: Value::Bool(false) }).expect("a switch");
    driven.engine.operate(&Act::Break(Fault::Stuck { signal: b })).expect("a report");
    driven.run_to(1.5);
    assert!(!driven.is("Belt.lightBarrierA"), "a box is in it");
    driven.run_to(4.0);
    assert!(!driven.is("Belt.lightBarrierB"), "a box is in it, and it sticks");
    driven.engine.operate(&Act::Mend(Fault::Stuck { signal: b })).expect("it sticks");
    driven.run_to(4.01);
    assert!(driven.is("Belt.lightBarrierB"));
    let signal = register(&driven, "Belt.velocityTarget");
    assert_eq!(driven.engine.operate(&Act::Break(Fault::Stuck { signal })), Err(ActError::NoReport));
    assert_eq!(driven.engine.operate(&Act::Force { signal, value: Value::Real(f32::NAN) }), Err(ActError::Unfit));
}

#[test]
fn a_drive_without_power_ramps_down_and_comes_back_to_its_command() {
    let mut driven = belt();
    let dead = Fault::Dead { instance: "Belt".to_owned() };
    driven.engine.operate(&Act::Break(dead.clone())).expect("a drive");
    driven.run_to(2.0);
    assert_eq!((driven.get("Belt.velocityActual"), driven.is("Belt.driveEnabled")), (0.0, false));
    assert_eq!(driven.get("Belt.velocityTarget"), 0.5, "the command is as it was sent");
    driven.set("Belt.velocityTarget", 0.25);
    driven.run_to(2.5);
    assert_eq!(driven.get("Belt.velocityActual"), 0.0);
    driven.engine.operate(&Act::Mend(dead.clone())).expect("it is broken");
    driven.run_to(4.0);
    assert_eq!(driven.get("Belt.velocityActual"), 0.25);
    assert_eq!(driven.engine.operate(&Act::Mend(dead)), Err(ActError::Whole));
    let none = Fault::Dead { instance: "Feed".to_owned() };
    assert!(matches!(driven.engine.operate(&Act::Break(none)), Err(ActError::NoDrive { .. })));
}

#[test]
fn a_lost_message_never_arrives() {
    let mut driven = belt();
    driven.engine.operate(&Act::Break(Fault::Lost)).expect("always");
    driven.set("Belt.velocityTarget", 0.1);
    driven.run_to(2.0);
    assert_eq!(driven.get("Belt.velocityTarget"), 0.5);
    driven.set("Belt.velocityTarget", 0.2);
    driven.run_to(3.0);
    assert_eq!(driven.get("Belt.velocityTarget"), f64::from(0.2_f32), "the one after it does");
}

#[test]
fn parts_put_in_and_taken_out_are_counted() {
    let mut driven = belt();
    let part = Insertion {
        kind: PartKind::Box,
        size: [0.3, 0.3, 0.3],
        belt: "Belt".to_owned(),
        station: 1.0,
        offset: 0.0,
        turn: 0.0,
    };
    driven.engine.operate(&Act::Insert(part.clone())).expect("room");
    assert!(matches!(driven.engine.operate(&Act::Insert(part.clone())), Err(ActError::NoRoom(_))));
    let elsewhere = Insertion { belt: "Best".to_owned(), ..part.clone() };
    assert!(matches!(driven.engine.operate(&Act::Insert(elsewhere)), Err(ActError::NoBelt { .. })));
    let flat = Insertion { size: [0.3, f64::NAN, 0.3], ..part };
    assert!(matches!(driven.engine.operate(&Act::Insert(flat)), Err(ActError::NoRoom(_))));
    let number = driven.engine.parts().last().expect("a part").number;
    let before = driven.engine.counts();
    driven.engine.operate(&Act::Remove { number }).expect("it is there");
    let after = driven.engine.counts();
    assert_eq!((after.boxes_present, after.boxes_removed), (before.boxes_present - 1, 1));
    assert_eq!(after.boxes_lost, 0);
    assert_eq!(driven.engine.operate(&Act::Remove { number }), Err(ActError::NoPart { number }));
}
