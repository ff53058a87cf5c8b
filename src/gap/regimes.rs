//! In which regimes a device's gap lies: what it was doing, what it bore, where it was, and when.
//!
//! Four questions are asked one beside the other, and the shares of each sum to 1: starting, cruising, stopping, reversing or
//! holding; loaded or empty; in the lower or the upper half of its way; in the first or the second half of a recording. Motion
//! is always told. The others are told where they say something: where the gap does not fall on them as the time does.

use super::prediction::{Predicted, Prediction};
use super::report::Regime;
use super::score::{Score, SignalScore};
use super::subject::{Run, Subject};
use super::world::Surrounding;
use crate::value::Quantity;

/// Below this share of the highest speed a device holds; below this share of the steepest change of it, it cruises.
const AT_REST: f64 = 1e-3;
const STEADY: f64 = 0.05;
/// How long after a change of sign of the speed it is a reversal, s.
const REVERSAL_S: f64 = 0.3;
/// A level's squares count where they are above its floor's by this factor.
const ABOVE_FLOOR: f64 = 1.5;
/// A share below this is not worth a word.
const WORTH_A_WORD: f64 = 0.05;
/// By how much a share of the gap must differ from that of the time to be told.
const TELLING: f64 = 0.2;
/// In how many instants a recording is divided to see how the time falls.
const INSTANTS: usize = 400;

const MOTION: [&str; 5] = ["starting", "cruising", "stopping", "reversing", "holding"];
const LOAD: [&str; 2] = ["empty", "loaded"];
const POSITION: [&str; 2] = ["in the lower half of its way", "in the upper half of its way"];
const TIME: [&str; 2] = ["in the first half of the recording", "in the second half of the recording"];

/// The regimes of the nominal motion that hold the gap's squares, each question's largest share first.
pub(super) fn regimes(subject: &Subject, nominal: &Prediction, score: &Score) -> Vec<Regime> {
    let courses: Vec<Course> = (0..subject.runs.len()).map(|run| Course::of(subject, nominal, run)).collect();
    let mut gap = Tally::default();
    for signal in &score.signals {
        let course = &courses[signal.run];
        squares(signal).for_each(|(at, square)| gap.add(course, at, square));
    }
    let mut time = Tally::default();
    for course in &courses {
        for k in 0..INSTANTS {
            time.add(course, course.ends * (k as f64 + 0.5) / INSTANTS as f64, course.ends);
        }
    }
    let mut regimes = named(&MOTION, &gap.motion);
    let telling = |gap: &[f64; 2], time: &[f64; 2]| {
        let share = |of: &[f64; 2]| of[0] / (of[0] + of[1]);
        // A question that one side alone answers (nothing was ever borne) is none; nor is one without a gap.
        time.iter().all(|part| *part > 0.0) && (share(gap) - share(time)).abs() > TELLING
    };
    let both = [(&LOAD, gap.load, time.load), (&POSITION, gap.position, time.position), (&TIME, gap.time, time.time)];
    for (names, gap, _) in both.iter().filter(|(_, gap, time)| telling(gap, time)) {
        regimes.extend(named(*names, gap));
    }
    regimes
}

/// The shares of one question, the largest first.
fn named(names: &[&str], parts: &[f64]) -> Vec<Regime> {
    let sum: f64 = parts.iter().sum();
    let worth = names.iter().zip(parts).filter(|(_, part)| **part > WORTH_A_WORD * sum);
    let mut regimes: Vec<Regime> =
        worth.map(|(name, part)| Regime { when: (*name).to_owned(), share: part / sum }).collect();
    regimes.sort_by(|a, b| b.share.total_cmp(&a.share));
    regimes
}

/// The squares of a signal's gap in units of its floor, each with its instant.
fn squares(signal: &SignalScore) -> impl Iterator<Item = (f64, f64)> {
    let floor = signal.floor.max(1e-12);
    let level = signal.level.as_ref().filter(|_| (signal.rms / floor).powi(2) > ABOVE_FLOOR);
    let levels = level.into_iter().flat_map(|level| level.at.iter().zip(&level.difference));
    let levels = levels.map(move |(at, difference)| (*at, (difference / floor).powi(2)));
    levels.chain(signal.edges.iter().map(|edge| (edge.at(), edge.residual.powi(2))))
}

/// Sums by the answer to each question.
#[derive(Default)]
struct Tally {
    motion: [f64; 5],
    load: [f64; 2],
    position: [f64; 2],
    time: [f64; 2],
}

impl Tally {
    fn add(&mut self, course: &Course, at: f64, what: f64) {
        if let Some(motion) = course.motion(at) {
            self.motion[motion] += what;
        }
        if let Some(is_upper) = course.is_upper(at) {
            self.position[usize::from(is_upper)] += what;
        }
        self.load[usize::from(course.is_loaded(at))] += what;
        self.time[usize::from(at > 0.5 * course.ends)] += what;
    }
}

/// What a device does in a run, by its nominal law and by what was seen of its parts.
struct Course {
    ends: f64,
    speeds: Option<Speeds>,
    /// Its position at each instant of its reports, and the middle of its way.
    positions: Option<(Vec<f64>, Vec<f64>, f64)>,
    /// Spans in which it bears something, s.
    loaded: Vec<(f64, f64)>,
}

