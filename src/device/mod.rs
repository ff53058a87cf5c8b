//! The device kinds with their nominal motion laws, one file each.
//!
//! A device computes in SI units and knows neither registers nor names: the engine hands it commands by port, asks it to
//! move by some seconds, and asks for its reports. It may be moved by any span, not only by the engine's step: a
//! diagnosis applies commands at their recorded instants and samples reports at theirs.

mod axis;
#[cfg(test)]
pub(crate) mod bench;
mod cartesian_robot;
mod conveyor;
mod conveyor_curve;
mod cylinder;
mod dispenser;
mod driven;
mod encoder_motor;
mod inverter_conveyor;
pub mod law;
mod loading_bay;
pub mod path;
mod pusher;
mod sensor;
mod servo_axis;
mod servo_path;
mod six_axis_robot;
mod straight_conveyor;
mod suction_cap_gripper;
mod table;
mod unloading_bay;

use self::path::Stages;
use crate::plant::{Parameters, PartKind};
use crate::prototype::kind::KindDescriptor;

/// Every device kind there is.
pub static KINDS: &[&KindDescriptor] = &[
    &straight_conveyor::KIND,
    &conveyor_curve::KIND,
    &pusher::KIND,
    &cartesian_robot::KIND,
    &suction_cap_gripper::KIND,
    &loading_bay::KIND,
    &unloading_bay::KIND,
    &servo_axis::KIND,
    &encoder_motor::KIND,
    &sensor::BOX,
    &sensor::PROXIMITY,
    &sensor::VISION,
    &inverter_conveyor::KIND,
    &dispenser::KIND,
    &six_axis_robot::KIND,
];

/// The boolean reports whose sensors look along a way: those for which [`Device::travel`] has an answer.
pub const SWITCHES_ALONG_A_WAY: &[&str] =
    &["lightBarrierA", "lightBarrierB", "lightbarrierA", "lightbarrierB", "limitExtended", "limitRetracted"];

/// Parameters that are each in their range, and do not fit together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{instance}: {parameter} {problem}")]
pub struct BuildError {
    /// The instance whose device it is.
    pub instance: String,
    /// The parameter to change.
    pub parameter: &'static str,
    /// What is wrong with it, found and expected.
    pub problem: String,
}

/// Builds a device of `kind` for the instance called `instance`, at rest, all commands 0 or false (an axis's
/// `torqueEnabled` true), its clock at 0.
///
/// `seed` is the run's: with the instance's name it fixes everything that is random about the device.
pub fn build(
    kind: &KindDescriptor,
    parameters: &Parameters,
    instance: &str,
    seed: u64,
) -> Result<Box<dyn Device>, BuildError> {
    match kind.name {
        "kinetwin.StraightConveyor" => straight_conveyor::build(parameters, instance),
        "kinetwin.ConveyorCurve" => conveyor_curve::build(parameters, instance),
        "kinetwin.Pusher" => pusher::build(parameters, instance),
        "kinetwin.CartesianRobot" => Ok(cartesian_robot::build(parameters)),
        "kinetwin.SuctionCapGripper" => suction_cap_gripper::build(parameters, instance),
        "kinetwin.LoadingBay" => loading_bay::build(parameters, instance, seed),
        "kinetwin.UnloadingBay" => unloading_bay::build(parameters, instance),
        "kinetwin.ServoAxis" => servo_axis::build(parameters, instance),
        "kinetwin.EncoderMotor" => Ok(encoder_motor::build(parameters)),
        "kinetwin.BoxSensor" | "kinetwin.ProximitySensor" | "kinetwin.VisionSensor" => {
            sensor::build(kind.name, parameters, instance)
        }
        "kinetwin.InverterConveyor" => inverter_conveyor::build(parameters, instance),
        "kinetwin.Dispenser" => dispenser::build(parameters, instance),
        "kinetwin.SixAxisRobot" => six_axis_robot::build(parameters, instance),
        other => unreachable!("{other:?} stands in no table of device kinds"),
    }
}

/// An error about one parameter of an instance.
fn misfit(instance: &str, parameter: &'static str, problem: impl Into<String>) -> BuildError {
    BuildError { instance: instance.to_owned(), parameter, problem: problem.into() }
}

/// A parameter that is three lengths.
fn triple(parameters: &Parameters, name: &'static str, instance: &str) -> Result<[f64; 3], BuildError> {
    let numbers = parameters.numbers(name);
    numbers.try_into().map_err(|_| misfit(instance, name, format!("has {} numbers, not 3", numbers.len())))
}

/// `box` or `pallet`.
fn part_kind(word: &str) -> PartKind {
    if word == "pallet" { PartKind::Pallet } else { PartKind::Box }
}

/// One device.
///
/// Time passes only in [`advance`](Device::advance). Between two calls its commands are constant, so that a law with a
/// closed form is computed exactly whatever the span.
pub trait Device: Send {
    /// Takes the value of a command port, in SI units (BOOL as 0 or 1), from now on. The value is finite; one that the
    /// port's range excludes is refused before it comes here. Of several commands at one instant only the last of each
    /// port counts. Until the first, a port is 0 or false, but an axis's `torqueEnabled`, which is true: whoever maps it
    /// hands its register's value in before time passes.
    fn command(&mut self, port: usize, value: f64);

