//! What a device kind of the engine declares about itself, so that a model file can be checked against it when it is
//! read: a task's type must be a kind, a map's property one of its ports, a property one of its parameters.
//!
//! The words stand here, in the row that reads models; the kinds themselves stand in `device`, which hands its table in.

use crate::signal_map::{Direction, Kind};
use crate::value::Quantity;

/// A device kind, as a `<task type="...">` names it.
#[derive(Debug)]
pub struct KindDescriptor {
    /// As written in the task's `type`: `kinetwin.StraightConveyor`.
    pub name: &'static str,
    /// One sentence for people.
    pub summary: &'static str,
    /// What it can exchange with the automation. A port's place here is its index in every call to the device.
    pub ports: &'static [PortDescriptor],
    /// What can be set about it.
    pub parameters: &'static [ParameterDescriptor],
}

impl KindDescriptor {
    /// The index of the port called `name`.
    pub fn port(&self, name: &str) -> Option<usize> {
        self.ports.iter().position(|port| port.name == name)
    }

    /// The parameter called `name`.
    pub fn parameter(&self, name: &str) -> Option<&'static ParameterDescriptor> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }
}

/// What kind of value a port takes or gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PortType {
    /// A BOOL signal.
    Boolean,
    /// An integer signal of any width.
    Integer,
    /// A REAL or LREAL signal.
    Real,
}

/// A port of a device kind: where a signal comes in or goes out.
#[derive(Debug, PartialEq)]
pub struct PortDescriptor {
    pub name: &'static str,
    pub direction: Direction,
    pub ty: PortType,
    /// The quantities its unit may be of: one, or a linear and a rotary one.
    pub quantities: &'static [Quantity],
    pub kind: Kind,
    /// The least and the greatest value allowed, in SI units; values outside are refused with 422.
    pub range: Option<(f64, f64)>,
    pub summary: &'static str,
}

/// What a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterType {
    /// A number with a unit, kept in SI.
    Number {
        min: f64,
        max: f64,
    },
    /// A whole number.
    Integer {
        min: i64,
        max: i64,
    },
    Boolean,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Any text.
    Text,
    /// A list of exactly `count` numbers of one unit, or of any where that is 0, separated by `;` or blanks, each kept in SI.
    Numbers {
        count: usize,
        min: f64,
        max: f64,
    },
    /// The name of another instance of the plant; empty means none.
    Instance,
}

/// A parameter of a device kind.
#[derive(Debug)]
pub struct ParameterDescriptor {
    pub name: &'static str,
    pub ty: ParameterType,
    /// The quantities its unit may be of: one, or a linear and a rotary one.
    pub quantities: &'static [Quantity],
    /// Its value where nobody sets it, written in SI units as in a file.
    pub default: &'static str,
    pub summary: &'static str,
}
