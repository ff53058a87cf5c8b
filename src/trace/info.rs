//! What stands in a trace, counted.

use std::collections::BTreeMap;
use std::fmt;
use std::io::BufRead;

use serde::Serialize;

use crate::time::Instant;
use crate::wire::Message;

use super::header::{Header, Source};
use super::reader::{Body, Reader, Sender, TraceError};

/// What stands in a trace.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Info {
    pub header: Header,
    /// Lines, the header not counted.
    pub lines: u64,
    /// Lines by sender.
    pub senders: BTreeMap<&'static str, u64>,
    /// Lines by message; `Refused` for those that were none, `Event` for events.
    pub messages: BTreeMap<&'static str, u64>,
    /// The time of the first line, in seconds; 0 if there is none.
    pub begins_s: f64,
    /// The time of the last line, in seconds; 0 if there is none.
    pub ends_s: f64,
    /// The signals that stand in it, by name.
    pub signals: BTreeMap<String, SignalInfo>,
    /// What was left out of a torn last line.
    pub torn: Option<String>,
    /// The time of the last line.
    #[serde(skip)]
    pub ends: Instant,
}

/// How often a signal stands in a trace.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct SignalInfo {
    /// In lines of the automation's.
    pub commands: u64,
    /// In lines of the plant's.
    pub reports: u64,
}

/// Reads a whole trace and counts. Every line is checked on the way: what this accepts, reads.
pub fn info<R: BufRead>(mut reader: Reader<R>) -> Result<Info, TraceError> {
    let mut info = Info {
        header: reader.header().clone(),
        lines: 0,
        senders: BTreeMap::new(),
        messages: BTreeMap::new(),
        begins_s: 0.0,
        ends_s: 0.0,
        signals: BTreeMap::new(),
        torn: None,
        ends: Instant::ZERO,
    };
    while let Some(line) = reader.next_line()? {
        if info.lines == 0 {
            info.begins_s = line.at.seconds();
        }
        info.lines += 1;
        info.ends = line.at;
        *info.senders.entry(line.from.name()).or_default() += 1;
        let message = match &line.body {
            Body::Message(message) => message.name(),
            Body::Refused { .. } => "Refused",
            Body::Event(_) => "Event",
        };
        *info.messages.entry(message).or_default() += 1;
        if let Body::Message(Message::SendValue(entries)) = &line.body {
            for name in entries.iter().filter_map(|entry| entry.name.as_deref()) {
                count(&mut info.signals, name, line.from);
            }
        }
    }
    info.ends_s = info.ends.seconds();
    info.torn = reader.torn().map(ToString::to_string);
    Ok(info)
}

fn count(signals: &mut BTreeMap<String, SignalInfo>, name: &str, from: Sender) {
    if !signals.contains_key(name) {
        signals.insert(name.to_owned(), SignalInfo::default());
    }
    if let Some(signal) = signals.get_mut(name) {
        match from {
            Sender::Automation => signal.commands += 1,
            _ => signal.reports += 1,
        }
    }
}

impl fmt::Display for Info {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let header = &self.header;
        let source = match header.source {
            Source::Plant => "a real machine",
            Source::Simulation => "a simulation",
            Source::Unknown => "not said",
        };
        let field = |f: &mut fmt::Formatter<'_>, name: &str, value: &str| writeln!(f, "{name:<11}{value}");
        field(f, "source", source)?;
        for (name, value) in [("model", &header.model), ("start", &header.start), ("note", &header.note)] {
            if let Some(value) = value {
                field(f, name, value)?;
            }
        }
        if let Some(step) = header.step_ns {
            field(f, "step", &format!("{} ms", step as f64 / 1e6))?;
        }
        if let Some(seed) = header.seed {
            field(f, "seed", &seed.to_string())?;
        }
        field(f, "time", &format!("{} s to {} s", self.begins_s, self.ends_s))?;
        let counts = |counts: &BTreeMap<&str, u64>| {
            counts.iter().map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
        };
        field(f, "lines", &format!("{}: {}", self.lines, counts(&self.senders)))?;
        field(f, "messages", &counts(&self.messages))?;
        if let Some(torn) = &self.torn {
            field(f, "torn", torn)?;
        }
        let wide = self.signals.keys().map(|name| name.chars().count()).max().unwrap_or(0).max(10);
        if !self.signals.is_empty() {
            writeln!(f, "\n{:wide$}  {:>9}  {:>9}", "signal", "commands", "reports")?;
        }
        for (name, signal) in &self.signals {
            writeln!(f, "{name:wide$}  {:>9}  {:>9}", signal.commands, signal.reports)?;
        }
        Ok(())
    }
}
