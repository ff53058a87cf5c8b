//! ConveyorFb: StraightConveyor and ConveyorCurve, which have the same signals.

use std::time::Duration;

use super::Barrier;
use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context, Delay};

/// Which way a belt runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Travel {
    Forward,
    Stopped,
    Backward,
}

impl Travel {
    fn code(self) -> i32 {
        match self {
            Travel::Forward => 1,
            Travel::Stopped => 0,
            Travel::Backward => -1,
        }
    }
}

/// How long a drive may take to report that it is enabled, or disabled.
const PATIENCE: Duration = Duration::from_secs(2);

/// A belt with its drive and its two light barriers.
#[derive(Debug)]
pub struct ConveyorFb {
    name: String,
    velocity_target: Output<f64>,
    motor_direction: Output<i32>,
    velocity_actual: Input<f64>,
    drive_enabled: Input<bool>,
    drive_running: Input<bool>,
    /// The barrier near the start.
    pub a: Barrier,
    /// The barrier near the end.
    pub b: Barrier,
    travel: Travel,
    enabled: bool,
    running: bool,
    supervision: Delay,
}

impl ConveyorFb {
    /// The block of the conveyor called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str) -> ConveyorFb {
        ConveyorFb {
            name: name.to_owned(),
            velocity_target: binder.output(name, "velocityTarget"),
            motor_direction: binder.output(name, "motorDirection"),
            velocity_actual: binder.input(name, "velocityActual"),
            drive_enabled: binder.input(name, "driveEnabled"),
            drive_running: binder.input(name, "driveRunning"),
            a: Barrier::new(binder.input(name, "lightBarrierA"), "A"),
            b: Barrier::new(binder.input(name, "lightBarrierB"), "B"),
            travel: Travel::Stopped,
            enabled: false,
            running: false,
            supervision: Delay::default(),
        }
    }

    /// Runs the belt at `speed` m/s (not negative) in `travel`'s direction; the target stays where it stops.
    pub fn run(&mut self, cx: &mut Context<'_>, speed: f64, travel: Travel) {
        if travel != Travel::Stopped {
            cx.set(self.velocity_target, speed);
        }
        if self.travel == travel {
            return;
        }
        self.travel = travel;
        cx.set(self.motor_direction, travel.code());
        self.supervision.start(cx, PATIENCE);
    }

    /// Lets the belt ramp down.
    pub fn stop(&mut self, cx: &mut Context<'_>) {
        self.run(cx, 0.0, Travel::Stopped);
    }

    /// What was last asked of it.
    pub fn travel(&self) -> Travel {
        self.travel
    }

    /// Whether the belt moves, as the drive reports it.
    pub fn running(&self) -> bool {
        self.running
    }

    /// Whether it does what was asked: enabled and moving, or disabled and at rest.
    pub fn settled(&self) -> bool {
        let wanted = self.travel != Travel::Stopped;
        self.enabled == wanted && self.running == wanted
    }

    /// The belt's speed as last reported, m/s, signed.
    pub fn velocity(&self, cx: &Context<'_>) -> f64 {
        cx.get(self.velocity_actual)
    }
}

impl Block for ConveyorFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        let (enabled, running) = (cx.get(self.drive_enabled), cx.get(self.drive_running));
        if enabled != self.enabled {
            self.enabled = enabled;
            cx.noted(&self.name, "IND", if enabled { "drive enabled" } else { "drive disabled" });
        }
        if running != self.running {
            self.running = running;
            cx.noted(&self.name, "IND", if running { "belt runs" } else { "belt at rest" });
        }
        self.a.update(&self.name, cx);
        self.b.update(&self.name, cx);
        if self.settled() {
            self.supervision.stop();
        } else if self.supervision.elapsed(cx) {
            let is = if self.enabled { "enabled" } else { "disabled" };
            cx.warned(
                &self.name,
                "TIMEOUT",
                format_args!("asked for direction {}, the drive is {is}", self.travel.code()),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench::Bench;

    fn belt() -> (Bench, ConveyorFb) {
        Bench::with(|binder| ConveyorFb::bind(binder, "Belt"))
    }

    #[test]
    fn run_sets_speed_and_direction_and_stop_only_the_direction() {
        let (mut bench, mut belt) = belt();
        assert_eq!(
            bench.event(|cx| belt.run(cx, 0.5, Travel::Forward)),
            ["Belt.velocityTarget=0.5", "Belt.motorDirection=1"]
        );
        assert_eq!(bench.event(|cx| belt.run(cx, 0.5, Travel::Forward)), Vec::<String>::new());
        assert_eq!(
            bench.event(|cx| belt.run(cx, 0.25, Travel::Backward)),
            ["Belt.velocityTarget=0.25", "Belt.motorDirection=-1"]
        );
        assert_eq!(bench.event(|cx| belt.stop(cx)), ["Belt.motorDirection=0"]);
    }

    #[test]
    fn it_has_settled_when_the_drive_says_so() {
        let (mut bench, mut belt) = belt();
        assert!(belt.settled());
        bench.event(|cx| belt.run(cx, 0.5, Travel::Forward));
        assert!(!belt.settled());
        bench.report(&[("Belt.driveEnabled", 1.0)], &mut belt);
        assert!(!belt.settled());
        bench.report(&[("Belt.driveRunning", 1.0)], &mut belt);
        assert!(belt.settled() && belt.running());
    }

    #[test]
    fn every_edge_of_a_barrier_is_taken_once() {
        let (mut bench, mut belt) = belt();
        for cut in [1.0, 0.0, 1.0] {
            bench.report(&[("Belt.lightBarrierB", cut)], &mut belt);
        }
        assert!(belt.b.cut());
        assert_eq!([belt.b.take_rise(), belt.b.take_rise(), belt.b.take_rise()], [true, true, false]);
        assert_eq!([belt.b.take_fall(), belt.b.take_fall()], [true, false]);
        assert!(!belt.a.take_rise());
    }

    #[test]
    fn supervision_ends_when_the_drive_follows() {
        let (mut bench, mut belt) = belt();
        bench.event(|cx| belt.run(cx, 0.5, Travel::Forward));
        assert!(belt.supervision.running());
        bench.report(&[("Belt.driveEnabled", 1.0), ("Belt.driveRunning", 1.0)], &mut belt);
        assert!(!belt.supervision.running());
    }
}
