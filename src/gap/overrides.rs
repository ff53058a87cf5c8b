//! Nominal parameters that are to be others than the model says.

use std::collections::BTreeMap;

use crate::plant::{EffectPlace, EffectSpec, ParameterValue};

/// Values in place of a device's nominal parameters, by the parameter's name, in SI units. A `parameter-error` by another
/// name: it is applied as one, so that the engine computes with it what the diagnosis did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides(pub BTreeMap<String, f64>);

impl Overrides {
    /// None.
    pub fn none() -> Overrides {
        Overrides::default()
    }

    /// One.
    pub fn one(parameter: &str, value: f64) -> Overrides {
        Overrides(BTreeMap::from([(parameter.to_owned(), value)]))
    }

    /// As effects.
    pub fn effects(&self) -> impl Iterator<Item = EffectSpec> {
        self.0.iter().map(|(name, value)| EffectSpec {
            place: EffectPlace::Actuator,
            kind: "parameter-error".to_owned(),
            component: Some(name.clone()),
            parameters: BTreeMap::from([("value".to_owned(), ParameterValue::Number(*value))]),
        })
    }
}
