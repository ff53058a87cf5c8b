//! Clocks beside that of the commands: one offset and one drift for each, shared by all that it stamped.
//!
//! What two clocks recorded has no common zero. Where a trace says which reports another clock stamped, that clock's offset and
//! drift are found as those that bring all of its reports, of all devices together, nearest to what the model predicts of
//! them. A device that is late beside the others on its clock stays late; of a clock with one device alone an offset is the
//! same as a dead time, and no recording tells them apart. Within one clock nothing is moved.
//!
//! An instant that the clock called t was at t + offset + drift·t by the clock of the commands (D. L. Mills, Computer Network
//! Time Synchronization, CRC Press 2010, section 4.1).

use serde::Serialize;

use super::fit::{Range, simplex};
use super::parts::Origin;
use super::prediction::Predicted;
use super::recording::Recording;
use super::statistics::{inflation, lag_one, least_gain, quantile};
use super::study::{Beforehand, Study, StudyError};
use super::subject::Subject;
use super::track::Track;
use crate::plant::Plant;

/// How far a clock is off that of the commands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClockOffset {
    pub name: String,
    /// What is added to its stamps at t = 0, s.
    pub offset_s: f64,
    /// What is added for each second more, 1; 0 where no drift shows.
    pub drift: f64,
    /// How many devices it stamped: of one alone an offset is the same as a dead time.
    pub devices: usize,
}

/// How far a clock may be off, s.
pub const MOST_OFFSET_S: f64 = 3.0;
/// How far it may drift, 1: far beyond a quartz.
const MOST_DRIFT: f64 = 1e-3;
/// Steps of the first search, s.
const STEP_S: f64 = 5e-3;
/// How often stamps are moved and the model is asked anew: what passes a belt is predicted from what was seen of it.
const ROUNDS: usize = 3;
/// A residual counts no more than as many deviations.
const CLIPPED: f64 = 3.0;

/// Moves the stamps of a recording's other clocks to that of the commands.
///
/// # Errors
/// A model whose own effects do not fit.
pub(super) fn align(plant: &Plant, recording: &Recording) -> Result<(Recording, Vec<ClockOffset>), StudyError> {
    let mut moved = recording.clone();
    let mut found: Vec<ClockOffset> = recording
        .clocks
        .iter()
        .map(|clock| ClockOffset { name: clock.name.clone(), offset_s: 0.0, drift: 0.0, devices: 0 })
        .collect();
    for round in 0..ROUNDS {
        let study = Study::of_one_clock(plant, std::slice::from_ref(&moved), Beforehand::NOTHING)?;
        for (clock, found) in found.iter_mut().enumerate() {
            let evidence = Evidence::of(&study, &moved, clock);
            let Some((offset, drift)) = evidence.nearest(round) else { continue };
            moved.shift(&plant.signal_map, clock, |at| at + offset + drift * at);
            // One correction after the other: (1 + d₂)·((1 + d₁)·t + o₁) + o₂.
            found.offset_s = offset + (1.0 + drift) * found.offset_s;
            found.drift += drift * (1.0 + found.drift);
            found.devices = evidence.devices;
        }
    }
    Ok((moved, found))
}

/// A level as it was recorded and as it is predicted, at the same instants.
struct Course {
    instants: Vec<f64>,
    recorded: Vec<f64>,
    predicted: Vec<f64>,
    /// Its deviation where nothing is wrong but the clock.
    sigma: f64,
}

impl Course {
    fn of(track: &Track, predicted: &[f64], step: f64) -> Option<Course> {
        let (low, high) = predicted.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
        let kept: Vec<usize> = (0..predicted.len()).filter(|k| !track.is_blind(track.first + k)).collect();
        // What never moves knows no time.
        (high - low > step && !kept.is_empty()).then(|| Course {
            instants: kept.iter().map(|k| track.grid.instants[track.first + k]).collect(),
            recorded: kept.iter().map(|k| track.values[*k]).collect(),
            predicted: kept.iter().map(|k| predicted[*k]).collect(),
            sigma: (0.02 * (high - low)).max(step),
        })
    }

    /// The prediction between its samples.
    fn at(&self, at: f64) -> f64 {
        let after = self.instants.partition_point(|instant| *instant < at).clamp(1, self.instants.len().max(2) - 1);
        let (Some(from), Some(to)) = (self.instants.get(after - 1), self.instants.get(after)) else {
            return self.predicted[0];
        };
        let part = ((at - from) / (to - from)).clamp(0.0, 1.0);
        self.predicted[after - 1] + part * (self.predicted[after] - self.predicted[after - 1])
    }

    fn rest(&self, at: &[f64]) -> impl Iterator<Item = f64> {
        let moved = |stamp: f64| stamp + at[0] + at[1] * stamp;
        self.instants.iter().zip(&self.recorded).map(move |(stamp, recorded)| recorded - self.at(moved(*stamp)))
    }
}

/// Edges as they were recorded and as they are predicted, s.
struct Edges {
    recorded: Vec<(f64, f64)>,
    predicted: Vec<(f64, f64)>,
}

/// All that a clock stamped.
struct Evidence {
    courses: Vec<Course>,
    edges: Vec<Edges>,
    devices: usize,
}

