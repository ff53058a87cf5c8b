//! The Adapter Layer: what stands between the shared-memory register bank and whatever the automation speaks.
//!
//! An [`Adapter`] has the life cycle of the reference's Adapter Layer API (section 5.3.2.3): it is configured, initialised
//! with the signals map, connected, driven by two loops, disconnected and disposed of. The loops are `pace`'s business;
//! an adapter never waits and never reads a clock: each of its methods does what can be done at once, at the instant
//! handed in.
//!
//! [`Connector`] is the implementation for the CPS-Protocol: the client session of [`session`](crate::session) over a
//! [`Transport`] of text messages. There are two transports: [`WebSocketConnector`] speaks over a real WebSocket,
//! [`InProcess`] hands the same frames to a peer in the same process, in memory.
//!
//! # A value's way
//!
//! ```text
//! frame → hf_io → session (decode, name → register) → hf_memory_update → bank.stage
//! bank.changed, bank.snapshot → hf_memory_update / lf_memory_update → session (encode) → hf_io → frame
//! ```
//!
//! Edges leave at every turn of a loop, each step's in a message of their own and in order; levels leave when their rate
//! class is due, and only if they changed.

mod connector;
#[cfg(test)]
mod connector_tests;
mod endpoint;
mod in_process;
mod outbox;
mod settings;
mod websocket;

use std::sync::Arc;
use std::task::Context;

pub use connector::{Connector, Event, Received, Traffic, Transport};
pub use endpoint::{Endpoint, ParseEndpointError};
pub use in_process::{FromPeer, InMemory, InProcess, Peer};
pub use settings::{Settings, SettingsError};
pub use websocket::{Socket, WebSocketConnector};

use crate::bank::IoSide;
use crate::signal_map::SignalMap;
use crate::time::Instant;
use crate::trace::Sender;

/// What connects a simulation's memory with an automation: the reference's Adapter Layer API (section 5.3.2.3).
///
/// The order of the calls is `configure`, `init`, `connect`, then the loops for as long as the run lasts, then
/// `disconnect`, further turns of the high-frequency loop until [`is_done`](Adapter::is_done), and `dispose`.
pub trait Adapter {
    /// Takes the settings; refuses those that cannot work, before anything is opened.
    fn configure(&mut self, settings: Settings) -> Result<(), SettingsError>;

    /// Takes the signals that it exchanges, and lays out what it keeps for each.
    fn init(&mut self, map: &Arc<SignalMap>);

    /// Asks for a session. It is made, and made again where it is lost, by the turns that follow.
    fn connect(&mut self);

    /// One exchange with the automation: takes in all that has arrived, sends all that is due. Says whether something
    /// now waits for [`hf_memory_update`](Adapter::hf_memory_update).
    ///
    /// Where it must wait, it leaves `cx`'s waker with what it waits for.
    fn hf_io(&mut self, cx: &mut Context<'_>, now: Instant) -> bool;

    /// The slow loop's exchange. Nothing by default: the CPS-Protocol has one way of access for all signals.
    fn lf_io(&mut self, _cx: &mut Context<'_>, _now: Instant) {}

    /// Moves what arrived into the memory, and out of it every edge and, where the loop's interval is over
    /// (`levels_due`), the high-frequency levels that changed.
    fn hf_memory_update(&mut self, now: Instant, memory: &mut Memory<'_>, levels_due: bool);

    /// Moves the low-frequency levels that changed out of the memory.
    fn lf_memory_update(&mut self, now: Instant, memory: &mut Memory<'_>);

    /// When it wants a turn though nothing happens: an answer overdue, a pause over. `None` for never.
    fn deadline(&self) -> Option<Instant>;

    /// What happened since it was last asked, for the log and for those who wait for it.
    fn poll_event(&mut self) -> Option<Event>;

    /// What went through so far.
    fn traffic(&self) -> Traffic;

    /// Whether a session stands.
    fn is_connected(&self) -> bool;

    /// Ends the session in good order: the turns that follow tell the automation, and wait for its answer at most for
    /// the timeout.
    fn disconnect(&mut self, now: Instant);

    /// Whether nothing is left to do: it ended, was told to or refused for good, and the connection is closed.
    fn is_done(&self) -> bool;

    /// Lets go of everything at once.
    fn dispose(&mut self);
}

/// The memory as an adapter's update sees it.
pub struct Memory<'a> {
    /// The IO thread's side of the register bank.
    pub bank: &'a mut IoSide,
    /// Who is told of all that passes.
    pub witness: &'a mut dyn Witness,
}

/// Who sees what passes between memory and session, in the order in which it passes: the recorder.
pub trait Witness {
    /// The automation's message `text` was staged, under the number that the bank gave it.
    fn staged(&mut self, number: u64, text: String);

    /// The message `text` was sent; its values are those of the cycle at `at`.
    fn reported(&mut self, at: Instant, text: &str);

    /// Any other message was received or sent, one that was refused included. `text` is on one line.
    fn exchanged(&mut self, from: Sender, text: &str);

    /// All reports before the cycle at `at` have been sent.
    fn reached(&mut self, at: Instant);
}

/// A witness that looks away.
pub struct NoWitness;

impl Witness for NoWitness {
    fn staged(&mut self, _number: u64, _text: String) {}
    fn reported(&mut self, _at: Instant, _text: &str) {}
    fn exchanged(&mut self, _from: Sender, _text: &str) {}
    fn reached(&mut self, _at: Instant) {}
}
