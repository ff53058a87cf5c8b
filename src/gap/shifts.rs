//! Where each part that passes a belt's barriers really was, and which of the plant's parts it was: as all its edges are likeliest.

use super::edges::{interval_cost, pair};
use super::prediction::PredictedEdge;
use super::track::Track;
use super::world::{Cut, Script};

/// How far a part may be from where its first edge says, m.
const LATENT_M: f64 = 0.25;

/// A barrier that parts pass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Barrier<'a> {
    pub track: &'a Track,
    pub predicted: &'a [PredictedEdge],
    /// How far its edges may be off in time, s.
    pub sigma: f64,
}

/// An edge of a part, recorded and predicted.
#[derive(Clone, Copy, Debug)]
struct PartEdge<'a> {
    track: &'a Track,
    sigma: f64,
    /// The grid's instant that showed it.
    index: usize,
    predicted: PredictedEdge,
}

/// How much further each part was than its first edge said, m.
pub(super) fn likeliest_shifts(barriers: &[Barrier<'_>]) -> Vec<f64> {
    edges_of_parts(barriers).iter().map(|edges| likeliest_shift(edges).1).collect()
}

/// What costs less than this is well enough explained.
const EXPLAINED: f64 = 6.0;

/// The script with other lengths for those parts whose edges say so: which of the plant's parts it was is known from the belt's way,
/// and so by no more than that is. `None` where all are as likely as can be.
pub(super) fn relengthed(script: &Script, lengths: &[f64], barriers: &[Barrier<'_>]) -> Option<Script> {
    let mut other: Option<Script> = None;
    for (part, edges) in edges_of_parts(barriers).into_iter().enumerate() {
        let of_part = |cut: &&Cut| cut.part == part && cut.length.is_finite() && !cut.is_known;
        let Some(now) = script.cuts.iter().find(of_part).map(|cut| cut.length) else { continue };
        let least = likeliest_shift(&edges).0;
        if least < EXPLAINED {
            continue;
        }
        let with = |length: f64| {
            let longer = edges.iter().map(|edge| {
                // On its way back a part comes with its rear.
                let comes_on = edge.predicted.part.is_none_or(|passing| passing.speed >= 0.0);
                let by = if (edge.predicted.to == 0.0) == comes_on { now - length } else { 0.0 };
                PartEdge { predicted: PredictedEdge { at: shifted(&edge.predicted, by), ..edge.predicted }, ..*edge }
            });
            likeliest_shift(&longer.collect::<Vec<_>>()).0
        };
        let costs = lengths.iter().map(|length| (with(*length), *length));
        let Some((cost, length)) = costs.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        if length != now && cost < least - 1.0 {
            let cuts = &mut other.get_or_insert_with(|| script.clone()).cuts;
            let own = cuts.iter_mut().filter(|cut| cut.part == part && cut.length.is_finite());
            own.for_each(|cut| cut.length = length);
        }
    }
    other
}

/// The edges of each part that were recorded and predicted.
fn edges_of_parts<'a>(barriers: &[Barrier<'a>]) -> Vec<Vec<PartEdge<'a>>> {
    let mut of_part: Vec<Vec<PartEdge<'a>>> = Vec::new();
    for Barrier { track, predicted, sigma } in barriers {
        for pair in pair(track, predicted, *sigma) {
            let (Some(recorded), Some(foreseen)) = (pair.recorded, pair.predicted) else { continue };
            let Some(part) = track.part(recorded) else { continue };
            if of_part.len() <= part {
                of_part.resize(part + 1, Vec::new());
            }
            let (index, predicted) = (track.edges[recorded].index, predicted[foreseen]);
            of_part[part].push(PartEdge { track, sigma: *sigma, index, predicted });
        }
    }
    of_part
}

