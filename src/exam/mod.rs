//! An exam of the diagnosis: what was answered about cases whose truth was sealed, held beside that truth.
//!
//! Cases come from plants that share nothing with the diagnosis (`tools/withheld-plant`). Each is diagnosed by a process of its
//! own that knows the case's folder alone; the truth is opened when all reports are written, and judged here.

mod answer;
mod calibration;
mod class;
mod curve;
mod floor;
mod judge;
mod page;
mod rates;
mod sittings;
mod target;
mod whole;

#[cfg(test)]
mod tests;

pub use answer::{Answer, AnswersError, ClassMember, Magnitude, Sort, TrueEffect, read_answers};
pub use calibration::Bin;
pub use floor::Floor;
pub use judge::{Judged, judge, unanswered};
pub use page::page;
pub use rates::{Rate, Rates, Shown};
pub use sittings::{Sitting, SittingError};
pub use target::{Reached, Target};
pub use whole::{Exam, Groups, Spread};
