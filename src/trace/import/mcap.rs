//! MCAP files whose messages are JSON. A member of a message is a column: `TOPIC.member`, `TOPIC.member.inner`, and of an
//! array `TOPIC.member[0]`. A message that is a value, or an object with `value` alone, is a column called `TOPIC`.

use std::collections::{BTreeMap, VecDeque};
use std::io::{Read, Write};

use ::mcap::sans_io::LinearReaderOptions;
use serde_json::Value;

use crate::time::Instant;
use crate::trace::Writer;

use super::merge::{Imported, merge};
use super::names::{Names, Pick};
use super::{ImportError, Row, Rows, Settings};

/// Reads an MCAP file, its messages in the order of their log times, and writes what they hold as lines of a trace.
///
/// Without a model, a channel whose metadata say `from: automation`, as an export of ours has it, is one of commands.
/// Messages in other encodings than JSON are left out, and their topics told as columns that became nothing.
pub fn mcap<R: Read, W: Write>(
    file: &str,
    input: R,
    settings: &Settings,
    out: &mut Writer<W>,
) -> Result<Imported, ImportError> {
    let mut settings = settings.clone();
    let mut messages = read(file, input, &mut settings)?;
    let mut columns: Vec<String> = Vec::new();
    let mut known = BTreeMap::new();
    for (column, _) in messages.cells.iter().flat_map(|(_, cells)| cells) {
        if known.insert(column.clone(), ()).is_none() {
            columns.push(column.clone());
        }
    }
    let names = Names::resolve(&settings, &[(file.to_owned(), columns)])?;
    // Equal times keep the order of the file.
    messages.cells.sort_by_key(|(at, _)| *at);
    let rows = Sorted { file, cells: messages.cells.into(), names: &names, missing: &settings.missing, read: 0 };
    let mut imported = merge(vec![rows], &names, &settings, out)?;
    imported.unused.extend(messages.unread);
    Ok(imported)
}

/// A file that claims a longer record, or chunk, is broken: nobody logs so much at once.
const LONGEST_RECORD: usize = 1 << 30;

#[derive(Default)]
struct Messages {
    /// Each message's log time, and its columns with their texts.
    cells: Vec<(Instant, Vec<(String, String)>)>,
    /// Topics whose messages are not JSON.
    unread: Vec<String>,
}

fn read<R: Read>(file: &str, input: R, settings: &mut Settings) -> Result<Messages, ImportError> {
    let broken = |problem: String| ImportError::File { file: file.to_owned(), problem };
    let has_items = !settings.maps.is_empty();
    let mut messages = Messages::default();
    let options = LinearReaderOptions::default().with_record_length_limit(LONGEST_RECORD);
    for message in ::mcap::io::MessageReader::new_with_options(input, options) {
        let message = message.map_err(|error| broken(format!("no MCAP file that can be read: {error}")))?;
        let topic = &message.channel.topic;
        if message.channel.message_encoding != "json" {
            let told = format!("{topic} ({})", message.channel.message_encoding);
            if !messages.unread.contains(&told) {
                messages.unread.push(told);
            }
            continue;
        }
        let value: Value = serde_json::from_slice(&message.data)
            .map_err(|error| broken(format!("a message of {topic} at {} ns is no JSON: {error}", message.log_time)))?;
        let at = i64::try_from(message.log_time).map_err(|_| {
            broken(format!("a message of {topic} at {} ns: expected 292 years at most", message.log_time))
        })?;
        if message.channel.metadata.get("from").is_some_and(|from| from == "automation") {
            settings.signals.commands.insert(topic.clone());
        }
        let mut cells = Vec::new();
        match &value {
            Value::Object(members) if members.len() == 1 && members.contains_key("value") => {
                flatten(topic, &members["value"], has_items, &mut cells);
            }
            value => flatten(topic, value, has_items, &mut cells),
        }
        messages.cells.push((Instant::from_nanos(at), cells));
    }
    Ok(messages)
}

/// The values in `value`, by their paths; an array's items only where mappings may ask for them.
fn flatten(path: &str, value: &Value, has_items: bool, cells: &mut Vec<(String, String)>) {
    match value {
        Value::Null => {}
        Value::Object(members) => {
            members.iter().for_each(|(name, value)| flatten(&format!("{path}.{name}"), value, has_items, cells));
        }
        Value::Array(items) => {
            cells.push((path.to_owned(), value.to_string()));
            for (index, item) in items.iter().enumerate().filter(|_| has_items) {
                flatten(&format!("{path}[{index}]"), item, has_items, cells);
            }
        }
        // A text keeps its quotes, so that it is taken as it stands.
        other => cells.push((path.to_owned(), other.to_string())),
    }
}

struct Sorted<'a> {
    file: &'a str,
    cells: VecDeque<(Instant, Vec<(String, String)>)>,
    names: &'a Names,
    missing: &'a [String],
    read: u64,
}

impl Sorted<'_> {
    fn values(&self, cells: &[(String, String)]) -> Result<Vec<(usize, String)>, ImportError> {
        let mut values = Vec::new();
        for (column, text) in cells {
            let picks: Vec<Pick> = self.names.picks(self.file, column).collect();
            self.names.values(&picks, text, self.missing, &mut values).map_err(|problem| ImportError::File {
                file: self.file.to_owned(),
                problem: format!("message {}: column {column}: {problem}", self.read),
            })?;
        }
        Ok(values)
    }
}

impl Rows for Sorted<'_> {
    /// Messages of one time are one row, until a signal comes again.
    fn next_row(&mut self) -> Result<Option<Row>, ImportError> {
        let Some((at, cells)) = self.cells.pop_front() else { return Ok(None) };
        self.read += 1;
        let mut row = Row { at, values: self.values(&cells)? };
        while let Some((next, cells)) = self.cells.front()
            && *next == at
        {
            let more = self.values(cells)?;
            if more.iter().any(|(signal, _)| row.values.iter().any(|(known, _)| known == signal)) {
                break;
            }
            row.values.extend(more);
            self.cells.pop_front();
            self.read += 1;
        }
        Ok(Some(row))
    }

    fn place(&self) -> (&str, u64) {
        (self.file, self.read)
    }
}
