//! When a device alone is looked at.
//!
//! States whose changes are known to the millisecond are not looked at a thousand times a second: nothing is seen at an instant
//! at which nothing has changed. One look then stands for all instants since the one before; where it finds anything changed,
//! the device is brought back and looked at one instant after the other.

use std::sync::Arc;

use super::alone::{SAME_S, Watch};
use super::subject::Run;
use super::track::Track;

/// Over how long one look may stand for others, s.
const LEAP_S: f64 = 0.02;

/// All looks of a run.
pub(super) struct Looks<'a> {
    streams: Vec<Stream<'a>>,
    /// The ports of speeds: one that passes 0 may have brought a state there and back.
    speeds: Vec<usize>,
    /// Until when every instant is looked at, s.
    slowly: f64,
    /// How many instants one look may stand for now.
    stride: usize,
    /// Whether the look that is next stands for others.
    leaps: bool,
}

/// Signals that are looked at at the same instants.
struct Stream<'a> {
    track: &'a Track,
    lead: f64,
    tick: f64,
    /// The next instant of the grid, and when it is looked at, s; infinite behind the last.
    next: usize,
    due: f64,
    /// How many instants one look may ever stand for while something may change.
    longest: usize,
    /// Whether it is of levels, which are looked at at every instant.
    is_of_levels: bool,
    /// Their places among the watches, and the first instant of each.
    signals: Vec<(usize, usize)>,
}

impl Stream<'_> {
    fn instant(&self, index: usize) -> Option<f64> {
        let at = *self.track.grid.instants.get(index)?;
        let at = if self.tick > 0.0 { (at / self.tick).round() * self.tick } else { at };
        Some((at + self.lead).max(0.0))
    }

    /// From now on that one is next.
    fn go_on_at(&mut self, next: usize) {
        self.next = next;
        self.due = self.instant(next).unwrap_or(f64::INFINITY);
    }

    /// The last instant before `until`, if it is the next one or behind it.
    fn last_before(&self, until: f64) -> Option<f64> {
        let instants = &self.track.grid.instants;
        let after = |index: &usize| self.instant(*index).is_none_or(|at| at >= until);
        let (mut low, mut high) = (self.next, instants.len());
        while low < high {
            let middle = low.midpoint(high);
            if after(&middle) { high = middle } else { low = middle + 1 }
        }
        (low > self.next).then(|| self.instant(low - 1)).flatten()
    }

    /// The last of the next `stride` instants that does not lie behind `bound`; the next one at least.
    fn last(&self, stride: usize, bound: f64) -> usize {
        let (mut last, most) = (self.next, self.next + stride.min(self.longest));
        while last + 1 < most && self.instant(last + 1).is_some_and(|at| at < bound) {
            last += 1;
        }
        last
    }
}

