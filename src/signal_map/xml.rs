//! The signals map as XML, as it stands under `signals-maps/`:
//! `<signals-map plant="…"><signal name type direction kind rate unit min max instance task property/>…</signals-map>`.
//!
//! The signals stand in the order of their registers, one to a line, so that two maps can be compared by eye.

use super::{Direction, Kind, RateClass, Signal, SignalMap};
use crate::value::{ElementaryType, SignalType, Unit};
use crate::xml::{Element, Faults, Located, escape, nearest, one_of, parse};

const DIRECTIONS: [(&str, Direction); 2] = [("command", Direction::Command), ("report", Direction::Report)];
/// The words for a signal's kind, here and in an avatar.
pub(crate) const KINDS: [(&str, Kind); 2] = [("edge", Kind::Edge), ("level", Kind::Level)];
/// The words for a signal's rate class, here and in an avatar.
pub(crate) const RATES: [(&str, RateClass); 2] = [("hf", RateClass::HighFrequency), ("lf", RateClass::LowFrequency)];

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<!-- Written from the plant by `kinetwin signals-map MODEL -o FILE`. The automation sets a command and reads a report. -->
";

fn word<T: PartialEq>(words: &[(&'static str, T)], value: T) -> &'static str {
    words.iter().find(|(_, known)| *known == value).map_or("", |(word, _)| word)
}

/// Writes a map.
pub fn write(map: &SignalMap) -> String {
    let mut text = format!("{HEAD}<signals-map plant=\"{}\">\n", escape(map.plant()));
    for signal in map.signals() {
        text.push_str("  <signal");
        for (name, value) in attributes(signal) {
            text.push_str(&format!(" {name}=\"{}\"", escape(&value)));
        }
        text.push_str("/>\n");
    }
    text.push_str("</signals-map>\n");
    text
}

/// The attributes of a signal as they are written.
fn attributes(signal: &Signal) -> Vec<(&'static str, String)> {
    let mut attributes = vec![
        ("name", signal.name.clone()),
        ("type", signal.ty.to_string()),
        ("direction", word(&DIRECTIONS, signal.direction).to_owned()),
        ("kind", word(&KINDS, signal.kind).to_owned()),
        ("rate", word(&RATES, signal.rate).to_owned()),
        ("unit", signal.unit.to_string()),
    ];
    attributes.extend(signal.min.map(|min| ("min", min.to_string())));
    attributes.extend(signal.max.map(|max| ("max", max.to_string())));
    attributes.push(("instance", signal.instance.clone()));
    // A signal that nothing in the plant takes or gives has neither.
    if !signal.task.is_empty() {
        attributes.push(("task", signal.task.clone()));
        attributes.push(("property", signal.property.clone()));
    }
    attributes
}

/// Reads the map `text` of the file called `file`.
pub fn read(file: &str, text: &str) -> Result<SignalMap, Faults> {
    let root = parse(file, text)?;
    let mut faults = Faults::default();
    if root.name.value != "signals-map" {
        let found = format!("the root element is <{}>", root.name.value);
        return Err(root.name.fault(found, "expected <signals-map>").into());
    }
    root.allow_attributes(&["plant"], &mut faults);
    root.allow_children(&["signal"], &mut faults);
    let plant = root.required("plant", &mut faults).map(|plant| plant.value.clone());
    let read: Vec<Located<Signal>> =
        root.children_named("signal").filter_map(|element| signal(element, &mut faults)).collect();
    refuse_doubles(&read, &mut faults);
    if !faults.is_empty() {
        return Err(faults);
    }
    let signals = read.into_iter().map(|signal| signal.value).collect();
    SignalMap::new(plant.unwrap_or_default(), signals)
        .map_err(|double| root.name.fault(double.to_string(), "expected each name once").into())
}

fn refuse_doubles(signals: &[Located<Signal>], faults: &mut Faults) {
    let mut first_by_name = std::collections::HashMap::new();
    for signal in signals {
        if let Some(first) = first_by_name.insert(signal.value.name.as_str(), &signal.place) {
            let found = format!("two signals are called {:?}", signal.value.name);
            faults.push(signal.fault(found, "expected each name once").beside(first, "the first"));
        }
    }
}

fn signal(element: &Element, faults: &mut Faults) -> Option<Located<Signal>> {
    const KNOWN: [&str; 11] =
        ["name", "type", "direction", "kind", "rate", "unit", "min", "max", "instance", "task", "property"];
    element.allow_attributes(&KNOWN, faults);
    element.allow_children(&[], faults);
    let name = element.required("name", faults);
    let ty = signal_type(element, faults);
    let direction = element.required_choice("direction", &DIRECTIONS, faults);
    let kind = element.required_choice("kind", &KINDS, faults);
    let rate = element.required_choice("rate", &RATES, faults);
    let unit = unit(element, faults).map_or(Unit::ONE, |unit| unit.value);
    let (min, max) = (bound(element, "min", faults), bound(element, "max", faults));
    let instance = element.required("instance", faults);
    let text = |name: &str| element.attribute(name).map(|value| value.value.clone()).unwrap_or_default();
    let name = name?;
    let signal = Signal {
        name: name.value.clone(),
        ty: ty?.value,
        direction: direction?,
        kind: kind?,
        rate: rate?,
        unit,
        min,
        max,
        instance: instance?.value.clone(),
        task: text("task"),
        property: text("property"),
    };
    Some(Located::new(signal, &name.place))
}

fn bound(element: &Element, name: &str, faults: &mut Faults) -> Option<f64> {
    let value = element.attribute(name)?;
    let number = value.value.trim().parse().ok().filter(|number: &f64| number.is_finite());
    if number.is_none() {
        faults.push(
            value.fault(format!("{:?} is no number", value.value), "expected a finite number in the signal's unit"),
        );
    }
    number
}

/// The required attribute `type` as the type of a signal.
pub(crate) fn signal_type(element: &Element, faults: &mut Faults) -> Option<Located<SignalType>> {
    let value = element.required("type", faults)?;
    match value.value.parse() {
        Ok(ty) => Some(Located::new(ty, &value.place)),
        Err(_) => {
            let names = ElementaryType::ALL.map(ElementaryType::name);
            let expected = format!("expected {}, or an array of one as REAL[16]", one_of(names));
            let fault = value.fault(format!("{:?} is no signal type", value.value), expected);
            faults.push(fault.did_you_mean(nearest(&value.value, names)));
            None
        }
    }
}

/// The attribute `unit`, if it is there.
pub(crate) fn unit(element: &Element, faults: &mut Faults) -> Option<Located<Unit>> {
    let value = element.attribute("unit")?;
    match Unit::named(&value.value) {
        Some(unit) => Some(Located::new(unit, &value.place)),
        None => {
            let symbols: Vec<&str> = Unit::ALL.iter().map(|unit| unit.symbol).collect();
            let found = format!("{:?} is no unit known here", value.value);
            let fault = value.fault(found, format!("expected {}", one_of(&symbols)));
            faults.push(fault.did_you_mean(nearest(&value.value, symbols)));
            None
        }
    }
}

/// What differs between the map that a plant gives and one that was found, one line each; nothing where they are the
/// same. An order that differs is told only where nothing else does.
pub fn differences(of_plant: &SignalMap, found: &SignalMap) -> Vec<String> {
    let mut lines = Vec::new();
    if of_plant.plant() != found.plant() {
        lines.push(format!("the map is of the plant {:?}: expected {:?}", found.plant(), of_plant.plant()));
    }
    for signal in of_plant.signals() {
        match found.register(&signal.name) {
            Some(id) => lines.extend(changed(signal, found.signal(id))),
            None => lines.push(format!("{} is missing", signal.name)),
        }
    }
    let strangers = found.signals().iter().filter(|signal| of_plant.register(&signal.name).is_none());
    lines.extend(strangers.map(|signal| format!("{} is no signal of the plant", signal.name)));
    if lines.is_empty() && of_plant.signals() != found.signals() {
        lines.push("the signals stand in another order than the plant gives".to_owned());
    }
    lines
}

/// The attributes in which two signals of one name differ.
fn changed(of_plant: &Signal, found: &Signal) -> Vec<String> {
    let (expected, present) = (attributes(of_plant), attributes(found));
    let value = |attributes: &[(&'static str, String)], name: &str| {
        let value = attributes.iter().find(|(known, _)| *known == name).map(|(_, value)| format!("{value:?}"));
        value.unwrap_or_else(|| "nothing".to_owned())
    };
    let mut names: Vec<&str> = expected.iter().chain(&present).map(|(name, _)| *name).collect();
    let mut seen = std::collections::BTreeSet::new();
    names.retain(|name| seen.insert(*name));
    names
        .into_iter()
        .filter(|name| value(&expected, name) != value(&present, name))
        .map(|name| format!("{}: {name} is {}: expected {}", found.name, value(&present, name), value(&expected, name)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> SignalMap {
        let signal = |name: &str, element, direction, kind| Signal {
            name: format!("Line1.Belt.{name}"),
            ty: SignalType::scalar(element),
            direction,
            kind,
            rate: RateClass::HighFrequency,
            unit: Unit::ONE,
            min: None,
            max: None,
            instance: "Line1.Belt".to_owned(),
            task: "Drive".to_owned(),
            property: name.to_owned(),
        };
        let mut speed = signal("velocityTarget", ElementaryType::Real, Direction::Command, Kind::Level);
        speed.unit = Unit::named("m/s").expect("a unit");
        let mut direction = signal("motorDirection", ElementaryType::Dint, Direction::Command, Kind::Edge);
        (direction.min, direction.max) = (Some(-1.0), Some(1.0));
        let mut temperature = signal("spectrum", ElementaryType::Lreal, Direction::Report, Kind::Level);
        temperature.ty.length = Some(16);
        temperature.rate = RateClass::LowFrequency;
        (temperature.task, temperature.property) = (String::new(), String::new());
        SignalMap::new("line & \"more\"", vec![speed, direction, temperature]).expect("names that differ")
    }

    #[test]
    fn a_map_reads_back_as_it_was_written() {
        let map = sample();
        let text = write(&map);
        assert_eq!(read("map.xml", &text).expect("a map"), map, "{text}");
        assert!(differences(&map, &map).is_empty());
    }

    #[test]
    fn a_map_is_one_line_for_each_signal() {
        let text = write(&sample());
        let line = "  <signal name=\"Line1.Belt.motorDirection\" type=\"DINT\" direction=\"command\" kind=\"edge\" \
                    rate=\"hf\" unit=\"1\" min=\"-1\" max=\"1\" instance=\"Line1.Belt\" task=\"Drive\" \
                    property=\"motorDirection\"/>";
        assert!(text.lines().any(|found| found == line), "{text}");
    }

    #[test]
    fn what_is_wrong_in_a_map_is_told_with_its_line() {
        let check = |signal: &str, expect: &str| {
            let text = format!("<signals-map plant=\"p\">\n{signal}\n</signals-map>");
            let faults = read("map.xml", &text).expect_err(signal).to_string();
            assert!(faults.contains(expect), "{signal}: {faults}");
        };
        let good = "<signal name=\"a\" type=\"REAL\" direction=\"report\" kind=\"level\" rate=\"hf\" instance=\"i\"/>";
        check(&good.replace("REAL", "FLOAT"), "map.xml:2:24: \"FLOAT\" is no signal type: expected BOOL, SINT");
        check(&good.replace("report", "rapport"), "expected command or report; did you mean \"report\"?");
        check(&good.replace(" rate=\"hf\"", ""), "map.xml:2:2: <signal> has no attribute \"rate\"");
        check(&good.replace("name=\"a\"", "name=\"a\" unit=\"km\""), "\"km\" is no unit known here");
        check(&good.replace("name=\"a\"", "name=\"a\" max=\"inf\""), "\"inf\" is no number");
        check(&format!("{good}\n{good}"), "map.xml:3:15: two signals are called \"a\"");
    }

    #[test]
    fn differences_are_told_by_name() {
        let map = sample();
        let check = |change: &dyn Fn(&mut Vec<Signal>), expect: &[&str]| {
            let mut signals = map.signals().to_vec();
            change(&mut signals);
            let changed = SignalMap::new(map.plant(), signals).expect("names that differ");
            assert_eq!(differences(&map, &changed), expect);
        };
        check(&|signals| signals[1].max = None, &["Line1.Belt.motorDirection: max is nothing: expected \"1\""]);
        check(&|signals| drop(signals.remove(0)), &["Line1.Belt.velocityTarget is missing"]);
        check(&|signals| signals.swap(0, 1), &["the signals stand in another order than the plant gives"]);
        check(
            &|signals| signals[0].name = "Belt.v".to_owned(),
            &["Line1.Belt.velocityTarget is missing", "Belt.v is no signal of the plant"],
        );
    }
}
