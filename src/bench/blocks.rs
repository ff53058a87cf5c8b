//! The plant of requirement R001: any number of blocks, each with two commands and two reports.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::device::KINDS;
use crate::plant::embedded::Embedded;
use crate::plant::{self, Plant};
use crate::prototype::source::{Layered, Memory};
use crate::signal_map::RegisterId;

/// The blocks of R001.
pub const R001: usize = 200;

/// The plant's file with so many blocks, in rows of twenty. `models/r001/plant.xml` is that of [`R001`].
pub fn plant_xml(blocks: usize) -> String {
    let name = if blocks == R001 { "r001".to_owned() } else { format!("r001-{blocks}") };
    let map = if blocks == R001 { " signals-map=\"signals-maps/r001.xml\"" } else { "" };
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- The load of requirement R001: {blocks} blocks, written by \
         `kinetwin bench plant`. -->\n<plant name=\"{name}\">\n  <adapter host=\"embedded\" timeout=\"5s\" \
         hf=\"10ms\" lf=\"500ms\"{map}/>\n\n"
    );
    for block in 0..blocks {
        let (x, y) = (block % 20, block / 20);
        let name = name_of(block);
        writeln!(
            text,
            "  <instance name=\"{name}\" prototype=\"Block\"><pose x=\"{x}\" y=\"{y}\" z=\"0\"/></instance>"
        )
        .expect("a String takes everything");
    }
    text.push_str("</plant>\n");
    text
}

fn name_of(block: usize) -> String {
    format!("Block{:03}", block + 1)
}

/// The plant with so many blocks.
pub fn plant(blocks: usize) -> Plant {
    let path = "models/r001/plant.xml";
    let files = BTreeMap::from([(path.to_owned(), plant_xml(blocks))]);
    plant::load(&Layered(Memory(files), Embedded), path, KINDS).expect("what is generated is right")
}

/// The registers of each block's signal `property`, in the order of the blocks.
pub fn registers(plant: &Plant, property: &str) -> Vec<RegisterId> {
    let of = |instance: &plant::Instance| plant.signal_map.register(&format!("{}.{property}", instance.name));
    plant.instances.iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_is_what_the_command_writes() {
        assert_eq!(
            plant_xml(R001),
            include_str!("../../models/r001/plant.xml"),
            "kinetwin bench plant -o models/r001/plant.xml"
        );
    }

    #[test]
    fn any_number_of_blocks_makes_a_plant() {
        for blocks in [1, 37, 2000] {
            let plant = plant(blocks);
            assert_eq!(plant.signal_map.signals().len(), 4 * blocks);
            assert_eq!(registers(&plant, "ready").len(), blocks);
        }
    }
}
