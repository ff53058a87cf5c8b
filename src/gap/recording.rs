//! A trace read for a diagnosis: typed commands and reports, in SI units, device by device.
//!
//! Times are those of the trace, in seconds since its start, exactly. What the model does not know is named and left out;
//! what the trace does not hold is named too. Spans that somebody declared as no evidence (manual operation, a jam, an
//! emergency stop), and spans in which nobody recorded, are kept as such: see [`Recording::is_blind`].

use std::collections::BTreeMap;
use std::io::BufRead;

use super::silence;
use crate::plant::{Instance, ParameterValue, Parameters, Plant, Task};
use crate::prototype::quantity::to_si;
use crate::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use crate::trace::{Body, Header, Line, Reader, Sender, Source, TraceError};
use crate::value::{ElementaryType, SignalType};
use crate::wire::{Entry, Message, TextForm, read_value};

/// A task of an instance: one device of the engine, and what a diagnosis looks at one at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TaskId {
    /// The instance's place in the plant.
    pub instance: usize,
    /// The task's place in the instance.
    pub task: usize,
}

impl TaskId {
    /// All tasks of a plant that have a signal, in the plant's order.
    pub fn all(plant: &Plant) -> Vec<TaskId> {
        let instances = plant.instances.iter().enumerate();
        let tasks = instances.flat_map(|(instance, of)| {
            (0..of.tasks.len()).map(move |task| TaskId { instance, task }).filter(|id| {
                let ports = &of.tasks[id.task].ports;
                ports.iter().any(Option::is_some)
            })
        });
        tasks.collect()
    }

    /// The instance that it belongs to.
    pub fn instance(self, plant: &Plant) -> &Instance {
        &plant.instances[self.instance]
    }

    /// The task.
    pub fn task(self, plant: &Plant) -> &Task {
        &plant.instances[self.instance].tasks[self.task]
    }

    /// The instance's name, and that of the task behind a point where the instance has several.
    pub fn name(self, plant: &Plant) -> String {
        let instance = self.instance(plant);
        match instance.tasks.len() {
            1 => instance.name.clone(),
            _ => format!("{}.{}", instance.name, self.task(plant).name),
        }
    }
}

/// A span of a trace, s, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    pub from: f64,
    pub to: f64,
}

impl Span {
    /// Whether an instant lies in it.
    pub fn holds(self, at: f64) -> bool {
        (self.from..=self.to).contains(&at)
    }
}

/// A value at a time: of a command as it was given, of a report as it was stamped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stamped {
    /// Seconds since the trace's start.
    pub at: f64,
    /// In SI units; BOOL as 0 or 1.
    pub value: f64,
}

/// Which signals are sent together, and so have their stamps in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Beat {
    /// Levels of the high-frequency loop.
    Fast,
    /// Levels of the low-frequency loop.
    Slow,
    /// Edges, which are sent when they come where the sender is not a PLC with one cycle for all.
    Edges,
}

impl Beat {
    /// All of them.
    pub const ALL: [Beat; 3] = [Beat::Fast, Beat::Slow, Beat::Edges];

    /// That of a signal.
    pub fn of(signal: &Signal) -> Beat {
        match (signal.kind, signal.rate) {
            (Kind::Edge, _) => Beat::Edges,
            (Kind::Level, RateClass::HighFrequency) => Beat::Fast,
            (Kind::Level, RateClass::LowFrequency) => Beat::Slow,
        }
    }
}

/// A clock beside that of the commands.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherClock {
    pub name: String,
    /// The reports that it stamped.
    pub registers: Vec<RegisterId>,
    /// As [`Recording::stamps`], of its reports.
    pub stamps: [Vec<f64>; 3],
}

/// A trace that cannot be used at all.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error(
        "{name}: none of the model's signals is reported in it ({lines} lines, {ignored} signals that the model lacks): \
         is it a trace of this plant?"
    )]
    Foreign { name: String, lines: u64, ignored: usize },
}

