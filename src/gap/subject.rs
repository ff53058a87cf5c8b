//! One device alone: driven by the recorded commands and by what its neighbours reported, it predicts its own reports.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use super::alone::{self, Alone, Watch};
use super::apart::apart;
use super::bay::Bay;
use super::beginning;
use super::cost::residual;
use super::floor::{Floor, step_of};
use super::grid::median;
use super::layout::Beside;
use super::link;
use super::overrides::{Overrides, as_modelled};
use super::prediction::{Predicted, Prediction};
use super::recording::{Beat, Recording, Stamped, TaskId};
use super::restarts::Restarts;
use super::samples::Samples;
use super::schedule::Course;
use super::score::{Foreseen, Score, SignalScore};
use super::shifts::{Barrier, likeliest_shifts, relengthed};
use super::study::Grids;
use super::surroundings::{self, Sizes};
use super::task::{Task, Ways};
use super::tolerance::rests;
use super::track::Track;
use super::world::{Script, is_one_length};
use crate::device::Device;
use crate::effect::{self, CARRIES_PARTS, EffectError, SHARES_A_SUPPLY};
use crate::plant::{EffectSpec, ParameterValue, Parameters, Plant};
use crate::prototype::kind::{KindDescriptor, PortDescriptor, PortType};
use crate::prototype::quantity::si_unit;
use crate::signal_map::{Direction, Kind, RegisterId};
use crate::trace::Commands;
use crate::value::Quantity;

/// How far a sensor may be off in time where nothing better is known, s.
const EDGE_SIGMA_S: f64 = 3e-4;
/// The same of a level whose instants are whole ticks.
const EXACT_S: f64 = 10e-6;
/// As near as an edge is known at all: a tick, s.
pub(super) const LEAST_EDGE_SIGMA_S: f64 = 1e-4;

/// A report of a subject.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalInfo {
    /// As in the trace: `Axis.position`.
    pub name: String,
    pub register: RegisterId,
    /// The port of the device's kind, and its description.
    pub port: usize,
    pub descriptor: &'static PortDescriptor,
    /// As the device's kind calls it: `position`. What an effect's component names.
    pub property: String,
    pub kind: Kind,
    /// The SI unit of its values: `m`, `rad/s`, `1`.
    pub unit: String,
    /// A counter: its values are whole, rounded down.
    pub is_count: bool,
}

/// A recording, as one device lived through it.
#[derive(Clone, Debug)]
pub struct Run {
    /// The recording's name.
    pub recording: String,
    /// When its last line was, s.
    pub ends: f64,
    /// What the device was told, each value with its port; in the order of time.
    pub commands: Vec<(usize, Stamped)>,
    /// What it reported, in the order of [`Subject::signals`]; `None` where the recording does not hold it.
    pub tracks: Vec<Option<Track>>,
    /// The floors of its levels, in the same order.
    pub floors: Vec<Floor>,
    /// How far the edges of each signal may be off in time, standard deviation, s, in the same order.
    pub edge_sigmas: Vec<f64>,
    /// Of each level, in the same order, where it rests.
    pub(super) rests: Vec<Vec<bool>>,
    /// Of each level, in the same order, which samples repeat the one before; empty where each prediction says that anew.
    pub(super) repeated: Vec<Vec<bool>>,
    /// What surrounds the device: parts that pass, as far as they were recorded.
    pub script: Arc<Script>,
    /// The same with what its neighbours did.
    pub(super) among_neighbours: Arc<Script>,
    /// How long the parts may be that pass it, m of its way.
    pub(super) part_lengths: Vec<f64>,
    /// Whether the recording starts under way, so that the device is given time to settle at its first commands.
    pub(super) settles: bool,
    /// Whether it goes on with a recording whose commands are lost, so that nobody knows where the device is.
    pub(super) resumes: bool,
    /// At equal times, whether a report already follows a command: so with steps of ours.
    pub(super) commands_first: bool,
    /// The tick at which the machine looked at its state, s; 0: none.
    pub(super) sample_tick: f64,
    /// The task that took commands up, and how late it reports.
    pub(super) task: Task,
    /// How far its instants are off one by one, standard deviation, s, where its task is known.
    pub(super) timing_s: Option<f64>,
    /// Parameters of the device that were set up otherwise than the model has them while this was recorded, SI.
    pub settings: BTreeMap<String, f64>,
    /// Of a bay: what its parts meet.
    pub(super) course: Option<Arc<Course>>,
    /// Where the device is taken up again; `None`: it is replayed in one go from rest.
    pub(super) restarts: Option<Arc<Restarts>>,
}

