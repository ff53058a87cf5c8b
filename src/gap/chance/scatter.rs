//! A sensor that scatters: its noise, in the steps that it is reported in, beside that of all other levels of the machine.

use super::{Chance, Drawn, candidate};
use crate::gap::cause::{Bare, Bounds};
use crate::gap::statistics::quantile;
use crate::gap::{Predicted, Run, Study, Subject};
use crate::plant::EffectPlace;

/// How many times more steps than those of the others a noise must be.
const MUCH: f64 = 10.0;
/// A noise below this many steps is none. (A force is often read with 3 steps of noise where positions show none.)
const LEAST: f64 = 0.4;
/// How many times more than that of the same report of another device.
const MORE_THAN_ITS_LIKE: f64 = 3.0;
/// How many other levels there must be.
const OTHERS: usize = 3;
/// What moves by less than this share of its noise rests.
const STILL: f64 = 0.05;
/// How well a standard deviation of noise that remembers is known beside what its samples say, as a share.
const UNSURE: f64 = 0.06;

/// The level of the device at `place` that scatters far more than all others do, the device being looked at as `own` has it. `has_gap`:
/// whether it is off in other ways, too; what it is off by looks like noise where it does not rest long. Nothing is said of `drawn`: what was
/// taken out of those levels may have left a part.
pub(super) fn find(
    place: usize,
    study: &Study,
    own: (&Subject, &Bare),
    has_gap: bool,
    drawn: &[usize],
) -> Option<Chance> {
    let (subject, bare) = own;
    let looked_at = |at: usize| if at == place { own } else { (&study.subjects[at], &study.bare[at]) };
    let steps: Vec<(usize, usize, f64)> = study
        .subjects
        .iter()
        .enumerate()
        .flat_map(|(at, subject)| (0..subject.signals.len()).map(move |signal| (at, signal)))
        .filter_map(|(at, signal)| Some((at, signal, in_steps(looked_at(at), signal, has_gap && at == place)?)))
        .collect();
    let own = steps.iter().filter(|(at, signal, _)| *at == place && !drawn.contains(signal));
    let &(_, signal, noise) = own.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let others: Vec<f64> = steps.iter().filter(|of| (of.0, of.1) != (place, signal)).map(|of| of.2).collect();
    let property = |at: usize, signal: usize| study.subjects[at].signals[signal].property.as_str();
    let is_like = |of: &&(usize, usize, f64)| of.0 != place && property(of.0, of.1) == property(place, signal);
    let of_its_like = steps.iter().filter(is_like).map(|of| of.2).fold(0.0, f64::max);
    if others.len() < OTHERS || !is_much(noise, quantile(&others, 0.5), of_its_like) {
        return None;
    }
    let runs = || subject.runs.iter().filter(|run| run.tracks[signal].is_some());
    let usual = quantile(&others, 0.5);
    let variances = runs().map(|run| run.floors[signal].noise.powi(2) - (usual * run.floors[signal].step).powi(2));
    let sigma = (variances.sum::<f64>() / runs().count().max(1) as f64).max(0.0).sqrt();
    let count: f64 = runs()
        .filter_map(|run| Some(run.tracks[signal].as_ref()?.values.len() as f64 * run.floors[signal].share()))
        .sum();
    let off = 1.96 * (0.5 / count.max(1.0)).sqrt().hypot(UNSURE / 1.96);
    let bounds =
        vec![Bounds { value: sigma, interval: [sigma * (1.0 - off), sigma * (1.0 + off)], is_identifiable: true }];
    let component = Some(subject.signals[signal].property.clone());
    let candidate = candidate("noise", EffectPlace::Sensor, component, &["sigma"], &bounds)?;
    let misfit = count * (noise / usual.max(LEAST)).powi(2);
    let (subject, bare) = (subject.clone(), bare.clone());
    Some(Chance { candidate, bounds, subject, bare, misfit, drawn: Drawn::Noise, signals: vec![signal], beside: None })
}

/// Whether a noise is far more than the `usual` one of the machine, and than that of the same report of other devices, all in steps.
fn is_much(noise: f64, usual: f64, of_its_like: f64) -> bool {
    noise >= MUCH * usual.max(LEAST) && noise >= MORE_THAN_ITS_LIKE * of_its_like
}

/// The noise of a level in its steps: the least of its recordings; `None` of what is no level, or does not move, or, if `only_long`, never
/// rests long.
fn in_steps((subject, bare): (&Subject, &Bare), signal: usize, only_long: bool) -> Option<f64> {
    if subject.signals[signal].is_count {
        return None;
    }
    let of = |(run, predicted): (&Run, &Vec<Predicted>)| {
        let Predicted::Level(predicted) = &predicted[signal] else { return None };
        let track = run.tracks[signal].as_ref().filter(|track| track.values.windows(2).any(|two| two[0] != two[1]))?;
        let floor = run.floors[signal];
        // What a law gets wrong in motion looks like noise there, and not at rest.
        let noise = floor.noise.min(at_rest(&track.values, predicted, STILL * floor.noise.max(floor.step), only_long)?);
        (track.values.len() > 100 && floor.step > 0.0).then(|| noise / floor.step)
    };
    subject.runs.iter().zip(&bare.prediction.runs).filter_map(of).min_by(f64::total_cmp)
}