/// A trace, read.
#[derive(Clone, Debug)]
pub struct Recording {
    /// What the trace was called when it was opened.
    pub name: String,
    pub header: Header,
    /// The time of the last line, s. Silence after it is no evidence.
    pub ends: f64,
    /// How many lines there were, the header not counted.
    pub lines: u64,
    /// Signals of the trace that are left out, each with the reason.
    pub ignored: BTreeMap<String, String>,
    /// Signals of the model that the trace does not hold: reports that cannot be compared, and commands that are taken
    /// to have stayed 0 or false. By name.
    pub absent: Vec<String>,
    /// What was left out beside that, in words, with how often.
    pub notices: BTreeMap<String, u64>,
    /// The last line, if it was torn.
    pub torn: Option<String>,
    /// Where there is no evidence: the spans declared to [`Recording::read`], and those between two connections.
    pub blind: Vec<Span>,
    /// Spans in which reports are missing: no signal is known again before its next report.
    pub lost: Vec<Span>,
    /// Whether it goes on with what another began, in the middle of a session.
    pub resumes: bool,
    /// The stamps of the plant's lines that held a signal of each [`Beat`], in its order; each stamp once. Of signals that
    /// another clock stamped: see [`OtherClock::stamps`].
    pub stamps: [Vec<f64>; 3],
    /// Other clocks than that of the commands.
    pub clocks: Vec<OtherClock>,
    /// How the machine was set up while it was recorded, where that is not as the model has it: parameters of its devices, SI.
    pub settings: BTreeMap<TaskId, BTreeMap<String, f64>>,
    /// By register.
    values: Vec<Vec<Stamped>>,
}

impl Recording {
    /// Reads a trace to its end. `name` is what messages call it; `masks` are the spans to leave out.
    ///
    /// # Errors
    /// Whatever a [`Reader`] finds (malformed lines, NaN, a time that goes back), and a trace in which nothing is reported
    /// that the model knows.
    pub fn read<R: BufRead>(
        plant: &Plant,
        name: &str,
        mut reader: Reader<R>,
        masks: &[Span],
    ) -> Result<Recording, RecordingError> {
        let map = &plant.signal_map;
        let mut reading = Reading::new(map, name, reader.header().clone(), masks);
        while let Some(line) = reader.next_line()? {
            reading.line(&line);
        }
        reading.recording.torn = reader.torn().map(ToString::to_string);
        reading.finish()
    }

    /// The recording that a machine would give that took `commands` and reported `reports`, each a time in s, a register and
    /// a value as it stands on the wire; both in the order of time. It ends at `ends`, s.
    pub fn of(
        plant: &Plant,
        name: &str,
        commands: &[(f64, RegisterId, f64)],
        reports: &[(f64, RegisterId, f64)],
        ends: f64,
    ) -> Recording {
        let map = &plant.signal_map;
        let mut recording = Reading::new(map, name, Header::default(), &[]).recording;
        recording.ends = ends;
        recording.lines = (commands.len() + reports.len()) as u64;
        for (at, register, value) in commands.iter().chain(reports) {
            let signal = map.signal(*register);
            recording.values[register.index()].push(Stamped { at: *at, value: to_si(*value, signal.unit) });
            let stamps = &mut recording.stamps[Beat::of(signal) as usize];
            if signal.direction == Direction::Report && stamps.last() != Some(at) {
                stamps.push(*at);
            }
        }
        recording
    }

    /// From now on it is of the machine set up as `variant` has it, a plant with the same instances as `plant`: every number in
    /// which their devices differ becomes a setting of this recording.
    pub fn set_up_as(&mut self, plant: &Plant, variant: &Plant) {
        for id in TaskId::all(plant) {
            let (own, name) = (id.task(plant), &id.instance(plant).name);
            let same = variant.instances.iter().find(|instance| instance.name == *name);
            let Some(other) = same.and_then(|instance| instance.tasks.get(id.task)) else { continue };
            let number = |parameters: &Parameters, name: &str| match parameters.0.get(name)?.value {
                ParameterValue::Number(value) => Some(value),
                _ => None,
            };
            let differing = own.parameters.0.keys().filter_map(|name| {
                let (here, there) = (number(&own.parameters, name)?, number(&other.parameters, name)?);
                (here != there).then(|| ((*name).to_owned(), there))
            });
            let differing: BTreeMap<String, f64> = differing.collect();
            if !differing.is_empty() {
                self.settings.insert(id, differing);
            }
        }
    }

    /// What was recorded of a register, in the order of time; empty where the trace does not hold it. Values are SI.
    pub fn values(&self, register: RegisterId) -> &[Stamped] {
        self.values.get(register.index()).map_or(&[], Vec::as_slice)
    }

