//! Belts carry parts, each as far as the others let it.
//!
//! All parts would move at once. Where two would come to be in one another, the one that runs into the other is held back to
//! contact, and whoever runs into *it* is held back in turn, until nobody is held back any more. Each part's share of its
//! motion only ever shrinks, and shrinks to what its neighbours leave it, so that the outcome is the same in whatever order
//! the pairs are looked at.

use super::contact::{self, Body, CONTACT_M, nearest_contact};
use super::part::{Part, Slot, Support};
use super::{BeltBody, Floor, Transfer};
use crate::device::law::follower::Stretch;
use crate::kinematics::{Bounds, DVec2, Motion, TOUCH_M};

/// A body of the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BodyId {
    /// A part that stands on no other, with all that stands on it.
    Group(Slot),
    /// A plate.
    Plate(usize),
}

/// A body and what it is about to do.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyState {
    pub id: BodyId,
    /// The number of its part; plates are counted from the top down.
    pub key: u64,
    /// Where its centre was before belts moved it.
    pub from: DVec2,
    /// The world's box about all the places it may be at in this step.
    bounds: Bounds,
    motion: Motion,
    /// The share of its motion that the others leave it.
    share: f64,
    /// Whether it moves, or has moved, in this step.
    moves: bool,
}

/// Lists that keep their room from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub bodies: Vec<BodyState>,
    /// Bodies that are so near each other that they may meet in this step, of which one at least moves.
    pub pairs: Vec<[usize; 2]>,
}

impl Scratch {
    /// The part of a body that moved in this step, and where its centre was before belts moved it.
    pub fn moved_group(&self, body: usize) -> Option<(Slot, DVec2)> {
        match self.bodies[body] {
            BodyState { id: BodyId::Group(slot), from, moves: true, .. } => Some((slot, from)),
            _ => None,
        }
    }

    /// The groups that the others kept from moving as far as they would have.
    pub fn held_back(&self) -> impl Iterator<Item = Slot> {
        self.bodies.iter().filter(|body| body.share < 1.0).filter_map(|body| match body.id {
            BodyId::Group(slot) => Some(slot),
            BodyId::Plate(_) => None,
        })
    }

    /// Whether the body of this key is there and does not move in this step. A plate that is not listed sleeps.
    pub fn rests(&self, key: u64) -> bool {
        match self.bodies.iter().find(|body| body.key == key) {
            Some(body) => !body.moves,
            None => key > u64::MAX / 2,
        }
    }
}

/// How much further than its motion a body's box is drawn, m: more than the sagitta of a step's arc.
const MARGIN_M: f64 = 1e-4;

impl Floor {
    /// Finds out how far parts slide on belts that change their speed too steeply for them.
    pub(super) fn slide(&mut self, seconds: f64) {
        if self.belts.iter().all(|belt| belt.grip.is_infinite()) {
            return;
        }
        for at in 0..self.parts.roots().len() {
            let slot = self.parts.roots()[at];
            if let Support::Belt(belt) = self.parts.get(slot).support {
                let BeltBody { grip, displacement: way, speeds, .. } = self.belts[belt];
                self.parts.slide(slot, grip, &Stretch { way, speeds, span: seconds });
            }
        }
    }

    /// Moves what stands on belts.
    pub(super) fn carry(&mut self) {
        let mut scratch = std::mem::take(&mut self.carried);
        self.gather(&mut scratch.bodies);
        for body in scratch.bodies.iter().filter(|body| body.moves) {
            if let BodyId::Group(slot) = body.id {
                self.stir_ahead(slot, &body.bounds, body.motion);
            }
        }
        self.gather_plates(&mut scratch.bodies);
        pair_up(&scratch.bodies, &mut scratch.pairs);
        self.hold_back(&mut scratch);
        for body in &scratch.bodies {
            if let BodyId::Group(slot) = body.id
                && body.share > 0.0
                && !body.motion.is_none()
            {
                let motion = if body.share < 1.0 { body.motion.scaled(body.share) } else { body.motion };
                self.parts.move_by(slot, motion);
            }
        }
        self.carried = scratch;
    }

