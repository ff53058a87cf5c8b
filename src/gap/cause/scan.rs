//! Errors that repeat along the way: with which period they repeat, found by a scan over spatial frequencies.
//!
//! Over the period the deviance has a false minimum in every turn, so that no search downhill finds it. With the period given,
//! amplitude and phase are linear: the error is a·cos + b·sin + c of the position, and the scan is a periodogram over position
//! in place of time (N. R. Lomb, Astrophysics and Space Science 39, 1976).

use std::f64::consts::TAU;

use super::starts::Clues;
use crate::gap::Predicted;
use crate::gap::statistics::span;
use crate::plant::ParameterValue;
use crate::value::Quantity;

/// A wave along the way: amplitude·sin(2π·x/period + phase).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    pub amplitude: f64,
    pub period: f64,
    pub phase: f64,
    /// Which share of the squared error it takes away.
    pub share: f64,
}

/// The shortest period looked for, as a share of the way.
const SHORTEST: f64 = 1.0 / 200.0;
/// The same of what turns, rad: a motor goes hundreds of turns, and most waves repeat with each.
const SHORTEST_TURN_RAD: f64 = 2.0;
/// How much of the error a wave must take away to be worth a start.
const LEAST_SHARE: f64 = 0.02;
/// How many samples are looked at, at most.
const MOST_SAMPLES: usize = 4000;

/// The best waves that the error of a signal has over position, at most `count`: of the position itself, or with `friction` of
/// the force, either way of motion taken as the same.
pub fn periods(clues: &Clues<'_>, friction: bool, count: usize) -> Vec<Wave> {
    let turned = if friction { None } else { error_along_turns(clues) };
    let is_turn = turned.is_some();
    let (way, error) = turned.unwrap_or_else(|| error_along(clues, friction));
    let travel = span(&way);
    if way.len() < 20 || travel <= 0.0 {
        return Vec::new();
    }
    let step = 1.0 / (8.0 * travel);
    let shortest = if is_turn { (SHORTEST * travel).min(SHORTEST_TURN_RAD) } else { SHORTEST * travel };
    let last = (1.0 / shortest / step) as usize;
    let waves: Vec<Wave> = (4..last).filter_map(|k| wave(&way, &error, k as f64 * step)).collect();
    let mut peaks: Vec<Wave> = waves
        .windows(3)
        .filter(|of| of[1].share >= of[0].share && of[1].share > of[2].share && of[1].share > LEAST_SHARE)
        .map(|of| of[1])
        .collect();
    peaks.sort_by(|a, b| b.share.total_cmp(&a.share));
    peaks.truncate(count);
    peaks
}

/// Angles of a motor and their errors, both by its encoder, rad, sample by sample; `None` of what counts nothing.
fn error_along_turns(clues: &Clues<'_>) -> Option<(Vec<f64>, Vec<f64>)> {
    let subject = clues.subject;
    // Of a belt behind a gear the way is the belt's.
    if subject.kind.name != "kinetwin.EncoderMotor" {
        return None;
    }
    let encoder = subject.signals.iter().position(|info| info.is_count)?;
    let counts = match subject.parameters.0.get("countsPerRevolution").map(|parameter| &parameter.value) {
        Some(ParameterValue::Integer(counts)) => *counts as f64,
        _ => return None,
    };
    let (mut way, mut error) = (Vec::new(), Vec::new());
    for (run, predicted) in subject.runs.iter().zip(&clues.nominal.runs) {
        let (Some(track), Predicted::Level(predicted)) = (&run.tracks[encoder], &predicted[encoder]) else { continue };
        way.extend(predicted.iter().map(|count| TAU / counts * count));
        // A count stands for all of its width.
        error.extend(track.values.iter().zip(predicted).map(|(count, law)| TAU / counts * (count + 0.5 - law)));
    }
    let every = way.len().div_ceil(MOST_SAMPLES).max(1);
    let some = |all: Vec<f64>| all.into_iter().step_by(every).collect();
    Some((some(way), some(error)))
}

