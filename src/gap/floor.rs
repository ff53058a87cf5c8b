//! How far a signal may be off where nothing is wrong: rounding, noise, and the uncertainty of its instants.

use super::cost;
use super::grid::Grid;
use super::noise::{self, Noise};

/// The floor of a level in one recording, found in the recording itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Floor {
    /// What values are rounded to, SI: the smallest step between two of them.
    pub step: f64,
    /// Noise before rounding, standard deviation, SI; 0 where none shows.
    pub noise: f64,
    /// How much of the noise of a sample is still in the next, 0 to 1: its correlation from one to the next.
    pub memory: f64,
    /// By how much the variance of noise and rounding is uncertain because few samples told it, standard deviation as a share of it.
    pub uncertainty: f64,
    /// Of a sensor that reads in coarse steps, how well it is known when it goes from one to the next, standard deviation, SI; 0 of any other.
    pub sharpness: f64,
    /// How far an instant may be off, standard deviation, s.
    pub timing: f64,
    /// How far even a good model is off, standard deviation, SI: of a device that is taken up again and again, whose errors
    /// grow from one time to the next. It belongs to the cost, not to the floor. 0 of every other.
    pub reach: f64,
    /// How far a law that is not all of the truth stays off where nothing else is wrong, standard deviation, SI: 0 of a law
    /// that explains the recording. Part of what a fit weighs differences by, and of no figure that is reported.
    pub misfit: f64,
}

/// How much of a floor's cost is uncertain because its noise is an estimate.
pub(super) const FLOOR_UNCERTAINTY: f64 = 0.06;
/// Of a step, how much of it is taken for noise at least: far less does not show.
const LEAST_NOISE: f64 = 0.2;
/// The same of a step that is known to end sharply: nearer than a law that is nearly true is to the truth.
const SHARPEST: f64 = 0.02;
/// Of a signal's range, what nothing is claimed about.
const RESOLUTION: f64 = 1e-6;
/// From which noise on, in steps, samples differ where nothing moves.
const SHOWN_NOISE: f64 = 0.1;

impl Floor {
    /// The standard deviation that a cost is computed with, where the signal changes by `slope` in a second.
    pub fn sigma(&self, slope: f64) -> f64 {
        let noise = self.noise.max(self.least_noise());
        let law = self.reach.hypot(self.misfit);
        (noise * noise + (slope * self.timing).powi(2) + law * law).sqrt()
    }

    /// What is taken for noise at least, SI.
    fn least_noise(&self) -> f64 {
        let least = LEAST_NOISE * self.step;
        if self.sharpness > 0.0 { least.min(self.sharpness.max(SHARPEST * self.step)) } else { least }
    }

    /// The root mean square of the difference where nothing is wrong and the signal moves with `slope`, SI.
    pub fn rms(&self, slope: f64) -> f64 {
        (self.noise * self.noise + self.step * self.step / 12.0 + (slope * self.timing).powi(2)).sqrt()
    }

    /// Whether neighbouring samples are off independently of each other. Without noise a rest, and whatever moves by whole
    /// steps, repeats one rounding error.
    pub fn shows_noise(&self) -> bool {
        self.noise > SHOWN_NOISE * self.step
    }

    /// What share of an independent observation a sample is: (1 − r)/(1 + r) for a noise with memory r.
    ///
    /// Source: G. V. Bayley, J. M. Hammersley, The effective number of independent observations in an autocorrelated time series, J.
    /// R. Stat. Soc. Suppl. 8 (1946), for a process of first order.
    pub fn share(&self) -> f64 {
        (1.0 - self.memory) / (1.0 + self.memory)
    }

    /// How many times more the sum of its costs scatters than that of independent ones: (1 + r²)/(1 − r²), squares having the
    /// memory r².
    pub fn scatter(&self) -> f64 {
        let squared = self.memory * self.memory;
        (1.0 + squared) / (1.0 - squared)
    }

    /// The variance of what a recording costs where nothing is wrong and that is `mean` on average, by how few samples told its noise: what
    /// of it is more than [`FLOOR_UNCERTAINTY`], which all floors have.
    pub(super) fn variance_by_its_noise(&self, mean: f64) -> f64 {
        mean * mean * (self.uncertainty.powi(2) - FLOOR_UNCERTAINTY.powi(2)).max(0.0)
    }

    /// Which share of that a moving level costs, on the average of all places between two steps, if there is no more noise than was found at rest.
    pub fn share_of_rounding(&self) -> f64 {
        let noise = self.noise.max(SHARPEST * self.step);
        FloorCosts::new(noise / self.step, self.sigma(0.0) / self.step).mean() / self.costs().mean()
    }

    /// What a sample costs where nothing is wrong. Noise that does not show at rest may be there in motion.
    pub fn costs(&self) -> FloorCosts {
        let sigma = self.sigma(0.0);
        FloorCosts::new(self.noise.max(self.least_noise()) / self.step, sigma / self.step)
    }

