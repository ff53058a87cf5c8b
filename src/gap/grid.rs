//! When a machine looked at its state: the exact cycle behind the stamps of its reports.
//!
//! A PLC samples its state at `tau_k = t0 + k·cycle`, exactly, and stamps the report a little later, by as much as the
//! sending took. Compared at its stamps a moving axis would seem tens of its noise floors off; compared at `tau_k` it is off
//! by its rounding alone. So the grid is rebuilt from the stamps (never from the motion, which may hold the gap):
//!
//! 1. The cycle is the slope of the stamps over their cycle numbers, rounded to a microsecond where that is within its error, or a little beyond it and the
//!    stamps begin at one line then.
//! 2. What is left, `r_k = t_k − k·cycle`, says how the stamps lie about the grid. All alike: the stamps are the grid. Skewed
//!    to one side: they are late only (early only), and the grid is where they begin (end). Else it is their mean.
//! 3. Where `r` is spread over the cycle there is no grid: the stamps are used as they are, and their spread goes into the
//!    floor of what moves.
//!
//! A cycle without a line is one in which nothing changed: its value is the last one, and it counts like any other. Where most have none,
//! because all that is reported are a few states, the cycle is about the shortest time between two stamps, and the one near that by which all of
//! them lie alike.
//!
//! Source: the clean recordings of an independent simulation; the lateness there is |N(0, jitter²)|, and the rules are those
//! that bring every clean signal of 16 recordings down to its rounding.

/// Instants at which a state was looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// In ascending order, s since the trace's start.
    pub instants: Vec<f64>,
    /// The time between two of them; of irregular stamps their median, s.
    pub cycle: f64,
    /// How far an instant may be off, standard deviation, s: 0 of a rebuilt grid.
    pub spread: f64,
    /// How late the stamps are behind the instants, root mean square, s.
    pub lateness: f64,
    /// Whether the instants are a grid; else they are the stamps.
    pub is_rebuilt: bool,
}

/// What a regular grid must have at least to be believed.
const LEAST_STAMPS: usize = 8;
/// Below this spread the stamps are the grid, s.
const SAME_STAMP_S: f64 = 2e-6;
/// What a cycle is rounded to where its error allows, s.
const ROUND_CYCLE_S: f64 = 1e-6;
/// Within how many of its standard errors at most: in three of a thousand grids it is off by more than three.
const MOST_ERRORS: f64 = 6.0;

impl Grid {
    /// The grid behind `stamps`, which ascend, up to the last of them.
    pub fn rebuild(stamps: &[f64]) -> Grid {
        // A machine that sends several messages in each cycle stamps it several times.
        let thinned = || rebuilt(&first_of_each(stamps)).filter(|grid| grid.fits(stamps));
        let sparse = || rebuilt_about(stamps, cycle_of_few(stamps)?);
        rebuilt(stamps).or_else(thinned).or_else(sparse).unwrap_or_else(|| Grid::of_stamps(stamps))
    }

    /// A grid that is known: the multiples of `step` from 0 to `ends`.
    pub fn of_steps(step: f64, ends: f64) -> Grid {
        let count = (ends / step + 0.5).floor() as usize + 1;
        let instants = (0..count).map(|k| k as f64 * step).collect();
        Grid { instants, cycle: step, spread: 0.0, lateness: 0.0, is_rebuilt: true }
    }

    /// Stamps that are the instants themselves.
    pub fn of_rows(stamps: &[f64]) -> Grid {
        Grid { spread: 0.0, ..Grid::of_stamps(stamps) }
    }

    /// The stamps themselves, in place of instants that nobody knows.
    pub fn of_stamps(stamps: &[f64]) -> Grid {
        let cycle = median(&spacings(stamps)).unwrap_or(0.0);
        let off: Vec<f64> = spacings(stamps).iter().map(|spacing| (spacing - cycle).abs()).collect();
        let spread = median(&off).unwrap_or(0.0) * 1.4826 / std::f64::consts::SQRT_2;
        Grid { instants: stamps.to_vec(), cycle, spread, lateness: 0.0, is_rebuilt: false }
    }

