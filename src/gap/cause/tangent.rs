//! Nominal parameters that follow along while another is looked for, as their slopes have it.
//!
//! Of a mass that is a per cent too large most is explained by the drive's gains that may be a per cent off too. With those held where
//! they fit best without it, it would explain next to nothing; fitted anew at every look, each look would cost as many replays as
//! there are parameters. So of what a look leaves, that part is taken away which the parameters' slopes can explain within their
//! tolerances: what is left is what a fit of all would leave, to first order. (Without that bound a viscous friction explained nothing
//! beside the one that an axis declares, which stood at the end of its tolerance.)
//!
//! Sources: G. H. Golub, V. Pereyra, The differentiation of pseudo-inverses and nonlinear least squares problems whose variables
//! separate, SIAM J. Numer. Anal. 10 (1973), with the linear part frozen; for the bounds the primal active-set method, J. Nocedal,
//! S. J. Wright, Numerical Optimization, 2nd ed., Springer 2006, section 16.5.

use nalgebra::{DMatrix, DVector};

use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use crate::gap::Overrides;
use crate::gap::fit::Range;

/// Over how many of its standard deviations a parameter's slope is a difference.
const DIFFERENCE: f64 = 0.02;
/// A direction of which less than this share is left beside the others is none of its own.
pub const LEAST_OWN: f64 = 1e-6;

/// The nuisances about a trial: where they are, and how the residuals of levels change with them.
pub struct Tangent {
    names: Vec<&'static str>,
    at: Overrides,
    /// The residuals there, those of the nuisances' tolerances left out.
    here: Vec<f64>,
    slopes: Vec<Vec<f64>>,
}

impl Tangent {
    /// About `below`. Edges have no slopes: where a device reports nothing else, the nuisances stay where they are.
    pub fn new(bench: &Bench<'_>, below: &Trial) -> Option<Tangent> {
        let own = below.parameters();
        let names: Vec<&'static str> = bench.names_beside(&below.set).collect();
        let prediction = bench.predict(&below.set, &below.at)?;
        let is_level = bench.subject.score(&prediction).are_levels();
        let here = bench.subject.residuals(&prediction);
        let slope = |place: usize| -> Option<Vec<f64>> {
            let nuisance = bench.nuisances.iter().find(|nuisance| nuisance.name == names[place])?;
            let step = DIFFERENCE * nuisance.deviation;
            let mut there = below.at.clone();
            there[own + place] += step;
            let there = bench.subject.residuals(&*bench.predict(&below.set, &there)?);
            let pairs = there.iter().zip(&here).zip(&is_level);
            Some(pairs.map(|((there, here), is_level)| if *is_level { (there - here) / step } else { 0.0 }).collect())
        };
        let slopes: Option<Vec<Vec<f64>>> = match is_level.contains(&true) && !bench.is_rugged() {
            true => (0..names.len()).map(slope).collect(),
            false => Some(Vec::new()),
        };
        Some(Tangent { names, at: below.overrides.clone(), here, slopes: slopes? })
    }

    /// What takes the part that the nuisances beside `set` explain out of the residuals of `set`.
    pub fn beside(&self, bench: &Bench<'_>, set: &[Candidate]) -> Beside {
        let carried = bench.carried(set, &self.at);
        let beside: Vec<&'static str> = bench.names_beside(set).collect();
        let strains = bench.deviations_beside(set);
        let mut slopes: Vec<Vec<f64>> = Vec::with_capacity(beside.len());
        if !self.slopes.is_empty() {
            for (place, name) in beside.iter().enumerate() {
                let Some(known) = self.names.iter().position(|other| other == name) else { continue };
                let own =
                    strains.iter().enumerate().map(|(at, deviation)| if at == place { 1.0 / deviation } else { 0.0 });
                slopes.push(self.slopes[known].iter().copied().chain(own).collect());
            }
        }
        let mut here = self.here.clone();
        let own: usize = set.iter().map(|candidate| candidate.free.len()).sum();
        here.extend(bench.strain(set, &[vec![0.0; own], carried.clone()].concat()));
        let ranges = bench.ranges(set)[own..].to_vec();
        let mut beside = Beside::new(carried, ranges, slopes);
        beside.here = beside.left_of(here);
        beside
    }
}

/// The nuisances beside a set.
pub struct Beside {
    /// Where they are held, while the set's own parameters are looked for.
    pub carried: Vec<f64>,
    ranges: Vec<Range>,
    slopes: Vec<Vec<f64>>,
    /// The products of the slopes.
    products: DMatrix<f64>,
    /// What is left without the set's last effect.
    pub here: Vec<f64>,
}

