//! What parts stand on: belts change, parts leave at a belt's end, fall where nothing is beneath.

use super::Floor;
use super::bays::Passage;
use super::part::{Slot, Support};
use crate::kinematics::{Along, Block, DVec2};

/// Within what height two faces are one level, m.
const LEVEL_M: f64 = 1e-3;

/// A part falls when no more than this share of its bottom face stands on anything: its centre has passed the edge.
const LEAST_SHARE: f64 = 0.5 - 1e-9;

/// What stands on less than this, m², stands beside it: two boxes 0.3 m long that touch share less.
const SLIVER_M2: f64 = 1e-6;

impl Floor {
    /// The belts that bear `block`, with the area of it that is over each, m²; `belt`, the one it stood on, first.
    pub(super) fn standing(&self, block: &Block, belt: usize) -> Vec<(usize, f64)> {
        let own = &self.belts[belt];
        let mut standing = vec![(belt, own.surface.area_under(block))];
        for &index in &own.neighbours {
            let area = self.belts[index].surface.area_under(block);
            if area > 0.0 {
                standing.push((index, area));
            }
        }
        standing
    }

    /// After parts have moved: takes off those at unloading bays, lets go those past an open end, finds for the others the
    /// belt that carries most of them.
    pub(super) fn rest(&mut self, seconds: f64) {
        for body in 0..self.carried.bodies.len() {
            let Some((slot, from)) = self.carried.moved_group(body) else { continue };
            if let Support::Belt(belt) = self.parts.get(slot).support {
                self.rest_part(slot, belt, from);
            }
        }
        // What a plate pushed along on another part may have come off it.
        for index in 0..self.handled.len() {
            let slot = self.handled[index];
            if self.parts.is_there(slot) && matches!(self.parts.get(slot).support, Support::Part(_)) {
                self.settle(slot);
            }
        }
        self.drain(seconds);
    }

    /// Finds out what becomes of a part that `belt` moved from where its centre was to where it is.
    pub(super) fn rest_part(&mut self, slot: Slot, belt: usize, from: DVec2) {
        let part = self.parts.get(slot);
        let has_drains = !self.belts[belt].drains.is_empty();
        if part.secure > 0.0 && !has_drains {
            return;
        }
        let surface = &self.belts[belt].surface;
        let Along { station, offset } = surface.locate(part.block.upright().place.truncate());
        let forwards = self.belts[belt].displacement + part.slid >= 0.0;
        if self.take(slot, belt, Passage { before: surface.locate(from).station, station, forwards }) {
            return;
        }
        let block = &self.parts.get(slot).block;
        let surface = &self.belts[belt].surface;
        let margin = surface.margin_of(block);
        if margin >= 0.0 {
            self.parts.secure(slot, margin);
            return;
        }
        let [opens_at_start, opens_at_end] = self.belts[belt].open;
        let is_past = (opens_at_end && station > surface.length()) || (opens_at_start && station < 0.0);
        let standing = self.standing(block, belt);
        let best = standing.iter().fold(standing[0], |best, next| if next.1 > best.1 { *next } else { best });
        let total: f64 = standing.iter().map(|(_, area)| area).sum();
        if is_past && offset.abs() <= surface.width() / 2.0 && best.0 == belt {
            self.let_go(slot);
        } else if total < block.area() * LEAST_SHARE {
            self.lose(slot);
        } else if best.0 != belt {
            self.parts.set_support(slot, Support::Belt(best.0));
        } else if !opens_at_start && !opens_at_end {
            // Where each point moves by d, what of it is over a belt changes by less than twice its outline times d.
            let outline = 2.0 * block.outline();
            let others = standing[1..].iter().fold(0.0, |most: f64, (_, area)| most.max(*area));
            let lead = (best.1 - others) / (2.0 * outline);
            let rest = (total - block.area() * LEAST_SHARE) / (standing.len() as f64 * outline);
            self.parts.secure(slot, lead.min(rest));
        }
    }

    /// A part leaves the plant as it should, with all that stands on it.
    pub(super) fn let_go(&mut self, slot: Slot) {
        let tally = &mut self.tally;
        self.parts.remove(slot, &mut |part| tally.left(&part));
    }

    /// A part falls, with all that stands on it.
    fn lose(&mut self, slot: Slot) {
        let from = match self.parts.get(slot).support {
            Support::Belt(belt) => self.belts[belt].name.clone(),
            Support::Cups(cups) => self.cups[cups].name.clone(),
            Support::Part(below) => format!("part {}", self.parts.get(below).number),
            Support::Sink { sink, .. } => self.drains[sink].name.clone(),
        };
        let tally = &mut self.tally;
        self.parts.remove(slot, &mut |part| tally.lost(&part, &from));
    }

    /// Lets a part down onto the highest thing beneath it, at once; it falls where too little is there.
    pub(super) fn settle(&mut self, slot: Slot) {
        let block = self.parts.get(slot).block;
        let Some((height, support)) = self.beneath(&block, Some(slot)) else {
            self.lose(slot);
            return;
        };
        let mut upright = block.upright();
        upright.place.z = height;
        if self.parts.get(slot).support != support {
            self.parts.set_support(slot, support);
        }
        self.parts.move_to(slot, upright);
        self.handled.push(slot);
    }

    /// The highest level beneath `block`, and what of it carries most of the block; `None` where too little of it would stand
    /// there. The part of `own` and what stands on it is not asked.
    pub(in crate::engine) fn beneath(&self, block: &Block, own: Option<Slot>) -> Option<(f64, Support)> {
        let footprint = block.footprint();
        let bottom = block.upright().place.z + LEVEL_M;
        let mut found: Vec<(f64, f64, Support)> = Vec::new();
        for (index, belt) in self.belts.iter().enumerate() {
            let height = belt.surface.height();
            let area = if height <= bottom { belt.surface.area_under(block) } else { 0.0 };
            if area > SLIVER_M2 {
                found.push((height, area, Support::Belt(index)));
            }
        }
        for (other, part) in self.parts.iter() {
            let top = part.block.top();
            let (ours, theirs) = (block.bounds(), part.block.bounds());
            let is_near = top <= bottom && ours.low.x <= theirs.high.x && theirs.low.x <= ours.high.x;
            if !is_near || own.is_some_and(|own| self.stands_on(other, own)) {
                continue;
            }
            let area = footprint.clipped(&part.block.footprint()).area();
            if area > SLIVER_M2 {
                found.push((top, area, Support::Part(other)));
            }
        }
        let highest = found.iter().map(|(height, ..)| *height).fold(f64::NEG_INFINITY, f64::max);
        let level = || found.iter().filter(|(height, ..)| highest - height < LEVEL_M);
        let total: f64 = level().map(|(_, area, _)| area).sum();
        if total < block.area() * LEAST_SHARE {
            return None;
        }
        let best = level().fold(None::<&(f64, f64, Support)>, |best, next| match best {
            Some(best) if best.1 >= next.1 => Some(best),
            _ => Some(next),
        })?;
        Some((best.0, best.2))
    }

    /// Whether `slot` is `root` or stands on it.
    fn stands_on(&self, slot: Slot, root: Slot) -> bool {
        slot == root
            || match self.parts.get(slot).support {
                Support::Part(below) => self.stands_on(below, root),
                _ => false,
            }
    }
}
