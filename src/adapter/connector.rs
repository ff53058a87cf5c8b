//! The connector for the CPS-Protocol: the client session over a transport of text messages.

use std::collections::VecDeque;
use std::sync::Arc;
use std::task::{Context, Poll};

use super::outbox::{Due, Outbox};
use super::{Adapter, Memory, Settings, SettingsError};
use crate::bank::Overrun;
use crate::session::{Client, ClientEvent, ClientSettings, Ending, Input, Output, Staged, close_code};
use crate::signal_map::SignalMap;
use crate::time::Instant;
use crate::trace::Sender;
use crate::wire::Fault;

/// What a transport has for its connector.
#[derive(Debug, PartialEq, Eq)]
pub enum Received {
    /// The connection stands.
    Opened,
    Text(String),
    Binary,
    /// A text that is not UTF-8.
    InvalidUtf8,
    /// A message over the limit of so many bytes; it was not read.
    TooLong {
        limit: usize,
    },
    /// The connection ended or could not be made; why, for people.
    Closed(String),
    /// The connection could not be made because one side does not accept what the other shows of itself, a certificate or
    /// a token; why and what to do, for people. Trying again is of no use.
    Denied(String),
}

/// Carries text messages to the automation and back. It never waits.
pub trait Transport {
    /// A transport as `settings` say; opens nothing yet.
    fn configure(&mut self, settings: &Settings);

    /// Begins to open a connection; what becomes of it is [`Received`].
    fn dial(&mut self, now: Instant);

    /// What has arrived. Leaves `cx`'s waker where nothing has.
    fn poll_receive(&mut self, cx: &mut Context<'_>, now: Instant) -> Poll<Received>;

    /// Takes a message to send.
    fn send(&mut self, now: Instant, text: String);

    /// Sends what it took as far as the other side takes it.
    fn flush(&mut self, cx: &mut Context<'_>);

    /// Whether so much waits to be sent that no more should be given.
    fn is_congested(&self) -> bool;

    /// Closes the connection, if there is one, with this WebSocket status code and reason.
    fn close(&mut self, now: Instant, code: u16, reason: &str);

    /// Whether nothing is left to do: no connection, none being closed.
    fn is_idle(&self) -> bool;

    /// Drops everything at once.
    fn abort(&mut self);
}

/// What went through a connector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// `SendValue` messages that arrived and of which something could be used.
    pub messages_in: u64,
    /// `SendValue` messages that were sent.
    pub messages_out: u64,
    /// `SendValue` messages that could not be kept until they were wanted: commands that the simulation did not take in
    /// time, and reports that the automation did not read in time (each lost change counts as one).
    pub messages_lost: u64,
    /// Values accepted.
    pub values_in: u64,
    /// Values sent.
    pub values_out: u64,
}

/// What a connector tells of itself.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// What the session says.
    Session(ClientEvent),
    /// Values that arrived in a message with good ones could not be used; the automation has been told.
    ValuesRefused(Vec<Fault>),
    /// One side does not accept what the other shows of itself, a certificate or a token: why, and what to do.
    Denied(String),
    /// The automation did not read for so long that this many changes could not be kept.
    ReportsLost { changes: u64 },
    /// The automation sent faster than the simulation takes, and the queue is full.
    CommandsLost { values: u64 },
}

/// Frames taken from the transport in one turn; more wait for the next, so that sending is never starved.
const FRAMES_A_TURN: usize = 1_024;

/// An [`Adapter`] for the CPS-Protocol over any [`Transport`].
pub struct Connector<T> {
    transport: T,
    settings: Option<Settings>,
    session: Option<Session>,
    events: VecDeque<Event>,
    traffic: Traffic,
}

/// What exists from `init` on.
struct Session {
    client: Client,
    outbox: Outbox,
    /// What passed since the memory was last updated, in order.
    passed: VecDeque<Passed>,
    /// How much of it is to be moved into the memory.
    arrived: usize,
    /// Why the connection ended or could not be made, in the transport's words.
    why: Option<String>,
    /// Whether `connect` was called.
    wanted: bool,
    ended: bool,
}

/// A message that passed.
enum Passed {
    /// The automation's values, for the memory.
    Values(Staged),
    /// Anything else that was received, or sent.
    Other(Sender, String),
}

impl<T: Transport> Connector<T> {
    /// A connector over `transport`, not yet configured.
    pub fn over(transport: T) -> Connector<T> {
        Connector { transport, settings: None, session: None, events: VecDeque::new(), traffic: Traffic::default() }
    }

    /// The transport.
    pub fn transport(&mut self) -> &mut T {
        &mut self.transport
    }