impl Evidence {
    fn of(study: &Study, recording: &Recording, clock: usize) -> Evidence {
        let mut evidence = Evidence { courses: Vec::new(), edges: Vec::new(), devices: 0 };
        for (subject, nominal) in study.subjects.iter().zip(&study.nominal) {
            let before = evidence.courses.len() + evidence.edges.len();
            for place in 0..subject.signals.len() {
                if recording.clock_of(subject.signals[place].register) == Some(clock) {
                    evidence.add(subject, place, &nominal.runs[0][place]);
                }
            }
            evidence.devices += usize::from(evidence.courses.len() + evidence.edges.len() > before);
        }
        evidence
    }

    fn add(&mut self, subject: &Subject, place: usize, predicted: &Predicted) {
        let run = &subject.runs[0];
        match (&run.tracks[place], predicted) {
            (Some(track), Predicted::Level(values)) => {
                self.courses.extend(Course::of(track, values, run.floors[place].step));
            }
            (Some(track), Predicted::Edges { edges, .. }) => {
                let middle = |index: usize| {
                    let before = track.grid.instants[index.saturating_sub(1)];
                    0.5 * (before + track.grid.instants[index])
                };
                let counts = |at: usize| track.origins.get(at).is_none_or(|origin| *origin != Origin::Input);
                let recorded = track.edges.iter().enumerate().filter(|(at, _)| counts(*at));
                let recorded: Vec<_> = recorded.map(|(_, edge)| (middle(edge.index), edge.to)).collect();
                let predicted: Vec<_> = edges.iter().map(|edge| (edge.at, edge.to)).collect();
                if !recorded.is_empty() && !predicted.is_empty() {
                    self.edges.push(Edges { recorded, predicted });
                }
            }
            _ => {}
        }
    }

    /// The offset and the drift that bring it nearest to the model; `None` where nothing moves. Deviations are those of the
    /// residuals themselves from the second round on.
    fn nearest(&self, round: usize) -> Option<(f64, f64)> {
        if self.courses.is_empty() && self.edges.is_empty() {
            return None;
        }
        let coarse = self.sigmas(None);
        let least = |candidates: &mut dyn Iterator<Item = f64>, sigmas: &(Vec<f64>, f64)| {
            candidates.map(|at| (self.cost(&[at, 0.0], sigmas), at)).min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let reach = if round == 0 { MOST_OFFSET_S } else { 20.0 * STEP_S };
        let steps = (reach / STEP_S) as i32;
        let (_, first) = least(&mut (-steps..=steps).map(|k| f64::from(k) * STEP_S), &coarse)?;
        let sigmas = self.sigmas(Some(first));
        let offset = |start: f64| Range { least: start - 0.1, greatest: start + 0.1, scale: 2e-3 };
        let alone = simplex(&mut |at| Some(self.cost(&[at[0], 0.0], &sigmas)), &[first], &[offset(first)], 1e-3, 80);
        let drift = Range { least: -MOST_DRIFT, greatest: MOST_DRIFT, scale: 2e-5 };
        let both =
            simplex(&mut |at| Some(self.cost(at, &sigmas)), &[alone.at[0], 0.0], &[offset(first), drift], 1e-3, 200);
        let drifts = alone.cost - both.cost > least_gain(1, 1) * self.inflation(&alone.at, &sigmas);
        Some(if drifts { (both.at[0], both.at[1]) } else { (alone.at[0], 0.0) })
    }

    /// The deviation of each course, and of the edges, s: a share of its range, or robustly from its residuals at an offset.
    fn sigmas(&self, at: Option<f64>) -> (Vec<f64>, f64) {
        let course = |course: &Course| match at {
            None => course.sigma,
            Some(offset) => {
                let rest: Vec<f64> = course.rest(&[offset, 0.0]).map(f64::abs).collect();
                (1.4826 * quantile(&rest, 0.5)).clamp(1e-3 * course.sigma, course.sigma)
            }
        };
        (self.courses.iter().map(course).collect(), if at.is_none() { 0.05 } else { 0.01 })
    }

    fn cost(&self, at: &[f64], (sigmas, edge_sigma): &(Vec<f64>, f64)) -> f64 {
        let clip = |z: f64| (z * z).min(CLIPPED * CLIPPED);
        let courses = self.courses.iter().zip(sigmas);
        let courses: f64 =
            courses.flat_map(|(course, sigma)| course.rest(at).map(move |rest| clip(rest / sigma))).sum();
        let nearest = |edges: &Edges, (stamp, to): (f64, f64)| {
            let moved = stamp + at[0] + at[1] * stamp;
            let same = edges.predicted.iter().filter(|predicted| predicted.1 == to);
            same.map(|predicted| (predicted.0 - moved).abs()).fold(f64::INFINITY, f64::min)
        };
        let edges = self.edges.iter().flat_map(|edges| edges.recorded.iter().map(|edge| nearest(edges, *edge)));
        courses + edges.map(|off| clip(off / edge_sigma)).sum::<f64>()
    }

    /// By how much neighbouring residuals repeat one another.
    fn inflation(&self, at: &[f64], sigmas: &(Vec<f64>, f64)) -> f64 {
        let offset = [at[0], 0.0];
        let each = self.courses.iter().zip(&sigmas.0);
        let rests = each.map(|(course, sigma)| course.rest(&offset).map(|rest| rest / sigma).collect::<Vec<_>>());
        let longest = rests.map(|rest| inflation(lag_one(&rest))).fold(1.0, f64::max);
        longest.min(100.0)
    }
}
