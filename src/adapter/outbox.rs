//! From the register bank to messages: every edge at once and in order, levels when they are due.

use crate::bank::{Changes, IoSide, Overrun};
use crate::signal_map::{RateClass, RegisterId};
use crate::time::Instant;
use crate::value::Value;

/// One message's worth of reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report<'a> {
    /// The simulated time of the step that produced them.
    pub at: Instant,
    pub values: &'a [(RegisterId, Value)],
}

/// Which levels are due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Due {
    pub high: bool,
    pub low: bool,
}

/// What the session has been told.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Told {
    /// No session stands.
    #[default]
    Nothing,
    /// A session stands, and must first hear all present values.
    AllDue,
    /// It hears of changes.
    Changes,
}

/// Turns what the simulation published into messages.
#[derive(Debug, Default)]
pub struct Outbox {
    told: Told,
    groups: Vec<Changes>,
    values: Vec<(RegisterId, Value)>,
}

impl Outbox {
    /// A session stands: the next message holds all present values.
    pub fn start(&mut self) {
        self.told = Told::AllDue;
    }

    /// No session stands.
    pub fn stop(&mut self) {
        self.told = Told::Nothing;
    }

    /// Gives to `emit` all edges since the last call, one message for each step, and the levels that are `due`; in the
    /// order of time. Levels of a step whose edges stand in the last message join it: they changed together. Without a
    /// session all of it is dropped: the first message of the next makes up for it.
    ///
    /// Gives the instant of the cycle that was reached, `None` while nothing was published.
    ///
    /// # Errors
    /// Edges were lost; those before the hole were given to `emit`. Go on with a new session.
    pub fn collect(
        &mut self,
        bank: &mut IoSide,
        due: Due,
        mut emit: impl FnMut(Report<'_>),
    ) -> Result<Option<Instant>, Overrun> {
        let cycle = bank.changed(&mut self.groups);
        let all = self.told == Told::AllDue;
        self.values.clear();
        if cycle.is_ok() && (due.high || all) {
            bank.levels(RateClass::HighFrequency, &mut self.values);
        }
        if cycle.is_ok() && (due.low || all) {
            bank.levels(RateClass::LowFrequency, &mut self.values);
        }
        if self.told != Told::Changes {
            self.groups.clear();
            self.values.clear();
        }
        let mut groups = self.groups.drain(..).peekable();
        while let Some(mut group) = groups.next() {
            if groups.peek().is_none() && cycle == Ok(Some(group.at)) {
                group.values.append(&mut self.values);
            }
            emit(Report { at: group.at, values: &group.values });
        }
        drop(groups);
        let Some(at) = cycle? else { return Ok(None) };
        if all {
            self.values.extend(bank.snapshot().iter().flat_map(|snapshot| snapshot.iter()));
            self.told = Told::Changes;
        }
        if !self.values.is_empty() {
            emit(Report { at, values: &self.values });
        }
        Ok(Some(at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bank::{self, SimulationSide};
    use crate::signal_map::{Direction, Kind, Signal, SignalMap};
    use crate::value::{ElementaryType, SignalType, Unit};

    fn signal(name: &str, element: ElementaryType, kind: Kind, rate: RateClass) -> Signal {
        Signal {
            name: name.to_owned(),
            ty: SignalType::scalar(element),
            direction: Direction::Report,
            kind,
            rate,
            unit: Unit::ONE,
            min: None,
            max: None,
            instance: "Belt".to_owned(),
            task: "Drive".to_owned(),
            property: name.to_owned(),
        }
    }

    /// An edge (register 0), a high-frequency level (1) and a low-frequency level (2).
    fn bench() -> (SimulationSide, IoSide, Outbox) {
        let map = SignalMap::new(
            "test",
            vec![
                signal("barrier", ElementaryType::Bool, Kind::Edge, RateClass::HighFrequency),
                signal("speed", ElementaryType::Real, Kind::Level, RateClass::HighFrequency),
                signal("count", ElementaryType::Dint, Kind::Level, RateClass::LowFrequency),
            ],
        );
        let (simulation, io) = bank::new(&map.expect("three names"));
        (simulation, io, Outbox::default())
    }

    fn publish(simulation: &mut SimulationSide, ms: i64, barrier: bool, speed: f32, count: i32) {
        let now = Instant::from_nanos(ms * 1_000_000);
        simulation.publish(now, &[Value::Bool(barrier), Value::Real(speed), Value::Dint(count)]);
    }

    /// What the outbox gives, as `ms: register=value …`.
    fn check(outbox: &mut Outbox, io: &mut IoSide, (high, low): (bool, bool), expect: &[&str]) {
        let mut given = Vec::new();
        let collected = outbox.collect(io, Due { high, low }, |report| {
            let values: Vec<String> = report.values.iter().map(|(id, value)| format!("{}={value}", id.0)).collect();
            given.push(format!("{}: {}", report.at.nanos() / 1_000_000, values.join(" ")));
        });
        assert!(collected.is_ok(), "{collected:?}");
        assert_eq!(given, expect);
    }

    #[test]
    fn a_session_begins_with_all_present_values_and_goes_on_with_changes() {
        let (mut simulation, mut io, mut outbox) = bench();
        outbox.start();
        check(&mut outbox, &mut io, (true, true), &[]);
        publish(&mut simulation, 0, false, 0.0, 0);
        check(&mut outbox, &mut io, (false, false), &["0: 0=false 1=0 2=0"]);
        check(&mut outbox, &mut io, (true, true), &[]);
        publish(&mut simulation, 1, true, 0.5, 1);
        check(&mut outbox, &mut io, (false, false), &["1: 0=true"]);
        check(&mut outbox, &mut io, (true, false), &["1: 1=0.5"]);
        check(&mut outbox, &mut io, (true, true), &["1: 2=1"]);
    }

    #[test]
    fn a_flash_within_an_interval_is_two_messages_and_levels_join_the_last() {
        let (mut simulation, mut io, mut outbox) = bench();
        outbox.start();
        publish(&mut simulation, 0, false, 0.0, 0);
        check(&mut outbox, &mut io, (true, true), &["0: 0=false 1=0 2=0"]);
        publish(&mut simulation, 1, true, 0.1, 0);
        publish(&mut simulation, 2, false, 0.2, 0);
        check(&mut outbox, &mut io, (true, true), &["1: 0=true", "2: 0=false 1=0.2"]);
    }

    #[test]
    fn what_changes_without_a_session_is_told_by_the_first_message_of_the_next() {
        let (mut simulation, mut io, mut outbox) = bench();
        publish(&mut simulation, 0, false, 0.0, 0);
        check(&mut outbox, &mut io, (true, false), &[]);
        publish(&mut simulation, 1, true, 0.1, 0);
        publish(&mut simulation, 2, true, 0.2, 7);
        check(&mut outbox, &mut io, (true, false), &[]);
        outbox.start();
        check(&mut outbox, &mut io, (false, false), &["2: 0=true 1=0.2 2=7"]);
        // What the first message held is not said again.
        check(&mut outbox, &mut io, (true, true), &[]);
        outbox.stop();
        publish(&mut simulation, 3, false, 0.2, 7);
        check(&mut outbox, &mut io, (true, true), &[]);
    }
}
