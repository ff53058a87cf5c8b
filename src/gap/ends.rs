//! States that are apart where a recording begins or ends.
//!
//! A state that is wrong for a while has two edges alone: where it becomes so, and where it is right again. One that is wrong to the end of its recording, or was so from
//! its start, has only one of them in it, and one that is wrong all along has none. They say as much.

use super::cost::{self, residual};
use super::score::{EdgeScore, Foreseen};
use super::track::Track;

/// For how long, s: an edge that comes late, or before anything was recorded, is no state that stays wrong.
const APART_S: f64 = 1.0;

/// Weighs the edges of a state beside how it is foreseen to begin and to change: the edge alone from which on it is wrong to the end, or until which it was from the
/// start, as two; and one that is wrong all along as the two that would have made it so.
pub(super) fn weigh(edges: &mut Vec<EdgeScore>, track: &Track, foreseen: &Foreseen<'_>) {
    let Foreseen { initial, edges: predicted, .. } = *foreseen;
    let instants = &track.grid.instants;
    let Some((starts, ends)) = instants.get(track.first).copied().zip(instants.last().copied()) else { return };
    let begins_apart = track.initial != initial && !track.is_blind(track.first);
    let ended = track.edges.last().map_or(track.initial, |edge| edge.to);
    let ends_apart =
        ended != predicted.last().map_or(initial, |edge| edge.to) && !track.is_blind(instants.len().saturating_sub(1));
    if begins_apart && track.edges.is_empty() && predicted.is_empty() && ends - starts > APART_S {
        // The one that should have come before the recording began, and the one that should come before it ends.
        let never = |at: f64, to: f64| EdgeScore {
            to,
            recorded: None,
            predicted: Some(at),
            error: 0.0,
            uncertainty: track.grid.spread,
            cost: cost::unmatched(),
            residual: residual(cost::unmatched(), -1.0),
        };
        edges.extend([never(starts, initial), never(ends, track.initial)]);
        return;
    }
    let is_alone =
        |edge: &&mut EdgeScore| (edge.recorded.is_none() || edge.predicted.is_none()) && edge.cost >= cost::unmatched();
    if begins_apart && let Some(first) = edges.iter_mut().find(is_alone).filter(|edge| edge.at() - starts > APART_S) {
        as_two(first);
    }
    if ends_apart && let Some(last) = edges.iter_mut().rfind(is_alone).filter(|edge| ends - edge.at() > APART_S) {
        as_two(last);
    }
}

/// Lets an edge cost as much as two.
fn as_two(edge: &mut EdgeScore) {
    edge.cost += cost::unmatched();
    edge.residual = residual(edge.cost, edge.residual);
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gap::prediction::PredictedEdge;
    use crate::gap::score::{Foreseen, SignalScore};
    use crate::gap::track::Edge;
    use crate::gap::{Grid, Track};

    /// What edges cost, in edges alone, of a flag of 60 s: recorded and predicted, each with its state at the start.
    fn cost_of(recorded: (f64, &[f64]), predicted: (f64, &[f64]), blind: &[(usize, usize)]) -> f64 {
        let grid = Arc::new(Grid::of_steps(0.02, 60.0));
        let index = |at: f64| grid.instants.partition_point(|instant| *instant < at);
        let to = |initial: f64, place: usize| if place.is_multiple_of(2) { 1.0 - initial } else { initial };
        let edge = |(place, at): (usize, &f64)| Edge { index: index(*at), to: to(recorded.0, place) };
        let track = Track {
            grid: grid.clone(),
            first: 0,
            values: Vec::new(),
            initial: recorded.0,
            edges: recorded.1.iter().enumerate().map(edge).collect(),
            origins: Vec::new(),
            tolerance: 0.0,
            blind: blind.to_vec(),
            anew: Vec::new(),
        };
        let edge = |(place, at): (usize, &f64)| {
            let to = to(predicted.0, place);
            PredictedEdge { at: *at, index: index(*at), to, part: None }
        };
        let edges: Vec<PredictedEdge> = predicted.1.iter().enumerate().map(edge).collect();
        let foreseen = Foreseen { initial: predicted.0, edges: &edges, unseen: &[], turns: &[], shifts: &[] };
        let score = SignalScore::edges((0, 0), &track, &foreseen, 1e-4);
        assert!((score.edges.iter().map(|edge| edge.residual.powi(2)).sum::<f64>() - score.cost).abs() < 1e-9);
        score.cost / cost::unmatched()
    }

    /// A flag that sticks, one that was stuck, one that never lets go of what it should never show, and one that is right.
    #[test]
    fn a_state_that_stays_wrong_counts_as_one_that_was_wrong_for_a_while() {
        let of = |recorded, predicted| cost_of(recorded, predicted, &[]).round();
        assert_eq!(of((0.0, &[5.01, 6.01]), (0.0, &[])), 2.0);
        assert_eq!(of((0.0, &[5.01]), (0.0, &[])), 2.0);
        assert_eq!(of((0.0, &[]), (0.0, &[5.01])), 2.0);
        assert_eq!(of((1.0, &[5.01]), (0.0, &[])), 2.0);
        assert_eq!(of((1.0, &[]), (0.0, &[])), 2.0);
        assert_eq!(of((1.0, &[5.01, 7.01]), (1.0, &[5.01, 7.01])), 0.0);
        assert_eq!(of((1.0, &[]), (1.0, &[])), 0.0);
        // Wrong between two edges that come alike: of the one before, and the one behind.
        assert_eq!(of((0.0, &[5.01, 7.01, 9.01]), (0.0, &[5.01, 7.01])), 2.0);
    }

    /// What comes in the last moments may have been late, and where a device is not looked at nothing is wrong.
    #[test]
    fn what_is_wrong_for_moments_or_where_nobody_looks_does_not_stay_wrong() {
        assert_eq!(cost_of((0.0, &[]), (0.0, &[59.51]), &[]).round(), 1.0);
        assert_eq!(cost_of((1.0, &[0.51]), (0.0, &[]), &[]).round(), 1.0);
        assert_eq!(cost_of((1.0, &[5.01]), (0.0, &[]), &[(0, 100)]).round(), 1.0);
        assert_eq!(cost_of((1.0, &[]), (0.0, &[]), &[(0, 100)]), 0.0);
    }
}
