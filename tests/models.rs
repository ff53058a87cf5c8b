//! The models that we ship: every one of them is a plant, with the signals that it promises.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{Parameter, ParameterValue, Plant, load};
use kinetwin::prototype::source::{Layered, Memory};
use kinetwin::signal_map::Direction;
use kinetwin::signal_map::xml::{differences, read, write};
use kinetwin::value::Value;

/// Every plant below `models/`, as `kinetwin` takes it.
const MODELS: &[&str] = &[
    "models/curve",
    "models/depalletizer",
    "models/packaging",
    "models/r001",
    "models/rig",
    "models/rig-toleranced",
    "models/servo-arm",
    "models/servo-pendulum",
    "models/servo-pendulum/kp100.xml",
    "models/servo-pendulum/kp200.xml",
    "models/servo-pendulum/kp400.xml",
    "models/servo-pendulum/kp800.xml",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[track_caller]
fn plant(model: &str) -> Plant {
    load(&Embedded, model, KINDS).unwrap_or_else(|error| panic!("{model}:\n{error}"))
}

fn files_of_models(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files_of_models(&path));
        } else if path.extension().is_some_and(|extension| extension == "xml" || extension == "js") {
            found.push(path);
        }
    }
    found
}

#[test]
fn no_model_is_forgotten_in_the_program() {
    let relative = |path: &PathBuf| path.strip_prefix(root()).expect("below the root").to_string_lossy().into_owned();
    let mut found: Vec<String> = files_of_models(&root().join("models")).iter().map(relative).collect();
    found.sort();
    assert_eq!(Embedded::paths().collect::<Vec<_>>(), found, "src/plant/embedded.rs lists what stands below models/");
}

#[test]
fn every_signals_map_is_what_its_plant_gives() {
    for model in MODELS {
        let plant = plant(model);
        let file = plant.adapter.signals_map.as_deref().unwrap_or_else(|| panic!("{model} names no signals map"));
        assert_eq!(file, format!("signals-maps/{}.xml", plant.name), "{model}");
        let text = fs::read_to_string(root().join(file)).unwrap_or_default();
        let found = read(file, &text).unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(differences(&plant.signal_map, &found), [""; 0], "{file}");
        assert_eq!(text, write(&plant.signal_map), "`kinetwin signals-map {model} -o {file}` writes it anew");
    }
}

#[test]
fn every_model_runs() {
    for model in MODELS {
        let plant = plant(model);
        let mut engine =
            Engine::new(&plant, Duration::from_millis(1), 0).unwrap_or_else(|error| panic!("{model}: {error}"));
        assert_eq!(engine.tick(&[]).len(), plant.signal_map.signals().len(), "{model}");
    }
}

#[test]
fn the_boxes_of_the_curve_come_round_it() {
    let plant = plant("models/curve");
    let mut engine = Engine::new(&plant, Duration::from_millis(1), 0).expect("an engine");
    let register = |name: &str| plant.signal_map.register(name).expect(name);
    let mut commands = Vec::new();
    for belt in ["Entry", "Curve", "Exit"] {
        commands.push((register(&format!("{belt}.velocityTarget")), Value::Real(0.5)));
        commands.push((register(&format!("{belt}.motorDirection")), Value::Dint(1)));
    }
    engine.tick(&commands);
    for _ in 0..20_000 {
        engine.tick(&[]);
    }
    let counts = engine.counts();
    assert_eq!((counts.boxes_in, counts.boxes_out, counts.boxes_lost, counts.collisions), (2, 2, 0, 0));
}

/// The rig's signals as its recordings have them: what the automation sets, then what the plant reports.
const RIG_COMMANDS: &[&str] = &[
    "Belt.velocityTarget",
    "Belt.motorDirection",
    "Pusher.command",
    "Robot.XTarget",
    "Robot.YTarget",
    "Robot.ZTarget",
    "Robot.RTarget",
    "Robot.grip",
    "Gripper.suctionOn",
    "Gripper.blowOn",
    "Axis.positionTarget",
    "Motor.speedTarget",
    "Motor.enable",
];
const RIG_REPORTS: &[&str] = &[
    "Belt.velocityActual",
    "Belt.driveEnabled",
    "Belt.driveRunning",
    "Belt.directionalActual",
    "Belt.lightBarrierA",
    "Belt.lightBarrierB",
    "Pusher.limitExtended",
    "Pusher.limitRetracted",
    "Pusher.isRunning",
    "Pusher.lightbarrierA",
    "Pusher.lightbarrierB",
    "Robot.actualPosX",
    "Robot.actualPosY",
    "Robot.actualPosZ",
    "Robot.actualPosR",
    "Robot.cartesianArrived",
    "Gripper.vacuumOn",
    "Axis.position",
    "Axis.velocity",
    "Axis.force",
    "Motor.encoder",
    "Motor.speedActual",
    "Motor.inverterReady",
];

