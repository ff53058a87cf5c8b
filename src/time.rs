//! Simulated time, and every other time the lower layers know: integer nanoseconds.
//!
//! Nothing below `adapter` reads a clock. An [`Instant`] is therefore handed in, counted from the start of *some* clock:
//! the simulation's own, the session's, a recorder's. Two instants of different clocks must never be subtracted; the
//! places that meet two clocks (the recorder, the diagnosis) say so.
//!
//! Integers, because a step of 1 ms added 600 000 times must be 600 s exactly: a replay compares states bit by bit.

use std::fmt;
use std::ops::{Add, AddAssign, Sub};
use std::time::Duration;

/// A point in time, in nanoseconds since the start of its clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instant(i64);

/// Nanoseconds in a second.
const SECOND_NS: i64 = 1_000_000_000;

impl Instant {
    /// The start of the clock.
    pub const ZERO: Instant = Instant(0);
    /// The last instant there is; "never" for a deadline.
    pub const FAR: Instant = Instant(i64::MAX);

    /// An instant `ns` nanoseconds after the start of its clock (before it, if negative).
    pub const fn from_nanos(ns: i64) -> Self {
        Instant(ns)
    }

    /// The instant nearest to `seconds` after the start; saturates, and takes NaN for 0.
    pub fn from_seconds(seconds: f64) -> Self {
        Instant((seconds * SECOND_NS as f64).round() as i64)
    }

    /// Nanoseconds since the start of the clock.
    pub const fn nanos(self) -> i64 {
        self.0
    }

    /// Seconds since the start of the clock, rounded to the nearest f64.
    pub fn seconds(self) -> f64 {
        self.0 as f64 / SECOND_NS as f64
    }

    /// The time from `earlier` to here; zero if `earlier` is later.
    pub fn since(self, earlier: Instant) -> Duration {
        Duration::from_nanos(self.0.saturating_sub(earlier.0).max(0) as u64)
    }
}

impl Add<Duration> for Instant {
    type Output = Instant;

    fn add(self, span: Duration) -> Instant {
        Instant(self.0.saturating_add(i64::try_from(span.as_nanos()).unwrap_or(i64::MAX)))
    }
}

impl AddAssign<Duration> for Instant {
    fn add_assign(&mut self, span: Duration) {
        *self = *self + span;
    }
}

impl Sub<Duration> for Instant {
    type Output = Instant;

    fn sub(self, span: Duration) -> Instant {
        Instant(self.0.saturating_sub(i64::try_from(span.as_nanos()).unwrap_or(i64::MAX)))
    }
}

impl fmt::Display for Instant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3} s", self.seconds())
    }
}

/// What was wrong with a text that should have been a duration.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found:?} is no duration: write a number and a unit, one of ns, us, ms, s, m, h (as 20s, 500ms, 1.5s, 2m)")]
pub struct ParseDurationError {
    found: String,
}

/// Reads a duration as people write it on a command line or in a plant's file: `20s`, `500ms`, `2m`, `1.5s`, `0s`.
///
/// A bare `0` is taken; any other number without a unit is refused, because a wrong guess is a factor of a thousand.
pub fn parse_duration(text: &str) -> Result<Duration, ParseDurationError> {
    let refuse = || ParseDurationError { found: text.to_owned() };
    let trimmed = text.trim();
    if trimmed == "0" {
        return Ok(Duration::ZERO);
    }
    let digits = trimmed.find(|c: char| c != '.' && !c.is_ascii_digit()).ok_or_else(refuse)?;
    let (number, unit) = trimmed.split_at(digits);
    let unit_ns = match unit.trim_start() {
        "ns" => 1.0,
        "us" | "µs" => 1e3,
        "ms" => 1e6,
        "s" => 1e9,
        "m" | "min" => 60e9,
        "h" => 3600e9,
        _ => return Err(refuse()),
    };
    let number: f64 = number.parse().map_err(|_| refuse())?;
    let ns = number * unit_ns;
    // A century is longer than any run and still far from the end of the clock.
    if !ns.is_finite() || ns > 3.2e18 {
        return Err(refuse());
    }
    Ok(Duration::from_nanos(ns.round() as u64))
}

/// Writes a duration in the largest unit that keeps it short: `20s`, `500ms`, `1.5ms`.
pub fn format_duration(span: Duration) -> String {
    let ns = span.as_nanos();
    let (unit_ns, unit) = match ns {
        0 => return "0s".to_owned(),
        ns if ns >= 1_000_000_000 => (1e9, "s"),
        ns if ns >= 1_000_000 => (1e6, "ms"),
        ns if ns >= 1_000 => (1e3, "us"),
        _ => (1.0, "ns"),
    };
    format!("{}{unit}", ns as f64 / unit_ns)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, ns: u64) {
        assert_eq!(parse_duration(text), Ok(Duration::from_nanos(ns)), "{text}");
    }

    #[test]
    fn durations_as_people_write_them() {
        check("20s", 20_000_000_000);
        check("500ms", 500_000_000);
        check("2m", 120_000_000_000);
        check("1.5s", 1_500_000_000);
        check("20 ms", 20_000_000);
        check("0", 0);
        check("0s", 0);
    }

    #[test]
    fn a_number_without_a_unit_is_refused() {
        for text in ["20", "", "s", "20 parsecs", "-1s", "1.2.3s", "1e400s", "NaNs", "99999999999h"] {
            assert!(parse_duration(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_duration_written_reads_back() {
        for ns in [0, 1, 1_500, 20_000_000, 1_500_000_000, 61_000_000_000] {
            let span = Duration::from_nanos(ns);
            assert_eq!(parse_duration(&format_duration(span)), Ok(span));
        }
    }

    #[test]
    fn six_hundred_thousand_steps_are_six_hundred_seconds() {
        let mut now = Instant::ZERO;
        for _ in 0..600_000 {
            now += Duration::from_millis(1);
        }
        assert_eq!(now, Instant::from_seconds(600.0));
    }

    #[test]
    fn nothing_overflows() {
        assert_eq!(Instant::FAR + Duration::MAX, Instant::FAR);
        assert_eq!(Instant::ZERO.since(Instant::FAR), Duration::ZERO);
        assert_eq!(Instant::from_seconds(f64::NAN), Instant::ZERO);
        assert_eq!(Instant::from_seconds(f64::INFINITY), Instant::FAR);
    }
}