impl Run {
    /// The tick at which the machine took this device's commands up, s; 0: at once.
    pub fn command_tick(&self) -> f64 {
        self.task.every_s
    }

    /// How long the parts may be that pass, m, those that should be `declared` being as long as they were made.
    fn with_length(&self, declared: f64, made: f64) -> Vec<f64> {
        self.part_lengths.iter().map(|length| if is_one_length(*length, declared) { made } else { *length }).collect()
    }
}

/// How well the instants of a run are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Timing {
    /// As well as with a tick that is right: while ticks compete.
    Exact,
    /// As what was found says.
    AsFound,
}

/// A device of a plant with what the recordings say of it. May be shared between threads; every prediction builds a device
/// of its own.
#[derive(Clone, Debug)]
pub struct Subject {
    pub id: TaskId,
    /// The instance's name, and the task's where it has several.
    pub name: String,
    pub kind: &'static KindDescriptor,
    /// The nominal parameters, SI: as the model's own `parameter-error`s have them.
    pub parameters: Parameters,
    /// What else the model already adds to the nominal law.
    pub effects: Vec<EffectSpec>,
    /// The device's reports that have a signal.
    pub signals: Vec<SignalInfo>,
    /// One for each recording.
    pub runs: Vec<Run>,
    /// Of a belt: the one bay that feeds it, whose parts lie along it.
    pub(super) bay: Option<Bay>,
    /// What the likeliest task has it that nominal parameters are, where the search for them begins.
    pub(super) likely: Overrides,
    /// The instance's name, from which all that is random about the device follows.
    pub(super) instance: String,
    /// The ports that have a signal and take commands.
    pub(super) commanded: Vec<usize>,
}

impl Subject {
    /// The device `id` of `plant` in each of `recordings`, whose grids stand in `grids`.
    pub(super) fn new(plant: &Plant, id: TaskId, recordings: &[Recording], grids: &[Grids]) -> Subject {
        let (instance, task) = (id.instance(plant), id.task(plant));
        let tasks: Vec<&str> = instance.tasks.iter().map(|task| task.name.as_str()).collect();
        let signals = signals_of(plant, id);
        let commanded = ports(plant, id, Direction::Command);
        let runs = recordings.iter().zip(grids).map(|(recording, grids)| {
            let track = |info: &SignalInfo| track_of(plant, info, recording, grids);
            let tracks: Vec<Option<Track>> = signals.iter().map(track).collect();
            Run {
                recording: recording.name.clone(),
                ends: recording.ends,
                commands: commands_of(plant, (id.task(plant).kind, &commanded), (&signals, &tracks), recording),
                settles: settles(plant, &commanded, recording),
                resumes: recording.resumes,
                tracks,
                floors: vec![Floor { step: 1.0, ..Floor::default() }; signals.len()],
                edge_sigmas: vec![EDGE_SIGMA_S; signals.len()],
                rests: vec![Vec::new(); signals.len()],
                repeated: vec![Vec::new(); signals.len()],
                script: Arc::default(),
                among_neighbours: Arc::default(),
                part_lengths: Vec::new(),
                commands_first: recording.step().is_some() || is_sampled(recording),
                sample_tick: 0.0,
                task: Task::default(),
                timing_s: None,
                settings: recording.settings.get(&id).cloned().unwrap_or_default(),
                course: None,
                restarts: None,
            }
        });
        let effects = effect::of_task(&instance.effects, &task.name, &tasks);
        let (parameters, effects) = as_modelled(task.kind, &task.parameters, &instance.name, effects);
        Subject {
            id,
            name: id.name(plant),
            kind: task.kind,
            parameters,
            effects,
            runs: runs.collect(),
            signals,
            bay: None,
            likely: Overrides::none(),
            instance: instance.name.clone(),
            commanded: commanded.into_iter().map(|(port, _)| port).collect(),
        }
    }

