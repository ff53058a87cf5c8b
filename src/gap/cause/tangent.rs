//! Nominal parameters that follow along while another is looked for, as their slopes have it.
//!
//! Of a mass that is a per cent too large most is explained by the drive's gains that may be a per cent off too. With those held where
//! they fit best without it, it would explain next to nothing; fitted anew at every look, each look would cost as many replays as
//! there are parameters. So of what a look leaves, that part is taken away which the parameters' slopes can explain: what is left is
//! what a fit of all would leave, to first order.
//!
//! Source: G. H. Golub, V. Pereyra, The differentiation of pseudo-inverses and nonlinear least squares problems whose variables
//! separate, SIAM J. Numer. Anal. 10 (1973), with the linear part frozen.

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
        let basis = orthonormal(&slopes);
        let ranges = bench.ranges(set)[own..].to_vec();
        let mut beside = Beside { carried, ranges, slopes, basis, here: Vec::new() };
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
    basis: Vec<Vec<f64>>,
    /// What is left without the set's last effect.
    pub here: Vec<f64>,
}

impl Beside {
    /// What the nuisances cannot explain of residuals.
    pub fn left_of(&self, mut residuals: Vec<f64>) -> Vec<f64> {
        take_out(&mut residuals, &self.basis);
        residuals
    }

    /// Where the nuisances go, by their slopes, when this is left where they are held.
    pub fn follow(&self, residuals: &[f64]) -> Vec<f64> {
        let count = self.slopes.len();
        if count != self.carried.len() || self.slopes.iter().any(|slope| slope.len() != residuals.len()) {
            return self.carried.clone();
        }
        let normal = DMatrix::from_fn(count, count, |a, b| product(&self.slopes[a], &self.slopes[b]));
        let right = DVector::from_iterator(count, self.slopes.iter().map(|slope| -product(slope, residuals)));
        let Some(cholesky) = normal.cholesky() else { return self.carried.clone() };
        let moved = cholesky.solve(&right);
        let each = self.carried.iter().zip(moved.iter()).zip(&self.ranges);
        each.map(|((at, moved), range)| (at + moved).clamp(range.least, range.greatest)).collect()
    }
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
    use super::*;

    fn held() -> Beside {
        let slopes = vec![vec![1.0, 1.0, 0.0, 0.0], vec![1.0, -1.0, 1.0, 0.0]];
        let range = Range { least: -10.0, greatest: 10.0, scale: 1.0 };
        let basis = orthonormal(&slopes);
        Beside { carried: vec![2.0, 3.0], ranges: vec![range; 2], slopes, basis, here: Vec::new() }
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
}
