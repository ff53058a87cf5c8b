//! A recorded signal on the grid of its reports.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use super::grid::Grid;
use super::parts::Origin;
use super::recording::{Recording, Stamped};

/// What one recording says of one signal.
#[derive(Clone, Debug)]
pub struct Track {
    /// When the signal was looked at.
    pub grid: Arc<Grid>,
    /// The first of the grid's instants from which its value is known.
    pub first: usize,
    /// Of a level: its value at each instant from `first`, SI; held where no line says otherwise. Empty of an edge.
    pub values: Vec<f64>,
    /// Of an edge: its value at `first`.
    pub initial: f64,
    /// Of an edge: its changes after that.
    pub edges: Vec<Edge>,
    /// Of a barrier that parts pass: what each of the edges is to a score. Empty of every other signal, whose edges all count.
    pub origins: Vec<Origin>,
    /// How far the parts that pass may be from where they are taken to be, beside what all of their edges share, m: they lie
    /// askew on a belt, and on a curve they turn.
    pub tolerance: f64,
    /// From which instants on (index into the grid) nothing counts, and until which; ascending.
    pub blind: Vec<(usize, usize)>,
    /// Of a count: from which instants on (index into the grid) it goes on from wherever it is found; ascending.
    pub anew: Vec<usize>,
}

/// A change of a recorded state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The grid's instant at which it was first seen; at the instant before it was not there yet.
    pub index: usize,
    /// What the signal became.
    pub to: f64,
}

impl Track {
    /// A level; `None` where it was never reported.
    pub fn level(grid: &Arc<Grid>, recording: &Recording, stamped: &[Stamped]) -> Option<Track> {
        let mut track = Track::empty(grid, recording, stamped)?;
        let mut value = stamped[0].value;
        let mut next = stamped.iter().peekable();
        for index in track.first..grid.instants.len() {
            while let Some(news) = next.next_if(|news| grid.index(news.at) <= index) {
                value = news.value;
            }
            track.values.push(value);
        }
        Some(track)
    }

    /// An edge; `None` where it was never reported. Of several changes within a cycle the last is seen.
    pub fn edge(grid: &Arc<Grid>, recording: &Recording, stamped: &[Stamped]) -> Option<Track> {
        let mut track = Track::empty(grid, recording, stamped)?;
        let mut value = stamped[0].value;
        track.initial = value;
        let mut seen: Vec<(usize, f64)> = Vec::new();
        for news in stamped {
            let index = grid.index(news.at);
            match seen.last_mut() {
                Some(last) if last.0 == index => last.1 = news.value,
                _ => seen.push((index, news.value)),
            }
        }
        track.initial = seen.first().map_or(value, |(_, first)| *first);
        value = track.initial;
        for (index, to) in seen {
            if to != value {
                track.edges.push(Edge { index, to });
                value = to;
            }
        }
        Some(track)
    }

    /// A counter that wraps, counted on: a jump of more than half of what it can count to is a wrap.
    pub(super) fn unwrapped(mut self) -> Track {
        let most = self.values.iter().copied().fold(0.0, f64::max);
        let least = self.values.iter().copied().fold(0.0, f64::min);
        // A DINT has both signs; fewer bits count from 0 up.
        let period = if least < 0.0 { 4_294_967_296.0 } else { 2.0_f64.powf((most + 1.0).max(2.0).log2().ceil()) };
        let mut turns = 0.0;
        let mut before = self.values.first().copied().unwrap_or(0.0);
        for value in &mut self.values {
            let raw = *value;
            turns += if raw - before < -0.75 * period { 1.0 } else { 0.0 }
                - if raw - before > 0.75 * period { 1.0 } else { 0.0 };
            *value = raw + turns * period;
            before = raw;
        }
        self
    }

