//! Asking a server for its interface: one connection, one question, one answer.

use std::time::Duration;

use super::outbox::Outbox;
use super::{Input, Output, close_code};
use crate::time::{Instant, format_duration};
use crate::wire::{DecodeError, Interface, Message};

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

/// A client that asks for the server's interface (`QueryAll`), and opens no session. One try: whoever asks wants to know
/// now, and an answer later is of no use to a check.
#[derive(Debug)]
pub struct Query {
    timeout: Duration,
    state: State,
    outbox: Outbox<QueryEvent>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// No deadline before the owner says what time it is.
    Dialling {
        deadline: Option<Instant>,
    },
    Asking {
        deadline: Instant,
    },
    Ended,
}

impl Query {
    /// A query that waits at most `timeout` for the connection, and as long again for the answer.
    pub fn new(timeout: Duration) -> Query {
        let mut outbox = Outbox::new();
        outbox.event(QueryEvent::Dial);
        Query { timeout, state: State::Dialling { deadline: None }, outbox }
    }

    /// Takes what happened.
    pub fn handle(&mut self, now: Instant, input: Input<'_>) {
        match (self.state, input) {
            (State::Ended, _) => {}
            (State::Dialling { deadline: None }, Input::Timeout) => {
                self.state = State::Dialling { deadline: Some(now + self.timeout) };
            }
            (State::Dialling { deadline: Some(deadline) }, Input::Timeout) if deadline <= now => {
                self.fail(format!("no connection within {}", format_duration(self.timeout)));
            }
            (State::Asking { deadline }, Input::Timeout) if deadline <= now => {
                self.fail(format!("no answer to QueryAll within {}", format_duration(self.timeout)));
            }
            (_, Input::Timeout) => {}
            (State::Dialling { .. }, Input::Opened) => {
                self.outbox.transmit(Message::QueryAll.encode());
                self.state = State::Asking { deadline: now + self.timeout };
            }
            (State::Dialling { .. }, Input::Closed) => self.fail("no connection could be made"),
            (State::Asking { .. }, Input::Closed) => self.fail("the connection ended before the server answered"),
            (State::Asking { .. }, Input::Text(text)) => self.text(text),
            (State::Asking { .. }, Input::InvalidUtf8) => self.fail("the server sent a message that is not UTF-8"),
            (State::Asking { .. }, Input::TooLong { limit }) => {
                self.fail(format!("the server sent a message longer than {limit} bytes"));
            }
            (_, Input::Binary) => self.notice("a binary message was ignored: the protocol speaks JSON text"),
            _ => {}
        }
    }

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Output<QueryEvent>> {
        self.outbox.pop()
    }

    /// When [`Input::Timeout`] is due; `None` if nothing is awaited.
    pub fn timeout(&self) -> Option<Instant> {
        match self.state {
            State::Dialling { deadline } => Some(deadline.unwrap_or(Instant::from_nanos(i64::MIN))),
            State::Asking { deadline } => Some(deadline),
            State::Ended => None,
        }
    }

    fn text(&mut self, text: &str) {
        match Message::decode(text) {
            Ok(Message::QueryAllReply(interface)) if interface.result.is_accepted() => {
                self.outbox.event(QueryEvent::Answered(interface));
                self.end();
            }
            Ok(Message::QueryAllReply(interface)) => {
                self.fail(format!("the server refused QueryAll with {}", interface.result));
            }
            // An answer in a form that is not ours: the source gives the message's name alone.
            Err(error @ DecodeError::Body { message: "QueryAllReply", .. }) => self.fail(error.to_string()),
            Ok(other) => self.notice(format!("a {} was ignored: only QueryAllReply is awaited", other.name())),
            Err(error) => self.notice(format!("a message was ignored: {error}")),
        }
    }

    fn notice(&mut self, text: impl Into<String>) {
        if !self.outbox.is_full() {
            self.outbox.event(QueryEvent::Notice(text.into()));
        }
    }

    fn fail(&mut self, reason: impl Into<String>) {
        self.outbox.event(QueryEvent::Failed { reason: reason.into() });
        self.end();
    }

    fn end(&mut self) {
        self.outbox.close(close_code::NORMAL, "the question is answered or given up");
        self.state = State::Ended;
    }
}
