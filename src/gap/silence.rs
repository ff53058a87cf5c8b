//! Silences: spans of a recording in which nobody recorded, and what that leaves of it.
//!
//! A sender of changes is silent while all rests. Where a position or a count is found far from where it was left, something moved
//! meanwhile and nobody wrote it down. Then nothing within counts, and no signal is known again before its next report. Where
//! the commands are missing too, nobody knows what the machine was told: the recording ends there, and what follows is one of its
//! own, which begins under way.

use super::recording::{Recording, Span, Stamped};
use super::statistics::quantile;
use crate::plant::Plant;
use crate::signal_map::{Direction, Kind, Signal, SignalMap};
use crate::value::{ElementaryType, Quantity, SignalType};

/// A silence shorter than this is not looked at, s.
const SILENCE_S: f64 = 2.0;
/// What a value jumps by across a silence, in its usual changes from one report to the next, if reports are missing.
const JUMP: f64 = 5.0;
/// A multiple of every tick that a machine may have, s.
const WHOLE_TICKS_S: f64 = 0.1;

/// Spans in which reports are missing.
pub(super) fn silences(map: &SignalMap, recording: &Recording) -> Vec<Span> {
    let mut stamps: Vec<f64> = recording.stamps.concat();
    stamps.sort_by(f64::total_cmp);
    let silent = stamps.windows(2).filter(|pair| pair[1] - pair[0] > SILENCE_S);
    let silent = silent.map(|pair| Span { from: pair[0], to: pair[1] });
    let goes_on = |signal: &Signal| {
        let is_count = signal.kind == Kind::Level && signal.ty != SignalType::scalar(ElementaryType::Real);
        let is_way = matches!(signal.unit.quantity, Quantity::Length | Quantity::Angle);
        signal.direction == Direction::Report && (is_way || is_count)
    };
    let ways = || map.signals().iter().zip(recording.by_register()).filter(|(signal, _)| goes_on(signal));
    silent.filter(|span| ways().any(|(_, values)| jumps(values, *span))).collect()
}

/// Whether a signal is found at the end of a silence far from where it was left.
fn jumps(values: &[Stamped], silence: Span) -> bool {
    let after = values.partition_point(|stamped| stamped.at < silence.to);
    let pair = after.checked_sub(1).and_then(|before| values.get(before).zip(values.get(after)));
    let Some((before, after)) = pair.filter(|(_, after)| after.at == silence.to) else { return false };
    let changes: Vec<f64> = values.windows(2).map(|pair| (pair[1].value - pair[0].value).abs()).collect();
    (after.value - before.value).abs() > JUMP * quantile(&changes, 0.95)
}

/// The parts of a recording between silences of both sides, each with times of its own from 0 on; the whole where there are none.
pub fn segments(plant: &Plant, recording: Recording) -> Vec<Recording> {
    let map = &plant.signal_map;
    // At its edges a recorder may have written one side and not the other.
    let is_told = |span: &&Span| {
        let edge = 0.1 * (span.to - span.from);
        let mut commands = map.directed(Direction::Command).flat_map(|(register, _)| recording.values(register));
        commands.any(|told| told.at > span.from + edge && told.at < span.to - edge)
    };
    let torn: Vec<Span> = recording.lost.iter().filter(|span| !is_told(span)).copied().collect();
    if torn.is_empty() {
        return vec![recording];
    }
    // A machine's ticks are whole multiples of theirs from the recording's start on: they stay so.
    let begins = |at: f64| (at / WHOLE_TICKS_S).floor() * WHOLE_TICKS_S;
    let froms = std::iter::once(0.0).chain(torn.iter().map(|span| begins(span.to)));
    let tos = torn.iter().map(|span| span.from).chain([recording.ends]);
    froms.zip(tos).map(|(from, to)| segment(map, &recording, Span { from, to })).collect()
}

/// What lies in a span.
fn segment(map: &SignalMap, whole: &Recording, span: Span) -> Recording {
    let Span { from, to } = span;
    let mut values: Vec<Vec<Stamped>> = vec![Vec::new(); map.signals().len()];
    for (register, _) in map.directed(Direction::Command) {
        values[register.index()] = told(whole.values(register), span);
    }
    for (register, _) in map.directed(Direction::Report) {
        values[register.index()] = within(whole.values(register), span).collect();
    }
    let shifted = |spans: &[Span]| {
        let here = spans.iter().filter(|other| other.to > from && other.from < to);
        here.map(|other| Span { from: other.from - from, to: other.to - from }).collect()
    };
    let mut segment = whole.clone();
    if from > 0.0 {
        segment.name = format!("{} from {from:.3} s on", whole.name);
    }
    segment.ends = to - from;
    (segment.blind, segment.lost) = (shifted(&whole.blind), shifted(&whole.lost));
    segment.resumes = whole.resumes || from > 0.0;
    segment.with_values(map, values)
}

/// The values of a span, by its own time.
fn within(values: &[Stamped], Span { from, to }: Span) -> impl Iterator<Item = Stamped> {
    let inside = values.iter().filter(move |stamped| stamped.at >= from && stamped.at <= to);
    inside.map(move |stamped| Stamped { at: stamped.at - from, ..*stamped })
}

/// Commands of a span: the last before it holds at its start.
fn told(values: &[Stamped], span: Span) -> Vec<Stamped> {
    let before = values.iter().rfind(|told| told.at < span.from);
    before.map(|told| Stamped { at: 0.0, ..*told }).into_iter().chain(within(values, span)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(from: f64, to: f64, speed: f64) -> Vec<Stamped> {
        let count = ((to - from) / 0.02) as i32;
        (0..count).map(|k| from + f64::from(k) * 0.02).map(|at| Stamped { at, value: speed * at }).collect()
    }

    #[test]
    fn reports_are_missing_where_a_position_jumps_across_a_silence() {
        let silence = Span { from: 1.98, to: 5.0 };
        let missed = [ramp(0.0, 2.0, 0.1), ramp(5.0, 8.0, 0.1)].concat();
        assert!(jumps(&missed, silence));
        let mut rested = ramp(0.0, 2.0, 0.1);
        rested.extend(ramp(0.0, 3.0, 0.1).into_iter().map(|s| Stamped { at: s.at + 5.0, value: s.value + 0.2 }));
        assert!(!jumps(&rested, silence));
    }

    #[test]
    fn what_was_told_last_before_a_span_holds_at_its_start() {
        let values = ramp(0.0, 10.0, 1.0);
        let told = told(&values, Span { from: 5.01, to: 6.0 });
        assert!(told[0].at == 0.0 && (told[0].value - 5.0).abs() < 1e-9);
        assert!((told[1].at - 0.01).abs() < 1e-9 && told.len() == 51);
    }
}
