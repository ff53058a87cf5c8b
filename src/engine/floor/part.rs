//! Parts: boxes and pallets, what each stands on, and what stands on it.

use crate::device::law::follower::{Slider, Stretch};
use crate::kinematics::{Block, Bounds, Motion, Upright};
use crate::plant::PartKind;

/// More than the sums of all ways are rounded by, m: what may be passed over is so much less than what was found.
pub(super) const ROUNDING_M: f64 = 1e-9;

/// A part's place in the store. Places are taken again when a part has gone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(in crate::engine) struct Slot(u32);

impl Slot {
    /// Its index in the store.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a part stands on or hangs from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::engine) enum Support {
    /// The belt of this index, which carries most of its footprint.
    Belt(usize),
    /// Another part, which takes it along.
    Part(Slot),
    /// The cups of this index.
    Cups(usize),
    /// It has reached an unloading bay and stays for so many more seconds.
    Sink { sink: usize, left: f64 },
}

/// A part.
#[derive(Clone, Debug)]
pub(in crate::engine) struct Part {
    /// Counted from 1 in the order in which parts came in; never given twice.
    pub number: u64,
    pub kind: PartKind,
    pub block: Block,
    pub support: Support,
    /// What stands on it, in the order it was put there.
    pub riders: Vec<Slot>,
    /// The world's box about it and all that stands on it.
    pub reach: Bounds,
    /// Where its group may move without waking anybody that it has not woken.
    pub cleared: Bounds,
    /// How it slides on the belt that bears it.
    pub slider: Slider,
    /// How much further than that belt it goes in this step, m.
    pub slid: f64,
    /// How far any of its points may still move until it has to be looked at what bears it, m.
    pub secure: f64,
    /// In which of the floor's steps it moved last, and how far any of its points has moved in that at most, m.
    last_moved: (u64, f64),
}

/// All parts.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct Parts {
    slots: Vec<Option<Part>>,
    free: Vec<Slot>,
    /// Parts that stand on no other part, in the order of their slots.
    roots: Vec<Slot>,
    last_number: u64,
    /// Which step of the floor it is.
    step: u64,
    /// How far a point of any part has moved at most: in all steps before this one, and in this one, m.
    travelled: [f64; 2],
    /// Where something has come, gone or moved that was not cleared.
    pub stirred: Vec<Bounds>,
}

impl Parts {
    /// Puts a part in. What it stands on learns of it.
    pub fn insert(&mut self, kind: PartKind, block: Block, support: Support) -> Slot {
        self.last_number += 1;
        let reach = *block.bounds();
        let cleared = Bounds::EMPTY;
        let part = Part {
            number: self.last_number,
            kind,
            block,
            support,
            riders: Vec::new(),
            reach,
            cleared,
            slider: Slider::default(),
            slid: 0.0,
            secure: 0.0,
            last_moved: (self.step, 0.0),
        };
        self.stirred.push(reach);
        let slot = match self.free.pop() {
            Some(slot) => slot,
            None => {
                self.slots.push(None);
                Slot(self.slots.len() as u32 - 1)
            }
        };
        self.slots[slot.0 as usize] = Some(part);
        self.join(slot, support);
        slot
    }

    /// Takes a part out, with all that stands on it; hands each to `gone`.
    pub fn remove(&mut self, slot: Slot, gone: &mut dyn FnMut(Part)) {
        self.leave(slot);
        self.stirred.push(self.get(slot).reach);
        self.drop_group(slot, gone);
    }

    fn drop_group(&mut self, slot: Slot, gone: &mut dyn FnMut(Part)) {
        let Some(part) = self.slots[slot.0 as usize].take() else { return };
        self.free.push(slot);
        for &rider in &part.riders {
            self.drop_group(rider, gone);
        }
        gone(part);
    }

    /// Lets a part stand on something else.
    pub fn set_support(&mut self, slot: Slot, support: Support) {
        self.leave(slot);
        let part = self.get_mut(slot);
        part.support = support;
        (part.slider, part.slid) = (Slider::default(), 0.0);
        part.secure = 0.0;
        self.join(slot, support);
    }

    /// How the part in `slot` slides while the belt that bears it, where friction gives it at most `grip`, does a stretch.
    pub fn slide(&mut self, slot: Slot, grip: f64, stretch: &Stretch) {
        let part = self.get_mut(slot);
        part.slid = part.slider.ride(grip, stretch) - stretch.way;
    }

