//! Short forms for the kinds' tables of ports and parameters.

use crate::prototype::kind::{ParameterDescriptor, ParameterType, PortDescriptor, PortType};
use crate::signal_map::{Direction, Kind};
use crate::value::Quantity;

/// Quantities of a drive that is linear or rotary.
pub(super) const TRAVEL: &[Quantity] = &[Quantity::Length, Quantity::Angle];
pub(super) const SPEED: &[Quantity] = &[Quantity::Velocity, Quantity::AngularVelocity];
pub(super) const EFFORT: &[Quantity] = &[Quantity::Force, Quantity::Torque];
/// Quantities of one kind only.
pub(super) const LENGTH: &[Quantity] = &[Quantity::Length];
pub(super) const ANGLE: &[Quantity] = &[Quantity::Angle];
pub(super) const TIME: &[Quantity] = &[Quantity::Time];
pub(super) const VELOCITY: &[Quantity] = &[Quantity::Velocity];
pub(super) const ANGULAR_VELOCITY: &[Quantity] = &[Quantity::AngularVelocity];
pub(super) const ACCELERATION: &[Quantity] = &[Quantity::Acceleration];
pub(super) const ANGULAR_ACCELERATION: &[Quantity] = &[Quantity::AngularAcceleration];
pub(super) const ONE: &[Quantity] = &[Quantity::One];

/// The longest length, stroke or radius a plant may have, m.
pub(super) const LONGEST_M: f64 = 1e3;
/// The highest speed of a linear drive, m/s, and of a rotary one, rad/s.
pub(super) const FASTEST: f64 = 1e4;
/// The highest acceleration of a drive, m/s² or rad/s².
pub(super) const STEEPEST: f64 = 1e6;
/// The lowest speed or acceleration that may be asked of a drive that has to move at all.
pub(super) const LEAST: f64 = 1e-6;
/// The longest time a parameter may set, s: a day.
pub(super) const LONGEST_S: f64 = 86_400.0;

/// A BOOL that the automation sets.
pub(super) const fn switch(name: &'static str, summary: &'static str) -> PortDescriptor {
    PortDescriptor {
        name,
        direction: Direction::Command,
        ty: PortType::Boolean,
        quantities: ONE,
        kind: Kind::Edge,
        range: None,
        summary,
    }
}

/// A coded integer that the automation sets; other values than `low` to `high` are refused.
pub(super) const fn code(name: &'static str, low: f64, high: f64, summary: &'static str) -> PortDescriptor {
    PortDescriptor {
        name,
        direction: Direction::Command,
        ty: PortType::Integer,
        quantities: ONE,
        kind: Kind::Edge,
        range: Some((low, high)),
        summary,
    }
}

/// A REAL that the automation sets.
pub(super) const fn target(
    name: &'static str,
    quantities: &'static [Quantity],
    summary: &'static str,
) -> PortDescriptor {
    PortDescriptor {
        name,
        direction: Direction::Command,
        ty: PortType::Real,
        quantities,
        kind: Kind::Level,
        range: None,
        summary,
    }
}

/// A BOOL that the plant reports.
pub(super) const fn indicator(name: &'static str, summary: &'static str) -> PortDescriptor {
    PortDescriptor {
        name,
        direction: Direction::Report,
        ty: PortType::Boolean,
        quantities: ONE,
        kind: Kind::Edge,
        range: None,
        summary,
    }
}

/// A coded integer that the plant reports.
pub(super) const fn state(name: &'static str, low: f64, high: f64, summary: &'static str) -> PortDescriptor {
    PortDescriptor {
        name,
        direction: Direction::Report,
        ty: PortType::Integer,
        quantities: ONE,
        kind: Kind::Edge,
        range: Some((low, high)),
        summary,
    }
}

/// A counter that the plant reports.
pub(super) const fn counter(name: &'static str, summary: &'static str) -> PortDescriptor {
    PortDescriptor {
        name,
        direction: Direction::Report,
        ty: PortType::Integer,
        quantities: ONE,
        kind: Kind::Level,
        range: None,
        summary,
    }
}

