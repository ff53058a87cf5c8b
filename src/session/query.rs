//! Asking a server for its interface: one connection, one question, one answer.

use std::collections::VecDeque;
use std::time::Duration;

use super::{Input, Output};
use crate::time::Instant;
use crate::wire::Interface;

/// What a [`Query`] tells its owner.
#[derive(Clone, Debug, PartialEq)]
pub enum QueryEvent {
    /// Open a connection to the server, and hand in [`Input::Opened`] or [`Input::Closed`].
    Dial,
    /// The server's answer. Compare it with [`mismatches`](super::mismatches).
    Answered(Interface),
    /// There is no answer, and none will be waited for.
    Failed {
        /// What happened, for people.
        reason: String,
    },
    /// Something odd that changes nothing, for the log.
    Notice(String),
}

/// A client that asks for the server's interface (`QueryAll`), and opens no session.
#[derive(Debug)]
pub struct Query {
    timeout: Duration,
    outputs: VecDeque<Output<QueryEvent>>,
}

impl Query {
    /// A query that waits at most `timeout` for the connection, and as long again for the answer.
    pub fn new(timeout: Duration) -> Query {
        Query { timeout, outputs: VecDeque::from([Output::Event(QueryEvent::Dial)]) }
    }

    /// Takes what happened.
    pub fn handle(&mut self, _now: Instant, _input: Input<'_>) {
        let _ = self.timeout;
    }

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Output<QueryEvent>> {
        self.outputs.pop_front()
    }

    /// When [`Input::Timeout`] is due; `None` if nothing is awaited.
    pub fn timeout(&self) -> Option<Instant> {
        None
    }
}
