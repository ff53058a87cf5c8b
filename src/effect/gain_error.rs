//! `gain-error`: the drive does `gain` times what it is told to: a speed on a ramped drive or a cylinder, a motion on a
//! robot's axis or an ideal one, a force on a servo axis.
//!
//! A robot's controller plans each axis's way to its target by the limits it knows, and the drive does `gain` times that way at `gain` times
//! its speed; whether the axis has arrived is asked of where the drive is.
//!
//! Source: the multiplicative fault of an actuator (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2).

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "gain-error",
    summary: "the drive does a multiple of what it is told to",
    equation: "y = gain·x (x: speed, motion or force)",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 5.2",
    places: &[EffectPlace::Actuator],
    parameters: &[parameter("gain", ONE, (0.05, 20.0), 1.0, 1.05, "how many times")],
    excited_by: "speeds, ways or forces other than 0",
    build: Build::Stage(|values, site| {
        let acts = match () {
            () if site.has_dynamics() => Acts::Force,
            () if site.is_ideal() || site.is_robot() => Acts::Motion,
            () => Acts::Reference,
        };
        Box::new(GainError { gain: values[0], acts })
    }),
    ..BASE
};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Acts {
    Reference,
    Motion,
    Force,
}

#[derive(Clone, Debug)]
struct GainError {
    gain: f64,
    acts: Acts,
}

impl Stage for GainError {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn reference(&mut self, reference: f64, _motion: Motion, _moment: Moment) -> f64 {
        if self.acts == Acts::Reference { self.gain * reference } else { reference }
    }

    fn motion(&mut self, motion: Motion, _moment: Moment) -> Motion {
        if self.acts == Acts::Motion {
            return Motion { position: self.gain * motion.position, velocity: self.gain * motion.velocity };
        }
        motion
    }

    fn strength(&self, _effort: f64) -> f64 {
        if self.acts == Acts::Force { self.gain } else { 1.0 }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_drive_a_cylinder_an_axis_and_a_force_are_off_by_their_gain() {
        let gain = |component| [spec("actuator", "gain-error", component, &[("gain", 1.1)])];
        let run = [("velocityTarget", 0.5), ("motorDirection", -1.0)];
        with("StraightConveyor", &[], &gain(None)).check(&run, 1.0, &[("velocityActual", -0.55)]);
        // Half of the way, 0.25 m, takes 0.5 s at 2 m/s².
        let mut robot = with("CartesianRobot", &[], &gain(Some("Z")));
        robot.check(&[("ZTarget", 0.5)], 0.5, &[("actualPosZ", 0.275)]);
        robot.check(&[], 1.5, &[("actualPosZ", 0.55), ("cartesianArrived", 0.0)]);
        let ideal = [("mode", "ideal")];
        with("ServoAxis", &ideal, &gain(None)).check(&[("positionTarget", 0.5)], 0.0, &[("position", 0.55)]);
        let mut pusher = with("Pusher", &[], &gain(None));
        pusher.check(&[("command", 1.0)], 0.905, &[("limitExtended", 0.0)]);
        pusher.check(&[], 0.001, &[("limitExtended", 1.0)]);
        // 110 N act on 20 kg against 50 N·s/m, and 100 N are reported.
        let velocity = 2.2 * (1.0 - (-2.5_f64).exp());
        let expected = [("velocity", velocity), ("force", 100.0)];
        with("ServoAxis", &[("mode", "force")], &gain(None)).check(&[("forceTarget", 100.0)], 1.0, &expected);
    }
}
