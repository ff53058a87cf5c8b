//! What the task of a machine does to all of its devices alike: it takes commands up at its own instants, what it reports is somewhat
//! old by then, and its inputs are filtered.
//!
//! A PLC runs its task every so often, with a phase that nobody wrote down; a drive answers a bus cycle later; every input passes
//! the same filter. All of that is the recording's, not a device's. It is looked for once, before any device is, and only where
//! several devices ask for the same, or the only one of several at work that can tell, or one of its signals, is explained by it to its floor:
//! what is left of one device alone is its own gap. (Within one clock no other offset of a device is ever fitted away.) What is looked for is bounded by what such machines do: reports at most [`MOST_AGE_S`] old, filters of at
//! most [`MOST_FILTER_S`](super::filter::MOST_FILTER_S).

mod outvoted;
mod voter;
mod ways;

use rayon::prelude::*;
use serde::Serialize;

use super::locate::THRESHOLD;
use super::overrides::Overrides;
use super::recording::TaskId;
use super::subject::Subject;
use crate::effect::EffectError;
use outvoted::outvoted;
use voter::{Moments, Voter, age_of_most, age_of_near, likeliest_age};
pub(super) use ways::{Ways, find as find_ways};

/// How old a report may be, s.
pub const MOST_AGE_S: f64 = 2.5e-3;
/// The tasks that are tried, s; 0: commands are taken up at once.
const TASKS_S: [f64; 7] = [0.0, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 4e-3];
/// What part of a cycle a task may be at most.
const OF_CYCLE: f64 = 0.2;
/// How many phases of a task are tried at least and at most, and how near each other they are where that leaves a choice, s; then nearer and
/// nearer to the best, so many times. Of a motor that turns round a hundred times each command that is taken up a cycle late is counts for
/// ever after, the more the longer the cycle is: phases further apart miss the valley in which the best one lies.
const PHASES: [u32; 2] = [16, 64];
const PHASE_S: f64 = 7.5e-6;
const HALVINGS: u32 = 7;
/// Of how many cycles, the best first, the phase is found nearer before one is chosen.
const NEARER_TASKS: usize = 3;
/// How often its phase and the nominal parameters are looked for, the one beside the other.
const ROUNDS: usize = 3;
/// Phases no further apart are one, s.
const SAME_PHASE_S: f64 = 2e-8;
/// A mean square in floors that no device comes below for any other reason than that a floor is too high.
pub(super) const LEAST_SQUARE: f64 = 0.2;
/// What a task's cycle and its phase have to gain, in deviance.
const OF_A_TASK: f64 = 12.0;
/// How many devices have to ask for the same.
pub(super) const LEAST_DEVICES: usize = 2;
/// Where only one asks for it because no other at work can tell, the mean square in floors that it may leave: all of its gap, then, is
/// what every machine has, and no effect of its own need be found.
const EXPLAINED: f64 = 1.2;
/// How much nearer each of them must come, in deviance.
pub(super) const NEARER: f64 = 4.0;

/// What is common to all devices of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Task {
    /// Commands are taken up at whole multiples of this behind the phase, s; 0: at once.
    pub every_s: f64,
    pub phase_s: f64,
    /// How old what is reported is at the instant of the report, s.
    pub age_s: f64,
    /// By how much later than that flags are reported, s.
    pub filter_s: f64,
    /// By how much the ways of commands scatter, standard deviation, s; 0 where that does not show.
    pub scatter_s: f64,
}

impl Task {
    /// When a command given at `at` acts.
    pub fn taken_up(&self, at: f64) -> f64 {
        if self.every_s > 0.0 {
            ((at - self.phase_s) / self.every_s - 1e-6).ceil() * self.every_s + self.phase_s
        } else {
            at
        }
    }
}

