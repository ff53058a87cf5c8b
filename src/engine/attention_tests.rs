//! Sleeping shows nowhere: an engine whose devices may sleep and one whose devices never do go the same way, bit for bit.

use proptest::prelude::*;

use super::bench::{Bench, Driven};
use super::*;
use crate::plant::{EffectPlace, Plant};

const MS: u64 = 4;

/// One of everything about a few belts in a row.
#[derive(Clone, Debug)]
struct Line {
    belts: usize,
    /// Whether each belt has a pusher beside it.
    pushers: Vec<bool>,
    shares: bool,
    interval: f64,
    parts: Vec<(usize, f64)>,
    is_late: bool,
}

fn lines() -> impl Strategy<Value = Line> {
    let pushers = prop::collection::vec(any::<bool>(), 5);
    let parts = prop::collection::vec((0..4_usize, 0.2..1.8_f64), 0..4);
    (2..5_usize, pushers, any::<bool>(), 1.0..9.0_f64, parts, any::<bool>()).prop_map(
        |(belts, pushers, shares, interval, parts, is_late)| Line { belts, pushers, shares, interval, parts, is_late },
    )
}

impl Line {
    fn plant(&self) -> Option<Plant> {
        let transfer = if self.shares { "share" } else { "most" };
        let mut bench = Bench::default();
        for belt in 0..self.belts {
            let x = 2.0 * belt as f64;
            bench = bench.add(
                &format!("Belt{belt}"),
                "StraightConveyor",
                [x, 0.0, 0.8, 0.0],
                &[("length", "2.0"), ("barrierB", "1.6"), ("transfer", transfer)],
            );
            if self.pushers[belt] {
                let quarter = std::f64::consts::FRAC_PI_2;
                bench = bench.add(&format!("Pusher{belt}"), "Pusher", [x + 1.2, -0.45, 0.81, quarter], &[]);
            }
        }
        let interval = self.interval.to_string();
        let last = format!("Belt{}", self.belts - 1);
        bench = bench
            .add("Feed", "LoadingBay", [0.0; 4], &[("belt", "Belt0"), ("at", "0.3"), ("interval", &interval)])
            .add("Sink", "UnloadingBay", [0.0; 4], &[("belt", &last)])
            .add("Robot", "CartesianRobot", [0.5, 0.0, 1.3, 0.0], &[])
            .add("Cups", "SuctionCapGripper", [0.0; 4], &[("robot", "Robot"), ("reach", "0.02")])
            .add("Motor", "EncoderMotor", [0.0; 4], &[])
            .add("Eye", "BoxSensor", [2.5, 0.0, 0.8, 0.0], &[("boxDimensions", "0.2;0.6;0.3")])
            .add("Ray", "ProximitySensor", [3.0, -0.6, 0.85, 1.57], &[("range", "0.5")])
            .add("Drum", "InverterConveyor", [0.0, 4.0, 0.8, 0.0], &[("transfer", transfer)])
            .add("Stack", "Dispenser", [0.0; 4], &[("belt", "Drum"), ("capacity", "3")])
            .add("Arm", "SixAxisRobot", [0.5, 4.5, 0.8, 0.0], &[])
            .add("Hand", "SuctionCapGripper", [0.0; 4], &[("robot", "Arm")])
            .add("Idle", "Pusher", [0.0, 9.0, 0.0, 0.0], &[]);
        for (belt, x) in &self.parts {
            bench = bench.part(&format!("Belt{}", belt % self.belts), *x);
        }
        let mut plant = bench.plant();
        // Two parts of a drawn line may not stand in one another.
        Engine::new(&plant, Duration::from_millis(MS), 1).ok()?;
        if self.is_late {
            let effect = super::effect_tests::spec(EffectPlace::CommandLink, "dead-time", &[("time", 0.1)], "");
            plant.instances.iter_mut().filter(|it| it.name == "Belt1").for_each(|it| it.effects.push(effect.clone()));
        }
        Some(plant)
    }
}

