//! The conveyor goes on by a pitch every cycle; a tray is let down behind it, and the exit runs.

use std::time::Duration;

use super::{BELT_M_S, CYCLE, Line, PITCH_M, REACH_M};
use crate::automation::block::Travel;
use crate::automation::network::{Context, Counts, Delay, Sequence};

/// The conveyor's speed and slope: 0.5 m/s and 1 m/s² of the belt.
const SPEED_M_S: f64 = 0.5;
const SLOPE_M_S2: f64 = 1.0;
/// How long the separator is open, and the elevator turns.
const OPEN: Duration = Duration::from_millis(300);

const NAME: &str = "Indexing";

#[derive(Default)]
pub struct Indexing {
    step: Step,
    cycle: Delay,
    is_due: bool,
    open: Delay,
    trays: u64,
    packs: u64,
}

#[derive(Clone, Copy, Default, PartialEq)]
enum Step {
    #[default]
    Start,
    Waiting,
    Moving,
    Releasing,
}

impl Sequence<Line> for Indexing {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        use Step::*;
        if line.exit.b.take_fall() {
            self.packs += 1;
            return true;
        }
        self.is_due |= self.cycle.elapsed(cx);
        self.step = match self.step {
            Start => {
                cx.decided(NAME, "INIT", format_args!("a pitch of {PITCH_M} m every {CYCLE:?}"));
                line.exit.run(cx, BELT_M_S, Travel::Forward);
                line.conveyor.enable(cx);
                self.is_due = true;
                Waiting
            }
            Waiting if self.is_due && line.conveyor.is_free(cx) && !line.load_wanted && !line.sealing => {
                self.is_due = false;
                self.cycle.start(cx, CYCLE);
                line.conveyor.index(cx, PITCH_M / REACH_M, SPEED_M_S / REACH_M, SLOPE_M_S2 / REACH_M);
                Moving
            }
            Moving if line.conveyor.is_free(cx) => {
                line.load_wanted = cx.get(line.tray_at_loading);
                if cx.get(line.denester.empty) {
                    cx.warned(NAME, "denester", "no tray is left");
                    Waiting
                } else {
                    self.trays += 1;
                    cx.set(line.denester.release, true);
                    cx.set(line.denester.separator, 0.03);
                    line.denester.elevator.turn(cx, 10.0);
                    self.open.start(cx, OPEN);
                    Releasing
                }
            }
            Releasing if self.open.elapsed(cx) => {
                cx.set(line.denester.release, false);
                cx.set(line.denester.separator, 0.0);
                line.denester.elevator.turn(cx, 0.0);
                Waiting
            }
            _ => return false,
        };
        true
    }

    fn count(&self, counts: &mut Counts) {
        counts.parts_in += self.trays;
        counts.parts_out += self.packs;
    }
}
