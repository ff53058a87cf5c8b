//! The engine with real devices, on plants built by hand.

use std::time::Duration;

use super::bench::{Bench, Driven};
use super::*;
use crate::plant::Plant;

const HERE: [f64; 4] = [0.0; 4];

/// The rig's belt and feed.
fn rig_belt() -> Bench {
    Bench::default()
        .add("Belt", "StraightConveyor", [0.0, 0.0, 0.8, 0.0], &[("length", "2.0"), ("acceleration", "1.0")])
        .add("Feed", "LoadingBay", HERE, &[("belt", "Belt"), ("at", "0.15"), ("firstTime", "1.0"), ("interval", "6.0")])
}

fn drive(driven: &mut Driven, belt: &str, speed: f64) {
    driven.set(&format!("{belt}.velocityTarget"), speed);
    driven.set(&format!("{belt}.motorDirection"), 1.0);
}

#[test]
fn a_step_reports_its_own_instant_before_it_moves() {
    let mut driven = rig_belt().engine(1000);
    drive(&mut driven, "Belt", 0.5);
    driven.tick();
    // The command of t = 0 is followed at once by what follows at once, and by nothing else.
    assert!(driven.is("Belt.driveEnabled"));
    assert_eq!((driven.get("Belt.velocityActual"), driven.is("Belt.driveRunning")), (0.0, false));
    driven.tick();
    assert_eq!(driven.get("Belt.velocityActual"), f64::from(1e-3_f32));
    assert_eq!(driven.engine.now(), Instant::from_seconds(0.002));
}

#[test]
fn commands_are_registers_too() {
    let mut driven = rig_belt().engine(1000);
    drive(&mut driven, "Belt", 0.5);
    driven.tick();
    assert_eq!((driven.get("Belt.velocityTarget"), driven.get("Belt.motorDirection")), (0.5, 1.0));
}

#[test]
fn the_rigs_box_cuts_its_barriers_when_it_should() {
    let mut driven = rig_belt().engine(1000);
    drive(&mut driven, "Belt", 0.5);
    // At rest at 0.15 m at t = 1 s, front exactly in A: it takes the belt's speed at once and cuts A from then on.
    assert_eq!(driven.wait_for("Belt.lightBarrierA", true, 9.0), 1.001);
    assert_eq!(driven.wait_for("Belt.lightBarrierA", false, 9.0), 1.6);
    assert_eq!(driven.wait_for("Belt.lightBarrierB", true, 9.0), 3.801);
    assert_eq!(driven.wait_for("Belt.lightBarrierB", false, 9.0), 4.4);
    driven.run_to(4.69);
    assert_eq!(driven.engine.counts().boxes_present, 1);
    driven.run_to(4.71);
    assert_eq!((driven.engine.counts().boxes_out, driven.engine.counts().boxes_present), (1, 0));
    assert_eq!(driven.wait_for("Belt.lightBarrierA", true, 9.0), 7.001);
}

#[test]
fn the_step_is_no_part_of_what_happens() {
    let edges = |step_us: u64, first: &str| {
        let bench = Bench::default()
            .add("Belt", "StraightConveyor", HERE, &[("length", "2.0"), ("acceleration", "1.0")])
            .add("Feed", "LoadingBay", HERE, &[("belt", "Belt"), ("firstTime", first), ("interval", "60")]);
        let mut driven = bench.engine(step_us);
        drive(&mut driven, "Belt", 0.5);
        (driven.wait_for("Belt.lightBarrierB", true, 9.0), driven.wait_for("Belt.lightBarrierB", false, 9.0))
    };
    for first in ["1.0", "1.00371"] {
        let (rise, fall) = edges(100, first);
        for step_us in [1000, 5000, 20_000] {
            let (rose, fell) = edges(step_us, first);
            let step = step_us as f64 / 1e6;
            assert!(rose >= rise - 2e-4 && rose <= rise + step, "step {step_us} us: rose at {rose}, not {rise}");
            assert!(fell >= fall - 2e-4 && fell <= fall + step, "step {step_us} us: fell at {fell}, not {fall}");
        }
    }
}

#[test]
fn a_pusher_moves_a_box_to_the_next_belt() {
    let mut driven = Bench::default()
        .add("Main", "StraightConveyor", HERE, &[("length", "3.0")])
        .add("Exit", "StraightConveyor", [0.0, 0.65, 0.0, 0.0], &[("length", "3.0")])
        .add(
            "Pusher",
            "Pusher",
            [1.5, -0.35, 0.02, std::f64::consts::FRAC_PI_2],
            &[
                ("stroke", "0.75"),
                ("extendSpeed", "2.0"),
                ("plateSize", "0.8;0.4;0.15"),
                ("barrierA", "0.35"),
                ("barrierB", "1.0"),
            ],
        )
        .part("Main", 0.5)
        .engine(1000);
    drive(&mut driven, "Main", 0.6);
    drive(&mut driven, "Exit", 0.6);
    driven.wait_for("Pusher.lightbarrierA", true, 5.0);
    driven.run_to(driven.engine.now().seconds() + 0.3);
    driven.set("Pusher.command", 1.0);
    driven.wait_for("Pusher.lightbarrierB", true, 5.0);
    driven.wait_for("Pusher.limitExtended", true, 5.0);
    driven.set("Pusher.command", 2.0);
    driven.wait_for("Pusher.limitRetracted", true, 5.0);
    let part = driven.engine.parts().next().expect("the box");
    assert!((part.place[1] - 0.55).abs() < 1e-3, "{part:?}");
    driven.run_to(9.0);
    let counts = driven.engine.counts();
    assert_eq!((counts.boxes_out, counts.boxes_lost, counts.collisions), (1, 0, 0));
}

