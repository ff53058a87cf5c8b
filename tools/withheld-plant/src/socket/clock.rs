//! A clock, and how late its owner was.

use std::time::{Duration, Instant};

/// Seconds since it was started.
#[derive(Clone, Copy, Debug)]
pub struct Clock(Instant);

impl Clock {
    /// From now on.
    pub fn start() -> Clock {
        Clock(Instant::now())
    }

    /// The clock that was started at `start`.
    pub fn started(start: Instant) -> Clock {
        Clock(start)
    }

    /// s
    pub fn now(self) -> f64 {
        self.at(Instant::now())
    }

    /// What it said at `instant`, s; 0 before its start.
    pub fn at(self, instant: Instant) -> f64 {
        instant.saturating_duration_since(self.0).as_secs_f64()
    }

    /// How long it is until `at`, s; `None` where that has come.
    pub fn until(self, at: f64) -> Option<Duration> {
        let left = at - self.now();
        (left > 0.0).then(|| Duration::try_from_secs_f64(left).unwrap_or(Duration::MAX))
    }
}

/// By how much events came later than they were due, each in s.
#[derive(Clone, Debug, Default)]
pub struct Lateness {
    all: Vec<f64>,
    /// By how much the way of a command was longer or shorter than that of most.
    unsure: f64,
}

impl Lateness {
    /// One more event.
    pub fn note(&mut self, late: f64) {
        self.all.push(late);
    }

    /// Messages were sent at these instants of one clock, and were there at those of another.
    pub fn note_ways(&mut self, sent: &[f64], arrived: &[f64]) {
        let mut ways: Vec<f64> = sent.iter().zip(arrived).map(|(sent, arrived)| arrived - sent).collect();
        ways.sort_by(f64::total_cmp);
        let middle = ways.get(ways.len() / 2).copied().unwrap_or(0.0);
        self.unsure = ways.iter().map(|way| (way - middle).abs()).fold(self.unsure, f64::max);
    }

    /// By how much the way of a command was longer or shorter than that of most: so wrong is the recording about it.
    pub fn unsure(&self) -> f64 {
        self.unsure
    }

    /// Those of both.
    pub fn and(mut self, other: Lateness) -> Lateness {
        self.all.extend(other.all);
        self.unsure = self.unsure.max(other.unsure);
        self
    }

    /// The latest.
    pub fn most(&self) -> f64 {
        self.all.iter().copied().fold(0.0, f64::max)
    }

    /// What this share of all events did not exceed; 0 where there were none.
    pub fn quantile(&self, share: f64) -> f64 {
        let mut sorted = self.all.clone();
        sorted.sort_by(f64::total_cmp);
        let at = (share * sorted.len() as f64) as usize;
        sorted.get(at.min(sorted.len().saturating_sub(1))).copied().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Lateness;

    #[test]
    fn lateness_is_told_by_its_share_and_its_most() {
        let mut all = Lateness::default();
        (0..100).for_each(|k| all.note(f64::from(99 - k)));
        let mut other = Lateness::default();
        other.note(200.0);
        let all = all.and(other);
        assert_eq!([all.quantile(0.5), all.quantile(0.99), all.most()], [50.0, 99.0, 200.0]);
        assert_eq!(Lateness::default().quantile(0.5), 0.0);
    }
}
