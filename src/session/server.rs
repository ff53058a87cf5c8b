//! The automation's end of the CPS-Protocol, for one connection.

use std::borrow::Cow;
use std::sync::Arc;

use super::exchange::{Exchange, one_line};
use super::interface::interface_of;
use super::limits::Gauge;
use super::outbox::Outbox;
use super::selection::Selection;
use super::{Input, Limits, OUTPUT_LIMIT, Output, Staged, close_code};
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;
use crate::wire::{Connect, ConnectReply, Entry, Fault, Message, ResultCode, from_base64, to_base64};

/// How a [`Server`] introduces itself, and whom it lets in.
#[derive(Clone, Debug)]
pub struct ServerSettings {
    /// The server's name. Travels as base64.
    pub name: String,
    /// Refuse every `Connect` with this result and these words; `None` to accept.
    pub refuse: Option<(ResultCode, String)>,
    /// What is taken from a client.
    pub limits: Limits,
}

impl ServerSettings {
    /// A server called `name` that lets everyone in.
    pub fn new(name: impl Into<String>) -> ServerSettings {
        ServerSettings { name: name.into(), refuse: None, limits: Limits::default() }
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
    exchange: Exchange,
    gauge: Gauge,
    state: State,
    outbox: Outbox<ServerEvent>,
}

/// Where the server stands.
#[derive(Debug)]
enum State {
    /// The connection stands without a session.
    Open,
    /// A client's session stands.
    Established {
        /// The client's id as it travels.
        id: String,
        /// What it selected; `None` for everything.
        selection: Option<Selection>,
    },
    /// The connection is over.
    Ended,
}

impl Server {
    /// A server for a connection just accepted, of the automation of the plant that `map` describes.
    pub fn new(settings: ServerSettings, map: Arc<SignalMap>) -> Server {
        let exchange = Exchange::new(map, Direction::Command);
        let gauge = Gauge::new(&settings.limits);
        Server { settings, exchange, gauge, state: State::Open, outbox: Outbox::new() }
    }

    /// Takes what happened.
    pub fn handle(&mut self, now: Instant, input: Input<'_>) {
        if matches!(self.state, State::Ended) {
            return;
        }
        match input {
            Input::Opened => {}
            Input::Closed => self.end("the connection ended"),
            Input::Timeout => self.time_passed(now),
            _ if self.outbox.is_full() => {
                self.close(close_code::POLICY, format!("{OUTPUT_LIMIT} outputs were not fetched"));
            }
            Input::Text(_) | Input::Binary if let Err(reason) = self.gauge.count(now) => {
                self.close(close_code::POLICY, reason);
            }
            Input::Text(text) => self.text(text),
            Input::Binary => self.notice("a binary message was ignored: the protocol speaks JSON text"),
            Input::InvalidUtf8 => self.close(close_code::NOT_UTF8, "a message was not UTF-8"),
            Input::TooLong { limit } => {
                self.close(close_code::TOO_BIG, format!("a message was longer than {limit} bytes"));
            }
        }
    }

    /// Sends `values`, all of them commands, in one `SendValue`; what the client did not select is left out, and what it
    /// wants less often is held back until it is due. Says whether a session stands.
    pub fn send(&mut self, now: Instant, values: &[(RegisterId, Value)]) -> bool {
        let State::Established { selection, .. } = &mut self.state else { return false };
        if self.outbox.is_full() {
            self.close(close_code::POLICY, format!("{OUTPUT_LIMIT} outputs were not fetched"));
            return false;
        }
        match selection {
            None => self.transmit(values),
            Some(selection) => {
                let goes = selection.offer(now, values);
                self.transmit(&goes);
            }
        }
        true
    }

    /// The settings, to be changed for what comes next: a server that is ready now, or no longer.
    pub fn settings_mut(&mut self) -> &mut ServerSettings {
        &mut self.settings
    }

    /// Closes the connection with a WebSocket status code, whatever stands.
    pub fn close(&mut self, code: u16, reason: impl Into<String>) {
        if !matches!(self.state, State::Ended) {
            let reason = reason.into();
            self.outbox.close(code, reason.clone());
            self.end(reason);
        }
    }

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Output<ServerEvent>> {
        self.outbox.pop()
    }

    /// When [`Input::Timeout`] is due; `None` if nothing is awaited.
    pub fn timeout(&self) -> Option<Instant> {
        match &self.state {
            State::Established { selection: Some(selection), .. } => selection.due(),
            _ => None,
        }
    }

    /// Whether a session stands.
    pub fn is_established(&self) -> bool {
        matches!(self.state, State::Established { .. })
    }

    fn time_passed(&mut self, now: Instant) {
        if let State::Established { selection: Some(selection), .. } = &mut self.state {
            let goes = selection.take_due(now);
            self.transmit(&goes);
        }
    }

