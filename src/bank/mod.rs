//! The shared-memory register bank: where the IO thread and the simulation thread meet, and the only place they do.
//!
//! [`new`] lays out one register for every signal of the map and hands back two sides, each owned by one thread:
//!
//! ```text
//!     IoSide::stage  ──── messages, whole and in order ────▶  SimulationSide::take
//!     IoSide::changed ◀── edges, every one and in order ────  SimulationSide::publish
//!     IoSide::levels  ◀── one consistent cycle ─────────────
//! ```
//!
//! No call ever waits for the other side: no lock, no spinning, a bounded number of steps each (what is usually called
//! wait-free). Inside there is no unsafe code either. Values lie as `u64` words in atomic cells, which are read and
//! written with `Relaxed` ordering, as cheap as plain memory; what makes them consistent is the hand-over of a whole
//! record or a whole cycle, argued where it stands (`ring.rs`, `triple.rs`).
//!
//! # Commands
//!
//! A message that arrived is staged and taken by a step, never applied on receipt. Two messages that set one signal
//! within one step are two events: [`take`](SimulationSide::take) stops before the message that would set a signal a
//! second time; that whole message and all after it wait for the next step.
//!
//! # Reports
//!
//! Each step publishes one cycle: all report registers with the step's instant. The other side always sees one whole
//! cycle, the newest when it looks, and may miss those between: that is right for a level. An edge must not be missed,
//! so what changed about the edge signals in a step goes into a log as well, one group for each step.
//!
//! The log and the queue of messages hold 65 536 entries each (an entry is one value of one signal). Past that
//! [`stage`](IoSide::stage) answers [`Full`], and [`changed`](IoSide::changed) answers [`Overrun`], once for each
//! overflow and at its place in the order; the owner then closes the connection, and what
//! [`all_outputs`](IoSide::all_outputs) gives after the next connect makes up for it.
//!
//! `tests/loom_bank.rs` compiles these files against loom's atomics and tries every interleaving of small models
//! (`cargo nextest run --test loom_bank`); `benches/bank.rs` measures.

mod ring;
mod sides;
mod sync;
mod triple;
mod words;

pub use sides::{CAPACITY, Changes, Full, IoSide, Overrun, SimulationSide, Snapshot, new};

#[cfg(test)]
pub(crate) use sides::with_capacity;

#[cfg(test)]
mod tests;
