//! How much later than its stamp each command acted, where the ways of commands scatter.
//!
//! What is told over a network is stamped when it leaves and acts when it has arrived: by some ten microseconds later, another time by a
//! hundred. As far as that is alike for all commands it is a part of the age of reports. What scatters is the recording's and no
//! device's: of a motor that turns round each microsecond stays in its encoder, and a task with a cycle may take a command up one cycle later.
//!
//! By how much ways scatter is one number for all devices, asked of what the devices say together: each says by its levels how likely every
//! scatter is (a normal way of each message, marginalised, with an error scale of its own). It is looked for in how a device's commands
//! differ from one another beyond what goes with the size, the direction or the time of a command: that is the device's own, as are a
//! dead time and a lag, which all of its commands show alike. Of a device alone whose commands scatter the others say that theirs do not.
//! Then each message's way is what is likeliest, for all devices that it told something; where a task has a cycle, by whole
//! cycles, and only so far as the stamp lies near enough to a border.
//!
//! Source: D. J. C. MacKay, Bayesian Interpolation, Neural Computation 4 (1992), 415-447, for the evidence of a scale.

mod says;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::voter::Voter;
use super::{EXPLAINED, LEAST_DEVICES, NEARER, Task};
use crate::effect::EffectError;
use crate::gap::cause::Bare;
use crate::gap::locate::THRESHOLD;
use crate::gap::subject::Subject;
use says::{Form, Says};

/// How far the way of a command may be off that of most, s: on a network that keeps time at all; what is off by more has another reason.
pub(super) const MOST_S: f64 = 3e-4;
/// The scatters that are tried, standard deviation, s: each half as much again as the one before, from what no recording shows on.
const SCATTERS_S: [f64; 9] = [5e-6, 7.5e-6, 1.1e-5, 1.7e-5, 2.5e-5, 3.8e-5, 5.7e-5, 8.5e-5, 1.3e-4];
/// How often ways are found, each time about those that were found before: what a command does is no straight line.
const ROUNDS: usize = 8;
/// How much of the way to what is likeliest a round goes: of what does more than its slope says, all of it would be too much.
const OF_THE_WAY: f64 = 2.0 / 3.0;

/// How the ways of a recording's commands scatter.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::gap) struct Ways {
    /// Standard deviation, s: of the instants at which commands act, whole cycles of a task among them.
    pub scatter_s: f64,
    /// The instant of a message, s, and by how much later it acts than most; ascending.
    later: Vec<(f64, f64)>,
}

impl Ways {
    /// By how much later than most what is told at `at` acts, s.
    pub fn later(&self, at: f64) -> f64 {
        let place = self.later.binary_search_by(|(told, _)| told.total_cmp(&at));
        place.map_or(0.0, |place| self.later[place].1)
    }
}

/// Finds the ways of a run's commands beside its task, each device being as `bare` has it; `None` where they do not scatter. Where it is known by how much they do, such as
/// from another recording of the machine, that is taken.
pub(in crate::gap) fn find(
    subjects: &[Subject],
    bare: &[Bare],
    run: usize,
    known: Option<f64>,
) -> Result<Option<Ways>, EffectError> {
    // Rows of a table are no messages.
    if subjects.iter().any(|subject| subject.runs[run].commands_first) {
        return Ok(None);
    }
    let says = |(subject, bare): (&Subject, &Bare)| -> Result<Option<Says>, EffectError> {
        let Some(mut voter) = Voter::new(subject.only(run).of_levels())? else { return Ok(None) };
        voter.begin_at(&bare.overrides)?;
        Says::new(voter)
    };
    let all = subjects.par_iter().zip(bare).map(says).collect::<Result<Vec<_>, _>>()?;
    let mut all: Vec<Says> = all.into_iter().flatten().collect();
    let costs = |all: &[Says]| -> Result<f64, EffectError> {
        let each = all.par_iter().map(|says| Ok(says.voter.moments(None)?.cost(0.0)));
        Ok(each.collect::<Result<Vec<f64>, EffectError>>()?.iter().sum())
    };
    let mut last = costs(&all)?;
    let mut best = (last - THRESHOLD, None);
    let mut ways = Ways { scatter_s: 0.0, later: Vec::new() };
    for _ in 0..ROUNDS {
        let forms = all.par_iter().map(Says::forms).collect::<Result<Vec<_>, _>>()?;
        let found = known.or_else(|| scatter(&forms));
        let Some(scatter_s) = found else { break };
        let found = likeliest(&all, &forms, scatter_s, &ways);
        if found.later == ways.later {
            break;
        }
        ways = found;
        all.par_iter_mut().try_for_each(|says| says.tell(&|at| ways.later(at)))?;
        let cost = costs(&all)?;
        if cost < best.0 {
            best = (cost, Some(ways.clone()));
        }
        if (last - cost).abs() < NEARER {
            break;
        }
        last = cost;
    }
    Ok(best.1)
}

