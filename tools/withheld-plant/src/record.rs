//! From a plant and a script to a trace: what a recorder beside the machine would have written.

use std::io::{self, Write};

use kinetwin::time::Instant;
use kinetwin::trace::{Compression, Header, Sender, Source, Writer};
use kinetwin::value::Value;
use kinetwin::wire::{Message, SendValueText};
use serde::{Deserialize, Serialize};

use crate::chance::Dice;
use crate::plant::{Command, Kind, Plant, Signal};
use crate::quirk::{Quirk, Quirks};
use crate::stream::Stream;

/// A message that is lost or not comes this much before its report, s.
const BEFORE_S: f64 = 1e-9;

/// How a machine is listened to. Nobody who diagnoses it knows any of this.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surroundings {
    /// From one report to the next, s.
    pub cycle: f64,
    /// When the first report is due, s.
    pub phase: f64,
    /// How much older the state is than its report, s.
    pub age: f64,
    /// How much later than due reports are stamped: |N(0, jitter)|, s.
    pub jitter: f64,
    /// The machine's task takes commands when it runs: its cycle and phase, s; a cycle of 0 takes them at once.
    pub task: f64,
    pub task_phase: f64,
    /// A flag is seen once it has stood for so long, s.
    pub filter: f64,
    /// How many times its sigma each level scatters.
    pub noise: f64,
    /// The noise forgets itself with this time constant, s.
    pub noise_time: f64,
}

impl Surroundings {
    /// At random.
    pub fn draw(dice: &mut Dice) -> Surroundings {
        let cycle = *dice.one_of(&[0.01, 0.02, 0.02, 0.05]);
        let task = *dice.one_of(&[0.0, 1e-4, 5e-4, 1e-3]);
        Surroundings {
            cycle,
            phase: dice.between(0.2, 1.0) * cycle,
            age: dice.between(0.0, 1e-3),
            jitter: *dice.one_of(&[0.0, 2e-4, 1e-3]),
            task,
            task_phase: dice.between(0.0, 1.0) * task,
            filter: *dice.one_of(&[0.0, 5e-4, 1e-3]),
            noise: *dice.one_of(&[0.0, 0.3, 1.0, 2.5]),
            noise_time: dice.log_between(2e-3, 2e-2),
        }
    }

    /// The same, without what makes a report older or a command later than its stamp.
    pub fn prompt(self) -> Surroundings {
        Surroundings { age: 0.0, task: 0.0, task_phase: 0.0, filter: 0.0, ..self }
    }

    /// When the machine's task takes a command that is there at `at`, s.
    pub fn taken_at(&self, at: f64) -> f64 {
        match self.task {
            task if task > 0.0 && at > 0.0 => ((at - self.task_phase) / task).ceil() * task + self.task_phase,
            _ => at,
        }
    }

    /// When the reports before `end` are due, s.
    pub fn due(&self, end: f64) -> Vec<f64> {
        (0..).map(|k| self.phase + f64::from(k) * self.cycle).take_while(|at| *at < end).collect()
    }

    /// When a report that is due at `due` looks at the machine, s.
    pub fn sample(&self, due: f64) -> f64 {
        (due - self.age).max(0.0)
    }
}

/// One message under way: what stands in a line of the trace.
pub struct Said {
    pub at: f64,
    pub from: Sender,
    pub text: String,
}

/// What was seen of each signal at each report's instant, before noise and rounding.
#[derive(Clone, Debug)]
pub struct Seen {
    /// When each report was due.
    pub due: Vec<f64>,
    /// By report, then by signal.
    pub values: Vec<Vec<f64>>,
}

impl Seen {
    /// Of one device alone, whose `signals` these are among.
    pub fn of(&self, device: &str, signals: &[Signal]) -> Seen {
        let is_own: Vec<bool> = signals.iter().map(|signal| signal.parts().0 == device).collect();
        let own = |values: &Vec<f64>| values.iter().zip(&is_own).filter(|(_, own)| **own).map(|(v, _)| *v).collect();
        Seen { due: self.due.clone(), values: self.values.iter().map(own).collect() }
    }
}

