//! On the borders of which windows of time something happens.

/// Fewer instants may lie anywhere.
const FEWEST: usize = 6;
/// How many cycles a window lasts at least, and how long at most, s.
pub(super) const WINDOW_CYCLES: f64 = 3.0;
const LONGEST_WINDOW_S: f64 = 0.5;
/// How much rarer than all lengths that are tried together it must be by chance that instants lie so on the borders of windows.
const RARER: f64 = 100.0;

/// The length of the windows on whose borders `instants` lie, s, each known to within a cycle; `None` where they lie anywhere. By chance the
/// mean of n unit vectors is as long as r with a probability of exp(−n·r²) (Lord Rayleigh, Phil. Mag. 37, 1919).
pub(super) fn windows(instants: &[f64], cycle: f64) -> Option<f64> {
    let n = instants.len() as f64;
    let span = instants.iter().copied().fold(0.0, f64::max) - instants.iter().copied().fold(f64::INFINITY, f64::min);
    if instants.len() < FEWEST || span <= LONGEST_WINDOW_S {
        return None;
    }
    let (most, least) = (1.0 / (WINDOW_CYCLES * cycle), 1.0 / LONGEST_WINDOW_S);
    let tried = ((most - least).max(0.0) * 4.0 * span).ceil();
    let length = |rate: f64| {
        let angles = || instants.iter().map(|at| std::f64::consts::TAU * rate * at);
        let (x, y) = (angles().map(f64::cos).sum::<f64>(), angles().map(f64::sin).sum::<f64>());
        x.hypot(y) / n
    };
    let rates = (0..=tried as usize).map(|k| least + k as f64 / (4.0 * span));
    let (seen, rate) = rates.map(|rate| (length(rate), rate)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    // Borders of long windows are those of their halves and thirds as well.
    let longer = (2..=4).rev().map(|times| rate / f64::from(times)).find(|rate| length(*rate) > 0.9 * seen);
    (n * seen * seen > (RARER * tried.max(1.0)).ln()).then(|| 1.0 / longer.unwrap_or(rate))
}