    /// What the device would have reported with `effects` beside those of the model and with `overrides` in place of its
    /// nominal parameters: forward, at the exact times of its commands, in all runs.
    ///
    /// # Errors
    /// Effects or parameters that do not fit the device, or that are out of their ranges.
    pub fn predict(&self, effects: &[EffectSpec], overrides: &Overrides) -> Result<Prediction, EffectError> {
        let device = self.device(effects, overrides)?;
        let asks = |spec: &EffectSpec| [SHARES_A_SUPPLY, CARRIES_PARTS].contains(&spec.kind.as_str());
        let asks_neighbours = self.effects.iter().chain(effects).any(asks);
        let made = self.bay.as_ref().map(|bay| Ok::<_, EffectError>((bay, bay.length(effects)?))).transpose()?;
        let made = made.filter(|(bay, made)| !is_one_length(bay.declared, *made));
        let run = |run: &Run| -> Result<Vec<Predicted>, EffectError> {
            let set_up = match run.settings.is_empty() {
                true => None,
                false => Some(self.set_up(&run.settings, effects, overrides)?),
            };
            let handed = link::before_the_task(run, self.kind, self.effects.iter().chain(effects));
            let unfiltered = match handed.as_ref().is_some_and(|handed| handed.is_filtered) {
                true => Some(self.device_with(&|spec| !link::filters_commands(spec), effects, overrides)?),
                false => set_up,
            };
            let device = unfiltered.as_ref().unwrap_or(&device);
            let run = handed.as_ref().map_or(run, |handed| &handed.run);
            if let (Some(course), [track]) = (&run.course, run.tracks.as_slice()) {
                let rises = |track: &Track| course.rises(device.boxed(), track);
                return Ok(vec![track.as_ref().map_or(Predicted::Nothing, rises)]);
            }
            let watch = |(info, track)| self.watch(info, track, run);
            let watches: Vec<Watch<'_>> = self.signals.iter().zip(&run.tracks).map(watch).collect();
            let script = if asks_neighbours { &run.among_neighbours } else { &run.script };
            let barriers = [0, 1].map(|beam| self.signals.iter().find(|info| beam_of(info) == Some(beam)));
            let barriers = barriers.map(|barrier| barrier.map(|info| info.property.as_str()));
            let sooner = link::before_the_report(script, barriers, self.effects.iter().chain(effects));
            let script = sooner.as_ref().unwrap_or(script);
            let longer = made.map(|(bay, made)| script.with_parts_of(bay.declared, made, bay.at));
            let (script, part_lengths) = match (&longer, made) {
                (Some(longer), Some((bay, made))) => (longer, Cow::Owned(run.with_length(bay.declared, made))),
                _ => (script, Cow::Borrowed(&run.part_lengths)),
            };
            let replay = |script: &Arc<Script>| {
                let mut predicted =
                    alone::run(Alone::new(device.boxed(), self.kind.ports.len(), script), run, &watches);
                for (predicted, watch) in predicted.iter_mut().zip(&watches) {
                    // By the clock of the reports.
                    predicted.come_sooner(watch.lead);
                }
                predicted
            };
            let mut predicted = replay(script);
            if let Some(other) = relengthed(script, &part_lengths, &self.barriers(run, &predicted)) {
                predicted = replay(&Arc::new(other));
            }
            self.count_on(run, &mut predicted);
            Ok(predicted)
        };
        Ok(Prediction { runs: self.runs.iter().map(run).collect::<Result<_, _>>()? })
    }

