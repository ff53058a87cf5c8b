//! `kinetwin trace import` and `kinetwin trace export`.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use clap::{Args, ValueEnum};

use super::output::{Output, write_whole};
use super::replay::open;
use super::{Answer, Failure, words};
use crate::engine::Engine;
use crate::replay::foxglove::Pictures;
use crate::replay::{self, Reported, Seen, Survey, Tolerances};
use crate::run::{Options, model};
use crate::scene::Scene;
use crate::signal_map::{Direction, SignalMap};
use crate::trace::export::{self, Exported};
use crate::trace::import::{self, Clock, Imported, Mapping, Settings, Shape, Signals, Table, TimeUnit};
use crate::trace::{self, Commands, Compression, Header, Source, Writer};

/// Makes a trace of tables of measurements: CSV files, or an MCAP file.
///
/// Every mapped cell that holds something becomes a value in a line with its row's time. With --model, signals that the
/// model takes as commands come from the automation and all others from the plant, values are checked by their signals'
/// types, and a name that the model does not have is refused. Several CSV files are merged by time.
///
/// Cells are parted by semicolons, tabulators or commas, whichever the header has; decimal commas are read where no point
/// stands beside them. Times are read as exact decimals. A table whose times go back, a cell that is no value, and NaN are
/// errors that name file, line and column.
#[derive(Debug, Args)]
#[command(after_long_help = IMPORT_HELP)]
pub struct ImportArguments {
    /// A CSV file whose first line names its columns; may be given several times
    #[arg(long, value_name = "FILE", required_unless_present = "mcap", conflicts_with = "mcap")]
    pub csv: Vec<PathBuf>,
    /// The column of the times: one for all files, or one for each in their order
    #[arg(long, value_name = "COLUMN", required_unless_present_any = ["rate", "mcap"], conflicts_with_all = ["rate", "mcap"])]
    pub time: Vec<String>,
    /// The unit of the times: one for all files, or one for each in their order [default: s]
    #[arg(long, value_name = "UNIT", value_parser = parse_unit, conflicts_with_all = ["rate", "mcap"])]
    pub unit: Vec<TimeUnit>,
    /// In place of a column of times: rows per second, the first row at 0
    #[arg(long, value_name = "HZ", value_parser = parse_rate, conflicts_with = "mcap")]
    pub rate: Option<f64>,
    /// An MCAP file with messages in JSON; its columns are called TOPIC.member, and TOPIC where that is `value` alone
    #[arg(long, value_name = "FILE")]
    pub mcap: Option<PathBuf>,
    /// What a column becomes: COLUMN=SIGNAL, COLUMN*0.001+0.5=SIGNAL, !COLUMN=SIGNAL, or COLUMN.3=SIGNAL for a bit
    ///
    /// May be given several times; FILE:COLUMN names the column of one file of several. Without any, columns that have a
    /// signal's name become that signal.
    #[arg(long = "map", value_name = "COLUMN=SIGNAL")]
    pub maps: Vec<Mapping>,
    /// Of a table with a row for each value: the column with the signal's name, which --map calls COLUMN
    #[arg(long, value_name = "COLUMN", requires = "value", conflicts_with = "mcap")]
    pub name: Option<String>,
    /// Of a table with a row for each value: the column with the value
    #[arg(long, value_name = "COLUMN", requires = "name")]
    pub value: Option<String>,
    /// The plant that the signals belong to: a folder, a plant's file, or a name of the catalogue (models/rig)
    #[arg(long, value_name = "MODEL")]
    pub model: Option<String>,
    /// Without a model: a signal that the automation sends; may be given several times
    #[arg(long = "command", value_name = "SIGNAL", conflicts_with = "model")]
    pub commands: Vec<String>,
    /// A word that stands in a cell where there is no value, such as NaN; may be given several times
    #[arg(long, value_name = "WORD")]
    pub missing: Vec<String>,
    /// Counts times from the first row
    #[arg(long)]
    pub from_zero: bool,
    /// The rows sample commands that moved on straight lines between them; without it, a command holds until the next row
    #[arg(long)]
    pub sampled: bool,
    /// Reports that another clock stamped than the one of the commands: NAME=SIGNAL,INSTANCE,…; may be given several times
    ///
    /// A data logger beside the PLC, say. A diagnosis then finds one offset and one drift for all that this clock stamped; the
    /// offset may be up to 3 s.
    #[arg(long = "clock", value_name = "NAME=SIGNAL,...", value_parser = parse_clock)]
    pub clocks: Vec<(String, Vec<String>)>,
    /// Who stood at the plant's end when it was recorded
    #[arg(long, value_name = "WHO", default_value = "plant")]
    pub source: SourceArgument,
    /// Free text for the trace's header [default: where it came from]
    #[arg(long, value_name = "TEXT")]
    pub note: Option<String>,
    /// The trace to write, compressed where its name ends with .zst
    #[arg(short, long, value_name = "TRACE")]
    pub output: PathBuf,
    /// Replaces the trace to write if there is one; without it, that is refused
    #[arg(long)]
    pub force: bool,
    /// Prints the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const IMPORT_HELP: &str = "\
Examples:
  kinetwin trace import --csv axis.csv --time t_ms --unit ms --model models/rig \\
      --map 'target_mm*0.001=Axis.positionTarget' --map 'actual_mm*0.001=Axis.position' -o axis.cps.jsonl
  kinetwin trace import --csv drive.csv --csv sensors.csv --time t --model models/rig \\
      --map 'v=Belt.velocityTarget' --map '!eye=Belt.lightBarrierA' --map 'status.3=Belt.isRunning' -o belt.cps.jsonl.zst
  kinetwin trace import --csv log.csv --time stamp --name tag --value value --model models/rig -o log.cps.jsonl
  kinetwin trace import --mcap run.mcap --model models/rig --map '/joint.position=Axis.position' -o run.cps.jsonl

Exit codes:
  0  the trace was written
  2  bad input or use; nothing was written";

/// Who stood at the plant's end.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SourceArgument {
    /// A real machine
    Plant,
    /// A simulation
    Simulation,
    /// Nobody knows
    Unknown,
}

