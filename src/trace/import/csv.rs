//! CSV files, wide or long: read as they come, in constant memory.

use std::io::{BufRead, BufReader, Cursor, Read, Write};

use crate::trace::Writer;
use crate::trace::seconds::read_time;

use super::long::Long;
use super::merge::{Imported, merge};
use super::names::Names;
use super::wide::Wide;
use super::{ImportError, Settings, cell};

/// What is longer is no line of names, in bytes; its cells are read all the same.
const LONGEST_HEADER: u64 = 1 << 20;

/// A table, with what errors call it.
pub struct Table<R> {
    pub file: String,
    pub input: R,
    pub clock: Clock,
}

/// Where a table's times come from.
#[derive(Clone, Debug, PartialEq)]
pub enum Clock {
    /// From a column.
    Column { name: String, unit: TimeUnit },
    /// From the rows' numbers: so many rows a second, the first at 0.
    Rate(f64),
}

/// The unit of a column of times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeUnit {
    #[default]
    Seconds,
    Milliseconds,
    Microseconds,
    Nanoseconds,
}

impl TimeUnit {
    /// All of them, with their symbols.
    pub const ALL: [(&'static str, TimeUnit); 4] = [
        ("s", TimeUnit::Seconds),
        ("ms", TimeUnit::Milliseconds),
        ("us", TimeUnit::Microseconds),
        ("ns", TimeUnit::Nanoseconds),
    ];

    /// How many decimals of it are a nanosecond.
    pub(super) const fn decimals(self) -> usize {
        match self {
            TimeUnit::Seconds => 9,
            TimeUnit::Milliseconds => 6,
            TimeUnit::Microseconds => 3,
            TimeUnit::Nanoseconds => 0,
        }
    }
}

/// How a table is laid out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Shape {
    /// A column for each signal.
    #[default]
    Wide,
    /// A row for each value: one column says of which signal, another the value.
    Long { name: String, value: String },
}

/// Reads tables, merges them by time, and writes what they hold as lines of a trace.
///
/// Cells are parted by the first of `;`, the tabulator and `,` that the header has. Within a table no time may be less than
/// the one before.
///
/// # Errors
/// A table cannot be read, lacks a column, or holds what cannot stand in a trace; `out` is of no use then.
pub fn csv<R: Read, W: Write>(
    tables: Vec<Table<R>>,
    shape: &Shape,
    settings: &Settings,
    out: &mut Writer<W>,
) -> Result<Imported, ImportError> {
    let mut opened = Vec::new();
    for table in tables {
        opened.push(Opened::new(table)?);
    }
    match shape {
        Shape::Wide => {
            let columns = opened.iter().map(|table| (table.file.clone(), table.value_columns())).collect::<Vec<_>>();
            let names = Names::resolve(settings, &columns)?;
            let wide = opened.into_iter().map(|table| Wide::new(table, &names, settings));
            merge(wide.collect(), &names, settings, out)
        }
        Shape::Long { name, value } => {
            // Which names a long table holds shows only as it is read: here every mapping is taken at its word.
            let names = Names::of_long(settings)?;
            let long = opened.into_iter().map(|table| Long::new(table, name, value, &names, settings));
            let mut imported = merge(long.collect::<Result<Vec<_>, _>>()?, &names, settings, out)?;
            if settings.maps.is_empty() {
                // Signals that nobody asked for.
                imported.empty.clear();
            }
            Ok(imported)
        }
    }
}

type Peeked<R> = std::io::Chain<Cursor<Vec<u8>>, BufReader<R>>;

/// A table whose header has been read.
pub(super) struct Opened<R: Read> {
    pub file: String,
    reader: ::csv::Reader<Peeked<R>>,
    pub columns: Vec<String>,
    clock: ClockColumn,
    record: ::csv::ByteRecord,
    rows: u64,
    /// The line that the last row began in.
    pub line: u64,
}

enum ClockColumn {
    Column { index: usize, unit: TimeUnit },
    Rate(f64),
}

