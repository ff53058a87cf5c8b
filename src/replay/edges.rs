//! An edge signal over time: which recorded edge is which of the model's, and how far apart they are.

use std::collections::VecDeque;
use std::time::Duration;

use crate::signal_map::{RegisterId, Signal};
use crate::time::Instant;
use crate::value::Value;

use super::report::EdgeReport;

/// Edges further apart than this are two edges, not one at two times. Widened to twice the tolerance where that is more.
const WINDOW: Duration = Duration::from_secs(1);

/// How many edges of a signal wait for their counterparts at most.
const MOST_WAITING: usize = 512;

/// A change of a signal.
#[derive(Clone, Debug)]
struct Edge {
    at: Instant,
    from: Value,
    to: Value,
    /// If it has no counterpart, it may have had one that nobody recorded.
    excused: bool,
}

/// One edge signal.
pub(super) struct EdgeTrack {
    pub id: RegisterId,
    tolerance: Duration,
    window: Duration,
    /// The time of the trace's last line.
    ends: Instant,
    /// What was recorded last; `None` before the first report, and while nobody records.
    recorded: Option<Value>,
    /// Since when it has been recorded.
    since: Instant,
    /// What the model was last.
    model: Option<Value>,
    /// Recorded edges, and edges of the model, that wait to be paired.
    waiting: [VecDeque<Edge>; 2],
    seen: bool,
    counts: Counts,
}

#[derive(Default)]
struct Counts {
    matched: u64,
    early: u64,
    late: u64,
    missing: u64,
    extra: u64,
    brief: u64,
    largest: Duration,
    first_at: Option<Instant>,
}

const RECORDED: usize = 0;
const MODEL: usize = 1;

impl EdgeTrack {
    pub fn new(id: RegisterId, tolerance: Duration, ends: Instant) -> EdgeTrack {
        EdgeTrack {
            id,
            tolerance,
            window: WINDOW.max(2 * tolerance),
            ends,
            recorded: None,
            since: Instant::ZERO,
            model: None,
            waiting: [VecDeque::new(), VecDeque::new()],
            seen: false,
            counts: Counts::default(),
        }
    }

    /// Nobody records until the next report.
    pub fn blind(&mut self) {
        self.recorded = None;
    }

    /// Looks at the model. What it did while nobody recorded is no edge.
    pub fn model(&mut self, now: Instant, registers: &[Value]) {
        let value = &registers[self.id.index()];
        if self.model.as_ref() != Some(value) {
            let before = self.model.replace(value.clone());
            if let (Some(from), true) = (before, self.recorded.is_some()) {
                let excused = now.since(self.since) <= self.tolerance || now + self.tolerance > self.ends;
                self.waiting[MODEL].push_back(Edge { at: now, from, to: value.clone(), excused });
            }
        }
        self.pair_old(now);
    }

    /// A report. The first, also after nobody recorded, is no edge; but the model must be there already.
    pub fn recorded(&mut self, now: Instant, value: &Value, registers: &[Value]) {
        let model = &registers[self.id.index()];
        if self.recorded.is_none() {
            self.since = now;
            self.seen = true;
        }
        let from = self.recorded.replace(value.clone()).unwrap_or_else(|| model.clone());
        if from != *value {
            let excused = now + self.tolerance > self.ends;
            self.waiting[RECORDED].push_back(Edge { at: now, from, to: value.clone(), excused });
        }
    }

    /// Pairs what can have no further counterpart.
    fn pair_old(&mut self, now: Instant) {
        let Some(newest) = self.waiting.iter().filter_map(|edges| edges.back()).map(|edge| edge.at).max() else {
            return;
        };
        if now.since(newest) > self.window {
            self.pair_until(Instant::FAR);
        } else if self.waiting[RECORDED].len() + self.waiting[MODEL].len() > MOST_WAITING {
            self.pair_until(now - self.window);
        }
    }

    /// Pairs all waiting edges and counts those up to the last pair that is older than `until`; if there is none, all.
    fn pair_until(&mut self, until: Instant) {
        let pairs = pair(&self.waiting[RECORDED], &self.waiting[MODEL], self.window);
        let is_old =
            |&&(i, j): &&(usize, usize)| self.waiting[RECORDED][i].at <= until && self.waiting[MODEL][j].at <= until;
        let (all_recorded, all_model) = (self.waiting[RECORDED].len(), self.waiting[MODEL].len());
        let end = match pairs.iter().rfind(is_old) {
            Some((i, j)) if until < Instant::FAR => (i + 1, j + 1),
            _ => (all_recorded, all_model),
        };
        let mut recorded_alone = vec![true; end.0];
        let mut model_alone = vec![true; end.1];
        for (i, j) in pairs.into_iter().filter(|pair| pair.0 < end.0) {
            (recorded_alone[i], model_alone[j]) = (false, false);
            self.counts.pair(&self.waiting[RECORDED][i], &self.waiting[MODEL][j], self.tolerance);
        }
        for (i, _) in recorded_alone.iter().enumerate().filter(|(_, alone)| **alone) {
            self.counts.missing(&self.waiting[RECORDED][i]);
        }
        self.count_extra(&model_alone);
        self.waiting[RECORDED].drain(..end.0);
        self.waiting[MODEL].drain(..end.1);
    }

