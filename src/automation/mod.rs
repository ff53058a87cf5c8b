//! The other half of a virtual commissioning: an automation that speaks the server's side of the CPS-Protocol and
//! controls the plants by an event-driven network of function blocks, as an IEC 61499 runtime does.
//!
//! It knows a plant by its signals alone. Nothing here imports the engine, the devices or the plant's model; what a
//! program knows of a plant (which belt follows which, where the robot picks) stands in the program, as it would in a
//! real controller's.
//!
//! [`Automation`] does no IO and reads no clock: it is told what happens on its connections and what time it is, and says
//! what to send. Around it lie, from the inside out: [`Faulty`], which misbehaves on demand, and [`server`], which has
//! the sockets and the clock. A run as fast as possible leaves [`server`] out and hands the texts over itself.
//!
//! # Several simulations
//!
//! Any number of simulations may be connected, and all of them receive the same messages in the same order; one that
//! comes later first receives the present value of every command. **The inputs of one of them control**: of the session
//! that has been open longest. The others are only told. When it ends, the next oldest takes over, with what it reported
//! so far.
//!
//! A program starts when the first simulation connects, with all commands at 0. It goes on when that simulation is lost
//! and returns (its `Id` tells). When no session is open and one of another `Id` connects, that is another plant: the
//! program starts anew.

#[cfg(test)]
mod bench;
pub mod block;
pub mod fault;
pub mod image;
pub mod network;
pub mod playback;
pub mod program;
mod round_trip;
pub mod server;
#[cfg(test)]
mod tests;

pub use fault::{Fault, Faulty};
pub use image::BindError;
pub use network::Counts;
pub use program::Control;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use hdrhistogram::Histogram;

use crate::session::{Input, Output as SessionOutput, Server, ServerEvent, ServerSettings, Staged};
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;
use crate::wire::ResultCode;
use image::Image;
use network::{Context, Program, Verbatim};
use program::StartError;
use round_trip::RoundTrip;

/// A connection, as its owner numbers them: in the order in which they were opened, never one number twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ConnectionId(pub u64);

/// What the automation wants done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Send this text message.
    Transmit { connection: ConnectionId, text: String },
    /// Close the connection with this WebSocket status code and reason.
    Close { connection: ConnectionId, code: u16, reason: String },
}

/// What went through an automation so far.
#[derive(Clone, Debug)]
pub struct Statistics {
    /// Sessions that stand.
    pub sessions: usize,
    /// Sessions that stood since the start.
    pub sessions_ever: u64,
    /// `SendValue` messages received, of all sessions.
    pub messages_in: u64,
    /// `SendValue` messages sent, of all sessions.
    pub messages_out: u64,
    /// Values accepted, of all sessions.
    pub values_in: u64,
    /// Values of ours that a simulation refused.
    pub refused: u64,
    /// What the control program has counted.
    pub counts: Counts,
    /// From a value sent to the simulation's answer to it, in nanoseconds, on the clock handed in; of the controlling
    /// session.
    pub round_trip_ns: Histogram<u64>,
}

/// One connection.
struct Session {
    server: Server,
    /// The client's id, while a session stands.
    id: Option<String>,
    /// What it reported last, by register.
    reports: BTreeMap<RegisterId, Value>,
}

/// The automation: its program, and the sessions with the simulations that are connected.
///
/// Drive it like a session: [`handle`](Automation::handle) for everything a connection gives, [`wake`](Automation::wake)
/// when the instant of [`timeout`](Automation::timeout) has come, and [`poll`](Automation::poll) after each until it gives
/// `None`.
pub struct Automation {
    map: Arc<SignalMap>,
    control: Control,
    server_settings: ServerSettings,
    program: Box<dyn Program>,
    image: Image,
    wakes: BTreeSet<Instant>,
    sessions: BTreeMap<ConnectionId, Session>,
    controller: Option<ConnectionId>,
    /// The id of the simulation that controls, or controlled last.
    controller_id: Option<String>,
    events: VecDeque<(ConnectionId, ServerEvent)>,
    outputs: VecDeque<Output>,
    round_trip: RoundTrip,
    statistics: Statistics,
}

/// What the server calls itself.
const SERVER_NAME: &str = "nxt-mock";

