//! Whether memory grows: a line through its samples, with its interval.

use std::fmt;
use std::time::Duration;

/// Memory over time.
#[derive(Default)]
pub struct Memory(Vec<(f64, f64)>);

/// The slope of a line through samples, with 95 % intervals, KiB a minute.
pub struct Slope {
    slope: f64,
    half: f64,
    last_mib: f64,
    minutes: f64,
}

/// What may not be told from an allocator that finds its size: a megabyte over the time that was watched.
const NEGLIGIBLE_KIB: f64 = 1024.0;
/// How long has to be watched before a slope tells a leak from buffers that find their size, minutes.
const LONG_ENOUGH: f64 = 6.0;
/// More than a run and all that may wait in it takes, MiB: past that it grows, however short the time.
const MOST_MIB: f64 = 96.0;
/// Blocks of samples whose means count as independent.
const BLOCKS: usize = 12;

impl Memory {
    pub fn sample(&mut self, at: Duration, bytes: u64) {
        self.0.push((at.as_secs_f64() / 60.0, bytes as f64 / 1024.0));
    }

    /// Least squares through the means of blocks of the last two thirds, since neighbours in time are alike; the first
    /// third is that of buffers that find their size. `None` of too few.
    pub fn slope(&self) -> Option<Slope> {
        let samples = &self.0[self.0.len() / 3..];
        if samples.len() < 5 * BLOCKS {
            return None;
        }
        let mean = |values: &mut dyn Iterator<Item = f64>, count: usize| values.sum::<f64>() / count as f64;
        let size = samples.len() / BLOCKS;
        let blocks: Vec<(f64, f64)> = samples
            .chunks_exact(size)
            .take(BLOCKS)
            .map(|chunk| (mean(&mut chunk.iter().map(|s| s.0), size), mean(&mut chunk.iter().map(|s| s.1), size)))
            .collect();
        let (x, y) = (mean(&mut blocks.iter().map(|b| b.0), BLOCKS), mean(&mut blocks.iter().map(|b| b.1), BLOCKS));
        let sxx: f64 = blocks.iter().map(|b| (b.0 - x).powi(2)).sum();
        let slope = blocks.iter().map(|b| (b.0 - x) * (b.1 - y)).sum::<f64>() / sxx;
        let rest: f64 = blocks.iter().map(|b| (b.1 - y - slope * (b.0 - x)).powi(2)).sum();
        // Student's t for ten degrees of freedom, two-sided 95 %.
        let half = 2.228 * (rest / (BLOCKS as f64 - 2.0) / sxx).sqrt();
        let (first, last) = (samples.first()?, samples.last()?);
        Some(Slope { slope, half, last_mib: last.1 / 1024.0, minutes: last.0 - first.0 })
    }
}

impl Slope {
    /// Whether it grows beyond doubt, and by more than nothing; in a short time, whether it is more than can be explained.
    pub fn grows(&self) -> bool {
        let is_beyond_doubt = (self.slope - self.half) * self.minutes > NEGLIGIBLE_KIB;
        (self.minutes >= LONG_ENOUGH && is_beyond_doubt) || self.last_mib > MOST_MIB
    }
}

impl fmt::Display for Slope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Slope { slope, half, last_mib, .. } = self;
        write!(
            f,
            "{slope:+.1} KiB a minute ({:+.1} to {:+.1}), {last_mib:.1} MiB at the end",
            slope - half,
            slope + half
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slope(of: impl Fn(u64) -> u64) -> Slope {
        let mut memory = Memory::default();
        (0..600).for_each(|s| memory.sample(Duration::from_secs(s), of(s)));
        memory.slope().expect("enough samples")
    }

    #[test]
    fn a_leak_is_seen_and_noise_is_none() {
        let noise = |s: u64| (s * 7919) % 13 * 4096;
        assert!(!slope(|s| 50_000_000 + noise(s)).grows());
        assert!(slope(|s| 50_000_000 + noise(s) + s * 4096).grows(), "240 KiB a minute");
    }
}
