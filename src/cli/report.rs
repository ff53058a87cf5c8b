//! The summary of a run in words.

use std::fmt::Write as _;

use super::words::counted;
use crate::run::{Quantiles, Summary};

/// Some lines about `summary`, for people.
pub fn text(summary: &Summary) -> String {
    let s = summary;
    let mut out = format!("{}: {}\n", s.model, extent(s.instances, s.signals, s.prototypes));
    let mut line = |name: &str, what: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  {name:<11} {what}");
    };
    line("time", format!("{} s simulated in {} s", s.sim_s, s.wall_s));
    line("steps", format!("{} of {} ms, {} overruns, {} late", s.steps, s.step_s * 1e3, s.overruns, s.late_steps));
    line("computing", quantiles(&s.step_us));
    line("round trip", quantiles(&s.round_trip_us));
    let sessions = match (&s.refused, s.sessions) {
        (Some(refusal), _) => format!("refused for good with {refusal}"),
        (None, 0) => "never stood".to_owned(),
        (None, 1) => "stood".to_owned(),
        (None, more) => format!("stood {more} times, lost {}", more - 1),
    };
    line("session", sessions);
    line("messages", format!("{} in, {} out, {} lost", s.messages_in, s.messages_out, s.messages_lost));
    line("values", format!("{} in, {} out", s.values_in, s.values_out));
    line(
        "boxes",
        format!("{} in, {} out, {} lost, {} collisions", s.parts_in, s.parts_out, s.parts_lost, s.collisions),
    );
    if s.pallets_in > 0 {
        line("pallets", format!("{} in, {} out", s.pallets_in, s.pallets_out));
    }
    line("state", s.state_hash.clone());
    if let Some(file) = &s.recorded {
        line("recorded", file.clone());
    }
    out
}

/// How large a model is, in words.
pub fn extent(instances: usize, signals: usize, prototypes: usize) -> String {
    [
        counted(instances, "instance", "instances"),
        counted(signals, "signal", "signals"),
        counted(prototypes, "prototype", "prototypes"),
    ]
    .join(", ")
}

fn quantiles(quantiles: &Quantiles) -> String {
    let Quantiles { count, p50: Some(p50), p99: Some(p99), p999: Some(p999), max: Some(max) } = quantiles else {
        return "not measured".to_owned();
    };
    format!("p50 {p50} µs, p99 {p99} µs, p99.9 {p999} µs, max {max} µs, of {count}")
}
