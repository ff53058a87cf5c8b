//! From a plant to an engine at t = 0.

use std::collections::BTreeMap;
use std::time::Duration;

use super::attention::{Attention, Visits};
use super::binding::{CommandTable, ReportPort, Target};
use super::floor::{Bay, BeltBody, CupsBody, Drain, Eye, Floor, PlateBody};
use super::operate::Operated;
use super::registers::Registers;
use super::ties::{self, Ties};
use super::{Engine, Mount, Unit, UnitBody};
use crate::device::{self, Belt, Cups, Device, Role, Surface as DeviceSurface};
use crate::effect;
use crate::kinematics::{Along, Block, DPose3, DQuat, DVec3, FrameId, FrameTree, Shape, Surface, Upright, is_level};
use crate::plant::{EffectSpec, InitialPart, Instance, Plant, Pose, Task};
use crate::signal_map::Direction;
use crate::time::Instant;
use crate::xml::Fault;

/// Why a plant cannot be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    #[error("the step is 0: expected more than no time, as 1ms")]
    NoStep,
    #[error(transparent)]
    Device(device::BuildError),
    /// The effect at `index` of an instance's effects.
    #[error("{}", said(instance, error))]
    Effect { instance: String, index: usize, error: Box<effect::EffectError> },
    #[error(
        "{instance} is tilted: parts stand upright, so that what carries, pushes or lifts them must be level; \
         set rx and ry of its pose to 0"
    )]
    Tilted { instance: String },
    #[error("{instance}: its property {property:?} names {found:?}, expected {expected}")]
    Neighbour { instance: String, property: &'static str, found: String, expected: &'static str },
    #[error("part {index} of the plant (counted from 1), {name}, {problem}")]
    Part { index: usize, name: String, problem: String },
}

/// What is wrong with an effect, with the instance that has it.
fn said(instance: &str, error: &effect::EffectError) -> String {
    match error {
        effect::EffectError::Device(error) => error.to_string(),
        error => format!("{instance}: {error}"),
    }
}

impl BuildError {
    /// The error as a fault in the plant's file; `None` where it is about none, or the plant was read from none.
    pub fn fault(&self, plant: &Plant) -> Option<Fault> {
        let places = &plant.places;
        // What the file sets is wrong there; a default is wrong where the instance leaves it alone.
        let parameter = |instance: &str, name: &'static str| match places.parameter(instance, name) {
            Some(place) => Some((place, format!("expected another {name}"))),
            None => Some((places.instance(instance)?, format!("expected a property that sets {name}"))),
        };
        let (place, expected) = match self {
            BuildError::NoStep => return None,
            BuildError::Effect { instance, index, error } => error.place(places.effect(instance, *index)?),
            BuildError::Device(error) => parameter(&error.instance, error.parameter)?,
            BuildError::Neighbour { instance, property, expected, .. } => {
                (parameter(instance, property)?.0, format!("expected {expected}"))
            }
            BuildError::Tilted { instance } => {
                (places.instance(instance)?, "expected rx and ry of its pose 0".to_owned())
            }
            BuildError::Part { index, .. } => {
                (places.part(index - 1)?, "expected a part that can stand there".to_owned())
            }
        };
        Some(place.fault(self.to_string(), expected))
    }
}

