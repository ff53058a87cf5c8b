//! What straight and curved conveyors have in common: their signals, their drive, their light barriers.

use crate::device::table::{
    ACCELERATION, LEAST, LENGTH, LONGEST_M, LONGEST_S, STEEPEST, TIME, VELOCITY, choice, code, indicator, measure,
    number, option, state, target,
};
use crate::prototype::kind::{ParameterDescriptor, PortDescriptor};

/// The ports of both kinds, in the order of the constants below.
pub(super) const PORTS: &[PortDescriptor] = &[
    target("velocityTarget", VELOCITY, "speed the belt is to run at, its sign counts"),
    code("motorDirection", -1.0, 1.0, "-1 backwards, 0 off, 1 forwards; multiplies the target"),
    measure("velocityActual", VELOCITY, "speed of the belt on its centre line"),
    indicator("driveEnabled", "motorDirection is not 0"),
    indicator("driveRunning", "the belt moves faster than 1 mm/s, either way"),
    state("directionalActual", -1.0, 1.0, "which way the belt moves: 0 within 1 mm/s of standstill"),
    indicator("lightBarrierA", "a part cuts the beam of barrier A"),
    indicator("lightBarrierB", "a part cuts the beam of barrier B"),
];

/// Width of the belt.
pub(super) const WIDTH: ParameterDescriptor =
    number("width", LENGTH, (0.01, LONGEST_M), "0.6", "width of the belt across its running direction");
/// How steeply the drive changes its speed.
pub(super) const DRIVE_ACCELERATION: ParameterDescriptor =
    number("acceleration", ACCELERATION, (LEAST, STEEPEST), "1.0", "slope of the speed towards its target");
/// How steeply it slows down, if that differs.
pub(super) const DRIVE_DECELERATION: ParameterDescriptor = number(
    "deceleration",
    ACCELERATION,
    (0.0, STEEPEST),
    "0",
    "slope while the speed falls towards 0; 0 means as acceleration",
);
/// Whether it coasts.
pub(super) const COAST: ParameterDescriptor =
    option("coast", "with motorDirection 0 the belt coasts instead of following the ramp");
/// How fast a coasting belt slows down.
pub(super) const COAST_DECELERATION: ParameterDescriptor =
    number("coastDeceleration", ACCELERATION, (LEAST, STEEPEST), "0.5", "slope at which a coasting belt slows down");
/// How long the drive takes to be ready.
pub(super) const READY_DELAY: ParameterDescriptor = number(
    "readyDelay",
    TIME,
    (0.0, LONGEST_S),
    "0",
    "time from motorDirection leaving 0 until the drive is enabled and moves",
);
/// Height of the beams.
pub(super) const BEAM_HEIGHT: ParameterDescriptor =
    number("beamHeight", LENGTH, (0.0, LONGEST_M), "0.05", "height of both beams above the belt");
/// How a part on two belts is carried.
pub(super) const TRANSFER: ParameterDescriptor = choice(
    "transfer",
    &["most", "share"],
    "most",
    "a part on two belts moves with the one that carries most of its footprint, or with both by their shares",
);

/// The place of a light barrier; `name` is `barrierA` or `barrierB`.
pub(super) const fn barrier(name: &'static str, default: &'static str) -> ParameterDescriptor {
    number(
        name,
        LENGTH,
        (-1.0, LONGEST_M),
        default,
        "where the barrier's beam crosses the centre line, from the start of the belt; negative: there is none",
    )
}
