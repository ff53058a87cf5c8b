//! A queue of records for one producer and one consumer.
//!
//! A record is a run of words that appears to the consumer whole or not at all. Beside its words it weighs some
//! entries; the ring holds at most so many words and at most so many entries.
//!
//! # Orderings
//!
//! `written` and `read` count words since the start; a word's cell is its count modulo the number of cells,
//! which is a power of two.
//!
//! - The producer stores the words of a record (`Relaxed`), then `written` (`Release`). A consumer that loads that
//!   value of `written` (`Acquire`) sees all words stored before it: no record is seen in part.
//! - The consumer loads the words of a record (`Relaxed`), then stores `read` (`Release`). A producer that loads that
//!   value of `read` (`Acquire`) and overwrites those cells does so after the loads: no word is lost to a later one.
//! - `released`, the entries the consumer is done with, guards no memory: it only bounds a sum, and a producer that
//!   sees an old value is merely stricter than it need be. `Relaxed` is enough.
//! - Each side keeps its own counter to itself as well and loads the other's only when it must, so the two threads
//!   touch each other's cache lines once a record at most.

use crossbeam::utils::CachePadded;

use super::sync::{Arc, AtomicU64, Cell, Ordering};

struct Ring {
    cells: Box<[Cell]>,
    /// Words ever written; stored by the producer only.
    written: CachePadded<AtomicU64>,
    /// Words ever read; stored by the consumer only.
    read: CachePadded<AtomicU64>,
    /// Entries ever read; stored by the consumer only.
    released: AtomicU64,
}

impl Ring {
    fn cell(&self, at: u64) -> &Cell {
        &self.cells[at as usize & (self.cells.len() - 1)]
    }
}

/// The end that records go in at.
pub(super) struct Producer {
    ring: Arc<Ring>,
    /// The most entries in the ring.
    limit: u64,
    written: u64,
    entries: u64,
    /// The last `read` seen: at most what the consumer has read.
    read: u64,
}

/// The end that records come out at.
pub(super) struct Consumer {
    ring: Arc<Ring>,
    read: u64,
    released: u64,
    /// The last `written` seen.
    written: u64,
}

/// An empty ring for at least `words` words, and for at most `entries` entries.
pub(super) fn ring(words: usize, entries: usize) -> (Producer, Consumer) {
    let ring = Arc::new(Ring {
        cells: (0..words.next_power_of_two()).map(|_| Cell::new()).collect(),
        written: CachePadded::new(AtomicU64::new(0)),
        read: CachePadded::new(AtomicU64::new(0)),
        released: AtomicU64::new(0),
    });
    let producer = Producer { ring: ring.clone(), limit: entries as u64, written: 0, entries: 0, read: 0 };
    (producer, Consumer { ring, read: 0, released: 0, written: 0 })
}

impl Producer {
    /// Appends a record that weighs `entries`; `false`, and nothing appended, if it does not fit.
    pub(super) fn push(&mut self, record: &[u64], entries: u64) -> bool {
        let end = self.written + record.len() as u64;
        if end - self.read > self.ring.cells.len() as u64 {
            self.read = self.ring.read.load(Ordering::Acquire);
            if end - self.read > self.ring.cells.len() as u64 {
                return false;
            }
        }
        if self.entries + entries - self.ring.released.load(Ordering::Relaxed) > self.limit {
            return false;
        }
        for (at, word) in (self.written..).zip(record) {
            self.ring.cell(at).write(*word);
        }
        self.written = end;
        self.entries += entries;
        self.ring.written.store(end, Ordering::Release);
        true
    }
}

impl Consumer {
    /// Looks for records that came in since the last call, and says how many words there are to read.
    pub(super) fn refresh(&mut self) -> usize {
        self.written = self.ring.written.load(Ordering::Acquire);
        self.available()
    }

    /// Words to read, as of the last [`refresh`](Self::refresh).
    pub(super) fn available(&self) -> usize {
        (self.written - self.read) as usize
    }

    /// The word `offset` after the first that was not released; `offset` is less than [`available`](Self::available).
    pub(super) fn word(&self, offset: usize) -> u64 {
        debug_assert!(offset < self.available(), "a word past the end of what was written");
        self.ring.cell(self.read + offset as u64).read()
    }

    /// Gives `words` words, which weighed `entries`, back to the producer.
    pub(super) fn release(&mut self, words: usize, entries: u64) {
        self.read += words as u64;
        self.released += entries;
        self.ring.released.store(self.released, Ordering::Relaxed);
        self.ring.read.store(self.read, Ordering::Release);
    }
}
