//! How far the gap shrinks.
//!
//! The gap of a signal is normalised by its floor: of a level the mean square of its differences over that of the floor, of an
//! edge 1 and the mean of what its edges cost above the floor, so that a signal at its floor counts 1 and metres, counts and
//! booleans can be put in one figure. The plant's gap is the root of the mean over its signals; those of a device of which nothing was found, and
//! where nothing is beyond chance, count as at their floors.

use crate::gap::cause::BLOCK_S;
use crate::gap::report::{Gap, NormalisedRms, Shrink};
use crate::gap::statistics::{Draws, quantile};
use crate::gap::{Score, SignalScore, Subject};

const DRAWS: usize = 400;

/// The squares of all signals above their floors, block by block of time.
#[derive(Clone, Debug, Default)]
pub(super) struct Squares {
    before: Vec<f64>,
    after: Vec<f64>,
    signals: f64,
}

impl Squares {
    /// Adds the signals of a device, scored without and with what is added to it.
    pub fn add(&mut self, subject: &Subject, before: &Score, after: &Score) {
        for place in 0..subject.signals.len() {
            let (before, after) = (of_signal(before, place), of_signal(after, place));
            if is_weighed(&before) {
                self.add_signal(&before, &after);
            }
        }
    }

    /// Adds one signal. Without it, or with it, there may be edges in blocks that hold none otherwise: each block is one of both.
    fn add_signal(&mut self, before: &[SignalScore], after: &[SignalScore]) {
        self.signals += 1.0;
        add(&mut self.before, before);
        add(&mut self.after, after);
        let blocks = self.before.len().max(self.after.len());
        self.before.resize(blocks, 0.0);
        self.after.resize(blocks, 0.0);
    }

    /// Adds the signals of a device that is in order: at their floors.
    pub fn add_floor(&mut self, subject: &Subject, score: &Score) {
        let weighed = (0..subject.signals.len()).filter(|place| is_weighed(&of_signal(score, *place)));
        self.signals += weighed.count() as f64;
    }
}

/// One signal in all runs.
fn of_signal(score: &Score, place: usize) -> Vec<SignalScore> {
    score.signals.iter().filter(|signal| signal.signal == place).cloned().collect()
}

fn is_weighed(runs: &[SignalScore]) -> bool {
    runs.iter().any(|signal| weight(signal) > 0.0)
}

fn weight(signal: &SignalScore) -> f64 {
    match &signal.level {
        Some(level) => level.at.len() as f64,
        None => {
            signal.edges.iter().filter(|edge| edge.recorded.is_some()).count().max(signal.edges.len().min(1)) as f64
        }
    }
}

/// Adds one signal of all runs: each block's part of its mean square above the floor.
fn add(blocks: &mut Vec<f64>, runs: &[SignalScore]) {
    let all: f64 = runs.iter().map(weight).sum();
    for signal in runs {
        let count = weight(signal);
        let mut put = |at: f64, square: f64| {
            // Runs lie beside one another: a block of each is not a block of the other, but they are drawn together.
            let block = (at.max(0.0) / BLOCK_S) as usize;
            if blocks.len() <= block {
                blocks.resize(block + 1, 0.0);
            }
            blocks[block] += square / all;
        };
        match &signal.level {
            Some(level) => {
                let floor = signal.floor.max(1e-12);
                for (at, difference) in level.at.iter().zip(&level.difference) {
                    put(*at, (difference / floor).powi(2) - 1.0);
                }
            }
            None => {
                let floor = signal.floor_cost.0 / count.max(1.0);
                for edge in &signal.edges {
                    put(edge.at(), edge.cost - floor);
                }
            }
        }
    }
}

/// The plant's gap and how far it shrinks; `adds` says whether anything is added at all.
pub(super) fn shrink(squares: &Squares, adds: bool) -> (Gap, Shrink) {
    if squares.signals == 0.0 {
        return (Gap::default(), Shrink::default());
    }
    let above = |sum: f64| (sum / squares.signals).max(0.0);
    let (before, after) = (above(squares.before.iter().sum()), above(squares.after.iter().sum()));
    let gap = Gap {
        before: Some((1.0 + before).sqrt()),
        after: Some((1.0 + after).sqrt()),
        floor: Some(1.0),
        unit: NormalisedRms::NormalisedRms,
    };
    let ratio = |before: f64, after: f64| if before > 0.0 { (after.max(0.0) / before).sqrt() } else { 1.0 };
    let measured = Shrink {
        holdout_before: gap.before,
        holdout_after: gap.after,
        ratio: Some(if adds { ratio(before, after) } else { 1.0 }),
        ci95: adds.then(|| {
            let draws = Draws::new(squares.before.len(), DRAWS, 4);
            let ratios = draws.each(&[&squares.before, &squares.after], |sums| ratio(sums[0], sums[1]));
            [quantile(&ratios, 0.025), quantile(&ratios, 0.975)]
        }),
        explainable_left: Some(after.sqrt()),
    };
    (gap, measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::EdgeScore;

    /// A flag that was late in the recording's end, where nothing is scored once the effect is there.
    #[test]
    fn edges_of_late_blocks_may_be_there_without_the_effect_alone() {
        let edge = |at: f64, cost: f64| EdgeScore {
            to: 1.0,
            recorded: Some((at, at + 0.01)),
            predicted: Some(at),
            error: 0.0,
            uncertainty: 1e-3,
            cost,
            residual: cost.sqrt(),
        };
        let scored = |edges: Vec<EdgeScore>| SignalScore {
            signal: 0,
            run: 0,
            cost: edges.iter().map(|edge| edge.cost).sum(),
            floor_cost: (0.0, 0.0),
            rms: 0.0,
            floor: 1e-3,
            level: None,
            edges,
        };
        let mut squares = Squares::default();
        squares.add_signal(&[scored(vec![edge(1.0, 8.0), edge(52.0, 8.0)])], &[scored(vec![edge(1.0, 2.0)])]);
        let (gap, shrink) = shrink(&squares, true);
        assert_eq!((gap.before, gap.after), (Some(3.0), Some(3.0_f64.sqrt())));
        assert!(
            shrink.ratio == Some(0.5) && shrink.ci95.is_some_and(|ends| ends.iter().all(|end| end.is_finite())),
            "{shrink:?}"
        );
    }
}
