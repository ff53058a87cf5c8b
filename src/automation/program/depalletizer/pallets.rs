//! Pallets: Conveyor1 brings them up, Conveyor2 takes one at a time to the picking place and lets it go when it is empty.

use super::{Line, Pallet};
use crate::automation::block::Travel;
use crate::automation::network::{Context, Sequence};

const INFEED_M_S: f64 = 0.3;
/// Faster than the infeed: it opens a gap between pallets that came in close.
const TAKE_M_S: f64 = 0.6;
/// So slow that the pallet stands within some millimetres of the barrier that stops it.
const CREEP_M_S: f64 = 0.1;

/// Conveyor2.
#[derive(Default)]
pub struct PickingPlace {
    step: Step,
}

#[derive(Clone, Copy, Default, PartialEq)]
enum Step {
    #[default]
    Start,
    /// Runs until a pallet comes in.
    Wanting,
    /// The pallet's last way.
    Creeping,
    Stopping,
    /// The robot works.
    Standing,
}

impl Sequence<Line> for PickingPlace {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        use Step::*;
        const NAME: &str = "PickingPlace";
        self.step = match self.step {
            Start if line.conveyor(2).b.cut() => {
                cx.decided(NAME, "INIT", "a pallet stands here");
                Stopping
            }
            Start if line.conveyor(2).a.cut() => {
                cx.decided(NAME, "INIT", "a pallet is nearly here: creep");
                creep(line, cx)
            }
            Start => {
                cx.decided(NAME, "INIT", "no pallet: take one in");
                want(line, cx)
            }
            Wanting if line.conveyor(2).a.take_rise() => {
                cx.decided(NAME, "A cut", "a pallet comes: creep");
                creep(line, cx)
            }
            Creeping if line.conveyor(2).b.cut() => {
                cx.decided(NAME, "B cut", "stop");
                line.conveyor(2).stop(cx);
                Stopping
            }
            Stopping if line.conveyor(2).settled() => {
                cx.decided(NAME, "belt at rest", "the pallet is ready");
                line.pallet = Pallet::Ready;
                Standing
            }
            Standing if line.pallet == Pallet::Spent => {
                cx.decided(NAME, "pallet spent", "let it go, take the next one in");
                want(line, cx)
            }
            _ => return false,
        };
        true
    }
}

/// Runs until the next rising edge of barrier A: the leaving pallet holds A until it is taken off at the end.
fn want(line: &mut Line, cx: &mut Context<'_>) -> Step {
    line.pallet = Pallet::Wanted;
    let belt = line.conveyor(2);
    belt.a.forget();
    belt.run(cx, TAKE_M_S, Travel::Forward);
    Step::Wanting
}

fn creep(line: &mut Line, cx: &mut Context<'_>) -> Step {
    line.pallet = Pallet::Coming;
    line.conveyor(2).run(cx, CREEP_M_S, Travel::Forward);
    Step::Creeping
}

/// Conveyor1: runs while its end is free, or while Conveyor2 takes a pallet in.
#[derive(Default)]
pub struct Infeed {
    started: bool,
}

impl Sequence<Line> for Infeed {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        let wanted = line.pallet == Pallet::Wanted;
        let belt = line.conveyor(1);
        let run = wanted || !belt.b.cut();
        if self.started && run == (belt.travel() == Travel::Forward) {
            return false;
        }
        self.started = true;
        match (run, wanted) {
            (true, true) => cx.decided("Infeed", "pallet wanted", format_args!("forwards at {INFEED_M_S} m/s")),
            (true, false) => cx.decided("Infeed", "B free", format_args!("forwards at {INFEED_M_S} m/s")),
            (false, _) => cx.decided("Infeed", "B cut", "stop: a pallet waits"),
        }
        let travel = if run { Travel::Forward } else { Travel::Stopped };
        belt.run(cx, INFEED_M_S, travel);
        true
    }
}
