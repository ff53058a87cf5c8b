//! Which core a thread runs on.
//!
//! Who wakes whom on which core is the scheduler's to choose, and it chooses anew for each pair of threads, once, by what
//! they did at their beginning: a round trip to a core that has halted takes twice one within a core. A table of ratios
//! would say where each row's threads happened to lie. On one core all rows pay the same.

/// While it lives, this thread, and the threads and processes that it starts, stay on one core.
pub struct OneCore {
    /// Those that it might run on before.
    before: Vec<usize>,
}

impl OneCore {
    /// On the last core that this thread may run on. `None` where the system does not let one choose.
    pub fn take() -> Option<OneCore> {
        let before = allowed();
        stay(&[*before.last()?]).then_some(OneCore { before })
    }
}

impl Drop for OneCore {
    fn drop(&mut self) {
        // It was allowed before.
        stay(&self.before);
    }
}

/// The cores that this thread may run on; none where the system does not say.
#[cfg(target_os = "linux")]
pub fn allowed() -> Vec<usize> {
    use rustix::thread::{CpuSet, sched_getaffinity};
    let Ok(set) = sched_getaffinity(None) else { return Vec::new() };
    (0..CpuSet::MAX_CPU).filter(|core| set.is_set(*core)).collect()
}

/// Keeps this thread on `cores`. Whether it is so.
#[cfg(target_os = "linux")]
pub fn stay(cores: &[usize]) -> bool {
    use rustix::thread::{CpuSet, sched_setaffinity};
    let mut set = CpuSet::new();
    cores.iter().for_each(|core| set.set(*core));
    sched_setaffinity(None, &set).is_ok()
}

/// The cores that this thread may run on; none where the system does not say.
#[cfg(not(target_os = "linux"))]
pub fn allowed() -> Vec<usize> {
    Vec::new()
}

/// Keeps this thread on `cores`. Whether it is so.
#[cfg(not(target_os = "linux"))]
pub fn stay(_cores: &[usize]) -> bool {
    false
}