    fn empty(grid: &Arc<Grid>, recording: &Recording, stamped: &[Stamped]) -> Option<Track> {
        let first = grid.index(stamped.first()?.at);
        let at = |instant: f64| grid.instants.partition_point(|at| *at < instant);
        let blind = recording.blind.iter().map(|span| (at(span.from), at(span.to)));
        // After lost reports a signal is unknown until it is reported again.
        let known = |after: f64| stamped.iter().find(|news| news.at >= after).map_or(f64::INFINITY, |news| news.at);
        let lost = recording.lost.iter().map(|span| (at(span.from) + 1, at(known(span.to)).saturating_sub(1)));
        let blind = blind.chain(lost).collect();
        let grid = grid.clone();
        Some(Track {
            grid,
            first,
            values: Vec::new(),
            initial: 0.0,
            edges: Vec::new(),
            origins: Vec::new(),
            tolerance: 0.0,
            blind,
            anew: Vec::new(),
        })
    }

    /// A level of these values, each 10 ms.
    #[cfg(test)]
    pub(super) fn of_values(values: Vec<f64>) -> Track {
        Track {
            grid: Arc::new(Grid::of_steps(0.01, 0.01 * values.len() as f64)),
            first: 0,
            values,
            initial: 0.0,
            edges: Vec::new(),
            origins: Vec::new(),
            tolerance: 0.0,
            blind: Vec::new(),
            anew: Vec::new(),
        }
    }

    /// A barrier that was cut in these spans, s, looked at every 20 ms for a minute.
    #[cfg(test)]
    pub(super) fn of_cuts(cuts: &[(f64, f64)]) -> Track {
        const CYCLE_S: f64 = 0.02;
        let edge = |at: f64, to: f64| Edge { index: (at / CYCLE_S).ceil() as usize, to };
        let edges = cuts.iter().flat_map(|(from, to)| [edge(*from, 1.0), edge(*to, 0.0)]).collect();
        Track { grid: Arc::new(Grid::of_steps(CYCLE_S, 60.0)), edges, ..Track::of_values(Vec::new()) }
    }

    /// Of a level: its values, and those predicted in their place, where they are evidence.
    pub(super) fn evident<'a>(&'a self, predicted: &'a [f64]) -> (Cow<'a, [f64]>, Cow<'a, [f64]>) {
        if self.blind.is_empty() {
            return (Cow::Borrowed(&self.values), Cow::Borrowed(predicted));
        }
        let seen = (0..self.values.len()).filter(|k| !self.is_blind(self.first + k));
        let pairs = seen.map(|k| (self.values[k], predicted[k]));
        let (values, predicted): (Vec<f64>, Vec<f64>) = pairs.unzip();
        (Cow::Owned(values), Cow::Owned(predicted))
    }

    /// The same with all instants earlier by so much, s.
    pub(super) fn earlier(&self, by: f64) -> Track {
        let mut track = self.clone();
        if by != 0.0 {
            let mut grid = Grid::clone(&self.grid);
            grid.instants.iter_mut().for_each(|at| *at -= by);
            track.grid = Arc::new(grid);
        }
        track
    }

    /// A state that is on where this one is off.
    pub(super) fn inverted(&self) -> Track {
        let mut track = self.clone();
        track.initial = 1.0 - track.initial;
        track.edges.iter_mut().for_each(|edge| edge.to = 1.0 - edge.to);
        track
    }

    /// Lets the values that are predicted of a count go on from where this one is found: at the start of what began elsewhere, and wherever nobody
    /// knows how far it was on.
    pub(super) fn count_on(&self, predicted: &mut [f64]) {
        const STARTED_FRESH: f64 = 2.0;
        let count = predicted.len();
        let Some(first) = (0..count).find(|k| !self.is_blind(self.first + k)) else { return };
        if first > 0 || self.values.first().is_some_and(|recorded| recorded.abs() > STARTED_FRESH) {
            let base = middle(count_base(self.counts(first..count, predicted)));
            predicted.iter_mut().for_each(|value| *value += base);
        }
        let places: Vec<usize> = self.anew.iter().map(|index| index.saturating_sub(self.first).min(count)).collect();
        self.count_on_at(&places, predicted);
    }

    /// The same at each of these of its values, ascending: as it had been found until then, or, behind what nobody saw, as it is found from then on.
    pub(super) fn count_on_at(&self, places: &[usize], predicted: &mut [f64]) {
        let ends = places.iter().skip(1).copied().chain([predicted.len()]);
        let mut since = 0;
        for (from, to) in places.iter().copied().zip(ends).filter(|(from, to)| 0 < *from && from < to) {
            let is_seen = since < from && !self.is_blind(self.first + from - 1);
            let base = match is_seen {
                true => as_it_was_or_middle(count_base(self.counts(since..from, predicted).rev())),
                false => middle(count_base(self.counts(from..to, predicted))),
            };
            predicted[from..].iter_mut().for_each(|value| *value += base);
            since = from;
        }
    }

    /// Of a count: what was recorded and what is predicted at these of its values.
    fn counts<'a>(
        &'a self,
        range: Range<usize>,
        predicted: &'a [f64],
    ) -> impl DoubleEndedIterator<Item = (f64, f64)> + 'a {
        self.values[range.clone()].iter().copied().zip(predicted[range].iter().copied())
    }

    /// Whether an instant of the grid is no evidence.
    pub fn is_blind(&self, index: usize) -> bool {
        self.blind.iter().any(|(from, to)| (*from..=*to).contains(&index))
    }

    /// The part that made an edge, if it is known.
    pub fn part(&self, edge: usize) -> Option<usize> {
        match self.origins.get(edge) {
            Some(Origin::Part(part)) => Some(*part),
            _ => None,
        }
    }

    /// Whether an edge was played back, so that nothing is learnt from it.
    pub fn is_input(&self, edge: usize) -> bool {
        self.origins.get(edge) == Some(&Origin::Input)
    }

    /// From when to when something was recorded, s.
    pub fn span(&self) -> (f64, f64) {
        let at = |index: usize| self.grid.instants.get(index).copied().unwrap_or(0.0);
        (at(self.first), at(self.grid.instants.len().saturating_sub(1)))
    }
}

