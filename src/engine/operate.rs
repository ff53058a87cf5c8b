//! What somebody at the simulation's controls does to the plant: forced signals, parts put in and taken out, faults.
//!
//! An act counts from the tick after it on, and is as much an input of the engine as a command: the same acts at the same
//! ticks give the same states. That is why they stand in a trace and a replay obeys them.

use super::Engine;
use super::binding::{ReportPort, Target};
use super::floor::PartRequest;
use super::registers::Registers;
use crate::device::Role;
use crate::plant::PartKind;
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::value::Value;

/// Something done to a plant that runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// From now on the signal has this value, whatever the automation sends or the device reports.
    Force { signal: RegisterId, value: Value },
    /// No more. A command takes the last value that the automation sent.
    Release { signal: RegisterId },
    /// Puts a part on a belt.
    Insert(Insertion),
    /// Takes the part of this number out, with all that stands on it.
    Remove { number: u64 },
    /// Breaks something.
    Break(Fault),
    /// Mends it.
    Mend(Fault),
}

/// A part to put on a belt.
#[derive(Clone, Debug, PartialEq)]
pub struct Insertion {
    pub kind: PartKind,
    /// Length, width, height, m.
    pub size: [f64; 3],
    /// The conveyor.
    pub belt: String,
    /// Where on its centre line the part's centre is to be, m from its start.
    pub station: f64,
    /// How far to the left of it, m.
    pub offset: f64,
    /// How far it is turned to the left from the running direction there, rad.
    pub turn: f64,
}

/// Something that can break.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// What a device reports stays what it is now: a light barrier that sticks.
    Stuck { signal: RegisterId },
    /// An instance's drives have no power: belts and motors ramp down, rods stay, axes stop where they are.
    Dead { instance: String },
    /// The next message of the automation is lost, with all that the same step would have taken.
    Lost,
}

/// Why an act cannot be done. Nothing has changed then.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ActError {
    #[error("the value is no number that this signal can have")]
    Unfit,
    #[error("nothing holds this signal: it is neither forced nor stuck")]
    NotHeld,
    #[error("the automation sets this signal: only what a device reports can stick")]
    NoReport,
    #[error("the plant has no conveyor {name:?}")]
    NoBelt { name: String },
    #[error("{}", .0)]
    NoRoom(&'static str),
    #[error("there is no part {number} in the plant")]
    NoPart { number: u64 },
    #[error("{instance:?} has no drive that could stop")]
    NoDrive { instance: String },
    #[error("this is not broken")]
    Whole,
}

/// A signal that is held.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    pub signal: RegisterId,
    /// What it is held at.
    pub value: Value,
    /// Whether a fault holds it: it sticks.
    pub sticks: bool,
}

/// A drive without power.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dead {
    unit: usize,
    instance: String,
    ports: Vec<usize>,
}

/// What has been done and still counts.
#[derive(Clone, Debug, Default)]
pub(super) struct Operated {
    pub held: Vec<Held>,
    /// What the automation sent for a held command, by its register.
    withheld: Vec<(RegisterId, Value)>,
    pub dead: Vec<Dead>,
    pub loses: bool,
}

/// Command ports that are 0 for a drive without power. Those of a robot hold where it is.
const POWERED: [&str; 6] = ["velocityTarget", "motorDirection", "command", "speedTarget", "enable", "torqueEnabled"];
const JOINTS: [&str; 6] = ["J1Target", "J2Target", "J3Target", "J4Target", "J5Target", "J6Target"];
const AXES: [&str; 4] = ["XTarget", "YTarget", "ZTarget", "RTarget"];

impl Operated {
    fn held(&self, signal: RegisterId) -> Option<&Held> {
        self.held.iter().find(|held| held.signal == signal)
    }

    /// Whether a command for `signal` must wait; it is kept then, as `fit` makes it fit the register.
    pub fn withholds(&mut self, signal: RegisterId, fit: impl FnOnce() -> Option<Value>) -> bool {
        if self.held.is_empty() || self.held(signal).is_none() {
            return false;
        }
        let Some(value) = fit() else { return true };
        self.withheld.retain(|(other, _)| *other != signal);
        self.withheld.push((signal, value));
        true
    }

    /// Whether a command does not reach this port of a device.
    pub fn is_dead(&self, target: Target) -> bool {
        self.dead.iter().any(|dead| dead.unit == target.unit && dead.ports.contains(&target.port))
    }