impl Automation {
    /// An automation that controls the plant of `map` by `control`.
    pub fn new(map: Arc<SignalMap>, mut control: Control) -> Result<Automation, StartError> {
        let program = control.program(&map)?;
        let round_trip = RoundTrip::new(map.clone());
        let statistics = Statistics {
            sessions: 0,
            sessions_ever: 0,
            messages_in: 0,
            messages_out: 0,
            values_in: 0,
            refused: 0,
            counts: Counts::default(),
            round_trip_ns: round_trip.histogram().clone(),
        };
        Ok(Automation {
            image: Image::new(map.clone()),
            map,
            control,
            server_settings: ServerSettings::new(SERVER_NAME),
            program,
            wakes: BTreeSet::new(),
            sessions: BTreeMap::new(),
            controller: None,
            controller_id: None,
            events: VecDeque::new(),
            outputs: VecDeque::new(),
            round_trip,
            statistics,
        })
    }

    /// From the next connection on, refuses every `Connect` with this result and these words; `None` accepts.
    pub fn refuse(&mut self, refusal: Option<(ResultCode, String)>) {
        self.server_settings.refuse = refusal;
    }

    /// The signals it controls and reads.
    pub fn map(&self) -> &Arc<SignalMap> {
        &self.map
    }

    /// The present value of every command.
    pub fn commands(&self) -> Vec<(RegisterId, Value)> {
        self.image.commands()
    }

    /// What went through so far. Copies a histogram: not for every step.
    pub fn statistics(&self) -> Statistics {
        let sessions = self.sessions.values().filter(|session| session.id.is_some()).count();
        let round_trip_ns = self.round_trip.histogram().clone();
        Statistics { sessions, counts: self.program.counts(), round_trip_ns, ..self.statistics.clone() }
    }

    /// Takes what happened on a connection. [`Input::Opened`] makes it known; [`Input::Closed`] ends it.
    pub fn handle(&mut self, now: Instant, connection: ConnectionId, input: Input<'_>) {
        if input == Input::Opened {
            let server = Server::new(self.server_settings.clone(), self.map.clone());
            self.sessions.insert(connection, Session { server, id: None, reports: BTreeMap::new() });
        }
        let Some(session) = self.sessions.get_mut(&connection) else { return };
        session.server.handle(now, input);
        self.pump(connection);
        self.settle(now);
    }

    /// Ends every connection with this WebSocket status code and reason.
    pub fn close(&mut self, now: Instant, code: u16, reason: &str) {
        let connections: Vec<ConnectionId> = self.sessions.keys().copied().collect();
        for connection in connections {
            if let Some(session) = self.sessions.get_mut(&connection) {
                session.server.close(code, reason);
            }
            self.pump(connection);
        }
        self.settle(now);
    }

    /// The instant that [`timeout`](Automation::timeout) named has come. Called too early, it does nothing.
    pub fn wake(&mut self, now: Instant) {
        let due = |session: &Session| session.server.timeout().is_some_and(|due| due <= now);
        let due: Vec<ConnectionId> = self.sessions.iter().filter(|(_, s)| due(s)).map(|(id, _)| *id).collect();
        for connection in due {
            self.handle(now, connection, Input::Timeout);
        }
        let later = self.wakes.split_off(&(now + std::time::Duration::from_nanos(1)));
        let woken = std::mem::replace(&mut self.wakes, later);
        if !woken.is_empty() {
            self.run(now, |program, cx| program.event(cx));
        }
    }

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Output> {
        self.outputs.pop_front()
    }

    /// When [`wake`](Automation::wake) is due; `None` if nothing is awaited.
    pub fn timeout(&self) -> Option<Instant> {
        let sessions = self.sessions.values().filter_map(|session| session.server.timeout());
        sessions.chain(self.wakes.first().copied()).min()
    }

    /// Moves what a session says to the outputs and events.
    fn pump(&mut self, connection: ConnectionId) {
        let Some(session) = self.sessions.get_mut(&connection) else { return };
        while let Some(output) = session.server.poll() {
            match output {
                SessionOutput::Transmit(text) => self.outputs.push_back(Output::Transmit { connection, text }),
                SessionOutput::Close { code, reason } => {
                    self.outputs.push_back(Output::Close { connection, code, reason });
                }
                SessionOutput::Event(event) => self.events.push_back((connection, event)),
            }
        }
    }

