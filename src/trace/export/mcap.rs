//! A channel for each signal, its messages `{"value":…}` as JSON, so that any viewer of MCAP files can plot them.

use std::collections::{BTreeMap, HashMap};
use std::io::{BufRead, Write};

use mcap::records::MessageHeader;
use mcap::write::NoSeek;
use mcap::{WriteOptions, Writer};

use crate::signal_map::SignalMap;
use crate::trace::{Body, Reader, Sender};
use crate::wire::{Message, Raw, Shape};

use super::{ExportError, Exported};

/// Writes a trace as an MCAP file and gives the writer back. Log and publish times are the trace's, in nanoseconds. A
/// channel's metadata hold its sender (`from`), and what the model's map says of it (`type`, `unit`).
pub fn mcap<R: BufRead, W: Write>(
    reader: Reader<R>,
    map: Option<&SignalMap>,
    out: W,
) -> Result<(W, Exported), ExportError> {
    mcap_with(reader, map, out, |_| Ok(()))
}

/// Writes a trace as [`mcap()`] does; `more` adds channels of its own behind the signals.
pub fn mcap_with<R: BufRead, W: Write>(
    mut reader: Reader<R>,
    map: Option<&SignalMap>,
    out: W,
    more: impl FnOnce(&mut Writer<NoSeek<W>>) -> Result<(), ExportError>,
) -> Result<(W, Exported), ExportError> {
    let options = WriteOptions::new().disable_seeking(true).library(concat!("kinetwin ", env!("CARGO_PKG_VERSION")));
    let mut channels = Channels { writer: options.create(NoSeek::new(out))?, map, known: HashMap::new() };
    let mut exported = Exported::default();
    let mut body = String::new();
    while let Some(line) = reader.next_line()? {
        let Body::Message(Message::SendValue(entries)) = &line.body else {
            exported.skipped += 1;
            continue;
        };
        for entry in entries {
            let (Some(name), Some(value)) = (entry.name.as_deref(), entry.value) else { continue };
            let (channel_id, sequence) = channels.of(name, line.from, value)?;
            body.clear();
            body.push_str("{\"value\":");
            body.push_str(value.text());
            body.push('}');
            // A trace's times are never negative.
            let time = line.at.nanos().unsigned_abs();
            let header = MessageHeader { channel_id, sequence, log_time: time, publish_time: time };
            channels.writer.write_to_known_channel(&header, body.as_bytes())?;
            exported.rows += 1;
        }
    }
    more(&mut channels.writer)?;
    channels.writer.finish()?;
    let mut out = channels.writer.into_inner().into_inner();
    out.flush().map_err(ExportError::Write)?;
    Ok((out, exported))
}

struct Channels<'a, W: Write> {
    writer: Writer<NoSeek<W>>,
    map: Option<&'a SignalMap>,
    /// The channel of a signal, and how many messages it has.
    known: HashMap<(String, Sender), (u16, u32)>,
}

impl<W: Write> Channels<'_, W> {
    /// The channel of a signal, and the number of its next message.
    fn of(&mut self, name: &str, from: Sender, value: Raw<'_>) -> Result<(u16, u32), ExportError> {
        if let Some((channel, messages)) = self.known.get_mut(&(name.to_owned(), from)) {
            *messages += 1;
            return Ok((*channel, *messages));
        }
        let ty = match value.shape() {
            Shape::Bool => "boolean",
            Shape::Number => "number",
            Shape::String => "string",
            Shape::Array => "array",
            _ => "object",
        };
        let schema = format!(r#"{{"type":"object","properties":{{"value":{{"type":"{ty}"}}}}}}"#);
        let schema = self.writer.add_schema(&format!("kinetwin.{ty}"), "jsonschema", schema.as_bytes())?;
        let mut metadata = BTreeMap::from([("from".to_owned(), from.name().to_owned())]);
        if let Some(signal) = self.map.and_then(|map| Some(map.signal(map.register(name)?))) {
            metadata.insert("type".to_owned(), signal.ty.to_string());
            metadata.insert("unit".to_owned(), signal.unit.to_string());
        }
        let channel = self.writer.add_channel(schema, name, "json", &metadata)?;
        self.known.insert((name.to_owned(), from), (channel, 0));
        Ok((channel, 0))
    }
}
