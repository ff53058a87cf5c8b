//! What devices learn of the parts about them.

use std::cell::Cell;

use super::Floor;
use super::part::{ROUNDING_M, Slot, Support};
use crate::device::Surroundings;
use crate::kinematics::Beam;

/// Until when a beam need not be looked at, because every part is far from it.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct Clear {
    /// What the parts' [`travelled`](super::part::Parts::travelled) has to come to, and how many there were.
    until: Cell<(f64, u64)>,
}

impl Floor {
    /// What a conveyor senses.
    pub(in crate::engine) fn at_belt(&self, index: usize) -> Surroundings {
        let belt = &self.belts[index];
        let [barrier_a, barrier_b] = [0, 1].map(|beam| self.is_cut(belt.beams[beam], &belt.clear[beam]));
        Surroundings { barrier_a, barrier_b, ..Surroundings::default() }
    }

    /// What a pusher senses.
    pub(in crate::engine) fn at_plate(&self, index: usize) -> Surroundings {
        let plate = &self.plates[index];
        let [barrier_a, barrier_b] = [0, 1].map(|beam| self.is_cut(plate.beams[beam], &plate.clear[beam]));
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

    fn is_cut(&self, beam: Option<Beam>, clear: &Clear) -> bool {
        let Some(beam) = beam else { return false };
        let (travelled, arrivals) = (self.parts.travelled(), self.parts.arrivals());
        let (until, known) = clear.until.get();
        if travelled < until && arrivals == known {
            return false;
        }
        let mut gap = f64::INFINITY;
        for &root in self.parts.roots() {
            let away = beam.bounds().gap(&self.parts.get(root).reach);
            gap = gap.min(away);
            if away > 0.0 {
                continue;
            }
            let mut is_cut = false;
            self.parts.visit_group(root, &mut |_, part| is_cut = is_cut || beam.is_cut_by(&part.block));
            if is_cut {
                return true;
            }
        }
        clear.until.set((travelled + gap - ROUNDING_M, arrivals));
        false
    }
}
