//! What a run came to.

use std::collections::BTreeMap;

use hdrhistogram::Histogram;
use serde::Serialize;
use serde_json::json;

use super::Facts;
use crate::adapter::{Event, Traffic};
use crate::engine::{Incident, IncidentKind, PartCounts};
use crate::pace::{Simulation, Timing};
use crate::session::{ClientEvent, Ending};
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;

/// The end of a run, in the words of `run --json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The model, as it was named.
    pub model: String,
    pub instances: usize,
    pub signals: usize,
    /// Prototypes in use.
    pub prototypes: usize,
    pub seed: u64,
    /// The engine's step.
    pub step_s: f64,
    /// Steps made.
    pub steps: u64,
    /// Steps whose computation took longer than the step.
    pub overruns: u64,
    /// Steps that the operating system began more than a step late.
    pub late_steps: u64,
    /// Time on the wall clock, from the first step to the end of the last.
    pub wall_s: f64,
    /// Simulated time.
    pub sim_s: f64,
    /// Sessions that stood: 1 where none was lost.
    pub sessions: u64,
    /// `SendValue` messages taken in.
    pub messages_in: u64,
    /// `SendValue` messages sent.
    pub messages_out: u64,
    /// `SendValue` messages that could not be kept until they were wanted.
    pub messages_lost: u64,
    /// Values accepted.
    pub values_in: u64,
    /// Values sent.
    pub values_out: u64,
    /// Boxes that came in; pallets are counted apart.
    pub parts_in: u64,
    /// Boxes that went out.
    pub parts_out: u64,
    /// Boxes that came in, did not go out, and are not there.
    pub parts_lost: u64,
    pub pallets_in: u64,
    pub pallets_out: u64,
    /// Times that two parts, a part and a body, or two bodies came to be inside one another.
    pub collisions: u64,
    /// The first of them, at most 16.
    pub first_collisions: Vec<CollisionReport>,
    /// The engine's whole state at the end, as a hash in hexadecimal digits: equal runs have equal hashes.
    pub state_hash: String,
    /// From a value that the automation sends to the simulation's answer to it, microseconds; null where it cannot be
    /// measured.
    pub round_trip_us: Quantiles,
    /// The computing time of a step, microseconds of processor time.
    pub step_us: Quantiles,
    /// Why the server refused the session for good.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
    /// Which side did not accept what the other showed of itself, a certificate or a token, and what to do about it; the
    /// run ended for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub denied: Option<String>,
    /// The file that was recorded to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recorded: Option<String>,
}

/// A collision, as it stands in a summary and in a trace.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CollisionReport {
    /// The end of the step in which the two came to be in one another, s.
    pub t: f64,
    pub between: [String; 2],
    pub depth_m: f64,
    /// Where the first of the two was.
    pub place_m: [f64; 3],
    /// The signals of the instances involved at that moment, as they are on the wire.
    pub signals: BTreeMap<String, serde_json::Value>,
}

impl CollisionReport {
    /// Of an incident, if it is a collision.
    pub(super) fn of(incident: &Incident, signal_map: &SignalMap) -> Option<CollisionReport> {
        let IncidentKind::Collision { between, depth, place, .. } = &incident.kind else { return None };
        let said = |(register, value): &(RegisterId, Value)| {
            let value = match value {
                Value::Bool(is) => json!(is),
                other => json!(other.to_f64()),
            };
            (signal_map.signal(*register).name.clone(), value)
        };
        Some(CollisionReport {
            t: incident.at.seconds(),
            between: between.clone(),
            depth_m: *depth,
            place_m: *place,
            signals: incident.signals.iter().map(said).collect(),
        })
    }
}

/// What the simulation came to.
pub(super) struct Simulated {
    timing: Timing,
    counts: PartCounts,
    collisions: u64,
    first_collisions: Vec<Incident>,
    state_hash: u64,
    /// Where its time ended.
    now: Instant,
    wall_s: f64,
}

impl Simulated {
    /// Of a simulation that took until `wall` on a clock that started with it.
    pub fn of(simulation: &Simulation, wall: Instant) -> Simulated {
        let engine = simulation.engine();
        Simulated {
            timing: simulation.timing().clone(),
            counts: engine.counts(),
            collisions: engine.collisions(),
            first_collisions: simulation.collisions().to_vec(),
            state_hash: engine.state_hash(),
            now: engine.now(),
            wall_s: wall.seconds(),
        }
    }
}