    /// Puts what is held in the place of what was reported.
    pub fn cover(&self, registers: &mut Registers) {
        for held in &self.held {
            registers.hold(held.signal, &held.value);
        }
    }
}

impl Engine {
    /// Does `act` before the next tick.
    ///
    /// # Errors
    /// It cannot be done; nothing has changed.
    pub fn operate(&mut self, act: &Act) -> Result<(), ActError> {
        self.wake_all();
        // A register that is held, or was, is not as its device reported it.
        self.units.iter_mut().flat_map(|unit| &mut unit.reports).for_each(ReportPort::forget);
        match act {
            Act::Force { signal, value } => self.force(*signal, value),
            Act::Release { signal } => self.let_loose(*signal, false),
            Act::Insert(insertion) => self.insert(insertion),
            Act::Remove { number } => {
                let removed = self.floor.remove_part(*number);
                if removed { Ok(()) } else { Err(ActError::NoPart { number: *number }) }
            }
            Act::Break(Fault::Stuck { signal }) => self.stick(*signal),
            Act::Break(Fault::Dead { instance }) => self.stop_drive(instance),
            Act::Break(Fault::Lost) => {
                self.operated.loses = true;
                Ok(())
            }
            Act::Mend(Fault::Stuck { signal }) => self.let_loose(*signal, true),
            Act::Mend(Fault::Dead { instance }) => self.start_drive(instance),
            Act::Mend(Fault::Lost) => {
                let lost = std::mem::take(&mut self.operated.loses);
                if lost { Ok(()) } else { Err(ActError::Whole) }
            }
        }
    }

    /// The signals that are held, in the order in which that began.
    pub fn held(&self) -> &[Held] {
        &self.operated.held
    }

    /// The instances whose drives have no power.
    pub fn dead_drives(&self) -> impl Iterator<Item = &str> {
        let mut last = "";
        self.operated.dead.iter().map(|dead| dead.instance.as_str()).filter(move |name| {
            let is_new = *name != last;
            last = name;
            is_new
        })
    }

    /// Whether the next message of the automation will be lost.
    pub fn loses_next(&self) -> bool {
        self.operated.loses
    }

    fn force(&mut self, signal: RegisterId, value: &Value) -> Result<(), ActError> {
        let Some(value) = self.commands.fit(signal, value) else { return Err(ActError::Unfit) };
        let was_held = self.operated.held(signal).is_some();
        if self.commands.is_command(signal) {
            if !was_held {
                let present = self.registers.get(signal).clone();
                self.operated.withheld.push((signal, present));
            }
            self.command(signal, &value);
        }
        self.operated.held.retain(|held| held.signal != signal);
        self.operated.held.push(Held { signal, value, sticks: false });
        Ok(())
    }

    fn stick(&mut self, signal: RegisterId) -> Result<(), ActError> {
        if self.commands.is_command(signal) {
            return Err(ActError::NoReport);
        }
        // Before the first tick the registers are those of a plant at rest.
        let value = self.registers.get(signal).clone();
        self.operated.held.retain(|held| held.signal != signal);
        self.operated.held.push(Held { signal, value, sticks: true });
        Ok(())
    }

    fn let_loose(&mut self, signal: RegisterId, sticks: bool) -> Result<(), ActError> {
        let held = self.operated.held.iter().position(|held| held.signal == signal && held.sticks == sticks);
        let Some(place) = held else { return Err(if sticks { ActError::Whole } else { ActError::NotHeld }) };
        self.operated.held.remove(place);
        if let Some(place) = self.operated.withheld.iter().position(|(other, _)| *other == signal) {
            let (_, value) = self.operated.withheld.remove(place);
            self.command(signal, &value);
        }
        Ok(())
    }

    /// Sets a command's register and hands it to the devices, in SI units. What is no finite number is passed over.
    #[inline]
    pub(super) fn command(&mut self, register: RegisterId, value: &Value) {
        let Some(number) = self.commands.number(register, value) else { return };
        let Some(kept) = self.registers.command(register, number) else { return };
        let number = self.commands.si(register, kept);
        for index in 0..self.commands.targets(register).len() {
            let target = self.commands.targets(register)[index];
            if self.operated.dead.is_empty() || !self.operated.is_dead(target) {
                self.wake(target.unit);
                self.units[target.unit].device.command(target.port, number);
            }
        }
    }