    /// The device set up otherwise: a nominal parameter that is wrong is wrong by the same factor there.
    fn set_up(
        &self,
        settings: &BTreeMap<String, f64>,
        effects: &[EffectSpec],
        overrides: &Overrides,
    ) -> Result<Box<dyn Device>, EffectError> {
        let factor = |name: &String| match self.parameters.0.get(name.as_str()).map(|parameter| &parameter.value) {
            Some(ParameterValue::Number(nominal)) if *nominal != 0.0 => settings.get(name).map(|set| set / nominal),
            _ => None,
        };
        let mut numbers = overrides.clone();
        for (name, value) in &mut numbers.0 {
            *value *= factor(name).unwrap_or(1.0);
        }
        let mut effects = effects.to_vec();
        let mut wrong: Vec<&String> = Vec::new();
        for effect in effects.iter_mut().filter(|effect| effect.kind == "parameter-error") {
            let Some((name, factor)) = effect.component.as_ref().and_then(|name| Some((name, factor(name)?))) else {
                continue;
            };
            if let Some(ParameterValue::Number(value)) = effect.parameters.get_mut("value") {
                *value *= factor;
                wrong.extend(settings.keys().find(|set| *set == name));
            }
        }
        for (name, value) in settings.iter().filter(|(name, _)| !wrong.contains(name)) {
            numbers.0.entry(name.clone()).or_insert(*value);
        }
        self.device(&effects, &numbers)
    }