/// Finds what is common in a run, from subjects whose floors are known, and what the nominal parameters of those that count are then. `None`
/// where nothing has to be found.
///
/// The likeliest task is found, each device's scale of error being its own: n·ln(squares), n the samples that move, each
/// as much as its noise lets it tell. So a device with a gap of its own, whose squares are large whatever the task, has a small say.
pub(super) fn find(subjects: &[Subject], run: usize, cycle: f64) -> Result<Option<Found>, EffectError> {
    let (found, near) = agreed(voters(subjects, run)?, (subjects, run), cycle)?;
    // What is far off whatever the task may have outvoted what is not.
    match found.is_none() && !near.is_empty() {
        true => Ok(agreed(near, (subjects, run), cycle)?.0),
        false => Ok(found),
    }
}

/// A task, and what the nominal parameters of devices are beside it.
pub(super) type Found = (Task, Vec<(TaskId, Overrides)>);

/// What these devices agree on, and those of their levels that are near what is recorded under what is likeliest; none of these where all are.
fn agreed(
    mut voters: Vec<Voter>,
    (subjects, run): (&[Subject], usize),
    cycle: f64,
) -> Result<(Option<Found>, Vec<Voter>), EffectError> {
    if voters.is_empty() {
        return Ok((None, Vec::new()));
    }
    voters.par_iter_mut().try_for_each(|voter| voter.centre_all(Task::default()))?;
    let now = voters.par_iter().map(|voter| voter.moments(None)).collect::<Result<Vec<_>, _>>()?;
    let before: Vec<f64> = now.iter().map(|moments| moments.cost(0.0)).collect();
    let mut best = Best::of(&mut voters, cycle)?;
    if best.task.every_s > 0.0 {
        // Whether there is such a task at all is asked of nominal parameters that were found without one, too.
        let mut as_told = voters.clone();
        let at_once = Best::at_once(&mut as_told)?;
        if at_once.cost < best.cost {
            (best, voters) = (at_once, as_told);
        }
    }
    let outvoted = outvoted(&voters, (&before, &best), cycle)?;
    let is_outvoted = outvoted.is_some();
    if let Some(others) = outvoted {
        (best, voters) = others;
    }
    let nearer = before.iter().zip(&best.costs).filter(|(before, after)| *before - *after > NEARER).count();
    let gain = before.iter().sum::<f64>() - best.cost;
    let is_whole = |(voter, (before, after)): (&Voter, (&f64, &f64))| -> Result<bool, EffectError> {
        let is_nearer = before - after > NEARER;
        Ok(is_nearer && (voter.mean_square_at(*after) < EXPLAINED || voter.has_explained_signal(best.task)?))
    };
    let is_explained = || -> Result<bool, EffectError> {
        let whole = voters.iter().zip(before.iter().zip(&best.costs)).map(is_whole);
        Ok(whole.collect::<Result<Vec<bool>, _>>()?.contains(&true))
    };
    // Where nothing else was at work, it is that device that was looked at.
    let is_at_work = |subject: &&Subject| {
        let changes = subject.runs[run].tracks.iter().flatten().any(|track| !track.edges.is_empty());
        changes || voters.iter().any(|voter| voter.subject.id == subject.id)
    };
    let are_others = || subjects.iter().filter(is_at_work).count() >= LEAST_DEVICES;
    let is_common = nearer >= LEAST_DEVICES || nearer == 1 && are_others() && is_explained()?;
    if !is_common || gain <= THRESHOLD {
        let near = voters.iter().map(|voter| voter.near(best.task)).collect::<Result<Vec<_>, _>>()?;
        let near: Vec<Voter> = near.into_iter().flatten().collect();
        let levels = |voters: &[Voter]| voters.iter().map(|voter| voter.kept.len()).sum::<usize>();
        let are_some = levels(&near) < levels(&voters);
        return Ok((None, if are_some { near } else { Vec::new() }));
    }
    let moments = Best::moments(&voters, best.task)?;
    let age_s = match is_outvoted {
        true => best.task.age_s,
        false => age_of_most(&moments, age_of_near(&moments, best.task.age_s)),
    };
    let counters = voters.iter().filter(|voter| voter.is_a_counter());
    let likely = counters.map(|voter| (voter.subject.id, voter.overrides())).collect();
    Ok((Some((Task { age_s, ..best.task }, likely)), Vec::new()))
}

