//! `prototype.xml`, the meta-descriptor of the reference's section 3.4.5: what a prototype is called, who made it, which
//! parameters its instances have, by which ports they are joined to others, and which logics they follow.
//!
//! Parameters are what shape and law have in common: an avatar's property takes one with `defaultValue="${length}"`.

use uuid::Uuid;

use super::basic::{BasicType, parse_boolean};
use super::quantity::parse_numbers;
use super::setting::{Constraint, Setting};
use super::words;
use crate::value::Quantity;
use crate::xml::{Element, Faults, Located, one_of};

/// A meta-descriptor.
#[derive(Clone, Debug)]
pub struct MetaDescriptor {
    pub uuid: Located<Uuid>,
    pub name: Located<String>,
    /// Progressive number of this version of the prototype.
    pub version: u32,
    /// Its name for people.
    pub display_name: String,
    /// Who made it.
    pub vendor: String,
    /// The group it belongs to.
    pub category: Option<String>,
    /// The script that builds its shape from its parameters. The reference requires one; here a prototype without is a
    /// law without a shape.
    pub generator: Option<Located<String>>,
    /// Centre of the box about its shape: x, y, z in m.
    pub bounds_center: Option<[f64; 3]>,
    /// Size of the box about its shape: x, y, z in m.
    pub bounds_size: Option<[f64; 3]>,
    pub parameters: Vec<Parameter>,
    pub inputs: Vec<Port>,
    pub outputs: Vec<Port>,
    pub logics: Option<Logics>,
}

/// A parameter of the meta-descriptor.
#[derive(Clone, Debug)]
pub struct Parameter {
    pub setting: Setting,
    /// Its name for people.
    pub display_name: Option<String>,
    /// Whether another value makes another shape.
    pub affects_geometry: bool,
}

/// Where instances are joined to each other in the model; it has nothing to do with the automation's signals.
#[derive(Clone, Debug)]
pub struct Port {
    pub name: Located<String>,
    /// Any word that both ends know.
    pub ty: String,
    /// The coordinate system of the shape that the port lies in.
    pub frame: Option<String>,
}

/// The law of a prototype that exchanges nothing with the automation: a device kind and its parameters.
#[derive(Clone, Debug)]
pub struct Logics {
    /// The device kind's name.
    pub ty: Located<String>,
    pub params: Vec<Param>,
}

/// A parameter of the logics.
#[derive(Clone, Debug)]
pub struct Param {
    pub name: Located<String>,
    pub ty: BasicType,
    /// A value, in which `${name}` stands for the value of a parameter of the prototype.
    pub content: Located<String>,
}

/// Reads a meta-descriptor; what is wrong is added to `faults`, and `None` means that something essential is missing.
pub fn read(root: &Element, faults: &mut Faults) -> Option<MetaDescriptor> {
    if root.name.value != "prototype" {
        let found = format!("the root element is <{}>", root.name.value);
        faults.push(root.name.fault(found, "expected <prototype>"));
        return None;
    }
    root.allow_attributes(&["uuid", "name", "version"], faults);
    root.allow_children(&["property", "parameter", "input", "output", "logics"], faults);
    let (uuid, name) = (words::uuid(root, faults), words::identifier(root, "name", faults));
    let version = version(root, faults);
    let known = ["displayName", "vendor", "category", "generator", "bounds_center", "bounds_size"];
    let properties = Properties::read(root, &known, faults);
    let parameters: Vec<Parameter> =
        root.children_named("parameter").filter_map(|element| parameter(element, faults)).collect();
    super::refuse_doubles(parameters.iter().map(|parameter| &parameter.setting.name), "parameters", faults);
    let ports = |direction, faults: &mut Faults| -> Vec<Port> {
        root.children_named(direction).filter_map(|element| port(element, faults)).collect()
    };
    let (inputs, outputs) = (ports("input", faults), ports("output", faults));
    super::refuse_doubles(inputs.iter().chain(&outputs).map(|port| &port.name), "ports", faults);
    let mut all_logics = root.children_named("logics");
    let logics = all_logics.next().and_then(|element| logics(element, faults));
    if let Some(second) = all_logics.next() {
        faults.push(second.name.fault("a second <logics>", "expected at most one in a prototype"));
    }
    let display_name = properties.required("displayName", root, faults);
    let vendor = properties.required("vendor", root, faults);
    Some(MetaDescriptor {
        uuid: uuid?,
        name: name?,
        version: version?,
        display_name: display_name?,
        vendor: vendor?,
        category: properties.text("category"),
        generator: properties.get("generator").cloned(),
        bounds_center: properties.vector("bounds_center", faults),
        bounds_size: properties.vector("bounds_size", faults),
        parameters,
        inputs,
        outputs,
        logics,
    })
}

