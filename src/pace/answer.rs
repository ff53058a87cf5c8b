//! Steps that what arrives starts: the shortest way from a command to its answer.

use std::future::poll_fn;
use std::pin::pin;
use std::task::Poll;
use std::time::Duration;

use super::clock::WallClock;
use super::exchange::Exchange;
use super::simulation::Simulation;
use crate::adapter::{Adapter, Witness};

/// Turns exchange and simulation on one thread: each message that arrives is staged and starts a step at once, and what the
/// step publishes leaves in the same turn. Simulated time stands still while nothing arrives.
///
/// `after` sees the exchange after each turn and says whether that was the last. Runs on a tokio runtime with its IO and
/// time drivers on.
pub async fn answer<A: Adapter, W: Witness>(
    exchange: &mut Exchange<A, W>,
    simulation: &mut Simulation,
    clock: WallClock,
    mut after: impl FnMut(&mut Exchange<A, W>) -> bool,
) {
    // There is something to report from the beginning.
    simulation.step();
    let mut alarm = pin!(tokio::time::sleep(Duration::ZERO));
    poll_fn(|cx| {
        loop {
            let staged = exchange.adapter().traffic().messages_in;
            exchange.turn(cx, clock.now());
            let arrived = exchange.adapter().traffic().messages_in - staged;
            for _ in 0..arrived {
                simulation.step();
            }
            let more = arrived > 0 && exchange.report(cx, clock.now());
            if after(exchange) {
                return Poll::Ready(());
            }
            if more {
                continue;
            }
            let next = clock.to_system(exchange.next_turn());
            if alarm.deadline() != next.into() {
                alarm.as_mut().reset(next.into());
            }
            if alarm.as_mut().poll(cx).is_pending() {
                return Poll::Pending;
            }
        }
    })
    .await;
}