    /// Acts on what the sessions told.
    fn settle(&mut self, now: Instant) {
        while let Some((connection, event)) = self.events.pop_front() {
            match event {
                ServerEvent::Connected { id } => self.connected(now, connection, id),
                ServerEvent::Values(staged) => self.values(now, connection, &staged),
                ServerEvent::Disconnected => {
                    tracing::info!(target: "automation", "{now:>11} session {} disconnected", connection.0);
                    self.ended(now, connection);
                }
                ServerEvent::Ended { reason, was_established } => {
                    if was_established {
                        tracing::info!(target: "automation", "{now:>11} session {} ended: {reason}", connection.0);
                    }
                    self.ended(now, connection);
                    self.sessions.remove(&connection);
                }
                ServerEvent::Refused { id, result } => {
                    tracing::info!(target: "automation", "{now:>11} refused {id:?} with {}", result.0);
                }
                ServerEvent::Faults(faults) => {
                    self.statistics.refused += faults.len() as u64;
                    for fault in faults {
                        let (name, result, message) = (fault.name, fault.result.0, fault.message);
                        tracing::warn!(target: "automation", "{now:>11} the simulation refused {name}: {result} {message}");
                    }
                }
                ServerEvent::Rejected { reason, .. } => {
                    tracing::warn!(target: "automation", "{now:>11} a message of session {} is of no use: {reason}", connection.0);
                }
                ServerEvent::Unsendable { reason, .. } | ServerEvent::Notice(reason) => {
                    tracing::warn!(target: "automation", "{now:>11} session {}: {reason}", connection.0);
                }
            }
        }
    }

    /// A session stands: it receives all present commands, and controls if no other does.
    fn connected(&mut self, now: Instant, connection: ConnectionId, id: String) {
        tracing::info!(target: "automation", "{now:>11} session {} of {id:?} stands", connection.0);
        self.statistics.sessions_ever += 1;
        let first = self.controller.is_none();
        if first && self.controller_id.as_ref() != Some(&id) {
            self.start(now);
        }
        if first {
            self.controller = Some(connection);
            self.controller_id = Some(id.clone());
        }
        let commands = self.image.commands();
        let Some(session) = self.sessions.get_mut(&connection) else { return };
        session.id = Some(id);
        session.reports.clear();
        session.server.send(now, &commands);
        self.statistics.messages_out += 1;
        self.pump(connection);
    }

    /// Starts the program, or starts it anew, with all commands at 0. No session stands: what changes here goes out with
    /// all present commands.
    fn start(&mut self, now: Instant) {
        match self.control.program(&self.map) {
            Ok(program) => self.program = program,
            Err(error) => {
                tracing::error!(target: "automation", "{now:>11} failed to start the program anew, it goes on: {error}");
                return;
            }
        }
        self.image = Image::new(self.map.clone());
        self.wakes.clear();
        self.run(now, |program, cx| program.start(cx));
    }

    /// Values arrived.
    fn values(&mut self, now: Instant, connection: ConnectionId, staged: &Staged) {
        self.statistics.messages_in += 1;
        self.statistics.values_in += staged.values.len() as u64;
        let Some(session) = self.sessions.get_mut(&connection) else { return };
        for (register, value) in &staged.values {
            session.reports.insert(*register, value.clone());
        }
        if self.controller == Some(connection) {
            self.round_trip.received(now, &staged.values);
            self.image.take(&staged.values);
            self.run(now, |program, cx| program.event(cx));
        }
    }

    /// A session ended: the oldest of those that stand takes over.
    fn ended(&mut self, now: Instant, connection: ConnectionId) {
        let Some(session) = self.sessions.get_mut(&connection) else { return };
        session.id = None;
        if self.controller != Some(connection) {
            return;
        }
        self.round_trip.forget();
        let next = self.sessions.iter().find(|(_, session)| session.id.is_some());
        self.controller = next.map(|(connection, _)| *connection);
        if let Some((connection, session)) = next {
            tracing::info!(target: "automation", "{now:>11} session {} controls from now on", connection.0);
            self.controller_id = session.id.clone();
            let reports: Vec<_> = session.reports.iter().map(|(register, value)| (*register, value.clone())).collect();
            self.image.take(&reports);
            self.run(now, |program, cx| program.event(cx));
        }
    }

    /// Runs one event of the program; the commands that it changed leave together, to every session.
    fn run(&mut self, now: Instant, event: impl FnOnce(&mut dyn Program, &mut Context<'_>)) {
        let mut verbatim = Vec::new();
        event(self.program.as_mut(), &mut Context::new(now, &mut self.image, &mut self.wakes, &mut verbatim));
        let changed = self.image.take_changed();
        let open: Vec<ConnectionId> =
            self.sessions.iter().filter(|(_, session)| session.id.is_some()).map(|(id, _)| *id).collect();
        if !changed.is_empty() {
            if !open.is_empty() {
                self.round_trip.sent(now, &changed);
            }
            for connection in &open {
                if let Some(session) = self.sessions.get_mut(connection) {
                    session.server.send(now, &changed);
                    self.statistics.messages_out += 1;
                }
                self.pump(*connection);
            }
        }
        for Verbatim { text, sets } in verbatim {
            if !open.is_empty() {
                self.round_trip.sent(now, &sets);
            }
            for connection in &open {
                self.statistics.messages_out += 1;
                self.outputs.push_back(Output::Transmit { connection: *connection, text: text.clone() });
            }
        }
    }
}
