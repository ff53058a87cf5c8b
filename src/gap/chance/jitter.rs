//! Whether the delays of commands are those of a link that jitters: whether they scatter as nothing else that delays commands lets them. A dead time has one
//! delay for all, a switch one for on and one for off, and what delays the longer the further a way is, the longer the rest before it was, or the longer
//! the machine has run goes with that.

use super::late::{Delay, ENOUGH, MAY_BE, SURE_S, Told};
use crate::gap::cause::Bounds;
use crate::gap::cost::normal;
use crate::gap::statistics::rank_correlation;

/// How far delays must scatter about their mean, as a share of it, and in how many: of the half normal distribution it is 0.76.
const SCATTERED: f64 = 0.25;
const IN_A_CLASS: usize = 5;
/// How far rank correlations of delays may be from none, in standard deviations: 0.1 % each.
const UNRELATED: f64 = 3.3;

/// The deviation of the normal distribution whose absolute values the delays of commands are, s, with its interval of 95 %; `None` where they are few,
/// no longer than a task of `task_s` makes them, or go with something.
pub(super) fn jitter(telling: &[(Told, Delay)], task_s: f64) -> Option<Bounds> {
    let n = telling.len() as f64;
    if telling.len() < ENOUGH {
        return None;
    }
    let within: Vec<[f64; 2]> = telling.iter().map(|(_, delay)| delay.within()).collect();
    let bounds = likeliest(&within);
    if bounds.value <= task_s {
        return None;
    }
    let rising = |told: &Told| told.rise > 0.0;
    let is_scattered = |rises: bool| {
        let class: Vec<f64> =
            telling.iter().filter(|(told, _)| rising(told) == rises).map(|(_, delay)| delay.by).collect();
        let mean = class.iter().sum::<f64>() / class.len().max(1) as f64;
        let variance = class.iter().map(|by| (by - mean).powi(2)).sum::<f64>() / class.len().max(1) as f64;
        class.len() < IN_A_CLASS || variance.sqrt() > SCATTERED * mean
    };
    let delays: Vec<f64> = telling.iter().map(|(_, delay)| delay.by).collect();
    let goes_with = |of: &dyn Fn(&Told) -> f64| {
        let others: Vec<f64> = telling.iter().map(|(told, _)| of(told)).collect();
        rank_correlation(&delays, &others).abs() * (n - 1.0).sqrt() > UNRELATED
    };
    let is_bound = goes_with(&|told| told.rise.abs())
        || goes_with(&|told| f64::from(u8::from(rising(told))))
        || goes_with(&|told| told.stood)
        || goes_with(&|told| told.at);
    if is_bound || !is_scattered(true) || !is_scattered(false) || !is_drawn(&within, bounds.value) {
        return None;
    }
    Some(bounds)
}

/// The deviation of the normal distribution among whose absolute values intervals are the likeliest, s, with what is as likely but for what a
/// chance of 5 % makes.
///
/// Source: the likelihood of observations that are known to within intervals, and its ratio (J. F. Lawless, Statistical Models and Methods for Lifetime
/// Data, Wiley 2003, section 2.2).
fn likeliest(within: &[[f64; 2]]) -> Bounds {
    const UNLIKELY: f64 = 1e-12;
    let below = |at: f64, sigma: f64| 2.0 * normal(at / sigma) - 1.0;
    let deviance = |log: f64| -> f64 {
        let of = |[from, to]: &[f64; 2]| below(*to, log.exp()) - below(*from, log.exp());
        within.iter().map(|within| -2.0 * of(within).max(UNLIKELY).ln()).sum()
    };
    let [mut low, mut high] = [SURE_S, 1.0].map(f64::ln);
    let ends = [low, high];
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        (low, high) = if deviance(a) < deviance(b) { (low, b) } else { (a, high) };
    }
    let best = 0.5 * (low + high);
    let least = deviance(best);
    let end = |mut far: f64| {
        let mut near = best;
        for _ in 0..60 {
            let middle = 0.5 * (near + far);
            if deviance(middle) < least + MAY_BE { near = middle } else { far = middle }
        }
        near.exp()
    };
    Bounds { value: best.exp(), interval: ends.map(end), is_identifiable: true }
}

/// Whether delays may be the absolute values of a normal distribution of `sigma`, and not one delay for some commands and none for others. One
/// that is known to within an interval is anywhere in it, the next elsewhere.
///
/// Source: the test of Kolmogorov and Smirnov with its limit at 1 % error for many (N. V. Smirnov, Ann. Math. Statist. 19, 1948); that the
/// deviation is found of the same delays makes it err less often.
fn is_drawn(within: &[[f64; 2]], sigma: f64) -> bool {
    const LIMIT: f64 = 1.63;
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let below = |at: f64| 2.0 * normal(at / sigma) - 1.0;
    let share = |(k, [from, to]): (usize, &[f64; 2])| {
        let there = (GOLDEN * k as f64).fract();
        below(*from) + there * (below(*to) - below(*from))
    };
    let mut shares: Vec<f64> = within.iter().enumerate().map(share).collect();
    shares.sort_by(f64::total_cmp);
    let n = shares.len() as f64;
    let off = |(k, share): (usize, &f64)| (share - k as f64 / n).abs().max((share - (k + 1) as f64 / n).abs());
    shares.iter().enumerate().map(off).fold(0.0, f64::max) * n.sqrt() <= LIMIT
}

