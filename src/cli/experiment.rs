//! `kinetwin gap plan`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::locate::open;
use super::output::write_whole;
use super::words::{answer, answer_line};
use super::{Answer, Failure};
use crate::gap::Recording;
use crate::gap::plan::bounds::Bounds;
use crate::gap::plan::{Experiment, Separation, plan as make};
use crate::gap::report::{Member, Report};
use crate::plant::Plant;
use crate::run::model;
use crate::signal_map::{Direction, RegisterId};
use crate::trace::Compression;

/// Writes the experiment that would tell a report's rivals apart.
///
/// Motions of several kinds are tried on the model with the cause and with each rival, within what the machine may be asked:
/// what --bounds says, else what the signals declare, else what the recordings asked of it. The one that tells most is
/// written as a trace of commands, which nxt-mock --trace plays; record the machine while it does, and diagnose again.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct ExperimentArguments {
    /// The plant that was diagnosed: a folder with a plant.xml, a plant's file, or a name of the catalogue
    #[arg(long, value_name = "MODEL")]
    pub model: String,
    /// The report.json of the diagnosis
    #[arg(long, value_name = "FILE")]
    pub report: PathBuf,
    /// The recordings that it was made from [default: those that the report names]
    #[arg(long, value_name = "TRACE", num_args = 1..)]
    pub trace: Vec<PathBuf>,
    /// What a command may be asked, in its own unit: SIGNAL=LEAST..GREATEST[,SPEED[,ACCELERATION]]
    #[arg(long, value_name = "BOUNDS", value_parser = parse_within)]
    pub bounds: Vec<Within>,
    /// The trace to write, compressed where its name ends with .zst
    #[arg(short, long, value_name = "TRACE")]
    pub output: PathBuf,
    /// Replaces the trace to write if there is one; without it, that is refused
    #[arg(long)]
    pub force: bool,
    /// Prints the plan as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const HELP: &str = "\
Examples:
  kinetwin gap plan --model models/rig --report gap/report.json -o experiment.cps.jsonl
  kinetwin gap plan --model models/rig --report gap/report.json --bounds Axis.positionTarget=0..0.4,0.5,2 -o experiment.cps.jsonl

Exit codes:
  0  the experiment tells every rival from the cause (power 0.95 at an error of 1 %)
  1  it is the best there is within the bounds, and some rival is not told apart; each is named
  2  bad input or use";

/// What a command may be asked, as `--bounds` says it; in the unit of the signal.
#[derive(Clone, Debug, PartialEq)]
pub struct Within {
    pub signal: String,
    pub least: f64,
    pub greatest: f64,
    pub speed: Option<f64>,
    pub acceleration: Option<f64>,
}

fn parse_within(text: &str) -> Result<Within, String> {
    let parsed = || {
        let (signal, bounds) = text.split_once('=')?;
        let mut parts = bounds.split(',');
        let (least, greatest) = parts.next()?.split_once("..")?;
        let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        let (least, greatest) = (number(least)?, number(greatest)?);
        let mut positive = || match parts.next() {
            None => Some(None),
            Some(text) => number(text).filter(|number| *number > 0.0).map(Some),
        };
        let (speed, acceleration) = (positive()?, positive()?);
        let is_whole = parts.next().is_none() && least < greatest && !signal.is_empty();
        is_whole.then(|| Within { signal: signal.to_owned(), least, greatest, speed, acceleration })
    };
    parsed().ok_or_else(|| {
        "expected SIGNAL=LEAST..GREATEST[,SPEED[,ACCELERATION]], as Axis.positionTarget=0..0.4,0.5,2".to_owned()
    })
}

/// Power from which on two causes are told apart.
const TELLS: f64 = 0.95;

/// Writes the experiment that would tell a report's rivals apart.
pub fn run(arguments: &ExperimentArguments) -> Result<Answer, Failure> {
    let plant = model::load(&arguments.model)?;
    let name = arguments.report.display();
    let text = std::fs::read_to_string(&arguments.report)
        .map_err(|error| Failure(format!("error: failed to read the report {name}: {error}")))?;
    let report = Report::from_json(&arguments.report, &text).map_err(|error| Failure::of(&error))?;
    let traces = traces(arguments, &report)?;
    let read = |path: &PathBuf| {
        let recording = Recording::read(&plant, &path.to_string_lossy(), open(path)?, &[]);
        recording.map_err(|error| Failure::of(&error))
    };
    let recordings = traces.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let declared = declared(&plant, &arguments.bounds)?;
    let experiment = make(&plant, &report, &recordings, &declared).map_err(|error| Failure::of(&error))?;
    let output = arguments.output.display().to_string();
    write_whole(&arguments.output, arguments.force, |file| {
        let written = experiment.write(&plant.signal_map, &arguments.model, file, Compression::of(&output));
        let file = written.map_err(|error| Failure(format!("error: failed to write {output}: {error}")))?;
        Ok((file, ()))
    })?;
    if arguments.json {
        answer_line(serde_json::to_string(&Planned::of(&experiment))?)?;
    } else {
        answer(words(&experiment, &output))?;
    }
    Ok(if experiment.separations.iter().all(|separation| separation.power >= TELLS) { Answer::Yes } else { Answer::No })
}

