//! How far a deviance stays low, and where it is least: walkers that spread over where it is low.
//!
//! Along a narrow valley with steps, as of times that are known within cycles, slopes say nothing of where it leads, and a descent stays where
//! it begins. Walkers that step as far and as they are apart from one another need none: they follow any valley that they lie in.
//!
//! Source: C. J. F. ter Braak, A Markov Chain Monte Carlo version of the genetic algorithm Differential Evolution, Statistics and Computing
//! 16 (2006), with its γ = 2.38/√(2d), and 1 in every tenth step; warm at first (S. Kirkpatrick and others, Science 220, 1983).

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::{Fitted, Range, simplex};

/// How many walkers there are for each parameter, and at least; how many steps each goes.
const EACH: usize = 3;
const LEAST: usize = 12;
const STEPS: u32 = 160;
/// How much warmer than in the end it is at first, and in which share of the steps it cools down.
const WARM: f64 = 16.0;
const COOLING: f64 = 0.4;
/// How far apart walkers begin: of a parameter's scale; of one that is far above 0, as a factor's logarithm.
const APART: f64 = 0.5;
/// No walker goes to the very end: from the furthest one it is gone on by such a share of how far that was, the others following, so often and
/// each time with so many trials.
const FURTHER: f64 = 0.2;
const TIMES: u32 = 10;
const TRIALS: u32 = 40;
/// By what a step grows that led on, and shrinks that did not.
const GROWS: [f64; 2] = [1.5, 0.4];
/// Of the walkers that are near the best, that share which is furthest says how the others follow there.
const THERE: f64 = 0.3;
/// And so many at least.
const FEWEST: usize = 8;
/// What is added to each step, of a parameter's scale, so that walkers that lie in a line can leave it.
const ASIDE: f64 = 1e-4;

/// What walkers found.
#[derive(Clone, Debug)]
pub struct Spread {
    /// Where the cost is least of all that was found.
    pub best: Fitted,
    /// Between which values of each wanted parameter places were found whose cost lies within the rise of that: what a profile of the likelihood
    /// encloses, seen from within.
    pub ends: Vec<[f64; 2]>,
}

/// Lets walkers spread from about `fitted`. `cost` is `None` where the model cannot be computed; `rise` is what a deviance rises by at the end
/// of an interval of 95 %: 3.84, or more where residuals exaggerate; `wanted` of the first parameters are asked for. What is drawn follows from `seed`.
pub fn spread(
    cost: &(dyn Fn(&[f64]) -> Option<f64> + Sync),
    fitted: &Fitted,
    ranges: &[Range],
    wanted: usize,
    (rise, seed): (f64, u64),
) -> Spread {
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    let cost = |at: &[f64]| cost(at).filter(|cost| cost.is_finite());
    let count = LEAST.max(EACH * ranges.len());
    let starts: Vec<Vec<f64>> = (1..count).map(|_| about(fitted, ranges, &mut dice)).collect();
    let mut walkers = vec![Walker { at: fitted.at.clone(), cost: fitted.cost }];
    walkers.extend(
        starts.into_par_iter().map(|at| Walker { cost: cost(&at).unwrap_or(f64::INFINITY), at }).collect::<Vec<_>>(),
    );
    let mut seen: Vec<Walker> = walkers.clone();
    for step in 0..STEPS {
        let cooled = f64::from(step) / (COOLING * f64::from(STEPS));
        let warmth = rise / 3.84 * WARM.powf((1.0 - cooled).max(0.0));
        let moves: Vec<Move> = (0..walkers.len()).map(|of| Move::draw(&walkers, of, ranges, step, &mut dice)).collect();
        let moved: Vec<Option<Walker>> = moves.par_iter().map(|to| to.taken(&cost, ranges, warmth)).collect();
        for (walker, next) in walkers.iter_mut().zip(moved) {
            if let Some(next) = next {
                seen.push(next.clone());
                *walker = next;
            }
        }
    }
    let best = seen.iter().min_by(|a, b| a.cost.total_cmp(&b.cost)).unwrap_or(&walkers[0]).clone();
    let near: Vec<&Walker> = seen.iter().filter(|walker| walker.cost - best.cost <= rise).collect();
    let ends = |j: usize| {
        [-1.0, 1.0].map(|side| {
            let furthest = near.iter().max_by(|a, b| (side * a.at[j]).total_cmp(&(side * b.at[j])));
            furthest.map_or(best.at[j], |furthest| further(&cost, &near, (furthest, &best), (j, side), ranges, rise))
        })
    };
    let ends = (0..wanted).into_par_iter().map(ends).collect();
    let evaluations = count as u32 * (1 + STEPS);
    Spread { best: Fitted { at: best.at, cost: best.cost, curvature: Vec::new(), evaluations }, ends }
}