    /// The instant that a stamp belongs to: the nearest of a grid, or of late stamps the one before.
    pub fn index(&self, stamp: f64) -> usize {
        let last = self.instants.len().saturating_sub(1);
        if self.is_rebuilt && self.cycle > 0.0 {
            let first = self.instants.first().copied().unwrap_or(0.0);
            let late = if self.lateness > 0.0 { self.lateness } else { 0.0 };
            let cycles = (stamp - late - first) / self.cycle;
            return (cycles.round().max(0.0) as usize).min(last);
        }
        let after = self.instants.partition_point(|at| *at < stamp - 1e-9);
        after.min(last)
    }

    /// Whether `stamps` lie on this grid as its own do: within as much of it.
    pub fn fits(&self, stamps: &[f64]) -> bool {
        let allowed = 4.0 * self.lateness + 5.0 * SAME_STAMP_S;
        let on = |stamp: &&f64| (**stamp - self.instants[self.index(**stamp)]).abs() <= allowed;
        self.is_rebuilt && stamps.iter().filter(on).count() * 100 >= stamps.len() * 98
    }
}

/// The first stamp of each bunch: what follows another within a quarter of the usual cycle, which most of the time passes in, is of
/// the same cycle.
fn first_of_each(stamps: &[f64]) -> Vec<f64> {
    let mut spacings = spacings(stamps);
    spacings.sort_by(|a, b| b.total_cmp(a));
    let half = 0.5 * spacings.iter().sum::<f64>();
    let mut passed = 0.0;
    let cycle = spacings.iter().find(|spacing| {
        passed += **spacing;
        passed >= half
    });
    let bunch = 0.25 * cycle.copied().unwrap_or(0.0);
    let mut firsts: Vec<f64> = Vec::with_capacity(stamps.len());
    for stamp in stamps {
        if firsts.last().is_none_or(|first| stamp - first > bunch) {
            firsts.push(*stamp);
        }
    }
    firsts
}

/// The cycle of which most have no stamp: near the shortest times between two, the one by which the stamps' phases agree best. (Of so many stamps
/// that come anyhow, one in a hundred thousand sets agrees by chance as those of a grid must.)
fn cycle_of_few(stamps: &[f64]) -> Option<f64> {
    const ENOUGH: usize = 48;
    /// How many of the shortest times are one cycle at least, and by how much they may differ.
    const SHORTEST: usize = 4;
    const ALIKE: f64 = 1.5;
    /// How far the cycle may be from them: late stamps make some of them shorter.
    const NEAR: f64 = 0.2;
    /// From so many stamps it is known well enough to find it from all.
    const MOST: usize = 400;
    /// Over more cycles than this so few stamps are spread by chance, or the shortest times lie within bunches of messages.
    const LONGEST: f64 = 2e4;
    if stamps.len() < ENOUGH {
        return None;
    }
    let stamps = &stamps[..stamps.len().min(MOST)];
    let mut spacings = spacings(stamps);
    spacings.sort_by(f64::total_cmp);
    let shortest = *spacings.first().filter(|shortest| **shortest > 0.0)?;
    let alike = &spacings[..spacings.partition_point(|spacing| *spacing < ALIKE * shortest)];
    let lasts = stamps[stamps.len() - 1] - stamps[0];
    let about = median(alike).filter(|about| alike.len() >= SHORTEST && lasts <= LONGEST * about)?;
    // A quarter of a turn from the first stamp to the last.
    let step = 0.25 * about * about / lasts;
    let most = (NEAR * about / step).ceil() as i64;
    let agreement = |cycle: f64| {
        let turns = stamps.iter().map(|stamp| std::f64::consts::TAU * (stamp - stamps[0]) / cycle);
        let (sine, cosine) = turns.fold((0.0, 0.0), |(sine, cosine), turn| (sine + turn.sin(), cosine + turn.cos()));
        sine.hypot(cosine)
    };
    let cycles = (-most..=most).map(|k| about + k as f64 * step);
    cycles.map(|cycle| (agreement(cycle), cycle)).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, cycle)| cycle)
}

