//! Tables of measurements become a trace: CSV files as machines, scopes and data loggers write them, and MCAP files.
//!
//! Several sources are merged by time. What each column becomes is said by [`Mapping`]s; which signals the automation sends,
//! and of which type they are, is said by the model's signals map, or else by name ([`Signals`]). Of every row the mapped cells
//! that hold something become at most two lines with the row's time, the automation's first. Times are read as exact
//! decimals. CSV is read as it comes, in constant memory; an MCAP file, whose messages need not be in order, is held whole.

mod cell;
mod csv;
mod long;
mod mapping;
mod mcap;
mod merge;
mod names;
mod signals;
#[cfg(test)]
mod tests;
mod wide;

use std::io;

pub use self::csv::{Clock, Shape, Table, TimeUnit, csv};
pub use self::mapping::{Mapping, ParseMappingError};
pub use self::mcap::mcap;
pub use self::merge::Imported;
pub use self::signals::Signals;

/// What holds for all tables of an import.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// Which column becomes which signal; where there is none, every column that has a signal's name.
    pub maps: Vec<Mapping>,
    pub signals: Signals,
    /// Words that stand in a cell where there is no value, besides nothing at all: `NaN`, `n/a`.
    pub missing: Vec<String>,
    /// Whether times are counted from the first of all rows.
    pub from_zero: bool,
}

/// Why tables do not become a trace.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    #[error("failed to read {file}")]
    Read {
        file: String,
        #[source]
        source: io::Error,
    },
    #[error("failed to write the trace")]
    Write(#[source] io::Error),
    /// Something in a line of a table; lines count from 1.
    #[error("{file}:{line}: {problem}")]
    Line { file: String, line: u64, problem: String },
    /// Something about a file as a whole.
    #[error("{file}: {problem}")]
    File { file: String, problem: String },
    /// A mapping that fits no column or no signal.
    #[error("--map {map}: {problem}")]
    Map { map: String, problem: String },
}

/// A row of a table: its time, and its values as the JSON texts they become, by the index of their signal.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    at: crate::time::Instant,
    values: Vec<(usize, String)>,
}

/// A source of rows, in the order of their times.
trait Rows {
    fn next_row(&mut self) -> Result<Option<Row>, ImportError>;

    /// What it is called, for errors, and the line it has read last.
    fn place(&self) -> (&str, u64);
}
