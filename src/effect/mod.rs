//! What real devices add to their nominal laws: the effects, one file each.
//!
//! An effect stands at one place of a device's signal path (see [`crate::device::path`]). It is part of the model's XML,
//! `<effect place="transmission" kind="belt-slip"><parameter name="ratio" value="0.06"/></effect>` on an instance, and the
//! engine runs the same code in a live run, in a replay and in a diagnosis. Each file holds the effect's equation with its
//! source, its parameters with units, ranges and the nominal value at which it does nothing, and a test against a closed form
//! or a published result. A new effect is a new file and one line in [`EFFECTS`].
//! `docs/effects.md` is written from the registry.

mod acceleration_limit;
mod added_mass;
mod affected;
mod attach;
mod back_pressure;
mod backlash;
mod belt_slip;
mod belt_slip_above_acceleration;
#[cfg(test)]
mod bench;
mod blind_range;
mod bounce;
mod breakaway_friction;
mod carried_mass;
mod clock_drift;
mod coasting;
mod compliance;
mod constant_force;
mod coulomb_friction;
mod dead_band;
mod dead_time;
mod dice;
mod direction_asymmetry;
mod drift;
mod end_cushioning;
mod first_order_lag;
mod force_limit;
mod gain;
mod gain_error;
mod gravity;
mod hysteresis;
mod input_filter;
mod intermittent;
mod inverted;
mod jerk_limit;
mod leak;
mod line;
mod load_dependent_friction;
mod load_dependent_speed;
mod lost_messages;
mod neighbours;
mod noise;
mod off_delay;
mod offset;
mod on_delay;
mod once_per_revolution_error;
mod page;
mod parameter_error;
mod part_length_error;
mod part_slip;
mod part_spacing_error;
mod play;
mod position_dependent_friction;
mod proportion;
mod quantisation;
mod registry;
mod said;
mod sampling_jitter;
mod scale_error;
mod second_order_lag;
mod settling_time;
mod site;
mod stale_hold;
mod stribeck_friction;
mod stuck;
mod supply_drop;
mod swapped;
mod switch_off_delay;
mod switch_on_delay;
mod table;
#[cfg(test)]
mod tests;
mod timer;
mod transfer_slip;
mod vacuum_build_up;
mod velocity_limit;
mod viscous_friction;
mod way;
mod wrong_unit;

use std::collections::BTreeMap;

use crate::device;
use crate::device::path::Stage;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};
use crate::value::{Quantity, Unit};

pub use affected::Affected;
pub(crate) use attach::is_of;
pub use attach::{attach, build, of_task, parameters_of};
pub use neighbours::{CARRIES_PARTS, SHARES_A_SUPPLY, moving_as_reported, neighbours, stranger};
pub use page::page;
pub use registry::EFFECTS;
pub use said::refuse_units;
pub use site::Site;

/// An effect, as the registry, the model reader, the diagnosis and the documentation know it.
#[derive(Debug)]
pub struct EffectDescriptor {
    /// As in model files and reports: `dead-time`.
    pub id: &'static str,
    /// One sentence for people.
    pub summary: &'static str,
    /// What it computes, in a line.
    pub equation: &'static str,
    /// Where that comes from.
    pub source: &'static str,
    /// The places where it may stand; what it stands for may differ by place.
    pub places: &'static [EffectPlace],
    /// What it may act on.
    pub fits: &'static [Fit],
    /// What an axis must have for it to act there.
    pub needs: Needs,
    pub parameters: &'static [EffectParameter],
    /// Properties that are no numbers.
    pub texts: &'static [EffectText],
    /// Whether there is no value of its parameters at which it does nothing: it is there or it is not.
    pub acts_always: bool,
    /// What a trace must hold for the effect to be seen.
    pub excited_by: &'static str,
    pub build: Build,
}

/// How an effect comes to act.
#[derive(Clone, Copy, Debug)]
pub enum Build {
    /// A stage, made from the parameters in the order of the registry, in SI units and in range, for its site.
    Stage(fn(&[f64], &Site) -> Box<dyn Stage>),
    /// The parameters of the device are others: see [`parameters_of`].
    Parameters,
    /// Two signals change places.
    Swap,
}

/// What of a servo axis an effect needs; every other kind has what its effects need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    Nothing,
    /// Forces and masses: not an axis in mode ideal.
    Dynamics,
    /// A speed that is asked for, or an ideal axis.
    Speed,
}

/// A property of an effect that is no number.
#[derive(Debug)]
pub struct EffectText {
    pub name: &'static str,
    pub required: bool,
    pub summary: &'static str,
}

/// What of a device an effect may act on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// A signal of any device: commands at the command link, reports at sensor and report link. The component is the
    /// signal's name; without one, every signal of the device that goes that way.
    Signals(SignalClass),
    /// The drive of these kinds (all kinds named by the last word of their type: `StraightConveyor`).
    Drives(&'static [&'static str]),
    /// What moves the parts on conveyors, or makes them.
    Parts(&'static [&'static str]),
}

/// Which signals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignalClass {
    Any,
    Boolean,
    Number,
    /// Numbers, and booleans whose sensors look along something that moves.
    Motion,
}

