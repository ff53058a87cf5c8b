//! The least value of a function without derivatives: a simplex that crawls downhill.
//!
//! Source: J. A. Nelder, R. Mead, A simplex method for function minimization, Computer Journal 7 (1965); points outside the
//! bounds are moved onto them.

use super::{Fitted, Range};

/// Crawls from `start` with first steps of the ranges' scales, computing the cost at most `budget` times, until a simplex has
/// equal costs within `enough`. A cost that is no number counts as infinite.
pub fn simplex(
    cost: &mut dyn FnMut(&[f64]) -> Option<f64>,
    start: &[f64],
    ranges: &[Range],
    enough: f64,
    budget: u32,
) -> Fitted {
    let mut simplex = Simplex { cost, ranges, corners: Vec::with_capacity(start.len() + 1), evaluations: 0 };
    simplex.set_up(start);
    while simplex.evaluations < budget && simplex.height() > enough {
        simplex.crawl();
    }
    let (cost, at) = simplex.corners.swap_remove(0);
    Fitted { at, cost, curvature: Vec::new(), evaluations: simplex.evaluations }
}

struct Simplex<'a> {
    cost: &'a mut dyn FnMut(&[f64]) -> Option<f64>,
    ranges: &'a [Range],
    /// The best first.
    corners: Vec<(f64, Vec<f64>)>,
    evaluations: u32,
}

impl Simplex<'_> {
    fn corner(&mut self, at: &[f64]) -> (f64, Vec<f64>) {
        let at: Vec<f64> = at.iter().zip(self.ranges).map(|(value, range)| range.clamp(*value)).collect();
        self.evaluations += 1;
        let cost = (self.cost)(&at).filter(|cost| !cost.is_nan()).unwrap_or(f64::INFINITY);
        (cost, at)
    }

    fn set_up(&mut self, start: &[f64]) {
        let first = self.corner(start);
        let origin = first.1.clone();
        self.corners.push(first);
        for (parameter, range) in self.ranges.iter().enumerate() {
            let mut at = origin.clone();
            let step = if at[parameter] + range.scale <= range.greatest { range.scale } else { -range.scale };
            at[parameter] += step;
            let corner = self.corner(&at);
            self.corners.push(corner);
        }
        self.sort();
    }

    fn sort(&mut self) {
        self.corners.sort_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// How much worse the worst corner is than the best.
    fn height(&self) -> f64 {
        match (self.corners.first(), self.corners.last()) {
            (Some(best), Some(worst)) if best.0.is_finite() => worst.0 - best.0,
            _ => f64::INFINITY,
        }
    }

    /// On the line from the worst corner through the middle of the others: 0 is the middle, −1 the corner.
    fn on_line(&mut self, way: f64) -> (f64, Vec<f64>) {
        let others = self.corners.len() - 1;
        let worst = &self.corners[others].1;
        let at: Vec<f64> = (0..worst.len())
            .map(|j| {
                let middle = self.corners[..others].iter().map(|corner| corner.1[j]).sum::<f64>() / others as f64;
                middle + way * (middle - worst[j])
            })
            .collect();
        self.corner(&at)
    }

    fn crawl(&mut self) {
        let last = self.corners.len() - 1;
        let (best, worst) = (self.corners[0].0, self.corners[last].0);
        let second_worst = self.corners[last.saturating_sub(1)].0;
        let reflected = self.on_line(1.0);
        let next = if reflected.0 < best {
            let far = self.on_line(2.0);
            Some(if far.0 < reflected.0 { far } else { reflected })
        } else if reflected.0 < second_worst {
            Some(reflected)
        } else {
            let is_outside = reflected.0 < worst;
            let near = self.on_line(if is_outside { 0.5 } else { -0.5 });
            Some(near).filter(|near| near.0 < worst.min(reflected.0))
        };
        match next {
            Some(corner) => self.corners[last] = corner,
            None => self.shrink(),
        }
        self.sort();
    }

    fn shrink(&mut self) {
        let best = self.corners[0].1.clone();
        for place in 1..self.corners.len() {
            let at: Vec<f64> = self.corners[place].1.iter().zip(&best).map(|(a, b)| 0.5 * (a + b)).collect();
            self.corners[place] = self.corner(&at);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kink_is_no_obstacle() {
        let ranges = [Range { least: -10.0, greatest: 10.0, scale: 1.0 }; 2];
        let mut cost = |at: &[f64]| Some((at[0] - 1.0).abs() + 3.0 * (at[1] + 2.0).abs());
        let found = simplex(&mut cost, &[5.0, 5.0], &ranges, 1e-9, 1000);
        assert!((found.at[0] - 1.0).abs() < 1e-6 && (found.at[1] + 2.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn it_stays_within_its_bounds_and_its_budget() {
        let ranges = [Range { least: 0.0, greatest: 1.0, scale: 0.3 }];
        let mut asked = 0;
        let mut cost = |at: &[f64]| {
            asked += 1;
            Some(at[0])
        };
        let found = simplex(&mut cost, &[0.9], &ranges, 0.0, 40);
        assert_eq!(found.at, [0.0]);
        assert!(asked <= 43 && asked == found.evaluations, "{asked}");
    }
}
