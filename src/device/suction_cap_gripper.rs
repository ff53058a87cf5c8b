//! `kinetwin.SuctionCapGripper`: cups that hold a part by vacuum.

use crate::device::table::{LENGTH, LONGEST_M, LONGEST_S, TIME, indicator, instance, number, numbers, option, switch};
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.SuctionCapGripper",
    summary: "suction cups that hold the part they are sealed on while vacuum holds",
    ports: &[
        switch("suctionOn", "draws vacuum"),
        switch("blowOn", "blows off; wins over suction"),
        indicator("vacuumOn", "vacuum holds"),
    ],
    parameters: &[
        number("buildUpTime", TIME, (0.0, LONGEST_S), "0.15", "time from suction on a sealed part to vacuum"),
        number("releaseTime", TIME, (0.0, LONGEST_S), "0.08", "time from suction off to the loss of the vacuum"),
        option("alwaysSealed", "a part is taken to be sealed at the cups always, with none in the model"),
        instance("robot", "the robot that carries the gripper; without one it stays where its instance stands"),
        numbers(
            "cupOffset",
            LENGTH,
            3,
            (-LONGEST_M, LONGEST_M),
            "0;0;0",
            "where the cups' rim lies from the robot's tool: x, y, z",
        ),
        number("reach", LENGTH, (0.0, 1.0), "0.01", "how far below the rim a part's top may lie and still be sealed"),
    ],
};