/// What somebody does at a step.
#[derive(Clone, Debug)]
enum Deed {
    Command(usize, f64),
    Insert(usize, f64),
    RemoveOldest,
    Force(bool),
    NoPower(bool),
}

fn deeds() -> impl Strategy<Value = Vec<(u32, Deed)>> {
    let deed = prop_oneof![
        12 => (any::<prop::sample::Index>(), -1.0..1.0_f64).prop_map(|(at, value)| Deed::Command(at.index(1000), value)),
        2 => (0..5_usize, 0.2..1.8_f64).prop_map(|(belt, at)| Deed::Insert(belt, at)),
        1 => Just(Deed::RemoveOldest),
        1 => any::<bool>().prop_map(Deed::Force),
        1 => any::<bool>().prop_map(Deed::NoPower),
    ];
    prop::collection::vec((0..2500_u32, deed), 1..30)
}

fn go(driven: &mut Driven, line: &Line, deed: &Deed, commands: &[(String, f64)]) {
    let belt = |index: usize| format!("Belt{}", index % line.belts);
    match deed {
        Deed::Command(at, value) => {
            let (name, most) = &commands[at % commands.len()];
            let value = if name.ends_with("command") { (value.abs() * 2.9).floor() } else { value * most };
            let is_whole = name.ends_with("motorDirection");
            driven.set(name, if is_whole { value.signum() * (value.abs() * 1.5).floor() } else { value });
        }
        Deed::Insert(index, station) => {
            let insertion = Insertion {
                kind: PartKind::Box,
                size: [0.3, 0.3, 0.2],
                belt: belt(*index),
                station: *station,
                offset: 0.0,
                turn: 0.0,
            };
            // Refused where there is no room: by both or by none, or they differ from then on.
            let _ = driven.engine.operate(&Act::Insert(insertion));
        }
        Deed::RemoveOldest => {
            let oldest = driven.engine.parts().map(|part| part.number).min();
            if let Some(number) = oldest {
                driven.engine.operate(&Act::Remove { number }).expect("it is there");
            }
        }
        Deed::Force(forces) => {
            let signal = driven.register("Belt0.velocityTarget");
            let act = if *forces { Act::Force { signal, value: Value::Real(0.3) } } else { Act::Release { signal } };
            let _ = driven.engine.operate(&act);
        }
        Deed::NoPower(breaks) => {
            let fault = Fault::Dead { instance: "Belt0".to_owned() };
            let _ = driven.engine.operate(&if *breaks { Act::Break(fault) } else { Act::Mend(fault) });
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn sleeping_shows_nowhere(line in lines(), deeds in deeds()) {
        let Some(plant) = line.plant() else { return Ok(()) };
        let commands: Vec<(String, f64)> = plant.signal_map.directed(crate::signal_map::Direction::Command)
            .map(|(_, signal)| (signal.name.clone(), if signal.property == "speedTarget" { 90.0 } else { 1.2 }))
            .collect();
        let mut engines = [Driven::new(&plant, MS * 1000, 1), Driven::new(&plant, MS * 1000, 1)];
        engines[1].engine.keep_awake(true);
        let all = engines[1].engine.awake();
        let mut fewest = all;
        for step in 0..3000 {
            for (_, deed) in deeds.iter().filter(|(at, _)| *at == step) {
                engines.iter_mut().for_each(|driven| go(driven, &line, deed, &commands));
            }
            engines.iter_mut().for_each(Driven::tick);
            let [sleeper, waker] = &mut engines;
            prop_assert_eq!(sleeper.engine.registers(), waker.engine.registers(), "at step {}", step);
            prop_assert_eq!(sleeper.engine.state_hash(), waker.engine.state_hash(), "at step {}", step);
            prop_assert_eq!(sleeper.engine.take_incidents(), waker.engine.take_incidents());
            prop_assert_eq!(waker.engine.awake(), all);
            fewest = fewest.min(sleeper.engine.awake());
        }
        prop_assert!(fewest < all, "nobody ever slept");
    }
}

/// Curves, queues, parts across two belts, pallets with their loads: what the belts of the drawn lines have not.
#[test]
fn what_is_passed_over_shows_nowhere_on_the_line() {
    let plant = crate::plant::load(&crate::plant::embedded::Embedded, "models/depalletizer", crate::device::KINDS);
    let plant = plant.expect("a model of ours");
    let mut engines = [Driven::new(&plant, 10_000, 1), Driven::new(&plant, 10_000, 1)];
    engines[1].engine.keep_awake(true);
    let commands: Vec<String> =
        plant.signal_map.directed(crate::signal_map::Direction::Command).map(|(_, it)| it.name.clone()).collect();
    for driven in &mut engines {
        for name in &commands {
            match name.rsplit('.').next() {
                Some("velocityTarget") => driven.set(name, 0.4),
                Some("motorDirection") => driven.set(name, 1.0),
                _ => {}
            }
        }
    }
    for step in 0..6000 {
        if step % 1500 == 700 {
            let pushes = if step % 3000 == 700 { 1.0 } else { 2.0 };
            engines.iter_mut().for_each(|driven| driven.set("Pusher2.command", pushes));
        }
        engines.iter_mut().for_each(Driven::tick);
        let [quick, thorough] = &mut engines;
        assert_eq!(quick.engine.registers(), thorough.engine.registers(), "at step {step}");
        assert_eq!(quick.engine.state_hash(), thorough.engine.state_hash(), "at step {step}");
        assert_eq!(quick.engine.take_incidents(), thorough.engine.take_incidents());
    }
    let counts = engines[0].engine.counts();
    assert!(counts.boxes_out + counts.boxes_lost > 5, "parts went all along it: {counts:?}");
}

/// Belts in a row, each beside nothing; one pusher.
fn standing(belts: usize) -> Driven {
    let mut bench = Bench::default().add("Pusher", "Pusher", [0.0, 0.0, 1.0, 0.0], &[]);
    for belt in 0..belts {
        bench = bench.add(&format!("Belt{belt}"), "StraightConveyor", [0.0, 2.0 * belt as f64, 0.8, 0.0], &[]);
    }
    bench.engine(1000)
}

#[test]
fn who_stands_still_is_not_visited() {
    let mut driven = standing(50);
    driven.run_to(0.2);
    assert_eq!(driven.engine.awake(), 0);
    driven.set("Pusher.command", 1.0);
    driven.run_to(0.5);
    assert_eq!(driven.engine.awake(), 1);
    assert!(driven.is("Pusher.isRunning"));
    driven.run_to(1.5);
    assert!(driven.is("Pusher.limitExtended"));
    assert_eq!(driven.engine.awake(), 0);
}

#[test]
fn a_part_wakes_the_belts_that_it_comes_to() {
    let mut bench = Bench::default();
    for belt in 0..10 {
        let x = 2.0 * f64::from(belt);
        bench = bench.add(&format!("Belt{belt}"), "StraightConveyor", [x, 0.0, 0.8, 0.0], &[]);
    }
    let mut driven = bench.part("Belt0", 1.0).engine(1000);
    driven.run_to(0.2);
    assert_eq!(driven.engine.awake(), 0);
    for belt in 0..10 {
        driven.set(&format!("Belt{belt}.velocityTarget"), 0.5);
    }
    for belt in [0, 1] {
        driven.set(&format!("Belt{belt}.motorDirection"), 1.0);
    }
    driven.run_to(1.0);
    assert_eq!(driven.engine.awake(), 2, "the belts that move");
    // The part comes to lie in the beam of Belt1's end, is taken over by Belt2, which stands, and stays there.
    driven.wait_for("Belt1.lightBarrierB", true, 9.0);
    driven.run_to(9.0);
    assert_eq!(driven.engine.counts().boxes_present, 1);
    assert!(!driven.is("Belt2.lightBarrierB"));
    assert_eq!(driven.engine.awake(), 2);
}
