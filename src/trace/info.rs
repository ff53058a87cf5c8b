//! What stands in a trace, counted.

use std::collections::BTreeMap;
use std::io::BufRead;

use serde::Serialize;

use crate::time::Instant;
use crate::wire::Message;

use super::header::Header;
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
