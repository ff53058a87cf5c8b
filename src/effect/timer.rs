//! A switch that follows late: the on-delay and off-delay timers of IEC 61131-3:2013, 6.6.3.5.5 (TON and TOF).

use crate::device::law::SAME_INSTANT_S;

/// A switch that takes on its late state only after its input has stood there for a time; the other at once.
#[derive(Clone, Debug)]
pub(super) struct Timer {
    time: f64,
    late: Late,
    exit: Option<bool>,
    /// When it will follow, if the input stays.
    due: Option<f64>,
}

/// Which state comes late.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Late {
    On,
    Off,
}

impl Timer {
    /// At first it is in the state `initial`, or in that of its input if `None`.
    pub fn new(time: f64, late: Late, initial: Option<bool>) -> Timer {
        Timer { time, late, exit: initial, due: None }
    }

    /// What stands at its exit while `input` stands at its entry.
    pub fn pass(&mut self, input: bool, now: f64) -> bool {
        let exit = *self.exit.get_or_insert(input);
        if input == exit {
            self.due = None;
            return exit;
        }
        let waits = match self.late {
            Late::On => input,
            Late::Off => !input,
        };
        let due = if waits { *self.due.get_or_insert(now + self.time) } else { now };
        if due <= now + SAME_INSTANT_S {
            self.exit = Some(input);
            self.due = None;
            return input;
        }
        exit
    }

    /// When it will follow, if nothing changes.
    pub fn next(&self) -> Option<f64> {
        self.due
    }

    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.exit.map_or(-1.0, |exit| f64::from(u8::from(exit))));
        visit(self.due.unwrap_or(-1.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inputs at times in ms, and the changes seen at the exit in steps of 1 ms.
    fn check(late: Late, inputs: &[(u32, bool)], changes: &[(u32, bool)]) {
        let mut timer = Timer::new(0.05, late, Some(false));
        let (mut input, mut last, mut seen) = (false, false, Vec::new());
        for time in 0..1000 {
            input = inputs.iter().rev().find(|(at, _)| *at <= time).map_or(input, |(_, value)| *value);
            let exit = timer.pass(input, f64::from(time) * 1e-3);
            if exit != last {
                seen.push((time, exit));
                last = exit;
            }
        }
        assert_eq!(seen, changes, "{late:?} {inputs:?}");
    }

    #[test]
    fn it_follows_late_one_way_and_at_once_the_other() {
        check(Late::On, &[(100, true), (300, false)], &[(150, true), (300, false)]);
        check(Late::Off, &[(100, true), (300, false)], &[(100, true), (350, false)]);
    }

    #[test]
    fn what_does_not_last_is_not_seen() {
        check(Late::On, &[(100, true), (140, false), (200, true), (249, false)], &[]);
        check(Late::Off, &[(100, true), (300, false), (340, true), (500, false)], &[(100, true), (550, false)]);
    }
}
