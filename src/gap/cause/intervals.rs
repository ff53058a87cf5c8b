//! Where each parameter of the answer lies.

use rayon::prelude::*;

use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use crate::gap::SignalScore;
use crate::gap::fit::{Interval, Side, Slopes, least_squares_from, profile};

/// The rise of the deviance that an interval of 95 % ends at, were what correlated residuals exaggerate known: 3.84. It is estimated from
/// some dozen blocks of time, and of 63 parameters of clear effects of plants with equations of their own 56 lay within. A tenth further, 60 do.
const RISE: f64 = 1.1 * 1.1 * 3.84;
/// How far a parameter may be off for what a law leaves out of the machine, as a share of itself, in an interval of 95 %: what evaluation by
/// other means than statistics adds (JCGM 100:2008, 4.3). Of gross effects the noise alone leaves as little as some millionths. (Plants with
/// equations of their own, friction with bristles and two masses on a spring among them, gave springs 0.5 to 0.9 per mille off where it
/// left 0.3 to 0.6, and frictions and belts under load 2 to 14 per mille; of 21 parameters of gross effects of another practice set 17 lay within
/// 2 per mille, and the two furthest off, of frictions, 5.7 and 6.7.)
const OF_THE_LAW: f64 = 7e-3;

/// A parameter of an effect with its interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub value: f64,
    pub interval: [f64; 2],
    pub is_identifiable: bool,
}

/// The intervals of all parameters of `best`'s candidates, by profile likelihood. A time is known no better than within the
/// ticks in which the machine looks at its commands: the variance of a tick's half is added. `tick` in s, 0 for none. So is what a law leaves
/// out of the machine (`OF_THE_LAW`).
///
/// What the deviance has to rise by is that of 95 % (`RISE`) times what correlated residuals exaggerate, times the dispersion: what is left above
/// the floor is the law's own error, and leaves parameters as unsure as noise of its size would.
///
/// Of several parameters of a device that reports states alone walkers say beside that how far they may go together (`ends`): the deviance of
/// times that are known within cycles has steps, along which a profile is lost.
pub fn intervals(bench: &Bench<'_>, best: &Trial, ends: Option<&[[f64; 2]]>, tick: f64) -> Vec<Bounds> {
    let settled = bench.predict(&best.set, &best.at).map(|there| bench.subject.repeating_as(&there));
    let bench = &bench.with(settled.as_ref().unwrap_or(bench.subject));
    let residuals = |at: &[f64]| bench.residuals(&best.set, at);
    let budget = 12 + 6 * best.ranges.len() as u32;
    let slopes = Slopes::of(&residuals, &best.at, &best.ranges);
    let fitted = slopes.map(|slopes| least_squares_from(slopes, &residuals, &best.at, &best.ranges, budget));
    let fitted = fitted.filter(|fitted| fitted.cost <= best.cost).unwrap_or_else(|| best.fitted());
    let rise = RISE * best.inflation() * dispersion(bench, best).unwrap_or(1.0);
    let times: Vec<bool> = best.set.iter().flat_map(|candidate| &candidate.free).map(|free| free.is_time).collect();
    let of = |(parameter, is_time): (usize, &bool)| {
        let interval = profile(&residuals, &fitted, &best.ranges, parameter, rise);
        let value = best.at[parameter];
        let blur = if *is_time { 1.96 * 0.5 * tick } else { 0.0 };
        bounds(value, interval, blur.hypot(OF_THE_LAW * value))
    };
    let mut bounds: Vec<Bounds> = times.par_iter().enumerate().map(of).collect();
    for (bounds, [from, to]) in bounds.iter_mut().zip(ends.into_iter().flatten()) {
        bounds.interval = [bounds.interval[0].min(*from), bounds.interval[1].max(*to)];
    }
    bounds
}

/// Each candidate of a set with the bounds of its own parameters.
pub fn of_each<'a>(
    set: &'a [Candidate],
    mut bounds: &'a [Bounds],
) -> impl Iterator<Item = (&'a Candidate, &'a [Bounds])> {
    set.iter().map(move |candidate| {
        let own;
        (own, bounds) = bounds.split_at(candidate.free.len());
        (candidate, own)
    })
}

/// How many times more than its floor a device's levels cost under `best`, at least 1. Where they are weighed by what the law leaves
/// ([`crate::gap::Floor::misfit`]) that is in their weights already.
///
/// Source: quasi-likelihood (P. McCullagh, J. A. Nelder, Generalized Linear Models, Chapman & Hall 1989, section 9.2).
fn dispersion(bench: &Bench<'_>, best: &Trial) -> Option<f64> {
    let score = bench.subject.score(&*bench.predict(&best.set, &best.at)?);
    let is_plain = |signal: &&SignalScore| {
        let floor = &bench.subject.runs[signal.run].floors[signal.signal];
        signal.level.is_some() && floor.misfit == 0.0 && floor.reach == 0.0
    };
    let (cost, floor) = score
        .signals
        .iter()
        .filter(is_plain)
        .fold((0.0, 0.0), |(cost, floor), signal| (cost + signal.cost, floor + signal.floor_cost.0));
    Some(if floor > 0.0 { (cost / floor).max(1.0) } else { 1.0 })
}

fn bounds(value: f64, interval: Interval, blur: f64) -> Bounds {
    let widened = |side: Side| match side {
        Side::At(end) => value + (end - value).signum() * (end - value).hypot(blur),
        Side::Bound(end) => end,
    };
    let (from, to) = (widened(interval.from), widened(interval.to));
    Bounds { value, interval: [from.min(value), to.max(value)], is_identifiable: interval.is_identifiable() }
}