    /// Counts the model's edges that have no counterpart. A state that the model leaves again within the tolerance could
    /// have begun where it ended: going there and coming back is no difference.
    fn count_extra(&mut self, alone: &[bool]) {
        let edges = &self.waiting[MODEL];
        let mut state = edges.front().map(|edge| edge.from.clone());
        for (j, edge) in edges.iter().enumerate().take(alone.len()) {
            let is_brief = edges.get(j + 1).is_some_and(|next| next.at.since(edge.at) <= self.tolerance);
            match alone[j] {
                true if is_brief => self.counts.brief += 1,
                true if state.as_ref() == Some(&edge.to) => {}
                alone => {
                    state = Some(edge.to.clone());
                    if alone {
                        self.counts.extra(edge);
                    }
                }
            }
        }
    }

    /// The result; `None` for a signal that was never recorded.
    pub fn finish(&mut self, signal: &Signal) -> Option<EdgeReport> {
        self.pair_until(Instant::FAR);
        let counts = &self.counts;
        self.seen.then(|| EdgeReport {
            name: signal.name.clone(),
            matched: counts.matched,
            early: counts.early,
            late: counts.late,
            missing: counts.missing,
            extra: counts.extra,
            brief: counts.brief,
            largest_s: counts.largest.as_secs_f64(),
            first_at_s: counts.first_at.map(Instant::seconds),
            differs: counts.early + counts.late + counts.missing + counts.extra > 0,
        })
    }
}

impl Counts {
    fn pair(&mut self, recorded: &Edge, model: &Edge, tolerance: Duration) {
        let apart = distance(recorded, model);
        self.largest = self.largest.max(apart);
        if apart <= tolerance {
            self.matched += 1;
            return;
        }
        match model.at < recorded.at {
            true => self.early += 1,
            false => self.late += 1,
        }
        self.difference_at(recorded.at.min(model.at));
    }

    fn missing(&mut self, edge: &Edge) {
        if !edge.excused {
            self.missing += 1;
            self.difference_at(edge.at);
        }
    }

    fn extra(&mut self, edge: &Edge) {
        if !edge.excused {
            self.extra += 1;
            self.difference_at(edge.at);
        }
    }

    fn difference_at(&mut self, at: Instant) {
        self.first_at = Some(self.first_at.map_or(at, |first| first.min(at)));
    }
}

fn distance(one: &Edge, other: &Edge) -> Duration {
    one.at.since(other.at).max(other.at.since(one.at))
}

/// Pairs edges that change to the same value, in order, so that the sum of the distances is least, where an edge without
/// a counterpart costs half the window. (The alignment of two sequences by dynamic programming: Needleman and Wunsch,
/// J. Mol. Biol. 48, 1970.)
fn pair(recorded: &VecDeque<Edge>, model: &VecDeque<Edge>, window: Duration) -> Vec<(usize, usize)> {
    let columns = model.len() + 1;
    let alone = window.as_nanos() as u64 / 2;
    let cost_of_pair = |i: usize, j: usize| {
        let (recorded, model) = (&recorded[i], &model[j]);
        let apart = distance(recorded, model);
        (recorded.to == model.to && apart <= window).then_some(apart.as_nanos() as u64)
    };
    // least[i, j]: the cost of the first i recorded and the first j of the model.
    let mut least = vec![0u64; (recorded.len() + 1) * columns];
    for i in 0..=recorded.len() {
        for j in 0..=model.len() {
            let mut costs = [u64::MAX; 3];
            if i > 0 {
                costs[0] = least[(i - 1) * columns + j] + alone;
            }
            if j > 0 {
                costs[1] = least[i * columns + j - 1] + alone;
            }
            if i > 0 && j > 0 {
                let pair = cost_of_pair(i - 1, j - 1);
                costs[2] = pair.map_or(u64::MAX, |pair| least[(i - 1) * columns + j - 1] + pair);
            }
            least[i * columns + j] = if i + j == 0 { 0 } else { costs.into_iter().min().unwrap_or(0) };
        }
    }
    let mut pairs = Vec::new();
    let (mut i, mut j) = (recorded.len(), model.len());
    while i > 0 && j > 0 {
        let here = least[i * columns + j];
        if cost_of_pair(i - 1, j - 1).is_some_and(|pair| least[(i - 1) * columns + j - 1] + pair == here) {
            (i, j) = (i - 1, j - 1);
            pairs.push((i, j));
        } else if least[(i - 1) * columns + j] + alone == here {
            i -= 1;
        } else {
            j -= 1;
        }
    }
    pairs.reverse();
    pairs
}
