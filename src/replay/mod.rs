//! A trace's commands go into an engine, and what the model reports is compared with what was recorded.
//!
//! The commands act at their recorded instants: a tick begins at every line of the trace, and at every step between.
//! In a recording of ours all lines lie on steps, so that the replay makes the very steps of the run and differs in
//! nothing. A real machine's lines lie between; the step is no part of the difference then.
//!
//! - **Levels** are compared at the recorded reports, by the largest and the RMS difference. A line that reports a level
//!   says of every other level of its rate class that it is unchanged: a signal holds its last value. Where a signal's
//!   class is silent although the model has moved away for long, that is compared too.
//! - **Edges** are paired by the value they change to and compared by time: matched within the tolerance, early or late
//!   (the model) beyond it; missing where the model does not make a recorded edge, extra where only the model makes it. A
//!   state that the model leaves again within the tolerance is no difference: a PLC that looks once a cycle misses it.
//!
//! Nothing is compared where nothing was recorded: before a signal's first report, after the last line, and between the
//! last report of a connection and the first of the next (a `Connect` in the trace says so).
//!
//! A replay reads the trace twice: [`Survey::of`] checks it from end to end before an engine moves, [`run`] replays it.

mod commands;
mod edges;
pub mod foxglove;
mod levels;
mod report;
mod reported;
mod survey;

#[cfg(test)]
mod tests;

use std::io::BufRead;
use std::sync::Arc;
use std::time::Duration;

pub use report::{EdgeReport, LevelReport, Report};
pub use reported::{Reported, Seen};
pub use survey::Survey;

use crate::bank::{self, Full};
use crate::engine::{Act, Engine};
use crate::signal_map::{Direction, Kind, RegisterId, SignalMap};
use crate::time::Instant;
use crate::trace::operator::Deed;
use crate::trace::{Body, Line, Reader, Sender, TraceError};
use crate::value::Value;
use crate::wire::{Message, TextForm, read_value};

use commands::Commands;
use edges::EdgeTrack;
use levels::LevelTrack;
use report::Notices;

/// The longest replay. What ends later does not count seconds from its start: a clock's date, or milliseconds.
const LONGEST: Duration = Duration::from_secs(30 * 24 * 3600);

/// How far the model may lie from the recording and still be the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// The most between a recorded edge and the model's.
    pub edge: Duration,
    /// The most between a recorded level and the model's, in the signal's unit.
    pub level: f64,
    /// How long a level may be silent until a model that has moved away differs: longer than a refresh interval. Four times
    /// the mean time between two reports of its rate class, where that is more.
    pub silence: Duration,
}

impl Default for Tolerances {
    /// No difference at all; a silence of 2 s, four times the default low-frequency interval.
    fn default() -> Tolerances {
        Tolerances { edge: Duration::ZERO, level: 0.0, silence: Duration::from_secs(2) }
    }
}

/// Why a trace cannot be replayed.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// The trace reaches too far.
    #[error(
        "the trace ends at t = {ends_s} s, after {} days: is that its time in seconds since the start of the recording?",
        LONGEST.as_secs() / 86_400
    )]
    TooLong { ends_s: f64 },
    /// The engine is not at its start.
    #[error("a replay begins with the plant at rest: this engine has made {steps} steps")]
    Started { steps: u64 },
    /// More commands at one instant than a live run could take.
    #[error("line {line}: {source}")]
    Queue {
        line: u64,
        #[source]
        source: Full,
    },
    /// The second reading gave other lines than the first.
    #[error("the trace changed while it was read")]
    Changed,
}

/// Replays the trace behind `reader`, which `survey` was made of, on `engine`, which is at its start. `map` is its plant's.
pub fn run<R: BufRead>(
    engine: &mut Engine,
    map: &Arc<SignalMap>,
    survey: &Survey,
    reader: Reader<R>,
    tolerances: &Tolerances,
) -> Result<Report, ReplayError> {
    watched(engine, map, survey, reader, tolerances, |_| {})
}

