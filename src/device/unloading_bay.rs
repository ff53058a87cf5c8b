//! `kinetwin.UnloadingBay`: a sink that takes parts off a belt.

use crate::device::table::{LENGTH, LONGEST_M, LONGEST_S, TIME, choice, instance, number};
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.UnloadingBay",
    summary: "takes parts off a belt where their centre passes its place",
    ports: &[],
    parameters: &[
        instance("belt", "the conveyor that the parts are taken from"),
        choice(
            "place",
            &["end", "start", "at"],
            "end",
            "taken at the end of the belt, at its start, or where `at` says",
        ),
        number("at", LENGTH, (0.0, LONGEST_M), "0", "with place at: where on the centre line, from the belt's start"),
        choice(
            "kind",
            &["any", "box", "pallet"],
            "any",
            "what kind of part it takes; what stands on a part goes with it",
        ),
        number("delay", TIME, (0.0, LONGEST_S), "0", "time from a part reaching the place until it is gone"),
    ],
};
