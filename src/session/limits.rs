//! What one end takes from the other: how many values in a message, how many messages in a second.
//!
//! The length of a message is the transport's business, how deep its JSON is nested the codec's
//! ([`wire`](crate::wire), 32).

use std::time::Duration;

use crate::time::Instant;

/// Limits to what a peer may send.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Values in one `SendValue`. A message with more is refused whole.
    pub values: usize,
    /// Messages of any kind in a second. A peer that sends more is cut off.
    pub messages_a_second: u32,
}

impl Default for Limits {
    /// As many values as the bank's input queue holds, and 100 000 messages in a second.
    fn default() -> Limits {
        Limits { values: 65_536, messages_a_second: 100_000 }
    }
}

impl Limits {
    /// Why a message of so many values is refused; `None` where it is not.
    pub(super) fn refuse(&self, values: usize) -> Option<String> {
        (values > self.values)
            .then(|| format!("the message holds {values} values, more than the limit of {}", self.values))
    }
}

/// Counts messages against the limit: the generic cell rate algorithm (ITU-T I.371, annex A) with a burst of one second.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gauge {
    /// When the messages so far would have come, had each kept its distance.
    expected: Instant,
    distance: Duration,
    limit: u32,
}

impl Gauge {
    pub(super) fn new(limits: &Limits) -> Gauge {
        let limit = limits.messages_a_second.max(1);
        Gauge { expected: Instant::from_nanos(i64::MIN / 2), distance: Duration::from_secs(1) / limit, limit }
    }

    /// Counts a message at `now`; or says why the peer is to be cut off.
    pub(super) fn count(&mut self, now: Instant) -> Result<(), String> {
        self.expected = self.expected.max(now) + self.distance;
        if self.expected.since(now) > Duration::from_secs(1) + self.distance {
            return Err(format!("more than {} messages came within a second", self.limit));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(messages: u32, apart: Duration) -> u32 {
        let mut gauge = Gauge::new(&Limits { messages_a_second: 100, ..Limits::default() });
        (0..messages).filter(|k| gauge.count(Instant::ZERO + *k * apart).is_err()).count() as u32
    }

    #[test]
    fn a_burst_of_a_second_is_taken_and_no_more() {
        assert_eq!(refused(101, Duration::ZERO), 0);
        assert_eq!(refused(103, Duration::ZERO), 2);
    }

    #[test]
    fn the_rate_can_be_held_for_ever() {
        assert_eq!(refused(10_000, Duration::from_millis(10)), 0);
        assert!(refused(10_000, Duration::from_millis(9)) > 0);
    }
}
