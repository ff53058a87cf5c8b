//! `kinetwin.ServoAxis`: one axis under a servo drive, linear or rotary.

use crate::device::table::{
    EFFORT, LENGTH, LONGEST_M, LONGEST_S, SPEED, TIME, TRAVEL, choice, measure, number, switch, target,
};
use crate::prototype::kind::KindDescriptor;
use crate::value::Quantity;

const GREATEST: f64 = 1e9;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.ServoAxis",
    summary: "an axis whose drive follows a position, a speed or a force, against inertia, friction and load",
    ports: &[
        target("positionTarget", TRAVEL, "where the axis is to be, in modes ideal and position"),
        target("velocityTarget", SPEED, "how fast it is to move, in mode velocity"),
        target("forceTarget", EFFORT, "what the drive is to exert, before forceGain, in mode force"),
        switch("torqueEnabled", "the drive may exert a force; true where it is not mapped"),
        measure("position", TRAVEL, "position of the load"),
        measure("velocity", SPEED, "speed of the motor"),
        measure("force", EFFORT, "what the drive exerts, after its limit"),
    ],
    parameters: &[
        choice("motion", &["linear", "rotary"], "linear", "whether it counts in m, kg and N or in rad, kg.m2 and N.m"),
        choice("mode", &["ideal", "position", "velocity", "force"], "position", "what the drive follows"),
        choice(
            "loop",
            &["cascade", "proportional"],
            "cascade",
            "in mode position: a speed loop within a position loop, or velocityGain on the position's error alone",
        ),
        number("M", &[Quantity::Mass, Quantity::Inertia], (1e-9, GREATEST), "20", "inertia of motor and load"),
        number("Fv", &[Quantity::LinearDamping, Quantity::AngularDamping], (0.0, GREATEST), "50", "viscous friction"),
        number("positionGain", &[Quantity::Rate], (0.0, GREATEST), "25", "speed asked for each unit of position error"),
        number(
            "velocityGain",
            &[Quantity::LinearDamping, Quantity::AngularDamping, Quantity::LinearStiffness, Quantity::AngularStiffness],
            (0.0, GREATEST),
            "800",
            "force for each unit of speed error; with loop proportional, of position error",
        ),
        number(
            "velocityIntegralTime",
            TIME,
            (0.0, LONGEST_S),
            "0",
            "reset time of the speed loop's integrator; 0: there is none",
        ),
        number(
            "velocityFeedforward",
            &[Quantity::One],
            (0.0, 10.0),
            "0",
            "share of the target's own speed that is added to the speed asked for",
        ),
        number(
            "forceGain",
            &[Quantity::One],
            (-GREATEST, GREATEST),
            "1",
            "force for each unit of forceTarget in mode force",
        ),
        number("forceLimit", EFFORT, (0.0, GREATEST), "500", "greatest force of the drive, either way"),
        number("load", EFFORT, (-GREATEST, GREATEST), "0", "constant load; positive opposes positive motion"),
        number(
            "pendulumMass",
            &[Quantity::Mass],
            (0.0, GREATEST),
            "0",
            "mass of a pendulum that loads the axis by m g l sin(position); 0: there is none",
        ),
        number("pendulumLength", LENGTH, (0.0, LONGEST_M), "0", "length of that pendulum, to its centre of mass"),
    ],
};
