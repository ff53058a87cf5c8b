//! The IO data model (section 5.3.1 of the reference): signals under the function block whose event they belong to, with
//! the time of that event.
//!
//! ```text
//! { "<function block, fully qualified>": { "ts": <ms since 1970>, "Param": { "<signal>": value, … } }, … }
//! ```
//!
//! Only the sender's outputs stand in a payload; all signals changed by one event stand in one payload; a payload holds
//! at least one function block, and a function block at least one signal. Texts are JSON strings here
//! ([`TextForm::Plain`]), not base64 as in the CPS-Protocol.
//!
//! ```
//! use kinetwin::value::Value;
//! use kinetwin::wire::io_data::{self, PayloadText};
//!
//! let mut payload = PayloadText::new();
//! payload.function_block("Field_QSS.PusherA", 0).signal("command", &Value::Int(1)).unwrap();
//! let text = payload.finish().unwrap();
//! assert_eq!(text, r#"{"Field_QSS.PusherA":{"ts":0,"Param":{"command":1}}}"#);
//!
//! let blocks = io_data::decode(&text).unwrap();
//! assert_eq!((blocks[0].name.as_ref(), blocks[0].timestamp_ms), ("Field_QSS.PusherA", 0));
//! assert_eq!(blocks[0].signals[0].1.text(), "1");
//! ```

use std::borrow::Cow;

use super::number::integer;
use super::raw::{Raw, Shape, abbreviated};
use super::scan::{ScanError, Scanner};
use super::value::{NotFinite, TextForm, write_number, write_string, write_value};
use crate::value::Value;

/// One function block of a payload.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionBlock<'a> {
    /// Fully qualified: the names of its containers and its own, with dots between.
    pub name: Cow<'a, str>,
    /// When the event happened by the sender's clock, in milliseconds since 1970-01-01 00:00 UTC.
    pub timestamp_ms: u64,
    /// Names, unique within the function block, and values, at least one. Where a name stands twice, the last counts.
    pub signals: Vec<(Cow<'a, str>, Raw<'a>)>,
}

/// Why a text is no payload.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum IoDataError {
    /// It is no JSON, or nested too deep.
    #[error(transparent)]
    Json(#[from] ScanError),
    /// It is JSON, but no object.
    #[error("expected an object of function blocks, found {found}")]
    NotAnObject { found: String },
    /// It holds no function block.
    #[error("expected at least one function block, found an empty object")]
    Empty,
    /// One of its function blocks is not what it should be.
    #[error("function block {name:?}: {reason}")]
    FunctionBlock { name: String, reason: String },
}

/// Reads a payload.
pub fn decode(text: &str) -> Result<Vec<FunctionBlock<'_>>, IoDataError> {
    let mut scanner = Scanner::new(text);
    if scanner.shape() != Some(Shape::Object) {
        return Err(IoDataError::NotAnObject { found: Raw::new(text)?.described() });
    }
    let mut blocks = Vec::new();
    scanner.object(|scanner, key| {
        let name = name_of(key);
        let fail = |reason| IoDataError::FunctionBlock { name: abbreviated(&name).into_owned(), reason };
        let (timestamp_ms, signals) = read_block(scanner)?.map_err(fail)?;
        blocks.push(FunctionBlock { name, timestamp_ms, signals });
        Ok::<(), IoDataError>(())
    })?;
    scanner.end()?;
    if blocks.is_empty() { Err(IoDataError::Empty) } else { Ok(blocks) }
}

type Block<'a> = (u64, Vec<(Cow<'a, str>, Raw<'a>)>);

/// Reads the value of a function block's member; the inner error says what is wrong with it in the model's terms.
fn read_block<'a>(scanner: &mut Scanner<'a>) -> Result<Result<Block<'a>, String>, ScanError> {
    if scanner.shape() != Some(Shape::Object) {
        return Ok(Err(format!(
            "expected an object with \"ts\" and \"Param\", found {}",
            scanner.value()?.described()
        )));
    }
    let (mut timestamp, mut signals) = (None, None);
    scanner.object(|scanner, key| {
        match name_of(key).as_ref() {
            "ts" => timestamp = Some(scanner.value()?),
            "Param" if scanner.shape() == Some(Shape::Object) => signals = Some(Ok(read_signals(scanner)?)),
            "Param" => signals = Some(Err(scanner.value()?)),
            _ => drop(scanner.value()?),
        }
        Ok::<(), ScanError>(())
    })?;
    Ok(checked_block(timestamp, signals))
}

