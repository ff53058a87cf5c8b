//! `settling-time`: an axis of a robot counts as arrived only after it has been there, at rest, for `time`: its controller
//! waits for the structure to settle. The motion is as ever.
//!
//! Source: the settling time of a positioning system (ISO 9283:1998, position stabilization time).

use super::table::{BASE, time};
use super::timer::{Late, Timer};
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "settling-time",
    summary: "an axis counts as arrived only after it has been there for a time",
    equation: "arrived(t) = there and at rest since t − time",
    source: "ISO 9283:1998 (position stabilization time)",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&["CartesianRobot"])],
    parameters: &[time("time", 0.1, "how long it has to be there")],
    excited_by: "arrivals",
    build: Build::Stage(|values, _| Box::new(SettlingTime { timer: Timer::new(values[0], Late::On, Some(true)) })),
    ..BASE
};

#[derive(Clone, Debug)]
struct SettlingTime {
    timer: Timer,
}

impl Stage for SettlingTime {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn arrived(&mut self, is_there: bool, moment: Moment) -> bool {
        self.timer.pass(is_there, moment.now)
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
    fn arrival_is_late_by_its_time_in_whatever_spans_it_is_looked_for() {
        // 0.5 m in one second; slower than 1 mm/s half a millisecond before.
        let arrival = 1.0 - 1e-3 / 2.0 + 0.1;
        for spans in [1, 7, 1000] {
            let settling = spec("actuator", "settling-time", Some("X"), &[("time", 0.1)]);
            let mut robot = with("CartesianRobot", &[], &[settling]);
            robot.check(&[], 1.0, &[("cartesianArrived", 1.0)]);
            robot.check(&[("XTarget", 0.5)], 0.0, &[("cartesianArrived", 0.0)]);
            for _ in 0..spans {
                robot.device.advance((arrival - 1e-6) / f64::from(spans));
            }
            robot.check(&[], 0.0, &[("cartesianArrived", 0.0), ("actualPosX", 0.5)]);
            robot.check(&[], 2e-6, &[("cartesianArrived", 1.0)]);
        }
    }

    #[test]
    fn another_axis_does_not_wait() {
        let settling = spec("actuator", "settling-time", Some("X"), &[("time", 0.5)]);
        let mut robot = with("CartesianRobot", &[], &[settling]);
        robot.check(&[("YTarget", 0.5)], 1.01, &[("cartesianArrived", 1.0)]);
    }
}
