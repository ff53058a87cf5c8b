//! A plant's file, word by word: `plant.xml` becomes declarations that know their places. What they name is looked up
//! when the plant is assembled.

use std::collections::BTreeMap;
use std::time::Duration;

use super::{EffectPlace, EffectPlaces, EffectSpec, ParameterValue, PartKind, Pose};
use crate::prototype::quantity::{parse_number, unit_in};
use crate::prototype::words;
use crate::signal_map::xml::unit;
use crate::time::parse_duration;
use crate::value::{Quantity, Unit};
use crate::xml::{Element, Faults, Located, Place};

/// A `<plant>`.
#[derive(Clone, Debug)]
pub(super) struct PlantFile {
    pub name: Located<String>,
    /// The file of the plant that this one changes, relative to this one's folder.
    pub base: Option<Located<String>>,
    /// For all parameters of all instances.
    pub tolerance: Option<f64>,
    pub adapter: AdapterDeclaration,
    pub instances: Vec<InstanceDeclaration>,
    pub parts: Vec<PartDeclaration>,
}

/// An `<adapter>`; what it does not say stays as it was.
#[derive(Clone, Debug, Default)]
pub(super) struct AdapterDeclaration {
    pub host: Option<String>,
    pub port: Option<u16>,
    pub timeout: Option<Duration>,
    pub signals_map: Option<String>,
    pub hf: Option<Duration>,
    pub lf: Option<Duration>,
}

/// An `<instance>`.
#[derive(Clone, Debug)]
pub(super) struct InstanceDeclaration {
    pub name: Located<String>,
    /// Required, but where it changes an instance of the base.
    pub prototype: Option<Located<String>>,
    pub pose: Option<Pose>,
    pub properties: Vec<PropertyDeclaration>,
    pub effects: Vec<EffectDeclaration>,
    /// The folder of the plant's file that declares it: its prototype is looked for from there.
    pub home: String,
}

/// A `<property>` of an instance.
#[derive(Clone, Debug)]
pub(super) struct PropertyDeclaration {
    pub name: Located<String>,
    pub value: Located<String>,
    pub tolerance: Option<f64>,
}

/// An `<effect>` of an instance.
#[derive(Clone, Debug)]
pub(super) struct EffectDeclaration {
    pub spec: EffectSpec,
    pub places: EffectPlaces,
}

/// A `<part>`.
#[derive(Clone, Debug)]
pub(super) struct PartDeclaration {
    pub place: Place,
    pub kind: PartKind,
    pub at: Option<Located<String>>,
    pub pose: Pose,
    pub size: [f64; 3],
}

/// Reads the `<plant>` of a file that lies in the folder `home`.
pub(super) fn read(root: &Element, home: &str, faults: &mut Faults) -> Option<PlantFile> {
    if root.name.value != "plant" {
        let found = format!("the root element is <{}>", root.name.value);
        faults.push(root.name.fault(found, "expected <plant>"));
        return None;
    }
    root.allow_attributes(&["name", "base", "tolerance"], faults);
    root.allow_children(&["adapter", "instance", "part"], faults);
    let name = plant_name(root, faults);
    let mut adapters = root.children_named("adapter");
    let adapter = adapters.next().map(|element| adapter(element, faults)).unwrap_or_default();
    if let Some(second) = adapters.next() {
        faults.push(second.name.fault("a second <adapter>", "expected at most one in a plant"));
    }
    let base = root.attribute("base").cloned();
    let instances: Vec<InstanceDeclaration> =
        root.children_named("instance").filter_map(|child| instance(child, home, base.is_some(), faults)).collect();
    let names = instances.iter().map(|instance| &instance.name);
    crate::prototype::refuse_doubles(names, "instances", faults);
    let parts = root.children_named("part").filter_map(|child| part(child, faults)).collect();
    let tolerance = words::tolerance(root, faults);
    Some(PlantFile { name: name?, base, tolerance, adapter, instances, parts })
}

/// A plant's name is also the name of its signals map's file.
fn plant_name(root: &Element, faults: &mut Faults) -> Option<Located<String>> {
    let name = root.required("name", faults)?;
    if name.value.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c)) && !name.value.starts_with('.') {
        return Some(name.clone());
    }
    let found = format!("{:?} is no plant's name", name.value);
    faults.push(name.fault(found, "expected letters, digits, _, - and ."));
    None
}

