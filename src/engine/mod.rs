//! The engine: a plant's devices and parts, moved by fixed steps of simulated time.
//!
//! One [`Engine::tick`] is one step, in phases: **actuators** take the commands, the state as it is now becomes the **report**,
//! **joints** move, **parts** move with them, **collisions** are looked for, **sensors** look at what came of it. Step k takes the commands with t ≤ kT and
//! reports the state at kT, immediate booleans already following their command; then it moves over [kT, (k+1)T). Devices that
//! rest and that nothing moves near are passed over, which changes nothing but what a step costs.
//!
//! Invariant: no clock, no IO, no thread, no hash map to iterate. The same plant, step, seed and the same inputs at the same
//! steps give bit-identical states ([`Engine::state_hash`]), in whatever time mode the engine is run.

mod attention;
#[cfg(test)]
mod attention_tests;
#[cfg(test)]
mod bench;
mod binding;
mod build;
#[cfg(all(test, feature = "javascript"))]
mod builder_tests;
mod clash;
#[cfg(test)]
mod effect_tests;
mod floor;
mod hash;
mod load;
mod operate;
#[cfg(test)]
mod operate_tests;
mod registers;
mod reported;
#[cfg(test)]
mod shape_fixture;
mod stage;
#[cfg(test)]
mod stage_tests;
#[cfg(test)]
mod structure_tests;
#[cfg(test)]
mod tests;
mod ties;

use std::time::Duration;

pub use build::BuildError;
pub use floor::{Incident, IncidentKind, PartCounts};
pub use operate::{Act, ActError, Fault, Held, Insertion};

use crate::device::{Device, Role, Surroundings};
use crate::kinematics::{DPose3, DQuat, DVec3, FrameId, FrameTree};
use crate::plant::PartKind;
use crate::prototype::kind::KindDescriptor;
use crate::signal_map::RegisterId;
use crate::time::Instant;
use crate::value::Value;
use attention::{Attention, Visits};
use binding::{CommandTable, ReportPort};
use clash::Watch;
use floor::Floor;
use operate::Operated;
use registers::Registers;
use stage::Stage;
use ties::Ties;

/// A plant that runs.
pub struct Engine {
    step: Duration,
    now: Instant,
    steps: u64,
    units: Vec<Unit>,
    commands: CommandTable,
    registers: Registers,
    /// Grippers that a robot's `grip` closes.
    mounts: Vec<Mount>,
    frames: FrameTree,
    floor: Floor,
    stage: Option<Stage>,
    watch: Option<Watch>,
    /// The registers of each instance, by its name; sorted.
    owners: Vec<(String, Vec<RegisterId>)>,
    /// Room for one device's reports.
    scratch: Vec<f64>,
    /// What an operator has done.
    operated: Operated,
    attention: Attention,
}

/// A device with what binds it to the registers and to the floor.
struct Unit {
    /// The instance that it belongs to.
    instance: String,
    kind: &'static KindDescriptor,
    device: Box<dyn Device>,
    ports: usize,
    reports: Vec<ReportPort>,
    body: UnitBody,
    ties: Ties,
    visits: Visits,
}

/// A gripper that hangs from a robot. It draws while its own `suctionOn` is true or the robot's `grip` is.
#[derive(Clone, Copy, Debug)]
struct Mount {
    robot: usize,
    gripper: usize,
    /// Its port for suction, and the register that is mapped to it.
    suction: usize,
    register: Option<RegisterId>,
    is_closed: bool,
}

/// What a device is on the floor: an index into the list of its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
enum UnitBody {
    Apart,
    Belt(usize),
    Plate(usize),
    /// The frame of its tool.
    Robot(FrameId),
    /// The frame of its rim.
    Cups(usize, FrameId),
    Bay(usize),
    Drain,
    Eye(usize),
}

/// A part, as it is now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartState {
    /// Counted from 1 in the order in which parts came in; never given twice in a run.
    pub number: u64,
    pub kind: PartKind,
    /// Length, width, height, m.
    pub size: [f64; 3],
    /// The centre of its bottom face in the world, m.
    pub place: [f64; 3],
    /// Where its length points, from the world's x about z, rad.
    pub yaw: f64,
}