impl<'a> Looks<'a> {
    pub fn new(run: &Run, watches: &[Watch<'a>]) -> Looks<'a> {
        let mut streams: Vec<Stream<'a>> = Vec::new();
        for (signal, watch) in watches.iter().enumerate() {
            let Some(track) = watch.track else { continue };
            let same =
                |stream: &&mut Stream<'a>| Arc::ptr_eq(&stream.track.grid, &track.grid) && stream.lead == watch.lead;
            let of_edges = (LEAP_S / track.grid.cycle.max(1e-6)).round().max(1.0) as usize;
            let is_of_levels = !watch.is_edge();
            let longest = if is_of_levels { 1 } else { of_edges };
            match streams.iter_mut().find(same) {
                Some(stream) => {
                    stream.signals.push((signal, track.first));
                    stream.next = stream.next.min(track.first);
                    stream.longest = stream.longest.min(longest);
                    stream.is_of_levels |= is_of_levels;
                }
                None => {
                    let (lead, tick, signals) = (watch.lead, run.sample_tick, vec![(signal, track.first)]);
                    let (next, due) = (track.first, f64::INFINITY);
                    streams.push(Stream { track, lead, tick, next, due, longest, is_of_levels, signals });
                }
            }
        }
        streams.iter_mut().for_each(|stream| stream.go_on_at(stream.next));
        let speeds = watches.iter().filter(|watch| watch.track.is_some() && watch.is_speed);
        let speeds = speeds.map(|watch| watch.port).collect();
        Looks { streams, speeds, slowly: 0.0, stride: 1, leaps: false }
    }

    /// Whether states alone are looked at: then nothing is there to be seen while none changes.
    pub fn are_of_states(&self) -> bool {
        !self.streams.iter().any(|stream| stream.is_of_levels)
    }

    /// When the device is looked at next, `due` being the next command's instant and no state changing before `quiet`; `None` where there is
    /// nothing left to see.
    pub fn next(&mut self, due: Option<f64>, quiet: f64) -> Option<f64> {
        let next = self.streams.iter().map(|stream| stream.due).fold(f64::INFINITY, f64::min);
        if next == f64::INFINITY {
            return None;
        }
        self.leaps = false;
        if next >= self.slowly && quiet > next + SAME_S && self.are_of_states() {
            let until = due.map_or(quiet, |due| quiet.min(due - SAME_S));
            let last = self.streams.iter().filter_map(|stream| stream.last_before(until)).max_by(f64::total_cmp);
            if let Some(last) = last.filter(|last| *last > next + SAME_S) {
                self.leaps = true;
                return Some(last);
            }
        }
        if self.stride == 1 || next < self.slowly {
            return Some(next);
        }
        let single = self.streams.iter().filter(|stream| stream.is_of_levels).map(|stream| stream.due + SAME_S);
        let bound = single.chain(due.map(|due| due - SAME_S)).fold(f64::INFINITY, f64::min);
        let last = |stream: &Stream<'_>| stream.instant(stream.last(self.stride, bound));
        let leapt = self.streams.iter().filter_map(last).min_by(f64::total_cmp)?;
        self.leaps = leapt > next + SAME_S;
        Some(leapt)
    }

    /// Whether the look that is next stands for others.
    pub fn leaps(&self) -> bool {
        self.leaps
    }

    /// Which way each speed goes from 0.
    pub fn signs(&self, reports: &[f64]) -> u64 {
        let bit = |(place, port): (usize, &usize)| u64::from(reports[*port] < 0.0) << (place % 64);
        self.speeds.iter().enumerate().map(bit).fold(0, |bits, bit| bits | bit)
    }

    /// Something has changed before `at`: until then every instant is looked at.
    pub fn go_slowly_until(&mut self, at: f64) {
        self.slowly = at + SAME_S;
    }

    /// The device was looked at: gives every signal that is due its index, the first of those that the look stands for.
    pub fn taken(&mut self, at: f64, mut see: impl FnMut(usize, usize)) {
        for stream in &mut self.streams {
            let first = stream.next;
            while stream.due <= at + SAME_S {
                stream.go_on_at(stream.next + 1);
                if stream.is_of_levels {
                    break;
                }
            }
            if stream.next > first {
                let seen = stream.signals.iter().filter(|(_, own)| *own < stream.next);
                seen.for_each(|(signal, own)| see(*signal, first.max(*own)));
            }
        }
        self.stride = if at < self.slowly { 1 } else { (2 * self.stride).min(64) };
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;
    use std::sync::Arc;

    use crate::device::KINDS;
    use crate::gap::{Overrides, Predicted, Recording, Study, Subject};
    use crate::plant::{self, EffectPlace, EffectSpec, ParameterValue, embedded::Embedded};
    use crate::signal_map::Kind;
    use crate::trace::Reader;

    const HEADER: &str = r#"{"trace":"kinetwin/1","source":"simulation","step_ns":1000000}"#;

    /// The rig's belt, told a new speed each second, ahead and back; it reports each 20 ms, its states to the millisecond.
    fn belt() -> Subject {
        let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
        let mut text = format!("{HEADER}\n");
        for (second, speed) in [0.5, -0.5, 0.3, 0.002, -0.7, 0.0, 0.9, -0.9].into_iter().enumerate() {
            let told = format!(
                r#"{{"name":"Belt.velocityTarget","value":{}}},{{"name":"Belt.motorDirection","value":{}}}"#,
                f64::abs(speed),
                if speed < 0.0 { -1 } else { 1 }
            );
            text += &format!("{{\"t\":{}.0005,\"from\":\"automation\",\"SendValue\":[{told}]}}\n", second);
            for look in 1..=50 {
                let at = second as f64 + 0.02 * f64::from(look);
                let reports = [("velocityActual", "0.0"), ("driveRunning", "false"), ("directionalActual", "0")];
                let reports = reports.map(|(name, value)| format!("{{\"name\":\"Belt.{name}\",\"value\":{value}}}"));
                text += &format!("{{\"t\":{at:.3},\"from\":\"plant\",\"SendValue\":[{}]}}\n", reports.join(","));
            }
        }
        let reader = Reader::new("belt", Cursor::new(text.into_bytes())).expect("a trace");
        let recording = Recording::read(&plant, "belt", reader, &[]).expect("a recording");
        Study::new(&plant, &[recording]).expect("a study").subject("Belt").expect("the belt").clone()
    }

    /// A belt that reverses stands still for four milliseconds.
    #[test]
    fn a_look_that_stands_for_others_misses_nothing() {
        let leaping = belt();
        let mut slow = leaping.clone();
        let run = &mut slow.runs[0];
        let edges = slow.signals.iter().position(|info| info.kind == Kind::Edge).expect("a state");
        let grid = run.tracks.iter().flatten().find(|track| track.values.is_empty()).expect("a state").grid.clone();
        for track in run.tracks.iter_mut().flatten() {
            track.grid = Arc::clone(&grid);
        }
        let [fast, every] = [&leaping, &slow].map(|of| of.predict(&[], &Overrides::none()).expect("a belt").runs);
        let mut found = 0;
        for (fast, every) in fast[0].iter().zip(&every[0]).skip(edges) {
            let (Predicted::Edges { edges: fast, .. }, Predicted::Edges { edges: every, .. }) = (fast, every) else {
                continue;
            };
            let each = |edges: &[crate::gap::PredictedEdge]| edges.iter().map(|e| (e.index, e.to)).collect::<Vec<_>>();
            assert_eq!(each(fast), each(every));
            assert!(fast.iter().zip(every).all(|(a, b)| (a.at - b.at).abs() < 1e-8), "{fast:?} {every:?}");
            found += fast.len();
        }
        assert!(found > 15, "{found}");
    }

    /// A study of the rig's gripper, whose one report is a state; it grips, blows and waits. `chatters`: it is told what it was told already every
    /// 10 ms, so that no while is quiet.
    fn gripper(chatters: bool) -> Study {
        let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
        let acts =
            [(0.31, true, false), (1.9, false, false), (2.0, true, false), (6.4, true, true), (6.5, false, false)];
        let mut lines: Vec<(f64, String)> = Vec::new();
        let (mut told, mut next) = ((false, false), 0);
        for step in 0..900 {
            let at = 0.01 * f64::from(step) + 0.00005;
            let is_news = acts.get(next).is_some_and(|act| act.0 <= at);
            if is_news {
                told = (acts[next].1, acts[next].2);
                next += 1;
            }
            if is_news || chatters {
                let (suction, blow) = told;
                lines.push((at, format!(r#""automation","SendValue":[{{"name":"Gripper.suctionOn","value":{suction}}},{{"name":"Gripper.blowOn","value":{blow}}}]"#)));
            }
        }
        for (at, vacuum) in [(0.0, false), (0.47, true), (1.99, false), (2.16, true), (6.41, false), (8.9, true)] {
            lines.push((at, format!(r#""plant","SendValue":[{{"name":"Gripper.vacuumOn","value":{vacuum}}}]"#)));
        }
        lines.sort_by(|a, b| a.0.total_cmp(&b.0));
        let each = lines.iter().map(|(at, line)| format!("{{\"t\":{at:.5},\"from\":{line}}}\n"));
        let text = format!("{HEADER}\n{}", each.collect::<String>());
        let reader = Reader::new("gripper", Cursor::new(text.into_bytes())).expect("a trace");
        let recording = Recording::read(&plant, "gripper", reader, &[]).expect("a recording");
        Study::new(&plant, &[recording]).expect("a study")
    }

    #[test]
    fn a_look_over_a_quiet_while_misses_nothing() {
        let (quiet, chatters) = (gripper(false), gripper(true));
        for time in [0.0, 0.02, 0.3, 2.0] {
            let late = EffectSpec {
                kind: "on-delay".to_owned(),
                place: EffectPlace::Sensor,
                component: Some("vacuumOn".to_owned()),
                parameters: [("time".to_owned(), ParameterValue::Number(time))].into_iter().collect(),
            };
            let edges = |study: &Study| {
                let gripper = study.subject("Gripper").expect("the gripper");
                let runs = gripper.predict(std::slice::from_ref(&late), &Overrides::none()).expect("a gripper").runs;
                let Predicted::Edges { edges, .. } = &runs[0][0] else { panic!("{runs:?}") };
                edges.iter().map(|edge| (edge.index, edge.to, edge.at)).collect::<Vec<_>>()
            };
            let (found, expected) = (edges(&quiet), edges(&chatters));
            assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
            assert!(found.len() >= 2, "{found:?}");
            let is_same =
                |(a, b): (&(usize, f64, f64), &(usize, f64, f64))| (a.0, a.1) == (b.0, b.1) && (a.2 - b.2).abs() < 3e-7;
            assert!(found.iter().zip(&expected).all(is_same), "{found:?} {expected:?}");
        }
    }

    #[test]
    fn a_fit_is_given_the_same_residuals_as_a_score_holds() {
        let mut belt = belt();
        for run in &mut belt.runs {
            run.tracks.iter_mut().flatten().for_each(|track| track.blind = vec![(70, 90), (20, 40), (30, 45)]);
        }
        let predicted = belt.predict(&[], &Overrides::none()).expect("a belt");
        let residuals = belt.residuals(&predicted);
        assert!(residuals.len() > 300, "{}", residuals.len());
        assert_eq!(residuals, belt.score(&predicted).residuals());
    }
}
