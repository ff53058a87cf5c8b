//! JSON text, read once and borrowed from (RFC 8259).
//!
//! A scanner of our own, because a message must not fail as a whole where one value in it does: `1e400` is JSON, no number
//! of any type of ours, and a fault of its one entry. The numbers stay text until their signal's type is known, so that
//! an ULINT keeps its last digit and a REAL is rounded once.

use super::raw::{Raw, Shape};

/// How deep arrays and objects may stand in each other. The deepest message of the protocol needs 4.
pub const DEPTH_LIMIT: u32 = 32;

/// Why a text is no JSON, or none that is read here.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ScanError {
    /// The text breaks the grammar.
    #[error("malformed JSON at byte {at}: expected {expected}, found {found}")]
    Syntax { at: usize, expected: &'static str, found: String },
    /// Arrays and objects stand too deep in each other.
    #[error("JSON nested deeper than {DEPTH_LIMIT} at byte {at}")]
    TooDeep { at: usize },
}

/// Reads a JSON text from front to back.
///
/// Its methods for objects and arrays call back for each member or element, and the callback must read that value.
#[derive(Debug)]
pub(super) struct Scanner<'a> {
    text: &'a str,
    /// The place of the next byte to read.
    at: usize,
    depth: u32,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(text: &'a str) -> Scanner<'a> {
        Scanner { text, at: 0, depth: 0 }
    }

    /// Reads any value.
    pub(super) fn value(&mut self) -> Result<Raw<'a>, ScanError> {
        self.blanks();
        let start = self.at;
        self.skip()?;
        Ok(Raw::scanned(&self.text[start..self.at]))
    }

    /// Makes sure that nothing but blanks follows.
    pub(super) fn end(&mut self) -> Result<(), ScanError> {
        self.blanks();
        if self.at == self.text.len() { Ok(()) } else { Err(self.unexpected("nothing more")) }
    }

    /// What the next value seems to be by its first byte; `None` if it cannot be a value.
    pub(super) fn shape(&mut self) -> Option<Shape> {
        self.blanks();
        Some(match self.peek()? {
            b'n' => Shape::Null,
            b't' | b'f' => Shape::Bool,
            b'-' | b'0'..=b'9' => Shape::Number,
            b'"' => Shape::String,
            b'[' => Shape::Array,
            b'{' => Shape::Object,
            _ => return None,
        })
    }

    /// Reads an object; `member` is called with each key, its quotes and escapes still on, and reads the value.
    pub(super) fn object<E: From<ScanError>>(
        &mut self,
        mut member: impl FnMut(&mut Self, Raw<'a>) -> Result<(), E>,
    ) -> Result<(), E> {
        self.blanks();
        self.open(b'{', "an object")?;
        if !self.close(b'}') {
            loop {
                self.blanks();
                let start = self.at;
                self.string()?;
                let key = Raw::scanned(&self.text[start..self.at]);
                self.blanks();
                self.expect(b':', "a colon")?;
                member(self, key)?;
                if self.close(b'}') {
                    break;
                }
                self.expect(b',', "a comma or the object's closing brace")?;
            }
        }
        self.depth -= 1;
        Ok(())
    }

    /// Reads an array; `element` is called for each element, and reads it.
    pub(super) fn array<E: From<ScanError>>(
        &mut self,
        mut element: impl FnMut(&mut Self) -> Result<(), E>,
    ) -> Result<(), E> {
        self.blanks();
        self.open(b'[', "an array")?;
        if !self.close(b']') {
            loop {
                element(self)?;
                if self.close(b']') {
                    break;
                }
                self.expect(b',', "a comma or the array's closing bracket")?;
            }
        }
        self.depth -= 1;
        Ok(())
    }

    fn skip(&mut self) -> Result<(), ScanError> {
        match self.peek() {
            Some(b'{') => self.object(|scanner, _| scanner.value().map(drop)),
            Some(b'[') => self.array(|scanner| scanner.value().map(drop)),
            Some(b'"') => self.string(),
            Some(b'-' | b'0'..=b'9') => self.number(),
            Some(b't') => self.literal("true"),
            Some(b'f') => self.literal("false"),
            Some(b'n') => self.literal("null"),
            _ => Err(self.unexpected("a value")),
        }
    }

    fn string(&mut self) -> Result<(), ScanError> {
        self.expect(b'"', "a string")?;
        loop {
            let rest = &self.text.as_bytes()[self.at..];
            self.at += rest.iter().position(|&b| b == b'"' || b == b'\\' || b < 0x20).unwrap_or(rest.len());
            match self.peek() {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(());
                }
                Some(b'\\') => self.escape()?,
                _ => return Err(self.unexpected("the string's closing quote")),
            }
        }
    }

    fn escape(&mut self) -> Result<(), ScanError> {
        self.at += 1;
        match self.peek() {
            Some(b'"' | b'\\' | b'/' | b'b' | b'f' | b'n' | b'r' | b't') => self.at += 1,
            Some(b'u') => {
                self.at += 1;
                for _ in 0..4 {
                    if !self.peek().is_some_and(|b| b.is_ascii_hexdigit()) {
                        return Err(self.unexpected("four hexadecimal digits"));
                    }
                    self.at += 1;
                }
            }
            _ => return Err(self.unexpected("an escape that JSON has")),
        }
        Ok(())
    }

    fn number(&mut self) -> Result<(), ScanError> {
        self.at += usize::from(self.peek() == Some(b'-'));
        if self.peek() == Some(b'0') {
            self.at += 1;
        } else {
            self.digits()?;
        }
        if self.peek() == Some(b'.') {
            self.at += 1;
            self.digits()?;
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            self.at += 1;
            self.at += usize::from(matches!(self.peek(), Some(b'+' | b'-')));
            self.digits()?;
        }
        Ok(())
    }

    fn digits(&mut self) -> Result<(), ScanError> {
        let rest = &self.text.as_bytes()[self.at..];
        let count = rest.iter().position(|b| !b.is_ascii_digit()).unwrap_or(rest.len());
        if count == 0 {
            return Err(self.unexpected("a digit"));
        }
        self.at += count;
        Ok(())
    }

    fn literal(&mut self, word: &'static str) -> Result<(), ScanError> {
        if !self.text.as_bytes()[self.at..].starts_with(word.as_bytes()) {
            return Err(self.unexpected("a value"));
        }
        self.at += word.len();
        Ok(())
    }

    fn open(&mut self, bracket: u8, what: &'static str) -> Result<(), ScanError> {
        self.expect(bracket, what)?;
        self.depth += 1;
        if self.depth > DEPTH_LIMIT { Err(ScanError::TooDeep { at: self.at - 1 }) } else { Ok(()) }
    }

    /// Takes blanks and then `bracket`, if it is what follows.
    fn close(&mut self, bracket: u8) -> bool {
        self.blanks();
        let here = self.peek() == Some(bracket);
        self.at += usize::from(here);
        here
    }

    fn expect(&mut self, byte: u8, what: &'static str) -> Result<(), ScanError> {
        if self.peek() != Some(byte) {
            return Err(self.unexpected(what));
        }
        self.at += 1;
        Ok(())
    }

    fn blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn unexpected(&self, expected: &'static str) -> ScanError {
        let found = match self.text.get(self.at..).map(|rest| rest.chars().next()) {
            Some(None) => "the end of the text".to_owned(),
            Some(Some(c)) => format!("{c:?}"),
            // Not at the start of a character: inside one, after an escape's backslash.
            None => "an odd character".to_owned(),
        };
        ScanError::Syntax { at: self.at, expected, found }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::wire::tests::texts;

    #[track_caller]
    fn refused(text: &str, expect: &str) {
        let error = Raw::new(text).expect_err(text).to_string();
        assert_eq!(error, expect, "{text}");
    }

    #[test]
    fn errors_say_where_what_was_expected_and_what_was_found() {
        refused("", "malformed JSON at byte 0: expected a value, found the end of the text");
        refused("{\"a\" 1}", "malformed JSON at byte 5: expected a colon, found '1'");
        refused("[1,]", "malformed JSON at byte 3: expected a value, found ']'");
        refused("[1 2]", "malformed JSON at byte 3: expected a comma or the array's closing bracket, found '2'");
        refused("{\"a\":1,}", "malformed JSON at byte 7: expected a string, found '}'");
        refused("01", "malformed JSON at byte 1: expected nothing more, found '1'");
        refused("1.", "malformed JSON at byte 2: expected a digit, found the end of the text");
        refused("\"\\x\"", "malformed JSON at byte 2: expected an escape that JSON has, found 'x'");
        refused("\"\\u12g4\"", "malformed JSON at byte 5: expected four hexadecimal digits, found 'g'");
        refused("\"a\nb\"", "malformed JSON at byte 2: expected the string's closing quote, found '\\n'");
        refused("NaN", "malformed JSON at byte 0: expected a value, found 'N'");
        refused("nul", "malformed JSON at byte 0: expected a value, found 'n'");
        refused("\u{feff}{}", "malformed JSON at byte 0: expected a value, found '\\u{feff}'");
    }

    #[test]
    fn thirty_two_deep_is_read_and_thirty_three_refused() {
        let nested = |depth: usize| "[".repeat(depth) + &"]".repeat(depth);
        assert!(Raw::new(&nested(32)).is_ok());
        refused(&nested(33), "JSON nested deeper than 32 at byte 32");
        // A million brackets must not reach the end of the stack.
        refused(&"[".repeat(1_000_000), "JSON nested deeper than 32 at byte 32");
    }

    /// Texts that are JSON, nearly JSON, or not at all.
    fn nearly_json() -> impl Strategy<Value = String> {
        let token = prop::sample::select(vec![
            "{",
            "}",
            "[",
            "]",
            ":",
            ",",
            "\"a\"",
            "\"\\u12aF\"",
            "\"\\ud800\"",
            "\"",
            "\\",
            "0",
            "-0",
            "1.5",
            "1e9",
            "-",
            "1e+",
            ".5",
            "01",
            "true",
            "false",
            "null",
            "tru",
            " ",
            "\n",
            "\t",
            "é",
            "\u{0}",
            "1e400",
            "\u{a0}",
        ]);
        prop_oneof![prop::collection::vec(token, 0..12).prop_map(|tokens| tokens.concat()), texts()]
    }

    /// A well-formed JSON text, blanks in it.
    fn documents() -> impl Strategy<Value = String> {
        let leaf = prop_oneof![
            any::<f64>().prop_map(|n| serde_json::json!(n).to_string()),
            any::<i64>().prop_map(|n| n.to_string()),
            texts().prop_map(|s| serde_json::json!(s).to_string()),
            Just("true".to_owned()),
            Just(" null\t".to_owned()),
        ];
        leaf.prop_recursive(6, 40, 5, |inner| {
            prop_oneof![
                prop::collection::vec(inner.clone(), 0..5).prop_map(|v| format!("[{}]", v.join(" ,"))),
                prop::collection::vec((texts(), inner), 0..5).prop_map(|members| {
                    let members = members.iter().map(|(k, v)| format!("{}:\n{v}", serde_json::json!(k)));
                    format!(" {{{} }}", members.collect::<Vec<_>>().join(","))
                }),
            ]
        })
    }

    proptest! {
        /// serde_json reads the same grammar, by other code.
        #[test]
        fn what_is_json_is_what_another_reader_takes(text in nearly_json()) {
            let other = serde_json::from_str::<serde::de::IgnoredAny>(&text).is_ok();
            prop_assert_eq!(Raw::new(&text).is_ok(), other, "{}", text);
        }

        #[test]
        fn every_document_is_read(text in documents()) {
            let raw = Raw::new(&text);
            prop_assert!(raw.is_ok(), "{:?}: {:?}", text, raw);
        }

    }
}