impl Engine {
    /// The step of simulated time.
    pub fn step(&self) -> Duration {
        self.step
    }

    /// The simulated time of the next tick; its report is stamped with it.
    pub fn now(&self) -> Instant {
        self.now
    }

    /// How many ticks there were.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// One step. Takes `inputs` in their order, each as its signal has it on the wire; a value for a signal that the plant
    /// reports, or one that is no number, is passed over (the session refuses those). Returns all registers, by
    /// [`RegisterId`], as they are at [`Engine::now`] before the motion.
    pub fn tick(&mut self, inputs: &[(RegisterId, Value)]) -> &[Value] {
        self.tick_for(inputs, self.step)
    }

    /// One step of another length. A replay of a real machine's recording takes commands and looks at reports at their
    /// recorded instants, which lie between the steps.
    pub fn tick_for(&mut self, inputs: &[(RegisterId, Value)], span: Duration) -> &[Value] {
        self.actuators(inputs);
        self.report();
        self.doze();
        self.joints(span);
        self.parts_phase(span);
        self.collisions_phase();
        self.wake_stirred();
        self.sensors();
        self.steps += 1;
        self.registers.all()
    }

    /// All registers, by [`RegisterId`], as of the last tick; before the first, those of a plant at rest.
    pub fn registers(&self) -> &[Value] {
        self.registers.all()
    }

    /// Puts the reports that were set to another value since the last call, or since the beginning, into `out` (cleared
    /// first), in the order of their ids. All others hold what they held then.
    pub fn take_changed(&mut self, out: &mut Vec<RegisterId>) {
        self.registers.take_changed(out);
    }

    /// How many parts came, left, and were lost.
    pub fn counts(&self) -> PartCounts {
        self.floor.counts()
    }

    /// All parts, as they are after the last tick.
    pub fn parts(&self) -> impl Iterator<Item = PartState> {
        self.floor.parts.iter().map(|(_, part)| PartState {
            number: part.number,
            kind: part.kind,
            size: part.block.size().to_array(),
            place: part.block.upright().place.to_array(),
            yaw: part.block.upright().yaw,
        })
    }

    /// What went wrong with parts and bodies since this was asked last, the first 256 of it. Asked after each tick, each
    /// collision has the signals of who is involved as they were at that moment.
    pub fn take_incidents(&mut self) -> Vec<Incident> {
        let incidents = std::mem::take(&mut self.floor.tally.incidents);
        if incidents.is_empty() { incidents } else { self.with_signals(incidents) }
    }

    fn actuators(&mut self, inputs: &[(RegisterId, Value)]) {
        // A message that is lost takes with it what arrived in the same step.
        let lost = !inputs.is_empty() && std::mem::take(&mut self.operated.loses);
        for (register, value) in inputs.iter().filter(|_| !lost) {
            let commands = &self.commands;
            let fit = || commands.number(*register, value).and_then(|_| commands.fit(*register, value));
            if !self.operated.withholds(*register, fit) {
                self.command(*register, value);
            }
        }
        self.close_mounted();
    }

    /// Hands the robots' `grip` on to the grippers that hang from them.
    fn close_mounted(&mut self) {
        if self.mounts.is_empty() {
            return;
        }
        for awake in 0..self.attention.awake.len() {
            // A robot that is awake has woken what hangs from it.
            let unit = self.attention.awake[awake] as usize;
            let Some((_, index)) = self.units[unit].visits.hangs else { continue };
            let Mount { robot, gripper, suction, register, is_closed } = self.mounts[index];
            let grips = self.grips(robot);
            if grips || is_closed {
                let own = register.is_some_and(|register| *self.registers.get(register) == Value::Bool(true));
                self.units[gripper].device.command(suction, f64::from(own || grips));
                self.mounts[index].is_closed = grips;
            }
        }
    }

