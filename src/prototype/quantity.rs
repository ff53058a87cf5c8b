//! Numbers as people write them, with or without their unit, become SI.

use crate::value::{Quantity, Unit};
use crate::xml::one_of;

/// A text that is no number of the quantity asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found}: {expected}")]
pub struct NumberError {
    /// What is there.
    pub found: String,
    /// What should be.
    pub expected: String,
}

/// The unit that the engine computes a quantity in.
pub fn si_unit(quantity: Quantity) -> Unit {
    Unit::ALL.iter().find(|unit| unit.quantity == quantity).copied().unwrap_or(Unit::ONE)
}

/// The symbols of all units that one of `quantities` may be written in, the SI unit of each first.
pub fn symbols(quantities: &[Quantity]) -> Vec<&'static str> {
    Unit::ALL.iter().filter(|unit| quantities.contains(&unit.quantity)).map(|unit| unit.symbol).collect()
}

/// `number`, which is in `unit`, in SI.
///
/// Where a unit is a whole part of the SI unit it is divided by, so that 700 mm is 0.7 m and not the double after it.
pub fn to_si(number: f64, unit: Unit) -> f64 {
    let parts = 1.0 / unit.to_si;
    if unit.to_si < 1.0 && parts.fract() == 0.0 { number / parts } else { number * unit.to_si }
}

/// `number`, which is in SI, in `unit`.
pub fn from_si(number: f64, unit: Unit) -> f64 {
    let parts = 1.0 / unit.to_si;
    if unit.to_si < 1.0 && parts.fract() == 0.0 { number * parts } else { number / unit.to_si }
}

/// Reads one number of one of `quantities`: `500`, `500 mm`, `90deg`. A bare number is in `declared`, or in SI where
/// nothing is declared.
pub fn parse_number(text: &str, declared: Option<Unit>, quantities: &[Quantity]) -> Result<f64, NumberError> {
    match parse_numbers(text, declared, quantities)?.as_slice() {
        [number] => Ok(*number),
        _ => Err(NumberError { found: format!("{text:?} holds several numbers"), expected: "expected one".to_owned() }),
    }
}

/// Reads numbers separated by `;` or blanks: `300;1700`, `0 0 0`, `300;1700 mm`, `0.3 m;1700 mm`.
///
/// A unit may follow each number, or stand once at the end for all. Bare numbers are in `declared`, or in SI.
pub fn parse_numbers(text: &str, declared: Option<Unit>, quantities: &[Quantity]) -> Result<Vec<f64>, NumberError> {
    let written = tokens(text, quantities)?;
    let si = quantities.first().map_or(Unit::ONE, |quantity| si_unit(*quantity));
    let default = declared.unwrap_or(si);
    let with_unit = written.iter().filter(|(_, unit)| unit.is_some()).count();
    let (count, last) = (written.len(), written.last().and_then(|(_, unit)| *unit));
    let all = match (with_unit, last) {
        (0, _) => default,
        (1, Some(unit)) => unit,
        (units, _) if units == count => default,
        _ => {
            return Err(NumberError {
                found: format!("{text:?} has a unit at some of its numbers"),
                expected: "expected one at each, or one at the end for all".to_owned(),
            });
        }
    };
    for unit in written.iter().filter_map(|(_, unit)| *unit).chain([default]) {
        if !quantities.contains(&unit.quantity) {
            return Err(NumberError {
                found: format!("{text:?} is in {unit}"),
                expected: format!("expected a number in {}", one_of(symbols(quantities))),
            });
        }
    }
    Ok(written.into_iter().map(|(number, unit)| to_si(number, unit.unwrap_or(all))).collect())
}

/// `text`, with `unit` behind it where it is a number without one: so that a value keeps its meaning when it is handed on
/// to where another unit is declared.
pub fn with_unit(text: &str, unit: Option<Unit>) -> String {
    match unit {
        Some(unit) if text.trim().ends_with(|c: char| c.is_ascii_digit() || c == '.') => format!("{text} {unit}"),
        _ => text.to_owned(),
    }
}

/// The unit that stands behind the first number of a text.
pub fn unit_in(text: &str) -> Option<Unit> {
    tokens(text, &[]).ok()?.first()?.1
}

/// The numbers of a text, each with the unit that follows it.
fn tokens(text: &str, quantities: &[Quantity]) -> Result<Vec<(f64, Option<Unit>)>, NumberError> {
    let mut numbers: Vec<(f64, Option<Unit>)> = Vec::new();
    for token in text.split(|c: char| c == ';' || c.is_whitespace()).filter(|token| !token.is_empty()) {
        if let Some(number) = finite(token) {
            numbers.push((number, None));
            continue;
        }
        match (numbers.last_mut(), Unit::named(token)) {
            (Some((_, unit @ None)), Some(named)) => *unit = Some(named),
            (Some((_, None)), None) if token.starts_with(char::is_alphabetic) => {
                return Err(no_unit(text, token, quantities));
            }
            _ => numbers.push(glued(token).ok_or_else(|| no_number(text, token, quantities))?),
        }
    }
    match numbers.is_empty() {
        true => Err(no_number(text, "", quantities)),
        false => Ok(numbers),
    }
}

