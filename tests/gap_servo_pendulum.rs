//! Recordings of a real servo that swings a pendulum, from their CSV files to a verdict: the friction that grows with the load is
//! found, on recordings at two gains that are fitted together.
//!
//! The recordings are not part of the project: where they do not lie beside it, this test says so and passes.

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;
use std::process::Command;

use kinetwin::gap::{Recording, Study};
use kinetwin::run::model;
use kinetwin::trace::Reader;
use serde_json::Value;

const TRAIN: [&str; 3] = ["sin_sin", "sin_time_square", "lift_and_drop"];
const HELD_OUT: &str = "up_and_down";
/// Two of the four: enough to be sure of the friction, and few enough to be fitted in a test.
const GAINS: [&str; 2] = ["kp100", "kp200"];

fn kinetwin(arguments: &[&str]) {
    let ended = Command::new(env!("CARGO_BIN_EXE_kinetwin"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("kinetwin starts");
    assert!(ended.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&ended.stderr));
}

/// The trace of a motion at a gain, imported into `folder`.
fn trace(folder: &Path, motion: &str, gain: &str) -> String {
    let table = format!("../shared/data/servo-pendulum/{motion}-{gain}.csv");
    let trace = folder.join(format!("{motion}-{gain}.cps.jsonl")).to_string_lossy().into_owned();
    let model = format!("models/servo-pendulum/{gain}.xml");
    let import = ["trace", "import", "--csv", &table, "--time", "t_s", "--sampled", "--model", &model];
    let map = ["goal_rad=Servo.positionTarget", "position_rad=Servo.position", "torque_enabled=Servo.torqueEnabled"];
    let map: Vec<&str> = map.iter().flat_map(|column| ["--map", column]).collect();
    kinetwin(&[&import[..], &map, &["-o", &trace]].concat());
    trace
}

#[test]
fn the_friction_of_a_real_gear_grows_with_its_load() {
    if !Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/servo-pendulum").exists() {
        eprintln!("servo-pendulum is not there: nothing was tested");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let of = |motions: &[&str]| -> Vec<String> {
        let each = motions.iter().flat_map(|motion| GAINS.map(|gain| trace(folder.path(), motion, gain)));
        each.collect()
    };
    let (train, held_out) = (of(&TRAIN), of(&[HELD_OUT]));
    let out = folder.path().join("gap").to_string_lossy().into_owned();
    let frictions = "coulomb-friction,load-dependent-friction";
    let mut arguments = vec!["gap", "diagnose", "--model", "models/servo-pendulum", "--effects", frictions, "--train"];
    arguments.extend(train.iter().map(String::as_str));
    arguments.push("--holdout");
    arguments.extend(held_out.iter().map(String::as_str));
    arguments.extend(["--out", &out]);
    kinetwin(&arguments);

    let text = fs::read_to_string(folder.path().join("gap/report.json")).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let friction = &report["cause"][0];
    assert_eq!(friction["effect"], "load-dependent-friction", "{text}");
    let coefficient = friction["parameters"][0]["value"].as_f64().expect("a number");
    assert!((0.18..0.32).contains(&coefficient), "{coefficient}");
    // Held out, in one go and in windows: far less than without it.
    let position = &report["where"][0]["signals"][0];
    let figure = |of: &Value, name: &str| of[name].as_f64().expect("a number");
    let (before, after) = (figure(position, "before"), figure(position, "after"));
    assert!(after < 0.085 && after < 0.8 * before, "{before} {after}");
    let windows = &position["in_windows"];
    let (before, after) = (figure(windows, "before"), figure(windows, "after"));
    assert!(after < 0.07 && after < 0.65 * before, "{before} {after}");
}

#[test]
fn another_plant_file_of_the_folder_is_a_setting_of_the_machine() {
    let [plant, variant] =
        ["models/servo-pendulum", "models/servo-pendulum/kp400.xml"].map(|name| model::load(name).expect("a model"));
    let mut recording = Recording::of(&plant, "still", &[], &[], 1.0);
    recording.set_up_as(&plant, &plant);
    assert!(recording.settings.is_empty());
    recording.set_up_as(&plant, &variant);
    let settings: Vec<(&String, &f64)> = recording.settings.values().flatten().collect();
    assert_eq!(settings, [(&"velocityGain".to_owned(), &0.8)]);
}

/// Whether the diagnosis takes the device up again and again in a trace of a model.
fn is_taken_up_again(model: &str, trace: &str, device: &str) -> bool {
    let plant = model::load(model).expect("a model");
    let file = File::open(trace).unwrap_or_else(|error| panic!("{trace}: {error}"));
    let reader = Reader::new(trace, BufReader::new(file)).expect("a trace");
    let recording = Recording::read(&plant, trace, reader, &[]).expect("a recording");
    let study = Study::new(&plant, &[recording]).expect("a study");
    study.subject(device).expect("the device").is_taken_up_again()
}

#[test]
fn an_axis_that_swings_is_taken_up_again_and_one_under_a_speed_loop_is_not() {
    if !Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/servo-pendulum").exists() {
        eprintln!("servo-pendulum is not there: nothing was tested");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    for gain in ["kp100", "kp800"] {
        let trace = trace(folder.path(), "sin_sin", gain);
        assert!(is_taken_up_again(&format!("models/servo-pendulum/{gain}.xml"), &trace, "Servo"), "{gain}");
    }
    // Its friction grows as it warms, and no effect explains that: the gap is large.
    let warming = "../shared/data/rig-sample/case-06/train.cps.jsonl.zst";
    assert!(!is_taken_up_again("models/rig", warming, "Axis"));
}