fn version(root: &Element, faults: &mut Faults) -> Option<u32> {
    let value = root.required("version", faults)?;
    let version = value.value.parse().ok().filter(|version| *version > 0);
    if version.is_none() {
        let found = format!("{:?} is no version", value.value);
        faults.push(value.fault(found, "expected a whole number, 1 or more"));
    }
    version
}

/// The `<property name type value/>` elements of an element, of which the reference fixes the names.
struct Properties(Vec<(String, Located<String>)>);

impl Properties {
    fn read(parent: &Element, known: &[&str], faults: &mut Faults) -> Properties {
        let mut properties: Vec<(Located<String>, Located<String>)> = Vec::new();
        for element in parent.children_named("property") {
            element.allow_attributes(&["name", "type", "value"], faults);
            element.allow_children(&[], faults);
            let name = element.required("name", faults);
            words::basic_type(element, faults);
            let Some(value) = element.attribute("value") else {
                faults.push(element.name.fault("a property without a value", "expected value=\"…\" in this element"));
                continue;
            };
            let Some(name) = name else { continue };
            if !known.contains(&name.value.as_str()) {
                let found = format!("<{}> has no property {:?}", parent.name.value, name.value);
                let fault = name.fault(found, format!("expected {}", one_of(known)));
                faults.push(fault.did_you_mean(crate::xml::nearest(&name.value, known.iter().copied())));
            }
            properties.push((name.clone(), value.clone()));
        }
        super::refuse_doubles(properties.iter().map(|(name, _)| name), "properties", faults);
        Properties(properties.into_iter().map(|(name, value)| (name.value, value)).collect())
    }

    fn get(&self, name: &str) -> Option<&Located<String>> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    fn text(&self, name: &str) -> Option<String> {
        self.get(name).map(|value| value.value.clone())
    }

    fn required(&self, name: &str, parent: &Element, faults: &mut Faults) -> Option<String> {
        let text = self.text(name);
        if text.is_none() {
            let found = format!("<{}> has no property {name:?}", parent.name.value);
            let expected = format!("expected <property name=\"{name}\" type=\"string\" value=\"…\"/> in it");
            faults.push(parent.name.fault(found, expected));
        }
        text
    }

    fn vector(&self, name: &str, faults: &mut Faults) -> Option<[f64; 3]> {
        let value = self.get(name)?;
        let vector = match parse_numbers(&value.value, None, &[Quantity::Length]) {
            Ok(numbers) => <[f64; 3]>::try_from(numbers).ok(),
            Err(_) => None,
        };
        if vector.is_none() {
            let found = format!("{:?} is no vector", value.value);
            faults.push(value.fault(found, "expected three numbers separated by ;, in m"));
        }
        vector
    }

    fn boolean(&self, name: &str, faults: &mut Faults) -> bool {
        let Some(value) = self.get(name) else { return false };
        parse_boolean(&value.value).unwrap_or_else(|| {
            faults.push(value.fault(format!("{:?} is no boolean", value.value), "expected true, false, 1 or 0"));
            false
        })
    }
}

fn parameter(element: &Element, faults: &mut Faults) -> Option<Parameter> {
    element.allow_attributes(&["name", "type", "value", "unit", "tolerance"], faults);
    element.allow_children(&["property"], faults);
    let properties = Properties::read(element, &["displayName", "affectGeometry", "constraints"], faults);
    let constraints = match properties.get("constraints") {
        Some(text) => Constraint::read(text, faults),
        None => Vec::new(),
    };
    let setting = Setting::read(element, "value", constraints, faults);
    let affects_geometry = properties.boolean("affectGeometry", faults);
    Some(Parameter { setting: setting?, display_name: properties.text("displayName"), affects_geometry })
}

fn port(element: &Element, faults: &mut Faults) -> Option<Port> {
    element.allow_attributes(&["name", "type"], faults);
    element.allow_children(&["property"], faults);
    let properties = Properties::read(element, &["frame"], faults);
    let (name, ty) = (words::identifier(element, "name", faults), element.required("type", faults));
    Some(Port { name: name?, ty: ty?.value.clone(), frame: properties.text("frame") })
}

