//! The basic data types of the reference's section 3.4.6 (Table 2), with `integer`, `integer[]` and `vector3`, which its
//! example of section 6.3.1 uses beside them.

use std::fmt;
use std::str::FromStr;

use super::kind::ParameterType;

/// What a property or a parameter is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BasicElement {
    Float,
    Double,
    String,
    Uri,
    Boolean,
    Integer,
    /// Three numbers, separated by blanks.
    Vector3,
}

impl BasicElement {
    const ALL: [(BasicElement, &'static str); 7] = [
        (BasicElement::Float, "float"),
        (BasicElement::Double, "double"),
        (BasicElement::String, "string"),
        (BasicElement::Uri, "URI"),
        (BasicElement::Boolean, "boolean"),
        (BasicElement::Integer, "integer"),
        (BasicElement::Vector3, "vector3"),
    ];

    fn name(self) -> &'static str {
        BasicElement::ALL.iter().find(|(element, _)| *element == self).map_or("", |(_, name)| name)
    }

    fn has_array(self) -> bool {
        !matches!(self, BasicElement::Uri | BasicElement::Vector3)
    }
}

/// A basic data type: `double`, `double[]`, `vector3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BasicType {
    pub element: BasicElement,
    /// Several of them, separated by `;`.
    pub array: bool,
}

impl BasicType {
    /// All of them, as they are written.
    pub fn names() -> Vec<String> {
        let one = BasicElement::ALL.iter().map(|(_, name)| (*name).to_owned());
        let arrays = BasicElement::ALL.iter().filter(|(element, _)| element.has_array());
        one.chain(arrays.map(|(_, name)| format!("{name}[]"))).collect()
    }

    /// Whether a value of this type can be one of what a device's parameter takes.
    pub fn fits(self, parameter: &ParameterType) -> bool {
        use BasicElement::{Boolean, Double, Float, Integer, String, Uri, Vector3};
        match parameter {
            ParameterType::Number { .. } => !self.array && matches!(self.element, Float | Double | Integer),
            ParameterType::Integer { .. } => !self.array && self.element == Integer,
            ParameterType::Boolean => !self.array && self.element == Boolean,
            ParameterType::Choice(_) | ParameterType::Instance => !self.array && self.element == String,
            ParameterType::Text => !self.array && matches!(self.element, String | Uri),
            ParameterType::Numbers { .. } => {
                self.element == Vector3 || self.array && matches!(self.element, Float | Double | Integer)
            }
        }
    }

    /// Whether its values are numbers, which may have a unit.
    pub fn is_numeric(self) -> bool {
        use BasicElement::{Double, Float, Integer, Vector3};
        matches!(self.element, Float | Double | Integer | Vector3)
    }
}

impl fmt::Display for BasicType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.element.name(), if self.array { "[]" } else { "" })
    }
}

/// A text that names no basic data type.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found:?} is no basic data type: expected {}", crate::xml::one_of(BasicType::names()))]
pub struct ParseBasicTypeError {
    found: String,
}

impl FromStr for BasicType {
    type Err = ParseBasicTypeError;

    fn from_str(text: &str) -> Result<Self, ParseBasicTypeError> {
        let (name, array) = match text.strip_suffix("[]") {
            Some(name) => (name, true),
            None => (text, false),
        };
        let element = BasicElement::ALL.iter().find(|(_, known)| *known == name).map(|(element, _)| *element);
        match element {
            Some(element) if !array || element.has_array() => Ok(BasicType { element, array }),
            _ => Err(ParseBasicTypeError { found: text.to_owned() }),
        }
    }
}

/// A boolean of Table 2: `true`, `false`, `1`, `0`.
pub fn parse_boolean(text: &str) -> Option<bool> {
    match text.trim() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_reads_back_as_it_is_written() {
        for name in BasicType::names() {
            assert_eq!(name.parse::<BasicType>().map(|ty| ty.to_string()), Ok(name));
        }
        for text in ["", "Double", "URI[]", "vector3[]", "double[", "int"] {
            let error = text.parse::<BasicType>().expect_err(text).to_string();
            assert!(error.contains("vector3") && error.contains("integer[]"), "{error}");
        }
    }

    #[test]
    fn a_type_fits_the_parameters_that_it_can_fill() {
        let check = |ty: &str, parameter: ParameterType, expect: bool| {
            assert_eq!(ty.parse::<BasicType>().expect(ty).fits(&parameter), expect, "{ty} {parameter:?}");
        };
        let number = ParameterType::Number { min: 0.0, max: 1.0 };
        let numbers = ParameterType::Numbers { count: 3, min: 0.0, max: 1.0 };
        check("double", number, true);
        check("integer", number, true);
        check("double[]", number, false);
        check("string", number, false);
        check("vector3", numbers, true);
        check("float[]", numbers, true);
        check("double", numbers, false);
        check("double", ParameterType::Integer { min: 0, max: 1 }, false);
        check("string", ParameterType::Choice(&["a"]), true);
        check("URI", ParameterType::Instance, false);
    }
}