impl Engine {
    /// The engine of `plant` at t = 0, all devices at rest, all commands 0 or false. `seed` is the run's: all that is random
    /// about the plant follows from it.
    pub fn new(plant: &Plant, step: Duration, seed: u64) -> Result<Engine, BuildError> {
        if step.is_zero() {
            return Err(BuildError::NoStep);
        }
        let map = &plant.signal_map;
        let mut builder = Builder::default();
        let mut commands = CommandTable::new(map);
        let mut units: Vec<Unit> = Vec::new();
        for instance in &plant.instances {
            for task in &instance.tasks {
                let mut device = device_of(plant, instance, task, seed)?;
                let mut reports = Vec::new();
                for (port, register) in task.ports.iter().enumerate() {
                    let Some(register) = *register else { continue };
                    if task.kind.ports[port].direction == Direction::Report {
                        reports.push(ReportPort::new(port, register, map));
                    } else {
                        commands.bind(register, Target { unit: units.len(), port });
                        // A command that is mapped is 0 or false until the automation says otherwise.
                        device.command(port, 0.0);
                    }
                }
                let body = builder.add(instance, units.len(), device.as_ref())?;
                units.push(Unit {
                    instance: instance.name.clone(),
                    kind: task.kind,
                    device,
                    ports: task.kind.ports.len(),
                    reports,
                    body,
                    ties: Ties::default(),
                    visits: Visits::default(),
                });
            }
        }
        builder.connect(plant, &mut units)?;
        ties::tie(plant, &builder.mounts, &mut units)?;
        let registers = Registers::new(map.signals().iter().map(|signal| signal.ty.initial()).collect());
        let room = units.iter().map(|unit| unit.ports).max().unwrap_or(0);
        let Builder { frames, floor, mounts, .. } = builder;
        let mut engine = Engine {
            step,
            now: Instant::ZERO,
            steps: 0,
            units,
            commands,
            registers,
            mounts,
            frames,
            floor,
            stage: None,
            watch: None,
            owners: super::clash::registers_of(plant),
            scratch: vec![0.0; room],
            operated: Operated::default(),
            attention: Attention::default(),
        };
        engine.attend();
        engine.frames.resolve();
        engine.place_bodies();
        engine.put_initial(&plant.parts)?;
        // What the bays have due at t = 0 stands there at t = 0.
        engine.floor.put(0.0);
        engine.sensors();
        engine.report();
        Ok(engine)
    }

    /// Puts the parts that stand in the plant at the start, the lowest first, so that what they stand on is there.
    fn put_initial(&mut self, parts: &[InitialPart]) -> Result<(), BuildError> {
        let mut blocks = Vec::new();
        for (index, part) in parts.iter().enumerate() {
            blocks.push((index, part, self.initial_block(index, part)?));
        }
        blocks.sort_by(|a, b| a.2.upright().place.z.total_cmp(&b.2.upright().place.z).then(a.0.cmp(&b.0)));
        for (index, part, mut block) in blocks {
            let refuse = |problem: &str| part_error(index, part, problem.to_owned());
            let Some((height, support)) = self.floor.beneath(&block, None) else {
                return Err(refuse("stands on nothing: put it on a conveyor, a pallet or a box"));
            };
            let mut upright = block.upright();
            upright.place.z = height;
            block.move_to(upright);
            if !self.floor.is_free(&block) {
                return Err(refuse("is in another part or in a plate: put it where there is room"));
            }
            self.floor.enter(part.kind, block, support);
        }
        Ok(())
    }

    fn initial_block(&self, index: usize, part: &InitialPart) -> Result<Block, BuildError> {
        let pose = frame_of(&part.pose);
        if !is_level(&pose) {
            return Err(part_error(index, part, "is tilted: parts stand upright, set its rx and ry to 0".to_owned()));
        }
        let mut upright = Upright::from_pose(&pose);
        if let Some(name) = &part.on {
            let Some(belt) = self.floor.belts.iter().find(|belt| belt.name == *name) else {
                return Err(part_error(index, part, format!("stands on {name:?}, which is no conveyor of the plant")));
            };
            let along = Along { station: part.pose.x, offset: part.pose.y };
            let (place, heading) = belt.surface.at(along);
            upright.place = place.extend(belt.surface.height() + part.pose.z);
            upright.yaw += heading;
        }
        Ok(Block::new(DVec3::from_array(part.size), upright))
    }
}

