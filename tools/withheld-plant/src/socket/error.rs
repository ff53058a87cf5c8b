//! Why a recording over a socket was not made.

use std::io;

/// Why a recording over a socket was not made.
#[derive(Debug, thiserror::Error)]
pub enum SocketError {
    /// No socket of this machine could be had.
    #[error("failed to open a connection to the {peer} on 127.0.0.1")]
    Open {
        peer: &'static str,
        #[source]
        source: io::Error,
    },
    /// The connection ended before the recording did.
    #[error("the connection to the {peer} was lost {at:.3} s after the recording began")]
    Lost {
        peer: &'static str,
        at: f64,
        #[source]
        source: tungstenite::Error,
    },
    /// A message came that the protocol does not have, or not then.
    #[error("the {peer} sent what no recording can hold, {at:.3} s after it began: {reason}: {text}")]
    Bad { peer: &'static str, at: f64, reason: String, text: String },
    /// Nothing came.
    #[error("the {peer} said nothing for {seconds} s when it should have answered")]
    Silent { peer: &'static str, seconds: f64 },
    /// The machine was not there in time: what is recorded would not be what happened.
    #[error(
        "the recording did not keep time: one of a thousand events was {:.1} ms late, and at most {:.1} ms are allowed: \
         this machine is too busy; record fewer at a time (--jobs), when it has less to do, or with leave for real-time \
         priorities (CAP_SYS_NICE, or `ulimit -r` 10)",
        1e3 * late, 1e3 * allowed
    )]
    Late { late: f64, allowed: f64 },
    /// A command was not there when its stamp says.
    #[error(
        "the recording did not keep time: the way of a command took {:.1} ms more or less than that of most, and at most \
         {:.1} ms are allowed: this machine is too busy; record fewer at a time (--jobs), or when it has less to do",
        1e3 * late, 1e3 * allowed
    )]
    Unsure { late: f64, allowed: f64 },
}

impl SocketError {
    /// Whether it only says that the other end has gone, for whatever reason that had.
    pub fn is_consequence(&self) -> bool {
        matches!(self, SocketError::Lost { .. } | SocketError::Silent { .. })
    }
}
