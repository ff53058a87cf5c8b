//! One device of a plant that was drawn: its name and what it is built to.

use crate::belt::{Belt, BeltParameters};
use crate::gripper::{Gripper, GripperParameters};
use crate::motor::{Motor, MotorParameters};
use crate::plant::{Device, Kind, Signal};
use crate::ports;
use crate::pusher::{Pusher, PusherParameters};
use crate::quirk::Quirk;
use crate::robot::{Robot, RobotParameters};
use crate::script::Program;
use crate::servo::{Servo, ServoParameters};

use super::sizes::Sizes;
use crate::chance::Dice;

/// A device with its name.
#[derive(Clone, Debug)]
pub struct Unit {
    pub name: String,
    pub figures: Figures,
}

/// What a device is built to, and how far or how fast its program sends it.
#[derive(Clone, Debug)]
pub enum Figures {
    Belt {
        parameters: BeltParameters,
        /// The bay that feeds it.
        feed: String,
        /// The fastest that it is told, m/s.
        top: f64,
    },
    Pusher(PusherParameters),
    Robot {
        parameters: RobotParameters,
        /// How far each axis is sent either way, m and rad.
        reach: [f64; 4],
    },
    Gripper(GripperParameters),
    Servo {
        parameters: ServoParameters,
        /// How far it is sent either way, m.
        reach: f64,
        /// What its force is rounded to, N.
        newton: f64,
    },
    Motor {
        parameters: MotorParameters,
        /// The fastest that it is told, rad/s.
        top: f64,
    },
}

/// What of the device of this name is built to a tolerance.
pub fn measures<'a>(units: &'a mut [Unit], device: &str) -> Vec<&'a mut f64> {
    let unit = units.iter_mut().find(|unit| unit.name == device);
    unit.map_or_else(Vec::new, |unit| unit.figures.measures())
}

impl Figures {
    /// What the rig calls a device of this kind.
    pub fn kind(&self) -> &'static str {
        match self {
            Figures::Belt { .. } => "Belt",
            Figures::Pusher(_) => "Pusher",
            Figures::Robot { .. } => "Robot",
            Figures::Gripper(_) => "Gripper",
            Figures::Servo { .. } => "Axis",
            Figures::Motor { .. } => "Motor",
        }
    }

    /// All measures that are built to a tolerance: what is counted or scheduled is exact.
    pub fn measures(&mut self) -> Vec<&mut f64> {
        match self {
            Figures::Belt { parameters: belt, .. } => {
                let [a, b] = &mut belt.barriers;
                vec![&mut belt.acceleration, &mut belt.box_length, a, b]
            }
            Figures::Pusher(pusher) => {
                let PusherParameters { stroke, extend_speed, retract_speed, limit_tolerance } = pusher;
                vec![stroke, extend_speed, retract_speed, limit_tolerance]
            }
            Figures::Robot { parameters: robot, .. } => {
                robot.fastest.iter_mut().chain(&mut robot.steepest).chain(&mut robot.tolerance).collect()
            }
            Figures::Gripper(gripper) => vec![&mut gripper.build_up, &mut gripper.release],
            Figures::Servo { parameters: servo, .. } => {
                let ServoParameters { mass, viscous, position_gain, velocity_gain, force_limit } = servo;
                vec![mass, viscous, position_gain, velocity_gain, force_limit]
            }
            Figures::Motor { parameters: motor, .. } => vec![&mut motor.acceleration],
        }
    }
}

impl Unit {
    /// The device with `quirks`; `seed` is that of what befalls its boxes.
    pub fn device(&self, quirks: &[Quirk], seed: u64) -> Box<dyn Device> {
        let name = &self.name;
        match &self.figures {
            Figures::Belt { parameters, feed, .. } => Box::new(Belt::new(parameters, quirks, name, feed, seed)),
            Figures::Pusher(parameters) => Box::new(Pusher::new(parameters, quirks, name)),
            Figures::Robot { parameters, .. } => Box::new(Robot::new(parameters, quirks, name)),
            Figures::Gripper(parameters) => Box::new(Gripper::new(parameters, quirks, name)),
            Figures::Servo { parameters, .. } => Box::new(Servo::new(parameters, quirks, name)),
            Figures::Motor { parameters, .. } => Box::new(Motor::new(parameters, quirks, name)),
        }
    }

    /// What it can be told.
    pub fn commands(&self) -> Vec<(String, Kind)> {
        let ports = match &self.figures {
            Figures::Belt { .. } => ports::BELT,
            Figures::Pusher(_) => ports::PUSHER,
            Figures::Robot { .. } => ports::ROBOT,
            Figures::Gripper(_) => ports::GRIPPER,
            Figures::Servo { .. } => ports::SERVO,
            Figures::Motor { .. } => ports::MOTOR,
        };
        ports::commands(&self.name, ports)
    }

    /// What it reports, in the order in which it reads.
    pub fn signals(&self) -> Vec<Signal> {
        let name = &self.name;
        match &self.figures {
            Figures::Belt { .. } => ports::belt(name),
            Figures::Pusher(_) => ports::pusher(name),
            Figures::Robot { .. } => ports::robot(name),
            Figures::Gripper(_) => ports::gripper(name),
            Figures::Servo { newton, .. } => ports::servo(name, *newton),
            Figures::Motor { .. } => ports::motor(name),
        }
    }

    /// Writes its part of the program: as the rig's, further, faster or slower as its sizes have it.
    pub fn program(&self, program: &mut Program, dice: &mut Dice) {
        let [own, rig] = [Sizes::of(&self.figures, ""), Sizes::of_rig(self.figures.kind(), "")];
        let name = &self.name;
        match &self.figures {
            Figures::Belt { .. } => program.belt(name, own.speed / rig.speed, dice),
            Figures::Pusher(_) => program.pusher(name, own.time() / rig.time(), dice),
            Figures::Robot { reach, .. } => {
                let longer = crate::robot::AXES.map(|axis| {
                    let [own, rig] = [Sizes::of(&self.figures, axis), Sizes::of_rig("Robot", axis)];
                    own.trip() / rig.trip()
                });
                program.robot(name, *reach, longer, dice);
            }
            Figures::Gripper(parameters) => program.gripper(name, (parameters.build_up / 0.15).max(1.0), dice),
            Figures::Servo { .. } => program.axis(name, own.way / rig.way, dice),
            Figures::Motor { .. } => program.motor(name, own.speed / rig.speed, dice),
        }
    }
}
