//! Plates push the parts they meet, and those push the next.
//!
//! A plate does not give way: its law knows no load. Everything before it moves in its direction, no further than it moved
//! itself; what is crushed between two plates is counted as a collision. Who pushes is not pushed back by whom it pushes: two
//! parts that are in one another already stay so.

use super::Floor;
use super::contact::{nearest_contact, overlap};
use super::part::{Slot, Support};
use crate::kinematics::{Block, DVec2, Motion, separation};

/// How often a part gives way in one step at most.
const MOST_PUSHES: usize = 4;

impl Floor {
    /// Moves what the plates met in this step.
    pub(super) fn push(&mut self) {
        for awake in 0..self.awake_plates.len() {
            let index = self.awake_plates[awake];
            let plate = &self.plates[index];
            let before = self.handled.len();
            if plate.displacement != 0.0 {
                let way = plate.direction * plate.displacement;
                let block = plate.block;
                self.push_from(&block, &mut Vec::new(), way);
            }
            let mut pushed: Vec<Slot> = self.handled[before..].iter().map(|slot| self.parts.root_of(*slot)).collect();
            pushed.sort_unstable();
            pushed.dedup();
            self.plates[index].pushed = pushed.len() as u32;
        }
    }

    /// Pushes all parts that are in `pusher` along `way`, until they are clear of it, and those they push in their turn. `chain`
    /// holds who pushes `pusher`, back to the plate.
    fn push_from(&mut self, pusher: &Block, chain: &mut Vec<Slot>, way: DVec2) {
        // Those nearest to where the push comes from move first, so that each is moved once in a row of several.
        let mut met: Vec<(f64, Slot)> = self
            .parts
            .iter()
            .filter(|(slot, part)| self.can_be_pushed(*slot, chain) && overlap(pusher, &part.block))
            .map(|(slot, part)| (part.block.upright().place.truncate().dot(way), slot))
            .collect();
        met.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (_, slot) in met {
            let block = self.parts.get(slot).block;
            // It may have been moved by one of the others meanwhile; in a clump it is not moved on and on.
            let moved = self.handled.iter().filter(|handled| **handled == slot).count();
            if !overlap(pusher, &block) || moved >= MOST_PUSHES {
                continue;
            }
            let apart = |share: f64| {
                let mut moved = block;
                moved.move_to(block.upright().moved(Motion { shift: way * share, turn: 0.0 }, DVec2::ZERO));
                separation(pusher, &moved).0
            };
            // Moved by the whole way it stands to the pusher as it did before, where it was clear of it.
            let share = if apart(1.0) < 0.0 { 1.0 } else { nearest_contact(1.0, 0.0, apart) };
            self.parts.move_by(slot, Motion { shift: way * share, turn: 0.0 });
            self.handled.push(slot);
            let root = self.parts.root_of(slot);
            if root != slot {
                self.handled.push(root);
            }
            let mut blocks = Vec::new();
            self.parts.visit_group(slot, &mut |_, part| blocks.push(part.block));
            chain.push(root);
            for block in blocks {
                self.push_from(&block, chain, way);
            }
            chain.pop();
        }
    }

    /// Whether a part gives way to a plate, or to the last of a `chain` of parts that push one another: not what hangs from cups,
    /// and nothing of the groups that push.
    fn can_be_pushed(&self, slot: Slot, chain: &[Slot]) -> bool {
        let root = self.parts.root_of(slot);
        let is_held = matches!(self.parts.get(root).support, Support::Cups(_));
        !is_held && chain.iter().all(|pushes| root != self.parts.root_of(*pushes))
    }
}
