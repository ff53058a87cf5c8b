//! `kinetwin gap locate`: which devices have a gap of their own.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use serde::Serialize;

use super::{Answer, Failure, words};
use crate::gap::{
    Beat, ClockOffset, Located, LocatedSignal, Location, Recording, Span, Study, Task, locate, read_mask, segments,
};
use crate::plant::Plant;
use crate::replay::{self, Survey, Tolerances};
use crate::run::{Options, model};
use crate::trace::Reader;

/// Says which devices of a model part from the recorded machine by themselves, and which only inherit what came to them.
///
/// Every device is driven alone by the recorded commands, at their exact times, and by what its neighbours reported; what it
/// reports then is compared with what was recorded. A level is off if it leaves what rounding, noise and the machine's own
/// tick explain; an edge if it lies outside of the reporting cycle that showed it. The cycle, the tick and the noise are found
/// in the traces themselves. A device that differs only in a replay of the whole plant inherits its gap: a late box makes every
/// later barrier late.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct LocateArguments {
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    #[arg(long, value_name = "MODEL")]
    pub model: String,
    /// A recording of the machine: *.cps.jsonl, or compressed *.cps.jsonl.zst; may be given several times
    #[arg(long = "trace", value_name = "TRACE", required = true, num_args = 1..)]
    pub traces: Vec<PathBuf>,
    /// Spans to leave out of every trace, or of one: lines FROM,TO in seconds since its start, and perhaps ,WHY
    ///
    /// For manual operation, jams and emergency stops, which are no evidence of how the machine works.
    #[arg(long, value_name = "[TRACE=]FILE")]
    pub mask: Vec<String>,
    /// Prints the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const HELP: &str = "\
Examples:
  kinetwin gap locate --model models/rig --trace machine.cps.jsonl.zst
  kinetwin gap locate --model ./my-plant --trace monday.cps.jsonl --trace tuesday.cps.jsonl --mask jams.csv --json

Columns:
  share    the device's part of all own gaps
  off by   RMS of the difference; of an edge, of how far it lies outside of the cycle that showed it
  floor    what that would be where nothing is wrong
  missing  recorded edges that the model does not make; extra: those that it alone makes
  evidence what a chance keeps below 17.8: the threshold that the greatest of 400 chances passes once in a hundred times

A trace whose header says \"commands\":\"sampled\" holds samples of references that moved on straight lines between them, as \
a logger's rows do; otherwise a command holds until the next. Signals that the model or the trace lacks are named and left out.

Exit codes:
  0  every device explains what it reported
  1  at least one has a gap of its own; each is named
  2  a trace, the mask or the model cannot be read";

/// What is printed as JSON.
#[derive(Serialize)]
struct Answered<'a> {
    recordings: Vec<Heard<'a>>,
    #[serde(flatten)]
    location: &'a Location,
}

/// What was found out about a recording.
#[derive(Serialize)]
struct Heard<'a> {
    trace: &'a str,
    ends_s: f64,
    /// The cycle in which levels were looked at; `None` where their stamps follow none.
    cycle_s: Option<f64>,
    /// How late the stamps are behind it.
    late_s: f64,
    /// The machine's own tick, 0 where none was found.
    tick_s: f64,
    /// What its task does to all devices alike.
    task: Task,
    /// Signals of the model that it does not hold.
    absent: &'a [String],
    /// Signals that were left out, and why.
    ignored: &'a BTreeMap<String, String>,
    /// How far clocks beside that of the commands are off.
    clocks: &'a [ClockOffset],
    /// What was left out beside that, and how often.
    notices: &'a BTreeMap<String, u64>,
    torn: Option<&'a str>,
}

/// Does what was asked.
pub fn run(arguments: &LocateArguments) -> Result<Answer, Failure> {
    let plant = model::load(&arguments.model)?;
    let masks = Masks::read(&arguments.mask, &arguments.traces.iter().collect::<Vec<_>>())?;
    let mut recordings = Vec::new();
    for path in &arguments.traces {
        let recording = Recording::read(&plant, &path.to_string_lossy(), open(path)?, &masks.of(path));
        recordings.extend(segments(&plant, recording.map_err(|error| Failure::of(&error))?));
    }
    let study = Study::new(&plant, &recordings).map_err(|error| Failure::of(&error))?;
    let mut location = locate(&study);
    if let ([path], [recording]) = (arguments.traces.as_slice(), recordings.as_slice()) {
        location.inherit(&whole(&plant, path, recording, &study)?);
    }
    let heard: Vec<Heard<'_>> =
        recordings.iter().enumerate().map(|(at, recording)| heard(at, recording, &study)).collect();
    if arguments.json {
        words::answer_line(serde_json::to_string(&Answered { recordings: heard, location: &location })?)?;
    } else {
        words::answer(text(&heard, &location))?;
    }
    Ok(if location.devices.iter().any(|device| device.own) { Answer::No } else { Answer::Yes })
}