    fn join(&mut self, slot: Slot, support: Support) {
        if let Support::Part(below) = support {
            self.get_mut(below).riders.push(slot);
            self.update_reach(below);
        } else if let Err(place) = self.roots.binary_search(&slot) {
            self.roots.insert(place, slot);
        }
    }

    fn leave(&mut self, slot: Slot) {
        if let Support::Part(below) = self.get(slot).support {
            self.get_mut(below).riders.retain(|rider| *rider != slot);
            self.update_reach(below);
        } else if let Ok(place) = self.roots.binary_search(&slot) {
            self.roots.remove(place);
        }
    }

    /// Renews the bounds of a group, from `slot` down to its root.
    fn update_reach(&mut self, slot: Slot) {
        let part = self.get(slot);
        let mut reach = *part.block.bounds();
        for &rider in &part.riders {
            reach = reach.merged(self.get(rider).reach);
        }
        let below = part.support;
        self.get_mut(slot).reach = reach;
        if let Support::Part(below) = below {
            self.update_reach(below);
        }
    }

    /// Whether there is a part in `slot`.
    pub fn is_there(&self, slot: Slot) -> bool {
        self.slots[slot.0 as usize].is_some()
    }

    /// The part in `slot`. Slots are kept only while their part is there.
    pub fn get(&self, slot: Slot) -> &Part {
        match &self.slots[slot.0 as usize] {
            Some(part) => part,
            None => unreachable!("a slot outlived its part"),
        }
    }

    fn get_mut(&mut self, slot: Slot) -> &mut Part {
        match &mut self.slots[slot.0 as usize] {
            Some(part) => part,
            None => unreachable!("a slot outlived its part"),
        }
    }

    /// The floor's next step begins.
    pub fn begin_step(&mut self) {
        self.step += 1;
        self.travelled = [self.travelled[0] + self.travelled[1], 0.0];
    }

    /// A bound of how far any point of any part has moved since the beginning, m: what is further from all parts than this has
    /// grown since is still not reached by any.
    pub fn travelled(&self) -> f64 {
        self.travelled[0] + self.travelled[1]
    }

    /// How many parts there have ever been.
    pub fn arrivals(&self) -> u64 {
        self.last_number
    }

    /// What bears a part need not be looked at until one of its points has moved so far, m.
    pub fn secure(&mut self, slot: Slot, way: f64) {
        self.get_mut(slot).secure = way - ROUNDING_M;
    }

    /// Every part has to be looked at.
    pub fn forget(&mut self) {
        self.slots.iter_mut().flatten().for_each(|part| part.secure = 0.0);
    }

    /// From now on the group of `slot` may move in `region` without waking anybody.
    pub fn clear(&mut self, slot: Slot, region: Bounds) {
        self.get_mut(slot).cleared = region;
    }

    /// From now on nobody may move anywhere without asking.
    pub fn clear_none(&mut self) {
        self.slots.iter_mut().flatten().for_each(|part| part.cleared = Bounds::EMPTY);
    }

    /// All parts, in the order of their slots.
    pub fn iter(&self) -> impl Iterator<Item = (Slot, &Part)> {
        (0u32..).map(Slot).zip(&self.slots).filter_map(|(slot, part)| Some((slot, part.as_ref()?)))
    }

    /// The parts that stand on no other part.
    pub fn roots(&self) -> &[Slot] {
        &self.roots
    }

    /// The part that a part stands on in the end, perhaps itself.
    pub fn root_of(&self, slot: Slot) -> Slot {
        match self.get(slot).support {
            Support::Part(below) => self.root_of(below),
            _ => slot,
        }
    }

    /// Shows a part and all that stands on it.
    pub fn visit_group(&self, slot: Slot, visit: &mut dyn FnMut(Slot, &Part)) {
        let part = self.get(slot);
        visit(slot, part);
        for &rider in &part.riders {
            self.visit_group(rider, visit);
        }
    }

    /// Moves a part and all that stands on it; the turn is about its own centre.
    pub fn move_by(&mut self, slot: Slot, motion: Motion) {
        let centre = self.get(slot).block.upright().place.truncate();
        self.relocate(slot, &|upright| upright.moved(motion, centre));
    }

