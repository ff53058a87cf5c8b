//! What real devices add to their nominal laws: the effects, one file each.
//!
//! An effect stands at one place of a device's signal path (see [`crate::device::path`]). It is part of the model's XML,
//! `<effect place="transmission" kind="belt-slip"><property name="ratio" value="0.06"/></effect>` on an instance, and the
//! engine runs the same code in a live run, in a replay and in a diagnosis. Each file holds the effect's equation with its
//! source, its parameters with units, ranges and the nominal value at which it does nothing, and a test against a closed form
//! or a published result. A new effect is a new file and one line in [`EFFECTS`].

mod affected;
mod attach;
mod dead_time;
mod first_order_lag;

use std::collections::BTreeMap;

use crate::device::path::Stage;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};
use crate::value::Quantity;

pub use affected::Affected;
pub use attach::attach;

/// Every effect there is.
pub static EFFECTS: &[&EffectDescriptor] = &[&dead_time::EFFECT, &first_order_lag::EFFECT];

/// An effect, as the registry, the model reader, the diagnosis and the documentation know it.
#[derive(Debug)]
pub struct EffectDescriptor {
    /// As in model files and reports: `dead-time`.
    pub id: &'static str,
    /// One sentence for people.
    pub summary: &'static str,
    /// The places where it may stand; what it stands for may differ by place.
    pub places: &'static [EffectPlace],
    /// What it may act on.
    pub fits: &'static [Fit],
    pub parameters: &'static [EffectParameter],
    /// What a trace must hold for the effect to be seen.
    pub excited_by: &'static str,
    /// Makes the stage from the parameters, in the order of `parameters`, in SI units and in range.
    pub build: fn(&[f64]) -> Box<dyn Stage>,
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
    if let Some(found) = spec.parameters.keys().find(|name| effect.parameters.iter().all(|p| p.name != name.as_str())) {
        let expected = effect.parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", ");
        return Err(EffectError::Parameter { id, found: found.clone(), expected });
    }
    let values = effect.parameters.iter().map(|parameter| value(id, parameter, &spec.parameters));
    Ok((effect, values.collect::<Result<_, _>>()?))
}

fn value(
    id: &'static str,
    parameter: &EffectParameter,
    given: &BTreeMap<String, ParameterValue>,
) -> Result<f64, EffectError> {
    let EffectParameter { name, range, summary, .. } = *parameter;
    let found = given.get(name).ok_or(EffectError::Missing { id, name, summary })?;
    let number = match found {
        ParameterValue::Number(number) => *number,
        ParameterValue::Integer(number) => *number as f64,
        other => return Err(EffectError::Value { id, name, found: format!("{other:?}"), range }),
    };
    if !(range.0..=range.1).contains(&number) {
        return Err(EffectError::Value { id, name, found: number.to_string(), range });
    }
    Ok(number)
}
