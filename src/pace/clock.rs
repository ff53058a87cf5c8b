//! The wall clock of a run, as the lower rows want it: an [`Instant`] that is handed in.

use crate::time::Instant;

/// A monotonic wall clock that starts at 0 when it is made. Copies show the same time.
#[derive(Clone, Copy, Debug)]
pub struct WallClock {
    origin: std::time::Instant,
}

impl WallClock {
    /// Starts now.
    pub fn start() -> WallClock {
        WallClock { origin: std::time::Instant::now() }
    }

    /// The time since the start.
    pub fn now(&self) -> Instant {
        Instant::ZERO + self.origin.elapsed()
    }

    /// The system's own instant at which this clock shows `instant`.
    pub fn to_system(&self, instant: Instant) -> std::time::Instant {
        self.origin + instant.since(Instant::ZERO)
    }
}
