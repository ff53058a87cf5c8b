//! How much an effect shows: measured, not intended.
//!
//! The machine runs twice under the same commands, with the effect and without, heard in the same way and without noise. The
//! distance is that of the two runs in units of what noise and rounding leave unsure, summed over all reports:
//!
//! ```text
//! D² = Σ (y₁ − y₀)²/(σ²·φ + q²/12),    φ = (1 + r)/(1 − r)
//! ```
//!
//! with the noise's correlation r from one report to the next; of a flag, every report in which it differs counts 12 (a time
//! error of one cycle, in units of the cycle's own scatter). A test of 1 % error finds D = 4.2 in 95 of 100 cases.
//!
//! Rounding is as unsure as q²/12 once. Where noise does not make it anew at each report, a level that stays where it is is rounded as it
//! was, a thousand times over: all reports of such a stay count as one.
//!
//! What a machine built otherwise within its tolerances would show as well tells nobody of an effect: of the differences d of the
//! levels that part is taken away which its measures explain, by their own runs J and what is known of them beforehand:
//! D² = d·d − dᵀJ(1 + JᵀJ)⁻¹Jᵀd. So is what an age of the reports would show that the other devices leave possible. Counts are compared as
//! they are before they are rounded, as levels are: what rounding leaves unsure is in their unit. Of flags, which have no slope, those reports
//! count in which the run differs from one of the machine with a measure at a bound of its tolerance, whichever of these runs comes nearest.

use std::rc::Rc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use serde::{Deserialize, Serialize};

use crate::plant::{Kind, Signal};
use crate::record::{Seen, Surroundings};

/// How much an effect shows, in words that were fixed before any case was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Magnitude {
    None,
    BelowNoise,
    Faint,
    Clear,
    Gross,
}

impl Magnitude {
    /// The distances that it means.
    pub fn range(self) -> (f64, f64) {
        match self {
            Magnitude::None => (0.0, 0.0),
            Magnitude::BelowNoise => (0.0, 1.0),
            Magnitude::Faint => (5.0, 12.0),
            Magnitude::Clear => (30.0, 150.0),
            Magnitude::Gross => (300.0, f64::INFINITY),
        }
    }

    /// What a distance is called, where it has a name.
    pub fn of(distance: f64) -> Option<Magnitude> {
        let all = [Magnitude::BelowNoise, Magnitude::Faint, Magnitude::Clear, Magnitude::Gross];
        all.into_iter().find(|magnitude| {
            let (low, high) = magnitude.range();
            (low..=high).contains(&distance)
        })
    }
}

/// What the tolerances of a machine, and what else is unknown of it, may make of its reports: how a run moves with each of its measures, by a
/// standard deviation of what is drawn anywhere within its tolerance.
pub struct Hidden {
    columns: Vec<Vec<f64>>,
    /// Of the columns' squares, with what is known of the measures beforehand.
    known: Cholesky<f64, Dyn>,
    /// How the flags move with each measure at a bound of its tolerance.
    flags: Vec<Vec<f64>>,
}

impl Hidden {
    /// By how each of `moved` runs differs from `base`, its measure off by a standard deviation.
    pub fn new(moved: &[Seen], base: &Seen, signals: &[Signal], around: &Surroundings) -> Hidden {
        Hidden::of(moved.iter().map(|moved| apart(moved, base, signals, around)).collect())
    }

    fn of(columns: Vec<Vec<f64>>) -> Hidden {
        let count = columns.len();
        let squares = DMatrix::from_fn(count, count, |a, b| {
            let own = if a == b { 1.0 } else { 0.0 };
            own + product(&columns[a], &columns[b])
        });
        let known = squares.cholesky().expect("a sum of squares and one is positive definite");
        Hidden { columns, known, flags: Vec::new() }
    }

    /// With runs in which one measure each is at a bound of its tolerance: what they do to flags.
    pub fn with_bounds(self, at_bounds: &[Seen], base: &Seen, signals: &[Signal]) -> Hidden {
        let flags = at_bounds.iter().map(|bound| flags_differ(bound, base, signals).collect()).collect();
        Hidden { flags, ..self }
    }

