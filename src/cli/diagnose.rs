//! `kinetwin gap diagnose`: where the gap is, which effect causes it, and how far it shrinks.

use std::collections::BTreeSet;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::locate::{Masks, open};
use super::output::write_whole;
use super::signals::Interruption;
use super::{Answer, Failure, words};
use crate::effect;
use crate::gap::cause::Progress;
use crate::gap::diagnosis::{self, Diagnosis, Options, Split};
use crate::gap::page::page;
use crate::gap::production::{self, Counters, Observation};
use crate::gap::report::{Consequence, MadeFrom, NotTestable, Report, Verdict};
use crate::gap::{Recording, effects_xml, segments};
use crate::plant::{ModelError, Plant, effects_file};
use crate::run::{self, Stop, model, observe};
use crate::trace;

/// Says where the model parts from the machine, which unmodelled effect causes it, and how far the gap shrinks with it.
///
/// Every device is looked at alone, driven by the recorded commands. What its reports hold above their noise is explained by
/// as few effects of the library as are worth having; the held-out traces are opened once, when all is fixed.
/// Ctrl-C ends with the best answer so far, marked incomplete.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct DiagnoseArguments {
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue
    #[arg(long, value_name = "MODEL")]
    pub model: String,
    /// Recordings of the machine to learn from
    ///
    /// One whose header names another plant's file in the model's folder is taken to be of the machine set up as that file has
    /// it: recordings at several settings are fitted together.
    #[arg(long, value_name = "TRACE", num_args = 1.., required = true)]
    pub train: Vec<PathBuf>,
    /// Recordings that no fit sees, to measure on; without any, spans of the training are kept back
    #[arg(long, value_name = "TRACE", num_args = 1..)]
    pub holdout: Vec<PathBuf>,
    /// The effects to look for, by their ids [default: all]
    #[arg(long, value_name = "ID", value_delimiter = ',')]
    pub effects: Vec<String>,
    /// The devices to look at, by their instances' names [default: all]
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub devices: Vec<String>,
    /// Spans to leave out of every trace, or of one: lines FROM,TO in seconds since its start, and perhaps ,WHY
    ///
    /// For manual operation, jams and emergency stops, which are no evidence of how the machine works.
    #[arg(long, value_name = "[TRACE=]FILE")]
    pub mask: Vec<String>,
    /// Ends after this long with the best answer so far, marked incomplete; what was begun by then is brought to its end
    #[arg(long, value_name = "TIME", value_parser = crate::time::parse_duration)]
    pub within: Option<Duration>,
    /// The folder for report.json, report.html and effects.xml; what stands there under these names is replaced
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Prints the report as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const HELP: &str = "\
Examples:
  kinetwin gap diagnose --model models/rig --train monday.cps.jsonl.zst --holdout tuesday.cps.jsonl.zst --out gap
  kinetwin gap diagnose --model models/rig --train monday.cps.jsonl --devices Robot,Belt --effects dead-time,backlash --out gap

Exit codes:
  0  a verdict was given, whatever it is
  2  bad input or use";

/// Does what was asked.
pub fn run(arguments: &DiagnoseArguments) -> Result<Answer, Failure> {
    let started = Instant::now();
    let plant = model::load(&arguments.model)?;
    let effects = asked(&arguments.effects)?;
    let devices = meant(&plant, &arguments.devices)?;
    let traces: Vec<&PathBuf> = arguments.train.iter().chain(&arguments.holdout).collect();
    let masks = Masks::read(&arguments.mask, &traces)?;
    let read = |paths: &[PathBuf]| {
        let recording = |path: &PathBuf| {
            let recording = Recording::read(&plant, &path.to_string_lossy(), open(path)?, &masks.of(path));
            let mut recording = recording.map_err(|error| Failure::of(&error))?;
            set_up(&mut recording, &plant, &arguments.model)?;
            Ok(segments(&plant, recording))
        };
        let of_each = paths.iter().map(recording).collect::<Result<Vec<_>, Failure>>();
        of_each.map(|of_each| of_each.concat())
    };
    let (train, holdout) = (read(&arguments.train)?, read(&arguments.holdout)?);
    let recorded = train.iter().max_by(|a, b| a.ends.total_cmp(&b.ends)).cloned();
    let Split { train, held_out } = match holdout.is_empty() {
        true => diagnosis::kept_back(&train),
        false => Split { train, held_out: holdout },
    };
    std::fs::create_dir_all(&arguments.out)
        .map_err(|error| Failure(format!("error: failed to make the folder {}: {error}", arguments.out.display())))?;
    let stop = Stop::default();
    let interruption = Interruption::watch(stop)?;
    let bar = progress_bar();
    let options = Options {
        is_asked: &|id| effects.as_ref().is_none_or(|asked| asked.iter().any(|effect| effect == id)),
        is_meant: &|name| devices.as_ref().is_none_or(|meant| meant.iter().any(|device| device == name)),
        is_stopped: &|| interruption.is_asked() || arguments.within.is_some_and(|within| started.elapsed() > within),
        tell: &|progress| show(&bar, progress),
    };
    let mut answer = diagnosis::diagnose(&plant, &train, &held_out, &options).map_err(|error| Failure::of(&error))?;
    bar.finish_and_clear();
    if let Some(recorded) = recorded {
        answer.report.consequence = consequence(&plant, &answer.report, &recorded)?;
    }
    answer.report.left_out.iter().for_each(|words| words::tell(format_args!("warning: {words}")));
    let is_meant = |name: &str| devices.as_ref().is_none_or(|meant| meant.iter().any(|device| device == name));
    let not_excited = not_excited(&plant, &answer.report, &arguments.train, &is_meant)?;
    answer.report.not_testable.extend(not_excited);
    write(&plant, arguments, answer)
}