/// Positions and errors, sample by sample.
fn error_along(clues: &Clues<'_>, friction: bool) -> (Vec<f64>, Vec<f64>) {
    let subject = clues.subject;
    let is_a = |signal: usize, wanted: [Quantity; 2]| {
        let info = &subject.signals[signal];
        let quantities = info.descriptor.quantities;
        let is_meant = clues.component.is_none_or(|component| info.property.ends_with(component));
        is_meant && !info.is_count && quantities.iter().any(|quantity| wanted.contains(quantity))
    };
    let find = |wanted| (0..subject.signals.len()).find(|signal| is_a(*signal, wanted));
    let position = find([Quantity::Length, Quantity::Angle]);
    let measured = if friction { find([Quantity::Force, Quantity::Torque]) } else { position };
    let (Some(position), Some(measured)) = (position, measured) else { return Default::default() };
    let (mut way, mut error) = (Vec::new(), Vec::new());
    for (run, predicted) in subject.runs.iter().zip(&clues.nominal.runs) {
        let (Predicted::Level(x), Predicted::Level(y)) = (&predicted[position], &predicted[measured]) else { continue };
        let Some(track) = &run.tracks[measured] else { continue };
        for k in 1..x.len().min(y.len()).min(track.values.len()) {
            let direction = if friction { x[k] - x[k - 1] } else { 1.0 };
            if direction.abs() > 1e-9 {
                way.push(x[k]);
                error.push((track.values[k] - y[k]) * direction.signum());
            }
        }
    }
    let every = way.len().div_ceil(MOST_SAMPLES).max(1);
    (way.into_iter().step_by(every).collect(), error.into_iter().step_by(every).collect())
}

/// The best wave of one frequency (1/m or 1/rad).
fn wave(way: &[f64], error: &[f64], frequency: f64) -> Option<Wave> {
    let mut normal = nalgebra::Matrix3::<f64>::zeros();
    let mut right = nalgebra::Vector3::<f64>::zeros();
    let mut squares = 0.0;
    for (x, e) in way.iter().zip(error) {
        let (sin, cos) = (TAU * frequency * x).sin_cos();
        let row = nalgebra::Vector3::new(sin, cos, 1.0);
        normal += row * row.transpose();
        right += row * *e;
        squares += e * e;
    }
    let solution = normal.cholesky()?.solve(&right);
    let mean = error.iter().sum::<f64>() / error.len() as f64;
    let about_mean = squares - mean * mean * error.len() as f64;
    let left = squares - solution.dot(&right);
    let share = if about_mean > 0.0 { 1.0 - left / about_mean } else { 0.0 };
    let [sin, cos, _]: [f64; 3] = solution.into();
    Some(Wave { amplitude: sin.hypot(cos), period: frequency.recip(), phase: cos.atan2(sin), share })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Overrides;
    use crate::gap::cause::scales::Scales;
    use crate::gap::recorded_tests::{RUBBING_AXIS, study};

    #[test]
    fn a_wave_of_known_period_is_found_at_its_frequency() {
        let way: Vec<f64> = (0..2000).map(|i| 0.5 * (f64::from(i) * 0.013).sin() + 0.001 * f64::from(i % 7)).collect();
        let error: Vec<f64> = way.iter().map(|x| 0.007 * (TAU * x / 0.04 + 0.4).sin() + 0.002).collect();
        let found = wave(&way, &error, 25.0).unwrap();
        assert!(found.share > 0.999 && (found.amplitude - 0.007).abs() < 1e-6 && (found.phase - 0.4).abs() < 1e-6);
        assert!(wave(&way, &error, 22.0).unwrap().share < 0.2);
    }

    /// A wheel on a motor's shaft, a little slower than the shaft is and 0.4 rad out, by the motor's encoder.
    #[test]
    fn a_wave_that_repeats_with_a_motors_turns_is_found_by_its_encoder() {
        let study = study(RUBBING_AXIS);
        let mut motor = study.subject("Motor").expect("it moves").clone();
        let nominal = motor.predict(&[], &Overrides::none()).expect("a prediction");
        let encoder = motor.signals.iter().position(|info| info.is_count).expect("an encoder");
        let Predicted::Level(counts) = &nominal.runs[0][encoder] else { panic!("counts") };
        let rad = TAU / 4096.0;
        let read = |count: &f64| (count + 0.4 / rad * (TAU * count * rad / 6.4 + 0.5).sin()).floor();
        motor.runs[0].tracks[encoder].as_mut().expect("a track").values = counts.iter().map(read).collect();
        let score = motor.score(&nominal);
        let scales = Scales::of(&motor, &nominal, None);
        let found =
            periods(&Clues { subject: &motor, nominal: &nominal, score: &score, scales, component: None }, false, 3);
        let best = found.first().expect("a wave");
        assert!((best.period / 6.4 - 1.0).abs() < 2e-3 && (best.amplitude - 0.4).abs() < 0.05, "{best:?}");
    }
}
