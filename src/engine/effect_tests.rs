//! Effects in whole plants: belts, parts, queues, plates, robots and grippers, with real parts.

use super::bench::{Bench, Driven};
use super::*;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};

const HERE: [f64; 4] = [0.0; 4];

/// An `<effect>` with numbers, and with the property `with` where that is not empty.
pub(super) fn spec(place: EffectPlace, kind: &str, numbers: &[(&str, f64)], with: &str) -> EffectSpec {
    let number = |(name, value): &(&str, f64)| ((*name).to_owned(), ParameterValue::Number(*value));
    let mut parameters: std::collections::BTreeMap<_, _> = numbers.iter().map(number).collect();
    if !with.is_empty() {
        parameters.insert("with".to_owned(), ParameterValue::Text(with.to_owned()));
    }
    EffectSpec { place, kind: kind.to_owned(), component: None, parameters }
}

/// The plant's engine, with an effect on `instance`.
fn with(bench: Bench, instance: &str, effect: EffectSpec) -> Driven {
    let mut plant = bench.plant();
    let found = plant.instances.iter_mut().find(|found| found.name == instance);
    found.expect(instance).effects.push(effect);
    Driven::new(&plant, 1000, 1)
}

fn drive(driven: &mut Driven, belts: &[&str], speed: f64) {
    for belt in belts {
        driven.set(&format!("{belt}.velocityTarget"), speed);
        driven.set(&format!("{belt}.motorDirection"), 1.0);
    }
}

/// A belt of 3 m with a barrier at 2 m, and a box that stands at 0.5 m: its front has 1.35 m to go.
fn one_box() -> Bench {
    let belt = [("length", "3"), ("barrierA", "2"), ("barrierB", "-1")];
    Bench::default().add("Belt", "StraightConveyor", HERE, &belt).part("Belt", 0.5)
}

/// When the box of [`one_box`] is seen with this effect on its belt, at 0.5 m/s and 1 m/s².
fn seen_with(kind: &str, numbers: &[(&str, f64)]) -> f64 {
    let place = if kind.starts_with("belt") { EffectPlace::Transmission } else { EffectPlace::Process };
    let mut driven = with(one_box(), "Belt", spec(place, kind, numbers, ""));
    drive(&mut driven, &["Belt"], 0.5);
    driven.wait_for("Belt.lightBarrierA", true, 20.0)
}

#[test]
fn parts_lose_what_belt_and_friction_lose() {
    // Nominally 0.125 m in the ramp's half second and 1.225 m after it; a step until it is seen.
    let check = |kind: &str, numbers: &[(&str, f64)], seconds: f64| {
        let found = seen_with(kind, numbers);
        assert!((found - seconds).abs() < 2e-3, "{kind}: {found} instead of {seconds}");
    };
    check("belt-slip", &[("ratio", 0.0)], 0.5 + 1.225 / 0.5);
    check("belt-slip", &[("ratio", 0.1)], 0.5 + (1.35 / 0.9 - 0.125) / 0.5);
    check("belt-slip-above-acceleration", &[("acceleration", 0.25)], 2.0 + (1.35 - 0.5) / 0.5);
    check("part-slip", &[("acceleration", 0.25)], 2.0 + (1.35 - 0.5) / 0.5);
}

#[test]
fn a_part_on_two_belts_loses_its_share() {
    let two = || {
        Bench::default()
            .add("One", "StraightConveyor", HERE, &[("length", "1"), ("barrierA", "-1"), ("barrierB", "-1")])
            .add(
                "Two",
                "StraightConveyor",
                [1.0, 0.0, 0.0, 0.0],
                &[("length", "2"), ("barrierA", "1"), ("barrierB", "-1")],
            )
            .part("One", 0.5)
    };
    let seen = |ratio: f64| {
        let slip = spec(EffectPlace::Process, "transfer-slip", &[("ratio", ratio)], "");
        let mut driven = with(two(), "One", slip);
        drive(&mut driven, &["One", "Two"], 0.5);
        driven.wait_for("Two.lightBarrierA", true, 20.0)
    };
    // It bridges the two from its front at 1 m until its centre is there: 0.15 m at half the speed take 0.3 s more.
    let late = seen(0.5) - seen(0.0);
    assert!((late - 0.3).abs() < 3e-3, "{late}");
}

