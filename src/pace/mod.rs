//!
//! Two threads, each with a loop of its own, meet in the register bank and nowhere else:
//!
//!   fast as it can, or when a caller says.
//! - The **IO thread** turns the exchange ([`Exchange`]): one body for the high- and the low-frequency loop of the
//!   reference (section 5.3.2.3), at two rates, on the wall clock ([`drive`]) or on a stepped one.
//!
//! was published: an edge leaves at once, a level when its interval is over.

mod answer;
mod bell;
mod clock;
mod exchange;
mod realtime;
mod simulation;

pub use answer::answer;
pub use bell::{Bell, Ears, Listener, bell};
pub use clock::WallClock;
pub use exchange::{Exchange, Rates, drive};
pub use realtime::{Refused, Urgency, prefer};
pub use simulation::{Journal, Next, NoJournal, Simulation, Timing, sharpen_sleep};