    /// The same beside another effect: how levels that are as in `base` move with its numbers, each `small` standard deviations off, and what flags do with
    /// each of them further off.
    pub fn beside(
        &self,
        (levels, small): (&[Rc<Seen>], f64),
        flags: &[Rc<Seen>],
        base: &Seen,
        (signals, around): (&[Signal], &Surroundings),
    ) -> Hidden {
        let along =
            |moved: &Rc<Seen>| apart(moved, base, signals, around).into_iter().map(|apart| apart / small).collect();
        let columns = self.columns.iter().cloned().chain(levels.iter().map(along)).collect();
        let flags = flags.iter().map(|moved| flags_differ(moved, base, signals).collect());
        Hidden { flags: self.flags.iter().cloned().chain(flags).collect(), ..Hidden::of(columns) }
    }

    /// The square of the distance of flags that differ so.
    fn flags_squared(&self, differ: &[f64]) -> f64 {
        let by_none = differ.iter().filter(|differs| **differs != 0.0).count();
        let by_one = |bound: &Vec<f64>| bound.iter().zip(differ).filter(|(bound, differs)| bound != differs).count();
        REPORT * self.flags.iter().map(by_one).fold(by_none, usize::min) as f64
    }

    /// How much of the square of a distance the measures can take away.
    fn takes(&self, apart: &[f64]) -> f64 {
        let along =
            DVector::from_iterator(self.columns.len(), self.columns.iter().map(|column| product(column, apart)));
        along.dot(&self.known.solve(&along))
    }
}

/// The distance D of two runs of a device, but for what its `hidden` measures can take away of it.
pub fn distance(one: &Seen, other: &Seen, signals: &[Signal], around: &Surroundings, hidden: &Hidden) -> f64 {
    let differ: Vec<f64> = flags_differ(one, other, signals).collect();
    (levels_apart(one, other, signals, around, hidden).powi(2) + hidden.flags_squared(&differ)).sqrt()
}

/// The same of their levels alone.
pub fn levels_apart(one: &Seen, other: &Seen, signals: &[Signal], around: &Surroundings, hidden: &Hidden) -> f64 {
    let apart = apart(one, other, signals, around);
    (product(&apart, &apart) - hidden.takes(&apart)).max(0.0).sqrt()
}

/// D of a level that scatters by `sigma` more, of so many `reports`: by how many standard deviations the logarithm of its variance lies above that
/// of the noisiest that a sensor may be. Nobody says how much a sensor scatters, but how much the others of a machine do, in their steps:
/// it may have twice as many as the noisiest of the table, and two besides.
pub fn noise_beyond(signal: &Signal, sigma: f64, around: &Surroundings, reports: usize) -> f64 {
    const NOISIEST: f64 = 3.0;
    const TWICE: f64 = 2.0;
    let rounding = signal.quantum.powi(2) / 12.0;
    let has = (around.noise * signal.sigma).powi(2) + sigma.powi(2) + rounding;
    let may_have = (TWICE * signal.quantum).powi(2) * ((NOISIEST * around.noise).powi(2) + 1.0) + rounding;
    (0.5 * reports as f64).sqrt() * (has / may_have).ln().max(0.0)
}

/// The differences of all levels, in units of what noise and rounding leave unsure.
fn apart(one: &Seen, other: &Seen, signals: &[Signal], around: &Surroundings) -> Vec<f64> {
    let levels = signals.iter().enumerate().filter(|(_, signal)| matches!(signal.kind, Kind::Level | Kind::Count));
    let of = |(place, signal): (usize, &Signal)| {
        Unsure::of(signal, around).apart(one.values.iter().zip(&other.values).map(move |(a, b)| (a[place], b[place])))
    };
    levels.flat_map(of).collect()
}

/// Noise of less than this share of a step leaves most reports of a rest rounded alike.
const REPEATS: f64 = 1.0 / 3.0;
/// What moves by less than this share of a step is rounded as it was.
const ALIKE: f64 = 0.5;

/// What noise and rounding leave unsure of a level.
#[derive(Clone, Copy, Debug)]
pub struct Unsure {
    /// At one report, σ·√φ and q/√12 together.
    each: f64,
    /// Within what it is rounded as it was; nothing where noise makes the rounding anew.
    alike: f64,
}

