//! The line's program, driven by plain signals under a virtual clock. A part of the plant that a test is not about is
//! left at rest.

use std::time::Duration;

use super::{Line, program};
use crate::automation::bench::{self, Pilot};
use crate::automation::network::Network;

const MS: Duration = Duration::from_millis(1);

/// The line at rest without a part in it, the program begun.
fn line(also: &[(&str, f64)]) -> (Pilot<Network<Line>>, Vec<String>) {
    let mut pilot = Pilot::new(bench::line(), program);
    let rest = [
        ("Pusher1.limitRetracted", 1.0),
        ("Pusher2.limitRetracted", 1.0),
        ("Pusher3.limitRetracted", 1.0),
        ("Robot.cartesianArrived", 1.0),
    ];
    let first = pilot.report(&[&rest, also].concat());
    (pilot, first)
}

/// Of the commands that changed, those of one device.
fn of(changed: Vec<String>, instance: &str) -> Vec<String> {
    changed.into_iter().filter(|text| text.starts_with(&format!("{instance}."))).collect()
}

/// Lets the robot arrive at the place it was sent to: mm, rad.
fn arrive(pilot: &mut Pilot<Network<Line>>, place: [f64; 4]) -> Vec<String> {
    let axes = ["Robot.actualPosX", "Robot.actualPosY", "Robot.actualPosZ", "Robot.actualPosR"];
    pilot.report(&std::array::from_fn::<_, 4, _>(|i| (axes[i], place[i])))
}

#[test]
fn the_box_line_and_the_exits_run_from_the_start() {
    let (_, first) = line(&[]);
    for running in ["Conveyor4", "Conveyor5", "Conveyor6", "Conveyor7", "Conveyor8", "Conveyor10", "Curve1", "Curve2"] {
        assert_eq!(
            of(first.clone(), running),
            [format!("{running}.velocityTarget=0.6"), format!("{running}.motorDirection=1")]
        );
    }
    assert_eq!(of(first, "Pusher1"), Vec::<String>::new(), "it is retracted");
}

#[test]
fn a_pusher_that_is_out_is_retracted_first() {
    let (mut pilot, first) = line(&[("Pusher2.limitRetracted", 0.0)]);
    assert_eq!(of(first, "Pusher2"), ["Pusher2.command=2"]);
    assert_eq!(pilot.report(&[("Pusher2.limitRetracted", 1.0)]), ["Pusher2.command=0"]);
}

#[test]
fn a_pallet_creeps_to_its_place_and_the_robot_waits_until_it_stands() {
    let (mut pilot, first) = line(&[]);
    assert_eq!(of(first, "Conveyor2"), ["Conveyor2.velocityTarget=0.6", "Conveyor2.motorDirection=1"]);
    pilot.report(&[("Conveyor2.driveEnabled", 1.0), ("Conveyor2.driveRunning", 1.0)]);
    assert_eq!(pilot.report(&[("Conveyor2.lightBarrierA", 1.0)]), ["Conveyor2.velocityTarget=0.1"]);
    assert_eq!(pilot.report(&[("Conveyor2.lightBarrierB", 1.0)]), ["Conveyor2.motorDirection=0"]);
    assert_eq!(pilot.report(&[("Conveyor2.driveEnabled", 0.0)]), Vec::<String>::new());
    let to_first_column = ["Robot.XTarget=-400", "Robot.ZTarget=-400", "Robot.RTarget=1.5707964"];
    assert_eq!(pilot.report(&[("Conveyor2.driveRunning", 0.0)]), to_first_column);
}

#[test]
fn the_infeed_stops_a_waiting_pallet_unless_it_is_wanted() {
    let (mut pilot, first) = line(&[("Conveyor2.lightBarrierA", 1.0), ("Conveyor2.lightBarrierB", 1.0)]);
    assert_eq!(of(first, "Conveyor1"), ["Conveyor1.velocityTarget=0.3", "Conveyor1.motorDirection=1"]);
    assert_eq!(pilot.report(&[("Conveyor1.lightBarrierB", 1.0)]), ["Conveyor1.motorDirection=0"]);
    assert_eq!(pilot.report(&[("Conveyor1.lightBarrierB", 0.0)]), ["Conveyor1.motorDirection=1"]);
}

