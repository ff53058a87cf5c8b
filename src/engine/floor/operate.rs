//! Parts that an operator puts in and takes out.

use super::Floor;
use super::part::Support;
use crate::kinematics::{Along, Block, DVec3, Upright};
use crate::plant::PartKind;

/// A part to put on a belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::engine) struct PartRequest {
    pub kind: PartKind,
    /// Length, width, height, m.
    pub size: [f64; 3],
    pub belt: usize,
    /// Along the belt's centre line from its start, and to the left of it, m.
    pub at: [f64; 2],
    /// How far it is turned to the left from the running direction there, rad.
    pub turn: f64,
}

impl Floor {
    /// Puts a part on a belt. The error says why it has no room there.
    pub fn insert_part(&mut self, request: &PartRequest) -> Result<(), &'static str> {
        let surface = &self.belts[request.belt].surface;
        let [station, offset] = request.at;
        if !(0.0..=surface.length()).contains(&station) || offset.abs() > surface.width() / 2.0 {
            return Err(
                "the place is not on the belt: expected a station between its ends, and an offset within its width",
            );
        }
        let (place, heading) = surface.at(Along { station, offset });
        let upright = Upright { place: place.extend(surface.height()), yaw: heading + request.turn };
        let block = Block::new(DVec3::from_array(request.size), upright);
        if !self.is_free(&block) {
            return Err("a part or a plate is where it is to stand: choose another place, or take that part out first");
        }
        self.enter(request.kind, block, Support::Belt(request.belt));
        Ok(())
    }

    /// Takes the part `number` out, with all that stands on it. Whether there was one.
    pub fn remove_part(&mut self, number: u64) -> bool {
        let Some(slot) = self.parts.iter().find(|(_, part)| part.number == number).map(|(slot, _)| slot) else {
            return false;
        };
        for cups in &mut self.cups {
            cups.held = cups.held.filter(|(held, _)| *held != slot);
        }
        let tally = &mut self.tally;
        self.parts.remove(slot, &mut |part| tally.removed(&part));
        true
    }
}
