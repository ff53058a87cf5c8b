//! A server's interface against the plant's.

use std::collections::BTreeMap;
use std::fmt;

use crate::signal_map::{Direction, SignalMap};
use crate::value::SignalType;
use crate::wire::{Interface, InterfaceSignal, ResultCode, to_base64};

/// The interface of an automation for the plant that `map` describes: its outputs are the plant's commands, its inputs
/// the plant's reports.
pub fn interface_of(map: &SignalMap, server_name: &str) -> Interface {
    let side = |direction| {
        map.directed(direction)
            .map(|(_, signal)| InterfaceSignal { name: signal.name.clone(), ty: signal.ty.to_string() })
            .collect()
    };
    Interface {
        server_name: to_base64(server_name),
        result: ResultCode::OK,
        inputs: side(Direction::Report),
        outputs: side(Direction::Command),
    }
}

/// Something in which a server's interface and a plant's signals map differ. Reads as a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// The plant has the signal, the server does not.
    Missing { name: String, ty: SignalType, direction: Direction },
    /// The server has the signal, the plant does not.
    Extra { name: String, ty: String, direction: Direction },
    /// Both have it, with other types.
    Type { name: String, plant: SignalType, server: String },
    /// Both have it, and both take it for their output, or both for their input.
    Direction { name: String, plant: Direction },
    /// The server lists it more than once.
    Repeated { name: String },
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = |direction: &Direction| match direction {
            Direction::Command => "output",
            Direction::Report => "input",
        };
        match self {
            Mismatch::Missing { name, ty, direction } => {
                write!(f, "{name}: the server lacks it; expected an {} of type {ty}", side(direction))
            }
            Mismatch::Extra { name, ty, direction } => {
                write!(f, "{name}: the server has it as an {} of type {ty}, the plant does not", side(direction))
            }
            Mismatch::Type { name, plant, server } => {
                write!(f, "{name}: the server has type {server}, the plant {plant}")
            }
            Mismatch::Direction { name, plant: Direction::Command } => {
                write!(f, "{name}: the plant takes it as a command, and the server has it as an input, not an output")
            }
            Mismatch::Direction { name, plant: Direction::Report } => {
                write!(f, "{name}: the plant reports it, and the server has it as an output, not an input")
            }
            Mismatch::Repeated { name } => write!(f, "{name}: the server lists it more than once"),
        }
    }
}

/// All in which `interface` differs from `map`, by name, type and direction: first in the order of the map, then what
/// the server has beyond it, in the server's order.
pub fn mismatches(map: &SignalMap, interface: &Interface) -> Vec<Mismatch> {
    let sides = [(Direction::Report, &interface.inputs), (Direction::Command, &interface.outputs)];
    let listed =
        || sides.iter().flat_map(|(direction, signals)| signals.iter().map(move |signal| (*direction, signal)));
    let mut by_name: BTreeMap<&str, Vec<(Direction, &InterfaceSignal)>> = BTreeMap::new();
    for (direction, signal) in listed() {
        by_name.entry(&signal.name).or_default().push((direction, signal));
    }
    let mut found = Vec::new();
    for signal in map.signals() {
        let name = || signal.name.clone();
        let Some(theirs) = by_name.get(signal.name.as_str()) else {
            found.push(Mismatch::Missing { name: name(), ty: signal.ty, direction: signal.direction });
            continue;
        };
        if theirs.len() > 1 {
            found.push(Mismatch::Repeated { name: name() });
        }
        let (direction, listed) = theirs[0];
        if direction != signal.direction {
            found.push(Mismatch::Direction { name: name(), plant: signal.direction });
        }
        if listed.ty.trim().parse() != Ok(signal.ty) {
            found.push(Mismatch::Type { name: name(), plant: signal.ty, server: listed.ty.clone() });
        }
    }
    let extra = listed().filter(|(_, signal)| map.register(&signal.name).is_none());
    found.extend(extra.map(|(direction, signal)| Mismatch::Extra {
        name: signal.name.clone(),
        ty: signal.ty.clone(),
        direction,
    }));
    found
}