/// Replays as [`run`] does; `watch` sees the engine after each tick.
pub fn watched<R: BufRead>(
    engine: &mut Engine,
    map: &Arc<SignalMap>,
    survey: &Survey,
    reader: Reader<R>,
    tolerances: &Tolerances,
    mut watch: impl FnMut(&mut Engine),
) -> Result<Report, ReplayError> {
    if engine.steps() != 0 {
        return Err(ReplayError::Started { steps: engine.steps() });
    }
    if survey.ends() > Instant::ZERO + LONGEST {
        return Err(ReplayError::TooLong { ends_s: survey.ends().seconds() });
    }
    let mut replay = Replay::new(map, survey, *tolerances);
    let mut lines = Lines { reader, next: None };
    lines.advance(&mut replay)?;
    while let Some(at) = lines.at() {
        replay.step(engine, at, &mut lines)?;
        watch(engine);
    }
    if replay.lines != survey.lines() {
        return Err(ReplayError::Changed);
    }
    Ok(replay.finish(engine))
}

/// What a line means for a replay.
#[derive(Debug)]
enum Meaning {
    /// Commands, by their registers.
    Commands(Vec<(RegisterId, Value)>),
    /// Reports, by their registers.
    Reports(Vec<(RegisterId, Value)>),
    /// What an operator did.
    Deed(Act),
    Nothing,
}

/// The lines of a trace, one of them read ahead.
struct Lines<R: BufRead> {
    reader: Reader<R>,
    next: Option<(Instant, u64, Meaning)>,
}

impl<R: BufRead> Lines<R> {
    /// The time of the next line.
    fn at(&self) -> Option<Instant> {
        self.next.as_ref().map(|(at, ..)| *at)
    }

    /// Gives the next line, and reads the one after it.
    fn advance(&mut self, replay: &mut Replay<'_>) -> Result<Option<(u64, Meaning)>, TraceError> {
        let this = self.next.take().map(|(_, number, meaning)| (number, meaning));
        self.next = match self.reader.next_line()? {
            Some(line) => Some((line.at, line.number, replay.meaning(&line))),
            None => None,
        };
        Ok(this)
    }
}

/// A replay in the making.
struct Replay<'a> {
    map: &'a SignalMap,
    survey: &'a Survey,
    tolerances: Tolerances,
    commands: Commands,
    simulation: bank::SimulationSide,
    io: bank::IoSide,
    inputs: Vec<(RegisterId, Value)>,
    levels: Vec<LevelTrack>,
    edges: Vec<EdgeTrack>,
    /// By register: its place among the levels or the edges.
    places: Vec<usize>,
    /// How many of the survey's blind spans have begun. They are reports apart, so that one begins in a tick at most.
    blind: usize,
    notices: Notices,
    lines: u64,
}

