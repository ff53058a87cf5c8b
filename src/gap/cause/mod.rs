//! Which effect: candidates from the library, a ladder of them, their classes, intervals and what they leave.

mod again;
#[cfg(test)]
mod axis_tests;
mod bare;
mod bench;
mod blur;
mod candidate;
mod class;
mod dropped;
mod glance;
mod intervals;
mod ladder;
mod latest;
mod library;
mod masked;
mod nuisance;
mod refresh;
mod remainder;
mod rhythm;
mod rung;
mod scales;
mod scan;
mod starts;
mod tangent;
mod two;
mod unseen;

pub use bare::Bare;
pub use bench::{BLOCK_S, Bench, Trial};
pub use candidate::{Candidate, Free};
pub use class::{Alternative, Answer, answers, is_part, plainness};
pub use dropped::lets_go_at_once;
pub use intervals::{Bounds, intervals, of_each};
pub use ladder::{Ladder, MOST_INFLATED, Progress, Standing, Tell, anew, climb, floor};
#[cfg(test)]
pub use library::candidates;
pub use nuisance::{Nuisance, nuisances};
pub use remainder::{Remainder, is_laws_own, misfit, remainder};