    /// Gives the reports of `names`, signals or whole instances, to a clock of their own.
    fn set_apart(&mut self, map: &SignalMap, clock: &str, names: &[String]) {
        for name in names {
            if !map.signals().iter().any(|signal| signal.name == *name || signal.instance == *name) {
                let words = format!("clock {clock}: the model has neither a signal nor an instance {name}");
                *self.notices.entry(words).or_default() += 1;
            }
        }
        let is_named = |signal: &Signal| names.iter().any(|name| signal.name == *name || signal.instance == *name);
        let reports = map.directed(Direction::Report).filter(|(_, signal)| is_named(signal));
        let registers = reports.map(|(register, _)| register).collect();
        self.clocks.push(OtherClock { name: clock.to_owned(), registers, stamps: Default::default() });
        self.restamp(map);
    }

    /// Which of the other clocks stamped a register; `None`: the clock of the commands.
    pub fn clock_of(&self, register: RegisterId) -> Option<usize> {
        self.clocks.iter().position(|clock| clock.registers.contains(&register))
    }

    /// Moves what a clock stamped: what it called `t` was at `at(t)`.
    pub(super) fn shift(&mut self, map: &SignalMap, clock: usize, at: impl Fn(f64) -> f64) {
        for register in self.clocks[clock].registers.clone() {
            self.values[register.index()].iter_mut().for_each(|stamped| stamped.at = at(stamped.at));
        }
        self.restamp(map);
    }

    /// The values of every register, by its index.
    pub(super) fn by_register(&self) -> &[Vec<Stamped>] {
        &self.values
    }

    /// The same with other values, whose stamps are collected anew.
    pub(super) fn with_values(mut self, map: &SignalMap, values: Vec<Vec<Stamped>>) -> Recording {
        self.values = values;
        self.restamp(map);
        self
    }

    /// Collects the stamps of every clock anew from the values.
    fn restamp(&mut self, map: &SignalMap) {
        let stamps = |wanted: Option<usize>| {
            Beat::ALL.map(|beat| {
                let of = map
                    .directed(Direction::Report)
                    .filter(|(register, signal)| Beat::of(signal) == beat && self.clock_of(*register) == wanted);
                let values = of.flat_map(|(register, _)| self.values(register));
                let mut stamps: Vec<f64> = values.map(|stamped| stamped.at).collect();
                stamps.sort_by(f64::total_cmp);
                stamps.dedup();
                stamps
            })
        };
        let main = stamps(None);
        let others: Vec<_> = (0..self.clocks.len()).map(|clock| stamps(Some(clock))).collect();
        self.stamps = main;
        for (clock, stamps) in self.clocks.iter_mut().zip(others) {
            clock.stamps = stamps;
        }
    }

    /// Whether what happened at an instant is no evidence.
    pub fn is_blind(&self, at: f64) -> bool {
        self.blind.iter().any(|span| span.holds(at))
    }

    /// Whether it was recorded by a simulation of ours, whose stamps are steps.
    pub fn step(&self) -> Option<f64> {
        let step = self.header.step_ns.filter(|_| self.header.source == Source::Simulation);
        step.map(|ns| ns as f64 * 1e-9)
    }
}

/// A recording in the making.
struct Reading<'a> {
    map: &'a SignalMap,
    recording: Recording,
    last_report: Option<f64>,
}

