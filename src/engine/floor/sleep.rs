//! Who sleeps: devices at rest with nothing moving near them are not visited until something comes near.

use std::collections::BTreeMap;

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::Bvh;

use super::Floor;
use super::part::Slot;
use crate::kinematics::{Bounds, DVec3, Motion};

/// How many steps like this one a part looks ahead when it asks whom it would wake.
const AHEAD: f64 = 100.0;
/// How far it looks at least, m.
const MARGIN_M: f64 = 0.02;

/// What a device is on the floor, for those whose lists the floor goes through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::engine) enum Listed {
    Not,
    Plate(usize),
    Cups(usize),
}

/// The devices that sleep, by the indices of their units.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct Sleepers {
    /// Where a part that moves wakes them.
    tree: Bvh,
    listed: BTreeMap<u32, Listed>,
    /// Who was woken by the floor, for the engine to learn of.
    pub woken: Vec<u32>,
}

impl Floor {
    /// Lets the device `unit` sleep until something moves in `region`; by nothing on the floor if that is empty.
    pub fn put_to_sleep(&mut self, unit: u32, region: Bounds, listed: Listed) {
        if region.low.cmple(region.high).all() {
            self.sleepers.tree.insert(Aabb::new(region.low, region.high), unit);
        }
        self.sleepers.listed.insert(unit, listed);
        match listed {
            Listed::Not => {}
            Listed::Plate(index) => self.awake_plates.retain(|awake| *awake != index),
            Listed::Cups(index) => self.awake_cups.retain(|awake| *awake != index),
        }
    }

    /// Puts a device back on the floor's lists.
    pub fn rouse(&mut self, unit: u32) {
        let Some(listed) = self.sleepers.listed.remove(&unit) else { return };
        self.sleepers.tree.remove(unit);
        let (list, index) = match listed {
            Listed::Not => return,
            Listed::Plate(index) => (&mut self.awake_plates, index),
            Listed::Cups(index) => (&mut self.awake_cups, index),
        };
        if let Err(place) = list.binary_search(&index) {
            list.insert(place, index);
        }
    }

    /// Wakes who sleeps in `region`.
    fn stir(&mut self, region: &Bounds) {
        if self.sleepers.listed.is_empty() {
            return;
        }
        let around = Aabb::new(region.low, region.high);
        let first = self.sleepers.woken.len();
        let Sleepers { tree, woken, .. } = &mut self.sleepers;
        woken.extend(tree.intersect_aabb(&around));
        for index in first..self.sleepers.woken.len() {
            self.rouse(self.sleepers.woken[index]);
        }
    }

    /// Wakes whom the group of `slot` comes near that is about to move by `motion` within `bounds`, and by the like for a while.
    pub(super) fn stir_ahead(&mut self, slot: Slot, bounds: &Bounds, motion: Motion) {
        if self.parts.get(slot).cleared.holds(bounds) {
            return;
        }
        let ahead = (motion.shift.abs() * AHEAD).extend(0.0) + DVec3::splat(MARGIN_M);
        let region = Bounds { low: bounds.low - ahead, high: bounds.high + ahead };
        self.stir(&region);
        self.parts.clear(slot, region);
    }

    /// Wakes who sleeps where something came, went or moved.
    pub fn stir_moved(&mut self) {
        while let Some(region) = self.parts.stirred.pop() {
            self.stir(&region);
        }
    }
}
