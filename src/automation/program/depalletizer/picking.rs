//! The robot: takes the boxes off the pallet, two at a time, and sets them on Conveyor4 one after the other.

use std::f64::consts::FRAC_PI_2;
use std::time::Duration;

use super::{Line, Pallet};
use crate::automation::block::Target;
use crate::automation::network::{Context, Counts, Delay, Sequence};

/// Columns of boxes along the pallet, m from its centre.
const COLUMNS_M: [f64; 3] = [-0.40, 0.0, 0.40];
/// Cups on the boxes of the upper and of the lower layer, m.
const LAYERS_M: [f64; 2] = [-0.774, -1.014];
/// Height to travel at, m.
const TRAVEL_M: f64 = -0.40;
/// The set-down place across the lanes, and the height at which boxes hang just above the belt, m.
const SET_DOWN_Y_M: f64 = 1.20;
const SET_DOWN_Z_M: f64 = -0.704;
/// The grippers stand across the pallet lane to pick, along the box line to set down.
const ACROSS_RAD: f64 = FRAC_PI_2;
const ALONG_RAD: f64 = 0.0;
/// A gripper whose vacuum has not come by then has no box below it.
const NO_BOX: Duration = Duration::from_secs(1);

/// How many picks empty a pallet.
const PICKS: usize = COLUMNS_M.len() * LAYERS_M.len();

/// The robot and its two grippers.
#[derive(Default)]
pub struct Picking {
    step: Step,
    /// Picks begun at this pallet, less one.
    pick: usize,
    /// Which grippers took a box.
    holds: [bool; 2],
    no_box: Delay,
    taken: u64,
}

#[derive(Clone, Copy, Default, PartialEq)]
enum Step {
    #[default]
    Waiting,
    Over,
    Down,
    Gripping,
    Up,
    Across,
    Lowering,
    /// The box of this gripper is let go.
    Releasing(usize),
    /// It leaves with the belt, before the other follows.
    Leaving,
    Rising,
}

const NAME: &str = "Picking";

impl Sequence<Line> for Picking {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        use Step::*;
        let arrived = line.robot.arrived();
        self.step = match self.step {
            Waiting if line.pallet == Pallet::Ready => {
                self.pick = 0;
                cx.decided(NAME, "pallet ready", "to the first column");
                self.over(line, cx)
            }
            Over if arrived => {
                cx.decided(NAME, "arrived", format_args!("down for pick {} of {PICKS}", self.pick + 1));
                line.robot.move_to(cx, self.column(LAYERS_M[self.pick / COLUMNS_M.len()]));
                Down
            }
            Down if arrived => {
                cx.decided(NAME, "arrived", "suction on");
                line.grippers.iter_mut().for_each(|gripper| gripper.grip(cx));
                self.no_box.start(cx, NO_BOX);
                Gripping
            }
            Gripping => match self.gripped(line, cx) {
                Some(next) => next,
                None => return false,
            },
            Up if arrived => self.lifted(line, cx),
            Across if arrived && line.set_down.robot_holds => {
                cx.decided(NAME, "place granted", "down");
                line.robot.move_to(cx, set_down(SET_DOWN_Z_M));
                Lowering
            }
            Lowering if arrived => self.release(line, cx, 0),
            Releasing(gripper) if line.grippers[gripper].free() => self.released(line, cx, gripper),
            Leaving if line.set_down.boxes == 0 => {
                cx.decided(NAME, "first box away", "the second");
                self.release(line, cx, 1)
            }
            Rising if arrived => self.next(line, cx),
            _ => return false,
        };
        true
    }

    fn count(&self, counts: &mut Counts) {
        counts.parts_in += self.taken;
    }
}

impl Picking {
    /// The place above, or in, the column of the present pick.
    fn column(&self, z: f64) -> Target {
        Target { x: COLUMNS_M[self.pick % COLUMNS_M.len()], y: 0.0, z, r: ACROSS_RAD }
    }

    fn over(&self, line: &mut Line, cx: &mut Context<'_>) -> Step {
        line.robot.move_to(cx, self.column(TRAVEL_M));
        Step::Over
    }

    /// Whether all is gripped that will be, and what follows.
    fn gripped(&mut self, line: &mut Line, cx: &mut Context<'_>) -> Option<Step> {
        self.holds = [line.grippers[0].holds(), line.grippers[1].holds()];
        let boxes = self.holds.into_iter().filter(|holds| *holds).count();
        if boxes == 2 {
            self.no_box.stop();
            cx.decided(NAME, "vacuum", "two boxes: up");
        } else if self.no_box.elapsed(cx) {
            cx.decided(NAME, "TIMEOUT", format_args!("{boxes} of two boxes are there: up"));
            for (gripper, holds) in line.grippers.iter_mut().zip(self.holds) {
                if !holds {
                    gripper.rest(cx);
                }
            }
        } else {
            return None;
        }
        self.taken += boxes as u64;
        line.set_down.robot_asks = boxes > 0;
        line.robot.move_to(cx, self.column(TRAVEL_M));
        Some(Step::Up)
    }

    /// At travel height over the pallet.
    fn lifted(&mut self, line: &mut Line, cx: &mut Context<'_>) -> Step {
        if self.pick + 1 == PICKS {
            cx.decided(NAME, "pallet empty", "let it go");
            line.pallet = Pallet::Spent;
        }
        if self.holds == [false, false] {
            return self.next(line, cx);
        }
        cx.decided(NAME, "arrived", "across to the set-down place");
        line.robot.move_to(cx, set_down(TRAVEL_M));
        Step::Across
    }

    /// Lets the box of `gripper` go, if it has one.
    fn release(&mut self, line: &mut Line, cx: &mut Context<'_>, gripper: usize) -> Step {
        cx.decided(NAME, "over the belt", format_args!("blow off gripper {}", gripper + 1));
        line.grippers[gripper].release(cx);
        Step::Releasing(gripper)
    }

    fn released(&mut self, line: &mut Line, cx: &mut Context<'_>, gripper: usize) -> Step {
        if self.holds[gripper] {
            line.set_down.boxes += 1;
            line.set_down.last_by_robot = true;
        }
        if gripper == 0 {
            cx.decided(NAME, "vacuum off", "wait until the first box is away");
            return Step::Leaving;
        }
        cx.decided(NAME, "vacuum off", "up, the place is free");
        line.grippers.iter_mut().for_each(|gripper| gripper.rest(cx));
        line.set_down.robot_asks = false;
        line.set_down.robot_holds = false;
        line.robot.move_to(cx, set_down(TRAVEL_M));
        Step::Rising
    }

    /// On to the next column, or the next pallet.
    fn next(&mut self, line: &mut Line, cx: &mut Context<'_>) -> Step {
        self.pick += 1;
        if self.pick == PICKS {
            cx.decided(NAME, "pallet done", "wait for the next");
            return Step::Waiting;
        }
        cx.decided(NAME, "arrived", "to the next column");
        self.over(line, cx)
    }
}

fn set_down(z: f64) -> Target {
    Target { x: 0.0, y: SET_DOWN_Y_M, z, r: ALONG_RAD }
}
