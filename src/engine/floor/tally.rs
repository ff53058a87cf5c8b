//! What is counted about parts, and what went wrong with them.

use std::fmt;

use super::carry::BodyId;
use super::contact::{self, COLLISION_M};
use super::part::{Part, Parts};
use crate::kinematics::{DVec3, Motion};
use crate::plant::PartKind;
use crate::signal_map::RegisterId;
use crate::time::Instant;
use crate::value::Value;

/// How many parts came and went since the start. What stands in the plant at t = 0 has come in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PartCounts {
    /// Boxes that came in.
    pub boxes_in: u64,
    /// Boxes that left at the end of a belt or by an unloading bay.
    pub boxes_out: u64,
    /// Boxes that fell off: in − out − present − removed.
    pub boxes_lost: u64,
    /// Boxes in the plant.
    pub boxes_present: u64,
    /// Boxes that an operator took out.
    pub boxes_removed: u64,
    /// Pallets, in the same way.
    pub pallets_in: u64,
    pub pallets_out: u64,
    pub pallets_lost: u64,
    pub pallets_present: u64,
    pub pallets_removed: u64,
    /// How often two parts, or a part and a plate, came to be in one another by more than 0.1 mm.
    pub collisions: u64,
}

/// Something that should not happen to a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Incident {
    /// The end of the step in which it happened.
    pub at: Instant,
    pub kind: IncidentKind,
    /// At a collision, the signals of the instances involved at that moment; see
    /// [`take_incidents`](crate::engine::Engine::take_incidents).
    pub signals: Vec<(RegisterId, Value)>,
}

/// What happened.
#[derive(Clone, Debug, PartialEq)]
pub enum IncidentKind {
    /// Part `number` fell: nothing was beneath it.
    Lost { part: PartKind, number: u64, place: [f64; 3], from: String },
    /// Two are in one another by more than 0.1 mm: parts, plates, or bodies of the scene; `depth` in metres, `place` where
    /// the first of them is. `instances` are those that they belong to, or that carry them.
    Collision { between: [String; 2], depth: f64, place: [f64; 3], instances: Vec<String> },
}

impl fmt::Display for Incident {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            IncidentKind::Lost { part, number, place: [x, y, z], from } => {
                let part = kind_name(*part);
                write!(f, "at {}: {part} {number} fell from {from} at x {x:.3}, y {y:.3}, z {z:.3} m", self.at)
            }
            IncidentKind::Collision { between: [a, b], depth, place: [x, y, z], .. } => {
                let millimetres = depth * 1e3;
                write!(
                    f,
                    "at {}: {a} and {b} are {millimetres:.1} mm in one another at x {x:.3}, y {y:.3}, z {z:.3} m",
                    self.at
                )
            }
        }
    }
}

pub(in crate::engine) fn kind_name(kind: PartKind) -> &'static str {
    match kind {
        PartKind::Box => "box",
        PartKind::Pallet => "pallet",
    }
}

/// How many incidents are kept for the next who asks; all are counted.
const KEPT: usize = 256;

/// The counters.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct Tally {
    pub now: Instant,
    pub incidents: Vec<Incident>,
    /// Boxes, pallets.
    entered: [u64; 2],
    left: [u64; 2],
    lost: [u64; 2],
    removed: [u64; 2],
    pub collisions: u64,
    /// Who is in whom at present, by the keys of their bodies; sorted.
    colliding: Vec<[u64; 2]>,
}

const fn place(kind: PartKind) -> usize {
    match kind {
        PartKind::Box => 0,
        PartKind::Pallet => 1,
    }
}

impl Tally {
    pub fn counts(&self, parts: &Parts) -> PartCounts {
        let mut present = [0; 2];
        parts.iter().for_each(|(_, part)| present[self::place(part.kind)] += 1);
        PartCounts {
            boxes_in: self.entered[0],
            boxes_out: self.left[0],
            boxes_lost: self.lost[0],
            boxes_present: present[0],
            boxes_removed: self.removed[0],
            pallets_in: self.entered[1],
            pallets_out: self.left[1],
            pallets_lost: self.lost[1],
            pallets_present: present[1],
            pallets_removed: self.removed[1],
            collisions: self.collisions,
        }
    }

    pub fn entered(&mut self, kind: PartKind) {
        self.entered[place(kind)] += 1;
    }

    pub fn left(&mut self, part: &Part) {
        self.left[place(part.kind)] += 1;
    }

    pub fn removed(&mut self, part: &Part) {
        self.removed[place(part.kind)] += 1;
    }

    pub fn lost(&mut self, part: &Part, from: &str) {
        self.lost[place(part.kind)] += 1;
        let place = part.block.upright().place.to_array();
        self.keep(IncidentKind::Lost { part: part.kind, number: part.number, place, from: from.to_owned() });
    }

    pub fn keep(&mut self, kind: IncidentKind) {
        if self.incidents.len() < KEPT {
            self.incidents.push(Incident { at: self.now, kind, signals: Vec::new() });
        }
    }
}

impl super::Floor {
    /// Counts the pairs that are in one another now and were not before. Only pairs of which one moved can have changed.
    pub(super) fn collide(&mut self) {
        let was = std::mem::take(&mut self.tally.colliding);
        let mut is: Vec<[u64; 2]> = Vec::new();
        for &[first, second] in &self.carried.pairs {
            let [first, second] = [&self.carried.bodies[first], &self.carried.bodies[second]];
            let bodies = [self.body(first.id), self.body(second.id)];
            let (apart, _) = contact::apart(&self.parts, bodies, [Motion::NONE; 2]);
            if apart >= -COLLISION_M {
                continue;
            }
            let key = [first.key, second.key];
            is.push(key);
            if was.binary_search(&key).is_err() {
                self.tally.collisions += 1;
                let between = [self.title(first.id), self.title(second.id)];
                let place = self.place_of(first.id).to_array();
                let instances = [first.id, second.id].iter().flat_map(|id| self.instance_of(*id)).collect();
                self.tally.keep(IncidentKind::Collision { between, depth: -apart, place, instances });
            }
        }
        // What stands still in one another stays so.
        is.extend(was.iter().filter(|[a, b]| self.carried.rests(*a) && self.carried.rests(*b)));
        is.sort_unstable();
        is.dedup();
        self.tally.colliding = is;
    }

    fn place_of(&self, id: BodyId) -> DVec3 {
        match id {
            BodyId::Group(slot) => self.parts.get(slot).block.upright().place,
            BodyId::Plate(plate) => self.plates[plate].block.upright().place,
        }
    }

    fn instance_of(&self, id: BodyId) -> Option<String> {
        match id {
            BodyId::Group(slot) => self.carrier(slot),
            BodyId::Plate(plate) => Some(self.plates[plate].name.clone()),
        }
    }

    fn title(&self, id: BodyId) -> String {
        match id {
            BodyId::Group(slot) => {
                let part = self.parts.get(slot);
                format!("{} {}", kind_name(part.kind), part.number)
            }
            BodyId::Plate(plate) => format!("the plate of {}", self.plates[plate].name),
        }
    }
}
