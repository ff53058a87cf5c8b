//! `avatar.xml`, the digital avatar of the reference's section 6.3.1: which signals a prototype exchanges with the
//! automation, what can be set about it, and which tasks bring it to life.
//!
//! Ours beyond the reference: on signals `unit`, `min`, `max`, `kind`, `rate` and `when`; on properties `unit` and
//! `tolerance`.

use uuid::Uuid;

use super::setting::Setting;
use super::words;
use crate::signal_map::xml::{KINDS, RATES, signal_type, unit};
use crate::signal_map::{Direction, Kind, RateClass};
use crate::value::{SignalType, Unit};
use crate::xml::{Element, Faults, Located};

/// An avatar.
#[derive(Clone, Debug)]
pub struct Avatar {
    pub uuid: Located<Uuid>,
    pub name: Located<String>,
    /// Inputs and outputs in the order of the file.
    pub signals: Vec<SignalDeclaration>,
    pub properties: Vec<Property>,
    pub tasks: Vec<TaskDeclaration>,
}

/// An `<input>` or `<output>`: seen from the plant, so that an input is the automation's command.
#[derive(Clone, Debug)]
pub struct SignalDeclaration {
    pub name: Located<String>,
    pub ty: Located<SignalType>,
    pub direction: Direction,
    /// Where it goes to or comes from. An input may go to several tasks.
    pub maps: Vec<Map>,
    pub unit: Option<Located<Unit>>,
    /// The least value, in `unit`.
    pub min: Option<Located<f64>>,
    /// The greatest value, in `unit`.
    pub max: Option<Located<f64>>,
    pub kind: Option<Kind>,
    pub rate: RateClass,
    /// Instances of which it is a signal; all where there is no condition.
    pub when: Option<Condition>,
}

/// A `<map>`: a property of a task.
#[derive(Clone, Debug)]
pub struct Map {
    pub task: Located<String>,
    pub property: Located<String>,
}

/// A `<property>` of the prototype.
#[derive(Clone, Debug)]
pub struct Property {
    pub setting: Setting,
    pub maps: Vec<Map>,
}

/// A `<task>`: a device of the engine.
#[derive(Clone, Debug)]
pub struct TaskDeclaration {
    pub name: Located<String>,
    /// The device kind's name.
    pub ty: Located<String>,
    pub properties: Vec<Setting>,
}

/// `when="mode=position|ideal"`: holds while a property has one of these values.
#[derive(Clone, Debug)]
pub struct Condition {
    pub property: String,
    pub values: Vec<String>,
    pub text: Located<String>,
}

/// Reads an avatar; what is wrong is added to `faults`, and `None` means that something essential is missing.
pub fn read(root: &Element, faults: &mut Faults) -> Option<Avatar> {
    if root.name.value != "prototype" {
        let found = format!("the root element is <{}>", root.name.value);
        faults.push(root.name.fault(found, "expected <prototype>"));
        return None;
    }
    root.allow_attributes(&["uuid", "name"], faults);
    root.allow_children(&["input", "output", "properties", "property", "task"], faults);
    let (uuid, name) = (words::uuid(root, faults), words::identifier(root, "name", faults));
    let (mut signals, mut properties, mut tasks) = (Vec::new(), Vec::new(), Vec::new());
    for child in &root.children {
        match child.name.value.as_str() {
            "input" => signals.extend(signal(child, Direction::Command, faults)),
            "output" => signals.extend(signal(child, Direction::Report, faults)),
            "property" => properties.extend(property(child, faults)),
            "properties" => {
                child.allow_attributes(&[], faults);
                child.allow_children(&["property"], faults);
                properties.extend(child.children_named("property").filter_map(|child| property(child, faults)));
            }
            "task" => tasks.extend(task(child, faults)),
            _ => {}
        }
    }
    super::refuse_doubles(properties.iter().map(|property: &Property| &property.setting.name), "properties", faults);
    super::refuse_doubles(tasks.iter().map(|task: &TaskDeclaration| &task.name), "tasks", faults);
    Some(Avatar { uuid: uuid?, name: name?, signals, properties, tasks })
}

fn signal(element: &Element, direction: Direction, faults: &mut Faults) -> Option<SignalDeclaration> {
    element.allow_attributes(&["name", "type", "unit", "min", "max", "kind", "rate", "when"], faults);
    element.allow_children(&["map"], faults);
    let (name, ty) = (words::identifier(element, "name", faults), signal_type(element, faults));
    let maps: Vec<Map> = element.children_named("map").filter_map(|child| map(child, faults)).collect();
    if let (Direction::Report, [first, second, ..]) = (direction, maps.as_slice()) {
        let fault = second.property.fault("two things at one output", "expected one <map>: an output has one value");
        faults.push(fault.beside(&first.property.place, "the first"));
    }
    let declaration = SignalDeclaration {
        unit: unit(element, faults),
        min: words::bare_number(element, "min", faults),
        max: words::bare_number(element, "max", faults),
        kind: element.choice("kind", &KINDS, faults),
        rate: element.choice("rate", &RATES, faults).unwrap_or(RateClass::HighFrequency),
        when: condition(element, faults),
        name: name?,
        ty: ty?,
        direction,
        maps,
    };
    if let (Some(min), Some(max)) = (&declaration.min, &declaration.max)
        && min.value > max.value
    {
        let found = format!("the greatest value, {}, is below the least, {}", max.value, min.value);
        faults.push(max.fault(found, format!("expected {} or more", min.value)));
    }
    Some(declaration)
}

fn condition(element: &Element, faults: &mut Faults) -> Option<Condition> {
    let text = element.attribute("when")?;
    let parts = text.value.split_once('=').map(|(property, values)| (property.trim(), values));
    match parts {
        Some((property, values)) if words::is_identifier(property) && !values.trim().is_empty() => Some(Condition {
            property: property.to_owned(),
            values: values.split('|').map(|value| value.trim().to_owned()).collect(),
            text: text.clone(),
        }),
        _ => {
            let found = format!("{:?} is no condition", text.value);
            faults.push(text.fault(found, "expected a property and its values: mode=position|ideal"));
            None
        }
    }
}

fn map(element: &Element, faults: &mut Faults) -> Option<Map> {
    element.allow_attributes(&["task", "property"], faults);
    element.allow_children(&[], faults);
    let (task, property) = (element.required("task", faults), element.required("property", faults));
    Some(Map { task: task?.clone(), property: property?.clone() })
}

fn property(element: &Element, faults: &mut Faults) -> Option<Property> {
    element.allow_attributes(&["name", "type", "defaultValue", "unit", "tolerance"], faults);
    element.allow_children(&["map"], faults);
    let setting = Setting::read(element, "defaultValue", Vec::new(), faults);
    let maps = element.children_named("map").filter_map(|child| map(child, faults)).collect();
    Some(Property { setting: setting?, maps })
}

fn task(element: &Element, faults: &mut Faults) -> Option<TaskDeclaration> {
    element.allow_attributes(&["name", "type"], faults);
    element.allow_children(&["property"], faults);
    let (name, ty) = (words::identifier(element, "name", faults), element.required("type", faults));
    let mut properties = Vec::new();
    for child in element.children_named("property") {
        child.allow_attributes(&["name", "type", "defaultValue", "unit", "tolerance"], faults);
        child.allow_children(&[], faults);
        properties.extend(Setting::read(child, "defaultValue", Vec::new(), faults));
    }
    super::refuse_doubles(properties.iter().map(|setting| &setting.name), "properties", faults);
    Some(TaskDeclaration { name: name?, ty: ty?.clone(), properties })
}
