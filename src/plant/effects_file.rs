//! `effects.xml`: effects to be added to a plant, as a diagnosis writes them and `kinetwin gap apply` takes them. This is
//! the one place where the file is read and written.
//!
//! ```xml
//! <effects plant="rig">
//!   <instance name="Axis">
//!     <effect kind="backlash" place="transmission">
//!       <parameter name="gap" value="0.002" unit="m"/>
//!     </effect>
//!   </instance>
//! </effects>
//! ```
//!
//! An `<effect>` is what it is in a plant's file; `plant` says which plant was diagnosed, and may be absent.

use std::collections::BTreeMap;

use super::file::{effect, qualified};
use super::{EffectSpec, ParameterValue};
use crate::xml::{Faults, Located, Place, escape, parse};

/// What an `effects.xml` holds.
#[derive(Clone, Debug)]
pub struct EffectsFile {
    /// The plant that was diagnosed.
    pub plant: Option<Located<String>>,
    /// In the order of the file.
    pub effects: Vec<Addition>,
}

/// An effect to be added to an instance.
#[derive(Clone, Debug)]
pub struct Addition {
    pub instance: Located<String>,
    pub effect: EffectSpec,
    /// Where the effect stands; its text is what is put into a plant's file.
    pub place: Place,
}

/// An effect to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct NewEffect {
    pub instance: String,
    pub effect: EffectSpec,
    /// The SI unit of a parameter, for people; what has none here is written bare.
    pub units: BTreeMap<String, String>,
}

/// Reads the text of the file called `file`.
///
/// # Errors
/// Everything that is wrong in it, each with its line. Whether the instances are there and the effects fit them is seen
/// when they are put into a plant.
pub fn read(file: &str, text: &str) -> Result<EffectsFile, Faults> {
    let root = parse(file, text)?;
    let mut faults = Faults::default();
    if root.name.value != "effects" {
        let found = format!("the root element is <{}>", root.name.value);
        return Err(root.name.fault(found, "expected <effects>, as a diagnosis writes it").into());
    }
    root.allow_attributes(&["plant"], &mut faults);
    root.allow_children(&["instance"], &mut faults);
    let mut effects = Vec::new();
    for child in root.children_named("instance") {
        child.allow_attributes(&["name"], &mut faults);
        child.allow_children(&["effect"], &mut faults);
        let name = qualified(child, &mut faults);
        for element in child.children_named("effect") {
            let read = effect(element, &mut faults);
            if let (Some(instance), Some(effect)) = (&name, read) {
                let place = element.extent.clone();
                effects.push(Addition { instance: instance.clone(), effect: effect.spec, place });
            }
        }
    }
    if effects.is_empty() && faults.is_empty() {
        faults.push(root.name.fault("no effect stands in it", "expected at least one <instance> with an <effect>"));
    }
    match faults.is_empty() {
        true => Ok(EffectsFile { plant: root.attribute("plant").cloned(), effects }),
        false => Err(faults),
    }
}

/// Writes effects as a file; those of one instance that follow each other stand in one `<instance>`. `note` becomes a
/// comment at its head.
pub fn write(plant: &str, effects: &[NewEffect], note: &str) -> String {
    // XML forbids two hyphens in a comment, and one at its end.
    let note = note.replace("--", "- -").trim_end_matches('-').to_owned();
    let mut out = format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {note} -->\n");
    out.push_str(&format!("<effects plant=\"{}\">\n", escape(plant)));
    for of_one in effects.chunk_by(|a, b| a.instance == b.instance) {
        out.push_str(&format!("  <instance name=\"{}\">\n", escape(&of_one[0].instance)));
        of_one.iter().for_each(|new| write_effect(&mut out, new));
        out.push_str("  </instance>\n");
    }
    out.push_str("</effects>\n");
    out
}