fn adapter(element: &Element, faults: &mut Faults) -> AdapterDeclaration {
    element.allow_attributes(&["host", "port", "timeout", "hf", "lf", "signals-map"], faults);
    element.allow_children(&[], faults);
    let text = |name: &str| element.attribute(name).map(|value| value.value.clone()).filter(|text| !text.is_empty());
    AdapterDeclaration {
        host: text("host"),
        port: port(element, faults),
        timeout: interval(element, "timeout", faults),
        signals_map: text("signals-map"),
        hf: interval(element, "hf", faults),
        lf: interval(element, "lf", faults),
    }
}

fn port(element: &Element, faults: &mut Faults) -> Option<u16> {
    let value = element.attribute("port")?;
    let port = value.value.parse().ok().filter(|port| *port > 0);
    if port.is_none() {
        faults.push(value.fault(format!("{:?} is no port", value.value), "expected a whole number from 1 to 65535"));
    }
    port
}

fn interval(element: &Element, name: &str, faults: &mut Faults) -> Option<Duration> {
    let value = element.attribute(name)?;
    match parse_duration(&value.value) {
        Ok(Duration::ZERO) => {
            faults.push(value.fault(format!("{name} is 0"), "expected more than 0"));
            None
        }
        Ok(span) => Some(span),
        Err(_) => {
            let found = format!("{:?} is no duration", value.value);
            faults.push(value.fault(found, "expected a number and its unit: 5s, 500ms, 20ms"));
            None
        }
    }
}

fn instance(element: &Element, home: &str, has_base: bool, faults: &mut Faults) -> Option<InstanceDeclaration> {
    element.allow_attributes(&["name", "prototype"], faults);
    element.allow_children(&["pose", "property", "effect"], faults);
    let name = qualified(element, faults);
    // In a plant with a base, an instance without prototype changes the base's; assembling looks whether there is one.
    let prototype = match element.attribute("prototype") {
        None if has_base => None,
        _ => Some(words::identifier(element, "prototype", faults)),
    };
    let mut poses = element.children_named("pose");
    let pose = poses.next().map(|child| {
        child.allow_attributes(&["x", "y", "z", "rx", "ry", "rz"], faults);
        child.allow_children(&[], faults);
        pose(child, faults)
    });
    if let Some(second) = poses.next() {
        faults.push(second.name.fault("a second <pose>", "expected at most one in an instance"));
    }
    let properties: Vec<PropertyDeclaration> =
        element.children_named("property").filter_map(|child| property(child, faults)).collect();
    crate::prototype::refuse_doubles(properties.iter().map(|property| &property.name), "properties", faults);
    let effects = element.children_named("effect").filter_map(|child| effect(child, faults)).collect();
    let prototype = match prototype {
        Some(read) => Some(read?),
        None => None,
    };
    Some(InstanceDeclaration { name: name?, prototype, pose, properties, effects, home: home.to_owned() })
}

/// An instance's name: identifiers joined by points, so that a function block's qualified name can be one.
pub(super) fn qualified(element: &Element, faults: &mut Faults) -> Option<Located<String>> {
    let name = element.required("name", faults)?;
    if name.value.split('.').all(words::is_identifier) {
        return Some(name.clone());
    }
    let found = format!("{:?} is no instance's name", name.value);
    faults.push(name.fault(found, "expected letters, digits and _, no digit first; points between such names"));
    None
}

fn property(element: &Element, faults: &mut Faults) -> Option<PropertyDeclaration> {
    element.allow_attributes(&["name", "value", "tolerance"], faults);
    element.allow_children(&[], faults);
    let (name, tolerance) = (element.required("name", faults), words::tolerance(element, faults));
    let Some(value) = element.attribute("value") else {
        faults.push(element.name.fault("a property without a value", "expected value=\"…\" in this element"));
        return None;
    };
    Some(PropertyDeclaration { name: name?.clone(), value: value.clone(), tolerance })
}

/// The number in the attribute `name`, in SI; 0 where it is not there.
fn number(element: &Element, name: &str, quantity: Quantity, faults: &mut Faults) -> f64 {
    let Some(value) = element.attribute(name) else { return 0.0 };
    parse_number(&value.value, None, &[quantity]).unwrap_or_else(|error| {
        faults.push(value.fault(error.found, error.expected));
        0.0
    })
}

