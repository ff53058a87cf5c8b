//! `kinetwin.CartesianRobot`: three linear axes and one rotary, each on its own trapezoidal profile.

use crate::device::axis::{self, Axis};
use crate::device::law::profile::Limits;
use crate::device::path::Stages;
use crate::device::table::{
    ACCELERATION, ANGLE, ANGULAR_ACCELERATION, ANGULAR_VELOCITY, FASTEST, LEAST, LENGTH, LONGEST_M, STEEPEST, VELOCITY,
    indicator, measure, number, switch, target,
};
use crate::device::{Device, Role, Surroundings, Tool, joints_where_reported};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

const SPEEDS: (f64, f64) = (LEAST, FASTEST);
const SLOPES: (f64, f64) = (LEAST, STEEPEST);
const SPEED_LINE: &str = "highest speed of the axis";
const SLOPE_LINE: &str = "highest acceleration of the axis, and its deceleration";

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.CartesianRobot",
    summary: "a gantry with axes X, Y, Z and a rotation R about the vertical, each on a trapezoidal profile",
    ports: &[
        target("XTarget", LENGTH, "where axis X is to go"),
        target("YTarget", LENGTH, "where axis Y is to go"),
        target("ZTarget", LENGTH, "where axis Z is to go"),
        target("RTarget", ANGLE, "where axis R is to turn"),
        switch("grip", "closes the mounted gripper"),
        indicator("cartesianArrived", "every axis is within its tolerance of the latest target and at rest"),
        measure("actualPosX", LENGTH, "position of axis X"),
        measure("actualPosY", LENGTH, "position of axis Y"),
        measure("actualPosZ", LENGTH, "position of axis Z"),
        measure("actualPosR", ANGLE, "angle of axis R"),
    ],
    parameters: &[
        number("maxVelocityX", VELOCITY, SPEEDS, "1.0", SPEED_LINE),
        number("maxVelocityY", VELOCITY, SPEEDS, "1.0", SPEED_LINE),
        number("maxVelocityZ", VELOCITY, SPEEDS, "1.0", SPEED_LINE),
        number("maxVelocityR", ANGULAR_VELOCITY, SPEEDS, "2.0", SPEED_LINE),
        number("maxAccelerationX", ACCELERATION, SLOPES, "2.0", SLOPE_LINE),
        number("maxAccelerationY", ACCELERATION, SLOPES, "2.0", SLOPE_LINE),
        number("maxAccelerationZ", ACCELERATION, SLOPES, "2.0", SLOPE_LINE),
        number("maxAccelerationR", ANGULAR_ACCELERATION, SLOPES, "8.0", SLOPE_LINE),
        number(
            "arrivedTolerance",
            LENGTH,
            (0.0, LONGEST_M),
            "0.0005",
            "how far X, Y and Z may be from their targets and have arrived",
        ),
        number(
            "arrivedToleranceR",
            ANGLE,
            (0.0, LONGEST_M),
            "0.0005",
            "how far R may be from its target and have arrived",
        ),
    ],
};

/// The first of the four targets, in the order X, Y, Z, R.
const TARGETS: usize = 0;
const GRIP: usize = 4;
const CARTESIAN_ARRIVED: usize = 5;
/// The first of the four positions.
const POSITIONS: usize = 6;

/// A robot with its axes X, Y, Z, R.
#[derive(Clone, Debug)]
struct CartesianRobot {
    axes: [Axis; 4],
    tool: Tool,
}

/// Builds one.
pub(super) fn build(parameters: &Parameters) -> Box<dyn Device> {
    const LIMITS: [(&str, &str, &str); 4] = [
        ("maxVelocityX", "maxAccelerationX", "arrivedTolerance"),
        ("maxVelocityY", "maxAccelerationY", "arrivedTolerance"),
        ("maxVelocityZ", "maxAccelerationZ", "arrivedTolerance"),
        ("maxVelocityR", "maxAccelerationR", "arrivedToleranceR"),
    ];
    let axes = LIMITS.map(|(velocity, acceleration, tolerance)| {
        let limits = Limits { velocity: parameters.number(velocity), acceleration: parameters.number(acceleration) };
        Axis::new(limits, parameters.number(tolerance))
    });
    Box::new(CartesianRobot { axes, tool: Tool::default() })
}

impl CartesianRobot {
    /// Every axis within its tolerance of the latest target, the tolerance included, and slower than 1 mm/s or 1 mrad/s.
    fn arrived(&mut self) -> bool {
        // Every axis is asked, whatever the others say: an answer may move what stands in an axis's path.
        self.axes.each_mut().map(|axis| axis.arrived()).iter().all(|arrived| *arrived)
    }
}

impl Device for CartesianRobot {
    fn command(&mut self, port: usize, value: f64) {
        match port {
            TARGETS..GRIP => self.axes[port - TARGETS].retarget(value),
            GRIP => self.tool.grip = value != 0.0,
            _ => {}
        }
    }