fn logics(element: &Element, faults: &mut Faults) -> Option<Logics> {
    element.allow_attributes(&["type"], faults);
    element.allow_children(&["param"], faults);
    let mut params = Vec::new();
    for param in element.children_named("param") {
        param.allow_attributes(&["name", "type"], faults);
        let (name, ty) = (words::identifier(param, "name", faults), words::basic_type(param, faults));
        if let (Some(name), Some(ty)) = (name, ty) {
            params.push(Param { name, ty, content: param.text.clone() });
        }
    }
    super::refuse_doubles(params.iter().map(|param| &param.name), "params", faults);
    Some(Logics { ty: element.required("type", faults)?.clone(), params })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prototype::setting::Relation;
    use crate::xml::parse;

    /// The examples printed in the reference's section 3.4.5, in one; port and logics after its tables.
    const PRINTED: &str = r#"
<prototype uuid="bad1968f-5607-4f4b-960e-c333ce324ae4" name="Cartesian" version="1">
  <property name="displayName" value="Cartesian Robot" type="string"/>
  <property name="vendor" value="TTS" type="string"/>
  <property name="category" value="handling" type="string"/>
  <property name="generator" value="builder.js" type="string"/>
  <property name="bounds_size" value="2;1.5;1200 mm" type="double[]"/>
  <parameter name="zSpeed" type="double" value="10">
    <property name="constraints" value=">0" type="string"/>
    <property name="displayName" value="Z speed [m/min]" type="string"/>
    <property name="affectGeometry" value="false" type="boolean"/>
  </parameter>
  <input name="partIn" type="test.Part"><property name="frame" value="start" type="string"/></input>
  <output name="partOut" type="test.Part"/>
  <logics type="test.Robot">
    <param name="speed" type="double">${zSpeed}</param>
  </logics>
</prototype>"#;

    fn read_text(text: &str) -> (Option<MetaDescriptor>, String) {
        let mut faults = Faults::default();
        let meta = read(&parse("prototype.xml", text).expect("well-formed"), &mut faults);
        (meta, faults.to_string())
    }

    #[test]
    fn the_references_examples_are_read() {
        let (meta, faults) = read_text(PRINTED);
        assert_eq!(faults, "");
        let meta = meta.expect("a meta-descriptor");
        assert_eq!((meta.name.value.as_str(), meta.version), ("Cartesian", 1));
        assert_eq!((meta.display_name.as_str(), meta.vendor.as_str()), ("Cartesian Robot", "TTS"));
        assert_eq!(
            (meta.category.as_deref(), meta.generator.as_ref().map(|file| file.value.as_str())),
            (Some("handling"), Some("builder.js"))
        );
        assert_eq!((meta.bounds_center, meta.bounds_size), (None, Some([0.002, 0.0015, 1.2])));
        let [speed] = meta.parameters.as_slice() else { panic!("one parameter") };
        assert_eq!(speed.display_name.as_deref(), Some("Z speed [m/min]"));
        assert!(!speed.affects_geometry);
        assert_eq!(speed.setting.constraints[0].relation, Relation::Above);
        assert_eq!((meta.inputs[0].frame.as_deref(), meta.outputs[0].frame.as_deref()), (Some("start"), None));
        let logics = meta.logics.expect("logics");
        assert_eq!((logics.ty.value.as_str(), logics.params[0].content.value.as_str()), ("test.Robot", "${zSpeed}"));
    }

    #[test]
    fn what_is_wrong_is_told() {
        let check = |from: &str, to: &str, expect: &str| {
            let (_, faults) = read_text(&PRINTED.replacen(from, to, 1));
            assert!(faults.contains(expect), "{to}: {faults}");
        };
        check(" version=\"1\"", "", "<prototype> has no attribute \"version\"");
        check("version=\"1\"", "version=\"1.2\"", "\"1.2\" is no version: expected a whole number, 1 or more");
        check("displayName", "dispalyName", "did you mean \"displayName\"?");
        check("\"vendor\"", "\"category\"", "<prototype> has no property \"vendor\"");
        check("2;1.5;1200 mm", "2;1.5", "\"2;1.5\" is no vector: expected three numbers");
        check("\">0\"", "\">O\"", "\">O\" is no constraint");
        check("value=\"false\"", "value=\"no\"", "\"no\" is no boolean");
        check("partOut", "partIn", "two ports are called \"partIn\"");
        check("</logics>", "</logics><logics type=\"test.Other\"/>", "a second <logics>");
    }
}