    /// Obeys all that the session wants done.
    fn drain(&mut self, now: Instant) {
        let Some(session) = self.session.as_mut().filter(|session| session.wanted) else { return };
        while let Some(output) = session.client.poll() {
            match output {
                Output::Transmit(text) => {
                    session.passed.push_back(Passed::Other(Sender::Plant, text.clone()));
                    self.transport.send(now, text);
                }
                Output::Close { code, reason } => self.transport.close(now, code, &reason),
                Output::Event(event) => session.take(event, &mut self.transport, &mut self.events, now),
            }
        }
    }

    fn handle(&mut self, now: Instant, input: Input<'_>) {
        if let Some(session) = &mut self.session {
            session.client.handle(now, input);
        }
        self.drain(now);
    }

    fn receive(&mut self, now: Instant, received: Received) {
        match received {
            Received::Opened => self.handle(now, Input::Opened),
            Received::Text(text) => self.receive_text(now, text),
            Received::Binary => self.handle(now, Input::Binary),
            Received::InvalidUtf8 => self.handle(now, Input::InvalidUtf8),
            Received::TooLong { limit } => self.handle(now, Input::TooLong { limit }),
            Received::Denied(why) => {
                self.events.push_back(Event::Denied(why.clone()));
                self.receive(now, Received::Closed(why));
            }
            Received::Closed(why) => {
                self.set_why(Some(why));
                self.handle(now, Input::Closed);
                // Of this connection alone, and of no later one.
                self.set_why(None);
            }
        }
    }

    fn set_why(&mut self, why: Option<String>) {
        if let Some(session) = &mut self.session {
            session.why = why;
        }
    }

    fn receive_text(&mut self, now: Instant, text: String) {
        let Some(session) = &mut self.session else { return };
        let before = session.arrived;
        session.client.handle(now, Input::Text(&text));
        // Before what it brought about: replies follow what they answer.
        let place = session.passed.len();
        self.drain(now);
        let Some(session) = &mut self.session else { return };
        if session.arrived == before {
            let one_line = if text.contains(['\n', '\r']) { text.replace(['\n', '\r'], " ") } else { text };
            session.passed.insert(place, Passed::Other(Sender::Automation, one_line));
        }
    }

    /// Whether something waits to be moved into the memory.
    fn has_arrivals(&self) -> bool {
        self.session.as_ref().is_some_and(|session| session.arrived > 0)
    }

    /// Ends a connection that something was lost on; the session makes a new one, and starts from present values.
    fn drop_connection(&mut self, now: Instant, reason: &str) {
        self.transport.close(now, close_code::POLICY, reason);
        self.handle(now, Input::Closed);
    }

    fn stage(&mut self, now: Instant, memory: &mut Memory<'_>) {
        let mut lost = 0;
        let Some(session) = &mut self.session else { return };
        session.arrived = 0;
        for passed in session.passed.drain(..) {
            let staged = match passed {
                Passed::Other(from, text) => {
                    memory.witness.exchanged(from, &text);
                    continue;
                }
                Passed::Values(staged) => staged,
            };
            // After a loss nothing more of this connection may act: order would be broken.
            let number = if lost == 0 { memory.bank.stage(&staged.values).ok() } else { None };
            match number {
                Some(number) => {
                    self.traffic.messages_in += 1;
                    self.traffic.values_in += staged.values.len() as u64;
                    memory.witness.staged(number, staged.text);
                }
                None => {
                    self.traffic.messages_lost += 1;
                    lost += staged.values.len() as u64;
                }
            }
        }
        if lost > 0 {
            self.events.push_back(Event::CommandsLost { values: lost });
            self.drop_connection(now, "values arrive faster than the simulation takes them");
        }
    }

    fn report(&mut self, now: Instant, memory: &mut Memory<'_>, due: Due) {
        // What the automation does not read stays in the bank, whose log is the bound.
        if self.transport.is_congested() {
            return;
        }
        let Connector { session: Some(session), transport, traffic, .. } = self else { return };
        let Session { outbox, client, .. } = session;
        let mut outputs = Vec::new();
        let collected = outbox.collect(memory.bank, due, |report| {
            if client.send(now, report.values) {
                traffic.messages_out += 1;
                traffic.values_out += report.values.len() as u64;
            }
            while let Some(output) = client.poll() {
                match output {
                    Output::Transmit(text) => {
                        memory.witness.reported(report.at, &text);
                        transport.send(now, text);
                    }
                    other => outputs.push(other),
                }
            }
        });
        for output in outputs {
            match output {
                Output::Event(event) => session.take(event, transport, &mut self.events, now),
                Output::Close { code, reason } => transport.close(now, code, &reason),
                Output::Transmit(_) => {}
            }
        }
        match collected {
            Ok(None) => {}
            Ok(Some(at)) => memory.witness.reached(at),
            Err(Overrun { lost }) => {
                self.traffic.messages_lost += lost;
                self.events.push_back(Event::ReportsLost { changes: lost });
                self.drop_connection(now, "reports are not read as fast as they come");
            }
        }
    }
}

