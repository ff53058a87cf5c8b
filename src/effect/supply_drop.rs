//! `supply-drop`: drives that move together share a supply, and each takes from it what the others then lack: while n others
//! move, the drive does (1 − `fraction`)^n times what it would alone. That is the speed of a ramped drive or a cylinder, the
//! highest speed of a robot's axis, the force of a servo axis.
//!
//! Who moves is what the world about the device says ([`Device::share`](crate::device::Device::share)): in a plant the engine
//! tells it before every step, of all other devices, or of those that its property `with` names; a robot adds its own axes.
//! For a device that is replayed alone, what the others did is read from their recorded reports
//! ([`moving_as_reported`](crate::effect::moving_as_reported)).
//!
//! Source: the drop along a common supply line, each consumer taking an equal share (P. Beater, Pneumatic Drives, Springer
//! 2007; for electric drives Ohm's law), to first order in `fraction`.

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, EffectText, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "supply-drop",
    summary: "while others on its supply move the drive is slower or weaker",
    equation: "y = (1 − fraction)^n·x, n others moving (x: speed, highest speed or force)",
    source: "Beater, Pneumatic Drives, Springer 2007; Ohm's law of a common line",
    places: &[EffectPlace::Actuator],
    needs: Needs::Dynamics,
    parameters: &[parameter("fraction", ONE, (0.0, 0.9), 0.0, 0.1, "share that each other one takes")],
    texts: &[EffectText {
        name: "with",
        required: false,
        summary: "the instances on its supply, separated by ;: all of the plant where it is not given",
    }],
    excited_by: "motion alone, and together with others",
    build: Build::Stage(|values, site| {
        let acts = match (site.is_robot(), site.is_servo()) {
            (true, _) => Acts::Fastest,
            (_, true) => Acts::Force,
            _ => Acts::Speed,
        };
        Box::new(SupplyDrop { share: 1.0 - values[0], acts, left: 1.0 })
    }),
    ..BASE
};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Acts {
    Speed,
    Fastest,
    Force,
}

#[derive(Clone, Debug)]
struct SupplyDrop {
    /// What each other one leaves.
    share: f64,
    acts: Acts,
    /// What all of them leave.
    left: f64,
}

impl Stage for SupplyDrop {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn shared(&mut self, others: f64) {
        self.left = self.share.powf(others);
    }

    fn reference(&mut self, reference: f64, _motion: Motion, _moment: Moment) -> f64 {
        if self.acts == Acts::Speed { self.left * reference } else { reference }
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        if self.acts == Acts::Fastest { Bounds { velocity: self.left * bounds.velocity, ..bounds } } else { bounds }
    }

    fn strength(&self, _effort: f64) -> f64 {
        if self.acts == Acts::Force { self.left } else { 1.0 }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.left);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn each_other_one_that_moves_takes_its_share() {
        let drop = |component| [spec("actuator", "supply-drop", component, &[("fraction", 0.1)])];
        let mut belt = with("StraightConveyor", &[], &drop(None));
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 1.0, &[("velocityActual", 0.5)]);
        belt.device.share(2);
        belt.check(&[], 1.0, &[("velocityActual", 0.5 * 0.81)]);
        let mut axis = with("ServoAxis", &[("mode", "force")], &drop(None));
        axis.device.share(1);
        // 90 N of the 100 N: v = F/Fv·(1 − e^(−Fv/M·t)).
        let velocity = 1.8 * (1.0 - (-2.5_f64).exp());
        axis.check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity), ("force", 100.0)]);
    }

    #[test]
    fn a_robots_own_axes_count() {
        let drop = [spec("actuator", "supply-drop", Some("X"), &[("fraction", 0.2)])];
        let mut robot = with("CartesianRobot", &[], &drop);
        robot.device.share(0);
        robot.check(&[("XTarget", 9.0), ("YTarget", 9.0)], 0.25, &[]);
        robot.device.share(0);
        // Y at 0.5 m/s takes its share: X comes to 0.8 m/s after 0.4 s.
        robot.check(&[], 1.75, &[("actualPosX", 0.16 + 0.8 * 1.6), ("actualPosY", 1.75)]);
    }
}
