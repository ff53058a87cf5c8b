//! Recordings that begin under way: in which state a device was then is latent.
//!
//! A machine is recorded in the middle of its work. Where a device's first reports are far from what the model in its initial
//! state says, nothing counts until both rest and agree: from there on the model is where the machine is. Where they do not
//! agree soon (a sensor that is off, say) it counts from the first rest on.

use super::prediction::Predicted;
use super::subject::{Run, SignalInfo, beam_of};
use super::track::Track;

/// How long nothing changes where a device rests, s.
const REST_S: f64 = 0.5;
/// How long the two are waited for to agree: a span, s, and a share of the recording.
const PATIENCE_S: f64 = 20.0;
const PATIENCE: f64 = 0.25;
/// How far they may be apart and agree, in floors.
const FLOORS: f64 = 6.0;
/// How far they may be apart at the start and the model be taken to be where the machine is, as a share of its range.
const NEAR: f64 = 0.05;

/// Leaves out what a run reported before the model was where the machine is.
pub(super) fn await_agreement(signals: &[SignalInfo], run: &mut Run, predicted: &[Predicted]) {
    let Some(from) = agreement(signals, run, predicted) else { return };
    for track in run.tracks.iter_mut().flatten() {
        let until = track.grid.instants.partition_point(|at| *at < from);
        if until > track.first {
            track.blind.push((0, until - 1));
        }
    }
}

/// When it begins to count; `None`: at once.
fn agreement(signals: &[SignalInfo], run: &Run, predicted: &[Predicted]) -> Option<f64> {
    let states: Vec<State<'_>> = signals
        .iter()
        .enumerate()
        .filter_map(|(at, info)| State::of(info, run.tracks[at].as_ref()?, &predicted[at], run.floors[at].rms(0.0)))
        .collect();
    let begins = states.iter().map(State::begins).fold(f64::INFINITY, f64::min);
    let is_there = || states.iter().all(|state| state.agrees(state.begins(), state.near));
    if states.is_empty() || !run.resumes && is_there() {
        return None;
    }
    let mut changes: Vec<f64> = states.iter().flat_map(State::changes).collect();
    changes.extend([begins, run.ends]);
    changes.sort_by(f64::total_cmp);
    let mut rests = changes.windows(2).filter(|pair| pair[1] - pair[0] > REST_S).map(|pair| pair[0]);
    let first = rests.clone().next()?;
    let patience = begins + PATIENCE_S.min(PATIENCE * (run.ends - begins));
    let agreed = rests.find(|rest| states.iter().all(|state| state.agrees(rest + 0.5 * REST_S, state.tolerance)));
    Some(match agreed {
        Some(at) if at <= patience || run.resumes => at,
        // Nobody knows where it is: it never counts.
        None if run.resumes => run.ends + 1.0,
        _ => first,
    })
}

/// A signal as it was recorded and as it is predicted.
struct State<'a> {
    track: &'a Track,
    predicted: &'a Predicted,
    is_count: bool,
    tolerance: f64,
    /// A share of what was recorded.
    near: f64,
}

impl<'a> State<'a> {
    fn of(info: &SignalInfo, track: &'a Track, predicted: &'a Predicted, floor: f64) -> Option<State<'a>> {
        // What parts do at a beam is no state of the device.
        let is_its_own = beam_of(info).is_none() && !matches!(predicted, Predicted::Nothing);
        let ends = track.values.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
        let near = NEAR * (ends.1 - ends.0);
        let tolerance = FLOORS * floor;
        let state = State { track, predicted, is_count: info.is_count, tolerance, near: near.max(tolerance) };
        is_its_own.then_some(state)
    }

    fn begins(&self) -> f64 {
        self.track.grid.instants[self.track.first]
    }

    /// Whether both say the same at an instant, `within` so much. A count goes on from wherever it was.
    fn agrees(&self, at: f64, within: f64) -> bool {
        let instants = &self.track.grid.instants;
        let index = instants.partition_point(|instant| *instant <= at).saturating_sub(1).max(self.track.first);
        match self.predicted {
            Predicted::Level(values) => {
                let place = (index - self.track.first).min(values.len().saturating_sub(1));
                let pair = values.get(place).zip(self.track.values.get(place));
                self.is_count || pair.is_none_or(|(a, b)| (a - b).abs() <= within)
            }
            Predicted::Edges { initial, edges, .. } => {
                let recorded = self.track.edges.iter().rfind(|edge| edge.index <= index);
                let predicted = edges.iter().rfind(|edge| edge.index <= index);
                recorded.map_or(self.track.initial, |edge| edge.to) == predicted.map_or(*initial, |edge| edge.to)
            }
            Predicted::Nothing => true,
        }
    }

    /// When it changes, on either side.
    fn changes(&self) -> Vec<f64> {
        let instants = &self.track.grid.instants;
        let at = |index: usize| instants[index.min(instants.len() - 1)];
        match self.predicted {
            Predicted::Level(values) => {
                let moves = |values: &[f64], k: usize| (values[k] - values[k - 1]).abs() > self.tolerance;
                let pairs = 1..values.len().min(self.track.values.len());
                pairs
                    .filter(|k| moves(values, *k) || moves(&self.track.values, *k))
                    .map(|k| at(self.track.first + k))
                    .collect()
            }
            Predicted::Edges { edges, .. } => {
                let recorded = self.track.edges.iter().map(|edge| at(edge.index));
                recorded.chain(edges.iter().map(|edge| edge.at)).collect()
            }
            Predicted::Nothing => Vec::new(),
        }
    }
}
