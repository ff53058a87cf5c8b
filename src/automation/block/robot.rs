//! CartesianRobotFb: three linear axes and a wrist.

use std::time::Duration;

use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context, Delay};

/// Where the tool should be: metres and radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub r: f64,
}

/// How near to its target an axis must report to be, m or rad, before "arrived" is believed to speak of this target and
/// not of the one before: wider than any sensible `arrivedTolerance`, and narrower than any move worth making.
const NEAR: f64 = 2e-3;

/// How long a move may take.
const PATIENCE: Duration = Duration::from_secs(15);

/// A cartesian robot.
#[derive(Debug)]
pub struct CartesianRobotFb {
    name: String,
    targets: [Output<f64>; 4],
    grip: Output<bool>,
    actual: [Input<f64>; 4],
    cartesian_arrived: Input<bool>,
    target: Target,
    arrived: bool,
    supervision: Delay,
}

impl CartesianRobotFb {
    /// The block of the robot called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str) -> CartesianRobotFb {
        CartesianRobotFb {
            name: name.to_owned(),
            targets: ["XTarget", "YTarget", "ZTarget", "RTarget"].map(|target| binder.output(name, target)),
            grip: binder.output(name, "grip"),
            actual: ["actualPosX", "actualPosY", "actualPosZ", "actualPosR"].map(|actual| binder.input(name, actual)),
            cartesian_arrived: binder.input(name, "cartesianArrived"),
            target: Target::default(),
            arrived: false,
            supervision: Delay::default(),
        }
    }

    /// Starts a move to `target`.
    pub fn move_to(&mut self, cx: &mut Context<'_>, target: Target) {
        if self.target == target {
            return;
        }
        self.target = target;
        let axes = [target.x, target.y, target.z, target.r];
        for (output, position) in self.targets.into_iter().zip(axes) {
            cx.set(output, position);
        }
        self.arrived = self.is_there(cx);
        self.supervision.start(cx, PATIENCE);
    }

    /// Closes or opens the mounted gripper.
    pub fn grip(&mut self, cx: &mut Context<'_>, close: bool) {
        cx.set(self.grip, close);
    }

    /// Where it was last sent.
    pub fn target(&self) -> Target {
        self.target
    }

    /// Whether it rests at its latest target.
    pub fn arrived(&self) -> bool {
        self.arrived
    }

    /// `cartesianArrived` may still speak of the target before: the reported position tells.
    fn is_there(&self, cx: &Context<'_>) -> bool {
        let axes = [self.target.x, self.target.y, self.target.z, self.target.r];
        cx.get(self.cartesian_arrived)
            && self.actual.into_iter().zip(axes).all(|(actual, target)| (cx.get(actual) - target).abs() <= NEAR)
    }
}

impl Block for CartesianRobotFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        let arrived = self.is_there(cx);
        if arrived != self.arrived {
            self.arrived = arrived;
            let Target { x, y, z, r } = self.target;
            let verb = if arrived { "arrived at" } else { "on its way to" };
            cx.noted(&self.name, "IND", format_args!("{verb} x {x:.3} y {y:.3} z {z:.3} m, r {r:.3} rad"));
        }
        if arrived {
            self.supervision.stop();
        } else if self.supervision.elapsed(cx) {
            cx.warned(&self.name, "TIMEOUT", "the move does not end");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench::Bench;

    #[test]
    fn arrived_is_believed_only_where_the_target_is() {
        let (mut bench, mut robot) = Bench::with(|binder| CartesianRobotFb::bind(binder, "Robot"));
        bench.report(&[("Robot.cartesianArrived", 1.0)], &mut robot);
        assert!(robot.arrived());
        let target = Target { x: 0.5, y: 0.0, z: 0.1, r: 1.0 };
        assert_eq!(
            bench.event(|cx| robot.move_to(cx, target)),
            ["Robot.XTarget=0.5", "Robot.ZTarget=0.1", "Robot.RTarget=1"]
        );
        assert!(!robot.arrived());
        // A report that left before the target came in: arrived, but at the old place.
        bench.report(&[("Robot.actualPosX", 0.0)], &mut robot);
        assert!(!robot.arrived());
        bench.report(&[("Robot.cartesianArrived", 0.0)], &mut robot);
        bench.report(&[("Robot.cartesianArrived", 1.0)], &mut robot);
        assert!(!robot.arrived(), "the positions have not followed yet");
        bench.report(&[("Robot.actualPosX", 0.5), ("Robot.actualPosZ", 0.1), ("Robot.actualPosR", 1.0)], &mut robot);
        assert!(robot.arrived());
    }
}
