//! `kinetwin trace info`.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Serialize;

use super::arguments::InfoArguments;
use super::replay::open;
use super::{Answer, Failure, words};
use crate::gap::report::number::significant;
use crate::plant::Plant;
use crate::run::model;
use crate::trace::{self, Excitation, Info, Motion};

/// All that is known of a trace, as `--json` prints it.
#[derive(Serialize)]
struct Known {
    #[serde(flatten)]
    info: Info,
    /// By signal: of numbers that change.
    motion: BTreeMap<String, Motion>,
    /// By device, where a model was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    devices: Option<Vec<Excitation>>,
    /// Signals that the model does not have.
    #[serde(skip_serializing_if = "Option::is_none")]
    unknown: Option<Vec<String>>,
}

/// Says what stands in a trace.
pub fn info(arguments: &InfoArguments) -> Result<Answer, Failure> {
    let plant = arguments.model.as_deref().map(model::load).transpose()?;
    let info = trace::info(open(&arguments.trace)?).map_err(|error| Failure::of(&error))?;
    let motion = trace::motions(open(&arguments.trace)?, &info).map_err(|error| Failure::of(&error))?;
    let devices = plant.as_ref().map(|plant| trace::excitations(plant, &info, &motion));
    let unknown = plant.as_ref().map(|plant| unknown(plant, &info));
    let known = Known { info, motion, devices, unknown };
    if arguments.json {
        words::answer_line(serde_json::to_string(&known)?)?;
    } else {
        words::answer(text(&known, plant.as_ref()))?;
    }
    Ok(Answer::Yes)
}

fn unknown(plant: &Plant, info: &Info) -> Vec<String> {
    info.signals.keys().filter(|name| plant.signal_map.register(name).is_none()).cloned().collect()
}

fn text(known: &Known, plant: Option<&Plant>) -> String {
    let mut out = about(&known.info);
    out.push_str(&signals(known, plant));
    for device in known.devices.iter().flatten() {
        out.push_str(&excitation(device));
    }
    let unknown = known.unknown.iter().flatten().cloned().collect::<Vec<_>>();
    if !unknown.is_empty() {
        out.push_str(&format!("\nthe model does not have: {}\n", unknown.join(", ")));
    }
    out
}

fn about(info: &Info) -> String {
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
    let counts = |counts: &BTreeMap<&'static str, u64>| {
        counts.iter().map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
    };
    line("lines", &format!("{} ({})", info.lines, counts(&info.senders)));
    line("messages", &counts(&info.messages));
    if let Some(interval) = info.interval_s {
        line("reports", &format!("every {} (median)", interval_text(interval)));
    }
    for silence in &info.silences {
        line(
            "silent",
            &format!("{:.3} s to {:.3} s: nothing changed, or nothing was recorded", silence.from_s, silence.to_s),
        );
    }
    if let Some(torn) = &info.torn {
        line("torn", torn);
    }
    out
}

fn interval_text(seconds: f64) -> String {
    if seconds < 1.0 { format!("{} ms", short(seconds * 1e3)) } else { format!("{} s", short(seconds)) }
}

/// A number with three digits that say something.
fn short(number: f64) -> String {
    significant(number, 3)
}

/// Signals that come less often than this are steps: over so long a time a speed says nothing.
const SAMPLED_S: f64 = 0.2;

fn signals(known: &Known, plant: Option<&Plant>) -> String {
    let names = known.info.signals.keys();
    let wide = names.map(|name| name.chars().count()).max().unwrap_or(0).max(6);
    let head = ["commands", "reports", "every", "values", "top speed", "turns", "stops"];
    let [commands, reports, every, values, speed, turns, stops] = head;
    let mut out = format!(
        "\n{:wide$}  {commands:>8} {reports:>8} {every:>8}  {values:<24} {speed:<14} {turns:>5} {stops:>5}\n",
        "signal"
    );
    for (name, signal) in &known.info.signals {
        let unit = plant.and_then(|plant| {
            let unit = plant.signal_map.signal(plant.signal_map.register(name)?).unit.to_string();
            (unit != "1").then(|| format!(" {unit}"))
        });
        let unit = unit.unwrap_or_default();
        let every = signal.interval_s.map(interval_text).unwrap_or_default();
        let values = match (signal.range, signal.is_boolean) {
            (Some([least, greatest]), _) if least == greatest => format!("{}{unit}", short(least)),
            (Some([least, greatest]), _) => format!("{} to {}{unit}", short(least), short(greatest)),
            (None, true) => {
                format!("{} rising, {} falling", signal.rising.unwrap_or(0), signal.falling.unwrap_or(0))
            }
            (None, false) => format!("{} changes", signal.changes),
        };
        let is_sampled = signal.interval_s.is_some_and(|interval| interval < SAMPLED_S);
        let [speed, turns, stops] = match known.motion.get(name) {
            Some(motion) if !is_sampled => [String::new(), motion.reversals.to_string(), motion.stops.to_string()],
            Some(motion) => {
                let per_second =
                    if unit.is_empty() { "/s".to_owned() } else { format!("{unit}/s").replace("/s/s", "/s2") };
                let speed = format!("{}{per_second}", short(motion.top_speed));
                [speed, motion.reversals.to_string(), motion.stops.to_string()]
            }
            None => Default::default(),
        };
        let (commands, reports) = (signal.commands, signal.reports);
        let line = format!(
            "{name:wide$}  {commands:>8} {reports:>8} {every:>8}  {values:<24} {speed:<14} {turns:>5} {stops:>5}"
        );
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}

fn excitation(device: &Excitation) -> String {
    let Excitation { device, missing, reversals, starts, stops, rising, falling, shows, lacks, .. } = device;
    let mut out = format!(
        "\n{device}: {starts} starts, {stops} stops, {reversals} reversals, {rising} rising and {falling} falling edges\n"
    );
    let mut line = |what: &str, text: String| {
        if !text.is_empty() {
            out.push_str(&wrapped(&format!("  {what:<10} "), &text));
        }
    };
    line("not in it", missing.join(", "));
    line("can show", shows.join(", "));
    // Effects that lack the same stand together.
    let mut by_need: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (effect, need) in lacks {
        by_need.entry(need).or_default().push(effect);
    }
    for (need, effects) in by_need {
        line("lacks", format!("{need}: {}", effects.join(", ")));
    }
    out
}

/// A text behind its first words, lines of 100 characters.
fn wrapped(first: &str, text: &str) -> String {
    const WIDE: usize = 100;
    let mut out = first.to_owned();
    let indent = first.chars().count();
    let mut column = indent;
    for word in text.split(' ') {
        let length = word.chars().count();
        if column > indent && column + length > WIDE {
            out = out.trim_end().to_owned();
            out.push('\n');
            out.push_str(&" ".repeat(indent));
            column = indent;
        }
        out.push_str(word);
        out.push(' ');
        column += length + 1;
    }
    let mut out = out.trim_end().to_owned();
    out.push('\n');
    out
}
