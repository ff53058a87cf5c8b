//! In which kinds of motion a gap lies.

use crate::gap::report::Regime;
use crate::gap::{Predicted, Prediction, Score, Subject};
use crate::value::Quantity;

/// Below this share of the highest speed a device holds; below this share of the steepest change of it, it cruises.
const AT_REST: f64 = 1e-3;
const STEADY: f64 = 0.05;
/// How long after a change of sign of the speed it is a reversal, s.
const REVERSAL_S: f64 = 0.3;

/// The regimes of the nominal motion that hold the gap's squares, the largest share first.
pub(super) fn regimes(subject: &Subject, nominal: &Prediction, score: &Score) -> Vec<Regime> {
    let names = ["starting", "cruising", "stopping", "reversing", "holding"];
    let mut squares = [0.0; 5];
    for signal in &score.signals {
        let Some(level) = &signal.level else { continue };
        let Some(course) = course(subject, nominal, signal.run, signal.signal) else { continue };
        let above = (signal.rms / signal.floor.max(1e-12)).powi(2);
        if above < 1.5 {
            continue;
        }
        for (at, difference) in level.at.iter().zip(&level.difference) {
            squares[course.regime(*at)] += (difference / signal.floor.max(1e-12)).powi(2);
        }
    }
    let sum: f64 = squares.iter().sum();
    let shares = names.iter().zip(squares).filter(|(_, part)| *part > 0.05 * sum);
    let mut regimes: Vec<Regime> =
        shares.map(|(name, part)| Regime { when: (*name).to_owned(), share: part / sum }).collect();
    regimes.sort_by(|a, b| b.share.total_cmp(&a.share));
    regimes
}

/// How fast the device moves, by its nominal law.
struct Course {
    instants: Vec<f64>,
    speeds: Vec<f64>,
    highest: f64,
    steepest: f64,
}

fn course(subject: &Subject, nominal: &Prediction, run: usize, signal: usize) -> Option<Course> {
    let speeds_of = |place: usize| {
        let track = subject.runs[run].tracks[place].as_ref()?;
        let quantities = subject.kind.ports[subject.signals[place].port].quantities;
        let is_a = |wanted: [Quantity; 2]| quantities.iter().any(|quantity| wanted.contains(quantity));
        let Predicted::Level(values) = &nominal.runs[run][place] else { return None };
        let instants = track.grid.instants[track.first..track.first + values.len()].to_vec();
        if is_a([Quantity::Velocity, Quantity::AngularVelocity]) {
            return Some((instants, values.clone()));
        }
        let pairs = || instants.windows(2).zip(values.windows(2));
        let speeds = pairs().map(|(t, x)| (x[1] - x[0]) / (t[1] - t[0]).max(1e-9)).collect();
        is_a([Quantity::Length, Quantity::Angle]).then(|| (instants.clone(), speeds))
    };
    let others = (0..subject.signals.len()).filter(|place| *place != signal);
    let (instants, speeds) = std::iter::once(signal).chain(others).find_map(speeds_of)?;
    let steps = speeds.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let steepest = steps.fold(0.0, f64::max);
    let highest = speeds.iter().map(|speed| speed.abs()).fold(0.0, f64::max);
    Some(Course { instants, speeds, highest, steepest })
}

impl Course {
    /// By its place among the names.
    fn regime(&self, at: f64) -> usize {
        let place = self.instants.partition_point(|instant| *instant < at).min(self.speeds.len().saturating_sub(2));
        let Some([now, next]) = self.speeds.get(place..place + 2).and_then(|pair| <[f64; 2]>::try_from(pair).ok())
        else {
            return 4;
        };
        let moves = |speed: f64| speed.abs() > AT_REST * self.highest;
        let since = self.instants.partition_point(|instant| *instant < at - REVERSAL_S);
        let before = self.speeds[since.min(place)..=place].iter().find(|speed| moves(**speed));
        if before.is_some_and(|before| moves(now) && before * now < 0.0) {
            return 3;
        }
        match () {
            () if !moves(now) && !moves(next) => 4,
            () if (next - now).abs() < STEADY * self.steepest => 1,
            () if next.abs() > now.abs() => 0,
            () => 2,
        }
    }
}
