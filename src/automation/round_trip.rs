//! How long the loop takes: from a value that the automation sends to the simulation's answer to it.
//!
//! Some reports follow a command at once, in the step that takes it: `driveEnabled` is true while `motorDirection` is not
//! 0, `inverterReady` follows `enable`, `vacuumOn` falls with `blowOn`. The time from sending such a command to receiving
//! such a report is the whole loop: encode, socket, decode, the wait for the next step, the step, encode, socket, decode.
//! Everything a plain session already exchanges; nothing is added to the protocol to measure it.

use std::collections::VecDeque;

use hdrhistogram::Histogram;

use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;

/// What a report is right after the command was taken; `None` if nothing can be told.
type Foretell = fn(f64) -> Option<bool>;

/// Commands whose answer comes at once: command, report, and what the command makes of the report.
const LAWS: &[(&str, &str, Foretell)] = &[
    ("motorDirection", "driveEnabled", |direction| Some(direction != 0.0)),
    ("enable", "inverterReady", |enable| Some(enable != 0.0)),
    ("blowOn", "vacuumOn", |blow| (blow != 0.0).then_some(false)),
];

/// How many answers may be outstanding for one report; a plant that does not answer must not fill the memory.
const MOST_OUTSTANDING: usize = 64;

/// A command and the report that answers it.
#[derive(Debug)]
struct Pair {
    command: RegisterId,
    report: RegisterId,
    foretell: Foretell,
    /// What the report will be once everything sent was taken.
    expected: bool,
    outstanding: VecDeque<(Instant, bool)>,
}

/// Measures round trips from what is sent and received.
#[derive(Debug)]
pub struct RoundTrip {
    pairs: Vec<Pair>,
    /// Nanoseconds.
    histogram: Histogram<u64>,
}

impl RoundTrip {
    /// Measures by the pairs that `map` has.
    pub fn new(map: &SignalMap) -> RoundTrip {
        let mut pairs = Vec::new();
        for (command, signal) in map.directed(Direction::Command) {
            for (_, answer, foretell) in LAWS.iter().filter(|(command, ..)| *command == signal.property) {
                let report = map.register(&format!("{}.{answer}", signal.instance));
                if let Some(report) = report.filter(|report| map.signal(*report).direction == Direction::Report) {
                    let foretell = *foretell;
                    pairs.push(Pair { command, report, foretell, expected: false, outstanding: VecDeque::new() });
                }
            }
        }
        RoundTrip { pairs, histogram: histogram() }
    }

    /// `values` left at `now`.
    pub fn sent(&mut self, now: Instant, values: &[(RegisterId, Value)]) {
        for (register, value) in values {
            for pair in self.pairs.iter_mut().filter(|pair| pair.command == *register) {
                let Some(expected) = value.to_f64().and_then(pair.foretell) else { continue };
                if expected == pair.expected || pair.outstanding.len() == MOST_OUTSTANDING {
                    continue;
                }
                pair.expected = expected;
                pair.outstanding.push_back((now, expected));
            }
        }
    }

    /// `values` came in at `now`.
    pub fn received(&mut self, now: Instant, values: &[(RegisterId, Value)]) {
        for (register, value) in values {
            for pair in self.pairs.iter_mut().filter(|pair| pair.report == *register) {
                let is = *value == Value::Bool(true);
                match pair.outstanding.pop_front() {
                    Some((sent, expected)) if expected == is => {
                        let span = u64::try_from(now.since(sent).as_nanos()).unwrap_or(u64::MAX);
                        self.histogram.saturating_record(span);
                    }
                    // It moved for another reason, as vacuum does: what is outstanding answers nothing any more.
                    _ => {
                        pair.outstanding.clear();
                        pair.expected = is;
                    }
                }
            }
        }
    }

    /// The plant that was spoken with is gone: its answers will not come.
    pub fn forget(&mut self) {
        for pair in &mut self.pairs {
            pair.outstanding.clear();
        }
    }

    /// All round trips so far, in nanoseconds.
    pub fn histogram(&self) -> &Histogram<u64> {
        &self.histogram
    }
}

/// From 1 ns to a minute (longer counts as a minute) with three significant digits.
fn histogram() -> Histogram<u64> {
    Histogram::new_with_bounds(1, 60_000_000_000, 3).expect("the bounds are in order and the digits in 0..=5")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench;

    const MS: i64 = 1_000_000;

    fn check(exchange: &[(i64, &str, f64)], round_trips_ms: &[u64]) {
        let map = bench::rig();
        let mut round_trip = RoundTrip::new(&map);
        for &(ms, name, number) in exchange {
            let now = Instant::from_nanos(ms * MS);
            let values = bench::values(&map, &[(name, number)]);
            match map.signal(values[0].0).direction {
                Direction::Command => round_trip.sent(now, &values),
                Direction::Report => round_trip.received(now, &values),
            }
        }
        let measured: Vec<u64> =
            round_trip.histogram().iter_recorded().map(|bucket| bucket.value_iterated_to() / MS as u64).collect();
        assert_eq!(measured, round_trips_ms, "{exchange:?}");
    }

    #[test]
    fn the_answer_to_a_command_is_timed() {
        check(&[(10, "Belt.motorDirection", 1.0), (13, "Belt.driveEnabled", 1.0)], &[3]);
        check(&[(10, "Motor.enable", 1.0), (12, "Motor.inverterReady", 1.0)], &[2]);
        check(&[(0, "Gripper.suctionOn", 1.0), (200, "Gripper.vacuumOn", 1.0)], &[]);
    }

    #[test]
    fn blow_off_is_answered_by_a_lost_vacuum() {
        check(&[(0, "Gripper.vacuumOn", 1.0), (10, "Gripper.blowOn", 1.0), (15, "Gripper.vacuumOn", 0.0)], &[5]);
    }

    #[test]
    fn a_command_that_changes_no_report_is_not_waited_for() {
        check(
            &[
                (0, "Belt.motorDirection", 1.0),
                (1, "Belt.driveEnabled", 1.0),
                (5, "Belt.motorDirection", -1.0),
                (9, "Belt.motorDirection", 0.0),
                (11, "Belt.driveEnabled", 0.0),
            ],
            &[1, 2],
        );
    }

    #[test]
    fn answers_come_in_the_order_of_the_commands() {
        check(
            &[
                (0, "Belt.motorDirection", 1.0),
                (3, "Belt.motorDirection", 0.0),
                (4, "Belt.driveEnabled", 1.0),
                (10, "Belt.driveEnabled", 0.0),
            ],
            &[4, 7],
        );
    }
}
