//! A text becomes the value of a device's parameter.

use super::ParameterValue;
use crate::prototype::basic::parse_boolean;
use crate::prototype::kind::{ParameterDescriptor, ParameterType};
use crate::prototype::quantity::{NumberError, parse_number, parse_numbers, si_unit};
use crate::value::{Quantity, Unit};
use crate::xml::{nearest, one_of};

/// Why a text is no value of a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Refused {
    pub found: String,
    pub expected: String,
    /// A word that was probably meant.
    pub near: Option<&'static str>,
}

impl From<NumberError> for Refused {
    fn from(error: NumberError) -> Refused {
        Refused { found: error.found, expected: error.expected, near: None }
    }
}

fn refused(found: String, expected: impl Into<String>) -> Refused {
    Refused { found, expected: expected.into(), near: None }
}

/// The quantities, of those that a kind declares, that hold for a linear or for a rotary device. A kind that can be either
/// lists them by turns: linear, rotary, linear, rotary.
pub(super) fn quantities_of(declared: &[Quantity], rotary: bool) -> Vec<Quantity> {
    match declared {
        [] | [_] => declared.to_vec(),
        _ => declared.iter().copied().skip(usize::from(rotary)).step_by(2).collect(),
    }
}

/// The value that `text` is for `parameter` of a `rotary` or linear device; bare numbers are in `unit`, or in SI.
pub(super) fn parse(
    parameter: &ParameterDescriptor,
    text: &str,
    unit: Option<Unit>,
    rotary: bool,
) -> Result<ParameterValue, Refused> {
    let quantities = quantities_of(parameter.quantities, rotary);
    let in_range = |number: f64, min: f64, max: f64| {
        if (min..=max).contains(&number) {
            return Ok(number);
        }
        let si = quantities.first().map_or(Unit::ONE, |quantity| si_unit(*quantity));
        let symbol = if si == Unit::ONE { String::new() } else { format!(" {si}") };
        let (found, expected) = (format!("{text:?} is out of range"), format!("expected {min} to {max}{symbol}"));
        Err(refused(found, expected))
    };
    match parameter.ty {
        ParameterType::Number { min, max } => {
            let number = parse_number(text, unit, &quantities)?;
            in_range(number, min, max).map(ParameterValue::Number)
        }
        ParameterType::Numbers { count, min, max } => {
            let numbers = parse_numbers(text, unit, &quantities)?;
            if count > 0 && numbers.len() != count {
                return Err(refused(format!("{text:?} holds {} numbers", numbers.len()), format!("expected {count}")));
            }
            let numbers: Result<Vec<f64>, Refused> = numbers.into_iter().map(|n| in_range(n, min, max)).collect();
            numbers.map(ParameterValue::Numbers)
        }
        ParameterType::Integer { min, max } => {
            let number: i64 = text
                .trim()
                .parse()
                .map_err(|_| refused(format!("{text:?} is no whole number"), format!("expected {min} to {max}")))?;
            match (min..=max).contains(&number) {
                true => Ok(ParameterValue::Integer(number)),
                false => Err(refused(format!("{text:?} is out of range"), format!("expected {min} to {max}"))),
            }
        }
        ParameterType::Boolean => parse_boolean(text)
            .map(ParameterValue::Boolean)
            .ok_or_else(|| refused(format!("{text:?} is no boolean"), "expected true, false, 1 or 0")),
        ParameterType::Choice(words) => match words.contains(&text.trim()) {
            true => Ok(ParameterValue::Text(text.trim().to_owned())),
            false => Err(Refused {
                found: format!("{text:?} is no {} known here", parameter.name),
                expected: format!("expected {}", one_of(words)),
                near: nearest(text, words.iter().copied()),
            }),
        },
        ParameterType::Text => Ok(ParameterValue::Text(text.to_owned())),
        ParameterType::Instance => Ok(ParameterValue::Text(text.trim().to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(ty: ParameterType, text: &str, expect: Result<ParameterValue, &str>) {
        let quantities: &[Quantity] = match ty {
            ParameterType::Number { .. } | ParameterType::Numbers { .. } => &[Quantity::Length, Quantity::Angle],
            _ => &[Quantity::One],
        };
        let parameter = ParameterDescriptor { name: "mode", ty, quantities, default: "", summary: "" };
        let read = parse(&parameter, text, None, false).map_err(|error| format!("{}: {}", error.found, error.expected));
        match (read, expect) {
            (Err(read), Err(expect)) => assert_eq!(read, expect, "{text}"),
            (read, expect) => assert_eq!(read, expect.map_err(str::to_owned), "{text}"),
        }
    }

    #[test]
    fn values_are_of_their_parameters_type_and_in_its_range() {
        let number = ParameterType::Number { min: 0.0, max: 2.0 };
        check(number, "500 mm", Ok(ParameterValue::Number(0.5)));
        check(number, "2", Ok(ParameterValue::Number(2.0)));
        check(number, "2500 mm", Err("\"2500 mm\" is out of range: expected 0 to 2 m"));
        check(number, "90 deg", Err("\"90 deg\" is in deg: expected a number in m or mm"));
        let numbers = ParameterType::Numbers { count: 3, min: 0.0, max: 2.0 };
        check(numbers, "1;2;0", Ok(ParameterValue::Numbers(vec![1.0, 2.0, 0.0])));
        check(numbers, "1;2", Err("\"1;2\" holds 2 numbers: expected 3"));
        check(ParameterType::Integer { min: 1, max: 9 }, "10", Err("\"10\" is out of range: expected 1 to 9"));
        check(ParameterType::Integer { min: 1, max: 9 }, "1.0", Err("\"1.0\" is no whole number: expected 1 to 9"));
        check(ParameterType::Boolean, "1", Ok(ParameterValue::Boolean(true)));
        check(ParameterType::Boolean, "yes", Err("\"yes\" is no boolean: expected true, false, 1 or 0"));
        let words = ParameterType::Choice(&["ideal", "position"]);
        check(words, "ideal", Ok(ParameterValue::Text("ideal".to_owned())));
        check(words, "Position", Err("\"Position\" is no mode known here: expected ideal or position"));
    }

    #[test]
    fn a_rotary_device_counts_in_rotary_units() {
        let four =
            [Quantity::LinearDamping, Quantity::AngularDamping, Quantity::LinearStiffness, Quantity::AngularStiffness];
        assert_eq!(quantities_of(&four, false), [Quantity::LinearDamping, Quantity::LinearStiffness]);
        assert_eq!(quantities_of(&four, true), [Quantity::AngularDamping, Quantity::AngularStiffness]);
        assert_eq!(quantities_of(&[Quantity::Time], true), [Quantity::Time]);
    }
}
