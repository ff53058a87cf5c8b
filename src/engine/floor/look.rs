//! What sensors that look at parts see.

use super::Floor;
use crate::device::{Look, Sensed};
use crate::kinematics::{Beam, Block, DPose3, DVec3, TOUCH_M, Upright, separation};

/// A sensor, as the floor has it.
#[derive(Clone, Debug)]
pub(in crate::engine) enum Eye {
    /// Sees what is in a box, touching it not counted.
    Box(Block),
    /// Sees what is on a way of so many metres.
    Ray(Beam, f64),
}

impl Eye {
    /// What `look` is to a sensor whose frame is at `pose`.
    pub fn new(look: &Look, pose: &DPose3) -> Eye {
        match *look {
            Look::Box { centre, size } => {
                let bottom = DVec3::from_array(centre) - DVec3::new(0.0, 0.0, size[2] / 2.0);
                let place = *pose * DPose3::from_translation(bottom);
                Eye::Box(Block::new(DVec3::from_array(size), Upright::from_pose(&place)))
            }
            Look::Ray { range } => {
                let end = pose.transform_point(DVec3::new(range, 0.0, 0.0));
                Eye::Ray(Beam::new(pose.translation, end), range)
            }
        }
    }
}

impl Floor {
    /// What the sensor of this index sees.
    pub(in crate::engine) fn seen_by(&self, index: usize) -> Sensed {
        let eye = &self.eyes[index];
        let bounds = match eye {
            Eye::Box(block) => block.bounds(),
            Eye::Ray(beam, _) => beam.bounds(),
        };
        let mut sensed = Sensed::default();
        let mut nearest = f64::INFINITY;
        for &root in self.parts.roots() {
            if !bounds.meet(&self.parts.get(root).reach) {
                continue;
            }
            self.parts.visit_group(root, &mut |_, part| {
                let distance = match eye {
                    Eye::Box(block) if separation(block, &part.block).0 < -TOUCH_M => {
                        Some((block.centre() - part.block.centre()).length())
                    }
                    Eye::Box(_) => None,
                    Eye::Ray(beam, range) => beam.way_to(&part.block).map(|share| share * range),
                };
                let Some(distance) = distance else { return };
                sensed.count += 1;
                if distance < nearest {
                    nearest = distance;
                    sensed.nearest = Some(part.kind);
                    sensed.distance = Some(distance);
                }
            });
        }
        sensed
    }
}
