//! The text of one JSON value, and what can be asked of it.

use std::borrow::Cow;
use std::fmt;

use super::scan::{ScanError, Scanner};

/// What a JSON value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    Null,
    Bool,
    Number,
    String,
    Array,
    Object,
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Shape::Null => "null",
            Shape::Bool => "a boolean",
            Shape::Number => "a number",
            Shape::String => "a string",
            Shape::Array => "an array",
            Shape::Object => "an object",
        })
    }
}

/// The text of one well-formed JSON value, without blanks around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Raw<'a>(&'a str);

impl<'a> Raw<'a> {
    /// Checks that `text` is one JSON value, not nested too deep; blanks around it are cut off.
    pub fn new(text: &'a str) -> Result<Raw<'a>, ScanError> {
        let mut scanner = Scanner::new(text);
        let raw = scanner.value()?;
        scanner.end()?;
        Ok(raw)
    }

    /// The value that `text` begins with, at its first byte, and what follows it; `None` where it begins with none.
    pub fn leading(text: &'a str) -> Option<(Raw<'a>, &'a str)> {
        let raw = Scanner::new(text).value().ok()?;
        text.strip_prefix(raw.0).map(|rest| (raw, rest))
    }

    /// The value that `text` is; the scanner has just read it.
    pub(super) fn scanned(text: &'a str) -> Raw<'a> {
        Raw(text)
    }

    /// The value's text.
    pub fn text(self) -> &'a str {
        self.0
    }

    /// What the value is.
    pub fn shape(self) -> Shape {
        match self.0.as_bytes().first() {
            Some(b'n') => Shape::Null,
            Some(b't' | b'f') => Shape::Bool,
            Some(b'"') => Shape::String,
            Some(b'[') => Shape::Array,
            Some(b'{') => Shape::Object,
            _ => Shape::Number,
        }
    }

    /// `true` or `false`, if it is one of them.
    pub fn as_bool(self) -> Option<bool> {
        match self.0 {
            "true" => Some(true),
            "false" => Some(false),
            _ => None,
        }
    }

    /// The number's text, if it is a number.
    pub fn as_number(self) -> Option<&'a str> {
        (self.shape() == Shape::Number).then_some(self.0)
    }

    /// The string without its quotes and escapes; `None` if it is no string, or holds half a surrogate pair.
    pub fn as_str(self) -> Option<Cow<'a, str>> {
        let inside = self.quoted()?;
        if !inside.contains('\\') {
            return Some(Cow::Borrowed(inside));
        }
        let mut plain = String::with_capacity(inside.len());
        for unit in char::decode_utf16(Units { rest: inside.chars(), second: None }) {
            plain.push(unit.ok()?);
        }
        Some(Cow::Owned(plain))
    }

    /// The string's UTF-16 code units, whether they pair or not; `None` if it is no string.
    pub fn as_utf16(self) -> Option<impl Iterator<Item = u16>> {
        Some(Units { rest: self.quoted()?.chars(), second: None })
    }

    /// The elements, if it is an array.
    pub fn elements(self) -> Option<Vec<Raw<'a>>> {
        let mut elements = Vec::new();
        Scanner::new(self.0)
            .array(|scanner| {
                elements.push(scanner.value()?);
                Ok::<(), ScanError>(())
            })
            .ok()?;
        Some(elements)
    }

    /// The text for a message to people: what it is, and its beginning.
    pub fn described(self) -> String {
        match self.shape() {
            Shape::Null => "null".to_owned(),
            shape => format!("{shape}, {}", abbreviated(self.0)),
        }
    }

    fn quoted(self) -> Option<&'a str> {
        self.0.strip_prefix('"')?.strip_suffix('"')
    }
}

/// `text`, or its beginning if it is long.
pub(super) fn abbreviated(text: &str) -> Cow<'_, str> {
    const LONG: usize = 40;
    match text.char_indices().nth(LONG) {
        None => Cow::Borrowed(text),
        Some((end, _)) => Cow::Owned(format!("{}… ({} bytes)", &text[..end], text.len())),
    }
}

/// The UTF-16 code units of the inside of a well-formed JSON string.
struct Units<'a> {
    rest: std::str::Chars<'a>,
    /// The second half of a character that has two.
    second: Option<u16>,
}

impl Iterator for Units<'_> {
    type Item = u16;

    fn next(&mut self) -> Option<u16> {
        if let Some(unit) = self.second.take() {
            return Some(unit);
        }
        let c = match self.rest.next()? {
            '\\' => match self.rest.next()? {
                'b' => '\u{8}',
                'f' => '\u{c}',
                'n' => '\n',
                'r' => '\r',
                't' => '\t',
                'u' => {
                    let digits = self.rest.as_str().get(..4)?;
                    self.rest = self.rest.as_str()[4..].chars();
                    return u16::from_str_radix(digits, 16).ok();
                }
                same => same,
            },
            c => c,
        };
        let mut units = [0; 2];
        let encoded = c.encode_utf16(&mut units);
        self.second = encoded.get(1).copied();
        encoded.first().copied()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::wire::tests::texts;

    #[test]
    fn strings_lose_their_escapes() {
        let check = |text: &str, expect: Option<&str>| {
            assert_eq!(Raw::new(text).expect(text).as_str().as_deref(), expect, "{text}");
        };
        check(r#""plain""#, Some("plain"));
        check(r#""\"\\\/\b\f\n\r\t""#, Some("\"\\/\u{8}\u{c}\n\r\t"));
        check(r#""T0s\u003d""#, Some("T0s="));
        check(r#""\u00e9é\ud83d\ude00😀""#, Some("éé😀😀"));
        check(r#""\ud83d""#, None);
        check(r#""\ude00\ud83d""#, None);
        check("1", None);
    }

    #[test]
    fn long_values_are_abbreviated_for_people() {
        let long = format!("\"{}\"", "ä".repeat(100));
        assert_eq!(
            Raw::new(&long).expect("a string").described(),
            format!("a string, \"{}… (202 bytes)", "ä".repeat(39))
        );
        assert_eq!(Raw::new(" 0.5 ").expect("a number").described(), "a number, 0.5");
        assert_eq!(Raw::new("null").expect("null").described(), "null");
    }

    proptest! {
        #[test]
        fn strings_read_as_another_reader_reads_them(text in texts()) {
            let quoted = serde_json::json!(text).to_string();
            let raw = Raw::new(&quoted).expect("a string");
            let read = raw.as_str();
            prop_assert_eq!(read.as_deref(), Some(text.as_str()));
            let units: Vec<u16> = raw.as_utf16().expect("a string").collect();
            prop_assert_eq!(units, text.encode_utf16().collect::<Vec<_>>());
        }
    }
}