/// Within what a counter is on beside what is predicted: it shows whole counts, so that each of them, recorded and predicted, says it within one; what the
/// first of them all allow.
fn count_base(counts: impl Iterator<Item = (f64, f64)>) -> [f64; 2] {
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    for (recorded, predicted) in counts {
        let (low, high) = (least.max(recorded - predicted), most.min(recorded + 1.0 - predicted));
        if low >= high {
            break;
        }
        (least, most) = (low, high);
    }
    [least, most]
}

fn middle([least, most]: [f64; 2]) -> f64 {
    0.5 * (least + most)
}

/// By how much it is on more than it was thought to be: nothing where that is among what it may be.
fn as_it_was_or_middle(base: [f64; 2]) -> f64 {
    if (base[0]..base[1]).contains(&0.0) { 0.0 } else { middle(base) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shaft that turned on by a hundred counts while nobody looked, from instant 40 to 49.
    #[test]
    fn a_count_goes_on_from_where_it_is_found_behind_what_nobody_saw() {
        let law: Vec<f64> = (0..100).map(|k| 0.7 * f64::from(k) + 0.4).collect();
        let turned = |k: usize| if k < 40 { 0.0 } else { 100.0 };
        let recorded = law.iter().enumerate().map(|(k, law)| (law + turned(k)).floor()).collect();
        let mut track = Track::of_values(recorded);
        (track.blind, track.anew) = (vec![(40, 49)], vec![50]);
        let mut predicted = law.clone();
        track.count_on(&mut predicted);
        let off = |k: usize| predicted[k] - track.values[k];
        assert!((0..40).chain(50..100).all(|k| (-0.2..1.2).contains(&off(k))), "{predicted:?}");
        assert_eq!(predicted[..50], law[..50]);
    }

    /// A shaft that is five counts ahead from instant 30 on, where it was told something, and another that is not.
    #[test]
    fn a_count_goes_on_from_where_it_was_found_when_something_was_told() {
        let law: Vec<f64> = (0..100).map(|k| 0.7 * f64::from(k) + 0.4).collect();
        for ahead in [0.0, 5.0] {
            let turned = |k: usize| if k < 30 { 0.0 } else { ahead };
            let track = Track::of_values(law.iter().enumerate().map(|(k, law)| (law + turned(k)).floor()).collect());
            let mut predicted = law.clone();
            track.count_on_at(&[30, 60], &mut predicted);
            // Between the two it is where it was; then as it was found between them.
            assert_eq!(predicted[..60], law[..60]);
            let off = predicted[60] - law[60];
            assert!(if ahead == 0.0 { off == 0.0 } else { (off - ahead).abs() < 0.2 }, "{off}");
        }
    }
}
