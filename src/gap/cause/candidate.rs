//! A candidate: an effect at a place of a device, with what is to be found of it.

use std::collections::BTreeMap;

use super::intervals::Bounds;
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
    /// Where the recording itself shows it to be, however little that is from afar; mostly nowhere.
    pub shown: Vec<Vec<f64>>,
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

    /// Whether it may be none: the interval of its main parameter holds the value at which it does nothing. `bounds`: of its own parameters.
    pub fn may_do_nothing(&self, bounds: &[Bounds]) -> bool {
        let parameter = |free: &Free| self.effect.parameters.iter().find(|of| of.name == free.name);
        let nominal = self.free.first().and_then(parameter).filter(|_| !self.is_parameter_error());
        bounds
            .first()
            .zip(nominal)
            .is_some_and(|(bounds, parameter)| (bounds.interval[0]..=bounds.interval[1]).contains(&parameter.nominal))
    }

    /// How many numbers say what it does: those that are free, and of a signal that never changes since when it is stuck, which nothing that
    /// was recorded tells. So a switch that is blind over any way that is long enough has no number more.
    pub fn numbers(&self) -> usize {
        self.free.len() + usize::from(self.effect.id == "stuck" && self.free.is_empty())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect::EFFECTS;

    /// Metres that are told as millimetres need no number; a switch that never shows may be stuck since whenever.
    #[test]
    fn what_is_stuck_from_the_start_is_so_since_an_instant_that_nobody_knows() {
        let numbers = |id: &str| {
            let effect = EFFECTS.iter().find(|effect| effect.id == id).expect("an effect of the library");
            let candidate = Candidate {
                effect,
                place: EffectPlace::ReportLink,
                component: None,
                texts: BTreeMap::new(),
                fixed: vec![("from", 0.0)],
                free: Vec::new(),
                starts: vec![Vec::new()],
                shown: Vec::new(),
            };
            candidate.numbers()
        };
        assert_eq!(["wrong-unit", "inverted", "stuck"].map(numbers), [0, 0, 1]);
    }
}
