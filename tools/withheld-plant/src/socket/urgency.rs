//! Going before what shares the processors by turns, where the system permits it.
//!
//! On Unix that is the policy "first in, first out" (POSIX.1-2017, `SCHED_FIFO`), on Windows the priority "time critical".
//! An end sleeps between what it does, so that nobody waits long for it.

use thread_priority::{ThreadPriority, ThreadPriorityValue};

/// Among 1 to 99; the system's own threads for interrupts have 50.
const PRIORITY: u8 = 10;

/// Has the calling thread go before all that is not real-time. Where that is refused it stays as it is, and how late it is
/// tells whether that was enough.
pub fn ask() {
    if let Ok(value) = ThreadPriorityValue::try_from(PRIORITY) {
        let _ = set(ThreadPriority::Crossplatform(value));
    }
}

#[cfg(unix)]
fn set(priority: ThreadPriority) -> Result<(), thread_priority::Error> {
    use thread_priority::{RealtimeThreadSchedulePolicy, ThreadSchedulePolicy};
    let first_in_first_out = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    thread_priority::set_thread_priority_and_policy(thread_priority::thread_native_id(), priority, first_in_first_out)
}

#[cfg(not(unix))]
fn set(_: ThreadPriority) -> Result<(), thread_priority::Error> {
    let critical = thread_priority::windows::WinAPIThreadPriority::TimeCritical;
    thread_priority::set_current_thread_priority(ThreadPriority::Os(critical.into()))
}
