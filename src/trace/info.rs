//! What stands in a trace, counted and measured.

use std::collections::BTreeMap;
use std::io::BufRead;

use serde::Serialize;

use crate::time::Instant;
use crate::wire::{Message, Raw, Shape};

use super::header::Header;
use super::reader::{Body, Reader, Sender, TraceError};
use super::rhythm::Rhythm;

/// A plant that says nothing for longer than this, and for much longer than it is wont to, is silent.
const SILENCE_NS: u64 = 2_000_000_000;
/// How many of its usual intervals that must be.
const SILENT_INTERVALS: u64 = 20;

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
    /// The median time between two lines of the plant's, in seconds; `None` of fewer than two.
    pub interval_s: Option<f64>,
    /// Spans in which the plant said nothing: nothing changed, or nothing was recorded.
    pub silences: Vec<Silence>,
    /// The signals that stand in it, by name.
    pub signals: BTreeMap<String, SignalInfo>,
    /// What was left out of a torn last line.
    pub torn: Option<String>,
    /// The time of the last line.
    #[serde(skip)]
    pub ends: Instant,
}

/// A span without a line of the plant's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Silence {
    pub from_s: f64,
    pub to_s: f64,
}

/// How often a signal stands in a trace, and what values it has.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SignalInfo {
    /// In lines of the automation's.
    pub commands: u64,
    /// In lines of the plant's.
    pub reports: u64,
    /// The median time between two of its values, in seconds; `None` of fewer than two.
    pub interval_s: Option<f64>,
    /// How often its value was another than before.
    pub changes: u64,
    /// Of a number: its least and greatest value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Whether it is a truth value.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_boolean: bool,
    /// Of a truth value: how often it became true.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rising: Option<u64>,
    /// And how often false.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub falling: Option<u64>,
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
        interval_s: None,
        silences: Vec::new(),
        signals: BTreeMap::new(),
        torn: None,
        ends: Instant::ZERO,
    };
    let mut signals: BTreeMap<String, Signal> = BTreeMap::new();
    let mut plant = Rhythm::default();
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
        let Body::Message(Message::SendValue(entries)) = &line.body else { continue };
        if line.from == Sender::Plant {
            plant.beat(line.at);
        }
        for entry in entries {
            let (Some(name), Some(value)) = (entry.name.as_deref(), entry.value) else { continue };
            if !signals.contains_key(name) {
                signals.insert(name.to_owned(), Signal::default());
            }
            if let Some(signal) = signals.get_mut(name) {
                signal.take(line.at, line.from, value);
            }
        }
    }
    info.ends_s = info.ends.seconds();
    info.interval_s = plant.median_s();
    info.silences = plant.pauses(SILENCE_NS, SILENT_INTERVALS).map(|(from_s, to_s)| Silence { from_s, to_s }).collect();
    info.signals = signals.into_iter().map(|(name, signal)| (name, signal.info())).collect();
    info.torn = reader.torn().map(ToString::to_string);
    Ok(info)
}

/// A signal as it is being counted.
#[derive(Default)]
struct Signal {
    info: SignalInfo,
    rhythm: Rhythm,
    last: Option<String>,
}

impl Signal {
    fn take(&mut self, at: Instant, from: Sender, value: Raw<'_>) {
        match from {
            Sender::Automation => self.info.commands += 1,
            _ => self.info.reports += 1,
        }
        self.rhythm.beat(at);
        if let Some(number) = value.as_number().and_then(|text| text.parse::<f64>().ok()) {
            let [least, greatest] = self.info.range.get_or_insert([number, number]);
            *least = least.min(number);
            *greatest = greatest.max(number);
        }
        self.info.is_boolean |= value.shape() == Shape::Bool;
        if self.last.as_deref() == Some(value.text()) {
            return;
        }
        // The first value is no change.
        if self.last.is_some() {
            self.info.changes += 1;
            match value.as_bool() {
                Some(true) => *self.info.rising.get_or_insert(0) += 1,
                Some(false) => *self.info.falling.get_or_insert(0) += 1,
                None => {}
            }
        }
        self.last = Some(value.text().to_owned());
    }

    fn info(self) -> SignalInfo {
        SignalInfo { interval_s: self.rhythm.median_s(), ..self.info }
    }
}