fn pose(element: &Element, faults: &mut Faults) -> Pose {
    let mut length = |name: &str| number(element, name, Quantity::Length, faults);
    let (x, y, z) = (length("x"), length("y"), length("z"));
    let mut angle = |name: &str| number(element, name, Quantity::Angle, faults);
    Pose { x, y, z, rx: angle("rx"), ry: angle("ry"), rz: angle("rz") }
}

/// An `<effect>`, in a plant's file or in one of effects.
pub(super) fn effect(element: &Element, faults: &mut Faults) -> Option<EffectDeclaration> {
    element.allow_attributes(&["kind", "place", "component"], faults);
    element.allow_children(&["parameter"], faults);
    let kind = element.required("kind", faults).cloned();
    if let Some(kind) = &kind
        && !kind.value.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
    {
        faults.push(kind.fault(format!("{:?} is no effect", kind.value), "expected words joined by -: belt-slip"));
    }
    let choices = EffectPlace::ALL.map(|place| (place.name(), place));
    let place = element.required_choice("place", &choices, faults);
    let (mut parameters, mut places) = (BTreeMap::new(), BTreeMap::new());
    let mut names = Vec::new();
    for child in element.children_named("parameter") {
        if let Some(EffectParameter { name, value, unit }) = effect_parameter(child, faults) {
            parameters.insert(name.value.clone(), value.value);
            places.insert(name.value.clone(), (value.place, unit));
            names.push(name);
        }
    }
    crate::prototype::refuse_doubles(names.iter(), "parameters", faults);
    let component = element.attribute("component").cloned();
    let (kind, place) = (kind?, place?);
    let places = EffectPlaces {
        element: element.name.place.clone(),
        kind: kind.place,
        place: element.attribute("place")?.place.clone(),
        component: component.as_ref().map(|component| component.place.clone()),
        parameters: places,
    };
    let component = component.map(|component| component.value);
    Some(EffectDeclaration { spec: EffectSpec { place, kind: kind.value, component, parameters }, places })
}

/// A `<parameter>` of an `<effect>`.
struct EffectParameter {
    name: Located<String>,
    /// A number in SI, whatever its unit, or else a text.
    value: Located<ParameterValue>,
    unit: Option<Located<Unit>>,
}

fn effect_parameter(element: &Element, faults: &mut Faults) -> Option<EffectParameter> {
    element.allow_attributes(&["name", "value", "unit"], faults);
    element.allow_children(&[], faults);
    let (name, value) = (element.required("name", faults), element.required("value", faults));
    let unit = unit(element, faults);
    let value = value?;
    let every: Vec<Quantity> = Unit::ALL.iter().map(|unit| unit.quantity).collect();
    let parameter = match parse_number(&value.value, unit.as_ref().map(|unit| unit.value), &every) {
        Ok(number) => ParameterValue::Number(number),
        Err(error) if unit.is_some() => {
            faults.push(value.fault(error.found, error.expected));
            return None;
        }
        Err(_) => ParameterValue::Text(value.value.clone()),
    };
    let unit = unit.or_else(|| Some(Located::new(unit_in(&value.value)?, &value.place)));
    Some(EffectParameter { name: name?.clone(), value: Located::new(parameter, &value.place), unit })
}

fn part(element: &Element, faults: &mut Faults) -> Option<PartDeclaration> {
    element.allow_attributes(&["kind", "at", "x", "y", "z", "rx", "ry", "rz", "size"], faults);
    element.allow_children(&[], faults);
    let kinds = [("box", PartKind::Box), ("pallet", PartKind::Pallet)];
    let kind = element.required_choice("kind", &kinds, faults);
    let (size, pose) = (size(element, faults), pose(element, faults));
    Some(PartDeclaration {
        place: element.name.place.clone(),
        kind: kind?,
        at: element.attribute("at").cloned(),
        pose,
        size: size?,
    })
}

fn size(element: &Element, faults: &mut Faults) -> Option<[f64; 3]> {
    let value = element.required("size", faults)?;
    let numbers = crate::prototype::quantity::parse_numbers(&value.value, None, &[Quantity::Length]);
    let size = numbers.ok().and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
    let size = size.filter(|size| size.iter().all(|side| *side > 0.0));
    if size.is_none() {
        let found = format!("{:?} is no size", value.value);
        faults
            .push(value.fault(found, "expected length, width and height above 0, separated by ;, bare or in m or mm"));
    }
    size
}
