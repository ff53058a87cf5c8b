//! Motion that is faster than anything in the training: what a law found there says of it nobody knows, so it is not scored.

use crate::gap::report::NotTestable;
use crate::gap::statistics::quantile;
use crate::gap::{Predicted, Prediction, Run, Study, Subject};
use crate::value::Quantity;

/// Over how long a speed of the training is averaged, and one that is held out, s: a moment of haste is no trained speed, and
/// one in a held-out motion makes it no other motion.
const TRAINED_S: f64 = 0.1;
const ASKED_S: f64 = 1.0;
/// Of the moving samples of the training, the share that is no faster than what is trained.
const MOST: f64 = 0.99;
/// Speeds that differ by less are one.
const ALIKE: f64 = 1.05;

/// Leaves out of `held_out` what is faster than the training, and says so: a line for each device and recording.
pub(super) fn leave_out(held_out: &mut Study, training: &Study) -> Vec<NotTestable> {
    let mut left_out = Vec::new();
    let pairs = held_out.subjects.iter_mut().zip(&held_out.nominal);
    for ((subject, nominal), (trained, trained_nominal)) in pairs.zip(training.subjects.iter().zip(&training.nominal)) {
        // What is taken up again from where its machine was has the machine's own speed.
        if trained.is_weighed_already() {
            continue;
        }
        for signal in 0..subject.signals.len() {
            let Some(most) = trained_speed(trained, trained_nominal, signal) else { continue };
            for run in 0..subject.runs.len() {
                left_out.extend(leave_out_of(subject, nominal, (run, signal), most));
            }
        }
    }
    left_out
}

/// The highest speed of a signal that the training shows: of its nominal motion, which the recording may not reach.
fn trained_speed(subject: &Subject, nominal: &Prediction, signal: usize) -> Option<f64> {
    let mut speeds = Vec::new();
    for (run, predicted) in subject.runs.iter().zip(&nominal.runs) {
        let Some(speed) = Speeds::of(subject, run, signal, &predicted[signal]) else { continue };
        let track = run.tracks[signal].as_ref()?;
        let seen = (0..speed.way.len()).filter(|k| !track.is_blind(track.first + k));
        speeds.extend(seen.map(|k| speed.mean(k, TRAINED_S)));
    }
    let highest = speeds.iter().copied().fold(0.0, f64::max);
    let moving: Vec<f64> = speeds.into_iter().filter(|speed| *speed > 1e-3 * highest).collect();
    (!moving.is_empty()).then(|| quantile(&moving, MOST))
}

fn leave_out_of(
    subject: &mut Subject,
    nominal: &Prediction,
    (run, signal): (usize, usize),
    most: f64,
) -> Option<NotTestable> {
    let (asked, first) = {
        let run_of = &subject.runs[run];
        let speed = Speeds::of(subject, run_of, signal, &nominal.runs[run][signal])?;
        let asked: Vec<f64> = (0..speed.way.len()).map(|k| speed.mean(k, ASKED_S)).collect();
        (asked, run_of.tracks[signal].as_ref()?.first)
    };
    let spans = above(&asked, ALIKE * most);
    if spans.is_empty() {
        return None;
    }
    let instants = subject.runs[run].tracks[signal].as_ref()?.grid.instants.clone();
    let at = |index: usize| instants[(first + index).min(instants.len() - 1)];
    for track in subject.runs[run].tracks.iter_mut().flatten() {
        let place = |at: f64| track.grid.instants.partition_point(|own| *own < at);
        let blind: Vec<(usize, usize)> = spans.iter().map(|(from, to)| (place(at(*from)), place(at(*to)))).collect();
        track.blind.extend(blind);
    }
    let count: usize = spans.iter().map(|(from, to)| to - from + 1).sum();
    let (info, unit) = (&subject.signals[signal], &subject.signals[signal].unit);
    let unit = if unit.ends_with("/s") { unit.clone() } else { format!("{unit}/s") };
    Some(NotTestable {
        device: Some(subject.name.clone()),
        reason: format!(
            "{} is asked for up to {:.3} {unit} in {}, the mean of a second, and for up to {most:.3} {unit} in the training: what is \
             faster, {:.0} % of that recording from {:.1} s on, is not scored",
            info.name,
            asked.iter().copied().fold(0.0, f64::max),
            subject.runs[run].recording,
            100.0 * count as f64 / asked.len() as f64,
            at(spans[0].0)
        ),
        needs: format!("a training motion above {most:.3} {unit}"),
        ..NotTestable::default()
    })
}