/// `known` with its phase as this run has it, which began at another instant: the likeliest as in [`find`].
pub(super) fn find_phase(subjects: &[Subject], run: usize, known: Task) -> Result<Task, EffectError> {
    if known.every_s <= 0.0 {
        return Ok(known);
    }
    let mut voters = voters(subjects, run)?;
    let mut found = known;
    // What a motor is built to was found under another run's phase.
    for _ in 0..=ROUNDS {
        voters.par_iter_mut().try_for_each(|voter| voter.centre_all(found))?;
        let phase_s = phase_of(&voters, found)?;
        let is_settled = (phase_s - found.phase_s).abs() < SAME_PHASE_S;
        found.phase_s = phase_s;
        if is_settled {
            break;
        }
    }
    Ok(found)
}

/// The likeliest of all phases of a task, s; of those that cost the same its own.
fn phase_of(voters: &[Voter], known: Task) -> Result<f64, EffectError> {
    let mut best = Best::none();
    let mut try_all = |phases: &mut dyn Iterator<Item = f64>| -> Result<f64, EffectError> {
        let tasks = phases.map(|phase_s| Task { phase_s: phase_s.rem_euclid(known.every_s), ..known });
        best.weigh(voters, tasks, Some(known.age_s))?;
        Ok(best.task.phase_s)
    };
    try_all(&mut [known.phase_s].into_iter())?;
    let phases = phases_of(known.every_s);
    let whole = known.every_s / f64::from(phases);
    let mut phase_s = try_all(&mut (0..phases).map(|phase| f64::from(phase) * whole))?;
    for halving in 0..HALVINGS {
        let step = whole / f64::from(1u32 << halving);
        phase_s = try_all(&mut [-2.0, -1.0, 1.0, 2.0].into_iter().map(|steps| phase_s + steps * step))?;
    }
    try_all(&mut phases_near(voters, Task { phase_s, ..known }).into_iter())
}

/// How many phases of a task are tried at first; of commands that are taken up at once there is one.
fn phases_of(every_s: f64) -> u32 {
    let [least, most] = PHASES;
    if every_s > 0.0 { ((every_s / PHASE_S).ceil() as u32).clamp(least, most) } else { 1 }
}

/// The phases near that of a task that are not one and the same: one for each span in which all commands are taken up at the same
/// instants. Between two of them a command comes a whole task's cycle sooner or later, so that no slope leads from one to the other.
fn phases_near(voters: &[Voter], task: Task) -> Vec<f64> {
    let commands = voters.iter().flat_map(|voter| &voter.subject.runs[0].commands).map(|(_, told)| told.at);
    phases_between(commands, task)
}

/// The same, of commands given at these instants, s.
fn phases_between(commands: impl Iterator<Item = f64>, task: Task) -> Vec<f64> {
    const REACH: f64 = 6.0;
    let Task { every_s, phase_s, .. } = task;
    let reach = REACH / f64::from(phases_of(every_s)) * every_s;
    // By how much later than the phase a command comes, at most half a cycle.
    let behind = |at: f64| (at - phase_s + 0.5 * every_s).rem_euclid(every_s) - 0.5 * every_s;
    let mut ends: Vec<f64> = commands.map(behind).filter(|behind| behind.abs() < reach).collect();
    ends.extend([-reach, reach]);
    ends.sort_by(f64::total_cmp);
    let apart = ends.windows(2).filter(|pair| pair[1] - pair[0] > SAME_PHASE_S);
    apart.map(|pair| (phase_s + 0.5 * (pair[0] + pair[1])).rem_euclid(every_s)).collect()
}