impl Unsure {
    pub fn of(signal: &Signal, around: &Surroundings) -> Unsure {
        let r = (-around.cycle / around.noise_time.max(1e-9)).exp();
        let wide = (1.0 + r) / (1.0 - r);
        let noise = around.noise * signal.sigma;
        let each = (noise.powi(2) * wide + signal.quantum.powi(2) / 12.0).sqrt();
        Unsure { each, alike: if noise < REPEATS * signal.quantum { ALIKE * signal.quantum } else { 0.0 } }
    }

    /// How far two tracks of it are apart, report by report, in units of that: the reports of a stay together as if they were one.
    pub fn apart(&self, pairs: impl Iterator<Item = (f64, f64)>) -> Vec<f64> {
        let pairs: Vec<(f64, f64)> = pairs.collect();
        let mut apart = Vec::with_capacity(pairs.len());
        while let Some(first) = pairs.get(apart.len()) {
            let is_alike =
                |pair: &&(f64, f64)| (pair.0 - first.0).abs() < self.alike && (pair.1 - first.1).abs() < self.alike;
            let stay = pairs[apart.len()..].iter().take_while(is_alike).count().max(1);
            let unit = self.each * (stay as f64).sqrt();
            let of = apart.len()..apart.len() + stay;
            apart.extend(pairs[of].iter().map(|(a, b)| (a - b) / unit));
        }
        apart
    }
}

/// The square of a report's distance in which a flag differs.
const REPORT: f64 = 12.0;

/// By report, the differences of all flags and codes.
fn flags_differ<'a>(one: &'a Seen, other: &'a Seen, signals: &'a [Signal]) -> impl Iterator<Item = f64> + 'a {
    let of = move |(a, b): (&'a Vec<f64>, &'a Vec<f64>)| {
        let flags = signals.iter().zip(a.iter().zip(b)).filter(|(signal, _)| signal.kind.is_edge());
        flags.map(|(_, (a, b))| a - b).collect::<Vec<f64>>()
    };
    one.values.iter().zip(&other.values).flat_map(of)
}