/// How far a parameter may go on from the furthest of the walkers `near` the best one, the others following as they lie about it.
fn further(
    cost: &dyn Fn(&[f64]) -> Option<f64>,
    near: &[&Walker],
    (furthest, best): (&Walker, &Walker),
    (j, side): (usize, f64),
    ranges: &[Range],
    rise: f64,
) -> f64 {
    // A valley bends: how the others follow is asked of those that are there.
    let mut near = near.to_vec();
    near.sort_by(|a, b| (side * b.at[j]).total_cmp(&(side * a.at[j])));
    near.truncate(((THERE * near.len() as f64) as usize).max(FEWEST));
    let count = near.len() as f64;
    let mean = |k: usize| near.iter().map(|walker| walker.at[k]).sum::<f64>() / count;
    let means: Vec<f64> = (0..ranges.len()).map(mean).collect();
    let product = |k: usize, l: usize| {
        near.iter().map(|walker| (walker.at[k] - means[k]) * (walker.at[l] - means[l])).sum::<f64>() / count
    };
    let scales: Vec<f64> = (0..ranges.len()).map(|k| product(k, k).sqrt().max(1e-6 * ranges[k].scale)).collect();
    let follow: Vec<f64> = (0..ranges.len()).map(|k| product(j, k) / product(j, j).max(f64::MIN_POSITIVE)).collect();
    let mut at = furthest.at.clone();
    let mut step = FURTHER * (at[j] - best.at[j]).abs();
    for _ in 0..TIMES {
        let there = ranges[j].clamp(at[j] + side * step);
        let moved = there - at[j];
        // At its bound it goes no further.
        if moved == 0.0 {
            break;
        }
        let others: Vec<usize> = (0..ranges.len()).filter(|k| *k != j).collect();
        let start: Vec<f64> = others.iter().map(|k| ranges[*k].clamp(at[*k] + follow[*k] * moved)).collect();
        let near: Vec<Range> = others.iter().map(|k| Range { scale: scales[*k], ..ranges[*k] }).collect();
        let whole = |others: &[f64]| {
            let mut whole = others.to_vec();
            whole.insert(j, there);
            whole
        };
        let found = simplex(&mut |others: &[f64]| cost(&whole(others)), &start, &near, 0.3, TRIALS);
        if found.cost - best.cost <= rise {
            (at, step) = (whole(&found.at), GROWS[0] * step);
        } else {
            step *= GROWS[1];
        }
    }
    at[j]
}

/// A place to begin at.
fn about(fitted: &Fitted, ranges: &[Range], dice: &mut impl Rng) -> Vec<f64> {
    let place = |(range, at): (&Range, &f64)| {
        let off = APART * (2.0 * dice.random::<f64>() - 1.0);
        let is_factor = range.least >= 0.0 && *at > 0.0 && range.scale >= 0.3 * at;
        range.clamp(if is_factor { at * (2.0 * off).exp() } else { at + off * range.scale })
    };
    ranges.iter().zip(&fitted.at).map(place).collect()
}

#[derive(Clone, Debug)]
struct Walker {
    at: Vec<f64>,
    cost: f64,
}

/// Where a walker may go, and how likely it does by chance alone.
struct Move {
    from: f64,
    to: Vec<f64>,
    chance: f64,
}

impl Move {
    fn draw(walkers: &[Walker], of: usize, ranges: &[Range], step: u32, dice: &mut impl Rng) -> Move {
        let mut other = || loop {
            let other = dice.random_range(0..walkers.len());
            if other != of {
                return other;
            }
        };
        let (one, two) = (other(), other());
        let far = if step % 10 == 9 { 1.0 } else { 2.38 / (2.0 * ranges.len() as f64).sqrt() };
        let place = |(j, range): (usize, &Range)| {
            let aside = ASIDE * range.scale * (2.0 * dice.random::<f64>() - 1.0);
            walkers[of].at[j] + far * (walkers[one].at[j] - walkers[two].at[j]) + aside
        };
        let to = ranges.iter().enumerate().map(place).collect();
        Move { from: walkers[of].cost, to, chance: dice.random() }
    }

    /// The walker there, if it goes.
    fn taken(&self, cost: &(dyn Fn(&[f64]) -> Option<f64> + Sync), ranges: &[Range], warmth: f64) -> Option<Walker> {
        let is_inside = self.to.iter().zip(ranges).all(|(at, range)| (range.least..=range.greatest).contains(at));
        let there = if is_inside { cost(&self.to)? } else { return None };
        (self.chance.ln() < -0.5 * (there - self.from) / warmth).then(|| Walker { at: self.to.clone(), cost: there })
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
        let truth = [0.06, 0.4];
        let cost = |at: &[f64]| {
            let off = |k: u32| (shown(at, k) - shown(&truth, k)).powi(2);
            Some((0..40).map(|k| 10.0 * off(k)).sum::<f64>())
        };
        let range = |greatest: f64, scale: f64| Range { least: 1e-3, greatest, scale };
        // Where a descent stuck, an end of the valley.
        let stuck = [0.03, 1.0 / (1.0 + 0.5 * lost(&truth) / 0.03)];
        let fitted = Fitted { at: stuck.to_vec(), cost: 0.0, curvature: vec![1e5, 0.0, 0.0, 1e4], evaluations: 0 };
        let found = spread(&cost, &fitted, &[range(0.25, 0.05), range(1.0, 0.4)], 2, (3.84, 1)).ends;
        for ([from, to], truth) in found.iter().zip(truth) {
            assert!((*from..=*to).contains(&truth), "{found:?}");
        }
        // It stays in it: of the whole range of lengths most cannot be, as a way cannot be less slow than not at all.
        assert!(found[1][1] < 1.0 && found[0][0] > 1e-3, "{found:?}");
    }
}
