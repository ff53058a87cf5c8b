//! `switch-off-delay`: the drive is switched off late: contactors, valves and brakes take their time. What reports that it was
//! told to (`driveEnabled`, `inverterReady`) does not wait for it. A cylinder that is to turn round stands until the coil of the one
//! way has let go: where both draw, the springs of a valve of five ports and three positions keep it in its middle.
//!
//! Source: the timer TOF of IEC 61131-3:2013, 6.6.3.5.5, on the switch of the drive.

use super::table::{BASE, SWITCHED, time};
use super::timer::{Late, Timer};
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "switch-off-delay",
    summary: "the drive is switched off late",
    equation: "off(t) = told off since t − time",
    source: "IEC 61131-3:2013, 6.6.3.5.5 (TOF)",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(SWITCHED)],
    needs: Needs::Dynamics,
    parameters: &[time("time", 0.05, "how much later")],
    excited_by: "stops",
    build: Build::Stage(|values, site| {
        // An axis has its torque to begin with; everything else is off.
        Box::new(SwitchOff { timer: Timer::new(values[0], Late::Off, Some(site.is_servo())) })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct SwitchOff {
    timer: Timer,
}

impl Stage for SwitchOff {
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
    fn what_stops_stops_later_by_its_time() {
        let late = || [spec("actuator", "switch-off-delay", None, &[("time", 0.1)])];
        let mut belt = with("StraightConveyor", &[], &late());
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 1.0, &[("velocityActual", 0.5)]);
        belt.check(&[("motorDirection", 0.0)], 0.1, &[("velocityActual", 0.5), ("driveEnabled", 0.0)]);
        belt.check(&[], 0.2, &[("velocityActual", 0.3)]);
        let mut gripper = with("SuctionCapGripper", &[("alwaysSealed", "true")], &late());
        gripper.check(&[("suctionOn", 1.0)], 1.0, &[("vacuumOn", 1.0)]);
        gripper.check(&[("suctionOn", 0.0)], 0.179, &[("vacuumOn", 1.0)]);
        gripper.check(&[], 0.001, &[("vacuumOn", 0.0)]);
    }

    #[test]
    fn a_cylinder_that_turns_round_waits_until_its_coil_lets_go() {
        let mut pusher = with("Pusher", &[], &[spec("actuator", "switch-off-delay", None, &[("time", 0.1)])]);
        pusher.check(&[("command", 1.0)], 5.0, &[("limitExtended", 1.0), ("isRunning", 0.0)]);
        pusher.check(&[("command", 2.0)], 0.0999, &[("limitExtended", 1.0), ("isRunning", 0.0)]);
        pusher.check(&[], 0.0002, &[("isRunning", 1.0)]);
        pusher.check(&[], 5.0, &[("limitRetracted", 1.0)]);
        pusher.check(&[("command", 0.0)], 1.0, &[]);
        // Under way it goes on as it went when it is told to hold, and stands while both coils draw: 0.15 s out, and as far back.
        pusher.check(&[("command", 1.0)], 0.1, &[("isRunning", 1.0)]);
        pusher.check(&[("command", 0.0)], 0.05, &[("isRunning", 1.0)]);
        pusher.check(&[("command", 2.0)], 0.0499, &[("isRunning", 0.0)]);
        pusher.check(&[], 0.1402, &[("isRunning", 1.0), ("limitRetracted", 0.0)]);
        pusher.check(&[], 0.0102, &[("limitRetracted", 1.0)]);
    }
}