fn names(plant: &Plant, direction: Direction) -> BTreeSet<&str> {
    plant.signal_map.directed(direction).map(|(_, signal)| signal.name.as_str()).collect()
}

#[track_caller]
fn parameter<'a>(plant: &'a Plant, instance: &str, name: &str) -> &'a Parameter {
    let found = plant.instances.iter().find(|found| found.name == instance).expect(instance);
    found.tasks.iter().find_map(|task| task.parameters.0.get(name)).unwrap_or_else(|| panic!("{instance}.{name}"))
}

#[test]
fn the_rig_has_the_signals_of_its_recordings() {
    for model in ["models/rig", "models/rig-toleranced", "rig"] {
        let plant = plant(model);
        assert_eq!(names(&plant, Direction::Command), RIG_COMMANDS.iter().copied().collect(), "{model}");
        assert_eq!(names(&plant, Direction::Report), RIG_REPORTS.iter().copied().collect(), "{model}");
        assert_eq!(plant.signal_map.signals().len(), 36);
    }
}

#[test]
fn the_rig_is_exact_and_its_sister_within_one_per_cent() {
    let check = |model: &str, tolerance: f64| {
        let plant = plant(model);
        let tasks = plant.instances.iter().flat_map(|instance| &instance.tasks);
        for (name, parameter) in tasks.flat_map(|task| &task.parameters.0) {
            assert_eq!(parameter.tolerance, tolerance, "{model}: {name}");
        }
    };
    check("models/rig", 0.0);
    check("models/rig-toleranced", 0.01);
}

#[test]
fn the_rigs_parameters_are_those_of_its_table() {
    let plant = plant("models/rig");
    let check = |instance: &str, name: &str, expect: f64| {
        let value = &parameter(&plant, instance, name).value;
        assert_eq!(*value, ParameterValue::Number(expect), "{instance}.{name}");
    };
    check("Belt", "length", 2.0);
    check("Belt", "acceleration", 1.0);
    check("Belt", "deceleration", 0.0);
    check("Belt", "barrierA", 0.3);
    check("Belt", "barrierB", 1.7);
    check("Feed", "at", 0.15);
    check("Feed", "firstTime", 1.0);
    check("Feed", "interval", 6.0);
    check("Feed", "spread", 0.0);
    check("Pusher", "stroke", 0.5);
    check("Pusher", "extendSpeed", 0.5);
    check("Pusher", "retractSpeed", 0.5);
    check("Pusher", "limitTolerance", 0.002);
    check("Robot", "maxVelocityX", 1.0);
    check("Robot", "maxAccelerationZ", 2.0);
    check("Robot", "maxVelocityR", 2.0);
    check("Robot", "maxAccelerationR", 8.0);
    check("Robot", "arrivedTolerance", 0.0005);
    check("Robot", "arrivedToleranceR", 0.0005);
    check("Gripper", "buildUpTime", 0.15);
    check("Gripper", "releaseTime", 0.08);
    check("Axis", "M", 20.0);
    check("Axis", "Fv", 50.0);
    check("Axis", "positionGain", 25.0);
    check("Axis", "velocityGain", 800.0);
    check("Axis", "forceLimit", 500.0);
    check("Axis", "load", 0.0);
    check("Motor", "acceleration", 20.0);
    assert_eq!(parameter(&plant, "Feed", "size").value, ParameterValue::Numbers(vec![0.3, 0.2, 0.2]));
    assert_eq!(parameter(&plant, "Feed", "belt").value, ParameterValue::Text("Belt".to_owned()));
    assert_eq!(parameter(&plant, "Gripper", "alwaysSealed").value, ParameterValue::Boolean(true));
    assert_eq!(parameter(&plant, "Motor", "countsPerRevolution").value, ParameterValue::Integer(4096));
}

