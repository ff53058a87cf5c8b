//! SuctionCapGripperFb: suction that holds a part, blow-off that lets it go.

use std::time::Duration;

use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context, Delay};

/// How long vacuum may take to build up.
const PATIENCE: Duration = Duration::from_secs(2);

/// A gripper with suction cups.
#[derive(Debug)]
pub struct SuctionCapGripperFb {
    name: String,
    suction_on: Output<bool>,
    blow_on: Output<bool>,
    vacuum_on: Input<bool>,
    gripping: bool,
    vacuum: bool,
    supervision: Delay,
}

impl SuctionCapGripperFb {
    /// The block of the gripper called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str) -> SuctionCapGripperFb {
        SuctionCapGripperFb {
            name: name.to_owned(),
            suction_on: binder.output(name, "suctionOn"),
            blow_on: binder.output(name, "blowOn"),
            vacuum_on: binder.input(name, "vacuumOn"),
            gripping: false,
            vacuum: false,
            supervision: Delay::default(),
        }
    }

    /// Switches suction on.
    pub fn grip(&mut self, cx: &mut Context<'_>) {
        cx.set(self.blow_on, false);
        cx.set(self.suction_on, true);
        self.gripping = true;
        self.supervision.start(cx, PATIENCE);
    }

    /// Switches suction off and blows; [`rest`](Self::rest) ends the blowing.
    pub fn release(&mut self, cx: &mut Context<'_>) {
        cx.set(self.suction_on, false);
        cx.set(self.blow_on, true);
        self.gripping = false;
        self.supervision.start(cx, PATIENCE);
    }

    /// Switches everything off.
    pub fn rest(&mut self, cx: &mut Context<'_>) {
        cx.set(self.suction_on, false);
        cx.set(self.blow_on, false);
        self.gripping = false;
        self.supervision.stop();
    }

    /// Whether a part hangs at its cups.
    pub fn holds(&self) -> bool {
        self.gripping && self.vacuum
    }

    /// Whether it has let go.
    pub fn free(&self) -> bool {
        !self.gripping && !self.vacuum
    }
}

impl Block for SuctionCapGripperFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        let vacuum = cx.get(self.vacuum_on);
        if vacuum != self.vacuum {
            self.vacuum = vacuum;
            match (vacuum, self.gripping) {
                (false, true) => cx.warned(&self.name, "IND", "vacuum lost while gripping"),
                (true, _) => cx.noted(&self.name, "IND", "vacuum"),
                (false, false) => cx.noted(&self.name, "IND", "no vacuum"),
            }
        }
        if vacuum == self.gripping {
            self.supervision.stop();
        } else if self.supervision.elapsed(cx) {
            cx.warned(&self.name, "TIMEOUT", if vacuum { "the vacuum stays" } else { "no vacuum builds up" });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench::Bench;

    #[test]
    fn grip_hold_release() {
        let (mut bench, mut gripper) = Bench::with(|binder| SuctionCapGripperFb::bind(binder, "Gripper"));
        assert_eq!(bench.event(|cx| gripper.grip(cx)), ["Gripper.suctionOn=true"]);
        assert!(!gripper.holds() && !gripper.free());
        bench.report(&[("Gripper.vacuumOn", 1.0)], &mut gripper);
        assert!(gripper.holds());
        assert_eq!(bench.event(|cx| gripper.release(cx)), ["Gripper.suctionOn=false", "Gripper.blowOn=true"]);
        assert!(!gripper.holds() && !gripper.free());
        bench.report(&[("Gripper.vacuumOn", 0.0)], &mut gripper);
        assert!(gripper.free());
        assert_eq!(bench.event(|cx| gripper.rest(cx)), ["Gripper.blowOn=false"]);
    }
}
