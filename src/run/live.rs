//! What a run shows of itself while it goes on: the newest frame of each of its threads, handed over without waiting.
//!
//! A frame is a snapshot by value. Whoever looks takes the newest; nobody keeps a thread of the run waiting by not looking,
//! and what the simulation computes never depends on whether somebody looks.

use std::sync::Arc;

use crossbeam::queue::ArrayQueue;

use crate::adapter::Traffic;
use crate::engine::{PartCounts, PartState};
use crate::pace::Simulation;
use crate::time::Instant;
use crate::value::Value;

use super::summary::Quantiles;

/// The simulation's frame.
#[derive(Clone, Debug, Default)]
pub struct SimulationFrame {
    /// The simulated time that has been reached.
    pub now: Instant,
    pub steps: u64,
    pub overruns: u64,
    pub late_steps: u64,
    pub step_us: Quantiles,
    pub counts: PartCounts,
    /// All parts, where they are.
    pub parts: Vec<PartState>,
    /// All registers.
    pub registers: Vec<Value>,
}

impl SimulationFrame {
    /// Makes it the present frame of `simulation`.
    pub(super) fn fill(&mut self, simulation: &Simulation) {
        let engine = simulation.engine();
        let timing = simulation.timing();
        self.now = engine.now();
        self.steps = timing.steps;
        self.overruns = timing.overruns;
        self.late_steps = timing.late_steps;
        self.step_us = Quantiles::of_ns(&timing.computing_ns);
        self.counts = engine.counts();
        self.parts.clear();
        self.parts.extend(engine.parts());
        self.registers.clear();
        self.registers.extend_from_slice(engine.registers());
    }
}

/// The IO thread's frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExchangeFrame {
    pub connected: bool,
    pub traffic: Traffic,
}

/// One thread's end: the newest frame waits here until somebody takes it.
#[derive(Debug)]
pub struct Publisher<T>(Arc<ArrayQueue<T>>);

/// The end of whoever looks.
#[derive(Debug)]
pub struct Viewer<T>(Arc<ArrayQueue<T>>);

/// A place for one frame.
pub fn channel<T>() -> (Publisher<T>, Viewer<T>) {
    let queue = Arc::new(ArrayQueue::new(1));
    (Publisher(Arc::clone(&queue)), Viewer(queue))
}

impl<T> Publisher<T> {
    /// Puts `frame` in the place of the one before. Never waits. Gives back the one that nobody took, for its buffers.
    pub fn publish(&self, frame: T) -> Option<T> {
        self.0.force_push(frame)
    }
}

impl<T> Viewer<T> {
    /// The newest frame, if there is one that was not taken yet.
    pub fn take(&self) -> Option<T> {
        self.0.pop()
    }
}
