//! How far a deviance stays low: walkers that spread over where it does.
//!
//! Along a narrow valley with steps, as of times that are known within cycles, slopes say nothing of where it leads, and a descent stays where
//! it begins. Walkers that step along the lines between one another need none: they follow any valley that they lie in.
//!
//! Source: J. Goodman, J. Weare, Ensemble samplers with affine invariance, Commun. Appl. Math. Comput. Sci. 5 (2010), with a = 2; moved in
//! halves side by side (D. Foreman-Mackey and others, emcee, PASP 125, 2013).

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::{Fitted, Range};

/// How many walkers there are for each parameter, beside two, and how many steps each goes.
const EACH: usize = 2;
const STEPS: u32 = 120;
/// The greatest stretch of a move.
const STRETCH: f64 = 2.0;

/// Between which values of each parameter places were found whose cost lies within `rise` of the least that was found: what a profile of the
/// likelihood encloses, seen from within. `cost` is `None` where the model cannot be computed. What is drawn follows from `seed`.
pub fn spread_of(
    cost: &(dyn Fn(&[f64]) -> Option<f64> + Sync),
    fitted: &Fitted,
    ranges: &[Range],
    rise: f64,
    seed: u64,
) -> Vec<[f64; 2]> {
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    // A rise of 3.84 is 95 % of a parameter; what a step may cost more by is in these units.
    let temperature = rise / 3.84;
    let mut walkers = vec![Walker { at: fitted.at.clone(), cost: fitted.cost }];
    while walkers.len() < EACH * ranges.len() + 2 {
        let place = |(j, range): (usize, &Range)| {
            let reach = (2.0 * temperature.sqrt() * fitted.spread(j)).min(0.3 * range.scale);
            range.clamp(fitted.at[j] + reach * (2.0 * dice.random::<f64>() - 1.0))
        };
        let at: Vec<f64> = ranges.iter().enumerate().map(place).collect();
        walkers.push(Walker { cost: cost(&at).unwrap_or(f64::INFINITY), at });
    }
    let mut seen = walkers.clone();
    for _ in 0..STEPS {
        for half in 0..2 {
            let (movers, others) = split(&walkers, half);
            let moves: Vec<Move> = movers.iter().map(|mover| Move::draw(mover, &others, &mut dice)).collect();
            let moved = moves.par_iter().map(|to| to.taken(cost, ranges, temperature));
            for (place, next) in moved.collect::<Vec<_>>().into_iter().enumerate() {
                if let Some(next) = next {
                    seen.push(next.clone());
                    walkers[2 * place + half] = next;
                }
            }
        }
    }
    let least = seen.iter().map(|walker| walker.cost).fold(f64::INFINITY, f64::min);
    let near: Vec<&Walker> = seen.iter().filter(|walker| walker.cost - least <= rise).collect();
    let ends = |j: usize| {
        near.iter().fold([fitted.at[j]; 2], |[from, to], walker| [from.min(walker.at[j]), to.max(walker.at[j])])
    };
    (0..ranges.len()).map(ends).collect()
}

#[derive(Clone, Debug)]
struct Walker {
    at: Vec<f64>,
    cost: f64,
}

/// The walkers of one half, and those of the other.
fn split(walkers: &[Walker], half: usize) -> (Vec<Walker>, Vec<Walker>) {
    let of = |wanted: usize| walkers.iter().skip(wanted).step_by(2).cloned().collect();
    (of(half), of(1 - half))
}

/// Where a walker may go, and how likely it does by chance alone.
struct Move {
    from: f64,
    to: Vec<f64>,
    stretch: f64,
    chance: f64,
}

impl Move {
    fn draw(mover: &Walker, others: &[Walker], dice: &mut impl Rng) -> Move {
        let other = &others[dice.random_range(0..others.len())];
        let root = 1.0 + (STRETCH - 1.0) * dice.random::<f64>();
        let stretch = root * root / STRETCH;
        let to = mover.at.iter().zip(&other.at).map(|(at, other)| other + stretch * (at - other)).collect();
        Move { from: mover.cost, to, stretch, chance: dice.random() }
    }

    /// The walker there, if it goes.
    fn taken(
        &self,
        cost: &(dyn Fn(&[f64]) -> Option<f64> + Sync),
        ranges: &[Range],
        temperature: f64,
    ) -> Option<Walker> {
        let is_inside = self.to.iter().zip(ranges).all(|(at, range)| (range.least..=range.greatest).contains(at));
        let there = if is_inside { cost(&self.to)? } else { return None };
        let dimensions = self.to.len() as f64;
        let likelihood = (dimensions - 1.0) * self.stretch.ln() - 0.5 * (there - self.from) / temperature;
        (self.chance.ln() < likelihood).then(|| Walker { at: self.to.clone(), cost: there })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Times that a slow last way takes, known to steps of 20 ms: they tell its length over its slowness, and each of the two hardly.
    #[test]
    fn walkers_go_along_a_valley_that_has_steps() {
        let lost = |at: &[f64]| at[0] * (1.0 / at[1] - 1.0) / 0.5;
        let shown = |at: &[f64], k: u32| ((lost(at) + 0.007 * f64::from(k)) / 0.02).floor();
        let truth = [0.02, 0.4];
        let cost = |at: &[f64]| {
            let off = |k: u32| (shown(at, k) - shown(&truth, k)).powi(2);
            Some((0..40).map(|k| 10.0 * off(k)).sum::<f64>())
        };
        let range = |greatest: f64, scale: f64| Range { least: 1e-3, greatest, scale };
        // Where a descent stuck, an end of the valley.
        let stuck = [0.03, 1.0 / (1.0 + 0.5 * lost(&truth) / 0.03)];
        let fitted = Fitted { at: stuck.to_vec(), cost: 0.0, curvature: vec![1e5, 0.0, 0.0, 1e4], evaluations: 0 };
        let found = spread_of(&cost, &fitted, &[range(0.25, 0.05), range(1.0, 0.4)], 3.84, 1);
        for ([from, to], truth) in found.iter().zip(truth) {
            assert!((*from..=*to).contains(&truth), "{found:?}");
        }
        // It stays in it: of the whole range of lengths most cannot be, as a way cannot be less slow than not at all.
        assert!(found[1][1] < 1.0 && found[0][0] > 1e-3, "{found:?}");
    }
}