pub(super) fn open(path: &Path) -> Result<Reader<BufReader<File>>, Failure> {
    let file = File::open(path)
        .map_err(|error| Failure(format!("error: failed to read the trace {}: {error}", path.display())))?;
    Reader::new(path.to_string_lossy(), BufReader::with_capacity(1 << 16, file)).map_err(|error| Failure::of(&error))
}

fn masks(path: &Path) -> Result<Vec<Span>, Failure> {
    let fail =
        |error: &dyn std::fmt::Display| Failure(format!("error: failed to read the mask {}: {error}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| fail(&error))?;
    read_mask(&text).map_err(|error| fail(&error))
}

/// Spans to leave out: of every trace, or of the one that is named.
#[derive(Default)]
pub(super) struct Masks {
    of_all: Vec<Span>,
    of_one: Vec<(PathBuf, Vec<Span>)>,
}

impl Masks {
    /// Reads `[TRACE=]FILE`, each of them; a trace that is named has to be among `traces`.
    pub fn read(asked: &[String], traces: &[&PathBuf]) -> Result<Masks, Failure> {
        let mut all = Masks::default();
        for asked in asked {
            match asked.split_once('=') {
                // A file's own name may hold the sign.
                Some((trace, file)) if !Path::new(asked).exists() => {
                    if !traces.iter().any(|path| *path == Path::new(trace)) {
                        let known: Vec<_> = traces.iter().map(|path| path.display().to_string()).collect();
                        return Err(Failure(format!(
                            "error: --mask {asked}: {trace:?} is none of the traces; expected one of {}, or a file for all of them",
                            known.join(", ")
                        )));
                    }
                    all.of_one.push((trace.into(), masks(Path::new(file))?));
                }
                _ => all.of_all.extend(masks(Path::new(asked))?),
            }
        }
        Ok(all)
    }

    /// The spans to leave out of a trace.
    pub fn of(&self, trace: &Path) -> Vec<Span> {
        let own = self.of_one.iter().filter(|(path, _)| path == trace).flat_map(|(_, spans)| spans);
        self.of_all.iter().chain(own).copied().collect()
    }
}

/// The whole plant under the same commands.
fn whole(plant: &Plant, path: &Path, recording: &Recording, study: &Study) -> Result<replay::Report, Failure> {
    let survey = Survey::of(&plant.signal_map, open(path)?).map_err(|error| Failure::of(&error))?;
    let seed = recording.header.seed.unwrap_or_default();
    let mut engine = model::engine(plant, Options::STEP, seed)?;
    let grid = &study.grids[0].main[Beat::Edges as usize];
    // An edge may lie anywhere in its cycle, and its stamp behind that.
    let edge = Duration::from_secs_f64(grid.cycle + 4.0 * grid.lateness + 2e-3);
    let tolerances = Tolerances { edge, ..Tolerances::default() };
    replay::run(&mut engine, &plant.signal_map, &survey, open(path)?, &tolerances).map_err(|error| Failure::of(&error))
}

fn heard<'a>(at: usize, recording: &'a Recording, study: &'a Study) -> Heard<'a> {
    let grid = &study.grids[at].main[Beat::Fast as usize];
    Heard {
        trace: &recording.name,
        ends_s: recording.ends,
        cycle_s: Some(grid.cycle).filter(|_| grid.is_rebuilt),
        late_s: grid.lateness,
        tick_s: study.ticks[at],
        task: study.tasks[at],
        absent: &recording.absent,
        ignored: &recording.ignored,
        clocks: &study.clocks[at],
        notices: &recording.notices,
        torn: recording.torn.as_deref(),
    }
}

fn text(heard: &[Heard<'_>], location: &Location) -> String {
    let mut out = String::new();
    for recording in heard {
        out.push_str(&heard_text(recording));
    }
    let (own, rest): (Vec<&Located>, Vec<&Located>) = location.devices.iter().partition(|device| device.own);
    if own.is_empty() {
        out.push_str("no device has a gap of its own\n");
    } else {
        out.push_str(&own_text(&own));
    }
    let named = |wanted: bool| {
        let names = rest.iter().filter(|device| (device.inherited == Some(true)) == wanted);
        names.map(|device| device.device.as_str()).collect::<Vec<_>>().join(", ")
    };
    for (what, names) in [("inherited", named(true)), ("explained", named(false))] {
        if !names.is_empty() {
            out.push_str(&format!("{what}: {names}\n"));
        }
    }
    out
}

fn heard_text(recording: &Heard<'_>) -> String {
    let cycle = recording.cycle_s.map_or("no cycle".to_owned(), |cycle| format!("cycle {:.4} ms", 1e3 * cycle));
    let tick = if recording.tick_s > 0.0 { format!("{} ms", 1e3 * recording.tick_s) } else { "none".to_owned() };
    let mut out = format!(
        "{}: {:.3} s, {cycle}, stamps {:.3} ms late, tick {tick}\n",
        recording.trace,
        recording.ends_s,
        1e3 * recording.late_s
    );
    let mut note = |line: String| out.push_str(&format!("  {line}\n"));
    if !recording.absent.is_empty() {
        note(format!("not in the trace: {}", recording.absent.join(", ")));
    }
    for (signal, reason) in recording.ignored {
        note(format!("left out: {signal}: {reason}"));
    }
    for (notice, count) in recording.notices {
        note(format!("{notice} ({count} times)"));
    }
    let Task { every_s, phase_s, age_s, filter_s, scatter_s } = recording.task;
    let task = format!("a task every {:.1} ms from {:.2} ms on", 1e3 * every_s, 1e3 * phase_s);
    let age = format!("reports {:.2} ms old", 1e3 * age_s);
    let filter = format!("flags filtered {:.1} ms", 1e3 * filter_s);
    let scatter = format!("commands {:.3} ms sooner or later than their stamps say", 1e3 * scatter_s);
    let common = [(every_s, task), (age_s, age), (filter_s, filter), (scatter_s, scatter)];
    let common: Vec<String> = common.into_iter().filter(|(span, _)| *span > 0.0).map(|(_, words)| words).collect();
    if !common.is_empty() {
        note(format!("common to all devices: {}", common.join(", ")));
    }
    for clock in recording.clocks {
        note(format!(
            "clock {}: {:+.4} s, {:+.1} ppm of drift, stamps {}",
            clock.name,
            clock.offset_s,
            1e6 * clock.drift,
            words::counted(clock.devices, "device", "devices")
        ));
    }
    if let Some(torn) = recording.torn {
        note(torn.to_owned());
    }
    out
}

fn own_text(own: &[&Located]) -> String {
    let wide = own.iter().flat_map(|device| &device.signals).map(|signal| signal.name.len()).max().unwrap_or(0).max(6);
    let mut out = format!(
        "\n{:>5}  {:wide$}  {:>5}  {:>15}  {:>15}  {:>7}  {:>5}  {:>9}\n",
        "share", "signal", "kind", "off by", "floor", "missing", "extra", "evidence"
    );
    for device in own {
        let signals: Vec<&LocatedSignal> = device.signals.iter().filter(|signal| signal.is_off()).collect();
        for (at, signal) in signals.iter().enumerate() {
            let share = if at == 0 { format!("{:.0} %", 100.0 * device.share) } else { String::new() };
            let off = |value: f64| format!("{value:.3e} {}", signal.unit);
            out.push_str(&format!(
                "{share:>5}  {:wide$}  {:>5}  {:>15}  {:>15}  {:>7}  {:>5}  {:>9.1}\n",
                signal.name,
                signal.kind,
                off(signal.before),
                off(signal.floor),
                signal.missing,
                signal.extra,
                signal.evidence
            ));
        }
        let regimes = device.regimes.iter().map(|regime| format!("{} {:.0} %", regime.when, 100.0 * regime.share));
        let regimes = regimes.collect::<Vec<_>>().join(", ");
        if !regimes.is_empty() {
            out.push_str(&format!("{:>5}  {}: {regimes}\n", "", device.device));
        }
    }
    out.push('\n');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mask_is_for_all_traces_or_for_the_one_it_names() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).expect("a file");
            path.display().to_string()
        };
        let (all, one) = (file("all.csv", "1,2,a jam\n"), file("a=b.csv", "5,7\n"));
        let traces = [PathBuf::from("mon.cps.jsonl"), PathBuf::from("tue.cps.jsonl")];
        let known: Vec<&PathBuf> = traces.iter().collect();
        let read = |asked: &[&str]| {
            let asked: Vec<String> = asked.iter().map(|asked| (*asked).to_owned()).collect();
            Masks::read(&asked, &known).map_err(|failure| failure.0)
        };
        let spans = |masks: &Masks, at: usize| masks.of(&traces[at]).iter().map(|span| span.from).collect::<Vec<_>>();
        let masks = read(&[&all, &format!("tue.cps.jsonl={one}")]).expect("masks");
        assert_eq!((spans(&masks, 0), spans(&masks, 1)), (vec![1.0], vec![1.0, 5.0]));
        let for_all = read(&[&one]).expect("a file whose own name holds the sign");
        assert_eq!(spans(&for_all, 0), [5.0]);
        let wrong = read(&[&format!("wed.cps.jsonl={all}")]).err().expect("no such trace");
        assert!(
            wrong.contains("\"wed.cps.jsonl\" is none of the traces; expected one of mon.cps.jsonl, tue"),
            "{wrong}"
        );
        let absent = read(&["mon.cps.jsonl=nowhere.csv"]).err().expect("no such file");
        assert!(absent.contains("failed to read the mask nowhere.csv"), "{absent}");
    }
}
