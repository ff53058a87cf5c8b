//! In which regimes of its motion a device's gap lies.

use super::prediction::{Predicted, Prediction};
use super::report::Regime;
use super::score::{Score, SignalScore};
use super::subject::Subject;
use crate::signal_map::Kind;

/// Of the highest speed, below which a device holds.
const HOLDING: f64 = 0.01;
/// Of the highest speed, by how much it must change from a sample to the next to be starting or stopping.
const CHANGING: f64 = 0.002;
/// How many samples about it are looked at to see a reversal.
const ABOUT: usize = 5;

/// What a device is doing at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Doing {
    Holding,
    Starting,
    Cruising,
    Stopping,
    Reversing,
}

impl Doing {
    const ALL: [Doing; 5] = [Doing::Holding, Doing::Starting, Doing::Cruising, Doing::Stopping, Doing::Reversing];

    const fn name(self) -> &'static str {
        match self {
            Doing::Holding => "holding",
            Doing::Starting => "starting",
            Doing::Cruising => "cruising",
            Doing::Stopping => "stopping",
            Doing::Reversing => "reversing",
        }
    }
}

/// The shares of the squared difference of the level that is worst off, by what the model's motion is doing then; the largest
/// first, those below a hundredth left out. Empty of a device without levels.
pub(super) fn regimes(subject: &Subject, nominal: &Prediction, score: &Score) -> Vec<Regime> {
    let levels = score.signals.iter().filter(|signal| signal.level.is_some());
    let worst = levels.max_by(|a, b| (a.rms / a.floor).total_cmp(&(b.rms / b.floor)));
    let Some(worst) = worst else { return Vec::new() };
    let Predicted::Level(values) = &nominal.runs[worst.run][worst.signal] else { return Vec::new() };
    let speeds = speeds(subject, worst, values);
    let mut shares = [0.0; Doing::ALL.len()];
    let differences = worst.level.iter().flat_map(|level| &level.difference);
    for (difference, doing) in differences.zip(doings(&speeds)) {
        shares[doing as usize] += difference * difference;
    }
    let total: f64 = shares.iter().sum();
    if total <= 0.0 {
        return Vec::new();
    }
    let named = Doing::ALL.into_iter().zip(shares);
    let mut regimes: Vec<Regime> =
        named.map(|(doing, share)| Regime { when: doing.name().to_owned(), share: share / total }).collect();
    regimes.retain(|regime| regime.share >= 0.01);
    regimes.sort_by(|a, b| b.share.total_cmp(&a.share));
    regimes
}

/// The speed at each sample: the level itself where it is one, else its slope.
fn speeds(subject: &Subject, score: &SignalScore, values: &[f64]) -> Vec<f64> {
    let info = &subject.signals[score.signal];
    debug_assert_eq!(info.kind, Kind::Level);
    if info.unit.ends_with("/s") {
        return values.to_vec();
    }
    let last = values.len().saturating_sub(1);
    (0..values.len()).map(|k| values[(k + 1).min(last)] - values[k.saturating_sub(1)]).collect()
}

fn doings(speeds: &[f64]) -> impl Iterator<Item = Doing> {
    let highest = speeds.iter().map(|speed| speed.abs()).fold(0.0, f64::max);
    let last = speeds.len().saturating_sub(1);
    (0..speeds.len()).map(move |k| {
        let (before, after) = (speeds[k.saturating_sub(ABOUT)], speeds[(k + ABOUT).min(last)]);
        let moves = |speed: f64| speed.abs() > HOLDING * highest;
        let change = speeds[(k + 1).min(last)].abs() - speeds[k.saturating_sub(1)].abs();
        match change / (2.0 * highest.max(f64::MIN_POSITIVE)) {
            _ if moves(before) && moves(after) && before * after < 0.0 => Doing::Reversing,
            change if change > CHANGING => Doing::Starting,
            change if change < -CHANGING => Doing::Stopping,
            _ if moves(speeds[k]) => Doing::Cruising,
            _ => Doing::Holding,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_falls_into_its_regimes() {
        // Up in 20 samples, on for 20, down through 0 in 40, on, and to a stop.
        let ramp = |k: i32| match k {
            0..20 => f64::from(k) / 20.0,
            20..40 => 1.0,
            40..80 => 1.0 - f64::from(k - 40) / 20.0,
            80..100 => -1.0,
            100..120 => -1.0 + f64::from(k - 100) / 20.0,
            _ => 0.0,
        };
        let speeds: Vec<f64> = (0..160).map(ramp).collect();
        let doings: Vec<Doing> = doings(&speeds).collect();
        let check = |at: usize, doing: Doing| assert_eq!(doings[at], doing, "at {at}");
        check(10, Doing::Starting);
        check(30, Doing::Cruising);
        check(50, Doing::Stopping);
        check(60, Doing::Reversing);
        check(70, Doing::Starting);
        check(90, Doing::Cruising);
        check(110, Doing::Stopping);
        check(150, Doing::Holding);
    }
}
