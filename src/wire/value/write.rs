//! Value → JSON.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::TextForm;
use crate::value::Value;

/// NaN and the infinities have no JSON form.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{number} has no JSON form")]
pub struct NotFinite {
    pub number: f64,
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
pub(in crate::wire) fn write_number(out: &mut String, number: &impl serde::Serialize) {
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
pub(in crate::wire) fn write_string(out: &mut String, text: &str) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_refused_and_leaves_no_trace() {
        let mut out = "before".to_owned();
        let nan = write_value(&mut out, &Value::Real(f32::NAN), TextForm::Base64).expect_err("NaN");
        assert_eq!(nan.to_string(), "NaN has no JSON form");
        let array = Value::Array([Value::Lreal(1.0), Value::Lreal(f64::NEG_INFINITY)].into());
        let infinite = write_value(&mut out, &array, TextForm::Base64).expect_err("-inf");
        assert_eq!(infinite.to_string(), "-inf has no JSON form");
        assert_eq!(out, "before");
    }
}
