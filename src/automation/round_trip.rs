//! How long the loop takes: from a value that the automation sends to the simulation's answer to it.
//!
//! Some reports follow a command at once, in the step that takes it or the one after: `driveEnabled` is true while
//! `motorDirection` is not 0, `inverterReady` follows `enable`, `vacuumOn` falls with `blowOn`, `cartesianArrived` falls
//! with a new target, `isRunning` rises when a pusher sets out from its end. The time from sending such a command to receiving
//! such a report is the whole loop: encode, socket, decode, the wait for the next step, the step, encode, socket, decode.
//! Everything a plain session already exchanges; nothing is added to the protocol to measure it.

use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;

use hdrhistogram::Histogram;

use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;

/// A report that comes at once.
struct Law {
    /// The commands that it answers.
    commands: &'static [&'static str],
    report: &'static str,
    /// Reports of the same device that decide whether it comes.
    circumstances: &'static [&'static str],
    foretell: Foretell,
}

/// What the report is right after the command was taken; `None` if nothing can be told.
type Foretell = fn(&Change) -> Option<bool>;

/// A command that leaves.
struct Change<'a> {
    /// What was sent before, and what is sent now, in SI units.
    from: f64,
    to: f64,
    /// The law's circumstances as they were reported last.
    circumstances: &'a [bool],
}

const LAWS: &[Law] = &[
    Law {
        commands: &["motorDirection"],
        report: "driveEnabled",
        circumstances: &[],
        foretell: |change| Some(change.to != 0.0),
    },
    Law {
        commands: &["enable"],
        report: "inverterReady",
        circumstances: &[],
        foretell: |change| Some(change.to != 0.0),
    },
    Law {
        commands: &["blowOn"],
        report: "vacuumOn",
        circumstances: &[],
        foretell: |change| (change.to != 0.0).then_some(false),
    },
    Law {
        commands: &["XTarget", "YTarget", "ZTarget", "RTarget"],
        report: "cartesianArrived",
        circumstances: &[],
        foretell: |change| ((change.to - change.from).abs() > BEYOND_ARRIVED).then_some(false),
    },
    // A pusher sets out at its full speed, unless it stands where it is sent. That it stops says nothing: it also stops by itself.
    Law {
        commands: &["command"],
        report: "isRunning",
        circumstances: &["limitExtended", "limitRetracted"],
        foretell: |change| match (change.to, change.circumstances) {
            (1.0, [false, true]) | (2.0, [true, false]) => Some(true),
            _ => None,
        },
    },
];

/// A target so far, in m or rad, that the robot cannot have arrived there already, whatever its tolerance: ten times that of
/// our catalogue.
const BEYOND_ARRIVED: f64 = 0.005;

/// How many answers may be outstanding for one report; a plant that does not answer must not fill the memory.
const MOST_OUTSTANDING: usize = 64;

/// A report and the commands that it answers.
#[derive(Debug)]
struct Pair {
    /// With what was sent last, in SI units.
    commands: Vec<(RegisterId, f64)>,
    report: RegisterId,
    /// With what was reported last.
    circumstances: Vec<(RegisterId, bool)>,
    foretell: Foretell,
    /// What the report will be once everything sent was taken.
    expected: bool,
    outstanding: VecDeque<(Instant, bool)>,
}

impl Pair {
    /// The pair of this report, if the map has its signals.
    fn new(map: &SignalMap, instance: &str, law: &Law) -> Option<Pair> {
        let register = |property: &&str, direction| {
            let register = map.register(&format!("{instance}.{property}"))?;
            (map.signal(register).direction == direction).then_some(register)
        };
        let commands = law.commands.iter().filter_map(|name| Some((register(name, Direction::Command)?, 0.0)));
        let circumstances = law.circumstances.iter().map(|name| Some((register(name, Direction::Report)?, false)));
        Some(Pair {
            commands: commands.collect(),
            report: register(&law.report, Direction::Report)?,
            circumstances: circumstances.collect::<Option<_>>()?,
            foretell: law.foretell,
            expected: false,
            outstanding: VecDeque::new(),
        })
        .filter(|pair| !pair.commands.is_empty())
    }