/// A machine's recording says which model it is of. Where that is another plant's file in the folder of the model that is
/// diagnosed, the machine was set up as that file has it: one device at several settings.
fn set_up(recording: &mut Recording, plant: &Plant, model: &str) -> Result<(), Failure> {
    let named = recording.header.model.clone().filter(|_| recording.header.source == trace::Source::Plant);
    if let Some(variant) = named.filter(|named| named != model && folder(named) == folder(model)) {
        recording.set_up_as(plant, &model::load(&variant)?);
    }
    Ok(())
}

/// The folder of a model.
fn folder(model: &str) -> &str {
    let path = Path::new(model);
    let parent = path.extension().and_then(|_| path.parent()).and_then(Path::to_str);
    parent.unwrap_or(model).trim_end_matches('/')
}

/// Effects that no training trace excites, of the devices with a gap; of all devices where none has one: what a `no-gap` does not
/// speak of.
fn not_excited(
    plant: &Plant,
    report: &Report,
    train: &[PathBuf],
    is_meant: &dyn Fn(&str) -> bool,
) -> Result<Vec<NotTestable>, Failure> {
    let mut lacks: Option<BTreeSet<(String, &'static str, &'static str)>> = None;
    for path in train {
        let info = trace::info(open(path)?).map_err(|error| Failure::of(&error))?;
        let motions = trace::motions(open(path)?, &info).map_err(|error| Failure::of(&error))?;
        let devices = trace::excitations(plant, &info, &motions);
        let here = devices
            .iter()
            .flat_map(|device| device.lacks.iter().map(|(effect, needs)| (device.device.clone(), *effect, *needs)));
        let here: BTreeSet<_> = here.collect();
        lacks = Some(lacks.map_or(here.clone(), |all| all.intersection(&here).cloned().collect()));
    }
    let has_gap = |device: &str| report.devices.is_empty() || report.devices.iter().any(|gap| gap.device == device);
    let is_asked = |device: &str| is_meant(device) && has_gap(device);
    let lacks = lacks.unwrap_or_default().into_iter().filter(|(device, _, _)| is_asked(device));
    let entry = |(device, effect, needs): (String, &str, &str)| NotTestable {
        device: Some(device),
        effect: Some(effect.to_owned()),
        reason: "the training does not excite it".to_owned(),
        needs: needs.to_owned(),
        ..NotTestable::default()
    };
    Ok(lacks.map(entry).collect())
}

/// The longest span of simulated time over which production is compared.
const LONGEST_PRODUCTION_S: f64 = 600.0;

/// What the causes of `report` mean for production: the model runs with its automation, without and with them, as long as the
/// machine was recorded. `None` without a cause, or where the machine was driven by another automation.
fn consequence(plant: &Plant, report: &Report, recorded: &Recording) -> Result<Option<Consequence>, Failure> {
    let Some(text) = effects_xml(report, &plant.name) else { return Ok(None) };
    let counters = Counters::of(plant);
    let span = recorded.ends.min(LONGEST_PRODUCTION_S);
    let seed = recorded.header.seed.unwrap_or_default();
    let run = |plant: &Plant| {
        observe(plant.clone(), Duration::from_secs_f64(span), seed, run::Options::STEP).map_err(Failure::from)
    };
    let recorded = Observation::of(plant, recorded, span);
    let before = run(plant)?;
    if !production::is_driven_alike(&recorded, &before) {
        return Ok(None);
    }
    let mut corrected = plant.clone();
    let added = effects_file::read("effects.xml", &text).map_err(ModelError::Faulty)?.effects;
    for addition in added {
        let named = corrected.instances.iter_mut().find(|instance| instance.name == addition.instance.value);
        named.into_iter().for_each(|instance| instance.effects.push(addition.effect.clone()));
    }
    Ok(production::consequence(&counters, &recorded, &before, &run(&corrected)?))
}

