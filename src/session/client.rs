//! The simulation's end of the CPS-Protocol.

use std::borrow::Cow;
use std::sync::Arc;
use std::time::Duration;

use super::exchange::{Exchange, one_line};
use super::limits::Gauge;
use super::outbox::Outbox;
use super::{Input, Limits, OUTPUT_LIMIT, Output, Staged, close_code};
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::{Instant, format_duration};
use crate::value::Value;
use crate::wire::{Connect, ConnectReply, Entry, Fault, Message, ResultCode, SignalSelection, from_base64, to_base64};

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
    /// What is taken from the server.
    pub limits: Limits,
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
            limits: Limits::default(),
        }
    }
}

/// What a [`Client`] tells its owner.
#[derive(Clone, Debug, PartialEq)]
pub enum ClientEvent {
    /// Open a connection to the server, and hand in [`Input::Opened`] or [`Input::Closed`].
    Dial {
        /// 1 for the first try since the run began or since a session stood; asking again after a 4xx counts as one.
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
    /// The id as it travels.
    id: String,
    exchange: Exchange,
    gauge: Gauge,
    state: State,
    /// Pauses since the run began or since a session stood; each is longer than the one before.
    pauses: u32,
    /// Tries since the run began or since a session stood.
    tries: u32,
    outbox: Outbox<ClientEvent>,
}

/// Where the client stands.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// The owner was asked for a connection. No deadline yet where no instant was known when it was asked.
    Dialling { deadline: Option<Instant> },
    /// The connection stands and `Connect` went out.
    Connecting { deadline: Instant },
    /// Until the next try: on the connection that stands, or on a new one.
    Paused { until: Instant, connected: bool },
    /// The server said 200.
    Established,
    /// `Connect` with `enable: false` went out.
    Disconnecting { deadline: Instant },
    /// Done for good.
    Ended,
}

impl State {
    fn is_connected(self) -> bool {
        match self {
            State::Connecting { .. } | State::Established | State::Disconnecting { .. } => true,
            State::Paused { connected, .. } => connected,
            State::Dialling { .. } | State::Ended => false,
        }
    }
}

impl Client {
    /// A client of the plant that `map` describes. Its first output asks for a connection.
    pub fn new(settings: ClientSettings, map: Arc<SignalMap>) -> Client {
        let mut outbox = Outbox::new();
        outbox.event(ClientEvent::Dial { attempt: 1 });
        Client {
            id: to_base64(&settings.id),
            gauge: Gauge::new(&settings.limits),
            settings,
            exchange: Exchange::new(map, Direction::Report),
            state: State::Dialling { deadline: None },
            pauses: 0,
            tries: 1,
            outbox,
        }
    }

    /// Takes what happened.
    pub fn handle(&mut self, now: Instant, input: Input<'_>) {
        match input {
            Input::Timeout => self.time_passed(now),
            Input::Opened => self.opened(now),
            Input::Closed => self.closed(now),
            // Whatever else came, it came over a connection that is no longer ours.
            _ if !self.state.is_connected() => {}
            _ if self.outbox.is_full() => {
                self.hang_up(now, close_code::POLICY, format!("{OUTPUT_LIMIT} outputs were not fetched"));
            }
            Input::Text(_) | Input::Binary if let Err(reason) = self.gauge.count(now) => {
                self.hang_up(now, close_code::POLICY, reason);
            }
            Input::Text(text) => self.text(now, text),
            Input::Binary => self.notice("a binary message was ignored: the protocol speaks JSON text"),
            Input::InvalidUtf8 => self.hang_up(now, close_code::NOT_UTF8, "a message was not UTF-8"),
            Input::TooLong { limit } => {
                self.hang_up(now, close_code::TOO_BIG, format!("a message was longer than {limit} bytes"));
            }
        }
    }

    /// Sends `values`, all of them reports, in one `SendValue`. Says whether a message went out: none does while no
    /// session stands, and after the next [`ClientEvent::Established`] all present values are due anyway.
    pub fn send(&mut self, now: Instant, values: &[(RegisterId, Value)]) -> bool {
        if self.state != State::Established {
            return false;
        }
        if self.outbox.is_full() {
            self.hang_up(now, close_code::POLICY, format!("{OUTPUT_LIMIT} outputs were not fetched"));
            return false;
        }
        let sending = self.exchange.send(values.iter());
        for (register, reason) in sending.unsendable {
            self.outbox.event(ClientEvent::Unsendable { register, reason });
        }
        let goes = sending.text.is_some();
        sending.text.into_iter().for_each(|text| self.outbox.transmit(text));
        goes
    }

