//! Three buffers that hand the newest cycle from one writer to one reader.
//!
//! At any time one buffer belongs to the writer, one to the reader, and one lies between them. The writer fills its own
//! and swaps it for the one between; the reader, if what lies between is new, swaps it for its own. Neither ever finds
//! the other inside its buffer, so neither waits, and the reader always has one whole cycle in hand.
//!
//! # Orderings
//!
//! `between` is the only cell both sides write, and both do it by a read-modify-write with `AcqRel`:
//!
//! - Release, the writer: its stores into the buffer (`Relaxed`) come before the swap that gives it away. Acquire, the
//!   reader: its loads come after the swap that took it. So the reader sees the whole cycle.
//! - Release, the reader: its loads from its old buffer come before the swap that gives it back. Acquire, the writer:
//!   its stores come after the swap that took it. So no store of a later cycle is seen by a reader of an earlier one.
//! - A read-modify-write reads the last value in the modification order, so no buffer is ever in two hands.
//! - The reader's look at the flag before it swaps may be `Relaxed`: it decides only whether to swap, and a flag it
//!   misses it sees the next time. (Whoever was woken after a publication does see it: waking is an ordering of its own.)

use crossbeam::utils::CachePadded;

use super::sync::{Arc, AtomicU64, Cell, Ordering};

/// Set in `between` while what lies there is newer than what the reader has.
const NEW: u64 = 0b100;
/// The buffer's number in `between`.
const INDEX: u64 = 0b011;

struct Shared {
    buffers: [Box<[Cell]>; 3],
    between: CachePadded<AtomicU64>,
}

/// The end that fills.
pub(super) struct Writer {
    shared: Arc<Shared>,
    own: u64,
}

/// The end that reads.
pub(super) struct Reader {
    shared: Arc<Shared>,
    own: u64,
}

/// Three buffers of `words` words each, all 0, nothing new in them.
pub(super) fn triple(words: usize) -> (Writer, Reader) {
    let buffer = || (0..words).map(|_| Cell::new()).collect();
    let shared =
        Arc::new(Shared { buffers: [buffer(), buffer(), buffer()], between: CachePadded::new(AtomicU64::new(1)) });
    (Writer { shared: shared.clone(), own: 0 }, Reader { shared, own: 2 })
}

impl Writer {
    /// Writes a whole cycle and hands it over. `words` is as long as the buffers are.
    pub(super) fn publish(&mut self, words: impl Iterator<Item = u64>) {
        for (cell, word) in self.shared.buffers[self.own as usize].iter().zip(words) {
            cell.write(word);
        }
        self.own = self.shared.between.swap(self.own | NEW, Ordering::AcqRel) & INDEX;
    }
}

impl Reader {
    /// Takes the newest cycle, if there is one newer than that in hand, and says whether there was.
    pub(super) fn refresh(&mut self) -> bool {
        if self.shared.between.load(Ordering::Relaxed) & NEW == 0 {
            return false;
        }
        self.own = self.shared.between.swap(self.own, Ordering::AcqRel) & INDEX;
        true
    }

    /// A word of the cycle in hand.
    pub(super) fn word(&self, at: usize) -> u64 {
        self.shared.buffers[self.own as usize][at].read()
    }
}