/// What the exchange with the automation came to.
#[derive(Clone, Debug, Default)]
pub(super) struct Spoken {
    pub traffic: Traffic,
    sessions: u64,
    refused: Option<String>,
    denied: Option<String>,
}

impl Spoken {
    /// Counts what happened.
    pub fn take(&mut self, event: &Event) {
        match event {
            Event::Session(ClientEvent::Established { .. }) => self.sessions += 1,
            Event::Session(ClientEvent::Ended(Ending::Refused { result, message })) => {
                let said = message.as_deref().map(|message| format!(": {message}")).unwrap_or_default();
                self.refused = Some(format!("{result}{said}"));
            }
            // Once a session stood, a server that shows another certificate may yet show the right one again.
            Event::Denied(why) if self.sessions == 0 => self.denied = Some(why.clone()),
            _ => {}
        }
    }

    /// Whether the run can as well end: no session will ever stand.
    pub fn is_denied(&self) -> bool {
        self.denied.is_some()
    }
}

impl Summary {
    /// Puts together what the parts of a run came to.
    pub(super) fn new(
        facts: &Facts,
        simulated: &Simulated,
        spoken: &Spoken,
        round_trip_us: Quantiles,
        recorded: Option<String>,
    ) -> Summary {
        let Simulated { timing, counts, .. } = simulated;
        let Traffic { messages_in, messages_out, messages_lost, values_in, values_out } = spoken.traffic;
        Summary {
            model: facts.model.clone(),
            instances: facts.plant.instances.len(),
            signals: facts.plant.signal_map.signals().len(),
            prototypes: facts.prototypes(),
            seed: facts.seed,
            step_s: facts.step.as_secs_f64(),
            steps: timing.steps,
            overruns: timing.overruns,
            late_steps: timing.late_steps,
            wall_s: (simulated.wall_s * 1e3).round() / 1e3,
            sim_s: simulated.now.seconds(),
            sessions: spoken.sessions,
            messages_in,
            messages_out,
            messages_lost,
            values_in,
            values_out,
            parts_in: counts.boxes_in,
            parts_out: counts.boxes_out,
            parts_lost: counts.boxes_lost,
            pallets_in: counts.pallets_in,
            pallets_out: counts.pallets_out,
            collisions: simulated.collisions,
            first_collisions: simulated
                .first_collisions
                .iter()
                .filter_map(|incident| CollisionReport::of(incident, &facts.plant.signal_map))
                .collect(),
            state_hash: format!("{:016x}", simulated.state_hash),
            round_trip_us,
            step_us: Quantiles::of_ns(&timing.computing_ns),
            refused: spoken.refused.clone(),
            denied: spoken.denied.clone(),
            recorded,
        }
    }
}

/// A distribution in four numbers, microseconds, and how many it was made of; all four `None` where nothing was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Quantiles {
    /// How many were measured. Of a few, the far quantiles are only the longest.
    pub count: u64,
    pub p50: Option<f64>,
    pub p99: Option<f64>,
    pub p999: Option<f64>,
    pub max: Option<f64>,
}

impl Quantiles {
    /// Of a histogram in nanoseconds.
    pub fn of_ns(histogram: &Histogram<u64>) -> Quantiles {
        if histogram.is_empty() {
            return Quantiles::default();
        }
        let us = |ns: u64| Some((ns as f64 / 100.0).round() / 10.0);
        Quantiles {
            count: histogram.len(),
            p50: us(histogram.value_at_quantile(0.5)),
            p99: us(histogram.value_at_quantile(0.99)),
            p999: us(histogram.value_at_quantile(0.999)),
            max: us(histogram.max()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_microseconds_and_null_where_nothing_was_measured() {
        let mut histogram = Histogram::new_with_bounds(1, 1_000_000_000, 3).expect("bounds");
        let none = serde_json::to_string(&Quantiles::of_ns(&histogram)).expect("JSON");
        assert_eq!(none, r#"{"count":0,"p50":null,"p99":null,"p999":null,"max":null}"#);
        for us in 1..=100 {
            histogram.record(us * 1000).expect("in bounds");
        }
        let quantiles = Quantiles::of_ns(&histogram);
        assert!(quantiles.p50.is_some_and(|us| (us - 50.0).abs() < 0.1), "{quantiles:?}");
        assert_eq!(quantiles.count, 100);
        assert!(quantiles.max.is_some_and(|us| (us - 100.0).abs() < 0.1), "{quantiles:?}");
    }
}
