//! A span of a trace as a trace of its own.

use std::collections::HashMap;
use std::io::{self, BufRead, Write};
use std::time::Duration;

use crate::time::{Instant, format_duration};
use crate::wire::{Entry, Message};

use super::header::Header;
use super::reader::{Body, Reader, Sender, TraceError};
use super::writer::{Compression, Writer};

/// What to keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    pub from: Instant,
    /// The last instant kept.
    pub to: Instant,
    /// How much before `from` is kept too, so that a model can settle.
    pub warm_up: Duration,
}

/// Why a trace could not be cut.
#[derive(Debug, thiserror::Error)]
pub enum CutError {
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error("failed to write the cut")]
    Write(#[source] io::Error),
    /// The span is empty.
    #[error("nothing to cut: from {from} to {to} is no span")]
    Empty { from: Instant, to: Instant },
    /// The trace has no line in the span.
    #[error("nothing to cut: the trace has no line from {from} to {to}; its last is at {ends}")]
    Outside { from: Instant, to: Instant, ends: Instant },
}

/// Copies `span` of a trace. Lines keep their times: t = 0 is still the start of the recording.
///
/// The last value that each signal had before the span stands in two lines at its start, one of the automation's and one
/// of the plant's, with the time of the last line left out: so the cut knows of every signal what the whole knew.
pub fn cut<R: BufRead, W: Write>(
    mut reader: Reader<R>,
    out: W,
    compression: Compression,
    span: Span,
) -> Result<W, CutError> {
    if span.from > span.to {
        return Err(CutError::Empty { from: span.from, to: span.to });
    }
    let begin = (span.from - span.warm_up).max(Instant::ZERO);
    let mut writer = Writer::new(out, compression, &header(reader.header(), span)).map_err(CutError::Write)?;
    let mut before = Some(Before::default());
    let mut kept = 0u64;
    let (mut left, mut ends) = (Instant::ZERO, Instant::ZERO);
    while let Some(line) = reader.next_line()? {
        ends = line.at;
        if line.at > span.to {
            break;
        }
        if line.at < begin {
            left = line.at;
            if let (Some(before), Body::Message(Message::SendValue(entries))) = (&mut before, &line.body) {
                before.keep(line.from, entries);
            }
            continue;
        }
        if let Some(before) = before.take() {
            before.write(&mut writer, left).map_err(CutError::Write)?;
        }
        kept += u64::from(line.at >= span.from);
        writer.line(line.at, line.text).map_err(CutError::Write)?;
    }
    if kept == 0 {
        return Err(CutError::Outside { from: span.from, to: span.to, ends });
    }
    writer.finish().map_err(CutError::Write)
}

fn header(whole: &Header, span: Span) -> Header {
    let seconds = |at: Instant| format_duration(at.since(Instant::ZERO));
    let warm_up = match span.warm_up {
        Duration::ZERO => String::new(),
        warm_up => format!(" with {} before it", format_duration(warm_up)),
    };
    let cut = format!("cut from {} to {}{warm_up}", seconds(span.from), seconds(span.to));
    let note = whole.note.as_ref().map_or(cut.clone(), |note| format!("{note}; {cut}"));
    Header { note: Some(note), ..whole.clone() }
}

/// The last values before a span, as the JSON text they had.
#[derive(Default)]
struct Before {
    values: Vec<(Sender, String, String)>,
    places: HashMap<(Sender, String), usize>,
}

impl Before {
    fn keep(&mut self, from: Sender, entries: &[Entry<'_>]) {
        for entry in entries {
            let (Some(name), Some(value)) = (&entry.name, entry.value) else { continue };
            let key = (from, name.to_string());
            match self.places.get(&key) {
                Some(place) => self.values[*place].2 = value.text().to_owned(),
                None => {
                    self.places.insert(key, self.values.len());
                    self.values.push((from, name.to_string(), value.text().to_owned()));
                }
            }
        }
    }

    fn write<W: Write>(&self, writer: &mut Writer<W>, at: Instant) -> io::Result<()> {
        for sender in [Sender::Automation, Sender::Plant] {
            let mut text = String::new();
            for (_, name, value) in self.values.iter().filter(|(from, ..)| *from == sender) {
                text.push_str(if text.is_empty() { "{\"SendValue\":[" } else { "," });
                text.push_str("{\"name\":");
                text.push_str(&serde_json::to_string(name)?);
                text.push_str(",\"value\":");
                text.push_str(value);
                text.push('}');
            }
            if !text.is_empty() {
                text.push_str("]}");
                writer.message(at, sender, &text)?;
            }
        }
        Ok(())
    }
}
