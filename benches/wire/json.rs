//! The same message as a JSON crate reads and writes it: names borrowed from the text, values by their JSON type.

use std::fmt;

use kinetwin::signal_map::{RegisterId, SignalMap};
use kinetwin::value::Value;
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
pub struct Message<'a> {
    #[serde(rename = "SendValue", borrow)]
    values: Vec<Entry<'a>>,
}

#[derive(Serialize, Deserialize)]
struct Entry<'a> {
    name: &'a str,
    value: Scalar,
}

/// The types of our values: REAL, BOOL, DINT.
enum Scalar {
    Real(f32),
    Bool(bool),
    Dint(i32),
}

impl<'a> Message<'a> {
    /// `values` under the names that `map` has for them.
    pub fn of(map: &'a SignalMap, values: &[(RegisterId, Value)]) -> Message<'a> {
        let entry = |(register, value): &(RegisterId, Value)| {
            let value = match value {
                Value::Real(value) => Scalar::Real(*value),
                Value::Bool(value) => Scalar::Bool(*value),
                Value::Dint(value) => Scalar::Dint(*value),
                other => unreachable!("{other} is of no type that the message has"),
            };
            Entry { name: &map.signal(*register).name, value }
        };
        Message { values: values.iter().map(entry).collect() }
    }
}

impl Serialize for Scalar {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Scalar::Real(value) => serializer.serialize_f32(*value),
            Scalar::Bool(value) => serializer.serialize_bool(*value),
            Scalar::Dint(value) => serializer.serialize_i32(*value),
        }
    }
}

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Scalar, D::Error> {
        struct Any;
        impl Visitor<'_> for Any {
            type Value = Scalar;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a truth value")
            }

            fn visit_bool<E: Error>(self, value: bool) -> Result<Scalar, E> {
                Ok(Scalar::Bool(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Scalar, E> {
                i32::try_from(value).map(Scalar::Dint).map_err(E::custom)
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<Scalar, E> {
                i32::try_from(value).map(Scalar::Dint).map_err(E::custom)
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Scalar, E> {
                Ok(Scalar::Real(value as f32))
            }
        }
        deserializer.deserialize_any(Any)
    }
}