    /// The floor of a recorded level that was predicted to be `predicted`, sample by sample.
    pub fn of(grid: &Grid, recorded: &[f64], predicted: &[f64], timing: f64, is_count: bool) -> Floor {
        let step = if is_count { 1.0 } else { step_of(recorded) };
        if is_count {
            return Floor { step, timing, ..Floor::default() };
        }
        let Noise { sigma, memory, scatter } = noise::of(grid, recorded, predicted, step);
        Floor { step, noise: sigma, memory, uncertainty: scatter, timing, ..Floor::default() }
    }
}

/// Mean and variance of the cost of a sample where nothing is wrong, by where the true value lies between two steps: at rest it
/// lies at one place for long, and there the cost may be twice what it is on the average of all places.
#[derive(Clone, Debug)]
pub struct FloorCosts {
    by_place: Vec<(f64, f64)>,
}

impl FloorCosts {
    const PLACES: u32 = 32;

    /// Of a `noise` evaluated with `sigma`, both in steps. Of noise that is many of them their size no longer shows: what never changed
    /// was recorded in steps of next to nothing.
    fn new(noise: f64, sigma: f64) -> FloorCosts {
        const MANY: f64 = 50.0;
        let coarser = (noise / MANY).max(1.0);
        let (noise, sigma) = (noise / coarser, sigma / coarser);
        let reach = (6.0 * noise + 1.0).ceil() as i32;
        let at = |place: u32| {
            let value = (f64::from(place) + 0.5) / f64::from(Self::PLACES) - 0.5;
            let (mut mean, mut square) = (0.0, 0.0);
            for seen in -reach..=reach {
                let seen = f64::from(seen);
                let share = cost::normal((seen + 0.5 - value) / noise) - cost::normal((seen - 0.5 - value) / noise);
                let cost = cost::level(seen, value, 1.0, sigma);
                mean += share * cost;
                square += share * cost * cost;
            }
            (mean, (square - mean * mean).max(1e-6))
        };
        FloorCosts { by_place: (0..Self::PLACES).map(at).collect() }
    }

    /// The mean of all places.
    fn mean(&self) -> f64 {
        self.by_place.iter().map(|(mean, _)| mean).sum::<f64>() / self.by_place.len() as f64
    }

    /// For a true value that lies `steps` steps from a value that can be recorded.
    pub fn at(&self, steps: f64) -> (f64, f64) {
        let place = (steps - steps.round() + 0.5) * f64::from(Self::PLACES);
        self.by_place[(place as usize).min(self.by_place.len() - 1)]
    }
}

/// The lattice that values lie on: the smallest step between two distinct ones, at least a millionth of their range.
pub(super) fn step_of(values: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let (Some(least), Some(most)) = (sorted.first(), sorted.last()) else { return RESOLUTION };
    let range = (most - least).max(most.abs()).max(least.abs());
    let same = (RESOLUTION * range).max(1e-12);
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > same);
    steps.fold(f64::INFINITY, f64::min).min(range.max(1e-9)).max(same)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tenth of a step off its middle a reading says nothing; beyond the step's end it says the more the better that is known.
    #[test]
    fn a_coarse_step_is_as_sharp_as_what_it_is_reported_in() {
        let soft = Floor { step: 0.05, ..Floor::default() };
        let sharp = Floor { sharpness: 1e-4, ..soft };
        let cost = |floor: Floor, off: f64| cost::level(off, 0.0, floor.step, floor.sigma(0.0));
        assert!(cost(soft, 0.02) > 0.3 && cost(sharp, 0.02) < 0.02, "{}", cost(soft, 0.02));
        assert!(cost(soft, 0.03) < 4.0 && cost(sharp, 0.03) > 10.0, "{} {}", cost(soft, 0.03), cost(sharp, 0.03));
        // One that is known no better than a fifth of its step is as any other.
        assert_eq!(Floor { sharpness: 0.03, ..soft }.sigma(0.0), soft.sigma(0.0));
    }

    /// A sensor that is stuck reports one value while its model moves: its step is next to nothing.
    #[test]
    fn noise_of_very_many_steps_costs_what_noise_of_many_does() {
        let [many, very_many] = [100.0, 1e9].map(|steps| FloorCosts::new(steps, 1.2 * steps).at(0.3));
        assert!((many.0 - very_many.0).abs() < 1e-3 * many.0, "{many:?} {very_many:?}");
        assert!((many.1 - very_many.1).abs() < 1e-3 * many.1, "{many:?} {very_many:?}");
        // What is left of Student's cost where nothing is wrong does not hang on where a value lies between two steps.
        let [fewer, middle] = [-0.5, 0.0].map(|place| FloorCosts::new(49.0, 58.8).at(place));
        assert!((fewer.0 - many.0).abs() < 1e-2 * many.0 && (middle.0 - many.0).abs() < 1e-2 * many.0);
    }
}
