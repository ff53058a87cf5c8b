//! A real arm through the whole diagnosis: two joints, trained on two motions, measured on motions that no fit saw. The figures to be
//! met stand in its own tests; without the recordings beside this folder nothing is tested.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

use kinetwin::gap::diagnosis::{Diagnosis, Options, diagnose};
use kinetwin::gap::report::{Report, Verdict};
use kinetwin::gap::{Overrides, Recording, Study};
use kinetwin::plant::Plant;
use kinetwin::run::model;
use kinetwin::trace::Reader;

const COLUMNS: [&str; 4] = [
    "rotation_target_rad=Rotation.positionTarget",
    "pitch_target_rad=Pitch.positionTarget",
    "rotation_rad=Rotation.position",
    "pitch_rad=Pitch.position",
];

/// A part of the library: what a servo with gears may have, its sensor off or not.
const LATE_WITH_PLAY: [&str; 4] = ["dead-time", "backlash", "dead-band", "offset"];

fn data() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/servo-arm");
    if !folder.is_dir() {
        eprintln!("the recordings of the arm are not beside this folder: nothing is tested");
        return None;
    }
    Some(folder)
}

/// A motion's tables as a recording.
fn motion(plant: &Plant, folder: &Path, name: &str) -> Recording {
    let out = tempfile::tempdir().expect("a folder");
    let trace = out.path().join(format!("{name}.cps.jsonl"));
    let mut import = Command::new(env!("CARGO_BIN_EXE_kinetwin"));
    import.args(["trace", "import", "--time", "t_s", "--sampled", "--model", "models/servo-arm", "-o"]).arg(&trace);
    for table in ["command", "state"] {
        import.arg("--csv").arg(folder.join(format!("{name}.{table}.csv")));
    }
    import.args(COLUMNS.iter().flat_map(|column| ["--map", column]));
    let told = import.output().expect("kinetwin");
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    let file = File::open(&trace).expect("a trace");
    let reader = Reader::new(name, BufReader::new(file)).expect("a trace");
    Recording::read(plant, name, reader, &[]).expect("a recording of the arm")
}

fn diagnosed(plant: &Plant, device: &str, effects: &[&str], train: &[Recording], held_out: &[Recording]) -> Diagnosis {
    let options = Options {
        is_asked: &|id| effects.contains(&id),
        is_meant: &|name| name == device,
        is_stopped: &|| false,
        tell: &|_| {},
    };
    let diagnosis = diagnose(plant, train, held_out, &options).expect("a diagnosis");
    assert_eq!(diagnosis.report.flaws(), Vec::<String>::new(), "{}", diagnosis.report.to_json());
    diagnosis
}

/// How far the device's position is off in a recording with what was found, mrad RMS.
fn left(plant: &Plant, diagnosis: &Diagnosis, recording: &Recording) -> f64 {
    let study = Study::new(plant, std::slice::from_ref(recording)).expect("a study");
    let finding = &diagnosis.findings[0];
    let subject = &study.subjects[finding.subject];
    let with = subject.predict(&finding.specs(), &Overrides::none()).expect("effects that fit");
    let score = subject.score(&with);
    1e3 * score.signals.iter().find(|signal| signal.level.is_some()).expect("the position").rms
}

/// Play and stiction: none of them is told from the others.
#[track_caller]
fn check_play(report: &Report) {
    let is_play = |effect: &str| ["backlash", "dead-band", "hysteresis"].contains(&effect);
    let cause = report.cause.iter().find(|cause| is_play(&cause.effect)).expect("play, in the answer");
    let class: Vec<&str> = cause.class.iter().map(|member| member.effect.as_str()).collect();
    assert!(class.contains(&"backlash") && class.contains(&"dead-band"), "{class:?}");
    assert_eq!(report.verdict, Verdict::Ambiguous);
}

fn parameter(report: &Report, effect: &str) -> f64 {
    let cause = report.cause.iter().find(|cause| cause.effect == effect);
    cause.unwrap_or_else(|| panic!("no {effect}: {}", report.to_json())).parameters[0].value
}

/// Trained on two motions, measured on two others, at most so many mrad RMS; the chirp is faster than both.
fn check_joint(device: &str, effects: &[&str], most: [f64; 2]) -> Option<Report> {
    let folder = data()?;
    let plant = model::load("models/servo-arm").expect("the arm");
    let read = |name| motion(&plant, &folder, name);
    let train = ["multisine", "step_response"].map(read);
    let held_out = ["backlash_detection", "trapezoidal_profile", "chirp_sweep"].map(read);
    let diagnosis = diagnosed(&plant, device, effects, &train, &held_out);
    check_play(&diagnosis.report);
    for (recording, most) in held_out.iter().zip(most) {
        let left = left(&plant, &diagnosis, recording);
        assert!(left <= most, "{device}, {}: {left} mrad\n{}", recording.name, diagnosis.report.to_json());
    }
    let untold = &diagnosis.report.not_testable;
    let of_chirp = untold.iter().filter(|entry| entry.reason.contains("chirp_sweep")).count();
    assert!(of_chirp == 1 && untold.len() == 1, "{untold:?}");
    Some(diagnosis.report)
}

#[test]
fn the_joint_about_the_vertical_is_late_and_has_play_or_stiction() {
    let Some(report) = check_joint("Rotation", &LATE_WITH_PLAY[..3], [4.5, 3.7]) else { return };
    assert!((0.07..0.09).contains(&parameter(&report, "dead-time")));
}

#[test]
fn the_joint_that_carries_the_arm_sags_as_well() {
    let Some(report) = check_joint("Pitch", &LATE_WITH_PLAY, [4.7, 7.4]) else { return };
    assert!((0.038..0.044).contains(&parameter(&report, "offset")));
}
