//! `added-mass`: the axis moves more mass than the model knows: M·dv/dt with M + mass for M.
//!
//! Source: Newton's second law.

use super::table::{BASE, INERTIA, SERVO, parameter};
use crate::device::path::{Burden, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "added-mass",
    summary: "the axis moves more mass than the model knows",
    equation: "(M + mass)·dv/dt = F − R",
    source: "Newton, second law",
    places: &[EffectPlace::Load],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[parameter("mass", INERTIA, (0.0, 1e6), 0.0, 2.0, "how much more, kg or kg·m²")],
    excited_by: "accelerations",
    build: Build::Stage(|values, _| Box::new(AddedMass { mass: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct AddedMass {
    mass: f64,
}

impl Stage for AddedMass {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn burden(&mut self, burden: Burden, _motion: Motion, _moment: Moment) -> Burden {
        Burden { inertia: burden.inertia + self.mass, ..burden }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_takes_longer_to_come_to_speed() {
        let mass = spec("load", "added-mass", None, &[("mass", 5.0)]);
        let velocity = 2.0 * (1.0 - (-2.0_f64).exp());
        let mut axis = with("ServoAxis", &[("mode", "force")], &[mass]);
        axis.check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity)]);
    }
}
