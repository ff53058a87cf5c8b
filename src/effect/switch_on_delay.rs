//! `switch-on-delay`: the drive is switched on late: contactors, valves and brakes take their time. What reports that it was
//! told to (`driveEnabled`, `inverterReady`) does not wait for it.
//!
//! Source: the timer TON of IEC 61131-3:2013, 6.6.3.5.5, on the switch of the drive.

use super::table::{BASE, SWITCHED, time};
use super::timer::{Late, Timer};
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "switch-on-delay",
    summary: "the drive is switched on late",
    equation: "on(t) = told on since t − time",
    source: "IEC 61131-3:2013, 6.6.3.5.5 (TON)",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(SWITCHED)],
    needs: Needs::Dynamics,
    parameters: &[time("time", 0.05, "how much later")],
    excited_by: "starts",
    build: Build::Stage(|values, site| {
        // An axis has its torque to begin with; everything else is off.
        Box::new(SwitchOn { timer: Timer::new(values[0], Late::On, Some(site.is_servo())) })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct SwitchOn {
    timer: Timer,
}

impl Stage for SwitchOn {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn switched(&mut self, on: bool, moment: Moment) -> bool {
        self.timer.pass(on, moment.now)
    }

    fn next_change(&self) -> Option<f64> {
        self.timer.next()
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.timer.state(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn what_starts_starts_later_by_its_time() {
        let late = || [spec("actuator", "switch-on-delay", None, &[("time", 0.1)])];
        let mut belt = with("StraightConveyor", &[], &late());
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 0.1, &[("velocityActual", 0.0)]);
        belt.check(&[], 0.2, &[("velocityActual", 0.2), ("driveEnabled", 1.0)]);
        belt.check(&[("motorDirection", 0.0)], 0.1, &[("velocityActual", 0.1)]);
        let mut pusher = with("Pusher", &[], &late());
        pusher.check(&[("command", 1.0)], 1.095, &[("limitExtended", 0.0)]);
        pusher.check(&[], 0.002, &[("limitExtended", 1.0)]);
        let mut gripper = with("SuctionCapGripper", &[("alwaysSealed", "true")], &late());
        gripper.check(&[("suctionOn", 1.0)], 0.249, &[("vacuumOn", 0.0)]);
        gripper.check(&[], 0.001, &[("vacuumOn", 1.0)]);
    }

    #[test]
    fn a_cylinder_that_turns_round_waits_for_its_other_coil() {
        let mut pusher = with("Pusher", &[], &[spec("actuator", "switch-on-delay", None, &[("time", 0.1)])]);
        pusher.check(&[("command", 1.0)], 0.5, &[("isRunning", 1.0)]);
        pusher.check(&[("command", 2.0)], 0.0999, &[("isRunning", 0.0)]);
        pusher.check(&[], 0.3971, &[("limitRetracted", 1.0)]);
    }
}
