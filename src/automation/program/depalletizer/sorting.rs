//! Sorting: each pusher takes its share of the boxes that pass, and its exit belt carries them to either of its ends.

use std::time::Duration;

use super::{LINE_M_S, Line};
use crate::automation::block::Travel;
use crate::automation::network::{Context, Counts, Delay, Sequence};

/// A place where boxes are pushed out.
#[derive(Clone, Copy)]
pub struct Lane {
    /// Which of the three, from 0.
    index: usize,
    /// The conveyor before the pusher, and the exit behind it, as the plan counts them.
    conveyor: usize,
    exit: usize,
    /// Takes the first of so many boxes.
    one_of: u64,
}

/// The three lanes: their shares leave the four ends (the last is Conveyor7's) equal numbers of boxes.
pub const LANES: [Lane; 3] = [
    Lane { index: 0, conveyor: 5, exit: 8, one_of: 4 },
    Lane { index: 1, conveyor: 6, exit: 9, one_of: 3 },
    Lane { index: 2, conveyor: 7, exit: 10, one_of: 2 },
];

/// A pusher and the barrier before it.
pub struct Sorter {
    name: String,
    lane: Lane,
    step: Step,
    seen: u64,
    /// Boxes that went on.
    passed: u64,
}

#[derive(Clone, Copy, PartialEq)]
enum Step {
    Start,
    Homing,
    Ready,
    Extending,
    Retracting,
}

impl Sorter {
    /// The sorter of `lane`.
    pub fn new(lane: Lane) -> Sorter {
        Sorter { name: format!("Sorter{}", lane.index + 1), lane, step: Step::Start, seen: 0, passed: 0 }
    }

    /// A box is before the plate: whether to push it.
    fn choose(&mut self, line: &mut Line, cx: &mut Context<'_>) -> Step {
        let chosen = self.seen.is_multiple_of(self.lane.one_of);
        self.seen += 1;
        let pusher = &mut line.pushers[self.lane.index];
        if !chosen {
            self.passed += 1;
            cx.decided(&self.name, "B cut", format_args!("box {} goes on", self.seen));
        } else if self.step != Step::Ready || pusher.b.cut() {
            self.passed += 1;
            cx.decided(&self.name, "B cut", format_args!("box {} goes on: no place to push it to", self.seen));
        } else {
            cx.decided(&self.name, "B cut", format_args!("box {} is pushed out", self.seen));
            pusher.extend(cx);
            line.pushed[self.lane.index] += 1;
            return Step::Extending;
        }
        self.step
    }
}

impl Sequence<Line> for Sorter {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        use Step::*;
        if self.step != Start && line.conveyor(self.lane.conveyor).b.take_rise() {
            self.step = self.choose(line, cx);
            return true;
        }
        let pusher = &mut line.pushers[self.lane.index];
        self.step = match self.step {
            Start if !pusher.retracted() => {
                cx.decided(&self.name, "INIT", "retract");
                pusher.retract(cx);
                Homing
            }
            Start => Ready,
            Extending if pusher.extended() => {
                cx.decided(&self.name, "extended", "retract");
                pusher.retract(cx);
                Retracting
            }
            Homing | Retracting if pusher.retracted() => {
                cx.decided(&self.name, "retracted", "ready");
                pusher.hold(cx);
                Ready
            }
            _ => return false,
        };
        true
    }

    fn count(&self, counts: &mut Counts) {
        // What passes the last pusher leaves at the end of its conveyor.
        if self.lane.index + 1 == LANES.len() {
            counts.parts_out += self.passed;
        }
    }
}

/// After so many boxes an exit carries the other way.
const TURN_AFTER: u32 = 5;
/// A box that was pushed so long ago has left, whatever the barriers saw.
const GONE: Duration = Duration::from_secs(4);

/// An exit belt.
pub struct Exit {
    name: String,
    lane: Lane,
    travel: Travel,
    /// Boxes pushed over since the belt last turned.
    since_turn: u32,
    /// Boxes pushed over and not yet seen to leave.
    on_belt: u32,
    gone: Delay,
    left: u64,
}

impl Exit {
    /// The exit of `lane`.
    pub fn new(lane: Lane) -> Exit {
        Exit {
            name: format!("Exit{}", lane.index + 1),
            lane,
            travel: Travel::Stopped,
            since_turn: 0,
            on_belt: 0,
            gone: Delay::default(),
            left: 0,
        }
    }

    fn run(&mut self, line: &mut Line, cx: &mut Context<'_>, event: &str, travel: Travel) {
        let way = if travel == Travel::Forward { "forwards" } else { "backwards" };
        cx.decided(&self.name, event, format_args!("{way} at {LINE_M_S} m/s"));
        self.travel = travel;
        line.conveyor(self.lane.exit).run(cx, LINE_M_S, travel);
    }
}

impl Sequence<Line> for Exit {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        if self.travel == Travel::Stopped {
            self.run(line, cx, "INIT", Travel::Forward);
            return true;
        }
        let pushed = std::mem::take(&mut line.pushed[self.lane.index]);
        if pushed > 0 {
            self.since_turn += pushed;
            self.on_belt += pushed;
            self.gone.start(cx, GONE);
        }
        let belt = line.conveyor(self.lane.exit);
        while belt.a.take_fall() || belt.b.take_fall() {
            self.left += 1;
            self.on_belt = self.on_belt.saturating_sub(1);
            cx.decided(&self.name, "box leaves", format_args!("{} so far", self.left));
        }
        if self.gone.elapsed(cx) {
            self.on_belt = 0;
        }
        if self.since_turn < TURN_AFTER || self.on_belt > 0 {
            return pushed > 0;
        }
        self.since_turn = 0;
        let other = if self.travel == Travel::Forward { Travel::Backward } else { Travel::Forward };
        self.run(line, cx, "empty", other);
        true
    }

    fn count(&self, counts: &mut Counts) {
        counts.parts_out += self.left;
    }
}
