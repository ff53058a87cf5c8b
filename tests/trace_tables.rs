//! Tables of real machines become traces that a model can be replayed against: the recordings of an arm and of a pendulum,
//! from their CSV files as they are.
//!
//! The recordings are not part of the project: where they do not lie beside it, these tests say so and pass. What stands in
//! them is read here a second time, by splitting lines at commas.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn data(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    if path.exists() {
        return Some(path);
    }
    eprintln!("{name} is not there: nothing was tested");
    None
}

fn kinetwin(arguments: &[&str]) -> (i32, String) {
    let ended = Command::new(env!("CARGO_BIN_EXE_kinetwin"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("kinetwin starts");
    let text = format!("{}{}", String::from_utf8_lossy(&ended.stdout), String::from_utf8_lossy(&ended.stderr));
    (ended.status.code().unwrap_or(-1), text)
}

/// The columns of a CSV file, without its header.
fn columns(path: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).expect("a table");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect())
        .collect();
    (0..rows[0].len()).map(|column| rows.iter().map(|row| row[column]).collect()).collect()
}

/// Times and values of a signal in a trace, by a plain reading of its JSON.
fn signal(trace: &Path, from: &str, name: &str) -> (Vec<f64>, Vec<Value>) {
    let text = fs::read_to_string(trace).expect("a trace");
    let lines = text.lines().skip(1).map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
    lines
        .filter(|line| line["from"] == from)
        .filter_map(|line| {
            let value = line["SendValue"].as_array()?.iter().find(|entry| entry["name"] == name)?["value"].clone();
            Some((line["t"].as_f64()?, value))
        })
        .unzip()
}

fn numbers(values: &[Value]) -> Vec<f64> {
    values.iter().map(|value| value.as_f64().expect("a number")).collect()
}

const ARM: [&str; 12] = [
    "--map",
    "rotation_target_rad=Rotation.positionTarget",
    "--map",
    "pitch_target_rad=Pitch.positionTarget",
    "--map",
    "rotation_rad=Rotation.position",
    "--map",
    "pitch_rad=Pitch.position",
    "--map",
    "rotation_rad_s=Rotation.velocity",
    "--map",
    "pitch_rad_s=Pitch.velocity",
];

#[test]
fn the_arms_recordings_become_traces_of_its_model() {
    let Some(folder) = data("servo-arm") else { return };
    let out = tempfile::tempdir().expect("a folder");
    for motion in ["backlash_detection", "chirp_sweep", "multisine", "step_response", "trapezoidal_profile"] {
        let table = |kind: &str| folder.join(format!("{motion}.{kind}.csv"));
        let (commands, states, trace) =
            (table("command"), table("state"), out.path().join(format!("{motion}.cps.jsonl")));
        let paths = [&commands, &states, &trace].map(|path| path.to_str().expect("a path"));
        let mut arguments = vec!["trace", "import", "--csv", paths[0], "--csv", paths[1], "--time", "t_s"];
        arguments.extend(["--model", "models/servo-arm", "-o", paths[2]]);
        arguments.extend(ARM);
        let (code, told) = kinetwin(&arguments);
        assert_eq!(code, 0, "{told}");

        let (commands, states) = (columns(&commands), columns(&states));
        let check = |from: &str, name: &str, table: &[Vec<f64>], column: usize| {
            let (times, values) = signal(&trace, from, name);
            assert_eq!(times, table[0], "{motion}: the times of {name}");
            assert_eq!(numbers(&values), table[column], "{motion}: {name}");
        };
        check("automation", "Rotation.positionTarget", &commands, 1);
        check("automation", "Pitch.positionTarget", &commands, 2);
        check("plant", "Rotation.position", &states, 1);
        check("plant", "Pitch.velocity", &states, 4);
    }
    // The ideal servo's gap, as the README states it: 11.3 and 43.1 mrad RMS over the trapezoids.
    let trace = out.path().join("trapezoidal_profile.cps.jsonl");
    let trace = trace.to_str().expect("a path");
    let (code, told) = kinetwin(&["replay", trace, "--model", "models/servo-arm", "--json"]);
    assert_eq!(code, 1, "{told}");
    let report: Value = serde_json::from_str(told.trim()).expect("JSON");
    let levels = report["levels"].as_array().expect("levels");
    for (name, stated) in [("Rotation.position", 0.0113), ("Pitch.position", 0.0431)] {
        let level = levels.iter().find(|level| level["name"] == name).expect("the level");
        let rms = level["rms"].as_f64().expect("an RMS difference");
        assert!((rms - stated).abs() < 0.0003, "{name}: {rms}, {stated} stated");
    }
}