impl<'a> Replay<'a> {
    fn new(map: &'a Arc<SignalMap>, survey: &'a Survey, tolerances: Tolerances) -> Replay<'a> {
        let (simulation, io) = bank::new(map);
        let (mut levels, mut edges) = (Vec::new(), Vec::new());
        let mut places = vec![usize::MAX; map.signals().len()];
        for (id, signal) in map.directed(Direction::Report) {
            places[id.index()] = match signal.kind {
                Kind::Level => levels.len(),
                Kind::Edge => edges.len(),
            };
            match signal.kind {
                Kind::Level => {
                    let silence = tolerances.silence.max(4 * survey.interval(signal.rate));
                    levels.push(LevelTrack::new(id, signal.rate, Tolerances { silence, ..tolerances }));
                }
                Kind::Edge => edges.push(EdgeTrack::new(id, tolerances.edge, survey.ends())),
            }
        }
        Replay {
            map,
            survey,
            tolerances,
            commands: Commands::new(map.clone()),
            simulation,
            io,
            inputs: Vec::new(),
            levels,
            edges,
            places,
            blind: 0,
            notices: Notices::default(),
            lines: 0,
        }
    }

    /// Reads a line's values. What a live session refuses is refused here, with a notice.
    fn meaning(&mut self, line: &Line<'_>) -> Meaning {
        self.lines += 1;
        match (&line.body, line.from) {
            (Body::Message(Message::SendValue(entries)), Sender::Automation) => {
                Meaning::Commands(self.commands.read(line.text, entries, &mut self.notices))
            }
            (Body::Message(Message::SendValue(entries)), Sender::Plant) => {
                let mut values = Vec::with_capacity(entries.len());
                for entry in entries {
                    let (Some(name), Some(raw)) = (&entry.name, entry.value) else { continue };
                    let reported = |id: &RegisterId| self.map.signal(*id).direction == Direction::Report;
                    // The survey has named those that are no reports.
                    let Some(id) = self.map.register(name).filter(reported) else { continue };
                    match read_value(raw, self.map.signal(id).ty, TextForm::Base64) {
                        Ok(value) => values.push((id, value)),
                        Err(unfit) => self.notices.add(format!("{name}: a report was left out: {}", unfit.message)),
                    }
                }
                Meaning::Reports(values)
            }
            (Body::Refused { reason }, _) => {
                self.notices.add(format!("a message that was refused is left out: {reason}"));
                Meaning::Nothing
            }
            (Body::Event(event), Sender::Operator) => {
                match Deed::read(event.text()).and_then(|deed| deed.act(self.map)) {
                    Ok(Some(act)) => return Meaning::Deed(act),
                    // A pause or a speed: nothing about the plant.
                    Ok(None) => {}
                    Err(error) => self.notices.add(format!("what an operator did was left out: {error}")),
                }
                Meaning::Nothing
            }
            _ => Meaning::Nothing,
        }
    }

    /// One tick, which begins now and ends at the next step or the next line, whichever comes first.
    fn step<R: BufRead>(
        &mut self,
        engine: &mut Engine,
        next: Instant,
        lines: &mut Lines<R>,
    ) -> Result<(), ReplayError> {
        let now = engine.now();
        let mut reports = Vec::new();
        if next <= now {
            while lines.at().is_some_and(|at| at <= now) {
                match lines.advance(self)? {
                    Some((line, Meaning::Commands(values))) => {
                        self.io.stage(&values).map_err(|source| ReplayError::Queue { line, source })?;
                    }
                    Some((_, Meaning::Reports(values))) => reports.push(values),
                    Some((_, Meaning::Deed(act))) => {
                        if let Err(error) = engine.operate(&act) {
                            self.notices.add(format!("what an operator did could not be done again: {error}"));
                        }
                    }
                    _ => {}
                }
            }
        }
        self.simulation.take(&mut self.inputs);
        let until = lines.at().map_or(Instant::FAR, |at| at).min(next_step(now, engine.step()));
        let registers = engine.tick_for(&self.inputs, until.since(now));
        self.compare(now, registers, &reports);
        Ok(())
    }

    /// Compares the model's state with the lines reported at this instant.
    fn compare(&mut self, now: Instant, registers: &[Value], reports: &[Vec<(RegisterId, Value)>]) {
        if self.survey.blind().get(self.blind).is_some_and(|last_report| *last_report < now) {
            self.blind += 1;
            self.edges.iter_mut().for_each(EdgeTrack::blind);
            self.levels.iter_mut().for_each(LevelTrack::blind);
        }
        for track in &mut self.edges {
            track.model(now, registers);
        }
        for values in reports {
            let mut sampled = [false; 2];
            for (id, value) in values {
                let signal = self.map.signal(*id);
                let place = self.places[id.index()];
                match signal.kind {
                    Kind::Edge => self.edges[place].recorded(now, value, registers),
                    Kind::Level => {
                        self.levels[place].recorded(value);
                        sampled[signal.rate as usize] = true;
                    }
                }
            }
            for track in self.levels.iter_mut().filter(|track| sampled[track.rate as usize]) {
                track.compare(now, registers);
            }
        }
        for track in &mut self.levels {
            track.silence(now, registers);
        }
    }

    fn finish(mut self, engine: &Engine) -> Report {
        let edges = self.edges.iter_mut().filter_map(|track| track.finish(self.map.signal(track.id))).collect();
        let levels = self.levels.iter().filter_map(|track| track.finish(self.map.signal(track.id))).collect();
        Report::new(engine, self.map, self.survey, &self.tolerances, (levels, edges), self.notices)
    }
}

/// The first step after `now`; steps are counted from 0.
fn next_step(now: Instant, step: Duration) -> Instant {
    let step = i64::try_from(step.as_nanos()).unwrap_or(i64::MAX).max(1);
    Instant::from_nanos(now.nanos().div_euclid(step).saturating_add(1).saturating_mul(step))
}
