//! Where an effect is about to stand: what it may know of its device.

use crate::plant::{EffectPlace, Parameters};
use crate::prototype::kind::{KindDescriptor, PortDescriptor, PortType};
use crate::signal_map::Kind;

/// The site of an effect.
#[derive(Clone, Copy, Debug)]
pub struct Site<'a> {
    /// The kind of its device.
    pub kind: &'a KindDescriptor,
    /// Its device's parameters, as they are with all `parameter-error`s.
    pub parameters: &'a Parameters,
    pub place: EffectPlace,
    /// The signal that passes; `None` inside a device.
    pub port: Option<&'a PortDescriptor>,
    /// What all that is random about the effect follows from: the run's seed, the instance, the port and the effect.
    pub seed: u64,
}

impl Site<'_> {
    /// The last word of the kind's name: `StraightConveyor`.
    pub fn short(&self) -> &str {
        self.kind.name.rsplit('.').next().unwrap_or(self.kind.name)
    }

    /// A servo axis, in whatever mode.
    pub fn is_servo(&self) -> bool {
        self.short() == "ServoAxis"
    }

    /// A servo axis that is where it is told to be.
    pub fn is_ideal(&self) -> bool {
        self.is_servo() && self.parameters.text("mode") == "ideal"
    }

    /// A servo axis with forces and masses.
    pub fn has_dynamics(&self) -> bool {
        self.is_servo() && !self.is_ideal()
    }

    /// A cylinder between end stops.
    pub fn is_stroke(&self) -> bool {
        self.short() == "Pusher"
    }

    /// A robot's axis.
    pub fn is_robot(&self) -> bool {
        self.short() == "CartesianRobot"
    }

    /// Whether the signal goes to the device.
    pub fn is_command(&self) -> bool {
        self.place == EffectPlace::CommandLink
    }

    /// Whether the signal is a BOOL.
    pub fn is_boolean(&self) -> bool {
        self.port.is_some_and(|port| port.ty == PortType::Boolean)
    }

    /// Whether the signal is a whole number.
    pub fn is_whole(&self) -> bool {
        self.port.is_some_and(|port| port.ty == PortType::Integer)
    }

    /// Whether the signal is a measured quantity that moves without jumps, so that it may be looked up between samples.
    pub fn is_smooth(&self) -> bool {
        !self.is_command() && self.port.is_some_and(|port| port.kind == Kind::Level && port.ty != PortType::Boolean)
    }
}
