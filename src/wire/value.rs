//! Values as JSON, by their type.
//!
//! | type | JSON |
//! | --- | --- |
//! | BOOL | `true`, `false` |
//! | SINT to ULINT, BYTE to LWORD | a number without a fraction; `1.0` and `1e2` are such |
//! | REAL, LREAL | a number; written with the fewest digits that read back as the same value |
//! | TIME | a number of milliseconds, down to nanoseconds: `1.5`, `0.000001` |
//! | STRING | by [`TextForm`] |
//! | WSTRING | by [`TextForm`] |
//! | array | an array of as many elements as declared |

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::message::ResultCode;
use super::number::{NotInteger, integer};
use super::scan::{Raw, Shape, abbreviated};
use crate::value::{ElementaryType, STRING_CAPACITY, SignalType, Value};

/// How texts stand in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextForm {
    /// As the CPS-Protocol has them: a STRING is the base64 (RFC 4648, padded) of its bytes, a WSTRING that of its UTF-16
    /// code units, low byte first. The latter is ours, the source shows a STRING alone.
    Base64,
    /// As the IO data model has them ("a string corresponding to the IEC 61499 STRING type"): a JSON string. Each byte of
    /// a STRING is the character of that number (ISO/IEC 10646, row 00, as IEC 61131-3 has it).
    Plain,
}

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

/// NaN and the infinities have no JSON form.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{number} has no JSON form")]
pub struct NotFinite {
    pub number: f64,
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

/// Appends `value` to `out`. Where it has no JSON form, `out` is left as it was.
pub fn write_value(out: &mut String, value: &Value, form: TextForm) -> Result<(), NotFinite> {
    match value {
        Value::Bool(v) => out.push_str(if *v { "true" } else { "false" }),
        Value::Sint(v) => write_number(out, v),
        Value::Int(v) => write_number(out, v),
        Value::Dint(v) => write_number(out, v),
        Value::Lint(v) => write_number(out, v),
        Value::Usint(v) | Value::Byte(v) => write_number(out, v),
        Value::Uint(v) | Value::Word(v) => write_number(out, v),
        Value::Udint(v) | Value::Dword(v) => write_number(out, v),
        Value::Ulint(v) | Value::Lword(v) => write_number(out, v),
        Value::Real(v) if v.is_finite() => write_number(out, &(v + 0.0)),
        Value::Lreal(v) if v.is_finite() => write_number(out, &(v + 0.0)),
        Value::Real(v) => return Err(NotFinite { number: f64::from(*v) }),
        Value::Lreal(v) => return Err(NotFinite { number: *v }),
        Value::Time(ns) => write_milliseconds(out, *ns),
        Value::String(bytes) => match form {
            TextForm::Base64 => write_base64(out, bytes),
            TextForm::Plain => write_string(out, &bytes.iter().map(|&b| char::from(b)).collect::<String>()),
        },
        Value::Wstring(units) => match form {
            TextForm::Base64 => {
                let bytes: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
                write_base64(out, &bytes);
            }
            TextForm::Plain => write_utf16(out, units),
        },
        Value::Array(values) => {
            let start = out.len();
            out.push('[');
            for (index, value) in values.iter().enumerate() {
                if index > 0 {
                    out.push(',');
                }
                if let Err(error) = write_value(out, value, form) {
                    out.truncate(start);
                    return Err(error);
                }
            }
            out.push(']');
        }
    }
    Ok(())
}

/// Appends a number in the fewest digits that read back as the same one.
fn write_number(out: &mut String, number: &impl serde::Serialize) {
    // The longest: a sign, 17 digits, a point and an exponent of an LREAL, or the 20 digits of a LINT.
    let mut digits = [0; 40];
    let mut rest = &mut digits[..];
    serde_json::to_writer(&mut rest, number).expect("a finite number of at most 40 characters");
    let length = 40 - rest.len();
    out.push_str(std::str::from_utf8(&digits[..length]).expect("digits are ASCII"));
}

/// Appends nanoseconds as a number of milliseconds, to the last digit.
fn write_milliseconds(out: &mut String, ns: i64) {
    if ns < 0 {
        out.push('-');
    }
    let ns = ns.unsigned_abs();
    write_number(out, &(ns / 1_000_000));
    let fraction = ns % 1_000_000;
    if fraction > 0 {
        let digits = format!(".{fraction:06}");
        out.push_str(digits.trim_end_matches('0'));
    }
}

fn write_base64(out: &mut String, bytes: &[u8]) {
    out.push('"');
    STANDARD.encode_string(bytes, out);
    out.push('"');
}

/// Appends `text` as a JSON string.
pub(super) fn write_string(out: &mut String, text: &str) {
    out.push('"');
    let mut rest = text;
    while let Some(at) = rest.find(|c: char| c == '"' || c == '\\' || c < ' ') {
        out.push_str(&rest[..at]);
        match rest.as_bytes()[at] {
            b'\n' => out.push_str("\\n"),
            b'\r' => out.push_str("\\r"),
            b'\t' => out.push_str("\\t"),
            control if control < 0x20 => out.push_str(&format!("\\u{control:04x}")),
            quoted => out.extend(['\\', char::from(quoted)]),
        }
        rest = &rest[at + 1..];
    }
    out.push_str(rest);
    out.push('"');
}

/// Appends UTF-16 code units as a JSON string; half a surrogate pair stands as its escape.
fn write_utf16(out: &mut String, units: &[u16]) {
    out.push('"');
    for unit in char::decode_utf16(units.iter().copied()) {
        match unit {
            Ok('"') => out.push_str("\\\""),
            Ok('\\') => out.push_str("\\\\"),
            Ok(c) if c < ' ' => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            Ok(c) => out.push(c),
            Err(half) => out.push_str(&format!("\\u{:04x}", half.unpaired_surrogate())),
        }
    }
    out.push('"');
}