#[test]
fn the_line_has_the_instances_and_signals_of_the_reference() {
    let plant = plant("models/depalletizer");
    let count = |prototype: &str| plant.instances.iter().filter(|instance| instance.prototype == prototype).count();
    let check = |prototype: &str, expect: usize| assert_eq!(count(prototype), expect, "{prototype}");
    check("StraightConveyor", 10);
    check("ConveyorCurve", 2);
    check("Pusher", 3);
    check("CartesianRobot", 1);
    check("SuctionCapGripper", 2);
    check("LoadingBay", 12);
    check("UnloadingBay", 8);
    assert_eq!((plant.instances.len(), plant.signal_map.signals().len()), (38, 130));
    let names: BTreeSet<&str> = plant.instances.iter().map(|instance| instance.name.as_str()).collect();
    for (name, last) in
        [("Conveyor", 10), ("Curve", 2), ("Pusher", 3), ("Gripper", 2), ("LoadingBay", 12), ("UnloadingBay", 8)]
    {
        for number in 1..=last {
            assert!(names.contains(format!("{name}{number}").as_str()), "{name}{number}");
        }
    }
}

#[test]
fn an_axis_has_the_signals_of_its_mode_in_the_units_of_its_motion() {
    let check = |model: &str, instance: &str, expect: &[(&str, &str)]| {
        let plant = plant(model);
        let signals = plant.signal_map.signals().iter().filter(|signal| signal.instance == instance);
        let found: Vec<(&str, &str)> = signals.map(|signal| (signal.property.as_str(), signal.unit.symbol)).collect();
        assert_eq!(found, expect, "{model}");
    };
    let linear = [("positionTarget", "m"), ("position", "m"), ("velocity", "m/s"), ("force", "N")];
    check("models/rig", "Axis", &linear);
    let ideal = [("positionTarget", "rad"), ("position", "rad"), ("velocity", "rad/s"), ("force", "N.m")];
    check("models/servo-arm", "Rotation", &ideal);
    check("models/servo-arm", "Pitch", &ideal);
    let mut with_torque = ideal.to_vec();
    with_torque.insert(1, ("torqueEnabled", "1"));
    check("models/servo-pendulum/kp400.xml", "Servo", &with_torque);
}

#[test]
fn the_pendulums_gains_rise_with_the_servos() {
    for kp in [100, 200, 400, 800] {
        let plant = plant(&format!("models/servo-pendulum/kp{kp}.xml"));
        let gain = parameter(&plant, "Servo", "velocityGain");
        assert_eq!(gain.value, ParameterValue::Number(f64::from(kp) * 2.0 / 1000.0));
        assert_eq!((gain.tolerance, parameter(&plant, "Servo", "pendulumMass").tolerance), (0.5, 0.01));
    }
}

/// What the catalogue holds for plants that are not ours.
const FOR_OTHER_PLANTS: [&str; 6] =
    ["BoxSensor", "Dispenser", "InverterConveyor", "ProximitySensor", "SixAxisRobot", "VisionSensor"];

#[test]
fn every_prototype_is_used_by_a_model_and_has_a_uuid_of_its_own() {
    let plants: Vec<Plant> = MODELS.iter().map(|model| plant(model)).collect();
    // What only one plant has stands beside it.
    let own: BTreeSet<&str> =
        Embedded::paths().filter_map(|path| path.split_once("/prototypes/")?.1.split('/').next()).collect();
    let names = plants.iter().flat_map(|plant| &plant.instances).map(|instance| instance.prototype.as_str());
    let used: BTreeSet<&str> = names.filter(|name| !own.contains(name)).collect();
    let shipped: BTreeSet<&str> =
        Embedded::paths().filter_map(|path| path.strip_prefix("models/catalogue/")?.split('/').next()).collect();
    let unused: BTreeSet<&str> = shipped.difference(&used).copied().collect();
    assert_eq!(unused, FOR_OTHER_PLANTS.into());
    assert!(used.is_subset(&shipped));
    assert_eq!(shipped.len(), KINDS.len());
    // One plant with all of them: the loader refuses a uuid that stands twice.
    let instances: String =
        shipped.iter().map(|name| format!("<instance name=\"{name}\" prototype=\"{name}\"/>")).collect();
    let plant = format!("<plant name=\"all\">{instances}</plant>");
    let source = Layered(Memory([("all/plant.xml".to_owned(), plant)].into()), Embedded);
    if let Err(error) = load(&source, "all", KINDS) {
        panic!("{error}");
    }
}
