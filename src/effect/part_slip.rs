//! `part-slip`: parts slip on their belt while it changes its speed more steeply than `acceleration`, which is what friction
//! gives them: μ·g. All parts of a belt slip alike; one that is put there while others slip takes their speed.
//!
//! Source: Coulomb friction of a body on a moving support, |a| ≤ μ·g (any textbook of mechanics).

use super::follower::Follower;
use super::table::{BASE, LINEAR_ACCELERATION, UNLIMITED, parameter};
use crate::device::path::{Moment, Stage};
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
    build: Build::Stage(|values, _| Box::new(PartSlip { limit: values[0], parts: Follower::new(values[0]) })),
    ..BASE
};

#[derive(Clone, Debug)]
struct PartSlip {
    limit: f64,
    parts: Follower,
}

impl Stage for PartSlip {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn carried(&mut self, displacement: f64, velocity: f64, before: f64, moment: Moment) -> f64 {
        if self.limit >= UNLIMITED {
            return displacement;
        }
        self.parts.follow(displacement, before, velocity, moment.span)
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.parts.state(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn parts_start_late_and_stop_late() {
        let slip = spec("process", "part-slip", None, &[("acceleration", 0.5)]);
        let mut belt = with("StraightConveyor", &[], &[slip]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 2.0, &[("velocityActual", 0.5)]);
        assert!((belt.displacement() - 0.75).abs() < 1e-12, "{}", belt.displacement());
        // The belt stops in 0.5 s and 0.125 m, the parts in 1 s and 0.25 m.
        belt.check(&[("motorDirection", 0.0)], 2.0, &[("velocityActual", 0.0)]);
        assert!((belt.displacement() - 0.25).abs() < 1e-12, "{}", belt.displacement());
    }
}
