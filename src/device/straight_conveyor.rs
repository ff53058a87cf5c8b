//! `kinetwin.StraightConveyor`: a belt that carries parts along a straight line, with a light barrier near each end.

use crate::device::conveyor;
use crate::device::table::{LENGTH, LONGEST_M, number};
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.StraightConveyor",
    summary: "a straight belt with a ramped drive and two light barriers",
    ports: conveyor::PORTS,
    parameters: &[
        number("length", LENGTH, (0.01, LONGEST_M), "2.0", "length of the belt, from x = 0 of its instance"),
        conveyor::WIDTH,
        conveyor::DRIVE_ACCELERATION,
        conveyor::DRIVE_DECELERATION,
        conveyor::COAST,
        conveyor::COAST_DECELERATION,
        conveyor::READY_DELAY,
        conveyor::barrier("barrierA", "0.3"),
        conveyor::barrier("barrierB", "1.7"),
        conveyor::BEAM_HEIGHT,
        conveyor::TRANSFER,
    ],
};
