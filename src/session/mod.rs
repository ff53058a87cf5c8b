//! Client and server of the CPS-Protocol as state machines **without IO and without a clock**.
//!
//! A session is told what happens ([`Input`], with the instant it happens at) and says what to do ([`Output`]). Its owner
//! has the socket and the clock:
//!
//! 1. call [`Client::handle`] or [`Server::handle`] for everything the connection gives, and for the instant that
//!    [`timeout`](Client::timeout) names when that instant has come;
//! 2. call [`send`](Client::send) when values are to go out, [`disconnect`](Client::disconnect) when the run ends;
//! 3. after **every** such call, [`poll`](Client::poll) until it gives `None`, and obey each output in order.
//!
//! Names become registers here, once, in both directions: above it everyone knows names, below it nobody does. Both sides
//! hold the same [`SignalMap`](crate::signal_map::SignalMap); the automation's outputs are its commands
//! ([`Direction::Command`](crate::signal_map::Direction)), the automation's inputs its reports.
//!
//! # Connections
//!
//! A [`Client`] outlives its connections. It asks for one with [`ClientEvent::Dial`]; the owner answers with
//! [`Input::Opened`], or with [`Input::Closed`] where nobody answers. All inputs are about the connection dialled last:
//! once the client said [`Output::Close`], the owner drops that connection and reports nothing more of it.
//! A [`Server`] is one connection, from its handshake to its end.
//!
//! # Values
//!
//! [`Staged`] holds what one `SendValue` brought: its good values by register, in the order in which they stand, each
//! register once (the last good one wins), its text for the trace, and its faults, which the session has already
//! answered. Two messages are never merged: what they set is two events, and when they act is the bank's business.
//!
//! # Both ends in one place
//!
//! ```
//! # use std::sync::Arc;
//! # use kinetwin::session::*;
//! # use kinetwin::signal_map::*;
//! # use kinetwin::value::{Unit, Value};
//! # use kinetwin::time::Instant;
//! # let signal = |name: &str, ty: &str, direction| Signal {
//! #     name: name.into(), ty: ty.parse().unwrap(), direction, kind: Kind::Edge, rate: RateClass::HighFrequency,
//! #     unit: Unit::ONE, min: None, max: None, instance: String::new(), task: String::new(), property: String::new(),
//! # };
//! let map = Arc::new(SignalMap::new("plant", vec![
//!     signal("Pusher.command", "DINT", Direction::Command),
//!     signal("Pusher.limitExtended", "BOOL", Direction::Report),
//! ])?);
//! let mut client = Client::new(ClientSettings::new("run 1"), Arc::clone(&map));
//! let mut server = Server::new(ServerSettings::new("automation"), Arc::clone(&map));
//! let now = Instant::ZERO;
//!
//! // The client asks for a connection, and here it is.
//! assert_eq!(client.poll(), Some(Output::Event(ClientEvent::Dial { attempt: 1 })));
//! client.handle(now, Input::Opened);
//!
//! // Carry every message to the other end, until neither has more to say.
//! let mut exchange = |client: &mut Client, server: &mut Server| {
//!     let mut arrived = Vec::new();
//!     loop {
//!         match (client.poll(), server.poll()) {
//!             (None, None) => return arrived,
//!             (from_client, from_server) => {
//!                 if let Some(Output::Transmit(text)) = from_client {
//!                     server.handle(now, Input::Text(&text));
//!                 }
//!                 match from_server {
//!                     Some(Output::Transmit(text)) => client.handle(now, Input::Text(&text)),
//!                     Some(Output::Event(ServerEvent::Values(staged))) => arrived.extend(staged.values),
//!                     _ => {}
//!                 }
//!             }
//!         }
//!     }
//! };
//! exchange(&mut client, &mut server);
//! assert!(client.is_established() && server.is_established());
//!
//! let extended = (map.register("Pusher.limitExtended").unwrap(), Value::Bool(true));
//! client.send(now, &[extended.clone()]);
//! assert_eq!(exchange(&mut client, &mut server), [extended]);
//! # Ok::<(), DuplicateSignal>(())
//! ```

mod client;
mod exchange;
mod interface;
mod limits;
mod outbox;
mod query;
mod selection;
mod server;

#[cfg(test)]
mod tests;

/// For a replay: it must take from a recorded message what the session took from it.
pub(crate) use exchange::Exchange;

pub use client::{Client, ClientEvent, ClientSettings, Ending};
pub use interface::{Mismatch, interface_of, mismatches};
pub use limits::Limits;
pub use query::{Query, QueryEvent};
pub use server::{Server, ServerEvent, ServerSettings};

use crate::signal_map::RegisterId;
use crate::value::Value;
use crate::wire::Fault;

/// What a session is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input<'a> {
    /// The connection stands: the WebSocket handshake is done.
    Opened,
    /// A text message arrived.
    Text(&'a str),
    /// A binary message arrived.
    Binary,
    /// A text message that is not UTF-8 arrived; the transport could not hand it in.
    InvalidUtf8,
    /// A message longer than the limit of so many bytes arrived; the transport did not read it.
    TooLong { limit: usize },
    /// The connection ended, or could not be made.
    Closed,
    /// The instant named by `timeout` has come. Handed in too early, it does nothing.
    Timeout,
}

/// What a session wants done.
#[derive(Clone, Debug, PartialEq)]
pub enum Output<E> {
    /// Send this text message.
    Transmit(String),
    /// Something happened that the owner should know.
    Event(E),
    /// Close the connection with this WebSocket status code (RFC 6455, section 7.4) and reason, and drop it.
    Close { code: u16, reason: String },
}

/// What one accepted `SendValue` brought.
#[derive(Clone, Debug, PartialEq)]
pub struct Staged {
    /// The good values, at least one, each register once.
    pub values: Vec<(RegisterId, Value)>,
    /// The message as it came, as one line: `{"SendValue":[…]}`. Only its line breaks have become blanks, so that it can
    /// stand in a trace.
    pub text: String,
    /// What was wrong with other entries of the message. The `SendValueReply` has been sent.
    pub faults: Vec<Fault>,
}

/// WebSocket status codes (RFC 6455, section 7.4.1) that sessions close with.
pub mod close_code {
    /// The session is over.
    pub const NORMAL: u16 = 1000;
    /// A text message that is not UTF-8.
    pub const NOT_UTF8: u16 = 1007;
    /// The peer did not keep to the protocol, or not to its times.
    pub const POLICY: u16 = 1008;
    /// A message over the limit.
    pub const TOO_BIG: u16 = 1009;
}

/// How many outputs a session holds for an owner that does not [`poll`](Client::poll). Past it the session closes its
/// connection, because it must neither lose a value silently nor grow for ever.
pub const OUTPUT_LIMIT: usize = 65_536;
