//! What a model's file says wrong about an effect, and where it says so.

use super::{EffectDescriptor, EffectError, Fit, named};
use crate::plant::{EffectPlaces, EffectSpec};
use crate::prototype::quantity::symbols;
use crate::value::{Quantity, Unit};
use crate::xml::Place;

/// Refuses a parameter in a unit of another quantity than its own; `unit` says in which it is given. A parameter that counts
/// in the unit of the signal that it stands at is given in any.
pub fn refuse_units(spec: &EffectSpec, unit: impl Fn(&str) -> Option<Unit>) -> Result<(), EffectError> {
    let Some(effect) = named(&spec.kind) else { return Ok(()) };
    for parameter in effect.parameters {
        let Some(found) = unit(parameter.name) else { continue };
        let is_any = parameter.quantities.is_empty() || is_of_a_signal(effect, parameter.quantities);
        if !is_any && !parameter.quantities.contains(&found.quantity) {
            let expected = match parameter.quantities {
                [Quantity::One] => "a number without a unit".to_owned(),
                quantities => symbols(quantities).join(" or "),
            };
            return Err(EffectError::Unit { id: effect.id, name: parameter.name, found, expected });
        }
    }
    Ok(())
}

/// Whether a number without a unit of its own is one of the signal that the effect stands at.
fn is_of_a_signal(effect: &EffectDescriptor, quantities: &[Quantity]) -> bool {
    let is_at_a_signal = effect.fits.iter().any(|fit| matches!(fit, Fit::Signals(_)));
    quantities == [Quantity::One] && (is_at_a_signal || effect.id == "parameter-error")
}

impl EffectError {
    /// Where in the file of `places` it is wrong, and what is expected there.
    pub fn place<'a>(&self, places: &'a EffectPlaces) -> (&'a Place, String) {
        let value = |name: &str| places.parameters.get(name).map(|(place, _)| place);
        let unit = |name: &str| places.parameters.get(name).and_then(|(_, unit)| Some(&unit.as_ref()?.place));
        match self {
            EffectError::Unknown { .. } => (&places.kind, "expected the id of an effect, as belt-slip".to_owned()),
            EffectError::Place { expected, .. } => (&places.place, format!("expected {expected}")),
            EffectError::Parameter { found, expected, .. } => {
                (value(found).unwrap_or(&places.element), format!("expected {expected}"))
            }
            EffectError::Value { name, range, .. } => {
                let place = value(name).unwrap_or(&places.element);
                (place, format!("expected a number from {} to {}", range.0, range.1))
            }
            EffectError::Unit { name, expected, .. } => {
                (unit(name).or(value(name)).unwrap_or(&places.element), format!("expected {expected}"))
            }
            EffectError::Missing { name, .. } | EffectError::MissingText { name, .. } => {
                (&places.element, format!("expected <parameter name={name:?} value=\"…\"/> in this element"))
            }
            EffectError::Misfit { .. } => {
                let place = places.component.as_ref().unwrap_or(&places.kind);
                (place, "expected an effect that fits this device".to_owned())
            }
            EffectError::Device(_) => (&places.element, "expected another effect".to_owned()),
        }
    }
}