    /// A counter that a recording finds at some count counts on from there: where it began is no gap.
    fn count_on(&self, run: &Run, predicted: &mut [Predicted]) {
        for (signal, _) in self.signals.iter().enumerate().filter(|(_, info)| info.is_count) {
            if let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &mut predicted[signal]) {
                track.count_on(values);
            }
        }
    }

    fn watch<'a>(&self, info: &SignalInfo, track: &'a Option<Track>, run: &Run) -> Watch<'a> {
        let speeds = [Quantity::Velocity, Quantity::AngularVelocity];
        let is_speed = info.kind == Kind::Level && speeds.iter().any(|of| info.descriptor.quantities.contains(of));
        Watch { port: info.port, track: track.as_ref(), lead: self.lead(info, run), beam: beam_of(info), is_speed }
    }

    /// Compares a prediction of this subject with what was recorded.
    pub fn score(&self, prediction: &Prediction) -> Score {
        let mut scores = Vec::new();
        for (at, (run, predicted)) in self.runs.iter().zip(&prediction.runs).enumerate() {
            let shifts = self.shifts(run, predicted);
            for (signal, info) in self.signals.iter().enumerate() {
                let Some(track) = &run.tracks[signal] else { continue };
                scores.extend(match &predicted[signal] {
                    Predicted::Nothing => None,
                    Predicted::Level(values) => {
                        Some(SignalScore::level((signal, at), track, values, &run.weighed(signal), info.is_count))
                    }
                    Predicted::Edges { initial, edges, unseen, turns } => {
                        let foreseen = Foreseen { initial: *initial, edges, unseen, turns, shifts: &shifts };
                        Some(SignalScore::edges((signal, at), track, &foreseen, run.edge_sigmas[signal]))
                    }
                });
            }
        }
        scores.sort_by_key(|score| (score.signal, score.run));
        Score::of(scores)
    }

    /// [`Score::residuals`] of [`Subject::score`], and nothing else of it: what a fit asks for thousands of times.
    pub fn residuals(&self, prediction: &Prediction) -> Vec<f64> {
        let samples = self.runs.iter().flat_map(|run| run.tracks.iter().flatten()).map(|track| track.values.len());
        let mut residuals = Vec::with_capacity(samples.sum::<usize>() + 64);
        let pairs = || self.runs.iter().zip(&prediction.runs);
        let shifts: Vec<Vec<f64>> = pairs().map(|(run, predicted)| self.shifts(run, predicted)).collect();
        for (signal, info) in self.signals.iter().enumerate() {
            for (at, (run, predicted)) in pairs().enumerate() {
                match (&run.tracks[signal], &predicted[signal]) {
                    (Some(track), Predicted::Level(values)) => {
                        let weighed = run.weighed(signal);
                        let samples = Samples::new(track, values, &weighed, info.is_count);
                        samples.each(|sample| residuals.push(residual(sample.cost, sample.difference)));
                    }
                    (Some(track), Predicted::Edges { initial, edges, unseen, turns }) => {
                        let foreseen = Foreseen { initial: *initial, edges, unseen, turns, shifts: &shifts[at] };
                        let score = SignalScore::edges((signal, at), track, &foreseen, run.edge_sigmas[signal]);
                        score.add_residuals(&mut residuals);
                    }
                    _ => {}
                }
            }
        }
        residuals
    }

    /// How much further each part of a run was than its first edge said, m: see [`super::shifts`].
    fn shifts(&self, run: &Run, predicted: &[Predicted]) -> Vec<f64> {
        likeliest_shifts(&self.barriers(run, predicted))
    }

    /// The barriers of a run that parts pass.
    fn barriers<'a>(&self, run: &'a Run, predicted: &'a [Predicted]) -> Vec<Barrier<'a>> {
        let signals = run.tracks.iter().zip(predicted).zip(&run.edge_sigmas);
        signals
            .filter_map(|((track, predicted), sigma)| match (track, predicted) {
                (Some(track), Predicted::Edges { edges, .. }) if !track.origins.is_empty() => {
                    Some(Barrier { track, predicted: edges, sigma: *sigma })
                }
                _ => None,
            })
            .collect()
    }

    /// Whether it reports how far or how fast it is, and not only states.
    pub(super) fn has_levels(&self) -> bool {
        self.runs.iter().flat_map(|run| run.tracks.iter().flatten()).any(|track| !track.values.is_empty())
    }

    /// The signals that sensors make of what they see, not the drive's own states.
    pub(super) fn sensors(&self) -> impl Iterator<Item = usize> {
        let is_sensor = |info: &SignalInfo| {
            beam_of(info).is_some() || matches!(info.property.as_str(), "limitExtended" | "limitRetracted" | "vacuumOn")
        };
        self.signals.iter().enumerate().filter(move |(_, info)| is_sensor(info)).map(|(place, _)| place)
    }

    /// Sets how far the edges of a run's sensors may be off in time, s; the drive's own states are as good as a tick.
    pub(super) fn set_edge_sigma(&mut self, run: usize, sigma: f64) {
        self.runs[run].edge_sigmas.fill(LEAST_EDGE_SIGMA_S);
        for place in self.sensors().collect::<Vec<_>>() {
            self.runs[run].edge_sigmas[place] = sigma;
        }
    }

    /// How far two predictions lie apart in units of the noise, as residuals of least squares: of a level sample by sample,
    /// of an edge in its time, with that of a cycle as far as it is hidden by it. What tells two causes apart on these very
    /// recordings.
    pub fn apart(&self, one: &Prediction, other: &Prediction) -> Vec<f64> {
        let mut residuals = Vec::new();
        for (run, (one, other)) in self.runs.iter().zip(one.runs.iter().zip(&other.runs)) {
            for (signal, pair) in one.iter().zip(other).enumerate() {
                apart(run, signal, pair, &mut residuals);
            }
        }
        residuals
    }

    /// The device as the model has it, with `effects` beside its own.
    pub(super) fn device(&self, effects: &[EffectSpec], overrides: &Overrides) -> Result<Box<dyn Device>, EffectError> {
        self.device_with(&|_| true, effects, overrides)
    }

    /// The same with those of all effects that `is_there` says.
    fn device_with(
        &self,
        is_there: &dyn Fn(&EffectSpec) -> bool,
        effects: &[EffectSpec],
        overrides: &Overrides,
    ) -> Result<Box<dyn Device>, EffectError> {
        let is_own = |spec: &&EffectSpec| self.bay.is_none() || !Bay::is_of(&spec.kind);
        let own = self.effects.iter().chain(effects.iter().filter(is_own)).filter(|spec| is_there(spec)).cloned();
        let all: Vec<EffectSpec> = own.chain(overrides.effects()).collect();
        let mut device = effect::build(self.kind, &self.parameters, &self.instance, &all, 0)?;
        device.count_finely();
        for port in &self.commanded {
            device.command(*port, 0.0);
        }
        Ok(device)
    }

    /// Finds out what surrounded the device in each run: see [`surroundings`].
    pub(super) fn surround(&mut self, sizes: &Sizes, beside: &[Beside]) -> Result<(), EffectError> {
        let device = self.device(&[], &Overrides::none())?;
        for both in beside.iter().zip(&mut self.runs) {
            surroundings::surround(self.kind, &self.parameters, &self.signals, device.as_ref(), sizes, both);
        }
        Ok(())
    }

    /// Leaves out what recordings that begin under way say of a state that nobody knows.
    pub(super) fn await_agreement(&mut self, nominal: &Prediction) {
        let signals = &self.signals;
        let runs = self.runs.iter_mut().zip(&nominal.runs);
        runs.for_each(|(run, predicted)| beginning::await_agreement(signals, run, predicted));
    }

    /// Whether it is a bay, which reports nothing itself: see [`super::schedule`].
    pub(super) fn is_bay(&self) -> bool {
        self.runs.iter().any(|run| run.course.is_some())
    }

    /// Whether an effect fits the device, or the bay that feeds it.
    pub(super) fn takes(&self, effect: &EffectSpec) -> bool {
        let effects = std::slice::from_ref(effect);
        let bay_takes = self.bay.as_ref().is_none_or(|bay| bay.length(effects).is_ok());
        bay_takes && self.device(effects, &Overrides::none()).is_ok()
    }

    /// The same device in one of its runs.
    pub fn only(&self, run: usize) -> Subject {
        Subject { runs: vec![self.runs[run].clone()], ..self.clone() }
    }

    /// The same device of which only levels are looked at: a replay then need not find when states change.
    pub(super) fn of_levels(mut self) -> Subject {
        let is_state = |track: &Option<Track>| track.as_ref().is_some_and(|track| track.values.is_empty());
        let tracks = self.runs.iter_mut().flat_map(|run| &mut run.tracks);
        tracks.filter(|track| is_state(track)).for_each(|track| *track = None);
        self
    }

    /// Sets the ticks of a run, s: that at which the machine looked at the device, and that at which it took commands up.
    pub(super) fn set_tick(&mut self, run: usize, sample_tick: f64, command_tick: f64) {
        let run = &mut self.runs[run];
        run.sample_tick = sample_tick;
        run.task.every_s = command_tick;
    }

    /// Sets what is common to all devices of a run.
    pub(super) fn set_task(&mut self, run: usize, task: Task) {
        self.runs[run].task = task;
    }

    /// Has the reports of all runs be older by so much, s.
    pub(super) fn let_reports_be_older(&mut self, by_s: f64) {
        self.runs.iter_mut().for_each(|run| run.task.age_s += by_s);
    }

    /// Has the commands of a run act as much later than their stamps say as their ways were longer than most.
    pub(super) fn act_later(&mut self, run: usize, ways: &Ways) {
        let run = &mut self.runs[run];
        run.task.scatter_s = ways.scatter_s;
        run.commands.iter_mut().for_each(|(_, told)| told.at += ways.later(told.at));
        run.commands.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
    }

    /// Takes the ticks of a run from the one before it.
    pub(super) fn keep_tick(&mut self, run: usize) {
        let before = &self.runs[run - 1];
        let (sample_tick, task, timing_s) = (before.sample_tick, before.task, before.timing_s);
        self.runs[run].sample_tick = sample_tick;
        self.runs[run].timing_s = timing_s;
        self.set_task(run, task);
    }

    /// Finds the floors of all levels from the recordings and a prediction, which may be wrong: what it gets wrong is slow
    /// beside noise.
    pub(super) fn find_floors(&mut self, prediction: &Prediction, timing: Timing) {
        let is_servo = self.kind.name == "kinetwin.ServoAxis";
        for (run, predicted) in self.runs.iter_mut().zip(&prediction.runs) {
            for (signal, info) in self.signals.iter().enumerate() {
                let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &predicted[signal]) else {
                    continue;
                };
                let is_exact = timing == Timing::Exact || run.sample_tick > 0.0 || run.commands_first;
                let off = match run.timing_s {
                    _ if is_exact => EXACT_S,
                    Some(timing_s) => timing_s,
                    None => 50e-6_f64.hypot(track.grid.spread),
                };
                let is_coarse = is_servo && info.property == "force" && (is_exact || run.timing_s.is_some());
                let timing = if is_coarse { 2.5 * off } else { off };
                let (recorded, predicted) = track.evident(values);
                let floor = Floor::of(&track.grid, &recorded, &predicted, timing, info.is_count);
                run.floors[signal] = Floor { sharpness: run.floors[signal].sharpness, ..floor };
                run.rests[signal] = rests(track, values, run.floors[signal].step);
            }
        }
    }

    /// Finds the floors again from a prediction that knows more; whether any of them is another now. Those of a device that is taken
    /// up again and again stay as they are.
    pub(super) fn find_floors_again(&mut self, prediction: &Prediction) -> bool {
        const OTHER: f64 = 0.05;
        if self.is_taken_up_again() {
            return false;
        }
        let before: Vec<Floor> = self.runs.iter().flat_map(|run| run.floors.iter().copied()).collect();
        self.find_floors(prediction, Timing::AsFound);
        let after = self.runs.iter().flat_map(|run| &run.floors);
        let is_other = |(before, after): (&Floor, &Floor)| {
            (after.noise - before.noise).abs() > OTHER * after.step.max(before.noise)
                || (after.memory - before.memory).abs() > OTHER
        };
        before.iter().zip(after).any(is_other)
    }

    /// Whether a signal is a contact, which comes through the filter of an input; a word does not.
    pub(super) fn is_filtered(&self, info: &SignalInfo) -> bool {
        info.descriptor.ty == PortType::Boolean
    }

    /// How far behind its instant a signal is looked at, s. A drive's force is that of the tick that follows: in its middle; what
    /// is old or filtered is of an instant before.
    pub(super) fn lead(&self, info: &SignalInfo, run: &Run) -> f64 {
        let is_force = self.kind.name == "kinetwin.ServoAxis" && info.property == "force";
        let ahead = if is_force { 0.5 * run.sample_tick } else { 0.0 };
        let filter = if self.is_filtered(info) { run.task.filter_s } else { 0.0 };
        ahead - run.task.age_s - filter
    }
}

