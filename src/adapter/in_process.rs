//! The connector within one process: the same frames, handed over in memory.
//!
//! It is what lets a run go as fast as the computer can and still be exact: nothing is under way between the two sides,
//! ever. What is sent has been handled when `send` returns, and what that brought in reply waits to be received.

use std::task::{Context, Poll};

use super::Settings;
use super::connector::{Connector, Received, Transport};
use crate::time::Instant;

/// The automation's end of a connection in memory.
pub trait Peer {
    /// The simulation connects.
    fn open(&mut self, now: Instant);
    /// A message arrives from the simulation.
    fn take(&mut self, now: Instant, text: &str);
    /// The next message for the simulation.
    fn give(&mut self, now: Instant) -> Option<FromPeer>;
    /// The simulation closed the connection.
    fn close(&mut self, now: Instant);
}

/// What a [`Peer`] has for the simulation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FromPeer {
    Text(String),
    Binary,
    /// It closed the connection; why, for people.
    Closed(String),
}

/// A [`Transport`] to a [`Peer`] in memory.
#[derive(Debug)]
pub struct InMemory<P> {
    peer: P,
    state: State,
}

#[derive(Debug, PartialEq, Eq)]
enum State {
    Idle,
    Opening,
    Open,
}

/// The connector to a [`Peer`] in the same process.
pub type InProcess<P> = Connector<InMemory<P>>;

impl<P: Peer> InProcess<P> {
    /// A connector to `peer`.
    pub fn to(peer: P) -> InProcess<P> {
        Connector::over(InMemory { peer, state: State::Idle })
    }
}

impl<P> InMemory<P> {
    /// The other end.
    pub fn peer(&mut self) -> &mut P {
        &mut self.peer
    }
}

impl<P: Peer> Transport for InMemory<P> {
    fn configure(&mut self, _settings: &Settings) {}

    fn dial(&mut self, now: Instant) {
        self.peer.open(now);
        self.state = State::Opening;
    }

    fn poll_receive(&mut self, _cx: &mut Context<'_>, now: Instant) -> Poll<Received> {
        match self.state {
            State::Idle => Poll::Pending,
            State::Opening => {
                self.state = State::Open;
                Poll::Ready(Received::Opened)
            }
            State::Open => match self.peer.give(now) {
                None => Poll::Pending,
                Some(FromPeer::Text(text)) => Poll::Ready(Received::Text(text)),
                Some(FromPeer::Binary) => Poll::Ready(Received::Binary),
                Some(FromPeer::Closed(why)) => {
                    self.state = State::Idle;
                    Poll::Ready(Received::Closed(why))
                }
            },
        }
    }

    fn send(&mut self, now: Instant, text: String) {
        if self.state == State::Open {
            self.peer.take(now, &text);
        }
    }

    fn flush(&mut self, _cx: &mut Context<'_>) {}

    fn is_congested(&self) -> bool {
        false
    }

    fn close(&mut self, now: Instant, _code: u16, _reason: &str) {
        if self.state != State::Idle {
            self.peer.close(now);
            self.state = State::Idle;
        }
    }

    fn is_idle(&self) -> bool {
        self.state == State::Idle
    }

    fn abort(&mut self) {
        self.state = State::Idle;
    }
}
