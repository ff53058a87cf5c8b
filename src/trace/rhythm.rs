//! How often something comes: intervals in a histogram, so that memory does not grow with their number.

use crate::time::Instant;

/// A step between two classes of intervals: 2 %, fine enough for a median that people read.
const STEP: f64 = 1.02;
/// The shortest interval told apart, in nanoseconds.
const LEAST_NS: f64 = 1_000.0;
/// Pauses kept; a trace with more is a trace of pauses.
const KEPT: usize = 4096;

/// Intervals between the times of something.
#[derive(Clone, Debug, Default)]
pub(super) struct Rhythm {
    last: Option<Instant>,
    /// How many intervals of each class.
    classes: Vec<u64>,
    count: u64,
    /// The longest intervals, by their length and their begin.
    longest: Vec<(u64, Instant)>,
}

impl Rhythm {
    /// It comes. Twice at one instant is once.
    pub fn beat(&mut self, at: Instant) {
        let Some(last) = self.last.replace(at) else { return };
        let ns = at.nanos().saturating_sub(last.nanos()).unsigned_abs();
        if ns == 0 {
            return;
        }
        let class = ((ns as f64 / LEAST_NS).max(1.0).ln() / STEP.ln()).round() as usize;
        if self.classes.len() <= class {
            self.classes.resize(class + 1, 0);
        }
        self.classes[class] += 1;
        self.count += 1;
        if self.longest.len() < KEPT {
            self.longest.push((ns, last));
        } else if let Some(shortest) = self.longest.iter_mut().min()
            && shortest.0 < ns
        {
            *shortest = (ns, last);
        }
    }

    /// The median interval in seconds, to 1 %.
    pub fn median_s(&self) -> Option<f64> {
        let mut before = 0;
        for (class, count) in self.classes.iter().enumerate() {
            before += count;
            if *count > 0 && before * 2 >= self.count {
                return Some(LEAST_NS * 1e-9 * STEP.powi(class as i32));
            }
        }
        None
    }

    /// The intervals longer than `least_ns` and than so many median ones, begin and end in seconds, in their order.
    pub fn pauses(&self, least_ns: u64, medians: u64) -> impl Iterator<Item = (f64, f64)> {
        let median_ns = self.median_s().unwrap_or_default() * 1e9;
        let least_ns = (least_ns as f64).max(median_ns * medians as f64);
        let mut pauses: Vec<(Instant, u64)> =
            self.longest.iter().filter(|(ns, _)| *ns as f64 > least_ns).map(|(ns, from)| (*from, *ns)).collect();
        pauses.sort_unstable();
        pauses.into_iter().map(|(from, ns)| (from.seconds(), from.seconds() + ns as f64 * 1e-9))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rhythm(times_ms: impl IntoIterator<Item = i64>) -> Rhythm {
        let mut rhythm = Rhythm::default();
        times_ms.into_iter().for_each(|ms| rhythm.beat(Instant::from_nanos(ms * 1_000_000)));
        rhythm
    }

    #[test]
    fn the_median_is_the_usual_interval() {
        let check = |times: &[i64], median: Option<f64>| {
            let found = rhythm(times.iter().copied()).median_s();
            let is_near = match (found, median) {
                (Some(found), Some(median)) => (found / median - 1.0).abs() < 0.011,
                (found, median) => found == median,
            };
            assert!(is_near, "{times:?}: {found:?}");
        };
        check(&[], None);
        check(&[5], None);
        check(&[5, 5], None);
        check(&[0, 20, 40, 60, 5060], Some(0.02));
        check(&[0, 1, 2, 502, 1002, 1502], Some(0.5));
    }

    #[test]
    fn pauses_are_long_and_unusual() {
        let with_a_pause = rhythm((0..100).map(|k| k * 20).chain((0..100).map(|k| 10_000 + k * 20)));
        let pauses: Vec<(f64, f64)> = with_a_pause.pauses(2_000_000_000, 20).collect();
        assert!(
            pauses.len() == 1 && (pauses[0].0 - 1.98).abs() < 1e-9 && (pauses[0].1 - 10.0).abs() < 1e-9,
            "{pauses:?}"
        );
        let slow = rhythm((0..10).map(|k| k * 5_000));
        assert_eq!(slow.pauses(2_000_000_000, 20).count(), 0);
    }
}
