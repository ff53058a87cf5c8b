//! How far two outputs of a device lie apart: exactly, by the rule of the magnitudes, and in a form that has slopes for the search.

use super::alone::{Alone, Heard};
use crate::magnitude::Unsure;
use crate::plant::{Kind, Signal};

/// A flag's edge is looked for so near, s.
const NEAR: f64 = 0.5;

/// One that is not there, or that is one too many, counts as if it were so many cycles late.
const LOST: f64 = 10.0;

/// The scales of a device's signals.
pub struct Measure {
    /// By signal; of a flag nothing.
    unsure: Vec<Option<Unsure>>,
    cycle: f64,
}

impl Measure {
    /// Of the signals of `device`.
    pub fn new(device: &Alone<'_>, signals: &[Signal]) -> Measure {
        let unsure = |signal: &Signal| {
            let is_level = matches!(signal.kind, Kind::Level | Kind::Count);
            is_level.then(|| Unsure::of(signal, device.around))
        };
        Measure { unsure: signals.iter().map(unsure).collect(), cycle: device.around.cycle }
    }

    /// The square of the distance: that of the magnitudes.
    pub fn squared(&self, one: &Heard, other: &Heard) -> f64 {
        self.by_signal(one, other).iter().sum()
    }

    /// The same, by signal.
    pub fn by_signal(&self, one: &Heard, other: &Heard) -> Vec<f64> {
        let of = |(signal, unsure): (usize, &Option<Unsure>)| {
            let pairs = pairs(one, other, signal);
            match unsure {
                Some(unsure) => unsure.apart(pairs).iter().map(|apart| apart * apart).sum(),
                None => 12.0 * pairs.filter(|(a, b)| a != b).count() as f64,
            }
        };
        self.unsure.iter().enumerate().map(of).collect()
    }

    /// Those of the [`differences`](Measure::differences) that are known by then.
    pub fn differences_until(&self, one: &Heard, other: &Heard, until: f64) -> Vec<f64> {
        let mut all = Vec::new();
        for (signal, unsure) in self.unsure.iter().enumerate() {
            all.extend(unsure.iter().flat_map(|unsure| unsure.apart(pairs(other, one, signal))));
        }
        for (one, other) in one.edges.iter().zip(&other.edges) {
            let from = all.len();
            self.edges(&one[..known_edges(one, until)], other, &mut all);
            // What there is too much of may have its like later.
            all.truncate(from + known_edges(one, until));
        }
        all
    }

    /// The places of those among the [`differences`](Measure::differences) from `one`, where so many reports are there by then.
    pub fn places_until(&self, one: &Heard, reports: usize, until: f64) -> Vec<usize> {
        let (mut places, mut from) = (Vec::new(), 0);
        for _ in self.unsure.iter().flatten() {
            places.extend(from..from + reports);
            from += one.values.len();
        }
        for edges in &one.edges {
            places.extend(from..from + known_edges(edges, until));
            from += edges.len() + 1;
        }
        places
    }

    /// Differences whose squares sum to about the same and that move with every edge: `other` less `one`, as many as `one` has values
    /// and edges.
    pub fn differences(&self, one: &Heard, other: &Heard) -> Vec<f64> {
        let mut all = Vec::with_capacity(one.values.len() * self.unsure.len());
        for (signal, unsure) in self.unsure.iter().enumerate() {
            all.extend(unsure.iter().flat_map(|unsure| unsure.apart(pairs(other, one, signal))));
        }
        for (one, other) in one.edges.iter().zip(&other.edges) {
            self.edges(one, other, &mut all);
        }
        all
    }

    /// The signal of each of the [`differences`](Measure::differences) from `one`.
    pub fn owners(&self, one: &Heard) -> Vec<usize> {
        let levels = || (0..self.unsure.len()).filter(|signal| self.unsure[*signal].is_some());
        let count = one.values.len();
        let mut owners: Vec<usize> = levels().flat_map(|signal| std::iter::repeat_n(signal, count)).collect();
        for (signal, edges) in one.edges.iter().enumerate() {
            owners.extend(std::iter::repeat_n(signal, edges.len() + 1));
        }
        owners
    }

    /// Edges beside each other in order. One that is nowhere near counts as far off; what there is too much of, in one number.
    fn edges(&self, one: &[(f64, f64)], other: &[(f64, f64)], all: &mut Vec<f64>) {
        let mut next = 0;
        let mut matched = 0;
        for &(at, value) in one {
            let near = other[next..].iter().take_while(|(then, _)| *then < at + NEAR);
            let found = near
                .enumerate()
                .filter(|(_, (then, to))| *to == value && (then - at).abs() < NEAR)
                .min_by(|(_, a), (_, b)| (a.0 - at).abs().total_cmp(&(b.0 - at).abs()));
            match found {
                Some((skipped, (then, _))) => {
                    next += skipped + 1;
                    matched += 1;
                    all.push(self.late(then - at));
                }
                None => all.push(self.late(LOST * self.cycle)),
            }
        }
        all.push((other.len().saturating_sub(matched) as f64).sqrt() * self.late(LOST * self.cycle));
    }

    /// A flag that is late by a time differs in so many reports, of which each counts 12; below a cycle the square of the time counts, so
    /// that it has a slope everywhere.
    fn late(&self, time: f64) -> f64 {
        let cycles = time / self.cycle;
        let size = if cycles.abs() <= 1.0 { cycles.abs() } else { (2.0 * cycles.abs() - 1.0).sqrt() };
        12.0_f64.sqrt() * size.copysign(cycles)
    }
}

/// How many of these edges have passed so long ago that what may be near each is known.
fn known_edges(edges: &[(f64, f64)], until: f64) -> usize {
    edges.partition_point(|(at, _)| at + NEAR <= until)
}

/// What a sum of squares over a part says of the whole: the last stay of each level may go on, and weighs as one however long it is.
pub fn at_least(squared: f64) -> f64 {
    (0.9 * squared - 12.0).max(0.0)
}

/// What the one and the other have for a signal, report by report.
fn pairs<'a>(one: &'a Heard, other: &'a Heard, signal: usize) -> impl Iterator<Item = (f64, f64)> + 'a {
    one.values.iter().zip(&other.values).map(move |(a, b)| (a[signal], b[signal]))
}
