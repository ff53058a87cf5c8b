//! `kinetwin.EncoderMotor`: an inverter motor with an incremental encoder.

use crate::device::table::{
    ANGULAR_ACCELERATION, ANGULAR_VELOCITY, LEAST, LONGEST_S, STEEPEST, TIME, counter, indicator, integer, measure,
    number, option, switch, target,
};
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.EncoderMotor",
    summary: "a motor with a ramped drive whose encoder counts its angle",
    ports: &[
        target("speedTarget", ANGULAR_VELOCITY, "speed the motor is to run at, its sign counts"),
        switch("enable", "lets the motor follow the target; it ramps to 0 without"),
        counter("encoder", "whole counts of the angle, wrapping at the ends of its range"),
        measure("speedActual", ANGULAR_VELOCITY, "speed of the motor"),
        indicator("inverterReady", "the inverter is enabled"),
    ],
    parameters: &[
        number("acceleration", ANGULAR_ACCELERATION, (LEAST, STEEPEST), "20", "slope of the speed towards its target"),
        number(
            "deceleration",
            ANGULAR_ACCELERATION,
            (0.0, STEEPEST),
            "0",
            "slope while the speed falls towards 0; 0 means as acceleration",
        ),
        option("coast", "without enable the motor coasts instead of following the ramp"),
        number(
            "coastDeceleration",
            ANGULAR_ACCELERATION,
            (LEAST, STEEPEST),
            "10",
            "slope at which a coasting motor slows down",
        ),
        number("readyDelay", TIME, (0.0, LONGEST_S), "0", "time from enable until the inverter is ready and moves"),
        integer("countsPerRevolution", (1, 1 << 30), "4096", "counts of the encoder in one turn"),
        integer("encoderBits", (0, 31), "0", "bits of the encoder's count, from 0 up; 0: a DINT that wraps"),
    ],
};
