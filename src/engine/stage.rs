//! What the engine shows: the frames of a scene, moved by the devices' joints.

use std::sync::Arc;

use super::{Engine, Unit, UnitBody};
use crate::plant::Plant;
use crate::scene::{NodeId, Poses, Scene};

/// A scene that follows the devices.
pub(super) struct Stage {
    poses: Poses,
    /// Of each unit the frames of its joints, in the order in which it gives them; none where it has none.
    joints: Vec<Vec<Option<NodeId>>>,
    /// Of each beam of the scene: the unit that it belongs to, and whether it is its barrier A or B.
    beams: Vec<Option<(usize, usize)>>,
}

impl Stage {
    fn new(plant: &Plant, units: &[Unit], scene: Arc<Scene>) -> Stage {
        let of_unit: Vec<usize> =
            plant.instances.iter().enumerate().flat_map(|(index, it)| it.tasks.iter().map(move |_| index)).collect();
        let mut joints = Vec::with_capacity(units.len());
        for (index, unit) in units.iter().enumerate() {
            let instance = &plant.instances[of_unit[index]].name;
            let mut frames = Vec::new();
            unit.device.joints(&mut |name, _| frames.push(scene.find_joint(&format!("{instance}.{name}"))));
            joints.push(if frames.iter().any(Option::is_some) { frames } else { Vec::new() });
        }
        let unit_of = |instance: usize| {
            let has_beams = |unit: &usize| matches!(units[*unit].body, UnitBody::Belt(_) | UnitBody::Plate(_));
            (0..units.len()).filter(|unit| of_unit[*unit] == instance).find(has_beams)
        };
        let beams = scene
            .beams()
            .iter()
            .map(|beam| Some((unit_of(scene.node(beam.node).instance)?, usize::from(beam.name.ends_with('B')))))
            .collect();
        Stage { poses: Poses::new(scene), joints, beams }
    }

    pub fn poses(&self) -> &Poses {
        &self.poses
    }

    /// Follows these of the devices to where they are now.
    pub fn follow(&mut self, units: &[Unit], moved: &[u32]) {
        for &unit in moved {
            self.pose(unit as usize, |visit| units[unit as usize].device.joints(visit));
        }
        self.resolve();
    }

    /// Sets the joints of one device to what `give` hands out, in the order of [`Device::joints`](crate::device::Device::joints).
    pub fn pose(&mut self, unit: usize, give: impl FnOnce(&mut dyn FnMut(&'static str, f64))) {
        let frames = &self.joints[unit];
        if frames.is_empty() {
            return;
        }
        let mut frames = frames.iter();
        give(&mut |_, value| {
            if let Some(Some(frame)) = frames.next() {
                self.poses.set(*frame, value);
            }
        });
    }

    /// Computes the poses of what was set.
    pub fn resolve(&mut self) {
        self.poses.resolve();
    }
}

impl Engine {
    /// From now on `scene`, made of the same `plant`, follows the devices at each tick. Nothing that the engine computes
    /// depends on it.
    pub fn show(&mut self, plant: &Plant, scene: Arc<Scene>) {
        let mut stage = Stage::new(plant, &self.units, scene);
        let all: Vec<u32> = (0..self.units.len() as u32).collect();
        stage.follow(&self.units, &all);
        self.stage = Some(stage);
    }

    /// Where the frames of the scene are after the last tick; `None` where nothing is shown.
    pub fn poses(&self) -> Option<&Poses> {
        self.stage.as_ref().map(|stage| &stage.poses)
    }

    /// Whether something cuts them now, of the beams of the scene in their order; nothing where nothing is shown. It is what
    /// the beams see, before any effect in the way to the automation. Computed when it is asked.
    pub fn cut_beams(&self) -> impl Iterator<Item = bool> {
        let beams = self.stage.as_ref().map(|stage| stage.beams.as_slice()).unwrap_or_default();
        beams.iter().map(|beam| {
            let Some((unit, barrier)) = *beam else { return false };
            let seen = match self.units[unit].body {
                UnitBody::Belt(index) => self.floor.at_belt(index),
                UnitBody::Plate(index) => self.floor.at_plate(index),
                _ => return false,
            };
            [seen.barrier_a, seen.barrier_b][barrier]
        })
    }
}
