//! The packaging line's program: `docs/packaging.md` describes the plant and what each of its sequences does.
//!
//! The conveyor goes on by one pitch every cycle, unless the tray at the loading place has not got its product or the sealer is
//! at work. Whatever stands still meanwhile is worked at: a tray is let down, one is loaded, one is sealed.

mod indexing;
mod loading;
mod sealing;

use std::time::Duration;

use crate::automation::block::{ConveyorFb, InverterConveyorFb, SixAxisRobotFb};
use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Devices, Network};

/// From one index of the conveyor to the next: packs leave at this interval.
pub const CYCLE: Duration = Duration::from_secs(4);
/// How far the conveyor goes, m, how far its belt goes while the motor turns by a radian, m, and the encoder's counts in a turn.
const PITCH_M: f64 = 0.6;
const REACH_M: f64 = 0.005;
const COUNTS: f64 = 4096.0;
/// Speed of the other belts, m/s.
const BELT_M_S: f64 = 0.4;

/// The line's devices, and the hand-shakes between its sequences.
pub struct Line {
    conveyor: InverterConveyorFb,
    sealer: ConveyorFb,
    exit: ConveyorFb,
    arm: SixAxisRobotFb,
    denester: Denester,
    products: Products,
    press: Press,
    film: Motor,
    /// An eye over the loading place: a tray is there.
    tray_at_loading: Input<bool>,
    /// Whether the tray at the loading place waits for its product.
    load_wanted: bool,
    /// Whether a tray stands in the sealer.
    sealing: bool,
}

struct Denester {
    release: Output<bool>,
    empty: Input<bool>,
    separator: Output<f64>,
    elevator: Motor,
}

struct Products {
    supply: Output<bool>,
    supplied: Input<i32>,
}

struct Press {
    enabled: Output<bool>,
    target: Output<f64>,
    position: Input<f64>,
}

struct Motor {
    speed: Output<f64>,
    enable: Output<bool>,
}

impl Motor {
    fn bind(binder: &mut Binder<'_>, instance: &str, speed: &str, enable: &str) -> Motor {
        Motor { speed: binder.output(instance, speed), enable: binder.output(instance, enable) }
    }

    fn turn(&self, cx: &mut crate::automation::network::Context<'_>, speed: f64) {
        cx.set(self.speed, speed);
        cx.set(self.enable, speed != 0.0);
    }
}

impl Devices for Line {
    fn each(&mut self, visit: &mut dyn FnMut(&mut dyn Block)) {
        visit(&mut self.conveyor);
        visit(&mut self.sealer);
        visit(&mut self.exit);
        visit(&mut self.arm);
    }
}

/// The program, bound to the line's signals.
pub fn program(binder: &mut Binder<'_>) -> Network<Line> {
    let line = Line {
        conveyor: InverterConveyorFb::bind(binder, "Conveyor", COUNTS),
        sealer: ConveyorFb::bind(binder, "Sealer"),
        exit: ConveyorFb::bind(binder, "Exit"),
        arm: SixAxisRobotFb::bind(binder, "CollaborativeRobot"),
        denester: Denester {
            release: binder.output("Denester", "release"),
            empty: binder.input("Denester", "empty"),
            separator: binder.output("Denester", "separatorTarget"),
            elevator: Motor::bind(binder, "Denester", "elevatorSpeed", "elevatorEnable"),
        },
        products: Products {
            supply: binder.output("CollaborativeRobot", "supply"),
            supplied: binder.input("CollaborativeRobot", "supplied"),
        },
        press: Press {
            enabled: binder.output("Sealer", "pressEnabled"),
            target: binder.output("Sealer", "pressTarget"),
            position: binder.input("Sealer", "pressPosition"),
        },
        film: Motor::bind(binder, "Sealer", "filmSpeed", "filmEnable"),
        tray_at_loading: binder.input("Conveyor", "loadDetected"),
        load_wanted: false,
        sealing: false,
    };
    let sequences: Vec<Box<dyn crate::automation::network::Sequence<Line>>> = vec![
        Box::new(indexing::Indexing::default()),
        Box::new(loading::Loading::default()),
        Box::new(sealing::Sealing::default()),
    ];
    Network::new(line, sequences)
}