    fn advance(&mut self, seconds: f64) {
        // Actuator and mechanics: the axes are not synchronised.
        for axis in &mut self.axes {
            axis.advance(seconds);
        }
        let [x, y, z, rotation] = self.axes.each_ref().map(|axis| axis.load().position);
        self.tool = Tool { position: [x, y, z], rotation, grip: self.tool.grip };
    }

    fn report(&mut self, reports: &mut [f64]) {
        reports[CARTESIAN_ARRIVED] = f64::from(self.arrived());
        for (report, axis) in reports[POSITIONS..].iter_mut().zip(&self.axes) {
            *report = axis.load().position;
        }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        for axis in &self.axes {
            axis.state(visit);
        }
        visit(f64::from(self.tool.grip));
    }

    fn rests(&self) -> bool {
        self.axes.iter().all(Axis::rests)
    }

    fn unchanged_for(&self) -> f64 {
        axis::unchanged_for(&self.axes)
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    /// The components are the axes X, Y, Z, R, also by the names of their signals.
    fn stages(&mut self, component: Option<&str>) -> Option<&mut Stages> {
        let name = component?;
        let axis = ["X", "Y", "Z", "R"].iter().position(|axis| {
            name == *axis || name.strip_suffix("Target") == Some(axis) || name.strip_prefix("actualPos") == Some(axis)
        })?;
        Some(&mut self.axes[axis].stages)
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        for axis in &mut self.axes {
            axis.loaded(surroundings.parts);
        }
    }

    fn moving(&self) -> u32 {
        axis::moving(&self.axes)
    }

    /// The axes are on one supply, too.
    fn share(&mut self, others: u32) {
        axis::share(&mut self.axes, others);
    }

    fn joints(&self, visit: &mut dyn FnMut(&'static str, f64)) {
        let [x, y, z] = self.tool.position;
        visit("X.T", x);
        visit("Y.T", y);
        visit("Z.T", z);
        visit("R.R", self.tool.rotation);
    }

    fn reported_joints(&self, reports: &[Option<f64>], visit: &mut dyn FnMut(&'static str, f64)) {
        joints_where_reported(self, &reports[POSITIONS..], visit);
    }

    fn role(&self) -> Role<'_> {
        Role::Moves(&self.tool)
    }
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;

    fn robot() -> Bench {
        Bench::new("kinetwin.CartesianRobot", &[])
    }

    #[test]
    fn it_has_arrived_at_the_start() {
        robot().check(&[], 0.0, &[("cartesianArrived", 1.0), ("actualPosX", 0.0), ("actualPosR", 0.0)]);
    }

    #[test]
    fn axes_are_not_synchronised() {
        let targets = [("XTarget", 2.0), ("YTarget", -0.125), ("RTarget", 1.0)];
        robot().check(
            &targets,
            0.5,
            &[
                ("actualPosX", 0.25),
                ("actualPosY", -0.125),
                ("actualPosZ", 0.0),
                ("actualPosR", 0.75),
                ("cartesianArrived", 0.0),
            ],
        );
    }

    #[test]
    fn arrived_looks_at_the_latest_target() {
        let mut robot = robot();
        robot.check(&[("ZTarget", 0.5)], 0.0, &[("cartesianArrived", 0.0)]);
        robot.check(&[], 1.0, &[("actualPosZ", 0.5), ("cartesianArrived", 1.0)]);
        robot.check(&[("ZTarget", 0.4995)], 0.0, &[("cartesianArrived", 1.0)]);
        robot.check(&[("ZTarget", 0.49)], 0.0, &[("cartesianArrived", 0.0)]);
    }

    #[test]
    fn arrived_asks_for_rest() {
        // 0.4 mm before the target the axis still brakes with 40 mm/s; 1 mm/s is left half a millisecond before the end.
        let mut robot = robot();
        robot.check(&[("XTarget", 0.125)], 0.48, &[("actualPosX", 0.1246), ("cartesianArrived", 0.0)]);
        robot.check(&[], 0.0194, &[("cartesianArrived", 0.0)]);
        robot.check(&[], 0.0002, &[("cartesianArrived", 1.0)]);
    }

    #[test]
    fn a_target_too_near_is_passed_and_returned_to() {
        let mut robot = robot();
        robot.check(&[("XTarget", 2.0)], 0.5, &[("actualPosX", 0.25)]);
        robot.check(&[("XTarget", 0.375)], 0.5, &[("actualPosX", 0.5)]);
        robot.check(&[], 0.5, &[("actualPosX", 0.375), ("cartesianArrived", 1.0)]);
    }

    #[test]
    fn grip_moves_nothing() {
        robot().check(&[("grip", 1.0)], 1.0, &[("cartesianArrived", 1.0), ("actualPosZ", 0.0)]);
    }
}