    /// Moves a part to `goal`, and what stands on it with it.
    pub fn move_to(&mut self, slot: Slot, goal: Upright) {
        let from = self.get(slot).block.upright();
        let centre = from.place.truncate();
        let motion = Motion { shift: goal.place.truncate() - centre, turn: goal.yaw - from.yaw };
        let rise = goal.place.z - from.place.z;
        self.relocate(slot, &|upright| {
            let mut moved = upright.moved(motion, centre);
            moved.place.z += rise;
            moved
        });
    }

    fn relocate(&mut self, slot: Slot, way: &dyn Fn(Upright) -> Upright) {
        let from = self.get(slot).reach;
        let reach = self.relocate_group(slot, way);
        if !self.get(slot).cleared.holds(&reach) {
            self.stirred.push(from.merged(reach));
        }
        if let Support::Part(below) = self.get(slot).support {
            self.update_reach(below);
        }
    }

    fn relocate_group(&mut self, slot: Slot, way: &dyn Fn(Upright) -> Upright) -> Bounds {
        let step = self.step;
        let part = self.get_mut(slot);
        let before = part.block.upright();
        let after = way(before);
        part.block.move_to(after);
        // No point moves further than the centre and than the turn takes the furthest corner.
        let shift = (after.place - before.place).abs();
        let moved = shift.x + shift.y + shift.z + (after.yaw - before.yaw).abs() * part.block.radius();
        part.secure -= moved;
        let so_far = if part.last_moved.0 == step { part.last_moved.1 } else { 0.0 };
        part.last_moved = (step, so_far + moved);
        let mut reach = *part.block.bounds();
        self.travelled[1] = self.travelled[1].max(so_far + moved);
        for index in 0..self.get(slot).riders.len() {
            let rider = self.get(slot).riders[index];
            reach = reach.merged(self.relocate_group(rider, way));
        }
        self.get_mut(slot).reach = reach;
        reach
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::kinematics::{DVec2, DVec3};

    fn block(x: f64, z: f64) -> Block {
        Block::new(DVec3::splat(0.2), Upright::new(x, 0.0, z, 0.0))
    }

    fn stack() -> (Parts, Slot, Slot, Slot) {
        let mut parts = Parts::default();
        let pallet = parts.insert(PartKind::Pallet, block(0.0, 0.0), Support::Belt(0));
        let lower = parts.insert(PartKind::Box, block(0.5, 0.2), Support::Part(pallet));
        let upper = parts.insert(PartKind::Box, block(0.5, 0.4), Support::Part(lower));
        (parts, pallet, lower, upper)
    }

    #[test]
    fn what_stands_on_a_part_goes_with_it() {
        let (mut parts, pallet, _, upper) = stack();
        parts.move_by(pallet, Motion { shift: DVec2::new(1.0, 0.0), turn: FRAC_PI_2 });
        let place = parts.get(upper).block.upright().place;
        assert!((place - DVec3::new(1.0, 0.5, 0.4)).length() < 1e-12, "{place}");
        assert!((parts.get(pallet).reach.high - DVec3::new(1.1, 0.6, 0.6)).length() < 1e-12);
    }

    #[test]
    fn a_part_taken_away_takes_its_riders_and_frees_their_slots() {
        let (mut parts, pallet, lower, _) = stack();
        let mut gone = Vec::new();
        parts.remove(lower, &mut |part| gone.push(part.number));
        assert_eq!(gone, [3, 2]);
        assert_eq!(parts.get(pallet).riders, []);
        assert_eq!(parts.get(pallet).reach, *parts.get(pallet).block.bounds());
        let next = parts.insert(PartKind::Box, block(3.0, 0.0), Support::Belt(0));
        assert_eq!(parts.get(next).number, 4);
        assert_eq!(parts.iter().count(), 2);
    }

    #[test]
    fn lifting_a_part_makes_it_a_root() {
        let (mut parts, pallet, lower, upper) = stack();
        assert_eq!(parts.roots(), [pallet]);
        parts.set_support(lower, Support::Cups(0));
        assert_eq!(parts.roots(), [pallet, lower]);
        assert_eq!((parts.root_of(upper), parts.root_of(pallet)), (lower, pallet));
    }
}