impl<R: Read> Opened<R> {
    fn new(table: Table<R>) -> Result<Opened<R>, ImportError> {
        let Table { file, input, clock } = table;
        let mut input = BufReader::with_capacity(1 << 16, input);
        let mut first = Vec::new();
        if let Err(source) = input.by_ref().take(LONGEST_HEADER).read_until(b'\n', &mut first) {
            return Err(ImportError::Read { file, source });
        }
        let mut builder = ::csv::ReaderBuilder::new();
        builder.delimiter(delimiter(&first));
        let mut reader = builder.from_reader(Cursor::new(first).chain(input));
        let header = match reader.byte_headers() {
            Ok(header) => header,
            Err(error) => return Err(unreadable(&file, error)),
        };
        let columns: Vec<String> = header.iter().map(|name| decoded(name).trim().to_owned()).collect();
        if columns.iter().all(String::is_empty) {
            let problem = "no header: expected the columns' names in the first line".to_owned();
            return Err(ImportError::Line { file, line: 1, problem });
        }
        let clock = match clock {
            Clock::Rate(rate) => ClockColumn::Rate(rate),
            Clock::Column { name, unit } => {
                ClockColumn::Column { index: column(&columns, &name, &file, "time")?, unit }
            }
        };
        let record = ::csv::ByteRecord::new();
        Ok(Opened { file, reader, columns, clock, record, rows: 0, line: 1 })
    }

    /// The columns that are no times.
    fn value_columns(&self) -> Vec<String> {
        let time = match self.clock {
            ClockColumn::Column { index, .. } => Some(index),
            ClockColumn::Rate(_) => None,
        };
        let values = self.columns.iter().enumerate().filter(|(index, _)| Some(*index) != time);
        values.map(|(_, name)| name.clone()).collect()
    }

    /// Goes to the next row and gives its time; `None` at the end.
    pub fn advance(&mut self) -> Result<Option<crate::time::Instant>, ImportError> {
        match self.reader.read_byte_record(&mut self.record) {
            Ok(true) => {}
            Ok(false) => return Ok(None),
            Err(error) => return Err(unreadable(&self.file, error)),
        }
        self.line = self.record.position().map_or(0, ::csv::Position::line);
        self.rows += 1;
        match self.clock {
            ClockColumn::Rate(rate) => Ok(Some(crate::time::Instant::from_seconds((self.rows - 1) as f64 / rate))),
            ClockColumn::Column { index, unit } => {
                let text = self.cell(index);
                let time = cell::decimal(text.trim()).and_then(|digits| read_time(&digits, unit.decimals()));
                time.map(Some).ok_or_else(|| {
                    let name = &self.columns[index];
                    self.wrong(name, format!("{text:?} is no time: expected a number (--time, --unit)"))
                })
            }
        }
    }

    /// A cell of the row.
    pub fn cell(&self, index: usize) -> std::borrow::Cow<'_, str> {
        decoded(self.record.get(index).unwrap_or_default())
    }

    /// What is wrong in a column of the row.
    pub fn wrong(&self, column: &str, problem: String) -> ImportError {
        let problem = format!("column {column}: {problem}");
        ImportError::Line { file: self.file.clone(), line: self.line, problem }
    }
}

/// The index of the column called `name`.
pub(super) fn column(columns: &[String], name: &str, file: &str, what: &str) -> Result<usize, ImportError> {
    columns.iter().position(|column| column == name).ok_or_else(|| {
        let near = crate::xml::nearest(name, columns.iter().map(String::as_str));
        let hint = near.map(|near| format!("; did you mean {near:?}?")).unwrap_or_default();
        let problem =
            format!("there is no column {name:?} for the {what}: expected one of {}{hint}", columns.join(", "));
        ImportError::Line { file: file.to_owned(), line: 1, problem }
    })
}

/// What parts the cells of a header: the least ambiguous that it has.
fn delimiter(header: &[u8]) -> u8 {
    let is_there = |delimiter: &u8| {
        let mut quoted = false;
        header.iter().any(|byte| {
            quoted ^= *byte == b'"';
            !quoted && byte == delimiter
        })
    };
    [b';', b'\t'].into_iter().find(is_there).unwrap_or(b',')
}

/// UTF-8, or else ISO 8859-1, as old loggers write it.
fn decoded(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect::<String>().into(),
    }
}

fn unreadable(file: &str, error: ::csv::Error) -> ImportError {
    let file = file.to_owned();
    let line = error.position().map_or(0, ::csv::Position::line);
    match error.into_kind() {
        ::csv::ErrorKind::Io(source) => ImportError::Read { file, source },
        ::csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            let problem = format!("{len} cells: expected {expected_len}, as in the header");
            ImportError::Line { file, line, problem }
        }
        other => ImportError::Line { file, line, problem: format!("no line of a table: {other:?}") },
    }
}
