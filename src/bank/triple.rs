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

use std::ops::Range;

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
    /// For each buffer, what was written since it was filled.
    lacks: [Lack; 3],
}

/// What a buffer lacks of the newest cycle.
#[derive(Default)]
struct Lack {
    /// Runs of words, in any order, perhaps one twice.
    runs: Vec<Range<usize>>,
    /// How many words they have together.
    words: usize,
    /// Whether it lacks so much that it is filled whole.
    all: bool,
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
    (Writer { shared: shared.clone(), own: 0, lacks: Default::default() }, Reader { shared, own: 2 })
}

impl Writer {
    /// Hands over a whole cycle. `words` is as long as the buffers are; all of it but the runs in `changed` is as it was at
    /// the call before. Costs what those runs and the runs of a few calls before have words, however long the cycle is.
    pub(super) fn publish(&mut self, words: &[u64], changed: &[Range<usize>]) {
        for lack in &mut self.lacks {
            lack.add(changed, words.len());
        }
        let buffer = &self.shared.buffers[self.own as usize];
        let lack = &mut self.lacks[self.own as usize];
        if std::mem::take(&mut lack.all) {
            lack.runs.clear();
            lack.runs.push(0..words.len());
        }
        for run in lack.runs.drain(..) {
            for (cell, word) in buffer[run.clone()].iter().zip(&words[run]) {
                cell.write(*word);
            }
        }
        lack.words = 0;
        self.own = self.shared.between.swap(self.own | NEW, Ordering::AcqRel) & INDEX;
    }
}

impl Lack {
    /// More that it lacks, of a cycle of `all` words. Where it comes to lack as much as a cycle has, nothing is remembered
    /// but that: a buffer that the reader holds for long costs no more than a whole one.
    fn add(&mut self, changed: &[Range<usize>], all: usize) {
        if self.all {
            return;
        }
        self.words += changed.iter().map(Range::len).sum::<usize>();
        if self.words < all {
            self.runs.extend_from_slice(changed);
        } else {
            self.all = true;
            self.runs.clear();
        }
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
        self.cells()[at].read()
    }

    /// All words of the cycle in hand.
    pub(super) fn cells(&self) -> &[Cell] {
        &self.shared.buffers[self.own as usize]
    }
}