impl Session {
    fn take<T: Transport>(
        &mut self,
        mut event: ClientEvent,
        transport: &mut T,
        events: &mut VecDeque<Event>,
        now: Instant,
    ) {
        match &mut event {
            ClientEvent::Dial { .. } => transport.dial(now),
            ClientEvent::Values(staged) => {
                if !staged.faults.is_empty() {
                    events.push_back(Event::ValuesRefused(std::mem::take(&mut staged.faults)));
                }
                self.arrived += 1;
            }
            ClientEvent::Established { .. } => self.outbox.start(),
            ClientEvent::Lost { reason, .. } => {
                // The transport knows better than the session why.
                *reason = self.why.take().unwrap_or_else(|| std::mem::take(reason));
                self.outbox.stop();
            }
            ClientEvent::Ended(_) => {
                self.ended = true;
                self.outbox.stop();
            }
            _ => {}
        }
        match event {
            ClientEvent::Values(staged) => self.passed.push_back(Passed::Values(staged)),
            event => events.push_back(Event::Session(event)),
        }
    }
}

impl<T: Transport> Adapter for Connector<T> {
    fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.validate()?;
        self.transport.configure(&settings);
        self.settings = Some(settings);
        Ok(())
    }

    fn init(&mut self, map: &Arc<SignalMap>) {
        let settings = self.settings.as_ref().expect("an adapter is configured before it is initialised");
        let client = ClientSettings {
            timeout: settings.timeout,
            limits: settings.limits,
            signals: settings.signals.clone(),
            ..ClientSettings::new(settings.id.clone())
        };
        self.session = Some(Session {
            client: Client::new(client, Arc::clone(map)),
            outbox: Outbox::default(),
            passed: VecDeque::new(),
            arrived: 0,
            why: None,
            wanted: false,
            ended: false,
        });
    }

    fn connect(&mut self) {
        if let Some(session) = &mut self.session {
            session.wanted = true;
        }
    }

    fn hf_io(&mut self, cx: &mut Context<'_>, now: Instant) -> bool {
        self.drain(now);
        for _ in 0..FRAMES_A_TURN {
            match self.transport.poll_receive(cx, now) {
                Poll::Ready(received) => self.receive(now, received),
                Poll::Pending if self.deadline().is_some_and(|due| due <= now) => self.handle(now, Input::Timeout),
                Poll::Pending => {
                    self.transport.flush(cx);
                    return self.has_arrivals();
                }
            }
        }
        // There is more: another turn, after this one's sending.
        self.transport.flush(cx);
        cx.waker().wake_by_ref();
        self.has_arrivals()
    }

    fn hf_memory_update(&mut self, now: Instant, memory: &mut Memory<'_>, levels_due: bool) {
        self.stage(now, memory);
        self.report(now, memory, Due { high: levels_due, low: false });
    }

    fn lf_memory_update(&mut self, now: Instant, memory: &mut Memory<'_>) {
        self.report(now, memory, Due { high: false, low: true });
    }

    fn deadline(&self) -> Option<Instant> {
        self.session.as_ref().filter(|session| session.wanted).and_then(|session| session.client.timeout())
    }

    fn poll_event(&mut self) -> Option<Event> {
        self.events.pop_front()
    }

    fn traffic(&self) -> Traffic {
        self.traffic
    }

    fn is_connected(&self) -> bool {
        self.session.as_ref().is_some_and(|session| session.client.is_established())
    }

    fn disconnect(&mut self, now: Instant) {
        if let Some(session) = &mut self.session {
            session.client.disconnect(now);
        }
        self.drain(now);
    }

    fn is_done(&self) -> bool {
        self.session.as_ref().is_none_or(|session| session.ended || !session.wanted) && self.transport.is_idle()
    }

    fn dispose(&mut self) {
        self.transport.abort();
        self.session = None;
    }
}

impl Event {
    /// Whether the session ended for good because the server refused it for good (5xx).
    pub fn is_final_refusal(&self) -> bool {
        matches!(self, Event::Session(ClientEvent::Ended(Ending::Refused { .. })))
    }
}
