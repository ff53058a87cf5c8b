//! `part-slip`: parts slip on their belt while it changes its speed more steeply than `acceleration`, which is what friction
//! gives them: μ·g. Each slips by itself; one that is put there, or comes from another belt, takes the belt's speed.
//!
//! Source: Coulomb friction of a body on a moving support, |a| ≤ μ·g (any textbook of mechanics).

use super::table::{BASE, LINEAR_ACCELERATION, UNLIMITED, parameter};
use crate::device::path::Stage;
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "part-slip",
    summary: "parts slip on their belt while it changes its speed too steeply",
    equation: "|dw/dt| ≤ acceleration; w follows v, and does not leave it while |dv/dt| ≤ acceleration",
    source: "Coulomb friction on a moving support, |a| ≤ μ·g",
    places: &[EffectPlace::Process],
    fits: &[Fit::Parts(&["StraightConveyor", "ConveyorCurve"])],
    parameters: &[parameter(
        "acceleration",
        LINEAR_ACCELERATION,
        (1e-3, UNLIMITED),
        UNLIMITED,
        0.5,
        "steepest change of speed that parts follow",
    )],
    excited_by: "starts and stops with parts on the belt",
    build: Build::Stage(|values, _| Box::new(PartSlip { limit: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct PartSlip {
    limit: f64,
}

impl Stage for PartSlip {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn grip(&self) -> f64 {
        if self.limit >= UNLIMITED { f64::INFINITY } else { self.limit }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::device::Role;
    use crate::effect::bench::{spec, with};

    // That parts slide is tested on the floor that carries them.
    #[test]
    fn the_belt_says_what_friction_gives_its_parts() {
        let slip = |steepest| spec("process", "part-slip", None, &[("acceleration", steepest)]);
        let mut belt = with("StraightConveyor", &[], &[slip(0.5), slip(0.2)]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 2.0, &[("velocityActual", 0.5)]);
        assert!((belt.displacement() - 0.875).abs() < 1e-12);
        let Role::Carries(body) = belt.device.role() else { panic!("a belt") };
        assert_eq!((body.grip, body.speeds[1]), (0.2, 0.5));
    }
}
