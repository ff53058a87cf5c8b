//! JSON → value, by the signal's type.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::TextForm;
use crate::value::{ElementaryType, STRING_CAPACITY, SignalType, Value};
use crate::wire::message::ResultCode;
use crate::wire::number::{NotInteger, integer};
use crate::wire::raw::{Raw, Shape, abbreviated};

/// Why a JSON value is none of a signal's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Unfit {
    /// 415 if the value is of another type, 422 if it is of the type and yet none of its values.
    pub result: ResultCode,
    /// What was expected and what was found.
    pub message: String,
}

impl Unfit {
    fn wrong_type(ty: SignalType, expected: &str, raw: Raw<'_>) -> Unfit {
        let message = format!("expected {ty}, {expected}, found {}", raw.described());
        Unfit { result: ResultCode::WRONG_TYPE, message }
    }

    fn wrong_value(message: String) -> Unfit {
        Unfit { result: ResultCode::WRONG_VALUE, message }
    }
}

/// Reads `raw` as a value of type `ty`.
pub fn read_value(raw: Raw<'_>, ty: SignalType, form: TextForm) -> Result<Value, Unfit> {
    let Some(length) = ty.length else { return read_scalar(raw, ty.element, form) };
    let Some(elements) = raw.elements() else {
        return Err(Unfit::wrong_type(ty, "an array", raw));
    };
    if elements.len() != usize::from(length) {
        let message = format!("expected {ty}, an array of {length} elements, found one of {}", elements.len());
        return Err(Unfit { result: ResultCode::WRONG_TYPE, message });
    }
    let mut values = Vec::with_capacity(elements.len());
    for (index, element) in elements.into_iter().enumerate() {
        let value = read_scalar(element, ty.element, form)
            .map_err(|unfit| Unfit { message: format!("element {index}: {}", unfit.message), ..unfit })?;
        values.push(value);
    }
    Ok(Value::Array(values.into()))
}

fn read_scalar(raw: Raw<'_>, element: ElementaryType, form: TextForm) -> Result<Value, Unfit> {
    let ty = SignalType::scalar(element);
    match element {
        ElementaryType::Bool => {
            raw.as_bool().map(Value::Bool).ok_or_else(|| Unfit::wrong_type(ty, "true or false", raw))
        }
        ElementaryType::Real | ElementaryType::Lreal => read_real(raw, element),
        ElementaryType::Time => read_time(raw),
        ElementaryType::String => read_string(raw, form),
        ElementaryType::Wstring => read_wstring(raw, form),
        _ => read_integer(raw, element),
    }
}

fn read_integer(raw: Raw<'_>, element: ElementaryType) -> Result<Value, Unfit> {
    let ty = SignalType::scalar(element);
    let text = raw.as_number().ok_or_else(|| Unfit::wrong_type(ty, "a whole number", raw))?;
    let outside = || {
        let (low, high) = element.integer_range().unwrap_or((0, 0));
        Unfit::wrong_value(format!("{} is outside {ty}, {low} to {high}", abbreviated(text)))
    };
    let number = integer(text, 0).map_err(|error| match error {
        NotInteger::Fraction { .. } => {
            Unfit::wrong_value(format!("expected {ty}, a whole number, found {}", abbreviated(text)))
        }
        NotInteger::TooLarge => outside(),
    })?;
    integer_value(element, number).ok_or_else(outside)
}

/// The value of integer type `element` that is `number`; `None` if it is outside the type.
fn integer_value(element: ElementaryType, number: i128) -> Option<Value> {
    Some(match element {
        ElementaryType::Sint => Value::Sint(number.try_into().ok()?),
        ElementaryType::Int => Value::Int(number.try_into().ok()?),
        ElementaryType::Dint => Value::Dint(number.try_into().ok()?),
        ElementaryType::Lint => Value::Lint(number.try_into().ok()?),
        ElementaryType::Usint => Value::Usint(number.try_into().ok()?),
        ElementaryType::Uint => Value::Uint(number.try_into().ok()?),
        ElementaryType::Udint => Value::Udint(number.try_into().ok()?),
        ElementaryType::Ulint => Value::Ulint(number.try_into().ok()?),
        ElementaryType::Byte => Value::Byte(number.try_into().ok()?),
        ElementaryType::Word => Value::Word(number.try_into().ok()?),
        ElementaryType::Dword => Value::Dword(number.try_into().ok()?),
        ElementaryType::Lword => Value::Lword(number.try_into().ok()?),
        _ => return None,
    })
}

