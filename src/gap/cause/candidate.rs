//! A candidate: an effect at a place of a device, with what is to be found of it.

use std::collections::BTreeMap;

use crate::effect::EffectDescriptor;
use crate::gap::fit::Range;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};

/// An effect that could be there.
#[derive(Clone, Debug)]
pub struct Candidate {
    pub effect: &'static EffectDescriptor,
    pub place: EffectPlace,
    pub component: Option<String>,
    /// Its properties that are no numbers.
    pub texts: BTreeMap<String, String>,
    /// Parameters that are as they are.
    pub fixed: Vec<(&'static str, f64)>,
    /// Parameters that are to be found.
    pub free: Vec<Free>,
    /// Where to begin: a value for each of the free ones. At least one.
    pub starts: Vec<Vec<f64>>,
}

/// A parameter that is to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Free {
    pub name: &'static str,
    pub range: Range,
    /// Whether it is a time, which a machine that looks at its commands in ticks shows no better than within one.
    pub is_time: bool,
}

impl Candidate {
    /// The effect with its free parameters at `at`.
    pub fn spec(&self, at: &[f64]) -> EffectSpec {
        let free = self.free.iter().zip(at).map(|(free, value)| (free.name, *value));
        let numbers = free.chain(self.fixed.iter().copied());
        let texts = self.texts.iter().map(|(name, text)| (name.clone(), ParameterValue::Text(text.clone())));
        EffectSpec {
            place: self.place,
            kind: self.effect.id.to_owned(),
            component: self.component.clone(),
            parameters: numbers
                .map(|(name, value)| (name.to_owned(), ParameterValue::Number(value)))
                .chain(texts)
                .collect(),
        }
    }

    /// Whether both are the same effect at the same place of the same component.
    pub fn is_same(&self, other: &Candidate) -> bool {
        self.effect.id == other.effect.id && self.place == other.place && self.component == other.component
    }

    /// Whether it is a nominal parameter that is wrong, and no effect of its own.
    pub fn is_parameter_error(&self) -> bool {
        self.effect.id == "parameter-error"
    }

    /// The ranges of its free parameters.
    pub fn ranges(&self) -> impl Iterator<Item = Range> {
        self.free.iter().map(|free| free.range)
    }

    /// For people: `first-order-lag at the actuator of Y`.
    pub fn name(&self) -> String {
        let of = self.component.as_ref().map(|component| format!(" of {component}")).unwrap_or_default();
        format!("{} at the {}{of}", self.effect.id, self.place.name())
    }
}