    fn gather(&self, bodies: &mut Vec<BodyState>) {
        bodies.clear();
        for &slot in self.parts.roots() {
            let part = self.parts.get(slot);
            let motion = match part.support {
                Support::Belt(belt) => self.motion_of(slot, belt),
                _ => Motion::NONE,
            };
            // A turn moves the corners of a body by less than its own length times the angle.
            let sweep = motion.shift.length() + motion.turn.abs() * (part.reach.high - part.reach.low).length();
            let moves = !motion.is_none() || self.handled.contains(&slot);
            let bounds = part.reach.grown(sweep + MARGIN_M);
            let (id, key, from) = (BodyId::Group(slot), part.number, part.block.upright().place.truncate());
            bodies.push(BodyState { id, key, from, bounds, motion, share: 1.0, moves });
        }
    }

    /// Adds the plates; those that sleep are near nobody who moves.
    fn gather_plates(&self, bodies: &mut Vec<BodyState>) {
        for &index in &self.awake_plates {
            let plate = &self.plates[index];
            bodies.push(BodyState {
                id: BodyId::Plate(index),
                key: u64::MAX - index as u64,
                from: plate.block.upright().place.truncate(),
                bounds: plate.block.bounds().grown(MARGIN_M),
                motion: Motion::NONE,
                share: 1.0,
                moves: plate.displacement != 0.0,
            });
        }
    }

    /// How the part in `slot`, which stands on `belt`, is carried if nothing stands in its way.
    fn motion_of(&self, slot: Slot, belt: usize) -> Motion {
        let Part { block, slid, .. } = self.parts.get(slot);
        let centre = block.upright().place.truncate();
        let own = &self.belts[belt];
        // What the part slides, it slides on the belt that bears it.
        let way_of = |index: usize, bridges| self.way_of(index, if index == belt { *slid } else { 0.0 }, bridges);
        if own.transfer == Transfer::Share {
            let standing = self.standing(block, belt);
            let total: f64 = standing.iter().map(|(_, area)| area).sum();
            let mut motion = Motion::NONE;
            // A belt that carries nothing of it moves nothing of it; that rules a total of 0 out, too.
            let bridges = standing.iter().filter(|(_, area)| *area > 0.0).count() > 1;
            for &(index, area) in standing.iter().filter(|(_, area)| *area > 0.0) {
                let part = self.belts[index].surface.carry(centre, way_of(index, bridges));
                motion.shift += part.shift * (area / total);
                motion.turn += part.turn * (area / total);
            }
            return motion;
        }
        if own.displacement + slid == 0.0 {
            return Motion::NONE;
        }
        let bridges = own.transfer_slip > 0.0 && self.standing(block, belt).iter().any(|(at, _)| *at != belt);
        own.surface.carry(centre, way_of(belt, bridges))
    }

    /// How far a belt takes a part that stands on it, and on another if it `bridges`; that has `slid` on it by so much, m.
    fn way_of(&self, belt: usize, slid: f64, bridges: bool) -> f64 {
        let BeltBody { displacement, transfer_slip, .. } = self.belts[belt];
        let way = displacement + slid;
        if bridges { (1.0 - transfer_slip) * way } else { way }
    }