/// Spans of indices, both ends included, in which values lie above `most`.
fn above(values: &[f64], most: f64) -> Vec<(usize, usize)> {
    let mut spans: Vec<(usize, usize)> = Vec::new();
    for k in (0..values.len()).filter(|k| values[*k] > most) {
        match spans.last_mut() {
            Some((_, to)) if *to + 1 == k => *to = k,
            _ => spans.push((k, k)),
        }
    }
    spans
}

/// How far a nominal motion has gone, to and fro, at each instant of its track.
struct Speeds<'a> {
    instants: &'a [f64],
    way: Vec<f64>,
}

impl<'a> Speeds<'a> {
    fn of(subject: &Subject, run: &'a Run, signal: usize, predicted: &Predicted) -> Option<Speeds<'a>> {
        let track = run.tracks[signal].as_ref()?;
        let Predicted::Level(values) = predicted else { return None };
        let quantities = subject.signals[signal].descriptor.quantities;
        let is_a = |wanted: [Quantity; 2]| quantities.iter().any(|quantity| wanted.contains(quantity));
        let is_speed = is_a([Quantity::Velocity, Quantity::AngularVelocity]);
        if !is_speed && !is_a([Quantity::Length, Quantity::Angle]) || values.len() < 2 {
            return None;
        }
        let instants = &track.grid.instants[track.first..track.first + values.len()];
        let mut gone = 0.0;
        let steps = values.windows(2).zip(instants.windows(2)).map(|(x, t)| match is_speed {
            true => 0.5 * (x[0].abs() + x[1].abs()) * (t[1] - t[0]),
            false => (x[1] - x[0]).abs(),
        });
        let way = std::iter::once(0.0).chain(steps.map(|step| {
            gone += step;
            gone
        }));
        Some(Speeds { instants, way: way.collect() })
    }

    /// The mean speed of the span about the `k`th instant.
    fn mean(&self, k: usize, span: f64) -> f64 {
        let at = |instant: f64| self.instants.partition_point(|own| *own < instant).min(self.instants.len() - 1);
        let (from, to) = (at(self.instants[k] - 0.5 * span), at(self.instants[k] + 0.5 * span));
        // At the ends, and across a silence, the span is what was recorded of it, or longer.
        let lasted = (self.instants[to] - self.instants[from]).max(span);
        (self.way[to] - self.way[from]) / lasted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_above_a_value_are_found_with_their_ends() {
        assert_eq!(above(&[2.0, 0.0, 3.0, 3.0, 0.0, 2.0], 1.0), [(0, 0), (2, 3), (5, 5)]);
        assert!(above(&[1.0], 1.0).is_empty());
    }

    #[test]
    fn a_speed_is_the_mean_of_its_span() {
        let instants: Vec<f64> = (0..200).map(|k| 0.01 * f64::from(k)).collect();
        // A step of 1 at 1 s.
        let way = instants.iter().map(|at| if *at < 0.995 { 0.0 } else { 1.0 }).collect();
        let speeds = Speeds { instants: &instants, way };
        assert!((speeds.mean(100, 1.0) - 1.0).abs() < 0.02 && speeds.mean(10, 1.0) == 0.0);
        assert!((speeds.mean(100, 0.1) - 10.0).abs() < 0.2);
    }
}
