//! A level, sample by sample: what each differs by, and what that costs.

use super::cost;
use super::floor::Floor;
use super::tolerance::Weighed;
use super::track::Track;

/// A level whose predicted values stand for those of its track.
pub(super) struct Samples<'a> {
    track: &'a Track,
    predicted: &'a [f64],
    weighed: &'a Weighed<'a>,
    /// What a count is rounded down by on the average.
    half: f64,
    /// Spans without evidence, ascending, none in another.
    blind: Vec<(usize, usize)>,
}

/// One sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Its place in the track's grid.
    pub index: usize,
    pub predicted: f64,
    /// How steeply the level is predicted to change, for each second, SI.
    pub slope: f64,
    /// Recorded less predicted, SI.
    pub difference: f64,
    pub weight: f64,
    /// Whether it says nothing new: nothing has changed in signal and prediction since the one before, and no noise shows.
    pub is_rest: bool,
    pub cost: f64,
}

impl<'a> Samples<'a> {
    pub fn new(track: &'a Track, predicted: &'a [f64], weighed: &'a Weighed<'a>, is_count: bool) -> Samples<'a> {
        let half = if is_count { 0.5 } else { 0.0 };
        let mut spans = track.blind.clone();
        spans.sort_unstable();
        let mut blind: Vec<(usize, usize)> = Vec::with_capacity(spans.len());
        for (from, to) in spans.into_iter().filter(|(from, to)| from <= to) {
            match blind.last_mut().filter(|last| from <= last.1) {
                Some(last) => last.1 = last.1.max(to),
                None => blind.push((from, to)),
            }
        }
        Samples { track, predicted, weighed, half, blind }
    }

    /// What a count is rounded down by on the average.
    pub fn half(&self) -> f64 {
        self.half
    }

    /// Shows every sample that is evidence.
    pub fn each(&self, mut see: impl FnMut(Sample)) {
        let (track, predicted, floor) = (self.track, self.predicted, self.weighed.floor);
        // A rest that counts by the second is not counted once; what is expected to be off anyway is off at rest as well, and says
        // so for as long as it lasts.
        let counts_rests = floor.shows_noise() || floor.misfit > 0.0 || floor.reach > 0.0;
        let mut blind = self.blind.iter().peekable();
        for (k, (recorded, predicted_here)) in track.values.iter().zip(predicted).enumerate() {
            let index = track.first + k;
            while blind.next_if(|(_, to)| *to < index).is_some() {}
            if blind.peek().is_some_and(|(from, _)| *from <= index) {
                continue;
            }
            let slope = slope(&track.grid.instants, track.first, predicted, k);
            let is_rest =
                !counts_rests && self.weighed.is_repeated(k).unwrap_or_else(|| k > 0 && self.repeats(k, floor));
            let weight = self.weighed.weight(k);
            let cost = match is_rest {
                true => 0.0,
                false => weight * cost::level(recorded + self.half, *predicted_here, floor.step, floor.sigma(slope)),
            };
            let difference = recorded + self.half - predicted_here;
            see(Sample { index, predicted: *predicted_here, slope, difference, weight, is_rest, cost });
        }
    }

    /// Whether the `k`th sample repeats the one before it.
    fn repeats(&self, k: usize, floor: Floor) -> bool {
        let (values, predicted, step) = (&self.track.values, self.predicted, floor.step);
        let before = values[k - 1] - predicted[k - 1];
        let now = values[k] - predicted[k];
        let is_still = values[k - 1] == values[k] && (predicted[k - 1] - predicted[k]).abs() < 1e-3 * step;
        // On a ramp that climbs by whole steps in a cycle, rounding repeats itself as it does at rest.
        let repeats = (now - before).abs() < 1e-2 * step && (now + self.half).abs() < 0.55 * step;
        is_still || repeats
    }
}

/// How steeply a level is predicted to change about the `k`th instant of its track.
fn slope(instants: &[f64], first: usize, predicted: &[f64], k: usize) -> f64 {
    let (low, high) = (k.saturating_sub(1), (k + 1).min(predicted.len() - 1));
    let span = instants[first + high] - instants[first + low];
    if span > 0.0 { ((predicted[high] - predicted[low]) / span).abs() } else { 0.0 }
}
