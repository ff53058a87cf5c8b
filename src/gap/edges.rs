//! Recorded and predicted edges, paired.
//!
//! Both were looked at on the same grid, so that a pulse within a cycle is in neither. They are paired in order and by what
//! they change to; where one side has more, so that the whole costs least.

use super::cost;
use super::prediction::PredictedEdge;
use super::track::{Edge, Track};

/// A recorded edge and the predicted one that is taken for it, or one that stands alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    /// Its place among the track's edges.
    pub recorded: Option<usize>,
    /// Its place among the predicted edges.
    pub predicted: Option<usize>,
}

/// How many edges one side may be ahead of the other beyond the difference of their numbers.
const AHEAD: usize = 8;

/// Pairs the edges of a track. `sigma` is how far a sensor may be off in time, s.
pub(super) fn pair(track: &Track, predicted: &[PredictedEdge], sigma: f64) -> Vec<Pair> {
    let recorded = &track.edges;
    let in_order = recorded.len() == predicted.len()
        && recorded.iter().zip(predicted).all(|(a, b)| a.to == b.to && a.index.abs_diff(b.index) <= 1);
    if in_order {
        return (0..recorded.len()).map(|at| Pair { recorded: Some(at), predicted: Some(at) }).collect();
    }
    cheapest(track, recorded, predicted, sigma)
}

/// The pairing that costs least: an alignment of two sequences (S. B. Needleman, C. D. Wunsch, J. Mol. Biol. 48, 1970), where
/// an edge alone costs what a stray one does.
fn cheapest(track: &Track, recorded: &[Edge], predicted: &[PredictedEdge], sigma: f64) -> Vec<Pair> {
    let (n, m) = (recorded.len(), predicted.len());
    let band = n.abs_diff(m) + AHEAD;
    let alone = cost::unmatched();
    let width = m + 1;
    let mut best = vec![f64::INFINITY; (n + 1) * width];
    let near = |i: usize, j: usize| i.abs_diff(j) <= band;
    // What comes further off than a stray edge does is another.
    let is_far = |i: usize, j: usize| {
        let seen = track.grid.instants.get(recorded[i].index);
        seen.is_some_and(|seen| (seen - predicted[j].at).abs() > cost::STRAY_SPAN_S)
    };
    let paired = |i: usize, j: usize| match recorded[i].to == predicted[j].to && !is_far(i, j) {
        true => interval_cost(track, recorded[i].index, &predicted[j], sigma),
        false => f64::INFINITY,
    };
    for i in 0..=n {
        for j in (0..=m).filter(|&j| near(i, j)) {
            let mut least = if i + j == 0 { 0.0 } else { f64::INFINITY };
            if i > 0 {
                least = least.min(best[(i - 1) * width + j] + alone);
            }
            if j > 0 {
                least = least.min(best[i * width + j - 1] + alone);
            }
            if i > 0 && j > 0 {
                least = least.min(best[(i - 1) * width + j - 1] + paired(i - 1, j - 1));
            }
            best[i * width + j] = least;
        }
    }
    let (mut i, mut j) = (n, m);
    let mut pairs = Vec::with_capacity(n.max(m));
    while i + j > 0 {
        let here = best[i * width + j];
        if i > 0 && j > 0 && best[(i - 1) * width + j - 1] + paired(i - 1, j - 1) <= here + 1e-9 {
            (i, j) = (i - 1, j - 1);
            pairs.push(Pair { recorded: Some(i), predicted: Some(j) });
        } else if i > 0 && best[(i - 1) * width + j] + alone <= here + 1e-9 {
            i -= 1;
            pairs.push(Pair { recorded: Some(i), predicted: None });
        } else {
            j -= 1;
            pairs.push(Pair { recorded: None, predicted: Some(j) });
        }
    }
    pairs.reverse();
    pairs
}

/// Between which instants an edge came that the track shows at `index`, s.
pub(super) fn interval(track: &Track, index: usize) -> (f64, f64) {
    let instants = &track.grid.instants;
    let seen = instants[index];
    let before = index.checked_sub(1).map_or(seen - track.grid.cycle, |before| instants[before]);
    (before, seen)
}

/// How far an edge may be off in time, s: as far as its sensor (`sigma`), its instants, and the part that makes it.
pub(super) fn uncertainty(track: &Track, predicted: &PredictedEdge, sigma: f64) -> f64 {
    const SLOWEST: f64 = 1e-3;
    let part =
        predicted.part.map_or(0.0, |passing| track.tolerance.hypot(passing.astray) / passing.speed.abs().max(SLOWEST));
    sigma.hypot(track.grid.spread).hypot(part)
}

/// What it costs that a predicted edge is shown at `index`.
pub(super) fn interval_cost(track: &Track, index: usize, predicted: &PredictedEdge, sigma: f64) -> f64 {
    let (before, seen) = interval(track, index);
    cost::edge(before, seen, predicted.at, uncertainty(track, predicted, sigma))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gap::Grid;

    fn track(edges: &[(usize, f64)]) -> Track {
        let edges = edges.iter().map(|(index, to)| Edge { index: *index, to: *to }).collect();
        let grid = Arc::new(Grid::of_steps(0.02, 60.0));
        Track {
            grid,
            first: 0,
            values: Vec::new(),
            initial: 0.0,
            edges,
            origins: Vec::new(),
            tolerance: 0.0,
            blind: Vec::new(),
            anew: Vec::new(),
        }
    }

    fn predicted(edges: &[(f64, f64)]) -> Vec<PredictedEdge> {
        let edge =
            |(at, to): &(f64, f64)| PredictedEdge { at: *at, index: (at / 0.02).ceil() as usize, to: *to, part: None };
        edges.iter().map(edge).collect()
    }

    #[test]
    fn a_missing_pulse_shifts_nothing_behind_it() {
        let track = track(&[(50, 1.0), (60, 0.0), (250, 1.0), (260, 0.0)]);
        let predicted = predicted(&[(0.99, 1.0), (1.19, 0.0), (3.0, 1.0), (3.1, 0.0), (4.99, 1.0), (5.19, 0.0)]);
        let pairs = pair(&track, &predicted, 3e-4);
        let paired: Vec<_> = pairs.iter().filter_map(|pair| Some((pair.recorded?, pair.predicted?))).collect();
        assert_eq!(paired, [(0, 0), (1, 1), (2, 4), (3, 5)]);
        assert_eq!(pairs.len(), 6);
    }

    /// A switch that came on 31 s before the model's did: of two edges so far apart each stands alone.
    #[test]
    fn edges_half_a_minute_apart_are_two() {
        let track = track(&[(300, 0.0), (315, 1.0)]);
        let pairs = pair(&track, &predicted(&[(5.99, 0.0), (37.6, 1.0)]), 3e-4);
        let alone = [Pair { recorded: Some(1), predicted: None }, Pair { recorded: None, predicted: Some(1) }];
        assert_eq!(pairs[0], Pair { recorded: Some(0), predicted: Some(0) });
        assert_eq!(pairs.len(), 3);
        assert!(alone.iter().all(|edge| pairs.contains(edge)), "{pairs:?}");
    }

    #[test]
    fn late_edges_are_paired_all_the_same() {
        let track = track(&[(50, 1.0), (60, 0.0)]);
        let pairs = pair(&track, &predicted(&[(0.8, 1.0), (1.0, 0.0)]), 3e-4);
        assert_eq!(pairs, [0, 1].map(|at| Pair { recorded: Some(at), predicted: Some(at) }));
    }
}
