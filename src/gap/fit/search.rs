//! The best of several starts.

use rayon::prelude::*;

use super::{Fitted, Range, Residuals, least_squares, simplex, sum_of_squares};

/// How long is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// From how many of the best starts the search goes downhill.
    pub starts: usize,
    /// How often the model is computed from each.
    pub budget: u32,
}

/// The least cost that is found from the best of `starts`: least squares, then of a few parameters a simplex about where it ended,
/// because least squares stick where a model has kinks or steps. `None` where the model cannot be computed at any start.
pub fn search(residuals: &Residuals<'_>, starts: &[Vec<f64>], ranges: &[Range], effort: Effort) -> Option<Fitted> {
    let mut scored: Vec<(f64, &Vec<f64>)> = starts
        .par_iter()
        .filter_map(|start| Some((sum_of_squares(&residuals(start)?), start)))
        .filter(|(cost, _)| cost.is_finite())
        .collect();
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    scored.truncate(effort.starts);
    let found = scored.par_iter().filter_map(|(_, start)| least_squares(residuals, start, ranges, effort.budget));
    let found: Vec<Fitted> = found.collect();
    let spent = starts.len() as u32 + found.iter().map(|found| found.evaluations).sum::<u32>();
    let best = found.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost))?;
    let found = nearer(residuals, best, ranges, effort.budget / 2)?;
    Some(Fitted { evaluations: spent + found.evaluations, ..found })
}

/// Among more parameters a simplex creeps for longer than any search lasts.
const MOST_OF_A_SIMPLEX: usize = 4;

/// What a simplex about where least squares ended finds, and least squares from there; its evaluations are those that were spent on it.
fn nearer(residuals: &Residuals<'_>, found: Fitted, ranges: &[Range], budget: u32) -> Option<Fitted> {
    if ranges.len() > MOST_OF_A_SIMPLEX {
        return Some(Fitted { evaluations: 0, ..found });
    }
    let near: Vec<Range> = (0..ranges.len())
        .map(|j| Range { scale: (4.0 * found.spread(j)).min(0.3 * ranges[j].scale), ..ranges[j] })
        .collect();
    let mut cost = |at: &[f64]| residuals(at).map(|residuals| sum_of_squares(&residuals));
    let crawled = simplex(&mut cost, &found.at, &near, 0.1, budget);
    // What the simplex found beyond doubt was on another slope: downhill from there once more.
    if crawled.cost < found.cost - 1.0 {
        let again = least_squares(residuals, &crawled.at, ranges, budget)?;
        return Some(Fitted { evaluations: crawled.evaluations + again.evaluations, ..again });
    }
    Some(Fitted { evaluations: crawled.evaluations, ..found })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn false_minima_are_left_by_other_starts() {
        // The phase of a sine: a minimum in every turn of the frequency.
        let model = |f: f64| (0..200).map(move |i| 5.0 * (f * f64::from(i) * 0.05).sin());
        let truth: Vec<f64> = model(7.3).collect();
        let residuals = |at: &[f64]| Some(model(at[0]).zip(&truth).map(|(a, b)| a - b).collect());
        let ranges = [Range { least: 0.0, greatest: 20.0, scale: 0.3 }];
        let starts: Vec<Vec<f64>> = (1..80).map(|i| vec![0.25 * f64::from(i)]).collect();
        let found = search(&residuals, &starts, &ranges, Effort { starts: 2, budget: 60 }).unwrap();
        assert!((found.at[0] - 7.3).abs() < 1e-3, "{found:?}");
    }

    #[test]
    fn a_limit_that_starts_where_it_does_nothing_is_found_from_below() {
        let model = |limit: f64| (0..100).map(move |i| 10.0 * (f64::from(i) * 0.1).sin().min(limit));
        let truth: Vec<f64> = model(0.93).collect();
        let residuals = |at: &[f64]| Some(model(at[0]).zip(&truth).map(|(a, b)| a - b).collect());
        let ranges = [Range { least: 1e-3, greatest: 1.0, scale: 0.1 }];
        let starts: Vec<Vec<f64>> = [1.0, 0.99, 0.9, 0.5].map(|share| vec![share]).to_vec();
        let found = search(&residuals, &starts, &ranges, Effort { starts: 2, budget: 60 }).unwrap();
        assert!((found.at[0] - 0.93).abs() < 1e-4, "{found:?}");
    }
}