impl Beside {
    fn new(carried: Vec<f64>, ranges: Vec<Range>, slopes: Vec<Vec<f64>>) -> Beside {
        let products = DMatrix::from_fn(slopes.len(), slopes.len(), |a, b| product(&slopes[a], &slopes[b]));
        Beside { carried, ranges, slopes, products, here: Vec::new() }
    }

    /// What the nuisances cannot explain of residuals within their tolerances.
    pub fn left_of(&self, mut residuals: Vec<f64>) -> Vec<f64> {
        for (moved, slope) in self.moved(&residuals).iter().zip(&self.slopes).filter(|(moved, _)| **moved != 0.0) {
            residuals.iter_mut().zip(slope).for_each(|(residual, slope)| *residual += moved * slope);
        }
        residuals
    }

    /// Where the nuisances go, by their slopes, when this is left where they are held.
    pub fn follow(&self, residuals: &[f64]) -> Vec<f64> {
        let each = self.carried.iter().zip(self.moved(residuals)).zip(&self.ranges);
        each.map(|((at, moved), range)| (at + moved).clamp(range.least, range.greatest)).collect()
    }

    /// How far the nuisances go from where they are held, within their tolerances, by their slopes: nowhere where residuals are not those that have them.
    fn moved(&self, residuals: &[f64]) -> Vec<f64> {
        let count = self.slopes.len();
        if count != self.carried.len() || self.slopes.iter().any(|slope| slope.len() != residuals.len()) {
            return vec![0.0; self.carried.len()];
        }
        let downhill = DVector::from_iterator(count, self.slopes.iter().map(|slope| -product(slope, residuals)));
        let bounds = self.carried.iter().zip(&self.ranges);
        let bounds: Vec<[f64; 2]> =
            bounds.map(|(at, range)| [(range.least - at).min(0.0), (range.greatest - at).max(0.0)]).collect();
        least_within(&self.products, &downhill, &bounds)
    }
}

/// Where ½ xᵀ·`products`·x − `downhill`ᵀ·x is least within `bounds`, which hold nought.
fn least_within(products: &DMatrix<f64>, downhill: &DVector<f64>, bounds: &[[f64; 2]]) -> Vec<f64> {
    let count = bounds.len();
    let mut at = vec![0.0; count];
    // Which end each is held at.
    let mut held: Vec<Option<usize>> = vec![None; count];
    // Each round holds one more or lets one go; a round trip of all is the most that a few that go together have been seen to take.
    for _ in 0..4 * count {
        let free: Vec<usize> = (0..count).filter(|place| held[*place].is_none()).collect();
        let rest = |place: usize| {
            let others = (0..count).filter(|other| held[*other].is_some());
            downhill[place] - others.map(|other| products[(place, other)] * at[other]).sum::<f64>()
        };
        let matrix = DMatrix::from_fn(free.len(), free.len(), |a, b| products[(free[a], free[b])]);
        let right = DVector::from_iterator(free.len(), free.iter().map(|place| rest(*place)));
        let Some(goal) = matrix.cholesky().map(|matrix| matrix.solve(&right)) else { break };
        // As far towards the goal as the first bound on the way.
        let mut first: (f64, Option<(usize, usize)>) = (1.0, None);
        for (place, goal) in free.iter().zip(goal.iter()) {
            let way = goal - at[*place];
            let end = usize::from(way > 0.0);
            let share = if way == 0.0 { 1.0 } else { (bounds[*place][end] - at[*place]) / way };
            if share < first.0 {
                first = (share.max(0.0), Some((*place, end)));
            }
        }
        free.iter().zip(goal.iter()).for_each(|(place, goal)| at[*place] += first.0 * (goal - at[*place]));
        if let (_, Some((place, end))) = first {
            (at[place], held[place]) = (bounds[place][end], Some(end));
            continue;
        }
        // What is held at a bound and would rather go back inside is let go.
        let slope =
            |place: usize| downhill[place] - (0..count).map(|other| products[(place, other)] * at[other]).sum::<f64>();
        let inwards = (0..count).filter_map(|place| {
            let pull = if held[place]? == 0 { slope(place) } else { -slope(place) };
            Some((place, pull / products[(place, place)].sqrt()))
        });
        let Some((place, pull)) = inwards.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if pull <= 1e-9 * downhill[place].abs() / products[(place, place)].sqrt() {
            break;
        }
        held[place] = None;
    }
    at
}