/// The beam that a signal reports.
pub(super) fn beam_of(info: &SignalInfo) -> Option<usize> {
    match info.property.as_str() {
        "lightBarrierA" | "lightbarrierA" => Some(0),
        "lightBarrierB" | "lightbarrierB" => Some(1),
        _ => None,
    }
}

fn ports(plant: &Plant, id: TaskId, direction: Direction) -> Vec<(usize, RegisterId)> {
    let task = id.task(plant);
    let bound = task.ports.iter().enumerate().filter_map(|(port, register)| Some((port, (*register)?)));
    bound.filter(|(port, _)| task.kind.ports[*port].direction == direction).collect()
}

fn signals_of(plant: &Plant, id: TaskId) -> Vec<SignalInfo> {
    let kind = id.task(plant).kind;
    let info = |(port, register): (usize, RegisterId)| {
        let signal = plant.signal_map.signal(register);
        let descriptor = &kind.ports[port];
        SignalInfo {
            name: signal.name.clone(),
            register,
            port,
            descriptor,
            property: descriptor.name.to_owned(),
            kind: signal.kind,
            unit: si_unit(signal.unit.quantity).to_string(),
            is_count: signal.kind == Kind::Level && descriptor.ty == PortType::Integer,
        }
    };
    ports(plant, id, Direction::Report).into_iter().map(info).collect()
}

