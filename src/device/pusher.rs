//! `kinetwin.Pusher`: a plate that a cylinder moves out and back, with a switch at each end and room for two light barriers.

use crate::device::table::{FASTEST, LEAST, LENGTH, LONGEST_M, VELOCITY, code, indicator, number, numbers};
use crate::prototype::kind::{KindDescriptor, ParameterDescriptor};

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.Pusher",
    summary: "a plate that extends and retracts at constant speed between two limit switches",
    ports: &[
        code("command", 0.0, 2.0, "0 hold, 1 extend, 2 retract"),
        indicator("limitExtended", "the plate is within limitTolerance of its stroke's end"),
        indicator("limitRetracted", "the plate is within limitTolerance of its start"),
        indicator("isRunning", "the plate moves faster than 1 mm/s, either way"),
        indicator("lightbarrierA", "a part cuts the beam of barrier A"),
        indicator("lightbarrierB", "a part cuts the beam of barrier B"),
    ],
    parameters: &[
        number("stroke", LENGTH, (0.001, LONGEST_M), "0.5", "way from retracted to extended"),
        number("extendSpeed", VELOCITY, (LEAST, FASTEST), "0.5", "speed of the plate on its way out"),
        number("retractSpeed", VELOCITY, (LEAST, FASTEST), "0.5", "speed of the plate on its way back"),
        number(
            "limitTolerance",
            LENGTH,
            (0.0, LONGEST_M),
            "0.002",
            "how far from an end its switch is still true, this far included",
        ),
        numbers("plateSize", LENGTH, 3, (0.001, LONGEST_M), "0.02;0.5;0.2", "thickness, width and height of the plate"),
        barrier("barrierA"),
        barrier("barrierB"),
        number("beamHeight", LENGTH, (0.0, LONGEST_M), "0.05", "height of both beams above the plate's lower edge"),
    ],
};

const fn barrier(name: &'static str) -> ParameterDescriptor {
    number(
        name,
        LENGTH,
        (-1.0, LONGEST_M),
        "-1",
        "where the barrier's beam crosses the plate's way, from the retracted front face; negative: there is none",
    )
}
