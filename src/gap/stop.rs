//! Work that is broken off when the answer is wanted.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// Set once nothing is to be computed any more.
#[derive(Clone, Debug, Default)]
pub(super) struct Stop(Arc<AtomicBool>);

impl Stop {
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Does `work`, whose stop is set as soon as `is_stopped` says so.
pub(super) fn until<T>(is_stopped: &(dyn Fn() -> bool + Sync), work: impl FnOnce(Stop) -> T) -> T {
    const LOOKS_EVERY: Duration = Duration::from_millis(20);
    let stop = Stop::default();
    let (done, is_done) = channel::<()>();
    thread::scope(|scope| {
        let set = stop.clone();
        scope.spawn(move || {
            while !is_stopped() {
                if is_done.recv_timeout(LOOKS_EVERY) != Err(RecvTimeoutError::Timeout) {
                    return;
                }
            }
            set.0.store(true, Ordering::Relaxed);
        });
        let found = work(stop);
        drop(done);
        found
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_hears_that_it_is_to_stop_and_nothing_otherwise() {
        let waited = until(&|| true, |stop| {
            while !stop.is_set() {
                thread::yield_now();
            }
            true
        });
        assert!(waited);
        assert!(!until(&|| false, |stop| stop.is_set()));
    }
}