impl Course {
    fn of(subject: &Subject, nominal: &Prediction, run: usize) -> Course {
        let level = |place: usize, wanted: [Quantity; 2]| {
            let quantities = subject.signals[place].descriptor.quantities;
            let is_wanted = quantities.iter().any(|quantity| wanted.contains(quantity));
            let track = subject.runs[run].tracks[place].as_ref().filter(|_| is_wanted)?;
            let Predicted::Level(values) = &nominal.runs[run][place] else { return None };
            Some((track.grid.instants[track.first..track.first + values.len()].to_vec(), values.clone()))
        };
        let first = |wanted: [Quantity; 2]| (0..subject.signals.len()).find_map(|place| level(place, wanted));
        let positions = first([Quantity::Length, Quantity::Angle]);
        let speeds = first([Quantity::Velocity, Quantity::AngularVelocity])
            .or_else(|| positions.as_ref().map(|(instants, values)| (instants.clone(), slopes(instants, values))));
        let middle = |values: &[f64]| {
            let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
            0.5 * (low + high)
        };
        Course {
            ends: subject.runs[run].ends,
            speeds: speeds.map(|(instants, speeds)| Speeds::of(instants, speeds)),
            positions: positions.map(|(instants, values)| {
                let middle = middle(&values);
                (instants, values, middle)
            }),
            loaded: loaded(&subject.runs[run], &nominal.runs[run]),
        }
    }

    /// By its place among the names.
    fn motion(&self, at: f64) -> Option<usize> {
        self.speeds.as_ref().map(|speeds| speeds.motion(at))
    }

    fn is_upper(&self, at: f64) -> Option<bool> {
        let (instants, values, middle) = self.positions.as_ref()?;
        let place = instants.partition_point(|instant| *instant < at).min(values.len().checked_sub(1)?);
        Some(values[place] > *middle)
    }

    fn is_loaded(&self, at: f64) -> bool {
        self.loaded.iter().any(|(from, to)| (*from..=*to).contains(&at))
    }
}

fn slopes(instants: &[f64], values: &[f64]) -> Vec<f64> {
    let pairs = instants.windows(2).zip(values.windows(2));
    pairs.map(|(t, x)| (x[1] - x[0]) / (t[1] - t[0]).max(1e-9)).collect()
}

/// From the first to the last edge of each part at a belt's barriers; while a gripper's cups are sealed.
fn loaded(run: &Run, predicted: &[Predicted]) -> Vec<(f64, f64)> {
    let mut parts = std::collections::BTreeMap::new();
    let edges = predicted.iter().flat_map(|predicted| match predicted {
        Predicted::Edges { edges, .. } => edges.as_slice(),
        _ => &[],
    });
    for edge in edges {
        if let Some(passing) = &edge.part {
            let span = parts.entry(passing.part).or_insert((edge.at, edge.at));
            *span = (span.0.min(edge.at), span.1.max(edge.at));
        }
    }
    let sealed = run.script.told.iter().filter(|told| told.what == Surrounding::Sealed);
    let until = sealed.clone().skip(1).map(|told| told.at).chain([run.ends]);
    let sealed = sealed.zip(until).filter(|(told, _)| told.is_on).map(|(told, until)| (told.at, until));
    parts.values().copied().chain(sealed).collect()
}

/// How fast the device moves, by its nominal law.
struct Speeds {
    instants: Vec<f64>,
    speeds: Vec<f64>,
    highest: f64,
    steepest: f64,
}

impl Speeds {
    fn of(instants: Vec<f64>, speeds: Vec<f64>) -> Speeds {
        let steps = speeds.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let steepest = steps.fold(0.0, f64::max);
        let highest = speeds.iter().map(|speed| speed.abs()).fold(0.0, f64::max);
        Speeds { instants, speeds, highest, steepest }
    }

    /// By its place among the names.
    fn motion(&self, at: f64) -> usize {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Up in 20 samples, on for 20, down through 0 in 40, on, and to a stop.
    fn ramp(k: i32) -> f64 {
        match k {
            0..20 => f64::from(k) / 20.0,
            20..40 => 1.0,
            40..80 => 1.0 - f64::from(k - 40) / 20.0,
            80..100 => -1.0,
            100..120 => -1.0 + f64::from(k - 100) / 20.0,
            _ => 0.0,
        }
    }

    fn course() -> Course {
        let instants: Vec<f64> = (0..160).map(|k| f64::from(k) * 0.02).collect();
        Course {
            ends: 3.2,
            speeds: Some(Speeds::of(instants.clone(), (0..160).map(ramp).collect())),
            positions: Some((instants.clone(), instants, 1.6)),
            loaded: vec![(0.0, 0.8)],
        }
    }

    #[test]
    fn a_motion_falls_into_its_regimes() {
        let course = course();
        let expected = [
            (10, "starting"),
            (30, "cruising"),
            (50, "stopping"),
            (66, "reversing"),
            (90, "cruising"),
            (110, "stopping"),
            (150, "holding"),
        ];
        for (at, doing) in expected {
            let motion = course.motion(f64::from(at) * 0.02).expect("a speed");
            assert_eq!(MOTION[motion], doing, "at {at}");
        }
    }

    #[test]
    fn a_gap_falls_into_load_position_and_time() {
        let course = course();
        let mut tally = Tally::default();
        tally.add(&course, 0.5, 3.0);
        tally.add(&course, 2.0, 1.0);
        assert_eq!((tally.load, tally.position, tally.time), ([1.0, 3.0], [3.0, 1.0], [3.0, 1.0]));
        let loads = named(&LOAD, &tally.load);
        assert_eq!((loads[0].when.as_str(), loads[0].share), ("loaded", 0.75));
    }
}
