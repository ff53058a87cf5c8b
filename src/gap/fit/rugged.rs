//! The least cost of a model whose deviance is rugged: where slopes say nothing.

use super::{Fitted, Range, Residuals, evolve, sum_of_squares};

/// The first cloud's width in the logarithm of a parameter.
const WIDTH: f64 = 0.3;
/// The second's: about what the first found.
const NARROW: f64 = 0.1;
/// The least of a parameter whose least value is 0, as a share of its scale: below, it changes nothing.
const LEAST: f64 = 1e-4;

/// The least cost that two clouds of trials find from the best of `starts`, in the logarithms of parameters that cannot be
/// negative: the first as wide as the ranges allow, the second about what it found. Never worse than any of `starts`, so that a
/// model that begins where one that it contains has ended is never worse than that. `None` where the model cannot be computed
/// at any start.
pub fn rugged(residuals: &Residuals<'_>, starts: &[Vec<f64>], ranges: &[Range], budget: u32) -> Option<Fitted> {
    let cost = |at: &[f64]| residuals(at).map(|residuals| sum_of_squares(&residuals)).filter(|cost| cost.is_finite());
    let scored = starts.iter().filter_map(|start| Some((cost(start)?, start)));
    let (least, start) = scored.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let mut best = Fitted { at: start.clone(), cost: least, curvature: Vec::new(), evaluations: starts.len() as u32 };
    if ranges.is_empty() {
        return Some(best);
    }
    for (seed, (width, share)) in [(WIDTH, 3), (NARROW, 1)].into_iter().enumerate() {
        let scales: Vec<Scale> = ranges.iter().zip(&best.at).map(|(range, value)| Scale::of(range, *value)).collect();
        let outside = |from: &[f64]| from.iter().zip(&scales).map(|(x, scale)| scale.outside(*x)).collect::<Vec<_>>();
        let inside: Vec<f64> = best.at.iter().zip(&scales).map(|(x, scale)| scale.inside(*x)).collect();
        let spans: Vec<Range> = scales.iter().map(|scale| scale.range(width)).collect();
        let found = evolve(&|at| cost(&outside(at)), &inside, &spans, seed as u64 + 1, share * budget / 4);
        best.evaluations += found.evaluations;
        if found.cost < best.cost {
            (best.at, best.cost) = (outside(&found.at), found.cost);
        }
    }
    Some(best)
}

/// How a parameter is searched for.
enum Scale {
    /// By its logarithm, down to `least`.
    Logarithm { least: f64, range: Range },
    /// As it is.
    Plain(Range),
}

impl Scale {
    fn of(range: &Range, value: f64) -> Scale {
        let least = range.least.max(LEAST * range.scale);
        if range.least >= 0.0 && value > 0.0 && range.greatest > least {
            Scale::Logarithm { least, range: *range }
        } else {
            Scale::Plain(*range)
        }
    }

    fn inside(&self, value: f64) -> f64 {
        match self {
            Scale::Logarithm { least, range } => value.clamp(*least, range.greatest).ln(),
            Scale::Plain(_) => value,
        }
    }

    fn outside(&self, value: f64) -> f64 {
        match self {
            Scale::Logarithm { least, range } => value.exp().clamp(*least, range.greatest),
            Scale::Plain(range) => range.clamp(value),
        }
    }

    fn range(&self, width: f64) -> Range {
        match self {
            Scale::Logarithm { least, range } => {
                Range { least: least.ln(), greatest: range.greatest.ln(), scale: width }
            }
            Scale::Plain(range) => Range { scale: width / WIDTH * range.scale, ..*range },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A valley with ripples on which slopes lead nowhere; its parameters lie four orders of magnitude apart.
    fn rippled(at: &[f64]) -> Option<Vec<f64>> {
        let (a, b) = ((at[0] / 0.002).ln(), (at[1] / 30.0).ln());
        Some(vec![3.0 * a, 3.0 * b, 0.4 * (1.0 - (25.0 * (a + b)).cos())])
    }

    const RANGES: [Range; 2] =
        [Range { least: 0.0, greatest: 1.0, scale: 0.01 }, Range { least: 0.0, greatest: 1e3, scale: 10.0 }];

    #[test]
    fn ripples_and_scales_do_not_hold_it_up() {
        let found = rugged(&rippled, &[vec![0.004, 12.0]], &RANGES, 400).unwrap();
        assert!((found.at[0] / 0.002 - 1.0).abs() < 0.02 && (found.at[1] / 30.0 - 1.0).abs() < 0.02, "{found:?}");
    }

    #[test]
    fn it_is_never_worse_than_where_it_begins() {
        let starts = [vec![0.5, 1.0], vec![0.002, 30.0]];
        let found = rugged(&rippled, &starts, &RANGES, 20).unwrap();
        assert_eq!((found.at, found.cost), (starts[1].clone(), 0.0));
        assert_eq!(rugged(&|_: &[f64]| None, &starts, &RANGES, 20), None);
    }
}