#[test]
fn two_boxes_are_set_down_one_after_the_other() {
    let (mut pilot, _) = line(&[("Conveyor2.lightBarrierA", 1.0), ("Conveyor2.lightBarrierB", 1.0)]);
    let turned = std::f64::consts::FRAC_PI_2;
    assert_eq!(arrive(&mut pilot, [-400.0, 0.0, -400.0, turned]), ["Robot.ZTarget=-774"]);
    assert_eq!(
        arrive(&mut pilot, [-400.0, 0.0, -774.0, turned]),
        ["Gripper1.suctionOn=true", "Gripper2.suctionOn=true"]
    );
    assert_eq!(pilot.report(&[("Gripper1.vacuumOn", 1.0)]), Vec::<String>::new());
    assert_eq!(pilot.report(&[("Gripper2.vacuumOn", 1.0)]), ["Robot.ZTarget=-400"]);
    assert_eq!(
        arrive(&mut pilot, [-400.0, 0.0, -400.0, turned]),
        ["Robot.XTarget=0", "Robot.YTarget=1200", "Robot.RTarget=0"]
    );
    assert_eq!(arrive(&mut pilot, [0.0, 1200.0, -400.0, 0.0]), ["Robot.ZTarget=-704"]);
    assert_eq!(arrive(&mut pilot, [0.0, 1200.0, -704.0, 0.0]), ["Gripper1.suctionOn=false", "Gripper1.blowOn=true"]);
    assert_eq!(pilot.report(&[("Gripper1.vacuumOn", 0.0)]), Vec::<String>::new());
    assert_eq!(pilot.report(&[("Conveyor4.lightBarrierB", 1.0)]), Vec::<String>::new());
    assert_eq!(pilot.report(&[("Conveyor4.lightBarrierB", 0.0)]), ["Gripper2.suctionOn=false", "Gripper2.blowOn=true"]);
    assert_eq!(
        pilot.report(&[("Gripper2.vacuumOn", 0.0)]),
        ["Gripper1.blowOn=false", "Gripper2.blowOn=false", "Robot.ZTarget=-400"]
    );
    assert_eq!(pilot.counts().parts_in, 2);
}

#[test]
fn a_column_without_boxes_is_left_after_a_second() {
    let (mut pilot, _) = line(&[("Conveyor2.lightBarrierA", 1.0), ("Conveyor2.lightBarrierB", 1.0)]);
    let turned = std::f64::consts::FRAC_PI_2;
    arrive(&mut pilot, [-400.0, 0.0, -400.0, turned]);
    arrive(&mut pilot, [-400.0, 0.0, -774.0, turned]);
    assert_eq!(of(pilot.advance(999 * MS), "Robot"), Vec::<String>::new());
    let left = pilot.advance(MS);
    assert_eq!(left, ["Gripper1.suctionOn=false", "Gripper2.suctionOn=false", "Robot.ZTarget=-400"]);
    assert_eq!(arrive(&mut pilot, [-400.0, 0.0, -400.0, turned]), ["Robot.XTarget=0"]);
}

#[test]
fn a_loose_box_does_not_enter_while_the_robot_asks_for_the_place() {
    let standing = [("Conveyor2.lightBarrierA", 1.0), ("Conveyor2.lightBarrierB", 1.0)];
    let (mut pilot, _) = line(&standing);
    let turned = std::f64::consts::FRAC_PI_2;
    arrive(&mut pilot, [-400.0, 0.0, -400.0, turned]);
    arrive(&mut pilot, [-400.0, 0.0, -774.0, turned]);
    pilot.report(&[("Gripper1.vacuumOn", 1.0), ("Gripper2.vacuumOn", 1.0)]);
    assert_eq!(pilot.report(&[("Conveyor3.lightBarrierB", 1.0)]), ["Conveyor3.motorDirection=0"]);
}

