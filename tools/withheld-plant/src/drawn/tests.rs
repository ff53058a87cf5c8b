//! Drawn plants: what their files say is what they are.

use super::*;
use crate::catalogue::ENTRIES;
use crate::rig;

fn drawn(seed: u64) -> Drawn {
    Drawn::draw(&[], &mut Dice::new(seed, 7))
}

/// What a device reads `seconds` after it was given these commands (port, value), having rested for a tenth of a second.
fn after(unit: &Unit, commands: &[(&str, f64)], seconds: f64) -> Vec<f64> {
    let mut device = unit.device(&[], 1);
    let mut now = 0.1;
    device.advance(now, now, 0);
    commands.iter().for_each(|(port, value)| device.command(now, port, *value));
    let steps = (seconds * 1e4).ceil();
    for _ in 0..steps as usize {
        now += seconds / steps;
        device.advance(now, seconds / steps, 0);
    }
    let mut values = Vec::new();
    device.read(now, &mut values);
    values
}

#[test]
fn a_plant_has_as_many_devices_as_it_may_and_names_none_twice() {
    for seed in 0..60 {
        let plant = drawn(seed);
        assert!((FEWEST..=MOST).contains(&plant.units.len()));
        let feeds = plant.units.iter().filter_map(|unit| match &unit.figures {
            Figures::Belt { feed, .. } => Some(feed),
            _ => None,
        });
        let mut names: Vec<&String> = plant.units.iter().map(|unit| &unit.name).chain(feeds).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count, "seed {seed}");
    }
    let plants: Vec<String> = (0..20).map(|seed| drawn(seed).xml(0.01)).collect();
    assert!(plants.windows(2).all(|two| two[0] != two[1]));
}

#[test]
fn devices_read_as_many_values_as_there_are_signals_and_take_every_command() {
    for seed in 0..5 {
        let mut plant = drawn(seed).plant(&[], 1);
        let mut values = Vec::new();
        plant.devices.iter().for_each(|(_, device)| device.read(0.0, &mut values));
        assert_eq!(values.len(), plant.signals.len(), "seed {seed}");
        let commands: Vec<(String, Kind)> = plant.commands.clone();
        let program = drawn(seed).program(Part::Train, &[], 1, &mut Dice::new(seed, 2));
        for (name, _) in &commands {
            assert!(program.iter().any(|command| command.signal == *name), "seed {seed}: nothing tells {name}");
        }
        assert!(program.iter().all(|command| commands.iter().any(|(name, _)| *name == command.signal)));
        // Under its program everything that it reports changes, but for a pusher's barriers, which it has not.
        let samples: Vec<f64> = (0..540).map(|k| 0.1 * f64::from(k)).collect();
        let streams = plant.run(&program, &samples, &vec![false; plant.signals.len()], 54.0);
        for (stream, signal) in streams.iter().zip(&plant.signals) {
            let is_still = stream.points().iter().all(|(_, value)| *value == stream.points()[0].1);
            assert_eq!(is_still, signal.name.contains(".lightbarrier"), "seed {seed}: {}", signal.name);
        }
    }
}