/// The devices of a run that have a say.
fn voters(subjects: &[Subject], run: usize) -> Result<Vec<Voter>, EffectError> {
    let voter = |subject: &Subject| Voter::new(subject.only(run).of_levels());
    let voters = subjects.par_iter().map(voter).collect::<Result<Vec<_>, _>>()?;
    Ok(voters.into_iter().flatten().collect())
}

/// The best task so far.
struct Best {
    /// What it costs, with what its parameters cost.
    cost: f64,
    task: Task,
    /// What each device costs.
    costs: Vec<f64>,
}

impl Best {
    fn none() -> Best {
        Best { cost: f64::INFINITY, task: Task::default(), costs: Vec::new() }
    }

    /// The best of all tasks; the voters as they are best under it.
    fn of(voters: &mut Vec<Voter>, cycle: f64) -> Result<Best, EffectError> {
        let tasks = TASKS_S.into_iter().filter(|every| *every <= OF_CYCLE * cycle + 1e-12);
        let mut each = tasks.map(|every_s| Best::of_phases(voters, every_s)).collect::<Result<Vec<_>, _>>()?;
        // Between two of these phases lie commands, and one that a drive takes up a cycle late may outweigh all others: a wrong cycle
        // may seem better than the true one until its phase is known nearer.
        each.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let settled = each.into_iter().take(NEARER_TASKS).map(|best| best.settled(voters));
        let mut settled = settled.collect::<Result<Vec<_>, _>>()?;
        settled.sort_by(|a, b| a.0.cost.total_cmp(&b.0.cost));
        let mut chosen: Option<(Best, Vec<Voter>)> = None;
        for (mut best, centred) in settled {
            best.between_commands(&centred)?;
            if chosen.as_ref().is_none_or(|(least, _)| best.cost < least.cost) {
                chosen = Some((best, centred));
            }
            // What a counter is off by under the likeliest of them it may not be under one whose phase lies between two commands.
            let is_far = |(best, voters): &(Best, Vec<Voter>)| {
                voters.iter().zip(&best.costs).any(|(voter, cost)| voter.is_far_at(*cost))
            };
            if !chosen.as_ref().is_some_and(is_far) {
                break;
            }
        }
        let Some((best, centred)) = chosen else { return Ok(Best::none()) };
        *voters = centred;
        Ok(best)
    }

    /// The best of the phases of a task that are tried at first.
    fn of_phases(voters: &[Voter], every_s: f64) -> Result<Best, EffectError> {
        let mut best = Best::none();
        let phases = phases_of(every_s);
        let phases = (0..phases).map(|phase| f64::from(phase) / f64::from(phases) * every_s);
        best.weigh(voters, phases.map(|phase_s| Task { every_s, phase_s, ..Task::default() }), None)?;
        Ok(best)
    }

    /// The best phase of this task's cycle, and the voters as they are best under it. A motor whose acceleration is a per cent off and
    /// a task hide in each other: a phase that is found beside the one is looked for anew beside the other, until that agrees.
    fn settled(self, voters: &[Voter]) -> Result<(Best, Vec<Voter>), EffectError> {
        let mut voters = voters.to_vec();
        let mut best = self.nearby(&voters)?;
        for _ in 0..ROUNDS {
            let (told, found) = (best.cost, best.task);
            voters.par_iter_mut().try_for_each(|voter| voter.centre(found))?;
            best = best.nearby(&voters)?;
            // What was told by slopes alone.
            if (told - best.cost).abs() < NEARER {
                break;
            }
            let anew = Best::of_phases(&voters, found.every_s)?.nearby(&voters)?;
            best = if anew.cost < best.cost { anew } else { best };
        }
        Ok((best, voters))
    }