/// Makes a table of a trace: CSV, or MCAP for any viewer of such files.
///
/// A CSV has a row for each line of the trace and a column for each signal, the times first, in seconds (t_s). An MCAP file
/// has a channel for each signal, with messages {\"value\": …} in JSON. Digits are kept, so that `trace import` makes the
/// same trace of it again. Connections, events and refused messages are left out.
#[derive(Debug, Args)]
#[command(after_long_help = EXPORT_HELP)]
pub struct ExportArguments {
    /// The trace: *.cps.jsonl, or compressed *.cps.jsonl.zst
    pub trace: PathBuf,
    /// The CSV file to write
    #[arg(long, value_name = "FILE", required_unless_present = "mcap", conflicts_with = "mcap")]
    pub csv: Option<PathBuf>,
    /// The MCAP file to write
    #[arg(long, value_name = "FILE")]
    pub mcap: Option<PathBuf>,
    /// The plant that the signals belong to: their types and units stand in the channels' metadata
    #[arg(long, value_name = "MODEL", conflicts_with = "csv")]
    pub model: Option<String>,
    /// Puts what the plant looks like beside the signals, as Foxglove draws it: frames, devices, parts
    ///
    /// The trace is replayed through the model; 30 pictures a second on /tf (foxglove.FrameTransforms), /scene and /parts
    /// (foxglove.SceneUpdate), with their schemas. Of a machine's trace the joints stand where they were measured.
    #[arg(long, requires_all = ["mcap", "model"])]
    pub scene: bool,
    /// Replaces the file to write if there is one; without it, that is refused
    #[arg(long)]
    pub force: bool,
    /// Prints the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const EXPORT_HELP: &str = "\
Examples:
  kinetwin trace export session.cps.jsonl --csv session.csv
  kinetwin trace export session.cps.jsonl.zst --mcap session.mcap --model models/rig --scene

Exit codes:
  0  the file was written
  2  bad input or use; nothing was written";

fn parse_unit(text: &str) -> Result<TimeUnit, String> {
    let unit = TimeUnit::ALL.into_iter().find(|(symbol, _)| *symbol == text).map(|(_, unit)| unit);
    unit.ok_or_else(|| format!("expected one of {}", TimeUnit::ALL.map(|(symbol, _)| symbol).join(", ")))
}

fn parse_clock(text: &str) -> Result<(String, Vec<String>), String> {
    let fields = text.split_once('=').filter(|(name, signals)| !name.is_empty() && !signals.is_empty());
    let (name, signals) = fields.ok_or_else(|| "expected NAME=SIGNAL, or NAME=SIGNAL,INSTANCE and so on".to_owned())?;
    let signals: Vec<String> = signals.split(',').map(|signal| signal.trim().to_owned()).collect();
    if signals.iter().any(String::is_empty) {
        return Err("a name between two commas is empty".to_owned());
    }
    Ok((name.to_owned(), signals))
}

fn parse_rate(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|rate: &f64| *rate > 0.0 && rate.is_finite())
        .ok_or_else(|| "expected rows per second, above 0".to_owned())
}

