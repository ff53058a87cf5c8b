//! A trace becomes a table for other programs: CSV, or MCAP.
//!
//! Only values go out; connections, events and refused messages are counted and left out. A value keeps its digits, and a
//! time is exact, so that an import gives the same trace again.

mod csv;
mod mcap;

use std::io;

use serde::Serialize;

pub use self::csv::csv;
pub use self::mcap::{mcap, mcap_with};

use super::TraceError;

/// What an export has written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Exported {
    /// Rows of a table, or messages.
    pub rows: u64,
    /// Lines of the trace that hold no values.
    pub skipped: u64,
}

/// Why a trace could not be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error("failed to write the table")]
    Write(#[source] io::Error),
    /// A column has one sender.
    #[error("both the automation and the plant send {name:?}: expected each signal from one of them")]
    BothSides { name: String },
    #[error("failed to write the MCAP file")]
    Mcap(#[from] ::mcap::McapError),
}