fn track_of(plant: &Plant, info: &SignalInfo, recording: &Recording, grids: &Grids) -> Option<Track> {
    let signal = plant.signal_map.signal(info.register);
    let grid = grids.of(recording.clock_of(info.register), Beat::of(signal));
    let stamped = recording.values(info.register);
    match info.kind {
        Kind::Level => {
            Track::level(grid, recording, stamped).map(|track| if info.is_count { track.unwrapped() } else { track })
        }
        Kind::Edge => Track::edge(grid, recording, stamped),
    }
}

/// Whether its commands are samples of references that move on straight lines between them.
fn is_sampled(recording: &Recording) -> bool {
    recording.header.commands == Commands::Sampled
}

fn commands_of(
    plant: &Plant,
    (kind, commanded): (&KindDescriptor, &[(usize, RegisterId)]),
    (signals, tracks): (&[SignalInfo], &[Option<Track>]),
    recording: &Recording,
) -> Vec<(usize, Stamped)> {
    let of = |(port, register): &(usize, RegisterId)| {
        let port = *port;
        let told = recording.values(*register);
        let is_level = plant.signal_map.signal(*register).kind == Kind::Level;
        let like = |info: &SignalInfo| info.descriptor.quantities == kind.ports[port].quantities;
        let alike = signals.iter().zip(tracks).filter(|(info, _)| like(info)).filter_map(|(_, track)| track.as_ref());
        let finest = alike.map(|track| step_of(&track.values)).fold(f64::INFINITY, f64::min);
        let told = if is_level && is_sampled(recording) { on_lines(told, finest) } else { told.to_vec() };
        told.into_iter().map(move |stamped| (port, stamped))
    };
    let mut commands: Vec<(usize, Stamped)> = commanded.iter().flat_map(of).collect();
    commands.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
    commands
}