    /// Ends the session: tells the server, waits for its answer, at most for the timeout, and closes. Values that arrive
    /// meanwhile are still given. Where the server was never told of a session, the client ends at once.
    pub fn disconnect(&mut self, now: Instant) {
        match self.state {
            State::Connecting { .. } | State::Established => {
                let connect = Connect { id: Cow::Borrowed(&self.id), enable: false, signals: None };
                self.outbox.transmit(Message::Connect(connect).encode());
                self.state = State::Disconnecting { deadline: now + self.settings.timeout };
            }
            State::Dialling { .. } | State::Paused { .. } => {
                if self.state.is_connected() || matches!(self.state, State::Dialling { .. }) {
                    self.outbox.close(close_code::NORMAL, "the run is over");
                }
                self.end(Ending::Disconnected);
            }
            State::Disconnecting { .. } | State::Ended => {}
        }
    }

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Output<ClientEvent>> {
        self.outbox.pop()
    }

    /// When [`Input::Timeout`] is due; `None` if nothing is awaited.
    pub fn timeout(&self) -> Option<Instant> {
        match self.state {
            // The deadline of the first dial cannot be known before the owner says what time it is: due at once.
            State::Dialling { deadline } => Some(deadline.unwrap_or(Instant::from_nanos(i64::MIN))),
            State::Connecting { deadline } | State::Disconnecting { deadline } => Some(deadline),
            State::Paused { until, .. } => Some(until),
            State::Established | State::Ended => None,
        }
    }

    /// Whether a session stands.
    pub fn is_established(&self) -> bool {
        self.state == State::Established
    }

    /// Whether the client is done for good.
    pub fn is_ended(&self) -> bool {
        self.state == State::Ended
    }

    fn time_passed(&mut self, now: Instant) {
        match self.state {
            State::Dialling { deadline: None } => {
                self.state = State::Dialling { deadline: Some(now + self.settings.timeout) };
            }
            State::Dialling { deadline: Some(deadline) } if deadline <= now => {
                let timeout = format_duration(self.settings.timeout);
                self.hang_up(now, close_code::NORMAL, format!("no connection within {timeout}"));
            }
            State::Connecting { deadline } if deadline <= now => {
                let timeout = format_duration(self.settings.timeout);
                self.hang_up(now, close_code::POLICY, format!("no valid answer to Connect within {timeout}"));
            }
            State::Paused { until, connected } if until <= now => {
                self.tries = self.tries.saturating_add(1);
                if connected {
                    return self.introduce(now);
                }
                self.outbox.event(ClientEvent::Dial { attempt: self.tries });
                self.state = State::Dialling { deadline: Some(now + self.settings.timeout) };
            }
            State::Disconnecting { deadline } if deadline <= now => {
                self.outbox.close(close_code::NORMAL, "the run is over");
                self.end(Ending::Unanswered);
            }
            _ => {}
        }
    }

    fn opened(&mut self, now: Instant) {
        match self.state {
            State::Dialling { .. } => self.introduce(now),
            // Abandoned in the meantime: the run is over, or the dial took too long.
            State::Paused { connected: false, .. } | State::Ended => {
                self.outbox.close(close_code::NORMAL, "no longer wanted");
            }
            _ => self.notice("the connection was opened twice"),
        }
    }

    fn introduce(&mut self, now: Instant) {
        let connect = Connect { id: Cow::Borrowed(&self.id), enable: true, signals: self.settings.signals.clone() };
        self.outbox.transmit(Message::Connect(connect).encode());
        self.state = State::Connecting { deadline: now + self.settings.timeout };
    }

    fn closed(&mut self, now: Instant) {
        match self.state {
            State::Dialling { .. } => self.lose(now, "no connection could be made"),
            State::Connecting { .. } => self.lose(now, "the connection ended before the server answered"),
            State::Established => self.lose(now, "the connection ended"),
            State::Paused { until, connected: true } => {
                self.notice("the connection ended while waiting to ask again");
                self.state = State::Paused { until, connected: false };
            }
            State::Disconnecting { .. } => self.end(Ending::Unanswered),
            State::Paused { connected: false, .. } | State::Ended => {}
        }
    }

    /// Closes the connection, or gives up the dial, and tries again later.
    fn hang_up(&mut self, now: Instant, code: u16, reason: impl Into<String>) {
        let reason = reason.into();
        self.outbox.close(code, reason.clone());
        match self.state {
            State::Disconnecting { .. } => self.end(Ending::Unanswered),
            _ => self.lose(now, reason),
        }
    }

    fn lose(&mut self, now: Instant, reason: impl Into<String>) {
        let was_established = self.is_established();
        let retry_at = self.pause(now, false);
        self.outbox.event(ClientEvent::Lost { reason: reason.into(), was_established, retry_at });
    }

