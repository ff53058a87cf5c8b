//! `kinetwin.LoadingBay`: a source that puts parts on a belt at its due instants.

use crate::device::table::{ANGLE, LENGTH, LONGEST_M, LONGEST_S, TIME, choice, instance, integer, number, numbers};
use crate::prototype::kind::KindDescriptor;

const SIZES: (f64, f64) = (0.001, LONGEST_M);

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.LoadingBay",
    summary: "puts parts on a belt, one at each due instant if the place is free",
    ports: &[],
    parameters: &[
        instance("belt", "the conveyor that the parts are put on"),
        number(
            "at",
            LENGTH,
            (0.0, LONGEST_M),
            "0.15",
            "where the part's centre is put, along the belt's centre line from its start",
        ),
        number(
            "across",
            LENGTH,
            (-LONGEST_M, LONGEST_M),
            "0",
            "how far to the left of the centre line its centre is put",
        ),
        number("turn", ANGLE, (-7.0, 7.0), "0", "how far the part is turned to the left from the running direction"),
        choice("kind", &["box", "pallet"], "box", "what kind of part"),
        numbers("size", LENGTH, 3, SIZES, "0.3;0.2;0.2", "length, width and height of the part"),
        number("firstTime", TIME, (0.0, LONGEST_S), "1.0", "the first due instant"),
        number("interval", TIME, (0.001, LONGEST_S), "6.0", "time from one due instant to the next"),
        number(
            "spread",
            TIME,
            (0.0, LONGEST_S),
            "0",
            "each instant is late by up to this, evenly at random; at most the interval",
        ),
        integer(
            "limit",
            (0, i64::MAX),
            "0",
            "how many parts are put there at most, what they come loaded with apart; 0: no end",
        ),
        choice("loadKind", &["box", "pallet"], "box", "what kind of part stands on each part that is put there"),
        numbers("loadSize", LENGTH, 3, SIZES, "0.3;0.2;0.2", "length, width and height of each part of the load"),
        integer("loadRows", (0, 100), "0", "rows of the load along the part; 0: it comes empty"),
        integer("loadColumns", (0, 100), "0", "columns of the load across the part; 0: it comes empty"),
        integer("loadLayers", (0, 100), "0", "layers of the load, one on the other; 0: it comes empty"),
        number(
            "loadGap",
            LENGTH,
            (0.0, LONGEST_M),
            "0.01",
            "room between neighbours in a layer of the load, which is centred",
        ),
    ],
};