#[test]
fn the_robot_waits_above_while_a_loose_box_has_the_place() {
    let standing = [("Conveyor2.lightBarrierA", 1.0), ("Conveyor2.lightBarrierB", 1.0)];
    let (mut pilot, _) = line(&standing);
    // The box at Conveyor3's end goes over without a stop, and the next one waits.
    assert_eq!(pilot.report(&[("Conveyor3.lightBarrierB", 1.0)]), Vec::<String>::new());
    assert_eq!(pilot.report(&[("Conveyor4.lightBarrierA", 1.0)]), ["Conveyor3.motorDirection=0"]);
    let turned = std::f64::consts::FRAC_PI_2;
    arrive(&mut pilot, [-400.0, 0.0, -400.0, turned]);
    arrive(&mut pilot, [-400.0, 0.0, -774.0, turned]);
    pilot.report(&[("Gripper1.vacuumOn", 1.0), ("Gripper2.vacuumOn", 1.0)]);
    arrive(&mut pilot, [-400.0, 0.0, -400.0, turned]);
    assert_eq!(arrive(&mut pilot, [0.0, 1200.0, -400.0, 0.0]), Vec::<String>::new());
    pilot.report(&[("Conveyor4.lightBarrierB", 1.0)]);
    assert_eq!(pilot.report(&[("Conveyor4.lightBarrierB", 0.0)]), ["Robot.ZTarget=-704"]);
}

/// A box passes a conveyor's barrier B; gives what its pusher is told.
fn pass(pilot: &mut Pilot<Network<Line>>, conveyor: usize, pusher: usize) -> Vec<String> {
    let barrier = format!("Conveyor{conveyor}.lightBarrierB");
    let changed = pilot.report(&[(&barrier, 1.0)]);
    pilot.report(&[(&barrier, 0.0)]);
    of(changed, &format!("Pusher{pusher}"))
}

fn stroke(pilot: &mut Pilot<Network<Line>>, pusher: usize) {
    let limit = |end: &str| format!("Pusher{pusher}.limit{end}");
    pilot.report(&[(&limit("Retracted"), 0.0)]);
    assert_eq!(pilot.report(&[(&limit("Extended"), 1.0)]), [format!("Pusher{pusher}.command=2")]);
    pilot.report(&[(&limit("Extended"), 0.0)]);
    assert_eq!(pilot.report(&[(&limit("Retracted"), 1.0)]), [format!("Pusher{pusher}.command=0")]);
}

#[test]
fn each_pusher_takes_its_share() {
    for (conveyor, pusher, one_of) in [(5, 1, 4), (6, 2, 3), (7, 3, 2)] {
        let (mut pilot, _) = line(&[]);
        for number in 0..12 {
            let pushed = pass(&mut pilot, conveyor, pusher);
            if number % one_of == 0 {
                assert_eq!(pushed, [format!("Pusher{pusher}.command=1")], "box {number}");
                stroke(&mut pilot, pusher);
            } else {
                assert_eq!(pushed, Vec::<String>::new(), "box {number}");
            }
        }
    }
}

#[test]
fn a_box_is_not_pushed_where_another_still_lies() {
    let (mut pilot, _) = line(&[("Pusher1.lightbarrierB", 1.0)]);
    assert_eq!(pass(&mut pilot, 5, 1), Vec::<String>::new());
}

#[test]
fn an_exit_turns_round_after_five_boxes_once_it_is_empty() {
    let (mut pilot, _) = line(&[]);
    for number in 1..=5 {
        while pass(&mut pilot, 7, 3).is_empty() {}
        stroke(&mut pilot, 3);
        pilot.report(&[("Conveyor10.lightBarrierB", 1.0)]);
        let left = pilot.report(&[("Conveyor10.lightBarrierB", 0.0)]);
        let expected: &[&str] = if number == 5 { &["Conveyor10.motorDirection=-1"] } else { &[] };
        assert_eq!(left, expected, "box {number}");
    }
    // Ten came by: every second was pushed out, the others left at the end of Conveyor7.
    assert_eq!(pilot.counts().parts_out, 9);
}