/// A parameter of an effect.
#[derive(Debug)]
pub struct EffectParameter {
    pub name: &'static str,
    /// Of a linear device, and of a rotary one where that differs.
    pub quantities: &'static [Quantity],
    /// Least and greatest value, SI.
    pub range: (f64, f64),
    /// The value at which the effect does nothing.
    pub nominal: f64,
    /// A magnitude at which it is usual on machines, SI: where a search starts, and the scale of its steps.
    pub typical: f64,
    /// What it is where a model does not give it; `None` where it must be given.
    pub default: Option<f64>,
    /// The values it may have; any in its range if empty.
    pub options: &'static [f64],
    pub summary: &'static str,
}

/// An effect in a model that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EffectError {
    #[error("there is no effect {found:?}{}", nearest(found))]
    Unknown { found: String },
    #[error("effect {id} stands at {}: it may stand at {expected}", found.name())]
    Place { id: &'static str, found: EffectPlace, expected: String },
    #[error("effect {id} has no parameter {found:?}: it has {expected}")]
    Parameter { id: &'static str, found: String, expected: String },
    #[error("effect {id} needs its parameter {name}: {summary}")]
    Missing { id: &'static str, name: &'static str, summary: &'static str },
    #[error("effect {id}: {name} is {found}, expected a number from {} to {}", range.0, range.1)]
    Value { id: &'static str, name: &'static str, found: String, range: (f64, f64) },
    #[error("effect {id}: {name} is given in {found}, expected {expected}")]
    Unit { id: &'static str, name: &'static str, found: Unit, expected: String },
    #[error(transparent)]
    Device(#[from] device::BuildError),
    #[error("effect {id} needs its property {name}: {summary}")]
    MissingText { id: &'static str, name: &'static str, summary: &'static str },
    #[error("effect {id} does not fit {device}{}: {reason}", component.as_ref().map(|c| format!(".{c}")).unwrap_or_default())]
    Misfit { id: &'static str, device: String, component: Option<String>, reason: String },
}

/// The effect called `id`.
pub fn named(id: &str) -> Option<&'static EffectDescriptor> {
    EFFECTS.iter().find(|effect| effect.id == id).copied()
}

fn nearest(found: &str) -> String {
    let distance = |id: &str| {
        let mut row: Vec<usize> = (0..=id.len()).collect();
        for (i, a) in found.bytes().enumerate() {
            let mut before = row[0];
            row[0] = i + 1;
            for (j, b) in id.bytes().enumerate() {
                let here = (before + usize::from(a != b)).min(row[j] + 1).min(row[j + 1] + 1);
                before = std::mem::replace(&mut row[j + 1], here);
            }
        }
        row[id.len()]
    };
    let best = EFFECTS.iter().map(|effect| (distance(effect.id), effect.id)).min();
    best.filter(|(steps, _)| *steps <= 4).map(|(_, id)| format!("; did you mean {id:?}?")).unwrap_or_default()
}

/// Checks a specification against the registry and gives the parameters in the registry's order.
pub fn resolve(spec: &EffectSpec) -> Result<(&'static EffectDescriptor, Vec<f64>), EffectError> {
    let effect = named(&spec.kind).ok_or_else(|| EffectError::Unknown { found: spec.kind.clone() })?;
    let id = effect.id;
    if !effect.places.contains(&spec.place) {
        let expected = effect.places.iter().map(|place| place.name()).collect::<Vec<_>>().join(" or ");
        return Err(EffectError::Place { id, found: spec.place, expected });
    }
    let names = || effect.parameters.iter().map(|p| p.name).chain(effect.texts.iter().map(|text| text.name));
    if let Some(found) = spec.parameters.keys().find(|found| names().all(|name| name != found.as_str())) {
        let expected =
            if names().next().is_none() { "none".to_owned() } else { names().collect::<Vec<_>>().join(", ") };
        return Err(EffectError::Parameter { id, found: found.clone(), expected });
    }
    for EffectText { name, required, summary } in effect.texts {
        if *required && text(spec, name).is_none() {
            return Err(EffectError::MissingText { id, name, summary });
        }
    }
    let values = effect.parameters.iter().map(|parameter| value(id, parameter, &spec.parameters));
    Ok((effect, values.collect::<Result<_, _>>()?))
}

/// The property `name` of an effect, where it is a text.
fn text<'a>(spec: &'a EffectSpec, name: &str) -> Option<&'a str> {
    match spec.parameters.get(name) {
        Some(ParameterValue::Text(text)) => Some(text),
        _ => None,
    }
}

fn value(
    id: &'static str,
    parameter: &EffectParameter,
    given: &BTreeMap<String, ParameterValue>,
) -> Result<f64, EffectError> {
    let EffectParameter { name, range, summary, .. } = *parameter;
    let Some(found) = given.get(name) else {
        return parameter.default.ok_or(EffectError::Missing { id, name, summary });
    };
    let number = match found {
        ParameterValue::Number(number) => *number,
        ParameterValue::Integer(number) => *number as f64,
        other => return Err(EffectError::Value { id, name, found: format!("{other:?}"), range }),
    };
    let is_option = parameter.options.is_empty() || parameter.options.contains(&number);
    if !(range.0..=range.1).contains(&number) || !is_option {
        return Err(EffectError::Value { id, name, found: number.to_string(), range });
    }
    Ok(number)
}
