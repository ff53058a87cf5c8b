//! One row of the table: a peer that is called, and how long its answers took.

use std::io;
use std::time::{Duration, Instant};

use hdrhistogram::Histogram;
use serde::Serialize;

/// Something that answers.
pub trait Peer {
    /// Sends one request and waits for its answer.
    fn call(&mut self) -> io::Result<()>;

    /// Makes so many calls, one after the other, a call every `pace` where there is one; gives how long each took, in
    /// nanoseconds.
    fn calls(&mut self, count: usize, pace: Option<Duration>) -> io::Result<Vec<u64>> {
        let begun = Instant::now();
        let mut took = Vec::with_capacity(count);
        for k in 0..count as u32 {
            if let Some(pace) = pace {
                std::thread::sleep((k * pace).saturating_sub(begun.elapsed()));
            }
            let called = Instant::now();
            self.call()?;
            took.push(called.elapsed().as_nanos() as u64);
        }
        Ok(took)
    }
}

/// A row in the making.
pub struct Row {
    pub name: String,
    pub bytes: usize,
    pub pace: Option<Duration>,
    pub peer: Box<dyn Peer>,
    took: Histogram<u64>,
}

impl Row {
    /// A row for `peer`, whose request has so many bytes.
    pub fn new(name: impl Into<String>, bytes: usize, pace: Option<Duration>, peer: Box<dyn Peer>) -> Row {
        let took = Histogram::new_with_bounds(1, 60_000_000_000, 3).expect("bounds in order, three digits");
        Row { name: name.into(), bytes, pace, peer, took }
    }

    /// Makes so many calls and records them.
    pub fn measure(&mut self, count: usize) -> io::Result<()> {
        for ns in self.peer.calls(count, self.pace)? {
            self.took.saturating_record(ns);
        }
        Ok(())
    }

    /// Makes calls that are not recorded: connections open, caches fill.
    pub fn warm_up(&mut self, count: usize) -> io::Result<()> {
        self.peer.calls(count, None).map(drop)
    }

    /// The quantiles, corrected for coordinated omission: while one call hung, those that should have been made meanwhile
    /// hung as well. They should have been made every `pace`, or back to back, every median.
    pub fn measured(&self) -> Measured {
        let expected = self.pace.map_or_else(|| self.took.value_at_quantile(0.5), |pace| pace.as_nanos() as u64);
        Measured::of(&self.name, self.bytes, &self.took.clone_correct(expected.max(1)))
    }
}

/// A row of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    pub name: String,
    /// The request's length, bytes; 0 where it is no matter of bytes.
    pub bytes: usize,
    /// How many calls were made.
    #[serde(skip_serializing_if = "is_zero")]
    pub count: u64,
    pub p50_us: f64,
    pub p99_us: f64,
    pub p999_us: f64,
    pub max_us: f64,
}

fn is_zero(count: &u64) -> bool {
    *count == 0
}

/// One of a row's quantiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    P50,
    P99,
    P999,
    Max,
}

impl Measured {
    /// The quantiles of a histogram in nanoseconds.
    pub fn of(name: &str, bytes: usize, took: &Histogram<u64>) -> Measured {
        let us = |ns: u64| (ns as f64 / 100.0).round() / 10.0;
        let at = |quantile| us(took.value_at_quantile(quantile));
        Measured {
            name: name.to_owned(),
            bytes,
            count: took.len(),
            p50_us: at(0.5),
            p99_us: at(0.99),
            p999_us: at(0.999),
            max_us: us(took.max()),
        }
    }

    /// One quantile, µs.
    pub fn get(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::P50 => self.p50_us,
            Quantity::P99 => self.p99_us,
            Quantity::P999 => self.p999_us,
            Quantity::Max => self.max_us,
        }
    }
}
