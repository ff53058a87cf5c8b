//! The high- and the low-frequency loop: one body, two rates, on the wall clock or on a stepped one.

use std::future::poll_fn;
use std::pin::pin;
use std::task::{Context, Poll};
use std::time::Duration;

use super::bell::Ears;
use super::clock::WallClock;
use crate::adapter::{Adapter, Memory, Witness};
use crate::bank::IoSide;
use crate::time::Instant;

/// How often a turn starts over because what it sent was answered at once, before others get their turn.
const PASSES_A_TURN: usize = 64;

/// The refresh intervals of the two loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rates {
    pub high: Duration,
    pub low: Duration,
}

/// An instant that comes again and again.
#[derive(Clone, Copy, Debug)]
struct Beat {
    interval: Duration,
    next: Instant,
}

impl Beat {
    /// The first one is at once.
    fn every(interval: Duration) -> Beat {
        Beat { interval, next: Instant::ZERO }
    }

    /// Whether an interval is over at `now`. Beats that were missed altogether are not made up for.
    fn is_due(&mut self, now: Instant) -> bool {
        if now < self.next {
            return false;
        }
        self.next += self.interval;
        if self.next <= now {
            self.next = now + self.interval;
        }
        true
    }
}

/// The loops' body: an adapter, its side of the memory, and the two rates.
pub struct Exchange<A, W> {
    adapter: A,
    bank: IoSide,
    witness: W,
    high: Beat,
    low: Beat,
}

impl<A: Adapter, W: Witness> Exchange<A, W> {
    /// The exchange between `bank` and the automation that `adapter` speaks with; `witness` sees all of it.
    pub fn new(adapter: A, bank: IoSide, witness: W, rates: Rates) -> Exchange<A, W> {
        Exchange { adapter, bank, witness, high: Beat::every(rates.high), low: Beat::every(rates.low) }
    }

    /// The adapter.
    pub fn adapter(&mut self) -> &mut A {
        &mut self.adapter
    }

    /// The witness.
    pub fn witness(&mut self) -> &mut W {
        &mut self.witness
    }

    /// One turn: takes in what arrived, hands it to the memory, takes every edge and what levels are due from it, sends;
    /// and again while what was sent brings something in at once.
    ///
    /// Called whenever something may have happened: a frame, a bell, an interval. Called too often, it does nothing.
    pub fn turn(&mut self, cx: &mut Context<'_>, now: Instant) {
        let mut memory = Memory { bank: &mut self.bank, witness: &mut self.witness };
        self.adapter.hf_io(cx, now);
        for _ in 0..PASSES_A_TURN {
            self.adapter.hf_memory_update(now, &mut memory, self.high.is_due(now));
            if self.low.is_due(now) {
                self.adapter.lf_memory_update(now, &mut memory);
                self.adapter.lf_io(cx, now);
            }
            if !self.adapter.hf_io(cx, now) {
                return;
            }
        }
        cx.waker().wake_by_ref();
    }

    /// Takes out of the memory what a step that was just made put there, and sends it. Whether something arrived meanwhile:
    /// then another turn is due at once.
    pub fn report(&mut self, cx: &mut Context<'_>, now: Instant) -> bool {
        let mut memory = Memory { bank: &mut self.bank, witness: &mut self.witness };
        self.adapter.hf_memory_update(now, &mut memory, self.high.is_due(now));
        self.adapter.hf_io(cx, now)
    }

    /// When the next turn is due though nothing happens before.
    pub fn next_turn(&self) -> Instant {
        let loops = self.high.next.min(self.low.next);
        self.adapter.deadline().map_or(loops, |deadline| deadline.min(loops))
    }

    /// Lets go of the connection and gives the witness back.
    pub fn dispose(mut self) -> W {
        self.adapter.dispose();
        self.witness
    }
}

/// Turns the loops on the wall clock: at every frame, at every ring of the bell, and when an interval is over. When the
/// bell is gone, the simulation is over: what it left is sent, the session is ended in good order, and that is the end.
///
/// `after` sees the exchange after each turn. Runs on a tokio runtime with its IO and time drivers on.
pub async fn drive<A: Adapter, W: Witness>(
    exchange: &mut Exchange<A, W>,
    mut ears: Ears,
    clock: WallClock,
    mut after: impl FnMut(&mut Exchange<A, W>, Instant),
) {
    let mut alarm = pin!(tokio::time::sleep(Duration::ZERO));
    let mut simulating = true;
    poll_fn(|cx| {
        loop {
            // Emptied before the turn looks into the bank; see `bell`.
            let over = simulating && ears.hear(cx).is_err();
            let now = clock.now();
            exchange.turn(cx, now);
            if over {
                simulating = false;
                exchange.adapter().disconnect(now);
                exchange.turn(cx, now);
            }
            after(exchange, now);
            if !simulating && exchange.adapter().is_done() {
                return Poll::Ready(());
            }
            alarm.as_mut().reset(clock.to_system(exchange.next_turn()).into());
            if alarm.as_mut().poll(cx).is_pending() {
                return Poll::Pending;
            }
        }
    })
    .await;
}