    /// Waits before the next try, longer after each failure. Gives the instant of that try.
    fn pause(&mut self, now: Instant, connected: bool) -> Instant {
        let factor = 2u32.saturating_pow(self.pauses);
        let pause = self.settings.first_pause.saturating_mul(factor).min(self.settings.longest_pause);
        self.pauses = self.pauses.saturating_add(1);
        let until = now + pause;
        self.state = State::Paused { until, connected };
        until
    }

    fn text(&mut self, now: Instant, text: &str) {
        if self.takes_values()
            && let Some(staged) = self.exchange.receive_plain(text, self.settings.limits.values)
        {
            return self.outbox.event(ClientEvent::Values(staged));
        }
        match Message::decode(text) {
            Err(error) => self.reject(text, error.to_string()),
            Ok(Message::ConnectReply(reply)) => self.connect_reply(now, &reply),
            Ok(Message::SendValue(entries)) => self.values(text, &entries),
            Ok(Message::SendValueReply(faults)) => self.outbox.event(ClientEvent::Faults(faults)),
            Ok(other) => self.reject(text, format!("{} is nothing that a client was waiting for", other.name())),
        }
    }

    fn connect_reply(&mut self, now: Instant, reply: &ConnectReply<'_>) {
        if reply.id != self.id {
            let foreign = from_base64(&reply.id);
            return self.notice(format!("a ConnectReply was ignored: its Id is {foreign:?}, not ours"));
        }
        match (self.state, reply.enable) {
            (State::Connecting { .. }, true) => self.answered(now, reply),
            (State::Disconnecting { .. }, false) => {
                if !reply.result.is_accepted() {
                    let said = reply.message.as_deref().unwrap_or("no reason given");
                    self.notice(format!("the server answered the disconnection with {}: {said}", reply.result));
                }
                self.outbox.close(close_code::NORMAL, "the run is over");
                self.end(Ending::Disconnected);
            }
            // The answer to the Connect that this disconnection overtook.
            (State::Disconnecting { .. }, true) => {}
            (State::Connecting { .. }, false) => {
                self.notice("a ConnectReply was ignored: it says enable false, and Connect said true");
            }
            _ => self.notice("a ConnectReply was ignored: nothing was asked"),
        }
    }

    fn answered(&mut self, now: Instant, reply: &ConnectReply<'_>) {
        let (result, message) = (reply.result, reply.message.as_deref().map(str::to_owned));
        if result.is_accepted() {
            self.state = State::Established;
            (self.pauses, self.tries) = (0, 0);
            message.into_iter().for_each(|said| self.notice(format!("the server accepted, and said: {said}")));
            self.outbox.event(ClientEvent::Established { server_name: from_base64(&reply.server_name) });
        } else if result.is_temporary() {
            let retry_at = Some(self.pause(now, true));
            self.outbox.event(ClientEvent::Refused { result, message, retry_at });
        } else if result.is_permanent() {
            self.outbox.close(close_code::NORMAL, format!("refused with {result}"));
            self.outbox.event(ClientEvent::Refused { result, message: message.clone(), retry_at: None });
            self.end(Ending::Refused { result, message });
        } else {
            self.notice(format!("a ConnectReply was ignored: its result {result} is neither 200 nor 4xx nor 5xx"));
        }
    }

    /// Whether the session stands, or is being ended.
    fn takes_values(&self) -> bool {
        matches!(self.state, State::Established | State::Disconnecting { .. })
    }

    fn values(&mut self, text: &str, entries: &[Entry<'_>]) {
        if !self.takes_values() {
            return self.reject(text, "values came before the server accepted the session".to_owned());
        }
        if let Some(reason) = self.settings.limits.refuse(entries.len()) {
            return self.reject(text, reason);
        }
        let receipt = self.exchange.receive(text, entries);
        if receipt.nameless > 0 {
            self.notice(format!("{} entries of a SendValue had no name", receipt.nameless));
        }
        match receipt.outcome {
            Ok(staged) => self.outbox.event(ClientEvent::Values(staged)),
            Err(reason) => self.reject(text, reason),
        }
        receipt.reply.into_iter().for_each(|reply| self.outbox.transmit(reply));
    }

    fn reject(&mut self, text: &str, reason: String) {
        self.outbox.event(ClientEvent::Rejected { text: one_line(text), reason });
    }

    fn notice(&mut self, text: impl Into<String>) {
        self.outbox.event(ClientEvent::Notice(text.into()));
    }

    fn end(&mut self, ending: Ending) {
        self.state = State::Ended;
        self.outbox.event(ClientEvent::Ended(ending));
    }
}
