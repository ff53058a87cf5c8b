//! The automation's end of the CPS-Protocol, for one connection.

use std::collections::VecDeque;
use std::sync::Arc;

use super::{Input, Output, Staged};
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;
use crate::wire::{Fault, ResultCode};

/// How a [`Server`] introduces itself, and whom it lets in.
#[derive(Clone, Debug)]
pub struct ServerSettings {
    /// The server's name. Travels as base64.
    pub name: String,
    /// Refuse every `Connect` with this result and these words; `None` to accept.
    pub refuse: Option<(ResultCode, String)>,
}

impl ServerSettings {
    /// A server called `name` that lets everyone in.
    pub fn new(name: impl Into<String>) -> ServerSettings {
        ServerSettings { name: name.into(), refuse: None }
    }
}

/// What a [`Server`] tells its owner.
#[derive(Clone, Debug, PartialEq)]
pub enum ServerEvent {
    /// A client opened its session. The owner now sends the present value of every command, in one [`Server::send`].
    Connected {
        /// The client's id, decoded.
        id: String,
    },
    /// A client asked, and was refused.
    Refused { id: String, result: ResultCode },
    /// Values arrived.
    Values(Staged),
    /// A message arrived of which nothing could be used. It has been answered where the protocol has an answer.
    Rejected {
        /// The message as it came, its line breaks turned to blanks.
        text: String,
        /// Why, for people.
        reason: String,
    },
    /// The client refused values of ours.
    Faults(Vec<Fault>),
    /// A value of ours was not sent, because it is no number (NaN or infinite).
    Unsendable {
        register: RegisterId,
        /// Names the signal, for people.
        reason: String,
    },
    /// Something odd that changes nothing, for the log.
    Notice(String),
    /// The client ended its session and was acknowledged. It may open another on the same connection.
    Disconnected,
    /// The connection is over.
    Ended {
        /// What happened, for people.
        reason: String,
        /// Whether a session stood.
        was_established: bool,
    },
}

/// The automation's end of one connection. See the [module](super) for how to drive it.
#[derive(Debug)]
pub struct Server {
    settings: ServerSettings,
    map: Arc<SignalMap>,
    outputs: VecDeque<Output<ServerEvent>>,
}

impl Server {
    /// A server for a connection just accepted, of the automation of the plant that `map` describes.
    pub fn new(settings: ServerSettings, map: Arc<SignalMap>) -> Server {
        Server { settings, map, outputs: VecDeque::new() }
    }

    /// Takes what happened.
    pub fn handle(&mut self, _now: Instant, _input: Input<'_>) {
        let _ = (&self.settings, &self.map);
    }

    /// Sends `values`, all of them commands, in one `SendValue`; what the client did not select is left out, and what it
    /// wants less often is held back until it is due. Says whether a session stands.
    pub fn send(&mut self, _now: Instant, _values: &[(RegisterId, Value)]) -> bool {
        false
    }

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Output<ServerEvent>> {
        self.outputs.pop_front()
    }

    /// When [`Input::Timeout`] is due; `None` if nothing is awaited.
    pub fn timeout(&self) -> Option<Instant> {
        None
    }

    /// Whether a session stands.
    pub fn is_established(&self) -> bool {
        false
    }
}