#[test]
fn parts_that_queue_press_back_and_parts_that_are_carried_slow_the_drive() {
    // A belt ends before one that stands; one box waits there, the other comes up.
    let queue = || {
        Bench::default()
            .add("One", "StraightConveyor", HERE, &[("length", "3"), ("barrierA", "1.5"), ("barrierB", "-1")])
            .add("Two", "StraightConveyor", [3.0, 0.0, 0.0, 0.0], &[])
            .part("Two", 0.16)
            .part("One", 2.84)
            .part("One", 0.5)
    };
    let seen = |place, kind, numbers: &[(&str, f64)]| {
        let mut driven = with(queue(), "One", spec(place, kind, numbers, ""));
        drive(&mut driven, &["One"], 0.5);
        driven.wait_for("One.lightBarrierA", true, 20.0)
    };
    let nominal = seen(EffectPlace::Process, "back-pressure", &[("coefficient", 0.0)]);
    assert!((nominal - (0.5 + (0.85 - 0.125) / 0.5)).abs() < 2e-3, "{nominal}");
    // The one that waits takes a fifth of the way of the other; the few millimetres until it waits do not count.
    let pressed = seen(EffectPlace::Process, "back-pressure", &[("coefficient", 0.2)]);
    assert!((pressed - (0.5 + (0.85 / 0.8 - 0.125) / 0.5)).abs() < 0.03, "{pressed}");
    // Two parts take a fifth of the drive's speed: 0.4 m/s after 0.4 s and 0.08 m.
    let slowed = seen(EffectPlace::Actuator, "load-dependent-speed", &[("coefficient", 0.1)]);
    assert!((slowed - (0.4 + (0.85 - 0.08) / 0.4)).abs() < 5e-3, "{slowed}");
}

#[test]
fn a_plate_is_slower_with_what_it_pushes() {
    let table = [("length", "2"), ("width", "2")];
    let bench = Bench::default()
        .add("Table", "StraightConveyor", HERE, &table)
        .add("Pusher", "Pusher", [0.2, 0.0, 0.02, 0.0], &[("stroke", "1"), ("plateSize", "0.1;0.4;0.15")])
        .part("Table", 0.85);
    // 0.5 m until it meets the box, then 0.498 m to the switch at 0.4 m/s.
    let slower = spec(EffectPlace::Actuator, "load-dependent-speed", &[("coefficient", 0.2)], "");
    let mut driven = with(bench, "Pusher", slower);
    driven.set("Pusher.command", 1.0);
    let there = driven.wait_for("Pusher.limitExtended", true, 20.0);
    assert!((there - (1.0 + 0.498 / 0.4)).abs() < 3e-3, "{there}");
}

#[test]
fn drives_that_move_together_share_their_supply() {
    let plant = || {
        let bench = Bench::default().add("Pusher", "Pusher", HERE, &[("stroke", "1")]);
        let bench = bench.add("Near", "StraightConveyor", [0.0, 5.0, 0.0, 0.0], &[]);
        bench.add("Far", "StraightConveyor", [0.0, 9.0, 0.0, 0.0], &[])
    };
    let stroke = |whom: &str, belts: &[&str]| {
        let drop = spec(EffectPlace::Actuator, "supply-drop", &[("fraction", 0.2)], whom);
        let mut driven = with(plant(), "Pusher", drop);
        drive(&mut driven, belts, 0.5);
        driven.run_to(1.0);
        driven.set("Pusher.command", 1.0);
        let start = driven.engine.now().seconds();
        driven.wait_for("Pusher.limitExtended", true, 20.0) - start
    };
    let check = |found: f64, share: f64| assert!((found - 0.998 / (0.5 * share)).abs() < 3e-3, "{found} {share}");
    check(stroke("", &[]), 1.0);
    check(stroke("", &["Near"]), 0.8);
    check(stroke("", &["Near", "Far"]), 0.64);
    check(stroke("Near", &["Near", "Far"]), 0.8);
    check(stroke("Near", &["Far"]), 1.0);
}

#[test]
fn a_robot_feels_the_part_that_hangs_from_it() {
    let gantry = || {
        Bench::default()
            .add("From", "StraightConveyor", [-1.0, 0.0, 0.5, 0.0], &[("length", "4")])
            .add("Robot", "CartesianRobot", [0.0, 0.0, 1.5, 0.0], &[])
            .add("Gripper", "SuctionCapGripper", HERE, &[("robot", "Robot"), ("cupOffset", "0;0;-0.1")])
            .part("From", 1.0)
    };
    let moved = |grips: f64| {
        let mass = EffectSpec {
            component: Some("X".to_owned()),
            ..spec(EffectPlace::Load, "carried-mass", &[("mass", 20.0)], "")
        };
        let mut driven = with(gantry(), "Robot", mass);
        driven.set("Robot.ZTarget", -0.695);
        driven.set("Gripper.suctionOn", grips);
        driven.run_to(2.0);
        driven.set("Robot.ZTarget", -0.6);
        driven.run_to(3.0);
        let start = driven.engine.now().seconds();
        driven.set("Robot.XTarget", 2.0);
        driven.run_to(start + 0.4);
        driven.get("Robot.actualPosX")
    };
    let close = |found: f64, exact: f64| assert!((found - exact).abs() < 2e-3, "{found} {exact}");
    close(moved(0.0), 2.0 * 0.08);
    // As much again to move: half the acceleration.
    close(moved(1.0), 0.08);
}

