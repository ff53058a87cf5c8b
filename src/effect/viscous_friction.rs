//! `viscous-friction`: a force against the motion that grows with its speed, beside what the nominal law has.
//!
//! Source: O. Reynolds' law of lubricated contacts, F = coefficient·v (Armstrong-Hélouvry and others, Automatica 30, 1994,
//! section 2).

use super::table::{BASE, DAMPING, SERVO, parameter};
use crate::device::path::{Effort, Friction, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "viscous-friction",
    summary: "a friction that grows with the speed",
    equation: "F_r = coefficient·v",
    source: "Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994), 2",
    places: &[EffectPlace::Mechanics],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[parameter("coefficient", DAMPING, (0.0, 1e6), 0.0, 10.0, "friction for each unit of speed")],
    excited_by: "motion at several speeds",
    build: Build::Stage(|values, _| Box::new(ViscousFriction { coefficient: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct ViscousFriction {
    coefficient: f64,
}

impl Stage for ViscousFriction {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn friction(&mut self, friction: Friction, _motion: Motion, _effort: Effort) -> Friction {
        Friction { viscous: friction.viscous + self.coefficient, ..friction }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_adds_to_the_nominal_one() {
        let friction = spec("mechanics", "viscous-friction", None, &[("coefficient", 30.0)]);
        let velocity = 100.0 / 80.0 * (1.0 - (-4.0_f64).exp());
        let mut axis = with("ServoAxis", &[("mode", "force")], &[friction]);
        axis.check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity)]);
    }
}