    /// What the world about it is like now; called after parts have moved and before [`report`](Device::report).
    fn sense(&mut self, _surroundings: &Surroundings) {}

    /// Moves by `seconds`.
    fn advance(&mut self, seconds: f64);

    /// Writes the state as it is now into the report ports' places of `reports`, which has one place for every port of
    /// the kind; in SI units, BOOL as 0 or 1. What follows its command at once already follows it here.
    fn report(&mut self, reports: &mut [f64]);

    /// From now on counters are reported as the numbers that they are rounded from, and do not wrap: a diagnosis compares
    /// before all rounding.
    fn count_finely(&mut self) {}

    /// Gives every number of the state to `visit`, in an order that never changes: for the state's hash.
    fn state(&self, visit: &mut dyn FnMut(f64));

    /// A copy with its state.
    fn boxed(&self) -> Box<dyn Device>;

    /// Whether time changes nothing about it any more, neither its state nor its reports nor its role, until it is told something
    /// or the world about it changes: one more step apart, moving it does nothing. Who cannot be sure says no, and is visited
    /// at every step.
    fn rests(&self) -> bool {
        false
    }

    /// For how long at least every report that steps, a BOOL or a code, stays what it is if it is told nothing and the world about it
    /// stays, s; 0 where that is not known. Who looks for the instant of a step need not look before.
    fn unchanged_for(&self) -> f64 {
        if self.rests() { f64::INFINITY } else { 0.0 }
    }

    /// Where effects inside the device are put: the stages of the component so called, or of the whole device. `None`
    /// where there is no such component, or nothing inside that an effect could act on.
    fn stages(&mut self, _component: Option<&str>) -> Option<&mut Stages> {
        None
    }

    /// What the boolean sensor of a report port looks along, m or rad: how far the belt or the rod has moved. `None` where
    /// it looks along nothing that moves.
    fn travel(&self, _port: usize) -> Option<f64> {
        None
    }

    /// How many of its actuators move now: what else is on their supply may feel it.
    fn moving(&self) -> u32 {
        0
    }

    /// From now on so many actuators of other devices on the same supply move.
    fn share(&mut self, _others: u32) {}

    /// Is elsewhere at once, and faster, by so much: a diagnosis takes a device up where its machine was. False where its state is
    /// not a position and a velocity alone, and nothing happens.
    fn shift(&mut self, _by: path::Motion) -> bool {
        false
    }

    /// Gives the joints of its shape to `visit`, always in the same order: the joint's name within the instance
    /// (`Spintore.T`), and its value, m or rad.
    fn joints(&self, _visit: &mut dyn FnMut(&'static str, f64)) {}

    /// Gives the joints to `visit` as [`joints`](Device::joints) does, where a machine's `reports` put them: one place for every
    /// port of the kind, in SI units, `None` where nothing was reported. What reports leave open is the model's.
    fn reported_joints(&self, _reports: &[Option<f64>], visit: &mut dyn FnMut(&'static str, f64)) {
        self.joints(visit);
    }

    /// What it is to the parts.
    fn role(&self) -> Role<'_> {
        Role::Apart
    }
}

/// Gives the joints of `device` to `visit` where `reports`, one for each of them in their order, put them.
fn joints_where_reported(device: &impl Device, reports: &[Option<f64>], visit: &mut dyn FnMut(&'static str, f64)) {
    let mut reports = reports.iter();
    device.joints(&mut |name, own| visit(name, reports.next().copied().flatten().unwrap_or(own)));
}

impl Clone for Box<dyn Device> {
    fn clone(&self) -> Self {
        self.boxed()
    }
}

/// What a device learns of the world about it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// A part cuts the beam of light barrier A.
    pub barrier_a: bool,
    /// A part cuts the beam of light barrier B.
    pub barrier_b: bool,
    /// A part is sealed at the cups; while vacuum holds a part it stays so.
    pub sealed: bool,
    /// How many parts a belt carries, a plate pushes, or a robot's cups hold, those that stand on others apart.
    pub parts: u32,
    /// How many of a belt's parts are held back by what stands in their way.
    pub queued: u32,
    /// What a sensor that looks at parts sees.
    pub sensed: Sensed,
    /// How many parts a source has put on its belt, their loads apart.
    pub made: u32,
}

/// What a sensor sees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensed {
    /// How many parts are where it looks.
    pub count: u32,
    /// How far the nearest of them is: along the ray, or from the centre of the box to its own, m.
    pub distance: Option<f64>,
    /// What kind that one is.
    pub nearest: Option<PartKind>,
}

/// Where a sensor looks, in the frame of its instance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// Into a box along the frame's axes, m.
    Box { centre: [f64; 3], size: [f64; 3] },
    /// Along x, so many metres.
    Ray { range: f64 },
}

