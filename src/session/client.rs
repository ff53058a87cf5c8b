//! The simulation's end of the CPS-Protocol.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use super::{Input, Output, Staged};
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;
use crate::wire::{Fault, ResultCode, SignalSelection};

/// How a [`Client`] introduces itself, and how patient it is.
#[derive(Clone, Debug)]
pub struct ClientSettings {
    /// Who connects. The same for all connections of one run, unique across runs; the owner sees to that, with a random
    /// part. Travels as base64.
    pub id: String,
    /// How long a connection may take to open, and an answer to come.
    pub timeout: Duration,
    /// The pause before the first retry; each further one is twice as long.
    pub first_pause: Duration,
    /// The longest pause between two tries.
    pub longest_pause: Duration,
    /// The signals to be sent, and how often at most (R007); `None` for all, at every change.
    pub signals: Option<Vec<SignalSelection>>,
}

impl ClientSettings {
    /// A client called `id` with the protocol's times: 5 s for an answer, pauses from 0.5 s to 30 s.
    pub fn new(id: impl Into<String>) -> ClientSettings {
        ClientSettings {
            id: id.into(),
            timeout: Duration::from_secs(5),
            first_pause: Duration::from_millis(500),
            longest_pause: Duration::from_secs(30),
            signals: None,
        }
    }
}

/// What a [`Client`] tells its owner.
#[derive(Clone, Debug, PartialEq)]
pub enum ClientEvent {
    /// Open a connection to the server, and hand in [`Input::Opened`] or [`Input::Closed`].
    Dial {
        /// 1 for the first try since the run began or since a session stood.
        attempt: u32,
    },
    /// The server accepted. The owner now sends the present value of every report, in one [`Client::send`].
    Established {
        /// The server's name, decoded.
        server_name: String,
    },
    /// The server answered, and refused.
    Refused {
        result: ResultCode,
        /// The server's own words.
        message: Option<String>,
        /// When the client asks again; `None` after a 5xx, which is final.
        retry_at: Option<Instant>,
    },
    /// No connection, no answer in time, or the connection ended.
    Lost {
        /// What happened, for people.
        reason: String,
        /// Whether a session stood.
        was_established: bool,
        retry_at: Instant,
    },
    /// Values arrived.
    Values(Staged),
    /// A message arrived of which nothing could be used. It has been answered where the protocol has an answer.
    Rejected {
        /// The message as it came, its line breaks turned to blanks.
        text: String,
        /// Why, for people.
        reason: String,
    },
    /// The server refused values of ours.
    Faults(Vec<Fault>),
    /// A value of ours was not sent, because it is no number (NaN or infinite).
    Unsendable {
        register: RegisterId,
        /// Names the signal, for people.
        reason: String,
    },
    /// Something odd that changes nothing, for the log.
    Notice(String),
    /// The client is done for good: nothing more will be asked or said.
    Ended(Ending),
}

/// Why a [`Client`] ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The owner asked for it, and the server acknowledged, or there was no session to end.
    Disconnected,
    /// The owner asked for it, and the server did not answer in time or was gone.
    Unanswered,
    /// The server refused for good (5xx).
    Refused { result: ResultCode, message: Option<String> },
}

/// The simulation's end: connects, retries, exchanges values, disconnects. See the [module](super) for how to drive it.
#[derive(Debug)]
pub struct Client {
    settings: ClientSettings,
    map: Arc<SignalMap>,
    outputs: VecDeque<Output<ClientEvent>>,
}

impl Client {
    /// A client of the plant that `map` describes. It asks for a connection at the first [`poll`](Client::poll).
    pub fn new(settings: ClientSettings, map: Arc<SignalMap>) -> Client {
        Client { settings, map, outputs: VecDeque::from([Output::Event(ClientEvent::Dial { attempt: 1 })]) }
    }

    /// Takes what happened.
    pub fn handle(&mut self, _now: Instant, _input: Input<'_>) {
        let _ = (&self.settings, &self.map);
    }

    /// Sends `values`, all of them reports, in one `SendValue`. Says whether a message went out: none does while no
    /// session stands, and after the next [`ClientEvent::Established`] all present values are due anyway.
    pub fn send(&mut self, _now: Instant, _values: &[(RegisterId, Value)]) -> bool {
        false
    }

    /// Ends the session: tells the server, waits for its answer, at most for the timeout, and closes.
    pub fn disconnect(&mut self, _now: Instant) {}

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Output<ClientEvent>> {
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
