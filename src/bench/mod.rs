//! What the channel costs, measured beside its peers in one run on one machine: `kinetwin bench`.
//!
//! [`latency`] makes the table of `docs/performance.md`; [`load`] holds requirement R001's load and looks for its limit.
//! Speed is shown here and not by tests, whose result would hang on what else the machine does.

pub mod blocks;
mod channel;
mod cores;
pub mod devices;
mod echo;
pub mod latency;
mod lateness;
pub mod load;
mod modbus;
mod mqtt;
mod opcua;
mod row;
mod sent;
mod serde_loop;
mod web;

pub use row::{Measured, Quantity};

use std::io;

/// Why a measurement could not be made.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    #[error("failed to measure {row}: {source}")]
    Row { row: String, source: io::Error },
    #[error("no row's name contains {only:?}: run kinetwin bench latency without --only to see them all")]
    NoRow { only: String },
    #[error(transparent)]
    Run(#[from] crate::run::RunError),
    #[error("failed to start a thread or to listen: {0}")]
    Start(#[from] io::Error),
}