/// The effects to look for; `None` for all.
fn asked(list: &[String]) -> Result<Option<Vec<String>>, Failure> {
    if list.is_empty() || list.iter().any(|id| id == "all") {
        return Ok(None);
    }
    match list.iter().find(|id| effect::named(id).is_none()) {
        Some(unknown) => Err(Failure(format!(
            "error: --effects: there is no effect {unknown:?}; `kinetwin gap diagnose --effects all` tries every one"
        ))),
        None => Ok(Some(list.to_vec())),
    }
}

/// The devices to look at; `None` for all.
fn meant(plant: &Plant, list: &[String]) -> Result<Option<Vec<String>>, Failure> {
    let is_there = |name: &&String| plant.instances.iter().any(|instance| instance.name == **name);
    match list.iter().find(|name| !is_there(name)) {
        Some(unknown) => {
            let names: Vec<&str> = plant.instances.iter().map(|instance| instance.name.as_str()).collect();
            Err(Failure(format!("error: --devices: the model has no {unknown:?}; it has {}", names.join(", "))))
        }
        None => Ok(Some(list.to_vec()).filter(|list| !list.is_empty() && list.iter().all(|name| name != "all"))),
    }
}

fn progress_bar() -> ProgressBar {
    let target =
        if std::io::stderr().is_terminal() { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
    let style = ProgressStyle::with_template("{prefix:12} {bar:30} {pos:>4}/{len:4} candidates, {eta} left  {msg}");
    let bar = ProgressBar::with_draw_target(Some(0), target);
    // The template is a constant; were it faulty, the plain bar would do.
    style.map_or(bar.clone(), |style| bar.with_style(style))
}

fn show(bar: &ProgressBar, progress: &Progress) {
    if bar.prefix() != progress.device {
        bar.reset_eta();
        bar.set_prefix(progress.device.clone());
    }
    bar.set_length(progress.of as u64);
    bar.set_position(progress.tried as u64);
    bar.set_message(format!("best: {}", progress.best));
}

fn write(plant: &Plant, arguments: &DiagnoseArguments, answer: Diagnosis) -> Result<Answer, Failure> {
    let evidence = answer.evidence(plant).map_err(|error| Failure::of(&error))?;
    let Diagnosis { mut report, .. } = answer;
    let paths = |paths: &[PathBuf]| paths.iter().map(|path| path.display().to_string()).collect();
    report.made_from = Some(MadeFrom {
        model: arguments.model.clone(),
        train: paths(&arguments.train),
        holdout: paths(&arguments.holdout),
        mask: (!arguments.mask.is_empty()).then(|| arguments.mask.join(", ")),
    });
    let effects = effects_xml(&report, &plant.name);
    let none =
        || effects_file::write(&plant.name, &[], &format!("A diagnosis found nothing to add ({}).", report.verdict));
    put(arguments, "report.json", &report.to_json())?;
    put(arguments, "report.html", &page(&report, &evidence))?;
    put(arguments, "effects.xml", &effects.unwrap_or_else(none))?;
    if arguments.json {
        words::answer_line(serde_json::to_string(&report)?)?;
    } else {
        words::answer(summary(&report))?;
    }
    Ok(Answer::Yes)
}

fn put(arguments: &DiagnoseArguments, name: &str, text: &str) -> Result<(), Failure> {
    write_whole(&arguments.out.join(name), true, |mut file| {
        file.write_all(text.as_bytes())?;
        Ok((file, ()))
    })
}

/// The answer in some lines.
fn summary(report: &Report) -> String {
    let said = report.answer();
    let mut text = format!("verdict  {}{}\n", report.verdict, if report.incomplete { " (incomplete)" } else { "" });
    for (name, sentence) in [("where", said.place), ("which", said.cause), ("how far", said.shrink)] {
        text.push_str(&format!("{name:7}  {sentence}\n"));
    }
    // Of a verdict of its own this is said already; what no effect names holds for all of them.
    let untold = report.not_testable.iter().filter(|entry| entry.effect.is_none());
    for entry in untold.filter(|_| report.verdict != Verdict::NotTestable) {
        let device = entry.device.as_ref().map(|device| format!("{device}: ")).unwrap_or_default();
        text.push_str(&format!("untold   {device}{}; needed: {}.\n", entry.reason, entry.needs));
    }
    text
}