impl<'a> Reading<'a> {
    fn new(map: &'a SignalMap, name: &str, header: Header, masks: &[Span]) -> Reading<'a> {
        let recording = Recording {
            name: name.to_owned(),
            header,
            ends: 0.0,
            lines: 0,
            ignored: BTreeMap::new(),
            absent: Vec::new(),
            notices: BTreeMap::new(),
            torn: None,
            blind: masks.to_vec(),
            lost: Vec::new(),
            resumes: false,
            stamps: Default::default(),
            clocks: Vec::new(),
            settings: BTreeMap::new(),
            values: vec![Vec::new(); map.signals().len()],
        };
        Reading { map, recording, last_report: None }
    }

    fn line(&mut self, line: &Line<'_>) {
        let at = line.at.seconds();
        self.recording.lines += 1;
        self.recording.ends = at;
        match (&line.body, line.from) {
            (Body::Message(Message::SendValue(entries)), from @ (Sender::Automation | Sender::Plant)) => {
                if from == Sender::Plant {
                    self.last_report = Some(at);
                }
                for entry in entries {
                    self.entry(at, from, entry);
                }
            }
            // A new session: what changed since the last report of the one before was reported to nobody.
            (Body::Message(Message::Connect(connect)), Sender::Plant) if connect.enable => {
                let from = self.last_report.take();
                self.recording.blind.extend(from.map(|from| Span { from, to: at }));
            }
            (Body::Refused { reason }, _) => self.notice(format!("a message that was refused is left out: {reason}")),
            (Body::Event(_), Sender::Operator) => self.notice("what an operator did is left out".to_owned()),
            _ => {}
        }
    }

    fn notice(&mut self, words: String) {
        *self.recording.notices.entry(words).or_default() += 1;
    }

    fn entry(&mut self, at: f64, from: Sender, entry: &Entry<'_>) {
        let (Some(name), Some(raw)) = (&entry.name, entry.value) else {
            return self.notice("an entry without a name or a value is left out".to_owned());
        };
        let Some(register) = self.map.register(name) else {
            return self.ignore(name, "the model has no such signal");
        };
        let signal = self.map.signal(register);
        match (signal.direction, from) {
            (Direction::Command, Sender::Plant) => return self.ignore(name, "a command that the plant reported"),
            (Direction::Report, Sender::Automation) => return self.ignore(name, "a report that the automation sent"),
            _ => {}
        }
        let value = match read_value(raw, signal.ty, TextForm::Base64) {
            Ok(value) => value.to_f64().filter(|number| number.is_finite()),
            Err(unfit) => return self.notice(format!("{name}: a value is left out: {}", unfit.message)),
        };
        let Some(number) = value else { return self.ignore(name, "neither a number nor a BOOL") };
        let number = self.as_written(signal, raw.as_number()).unwrap_or(number);
        if signal.min.is_some_and(|min| number < min) || signal.max.is_some_and(|max| number > max) {
            return self.notice(format!("{name}: a value out of its range is left out, as a session would refuse it"));
        }
        let value = if signal.unit.to_si == 1.0 { number } else { to_si(number, signal.unit) };
        if from == Sender::Plant {
            let stamps = &mut self.recording.stamps[Beat::of(signal) as usize];
            if stamps.last() != Some(&at) {
                stamps.push(at);
            }
        }
        self.recording.values[register.index()].push(Stamped { at, value });
    }

    /// A machine's REAL as its decimal stands there: rounded to 32 bits it would lie off the lattice that it was rounded to.
    /// The commands of a simulation of ours acted as 32 bits.
    fn as_written(&self, signal: &Signal, text: Option<&str>) -> Option<f64> {
        let is_ours = self.recording.header.source == Source::Simulation;
        let is_real = signal.ty == SignalType::scalar(ElementaryType::Real);
        let number = text.filter(|_| is_real && !(is_ours && signal.direction == Direction::Command))?;
        number.parse().ok()
    }

    fn ignore(&mut self, name: &str, reason: &str) {
        self.recording.ignored.entry(name.to_owned()).or_insert_with(|| reason.to_owned());
    }

    fn finish(self) -> Result<Recording, RecordingError> {
        let Reading { map, mut recording, .. } = self;
        let silences = silence::silences(map, &recording);
        for span in &silences {
            let words = format!(
                "nothing was reported from {:.3} s to {:.3} s though something moved: the span is left out",
                span.from, span.to
            );
            *recording.notices.entry(words).or_default() += 1;
        }
        recording.lost = silences;
        if recording.stamps.iter().all(Vec::is_empty) {
            let (name, ignored) = (recording.name, recording.ignored.len());
            return Err(RecordingError::Foreign { name, lines: recording.lines, ignored });
        }
        let clocks = recording.header.clocks.clone();
        for (name, signals) in &clocks {
            recording.set_apart(map, name, signals);
        }
        let is_absent = |(_, signal): &(usize, &Signal)| !signal.task.is_empty();
        let named = map.signals().iter().enumerate().filter(is_absent);
        recording.absent = named
            .filter(|(register, _)| recording.values[*register].is_empty())
            .map(|(_, signal)| signal.name.clone())
            .collect();
        Ok(recording)
    }
}
