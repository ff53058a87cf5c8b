//! What a device's neighbours did, as far as they reported it: who else on its supply moves, and whether a robot's grippers hold
//! something. Effects that hang on others ask for it; no other replay is told.
//!
//! A speed that is reported with noise is never zero: where a level says who moves, it is what the neighbour's model predicts of it.

use std::sync::Arc;

use super::prediction::{Predicted, Prediction};
use super::subject::{Run, Subject};
use super::track::Track;
use super::world::{Script, Surrounding, Told};
use crate::effect::moving_as_reported;
use crate::plant::Plant;

/// A number from an instant on, s.
type Steps = Vec<(f64, u32)>;

/// Sets what each subject's neighbours did in a run, `nominal` being what is predicted of each, in their order; of one that has no
/// prediction yet its levels are as they were reported.
pub(super) fn tell(plant: &Plant, subjects: &mut [Subject], nominal: &[Prediction], run: usize) {
    let predicted = |at: usize| nominal.get(at).map(|prediction| prediction.runs[run].as_slice());
    let moving: Vec<Steps> =
        subjects.iter().enumerate().map(|(at, subject)| moving(subject, &subject.runs[run], predicted(at))).collect();
    let held: Vec<Steps> = (0..subjects.len()).map(|at| held(plant, subjects, at, run)).collect();
    for (at, subject) in subjects.iter_mut().enumerate() {
        let others = moving.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, steps)| steps.as_slice());
        let others = sum(others).into_iter().map(|(at, count)| told(at, Surrounding::Others(count)));
        let held = held[at].iter().map(|(at, count)| told(*at, Surrounding::Held(*count)));
        let run = &mut subject.runs[run];
        let mut script = Script::clone(&run.script);
        script.told.extend(others.chain(held));
        script.told.sort_by(|a, b| a.at.total_cmp(&b.at));
        run.among_neighbours = Arc::new(script);
    }
}

fn told(at: f64, what: Surrounding) -> Told {
    Told { at, what, is_on: true }
}

/// How many actuators of a subject move, by its flags and by what is `predicted` of its levels: between the look that shows it and the one
/// before.
fn moving(subject: &Subject, run: &Run, predicted: Option<&[Predicted]>) -> Steps {
    let ports = subject.kind.ports.len();
    let longest = run.tracks.iter().flatten().max_by_key(|track| track.grid.instants.len());
    let Some(grid) = longest.map(|track| track.grid.clone()) else { return Vec::new() };
    let mut steps = Steps::new();
    let mut before = vec![0.0; ports];
    let mut now = vec![0.0; ports];
    let mut looks: Vec<Look<'_>> = subject
        .signals
        .iter()
        .zip(&run.tracks)
        .enumerate()
        .filter_map(|(place, (info, track))| {
            let track = track.as_ref()?;
            let values = match predicted.map(|predicted| &predicted[place]) {
                Some(Predicted::Level(values)) => values,
                _ => &track.values,
            };
            Some(Look { port: info.port, track, values, next: 0 })
        })
        .collect();
    for (index, at) in grid.instants.iter().enumerate() {
        looks.iter_mut().for_each(|look| now[look.port] = look.at(*at));
        if index == 0 {
            before.copy_from_slice(&now);
            continue;
        }
        let seconds = at - grid.instants[index - 1];
        let count = moving_as_reported(subject.kind, &before, &now, seconds);
        if steps.last().map_or(0, |(_, count)| *count) != count {
            steps.push((at - 0.5 * seconds, count));
        }
        before.copy_from_slice(&now);
    }
    steps
}

/// A track that is read on and on.
struct Look<'a> {
    port: usize,
    track: &'a Track,
    /// Of a level, at each instant of its track from its first.
    values: &'a [f64],
    next: usize,
}

impl Look<'_> {
    /// What it was last at an instant, not before the one asked last.
    fn at(&mut self, at: f64) -> f64 {
        let instants = &self.track.grid.instants;
        while instants.get(self.next + 1).is_some_and(|instant| *instant <= at + 1e-9) {
            self.next += 1;
        }
        if self.values.is_empty() {
            let edge = self.track.edges.partition_point(|edge| edge.index <= self.next);
            return edge.checked_sub(1).map_or(self.track.initial, |edge| self.track.edges[edge].to);
        }
        let place = self.next.saturating_sub(self.track.first).min(self.values.len() - 1);
        self.values[place]
    }
}

/// How many grippers of a robot report vacuum.
fn held(plant: &Plant, subjects: &[Subject], robot: usize, run: usize) -> Steps {
    let name = &subjects[robot].id.instance(plant).name;
    let is_its_own =
        |subject: &&Subject| subject.parameters.0.contains_key("robot") && subject.parameters.text("robot") == *name;
    let grippers: Vec<Steps> = subjects.iter().filter(is_its_own).map(|gripper| vacuum(gripper, run)).collect();
    sum(grippers.iter().map(Vec::as_slice))
}

fn vacuum(gripper: &Subject, run: usize) -> Steps {
    let place = gripper.signals.iter().position(|info| info.property == "vacuumOn");
    let Some(track) = place.and_then(|place| gripper.runs[run].tracks[place].as_ref()) else { return Vec::new() };
    let first = (track.grid.instants[track.first], u32::from(track.initial != 0.0));
    let edges = track.edges.iter().map(|edge| (track.grid.instants[edge.index], u32::from(edge.to != 0.0)));
    std::iter::once(first).chain(edges).collect()
}

/// The sum of several.
fn sum<'a>(all: impl Iterator<Item = &'a [(f64, u32)]>) -> Steps {
    let mut changes: Vec<(f64, i64)> = Vec::new();
    for steps in all {
        let mut before = 0;
        for (at, count) in steps {
            changes.push((*at, i64::from(*count) - before));
            before = i64::from(*count);
        }
    }
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut sum = Steps::new();
    let mut total = 0;
    for (at, change) in changes {
        total += change;
        let count = total.max(0) as u32;
        match sum.last_mut() {
            Some(last) if last.0 == at => last.1 = count,
            _ => sum.push((at, count)),
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_of_steps_steps_with_each() {
        let one = [(1.0, 1), (3.0, 0)];
        let two = [(2.0, 2), (3.0, 1)];
        assert_eq!(sum([&one[..], &two[..]].into_iter()), [(1.0, 1), (2.0, 3), (3.0, 1)]);
    }
}