fn rebuilt(stamps: &[f64]) -> Option<Grid> {
    rebuilt_about(stamps, median(&spacings(stamps)).filter(|cycle| *cycle > 0.0)?)
}

/// The grid whose cycle is about a `cycle`, s.
fn rebuilt_about(stamps: &[f64], mut cycle: f64) -> Option<Grid> {
    if stamps.len() < LEAST_STAMPS {
        return None;
    }
    let first = stamps[0];
    let mut offset = 0.0;
    let mut error = 0.0;
    // From the first stamps to all of them, so that an error of the cycle is never counted up to a whole one.
    let mut count = stamps.len().min(16);
    loop {
        for _ in 0..3 {
            (offset, cycle, error) = regress(&stamps[..count], first, offset, cycle)?;
        }
        if count == stamps.len() {
            break;
        }
        count = (4 * count).min(stamps.len());
    }
    let number = |stamp: f64, cycle: f64| ((stamp - first - offset) / cycle).round();
    let rest_of =
        |cycle: f64| stamps.iter().map(|stamp| stamp - first - number(*stamp, cycle) * cycle).collect::<Vec<f64>>();
    let rounded = (cycle / ROUND_CYCLE_S).round() * ROUND_CYCLE_S;
    let off = (rounded - cycle).abs();
    let is_rounded = off <= 3.0 * error + 1e-12 || off <= MOST_ERRORS * error && begins_at_one_line(&rest_of(rounded));
    if is_rounded && rounded > 0.0 {
        cycle = rounded;
    }
    let rest = rest_of(cycle);
    let mean = rest.iter().sum::<f64>() / rest.len() as f64;
    let moment = |power: i32| rest.iter().map(|r| (r - mean).powi(power)).sum::<f64>() / rest.len() as f64;
    let deviation = moment(2).sqrt();
    if deviation > cycle / 6.0 {
        return None;
    }
    let least = rest.iter().copied().fold(f64::INFINITY, f64::min);
    let most = rest.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let skew = if deviation > 0.0 { moment(3) / deviation.powi(3) } else { 0.0 };
    let from = |end: f64| (rest.iter().map(|r| (r - end).powi(2)).sum::<f64>() / rest.len() as f64).sqrt();
    let beyond = 1.25 / rest.len() as f64;
    let (start, lateness) = match skew {
        _ if deviation < SAME_STAMP_S => (mean, 0.0),
        skew if skew > 0.5 => (least - beyond * from(least), from(least)),
        skew if skew < -0.5 => (most + beyond * from(most), from(most)),
        _ => (mean, deviation),
    };
    let lowest = number(stamps[0], cycle);
    let highest = number(stamps[stamps.len() - 1], cycle);
    let instants = (lowest as i64..=highest as i64).map(|k| first + start + k as f64 * cycle).collect();
    Some(Grid { instants, cycle, spread: 0.0, lateness, is_rebuilt: true })
}

/// Whether lateness behind a grid begins at the same instant of its cycle from the first stamps to the last. Where many stamps are hardly late at all that
/// says far better than their mean whether a cycle is right: of half a normal distribution the least of n comes about 1.25·rms/n behind its begin, and the
/// slope of all is not known to a drift of ten of these.
fn begins_at_one_line(rest: &[f64]) -> bool {
    const PARTS: usize = 4;
    /// How many stamps of each: where they are few, ten times what is expected is as much as a drift of all that lateness.
    const ENOUGH: usize = 40;
    /// Of so many times what is expected, by chance in one of five thousand grids.
    const FURTHEST: f64 = 10.0;
    let length = rest.len() / PARTS;
    if length < ENOUGH {
        return false;
    }
    let least = |part: &[f64]| part.iter().copied().fold(f64::INFINITY, f64::min);
    let begins: Vec<f64> = rest.chunks_exact(length).take(PARTS).map(least).collect();
    let first = least(&begins);
    let lateness = (rest.iter().map(|r| (r - first).powi(2)).sum::<f64>() / rest.len() as f64).sqrt();
    begins.iter().all(|begin| begin - first <= FURTHEST * 1.25 * lateness / length as f64)
}

