//! Whom a step visits: devices that are at work, or that something moves near. The others sleep.
//!
//! A device falls asleep when it has been at rest for some dozens of steps ([`Device::rests`](crate::device::Device::rests)),
//! and wakes when a command comes, when a part moves where it looks or stands, and with the robot that carries it. Visiting a
//! device that sleeps would change nothing, bit for bit: neither when it falls asleep nor when it wakes shows anywhere. Devices
//! with effects, bays with their schedules and servo loops never sleep.

use super::floor::{Eye, Listed};
use super::{Engine, UnitBody};
use crate::device::{Role, Surroundings};
use crate::kinematics::{Bounds, DVec3};

/// So many steps apart devices are asked whether they rest.
const PERIOD: u64 = 16;
/// So often in a row they have to say yes.
const CALM: u8 = 4;
/// How far about what stands there a device wakes, m.
const MARGIN_M: f64 = 1e-3;

/// Who is visited.
#[derive(Clone, Debug, Default)]
pub(super) struct Attention {
    /// The units that do not sleep, in no order that matters.
    pub awake: Vec<u32>,
    /// Units that learn how many others on their supply move.
    pub supplied: Vec<usize>,
    never_sleeps: bool,
}

/// How a unit is visited.
#[derive(Clone, Debug, Default)]
pub(super) struct Visits {
    pub sleeps: bool,
    /// How often in a row it was found at rest.
    calm: u8,
    /// What it was told of the world last.
    pub seen: Surroundings,
    /// The unit of the robot that it hangs from, and of the mount by which it does.
    pub hangs: Option<(usize, usize)>,
    /// What hangs from it.
    pub carries: Vec<usize>,
}

impl Visits {
    /// Something has happened to it.
    pub fn stir(&mut self) {
        self.calm = 0;
    }
}

impl Engine {
    /// Lets no device sleep from now on, and has everything looked at anew at each step, or lets them again: for comparisons, as
    /// nothing but the cost of a step depends on it.
    pub fn keep_awake(&mut self, awake: bool) {
        self.attention.never_sleeps = awake;
        self.floor.forgets = awake;
        self.wake_all();
    }

    /// How many devices a step visits now.
    pub fn awake(&self) -> usize {
        self.attention.awake.len()
    }

    /// Finds out who hangs from whom, and who has to know of others; once, when all units are there. All are awake.
    pub(super) fn attend(&mut self) {
        for (index, mount) in self.mounts.iter().enumerate() {
            self.units[mount.gripper].visits.hangs = Some((mount.robot, index));
            self.units[mount.robot].visits.carries.push(mount.gripper);
        }
        let is_supplied = |unit: &usize| self.units[*unit].ties.supply.is_some();
        self.attention.supplied = (0..self.units.len()).filter(is_supplied).collect();
        self.attention.awake = (0..self.units.len() as u32).collect();
    }

    /// A unit is visited from now on, with what hangs from it.
    pub(super) fn wake(&mut self, unit: usize) {
        let visits = &mut self.units[unit].visits;
        visits.stir();
        if std::mem::replace(&mut visits.sleeps, false) {
            self.attention.awake.push(unit as u32);
            self.floor.rouse(unit as u32);
            for carried in 0..self.units[unit].visits.carries.len() {
                self.wake(self.units[unit].visits.carries[carried]);
            }
        }
    }

    pub(super) fn wake_all(&mut self) {
        (0..self.units.len()).for_each(|unit| self.wake(unit));
    }

    /// Wakes whom the parts have come near.
    pub(super) fn wake_stirred(&mut self) {
        self.floor.stir_moved();
        while let Some(unit) = self.floor.sleepers.woken.pop() {
            self.wake(unit as usize);
        }
    }

    /// Lets those sleep that have been at rest for long enough. What they are has been reported and is known to the floor.
    pub(super) fn doze(&mut self) {
        if !self.steps.is_multiple_of(PERIOD) || self.attention.never_sleeps {
            return;
        }
        let mut awake = std::mem::take(&mut self.attention.awake);
        let before = awake.len();
        awake.retain(|unit| !self.falls_asleep(*unit as usize));
        if awake.len() < before {
            // They may be where parts were told that nobody sleeps.
            self.floor.parts.clear_none();
        }
        self.attention.awake = awake;
    }

    fn falls_asleep(&mut self, index: usize) -> bool {
        let unit = &self.units[index];
        let has_ties = unit.ties.counts_parts || unit.ties.supply.is_some();
        let follows = unit.visits.hangs.is_some_and(|(robot, _)| !self.units[robot].visits.sleeps);
        if has_ties || follows || !unit.device.rests() || self.grasps(unit.body) {
            self.units[index].visits.stir();
            return false;
        }
        let visits = &mut self.units[index].visits;
        visits.calm += 1;
        if visits.calm < CALM {
            return false;
        }
        visits.sleeps = true;
        let body = self.units[index].body;
        let (region, listed) = self.region_of(body);
        self.floor.put_to_sleep(index as u32, region.grown(MARGIN_M), listed);
        true
    }

    /// Whether it would take whatever comes.
    fn grasps(&self, body: UnitBody) -> bool {
        match body {
            UnitBody::Cups(index, _) => self.floor.cups[index].vacuum && self.floor.cups[index].held.is_none(),
            _ => false,
        }
    }

    /// Where something that moves bears on it, and what it is to the floor.
    fn region_of(&self, body: UnitBody) -> (Bounds, Listed) {
        let beams = |beams: &[Option<crate::kinematics::Beam>; 2]| {
            beams.iter().flatten().fold(Bounds::EMPTY, |all, beam| all.merged(*beam.bounds()))
        };
        match body {
            UnitBody::Belt(index) => (beams(&self.floor.belts[index].beams), Listed::Not),
            UnitBody::Plate(index) => {
                let plate = &self.floor.plates[index];
                (beams(&plate.beams).merged(*plate.block.bounds()), Listed::Plate(index))
            }
            UnitBody::Cups(index, _) => {
                let cups = &self.floor.cups[index];
                let (rim, reach) = (cups.rim.translation, DVec3::splat(cups.reach));
                (Bounds { low: rim - reach, high: rim + reach }, Listed::Cups(index))
            }
            UnitBody::Eye(index) => match &self.floor.eyes[index] {
                Eye::Box(block) => (*block.bounds(), Listed::Not),
                Eye::Ray(beam, _) => (*beam.bounds(), Listed::Not),
            },
            UnitBody::Apart | UnitBody::Robot(_) | UnitBody::Bay(_) | UnitBody::Drain => (Bounds::EMPTY, Listed::Not),
        }
    }

    /// Whether a robot closes what hangs from it.
    pub(super) fn grips(&self, robot: usize) -> bool {
        matches!(self.units[robot].device.role(), Role::Moves(tool) if tool.grip)
    }
}