    /// The best task with its phase between its neighbours, from voters that may have changed since.
    fn nearby(self, voters: &[Voter]) -> Result<Best, EffectError> {
        let mut best = Best::none();
        best.weigh(voters, [self.task], None)?;
        for halving in 0..HALVINGS {
            let found = best.task;
            if found.every_s > 0.0 {
                let step = found.every_s / f64::from(phases_of(found.every_s) << halving);
                let phases = [-2.0, -1.0, 1.0, 2.0].map(|steps| found.phase_s + steps * step);
                let tasks = phases.map(|phase_s| Task { phase_s: phase_s.rem_euclid(found.every_s), ..found });
                best.weigh(voters, tasks, None)?;
            }
        }
        Ok(best)
    }

    /// The best without a task, and the voters as they are best then.
    fn at_once(voters: &mut [Voter]) -> Result<Best, EffectError> {
        let mut best = Best::none();
        for _ in 0..2 {
            best = Best::none();
            best.weigh(voters, [Task::default()], None)?;
            voters.par_iter_mut().try_for_each(|voter| voter.centre(best.task))?;
        }
        best.weigh(voters, [Task::default()], None)?;
        Ok(best)
    }

    /// Tries the phases near that of the best between which a command is taken up sooner or later.
    fn between_commands(&mut self, voters: &[Voter]) -> Result<(), EffectError> {
        let found = self.task;
        if found.every_s > 0.0 {
            let phases = phases_near(voters, found).into_iter();
            self.weigh(voters, phases.map(|phase_s| Task { phase_s, ..found }), None)?;
        }
        Ok(())
    }

    fn moments(voters: &[Voter], task: Task) -> Result<Vec<Moments>, EffectError> {
        voters.par_iter().map(|voter| voter.moments(Some(task))).collect()
    }