/// Samples with the straight lines between them, in short steps that each hold their middle; not over a gap in time. The steps are
/// lower than a quarter of `seen`, the finest step that reports of the quantity show, as far as ten of them do.
fn on_lines(samples: &[Stamped], seen: f64) -> Vec<Stamped> {
    const MOST_PARTS: f64 = 10.0;
    const SHORT_S: f64 = 2e-3;
    const GAP: f64 = 5.0;
    let spans: Vec<f64> = samples.windows(2).map(|pair| pair[1].at - pair[0].at).collect();
    let usual = median(&spans).unwrap_or(0.0);
    let mut on_lines = Vec::with_capacity(4 * samples.len());
    for pair in samples.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        on_lines.push(from);
        if to.at - from.at > GAP * usual || from.value == to.value {
            continue;
        }
        let height = (to.value - from.value).abs();
        let by_height = if seen.is_finite() { (4.0 * height / seen).ceil() } else { MOST_PARTS };
        let parts = ((to.at - from.at) / SHORT_S).ceil().min(by_height).clamp(1.0, MOST_PARTS);
        for part in 0..parts as u32 {
            let share = |of: f64| (f64::from(part) + of) / parts;
            let at = from.at + share(0.0) * (to.at - from.at) + 1e-9;
            on_lines.push(Stamped { at, value: from.value + share(0.5) * (to.value - from.value) });
        }
    }
    on_lines.extend(samples.last());
    on_lines
}

/// Whether a machine's recording starts with references that are not 0: then it had gone there before.
fn settles(plant: &Plant, commanded: &[(usize, RegisterId)], recording: &Recording) -> bool {
    let first = recording.stamps.iter().filter_map(|stamps| stamps.first()).copied().fold(f64::INFINITY, f64::min);
    let is_under_way = |(_, register): &(usize, RegisterId)| {
        let is_level = plant.signal_map.signal(*register).kind == Kind::Level;
        is_level && recording.values(*register).first().is_some_and(|told| told.at <= first && told.value != 0.0)
    };
    recording.resumes || recording.step().is_none() && commanded.iter().any(is_under_way)
}