    fn insert(&mut self, insertion: &Insertion) -> Result<(), ActError> {
        let Insertion { kind, size, belt, station, offset, turn } = insertion;
        let is_length = |side: &f64| side.is_finite() && (0.01..=10.0).contains(side);
        if !size.iter().all(is_length) || ![station, offset, turn].into_iter().all(|number| number.is_finite()) {
            return Err(ActError::NoRoom("a part is 0.01 m to 10 m long, wide and high, and stands at finite numbers"));
        }
        let Some(index) = self.floor.belts.iter().position(|body| body.name == *belt) else {
            return Err(ActError::NoBelt { name: belt.clone() });
        };
        self.floor
            .insert_part(&PartRequest { kind: *kind, size: *size, belt: index, at: [*station, *offset], turn: *turn })
            .map_err(ActError::NoRoom)
    }

    fn stop_drive(&mut self, instance: &str) -> Result<(), ActError> {
        if self.dead_drives().any(|name| name == instance) {
            return Ok(());
        }
        let mut found = Vec::new();
        for (index, unit) in self.units.iter().enumerate().filter(|(_, unit)| unit.instance == instance) {
            let port = |name: &&str| unit.kind.port(name);
            let powered: Vec<(usize, f64)> = POWERED.iter().filter_map(port).map(|port| (port, 0.0)).collect();
            let held = match unit.device.role() {
                Role::Moves(_) if unit.kind.port("place").is_some() => {
                    // An arm's joints stay where they are, and no place calls it.
                    let mut angles = Vec::new();
                    unit.device.joints(&mut |_, angle| angles.push(angle));
                    let joints = JOINTS.iter().zip(angles).map(|(name, angle)| (*name, angle));
                    let calm = joints.chain([("place", 0.0)]);
                    calm.filter_map(|(name, value)| Some((unit.kind.port(name)?, value))).collect()
                }
                Role::Moves(tool) => {
                    let [x, y, z] = tool.position;
                    let places = AXES.iter().zip([x, y, z, tool.rotation]);
                    places.filter_map(|(name, place)| Some((unit.kind.port(name)?, place))).collect()
                }
                _ => Vec::new(),
            };
            let ports: Vec<(usize, f64)> = powered.into_iter().chain(held).collect();
            if !ports.is_empty() {
                found.push((index, ports));
            }
        }
        if found.is_empty() {
            return Err(ActError::NoDrive { instance: instance.to_owned() });
        }
        for (unit, ports) in found {
            for (port, value) in &ports {
                self.units[unit].device.command(*port, *value);
            }
            let ports = ports.into_iter().map(|(port, _)| port).collect();
            self.operated.dead.push(Dead { unit, instance: instance.to_owned(), ports });
        }
        Ok(())
    }

    fn start_drive(&mut self, instance: &str) -> Result<(), ActError> {
        let (dead, others): (Vec<Dead>, Vec<Dead>) =
            std::mem::take(&mut self.operated.dead).into_iter().partition(|dead| dead.instance == instance);
        self.operated.dead = others;
        if dead.is_empty() {
            return Err(ActError::Whole);
        }
        // What was commanded meanwhile counts now.
        for index in 0..self.registers.all().len() {
            let register = RegisterId(index as u32);
            let concerns = |target: &&Target| {
                dead.iter().any(|dead| dead.unit == target.unit && dead.ports.contains(&target.port))
            };
            let targets: Vec<Target> = self.commands.targets(register).iter().filter(concerns).copied().collect();
            if targets.is_empty() {
                continue;
            }
            if let Some(number) = self.commands.number(register, self.registers.get(register)) {
                let number = self.commands.si(register, number);
                targets.iter().for_each(|target| self.units[target.unit].device.command(target.port, number));
            }
        }
        Ok(())
    }
}

impl Fault {
    /// What breaks, for people.
    pub fn described(&self, map: &SignalMap) -> String {
        match self {
            Fault::Stuck { signal } => format!("{} sticks", map.signal(*signal).name),
            Fault::Dead { instance } => format!("the drive of {instance} has no power"),
            Fault::Lost => "the automation's next message is lost".to_owned(),
        }
    }

    /// Whether a signal could stick.
    pub fn can_stick(map: &SignalMap, signal: RegisterId) -> bool {
        map.signal(signal).direction == Direction::Report
    }
}
