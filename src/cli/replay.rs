//! `kinetwin replay`, `kinetwin trace info` and `kinetwin trace cut`.

use std::fs::File;
use std::io::{BufReader, BufWriter, Write};
use std::path::Path;
use std::time::Duration;

use super::arguments::{CutArguments, InfoArguments, ReplayArguments};
use super::words;
use super::{Answer, Failure};
use crate::replay::{self, Survey, Tolerances};
use crate::run::Options;
use crate::run::model;
use crate::time::Instant;
use crate::trace::{self, Compression, Info, Reader, Span};

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

fn open(path: &Path) -> Result<Reader<BufReader<File>>, Failure> {
    let file = File::open(path)
        .map_err(|error| Failure(format!("error: failed to read the trace {}: {error}", path.display())))?;
    Reader::new(path.to_string_lossy(), BufReader::with_capacity(1 << 16, file)).map_err(|error| Failure::of(&error))
}

/// Says what stands in a trace.
pub fn info(arguments: &InfoArguments) -> Result<Answer, Failure> {
    let info = trace::info(open(&arguments.trace)?).map_err(|error| Failure::of(&error))?;
    if arguments.json {
        words::answer_line(serde_json::to_string(&info)?)?;
    } else {
        words::answer(info_text(&info))?;
    }
    Ok(Answer::Yes)
}

fn info_text(info: &Info) -> String {
    let mut out = String::new();
    let mut line = |name: &str, what: &str| out.push_str(&format!("{name:<11} {what}\n"));
    let header = &info.header;
    line("source", &format!("{:?}", header.source).to_lowercase());
    for (name, text) in [("start", &header.start), ("model", &header.model), ("note", &header.note)] {
        if let Some(text) = text {
            line(name, text);
        }
    }
    if let Some(step) = header.step_ns {
        line("step", &crate::time::format_duration(Duration::from_nanos(step)));
    }
    if let Some(seed) = header.seed {
        line("seed", &seed.to_string());
    }
    line("time", &format!("{} s to {} s", info.begins_s, info.ends_s));
    let counts = |counts: &std::collections::BTreeMap<&'static str, u64>| {
        counts.iter().map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
    };
    line("lines", &format!("{} ({})", info.lines, counts(&info.senders)));
    line("messages", &counts(&info.messages));
    if let Some(torn) = &info.torn {
        line("torn", torn);
    }
    let wide = info.signals.keys().map(|name| name.chars().count()).max().unwrap_or(0).max(6);
    out.push_str(&format!("\n{:wide$}  {:>9}  {:>9}\n", "signal", "commands", "reports"));
    for (name, signal) in &info.signals {
        out.push_str(&format!("{name:wide$}  {:>9}  {:>9}\n", signal.commands, signal.reports));
    }
    out
}

/// Copies a span of a trace.
pub fn cut(arguments: &CutArguments) -> Result<Answer, Failure> {
    let CutArguments { trace: from, output, force, .. } = arguments;
    if output.exists() && !force {
        return Err(Failure(format!(
            "error: {} is there already; choose another file, or replace it with --force",
            output.display()
        )));
    }
    let span =
        Span { from: Instant::ZERO + arguments.from, to: Instant::ZERO + arguments.to, warm_up: arguments.warm_up };
    let fail = |error: std::io::Error| Failure(format!("error: failed to write {}: {error}", output.display()));
    let reader = open(from)?;
    // Under another name until it is whole: what is read may be what is replaced.
    let mut partial = output.clone().into_os_string();
    partial.push(".partial");
    let file = BufWriter::new(File::create(&partial).map_err(fail)?);
    let written = trace::cut(reader, file, Compression::of(&output.to_string_lossy()), span);
    match written {
        Ok(mut file) => {
            file.flush().and_then(|()| std::fs::rename(&partial, output)).map_err(fail)?;
            Ok(Answer::Yes)
        }
        Err(error) => {
            // What was begun is of no use to anybody; the error says why.
            let _ = std::fs::remove_file(&partial);
            Err(Failure::of(&error))
        }
    }
}