#[test]
fn the_pendulums_recordings_become_traces_of_its_model() {
    let Some(folder) = data("servo-pendulum") else { return };
    let out = tempfile::tempdir().expect("a folder");
    for (motion, gain) in [("lift_and_drop", "kp100"), ("up_and_down", "kp800")] {
        let (table, trace) =
            (folder.join(format!("{motion}-{gain}.csv")), out.path().join(format!("{motion}.cps.jsonl")));
        let model = format!("models/servo-pendulum/{gain}.xml");
        let (code, told) = kinetwin(&[
            "trace",
            "import",
            "--csv",
            table.to_str().expect("a path"),
            "--time",
            "t_s",
            "--model",
            &model,
            "--map",
            "goal_rad=Servo.positionTarget",
            "--map",
            "torque_enabled=Servo.torqueEnabled",
            "--map",
            "position_rad=Servo.position",
            "--map",
            "speed_rad_s=Servo.velocity",
            "-o",
            trace.to_str().expect("a path"),
        ]);
        assert_eq!(code, 0, "{told}");
        assert!(told.contains("columns unused   supply_V"), "{told}");
        let table = columns(&table);
        let (times, goals) = signal(&trace, "automation", "Servo.positionTarget");
        assert_eq!((times, numbers(&goals)), (table[0].clone(), table[1].clone()), "{motion}");
        let (_, torque) = signal(&trace, "automation", "Servo.torqueEnabled");
        let stated: Vec<Value> = table[5].iter().map(|on| Value::Bool(*on == 1.0)).collect();
        assert_eq!(torque, stated, "{motion}");
        let (code, told) = kinetwin(&["trace", "info", trace.to_str().expect("a path"), "--model", &model, "--json"]);
        assert_eq!(code, 0, "{told}");
        let info: Value = serde_json::from_str(told.trim()).expect("JSON");
        let shows = info["devices"][0]["shows"].as_array().expect("a device");
        assert!(shows.iter().any(|effect| effect == "load-dependent-friction"), "{motion}: {shows:?}");
    }
}

#[test]
fn a_wrong_table_leaves_nothing_behind() {
    let out = tempfile::tempdir().expect("a folder");
    let (table, trace) = (out.path().join("a.csv"), out.path().join("a.cps.jsonl"));
    fs::write(&table, "t,x\n0,1\n1,NaN\n").expect("a table");
    let paths = [&table, &trace].map(|path| path.to_str().expect("a path"));
    let import = |more: &[&str]| {
        let mut arguments = vec!["trace", "import", "--csv", paths[0], "-o", paths[1]];
        arguments.extend(more);
        kinetwin(&arguments)
    };
    let check = |more: &[&str], words: &str| {
        let (code, told) = import(more);
        assert!(code == 2 && told.contains(words), "{code}: {told}");
        assert_eq!(fs::read_dir(out.path()).expect("a folder").count(), 1, "only the table is there");
    };
    check(&["--time", "t", "--map", "x=A.x"], "a.csv:3: column x: \"NaN\" cannot stand in a trace");
    check(&["--time", "T", "--map", "x=A.x"], "there is no column \"T\" for the time: expected one of t, x");
    check(&["--time", "t", "--map", "x=Axis.positoin", "--model", "rig"], "did you mean \"Axis.position\"?");
    check(&["--time", "t", "--unit", "hours", "--map", "x=A.x"], "expected one of s, ms, us, ns");
    check(&["--time", "t", "--map", "x"], "is no COLUMN=SIGNAL");
    check(&["--map", "x=A.x"], "--time <COLUMN>");
    let (code, told) = import(&["--time", "t", "--map", "x=A.x", "--missing", "NaN"]);
    assert_eq!(code, 0, "{told}");
    assert!(import(&["--time", "t", "--map", "x=A.x"]).1.contains("is there already"));
}
