//! One device with effects, for the tests of the effects.

use std::collections::BTreeMap;

use super::{attach, build};
use crate::device::bench::Bench;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};

/// An `<effect>`.
pub fn spec(place: &str, kind: &str, component: Option<&str>, parameters: &[(&str, f64)]) -> EffectSpec {
    let number = |(name, value): &(&str, f64)| ((*name).to_owned(), ParameterValue::Number(*value));
    EffectSpec {
        place: *EffectPlace::ALL.iter().find(|known| known.name() == place).expect(place),
        kind: kind.to_owned(),
        component: component.map(str::to_owned),
        parameters: parameters.iter().map(number).collect::<BTreeMap<_, _>>(),
    }
}

/// A device of the kind with that last word, its defaults but for what is set, with effects.
pub fn with(kind: &str, set: &[(&str, &str)], effects: &[EffectSpec]) -> Bench {
    let mut bench = Bench::new(&format!("kinetwin.{kind}"), set);
    bench.device = build(bench.kind, &bench.parameters, "Device1", effects, 1).expect("effects that fit");
    bench
}

/// What is said of effects that do not fit.
pub fn error(kind: &str, set: &[(&str, &str)], effects: &[EffectSpec]) -> String {
    let bench = Bench::new(&format!("kinetwin.{kind}"), set);
    let built = build(bench.kind, &bench.parameters, "Device1", effects, 1);
    let attached = attach(bench.device, bench.kind, &bench.parameters, "Device1", effects, 1);
    built.err().or(attached.err()).expect("an error").to_string()
}
