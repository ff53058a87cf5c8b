//! What a device's neighbours did, as far as they reported it: who else on its supply moves, and whether a robot's grippers hold
//! something. Effects that hang on others ask for it; no other replay is told.
//!
//! A speed that is reported with noise is never zero, and a look each cycle misses when a motion began by up to that cycle: where a level
//! says who moves, the neighbour's model is asked between the looks, and where a flag does, its edge is when the model has it.

use std::sync::Arc;

use super::alone;
use super::overrides::Overrides;
use super::prediction::{Predicted, Prediction};
use super::subject::{Run, Subject};
use super::track::Track;
use super::world::{Script, Surrounding, Told};
use crate::effect::{EffectError, moving_as_reported};
use crate::plant::Plant;

/// A number from an instant on, s.
type Steps = Vec<(f64, u32)>;

/// The flags that say that a device moves.
const FLAGS: [&str; 2] = ["driveRunning", "isRunning"];

/// Sets what each subject's neighbours did in a run, `nominal` being what is predicted of each, in their order; of one that has no
/// prediction yet its levels are as they were reported.
///
/// # Errors
/// Where the model's own effects do not fit.
pub(super) fn tell(
    plant: &Plant,
    subjects: &mut [Subject],
    nominal: &[Prediction],
    run: usize,
) -> Result<(), EffectError> {
    let predicted = |at: usize| nominal.get(at).map(|prediction| prediction.runs[run].as_slice());
    let moving = subjects.iter().enumerate().map(|(at, subject)| match predicted(at) {
        Some(_) if is_followed(subject, &subject.runs[run]) => {
            let device = subject.device(&[], &Overrides::none())?;
            let run = &subject.runs[run];
            Ok(alone::moving(device, alone::taken_up(run), run.ends))
        }
        predicted => Ok(moving(subject, &subject.runs[run], predicted)),
    });
    let moving = moving.collect::<Result<Vec<Steps>, EffectError>>()?;
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
    Ok(())
}

/// Whether the model says of itself when it moves: no flag does, and it is replayed in one go from rest.
fn is_followed(subject: &Subject, run: &Run) -> bool {
    let has_flag = FLAGS.iter().any(|flag| subject.signals.iter().any(|info| info.property == *flag));
    !has_flag && !run.settles && !run.resumes && run.restarts.is_none() && run.settings.is_empty()
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
            let edge = predicted.and_then(|predicted| flag_edge(subject, predicted, at - seconds, *at));
            steps.push((edge.unwrap_or(at - 0.5 * seconds), count));
        }
        before.copy_from_slice(&now);
    }
    steps
}

/// When the flag that says that it moves is predicted to change within a span, if it is.
fn flag_edge(subject: &Subject, predicted: &[Predicted], from: f64, to: f64) -> Option<f64> {
    let place = subject.signals.iter().position(|info| FLAGS.contains(&info.property.as_str()))?;
    let Predicted::Edges { edges, .. } = &predicted[place] else { return None };
    edges.iter().rev().map(|edge| edge.at).find(|edge| (from..=to).contains(edge))
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
    use crate::device::bench::Bench;

    /// Two axes of a robot, told the one a little after the other, in the middle of nothing that a look would show.
    #[test]
    fn a_device_is_asked_since_when_it_moves() {
        let robot = Bench::new("kinetwin.CartesianRobot", &[]);
        let port = |name: &str| robot.kind.port(name).expect(name);
        let commands = [(port("XTarget"), 0.3137, 0.2), (port("YTarget"), 0.3351, 0.2)];
        let steps = alone::moving(robot.device, commands.into_iter(), 3.0);
        let counts: Vec<u32> = steps.iter().map(|(_, count)| *count).collect();
        assert_eq!(counts, [1, 2, 1, 0]);
        // Speeds up and down at 2 m/s² over 0.2 m, below its highest speed.
        let takes = 2.0 * (0.2_f64 / 2.0).sqrt();
        let begun = [0.3137, 0.3351].into_iter();
        let expected: Vec<f64> = begun.clone().chain(begun.map(|at| at + takes)).collect();
        let near = steps.iter().zip(expected).all(|((at, _), expected)| (at - expected).abs() <= 1e-3);
        assert!(near, "{steps:?}");
    }

    #[test]
    fn the_sum_of_steps_steps_with_each() {
        let one = [(1.0, 1), (3.0, 0)];
        let two = [(2.0, 2), (3.0, 1)];
        assert_eq!(sum([&one[..], &two[..]].into_iter()), [(1.0, 1), (2.0, 3), (3.0, 1)]);
    }
}
