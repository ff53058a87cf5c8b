//! How far the instants of reports are off, one by one, once a machine's task and the age of its reports are known.
//!
//! A report that comes τ sooner or later shows a level that moves with v by v·τ off, beside noise and rounding; on stretches of one
//! speed second differences leave nothing else,
//!
//! ```text
//! Var(x(k+1) − 2·x(k) + x(k−1)) = 6·(v²·τ² + q²/12) + σ²·(6 − 8·r + 2·r²)
//! ```
//!
//! for rounding to steps of q and noise σ that remembers r from one sample to the next. A gap is slow beside that on such stretches, and where it
//! is not the quieter ones of the machine's levels say what τ is.

use super::cause::Bare;
use super::floor::Floor;
use super::prediction::Predicted;
use super::statistics::quantile;
use super::subject::Subject;

/// As near as instants are taken to be known at all, s.
pub(super) const LEAST_S: f64 = 10e-6;
/// As far as they are looked for, s: what is off by more has another reason.
pub(super) const MOST_S: f64 = 50e-6;
/// How many levels have to say it, and on how many samples each.
const LEVELS: usize = 2;
const ENOUGH: usize = 60;
/// From which share of a level's highest speed on it says anything, and how much its speed may change from one sample to the next.
const FAST: f64 = 0.5;
const STEADY: f64 = 0.02;
/// Which of the levels, the quietest first.
const QUIETER: f64 = 0.25;

/// What the levels of all devices say of a run.
pub(super) fn find(subjects: &[Subject], bare: &[Bare], run: usize) -> f64 {
    let each = subjects.iter().zip(bare).flat_map(|(subject, bare)| {
        let levels = (0..subject.signals.len()).filter(|signal| !subject.signals[*signal].is_count);
        levels.filter_map(|signal| of_level(subject, bare, (run, signal))).collect::<Vec<f64>>()
    });
    let each: Vec<f64> = each.collect();
    if each.len() < LEVELS { LEAST_S } else { quantile(&each, QUIETER).clamp(LEAST_S, MOST_S) }
}

/// What one level says, s; `None` where it hardly runs at one speed.
fn of_level(subject: &Subject, bare: &Bare, (run, signal): (usize, usize)) -> Option<f64> {
    let Predicted::Level(predicted) = &bare.prediction.runs[run][signal] else { return None };
    let track = subject.runs[run].tracks[signal].as_ref()?;
    let floor = subject.runs[run].floors[signal];
    let (recorded, predicted) = track.evident(predicted);
    scatter(&recorded, &predicted, track.grid.cycle, floor)
}

/// What a level recorded every `cycle` says, s.
fn scatter(recorded: &[f64], predicted: &[f64], cycle: f64, floor: Floor) -> Option<f64> {
    if recorded.len() < ENOUGH || cycle <= 0.0 {
        return None;
    }
    let speeds: Vec<f64> = predicted.windows(2).map(|two| (two[1] - two[0]) / cycle).collect();
    let fast = FAST * speeds.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
    let steady: Vec<usize> = (1..predicted.len() - 1)
        .filter(|k| {
            let (before, after) = (speeds[k - 1], speeds[*k]);
            before.abs() >= fast && fast > 0.0 && (after - before).abs() <= STEADY * before.abs()
        })
        .collect();
    if steady.len() < ENOUGH {
        return None;
    }
    let left = |k: usize| recorded[k] - predicted[k];
    let bends: Vec<f64> = steady.iter().map(|k| (left(k + 1) - 2.0 * left(*k) + left(k - 1)).abs()).collect();
    let scatter = (1.4826 * quantile(&bends, 0.5)).powi(2);
    let noise = floor.noise.powi(2) * (6.0 - 8.0 * floor.memory + 2.0 * floor.memory.powi(2));
    let speed = steady.iter().map(|k| speeds[*k].powi(2)).sum::<f64>() / steady.len() as f64;
    let beyond = (scatter - noise - 0.5 * floor.step.powi(2)) / 6.0;
    // What noise and rounding hide of it is no evidence that it is small.
    let hidden = (noise / 6.0 + floor.step.powi(2) / 12.0) / speed;
    (hidden.sqrt() < MOST_S).then(|| (beyond.max(0.0) / speed).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 400 samples of 10 ms at 0.5 m/s, every other one `off` too soon, on steps of 1 µm.
    fn level(off: f64) -> (Vec<f64>, Vec<f64>) {
        let law = |at: f64| 0.5 * at;
        let instants = (0..400).map(|k| 0.01 * f64::from(k));
        let recorded = instants.clone().enumerate().map(|(k, at)| {
            let at = if k % 2 == 0 { at } else { at - off };
            (law(at) / 1e-6).round() * 1e-6
        });
        (recorded.collect(), instants.map(law).collect())
    }

    #[test]
    fn instants_that_are_off_show_in_what_moves() {
        let floor = Floor { step: 1e-6, ..Floor::default() };
        // Second differences of what is every other time off by v·τ are 2·v·τ: of a normal one of as large a median, τ = 1.4826·2·v·τ/√6/v.
        let expected = 20e-6 * 1.4826 * 2.0 / 6.0_f64.sqrt();
        let (recorded, predicted) = level(20e-6);
        let found = scatter(&recorded, &predicted, 0.01, floor).expect("it moves");
        assert!((found - expected).abs() < 0.05 * expected, "{found} {expected}");
        let (recorded, predicted) = level(0.0);
        assert!(scatter(&recorded, &predicted, 0.01, floor).expect("it moves") < LEAST_S);
    }

    #[test]
    fn what_stands_still_says_nothing() {
        let floor = Floor { step: 1e-6, ..Floor::default() };
        assert_eq!(scatter(&[1.0; 400], &[1.0; 400], 0.01, floor), None);
    }
}