    fn transmit(&mut self, values: &[(RegisterId, Value)]) {
        let sending = self.exchange.send(values.iter());
        for (register, reason) in sending.unsendable {
            self.outbox.event(ServerEvent::Unsendable { register, reason });
        }
        sending.text.into_iter().for_each(|text| self.outbox.transmit(text));
    }

    fn text(&mut self, text: &str) {
        if self.is_established()
            && let Some(staged) = self.exchange.receive_plain(text, self.settings.limits.values)
        {
            return self.outbox.event(ServerEvent::Values(staged));
        }
        match Message::decode(text) {
            Err(error) => self.reject(text, error.to_string()),
            Ok(Message::Connect(connect)) if connect.enable => self.connect(&connect),
            Ok(Message::Connect(connect)) => self.disconnect(&connect),
            Ok(Message::SendValue(entries)) => self.values(text, &entries),
            Ok(Message::SendValueReply(faults)) => self.outbox.event(ServerEvent::Faults(faults)),
            Ok(Message::QueryAll) => {
                let interface = interface_of(self.exchange.map(), &self.settings.name);
                self.outbox.transmit(Message::QueryAllReply(interface).encode());
            }
            Ok(other) => self.reject(text, format!("{} is nothing that a server was waiting for", other.name())),
        }
    }

    fn connect(&mut self, connect: &Connect<'_>) {
        let id = from_base64(&connect.id);
        if let Some((result, message)) = self.settings.refuse.clone() {
            self.reply(connect, result, Some(message));
            return self.outbox.event(ServerEvent::Refused { id, result });
        }
        if let State::Established { id: present, .. } = &self.state
            && *present != connect.id
        {
            let message = format!("this connection belongs to the session of {:?}", from_base64(present));
            self.reply(connect, ResultCode::CONFLICT, Some(message));
            return self.outbox.event(ServerEvent::Refused { id, result: ResultCode::CONFLICT });
        }
        let (selection, unknown) = match &connect.signals {
            None => (None, Vec::new()),
            Some(wanted) => {
                let (selection, unknown) = Selection::new(self.exchange.map(), wanted);
                (Some(selection), unknown)
            }
        };
        let message = (!unknown.is_empty()).then(|| unselectable(&unknown));
        message.iter().for_each(|message| self.notice(message.clone()));
        self.reply(connect, ResultCode::OK, message);
        self.state = State::Established { id: connect.id.to_string(), selection };
        self.outbox.event(ServerEvent::Connected { id });
    }

    fn disconnect(&mut self, connect: &Connect<'_>) {
        let known = matches!(&self.state, State::Established { id, .. } if *id == connect.id);
        if known {
            self.reply(connect, ResultCode::OK, None);
            self.state = State::Open;
            self.outbox.event(ServerEvent::Disconnected);
        } else {
            let message = format!("no session of {:?} stands on this connection", from_base64(&connect.id));
            self.notice(format!("a disconnection was refused: {message}"));
            self.reply(connect, ResultCode::NOT_FOUND, Some(message));
        }
    }

    fn reply(&mut self, connect: &Connect<'_>, result: ResultCode, message: Option<String>) {
        let reply = ConnectReply {
            id: Cow::Borrowed(&connect.id),
            enable: connect.enable,
            server_name: Cow::Owned(to_base64(&self.settings.name)),
            result,
            message: message.map(Cow::Owned),
        };
        self.outbox.transmit(Message::ConnectReply(reply).encode());
    }

    fn values(&mut self, text: &str, entries: &[Entry<'_>]) {
        if !self.is_established() {
            return self.reject(text, "values came before a Connect was accepted".to_owned());
        }
        if let Some(reason) = self.settings.limits.refuse(entries.len()) {
            return self.reject(text, reason);
        }
        let receipt = self.exchange.receive(text, entries);
        if receipt.nameless > 0 {
            self.notice(format!("{} entries of a SendValue had no name", receipt.nameless));
        }
        match receipt.outcome {
            Ok(staged) => self.outbox.event(ServerEvent::Values(staged)),
            Err(reason) => self.reject(text, reason),
        }
        receipt.reply.into_iter().for_each(|reply| self.outbox.transmit(reply));
    }

    fn reject(&mut self, text: &str, reason: String) {
        self.outbox.event(ServerEvent::Rejected { text: one_line(text), reason });
    }

    fn notice(&mut self, text: impl Into<String>) {
        self.outbox.event(ServerEvent::Notice(text.into()));
    }

    fn end(&mut self, reason: impl Into<String>) {
        let was_established = self.is_established();
        self.state = State::Ended;
        self.outbox.event(ServerEvent::Ended { reason: reason.into(), was_established });
    }
}

/// What to say of selected names that the server cannot send: the first few of them.
fn unselectable(names: &[String]) -> String {
    const SHOWN: usize = 5;
    let shown = names.iter().take(SHOWN).map(|name| format!("{:.80?}", name)).collect::<Vec<_>>().join(", ");
    let more = if names.len() > SHOWN { format!(" and {} more", names.len() - SHOWN) } else { String::new() };
    format!("selected, but no output of this automation: {shown}{more}")
}
