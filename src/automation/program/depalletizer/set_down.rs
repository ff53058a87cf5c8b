//! Loose boxes: Conveyor3 lets them onto the set-down place, one at a time, when the robot does not want it.

use super::{Line, SetDown};
use crate::automation::block::Travel;
use crate::automation::network::{Context, Counts, Sequence};

/// Slower than Conveyor4, which so pulls the first box away from the next.
const LOOSE_M_S: f64 = 0.4;

/// Conveyor3, and the books of the set-down place.
#[derive(Default)]
pub struct Loose {
    step: Step,
    let_in: u64,
}

#[derive(Clone, Copy, Default, PartialEq)]
enum Step {
    #[default]
    Start,
    /// Boxes close up to barrier B.
    Gathering,
    /// The first box goes over to Conveyor4.
    LettingIn,
}

const NAME: &str = "Loose";

impl Sequence<Line> for Loose {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        let booked = book(line, cx);
        let stepped = self.step(line, cx);
        booked || stepped
    }

    fn count(&self, counts: &mut Counts) {
        counts.parts_in += self.let_in;
    }
}

impl Loose {
    fn step(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        use Step::*;
        self.step = match self.step {
            Start => {
                cx.decided(NAME, "INIT", "boxes close up");
                Gathering
            }
            Gathering if line.conveyor(3).b.cut() && line.set_down.open_to_loose() => {
                cx.decided(NAME, "place free", "let a box in");
                line.set_down.loose_holds = true;
                line.conveyor(4).a.forget();
                line.conveyor(3).run(cx, LOOSE_M_S, Travel::Forward);
                LettingIn
            }
            LettingIn if line.conveyor(4).a.take_rise() => {
                self.let_in += 1;
                cx.decided(NAME, "A of Conveyor4", format_args!("loose box {} is in", self.let_in));
                line.set_down.boxes += 1;
                line.set_down.last_by_robot = false;
                Gathering
            }
            Gathering => return gather(line, cx),
            LettingIn => return false,
        };
        true
    }
}

/// Conveyor3 runs as far as its barrier B.
fn gather(line: &mut Line, cx: &mut Context<'_>) -> bool {
    let belt = line.conveyor(3);
    let run = !belt.b.cut();
    if run == (belt.travel() == Travel::Forward) {
        return false;
    }
    if run {
        cx.decided(NAME, "B free", format_args!("forwards at {LOOSE_M_S} m/s"));
        belt.run(cx, LOOSE_M_S, Travel::Forward);
    } else {
        cx.decided(NAME, "B cut", "stop: a box waits");
        belt.stop(cx);
    }
    true
}

/// Counts the boxes that leave the set-down place, and gives it to the robot.
fn book(line: &mut Line, cx: &mut Context<'_>) -> bool {
    let mut changed = false;
    while line.conveyor(4).b.take_fall() {
        let place = &mut line.set_down;
        place.boxes = place.boxes.saturating_sub(1);
        if place.boxes == 0 {
            place.loose_holds = false;
        }
        changed = true;
    }
    let place = &mut line.set_down;
    if place.robot_asks && !place.robot_holds && !place.loose_holds && place.boxes == 0 {
        place.robot_holds = true;
        cx.decided("SetDown", "place free", "it is the robot's");
        changed = true;
    }
    changed
}

impl SetDown {
    fn open_to_loose(&self) -> bool {
        let clear = self.boxes == 0 || (self.boxes == 1 && self.last_by_robot);
        !self.robot_asks && !self.loose_holds && clear
    }
}
