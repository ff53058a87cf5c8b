//! `stribeck-friction`: friction that falls as the speed rises: F_r = force·e^(−(v/velocity)²), and at rest as much as is
//! needed, up to `force`. What is left at high speed is Coulomb's, an effect of its own.
//!
//! Source: R. Stribeck's curve as the Gaussian form of Armstrong-Hélouvry and others (Automatica 30, 1994, section 2.3).

use super::table::{BASE, EFFORT, SERVO, SPEED, parameter};
use crate::device::path::{Effort, Friction, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "stribeck-friction",
    summary: "a friction that falls as the speed rises",
    equation: "F_r = force·e^(−(v/velocity)²)·sign(v); at rest |F_r| ≤ force",
    source: "Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994), 2.3",
    places: &[EffectPlace::Mechanics],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[
        parameter("force", EFFORT, (0.0, 1e6), 0.0, 10.0, "the friction at rest"),
        parameter("velocity", SPEED, (1e-3, 1e3), 0.05, 0.05, "speed at which 37 % of it are left"),
    ],
    excited_by: "speeds below and above its velocity, rests",
    build: Build::Stage(|values, _| Box::new(StribeckFriction { force: values[0], velocity: values[1] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct StribeckFriction {
    force: f64,
    velocity: f64,
}

impl Stage for StribeckFriction {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        1e-3
    }

    fn uneven(&self, _effort: Effort) -> f64 {
        self.force
    }

    fn friction(&mut self, friction: Friction, motion: Motion, _effort: Effort) -> Friction {
        let share = (-(motion.velocity / self.velocity).powi(2)).exp();
        let Friction { sliding, sticking, viscous } = friction;
        Friction { sliding: sliding + self.force * share, sticking: sticking + self.force, viscous }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn what_falls_as_it_speeds_up_takes_what_its_curve_does() {
        let friction = spec("mechanics", "stribeck-friction", None, &[("force", 40.0), ("velocity", 0.02)]);
        let mut axis = with("ServoAxis", &[("mode", "force")], &[friction]);
        axis.check(&[("forceTarget", 100.0)], 0.05, &[]);
        // 20 kg and 50 N·s/m by steps of a microsecond.
        let slope = |v: f64| (100.0 - 50.0 * v - 40.0 * (-(v / 0.02).powi(2)).exp()) / 20.0;
        let exact = (0..50_000).fold(0.0, |v: f64, _| v + 1e-6 * slope(v + 0.5e-6 * slope(v)));
        assert!((axis.report("velocity") - exact).abs() < 5e-5, "{} not {exact}", axis.report("velocity"));
    }

    #[test]
    fn at_a_steady_speed_the_force_is_the_curves() {
        let friction = || [spec("mechanics", "stribeck-friction", None, &[("force", 40.0), ("velocity", 0.1)])];
        for speed in [0.05, 0.1, 0.3] {
            let integral = [("mode", "velocity"), ("velocityIntegralTime", "0.05")];
            let mut axis = with("ServoAxis", &integral, &friction());
            axis.check(&[("velocityTarget", speed)], 10.0, &[]);
            let exact = 50.0 * speed + 40.0 * (-(speed / 0.1).powi(2)).exp();
            assert!((axis.report("force") - exact).abs() < 1e-3, "{} not {exact}", axis.report("force"));
        }
        with("ServoAxis", &[("mode", "force")], &friction()).check(&[("forceTarget", 39.9)], 1.0, &[("position", 0.0)]);
    }
}
