//! The floor: parts, and what carries, pushes, holds, makes and takes them. The engine's part phase.
//!
//! A step moves, in this order: what hangs from cups; what plates push; what belts carry, each part as far as the others
//! let it; then parts leave or change their belt, bays take and put. Only parts that move are looked at.
//!
//! Invariant: nothing here depends on the order of a hash map, on a thread or on a clock. The order in which parts came in
//! decides nothing but which of two slots is free.

mod bays;
mod carry;
mod contact;
mod hold;
mod look;
#[cfg(test)]
mod look_tests;
mod operate;
mod part;
mod push;
mod rest;
mod sense;
mod sleep;
mod tally;
#[cfg(test)]
mod tests;

pub(super) use bays::{Bay, Drain};
pub(super) use look::Eye;
pub(super) use operate::PartRequest;
use part::Parts;
pub(super) use part::Slot;
pub(super) use part::Support;
pub(super) use sense::Clear;
pub(super) use sleep::Listed;
pub(super) use tally::kind_name;
pub use tally::{Incident, IncidentKind, PartCounts};

use crate::device::{Belt, Plate, Transfer};
use crate::kinematics::{Beam, Block, DPose3, DVec2, DVec3, Surface, Upright};
use crate::time::Instant;
use tally::Tally;

/// A conveyor, as parts see it.
#[derive(Clone, Debug)]
pub(super) struct BeltBody {
    pub name: String,
    pub surface: Surface,
    pub transfer: Transfer,
    /// Which share of its way on this belt a part loses that stands on another, too.
    pub transfer_slip: f64,
    /// The steepest change of its speed that parts follow, m/s²; infinite where none slips.
    pub grip: f64,
    /// How far it moved in this step, m on the centre line.
    pub displacement: f64,
    /// How fast it was when the step began, and is now, m/s.
    pub speeds: [f64; 2],
    /// The other belts that a part on this one may stand on too.
    pub neighbours: Vec<usize>,
    /// Whether nothing follows at its start, and at its end.
    pub open: [bool; 2],
    pub beams: [Option<Beam>; 2],
    pub clear: [Clear; 2],
    /// The unloading bays that take parts off it.
    pub drains: Vec<usize>,
}

impl BeltBody {
    /// Takes over how a device has moved.
    pub fn follow(&mut self, belt: &Belt) {
        let Belt { displacement, speeds, transfer_slip, grip, .. } = *belt;
        (self.displacement, self.speeds, self.transfer_slip, self.grip) = (displacement, speeds, transfer_slip, grip);
    }
}

/// A pusher's plate, as parts see it.
#[derive(Clone, Debug)]
pub(super) struct PlateBody {
    pub name: String,
    pub pose: DPose3,
    /// The direction in which it extends.
    pub direction: DVec2,
    pub block: Block,
    /// How far it moved in this step, m.
    pub displacement: f64,
    /// How many parts it pushed in this step, those that stand on others apart.
    pub pushed: u32,
    pub beams: [Option<Beam>; 2],
    clear: [Clear; 2],
}

impl PlateBody {
    /// The plate of a device whose instance stands at `pose`.
    pub fn new(name: &str, pose: &DPose3, plate: &Plate) -> PlateBody {
        let along = pose.rotation * DVec3::X;
        let [thickness, width, _] = plate.size;
        let beam = |at: Option<f64>| {
            at.map(|x| {
                let end = |y| pose.transform_point(DVec3::new(x, y, plate.beam_height));
                Beam::new(end(width / 2.0), end(-width / 2.0))
            })
        };
        let mut body = PlateBody {
            name: name.to_owned(),
            pose: *pose,
            direction: along.truncate().normalize_or(DVec2::X),
            block: Block::new(DVec3::from_array(plate.size), Upright::default()),
            displacement: 0.0,
            pushed: 0,
            beams: plate.barriers.map(beam),
            clear: Default::default(),
        };
        body.set(plate.position, 0.0, thickness);
        body
    }

    /// Puts its front face at `position`, where `displacement` brought it.
    pub fn set(&mut self, position: f64, displacement: f64, thickness: f64) {
        let centre = self.pose.transform_point(DVec3::new(position - thickness / 2.0, 0.0, 0.0));
        self.block.move_to(Upright { place: centre, yaw: self.direction.to_angle() });
        self.displacement = displacement;
    }
}

