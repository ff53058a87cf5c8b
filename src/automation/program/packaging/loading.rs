//! The arm takes a product from its table, waits over the loading place, and puts it into the tray there.

use super::Line;
use crate::automation::network::{Context, Sequence};

/// The places that the arm was taught.
const OVER_PRODUCT: i32 = 1;
const AT_PRODUCT: i32 = 2;
const OVER_TRAY: i32 = 3;
const AT_TRAY: i32 = 4;

const NAME: &str = "Loading";

#[derive(Default)]
pub struct Loading {
    step: Step,
    taken: i32,
}

#[derive(Clone, Copy, Default, PartialEq)]
enum Step {
    #[default]
    Start,
    OverProduct,
    AtProduct,
    Gripping,
    Lifting,
    OverTray,
    AtTray,
    Releasing,
    Rising,
}

impl Sequence<Line> for Loading {
    fn advance(&mut self, line: &mut Line, cx: &mut Context<'_>) -> bool {
        use Step::*;
        let arrived = line.arm.arrived();
        self.step = match self.step {
            Start => {
                cx.decided(NAME, "INIT", "to the first product");
                cx.set(line.products.supply, true);
                line.arm.go(cx, OVER_PRODUCT);
                OverProduct
            }
            OverProduct if arrived && cx.get(line.products.supplied) > self.taken => {
                cx.set(line.products.supply, false);
                line.arm.go(cx, AT_PRODUCT);
                AtProduct
            }
            AtProduct if arrived => {
                line.arm.hold(cx, true);
                Gripping
            }
            Gripping if line.arm.holds(cx) => {
                self.taken += 1;
                line.arm.go(cx, OVER_PRODUCT);
                Lifting
            }
            Lifting if arrived => {
                cx.set(line.products.supply, true);
                line.arm.go(cx, OVER_TRAY);
                OverTray
            }
            OverTray if arrived && line.load_wanted => {
                cx.decided(NAME, "tray", format_args!("product {} into it", self.taken));
                line.arm.go(cx, AT_TRAY);
                AtTray
            }
            AtTray if arrived => {
                line.arm.hold(cx, false);
                Releasing
            }
            Releasing if !line.arm.holds(cx) => {
                line.arm.go(cx, OVER_TRAY);
                Rising
            }
            Rising if arrived => {
                line.load_wanted = false;
                line.arm.go(cx, OVER_PRODUCT);
                OverProduct
            }
            _ => return false,
        };
        true
    }
}
