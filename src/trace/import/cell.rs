//! The text of a cell becomes the JSON text of a signal's value.

use crate::value::{ElementaryType, SignalType};
use crate::wire::{Raw, TextForm, read_value, write_value};

use super::mapping::Transform;

/// What is wrong with a cell: what it is, and what was expected.
pub(super) type Wrong = String;

/// The value of a cell that holds something, as JSON.
///
/// A number that is not computed with keeps its digits. Decimal commas are read where no point stands beside them.
pub(super) fn value(cell: &str, transform: &Transform, ty: Option<SignalType>) -> Result<String, Wrong> {
    let text = plain(cell, transform, ty)?;
    if let Some(ty) = ty {
        let raw = Raw::new(&text).map_err(|_| format!("{cell:?}: expected a value of type {ty}"))?;
        read_value(raw, ty, TextForm::Base64).map_err(|unfit| format!("{cell:?}: {unfit}"))?;
    }
    Ok(text)
}

fn plain(cell: &str, transform: &Transform, ty: Option<SignalType>) -> Result<String, Wrong> {
    let is = |element: ElementaryType| ty.is_some_and(|ty| ty == SignalType::scalar(element));
    if let Some(bit) = transform.bit {
        let word = whole(cell).ok_or_else(|| format!("{cell:?} has no bits: expected a whole number from 0"))?;
        return Ok((((word >> bit) & 1 == 1) != transform.invert).to_string());
    }
    if transform.invert || is(ElementaryType::Bool) {
        let truth = truth(cell).ok_or_else(|| format!("{cell:?} is neither true nor false: expected 1 or 0"))?;
        return Ok((truth != transform.invert).to_string());
    }
    if is(ElementaryType::String) || is(ElementaryType::Wstring) {
        let is_json = Raw::new(cell).is_ok_and(|raw| raw.as_str().is_some());
        return if is_json { Ok(cell.to_owned()) } else { encoded(cell, ty) };
    }
    if cell.starts_with(['[', '"']) && Raw::new(cell).is_ok() {
        return Ok(cell.to_owned());
    }
    if ty.is_none() && matches!(cell.to_ascii_lowercase().as_str(), "true" | "false") {
        return Ok(cell.to_ascii_lowercase());
    }
    let digits = decimal(cell).ok_or_else(|| no_number(cell))?;
    let is_whole = ty.is_some_and(|ty| ty.element.integer_range().is_some());
    if !transform.is_arithmetic() {
        // Loggers write counts as 12.0, too.
        return Ok(if is_whole { without_zeros(digits) } else { digits });
    }
    let number: f64 = digits.parse().map_err(|_| no_number(cell))?;
    let number = number * transform.scale + transform.shift;
    if !number.is_finite() {
        return Err(format!("{cell:?} is too large a number"));
    }
    Ok(if is_whole { format!("{:.0}", number.round()) } else { serde_json::json!(number).to_string() })
}

/// A text as a message has it.
fn encoded(cell: &str, ty: Option<SignalType>) -> Result<String, Wrong> {
    let quoted = serde_json::json!(cell).to_string();
    let unfit = |why: String| format!("{cell:?}: {why}");
    let raw = Raw::new(&quoted).map_err(|_| unfit("no text".to_owned()))?;
    let ty = ty.unwrap_or(SignalType::scalar(ElementaryType::String));
    let value = read_value(raw, ty, TextForm::Plain).map_err(|error| unfit(error.to_string()))?;
    let mut text = String::new();
    write_value(&mut text, &value, TextForm::Base64).map_err(|error| unfit(error.to_string()))?;
    Ok(text)
}

fn no_number(cell: &str) -> Wrong {
    let is_nan = matches!(cell.to_ascii_lowercase().as_str(), "nan" | "inf" | "-inf" | "+inf" | "infinity");
    if is_nan {
        return format!("{cell:?} cannot stand in a trace: leave the cell empty, or say --missing {cell}");
    }
    let thousands = cell.contains(',') && cell.contains('.');
    let why = if thousands { " without separators of thousands" } else { "" };
    format!("{cell:?} is no number: expected one{why}, or nothing where there is no value (or --missing {cell:?})")
}

/// A number's digits as JSON has them: a point, no plus sign, digits on both sides of the point, no zeros before others.
pub(super) fn decimal(cell: &str) -> Option<String> {
    let text = match cell.split_once(',') {
        Some((whole, part)) if !part.contains(',') && !cell.contains('.') => format!("{whole}.{part}"),
        _ => cell.to_owned(),
    };
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", text.strip_prefix('+').unwrap_or(&text)),
    };
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (text, None),
    };
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let are_digits = |digits: &str| digits.bytes().all(|b| b.is_ascii_digit());
    let exponent_fits = exponent.is_none_or(|e| {
        let digits = e.strip_prefix(['+', '-']).unwrap_or(e);
        !digits.is_empty() && are_digits(digits)
    });
    if !are_digits(whole) || !are_digits(part) || whole.len() + part.len() == 0 || !exponent_fits {
        return None;
    }
    let whole = whole.trim_start_matches('0');
    let mut out = format!("{sign}{}", if whole.is_empty() { "0" } else { whole });
    if !part.is_empty() {
        out.push('.');
        out.push_str(part);
    }
    if let Some(exponent) = exponent {
        out.push('e');
        out.push_str(exponent);
    }
    Some(out)
}

