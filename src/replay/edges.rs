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
                // What is reported at the instant of the last line may stand behind it, where the recorder has ended.
                let excused = now.since(self.since) <= self.tolerance || now + self.tolerance >= self.ends;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal_map::{Direction, Kind, RateClass};
    use crate::value::Unit;

    fn signal() -> Signal {
        Signal {
            name: "x".to_owned(),
            ty: "DINT".parse().expect("a type"),
            direction: Direction::Report,
            kind: Kind::Edge,
            rate: RateClass::HighFrequency,
            unit: Unit::ONE,
            min: None,
            max: None,
            instance: String::new(),
            task: String::new(),
            property: String::new(),
        }
    }

    /// Runs a model and a recording, each given by its changes (milliseconds, value) from 0, in steps of 1 ms.
    fn compare(recorded: &[(i64, i32)], model: &[(i64, i32)], tolerance_ms: u64, ends_ms: i64) -> EdgeReport {
        let at = |ms: i64| Instant::from_nanos(ms * 1_000_000);
        let mut track = EdgeTrack::new(RegisterId(0), Duration::from_millis(tolerance_ms), at(ends_ms));
        let mut registers = [Value::Dint(0)];
        for ms in 0..=ends_ms {
            if let Some((_, value)) = model.iter().find(|edge| edge.0 == ms) {
                registers[0] = Value::Dint(*value);
            }
            track.model(at(ms), &registers);
            if ms == 0 {
                track.recorded(at(0), &Value::Dint(0), &registers);
            }
            if let Some((_, value)) = recorded.iter().find(|edge| edge.0 == ms) {
                track.recorded(at(ms), &Value::Dint(*value), &registers);
            }
        }
        track.finish(&signal()).expect("it was recorded")
    }

    /// Matched, early, late, missing, extra, brief.
    fn check(recorded: &[(i64, i32)], model: &[(i64, i32)], tolerance_ms: u64, expect: [u64; 6]) {
        let report = compare(recorded, model, tolerance_ms, 9_000);
        let found = [report.matched, report.early, report.late, report.missing, report.extra, report.brief];
        assert_eq!(found, expect, "{recorded:?} {model:?} {tolerance_ms}");
    }

    #[test]
    fn edges_are_paired_by_value_and_time() {
        let box_passes = [(1000, 1), (2000, 0)];
        check(&box_passes, &box_passes, 0, [2, 0, 0, 0, 0, 0]);
        check(&box_passes, &[(999, 1), (2003, 0)], 0, [0, 1, 1, 0, 0, 0]);
        check(&box_passes, &[(999, 1), (2003, 0)], 3, [2, 0, 0, 0, 0, 0]);
        check(&box_passes, &[], 0, [0, 0, 0, 2, 0, 0]);
        check(&[], &box_passes, 0, [0, 0, 0, 0, 2, 0]);
        // A box that only the model has, just before, does not make the others early.
        check(&box_passes, &[(600, 1), (700, 0), (1000, 1), (2000, 0)], 0, [2, 0, 0, 0, 2, 0]);
        // One that the model lacks does not make the others late.
        check(&[(600, 1), (700, 0), (1000, 1), (2000, 0)], &box_passes, 0, [2, 0, 0, 2, 0, 0]);
        // Two seconds apart they are two edges.
        check(&[(1000, 1)], &[(3500, 1)], 0, [0, 0, 0, 1, 1, 0]);
        check(&[(1000, 1)], &[(3500, 1)], 3000, [1, 0, 0, 0, 0, 0]);
        // Codes: the value counts, not only the time.
        check(&[(1000, 2), (1500, 1)], &[(1000, 3), (1500, 1)], 0, [1, 0, 0, 1, 1, 0]);
    }

    #[test]
    fn a_state_that_ends_within_the_tolerance_may_go_unrecorded() {
        // A drive that reverses stands still for 2 ms; a PLC that looks every 20 ms does not see it.
        check(&[(1000, 1), (2010, -1)], &[(990, 1), (1995, 0), (1997, -1)], 20, [2, 0, 0, 0, 0, 1]);
        check(&[(1000, 1)], &[(990, 1), (2000, 0), (2002, 1)], 20, [1, 0, 0, 0, 0, 1]);
        check(&[(1000, 1)], &[(990, 1), (2000, 0), (2030, 1)], 20, [1, 0, 0, 0, 2, 0]);
        check(&[(1000, 1)], &[(1000, 1), (2000, 0), (2001, 1)], 0, [1, 0, 0, 0, 2, 0]);
        // What was recorded happened, however brief it was.
        check(&[(1000, 1), (1001, 0)], &[], 20, [0, 0, 0, 2, 0, 0]);
    }

    #[test]
    fn what_could_have_its_counterpart_outside_the_trace_is_no_difference() {
        let at_the_end = |tolerance_ms| {
            let late = compare(&[], &[(8_990, 1)], tolerance_ms, 9_000);
            let early = compare(&[(8_990, 1)], &[], tolerance_ms, 9_000);
            (late.extra, early.missing)
        };
        assert_eq!(at_the_end(0), (1, 1));
        assert_eq!(at_the_end(20), (0, 0));
        // At the very last instant: the model's answer to the last line was not recorded any more, what was recorded was so.
        assert_eq!(compare(&[], &[(9_000, 1)], 0, 9_000).extra, 0);
        assert_eq!(compare(&[(9_000, 1)], &[], 0, 9_000).missing, 1);
        // A state that the model never had, from the first report on.
        check(&[(0, 1)], &[], 0, [0, 0, 0, 1, 0, 0]);
        check(&[(0, 1)], &[(3, 1)], 0, [0, 0, 1, 0, 0, 0]);
    }

    #[test]
    fn a_signal_that_never_rests_is_paired_as_it_goes() {
        let flicker: Vec<_> = (1..900).map(|i| (i * 10, (i % 2) as i32)).collect();
        let late: Vec<_> = flicker.iter().map(|(at, value)| (at + 2, *value)).collect();
        check(&flicker, &flicker, 0, [899, 0, 0, 0, 0, 0]);
        check(&flicker, &late, 0, [0, 0, 899, 0, 0, 0]);
        check(&flicker, &late, 2, [899, 0, 0, 0, 0, 0]);
    }
}