/// A REAL that the plant reports.
pub(super) const fn measure(
    name: &'static str,
    quantities: &'static [Quantity],
    summary: &'static str,
) -> PortDescriptor {
    PortDescriptor {
        name,
        direction: Direction::Report,
        ty: PortType::Real,
        quantities,
        kind: Kind::Level,
        range: None,
        summary,
    }
}

/// A number from `min` to `max`, in SI units, both included.
pub(super) const fn number(
    name: &'static str,
    quantities: &'static [Quantity],
    (min, max): (f64, f64),
    default: &'static str,
    summary: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor { name, ty: ParameterType::Number { min, max }, quantities, default, summary }
}

/// Exactly `count` numbers, or any where that is 0, each from `min` to `max`, in SI units, both included.
pub(super) const fn numbers(
    name: &'static str,
    quantities: &'static [Quantity],
    count: usize,
    (min, max): (f64, f64),
    default: &'static str,
    summary: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor { name, ty: ParameterType::Numbers { count, min, max }, quantities, default, summary }
}

/// A whole number from `min` to `max`, both included.
pub(super) const fn integer(
    name: &'static str,
    (min, max): (i64, i64),
    default: &'static str,
    summary: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor { name, ty: ParameterType::Integer { min, max }, quantities: ONE, default, summary }
}

/// A switch, off unless set.
pub(super) const fn option(name: &'static str, summary: &'static str) -> ParameterDescriptor {
    ParameterDescriptor { name, ty: ParameterType::Boolean, quantities: ONE, default: "false", summary }
}

/// One of some words.
pub(super) const fn choice(
    name: &'static str,
    words: &'static [&'static str],
    default: &'static str,
    summary: &'static str,
) -> ParameterDescriptor {
    ParameterDescriptor { name, ty: ParameterType::Choice(words), quantities: ONE, default, summary }
}

/// The name of another instance; none unless set.
pub(super) const fn instance(name: &'static str, summary: &'static str) -> ParameterDescriptor {
    ParameterDescriptor { name, ty: ParameterType::Instance, quantities: ONE, default: "", summary }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::device::KINDS;

    #[test]
    fn names_stand_once_and_every_line_says_something() {
        let names: BTreeSet<_> = KINDS.iter().map(|kind| kind.name).collect();
        assert_eq!(names.len(), KINDS.len());
        for kind in KINDS {
            let ports: BTreeSet<_> = kind.ports.iter().map(|port| port.name).collect();
            assert_eq!(ports.len(), kind.ports.len(), "{}", kind.name);
            let parameters: BTreeSet<_> = kind.parameters.iter().map(|parameter| parameter.name).collect();
            assert_eq!(parameters.len(), kind.parameters.len(), "{}", kind.name);
            let summaries = kind.ports.iter().map(|p| p.summary).chain(kind.parameters.iter().map(|p| p.summary));
            assert!(summaries.chain([kind.summary]).all(|line| !line.is_empty()), "{}", kind.name);
        }
    }

    #[test]
    fn every_default_is_one_that_its_parameter_takes() {
        for kind in KINDS {
            for parameter in kind.parameters {
                let place = format!("{} {}", kind.name, parameter.name);
                let text = parameter.default;
                match parameter.ty {
                    ParameterType::Number { min, max } => {
                        let number: f64 = text.parse().expect(&place);
                        assert!((min..=max).contains(&number), "{place}");
                    }
                    ParameterType::Numbers { count, min, max } => {
                        let list: Vec<f64> = text.split(';').map(|n| n.parse().expect(&place)).collect();
                        assert!(count == 0 || list.len() == count, "{place}");
                        assert!(list.iter().all(|number| (min..=max).contains(number)), "{place}");
                    }
                    ParameterType::Integer { min, max } => {
                        let number: i64 = text.parse().expect(&place);
                        assert!((min..=max).contains(&number), "{place}");
                    }
                    ParameterType::Boolean => assert!(text.parse::<bool>().is_ok(), "{place}"),
                    ParameterType::Choice(words) => assert!(words.contains(&text), "{place}"),
                    ParameterType::Text | ParameterType::Instance => {}
                }
            }
        }
    }
}
