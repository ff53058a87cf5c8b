//! How long the replay of a minute takes: the rig's and the line's, recorded in lock-step with their automation.
//!
//!     cargo bench --bench replay
//!
//! The goal: a trace of 60 s is replayed in less than 1 s.

use std::fs::File;
use std::hint::black_box;
use std::io::{BufReader, Cursor, Read};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::{self, Plant, embedded::Embedded};
use kinetwin::replay::{self, Report, Survey, Tolerances};
use kinetwin::run::{self, Connect, Options, RecordTo, Speed};
use kinetwin::trace::{Reader, info};

const SECONDS: u64 = 60;

/// A minute of `model`, recorded: the file's bytes.
fn record(model: &str, folder: &Path) -> Vec<u8> {
    let path = folder.join("minute.cps.jsonl");
    let options = Options {
        connect: Some(Connect::Embedded),
        speed: Speed::Max,
        duration: Some(Duration::from_secs(SECONDS)),
        record: Some(RecordTo { path: path.clone(), replace: true }),
        ..Options::new(model)
    };
    run::start(&options).expect("the run starts").finish().expect("the run ends");
    let mut bytes = Vec::new();
    File::open(&path).and_then(|file| BufReader::new(file).read_to_end(&mut bytes)).expect("the trace is read");
    bytes
}

fn open(trace: &[u8]) -> Reader<Cursor<&[u8]>> {
    Reader::new("minute", Cursor::new(trace)).expect("a trace")
}

fn replay(plant: &Plant, trace: &[u8]) -> Report {
    let survey = Survey::of(&plant.signal_map, open(trace)).expect("every line is one");
    let mut engine = Engine::new(plant, Options::STEP, survey.header().seed.unwrap_or(0)).expect("an engine");
    replay::run(&mut engine, &Arc::clone(&plant.signal_map), &survey, open(trace), &Tolerances::default())
        .expect("a replay")
}

fn minutes(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut group = criterion.benchmark_group("60 s");
    group.sample_size(10);
    for model in ["models/rig", "models/depalletizer"] {
        let trace = record(model, folder.path());
        let plant = plant::load(&Embedded, model, KINDS).expect("the model");
        let report = replay(&plant, &trace);
        assert!(!report.differs, "{report}");
        println!("{model}: {} lines, {:.1} MB", report.lines, trace.len() as f64 / 1e6);
        group.bench_function(format!("{model}: replay"), |b| b.iter(|| black_box(replay(&plant, &trace))));
        group.bench_function(format!("{model}: read"), |b| b.iter(|| black_box(info(open(&trace)).is_ok())));
    }
    group.finish();
}

criterion_group!(benches, minutes);
criterion_main!(benches);
