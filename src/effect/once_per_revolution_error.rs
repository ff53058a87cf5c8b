//! `once-per-revolution-error`: an eccentric drum, gear or spindle: y = x + A·(sin(2π·x/period + phase) − sin(phase)). The
//! position 0 stays where it is.
//!
//! Source: the periodic error of an axis (ISO 230-2:2014; A. H. Slocum, Precision Machine Design, SME 1992, section 2.2).
//! Without its phase most of the error would be left: on a recording of an axis it keeps 80 %.

use std::f64::consts::TAU;

use super::table::{ANGLE, BASE, TRAVEL, parameter};
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "once-per-revolution-error",
    summary: "an eccentric drum, gear or spindle",
    equation: "y = x + amplitude·(sin(2π·x/period + phase) − sin(phase))",
    source: "ISO 230-2:2014; Slocum, Precision Machine Design, SME 1992, 2.2",
    places: &[EffectPlace::Transmission],
    parameters: &[
        parameter("amplitude", TRAVEL, (0.0, 1e3), 0.0, 0.002, "amplitude of the error"),
        parameter("period", TRAVEL, (1e-5, 1e3), 0.1, 0.04, "way of one revolution"),
        parameter("phase", ANGLE, (-7.0, 7.0), 0.0, 1.0, "where in its revolution it is at position 0").or(0.0),
    ],
    excited_by: "motion over more than a revolution, or slow motion within one",
    build: Build::Stage(|values, _| {
        let [amplitude, period, phase] = [values[0], values[1], values[2]];
        Box::new(OncePerRevolution { amplitude, number: TAU / period, phase })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct OncePerRevolution {
    amplitude: f64,
    /// 2π for each revolution, rad/m.
    number: f64,
    phase: f64,
}

impl Stage for OncePerRevolution {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn motion(&mut self, motion: Motion, _moment: Moment) -> Motion {
        let (sine, cosine) = (self.number * motion.position + self.phase).sin_cos();
        Motion {
            position: motion.position + self.amplitude * (sine - self.phase.sin()),
            velocity: motion.velocity * (1.0 + self.amplitude * self.number * cosine),
        }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_quarter_of_a_revolution_on_it_is_at_its_greatest() {
        let check = |phase: f64, target: f64, position: f64| {
            let parameters = [("amplitude", 0.002), ("period", 0.04), ("phase", phase)];
            let error = spec("transmission", "once-per-revolution-error", Some("X"), &parameters);
            with("CartesianRobot", &[], &[error]).check(&[("XTarget", target)], 2.0, &[("actualPosX", position)]);
        };
        check(0.0, 0.01, 0.012);
        check(0.0, 0.04, 0.04);
        check(0.0, 0.03, 0.028);
        check(std::f64::consts::FRAC_PI_2, 0.02, 0.016);
    }
}
