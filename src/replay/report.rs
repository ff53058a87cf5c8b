//! What a replay found, for people and for programs.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use crate::engine::Engine;
use crate::signal_map::{Direction, SignalMap};
use crate::time::format_duration;
use crate::value::Unit;

use super::{Survey, Tolerances};

/// What a replay found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The plant's name.
    pub model: String,
    /// Whether any signal differs beyond the tolerances.
    pub differs: bool,
    /// The signals that do.
    pub differing: Vec<String>,
    /// The engine's state at the end: 16 hexadecimal digits, equal if and only if all bits of the state are.
    pub state_hash: String,
    /// The engine's ticks.
    pub steps: u64,
    /// The engine's step, in seconds.
    pub step_s: f64,
    /// The time of the trace's last line, in seconds.
    pub ends_s: f64,
    /// Lines of the trace.
    pub lines: u64,
    /// What counted as no difference: for edges, in seconds.
    pub edge_tolerance_s: f64,
    /// What counted as no difference: for levels, in each signal's unit.
    pub level_tolerance: f64,
    pub levels: Vec<LevelReport>,
    pub edges: Vec<EdgeReport>,
    /// Signals of the trace that were left out, each with the reason.
    pub ignored: BTreeMap<String, String>,
    /// The model's reports that the trace never has.
    pub unrecorded: Vec<String>,
    /// What else was left out, and how often.
    pub notices: BTreeMap<String, u64>,
    /// What was lost with a torn last line.
    pub torn: Option<String>,
}

/// How one level differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LevelReport {
    pub name: String,
    /// The unit of the differences.
    pub unit: &'static str,
    /// At how many reports it was compared.
    pub compared: u64,
    pub largest: f64,
    /// When the largest difference was, in seconds.
    pub largest_at_s: f64,
    pub rms: f64,
    /// How many of the comparisons were made because the recording was silent for too long.
    pub silent: u64,
    pub differs: bool,
}

/// How the edges of one signal differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EdgeReport {
    pub name: String,
    /// Edges of both, within the tolerance.
    pub matched: u64,
    /// Edges of both, the model's too early.
    pub early: u64,
    /// Edges of both, the model's too late.
    pub late: u64,
    /// Edges that were recorded and that the model does not make.
    pub missing: u64,
    /// Edges that the model makes and that were not recorded.
    pub extra: u64,
    /// States that only the model had, and left again within the tolerance: no difference, and no recording that looks
    /// once in that time can tell.
    pub brief: u64,
    /// The largest time between two edges of a pair, in seconds.
    pub largest_s: f64,
    /// When the first difference beyond the tolerance was, in seconds.
    pub first_at_s: Option<f64>,
    pub differs: bool,
}

/// What was left out, each text once with how often. A trace of one kind of fault does not fill the memory.
#[derive(Debug, Default)]
pub(super) struct Notices(BTreeMap<String, u64>);

impl Notices {
    const MOST: usize = 100;

    pub fn add(&mut self, text: String) {
        let text = match self.0.len() < Notices::MOST || self.0.contains_key(&text) {
            true => text,
            false => "more of this kind".to_owned(),
        };
        *self.0.entry(text).or_default() += 1;
    }
}