/// What a device is to the parts: how the engine's part phase sees it.
#[derive(Debug)]
pub enum Role<'a> {
    /// It touches no part.
    Apart,
    /// It carries parts.
    Carries(&'a Belt),
    /// It pushes parts.
    Pushes(&'a Plate),
    /// It moves a tool in space.
    Moves(&'a Tool),
    /// It holds a part by its cups.
    Holds(&'a Cups),
    /// It puts parts on a belt.
    Makes(&'a Source),
    /// It takes parts off a belt.
    Takes(&'a Sink),
    /// It looks at parts.
    Looks(&'a Look),
}

/// The shape of a conveyor's surface, in the frame of its instance: x along it, y to its left, z up, the surface at z = 0
/// and its start at x = 0 on the centre line y = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    Straight {
        length: f64,
        width: f64,
    },
    /// An arc of `radius` on the centre line that turns by `angle` (radians, to the left if positive) from the x direction.
    Curve {
        radius: f64,
        angle: f64,
        width: f64,
    },
}

impl Surface {
    /// Length of the centre line, m.
    pub fn length(&self) -> f64 {
        match *self {
            Surface::Straight { length, .. } => length,
            Surface::Curve { radius, angle, .. } => radius * angle.abs(),
        }
    }
}

/// A conveyor's surface and how far it moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belt {
    pub surface: Surface,
    /// Speed along the centre line before the last `advance` and now, m/s.
    pub speeds: [f64; 2],
    /// How far the surface moved in the last `advance`, m on the centre line.
    pub displacement: f64,
    /// Where the beams of the light barriers cross, m along the centre line from the start.
    pub barriers: [Option<f64>; 2],
    /// Height of the beams above the surface, m.
    pub beam_height: f64,
    /// How a part that stands on this belt and on another is carried.
    pub transfer: Transfer,
    /// Which share of its way on this belt such a part loses; 0 nominally.
    pub transfer_slip: f64,
    /// The steepest change of speed that parts follow, m/s²; infinite nominally.
    pub grip: f64,
}

/// How a part on two belts moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// With the belt that carries most of its footprint.
    Most,
    /// With both, by the share of its footprint that each carries.
    Share,
}

/// A pusher's plate: a box that moves along +x of its instance's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// Where its front face stands, m: 0 when retracted.
    pub position: f64,
    /// How far it moved in the last `advance`, m.
    pub displacement: f64,
    /// Thickness (x), width (y), height (z) of the plate, m. It lies behind the front face, on z = 0, centred on y = 0.
    pub size: [f64; 3],
    /// Where along x the beams of its light barriers cross, m from the retracted front face; they lie along y.
    pub barriers: [Option<f64>; 2],
    /// Height of the beams above z = 0, m.
    pub beam_height: f64,
}

/// Where a robot holds its tool, in the frame of its instance: metres, and the rotation about z in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tool {
    pub position: [f64; 3],
    pub rotation: f64,
    /// Whether it closes the gripper mounted on it.
    pub grip: bool,
}

/// A suction gripper's cups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cups {
    /// Where the cups' rim lies from the tool of the robot that carries it, m.
    pub offset: [f64; 3],
    /// How far below the rim a part's top may lie and still be sealed, m.
    pub reach: f64,
    /// Vacuum holds: the part at the cups follows them.
    pub vacuum: bool,
    /// Whether a part is taken to be sealed always, with no part in the model.
    pub always_sealed: bool,
}

/// A loading bay: what it puts on which belt, and when. Which belt is the bay's parameter `belt`.
///
/// The engine puts a part there for every instant in `due` where the place is free, and skips the instant otherwise;
/// it stops after `limit` parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Where the part's centre is put: along the belt's centre line from its start, and to the left of it, m.
    pub at: [f64; 2],
    /// How far it is turned to the left from the running direction there, rad.
    pub turn: f64,
    pub kind: PartKind,
    /// Length, width, height of the part, m.
    pub size: [f64; 3],
    /// What stands on it.
    pub load: Option<Load>,
    /// How many parts it puts there at most, the load's apart.
    pub limit: Option<u64>,
    /// The instants that fell due in the last `advance`, each as the seconds that passed from it to the advance's end,
    /// the oldest first. Before the first `advance`: those due at t = 0.
    pub due: Vec<f64>,
}

/// A regular stack of parts that stands on a part, centred on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    pub kind: PartKind,
    /// Length, width, height of each, m.
    pub size: [f64; 3],
    /// How many along the part's length, along its width, and one on the other; each at least 1.
    pub counts: [u32; 3],
    /// Room between neighbours in a layer, m.
    pub gap: f64,
}

/// An unloading bay: what it takes off which belt. Which belt is the bay's parameter `belt`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sink {
    pub place: Place,
    /// What kind it takes; any if `None`. What stands on a part goes with it.
    pub kind: Option<PartKind>,
    /// How long a part stays at the place until it is gone, s.
    pub delay: f64,
}

/// Where on a belt's centre line a part is taken: when its centre passes there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// The end, running forwards.
    End,
    /// The start, running backwards.
    Start,
    /// So many metres from the start, running either way.
    At(f64),
}
