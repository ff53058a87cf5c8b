//! Where each parameter of the answer lies.

use rayon::prelude::*;

use super::bench::{Bench, Trial};
use crate::gap::fit::{Interval, Side, least_squares, profile};

/// The rise of the deviance that an interval of 95 % ends at.
const RISE: f64 = 3.84;

/// A parameter of an effect with its interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub value: f64,
    pub interval: [f64; 2],
    pub is_identifiable: bool,
}

/// The intervals of all parameters of `best`'s candidates, by profile likelihood. A time is known no better than within the
/// ticks in which the machine looks at its commands: the variance of a tick's half is added. `tick` in s, 0 for none.
pub fn intervals(bench: &Bench<'_>, best: &Trial, tick: f64) -> Vec<Bounds> {
    let residuals = |at: &[f64]| bench.residuals(&best.set, at);
    let fitted = least_squares(&residuals, &best.at, &best.ranges, 2 + 2 * best.ranges.len() as u32);
    let fitted = fitted.filter(|fitted| fitted.cost <= best.cost).unwrap_or_else(|| best.fitted());
    let rise = RISE * best.inflation();
    let times: Vec<bool> = best.set.iter().flat_map(|candidate| &candidate.free).map(|free| free.is_time).collect();
    let of = |(parameter, is_time): (usize, &bool)| {
        let interval = profile(&residuals, &fitted, &best.ranges, parameter, rise);
        let value = best.at[parameter];
        let blur = if *is_time { 1.96 * 0.5 * tick } else { 0.0 };
        bounds(value, interval, blur)
    };
    times.par_iter().enumerate().map(of).collect()
}

fn bounds(value: f64, interval: Interval, blur: f64) -> Bounds {
    let widened = |side: Side| match side {
        Side::At(end) => value + (end - value).signum() * (end - value).hypot(blur),
        Side::Bound(end) => end,
    };
    let (from, to) = (widened(interval.from), widened(interval.to));
    Bounds { value, interval: [from.min(value), to.max(value)], is_identifiable: interval.is_identifiable() }
}
