//! The recordings of a rig that is not ours, replayed on `models/rig`: the two without any effect differ by no more than
//! a report cycle on edges and the stated noise on levels, and where something was added the replay names it.
//!
//! The rig was recorded at a PLC's cycle, with noise, quantisation and jitter; its README states how much. The recordings
//! are not part of the project: where they do not lie beside it, the test says so and passes.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::{self, embedded::Embedded};
use kinetwin::replay::{self, Report, Survey, Tolerances};
use kinetwin::trace::Reader;

const RECORDINGS: &str = "../shared/data/rig-sample";

/// Each level's quantisation, the RMS of its noise where the stated noise is 1, and how much it can change in a second:
/// that, times the jitter, is what a report's stamp may be off by. (Counts of an encoder add up what the commands' stamps
/// are off by, too.)
const LEVELS: [(&str, f64, f64, f64); 10] = [
    ("Belt.velocityActual", 1e-3, 1.0e-3, 1.0),
    ("Robot.actualPosX", 5e-5, 2.2e-5, 1.0),
    ("Robot.actualPosY", 5e-5, 2.2e-5, 1.0),
    ("Robot.actualPosZ", 5e-5, 2.2e-5, 1.0),
    ("Robot.actualPosR", 5e-5, 3.4e-5, 2.0),
    ("Axis.position", 1e-5, 1.6e-5, 2.0),
    ("Axis.velocity", 1e-3, 1.5e-3, 25.0),
    ("Axis.force", 0.5, 1.5, 30_000.0),
    ("Motor.encoder", 1.0, 0.0, 20_000.0),
    ("Motor.speedActual", 1e-2, 3.1e-2, 20.0),
];

/// The recorded simulation samples and stamps by this much.
const SAMPLING: Duration = Duration::from_micros(110);

/// The replay of a recording with a step of 1 ms; `None` where there is none.
fn replay(case: &str, file: &str, edge: Duration) -> Option<Report> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(RECORDINGS).join(case).join(format!("{file}.cps.jsonl.zst"));
    if !path.exists() {
        println!("skipped: no recording at {}", path.display());
        return None;
    }
    let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
    let mut engine = Engine::new(&plant, Duration::from_millis(1), 0).expect("an engine");
    let open = || {
        let file = BufReader::new(File::open(&path).expect("the recording opens"));
        Reader::new(path.display().to_string(), file).expect("it is a trace")
    };
    let survey = Survey::of(&plant.signal_map, open()).expect("every line is one");
    let tolerances = Tolerances { edge, ..Tolerances::default() };
    let report = replay::run(&mut engine, &plant.signal_map, &survey, open(), &tolerances).expect("a replay");
    println!("{case} {file}\n{report}");
    Some(report)
}

/// Both recordings of a case without an effect.
fn check(case: &str, cycle: Duration, noise: f64, jitter: Duration) {
    for file in ["train", "holdout"] {
        let Some(report) = replay(case, file, cycle + 4 * jitter + SAMPLING) else { return };
        assert!(report.ignored.is_empty() && report.notices.is_empty() && report.unrecorded.is_empty());
        assert_eq!(report.edges.len() + report.levels.len(), 23);
        for edge in &report.edges {
            assert!(!edge.differs, "{case} {file}: {edge:?}");
        }
        for level in &report.levels {
            let (_, step, unit, slope) = LEVELS.iter().find(|entry| entry.0 == level.name).expect("a level of the rig");
            let (noise, timing) = (noise * unit, slope * jitter.as_secs_f64());
            let rms = 1.1 * (noise * noise + step * step / 12.0 + timing * timing).sqrt() + slope * 1e-5;
            let largest = 0.5 * step + 5.0 * noise + 4.0 * timing + slope * SAMPLING.as_secs_f64();
            assert!(level.rms <= rms, "{case} {file}: RMS of at most {rms:e} expected: {level:?}");
            assert!(level.largest <= largest, "{case} {file}: at most {largest:e} expected: {level:?}");
        }
    }
}

#[test]
fn a_recording_with_jitter_differs_by_no_more_than_its_cycle_and_noise() {
    check("case-01", Duration::from_millis(20), 0.3, Duration::from_millis(1));
}

#[test]
fn a_recording_without_jitter_differs_by_no_more_than_its_cycle_and_noise() {
    check("case-02", Duration::from_millis(50), 1.0, Duration::ZERO);
}

/// What the replay finds where an effect was added: only these signals' edges, in a recording at 20 ms.
fn check_effect(case: &str, jitter: Duration, differing: &[&str]) {
    let Some(report) = replay(case, "train", Duration::from_millis(20) + 4 * jitter + SAMPLING) else { return };
    let edges: Vec<_> = report.edges.iter().filter(|edge| edge.differs).map(|edge| edge.name.as_str()).collect();
    assert_eq!(edges, differing, "{case}\n{report}");
}

#[test]
fn an_effect_is_seen_where_it_was_added() {
    // A dead time of 169 ms on the gripper's commands.
    check_effect("case-03", Duration::from_millis(1), &["Gripper.vacuumOn"]);
    // Friction on the axis, which has no edges.
    check_effect("case-06", Duration::from_millis(1), &[]);
    // A light barrier that comes on 56 ms late, beside a lag of 3 ms of the robot.
    check_effect("case-07", Duration::from_millis(1), &["Belt.lightBarrierB"]);
}
