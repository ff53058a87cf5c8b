//! The packaging line: what it is made of, and that it packs as fast as its cycle says, with its automation in lock-step.

mod lockstep;

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Duration;

use kinetwin::engine::Engine;
use kinetwin::scene::Scene;
use lockstep::{Lockstep, plant};

const MODEL: &str = "models/packaging";

/// The program's cycle, pitch and gear.
const CYCLE_S: f64 = 4.0;
const PITCH_M: f64 = 0.6;
const REACH_M: f64 = 0.005;

fn line() -> Lockstep {
    let mut line = Lockstep::new(MODEL, &[]);
    line.join(1);
    line
}

fn engine(line: &Lockstep) -> &Engine {
    &line.simulations[0].engine
}

fn value(line: &Lockstep, name: &str) -> f64 {
    let simulation = &line.simulations[0];
    let register = simulation.plant.signal_map.register(name).expect(name);
    simulation.engine.registers()[register.index()].to_f64().expect("a number")
}

#[test]
fn it_has_the_size_of_the_references() {
    let plant = plant(MODEL);
    let prototypes: BTreeSet<&str> = plant.instances.iter().map(|instance| instance.prototype.as_str()).collect();
    assert_eq!((prototypes.len(), plant.instances.len(), plant.signal_map.signals().len()), (5, 5, 80));
    assert_eq!(plant.adapter.high_frequency, Duration::from_millis(10));
    let triangles = Scene::of(&plant).triangles();
    assert!((180_000..=220_000).contains(&triangles), "{triangles}");
}

#[test]
fn every_signal_stands_in_its_page() {
    let page = std::fs::read_to_string("docs/packaging.md").expect("the page");
    for signal in plant(MODEL).signal_map.signals() {
        let row = page.lines().find(|line| line.starts_with(&format!("| `{}` |", signal.name)));
        assert!(
            row.is_some_and(|row| row.contains(&signal.ty.to_string())),
            "{} has no row with its type",
            signal.name
        );
    }
}

#[test]
fn a_pack_leaves_every_cycle() {
    let mut line = line();
    // The first pack has come through by then.
    line.run_to(32.0);
    let before = engine(&line).counts();
    assert!(before.boxes_out > 0, "{before:?}");
    const CYCLES: u64 = 15;
    line.run_to(32.0 + CYCLES as f64 * CYCLE_S);
    let after = engine(&line).counts();
    // 60 s / 4 s: 15 packs in a minute, each a tray with its product.
    assert_eq!((after.boxes_out - before.boxes_out, after.pallets_out - before.pallets_out), (CYCLES, CYCLES));
    assert_eq!((after.boxes_lost, after.pallets_lost, after.collisions), (0, 0, 0));
}

#[test]
fn nothing_runs_into_anything_while_trays_are_loaded_and_sealed() {
    let mut line = line();
    let simulation = &mut line.simulations[0];
    simulation.engine.show(&simulation.plant, Arc::new(Scene::of(&simulation.plant)));
    simulation.engine.watch();
    let (mut loaded, mut sealed) = (false, false);
    while engine(&line).now().seconds() < 22.0 {
        line.step();
        loaded |= value(&line, "CollaborativeRobot.place") == 4.0;
        sealed |= value(&line, "Sealer.pressPosition") > 0.15 && value(&line, "Sealer.packKind") == 1.0;
    }
    assert!(loaded && sealed, "loaded {loaded}, sealed {sealed}");
    let incidents = line.simulations[0].engine.take_incidents();
    assert_eq!(engine(&line).collisions(), 0, "{incidents:?}");
}

#[test]
fn the_motor_follows_its_profile_and_the_encoder_says_how_far() {
    let mut line = line();
    let (mut fastest, mut counts) = (0.0_f64, BTreeSet::new());
    while engine(&line).now().seconds() < 2.0 {
        line.step();
        fastest = fastest.max(value(&line, "Conveyor.speedActual"));
        counts.insert(value(&line, "Conveyor.encoder") as i64);
    }
    // 0.5 m/s on the belt is 100 rad/s of the motor, and a pitch 120 rad.
    assert!((fastest - 100.0).abs() < 1e-6, "{fastest}");
    let indexed = |line: &Lockstep, indices: f64| {
        let expected = indices * PITCH_M / REACH_M * 4096.0 / TAU;
        let found = value(line, "Conveyor.encoder");
        assert!((found - expected).abs() < 200.0, "{found} counts after {indices} indices instead of {expected}");
    };
    assert!(counts.len() > 150, "the encoder moved {} times", counts.len());
    indexed(&line, 1.0);
    // Its loop through the encoder keeps what is left of one index out of the next.
    line.run_to(2.0 + 20.0 * CYCLE_S);
    indexed(&line, 21.0);
    // The encoder came back to the automation at 100 Hz while the motor turned: 1.7 s an index.
    let heard = line.hub.borrow().heard.iter().filter(|(_, text)| text.contains("Conveyor.encoder")).count();
    assert!((21 * 160..21 * 190).contains(&heard), "{heard} messages with the encoder");
}
