//! A plant and its recordings, made ready: grids, ticks, floors, and one subject for each device.

use std::sync::Arc;

use rayon::prelude::*;

use super::age;
use super::bay::Bay;
use super::cause::Bare;
use super::clocks::{self, ClockOffset};
use super::filter;
use super::grid::Grid;
use super::layout::Layout;
use super::locate::{THRESHOLD, evidence};
use super::neighbours;
use super::overrides::Overrides;
use super::prediction::Prediction;
use super::recording::{Beat, Recording, TaskId};
use super::score::{Score, SignalScore};
use super::stamps;
use super::subject::{Subject, Timing};
use super::surroundings::{self, Sizes};
use super::task::{self, Task};
use super::tick::{self, Vote};
use crate::effect::EffectError;
use crate::plant::{EffectSpec, Plant};
use crate::trace::Commands;

/// Why there is nothing to study.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    #[error("no recording was given: a diagnosis needs at least one")]
    NoRecording,
    #[error("the model cannot be replayed: {0}")]
    Model(#[from] EffectError),
}

/// Of the effects of a device those beside which what is common to all is found: a belt's own, and not what is found of its bay there; and none of a device
/// on a spring, which takes minutes to be asked.
pub(super) fn told_beside(added: &[EffectSpec]) -> impl Iterator<Item = &EffectSpec> {
    let is_on_a_spring = added.iter().any(|spec| spec.kind == "compliance");
    added.iter().filter(move |spec| !is_on_a_spring && !Bay::is_of(&spec.kind))
}

/// Everything a diagnosis asks.
#[derive(Clone, Debug)]
pub struct Study {
    /// One for each task that has a signal, in the plant's order.
    pub subjects: Vec<Subject>,
    /// What the model alone predicts of each, in their order.
    pub nominal: Vec<Prediction>,
    /// The same with its nominal parameters as they fit best within their tolerances, which is no gap.
    pub bare: Vec<Bare>,
    /// The tick of the machine in each recording, s; 0: none was found.
    pub ticks: Vec<f64>,
    /// When the machine looked at its state, by recording.
    pub grids: Vec<Grids>,
    /// What the machine's task does to all devices alike, by recording.
    pub tasks: Vec<Task>,
    /// How far the other clocks of each recording are off that of its commands.
    pub clocks: Vec<Vec<ClockOffset>>,
}

/// When what is told acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Told {
    /// As it is stamped.
    AsStamped,
    /// As its way has it, where ways scatter.
    AsItActs,
}

/// What is known of recordings before they are looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beforehand<'a> {
    pub known: Known<'a>,
    pub told: Told,
    /// What each of the plant's devices has besides what the model says, in their order; empty: nothing.
    pub added: &'a [Vec<EffectSpec>],
}

impl Beforehand<'_> {
    /// Nothing is known.
    pub const NOTHING: Beforehand<'static> = Beforehand { known: Known::Nothing, told: Told::AsItActs, added: &[] };
}

