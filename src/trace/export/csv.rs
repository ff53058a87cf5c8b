//! A table with a row for each line, and a column for each signal.

use std::collections::HashMap;
use std::io::{BufRead, Write};

use crate::trace::seconds::write_seconds;
use crate::trace::{Body, Info, Reader};
use crate::wire::Message;

use super::{ExportError, Exported};

/// The column of the times.
pub(super) const TIME: &str = "t_s";

/// Writes a trace as a table: times in seconds, then the commands, then the reports, each in alphabetical order. `info` is
/// of the same trace. A cell is empty where its row's line does not hold its signal.
pub fn csv<R: BufRead, W: Write>(mut reader: Reader<R>, info: &Info, out: W) -> Result<Exported, ExportError> {
    let both = info.signals.iter().find(|(_, signal)| signal.commands > 0 && signal.reports > 0);
    if let Some((name, _)) = both {
        return Err(ExportError::BothSides { name: name.clone() });
    }
    let (commands, reports): (Vec<_>, Vec<_>) = info.signals.iter().partition(|(_, signal)| signal.commands > 0);
    let names: Vec<&str> = commands.iter().chain(&reports).map(|(name, _)| name.as_str()).collect();
    let index: HashMap<&str, usize> = names.iter().enumerate().map(|(at, name)| (*name, at + 1)).collect();
    let mut table = ::csv::Writer::from_writer(out);
    table.write_record(std::iter::once(TIME).chain(names.iter().copied())).map_err(failed)?;
    let mut row = vec![String::new(); names.len() + 1];
    let mut exported = Exported::default();
    while let Some(line) = reader.next_line()? {
        let Body::Message(Message::SendValue(entries)) = &line.body else {
            exported.skipped += 1;
            continue;
        };
        for entry in entries {
            let (Some(name), Some(value)) = (entry.name.as_deref(), entry.value) else { continue };
            let Some(&at) = index.get(name) else { continue };
            if row[0].is_empty() {
                write_seconds(&mut row[0], line.at);
            } else if !row[at].is_empty() {
                // A signal twice in a message: the first value was there, however short.
                write(&mut table, &mut row, &mut exported)?;
                write_seconds(&mut row[0], line.at);
            }
            row[at].push_str(value.text());
        }
        if row[0].is_empty() {
            exported.skipped += 1;
        } else {
            write(&mut table, &mut row, &mut exported)?;
        }
    }
    table.flush().map_err(ExportError::Write)?;
    Ok(exported)
}

fn write<W: Write>(
    table: &mut ::csv::Writer<W>,
    row: &mut [String],
    exported: &mut Exported,
) -> Result<(), ExportError> {
    table.write_record(row.iter()).map_err(failed)?;
    row.iter_mut().for_each(String::clear);
    exported.rows += 1;
    Ok(())
}

fn failed(error: ::csv::Error) -> ExportError {
    match error.into_kind() {
        ::csv::ErrorKind::Io(source) => ExportError::Write(source),
        other => ExportError::Write(std::io::Error::other(format!("{other:?}"))),
    }
}
