//! `kinetwin replay` and `kinetwin trace cut`.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use std::time::Duration;

use super::arguments::{CutArguments, ReplayArguments};
use super::output::write_whole;
use super::words;
use super::{Answer, Failure};
use crate::replay::{self, Survey, Tolerances};
use crate::run::Options;
use crate::run::model;
use crate::time::Instant;
use crate::trace::{self, Compression, Reader, Span};

/// Replays a trace through a model and compares.
pub fn replay(arguments: &ReplayArguments) -> Result<Answer, Failure> {
    let plant = model::load(&arguments.model)?;
    let survey = Survey::of(&plant.signal_map, open(&arguments.trace)?).map_err(|error| Failure::of(&error))?;
    let header = survey.header();
    let known = header.model_hash.as_deref();
    if known.is_some_and(|hash| hash != model::hash(&plant)) {
        let recorded = header.model.as_deref().unwrap_or("another model");
        words::tell(format_args!(
            "warning: the trace was recorded with {recorded} in another state than {} has now",
            arguments.model
        ));
    }
    let step = header.step_ns.map_or(Options::STEP, Duration::from_nanos);
    let mut engine = model::engine(&plant, step, header.seed.unwrap_or_default())?;
    let tolerances =
        Tolerances { edge: arguments.edge_tolerance, level: arguments.level_tolerance, ..Tolerances::default() };
    let report = replay::run(&mut engine, &plant.signal_map, &survey, open(&arguments.trace)?, &tolerances);
    let report = report.map_err(|error| Failure::of(&error))?;
    if arguments.json {
        words::answer_line(serde_json::to_string(&report)?)?;
    } else {
        words::answer(&report)?;
    }
    // Where nothing was compared, nothing was shown to be equal.
    let compared = !report.levels.is_empty() || !report.edges.is_empty();
    Ok(if compared && !report.differs { Answer::Yes } else { Answer::No })
}

/// Opens a trace.
pub fn open(path: &Path) -> Result<Reader<BufReader<File>>, Failure> {
    let file = File::open(path)
        .map_err(|error| Failure(format!("error: failed to read the trace {}: {error}", path.display())))?;
    Reader::new(path.to_string_lossy(), BufReader::with_capacity(1 << 16, file)).map_err(|error| Failure::of(&error))
}

/// Copies a span of a trace.
pub fn cut(arguments: &CutArguments) -> Result<Answer, Failure> {
    let CutArguments { trace: from, output, force, .. } = arguments;
    let span =
        Span { from: Instant::ZERO + arguments.from, to: Instant::ZERO + arguments.to, warm_up: arguments.warm_up };
    let reader = open(from)?;
    write_whole(output, *force, |file| {
        let written = trace::cut(reader, file, Compression::of(&output.to_string_lossy()), span);
        written.map(|file| (file, ())).map_err(|error| Failure::of(&error))
    })?;
    Ok(Answer::Yes)
}
