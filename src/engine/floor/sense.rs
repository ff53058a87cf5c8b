//! What devices learn of the parts about them.

use super::Floor;
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