/// A gripper's cups, as parts see them.
#[derive(Clone, Debug)]
pub(super) struct CupsBody {
    pub name: String,
    /// The pose of the rim in the world.
    pub rim: DPose3,
    pub reach: f64,
    pub vacuum: bool,
    pub always_sealed: bool,
    /// The part that hangs from it, and its pose in the rim's frame.
    pub held: Option<(Slot, DPose3)>,
}

/// The floor.
#[derive(Clone, Debug, Default)]
pub(super) struct Floor {
    pub belts: Vec<BeltBody>,
    pub plates: Vec<PlateBody>,
    pub cups: Vec<CupsBody>,
    pub bays: Vec<Bay>,
    pub drains: Vec<Drain>,
    pub eyes: Vec<Eye>,
    pub parts: Parts,
    pub tally: Tally,
    /// Parts that moved in this step by something other than a belt.
    handled: Vec<Slot>,
    carried: carry::Scratch,
    pub sleepers: sleep::Sleepers,
    /// The plates, and the cups, that are visited; in their order.
    awake_plates: Vec<usize>,
    awake_cups: Vec<usize>,
    /// Whether nothing that was found far away in one step is passed over in the next.
    pub forgets: bool,
}

impl Floor {
    /// One step of `seconds` that ends at `now`, after the devices have moved.
    pub fn advance(&mut self, now: Instant, seconds: f64) {
        self.tally.now = now;
        self.parts.begin_step();
        if self.forgets {
            self.parts.forget();
            self.belts.iter_mut().for_each(|belt| belt.clear = Default::default());
            self.plates.iter_mut().for_each(|plate| plate.clear = Default::default());
        }
        self.handled.clear();
        self.hold();
        self.push();
        self.slide(seconds);
        self.carry();
        self.collide();
        self.rest(seconds);
        self.put(seconds);
    }

    /// Counts, as of now.
    pub fn counts(&self) -> PartCounts {
        self.tally.counts(&self.parts)
    }

    /// Adds a plate and returns its index.
    pub fn add_plate(&mut self, plate: PlateBody) -> usize {
        self.awake_plates.push(self.plates.len());
        self.plates.push(plate);
        self.plates.len() - 1
    }

    /// Adds cups and returns their index.
    pub fn add_cups(&mut self, cups: CupsBody) -> usize {
        self.awake_cups.push(self.cups.len());
        self.cups.push(cups);
        self.cups.len() - 1
    }

    /// Adds an unloading bay, whose belt is there.
    pub fn add_drain(&mut self, drain: Drain) {
        self.belts[drain.belt].drains.push(self.drains.len());
        self.drains.push(drain);
    }

    /// Finds out which belts follow which; once, when all are there.
    pub fn connect_belts(&mut self) {
        for index in 0..self.belts.len() {
            self.belts[index].neighbours = self.neighbours_of(index);
            self.belts[index].open = [self.is_open(index, false), self.is_open(index, true)];
        }
    }

    fn neighbours_of(&self, index: usize) -> Vec<usize> {
        // No part is longer than this bridge to a belt further off.
        const REACH_M: f64 = 1.0;
        let surface = &self.belts[index].surface;
        let near =
            |other: &Surface| surface.bears(other.height()) && surface.bounds().grown(REACH_M).meet(other.bounds());
        (0..self.belts.len()).filter(|&other| other != index && near(&self.belts[other].surface)).collect()
    }

    /// Whether at the end (the start, if not `forwards`) of a belt no other begins within a hand's breadth.
    fn is_open(&self, index: usize, forwards: bool) -> bool {
        let belt = &self.belts[index];
        let probes = [0.01, 0.05, 0.10, 0.15];
        !probes.iter().any(|&gap| {
            let station = if forwards { belt.surface.length() + gap } else { -gap };
            let (place, yaw) = belt.surface.at(crate::kinematics::Along { station, offset: 0.0 });
            let probe = Block::new(DVec3::splat(0.005), Upright { place: place.extend(0.0), yaw });
            belt.neighbours.iter().any(|&other| self.belts[other].surface.area_under(&probe) > 0.0)
        })
    }
}
