//! SixAxisRobotFb: an arm that goes to places it was taught, with suction cups on it.

use std::time::Duration;

use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context, Delay};

/// How long a move may take.
const PATIENCE: Duration = Duration::from_secs(10);

/// An arm with its cups.
#[derive(Debug)]
pub struct SixAxisRobotFb {
    name: String,
    place: Output<i32>,
    suction: Output<bool>,
    blow: Output<bool>,
    arrived: Input<bool>,
    vacuum: Input<bool>,
    /// Whether a move has been asked for whose beginning was not seen, or whose end was not.
    is_asked: bool,
    has_left: bool,
    supervision: Delay,
}

impl SixAxisRobotFb {
    /// The block of the arm called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str) -> SixAxisRobotFb {
        SixAxisRobotFb {
            name: name.to_owned(),
            place: binder.output(name, "place"),
            suction: binder.output(name, "suctionOn"),
            blow: binder.output(name, "blowOn"),
            arrived: binder.input(name, "arrived"),
            vacuum: binder.input(name, "vacuumOn"),
            is_asked: false,
            has_left: false,
            supervision: Delay::default(),
        }
    }

    /// Starts a move to a place other than that where it is.
    pub fn go(&mut self, cx: &mut Context<'_>, place: i32) {
        if cx.last(self.place) != place {
            cx.set(self.place, place);
            (self.is_asked, self.has_left) = (true, false);
            self.supervision.start(cx, PATIENCE);
        }
    }

    /// Whether it rests where it was sent: it has left since, and arrived.
    pub fn arrived(&self) -> bool {
        !self.is_asked
    }

    /// Draws vacuum, or lets go by blowing.
    pub fn hold(&mut self, cx: &mut Context<'_>, holds: bool) {
        cx.set(self.suction, holds);
        cx.set(self.blow, !holds);
    }

    /// Whether its cups hold something.
    pub fn holds(&self, cx: &Context<'_>) -> bool {
        cx.get(self.vacuum)
    }
}

impl Block for SixAxisRobotFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        if !self.is_asked {
            return;
        }
        let arrived = cx.get(self.arrived);
        self.has_left |= !arrived;
        if arrived && self.has_left {
            self.is_asked = false;
            self.supervision.stop();
            cx.noted(&self.name, "IND", format_args!("at place {}", cx.last(self.place)));
        } else if self.supervision.elapsed(cx) {
            cx.warned(&self.name, "TIMEOUT", "the arm does not arrive");
        }
    }
}