fn without_zeros(digits: String) -> String {
    match digits.split_once('.') {
        Some((whole, part)) if part.bytes().all(|b| b == b'0') => whole.to_owned(),
        _ => digits,
    }
}

/// A whole number from 0: `12`, `12.0`, `0x1F`, `16#1F`.
fn whole(cell: &str) -> Option<u64> {
    let hexadecimal = ["0x", "0X", "16#"].iter().find_map(|prefix| cell.strip_prefix(prefix));
    match hexadecimal {
        Some(digits) => u64::from_str_radix(digits, 16).ok(),
        None => without_zeros(decimal(cell)?).parse().ok(),
    }
}

fn truth(cell: &str) -> Option<bool> {
    match cell.to_ascii_lowercase().as_str() {
        "true" | "on" | "yes" => Some(true),
        "false" | "off" | "no" => Some(false),
        number => match decimal(number)?.parse::<f64>().ok()? {
            0.0 => Some(false),
            1.0 => Some(true),
            _ => None,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: Transform = Transform::NONE;

    fn check(cell: &str, transform: Transform, ty: Option<&str>, expected: Result<&str, &str>) {
        let found = value(cell, &transform, ty.map(|ty| ty.parse().expect("a type")));
        match (found, expected) {
            (Ok(found), Ok(expected)) => assert_eq!(found, expected, "{cell}"),
            (Err(found), Err(part)) => assert!(found.contains(part), "{cell}: {found}"),
            (found, _) => panic!("{cell}: {found:?}, expected {expected:?}"),
        }
    }

    #[test]
    fn numbers_keep_their_digits() {
        check("0.100", NONE, None, Ok("0.100"));
        check("-2.4175077629353806e-11", NONE, Some("REAL"), Ok("-2.4175077629353806e-11"));
        check("+.5", NONE, None, Ok("0.5"));
        check("007", NONE, None, Ok("7"));
        check("5.", NONE, None, Ok("5"));
        check("-1,25", NONE, None, Ok("-1.25"));
        check("12.0", NONE, Some("DINT"), Ok("12"));
        check("1E+3", NONE, None, Ok("1e+3"));
    }

    #[test]
    fn numbers_are_scaled_and_shifted() {
        let millimetres = Transform { scale: 0.001, shift: 0.5, ..NONE };
        check("250", millimetres, None, Ok("0.75"));
        check("1,5", Transform { scale: 2.0, ..NONE }, None, Ok("3.0"));
        check("10.4", Transform { scale: 10.0, ..NONE }, Some("INT"), Ok("104"));
        check("1e308", Transform { scale: 10.0, ..NONE }, None, Err("too large"));
    }

    #[test]
    fn booleans_bits_and_texts() {
        let invert = Transform { invert: true, ..NONE };
        let bit = |bit| Transform { bit: Some(bit), ..NONE };
        check("1", NONE, Some("BOOL"), Ok("true"));
        check("0.0", NONE, Some("BOOL"), Ok("false"));
        check("TRUE", NONE, None, Ok("true"));
        check("off", invert, None, Ok("true"));
        check("2", NONE, Some("BOOL"), Err("neither true nor false"));
        check("5", bit(0), None, Ok("true"));
        check("5", bit(1), None, Ok("false"));
        check("16#10", bit(4), None, Ok("true"));
        check("0x10", Transform { bit: Some(4), ..invert }, None, Ok("false"));
        check("-1", bit(0), None, Err("has no bits"));
        check("idle", NONE, Some("STRING"), Ok("\"aWRsZQ==\""));
        check("\"aWRsZQ==\"", NONE, Some("STRING"), Ok("\"aWRsZQ==\""));
        check("[1,2]", NONE, Some("REAL[2]"), Ok("[1,2]"));
    }

    #[test]
    fn what_is_no_value_says_what_to_do() {
        check("nan", NONE, None, Err("--missing nan"));
        check("inf", NONE, Some("REAL"), Err("cannot stand in a trace"));
        check("1.234,5", NONE, None, Err("without separators of thousands"));
        check("broken", NONE, None, Err("is no number"));
        check("1e", NONE, None, Err("is no number"));
        check("40000", NONE, Some("INT"), Err("40000"));
        check("0.5", NONE, Some("INT"), Err("0.5"));
        check("[1]", NONE, Some("REAL[2]"), Err("[1]"));
    }
}