fn read_real(raw: Raw<'_>, element: ElementaryType) -> Result<Value, Unfit> {
    let ty = SignalType::scalar(element);
    let text = raw.as_number().ok_or_else(|| Unfit::wrong_type(ty, "a number", raw))?;
    // Read in the width of the type, so that it is rounded once. Adding 0.0 turns -0.0 into 0.0: the two are equal, and
    // must be one in a hash.
    let value = match element {
        ElementaryType::Real => text.parse().ok().filter(|n: &f32| n.is_finite()).map(|n| Value::Real(n + 0.0)),
        _ => text.parse().ok().filter(|n: &f64| n.is_finite()).map(|n| Value::Lreal(n + 0.0)),
    };
    value.ok_or_else(|| {
        let greatest = if element == ElementaryType::Real { f64::from(f32::MAX) } else { f64::MAX };
        Unfit::wrong_value(format!("{} is outside {ty}, at most {greatest:e} either way", abbreviated(text)))
    })
}

fn read_time(raw: Raw<'_>) -> Result<Value, Unfit> {
    let ty = SignalType::scalar(ElementaryType::Time);
    let text = raw.as_number().ok_or_else(|| Unfit::wrong_type(ty, "a number of milliseconds", raw))?;
    let ns = match integer(text, 6) {
        Ok(ns) | Err(NotInteger::Fraction { nearest: ns }) => i64::try_from(ns).ok(),
        Err(NotInteger::TooLarge) => None,
    };
    ns.map(Value::Time).ok_or_else(|| {
        Unfit::wrong_value(format!(
            "{} ms is outside TIME, at most {} ms either way",
            abbreviated(text),
            i64::MAX / 1_000_000
        ))
    })
}

fn read_string(raw: Raw<'_>, form: TextForm) -> Result<Value, Unfit> {
    let ty = SignalType::scalar(ElementaryType::String);
    let bytes = match form {
        TextForm::Base64 => read_base64(raw, ty)?,
        TextForm::Plain => {
            let units = raw.as_utf16().ok_or_else(|| Unfit::wrong_type(ty, "a string", raw))?;
            let bytes: Option<Vec<u8>> = units.map(|unit| u8::try_from(unit).ok()).collect();
            bytes.ok_or_else(|| {
                Unfit::wrong_value(format!("{} holds a character beyond the 256 of STRING", abbreviated(raw.text())))
            })?
        }
    };
    within_capacity(bytes.len(), ty, "characters")?;
    Ok(Value::String(bytes.into()))
}

fn read_wstring(raw: Raw<'_>, form: TextForm) -> Result<Value, Unfit> {
    let ty = SignalType::scalar(ElementaryType::Wstring);
    let units: Vec<u16> = match form {
        TextForm::Base64 => {
            let bytes = read_base64(raw, ty)?;
            if bytes.len() % 2 != 0 {
                let message = format!("expected WSTRING, pairs of bytes as base64, found {} bytes", bytes.len());
                return Err(Unfit::wrong_value(message));
            }
            bytes.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect()
        }
        TextForm::Plain => raw.as_utf16().ok_or_else(|| Unfit::wrong_type(ty, "a string", raw))?.collect(),
    };
    within_capacity(units.len(), ty, "code units")?;
    Ok(Value::Wstring(units.into()))
}

fn read_base64(raw: Raw<'_>, ty: SignalType) -> Result<Vec<u8>, Unfit> {
    if raw.shape() != Shape::String {
        return Err(Unfit::wrong_type(ty, "a base64 string", raw));
    }
    let decoded = raw.as_str().and_then(|text| STANDARD.decode(text.as_bytes()).ok());
    decoded.ok_or_else(|| Unfit::wrong_value(format!("expected {ty}, as base64, found {}", abbreviated(raw.text()))))
}

fn within_capacity(length: usize, ty: SignalType, of: &str) -> Result<(), Unfit> {
    if length > STRING_CAPACITY {
        return Err(Unfit::wrong_value(format!("expected {ty}, at most {STRING_CAPACITY} {of}, found {length}")));
    }
    Ok(())
}