/// A number with its unit behind it and nothing between: `90deg`.
fn glued(token: &str) -> Option<(f64, Option<Unit>)> {
    (1..token.len()).rev().filter(|end| token.is_char_boundary(*end)).find_map(|end| {
        let (number, unit) = token.split_at(end);
        Some((finite(number)?, Some(Unit::named(unit)?)))
    })
}

/// Rust reads `inf` and `nan` as numbers; no model means them.
fn finite(token: &str) -> Option<f64> {
    token.parse().ok().filter(|number: &f64| number.is_finite())
}

fn no_unit(text: &str, token: &str, quantities: &[Quantity]) -> NumberError {
    let expected = match quantities {
        [] | [Quantity::One] => "expected a number without a unit, or in %".to_owned(),
        _ => format!("expected a number bare or in {}", one_of(symbols(quantities))),
    };
    NumberError { found: format!("{token:?} in {text:?} is no unit known here"), expected }
}

fn no_number(text: &str, token: &str, quantities: &[Quantity]) -> NumberError {
    let found = match token {
        "" => "there is no number".to_owned(),
        _ if token == text => format!("{text:?} is no number"),
        _ => format!("{token:?} in {text:?} is no number"),
    };
    let unit = match quantities {
        [] | [Quantity::One] => String::new(),
        _ => format!(", bare or in {}", one_of(symbols(quantities))),
    };
    NumberError { found, expected: format!("expected a finite number with a decimal point{unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Quantity::{Angle, Length, One, Rate};

    #[track_caller]
    fn check(text: &str, declared: Option<&str>, quantity: Quantity, expect: &[f64]) {
        let declared = declared.map(|symbol| Unit::named(symbol).expect(symbol));
        assert_eq!(parse_numbers(text, declared, &[quantity]).as_deref(), Ok(expect), "{text}");
    }

    #[track_caller]
    fn refused(text: &str, declared: Option<&str>, quantity: Quantity, expect: &str) {
        let declared = declared.map(|symbol| Unit::named(symbol).expect(symbol));
        let error = parse_numbers(text, declared, &[quantity]).expect_err(text).to_string();
        assert!(error.contains(expect), "{text}: {error}");
    }

    #[test]
    fn a_number_is_in_its_own_unit_else_in_the_declared_one_else_in_si() {
        check("500 mm", None, Length, &[0.5]);
        check("500mm", Some("m"), Length, &[0.5]);
        check("500", Some("mm"), Length, &[0.5]);
        check("0.5", None, Length, &[0.5]);
        check(" 90deg ", None, Angle, &[std::f64::consts::FRAC_PI_2]);
        check("12.78E-2", None, One, &[0.1278]);
        check("5 1/s", None, Rate, &[5.0]);
        check("1 %", None, One, &[0.01]);
    }

    #[test]
    fn millimetres_give_the_double_that_the_same_metres_give() {
        for mm in 0..5000 {
            let metres: f64 = format!("{}.{:03}", mm / 1000, mm % 1000).parse().expect("a number");
            check(&format!("{mm} mm"), None, Length, &[metres]);
            assert_eq!(from_si(metres, Unit::named("mm").expect("mm")).round(), f64::from(mm));
        }
    }

    #[test]
    fn lists_take_a_unit_at_each_number_or_one_for_all() {
        check("0 0 0", None, Length, &[0.0, 0.0, 0.0]);
        check("300;1700", Some("mm"), Length, &[0.3, 1.7]);
        check("300; 1700 mm", None, Length, &[0.3, 1.7]);
        check("0.3 m;1700mm", None, Length, &[0.3, 1.7]);
        refused("300 mm;1700", None, Length, "a unit at some of its numbers");
        refused("1;2 m;3 mm", None, Length, "a unit at some of its numbers");
    }

    #[test]
    fn what_is_no_number_of_the_quantity_is_refused() {
        refused("", None, One, "there is no number");
        refused(
            "0,5",
            None,
            Length,
            "\"0,5\" is no number: expected a finite number with a decimal point, bare or in m or mm",
        );
        refused("inf", None, One, "no number");
        refused("NaN", None, One, "no number");
        refused(
            "5 furlong",
            None,
            Length,
            "\"furlong\" in \"5 furlong\" is no unit known here: expected a number bare or in m or mm",
        );
        refused("5 parts", None, One, "is no unit known here: expected a number without a unit, or in %");
        refused("5 kg", None, Length, "is in kg: expected a number in m or mm");
        refused("mm", None, Length, "no number");
    }

    #[test]
    fn a_number_handed_on_takes_its_unit_along() {
        let mm = Unit::named("mm");
        assert_eq!(with_unit("500", mm), "500 mm");
        assert_eq!(with_unit("500 m", mm), "500 m");
        assert_eq!(with_unit("1;2", mm), "1;2 mm");
        assert_eq!(with_unit("Belt", mm), "Belt");
        assert_eq!(with_unit("500", None), "500");
    }
}