type Signals<'a> = Vec<(Cow<'a, str>, Raw<'a>)>;

fn checked_block<'a>(
    timestamp: Option<Raw<'a>>,
    signals: Option<Result<Signals<'a>, Raw<'a>>>,
) -> Result<Block<'a>, String> {
    let timestamp = timestamp.ok_or("it has no \"ts\"")?;
    let ms = timestamp.as_number().and_then(|text| integer(text, 0).ok()).and_then(|ms| u64::try_from(ms).ok());
    let ms = ms.ok_or_else(|| {
        format!("expected whole milliseconds since 1970, 0 or more, as \"ts\", found {}", timestamp.described())
    })?;
    match signals {
        None => Err("it has no \"Param\"".to_owned()),
        Some(Err(other)) => Err(format!("expected an object of signals as \"Param\", found {}", other.described())),
        Some(Ok(signals)) if signals.is_empty() => Err("its \"Param\" holds no signal".to_owned()),
        Some(Ok(signals)) => Ok((ms, signals)),
    }
}

fn read_signals<'a>(scanner: &mut Scanner<'a>) -> Result<Signals<'a>, ScanError> {
    let mut signals = Vec::new();
    scanner.object(|scanner, key| {
        let value = scanner.value()?;
        signals.push((name_of(key), value));
        Ok::<(), ScanError>(())
    })?;
    Ok(signals)
}

fn name_of(key: Raw<'_>) -> Cow<'_, str> {
    key.as_str().unwrap_or(Cow::Borrowed(key.text()))
}

/// The function block and the signal in a signal's full name: what stands before its last dot and what after. `None` for
/// a name without both.
pub fn split_name(full: &str) -> Option<(&str, &str)> {
    full.rsplit_once('.').filter(|(block, signal)| !block.is_empty() && !signal.is_empty())
}

/// A payload in the making: one buffer, one pass.
#[derive(Debug)]
pub struct PayloadText {
    text: String,
    /// Where the present function block begins in the text.
    block: usize,
    /// How many signals it holds.
    signals: usize,
}

impl PayloadText {
    /// An empty payload.
    #[expect(clippy::new_without_default, reason = "an empty payload is no payload: there is nothing default about it")]
    pub fn new() -> PayloadText {
        PayloadText { text: "{".to_owned(), block: 1, signals: 0 }
    }

    /// Begins a function block; the time of its event is in milliseconds since 1970. One that gets no signal is left out.
    pub fn function_block(&mut self, name: &str, timestamp_ms: u64) -> FunctionBlockText<'_> {
        self.end_block();
        if self.block > 1 {
            self.text.push(',');
        }
        write_string(&mut self.text, name);
        self.text.push_str(":{\"ts\":");
        write_number(&mut self.text, &timestamp_ms);
        self.text.push_str(",\"Param\":{");
        FunctionBlockText(self)
    }

    /// The payload's text; `None` if it holds no signal, because there is nothing to say then.
    pub fn finish(mut self) -> Option<String> {
        self.end_block();
        if self.text.len() == 1 {
            return None;
        }
        self.text.push('}');
        Some(self.text)
    }

    fn end_block(&mut self) {
        match self.signals {
            0 => self.text.truncate(self.block),
            _ => self.text.push_str("}}"),
        }
        self.block = self.text.len();
        self.signals = 0;
    }
}

/// The function block of a [`PayloadText`] that is being written.
#[derive(Debug)]
pub struct FunctionBlockText<'p>(&'p mut PayloadText);

