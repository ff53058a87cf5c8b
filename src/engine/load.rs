//! How much each device has to do with parts.

use super::{Engine, UnitBody};

impl Engine {
    /// Of every device that carries, holds or pushes parts: its instance, and how many it has at present, those that stand on
    /// others apart.
    pub fn loads(&self) -> impl Iterator<Item = (&str, u32)> {
        self.units.iter().filter_map(|unit| {
            let parts = match unit.body {
                UnitBody::Belt(index) => self.floor.load_of_belt(index).0,
                UnitBody::Plate(index) => self.floor.plates[index].pushed,
                UnitBody::Cups(index, _) => self.floor.held_by(&[index]),
                _ => return None,
            };
            Some((unit.instance.as_str(), parts))
        })
    }
}
