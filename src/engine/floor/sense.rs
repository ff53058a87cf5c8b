//! What devices learn of the parts about them.

use super::Floor;
use super::part::{Slot, Support};
use crate::device::Surroundings;
use crate::kinematics::Beam;

impl Floor {
    /// What a conveyor senses.
    pub(in crate::engine) fn at_belt(&self, index: usize) -> Surroundings {
        let [barrier_a, barrier_b] = self.belts[index].beams.map(|beam| self.is_cut(beam));
        Surroundings { barrier_a, barrier_b, ..Surroundings::default() }
    }

    /// What a pusher senses.
    pub(in crate::engine) fn at_plate(&self, index: usize) -> Surroundings {
        let [barrier_a, barrier_b] = self.plates[index].beams.map(|beam| self.is_cut(beam));
        Surroundings { barrier_a, barrier_b, ..Surroundings::default() }
    }

    /// What a gripper senses.
    pub(in crate::engine) fn about_cups(&self, index: usize) -> Surroundings {
        let sealed = self.cups[index].always_sealed || self.at_cups(index).is_some();
        Surroundings { sealed, ..Surroundings::default() }
    }

    /// How many parts a belt carries, those that stand on others apart, and how many of them were held back in this step.
    pub(in crate::engine) fn load_of_belt(&self, index: usize) -> (u32, u32) {
        let is_there =
            |slot: &Slot| self.parts.is_there(*slot) && self.parts.get(*slot).support == Support::Belt(index);
        let parts = self.parts.roots().iter().filter(|slot| is_there(slot)).count();
        let queued = self.carried.held_back().filter(is_there).count();
        (parts as u32, queued as u32)
    }

    /// How many of these cups hold a part, or one that the model leaves out.
    pub(in crate::engine) fn held_by(&self, cups: &[usize]) -> u32 {
        let holds = |index: &&usize| {
            let cups = &self.cups[**index];
            cups.held.is_some() || (cups.vacuum && cups.always_sealed)
        };
        cups.iter().filter(holds).count() as u32
    }

    fn is_cut(&self, beam: Option<Beam>) -> bool {
        let Some(beam) = beam else { return false };
        self.parts.roots().iter().any(|&root| {
            if !beam.bounds().meet(&self.parts.get(root).reach) {
                return false;
            }
            let mut is_cut = false;
            self.parts.visit_group(root, &mut |_, part| is_cut = is_cut || beam.is_cut_by(&part.block));
            is_cut
        })
    }
}
