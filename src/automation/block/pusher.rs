//! PusherFb: a plate that extends and retracts, with a limit switch at each end.

use std::time::Duration;

use super::Barrier;
use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context, Delay};

/// The pusher's command codes.
const HOLD: i32 = 0;
const EXTEND: i32 = 1;
const RETRACT: i32 = 2;

/// How long a stroke may take.
const PATIENCE: Duration = Duration::from_secs(10);

/// A pusher with its limit switches and its two light barriers.
#[derive(Debug)]
pub struct PusherFb {
    name: String,
    command: Output<i32>,
    limit_extended: Input<bool>,
    limit_retracted: Input<bool>,
    /// The first barrier along its stroke.
    pub a: Barrier,
    /// The second barrier along its stroke.
    pub b: Barrier,
    asked: i32,
    extended: bool,
    retracted: bool,
    supervision: Delay,
}

impl PusherFb {
    /// The block of the pusher called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str) -> PusherFb {
        PusherFb {
            name: name.to_owned(),
            command: binder.output(name, "command"),
            limit_extended: binder.input(name, "limitExtended"),
            limit_retracted: binder.input(name, "limitRetracted"),
            a: Barrier::new(binder.input(name, "lightbarrierA"), "A"),
            b: Barrier::new(binder.input(name, "lightbarrierB"), "B"),
            asked: HOLD,
            extended: false,
            retracted: false,
            supervision: Delay::default(),
        }
    }

    /// Starts the stroke outwards.
    pub fn extend(&mut self, cx: &mut Context<'_>) {
        self.ask(cx, EXTEND);
    }

    /// Starts the stroke back.
    pub fn retract(&mut self, cx: &mut Context<'_>) {
        self.ask(cx, RETRACT);
    }

    /// Stops where it is.
    pub fn hold(&mut self, cx: &mut Context<'_>) {
        self.ask(cx, HOLD);
    }

    /// Whether it stands at its outer end, and was not asked to leave it.
    pub fn extended(&self) -> bool {
        self.extended && self.asked != RETRACT
    }

    /// Whether it stands at its inner end, and was not asked to leave it.
    pub fn retracted(&self) -> bool {
        self.retracted && self.asked != EXTEND
    }

    fn ask(&mut self, cx: &mut Context<'_>, code: i32) {
        if self.asked == code {
            return;
        }
        self.asked = code;
        cx.set(self.command, code);
        match code {
            HOLD => self.supervision.stop(),
            _ => self.supervision.start(cx, PATIENCE),
        }
    }
}

impl Block for PusherFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        let (extended, retracted) = (cx.get(self.limit_extended), cx.get(self.limit_retracted));
        if extended != self.extended {
            self.extended = extended;
            cx.noted(&self.name, "IND", if extended { "extended" } else { "leaves its outer end" });
        }
        if retracted != self.retracted {
            self.retracted = retracted;
            cx.noted(&self.name, "IND", if retracted { "retracted" } else { "leaves its inner end" });
        }
        self.a.update(&self.name, cx);
        self.b.update(&self.name, cx);
        let done = match self.asked {
            EXTEND => self.extended,
            RETRACT => self.retracted,
            _ => true,
        };
        if done {
            self.supervision.stop();
        } else if self.supervision.elapsed(cx) {
            cx.warned(&self.name, "TIMEOUT", "the stroke does not end");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench::Bench;

    #[test]
    fn a_stroke_out_and_back() {
        let (mut bench, mut pusher) = Bench::with(|binder| PusherFb::bind(binder, "Pusher"));
        bench.report(&[("Pusher.limitRetracted", 1.0)], &mut pusher);
        assert!(pusher.retracted() && !pusher.extended());
        assert_eq!(bench.event(|cx| pusher.extend(cx)), ["Pusher.command=1"]);
        // The switch has not opened yet, but who was asked to leave is no longer there.
        assert!(!pusher.retracted());
        bench.report(&[("Pusher.limitRetracted", 0.0)], &mut pusher);
        bench.report(&[("Pusher.limitExtended", 1.0)], &mut pusher);
        assert!(pusher.extended() && !pusher.supervision.running());
        assert_eq!(bench.event(|cx| pusher.retract(cx)), ["Pusher.command=2"]);
        assert!(!pusher.extended() && !pusher.retracted());
        bench.report(&[("Pusher.limitExtended", 0.0), ("Pusher.limitRetracted", 1.0)], &mut pusher);
        assert!(pusher.retracted());
    }
}
