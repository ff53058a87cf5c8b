//! `load-dependent-friction`: friction in proportion to what goes through the gears: F_r = coefficient·(|F| + |L|), with F
//! the drive's force, less what the motor's own voltage takes of it, and L the load: both press on the teeth, whether they pull
//! against one another or the same way. At rest it is as much as is needed, up to that.
//!
//! Source: the load-dependent model of M. Duclusaud and others, Extended Friction Models for the Physics Simulation of
//! Servo Actuators (ICRA 2025).

use super::table::{BASE, ONE, SERVO, parameter};
use crate::device::path::{Effort, Friction, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "load-dependent-friction",
    summary: "a friction in proportion to what goes through the gears",
    equation: "F_r = coefficient·(|F| + |L|)·sign(v)",
    source: "Duclusaud and others, Extended Friction Models for the Physics Simulation of Servo Actuators, ICRA 2025",
    places: &[EffectPlace::Mechanics],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[parameter("coefficient", ONE, (0.0, 0.95), 0.0, 0.1, "share of drive and load together")],
    excited_by: "several loads, or accelerations of several heights",
    build: Build::Stage(|values, _| Box::new(LoadDependentFriction { coefficient: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct LoadDependentFriction {
    coefficient: f64,
}

impl Stage for LoadDependentFriction {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        1e-3
    }

    fn uneven(&self, effort: Effort) -> f64 {
        self.coefficient * effort.transmitted
    }

    fn friction(&mut self, friction: Friction, _motion: Motion, effort: Effort) -> Friction {
        let more = self.coefficient * effort.transmitted;
        let Friction { sliding, sticking, viscous } = friction;
        Friction { sliding: sliding + more, sticking: sticking + more, viscous }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};
    use crate::plant::EffectSpec;

    fn axis(load: &str) -> crate::device::bench::Bench {
        let friction = spec("mechanics", "load-dependent-friction", None, &[("coefficient", 0.1)]);
        with("ServoAxis", &[("mode", "force"), ("load", load)], &[friction])
    }

    #[test]
    fn it_takes_its_share_of_drive_and_load() {
        // Without a load a tenth of 100 N; with 50 N of load a tenth of 150 N.
        let velocity = |force: f64| force / 50.0 * (1.0 - (-2.5_f64).exp());
        axis("0").check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity(90.0))]);
        axis("50").check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity(35.0))]);
    }

    /// What rubs goes by the force of a loop that settles within milliseconds: how finely the way is told makes no difference to that.
    #[test]
    fn a_force_that_changes_fast_rubs_as_it_is_and_not_as_it_was() {
        let way = |effects: &[EffectSpec], steps: u32| {
            let mut axis = with("ServoAxis", &[], effects);
            axis.check(&[("positionTarget", 0.5)], 0.0, &[]);
            (0..steps).for_each(|_| axis.device.advance(0.05 / f64::from(steps)));
            axis.report("position")
        };
        let rubs = [spec("mechanics", "load-dependent-friction", None, &[("coefficient", 0.1)])];
        let (free, fine, told) = (way(&[], 1), way(&rubs, 50_000), way(&rubs, 1));
        let off = (told - fine) / (free - fine);
        assert!((free - fine).abs() > 1e-4 && off.abs() < 1e-3, "{off} of {} m", free - fine);
    }

    #[test]
    fn it_holds_a_load_that_the_drive_nearly_holds() {
        axis("50").check(&[("forceTarget", 41.0)], 1.0, &[("position", 0.0)]);
        // One that pulls the way the drive does presses on the gears as well: 15 N of 150 N.
        let velocity = 135.0 / 50.0 * (1.0 - (-2.5_f64).exp());
        axis("-50").check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity)]);
    }
}
