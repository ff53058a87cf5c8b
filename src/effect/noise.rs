//! `noise`: a sensor's readings scatter: y = x + N(0, sigma), drawn anew for every millisecond.
//!
//! Source: white Gaussian noise (A. Papoulis, Probability, Random Variables, and Stochastic Processes, McGraw-Hill 2002,
//! section 9.1).

use super::dice::Dice;
use super::table::{BASE, ONE, parameter};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "noise",
    summary: "a sensor's readings scatter",
    equation: "y = x + N(0, sigma)",
    source: "Papoulis, Probability, Random Variables, and Stochastic Processes, McGraw-Hill 2002, 9.1",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Number)],
    parameters: &[parameter("sigma", ONE, (0.0, 1e9), 0.0, 0.001, "standard deviation, in the signal's SI unit")],
    excited_by: "any reading, rests most of all",
    build: Build::Stage(|values, site| {
        Box::new(Noise {
            sigma: values[0],
            is_whole: site.is_whole(),
            dice: Dice::new(site.seed),
            drawn: (u64::MAX, 0.0),
        })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Noise {
    sigma: f64,
    is_whole: bool,
    dice: Dice,
    /// The last millisecond and its draw.
    drawn: (u64, f64),
}

impl Stage for Noise {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        let millisecond = ((moment.now + SAME_INSTANT_S) * 1e3) as u64;
        if self.drawn.0 != millisecond {
            self.drawn = (millisecond, self.dice.normal(millisecond));
        }
        let more = self.sigma * self.drawn.1;
        value + if self.is_whole { more.round() } else { more }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn readings_scatter_by_its_sigma_and_the_axis_does_not_know() {
        let noise = spec("sensor", "noise", Some("position"), &[("sigma", 0.002)]);
        let mut axis = with("ServoAxis", &[], &[noise]);
        let mut sum = 0.0;
        for _ in 0..5000 {
            axis.device.advance(0.02);
            sum += axis.report("position").powi(2);
            axis.check(&[], 0.0, &[("force", 0.0)]);
        }
        let sigma = (sum / 5000.0_f64).sqrt();
        assert!((sigma / 0.002 - 1.0).abs() < 0.03, "{sigma}");
    }
}