/// Lets `plant` run under `script` and looks at it.
pub fn watch(plant: &mut Plant, script: &[Command], around: &Surroundings, end: f64, seed: u64) -> Seen {
    let mut dice = Dice::new(seed, 21);
    let quirks = plant.quirks.clone();
    let due = around.due(end);
    let samples: Vec<f64> = due.iter().map(|at| around.sample(*at)).collect();
    let commands = taken(script, plant, around, end, &mut dice);
    let signals = plant.signals.clone();
    let watched: Vec<bool> = signals.iter().map(|signal| passes(&quirks, signal).next().is_some()).collect();
    let streams = plant.run(&commands, &samples, &watched, end);
    let mut streams: Vec<Stream> = streams
        .into_iter()
        .zip(&signals)
        .map(|(stream, signal)| reported(stream, signal, &quirks, around, end, &mut dice))
        .collect();
    swap(&mut streams, &signals, &quirks);
    let values = samples.iter().map(|at| streams.iter().map(|stream| stream.at(*at)).collect()).collect();
    Seen { due, values }
}

/// The commands as the devices take them: over their links, when their task runs next.
pub fn taken(script: &[Command], plant: &Plant, around: &Surroundings, end: f64, dice: &mut Dice) -> Vec<Command> {
    let (mut all, quirks) = (Vec::new(), &plant.quirks);
    for (name, kind) in &plant.commands {
        let (device, port) = name.split_once('.').unwrap_or_default();
        let mut stream = Stream::new(true);
        stream.push(0.0, 0.0);
        script
            .iter()
            .filter(|command| command.signal == *name)
            .for_each(|command| stream.push(command.at, command.value));
        let of_device = Quirks::of(quirks, device);
        for quirk in of_device.at("command-link", port) {
            stream = stream.through(quirk, *kind, dice, end).in_steps();
        }
        let name = arrives_at(quirks, name);
        let value = |value: f64| if *kind == Kind::Code { value.round() } else { value };
        let points = stream.points().iter();
        all.extend(points.map(|(at, to)| Command {
            at: around.taken_at(*at),
            signal: name.clone(),
            value: value(*to),
        }));
    }
    all.sort_by(|a, b| a.at.total_cmp(&b.at));
    all
}

/// The command that one of this name is taken for.
pub fn arrives_at(quirks: &[Quirk], name: &str) -> String {
    let (device, port) = name.split_once('.').unwrap_or_default();
    let mut name = name.to_owned();
    for quirk in quirks.iter().filter(|q| q.device == device && q.effect == "swapped" && q.place == "command-link") {
        let (one, two) = (quirk.component.as_deref().unwrap_or_default(), quirk.with.as_deref().unwrap_or_default());
        let other = if port == one {
            two
        } else if port == two {
            one
        } else {
            port
        };
        name = format!("{device}.{other}");
    }
    name
}

/// What stands between a signal's sensor and its report.
pub fn passes<'a>(quirks: &'a [Quirk], signal: &'a Signal) -> impl Iterator<Item = &'a Quirk> {
    let (device, port) = signal.parts();
    let of_device = Quirks::of(quirks, device);
    // A sensor's effect names its signal, a link's may mean all of them.
    let sensor = of_device.at("sensor", port).filter(|quirk| quirk.component.is_some());
    sensor.chain(of_device.at("report-link", port))
}

/// All that a signal passes from its sensor to its report, in order: what is wrong there, and the filter of its input. Messages bring what has passed
/// that.
pub fn way(quirks: &[Quirk], signal: &Signal, around: &Surroundings) -> Vec<Quirk> {
    let mut way: Vec<Quirk> = passes(quirks, signal).cloned().collect();
    for quirk in way.iter_mut().filter(|quirk| quirk.effect == "lost-messages") {
        // A message is a report: what one brings is what its sampling saw.
        quirk.parameters.push(("cycle".to_owned(), around.cycle));
        quirk.parameters.push(("phase".to_owned(), around.sample(around.phase) - BEFORE_S));
    }
    if signal.kind == Kind::Flag && around.filter > 0.0 {
        let filter = Quirk {
            effect: "input-filter".to_owned(),
            parameters: vec![("time_constant".to_owned(), around.filter)],
            device: String::new(),
            component: None,
            place: String::new(),
            with: None,
        };
        let messages = way.iter().position(|quirk| quirk.effect == "lost-messages");
        way.insert(messages.unwrap_or(way.len()), filter);
    }
    way
}

