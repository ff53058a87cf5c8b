//! What is on or off, and takes its time.

use crate::quirk::Quirks;

/// A switch whose change is seen later: on after one time, off after another. What does not last that long is never seen.
#[derive(Clone, Debug, Default)]
pub struct Delay {
    on: f64,
    off: f64,
    told: bool,
    since: f64,
    was: bool,
}

impl Delay {
    /// With these delays, off to begin with.
    pub fn new(on: f64, off: f64) -> Delay {
        Delay { on, off, since: f64::NEG_INFINITY, ..Delay::default() }
    }

    /// With the `time` of two effects.
    pub fn of(quirks: Quirks<'_>, on: &str, off: &str) -> Delay {
        let time = |effect| quirks.value(effect, "time").unwrap_or(0.0);
        Delay::new(time(on), time(off))
    }

    /// It is told at `now` to be on or off.
    pub fn set(&mut self, now: f64, on: bool) {
        if on != self.told {
            self.was = self.at(now);
            self.told = on;
            self.since = now;
        }
    }

    /// Whether it is seen to be on at `now`.
    pub fn at(&self, now: f64) -> bool {
        let wait = if self.told { self.on } else { self.off };
        // Sums of steps differ from what they should be by some units in the last place.
        if now - self.since >= wait - 1e-9 { self.told } else { self.was }
    }
}

#[cfg(test)]
mod tests {
    use super::Delay;

    #[test]
    fn a_change_is_seen_after_its_time_and_a_pulse_never() {
        let mut delay = Delay::new(0.1, 0.2);
        delay.set(1.0, true);
        assert!(!delay.at(1.05) && delay.at(1.1));
        delay.set(1.5, false);
        assert!(delay.at(1.6) && !delay.at(1.7));
        delay.set(2.0, true);
        delay.set(2.05, false);
        assert!(!delay.at(2.2) && !delay.at(3.0));
    }
}