    /// The body of an id.
    pub(super) fn body(&self, id: BodyId) -> Body<'_> {
        match id {
            BodyId::Group(slot) => Body::Group(slot),
            BodyId::Plate(plate) => Body::Block(&self.plates[plate].block),
        }
    }

    /// Shrinks the shares until nobody runs into anybody.
    fn hold_back(&self, scratch: &mut Scratch) {
        // Every round settles at least the next part of a queue, so that there are no more rounds than parts.
        for _ in 0..=scratch.bodies.len() {
            let mut is_settled = true;
            for &[first, second] in &scratch.pairs {
                let pair = [scratch.bodies[first], scratch.bodies[second]];
                if let Some([a, b]) = self.shares(&pair) {
                    scratch.bodies[first].share = a;
                    scratch.bodies[second].share = b;
                    is_settled = false;
                }
            }
            if is_settled {
                return;
            }
        }
        // Not reached by any queue known; to stand still is always safe.
        scratch.bodies.iter_mut().for_each(|body| body.share = 0.0);
    }

    /// The lesser shares at which two bodies meet without being in one another; `None` if theirs are good.
    fn shares(&self, pair: &[BodyState; 2]) -> Option<[f64; 2]> {
        let [first, second] = pair;
        let apart = |shares: [f64; 2]| {
            let motions = [first.motion.scaled(shares[0]), second.motion.scaled(shares[1])];
            contact::apart(&self.parts, [self.body(first.id), self.body(second.id)], motions)
        };
        let shares = [first.share, second.share];
        if apart(shares).0 >= -TOUCH_M {
            return None;
        }
        let (before, normal) = apart([0.0, 0.0]);
        let towards = |motion: Motion| motion.shift.dot(normal.truncate());
        let approach = [towards(first.motion) > 0.0, towards(second.motion) < 0.0];
        if before < -TOUCH_M {
            // Crushed already, by a plate or a robot: what draws them apart is allowed, what does not is not.
            if apart(shares).0 >= before - TOUCH_M {
                return None;
            }
            let keep = |index: usize| if approach[index] { 0.0 } else { shares[index] };
            let kept = [keep(0), keep(1)];
            return Some(if kept == shares { [0.0, 0.0] } else { kept });
        }
        let held = match approach {
            [true, false] if apart([0.0, shares[1]]).0 >= -TOUCH_M => {
                [nearest_contact(0.0, shares[0], |share| apart([share, shares[1]]).0), shares[1]]
            }
            [false, true] if apart([shares[0], 0.0]).0 >= -TOUCH_M => {
                [shares[0], nearest_contact(0.0, shares[1], |share| apart([shares[0], share]).0)]
            }
            _ => {
                let part = nearest_contact(0.0, 1.0, |part| apart([shares[0] * part, shares[1] * part]).0);
                [shares[0] * part, shares[1] * part]
            }
        };
        // What is left of a motion below the precision of contact is none: a queue that stands, stands.
        let stand = |index: usize| {
            let motion = if index == 0 { first.motion } else { second.motion };
            if held[index] < shares[index] && motion.shift.length() * held[index] < CONTACT_M {
                0.0
            } else {
                held[index]
            }
        };
        let held = [stand(0), stand(1)];
        Some(if held == shares { [0.0, 0.0] } else { held })
    }
}

/// Finds the bodies that may meet.
fn pair_up(bodies: &[BodyState], pairs: &mut Vec<[usize; 2]>) {
    pairs.clear();
    for (index, body) in bodies.iter().enumerate().filter(|(_, body)| body.moves) {
        for (other, near) in bodies.iter().enumerate() {
            // A pair of two that move is found from the first of them.
            if other == index || (near.moves && other < index) || !body.bounds.meet(&near.bounds) {
                continue;
            }
            pairs.push([index.min(other), index.max(other)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::floor::tests::{box_at, floor, straight};

    #[test]
    fn pairs_are_found_once_and_only_where_something_moves() {
        let mut floor = floor(vec![straight(0.0, 0.0, 4.0, 0.0), straight(4.0, 0.0, 2.0, 0.0)]);
        floor.belts[0].displacement = 1e-3;
        for x in [1.0, 1.3, 4.5, 4.8, 3.0] {
            box_at(&mut floor, x, 0.0);
        }
        let mut scratch = Scratch::default();
        floor.gather(&mut scratch.bodies);
        pair_up(&scratch.bodies, &mut scratch.pairs);
        assert_eq!(scratch.pairs, [[0, 1]]);
    }
}
