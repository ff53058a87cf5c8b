//! The causes of a report as effects to be added.

use std::collections::BTreeMap;

use crate::plant::effects_file::{self, NewEffect};
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};

use super::report::{Cause, FittedNominal, Report};

/// `effects.xml` of a report, for the plant of that name; `None` where nothing is to be added.
pub fn effects_xml(report: &Report, plant: &str) -> Option<String> {
    if report.cause.is_empty() {
        return None;
    }
    let effects: Vec<NewEffect> = report.cause.iter().map(new_effect).chain(report.fitted.iter().map(set)).collect();
    let note = format!("What a diagnosis found ({}): kinetwin gap apply adds it to the model.", report.verdict);
    Some(effects_file::write(plant, &effects, &note))
}

/// A nominal parameter as it was fitted beside the causes, which without it would not do what they were found to.
fn set(fitted: &FittedNominal) -> NewEffect {
    NewEffect {
        instance: fitted.device.clone(),
        effect: EffectSpec {
            place: EffectPlace::Actuator,
            kind: "parameter-error".to_owned(),
            component: Some(fitted.parameter.clone()),
            parameters: BTreeMap::from([("value".to_owned(), ParameterValue::Number(fitted.value))]),
        },
        units: BTreeMap::new(),
    }
}

fn new_effect(cause: &Cause) -> NewEffect {
    let numbers = cause.parameters.iter().map(|p| (p.name.clone(), ParameterValue::Number(p.value)));
    let texts = cause.texts.iter().map(|(name, text)| (name.clone(), ParameterValue::Text(text.clone())));
    let has_unit = |unit: &String| !unit.is_empty() && unit != "1";
    let units = cause.parameters.iter().filter(|p| has_unit(&p.unit)).map(|p| (p.name.clone(), p.unit.clone()));
    NewEffect {
        instance: cause.device.clone(),
        effect: EffectSpec {
            place: cause.place,
            kind: cause.effect.clone(),
            component: cause.component.clone(),
            parameters: numbers.chain(texts).collect::<BTreeMap<_, _>>(),
        },
        units: units.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::report::{FittedParameter, Verdict};

    #[test]
    fn a_cause_reads_back_as_the_effect_it_is() {
        assert_eq!(effects_xml(&Report::new(Verdict::NoGap), "rig"), None);
        let mut cause = Cause {
            device: "Axis".to_owned(),
            component: None,
            effect: "backlash".to_owned(),
            place: EffectPlace::Transmission,
            weight: 1.0,
            class: Vec::new(),
            parameters: vec![FittedParameter {
                name: "gap".to_owned(),
                value: 0.002,
                unit: "m".to_owned(),
                ci95: [0.001, 0.003],
                not_identifiable: false,
            }],
            texts: BTreeMap::new(),
        };
        cause.class.push(cause.member());
        let mut report = Report::new(Verdict::Effect);
        report.cause.push(cause);
        let text = effects_xml(&report, "rig").expect("effects");
        let read = effects_file::read("effects.xml", &text).expect(&text);
        assert_eq!(read.effects[0].instance.value, "Axis");
        assert_eq!(read.effects[0].effect.parameters.get("gap"), Some(&ParameterValue::Number(0.002)));
        assert!(text.contains("unit=\"m\""), "{text}");
        // What was fitted beside it goes with it.
        let (device, parameter, unit) = ("Axis".to_owned(), "Fv".to_owned(), "N.s/m".to_owned());
        report.fitted.push(FittedNominal { device, parameter, nominal: 50.0, value: 48.5, unit });
        let text = effects_xml(&report, "rig").expect("effects");
        let read = effects_file::read("effects.xml", &text).expect(&text);
        assert_eq!(read.effects[1].effect.component.as_deref(), Some("Fv"));
        assert_eq!(read.effects[1].effect.parameters.get("value"), Some(&ParameterValue::Number(48.5)));
    }
}
