//! `quantisation`: a sensor reads in steps: y = step·round(x/step).
//!
//! Source: the uniform quantiser (B. Widrow, I. Kollár, Quantization Noise, Cambridge 2008, section 1.1).

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "quantisation",
    summary: "a sensor reads in steps",
    equation: "y = step·round(x/step)",
    source: "Widrow, Kollár, Quantization Noise, Cambridge 2008, 1.1",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Number)],
    parameters: &[parameter(
        "step",
        ONE,
        (0.0, 1e9),
        0.0,
        0.001,
        "from one reading to the next, in the signal's SI unit",
    )],
    excited_by: "slow changes of the reading",
    build: Build::Stage(|values, _| Box::new(Quantisation { step: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct Quantisation {
    step: f64,
}

impl Stage for Quantisation {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn signal(&mut self, value: f64, _moment: Moment) -> f64 {
        if self.step == 0.0 { value } else { self.step * (value / self.step).round() }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_reading_is_a_whole_number_of_steps() {
        let coarse = spec("sensor", "quantisation", Some("actualPosX"), &[("step", 0.1)]);
        let mut robot = with("CartesianRobot", &[], &[coarse]);
        robot.check(&[("XTarget", 0.5), ("YTarget", 0.5)], 0.4, &[("actualPosX", 0.2), ("actualPosY", 0.16)]);
    }
}