    fn report(&mut self) {
        for &awake in &self.attention.awake {
            let unit = &mut self.units[awake as usize];
            if unit.reports.is_empty() {
                continue;
            }
            let reports = &mut self.scratch[..unit.ports];
            unit.device.report(reports);
            for port in &mut unit.reports {
                // Of what a device reports, little is new at a step.
                let number = reports[port.port];
                if port.is_news(number) {
                    self.registers.report(port.register, port.on_the_wire(number));
                }
            }
        }
        self.operated.cover(&mut self.registers);
    }

    fn joints(&mut self, span: Duration) {
        let seconds = span.as_secs_f64();
        self.share_supplies();
        for &awake in &self.attention.awake {
            self.units[awake as usize].device.advance(seconds);
        }
        self.now += span;
        self.place_bodies();
    }

    /// Tells devices that feel it how many others on their supply move; what all do before any of them moves.
    fn share_supplies(&mut self) {
        for &index in &self.attention.supplied {
            let Some(others) = &self.units[index].ties.supply else { continue };
            let moving = others.iter().map(|other| self.units[*other].device.moving()).sum();
            self.units[index].device.share(moving);
        }
    }

    /// Tells the floor where the devices are now.
    fn place_bodies(&mut self) {
        for &awake in &self.attention.awake {
            let unit = &self.units[awake as usize];
            if unit.body == UnitBody::Apart {
                continue;
            }
            match (unit.device.role(), unit.body) {
                (Role::Carries(belt), UnitBody::Belt(index)) => {
                    self.floor.belts[index].follow(belt);
                }
                (Role::Pushes(plate), UnitBody::Plate(index)) => {
                    self.floor.plates[index].set(plate.position, plate.displacement, plate.size[0]);
                }
                (Role::Moves(tool), UnitBody::Robot(frame)) => {
                    let place = DVec3::from_array(tool.position);
                    let local = DPose3::from_parts(place, DQuat::from_rotation_z(tool.rotation));
                    self.frames.set_local(frame, local);
                    self.frames.resolve_one(frame);
                }
                (Role::Holds(cups), UnitBody::Cups(index, _)) => self.floor.cups[index].vacuum = cups.vacuum,
                (Role::Makes(source), UnitBody::Bay(index)) => {
                    let due = &mut self.floor.bays[index].source.due;
                    due.clear();
                    due.extend_from_slice(&source.due);
                }
                _ => {}
            }
        }
        // What hangs from a robot is where that is now.
        let cups = if self.floor.cups.is_empty() { &[] } else { self.attention.awake.as_slice() };
        for &awake in cups {
            if let UnitBody::Cups(index, frame) = self.units[awake as usize].body {
                self.frames.resolve_one(frame);
                self.floor.cups[index].rim = *self.frames.world(frame);
            }
        }
        if let Some(stage) = &mut self.stage {
            stage.follow(&self.units, &self.attention.awake);
        }
    }

    fn parts_phase(&mut self, span: Duration) {
        self.floor.advance(self.now, span.as_secs_f64());
    }

    fn sensors(&mut self) {
        for &awake in &self.attention.awake {
            let unit = &mut self.units[awake as usize];
            let mut surroundings = match unit.body {
                UnitBody::Belt(index) => self.floor.at_belt(index),
                UnitBody::Plate(index) => self.floor.at_plate(index),
                UnitBody::Cups(index, _) => self.floor.about_cups(index),
                UnitBody::Eye(index) => Surroundings { sensed: self.floor.seen_by(index), ..Surroundings::default() },
                UnitBody::Bay(index) => {
                    Surroundings { made: self.floor.bays[index].made as u32, ..Surroundings::default() }
                }
                _ if unit.ties.counts_parts => Surroundings::default(),
                _ => continue,
            };
            if unit.ties.counts_parts {
                (surroundings.parts, surroundings.queued) = match unit.body {
                    UnitBody::Belt(index) => self.floor.load_of_belt(index),
                    UnitBody::Plate(index) => (self.floor.plates[index].pushed, 0),
                    _ => (self.floor.held_by(&unit.ties.cups), 0),
                };
            }
            if unit.visits.seen != surroundings {
                unit.visits.seen = surroundings;
                unit.visits.stir();
            }
            unit.device.sense(&surroundings);
        }
    }
}
