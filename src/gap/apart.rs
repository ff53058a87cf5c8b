//! How far two predictions lie apart: what these very recordings can tell of two causes.

use super::prediction::{Predicted, PredictedEdge};
use super::subject::Run;

/// How far off, in units of the noise, an edge is that only one of two predictions has: as far as an edge can be; and where nothing of either changes
/// for [`LASTING_S`] after it, s, further than anything is that nobody can tell.
const ALONE: f64 = 4.0;
const LASTS: f64 = 6.0;
const LASTING_S: f64 = 1.0;

/// Adds how far two predictions of a signal lie apart to `residuals`, in units of the noise: of a level sample by sample, of an edge in its time.
pub(super) fn apart(run: &Run, signal: usize, pair: (&Predicted, &Predicted), residuals: &mut Vec<f64>) {
    let Some(track) = &run.tracks[signal] else { return };
    match pair {
        (Predicted::Level(one), Predicted::Level(other)) => {
            let (floor, weighed) = (run.floors[signal], run.weighed(signal));
            let sigma = floor.rms(0.0).max(floor.sigma(0.0));
            let pairs = one.iter().zip(other).enumerate();
            residuals.extend(pairs.map(|(k, (a, b))| weighed.weight(k).sqrt() * (a - b) / sigma));
        }
        (Predicted::Edges { edges: one, .. }, Predicted::Edges { edges: other, .. }) => {
            let sigma = run.edge_sigmas[signal].hypot(track.grid.cycle / 12.0_f64.sqrt());
            edges_apart((one, other), sigma, run.ends, residuals);
        }
        _ => {}
    }
}

/// The same of edges in a recording that `ends` then, s; `sigma` is how far they may be off in time, s.
fn edges_apart((one, other): (&[PredictedEdge], &[PredictedEdge]), sigma: f64, ends: f64, residuals: &mut Vec<f64>) {
    let alone = |edge: &PredictedEdge| {
        let later = one.iter().chain(other).map(|next| next.at).filter(|at| *at > edge.at);
        if later.fold(ends, f64::min) - edge.at > LASTING_S { LASTS } else { ALONE }
    };
    let mut rest = other.iter().peekable();
    for edge in one {
        let near = rest.next_if(|other| other.to == edge.to);
        residuals.push(near.map_or_else(|| alone(edge), |near| (edge.at - near.at) / sigma));
    }
    residuals.extend(rest.map(alone));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::statistics::SAME_CLASS;

    /// A flag that comes on and stays: who says that it never does differs for good, which anyone sees; a flag that is on for half a second may be
    /// one that is not.
    #[test]
    fn a_state_that_differs_for_good_is_told() {
        let edge = |at: f64, to: f64| PredictedEdge { at, index: 0, to, part: None };
        let squared = |one: &[PredictedEdge], other: &[PredictedEdge]| {
            let mut residuals = Vec::new();
            edges_apart((one, other), 0.01, 10.0, &mut residuals);
            residuals.iter().map(|residual| residual * residual).sum::<f64>()
        };
        let on = [edge(3.0, 1.0)];
        assert!(squared(&on, &[]) > SAME_CLASS && squared(&[], &on) > SAME_CLASS);
        assert!(squared(&[edge(9.5, 1.0)], &[]) < SAME_CLASS);
        assert!((squared(&on, &[edge(3.02, 1.0)]) - 4.0).abs() < 1e-9);
    }
}
