//! Which column becomes which signal, and how: `COLUMN=SIGNAL`, `COLUMN*0.001+0.5=SIGNAL`, `!COLUMN=SIGNAL`, `COLUMN.3=SIGNAL`.

use std::str::FromStr;

/// A column, what is done with its cells, and the signal it becomes.
///
/// The signal stands behind the last `=`. Before it stands the column's name, as it is in the table or with what is done:
/// `*FACTOR` or `/DIVISOR`, then `+SHIFT` or `-SHIFT`; or `.BIT`, a bit of a whole number, the least is 0; and `!` before it
/// turns a truth value around. A column whose very name looks so is meant before any arithmetic. `FILE:COLUMN` names the
/// column of one file of several.
#[derive(Clone, Debug, PartialEq)]
pub struct Mapping {
    /// As it was given.
    pub text: String,
    pub signal: String,
    /// The column's name and what is done with its cells, as it can be read, the plainest first.
    pub(super) readings: Vec<(String, Transform)>,
}

/// What is done with a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform {
    pub scale: f64,
    pub shift: f64,
    pub bit: Option<u32>,
    pub invert: bool,
}

impl Transform {
    pub const NONE: Transform = Transform { scale: 1.0, shift: 0.0, bit: None, invert: false };

    /// Whether it computes with the cell's number.
    pub fn is_arithmetic(&self) -> bool {
        self.scale != 1.0 || self.shift != 0.0
    }
}

/// A text that is no mapping.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{found:?} is no COLUMN=SIGNAL: expected for example position_mm*0.001=Axis.position, !closed=Door.open or status.3=Belt.isRunning"
)]
pub struct ParseMappingError {
    found: String,
}

impl FromStr for Mapping {
    type Err = ParseMappingError;

    fn from_str(text: &str) -> Result<Mapping, ParseMappingError> {
        let error = || ParseMappingError { found: text.to_owned() };
        let (column, signal) = text.rsplit_once('=').ok_or_else(error)?;
        let (column, signal) = (column.trim(), signal.trim());
        if column.is_empty() || signal.is_empty() {
            return Err(error());
        }
        Ok(Mapping { text: text.to_owned(), signal: signal.to_owned(), readings: readings(column) })
    }
}

/// How `text` can be read as a column and a transform, the plainest first.
fn readings(text: &str) -> Vec<(String, Transform)> {
    let mut all = vec![(text.to_owned(), Transform::NONE)];
    all.extend(computed(text));
    if let Some(rest) = text.strip_prefix('!') {
        let inverted = std::iter::once((rest.trim().to_owned(), Transform::NONE)).chain(bits(rest));
        all.extend(inverted.map(|(column, transform)| (column, Transform { invert: true, ..transform })));
    }
    all.extend(bits(text));
    all
}

/// With a factor, a shift, or both.
fn computed(text: &str) -> Vec<(String, Transform)> {
    let mut all = scaled(text, 0.0);
    for (at, _) in text.char_indices().skip(1).filter(|(_, c)| matches!(c, '+' | '-')) {
        let Some(shift) = number(&text[at..]) else { continue };
        let rest = text[..at].trim_end();
        all.push((rest.to_owned(), Transform { shift, ..Transform::NONE }));
        all.extend(scaled(rest, shift));
    }
    all
}

fn scaled(text: &str, shift: f64) -> Vec<(String, Transform)> {
    let mut all = Vec::new();
    for (at, sign) in text.char_indices().filter(|(_, c)| matches!(c, '*' | '/')) {
        let Some(factor) = number(&text[at + 1..]).filter(|factor| *factor != 0.0) else { continue };
        let scale = if sign == '*' { factor } else { 1.0 / factor };
        all.push((text[..at].trim_end().to_owned(), Transform { scale, shift, ..Transform::NONE }));
    }
    all
}

fn bits(text: &str) -> Vec<(String, Transform)> {
    let Some((column, bit)) = text.rsplit_once('.') else { return Vec::new() };
    match bit.parse() {
        Ok(bit) if bit < 64 => vec![(column.trim().to_owned(), Transform { bit: Some(bit), ..Transform::NONE })],
        _ => Vec::new(),
    }
}

/// A finite number with digits in it: no `inf`, no `nan`.
fn number(text: &str) -> Option<f64> {
    let is_number = text.contains(|c: char| c.is_ascii_digit());
    text.trim().parse().ok().filter(|number: &f64| is_number && number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads `text` where the table has `column`, and nothing else.
    fn check(text: &str, column: &str, expected: Option<Transform>) {
        let mapping: Mapping = text.parse().expect(text);
        let found = mapping.readings.iter().find(|(name, _)| name == column).map(|(_, transform)| *transform);
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn a_column_is_named_with_what_is_done_to_it() {
        let plain = Transform::NONE;
        check("t=A.x", "t", Some(plain));
        check("a b = A.x", "a b", Some(plain));
        check("x*0.001+0.5=A.x", "x", Some(Transform { scale: 0.001, shift: 0.5, ..plain }));
        check("x*1e-3=A.x", "x", Some(Transform { scale: 0.001, ..plain }));
        check("x/1000-2=A.x", "x", Some(Transform { scale: 0.001, shift: -2.0, ..plain }));
        check("x - 0.5=A.x", "x", None);
        check("x-0.5=A.x", "x", Some(Transform { shift: -0.5, ..plain }));
        check("!x=A.x", "x", Some(Transform { invert: true, ..plain }));
        check("w.3=A.x", "w", Some(Transform { bit: Some(3), ..plain }));
        check("!w.12=A.x", "w", Some(Transform { bit: Some(12), invert: true, ..plain }));
        check("w.64=A.x", "w", None);
        check("x*0=A.x", "x", None);
        check("x*inf=A.x", "x", None);
    }

    #[test]
    fn a_column_that_looks_like_arithmetic_is_meant_first() {
        for name in ["w.3", "x*2", "a-1", "!x", "p=q", "speed [m/s]", "°C+1"] {
            let mapping: Mapping = format!("{name}=A.x").parse().expect(name);
            assert_eq!(mapping.readings[0], (name.to_owned(), Transform::NONE));
            assert_eq!(mapping.signal, "A.x");
        }
    }

    #[test]
    fn what_is_no_mapping_is_refused() {
        for text in ["", "x", "=A.x", "x=", " = "] {
            assert!(text.parse::<Mapping>().is_err(), "{text:?}");
        }
    }
}
