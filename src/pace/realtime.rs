//! Real-time scheduling, where the system permits it: a thread that has something to do goes before all that shares the
//! processors by turns.
//!
//! On Unix that is the policy "first in, first out" (POSIX.1-2017, `SCHED_FIFO`), on Windows the priority "time critical".
//! Both threads of a run sleep between what they do. One that spun would take a processor from everything else, and Linux
//! would halt it for 50 ms of every second (sched(7), `sched_rt_runtime_us`).

use thread_priority::{ThreadPriority, ThreadPriorityValue};

/// What a thread is for; the simulation goes before the exchange, whose frames wait for its steps and not the other way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Urgency {
    Simulation,
    Exchange,
}

impl Urgency {
    /// Among 1 to 99; the system's own threads for interrupts have 50.
    fn priority(self) -> u8 {
        match self {
            Urgency::Simulation => 20,
            Urgency::Exchange => 10,
        }
    }
}

/// The system does not let this process go before others.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the system refuses real-time scheduling ({reason}): the run goes on without it, and its steps may begin later; run \
     with the capability CAP_SYS_NICE, or raise the limit `ulimit -r` to {} or more",
    Urgency::Simulation.priority()
)]
pub struct Refused {
    reason: String,
}

/// Has the calling thread go before all that is not real-time.
///
/// # Errors
/// The system does not permit it: the thread stays as it is.
pub fn prefer(urgency: Urgency) -> Result<(), Refused> {
    let value = ThreadPriorityValue::try_from(urgency.priority()).map_err(|reason| Refused { reason })?;
    set(ThreadPriority::Crossplatform(value)).map_err(|error| Refused { reason: told(&error) })
}

#[cfg(unix)]
fn set(priority: ThreadPriority) -> Result<(), thread_priority::Error> {
    use thread_priority::{RealtimeThreadSchedulePolicy, ThreadSchedulePolicy};
    let first_in_first_out = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    thread_priority::set_thread_priority_and_policy(thread_priority::thread_native_id(), priority, first_in_first_out)
}

#[cfg(windows)]
fn set(_: ThreadPriority) -> Result<(), thread_priority::Error> {
    // Windows has one such class, whose threads take turns.
    let critical = thread_priority::windows::WinAPIThreadPriority::TimeCritical;
    thread_priority::set_current_thread_priority(ThreadPriority::Os(critical.into()))
}

fn told(error: &thread_priority::Error) -> String {
    match error {
        thread_priority::Error::OS(code) => std::io::Error::from_raw_os_error(*code).to_string(),
        error => error.to_string(),
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    /// The policy and the real-time priority of the calling thread, as the system tells them (proc_pid_stat(5): fields 41
    /// and 40; 1 is `SCHED_FIFO`).
    fn scheduled() -> (u32, u32) {
        let stat = std::fs::read_to_string("/proc/thread-self/stat").expect("the system tells");
        let (_, rest) = stat.rsplit_once(") ").expect("a name in brackets");
        let fields: Vec<&str> = rest.split(' ').collect();
        let field = |number: usize| fields[number - 3].parse().expect("a number");
        (field(41), field(40))
    }

    #[test]
    fn a_thread_is_scheduled_as_it_asked_or_told_why_not() {
        std::thread::spawn(|| match prefer(Urgency::Simulation) {
            Ok(()) => assert_eq!(scheduled(), (1, 20)),
            Err(refused) => {
                assert_eq!(scheduled(), (0, 0), "it stays as it is");
                assert!(refused.to_string().contains("CAP_SYS_NICE"), "{refused}");
            }
        })
        .join()
        .expect("a thread that ends");
    }
}