fn write_effect(out: &mut String, new: &NewEffect) {
    let EffectSpec { place, kind, component, parameters } = &new.effect;
    out.push_str(&format!("    <effect kind=\"{}\" place=\"{}\"", escape(kind), place.name()));
    if let Some(component) = component {
        out.push_str(&format!(" component=\"{}\"", escape(component)));
    }
    if parameters.is_empty() {
        out.push_str("/>\n");
        return;
    }
    out.push_str(">\n");
    for (name, value) in parameters {
        let text = match value {
            ParameterValue::Number(number) => number.to_string(),
            ParameterValue::Integer(number) => number.to_string(),
            ParameterValue::Boolean(truth) => truth.to_string(),
            ParameterValue::Text(text) => text.clone(),
            ParameterValue::Numbers(numbers) => numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(";"),
        };
        out.push_str(&format!("      <parameter name=\"{}\" value=\"{}\"", escape(name), escape(&text)));
        if let Some(unit) = new.units.get(name) {
            out.push_str(&format!(" unit=\"{}\"", escape(unit)));
        }
        out.push_str("/>\n");
    }
    out.push_str("    </effect>\n");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::EffectPlace;

    fn number(name: &str, value: f64) -> (String, ParameterValue) {
        (name.to_owned(), ParameterValue::Number(value))
    }

    #[test]
    fn what_is_written_reads_back() {
        let backlash = EffectSpec {
            place: EffectPlace::Transmission,
            kind: "backlash".to_owned(),
            component: None,
            parameters: BTreeMap::from([number("gap", 0.018_349_999_999_999_998)]),
        };
        let swapped = EffectSpec {
            place: EffectPlace::ReportLink,
            kind: "swapped".to_owned(),
            component: Some("lightBarrierA".to_owned()),
            parameters: BTreeMap::from([("with".to_owned(), ParameterValue::Text("lightBarrierB".to_owned()))]),
        };
        let inverted = EffectSpec { kind: "inverted".to_owned(), parameters: BTreeMap::new(), ..swapped.clone() };
        let units = BTreeMap::from([("gap".to_owned(), "rad".to_owned())]);
        let new = |instance: &str, effect: &EffectSpec, units: &BTreeMap<String, String>| NewEffect {
            instance: instance.to_owned(),
            effect: effect.clone(),
            units: units.clone(),
        };
        let none = BTreeMap::new();
        let all = [new("Pitch", &backlash, &units), new("Belt", &swapped, &none), new("Belt", &inverted, &none)];
        let text = write("rig", &all, "Written --by a test--");
        let file = read("effects.xml", &text).expect(&text);
        assert_eq!(file.plant.expect("a plant").value, "rig");
        let read: Vec<(&str, &EffectSpec)> =
            file.effects.iter().map(|addition| (addition.instance.value.as_str(), &addition.effect)).collect();
        assert_eq!(read, [("Pitch", &backlash), ("Belt", &swapped), ("Belt", &inverted)]);
        assert!(text.contains("value=\"0.018349999999999998\" unit=\"rad\""), "{text}");
        assert_eq!(text.matches("<instance").count(), 2, "{text}");
    }

    #[test]
    fn what_is_no_such_file_is_told_with_its_line() {
        let check = |text: &str, words: &str| {
            let faults = read("effects.xml", text).expect_err(text).to_string();
            assert!(faults.contains(words), "{faults}");
        };
        check("<plant name=\"a\"/>", "effects.xml:1:2: the root element is <plant>: expected <effects>");
        check("<effects/>", "effects.xml:1:2: no effect stands in it");
        check("<effects>\n<instance><effect kind=\"drift\"/></instance></effects>", "effects.xml:2:2: ");
        check("<effects><instance name=\"A\"><effekt/></instance></effects>", "effekt");
        check(
            "<effects>\n<instance name=\"A\">\n<effect kind=\"drift\" place=\"gear\"/></instance></effects>",
            "effects.xml:3:29",
        );
    }
}
