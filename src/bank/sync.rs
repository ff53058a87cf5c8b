//! The atomics the bank is made of. `tests/loom_bank.rs` puts loom's in their place.

pub(super) use std::sync::Arc;
pub(super) use std::sync::atomic::{AtomicU64, Ordering};
