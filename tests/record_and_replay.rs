//! A minute of the line under its automation, recorded; and its trace, replayed twice, each time without any difference
//! and to the state that the run ended in.

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

/// Runs `model` in lock-step with its automation and records it. The hash of the state it ends in.
fn record(model: &str, seconds: u64, path: &Path) -> String {
    let options = Options {
        connect: Some(Connect::Embedded),
        seed: 3,
        speed: Speed::Max,
        duration: Some(Duration::from_secs(seconds)),
        record: Some(RecordTo { path: path.to_owned(), replace: false }),
        ..Options::new(model)
    };
    run::start(&options).expect("the run starts").finish().expect("the run ends").state_hash
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

/// Runs, records and replays `model`; at least so many edges are matched.
fn check(model: &str, seconds: u64, edges: u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.cps.jsonl.zst");
    let state = record(model, seconds, &path);
    let report = replay(model, &path);
    assert!(!report.differs && report.ignored.is_empty() && report.notices.is_empty(), "{report}");
    assert!(report.unrecorded.is_empty() && report.torn.is_none(), "{report}");
    assert!(report.levels.iter().all(|level| level.largest == 0.0 && level.silent == 0), "{report}");
    let matched: u64 = report.edges.iter().map(|edge| edge.matched).sum();
    assert!(matched >= edges, "{report}");
    // The session ends at the run's last step, and so does its trace.
    assert_eq!(report.state_hash, state, "{report}");
    assert_eq!(report, replay(model, &path), "two replays of one trace");
}

#[test]
fn the_line_replays_without_any_difference() {
    check("models/depalletizer", 60, 300);
}
