//! Bays: the world outside, which puts parts on belts and takes them off.

use super::contact::overlap;
use super::part::{Slot, Support};
use super::{BeltBody, Floor};
use crate::device::{Load, Place, Sink, Source};
use crate::kinematics::{Along, Block, DVec2, DVec3, Upright};
use crate::plant::PartKind;

/// A loading bay.
#[derive(Clone, Debug)]
pub(in crate::engine) struct Bay {
    pub belt: usize,
    /// What it puts there; its due instants are those of this step.
    pub source: Source,
    /// How many parts it has put there, their loads apart.
    pub made: u64,
}

/// An unloading bay.
#[derive(Clone, Debug)]
pub(in crate::engine) struct Drain {
    pub name: String,
    pub belt: usize,
    pub sink: Sink,
}

/// From where to where on a belt a part's centre came in a step, and which way the belt moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    pub before: f64,
    pub station: f64,
    pub forwards: bool,
}

impl Floor {
    /// Puts the parts that fell due in this step, which was `seconds` long.
    pub(in crate::engine) fn put(&mut self, seconds: f64) {
        for index in 0..self.bays.len() {
            for due in 0..self.bays[index].source.due.len() {
                let bay = &self.bays[index];
                if bay.source.limit.is_some_and(|limit| bay.made >= limit) {
                    break;
                }
                let ago = bay.source.due[due];
                let Some(slot) = self.put_one(index) else { continue };
                self.bays[index].made += 1;
                self.catch_up(slot, self.bays[index].belt, if seconds > 0.0 { ago / seconds } else { 0.0 });
            }
        }
    }

    /// Puts one part and its load, if the place is free.
    fn put_one(&mut self, index: usize) -> Option<Slot> {
        let Bay { belt, source, .. } = &self.bays[index];
        let (belt, kind, load) = (*belt, source.kind, source.load);
        let surface = &self.belts[belt].surface;
        let [station, offset] = source.at;
        let (place, heading) = surface.at(Along { station, offset });
        let upright = Upright { place: place.extend(surface.height()), yaw: heading + source.turn };
        let block = Block::new(DVec3::from_array(source.size), upright);
        let stack = load.map(|load| stacked(&load, &block)).unwrap_or_default();
        if !self.is_free(&block) || !stack.iter().all(|block| self.is_free(block)) {
            return None;
        }
        let slot = self.enter(kind, block, Support::Belt(belt));
        if let Some(load) = load {
            let layer = (load.counts[0] * load.counts[1]) as usize;
            let mut slots = Vec::with_capacity(stack.len());
            for (place, block) in stack.into_iter().enumerate() {
                let below = if place < layer { slot } else { slots[place - layer] };
                slots.push(self.enter(load.kind, block, Support::Part(below)));
            }
        }
        Some(slot)
    }

    /// Lets a part in and counts it.
    pub(in crate::engine) fn enter(&mut self, kind: PartKind, block: Block, support: Support) -> Slot {
        self.tally.entered(kind);
        self.parts.insert(kind, block, support)
    }

    /// Whether nothing is where `block` is to be put.
    pub(in crate::engine) fn is_free(&self, block: &Block) -> bool {
        let by_parts = self.parts.iter().any(|(_, part)| overlap(block, &part.block));
        !by_parts && !self.plates.iter().any(|plate| overlap(block, &plate.block))
    }

    /// A part that came `share` of a step before its end has moved with the belt since; unless it would run into something.
    fn catch_up(&mut self, slot: Slot, belt: usize, share: f64) {
        let body = &self.belts[belt];
        let from = self.parts.get(slot).block.upright();
        let centre = from.place.truncate();
        let motion = body.surface.carry(centre, body.displacement * share);
        if motion.is_none() {
            return;
        }
        self.parts.move_by(slot, motion);
        let mut meets = false;
        self.parts.visit_group(slot, &mut |_, part| meets |= self.meets_another(slot, &part.block));
        if meets {
            self.parts.move_to(slot, from);
        } else {
            self.rest_part(slot, belt, centre);
        }
    }

    /// Whether `block`, of the group of `root`, is in a part of another group or in a plate.
    fn meets_another(&self, root: Slot, block: &Block) -> bool {
        let others = self.parts.iter().filter(|(other, _)| self.parts.root_of(*other) != root);
        others.into_iter().any(|(_, part)| overlap(block, &part.block))
            || self.plates.iter().any(|plate| overlap(block, &plate.block))
    }

    /// Gives a part to the bay whose place it has come to or passed, if there is one. Returns whether it has gone for good.
    pub(super) fn take(&mut self, slot: Slot, belt: usize, passage: Passage) -> bool {
        let kind = self.parts.get(slot).kind;
        let BeltBody { surface, drains, .. } = &self.belts[belt];
        let matching = |index: &&usize| {
            let Sink { place, kind: taken, .. } = self.drains[**index].sink;
            taken.is_none_or(|wanted| wanted == kind) && has_come(place, surface.length(), passage)
        };
        let Some(&sink) = drains.iter().find(matching) else { return false };
        let left = self.drains[sink].sink.delay;
        if left > 0.0 {
            self.parts.set_support(slot, Support::Sink { sink, left });
        } else {
            self.let_go(slot);
        }
        true
    }

    /// Lets the parts go that have stayed at an unloading bay for its time.
    pub(super) fn drain(&mut self, seconds: f64) {
        let staying = |slot: &Slot| matches!(self.parts.get(*slot).support, Support::Sink { .. });
        let slots: Vec<Slot> = self.parts.roots().iter().copied().filter(staying).collect();
        for slot in slots {
            let Support::Sink { sink, left } = self.parts.get(slot).support else { continue };
            if left <= seconds {
                self.let_go(slot);
            } else {
                self.parts.set_support(slot, Support::Sink { sink, left: left - seconds });
            }
        }
    }
}

/// Whether a part has come to the place of a bay on a belt of `length`.
fn has_come(place: Place, length: f64, passage: Passage) -> bool {
    let Passage { before, station, forwards } = passage;
    match place {
        Place::End => forwards && station >= length,
        Place::Start => !forwards && station <= 0.0,
        Place::At(at) => (before < at && station >= at) || (before > at && station <= at),
    }
}

/// The blocks of a load on `carrier`: layer by layer, in a layer row by row along the carrier.
fn stacked(load: &Load, carrier: &Block) -> Vec<Block> {
    let size = DVec3::from_array(load.size);
    let [rows, columns, layers] = load.counts;
    let centred =
        |index: u32, count: u32, side: f64| (f64::from(index) - f64::from(count - 1) / 2.0) * (side + load.gap);
    let base = carrier.upright();
    let mut blocks = Vec::new();
    for layer in 0..layers {
        for row in 0..rows {
            for column in 0..columns {
                let arm = DVec2::new(centred(row, rows, size.x), centred(column, columns, size.y));
                let place = base.place.truncate() + DVec2::from_angle(base.yaw).rotate(arm);
                let height = carrier.top() + f64::from(layer) * size.z;
                blocks.push(Block::new(size, Upright { place: place.extend(height), yaw: base.yaw }));
            }
        }
    }
    blocks
}
