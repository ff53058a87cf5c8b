//! `kinetwin.CartesianRobot`: three linear axes and one rotary, each on its own trapezoidal profile.

use crate::device::table::{
    ACCELERATION, ANGLE, ANGULAR_ACCELERATION, ANGULAR_VELOCITY, FASTEST, LEAST, LENGTH, LONGEST_M, STEEPEST, VELOCITY,
    indicator, measure, number, switch, target,
};
use crate::prototype::kind::KindDescriptor;

const SPEEDS: (f64, f64) = (LEAST, FASTEST);
const SLOPES: (f64, f64) = (LEAST, STEEPEST);
const SPEED_LINE: &str = "highest speed of the axis";
const SLOPE_LINE: &str = "highest acceleration of the axis, and its deceleration";

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.CartesianRobot",
    summary: "a gantry with axes X, Y, Z and a rotation R about the vertical, each on a trapezoidal profile",
    ports: &[
        target("XTarget", LENGTH, "where axis X is to go"),
        target("YTarget", LENGTH, "where axis Y is to go"),
        target("ZTarget", LENGTH, "where axis Z is to go"),
        target("RTarget", ANGLE, "where axis R is to turn"),
        switch("grip", "closes the mounted gripper"),
        indicator("cartesianArrived", "every axis is within its tolerance of the latest target and at rest"),
        measure("actualPosX", LENGTH, "position of axis X"),
        measure("actualPosY", LENGTH, "position of axis Y"),
        measure("actualPosZ", LENGTH, "position of axis Z"),
        measure("actualPosR", ANGLE, "angle of axis R"),
    ],
    parameters: &[
        number("maxVelocityX", VELOCITY, SPEEDS, "1.0", SPEED_LINE),
        number("maxVelocityY", VELOCITY, SPEEDS, "1.0", SPEED_LINE),
        number("maxVelocityZ", VELOCITY, SPEEDS, "1.0", SPEED_LINE),
        number("maxVelocityR", ANGULAR_VELOCITY, SPEEDS, "2.0", SPEED_LINE),
        number("maxAccelerationX", ACCELERATION, SLOPES, "2.0", SLOPE_LINE),
        number("maxAccelerationY", ACCELERATION, SLOPES, "2.0", SLOPE_LINE),
        number("maxAccelerationZ", ACCELERATION, SLOPES, "2.0", SLOPE_LINE),
        number("maxAccelerationR", ANGULAR_ACCELERATION, SLOPES, "8.0", SLOPE_LINE),
        number(
            "arrivedTolerance",
            LENGTH,
            (0.0, LONGEST_M),
            "0.0005",
            "how far X, Y and Z may be from their targets and have arrived",
        ),
        number(
            "arrivedToleranceR",
            ANGLE,
            (0.0, LONGEST_M),
            "0.0005",
            "how far R may be from its target and have arrived",
        ),
    ],
};
