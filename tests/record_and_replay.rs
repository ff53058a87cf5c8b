//! A run with its automation, recorded; and its trace, replayed without any difference, whether the run was made in
//! lock-step or by two threads over a WebSocket.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::{self, embedded::Embedded};
use kinetwin::replay::{self, Report, Survey, Tolerances};
use kinetwin::run::{self, Connect, Options, RecordTo, Speed};
use kinetwin::trace::Reader;

fn record(model: &str, speed: Speed, seconds: u64, path: &Path) {
    let options = Options {
        connect: Some(Connect::Embedded),
        seed: 3,
        speed,
        duration: Some(Duration::from_secs(seconds)),
        record: Some(RecordTo { path: path.to_owned(), replace: false }),
        ..Options::new(model)
    };
    run::start(&options).expect("the run starts").finish().expect("the run ends");
}

fn replay(model: &str, path: &Path) -> Report {
    let open = || {
        let file = BufReader::new(File::open(path).expect("the trace opens"));
        Reader::new(path.display().to_string(), file).expect("a trace")
    };
    let plant = plant::load(&Embedded, model, KINDS).expect("the model");
    let survey = Survey::of(&plant.signal_map, open()).expect("every line is one");
    let seed = survey.header().seed.expect("the run's seed");
    let mut engine = Engine::new(&plant, Options::STEP, seed).expect("an engine");
    replay::run(&mut engine, &plant.signal_map, &survey, open(), &Tolerances::default()).expect("a replay")
}

/// Runs, records and replays `model`; at least so many edges were matched.
fn check(model: &str, speed: Speed, seconds: u64, edges: u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.cps.jsonl.zst");
    record(model, speed, seconds, &path);
    let report = replay(model, &path);
    assert!(!report.differs && report.ignored.is_empty() && report.notices.is_empty(), "{report}");
    assert!(report.unrecorded.is_empty() && report.torn.is_none(), "{report}");
    assert!(report.levels.iter().all(|level| level.largest == 0.0 && level.silent == 0), "{report}");
    let matched: u64 = report.edges.iter().map(|edge| edge.matched).sum();
    assert!(matched >= edges, "{report}");
    assert_eq!(report, replay(model, &path), "two replays of one trace");
}

#[test]
fn a_run_in_lock_step_replays_without_any_difference() {
    check("models/rig", Speed::Max, 60, 300);
}

#[test]
fn a_run_over_a_websocket_replays_without_any_difference() {
    check("models/rig", Speed::Wall(4.0), 8, 1);
}