/// Makes a trace of tables.
pub fn import(arguments: &ImportArguments) -> Result<Answer, Failure> {
    let map = match &arguments.model {
        Some(model) => Some((*model::load(model)?.signal_map).clone()),
        None => None,
    };
    if let Some(map) = &map {
        check_clocks(map, &arguments.clocks)?;
    }
    let settings = Settings {
        maps: arguments.maps.clone(),
        signals: Signals { map, commands: arguments.commands.iter().cloned().collect() },
        missing: arguments.missing.clone(),
        from_zero: arguments.from_zero,
    };
    let inputs = arguments.csv.iter().chain(&arguments.mcap);
    let names: Vec<String> = inputs.map(|path| path.display().to_string()).collect();
    let header = Header {
        source: match arguments.source {
            SourceArgument::Plant => Source::Plant,
            SourceArgument::Simulation => Source::Simulation,
            SourceArgument::Unknown => Source::Unknown,
        },
        model: arguments.model.clone(),
        note: Some(arguments.note.clone().unwrap_or_else(|| format!("imported from {}", names.join(", ")))),
        commands: if arguments.sampled { Commands::Sampled } else { Commands::Held },
        clocks: arguments.clocks.iter().cloned().collect(),
        ..Header::default()
    };
    let tables = tables(arguments)?;
    let output = &arguments.output;
    let imported = write_whole(output, arguments.force, |file| {
        let writer = Writer::new(file, Compression::of(&output.to_string_lossy()), &header);
        let mut writer = writer.map_err(Failure::from)?;
        let imported = match &arguments.mcap {
            Some(path) => import::mcap(&path.display().to_string(), read(path)?, &settings, &mut writer),
            None => import::csv(tables, &shape(arguments), &settings, &mut writer),
        };
        let imported = imported.map_err(|error| Failure::of(&error))?;
        Ok((writer.finish()?, imported))
    })?;
    if arguments.json {
        words::answer_line(serde_json::to_string(&imported)?)?;
    } else {
        words::answer(imported_text(&imported, output))?;
    }
    Ok(Answer::Yes)
}

/// Whether every name of a clock is a report's, or an instance's.
fn check_clocks(map: &SignalMap, clocks: &[(String, Vec<String>)]) -> Result<(), Failure> {
    for (clock, names) in clocks {
        let is_there = |name: &String| {
            let mut reports = map.directed(Direction::Report);
            reports.any(|(_, signal)| signal.name == *name || signal.instance == *name)
        };
        if let Some(unknown) = names.iter().find(|name| !is_there(name)) {
            return Err(Failure(format!(
                "error: --clock {clock}: the model has neither a report nor an instance {unknown:?}; `kinetwin signals-map` lists them"
            )));
        }
    }
    Ok(())
}

fn shape(arguments: &ImportArguments) -> Shape {
    match (&arguments.name, &arguments.value) {
        (Some(name), Some(value)) => Shape::Long { name: name.clone(), value: value.clone() },
        _ => Shape::Wide,
    }
}

fn tables(arguments: &ImportArguments) -> Result<Vec<Table<BufReader<File>>>, Failure> {
    let files = arguments.csv.len();
    for (option, given) in [("--time", arguments.time.len()), ("--unit", arguments.unit.len())] {
        if given > 1 && given != files {
            return Err(Failure(format!(
                "error: {option} is given {given} times for {files} files: expected once, or once for each --csv"
            )));
        }
    }
    let mut tables = Vec::new();
    for (index, path) in arguments.csv.iter().enumerate() {
        let clock = match arguments.rate {
            Some(rate) => Clock::Rate(rate),
            None => Clock::Column {
                name: of_each(&arguments.time, index).cloned().unwrap_or_default(),
                unit: of_each(&arguments.unit, index).copied().unwrap_or_default(),
            },
        };
        tables.push(Table { file: path.display().to_string(), input: read(path)?, clock });
    }
    Ok(tables)
}

/// The one for all, or the one for this.
fn of_each<T>(given: &[T], index: usize) -> Option<&T> {
    if given.len() == 1 { given.first() } else { given.get(index) }
}

