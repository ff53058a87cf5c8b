//! A plant assembled from its prototypes: instances with their parameters in SI, the parts that stand in it at the start,
//! and the signals map that follows from it.

mod assemble;
mod effect_spec;
pub mod effects_file;
pub mod embedded;
mod file;
mod insert;
mod instance;
mod load;
mod parameter;
mod places;
mod shapes;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crate::prototype::kind::KindDescriptor;
use crate::prototype::structure::Structure;
use crate::signal_map::{RegisterId, SignalMap};

pub use self::effect_spec::{EffectPlace, EffectSpec};
pub use self::insert::{Edited, insert};
pub use self::load::{ModelError, load, locate};
pub use self::places::{EffectPlaces, Places};

/// A plant, ready to be built into an engine.
#[derive(Clone, Debug)]
pub struct Plant {
    pub name: String,
    /// Where the automation is and how often to speak with it.
    pub adapter: AdapterSettings,
    pub instances: Vec<Instance>,
    /// Parts that stand in the plant at t = 0.
    pub parts: Vec<InitialPart>,
    /// All signals; its registers are what the tasks' ports are bound to.
    pub signal_map: Arc<SignalMap>,
    /// Where in its files it says what.
    pub places: Places,
}

impl Plant {
    /// What is no mistake and may yet not be meant, one line each: signals that the automation has and nothing in the
    /// plant takes or gives.
    pub fn remarks(&self) -> Vec<String> {
        let unmapped = self.signal_map.signals().iter().filter(|signal| signal.task.is_empty());
        unmapped.map(|signal| format!("{} leads nowhere: it has no <map> in its avatar", signal.name)).collect()
    }
}

/// The host of a plant whose automation runs in the same process, on a free port: what needs no other machine.
pub const EMBEDDED_HOST: &str = "embedded";

/// The connection settings in a plant's file; a flag on the command line overrides each.
#[derive(Clone, Debug, PartialEq)]
pub struct AdapterSettings {
    /// The automation's host, or [`EMBEDDED_HOST`], which is meant where the file names none.
    pub host: String,
    pub port: u16,
    /// How long an answer may take.
    pub timeout: Duration,
    /// The signals map's file, relative to the project; `None` where the map follows from the plant alone.
    pub signals_map: Option<String>,
    /// Refresh interval of the high-frequency loop.
    pub high_frequency: Duration,
    /// Refresh interval of the low-frequency loop.
    pub low_frequency: Duration,
}

/// A place and an attitude: metres, and rotations about the fixed x, y and z axes, in this order, in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub rx: f64,
    pub ry: f64,
    pub rz: f64,
}

/// One device in its place.
#[derive(Clone, Debug)]
pub struct Instance {
    pub name: String,
    /// The name of its prototype.
    pub prototype: String,
    pub pose: Pose,
    pub tasks: Vec<Task>,
    /// The parameters of its prototype's meta-descriptor, by name, in SI units: what its shape follows from.
    pub shape: BTreeMap<String, ParameterValue>,
    /// What its prototype's files make of them; `None` where there are none and the shape is that of its device kinds. Instances
    /// of one prototype whose parameters affect the geometry alike share it.
    pub structure: Option<Arc<Structure>>,
    /// What its device adds to the nominal law.
    pub effects: Vec<EffectSpec>,
}

/// A task of an instance: one device of the engine.
#[derive(Clone, Debug)]
pub struct Task {
    /// Its name within the prototype.
    pub name: String,
    pub kind: &'static KindDescriptor,
    /// Every parameter of the kind, resolved.
    pub parameters: Parameters,
    /// The register that each port of the kind is bound to, in the order of `kind.ports`; `None` for a port not mapped.
    pub ports: Vec<Option<RegisterId>>,
}

/// The value of a parameter, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterValue {
    Number(f64),
    Integer(i64),
    Boolean(bool),
    /// A text, a choice or the name of an instance.
    Text(String),
    Numbers(Vec<f64>),
}

/// A parameter's value, and how far the real device's may lie from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    pub value: ParameterValue,
    /// Relative: 0.01 where the file says nothing, 0 for a machine built exactly to the model.
    pub tolerance: f64,
}

/// All parameters of a task. The plant checks them against the kind's table when it is assembled, so that a device may
/// ask for its own without looking twice: asking for what the kind does not declare is a bug, and panics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters(pub BTreeMap<&'static str, Parameter>);

impl Parameters {
    fn get(&self, name: &str) -> &ParameterValue {
        match self.0.get(name) {
            Some(parameter) => &parameter.value,
            None => unreachable!("the device's kind declares no parameter {name:?}"),
        }
    }

    /// A number, in SI units.
    pub fn number(&self, name: &str) -> f64 {
        match self.get(name) {
            ParameterValue::Number(number) => *number,
            other => unreachable!("{name:?} is declared as a number, not {other:?}"),
        }
    }

    /// A whole number.
    pub fn integer(&self, name: &str) -> i64 {
        match self.get(name) {
            ParameterValue::Integer(number) => *number,
            other => unreachable!("{name:?} is declared as an integer, not {other:?}"),
        }
    }

    /// A switch.
    pub fn boolean(&self, name: &str) -> bool {
        match self.get(name) {
            ParameterValue::Boolean(value) => *value,
            other => unreachable!("{name:?} is declared as a boolean, not {other:?}"),
        }
    }

    /// A text, a choice, or the name of an instance (empty for none).
    pub fn text(&self, name: &str) -> &str {
        match self.get(name) {
            ParameterValue::Text(text) => text,
            other => unreachable!("{name:?} is declared as a text, not {other:?}"),
        }
    }

    /// A list of numbers, in SI units.
    pub fn numbers(&self, name: &str) -> &[f64] {
        match self.get(name) {
            ParameterValue::Numbers(numbers) => numbers,
            other => unreachable!("{name:?} is declared as numbers, not {other:?}"),
        }
    }
}

/// What kind of part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PartKind {
    Box,
    Pallet,
}

/// A part that stands in the plant at t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialPart {
    pub kind: PartKind,
    /// Length, width, height in metres.
    pub size: [f64; 3],
    /// The centre of its bottom face: in the world, or, with `on`, relative to that conveyor: x along its centre line from its
    /// start, y to the left of it, z above its surface, turned from its running direction there.
    pub pose: Pose,
    /// The conveyor that its pose is relative to.
    pub on: Option<String>,
}
