//! `kinetwin.ConveyorCurve`: a belt that carries parts along an arc; its speed is that of the centre line.

use crate::device::conveyor;
use crate::device::table::{ANGLE, LENGTH, LONGEST_M, number};
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.ConveyorCurve",
    summary: "a curved belt with a ramped drive and two light barriers",
    ports: conveyor::PORTS,
    parameters: &[
        number("radius", LENGTH, (0.01, LONGEST_M), "1.0", "radius of the centre line"),
        number(
            "angle",
            ANGLE,
            (-std::f64::consts::TAU, std::f64::consts::TAU),
            "1.5707963267948966",
            "angle the belt turns by from the x direction, to the left if positive; not 0",
        ),
        conveyor::WIDTH,
        conveyor::DRIVE_ACCELERATION,
        conveyor::DRIVE_DECELERATION,
        conveyor::COAST,
        conveyor::COAST_DECELERATION,
        conveyor::READY_DELAY,
        conveyor::barrier("barrierA", "0.2"),
        conveyor::barrier("barrierB", "1.3"),
        conveyor::BEAM_HEIGHT,
        conveyor::TRANSFER,
    ],
};
