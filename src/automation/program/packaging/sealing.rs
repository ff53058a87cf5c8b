//! A tray stops under the bell, which comes down, stays, and goes up; then the film goes on and the tray leaves.

use std::time::Duration;

use super::{BELT_M_S, Line};
use crate::automation::block::Travel;
use crate::automation::network::{Context, Delay, Sequence};

/// How far the bell comes down, m: first near to the tray, as its loop overshoots by some per cent, then onto it; and how near to
/// its ends it has come, m.
const ABOVE_M: f64 = 0.13;
const DOWN_M: f64 = 0.158;
const NEAR_M: f64 = 0.002;
/// How long the bell stays on the tray, and how long the film goes on.
const DWELL: Duration = Duration::from_millis(500);
const FILM: Duration = Duration::from_millis(400);

const NAME: &str = "Sealing";

#[derive(Default)]
pub struct Sealing {
    step: Step,
    dwell: Delay,
    film: Delay,
}

#[derive(Clone, Copy, Default, PartialEq)]
enum Step {
    #[default]
    Start,
    Waiting,
    Stopping,
    Lowering,
    Closing,
    Sealing,
    Raising,
    Leaving,
}

impl Sequence<Line> for Sealing {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        use Step::*;
        let press = cx.get(line.press.position);
        if self.film.elapsed(cx) {
            line.film.turn(cx, 0.0);
            return true;
        }
        self.step = match self.step {
            Start => {
                cx.decided(NAME, "INIT", "the belt runs");
                cx.set(line.press.enabled, true);
                line.sealer.run(cx, BELT_M_S, Travel::Forward);
                Waiting
            }
            Waiting if line.sealer.b.take_rise() => {
                line.sealing = true;
                line.sealer.stop(cx);
                Stopping
            }
            Stopping if line.sealer.settled() => {
                cx.decided(NAME, "tray", "the bell comes down");
                cx.set(line.press.target, ABOVE_M);
                Lowering
            }
            Lowering if press > ABOVE_M - NEAR_M => {
                cx.set(line.press.target, DOWN_M);
                Closing
            }
            Closing if press > DOWN_M - NEAR_M => {
                self.dwell.start(cx, DWELL);
                Sealing
            }
            Sealing if self.dwell.elapsed(cx) => {
                cx.set(line.press.target, 0.0);
                // By the time the next tray comes, this one is on its way.
                line.sealing = false;
                Raising
            }
            Raising if press < NEAR_M => {
                line.film.turn(cx, 20.0);
                self.film.start(cx, FILM);
                line.sealer.run(cx, BELT_M_S, Travel::Forward);
                Leaving
            }
            Leaving if line.sealer.b.take_fall() => Waiting,
            _ => return false,
        };
        true
    }
}
