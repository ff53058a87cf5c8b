//! Cups hold parts: a part that hangs from them follows them rigidly, and rests on what is beneath when it is let go.

use super::Floor;
use super::part::{Slot, Support};
use crate::kinematics::Upright;

impl Floor {
    /// Moves what hangs from cups to where they are now, takes what is sealed where there is vacuum, lets go where there is
    /// none any more.
    pub(super) fn hold(&mut self) {
        for awake in 0..self.awake_cups.len() {
            let index = self.awake_cups[awake];
            let cups = &self.cups[index];
            match cups.held {
                Some((slot, pose)) if cups.vacuum => self.follow(slot, Upright::from_pose(&(cups.rim * pose))),
                Some((slot, pose)) => {
                    self.follow(slot, Upright::from_pose(&(cups.rim * pose)));
                    self.cups[index].held = None;
                    self.settle(slot);
                }
                None if cups.vacuum => self.grasp(index),
                None => {}
            }
        }
    }

    fn follow(&mut self, slot: Slot, goal: Upright) {
        if self.parts.get(slot).block.upright() != goal {
            self.parts.move_to(slot, goal);
            self.handled.push(slot);
        }
    }

    fn grasp(&mut self, index: usize) {
        let Some(slot) = self.at_cups(index) else { return };
        let root = self.parts.root_of(slot);
        if matches!(self.parts.get(root).support, Support::Cups(_)) {
            return;
        }
        let pose = self.cups[index].rim.inv_mul(&self.parts.get(slot).block.upright().pose());
        self.parts.set_support(slot, Support::Cups(index));
        self.cups[index].held = Some((slot, pose));
    }

    /// The part that is sealed at the cups: the one that hangs there, else the highest whose top is below the rim's middle,
    /// no further than the cups reach. Cups give: a rim pressed in by no more than that is sealed as well.
    pub(super) fn at_cups(&self, index: usize) -> Option<Slot> {
        let cups = &self.cups[index];
        if let Some((slot, _)) = cups.held {
            return Some(slot);
        }
        let rim = cups.rim.translation;
        let mut best: Option<(f64, Slot)> = None;
        for (slot, part) in self.parts.iter() {
            let top = part.block.top();
            let is_sealed = (rim.z - top).abs() <= cups.reach && part.block.is_over(rim.truncate());
            if is_sealed && best.is_none_or(|(height, _)| top > height) {
                best = Some((top, slot));
            }
        }
        best.map(|(_, slot)| slot)
    }
}
