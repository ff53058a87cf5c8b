//! `position-dependent-friction`: friction that varies along the way: F_r = amplitude·sin(2π·x/period + phase), on top of
//! what else rubs; never below 0 in all.
//!
//! Source: friction that depends on position (Armstrong-Hélouvry and others, Automatica 30, 1994, section 2.6), its first
//! harmonic.

use std::f64::consts::TAU;

use super::table::{ANGLE, BASE, EFFORT, SERVO, TRAVEL, parameter};
use crate::device::path::{Effort, Friction, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "position-dependent-friction",
    summary: "a friction that varies along the way",
    equation: "F_r = max(0, F_c + amplitude·sin(2π·x/period + phase))·sign(v)",
    source: "Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994), 2.6",
    places: &[EffectPlace::Mechanics],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[
        parameter("amplitude", EFFORT, (0.0, 1e6), 0.0, 10.0, "amplitude of the variation"),
        parameter("period", TRAVEL, (1e-5, 1e3), 0.1, 0.1, "way from one greatest value to the next"),
        parameter("phase", ANGLE, (-7.0, 7.0), 0.0, 1.0, "where in its period it is at position 0").or(0.0),
    ],
    excited_by: "slow motion over several periods",
    build: Build::Stage(|values, _| {
        Box::new(PositionDependentFriction { amplitude: values[0], number: TAU / values[1], phase: values[2] })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct PositionDependentFriction {
    amplitude: f64,
    number: f64,
    phase: f64,
}

impl Stage for PositionDependentFriction {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        1e-3
    }

    fn uneven(&self, _effort: Effort) -> f64 {
        self.amplitude
    }

    fn friction(&mut self, friction: Friction, motion: Motion, _effort: Effort) -> Friction {
        let more = self.amplitude * (self.number * motion.position + self.phase).sin();
        let Friction { sliding, sticking, viscous } = friction;
        Friction { sliding: (sliding + more).max(0.0), sticking: (sticking + more).max(0.0), viscous }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_does_the_work_of_its_integral() {
        // From rest to half a period on 20 kg under 100 N, no other friction: M·v²/2 = F·x − A·p/π.
        let parameters = [("amplitude", 40.0), ("period", 1.0)];
        let friction = spec("mechanics", "position-dependent-friction", None, &parameters);
        let mut axis = with("ServoAxis", &[("mode", "force"), ("Fv", "0")], &[friction]);
        axis.check(&[("forceTarget", 100.0)], 0.0, &[]);
        while axis.report("position") < 0.5 {
            axis.device.advance(1e-3);
        }
        let (x, v) = (axis.report("position"), axis.report("velocity"));
        let work = 100.0 * x - 40.0 / std::f64::consts::PI;
        assert!((0.5 * 20.0 * v * v / work - 1.0).abs() < 2e-3, "{x} {v} {work}");
    }
}