/// The quantiles of the half normal distribution, 40 in no order.
#[cfg(test)]
pub(super) fn scattered(k: usize) -> f64 {
    let share = (((k * 17) % 40) as f64 + 0.5) / 40.0;
    let (mut low, mut high) = (0.0, 8.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let below = 2.0 * normal(middle) - 1.0;
        (low, high) = if below < share { (middle, high) } else { (low, middle) };
    }
    low
}

/// Forty changes to and fro, each as late as `by` says.
#[cfg(test)]
pub(super) fn delayed(by: impl Fn(usize, &Told) -> f64) -> Vec<(Told, Delay)> {
    let of = |k: usize| {
        let rise = if k.is_multiple_of(2) { 1.0 } else { -1.0 } * (1.0 + ((k * 5) % 7) as f64);
        let stood = 0.5 + 0.1 * ((k * 11) % 13) as f64;
        let told = Told { run: 0, index: k, port: 0, at: k as f64, rise, stood };
        (told, Delay { by: by(k, &told), width: 0.0, tells: true })
    };
    (0..40).map(of).collect()
}

/// Delays of a deviation of 10 ms.
#[cfg(test)]
pub(super) fn drawn(k: usize) -> f64 {
    0.01 * scattered(k)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a machine whose task takes up to 2 ms.
    fn jitter(delays: &[(Told, Delay)]) -> Option<Bounds> {
        super::jitter(delays, 2e-3)
    }

    #[test]
    fn delays_that_scatter_tell_their_deviation() {
        let Bounds { value, interval: [least, most], .. } = jitter(&delayed(|k, _| drawn(k))).expect("jitter");
        assert!((value / 0.01 - 1.0).abs() < 0.05, "{value}");
        // The deviance of 40 absolute values of a normal distribution whose deviation is r times theirs.
        let rise = |r: f64| 40.0 * (2.0 * r.ln() + 1.0 / (r * r) - 1.0);
        assert!(
            (rise(least / value) - 3.84).abs() < 0.05 && (rise(most / value) - 3.84).abs() < 0.05,
            "{least} {most}"
        );
    }

    /// A flag that is looked at every 20 ms.
    #[test]
    fn delays_that_are_known_to_within_a_cycle_tell_their_deviation() {
        let seen = |k: usize| 0.02 * ((drawn(k) + 5e-4 * (k % 40) as f64) / 0.02).floor();
        let mut delays = delayed(|k, _| (seen(k) + 0.01 - 5e-4 * (k % 40) as f64).max(0.0));
        delays.iter_mut().for_each(|(_, delay)| delay.width = 0.02);
        let Bounds { value, interval: [least, most], .. } = jitter(&delays).expect("jitter");
        assert!((value / 0.01 - 1.0).abs() < 0.3 && least < 0.01 && 0.01 < most, "{value} {least} {most}");
    }

    #[test]
    fn delays_that_go_with_something_are_no_jitter() {
        assert!(jitter(&delayed(|k, _| 0.01 + 1e-2 * drawn(k))).is_none(), "a dead time");
        assert!(jitter(&delayed(|k, told| if told.rise > 0.0 { 0.02 } else { 1e-2 * drawn(k) })).is_none(), "a switch");
        assert!(jitter(&delayed(|_, told| 0.01 * told.rise.abs())).is_none(), "a slow drive");
        assert!(jitter(&delayed(|_, told| 0.01 * (told.stood - 0.5))).is_none(), "what sticks after a rest");
        assert!(jitter(&delayed(|_, told| 1e-3 * told.at)).is_none(), "what warms up");
        let some = |k: usize, _: &Told| if (k * 17) % 40 < 12 { 0.09 } else { 1e-4 };
        assert!(jitter(&delayed(some)).is_none(), "a delay of some commands");
    }

    #[test]
    fn delays_of_a_known_task_are_no_jitter_and_longer_ones_are() {
        let short = delayed(|k, _| 0.05 * drawn(k));
        assert!(super::jitter(&short, 2e-3).is_none() && super::jitter(&short, 1e-3).is_none());
        let Bounds { value, .. } = super::jitter(&short, 2.5e-4).expect("jitter");
        assert!((value / 5e-4 - 1.0).abs() < 0.1, "{value}");
    }
}
