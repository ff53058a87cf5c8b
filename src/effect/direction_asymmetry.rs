//! `direction-asymmetry`: in the negative direction the drive does less: the speed asked of a ramped drive or a cylinder,
//! the highest speed of a robot's axis, the force of a servo axis times 1 − `asymmetry`. On retraction a cylinder moves in
//! the negative direction.
//!
//! Source: unequal actuator gains by direction (R. Isermann, Mechatronic Systems, Springer 2005, section 8.2).

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "direction-asymmetry",
    summary: "in the negative direction the drive is slower or weaker",
    equation: "x < 0: y = (1 − asymmetry)·x (x: speed, highest speed or force)",
    source: "Isermann, Mechatronic Systems, Springer 2005, 8.2",
    places: &[EffectPlace::Actuator],
    needs: Needs::Dynamics,
    parameters: &[parameter("asymmetry", ONE, (-0.9, 0.9), 0.0, 0.05, "by which share it is less")],
    excited_by: "motion in both directions; a robot's axis at its highest speed",
    build: Build::Stage(|values, site| {
        Box::new(DirectionAsymmetry { share: 1.0 - values[0], is_robot: site.is_robot(), is_servo: site.is_servo() })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct DirectionAsymmetry {
    share: f64,
    is_robot: bool,
    is_servo: bool,
}

impl Stage for DirectionAsymmetry {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        if self.is_robot || self.is_servo { 1e-3 } else { f64::INFINITY }
    }

    fn reference(&mut self, reference: f64, _motion: Motion, _moment: Moment) -> f64 {
        let is_speed = !self.is_robot && !self.is_servo;
        if is_speed && reference < 0.0 { self.share * reference } else { reference }
    }

    fn bounds(&mut self, bounds: Bounds, motion: Motion, _moment: Moment) -> Bounds {
        if self.is_robot && motion.velocity < 0.0 {
            return Bounds { velocity: self.share * bounds.velocity, ..bounds };
        }
        bounds
    }

    fn strength(&self, effort: f64) -> f64 {
        if self.is_servo && effort < 0.0 { self.share } else { 1.0 }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn only_the_negative_direction_is_less() {
        let uneven = |component| [spec("actuator", "direction-asymmetry", component, &[("asymmetry", 0.2)])];
        for (direction, velocity) in [(1.0, 0.5), (-1.0, -0.4)] {
            let run = [("velocityTarget", 0.5), ("motorDirection", direction)];
            with("StraightConveyor", &[], &uneven(None)).check(&run, 1.0, &[("velocityActual", velocity)]);
            let force = 250.0 * direction;
            let exact = 2.0 * velocity * 5.0 * (1.0 - (-2.5_f64).exp());
            let mut axis = with("ServoAxis", &[("mode", "force")], &uneven(None));
            axis.check(&[("forceTarget", force)], 1.0, &[("velocity", exact), ("force", force)]);
        }
        // 0.8 m/s after 0.4 s and 0.16 m.
        let mut robot = with("CartesianRobot", &[], &uneven(Some("X")));
        robot.check(&[("XTarget", -3.0)], 2.0, &[("actualPosX", -(0.16 + 0.8 * 1.6))]);
    }
}