/// What the edges of a part cost together at the least, and how much further it then was than its first edge said, m.
fn likeliest_shift(edges: &[PartEdge<'_>]) -> (f64, f64) {
    let cost = |shift: f64| -> f64 {
        let edge = |edge: &PartEdge<'_>| {
            let predicted = PredictedEdge { at: shifted(&edge.predicted, shift), ..edge.predicted };
            interval_cost(edge.track, edge.index, &predicted, edge.sigma)
        };
        edges.iter().map(edge).sum::<f64>() + 1e-6 * shift * shift
    };
    // Every edge's own best, and the ends of what it allows.
    let mut best = (cost(0.0), 0.0);
    let mut step: f64 = 0.0;
    for edge in edges {
        let Some(passing) = edge.predicted.part else { continue };
        let (before, seen) = super::edges::interval(edge.track, edge.index);
        for share in [0.02, 0.25, 0.5, 0.75, 0.98] {
            let wanted = before + share * (seen - before);
            let shift = ((edge.predicted.at - wanted) * passing.speed).clamp(-LATENT_M, LATENT_M);
            best = if cost(shift) < best.0 { (cost(shift), shift) } else { best };
            step = step.max(0.25 * (seen - before) * passing.speed.abs());
        }
    }
    // Then halved in on.
    for _ in 0..16 {
        for shift in [best.1 - step, best.1 + step] {
            best = if cost(shift) < best.0 { (cost(shift), shift) } else { best };
        }
        step *= 0.6;
    }
    best
}

/// When an edge comes of a part that is further by `shift`, s.
pub(super) fn shifted(edge: &PredictedEdge, shift: f64) -> f64 {
    const SLOWEST: f64 = 1e-3;
    edge.part.map_or(edge.at, |passing| edge.at - shift / passing.speed.abs().max(SLOWEST).copysign(passing.speed))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gap::{Edge, Grid};

    const CYCLE_S: f64 = 0.02;

    /// A barrier that was cut from 1.01 s to 1.61 s, looked at every 20 ms.
    fn barrier() -> Track {
        let edge = |at: f64, to: f64| Edge { index: (at / CYCLE_S).ceil() as usize, to };
        Track {
            grid: Arc::new(Grid::of_steps(CYCLE_S, 60.0)),
            first: 0,
            values: Vec::new(),
            initial: 0.0,
            edges: vec![edge(1.01, 1.0), edge(1.61, 0.0)],
            origins: Vec::new(),
            tolerance: 0.0,
            blind: Vec::new(),
            anew: Vec::new(),
        }
    }

    #[test]
    fn a_part_is_where_all_its_edges_are_likeliest() {
        let track = barrier();
        let edge = |at: f64, to: f64| PredictedEdge {
            at,
            index: (at / CYCLE_S).ceil() as usize,
            to,
            part: Some(crate::gap::Passing { part: 0, speed: 0.5, astray: 0.0 }),
        };
        // Both edges 45 ms early: the part was 22.5 mm further back than its first edge said, or a little beside.
        let edges = [edge(0.965, 1.0), edge(1.565, 0.0)];
        let parts: Vec<PartEdge<'_>> = track
            .edges
            .iter()
            .zip(edges)
            .map(|(seen, predicted)| PartEdge { track: &track, sigma: 3e-4, index: seen.index, predicted })
            .collect();
        let (_, shift) = likeliest_shift(&parts);
        assert!((-0.0275..=-0.0175).contains(&shift), "{shift}");
        assert!(parts.iter().all(|part| {
            let predicted = PredictedEdge { at: shifted(&part.predicted, shift), ..part.predicted };
            interval_cost(&track, part.index, &predicted, 3e-4) < 0.1
        }));
    }

    #[test]
    fn a_part_that_is_further_comes_sooner_and_on_its_way_back_later() {
        let edge = |speed: f64| PredictedEdge {
            at: 2.0,
            index: 100,
            to: 1.0,
            part: Some(crate::gap::Passing { part: 0, speed, astray: 0.0 }),
        };
        assert!((shifted(&edge(0.5), 0.01) - 1.98).abs() < 1e-12);
        assert!((shifted(&edge(-0.5), 0.01) - 2.02).abs() < 1e-12);
    }
}
