//! Edges seen from afar: where a search begins among edges that are known to the millisecond.
//!
//! An edge that is known to a millisecond costs the same whether it is predicted a tenth of a second too early or half a second:
//! it is a stray. Far from the truth the deviance has no slope. So parameters are sought first with edges that may be off by as
//! much as they are, then by less and less, and only then as they are known.
//!
//! Source: graduated non-convexity (A. Blake, A. Zisserman, Visual Reconstruction, MIT Press 1987, chapter 3).

use super::bench::Bench;
use super::candidate::Candidate;
use crate::gap::fit::least_squares;
use crate::gap::statistics::quantile;
use crate::gap::{Score, Subject};

/// Edges that may be off by more than this are known too well for the search, s.
const SHARP_S: f64 = 2e-3;
/// No edge is sought from further off, s.
const FURTHEST_S: f64 = 0.15;

/// By how much better edges are known from one look to the next.
const NEARER: f64 = 8.0;

/// The device with its edges less well known, the least first; empty where what is off of them is not far beyond what is known.
pub fn blurred(subject: &Subject, score: &Score) -> Vec<Subject> {
    let edges = score.signals.iter().flat_map(|signal| &signal.edges);
    let off: Vec<f64> = edges.filter(|edge| edge.error != 0.0).map(|edge| edge.error.abs()).collect();
    let known = subject.runs.iter().flat_map(|run| &run.edge_sigmas).copied().fold(f64::INFINITY, f64::min);
    let far = quantile(&off, 0.75).min(FURTHEST_S);
    if far.is_nan() || far <= SHARP_S.max(4.0 * known) {
        return Vec::new();
    }
    let looks = ((far / known).ln() / NEARER.ln()).ceil().max(1.0);
    let sigma = |look: u32| far * (known / far).powf(f64::from(look) / looks);
    (0..looks as u32).map(|look| with_sigma(subject, sigma(look))).collect()
}

fn with_sigma(subject: &Subject, sigma: f64) -> Subject {
    let mut blurred = subject.clone();
    for run in &mut blurred.runs {
        run.edge_sigmas.iter_mut().for_each(|own| *own = own.max(sigma));
    }
    blurred
}

/// Where a candidate's search begins, seen from afar: where the devices of [`blurred`] led one after the other from the first of
/// `starts`, which are the best for the first of them, and those. `all` completes a candidate's parameters.
pub fn sharpened(
    bench: &Bench<'_>,
    blurred: &[Subject],
    (set, candidate): (&[Candidate], &Candidate),
    starts: &[Vec<f64>],
    all: &(dyn Fn(&[f64]) -> Vec<f64> + Sync),
) -> Option<Vec<Vec<f64>>> {
    const FROM: usize = 2;
    let ranges: Vec<_> = candidate.ranges().collect();
    let nearer = |subject: &Subject, from: &[f64]| {
        let there = bench.with(subject);
        let residuals = |at: &[f64]| there.residuals(set, &all(at));
        least_squares(&residuals, from, &ranges, 6 + 4 * ranges.len() as u32)
    };
    let found = starts.iter().take(FROM).filter_map(|start| nearer(&blurred[0], start));
    let mut at = found.min_by(|a, b| a.cost.total_cmp(&b.cost))?.at;
    for subject in &blurred[1..] {
        at = nearer(subject, &at)?.at;
    }
    let others = starts.iter().take(FROM).cloned();
    Some(std::iter::once(at).chain(others).collect())
}