/// By how much all that is told scatters, s; `None` where the devices do not say so together.
fn scatter(forms: &[(Form, Form)]) -> Option<f64> {
    let of = |scatter_s: f64| forms.iter().map(|(_, free)| free.deviance(scatter_s)).collect::<Vec<(f64, f64)>>();
    let total = |each: &[(f64, f64)]| each.iter().map(|(deviance, _)| deviance).sum::<f64>();
    let without = of(0.0);
    let each = SCATTERS_S.map(|scatter_s| (scatter_s, of(scatter_s)));
    let (scatter_s, best) = each.into_iter().min_by(|a, b| total(&a.1).total_cmp(&total(&b.1)))?;
    let gains: Vec<f64> = without.iter().zip(&best).map(|(without, best)| without.0 - best.0).collect();
    let nearer = gains.iter().filter(|gain| **gain > NEARER).count();
    // One alone is believed where nobody contradicts and all that it has is explained by it.
    let is_explained = |(gain, (_, square)): (&f64, &(f64, f64))| *gain > NEARER && *square < EXPLAINED;
    let is_undisputed = || gains.iter().all(|gain| *gain > -NEARER) && gains.iter().zip(&best).any(is_explained);
    let is_common = nearer >= LEAST_DEVICES || nearer == 1 && is_undisputed();
    (is_common && gains.iter().sum::<f64>() > THRESHOLD).then_some(scatter_s)
}

/// The likeliest ways of all messages that scatter by so much, s, or nearer to them than those that were found `before`.
fn likeliest(all: &[Says], forms: &[(Form, Form)], scatter_s: f64, before: &Ways) -> Ways {
    let mut told: Vec<f64> = all.iter().flat_map(|says| says.told.iter().copied()).collect();
    told.sort_by(f64::total_cmp);
    told.dedup();
    let mut squares = DMatrix::from_diagonal_element(told.len(), told.len(), scatter_s.powi(-2));
    let mut products = DVector::zeros(told.len());
    for (says, (plain, free)) in all.iter().zip(forms) {
        let (_, square) = free.deviance(scatter_s);
        // What goes with all commands of a device is its own only where chance does not make as much of it.
        let form = if plain.is_by_chance(free, says.things(), (scatter_s, square)) { plain } else { free };
        let at: Vec<usize> = says.told.iter().map(|told_at| told.partition_point(|at| at < told_at)).collect();
        for (row, place) in at.iter().enumerate() {
            products[*place] += form.products[row] / square;
            for (column, other) in at.iter().enumerate() {
                squares[(*place, *other)] += form.squares[(row, column)] / square;
            }
        }
    }
    let Some(known) = squares.cholesky() else { return Ways { scatter_s, later: Vec::new() } };
    let later = known.solve(&products);
    let tasks = || all.iter().map(Says::task);
    // Where each device has a tick of its own, an instant for all is the stamp's own.
    let is_one = tasks().zip(tasks().skip(1)).all(|(one, next)| one.every_s == next.every_s);
    let task = tasks().next().filter(|_| is_one).unwrap_or_default();
    let furthest = MOST_S.max(task.every_s);
    let each = told.into_iter().zip(later.iter());
    let act = |(at, later): (f64, &f64)| {
        let to = acting(task, at, later.clamp(-furthest, furthest)) - at;
        (at, if task.every_s > 0.0 { to } else { before.later(at) + OF_THE_WAY * (to - before.later(at)) })
    };
    let each = each.map(act);
    Ways { scatter_s, later: each.filter(|(_, later)| *later != 0.0).collect() }
}

/// The instant nearest to the stamp `at` at which something told acts so much later under a task: by whole cycles of it, and only where
/// the stamp is near enough to where such a cycle begins or ends.
fn acting(task: Task, at: f64, later: f64) -> f64 {
    let cycles = (later / task.every_s).round();
    if task.every_s <= 0.0 || cycles == 0.0 {
        return if task.every_s > 0.0 { at } else { at + later };
    }
    let to = task.taken_up(at) + cycles * task.every_s;
    // Taken up at `to` is what comes after the cycle before it.
    let nearest = at.clamp(to - (1.0 - WITHIN_A_CYCLE) * task.every_s, to);
    if (nearest - at).abs() <= MOST_S { nearest } else { at }
}

/// How far behind its beginning a command is put into a cycle, as a share of it: so far that no rounding puts it back.
const WITHIN_A_CYCLE: f64 = 1e-3;

#[cfg(test)]
mod tests;