/// The device of a task with its instance's effects. What cannot be is told of the first effect that makes it so.
fn device_of(plant: &Plant, instance: &Instance, task: &Task, seed: u64) -> Result<Box<dyn Device>, BuildError> {
    let tasks: Vec<&str> = instance.tasks.iter().map(|task| task.name.as_str()).collect();
    let with = |effects: &[EffectSpec]| {
        let effects = effect::of_task(effects, &task.name, &tasks);
        effect::build(task.kind, &task.parameters, &instance.name, &effects, seed)
    };
    let refuse = |index: usize, error| {
        let instance = instance.name.clone();
        BuildError::Effect { instance, index, error: Box::new(error) }
    };
    for (index, spec) in instance.effects.iter().enumerate() {
        let places = plant.places.effect(&instance.name, index);
        let unit_of = |name: &str| Some(places?.parameters.get(name)?.1.as_ref()?.value);
        effect::refuse_units(spec, unit_of).map_err(|error| refuse(index, error))?;
    }
    let refused = match with(&instance.effects) {
        Ok(device) => return Ok(device),
        Err(refused) => refused,
    };
    if let Err(effect::EffectError::Device(error)) = with(&[]) {
        return Err(BuildError::Device(error));
    }
    let counts = 1..instance.effects.len();
    let first = counts.into_iter().find_map(|count| Some((count - 1, with(&instance.effects[..count]).err()?)));
    let (index, error) = first.unwrap_or((instance.effects.len() - 1, refused));
    Err(refuse(index, error))
}

fn part_error(index: usize, part: &InitialPart, problem: String) -> BuildError {
    let kind = format!("{:?}", part.kind).to_lowercase();
    let Pose { x, y, z, .. } = part.pose;
    let of = part.on.as_ref().map(|name| format!(" of {name}")).unwrap_or_default();
    BuildError::Part { index: index + 1, name: format!("a {kind} at x {x}, y {y}, z {z}{of}"), problem }
}

/// A pose of the plant's file: turned about the fixed x, y and z axes, in this order.
fn frame_of(pose: &Pose) -> DPose3 {
    let about = DQuat::from_rotation_z(pose.rz) * DQuat::from_rotation_y(pose.ry) * DQuat::from_rotation_x(pose.rx);
    DPose3::from_parts(DVec3::new(pose.x, pose.y, pose.z), about)
}

/// Collects the bodies of the floor.
#[derive(Default)]
struct Builder {
    frames: FrameTree,
    floor: Floor,
    mounts: Vec<Mount>,
    belts: BTreeMap<String, usize>,
    /// The units of robots, and the frames of their tools.
    tools: BTreeMap<String, (usize, FrameId)>,
}

impl Builder {
    /// Adds what a device is to the parts. What needs a neighbour waits for [`Builder::connect`].
    fn add(&mut self, instance: &Instance, unit: usize, device: &dyn Device) -> Result<UnitBody, BuildError> {
        let pose = frame_of(&instance.pose);
        let role = device.role();
        if !matches!(role, Role::Apart | Role::Makes(_) | Role::Takes(_)) && !is_level(&pose) {
            return Err(BuildError::Tilted { instance: instance.name.clone() });
        }
        Ok(match role {
            Role::Carries(belt) => {
                self.belts.insert(instance.name.clone(), self.floor.belts.len());
                self.floor.belts.push(belt_body(&instance.name, &pose, belt));
                UnitBody::Belt(self.floor.belts.len() - 1)
            }
            Role::Pushes(plate) => UnitBody::Plate(self.floor.add_plate(PlateBody::new(&instance.name, &pose, plate))),
            Role::Moves(_) => {
                let base = self.frames.add(None, pose);
                let tool = self.frames.add(Some(base), DPose3::IDENTITY);
                self.tools.insert(instance.name.clone(), (unit, tool));
                UnitBody::Robot(tool)
            }
            Role::Looks(look) => {
                self.floor.eyes.push(Eye::new(look, &pose));
                UnitBody::Eye(self.floor.eyes.len() - 1)
            }
            Role::Apart | Role::Holds(_) | Role::Makes(_) | Role::Takes(_) => UnitBody::Apart,
        })
    }