fn product(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rest of a hundred reports that is off by two steps, then a way: without noise the rest counts once, with it a hundred times, and
    /// the way always.
    #[test]
    fn a_rest_that_is_rounded_alike_counts_once() {
        let signal = Signal { name: "Axis.position".into(), kind: Kind::Level, quantum: 1.0, sigma: 1.0 };
        let heard = Surroundings::draw(&mut crate::chance::Dice::new(1, 2));
        let squared = |noise: f64| {
            let unsure = Unsure::of(&signal, &Surroundings { cycle: 0.01, noise, noise_time: 1e-5, ..heard.clone() });
            let rest = std::iter::repeat_n((5.0, 3.0), 100);
            let way = (0..10).map(|k| (8.0 + 4.0 * f64::from(k), 6.0 + 4.0 * f64::from(k)));
            unsure.apart(rest.chain(way)).iter().map(|apart| apart * apart).sum::<f64>()
        };
        assert!(
            (squared(0.0) - 11.0 * 48.0).abs() < 1e-6 && (squared(0.2) - 11.0 * 4.0 / (0.04 + 1.0 / 12.0)).abs() < 1e-3
        );
        assert!((squared(1.0) - 110.0 * 4.0 / (1.0 + 1.0 / 12.0)).abs() < 1e-3, "{}", squared(1.0));
    }

    #[test]
    fn noise_is_none_that_a_sensor_may_have() {
        let signal = Signal { name: "Axis.velocity".into(), kind: Kind::Level, quantum: 1e-3, sigma: 1.5e-3 };
        let around = Surroundings { noise: 1.0, ..Surroundings::draw(&mut crate::chance::Dice::new(1, 2)) };
        assert_eq!(noise_beyond(&signal, 6e-3, &around, 2000), 0.0);
        // Four times the variance of what it may have, to within what it has and rounding.
        let four = (4.0 * 40.0e-6_f64).sqrt();
        let found = noise_beyond(&signal, four, &around, 2000);
        assert!((found - 1000.0_f64.sqrt() * 4.0_f64.ln()).abs() < 1.0, "{found}");
    }

    /// A flag that comes three reports late, of which a measure at its bound explains two; and one that comes early, which it does not.
    #[test]
    fn of_a_flag_counts_what_no_bound_of_a_measure_explains() {
        let signals = [Signal { name: "Pusher.extended".into(), kind: Kind::Flag, quantum: 0.0, sigma: 0.0 }];
        let from = |first: usize| Seen {
            due: vec![0.0; 20],
            values: (0..20).map(|at| vec![f64::from(u8::from(at >= first))]).collect(),
        };
        let around = Surroundings::draw(&mut crate::chance::Dice::new(1, 2));
        let base = from(10);
        let hidden = || Hidden::new(&[], &base, &signals, &around);
        let off = |first: usize, hidden: &Hidden| distance(&from(first), &base, &signals, &around, hidden).powi(2);
        assert!((off(13, &hidden()) - 36.0).abs() < 1e-9);
        let bounded = hidden().with_bounds(&[from(12)], &base, &signals);
        assert!((off(13, &bounded) - 12.0).abs() < 1e-9 && (off(7, &bounded) - 36.0).abs() < 1e-9);
    }

    #[test]
    fn what_a_measure_within_its_tolerance_explains_is_no_distance() {
        let signals =
            [Signal { name: "Axis.position".into(), kind: Kind::Level, quantum: 12.0_f64.sqrt(), sigma: 0.0 }];
        let seen =
            |values: &[f64]| Seen { due: vec![0.0; values.len()], values: values.iter().map(|v| vec![*v]).collect() };
        let heard = Surroundings::draw(&mut crate::chance::Dice::new(1, 2));
        let around = Surroundings { cycle: 0.01, noise: 0.0, noise_time: 1e-3, ..heard };
        let (base, moved) = (seen(&[0.0, 0.0, 0.0]), seen(&[0.0, 100.0, 0.0]));
        let hidden = Hidden::new(&[moved], &base, &signals, &around);
        let off = |values: &[f64]| distance(&seen(values), &base, &signals, &around, &hidden);
        // Along the measure next to nothing is left, across it all of it.
        assert!(off(&[0.0, 50.0, 0.0]) < 0.51 && (off(&[0.0, 50.0, 7.0]) - 7.0).abs() < 0.05);
    }

    /// What another effect would do with other numbers tells nobody of this one: of levels along them nothing is left, and of a flag what none of them does.
    #[test]
    fn beside_another_effect_counts_what_its_numbers_do_not_explain() {
        let signal = |name: &str, kind: Kind| Signal { name: name.into(), kind, quantum: 12.0_f64.sqrt(), sigma: 0.0 };
        let signals = [signal("Axis.position", Kind::Level), signal("Axis.arrived", Kind::Flag)];
        let seen =
            |values: &[[f64; 2]]| Seen { due: vec![0.0; 3], values: values.iter().map(|v| v.to_vec()).collect() };
        let heard = Surroundings::draw(&mut crate::chance::Dice::new(1, 2));
        let around = Surroundings { cycle: 0.01, noise: 0.0, noise_time: 1e-3, ..heard };
        let base = seen(&[[0.0, 0.0], [0.0, 1.0], [0.0, 1.0]]);
        let little = seen(&[[0.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
        let much = seen(&[[0.0, 0.0], [90.0, 0.0], [0.0, 1.0]]);
        let hidden = Hidden::new(&[], &base, &signals, &around);
        let beside = hidden.beside((&[Rc::new(little)], 0.02), &[Rc::new(much)], &base, (&signals, &around));
        let off = |values: &[[f64; 2]]| distance(&seen(values), &base, &signals, &around, &beside);
        assert!(off(&[[0.0, 0.0], [50.0, 0.0], [0.0, 1.0]]) < 0.51);
        // It never counts more than by itself.
        let alone = distance(&seen(&[[0.0, 0.0], [50.0, 0.0], [7.0, 0.0]]), &base, &signals, &around, &hidden);
        assert!(off(&[[0.0, 0.0], [50.0, 0.0], [7.0, 0.0]]) < alone);
        assert!((off(&[[0.0, 0.0], [50.0, 0.0], [7.0, 1.0]]) - 7.0).abs() < 0.05);
        assert!((off(&[[0.0, 0.0], [50.0, 0.0], [0.0, 0.0]]) - 12.0_f64.sqrt()).abs() < 0.05);
    }
}