#[test]
fn devices_keep_to_the_figures_drawn_for_them() {
    let units = (0..30).flat_map(|seed| drawn(seed).units);
    let mut seen = std::collections::BTreeSet::new();
    for unit in units {
        seen.insert(unit.figures.kind());
        match &unit.figures {
            Figures::Belt { parameters, top, .. } => {
                // Half way up the ramp it runs at half its speed.
                let time = 0.5 * top / parameters.acceleration;
                let values = after(&unit, &[("velocityTarget", *top), ("motorDirection", 1.0)], time);
                assert!(
                    (values[0] - parameters.acceleration * time).abs() < 2e-4 * parameters.acceleration,
                    "{unit:?}"
                );
            }
            Figures::Pusher(pusher) => {
                let time = (pusher.stroke - pusher.limit_tolerance) / pusher.extend_speed;
                let flags = [time - 3e-4, time + 3e-4].map(|at| after(&unit, &[("command", 1.0)], at)[0]);
                assert_eq!(flags, [0.0, 1.0], "{unit:?}");
            }
            Figures::Robot { parameters, reach } => {
                // Farther than it ever goes it has its speed, after its ramp.
                let ramp = parameters.fastest[1] / parameters.steepest[1];
                let way = 0.5 * ramp * parameters.fastest[1] + 0.2 * parameters.fastest[1];
                let values = after(&unit, &[("YTarget", 10.0 * reach[1])], ramp + 0.2);
                assert!((values[2] - way).abs() < 1e-3 * way, "{unit:?} {values:?}");
            }
            Figures::Gripper(gripper) => {
                let flags = [gripper.build_up - 3e-4, gripper.build_up + 3e-4];
                let flags = flags.map(|at| after(&unit, &[("suctionOn", 1.0)], at)[0]);
                assert_eq!(flags, [0.0, 1.0], "{unit:?}");
            }
            Figures::Servo { parameters, .. } => {
                // M·x'' + (Kv + Fv)·x' + Kp·Kv·(x − target) = 0 comes to rest at its target, and a tenth of a millisecond after a
                // step it exerts Kp·Kv·step, less what its first motion takes.
                let [stiffness, step] = [parameters.position_gain * parameters.velocity_gain, 1e-4];
                let values = after(&unit, &[("positionTarget", step)], 1e-4);
                assert!((values[2] / (stiffness * step) - 1.0).abs() < 0.02, "{unit:?} {values:?}");
                let values = after(&unit, &[("positionTarget", step)], 4.0);
                assert!((values[0] - step).abs() < 1e-3 * step, "{unit:?} {values:?}");
            }
            Figures::Motor { parameters, top } => {
                let time = top / parameters.acceleration;
                let values = after(&unit, &[("speedTarget", *top), ("enable", 1.0)], time);
                let counts = 0.5 * top * time / std::f64::consts::TAU * parameters.counts;
                assert!((values[0] - counts.floor()).abs() <= 2.0, "{unit:?} {values:?} {counts}");
            }
        }
    }
    assert_eq!(seen.len(), KINDS.len());
}

#[test]
fn every_effect_of_the_catalogue_is_put_on_a_device_that_is_there() {
    for (at, entry) in ENTRIES.iter().enumerate() {
        for spot in entry.spots {
            let plant = Drawn::draw(&[spot.0], &mut Dice::new(at as u64, 7));
            assert!(plant.has(spot.0), "{} at {}", entry.effect, spot.0);
            let quirk = plant.fitted(entry.quirk(*spot, 0.5, &mut Dice::new(at as u64, 3)));
            let is_feed = |unit: &Unit| matches!(&unit.figures, Figures::Belt { feed, .. } if *feed == quirk.device);
            let is_there = |unit: &&Unit| unit.name == quirk.device && spot.0 != "Feed" || is_feed(unit);
            let unit = plant.units.iter().find(is_there).unwrap_or_else(|| panic!("{quirk:?} is nowhere"));
            assert_eq!(plant.kind(&quirk.device), spot.0);
            assert_eq!(unit.figures.kind(), if spot.0 == "Feed" { "Belt" } else { spot.0 });
            assert!(quirk.parameters.iter().all(|(_, value)| value.is_finite()), "{quirk:?}");
        }
    }
}