/// The noise of samples where the prediction moves by less than `still`, by the median of what one differs from the next: of each long rest
/// its later half, and of these the quietest tenth, as what swings out or settles there has done so in some; where no rest is long, and not
/// `only_long`, of all that rest. `None` where too few do.
fn at_rest(values: &[f64], predicted: &[f64], still: f64, only_long: bool) -> Option<f64> {
    const LONG: usize = 24;
    const ENOUGH: usize = 40;
    const QUIETEST: f64 = 0.1;
    const SWINGS: f64 = 0.5;
    // What drifts differs from one sample to the next by what it drifts; and what swings by nearly what it did from the one before, where noise of whatever
    // memory rather turns back.
    let noise = |differences: &[f64]| {
        let drifts = quantile(differences, 0.5);
        let off: Vec<f64> = differences.iter().map(|difference| difference - drifts).collect();
        let product = |lag: usize| off.iter().zip(&off[lag..]).map(|(a, b)| a * b).sum::<f64>();
        if product(1) > SWINGS * product(0) {
            return 0.0;
        }
        let off: Vec<f64> = off.iter().map(|off| off.abs()).collect();
        1.4826 * quantile(&off, 0.5) / std::f64::consts::SQRT_2
    };
    let rests: Vec<bool> = predicted.windows(2).map(|law| (law[1] - law[0]).abs() < still).collect();
    let differences: Vec<f64> = values.windows(2).map(|two| two[1] - two[0]).collect();
    let (mut long, mut all, mut first) = (Vec::new(), Vec::new(), 0);
    for rest in rests.chunk_by(|a, b| a == b) {
        let here = &differences[first..first + rest.len()];
        first += rest.len();
        if rest[0] {
            all.extend_from_slice(here);
            if here.len() >= LONG {
                long.push(noise(&here[here.len() / 2..]));
            }
        }
    }
    match long.is_empty() {
        true => (!only_long && all.len() >= ENOUGH).then(|| noise(&all)),
        false => Some(quantile(&long, QUIETEST)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hundred samples at rest, a hundred that move, over and over.
    fn law() -> Vec<f64> {
        let place = |k: u32| if (k / 100).is_multiple_of(2) { 0.0 } else { 50.0 * f64::from(k) };
        (0..600).map(place).collect()
    }

    /// Forces scatter by three steps where positions show next to nothing; one of two forces that scatters by thirty is a noise.
    #[test]
    fn a_force_is_held_against_forces() {
        assert!(!is_much(3.1, 0.3, 0.0) && !is_much(7.5, 0.5, 7.2) && !is_much(20.0, 0.5, 7.2));
        assert!(is_much(30.0, 0.5, 7.2) && is_much(6.0, 0.3, 0.0));
    }

    /// Differences of one unit with either sign: what moves says nothing.
    #[test]
    fn noise_is_what_scatters_at_rest() {
        let predicted = law();
        let values: Vec<f64> = predicted.iter().enumerate().map(|(k, law)| law + (k % 2) as f64).collect();
        let noise = at_rest(&values, &predicted, 0.1, false).expect("enough rests");
        assert!((noise - 1.4826 / std::f64::consts::SQRT_2).abs() < 1e-12);
        assert_eq!(at_rest(&values[101..200], &predicted[101..200], 0.1, false), None);
    }

    /// Rests of 20 samples: short ones say how a peer scatters, and not how what has a gap does.
    #[test]
    fn short_rests_say_nothing_of_what_has_a_gap() {
        let predicted: Vec<f64> = (0..600).map(|k| if (k / 20) % 2 == 0 { 0.0 } else { 50.0 * f64::from(k) }).collect();
        let values: Vec<f64> = predicted.iter().enumerate().map(|(k, law)| law + (k % 2) as f64).collect();
        assert!(at_rest(&values, &predicted, 0.1, false).is_some());
        assert_eq!(at_rest(&values, &predicted, 0.1, true), None);
    }

    /// What drifts by one unit from each sample to the next scatters by nothing, and by what it scatters beside that.
    #[test]
    fn what_drifts_is_no_noise() {
        let predicted = law();
        let drifts = |k: usize| k as f64 + (k % 2) as f64;
        let values =
            |of: &dyn Fn(usize) -> f64| predicted.iter().enumerate().map(|(k, law)| law + of(k)).collect::<Vec<_>>();
        assert_eq!(at_rest(&values(&|k| k as f64), &predicted, 0.1, false), Some(0.0));
        let noise = at_rest(&values(&drifts), &predicted, 0.1, false).expect("enough rests");
        assert!((noise - 1.4826 / std::f64::consts::SQRT_2).abs() < 1e-12, "{noise}");
    }

    /// A loop that swings for ever, and one that does so with noise on its report.
    #[test]
    fn what_swings_on_and_on_is_no_noise() {
        let predicted = law();
        let noise = |by: f64| {
            let swing = |k: usize| 0.6 * (0.05 * k as f64).sin() + by * (k % 2) as f64;
            let values: Vec<f64> = predicted.iter().enumerate().map(|(k, law)| law + swing(k)).collect();
            at_rest(&values, &predicted, 0.1, false).expect("enough rests")
        };
        assert!(noise(0.0) == 0.0 && noise(0.2) > 0.1, "{} {}", noise(0.0), noise(0.2));
    }

    /// Of what swings when it comes to rest, 15 samples a turn, little is left in the later half.
    #[test]
    fn what_swings_out_is_no_noise() {
        let predicted = law();
        let swing = |k: usize| (-((k % 100) as f64) / 8.0).exp() * (0.4 * k as f64).sin();
        let values: Vec<f64> = predicted.iter().enumerate().map(|(k, law)| law + swing(k)).collect();
        assert!(at_rest(&values, &predicted, 0.1, false).expect("enough rests") < 1e-3);
    }
}