impl Report {
    pub(super) fn new(
        engine: &Engine,
        map: &SignalMap,
        survey: &Survey,
        tolerances: &Tolerances,
        (levels, edges): (Vec<LevelReport>, Vec<EdgeReport>),
        notices: Notices,
    ) -> Report {
        let differing: Vec<_> = levels.iter().filter(|level| level.differs).map(|level| level.name.clone()).collect();
        let differing_edges = edges.iter().filter(|edge| edge.differs).map(|edge| edge.name.clone());
        let differing: Vec<_> = differing.into_iter().chain(differing_edges).collect();
        let is_recorded =
            |name: &str| levels.iter().any(|level| level.name == name) || edges.iter().any(|edge| edge.name == name);
        let reports = map.directed(Direction::Report).map(|(_, signal)| &signal.name);
        Report {
            model: map.plant().to_owned(),
            differs: !differing.is_empty(),
            differing,
            state_hash: format!("{:016x}", engine.state_hash()),
            steps: engine.steps(),
            step_s: engine.step().as_secs_f64(),
            ends_s: survey.ends().seconds(),
            lines: survey.lines(),
            edge_tolerance_s: tolerances.edge.as_secs_f64(),
            level_tolerance: tolerances.level,
            unrecorded: reports.filter(|name| !is_recorded(name)).cloned().collect(),
            levels,
            edges,
            ignored: survey.ignored().clone(),
            notices: notices.0,
            torn: survey.torn().map(ToOwned::to_owned),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let step = format_duration(std::time::Duration::from_secs_f64(self.step_s));
        writeln!(f, "{}: {} lines, {} s, {} steps of {step} or less", self.model, self.lines, self.ends_s, self.steps)?;
        let names = self.levels.iter().map(|level| &level.name).chain(self.edges.iter().map(|edge| &edge.name));
        let wide = names.map(|name| name.chars().count()).max().unwrap_or(0).max(24);
        self.write_levels(f, wide)?;
        self.write_edges(f, wide)?;
        self.write_remarks(f)?;
        writeln!(f, "\nstate {} at the end", self.state_hash)?;
        self.write_verdict(f)
    }
}

impl Report {
    fn write_levels(&self, f: &mut fmt::Formatter<'_>, wide: usize) -> fmt::Result {
        if self.levels.is_empty() {
            return Ok(());
        }
        writeln!(f, "\n  {:wide$}  {:>8}  {:>12}  {:>12}  {:>10}", "level", "compared", "largest", "RMS", "at")?;
        for level in &self.levels {
            let mark = if level.differs { '!' } else { ' ' };
            let at = if level.largest > 0.0 { format!("{:.3} s", level.largest_at_s) } else { String::new() };
            let unit = if level.unit == Unit::ONE.symbol { "" } else { level.unit };
            let [largest, rms] =
                [level.largest, level.rms].map(|number| format!("{} {unit}", short(number)).trim_end().to_owned());
            writeln!(f, "{mark} {:wide$}  {:>8}  {largest:>12}  {rms:>12}  {at:>10}", level.name, level.compared)?;
        }
        Ok(())
    }

    fn write_edges(&self, f: &mut fmt::Formatter<'_>, wide: usize) -> fmt::Result {
        if self.edges.is_empty() {
            return Ok(());
        }
        let titles = ["matched", "early", "late", "missing", "extra"].map(|title| format!("{title:>7}")).join("  ");
        writeln!(f, "\n  {:wide$}  {titles}  {:>9}  {:>10}", "edge", "largest", "first at")?;
        for edge in &self.edges {
            let mark = if edge.differs { '!' } else { ' ' };
            let counts = [edge.matched, edge.early, edge.late, edge.missing, edge.extra];
            let counts = counts.map(|count| format!("{count:>7}")).join("  ");
            let largest = format!("{:.1} ms", edge.largest_s * 1e3);
            let first = edge.first_at_s.map_or(String::new(), |at| format!("{at:.3} s"));
            writeln!(f, "{mark} {:wide$}  {counts}  {largest:>9}  {first:>10}", edge.name)?;
        }
        Ok(())
    }

    fn write_remarks(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let heading = [self.ignored.is_empty(), self.notices.is_empty(), self.unrecorded.is_empty()];
        if heading != [true; 3] || self.torn.is_some() {
            writeln!(f)?;
        }
        for (name, reason) in &self.ignored {
            writeln!(f, "left out: {name}: {reason}")?;
        }
        for (notice, times) in &self.notices {
            let times = if *times > 1 { format!(" ({times} times)") } else { String::new() };
            writeln!(f, "{notice}{times}")?;
        }
        if !self.unrecorded.is_empty() {
            let listed = &self.unrecorded[..self.unrecorded.len().min(LISTED)];
            let more = match self.unrecorded.len() - listed.len() {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            writeln!(f, "not in the trace: {}{more}", listed.join(", "))?;
        }
        if let Some(torn) = &self.torn {
            writeln!(f, "{torn}")?;
        }
        Ok(())
    }

    fn write_verdict(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let edge = format_duration(std::time::Duration::from_secs_f64(self.edge_tolerance_s));
        let within = format!("edges within {edge}, levels within {}", short(self.level_tolerance));
        match (self.differing.len(), self.levels.is_empty() && self.edges.is_empty()) {
            (_, true) => writeln!(f, "nothing to compare: the trace reports no signal of this model"),
            (0, _) => writeln!(f, "the model reports what was recorded ({within})"),
            (count, _) => {
                let total = self.levels.len() + self.edges.len();
                writeln!(f, "{count} of {total} signals differ ({within}): {}", self.differing.join(", "))
            }
        }
    }
}

/// How many signals are listed that the trace never has.
const LISTED: usize = 8;

/// A number in four digits, for a table.
fn short(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e6).contains(&size) => {
            let decimals = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
            let text = format!("{number:.decimals$}");
            match text.contains('.') {
                true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
                false => text,
            }
        }
        _ => format!("{number:.3e}"),
    }
}
