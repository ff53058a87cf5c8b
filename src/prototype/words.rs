//! Reading single words out of a model's elements: names, identifiers, units, types. Each adds a fault where it fails.

use uuid::Uuid;

use super::basic::BasicType;
use super::quantity::parse_number;
use crate::value::Quantity;
use crate::xml::{Element, Faults, Located, nearest, one_of};

/// Whether `name` is an identifier as IEC 61131-3 has it: letters, digits and `_`, not starting with a digit.
pub fn is_identifier(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// The required attribute `name` as an identifier.
pub fn identifier(element: &Element, name: &str, faults: &mut Faults) -> Option<Located<String>> {
    let value = element.required(name, faults)?;
    if is_identifier(&value.value) {
        return Some(value.clone());
    }
    let found = format!("{:?} is no identifier", value.value);
    faults.push(value.fault(found, "expected letters, digits and _, no digit first"));
    None
}

/// The required attribute `uuid`.
pub fn uuid(element: &Element, faults: &mut Faults) -> Option<Located<Uuid>> {
    const HELP: &str = "every prototype has a uuid of its own: `uuidgen` prints a new one";
    let Some(value) = element.attribute("uuid") else {
        let fault = element.name.fault("a prototype without uuid", "expected uuid=\"…\" in this element");
        faults.push(fault.help(HELP));
        return None;
    };
    match Uuid::try_parse(&value.value) {
        Ok(uuid) => Some(Located::new(uuid, &value.place)),
        Err(_) => {
            let found = format!("{:?} is no uuid", value.value);
            let fault = value.fault(found, "expected 32 hexadecimal digits as 8-4-4-4-12");
            faults.push(fault.help(HELP));
            None
        }
    }
}

/// The required attribute `type` as a basic data type.
pub fn basic_type(element: &Element, faults: &mut Faults) -> Option<BasicType> {
    let value = element.required("type", faults)?;
    match value.value.parse() {
        Ok(ty) => Some(ty),
        Err(_) => {
            let names = BasicType::names();
            let found = format!("{:?} is no basic data type", value.value);
            let fault = value.fault(found, format!("expected {}", one_of(&names)));
            faults.push(fault.did_you_mean(nearest(&value.value, names.iter().map(String::as_str))));
            None
        }
    }
}

/// The attribute `name` as a bare number, if it is there.
pub fn bare_number(element: &Element, name: &str, faults: &mut Faults) -> Option<Located<f64>> {
    let value = element.attribute(name)?;
    match parse_number(&value.value, None, &[Quantity::One]) {
        Ok(number) => Some(Located::new(number, &value.place)),
        Err(error) => {
            faults.push(value.fault(error.found, error.expected));
            None
        }
    }
}

/// The attribute `tolerance`, relative and not negative, if it is there: `0.01` or `1%`.
pub fn tolerance(element: &Element, faults: &mut Faults) -> Option<f64> {
    let tolerance = bare_number(element, "tolerance", faults)?;
    if tolerance.value < 0.0 {
        faults.push(
            tolerance.fault("a negative tolerance", "expected 0 or more: how far the value may be off, relative"),
        );
        return None;
    }
    Some(tolerance.value)
}