/// A robot over two belts with two grippers, and a box under the first of them.
fn gantry() -> Bench {
    let robot = [("maxVelocityY", "2.0"), ("maxAccelerationY", "4.0")];
    Bench::default()
        .add("From", "StraightConveyor", [-1.0, 0.0, 0.5, 0.0], &[])
        .add("To", "StraightConveyor", [-1.0, 1.2, 0.5, 0.0], &[])
        .add("Robot", "CartesianRobot", [0.0, 0.0, 1.5, 0.0], &robot)
        .add("Gripper1", "SuctionCapGripper", HERE, &[("robot", "Robot"), ("cupOffset", "0;0;-0.1")])
        .add("Gripper2", "SuctionCapGripper", HERE, &[("robot", "Robot"), ("cupOffset", "0.5;0;-0.1")])
        .part("From", 1.0)
}

/// Lets the robot lower its cups to the box, by whatever closes them: sets `suction` to 1, and 0 over the other belt.
fn pick_and_place(suction: &str) -> Driven {
    let mut driven = gantry().engine(1000);
    driven.set("Robot.ZTarget", -0.695);
    driven.set(suction, 1.0);
    driven.run_to(2.0);
    assert_eq!((driven.is("Gripper1.vacuumOn"), driven.is("Gripper2.vacuumOn")), (true, false));
    driven.set("Robot.ZTarget", -0.3);
    driven.set("Robot.RTarget", 1.0);
    driven.run_to(3.0);
    driven.set("Robot.YTarget", 1.2);
    driven.run_to(5.0);
    driven.set("Robot.ZTarget", -0.69);
    driven.run_to(6.0);
    driven.set(suction, 0.0);
    driven.run_to(6.079);
    assert!(driven.is("Gripper1.vacuumOn"));
    driven.run_to(6.081);
    assert!(!driven.is("Gripper1.vacuumOn"));
    driven
}

#[test]
fn a_robot_carries_a_box_over() {
    let driven = pick_and_place("Gripper1.suctionOn");
    let part = driven.engine.parts().next().expect("the box");
    let found = part.place.iter().chain([&part.yaw]);
    let close = found.zip([0.0, 1.2, 0.5, 1.0]).all(|(found, expected)| (found - expected).abs() < 1e-3);
    assert!(close, "{part:?}");
    assert_eq!(driven.engine.counts().collisions, 0);
}

#[test]
fn the_robots_grip_closes_what_is_mounted_on_it() {
    let driven = pick_and_place("Robot.grip");
    let part = driven.engine.parts().next().expect("the box");
    assert!((part.place[1] - 1.2).abs() < 1e-3, "{part:?}");
}

fn random() -> Plant {
    let feed = [("belt", "Belt"), ("firstTime", "0"), ("interval", "1"), ("spread", "0.9")];
    Bench::default().add("Belt", "StraightConveyor", HERE, &[]).add("Feed", "LoadingBay", HERE, &feed).plant()
}

#[test]
fn the_same_run_has_the_same_hash_at_every_step_and_the_seed_counts() {
    let hashes = |seed: u64| {
        let mut driven = Driven::new(&random(), 1000, seed);
        drive(&mut driven, "Belt", 0.4);
        let hashes: Vec<u64> = (0..3000)
            .map(|_| {
                driven.tick();
                driven.engine.state_hash()
            })
            .collect();
        hashes
    };
    let first = hashes(7);
    assert_eq!(first, hashes(7));
    assert_ne!(first.last(), hashes(8).last());
    let distinct: std::collections::BTreeSet<u64> = first.iter().copied().collect();
    assert_eq!(distinct.len(), first.len(), "each step has a state of its own");
}

#[test]
fn what_is_due_at_the_start_stands_there_at_the_start() {
    let feed = [("belt", "Belt"), ("at", "0.3"), ("firstTime", "0")];
    let plant =
        Bench::default().add("Belt", "StraightConveyor", HERE, &[]).add("Feed", "LoadingBay", HERE, &feed).plant();
    let mut driven = Driven::new(&plant, 1000, 1);
    assert_eq!(driven.engine.counts().boxes_present, 1);
    assert!(driven.is("Belt.lightBarrierA"), "seen before the first step");
    driven.tick();
    assert!(driven.is("Belt.lightBarrierA"));
}

fn check_error(bench: Bench, change: impl Fn(&mut Plant), expect: &str) {
    let mut plant = bench.plant();
    change(&mut plant);
    match Engine::new(&plant, Duration::from_millis(1), 1) {
        Ok(_) => panic!("built, though {expect}"),
        Err(error) => assert!(error.to_string().contains(expect), "{error}"),
    }
}

#[test]
fn what_cannot_be_built_is_said() {
    let belt = || Bench::default().add("Belt", "StraightConveyor", HERE, &[]);
    let nothing = |_: &mut Plant| {};
    check_error(belt(), |plant| plant.instances[0].pose.rx = 0.1, "Belt is tilted");
    check_error(
        belt().add("F", "LoadingBay", HERE, &[("belt", "Bolt")]),
        nothing,
        "F: its property \"belt\" names \"Bolt\"",
    );
    check_error(belt().add("G", "SuctionCapGripper", HERE, &[("robot", "Belt")]), nothing, "expected a CartesianRobot");
    check_error(
        belt().part("Bolt", 1.0),
        nothing,
        "part 1 of the plant (counted from 1), a box at x 1, y 0, z 0 of Bolt, stands on \"Bolt\"",
    );
    check_error(belt().part("Belt", 3.0), nothing, "stands on nothing");
    check_error(belt().part("Belt", 1.0).part("Belt", 1.2), nothing, "part 2 of the plant");
    let plant = belt().plant();
    assert!(Engine::new(&plant, Duration::ZERO, 1).is_err());
}