/// The recordings that the report was made from, unless others are given.
fn traces(arguments: &ExperimentArguments, report: &Report) -> Result<Vec<PathBuf>, Failure> {
    if !arguments.trace.is_empty() {
        return Ok(arguments.trace.clone());
    }
    let made_from = report.made_from.as_ref().map(|from| from.train.iter().map(PathBuf::from).collect::<Vec<_>>());
    made_from.filter(|traces| !traces.is_empty()).ok_or_else(|| {
        let name = arguments.report.display();
        Failure(format!("error: {name} does not say which recordings it was made from: name them with --trace"))
    })
}

/// The bounds on the command line, by register; in SI.
fn declared(plant: &Plant, bounds: &[Within]) -> Result<BTreeMap<RegisterId, Bounds>, Failure> {
    let of = |within: &Within| {
        let register = plant.signal_map.register(&within.signal);
        let command = register.filter(|register| plant.signal_map.signal(*register).direction == Direction::Command);
        let Some(register) = command else {
            return Err(Failure(format!("error: --bounds: the model has no command {:?}", within.signal)));
        };
        let si = plant.signal_map.signal(register).unit.to_si;
        let Within { least, greatest, speed, acceleration, .. } = *within;
        let bounds = Bounds {
            least: least * si,
            greatest: greatest * si,
            speed: speed.map_or(f64::INFINITY, |speed| speed * si),
            acceleration: acceleration.map_or(f64::INFINITY, |acceleration| acceleration * si),
        };
        Ok((register, bounds))
    };
    bounds.iter().map(of).collect()
}

/// The plan, as `--json` prints it.
#[derive(Serialize)]
struct Planned<'a> {
    motions: &'a [&'static str],
    span_s: f64,
    lines: usize,
    separations: Vec<Told>,
}

/// A separation, as `--json` prints it.
#[derive(Serialize)]
struct Told {
    cause: Member,
    rival: Member,
    distance: f64,
    power: f64,
}

impl Planned<'_> {
    fn of(experiment: &Experiment) -> Planned<'_> {
        let told = |it: &Separation| Told {
            cause: it.cause.clone(),
            rival: it.rival.clone(),
            distance: it.distance,
            power: it.power,
        };
        Planned {
            motions: &experiment.motions,
            span_s: experiment.span_s,
            lines: experiment.lines.len(),
            separations: experiment.separations.iter().map(told).collect(),
        }
    }
}

fn words(experiment: &Experiment, output: &str) -> String {
    let mut text = format!("{output}: {:.0} s of {}\n", experiment.span_s, experiment.motions.join(", then "));
    for Separation { cause, rival, power, .. } in &experiment.separations {
        let verdict = if *power >= TELLS { "told apart" } else { "NOT told apart by any motion within the bounds" };
        text.push_str(&format!("{} from {}: {verdict}, power {power:.2}\n", title(cause), title(rival)));
    }
    text
}

fn title(member: &Member) -> String {
    let of = member.component.as_ref().map(|name| format!(".{name}")).unwrap_or_default();
    format!("{}{of} {} ({})", member.device, member.effect, member.place.name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_read_as_they_are_said() {
        let within = parse_within("Axis.positionTarget=-0.1..0.4,0.5,2").expect("bounds");
        assert_eq!(
            (within.least, within.greatest, within.speed, within.acceleration),
            (-0.1, 0.4, Some(0.5), Some(2.0))
        );
        assert_eq!(parse_within("A.b=0..1").expect("bounds").speed, None);
        for text in ["", "A.b", "A.b=1", "A.b=1..0", "A.b=0..x", "=0..1", "A.b=0..1,0", "A.b=0..1,1,1,1", "A.b=0..inf"]
        {
            assert!(parse_within(text).is_err(), "{text}");
        }
    }
}