    /// Adds what hangs from a robot or serves a belt, now that all robots and belts are there.
    fn connect(&mut self, plant: &Plant, units: &mut [Unit]) -> Result<(), BuildError> {
        let tasks = plant.instances.iter().flat_map(|instance| instance.tasks.iter().map(move |task| (instance, task)));
        for (index, ((instance, task), unit)) in tasks.zip(units).enumerate() {
            match unit.device.role() {
                Role::Holds(cups) => unit.body = self.add_cups(instance, task, index, cups)?,
                Role::Makes(source) => {
                    let belt = self.belt_of(instance, task)?;
                    self.floor.bays.push(Bay { belt, source: source.clone(), made: 0 });
                    unit.body = UnitBody::Bay(self.floor.bays.len() - 1);
                }
                Role::Takes(sink) => {
                    let belt = self.belt_of(instance, task)?;
                    self.floor.add_drain(Drain { name: instance.name.clone(), belt, sink: *sink });
                    unit.body = UnitBody::Drain;
                }
                _ => {}
            }
        }
        self.floor.connect_belts();
        Ok(())
    }

    fn add_cups(
        &mut self,
        instance: &Instance,
        task: &Task,
        gripper: usize,
        cups: &Cups,
    ) -> Result<UnitBody, BuildError> {
        let robot = task.parameters.text("robot");
        let offset = DPose3::from_translation(DVec3::from_array(cups.offset));
        let frame = if robot.is_empty() {
            self.frames.add(None, frame_of(&instance.pose) * offset)
        } else {
            let expected = "a CartesianRobot of the plant";
            let found = self.tools.get(robot).copied();
            let (robot, tool) = found.ok_or_else(|| neighbour(instance, "robot", robot, expected))?;
            if let Some(suction) = task.kind.port("suctionOn") {
                let register = task.ports.get(suction).copied().flatten();
                self.mounts.push(Mount { robot, gripper, suction, register, is_closed: false });
            }
            self.frames.add(Some(tool), offset)
        };
        let index = self.floor.add_cups(CupsBody {
            name: instance.name.clone(),
            rim: *self.frames.world(frame),
            reach: cups.reach,
            vacuum: false,
            always_sealed: cups.always_sealed,
            held: None,
        });
        Ok(UnitBody::Cups(index, frame))
    }

    fn belt_of(&self, instance: &Instance, task: &Task) -> Result<usize, BuildError> {
        let name = task.parameters.text("belt");
        let expected = "a StraightConveyor or ConveyorCurve of the plant";
        self.belts.get(name).copied().ok_or_else(|| neighbour(instance, "belt", name, expected))
    }
}

fn neighbour(instance: &Instance, property: &'static str, found: &str, expected: &'static str) -> BuildError {
    BuildError::Neighbour { instance: instance.name.clone(), property, found: found.to_owned(), expected }
}

fn belt_body(name: &str, pose: &DPose3, belt: &Belt) -> BeltBody {
    let shape = match belt.surface {
        DeviceSurface::Straight { length, width } => Shape::Straight { length, width },
        DeviceSurface::Curve { radius, angle, width } => Shape::Curve { radius, angle, width },
    };
    let surface = Surface::new(shape, pose);
    let beams = belt.barriers.map(|at| at.map(|station| surface.beam(station, belt.beam_height)));
    BeltBody {
        name: name.to_owned(),
        surface,
        transfer: belt.transfer,
        transfer_slip: 0.0,
        grip: f64::INFINITY,
        displacement: 0.0,
        speeds: [0.0; 2],
        neighbours: Vec::new(),
        open: [true; 2],
        beams,
        clear: Default::default(),
        drains: Vec::new(),
    }
}
