//! `coulomb-friction`: a constant force against the motion, and at rest as much as is needed, up to it.
//!
//! Source: C.-A. de Coulomb, as a set-valued law (B. Armstrong-Hélouvry, P. Dupont, C. Canudas de Wit, A survey of models,
//! analysis tools and compensation methods for the control of machines with friction, Automatica 30, 1994, section 2).

use super::table::{BASE, EFFORT, SERVO, parameter};
use crate::device::path::{Effort, Friction, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "coulomb-friction",
    summary: "a constant friction, whatever the speed",
    equation: "F_r = force·sign(v); at rest |F_r| ≤ force",
    source: "Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994), 2",
    places: &[EffectPlace::Mechanics],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[parameter("force", EFFORT, (0.0, 1e6), 0.0, 10.0, "the friction")],
    excited_by: "reversals and rests; the drive's effort most of all",
    build: Build::Stage(|values, _| Box::new(CoulombFriction { force: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct CoulombFriction {
    force: f64,
}

impl Stage for CoulombFriction {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        5e-3
    }

    fn friction(&mut self, friction: Friction, _motion: Motion, _effort: Effort) -> Friction {
        let Friction { sliding, sticking, viscous } = friction;
        Friction { sliding: sliding + self.force, sticking: sticking + self.force, viscous }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    fn axis(force: f64) -> crate::device::bench::Bench {
        let friction = spec("mechanics", "coulomb-friction", None, &[("force", force)]);
        with("ServoAxis", &[("mode", "force")], &[friction])
    }

    #[test]
    fn it_takes_a_constant_force_from_the_drive() {
        // 80 N are left: v = F/Fv·(1 − e^(−Fv/M·t)).
        let velocity = 1.6 * (1.0 - (-2.5_f64).exp());
        axis(20.0).check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity), ("force", 100.0)]);
    }

    #[test]
    fn it_holds_what_it_can_and_brings_to_rest_what_is_not_driven() {
        axis(20.0).check(&[("forceTarget", 19.9)], 1.0, &[("position", 0.0), ("velocity", 0.0)]);
        let mut axis = axis(20.0);
        axis.check(&[("forceTarget", 100.0)], 1.0, &[]);
        // v = −0.4 + (v0 + 0.4)·e^(−2.5·t) until it is 0.
        let start = 1.6 * (1.0 - (-2.5_f64).exp());
        let rest = (1.0 + start / 0.4_f64).ln() / 2.5;
        axis.check(&[("forceTarget", 0.0)], rest - 0.01, &[]);
        assert!(axis.report("velocity") > 0.0);
        axis.check(&[], 0.0101, &[("velocity", 0.0)]);
        let stopped = axis.report("position");
        axis.check(&[], 5.0, &[("velocity", 0.0), ("position", stopped)]);
    }
}
