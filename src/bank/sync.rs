//! The shared memory the bank is made of. `tests/loom_bank.rs` puts loom's in its place.

pub(super) use std::sync::Arc;
pub(super) use std::sync::atomic::{AtomicU64, Ordering};

/// A word of data that one side writes and the other reads, never both at once: whose it is follows from the hand-over.
///
/// `Relaxed`, because nothing is concluded from a word alone. That the hand-over orders every access of both sides is
/// what loom proves: there a cell that both touched without an order between them ends the test.
#[derive(Debug)]
pub(super) struct Cell(AtomicU64);

impl Cell {
    pub(super) fn new() -> Cell {
        Cell(AtomicU64::new(0))
    }

    pub(super) fn read(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }

    pub(super) fn write(&self, word: u64) {
        self.0.store(word, Ordering::Relaxed);
    }
}
