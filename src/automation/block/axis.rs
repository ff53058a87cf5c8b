//! ServoAxisFb: a positioned axis.

use std::time::Duration;

use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context, Delay};

/// How near to its target it must report to be, m or rad, to have arrived.
const NEAR: f64 = 1e-3;
/// How slow it must report to be, m/s or rad/s, to have arrived.
const SLOW: f64 = 5e-3;
/// How long a step may take.
const PATIENCE: Duration = Duration::from_secs(10);

/// A servo axis in a mode that takes positions.
#[derive(Debug)]
pub struct ServoAxisFb {
    name: String,
    position_target: Output<f64>,
    position: Input<f64>,
    velocity: Input<f64>,
    target: f64,
    arrived: bool,
    supervision: Delay,
}

impl ServoAxisFb {
    /// The block of the axis called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str) -> ServoAxisFb {
        ServoAxisFb {
            name: name.to_owned(),
            position_target: binder.output(name, "positionTarget"),
            position: binder.input(name, "position"),
            velocity: binder.input(name, "velocity"),
            target: 0.0,
            arrived: false,
            supervision: Delay::default(),
        }
    }

    /// Starts a step to `target`, m or rad.
    pub fn move_to(&mut self, cx: &mut Context<'_>, target: f64) {
        self.target = target;
        cx.set(self.position_target, target);
        self.arrived = self.is_there(cx);
        self.supervision.start(cx, PATIENCE);
    }

    /// Whether it rests at its target.
    pub fn arrived(&self) -> bool {
        self.arrived
    }

    fn is_there(&self, cx: &Context<'_>) -> bool {
        (cx.get(self.position) - self.target).abs() <= NEAR && cx.get(self.velocity).abs() <= SLOW
    }
}

impl Block for ServoAxisFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        let arrived = self.is_there(cx);
        if arrived != self.arrived {
            self.arrived = arrived;
            let verb = if arrived { "arrived at" } else { "on its way to" };
            cx.noted(&self.name, "IND", format_args!("{verb} {:.3}", self.target));
        }
        if arrived {
            self.supervision.stop();
        } else if self.supervision.elapsed(cx) {
            cx.warned(&self.name, "TIMEOUT", "the axis does not reach its target");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench::Bench;

    #[test]
    fn it_has_arrived_when_it_rests_at_its_target() {
        let (mut bench, mut axis) = Bench::with(|binder| ServoAxisFb::bind(binder, "Axis"));
        assert_eq!(bench.event(|cx| axis.move_to(cx, 0.25)), ["Axis.positionTarget=0.25"]);
        assert!(!axis.arrived());
        bench.report(&[("Axis.position", 0.2499), ("Axis.velocity", 0.1)], &mut axis);
        assert!(!axis.arrived(), "it passes");
        bench.report(&[("Axis.velocity", 0.001)], &mut axis);
        assert!(axis.arrived());
    }
}
