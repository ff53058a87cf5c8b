//! The causes of a report as effects to be added.

use std::collections::BTreeMap;

use crate::plant::effects_file::{self, NewEffect};
use crate::plant::{EffectSpec, ParameterValue};

use super::report::{Cause, Report};

/// `effects.xml` of a report, for the plant of that name; `None` where nothing is to be added.
pub fn effects_xml(report: &Report, plant: &str) -> Option<String> {
    let effects: Vec<NewEffect> = report.cause.iter().map(new_effect).collect();
    let note = format!("What a diagnosis found ({}): kinetwin gap apply adds it to the model.", report.verdict);
    (!effects.is_empty()).then(|| effects_file::write(plant, &effects, &note))
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
    use crate::plant::EffectPlace;

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
    }
}