    fn sent(&mut self, now: Instant, register: RegisterId, to: f64) {
        let Some((_, from)) = self.commands.iter_mut().find(|(command, _)| *command == register) else { return };
        let from = std::mem::replace(from, to);
        let circumstances: Vec<bool> = self.circumstances.iter().map(|(_, is)| *is).collect();
        let Some(expected) = (self.foretell)(&Change { from, to, circumstances: &circumstances }) else { return };
        if expected != self.expected && self.outstanding.len() < MOST_OUTSTANDING {
            self.expected = expected;
            self.outstanding.push_back((now, expected));
        }
    }

    /// When the command was sent that this report answers; `None` if it answers none.
    fn received(&mut self, register: RegisterId, is: bool) -> Option<Instant> {
        if let Some((_, circumstance)) = self.circumstances.iter_mut().find(|(report, _)| *report == register) {
            *circumstance = is;
        }
        if register != self.report {
            return None;
        }
        match self.outstanding.pop_front() {
            Some((sent, expected)) if expected == is => Some(sent),
            // It moved for another reason, as vacuum does: what is outstanding answers nothing any more.
            _ => {
                self.outstanding.clear();
                self.expected = is;
                None
            }
        }
    }
}

/// Measures round trips from what is sent and received.
#[derive(Debug)]
pub struct RoundTrip {
    map: Arc<SignalMap>,
    pairs: Vec<Pair>,
    /// Nanoseconds.
    histogram: Histogram<u64>,
}

impl RoundTrip {
    /// Measures by the pairs that `map` has.
    pub fn new(map: Arc<SignalMap>) -> RoundTrip {
        let instances: BTreeSet<&str> = map.signals().iter().map(|signal| signal.instance.as_str()).collect();
        let pairs = instances.iter().flat_map(|instance| LAWS.iter().map(move |law| (instance, law)));
        let pairs = pairs.filter_map(|(instance, law)| Pair::new(&map, instance, law)).collect();
        RoundTrip { pairs, histogram: histogram(), map }
    }

    /// `values` left at `now`.
    pub fn sent(&mut self, now: Instant, values: &[(RegisterId, Value)]) {
        for (register, value) in values {
            let Some(value) = value.to_f64() else { continue };
            let si = value * self.map.signal(*register).unit.to_si;
            self.pairs.iter_mut().for_each(|pair| pair.sent(now, *register, si));
        }
    }

    /// `values` came in at `now`.
    pub fn received(&mut self, now: Instant, values: &[(RegisterId, Value)]) {
        for (register, value) in values {
            let Value::Bool(is) = value else { continue };
            for sent in self.pairs.iter_mut().filter_map(|pair| pair.received(*register, *is)) {
                let span = u64::try_from(now.since(sent).as_nanos()).unwrap_or(u64::MAX);
                self.histogram.saturating_record(span);
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
        let mut round_trip = RoundTrip::new(map.clone());
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

    #[test]
    fn a_robot_leaves_for_a_new_target_at_once() {
        check(
            &[
                (0, "Robot.cartesianArrived", 1.0),
                (10, "Robot.XTarget", 0.5),
                (10, "Robot.YTarget", 0.5),
                (12, "Robot.cartesianArrived", 0.0),
                // Under way; then it arrives by itself.
                (20, "Robot.YTarget", 0.2),
                (900, "Robot.cartesianArrived", 1.0),
                // Within its tolerance it does not leave.
                (910, "Robot.YTarget", 0.2001),
                (920, "Robot.RTarget", 1.0),
                (923, "Robot.cartesianArrived", 0.0),
            ],
            &[2, 3],
        );
    }

    #[test]
    fn a_pusher_sets_out_at_once_from_where_it_stands() {
        check(
            &[
                (0, "Pusher.limitRetracted", 1.0),
                // It stands where it is sent: no answer comes.
                (5, "Pusher.command", 2.0),
                (10, "Pusher.command", 1.0),
                (14, "Pusher.isRunning", 1.0),
                (20, "Pusher.limitRetracted", 0.0),
                (990, "Pusher.limitExtended", 1.0),
                (1000, "Pusher.isRunning", 0.0),
                (1010, "Pusher.command", 2.0),
                (1015, "Pusher.isRunning", 1.0),
                // Turned back in mid-way it runs on.
                (1020, "Pusher.limitExtended", 0.0),
                (1030, "Pusher.command", 1.0),
            ],
            &[4, 5],
        );
    }
}
