//! Nominal parameters that are to be others than the model says.

use std::collections::BTreeMap;

use crate::effect;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue, Parameters};
use crate::prototype::kind::KindDescriptor;

const PARAMETER_ERROR: &str = "parameter-error";

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
            kind: PARAMETER_ERROR.to_owned(),
            component: Some(name.clone()),
            parameters: BTreeMap::from([("value".to_owned(), ParameterValue::Number(*value))]),
        })
    }
}

/// A device's nominal parameters with the model's own `parameter-error`s in them, and what else the model adds to the device: what overrides a
/// parameter is to be about what the model says, wherever it says so. An error that fits no parameter stays an effect, which the device's builder refuses.
pub(super) fn as_modelled(
    kind: &KindDescriptor,
    parameters: &Parameters,
    instance: &str,
    effects: Vec<EffectSpec>,
) -> (Parameters, Vec<EffectSpec>) {
    let (errors, others): (Vec<_>, Vec<_>) = effects.iter().cloned().partition(|effect| effect.kind == PARAMETER_ERROR);
    match effect::parameters_of(kind, parameters, instance, &errors) {
        Ok(parameters) => (parameters.into_owned(), others),
        Err(_) => (parameters.clone(), effects),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::bench::Bench;

    #[test]
    fn what_the_model_says_is_wrong_is_nominal() {
        let bench = Bench::new("kinetwin.StraightConveyor", &[("acceleration", "1")]);
        let effects = |value: f64| -> Vec<EffectSpec> {
            let slip = EffectSpec {
                place: EffectPlace::Process,
                kind: "part-slip".to_owned(),
                component: None,
                parameters: BTreeMap::from([("acceleration".to_owned(), ParameterValue::Number(0.3))]),
            };
            Overrides::one("acceleration", value).effects().chain([slip]).collect()
        };
        let (parameters, others) = as_modelled(bench.kind, &bench.parameters, "Belt", effects(1.3));
        assert_eq!((parameters.number("acceleration"), others), (1.3, effects(1.3)[1..].to_vec()));
        assert_eq!(parameters.0["acceleration"].tolerance, bench.parameters.0["acceleration"].tolerance);
        let (parameters, others) = as_modelled(bench.kind, &bench.parameters, "Belt", effects(-1.0));
        assert_eq!((parameters.number("acceleration"), others), (1.0, effects(-1.0)));
    }
}