fn read(path: &Path) -> Result<BufReader<File>, Failure> {
    let fail = |error: std::io::Error| Failure(format!("error: failed to read {}: {error}", path.display()));
    let mut input = BufReader::with_capacity(1 << 16, File::open(path).map_err(fail)?);
    // A folder opens, and fails only when it is read.
    std::io::BufRead::fill_buf(input.by_ref()).map_err(fail)?;
    Ok(input)
}

fn imported_text(imported: &Imported, output: &Path) -> String {
    let Imported { rows, lines, begins_s, ends_s, .. } = imported;
    let mut out = format!("{}: {lines} lines of {rows} rows, {begins_s} s to {ends_s} s\n", output.display());
    let mut list = |what: &str, names: &[String]| {
        if !names.is_empty() {
            out.push_str(&format!("  {what:<16} {}\n", names.join(", ")));
        }
    };
    list("commands", &imported.commands);
    list("reports", &imported.reports);
    list("without a value", &imported.empty);
    list("columns unused", &imported.unused);
    out
}

/// Makes a table of a trace.
pub fn export(arguments: &ExportArguments) -> Result<Answer, Failure> {
    let (output, exported) = match (&arguments.csv, &arguments.mcap) {
        (Some(path), _) => (path, write_whole(path, arguments.force, |file| export_csv(arguments, file))?),
        (None, Some(path)) => (path, write_whole(path, arguments.force, |file| export_mcap(arguments, file))?),
        (None, None) => return Err(Failure("error: expected --csv FILE or --mcap FILE".to_owned())),
    };
    if arguments.json {
        words::answer_line(serde_json::to_string(&exported)?)?;
        return Ok(Answer::Yes);
    }
    let what = if arguments.csv.is_some() { "rows" } else { "messages" };
    words::answer_line(format_args!("{}: {} {what}", output.display(), exported.rows))?;
    if exported.skipped > 0 {
        words::answer_line(format_args!("  {} lines that hold no values were left out", exported.skipped))?;
    }
    Ok(Answer::Yes)
}

fn export_csv(arguments: &ExportArguments, mut file: Output) -> Result<(Output, Exported), Failure> {
    let info = trace::info(open(&arguments.trace)?).map_err(|error| Failure::of(&error))?;
    let exported = export::csv(open(&arguments.trace)?, &info, &mut file).map_err(|error| Failure::of(&error))?;
    Ok((file, exported))
}

fn export_mcap(arguments: &ExportArguments, file: Output) -> Result<(Output, Exported), Failure> {
    let plant = match &arguments.model {
        Some(model) => Some(model::load(model)?),
        None => None,
    };
    let map = plant.as_ref().map(|plant| &*plant.signal_map);
    let Some(plant) = plant.as_ref().filter(|_| arguments.scene) else {
        return export::mcap(open(&arguments.trace)?, map, file).map_err(|error| Failure::of(&error));
    };
    // Replayed before anything is written: a trace that the model cannot take leaves no file.
    let survey = Survey::of(&plant.signal_map, open(&arguments.trace)?).map_err(|error| Failure::of(&error))?;
    let header = survey.header();
    let step = header.step_ns.map_or(Options::STEP, Duration::from_nanos);
    let mut engine = model::engine(plant, step, header.seed.unwrap_or_default())?;
    engine.show(plant, Arc::new(Scene::of(plant)));
    let machine = match Seen::by_default(header.source) {
        Seen::Recorded => Some(Reported::read(&plant.signal_map, open(&arguments.trace)?)),
        Seen::Model => None,
    };
    let machine = machine.transpose().map_err(|error| Failure::of(&error))?;
    let mut pictures = 0;
    let mut refused = None;
    let replayed = open(&arguments.trace)?;
    let written = export::mcap_with(open(&arguments.trace)?, map, file, |writer| {
        let mut shown = Pictures::new(writer, machine)?;
        let mut failed = None;
        let watch = |engine: &mut Engine| failed = failed.take().or_else(|| shown.take(engine).err());
        let tolerances = Tolerances::default();
        refused = replay::watched(&mut engine, &plant.signal_map, &survey, replayed, &tolerances, watch).err();
        pictures = shown.written;
        failed.map_or(Ok(()), |error| Err(error.into()))
    });
    let (file, exported) = written.map_err(|error| Failure::of(&error))?;
    match refused {
        Some(error) => Err(Failure::of(&error)),
        None => Ok((file, Exported { rows: exported.rows + pictures, ..exported })),
    }
}
