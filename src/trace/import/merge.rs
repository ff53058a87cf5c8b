//! Rows of several sources, merged by time, become the lines of a trace.

use std::io::Write;

use serde::Serialize;

use crate::time::Instant;
use crate::trace::seconds::write_seconds;
use crate::trace::{Sender, Writer};

use super::names::Names;
use super::{ImportError, Row, Rows, Settings};

/// Later first times than this are no seconds since a start: a day, in nanoseconds.
const LATEST_START_NS: i64 = 86_400_000_000_000;

/// What an import has made.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Imported {
    /// Rows read, of all sources.
    pub rows: u64,
    /// Lines written.
    pub lines: u64,
    pub begins_s: f64,
    pub ends_s: f64,
    /// Signals that are commands, and those that are reports.
    pub commands: Vec<String>,
    pub reports: Vec<String>,
    /// Signals that were to be made and never had a value.
    pub empty: Vec<String>,
    /// Columns that became nothing.
    pub unused: Vec<String>,
}

/// A source and the row that is next.
struct Source<S> {
    rows: S,
    next: Option<Row>,
}

impl<S: Rows> Source<S> {
    fn take(&mut self) -> Result<Option<Row>, ImportError> {
        let row = self.next.take();
        self.next = self.rows.next_row()?;
        if let (Some(row), Some(next)) = (&row, &self.next)
            && next.at < row.at
        {
            let (file, line) = self.rows.place();
            let (before, after) = (exact(row.at), exact(next.at));
            let problem =
                format!("time goes back, from {before} s to {after} s: expected rows in the order of their times");
            return Err(ImportError::Line { file: file.to_owned(), line, problem });
        }
        Ok(row)
    }
}

/// Writes the rows of `sources` as lines of `out`, in the order of their times.
pub(super) fn merge<S: Rows, W: Write>(
    sources: Vec<S>,
    names: &Names,
    settings: &Settings,
    out: &mut Writer<W>,
) -> Result<Imported, ImportError> {
    let mut sources: Vec<Source<S>> = sources.into_iter().map(|rows| Source { rows, next: None }).collect();
    for source in &mut sources {
        source.take()?;
    }
    let start = start(&sources, settings)?;
    let senders = names.senders();
    let mut seen = vec![false; senders.len()];
    let mut imported = Imported { unused: names.unused.clone(), ..Imported::default() };
    while let Some(at) = sources.iter().filter_map(|source| source.next.as_ref()).map(|row| row.at).min() {
        let mut texts = [String::new(), String::new()];
        for source in &mut sources {
            if source.next.as_ref().is_none_or(|row| row.at != at) {
                continue;
            }
            let Some(row) = source.take()? else { continue };
            imported.rows += 1;
            for (signal, value) in row.values {
                seen[signal] = true;
                let (name, from) = &senders[signal];
                push(&mut texts[usize::from(*from != Sender::Automation)], name, &value);
            }
        }
        let at = Instant::from_nanos(at.nanos().saturating_sub(start.nanos()));
        if imported.lines == 0 {
            imported.begins_s = at.seconds();
        }
        for (text, from) in texts.iter_mut().zip([Sender::Automation, Sender::Plant]) {
            if !text.is_empty() {
                text.push_str("]}");
                out.message(at, from, text).map_err(ImportError::Write)?;
                imported.lines += 1;
                imported.ends_s = at.seconds();
            }
        }
    }
    for ((name, from), seen) in senders.into_iter().zip(seen) {
        let list = match (seen, from) {
            (false, _) => &mut imported.empty,
            (true, Sender::Automation) => &mut imported.commands,
            (true, _) => &mut imported.reports,
        };
        list.push(name);
    }
    Ok(imported)
}

/// What is subtracted from all times.
fn start<S: Rows>(sources: &[Source<S>], settings: &Settings) -> Result<Instant, ImportError> {
    let firsts = sources.iter().filter_map(|source| Some((source.next.as_ref()?.at, source.rows.place())));
    let Some((first, (file, line))) = firsts.min_by_key(|(at, _)| *at) else { return Ok(Instant::ZERO) };
    if settings.from_zero {
        return Ok(first);
    }
    let problem = if first < Instant::ZERO {
        "before the start"
    } else if first.nanos() > LATEST_START_NS {
        "more than a day after the start: is it a date, or in another --unit?"
    } else {
        return Ok(Instant::ZERO);
    };
    let first = exact(first);
    let problem = format!("the first time is {first} s, {problem}; --from-zero counts from the first row");
    Err(ImportError::Line { file: file.to_owned(), line, problem })
}

/// A time's seconds, every digit of them.
fn exact(at: Instant) -> String {
    let mut text = String::new();
    write_seconds(&mut text, at);
    text
}

fn push(text: &mut String, name: &str, value: &str) {
    text.push_str(if text.is_empty() { "{\"SendValue\":[" } else { "," });
    text.push_str("{\"name\":");
    text.push_str(&serde_json::json!(name).to_string());
    text.push_str(",\"value\":");
    text.push_str(value);
    text.push('}');
}