/// What is known of the machine's task.
#[derive(Clone, Copy, Debug)]
pub(super) enum Known<'a> {
    Nothing,
    /// Tasks of the machine, each with the cycle of the recording that it was found in.
    OfItsCycle(&'a [(f64, Task)]),
    /// All of it, as another study of the same recordings has it.
    As(&'a Study),
    /// The same of recordings that are held out: how far their instants are off is not fitted to them.
    AsHeldOut(&'a Study),
}

impl Study {
    /// Reads all that can be known without any candidate.
    ///
    /// # Errors
    /// No recording; a model whose own effects do not fit.
    pub fn new(plant: &Plant, recordings: &[Recording]) -> Result<Study, StudyError> {
        Ok(Study::beside_effects(plant, recordings, &[])?.with_bays(None)?)
    }

    /// The same where devices have these effects, in the plant's order, but for what bays make.
    pub(super) fn beside_effects(
        plant: &Plant,
        recordings: &[Recording],
        added: &[Vec<EffectSpec>],
    ) -> Result<Study, StudyError> {
        let of = |told| {
            let beforehand = Beforehand { told, added, ..Beforehand::NOTHING };
            Ok::<_, StudyError>(
                Study::aligned(plant, recordings, beforehand)?.within_tolerances(recordings, !added.is_empty()),
            )
        };
        let mut study = of(Told::AsItActs)?;
        // Where a device is wrong by so much that a motor's few counts are nothing beside it, ways may be found that are how it is wrong.
        if study.tasks.iter().any(|task| task.scatter_s > 0.0) && study.in_order() < study.subjects.len() {
            let stamped = of(Told::AsStamped)?;
            if stamped.in_order() > study.in_order() {
                study = stamped;
            }
        }
        Ok(study)
    }

    /// The same of a machine whose task is as another study of the same recordings has it.
    pub(super) fn under(plant: &Plant, recordings: &[Recording], found: &Study) -> Result<Study, StudyError> {
        let beforehand = Beforehand { known: Known::As(found), ..Beforehand::NOTHING };
        let study = Study::aligned(plant, recordings, beforehand)?;
        Ok(study.with_parameters().widely().with_bays(None)?)
    }

    /// How many of its devices are in order.
    fn in_order(&self) -> usize {
        let all = self.subjects.par_iter().zip(&self.bare);
        all.filter(|(subject, bare)| evidence(subject, &bare.prediction) <= THRESHOLD).count()
    }

    /// The same with nominal parameters as they are declared.
    fn aligned(plant: &Plant, recordings: &[Recording], beforehand: Beforehand<'_>) -> Result<Study, StudyError> {
        if recordings.iter().all(|recording| recording.clocks.is_empty()) {
            return Study::of_one_clock(plant, recordings, beforehand);
        }
        let aligned = recordings.iter().map(|recording| clocks::align(plant, recording));
        let aligned = aligned.collect::<Result<Vec<_>, _>>()?;
        let (recordings, offsets): (Vec<Recording>, Vec<_>) = aligned.into_iter().unzip();
        Ok(Study { clocks: offsets, ..Study::of_one_clock(plant, &recordings, beforehand)? })
    }

    /// The same, of recordings whose stamps are taken as they are.
    pub(super) fn of_one_clock(
        plant: &Plant,
        recordings: &[Recording],
        beforehand: Beforehand<'_>,
    ) -> Result<Study, StudyError> {
        if recordings.is_empty() {
            return Err(StudyError::NoRecording);
        }
        let grids: Vec<Grids> = recordings.iter().map(Grids::new).collect();
        let ids = TaskId::all(plant);
        let mut subjects: Vec<Subject> =
            ids.into_par_iter().map(|id| Subject::new(plant, id, recordings, &grids)).collect();
        for (subject, added) in subjects.iter_mut().zip(beforehand.added) {
            subject.effects.extend(told_beside(added).cloned());
        }
        subjects
            .par_iter_mut()
            .try_for_each(|subject| calibrate(subject).map(|nominal| subject.await_agreement(&nominal)))?;
        let mut ticks = Vec::new();
        for (run, recording) in recordings.iter().enumerate() {
            let tick = match ticks.last() {
                // Steps of ours are no tick to be found.
                _ if recording.step().is_some() => 0.0,
                // The rest of a recording is of the same machine.
                Some(tick) if recording.resumes => {
                    subjects.iter_mut().for_each(|subject| subject.keep_tick(run));
                    let scatter_s = subjects.first().map_or(0.0, |subject| subject.runs[run].task.scatter_s);
                    if scatter_s > 0.0 {
                        let bare = within_tolerances(&mut subjects)?;
                        find_ways(&mut subjects, &bare, run, Some(scatter_s))?;
                    }
                    *tick
                }
                _ => {
                    let tick = find_tick(&mut subjects, run, &grids[run].main)?;
                    find_task(&mut subjects, run, &grids[run].main, beforehand)?.unwrap_or(tick)
                }
            };
            ticks.push(tick);
        }
        let sizes = surroundings::part_sizes(plant);
        let layout = Layout::new(plant, &subjects)?;
        let beside = layout.beside(&subjects, &|_| true)?;
        subjects.par_iter_mut().zip(&beside).try_for_each(|(subject, beside)| {
            let fed = beside.first().and_then(|beside| beside.fed);
            subject.bay = fed.and_then(|fed| Bay::of(plant, &fed));
            subject.surround(&sizes, beside)
        })?;
        (0..recordings.len()).try_for_each(|run| neighbours::tell(plant, &mut subjects, &[], run))?;
        let mut nominal = subjects.par_iter_mut().map(calibrate).collect::<Result<Vec<_>, _>>()?;
        doubt_those_with_gaps(&layout, &mut subjects, &mut nominal, &sizes)?;
        (0..recordings.len()).try_for_each(|run| neighbours::tell(plant, &mut subjects, &nominal, run))?;
        for run in 0..recordings.len() {
            find_edge_sigma(&mut subjects, &nominal, run);
        }
        let tasks =
            (0..recordings.len()).map(|run| subjects.first().map_or(Task::default(), |of| of.runs[run].task)).collect();
        Ok(Study {
            subjects,
            nominal,
            bare: Vec::new(),
            ticks,
            tasks,
            grids,
            clocks: vec![Vec::new(); recordings.len()],
        })
    }

    /// The same for recordings that `trained` has not seen. What its task does is as in the training where that has the same
    /// cycle, and only its phase is found anew, beside the effects that were `found` of each device there, in its order: what is fitted to a recording is not
    /// held out from it. The devices that are taken up again there are replayed in one go here, from where their machine was at the start.
    ///
    /// # Errors
    /// As of [`Study::new`].
    pub fn beside(
        plant: &Plant,
        recordings: &[Recording],
        trained: &Study,
        found: &[Vec<EffectSpec>],
    ) -> Result<Study, StudyError> {
        let cycles = trained.grids.iter().map(|grids| grids.main[Beat::Fast as usize].cycle);
        let known: Vec<(f64, Task)> = cycles.zip(trained.tasks.iter().copied()).collect();
        let beforehand = Beforehand { known: Known::OfItsCycle(&known), ..Beforehand::NOTHING };
        let mut study = Study::aligned(plant, recordings, beforehand)?;
        if found.iter().any(|specs| told_beside(specs).next().is_some())
            && known.iter().any(|(_, task)| task.every_s > 0.0)
        {
            let beside = Study::aligned(plant, recordings, Beforehand { added: found, ..beforehand })?;
            if !study.is_told_like(&beside) {
                let beforehand = Beforehand { known: Known::AsHeldOut(&beside), ..Beforehand::NOTHING };
                study = Study::aligned(plant, recordings, beforehand)?;
            }
        }
        for (place, subject) in study.subjects.iter_mut().enumerate() {
            if subject.take_up_like(&trained.subjects[place]) {
                study.nominal[place] = subject.predict(&[], &Overrides::none())?;
            }
        }
        let each = study.subjects.iter().zip(&study.nominal).zip(&trained.bare);
        study.bare = each.map(|((subject, nominal), bare)| bare.beside(subject, nominal)).collect();
        for (subject, bare) in study.subjects.iter_mut().zip(&study.bare) {
            subject.find_floors_again(&bare.prediction);
        }
        Ok(study.with_bays(Some(trained))?)
    }

    /// Whether the tasks of another study of the same recordings take all commands up, and report, at the same times.
    pub(super) fn is_told_like(&self, other: &Study) -> bool {
        let same = |run: usize| {
            let [a, b]: [Task; 2] = [self, other].map(|study| study.tasks[run]);
            let commands = self.subjects.iter().flat_map(|subject| &subject.runs[run].commands);
            let mut told = commands.map(|(_, told)| told.at);
            (a.age_s - b.age_s).abs() < SAME_AGE_S
                && (a.filter_s - b.filter_s).abs() < SAME_FILTER_S
                && (a.scatter_s > 0.0) == (b.scatter_s > 0.0)
                && told.all(|at| (a.taken_up(at) - b.taken_up(at)).abs() < SAME_TIME_S)
        };
        (0..self.tasks.len()).all(same)
    }

    /// The subject called so.
    pub fn subject(&self, name: &str) -> Option<&Subject> {
        self.subjects.iter().find(|subject| subject.name == name)
    }

    /// What the model alone costs, as well as its tolerances let it stand, subject by subject.
    pub fn scores(&self) -> Vec<Score> {
        self.subjects.par_iter().zip(&self.bare).map(|(subject, bare)| subject.score(&bare.prediction)).collect()
    }

    /// The same with the nominal parameters fitted, and what is common to all found once more beside them. `are_explained`: by effects, so that
    /// what is not off says something of a filter, too.
    fn within_tolerances(self, recordings: &[Recording], are_explained: bool) -> Study {
        let mut study = self.with_parameters();
        // What we recorded ourselves passed none.
        let is_machine = recordings.iter().all(|recording| recording.step().is_none());
        let known = study.tasks.iter().map(|task| task.filter_s).fold(0.0, f64::max);
        if is_machine
            && (are_explained || study.subjects.iter().zip(&study.bare).any(is_off))
            && let Some(filter_s) =
                filter::find_beside_parameters(known, &mut study.subjects, &study.nominal, &mut study.bare)
        {
            study.tasks.iter_mut().for_each(|task| task.filter_s = filter_s);
        }
        if is_machine
            && study.tasks.iter().any(|task| *task != Task::default())
            && let Some(by_s) = age::find_beside_parameters(&mut study.subjects, &mut study.nominal, &mut study.bare)
        {
            study.tasks.iter_mut().for_each(|task| task.age_s += by_s);
        }
        study.widely()
    }

    /// The same with the nominal parameters fitted.
    fn with_parameters(mut self) -> Study {
        let each = self.subjects.par_iter().zip(&self.nominal).with_max_len(1);
        self.bare = each.map(|(subject, nominal)| Bare::new(subject, nominal)).collect();
        // What a drum leaves that is a per cent too large was taken for noise so far.
        let each = self.subjects.par_iter_mut().zip(&self.nominal).zip(&mut self.bare).with_max_len(1);
        each.for_each(|((subject, nominal), bare)| {
            if subject.find_floors_again(&bare.prediction) {
                *bare = bare.again(subject, nominal);
            }
        });
        let each = self.subjects.par_iter_mut().zip(&mut self.nominal).zip(&mut self.bare).with_max_len(1);
        each.for_each(|((subject, nominal), bare)| {
            if let Some(whole) = explained_in_one_go(subject, bare) {
                (*subject, *nominal, *bare) = whole;
            }
        });
        self
    }

    /// The same with the parameters of what reports states alone and is off looked for far and wide.
    fn widely(mut self) -> Study {
        let each = self.subjects.par_iter().zip(&self.nominal).zip(&mut self.bare);
        each.filter(|((subject, _), bare)| !subject.has_levels() && is_off((*subject, &**bare)))
            .for_each(|((subject, nominal), bare)| *bare = bare.widely(subject, nominal));
        self
    }
}

/// Whether a device is off as its tolerances let it stand.
fn is_off((subject, bare): (&Subject, &Bare)) -> bool {
    evidence(subject, &bare.prediction) > THRESHOLD
}

/// The tick of a run, which is set in all subjects.
fn find_tick(subjects: &mut [Subject], run: usize, grids: &[Arc<Grid>; 3]) -> Result<f64, EffectError> {
    let main = &grids[Beat::Fast as usize];
    let ticks = if main.is_rebuilt { tick::candidates(main.cycle) } else { vec![0.0] };
    if ticks.len() < 2 {
        return Ok(0.0);
    }
    let of = |subject: &Subject| -> Result<Vec<Vote>, EffectError> {
        let votes: Result<Vec<Option<Vote>>, _> = ticks.iter().map(|tick| tick::vote(subject, run, *tick)).collect();
        Ok(votes?.into_iter().flatten().collect())
    };
    let votes = subjects.par_iter().map(of).collect::<Result<Vec<_>, _>>()?;
    let tick = tick::elect(&ticks, &votes);
    let at = ticks.iter().position(|candidate| *candidate == tick).unwrap_or(0);
    for (subject, votes) in subjects.iter_mut().zip(&votes) {
        let command_tick = tick::taken_up(subject.kind.name, tick, votes.get(at).copied());
        subject.set_tick(run, tick, command_tick);
    }
    Ok(tick)
}

/// Times of two tasks that differ by no more are one, s: how old reports are, how slow the filter of flags, and when commands are taken up.
const SAME_AGE_S: f64 = 3e-6;
const SAME_FILTER_S: f64 = 1e-4;
const SAME_TIME_S: f64 = 5e-6;
/// By how much two cycles may differ that are the same, of the cycle.
const SAME_CYCLE: f64 = 0.01;

/// What the machine's task does to all devices of a run alike, which is set in them; its tick, s, where there is such. Where one is
/// known that was found at the same cycle, it is that one, and only its phase is this run's.
fn find_task(
    subjects: &mut [Subject],
    run: usize,
    grids: &[Arc<Grid>; 3],
    Beforehand { known, told, .. }: Beforehand<'_>,
) -> Result<Option<f64>, EffectError> {
    let main = &grids[Beat::Fast as usize];
    subjects.par_iter_mut().try_for_each(|subject| calibrate(subject).map(drop))?;
    match known {
        Known::OfItsCycle(known) => {
            let is_same = |(cycle, _): &&(f64, Task)| (cycle - main.cycle).abs() <= SAME_CYCLE * main.cycle;
            if let Some((_, task)) = known.iter().find(is_same).filter(|_| main.is_rebuilt) {
                let task = task::find_phase(subjects, run, *task)?;
                return take_task(subjects, run, task, false);
            }
        }
        Known::As(found) => {
            for (subject, found) in subjects.iter_mut().zip(&found.subjects) {
                subject.likely = found.likely.clone();
            }
            return take_task(subjects, run, found.tasks[run], true);
        }
        Known::AsHeldOut(found) => return take_task(subjects, run, found.tasks[run], false),
        Known::Nothing => {}
    }
    let found = if main.is_rebuilt { task::find(subjects, run, main.cycle)? } else { None };
    let found = found.map(|(task, likely)| {
        subjects.iter_mut().for_each(|subject| {
            subject.set_tick(run, 0.0, 0.0);
            subject.set_task(run, task);
            if let Some((_, likely)) = likely.iter().find(|(id, _)| *id == subject.id) {
                subject.likely = likely.clone();
            }
        });
        task
    });
    let as_found = |subjects: &mut [Subject]| match found {
        Some(_) => find_timing(subjects, run),
        None => within_tolerances(subjects),
    };
    let mut bare = as_found(subjects)?;
    if main.is_rebuilt && told == Told::AsItActs && find_ways(subjects, &bare, run, None)? {
        bare = as_found(subjects)?;
    }
    let filter_s = if main.is_rebuilt { filter::find(subjects, &bare, run) } else { 0.0 };
    if filter_s > 0.0 {
        subjects.iter_mut().for_each(|subject| {
            let task = subject.runs[run].task;
            subject.set_task(run, Task { filter_s, ..task });
        });
    }
    Ok(found.map(|task| task.every_s))
}

/// Sets a task that is known; its tick, s, where there is such. `is_timed`: how far the instants of the run are off is found with it.
fn take_task(subjects: &mut [Subject], run: usize, task: Task, is_timed: bool) -> Result<Option<f64>, EffectError> {
    if task == Task::default() {
        return Ok(None);
    }
    // Of one that is a filter alone the tick is as it was found.
    let is_filter_alone = is_timed && Task { filter_s: 0.0, ..task } == Task::default();
    subjects.iter_mut().for_each(|subject| {
        if !is_filter_alone {
            subject.set_tick(run, 0.0, 0.0);
        }
        subject.set_task(run, task);
    });
    if is_filter_alone {
        return Ok(None);
    }
    if is_timed {
        find_timing(subjects, run)?;
    }
    if task.scatter_s > 0.0 {
        let bare = within_tolerances(subjects)?;
        find_ways(subjects, &bare, run, Some(task.scatter_s))?;
    }
    // Reports that are held out are as old as those of the training within some ten microseconds: as far as is taken of a run without a task.
    Ok(Some(task.every_s))
}

/// When the commands of a run acted whose ways scatter, which is set in all subjects; `known`: by how much they do, s.
/// Whether there are such.
fn find_ways(subjects: &mut [Subject], bare: &[Bare], run: usize, known: Option<f64>) -> Result<bool, EffectError> {
    let found = task::find_ways(subjects, bare, run, known)?;
    if let Some(ways) = &found {
        subjects.iter_mut().for_each(|subject| subject.act_later(run, ways));
    }
    Ok(found.is_some())
}

/// How far the instants of a run are off once its task is known, which is set in all subjects; each as its tolerances let it stand.
fn find_timing(subjects: &mut [Subject], run: usize) -> Result<Vec<Bare>, EffectError> {
    subjects.iter_mut().for_each(|subject| subject.runs[run].timing_s = Some(stamps::LEAST_S));
    let bare = within_tolerances(subjects)?;
    let timing_s = stamps::find(subjects, &bare, run);
    subjects.iter_mut().for_each(|subject| subject.runs[run].timing_s = Some(timing_s));
    Ok(bare)
}

/// Every subject as its tolerances let it stand.
fn within_tolerances(subjects: &mut [Subject]) -> Result<Vec<Bare>, EffectError> {
    let nominal = subjects.par_iter_mut().map(calibrate).collect::<Result<Vec<_>, _>>()?;
    let each = subjects.par_iter().zip(&nominal).with_max_len(1);
    Ok(each.map(|(subject, nominal)| Bare::roughly(subject, nominal)).collect())
}

/// The nominal prediction of a subject, and its floors with it.
fn calibrate(subject: &mut Subject) -> Result<Prediction, EffectError> {
    let nominal = subject.predict(&[], &Overrides::none())?;
    subject.find_floors(&nominal, Timing::AsFound);
    // What the model explains in one go needs no taking up again.
    if is_explained(&subject.score(&nominal)) || !subject.take_up_again()? {
        return Ok(nominal);
    }
    let nominal = subject.predict(&[], &Overrides::none())?;
    subject.find_reach(&nominal);
    Ok(nominal)
}

/// A device that is taken up again and again and is off then, in one go: where its nominal parameters, as they were found, explain it so, what
/// was off is where its windows begin. Of an axis that forgets within half of one that is worse than what its model lacks.
fn explained_in_one_go(subject: &Subject, bare: &Bare) -> Option<(Subject, Prediction, Bare)> {
    if !subject.is_taken_up_again() || evidence(subject, &bare.prediction) <= THRESHOLD {
        return None;
    }
    let mut whole = subject.clone();
    whole.leave_alone();
    let nominal = whole.predict(&[], &Overrides::none()).ok()?;
    whole.find_floors(&bare.held(&whole).prediction, Timing::AsFound);
    let found = bare.again(&whole, &nominal);
    (evidence(&whole, &found.prediction) <= THRESHOLD).then_some((whole, nominal, found))
}

/// What a belt with a gap of its own does with the parts that it takes over is seen from both sides: a belt before it takes how far
/// they went on it from when they were seen there, not from what it reported.
fn doubt_those_with_gaps(
    layout: &Layout,
    subjects: &mut [Subject],
    nominal: &mut [Prediction],
    sizes: &Sizes,
) -> Result<(), EffectError> {
    let is_off = |signal: &SignalScore| signal.cost > 18.0 + 2.0 * signal.floor_cost.0;
    let trusted = |(subject, nominal): (&Subject, &Prediction)| !subject.score(nominal).signals.iter().any(is_off);
    let is_trusted: Vec<bool> = subjects.iter().zip(nominal.iter()).map(trusted).collect();
    let beside = layout.beside(subjects, &|at| is_trusted[at])?;
    for at in 0..subjects.len() {
        if layout.follow(at).into_iter().any(|other| !is_trusted[other]) {
            subjects[at].surround(sizes, &beside[at])?;
            nominal[at] = calibrate(&mut subjects[at])?;
        }
    }
    Ok(())
}

/// Whether a score is not far above its floor.
fn is_explained(score: &Score) -> bool {
    let floor = score.total - score.excess();
    score.excess() < 18.0 + floor
}

/// How far sensors may be off in time, s: what is tried.
const EDGE_SIGMAS_S: [f64; 6] = [1e-4, 2e-4, 3e-4, 4.5e-4, 7e-4, 1e-3];

/// Finds how far the sensors of a run are off in time, one number for all: the likeliest. A sensor with a gap of its own says
/// nothing, its edges being strays whatever the number.
fn find_edge_sigma(subjects: &mut [Subject], nominal: &[Prediction], run: usize) {
    let cost = |sigma: f64| -> f64 {
        let of = |(subject, nominal): (&Subject, &Prediction)| {
            let mut alone = subject.only(run);
            alone.set_edge_sigma(0, sigma);
            let sensors: Vec<usize> = alone.sensors().collect();
            let score = alone.score(&Prediction { runs: vec![nominal.runs[run].clone()] });
            score.signals.iter().filter(|of| sensors.contains(&of.signal)).map(|of| of.cost).sum::<f64>()
        };
        subjects.iter().zip(nominal).filter(|(subject, _)| subject.sensors().next().is_some()).map(of).sum()
    };
    let costs: Vec<(f64, f64)> = EDGE_SIGMAS_S.iter().map(|sigma| (cost(*sigma), *sigma)).collect();
    let best = costs.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(EDGE_SIGMAS_S[0], |(_, sigma)| sigma);
    subjects.iter_mut().for_each(|subject| subject.set_edge_sigma(run, best));
}

/// When a machine looked at its state, clock by clock and by [`Beat`].
#[derive(Clone, Debug)]
pub struct Grids {
    /// By the clock of the commands.
    pub main: [Arc<Grid>; 3],
    /// By the recording's other clocks, in its order.
    pub others: Vec<[Arc<Grid>; 3]>,
}

impl Grids {
    fn new(recording: &Recording) -> Grids {
        Grids {
            main: grids(recording, &recording.stamps),
            others: recording.clocks.iter().map(|clock| grids(recording, &clock.stamps)).collect(),
        }
    }

    /// That of a clock, by its place among the others.
    pub(super) fn of(&self, clock: Option<usize>, beat: Beat) -> &Arc<Grid> {
        let grids = clock.and_then(|clock| self.others.get(clock)).unwrap_or(&self.main);
        &grids[beat as usize]
    }
}

/// The grids behind stamps: one for all where all signals lie on it, else one for each beat.
fn grids(recording: &Recording, stamps: &[Vec<f64>; 3]) -> [Arc<Grid>; 3] {
    let [fast, slow, edges] = stamps;
    if recording.header.commands == Commands::Sampled {
        // The rows of a table say of commands and reports alike when they were: there is nothing to rebuild.
        return Beat::ALL.map(|beat| Arc::new(Grid::of_rows(&stamps[beat as usize])));
    }
    let mut all: Vec<f64> = stamps.concat();
    all.sort_by(f64::total_cmp);
    all.dedup();
    if let Some(step) = recording.step() {
        // Steps of ours are known: edges leave with theirs, levels with a cycle of their own.
        let edges = Arc::new(Grid::of_steps(step, recording.ends));
        return [Arc::new(Grid::rebuild(fast)), Arc::new(Grid::rebuild(slow)), edges];
    }
    let main = if fast.is_empty() { &all } else { fast };
    let main = Grid::rebuild(main);
    if main.is_rebuilt && main.fits(slow) && main.fits(edges) {
        let one = Arc::new(Grid::rebuild(&all));
        return [one.clone(), one.clone(), one];
    }
    Beat::ALL.map(|beat| Arc::new(Grid::rebuild(&stamps[beat as usize])))
}
