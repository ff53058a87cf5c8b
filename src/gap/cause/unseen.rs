//! What a trial costs on blocks of time that its parameters did not see.
//!
//! A law with a parameter more always costs less where it was fitted. Here the recordings are divided into folds, spans of time side
//! by side; for each the parameters are fitted anew to the others, without the blocks beside it, which its residuals still
//! remember, and the fold is predicted with them. What all folds cost, block by block, is what rivals are compared by.
//!
//! Source: M. Stone, Cross-validatory choice and assessment of statistical predictions, J. R. Stat. Soc. B 36 (1974); the purge
//! beside a fold: M. López de Prado, Advances in Financial Machine Learning, Wiley 2018, section 7.4.

use rayon::prelude::*;

use super::bench::{BLOCK_S, Bench, Trial};
use crate::gap::fit::{Slopes, least_squares_from};

/// Into how many folds each recording is divided.
const FOLDS: usize = 4;
/// Blocks beside a fold that are used for neither.
const PURGED: usize = 1;

/// How often a fold's fit looks at most. It begins where that of all folds ended, with its derivatives, and what a few steps leave to be gained
/// is far less than what folds differ by.
const STEPS: u32 = 6;

/// How the recordings are divided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Folds {
    /// Each fold a long span, so that as far as possible it is another kind of motion than the others.
    #[default]
    Long,
    /// Every fourth block is of one fold: what the machine does in one span alone is seen from that span's other blocks.
    Short,
}

/// What each block costs by parameters that did not see it; of a trial without parameters, what it costs. `None` where the answer is
/// wanted now.
pub fn unseen(bench: &Bench<'_>, trial: &Trial, folds: Folds) -> Option<Vec<f64>> {
    if trial.at.is_empty() {
        return Some(trial.blocks.clone());
    }
    let score = bench.subject.score(&*bench.predict(&trial.set, &trial.at)?);
    let places = score.places();
    // All folds begin where the trial stands.
    let slopes = Slopes::of(&|at: &[f64]| bench.residuals(&trial.set, at), &trial.at, &trial.ranges)?;
    let fold = |fold: usize| -> Option<Vec<f64>> {
        let weights: Vec<f64> =
            places.iter().map(|place| f64::from(u8::from(sees(bench, (folds, fold), *place)))).collect();
        let residuals = |at: &[f64]| {
            let mut residuals = bench.residuals(&trial.set, at)?;
            residuals.iter_mut().zip(&weights).for_each(|(residual, weight)| *residual *= weight);
            Some(residuals)
        };
        let fitted = least_squares_from(slopes.weighted(&weights), &residuals, &trial.at, &trial.ranges, STEPS);
        let there = bench.subject.score(&*bench.predict(&trial.set, &fitted.at)?);
        Some(bench.blocks(&there))
    };
    let costs: Vec<Vec<f64>> = (0..FOLDS).into_par_iter().map(fold).collect::<Option<_>>()?;
    let runs = bench.subject.runs.iter().map(|run| bench.blocks_of(run));
    let of_run = runs.flat_map(|blocks| (0..blocks).map(move |block| folds.of(block, blocks)));
    Some(of_run.enumerate().map(|(block, fold)| costs[fold][block]).collect())
}

impl Folds {
    /// The fold of a block among so many of its run.
    fn of(self, block: usize, blocks: usize) -> usize {
        match self {
            Folds::Long => (block * FOLDS / blocks.max(1)).min(FOLDS - 1),
            Folds::Short => block % FOLDS,
        }
    }
}

/// Whether the parameters of a fold are fitted to what lies at a place.
fn sees(bench: &Bench<'_>, (folds, fold): (Folds, usize), place: Option<(usize, f64)>) -> bool {
    let Some((run, at)) = place else { return true };
    let blocks = bench.blocks_of(&bench.subject.runs[run]);
    let block = ((at.max(0.0) / BLOCK_S) as usize).min(blocks - 1);
    let near = block.saturating_sub(PURGED)..=(block + PURGED).min(blocks - 1);
    near.map(|near| folds.of(near, blocks)).all(|near| near != fold)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folds_lie_side_by_side_and_hold_all() {
        let all = |folds: Folds| (0..10).map(|block| folds.of(block, 10)).collect::<Vec<usize>>();
        assert_eq!(all(Folds::Long), [0, 0, 0, 1, 1, 2, 2, 2, 3, 3]);
        assert_eq!(all(Folds::Short), [0, 1, 2, 3, 0, 1, 2, 3, 0, 1]);
        assert_eq!(Folds::Long.of(0, 1), 0);
    }
}