impl FunctionBlockText<'_> {
    /// Adds a signal. A value without a JSON form is refused, and the payload stays as it was.
    pub fn signal(&mut self, name: &str, value: &Value) -> Result<(), NotFinite> {
        let payload = &mut *self.0;
        let start = payload.text.len();
        if payload.signals > 0 {
            payload.text.push(',');
        }
        write_string(&mut payload.text, name);
        payload.text.push(':');
        if let Err(error) = write_value(&mut payload.text, value, TextForm::Plain) {
            payload.text.truncate(start);
            return Err(error);
        }
        payload.signals += 1;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::{ElementaryType, SignalType};
    use crate::wire::read_value;

    #[track_caller]
    fn refused(text: &str, expect: &str) {
        assert_eq!(decode(text).expect_err(text).to_string(), expect, "{text}");
    }

    #[test]
    fn a_payload_holds_all_that_changed_by_function_block() {
        let mut payload = PayloadText::new();
        let mut robot = payload.function_block("FI_QDP.FieldInterface_Cartesia", 1_700_000_000_123);
        robot.signal("XTarget", &Value::Real(900.0)).expect("a number");
        robot.signal("grip", &Value::Bool(true)).expect("a boolean");
        payload.function_block("Nothing.changed", 5);
        let mut pusher = payload.function_block("Field_QSS.PusherA", 0);
        pusher.signal("status", &Value::String((*b"O\"K\xe9").into())).expect("a text");
        let text = payload.finish().expect("a payload");
        assert_eq!(
            text,
            r#"{"FI_QDP.FieldInterface_Cartesia":{"ts":1700000000123,"Param":{"XTarget":900.0,"grip":true}},"#
                .to_owned()
                + r#""Field_QSS.PusherA":{"ts":0,"Param":{"status":"O\"Ké"}}}"#
        );
        let blocks = decode(&text).expect("a payload");
        let heads: Vec<_> = blocks.iter().map(|block| (block.name.as_ref(), block.timestamp_ms)).collect();
        assert_eq!(heads, [("FI_QDP.FieldInterface_Cartesia", 1_700_000_000_123), ("Field_QSS.PusherA", 0)]);
        let status = read_value(blocks[1].signals[0].1, SignalType::scalar(ElementaryType::String), TextForm::Plain);
        assert_eq!(status, Ok(Value::String((*b"O\"K\xe9").into())));
    }

    #[test]
    fn what_has_no_json_form_is_left_out_and_nothing_is_sent_for_nothing() {
        let mut payload = PayloadText::new();
        let mut block = payload.function_block("A.B", 7);
        assert!(block.signal("x", &Value::Real(f32::NAN)).is_err());
        block.signal("y", &Value::Lreal(0.5)).expect("a number");
        assert!(block.signal("z", &Value::Lreal(f64::INFINITY)).is_err());
        assert_eq!(payload.finish().as_deref(), Some(r#"{"A.B":{"ts":7,"Param":{"y":0.5}}}"#));

        let mut payload = PayloadText::new();
        assert!(payload.function_block("A.B", 7).signal("x", &Value::Real(f32::NAN)).is_err());
        payload.function_block("C.D", 7);
        assert_eq!(payload.finish(), None);
        assert_eq!(PayloadText::new().finish(), None);
    }

    #[test]
    fn array_sizes_are_above_zero_and_times_not_below() {
        refused("{}", "expected at least one function block, found an empty object");
        refused("[]", "expected an object of function blocks, found an array, []");
        refused(r#"{"A":{"ts":1,"Param":{}}}"#, "function block \"A\": its \"Param\" holds no signal");
        refused(r#"{"A":{"Param":{"x":1}}}"#, "function block \"A\": it has no \"ts\"");
        refused(r#"{"A":{"ts":1}}"#, "function block \"A\": it has no \"Param\"");
        refused(
            r#"{"A":{"ts":1,"Param":[1]}}"#,
            "function block \"A\": expected an object of signals as \"Param\", found an array, [1]",
        );
        refused(r#"{"A":5}"#, "function block \"A\": expected an object with \"ts\" and \"Param\", found a number, 5");
        for ts in ["-1", "0.5", "\"0\"", "null", "1e400"] {
            let error = decode(&format!(r#"{{"A":{{"ts":{ts},"Param":{{"x":1}}}}}}"#)).expect_err(ts).to_string();
            assert!(error.contains("expected whole milliseconds since 1970, 0 or more"), "{error}");
        }
        refused("{\"A\":", "malformed JSON at byte 5: expected a value, found the end of the text");
        assert!(decode(r#"{"A":{"ts":1.0,"more":[{}],"Param":{"x":1}}}"#).is_ok());
    }

    #[test]
    fn a_full_name_is_a_function_block_and_a_signal() {
        assert_eq!(split_name("Field_QSS.PusherA.command"), Some(("Field_QSS.PusherA", "command")));
        assert_eq!(split_name("command"), None);
        assert_eq!(split_name(".command"), None);
        assert_eq!(split_name("PusherA."), None);
    }
}