#[test]
fn what_is_much_for_the_rig_becomes_as_much_for_a_larger_device() {
    let mut figures = sizes::of_rig("Belt").expect("a belt");
    let entry = |effect: &str| ENTRIES.iter().find(|entry| entry.effect == effect).expect("an entry");
    let quirk = |effect: &str, spot| entry(effect).quirk(spot, 0.5, &mut Dice::new(1, 3));
    let limit = quirk("velocity-limit", ("Belt", "", 0.55));
    assert_eq!(sizes::fitted(limit.clone(), &figures), limit, "the rig's own is the rig's");
    if let Figures::Belt { top, .. } = &mut figures {
        *top = 1.2;
    }
    let twice = sizes::fitted(limit.clone(), &figures);
    assert!((twice.value("limit") / limit.value("limit") - 2.0).abs() < 1e-12);
    let mut axis = sizes::of_rig("Axis").expect("an axis");
    if let Figures::Servo { parameters, .. } = &mut axis {
        parameters.position_gain = 50.0;
    }
    let wrong = sizes::fitted(quirk("parameter-error", ("Axis", "positionGain", 25.0)), &axis);
    // Wrong by a fifth of what it should be: 40 or 60.
    assert!((wrong.value("value") - 40.0).abs() < 1e-9 || (wrong.value("value") - 60.0).abs() < 1e-9, "{wrong:?}");
}

#[test]
fn a_file_holds_every_figure_and_a_built_plant_keeps_to_its_tolerance() {
    let (designed, xml) = (drawn(3), drawn(3).xml(0.01));
    assert!(xml.contains("tolerance=\"1 %\""), "{xml}");
    for unit in &designed.units {
        assert!(xml.contains(&format!("<instance name=\"{}\"", unit.name)));
        if let Figures::Belt { parameters, .. } = &unit.figures {
            assert!(xml.contains(&format!("name=\"acceleration\" value=\"{} m/s2\"", parameters.acceleration)));
        }
    }
    let mut built = designed.built(0.01, &mut Dice::new(4, 2));
    for (unit, built) in designed.units.clone().iter_mut().zip(&mut built.units) {
        let both = unit.figures.measures().into_iter().zip(built.figures.measures());
        for (nominal, built) in both {
            assert!((*built / *nominal - 1.0).abs() <= 0.01 && built != nominal);
        }
    }
    // The rig's kinds are all that there are.
    assert_eq!(rig::commands().len(), KINDS.iter().map(|kind| ports(kind)).sum::<usize>());
}

fn ports(kind: &str) -> usize {
    let figures = sizes::of_rig(kind).expect("one of the rig's");
    Unit { name: kind.to_owned(), figures }.commands().len()
}

/// Plants with their files and signals as they were drawn, which `tests/drawn_plants.rs` of the library loads.
const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/drawn-plants");
const KEPT_SEEDS: [u64; 4] = [1, 2, 3, 4];

/// What is kept of the plant of a seed: its file, and its signals with their types and directions.
fn kept(seed: u64) -> [(String, String); 2] {
    let plant = drawn(seed).plant(&[], 1);
    let ty = |kind: Kind| match kind {
        Kind::Flag => "BOOL",
        Kind::Code | Kind::Count => "DINT",
        Kind::Level => "REAL",
    };
    let commands = plant.commands.iter().map(|(name, kind)| format!("command {name} {}\n", ty(*kind)));
    let reports = plant.signals.iter().map(|signal| format!("report {} {}\n", signal.name, ty(signal.kind)));
    let signals: String = commands.chain(reports).collect();
    let path = |end: &str| format!("{KEPT}/plant-{seed}.{end}");
    [(path("xml"), drawn(seed).xml(0.01)), (path("signals"), signals)]
}

#[test]
fn plants_are_drawn_as_those_that_the_library_is_tried_with() {
    let mut kinds = std::collections::BTreeSet::new();
    for seed in KEPT_SEEDS {
        kinds.extend(drawn(seed).units.iter().map(|unit| unit.figures.kind()));
        for (path, drawn) in kept(seed) {
            if std::env::var_os("KINETWIN_BLESS").is_some() {
                std::fs::write(&path, &drawn).unwrap_or_else(|error| panic!("{path}: {error}"));
            }
            let found = std::fs::read_to_string(&path).unwrap_or_default();
            assert_eq!(found, drawn, "{path}: KINETWIN_BLESS=1 writes it anew");
        }
    }
    assert_eq!(kinds.len(), KINDS.len(), "the kept plants lack a kind");
}
