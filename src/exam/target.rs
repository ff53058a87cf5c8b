//! What the rates of an exam have to reach.

use std::fmt;

use super::rates::Rate;
use crate::gap::report::number::percent;

/// What a rate must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    AtLeast(f64),
    AtMost(f64),
    Within(f64, f64),
}

/// How a rate stands to its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// All of its interval lies where the target is: so many cases show it.
    Met,
    /// Its value does, and its interval goes further.
    InValue,
    Missed,
}

impl Target {
    /// How `rate` stands to it; `None` where no case was counted.
    pub fn reached(self, rate: &Rate) -> Option<Reached> {
        let value = rate.value?;
        let [low, high] = rate.ci95.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let (is_in, is_whole) = match self {
            Target::AtLeast(least) => (value >= least, low >= least),
            Target::AtMost(most) => (value <= most, high <= most),
            Target::Within(least, most) => ((least..=most).contains(&value), low >= least && high <= most),
        };
        Some(match (is_in, is_whole) {
            (true, true) => Reached::Met,
            (true, false) => Reached::InValue,
            (false, _) => Reached::Missed,
        })
    }

    /// Whether no value within the interval of `rate` would do.
    pub fn is_out_of_reach(self, rate: &Rate) -> bool {
        let Some([low, high]) = rate.ci95 else { return false };
        match self {
            Target::AtLeast(least) => high < least,
            Target::AtMost(most) => low > most,
            Target::Within(least, most) => high < least || low > most,
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Target::AtLeast(least) => write!(f, "at least {}", percent(least)),
            Target::AtMost(most) => write!(f, "at most {}", percent(most)),
            Target::Within(least, most) => write!(f, "{:.0} to {}", 100.0 * least, percent(most)),
        }
    }
}

impl Reached {
    /// The words for it.
    pub const fn words(self) -> &'static str {
        match self {
            Reached::Met => "met",
            Reached::InValue => "met in value alone",
            Reached::Missed => "missed",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_is_met_by_the_bound_of_the_interval() {
        let check = |target: Target, yes: usize, n: usize, expected| {
            let rate = Rate::share((0..n).map(|k| k < yes));
            assert_eq!(target.reached(&rate), expected, "{yes} of {n}, {target}");
        };
        let [met, in_value, missed] = [Reached::Met, Reached::InValue, Reached::Missed].map(Some);
        // Wilson's intervals: 97.8 to 99.7 % of 395 of 398, 88.6 to 100 % of 30, 95.5 to 98.6 % of 390 of 400.
        check(Target::AtLeast(0.95), 395, 398, met);
        check(Target::AtLeast(0.95), 30, 30, in_value);
        check(Target::AtLeast(0.95), 28, 30, missed);
        check(Target::AtMost(0.02), 0, 400, met);
        check(Target::AtMost(0.02), 0, 30, in_value);
        check(Target::AtMost(0.02), 1, 30, missed);
        check(Target::Within(0.90, 0.98), 380, 400, met);
        check(Target::Within(0.90, 0.98), 390, 400, in_value);
        check(Target::Within(0.90, 0.98), 400, 400, missed);
        check(Target::AtLeast(0.95), 0, 0, None);
        let out_of_reach = |target: Target, yes, n| target.is_out_of_reach(&Rate::share((0..n).map(|k| k < yes)));
        assert!(out_of_reach(Target::AtLeast(0.95), 2, 10) && !out_of_reach(Target::AtLeast(0.95), 9, 10));
        assert!(out_of_reach(Target::Within(0.90, 0.98), 400, 400) && !out_of_reach(Target::Within(0.90, 0.98), 1, 1));
        assert!(out_of_reach(Target::AtMost(0.02), 4, 10) && !out_of_reach(Target::AtMost(0.02), 0, 0));
        assert_eq!(Target::Within(0.90, 0.98).to_string(), "90 to 98 %");
        assert_eq!(Target::AtMost(0.05).to_string(), "at most 5 %");
    }
}
