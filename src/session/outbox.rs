//! What a session has to say until its owner asks.

use std::collections::VecDeque;

use super::{OUTPUT_LIMIT, Output};

/// Outputs in order. What ends a session always finds room; what a peer can cause at will is not taken once it is full.
#[derive(Debug)]
pub(super) struct Outbox<E>(VecDeque<Output<E>>);

impl<E> Outbox<E> {
    pub(super) fn new() -> Outbox<E> {
        Outbox(VecDeque::new())
    }

    pub(super) fn event(&mut self, event: E) {
        self.0.push_back(Output::Event(event));
    }

    pub(super) fn transmit(&mut self, text: String) {
        self.0.push_back(Output::Transmit(text));
    }

    pub(super) fn close(&mut self, code: u16, reason: impl Into<String>) {
        self.0.push_back(Output::Close { code, reason: reason.into() });
    }

    pub(super) fn pop(&mut self) -> Option<Output<E>> {
        self.0.pop_front()
    }

    pub(super) fn is_full(&self) -> bool {
        self.0.len() >= OUTPUT_LIMIT
    }
}
