//! Messages as texts: those of the reference, and every way in which a text can fail to be one.

mod golden;
mod messages;

use proptest::prelude::*;

/// Any text, control characters and all (`any::<String>()` gives printable ones alone).
pub(super) fn texts() -> impl Strategy<Value = String> {
    prop::collection::vec(any::<char>(), 0..12).prop_map(|chars| chars.into_iter().collect())
}
