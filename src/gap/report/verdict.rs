//! The answer in a word.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The answer in a word: the first that applies, in the order of [`Verdict::ALL`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The trace does not excite what would have to be seen.
    NotTestable,
    /// The model explains the trace down to the noise, or within the tolerances that it declares.
    NoGap,
    /// Nothing in the library explains a part worth having.
    Unknown,
    /// An effect explains a part worth having, and a significant remainder is left that nothing in the library explains.
    Partial,
    /// The data cannot tell the named rivals apart.
    Ambiguous,
    /// One cause, an effect or a set of effects, stands clear.
    Effect,
}

impl Verdict {
    /// All of them, in the order in which they are asked.
    pub const ALL: [Verdict; 6] =
        [Verdict::NotTestable, Verdict::NoGap, Verdict::Unknown, Verdict::Partial, Verdict::Ambiguous, Verdict::Effect];

    /// As it stands in the report.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::NotTestable => "not-testable",
            Verdict::NoGap => "no-gap",
            Verdict::Unknown => "unknown",
            Verdict::Partial => "partial",
            Verdict::Ambiguous => "ambiguous",
            Verdict::Effect => "effect",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
