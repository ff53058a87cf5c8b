//! Blocks of time drawn anew: how sure a figure of one trace is.
//!
//! Source: the block bootstrap (H. R. Künsch, Annals of Statistics 17 (1989)), over blocks that do not overlap. What a model costs
//! is kept once for each block, so that a draw is a sum of sums.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Blocks drawn with replacement, many times over.
#[derive(Clone, Debug)]
pub struct Draws {
    draws: Vec<Vec<u32>>,
}

impl Draws {
    /// `count` draws of as many blocks as there are; they follow from `seed`.
    pub fn new(blocks: usize, count: usize, seed: u64) -> Draws {
        let mut dice = ChaCha8Rng::seed_from_u64(seed);
        let mut draw = || (0..blocks).map(|_| dice.random_range(0..blocks as u32)).collect();
        Draws { draws: (0..count).map(|_| draw()).collect() }
    }

    /// The sum of `blocks` (one number for each) in every draw.
    pub fn sums(&self, blocks: &[f64]) -> Vec<f64> {
        let sum = |draw: &Vec<u32>| draw.iter().map(|block| blocks[*block as usize]).sum();
        self.draws.iter().map(sum).collect()
    }

    /// What `statistic` makes of the sums of several models in every draw. Draws in which it is no number are left out.
    pub fn each(&self, models: &[&[f64]], statistic: impl Fn(&[f64]) -> f64) -> Vec<f64> {
        let sums: Vec<Vec<f64>> = models.iter().map(|blocks| self.sums(blocks)).collect();
        let of = |draw: usize| statistic(&sums.iter().map(|sums| sums[draw]).collect::<Vec<_>>());
        (0..self.draws.len()).map(of).filter(|value| !value.is_nan()).collect()
    }

    /// What `statistic` makes of the blocks drawn, by their numbers, in every draw.
    pub fn picks(&self, statistic: impl Fn(&[usize]) -> f64) -> Vec<f64> {
        let of = |draw: &Vec<u32>| statistic(&draw.iter().map(|block| *block as usize).collect::<Vec<_>>());
        self.draws.iter().map(of).collect()
    }
}

/// In which share of `count` draws each model is the best: costs less than every other, `handicap` of each added. The shares sum to 1;
/// they follow from `seed`.
///
/// Every block counts in every draw, some more and some less, by a number of the exponential distribution of mean one. What tells two models
/// apart often lies in a single block, which more than a third of the draws with replacement leave out.
///
/// Source: the Bayesian bootstrap (D. B. Rubin, Annals of Statistics 9 (1981)).
pub fn wins(models: &[&[f64]], handicaps: &[f64], count: usize, seed: u64) -> Vec<f64> {
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    let mut wins = vec![0.0; models.len()];
    let blocks = models.first().map_or(0, |blocks| blocks.len());
    let share = 1.0 / count as f64;
    for _ in 0..count {
        let counts: Vec<f64> = (0..blocks).map(|_| -(1.0 - dice.random::<f64>()).ln()).collect();
        let cost = |blocks: &[f64]| blocks.iter().zip(&counts).map(|(cost, counts)| cost * counts).sum::<f64>();
        let costs = models.iter().zip(handicaps).map(|(blocks, handicap)| cost(blocks) + handicap).enumerate();
        if let Some((winner, _)) = costs.min_by(|a, b| a.1.total_cmp(&b.1)) {
            wins[winner] += share;
        }
    }
    wins
}

/// What the blocks that stand out cost beyond what the others do: where a floor is thought too high by a few per cent, a gap of a few moments is
/// nothing of what all blocks cost above it.
pub fn standing_out(blocks: &[f64]) -> f64 {
    /// How many times what most blocks cost is still chance.
    const CHANCE: f64 = 2.0;
    let usual = CHANCE * quantile(blocks, 0.5);
    blocks.iter().map(|block| (block - usual).max(0.0)).sum()
}

/// The value below which `share` of `values` lie, between neighbours on a straight line; NaN of none.
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = sorted[place.floor() as usize];
    let above = sorted[place.ceil() as usize];
    below + (above - below) * place.fract()
}

/// From the least to the greatest; 0 of nothing.
pub fn span(values: &[f64]) -> f64 {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (greatest - least).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spread_of_a_mean_is_what_theory_says() {
        let mut dice = ChaCha8Rng::seed_from_u64(5);
        let blocks: Vec<f64> = (0..100).map(|_| dice.random::<f64>()).collect();
        let means: Vec<f64> = Draws::new(100, 2000, 1).sums(&blocks).iter().map(|sum| sum / 100.0).collect();
        // The deviation of a uniform number is 1/√12, that of the mean of 100 a tenth of it.
        let half = 0.5 * (quantile(&means, 0.975) - quantile(&means, 0.025));
        assert!((half - 1.96 * 0.02887).abs() < 0.008, "{half}");
    }

    #[test]
    fn who_is_better_in_every_block_always_wins() {
        let (good, bad) = (vec![1.0; 20], vec![1.5; 20]);
        assert!((wins(&[&bad, &good], &[0.0, 0.0], 300, 2)[1] - 1.0).abs() < 1e-9);
        // 10 is what the better gains, and no draw of twenty blocks counts them four times.
        assert!((wins(&[&bad, &good], &[0.0, 40.0], 300, 2)[0] - 1.0).abs() < 1e-9);
    }

    /// A signal that sticks is told from one that is slow by the one span in which it should have changed.
    #[test]
    fn what_one_block_tells_is_left_out_of_no_draw() {
        let good = vec![0.0; 30];
        let bad: Vec<f64> = (0..30).map(|block| if block == 7 { 60.0 } else { -0.01 }).collect();
        let wins = wins(&[&bad, &good], &[0.0, 0.0], 400, 2);
        assert!(wins[1] > 0.95, "{wins:?}");
    }

    #[test]
    fn who_is_better_by_chance_wins_by_half() {
        let mut dice = ChaCha8Rng::seed_from_u64(9);
        let mut noise = || (0..40).map(|_| dice.random::<f64>() - 0.5).collect::<Vec<f64>>();
        let (mut a, mut b) = (noise(), noise());
        let middle = |blocks: &mut Vec<f64>| {
            let mean = blocks.iter().sum::<f64>() / blocks.len() as f64;
            blocks.iter_mut().for_each(|cost| *cost -= mean);
        };
        middle(&mut a);
        middle(&mut b);
        let wins = wins(&[&a, &b], &[0.0, 0.0], 2000, 3);
        assert!((wins[0] - 0.5).abs() < 0.05, "{wins:?}");
    }

    #[test]
    fn only_what_others_do_not_cost_stands_out() {
        assert_eq!(standing_out(&[1.0, 1.0, 0.8, 11.0, 1.0, 1.9]), 9.0);
        assert_eq!(standing_out(&[1.0, 1.2, 0.8, 1.9, 1.0]), 0.0);
        assert_eq!(standing_out(&[]), 0.0);
    }

    #[test]
    fn quantiles_lie_between_neighbours() {
        assert_eq!(quantile(&[3.0, 1.0, 2.0], 0.5), 2.0);
        assert_eq!(quantile(&[0.0, 1.0], 0.25), 0.25);
        assert!(quantile(&[], 0.5).is_nan());
    }
}
