//! `carried-mass`: every part that the axis carries is one more `mass` to move. On a servo axis it adds to M; on a robot's
//! axis, whose own mass the model does not know, it lowers the acceleration to own/(own + mass·parts) of it, with the mass
//! `own` that the axis moves by itself.
//!
//! A robot carries what hangs from its grippers. A servo axis carries what hangs from the gripper that the property `with`
//! names.
//!
//! Source: Newton's second law.

use super::table::{BASE, INERTIA, parameter};
use crate::device::path::{Bounds, Burden, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, EffectText, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "carried-mass",
    summary: "every part that the axis carries is more mass to move",
    equation: "(M + mass·parts)·dv/dt = F − R; robot: |dv/dt| ≤ a·own/(own + mass·parts)",
    source: "Newton, second law",
    places: &[EffectPlace::Load],
    fits: &[Fit::Drives(&["ServoAxis", "CartesianRobot"])],
    needs: Needs::Dynamics,
    parameters: &[
        parameter("mass", INERTIA, (0.0, 1e6), 0.0, 5.0, "mass of each part, kg or kg·m²"),
        parameter("own", INERTIA, (1e-6, 1e6), 20.0, 20.0, "mass that a robot's axis moves by itself").or(20.0),
    ],
    texts: &[EffectText { name: "with", required: false, summary: "the gripper whose parts a servo axis carries" }],
    excited_by: "accelerations with and without a part",
    build: Build::Stage(|values, _| Box::new(CarriedMass { mass: values[0], own: values[1], parts: 0.0 })),
    ..BASE
};

#[derive(Clone, Debug)]
struct CarriedMass {
    mass: f64,
    own: f64,
    parts: f64,
}

impl Stage for CarriedMass {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn loaded(&mut self, parts: f64, _queued: f64) {
        self.parts = parts;
    }

    fn burden(&mut self, burden: Burden, _motion: Motion, _moment: Moment) -> Burden {
        Burden { inertia: burden.inertia + self.mass * self.parts, ..burden }
    }

    /// Only a robot's axis asks its load for bounds: a servo axis has its burden.
    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        let share = self.own / (self.own + self.mass * self.parts);
        Bounds { acceleration: share * bounds.acceleration, deceleration: share * bounds.deceleration, ..bounds }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.parts);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_is_there_with_a_part_and_gone_without() {
        let mass = |component| [spec("load", "carried-mass", component, &[("mass", 5.0)])];
        let mut axis = with("ServoAxis", &[("mode", "force"), ("Fv", "0")], &mass(None));
        axis.check(&[("forceTarget", 100.0)], 1.0, &[("velocity", 5.0)]);
        axis.load(1, 0);
        axis.check(&[], 1.0, &[("velocity", 9.0)]);
        axis.load(0, 0);
        axis.check(&[], 1.0, &[("velocity", 14.0)]);
        // 2 m/s² with 20 kg are 1.6 m/s² with 25 kg.
        let mut robot = with("CartesianRobot", &[], &mass(Some("X")));
        robot.load(1, 0);
        robot.check(&[("XTarget", 2.0)], 0.5, &[("actualPosX", 0.2)]);
    }
}
