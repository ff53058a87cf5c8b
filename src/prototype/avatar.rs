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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::xml::parse;

    /// The example printed in the reference's section 6.3.1.
    const PRINTED: &str = r#"
<prototype uuid="a7315040-3e5c-42cb-b5ee-b532b7e08e5d" name="Pusher">
  <input name="command" type="DINT">
    <map task="PusherSensor" property="pusherCommand_RegistryIn"/>
  </input>
  <!-- Pusher Extended TRUE:is completely extended -->
  <output name="limitExtended" type="BOOL">
    <map task="PusherSensor" property="pusherLimitExtended_RegistryOut"/>
  </output>
  <properties>
    <property name="pusherAxisValue" defaultValue="500" type="double">
      <map task="PusherSensor" property="pusherAxisValue"/>
    </property>
    <property name="sensorColor" defaultValue="255;0;0" type="integer[]">
      <map task="PusherSensor" property="appearanceColorRGB"/>
    </property>
  </properties>
  <task type="synesis.sensors.PusherBoxSensorModule" name="PusherSensor">
    <property name="boxDimentions" defaultValue="120 120 20" type="vector3"/>
    <property name="pusherAxisName" defaultValue="$.Spintore.T" type="string"/>
  </task>
</prototype>"#;

    fn read_text(text: &str) -> (Option<Avatar>, String) {
        let mut faults = Faults::default();
        let avatar = read(&parse("avatar.xml", text).expect("well-formed"), &mut faults);
        (avatar, faults.to_string())
    }

    #[test]
    fn the_references_example_is_read() {
        let (avatar, faults) = read_text(PRINTED);
        assert_eq!(faults, "");
        let avatar = avatar.expect("an avatar");
        assert_eq!(avatar.name.value, "Pusher");
        let [command, extended] = avatar.signals.as_slice() else { panic!("two signals") };
        assert_eq!((command.direction, extended.direction), (Direction::Command, Direction::Report));
        assert_eq!(command.maps[0].property.value, "pusherCommand_RegistryIn");
        let defaults: Vec<&str> = avatar.properties.iter().map(|p| p.setting.default.value.as_str()).collect();
        assert_eq!(defaults, ["500", "255;0;0"]);
        assert_eq!(avatar.tasks[0].ty.value, "synesis.sensors.PusherBoxSensorModule");
        assert_eq!(avatar.tasks[0].properties[1].default.value, "$.Spintore.T");
    }

    #[test]
    fn what_we_add_to_signals_is_read() {
        let signal = r#"<output name="speed" type="REAL" unit="mm/s" min="-5" max="5" kind="edge" rate="lf"
                                when="mode=position| ideal"/>"#;
        let text = PRINTED.replace("  <properties>", &format!("{signal}<properties>"));
        let (avatar, faults) = read_text(&text);
        assert_eq!(faults, "");
        let speed = avatar.expect("an avatar").signals.pop().expect("a third signal");
        assert_eq!(speed.unit.map(|unit| unit.value.symbol), Some("mm/s"));
        assert_eq!((speed.min.map(|min| min.value), speed.max.map(|max| max.value)), (Some(-5.0), Some(5.0)));
        assert_eq!((speed.kind, speed.rate), (Some(Kind::Edge), RateClass::LowFrequency));
        let when = speed.when.expect("a condition");
        assert_eq!((when.property.as_str(), when.values), ("mode", vec!["position".to_owned(), "ideal".to_owned()]));
    }

    #[test]
    fn what_is_wrong_is_told() {
        let check = |from: &str, to: &str, expect: &str| {
            let (_, faults) = read_text(&PRINTED.replacen(from, to, 1));
            assert!(faults.contains(expect), "{to}: {faults}");
        };
        check("name=\"command\"", "name=\"com.mand\"", "\"com.mand\" is no identifier");
        check("type=\"DINT\"", "type=\"DINT\" kind=\"egde\"", "did you mean \"edge\"?");
        check("type=\"DINT\"", "type=\"DINT\" min=\"3\" max=\"1\"", "the greatest value, 1, is below the least, 3");
        check("type=\"DINT\"", "type=\"DINT\" when=\"mode\"", "\"mode\" is no condition");
        check("type=\"DINT\"", "typ=\"DINT\"", "<input> has no attribute \"type\"");
        check("type=\"integer[]\"", "type=\"int[]\"", "\"int[]\" is no basic data type");
        check("name=\"sensorColor\"", "name=\"pusherAxisValue\"", "two properties are called \"pusherAxisValue\"");
        check("\"255;0;0\" type=\"integer[]\"", "\"red\" type=\"string\" unit=\"mm\"", "a unit for a string");
        check("a7315040-", "a731504-", "is no uuid: expected 32 hexadecimal digits");
    }
}