/// The line through the stamps over their cycle numbers: offset, slope, and the slope's standard error.
fn regress(stamps: &[f64], first: f64, offset: f64, cycle: f64) -> Option<(f64, f64, f64)> {
    let numbers: Vec<f64> = stamps.iter().map(|stamp| ((stamp - first - offset) / cycle).round()).collect();
    let n = stamps.len() as f64;
    let mean_k = numbers.iter().sum::<f64>() / n;
    let mean_t = stamps.iter().map(|stamp| stamp - first).sum::<f64>() / n;
    let pairs = || numbers.iter().zip(stamps).map(|(k, stamp)| (k - mean_k, stamp - first - mean_t));
    let spread = pairs().map(|(k, _)| k * k).sum::<f64>();
    if spread <= 0.0 {
        return None;
    }
    let slope = pairs().map(|(k, t)| k * t).sum::<f64>() / spread;
    let rest = pairs().map(|(k, t)| (t - slope * k).powi(2)).sum::<f64>() / (n - 2.0).max(1.0);
    (slope > 0.0).then(|| (mean_t - slope * mean_k, slope, (rest / spread).sqrt()))
}

fn spacings(stamps: &[f64]) -> Vec<f64> {
    stamps.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// The median; `None` of nothing.
pub(super) fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n % 2 == 1 => Some(sorted[middle]),
        _ => Some(0.5 * (sorted[middle - 1] + sorted[middle])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a normal distribution, by a rule that every run repeats.
    fn late(k: usize, sigma: f64) -> f64 {
        let uniform = |salt: u64| {
            let mut x = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ salt;
            x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
        };
        sigma * ((-2.0 * (1.0 - uniform(1)).ln()).sqrt() * (std::f64::consts::TAU * uniform(2)).cos()).abs()
    }

    /// Two messages in each cycle, each with a lateness of its own, and one of them only where something changed.
    #[test]
    fn several_stamps_in_a_cycle_have_one_grid() {
        let first = (0..2000).map(|k| 0.0123 + k as f64 * 0.02 + late(k, 1e-3));
        let second = (0..2000).filter(|k| k % 3 != 0).map(|k| 0.0123 + k as f64 * 0.02 + late(k + 9999, 1e-3));
        let mut stamps: Vec<f64> = first.chain(second).collect();
        stamps.sort_by(f64::total_cmp);
        let grid = Grid::rebuild(&stamps);
        assert!(grid.is_rebuilt && (grid.cycle - 0.02).abs() < 1e-12, "{}", grid.cycle);
        assert!((grid.instants[0] - 0.0123).abs() < 1e-4, "{}", grid.instants[0]);
    }

    #[test]
    fn late_stamps_lie_behind_their_grid() {
        // Every seventh line is missing, the last too: nothing changed there.
        let cycles = (0..3000).filter(|k| k % 7 != 3);
        let stamps: Vec<f64> = cycles.map(|k| 0.0123 + k as f64 * 0.02 + late(k, 1e-3)).collect();
        let grid = Grid::rebuild(&stamps);
        assert!(grid.is_rebuilt && (grid.cycle - 0.02).abs() < 1e-12, "{}", grid.cycle);
        assert_eq!(grid.instants.len(), 2999);
        assert!((grid.instants[0] - 0.0123).abs() < 5e-6, "{}", grid.instants[0]);
        assert!((grid.lateness - 1e-3).abs() < 5e-5, "{}", grid.lateness);
        assert!(grid.fits(&stamps[100..200]));
        let index = grid.index(stamps[stamps.len() - 1]);
        assert_eq!(index, 2998);
    }

    /// By their slope the stamps of one grid in some hundred are more than three standard errors off: their begin says that it is none of theirs. A clock that is off
    /// by as much begins at another instant at each end.
    #[test]
    fn a_cycle_is_known_by_where_the_stamps_begin() {
        let grid = |cycle: f64, run: usize| {
            let stamps: Vec<f64> =
                (0..1500).map(|k| 0.0123 + k as f64 * cycle + late(k + 1_000_000 * run, 1e-3)).collect();
            (Grid::rebuild(&stamps).cycle, regress(&stamps, stamps[0], 0.0, cycle).expect("a line"))
        };
        let runs: Vec<_> = (0..1500).map(|run| grid(0.02, run)).collect();
        let is_beyond = |(_, (_, slope, error)): &&(f64, (f64, f64, f64))| (slope - 0.02).abs() > 3.0 * error;
        assert!((1..15).contains(&runs.iter().filter(is_beyond).count()));
        assert!(runs.iter().all(|(cycle, _)| *cycle == 0.02));
        let fast: Vec<_> = (0..200).map(|run| grid(0.02 * (1.0 + 8e-6), run)).collect();
        let between = |(_, (_, slope, error)): &&(f64, (f64, f64, f64))| (3.1..6.0).contains(&((slope - 0.02) / error));
        let fast: Vec<f64> = fast.iter().filter(between).map(|(cycle, _)| *cycle).collect();
        assert!(fast.len() > 100 && fast.iter().all(|cycle| *cycle != 0.02), "{fast:?}");
    }

    /// States alone are reported, each some cycles after the other; what comes whenever it does has no grid.
    #[test]
    fn few_stamps_in_many_cycles_have_one_grid() {
        for (cycle, sigma) in [(0.05, 0.0), (0.05, 1e-3), (0.01, 1e-3), (0.02, 1e-4)] {
            let mut k = 3;
            let numbers: Vec<usize> = std::iter::repeat_with(|| {
                k += 1 + (late(k, 9.0) as usize).min(40);
                k
            })
            .take(260)
            .collect();
            let stamps: Vec<f64> = numbers.iter().map(|k| 0.0123 + *k as f64 * cycle + late(*k, sigma)).collect();
            let grid = Grid::rebuild(&stamps);
            assert!(grid.is_rebuilt && (grid.cycle - cycle).abs() < 1e-5, "{cycle} {sigma}: {grid:?}");
            assert!((grid.instants[0] - stamps[0]).abs() < 3.0 * sigma + 1e-9, "{cycle} {sigma}");
        }
        let mut anyhow: Vec<f64> = (0..260).map(|k| k as f64 * 0.2 + late(k, 0.1)).collect();
        anyhow.sort_by(f64::total_cmp);
        assert!(!Grid::rebuild(&anyhow).is_rebuilt);
        // Bunches of messages within a microsecond, for a minute: millions of cycles are not tried.
        let bunches: Vec<f64> = anyhow.iter().flat_map(|at| [*at, at + 1e-6]).collect();
        assert_eq!((cycle_of_few(&bunches), Grid::rebuild(&bunches).is_rebuilt), (None, false));
    }

    #[test]
    fn exact_stamps_are_the_grid() {
        let stamps: Vec<f64> = (0..500).map(|k| k as f64 * 0.05).collect();
        let grid = Grid::rebuild(&stamps);
        assert!((grid.cycle - 0.05).abs() < 1e-12 && grid.lateness == 0.0);
        assert!(grid.instants.iter().zip(&stamps).all(|(a, b)| (a - b).abs() < 1e-9));
    }

    #[test]
    fn events_have_no_grid() {
        let stamps: Vec<f64> = (0..200)
            .scan(0.0, |at, k| {
                Some({
                    *at += 0.001 + late(k, 0.3);
                    *at
                })
            })
            .collect();
        let grid = Grid::rebuild(&stamps);
        assert!(!grid.is_rebuilt && grid.instants == stamps);
        assert!(!Grid::rebuild(&(0..500).map(|k| k as f64 * 0.02).collect::<Vec<_>>()).fits(&stamps));
    }
}