    /// Tries tasks, with every age or with the one that is told. A counter knows a phase a hundred times better than what else there is, and is replayed at a
    /// fraction of what a robot costs: where what the counters alone cost leaves a task no chance to be the best, nothing else is asked.
    fn weigh(
        &mut self,
        voters: &[Voter],
        tasks: impl IntoIterator<Item = Task>,
        age_s: Option<f64>,
    ) -> Result<(), EffectError> {
        let cost_of = |task: Task, each: &[&Moments]| -> (f64, f64) {
            let (cost, age_s) = match age_s {
                Some(age_s) => (each.iter().map(|moments| moments.cost(age_s)).sum(), age_s),
                None => likeliest_age(each),
            };
            (cost + if task.every_s > 0.0 { OF_A_TASK } else { 0.0 }, age_s)
        };
        let least_of_others: f64 = voters.iter().filter(|voter| !voter.is_a_counter()).map(Voter::least_cost).sum();
        let by_counters = |task: Task| -> Result<(f64, Task, Vec<Option<Moments>>), EffectError> {
            let counted = |voter: &Voter| voter.is_a_counter().then(|| voter.moments(Some(task))).transpose();
            let counted = voters.par_iter().map(counted).collect::<Result<Vec<_>, _>>()?;
            let (least, _) = cost_of(task, &counted.iter().flatten().collect::<Vec<_>>());
            Ok((least + least_of_others, task, counted))
        };
        let mut tasks = tasks.into_iter().map(by_counters).collect::<Result<Vec<_>, _>>()?;
        tasks.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (least, task, counted) in tasks {
            if least > self.cost {
                break;
            }
            let each = voters.par_iter().zip(counted);
            let each = each.map(|(voter, counted)| counted.map_or_else(|| voter.moments(Some(task)), Ok));
            let each = each.collect::<Result<Vec<_>, _>>()?;
            let (cost, age_s) = cost_of(task, &each.iter().collect::<Vec<_>>());
            if cost < self.cost {
                let costs = each.iter().map(|moments| moments.cost(age_s)).collect();
                *self = Best { cost, task: Task { age_s, ..task }, costs };
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::device::KINDS;
    use crate::gap::recorded_tests::{RUBBING_AXIS, study_of, study_of_folder, text_of};
    use crate::gap::{Overrides, Predicted, Recording, Study};
    use crate::plant::{self, embedded::Embedded};
    use crate::trace::Reader;

    /// All that an axis reports has the wrong sign: what its nominal parameters would have to be for that is not all that anybody hears.
    #[test]
    fn an_axis_that_goes_the_wrong_way_does_not_drown_what_the_others_say() {
        let mirrored = |line: &str| {
            let mut line: serde_json::Value = serde_json::from_str(line).expect("a line");
            let is_plants = line["from"] == "plant";
            let entries = line.get_mut("SendValue").and_then(serde_json::Value::as_array_mut).filter(|_| is_plants);
            for entry in entries.into_iter().flatten() {
                let is_axis = entry["name"].as_str().is_some_and(|name| name.starts_with("Axis."));
                if let Some(value) = entry["value"].as_f64().filter(|_| is_axis) {
                    entry["value"] = (-value).into();
                }
            }
            format!("{line}\n")
        };
        let text: String = text_of(RUBBING_AXIS).lines().map(mirrored).collect();
        let task = study_of("mirrored", text.as_bytes()).tasks[0];
        let known = study_of("as recorded", text_of(RUBBING_AXIS).as_bytes()).tasks[0];
        assert_eq!((task.every_s, task.scatter_s), (known.every_s, 0.0), "{task:?}, not {known:?}");
        assert!((task.phase_s - known.phase_s).abs() < 2e-5 && (task.age_s - known.age_s).abs() < 2e-5, "{task:?}");
    }

    #[test]
    fn a_command_waits_for_the_task() {
        let task = Task { every_s: 5e-4, phase_s: 1e-4, ..Task::default() };
        assert!((task.taken_up(1.0001) - 1.0001).abs() < 1e-9);
        assert!((task.taken_up(1.00011) - 1.0006).abs() < 1e-9);
        assert_eq!(Task::default().taken_up(1.23), 1.23);
    }

    /// A fast task needs fewer phases than a slow one, whose commands come more of a cycle late.
    #[test]
    fn phases_are_near_enough_each_other() {
        assert_eq!([0.0, 1e-4, 2e-4, 5e-4, 4e-3].map(phases_of), [1, 16, 27, 64, 64]);
    }

    /// States that nobody looks at change no level.
    #[test]
    fn levels_are_what_they_are_whether_states_are_looked_at_or_not() {
        let study = crate::gap::recorded_tests::study(crate::gap::recorded_tests::SLOW_PUSHER);
        let mut compared = 0;
        for subject in &study.subjects {
            let all = subject.predict(&[], &Overrides::none()).expect("a prediction");
            let levels = subject.clone().of_levels().predict(&[], &Overrides::none()).expect("a prediction");
            for (one, other) in all.runs[0].iter().zip(&levels.runs[0]) {
                match (one, other) {
                    (Predicted::Level(one), Predicted::Level(other)) => {
                        compared += one.len();
                        assert!(one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-9), "{}", subject.name);
                    }
                    (_, other) => assert_eq!(*other, Predicted::Nothing, "{}", subject.name),
                }
            }
        }
        assert!(compared > 1000, "{compared}");
    }

    /// Of commands that come 0.1, 0.11 and 0.4 ms behind the task's cycle two stand near a phase of 0.104 ms: three phases differ.
    #[test]
    fn phases_differ_where_a_command_stands_between_them() {
        let task = Task { every_s: 5e-4, phase_s: 1.04e-4, ..Task::default() };
        let found = phases_between([1.0001, 2.00011, 3.0004].into_iter(), task);
        assert_eq!(found.len(), 3);
        let taken = |phase_s: f64| [1.0001, 2.00011].map(|at| Task { phase_s, ..task }.taken_up(at));
        let taken: Vec<[f64; 2]> = found.into_iter().map(taken).collect();
        assert!(taken[0] != taken[1] && taken[1] != taken[2] && taken[0] != taken[2], "{taken:?}");
    }

    /// Targets of an axis, a ramp with a corner every 0.3 s, and of a motor that turns round at each; reports of `signals` every 50 ms,
    /// which `value` says.
    pub(super) fn recorded(signals: &[Signal], value: impl Fn(Signal, usize) -> f64) -> Study {
        let plant = plant::load(&Embedded, "models/rig-toleranced", KINDS).expect("the rig");
        let mut lines: Vec<(f64, String)> = Vec::new();
        let entry = |name: &str, value: f64| format!("{{\"name\":\"{name}\",\"value\":{value:.5}}}");
        let mut target = 0.0;
        for step in 0..2000_usize {
            let corner = (step / 15 * 7919 % 23) as f64 / 11.0 - 1.0;
            target = (target + 0.012 * corner).clamp(-0.4, 0.4);
            let mut told = vec![entry("Axis.positionTarget", target)];
            if step % 15 == 0 {
                told.push(entry("Motor.speedTarget", 11.0 * STEP * corner));
            }
            if step == 0 {
                told.push("{\"name\":\"Motor.enable\",\"value\":true}".to_owned());
            }
            let told = told.join(",");
            lines.push((0.0103 + 0.020_037 * step as f64, format!("\"automation\",\"SendValue\":[{told}]")));
        }
        for look in 0..800 {
            let told = signals.iter().map(|&(device, name)| match name {
                "encoder" => {
                    format!("{{\"name\":\"{device}.{name}\",\"value\":{:.0}}}", value((device, name), look).floor())
                }
                _ => entry(&format!("{device}.{name}"), value((device, name), look)),
            });
            let told = told.collect::<Vec<_>>().join(",");
            lines.push((0.0041 + 0.05 * look as f64, format!("\"plant\",\"SendValue\":[{told}]")));
        }
        lines.sort_by(|a, b| a.0.total_cmp(&b.0));
        let lines: String = lines.iter().map(|(at, line)| format!("{{\"t\":{at:.6},\"from\":{line}}}\n")).collect();
        let text = format!("{{\"trace\":\"kinetwin/1\",\"source\":\"plant\"}}\n{lines}");
        let reader = Reader::new("two", Cursor::new(text.into_bytes())).expect("a trace");
        let recording = Recording::read(&plant, "two", reader, &[]).expect("a recording");
        Study::new(&plant, &[recording]).expect("a study")
    }

    /// The acceleration of the rig's motor, rad/s².
    const AS_DECLARED: f64 = 20.0;
    /// The step of its targets, rad/s: of three of them it speeds up in the 0.3006 s between two commands at 20.16 rad/s².
    const STEP: f64 = 2.0198;
    pub(super) const SIGNALS: [Signal; 2] = [("Axis", "position"), ("Motor", "encoder")];

    /// A device and what it reports.
    pub(super) type Signal = (&'static str, &'static str);

    /// What is recorded of `signals` where the machine's task is `told` and its motor is built to this acceleration, rad/s²; each report times
    /// what `factor` says.
    fn study(signals: &[Signal], told: Task, built: f64, factor: impl Fn(Signal) -> f64) -> Study {
        let still = recorded(signals, |_, _| 0.0);
        let values = |(device, name): Signal| {
            let mut subject = still.subject(device).expect("it moves").clone();
            subject.set_tick(0, 0.0, 0.0);
            subject.set_task(0, told);
            let place = subject.signals.iter().position(|info| info.property == name).expect("its signal");
            let mut as_built = Overrides::none();
            if device == "Motor" {
                as_built.0.insert("acceleration".to_owned(), built);
            }
            match subject.predict(&[], &as_built).expect("a prediction").runs[0][place].clone() {
                Predicted::Level(values) => values,
                other => panic!("{other:?}"),
            }
        };
        let each: Vec<(Signal, Vec<f64>)> = signals.iter().map(|signal| (*signal, values(*signal))).collect();
        recorded(signals, |signal, look| {
            let (_, values) = each.iter().find(|(other, _)| *other == signal).expect("one of them");
            factor(signal) * values[look.min(values.len() - 1)]
        })
    }

    /// What is found where the machine's task is `told`, its motor being built to this acceleration, rad/s².
    fn found(told: Task, built: f64) -> Task {
        study(&SIGNALS, told, built, |_| 1.0).tasks[0]
    }

    /// Millimetres for metres are no matter of age, and leave the speed its say.
    #[test]
    fn what_is_far_off_has_no_say_beside_what_is_not() {
        let of = |factor: f64| {
            let signals = [("Axis", "position"), ("Axis", "velocity")];
            let study = study(
                &signals,
                Task::default(),
                AS_DECLARED,
                |(_, name)| if name == "position" { factor } else { 1.0 },
            );
            let axis = study.subject("Axis").expect("it moves").only(0);
            let voter = Voter::new(axis).expect("it can be built").expect("it moves");
            let name = |(place, _): &(usize, usize)| voter.subject.signals[*place].property.clone();
            voter.kept.iter().map(name).collect::<std::collections::BTreeSet<_>>().into_iter().collect::<Vec<_>>()
        };
        assert_eq!(of(1.0), ["position", "velocity"]);
        assert_eq!(of(1000.0), ["velocity"]);
    }

    /// From one report to the next an axis that lags by 40 ms does anything: a slope over two of them would be half of what it is.
    #[test]
    fn an_age_is_found_of_reports_in_a_coarse_cycle() {
        let found = found(Task { age_s: 3e-4, ..Task::default() }, AS_DECLARED);
        assert!(found.every_s == 0.0 && (found.age_s - 3e-4).abs() < 1e-5, "{found:?}");
    }

    /// That the machine's task is found to be `told`, both its times within `by`, s, the motor being built to `built`, rad/s².
    fn assert_found(told: Task, built: f64, by: f64) {
        let found = found(told, built);
        let near = |of: fn(&Task) -> f64| (of(&found) - of(&told)).abs() < by;
        assert!(found.every_s == told.every_s && near(|task| task.phase_s) && near(|task| task.age_s), "{found:?}");
    }

    /// Of a motor that turns round each microsecond counts for ever after.
    #[test]
    fn a_task_is_found_whose_phase_lies_between_those_that_are_tried() {
        assert_found(Task { every_s: 1e-3, phase_s: 4.16e-4, age_s: 4.5e-4, ..Task::default() }, AS_DECLARED, 2e-5);
    }

    /// Each of its ramps leaves counts, as it is built two per cent beyond what is declared, which sum up to more than any age of its reports would: heard by its
    /// speed alone it says nothing of a task of 0.1 ms, whose phase is 49.7 µs, and whose reports are 954 µs old.
    #[test]
    fn a_counter_is_heard_again_once_it_is_known_what_it_is_built_to() {
        let found = study_of_folder("tests/data/motor-two-per-cent-steep").tasks[0];
        let is_near = (found.phase_s - 4.97e-5).abs() < 2e-6 && (found.age_s - 9.54e-4).abs() < 5e-6;
        assert!(found.every_s == 1e-4 && is_near, "{found:?}");
    }

    /// A little beyond what it is built to, the motor's ramps over three steps would end before the next command: what a whole standard
    /// deviation more does to its encoder is not what a hundredth of it does.
    #[test]
    fn a_task_is_found_of_a_motor_whose_ramps_just_do_not_end() {
        assert_found(Task { every_s: 1e-4, phase_s: 8.1e-5, age_s: 3.3e-4, ..Task::default() }, 20.127, 5e-6);
    }

    /// Its ramps gain so much more that half of it is made up for by commands that seem to be taken up a cycle later: downhill from what is declared
    /// its acceleration ends there.
    #[test]
    fn a_task_is_found_of_a_motor_that_is_far_from_what_is_declared() {
        for built in [19.7, 20.28] {
            assert_found(Task { every_s: 5e-4, phase_s: 1.12e-4, age_s: 2e-4, ..Task::default() }, built, 2e-5);
        }
    }
}