/// Directions across each other, each of length 1, that span the columns.
pub fn orthonormal(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
    for column in columns {
        let mut rest = column.clone();
        // Twice is enough (W. Kahan's rule for Gram and Schmidt).
        take_out(&mut rest, &basis);
        take_out(&mut rest, &basis);
        let (whole, own) = (product(column, column), product(&rest, &rest));
        if own > LEAST_OWN * whole && own > 0.0 {
            let length = own.sqrt();
            rest.iter_mut().for_each(|rest| *rest /= length);
            basis.push(rest);
        }
    }
    basis
}

/// Takes what goes along each of these directions of length 1 out of `values`.
pub fn take_out(values: &mut [f64], basis: &[Vec<f64>]) {
    let count = values.len();
    for direction in basis.iter().filter(|direction| direction.len() == count) {
        let along = product(direction, values);
        values.iter_mut().zip(direction).for_each(|(value, share)| *value -= along * share);
    }
}

/// The sum of the products.
pub fn product(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;

    use super::*;

    fn held() -> Beside {
        let slopes = vec![vec![1.0, 1.0, 0.0, 0.0], vec![1.0, -1.0, 1.0, 0.0]];
        let range = Range { least: -10.0, greatest: 10.0, scale: 1.0 };
        Beside::new(vec![2.0, 3.0], vec![range; 2], slopes)
    }

    #[test]
    fn what_the_slopes_explain_is_taken_out_and_nothing_else() {
        let beside = held();
        // 3 times the first slope, −2 times the second, and 5 across both.
        let left = beside.left_of(vec![1.0, 5.0, -2.0, 5.0]);
        assert!(left.iter().zip([0.0, 0.0, 0.0, 5.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{left:?}");
    }

    #[test]
    fn the_nuisances_go_where_that_is_explained() {
        let followed = held().follow(&[1.0, 5.0, -2.0, 5.0]);
        assert!((followed[0] + 1.0).abs() < 1e-12 && (followed[1] - 5.0).abs() < 1e-12, "{followed:?}");
    }

    /// The second would have to go to 13: it goes to 10, and the first as far as is best beside it.
    #[test]
    fn no_nuisance_leaves_its_tolerance() {
        let beside = held();
        let residuals = [-10.0, 10.0, -10.0, 5.0];
        let followed = beside.follow(&residuals);
        assert!((followed[0] - 2.0).abs() < 1e-12 && (followed[1] - 10.0).abs() < 1e-12, "{followed:?}");
        let left = beside.left_of(residuals.to_vec());
        assert!(left.iter().zip([-3.0, 3.0, -3.0, 5.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{left:?}");
    }

    proptest! {
        /// Within bounds nothing nearby is less, whatever the slopes.
        #[test]
        fn nothing_within_the_bounds_is_less(
            slopes in vec(vec(-1.0f64..1.0, 6), 4),
            residuals in vec(-3.0f64..3.0, 6),
            ends in vec((-2.0f64..=0.0, 0.0f64..2.0), 4),
        ) {
            let strained = |place: usize| (0..4).map(move |other| if place == other { 0.3 } else { 0.0 });
            let slopes: Vec<Vec<f64>> =
                slopes.into_iter().enumerate().map(|(place, slope)| slope.into_iter().chain(strained(place)).collect()).collect();
            let ranges = ends.iter().map(|(least, greatest)| Range { least: *least, greatest: *greatest, scale: 1.0 });
            let beside = Beside::new(vec![0.0; 4], ranges.collect(), slopes.clone());
            let residuals: Vec<f64> = residuals.into_iter().chain([0.0; 4]).collect();
            let cost = |at: &[f64]| {
                let each = (0..10).map(|row| residuals[row] + (0..4).map(|place| at[place] * slopes[place][row]).sum::<f64>());
                each.map(|left| left * left).sum::<f64>()
            };
            let at = beside.follow(&residuals);
            let least = cost(&at);
            let left = beside.left_of(residuals.clone());
            prop_assert!((product(&left, &left) - least).abs() < 1e-9);
            for (place, (low, high)) in ends.iter().enumerate() {
                prop_assert!((*low..=*high).contains(&at[place]));
                for step in [-1e-3, 1e-3] {
                    let mut there = at.clone();
                    there[place] = (there[place] + step).clamp(*low, *high);
                    prop_assert!(cost(&there) >= least - 1e-9, "{at:?} {place} {step}");
                }
            }
        }
    }
}
