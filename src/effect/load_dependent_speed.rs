//! `load-dependent-speed`: the drive is slower with every part that it carries or pushes, by `coefficient` of its speed; of a
//! robot's axis the highest speed. It never falls below a hundredth.
//!
//! Source: the linear speed-torque line of a drive, n = n0·(1 − M/M_stall) (A. Hughes, B. Drury, Electric Motors and Drives,
//! Newnes 2013), each part being the same load.

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// The least share of its speed that is left.
const LEAST: f64 = 0.01;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "load-dependent-speed",
    summary: "the drive is slower with every part that it carries or pushes",
    equation: "v = (1 − coefficient·parts)·v0",
    source: "Hughes, Drury, Electric Motors and Drives, Newnes 2013 (speed-torque line)",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&["StraightConveyor", "ConveyorCurve", "Pusher", "CartesianRobot"])],
    parameters: &[parameter("coefficient", ONE, (0.0, 0.99), 0.0, 0.05, "share of its speed lost for each part")],
    excited_by: "motion with and without parts; a robot's axis at its highest speed",
    build: Build::Stage(|values, site| {
        Box::new(LoadDependentSpeed { coefficient: values[0], is_robot: site.is_robot(), parts: 0.0 })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct LoadDependentSpeed {
    coefficient: f64,
    is_robot: bool,
    parts: f64,
}

impl LoadDependentSpeed {
    fn share(&self) -> f64 {
        (1.0 - self.coefficient * self.parts).max(LEAST)
    }
}

impl Stage for LoadDependentSpeed {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn loaded(&mut self, parts: f64, _queued: f64) {
        self.parts = parts;
    }

    fn reference(&mut self, reference: f64, _motion: Motion, _moment: Moment) -> f64 {
        if self.is_robot { reference } else { self.share() * reference }
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        if self.is_robot { Bounds { velocity: self.share() * bounds.velocity, ..bounds } } else { bounds }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.parts);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn every_part_takes_its_share() {
        let slower = |component| [spec("actuator", "load-dependent-speed", component, &[("coefficient", 0.1)])];
        let mut belt = with("StraightConveyor", &[], &slower(None));
        belt.load(2, 0);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", -1.0)], 1.0, &[("velocityActual", -0.4)]);
        belt.load(0, 0);
        belt.check(&[], 1.0, &[("velocityActual", -0.5)]);
        belt.load(99, 0);
        belt.check(&[], 1.0, &[("velocityActual", -0.005)]);
        // 0.9 m/s after 0.45 s and 0.2025 m.
        let mut robot = with("CartesianRobot", &[], &slower(Some("X")));
        robot.load(1, 0);
        robot.check(&[("XTarget", 3.0)], 2.0, &[("actualPosX", 0.2025 + 0.9 * 1.55)]);
        let mut pusher = with("Pusher", &[], &slower(None));
        pusher.load(1, 0);
        pusher.check(&[("command", 1.0)], 0.498 / 0.45 - 1e-6, &[("limitExtended", 0.0)]);
        pusher.check(&[], 2e-6, &[("limitExtended", 1.0)]);
    }
}