#[test]
fn an_axis_feels_what_hangs_from_the_gripper_that_it_names() {
    let gripper = [("alwaysSealed", "true")];
    let bench = Bench::default().add("Axis", "ServoAxis", HERE, &[("mode", "force"), ("Fv", "0")]).add(
        "Gripper",
        "SuctionCapGripper",
        [5.0, 0.0, 0.0, 0.0],
        &gripper,
    );
    let mass = spec(EffectPlace::Load, "carried-mass", &[("mass", 20.0)], "Gripper");
    let mut driven = with(bench, "Axis", mass);
    driven.set("Gripper.suctionOn", 1.0);
    driven.set("Axis.torqueEnabled", 1.0);
    driven.run_to(1.0);
    driven.set("Axis.forceTarget", 100.0);
    driven.run_to(1.4);
    // 100 N on 40 kg.
    let found = driven.get("Axis.velocity");
    assert!((found - 2.5 * 0.4).abs() < 5e-3, "{found}");
}

#[test]
fn longer_parts_cut_a_beam_for_longer_and_come_when_they_should() {
    let bench = || {
        Bench::default().add("Belt", "StraightConveyor", HERE, &[("length", "2")]).add(
            "Feed",
            "LoadingBay",
            HERE,
            &[("belt", "Belt"), ("interval", "2")],
        )
    };
    let passages = |kind: &str, numbers: &[(&str, f64)]| {
        let mut driven = with(bench(), "Feed", spec(EffectPlace::Process, kind, numbers, ""));
        drive(&mut driven, &["Belt"], 0.5);
        let [mut rises, mut falls] = [vec![], vec![]];
        for _ in 0..2 {
            rises.push(driven.wait_for("Belt.lightBarrierB", true, 20.0));
            falls.push(driven.wait_for("Belt.lightBarrierB", false, 20.0));
        }
        (falls[0] - rises[0], rises[1] - rises[0])
    };
    let check = |found: (f64, f64), cut: f64, apart: f64| {
        assert!((found.0 - cut).abs() < 2e-3 && (found.1 - apart).abs() < 2e-3, "{found:?}");
    };
    check(passages("part-length-error", &[("length", 0.0)]), 0.6, 2.0);
    check(passages("part-length-error", &[("length", 0.05)]), 0.7, 2.0);
    check(passages("part-spacing-error", &[("time", 0.5)]), 0.6, 2.5);
}

#[test]
fn a_part_is_let_go_by_cups_that_leak() {
    let bench = Bench::default()
        .add("Table", "StraightConveyor", [-1.0, 0.0, 0.5, 0.0], &[])
        .add("Robot", "CartesianRobot", [0.0, 0.0, 1.5, 0.0], &[])
        .add("Gripper", "SuctionCapGripper", HERE, &[("robot", "Robot"), ("cupOffset", "0;0;-0.1")])
        .part("Table", 1.0);
    let mut driven = with(bench, "Gripper", spec(EffectPlace::Process, "leak", &[("rate", 0.5)], ""));
    driven.set("Robot.ZTarget", -0.695);
    driven.run_to(1.5);
    driven.set("Gripper.suctionOn", 1.0);
    driven.run_to(2.0);
    driven.set("Robot.ZTarget", -0.3);
    driven.run_to(3.5);
    let height = |driven: &Driven| driven.engine.parts().next().expect("the box").place[2];
    assert!(height(&driven) > 0.85, "{}", height(&driven));
    driven.run_to(3.7);
    assert!((height(&driven) - 0.5).abs() < 1e-9 && !driven.is("Gripper.vacuumOn"), "{}", height(&driven));
}

#[test]
fn a_plant_with_effects_runs_the_same_again_and_otherwise_with_another_seed() {
    let hashes = |seed: u64| {
        let mut plant = one_box().plant();
        plant.instances[0].effects = vec![
            spec(EffectPlace::ReportLink, "sampling-jitter", &[("sigma", 0.005)], ""),
            spec(EffectPlace::Process, "part-slip", &[("acceleration", 0.3)], ""),
            spec(EffectPlace::Transmission, "compliance", &[("stiffness", 500.0), ("damping", 10.0)], ""),
            spec(EffectPlace::Actuator, "load-dependent-speed", &[("coefficient", 0.1)], ""),
        ];
        let mut driven = Driven::new(&plant, 1000, seed);
        drive(&mut driven, &["Belt"], 0.5);
        let hash = |_| {
            driven.tick();
            driven.engine.state_hash()
        };
        (0..2000).map(hash).collect::<Vec<u64>>()
    };
    assert_eq!(hashes(1), hashes(1));
    assert_ne!(hashes(1), hashes(2));
}

#[test]
fn an_effect_that_names_nobody_is_refused() {
    let drop = spec(EffectPlace::Actuator, "supply-drop", &[("fraction", 0.2)], "Belt; Bolt");
    let mut plant = one_box().plant();
    plant.instances[0].effects.push(drop);
    let error = Engine::new(&plant, Duration::from_millis(1), 1).err().expect("an error").to_string();
    assert!(error.contains("with names \"Bolt\", which is no instance of the plant"), "{error}");
}