pub fn reported(
    stream: Stream,
    signal: &Signal,
    quirks: &[Quirk],
    around: &Surroundings,
    end: f64,
    dice: &mut Dice,
) -> Stream {
    let way = way(quirks, signal, around);
    way.iter().fold(stream, |stream, quirk| stream.through(quirk, signal.kind, dice, end))
}

/// Exchanges what stands for two signals whose reports are swapped.
pub fn swap<T>(streams: &mut [T], signals: &[Signal], quirks: &[Quirk]) {
    for quirk in quirks.iter().filter(|quirk| quirk.effect == "swapped" && quirk.place == "report-link") {
        let place = |port: &Option<String>| {
            let name = format!("{}.{}", quirk.device, port.as_deref().unwrap_or_default());
            signals.iter().position(|signal| signal.name == name)
        };
        if let (Some(one), Some(two)) = (place(&quirk.component), place(&quirk.with)) {
            streams.swap(one, two);
        }
    }
}

/// Writes what was seen of `plant` under `script` as a trace of the plant called `model`.
pub fn write<W: Write>(
    out: W,
    model: &str,
    script: &[Command],
    seen: &Seen,
    plant: &Plant,
    around: &Surroundings,
    seed: u64,
) -> io::Result<W> {
    let mut said = commands(script, &plant.commands);
    said.extend(reports(seen, &plant.signals, around, seed));
    // Stable: the automation's first.
    said.sort_by(|a, b| a.at.total_cmp(&b.at));
    write_said(out, model, &said)
}

/// Writes messages, sorted by their instants, as a trace of the plant called `model`.
pub fn write_said<W: Write>(out: W, model: &str, said: &[Said]) -> io::Result<W> {
    let header = Header { source: Source::Plant, model: Some(model.to_owned()), ..Header::default() };
    let mut writer = Writer::new(out, Compression::Zstd, &header)?;
    for Said { at, from, text } in said {
        writer.message(Instant::from_seconds(*at), *from, text)?;
    }
    writer.finish()
}

/// The automation's messages: the first sets everything to 0.
pub fn commands(script: &[Command], known: &[(String, Kind)]) -> Vec<Said> {
    let mut text = SendValueText::with_capacity(known.len());
    for (name, kind) in known {
        let _ = text.push(name, &value(*kind, 0.0));
    }
    let mut said = vec![Said { at: 0.0, from: Sender::Automation, text: text.finish().unwrap_or_default() }];
    for together in script.chunk_by(|one, next| one.at == next.at) {
        let mut text = SendValueText::with_capacity(together.len());
        for command in together {
            let kind = known.iter().find(|(name, _)| *name == command.signal).map_or(Kind::Level, |(_, kind)| *kind);
            let _ = text.push(&command.signal, &value(kind, command.value));
        }
        let text = text.finish().unwrap_or_default();
        said.push(Said { at: together[0].at, from: Sender::Automation, text });
    }
    said
}

/// The plant's messages: the first holds everything, each further one what has changed.
pub fn reports(seen: &Seen, signals: &[Signal], around: &Surroundings, seed: u64) -> Vec<Said> {
    let mut reporter = Reporter::new(signals, around, seed);
    let mut said = Vec::new();
    for (due, values) in seen.due.iter().zip(&seen.values) {
        let (text, late) = reporter.report(values);
        if let Some(text) = text {
            said.push(Said { at: due + late, from: Sender::Plant, text });
        }
    }
    said
}

/// From what is seen to what is reported, report by report.
pub struct Reporter<'a> {
    signals: &'a [Signal],
    around: &'a Surroundings,
    dice: Dice,
    /// By signal, in units of its sigma.
    noise: Vec<f64>,
    last: Vec<Option<Value>>,
}

impl<'a> Reporter<'a> {
    /// Before the first report.
    pub fn new(signals: &'a [Signal], around: &'a Surroundings, seed: u64) -> Reporter<'a> {
        let mut dice = Dice::new(seed, 22);
        let noise = signals.iter().map(|_| dice.normal()).collect();
        Reporter { signals, around, dice, noise, last: vec![None; signals.len()] }
    }

    /// The next message, one cycle after the one before, and how much later than due it leaves, s. `None` where nothing has
    /// changed.
    pub fn report(&mut self, values: &[f64]) -> (Option<String>, f64) {
        let around = self.around;
        let keep = (-around.cycle / around.noise_time.max(1e-9)).exp();
        let fresh = (1.0 - keep * keep).sqrt();
        let mut text = SendValueText::with_capacity(8);
        for (at, signal) in self.signals.iter().enumerate() {
            self.noise[at] = keep * self.noise[at] + fresh * self.dice.normal();
            let read = values[at] + around.noise * signal.sigma * self.noise[at];
            let rounded =
                if signal.kind == Kind::Level { (read / signal.quantum).round() * signal.quantum } else { read };
            let now = Some(value(signal.kind, rounded));
            if now != self.last[at]
                && let Some(value) = &now
            {
                let _ = text.push(&signal.name, value);
                self.last[at] = now;
            }
        }
        let late = (around.jitter * self.dice.normal()).abs().min(0.4 * around.cycle);
        (text.finish(), late)
    }
}

fn value(kind: Kind, number: f64) -> Value {
    match kind {
        Kind::Flag => Value::Bool(number != 0.0),
        Kind::Code => Value::Dint(number as i32),
        // A counter does not count the other way round below 0.
        Kind::Count => Value::Dint(number.floor() as i32),
        // Rounding to a grid and to REAL: the shortest text of the REAL is what is written.
        Kind::Level => Value::Real(number as f32 + 0.0),
    }
}

/// The script as a plant that takes the commands `known` hears it: every message through the wire and back, so that no number
/// is finer than what travels.
pub fn heard(script: &[Command], known: &[(String, Kind)]) -> Vec<Command> {
    let mut heard = Vec::new();
    for said in commands(script, known).into_iter().skip(1) {
        let Ok(Message::SendValue(entries)) = Message::decode(&said.text) else { continue };
        for entry in entries {
            let (Some(name), Some(raw)) = (entry.name, entry.value) else { continue };
            let number = raw.as_bool().map(f64::from).or_else(|| raw.as_number()?.parse::<f32>().ok().map(f64::from));
            if let Some(value) = number {
                // The recorder stamps to the nanosecond.
                let at = Instant::from_seconds(said.at).seconds();
                heard.push(Command { at, signal: name.into_owned(), value });
            }
        }
    }
    heard
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::quirk;

    /// A flag that is filtered for 1 ms before each of its reports is taken, of which none is lost.
    #[test]
    fn a_link_that_loses_nothing_brings_each_report_when_it_was_due() {
        let around =
            Surroundings { filter: 1e-3, cycle: 0.02, phase: 0.01, ..Surroundings::draw(&mut Dice::new(1, 1)) };
        let signal = Signal { name: "D.flag".to_owned(), kind: Kind::Flag, quantum: 0.0, sigma: 0.0 };
        let seen = |quirks: &[Quirk]| -> Vec<f64> {
            let mut stream = Stream::new(true);
            [(0.0, 0.0), (0.104, 1.0), (0.158, 0.0)].into_iter().for_each(|(at, value)| stream.push(at, value));
            let stream = reported(stream, &signal, quirks, &around, 0.3, &mut Dice::new(1, 1));
            around.due(0.3).into_iter().map(|due| stream.at(around.sample(due))).collect()
        };
        let link = Quirk { place: "report-link".to_owned(), ..quirk("D", "lost-messages", &[("probability", 0.0)]) };
        assert!(seen(&[]).contains(&1.0));
        assert_eq!(seen(&[link]), seen(&[]));
    }
}
