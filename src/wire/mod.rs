//! Messages ↔ JSON text: the CPS-Protocol and the IO data model. The only module that knows JSON on the wire.
//!
//! Source: *3D virtual commissioning on IEC 61499*, section 5.3. The CPS-Protocol (5.3.2.1) sends one JSON object per
//! WebSocket text message; the object's single key is the message's type. The automation is the server, the simulation
//! the client, which speaks first.
//!
//! | [`Message`] | direction | body |
//! | --- | --- | --- |
//! | `Connect` | client → server | `{"Id": base64, "enable": bool}`, and ours: `"Signals": [{"name", "minInterval": ms}]` |
//! | `ConnectReply` | server → client | `{"Id": echo, "enable": bool, "ServerName": base64, "result": int}`, and ours: `"message"` |
//! | `SendValue` | both | array of `{"name": string, "value": v}` |
//! | `SendValueReply` | both, on error only | ours: array of `{"name", "result": 404, 415 or 422, "message"}` |
//! | `QueryAll` | client → server | `{}`; `null` and `[]` are read too |
//! | `QueryAllReply` | server → client | ours: `{"ServerName", "result", "inputs": [{"name", "type"}], "outputs": [...]}` |
//!
//! Reading has two steps, because what a value must be depends on its signal: [`Message::decode`] gives entries whose
//! values are still text ([`Raw`]), borrowed from the message; [`read_value`] makes a [`Value`](crate::value::Value) of
//! one, or says why not. So one bad value never costs its neighbours. Writing is one pass into one buffer:
//! [`SendValueText`] for values, [`Message::encode`] for everything else.
//!
//! ```
//! use kinetwin::value::{ElementaryType, SignalType, Value};
//! use kinetwin::wire::{Message, SendValueText, TextForm, read_value};
//!
//! let mut text = SendValueText::with_capacity(1);
//! text.push("TC1.Position", &Value::Real(0.5776)).unwrap();
//! let text = text.finish().unwrap();
//! assert_eq!(text, r#"{"SendValue":[{"name":"TC1.Position","value":0.5776}]}"#);
//!
//! let Message::SendValue(entries) = Message::decode(&text).unwrap() else { panic!() };
//! let real = SignalType::scalar(ElementaryType::Real);
//! assert_eq!(read_value(entries[0].value.unwrap(), real, TextForm::Base64), Ok(Value::Real(0.5776)));
//! ```

mod decode;
mod encode;
pub mod io_data;
mod message;
mod number;
mod raw;
mod scan;
#[cfg(test)]
mod tests;
mod value;

pub use decode::{DecodeError, members};
pub use encode::SendValueText;
pub use message::{
    Connect, ConnectReply, Entry, Fault, Interface, InterfaceSignal, Message, ResultCode, SignalSelection,
};
pub use raw::{Raw, Shape};
pub use scan::{DEPTH_LIMIT, ScanError};
pub use value::{NotFinite, TextForm, Unfit, read_value, write_value};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// A name as `Id` and `ServerName` have it: the base64 of its UTF-8.
pub fn to_base64(name: &str) -> String {
    STANDARD.encode(name)
}

/// The name behind an `Id` or a `ServerName`, for people: decoded, or as it stands if it is no base64 of a text.
pub fn from_base64(text: &str) -> String {
    let decoded = STANDARD.decode(text).ok().and_then(|bytes| String::from_utf8(bytes).ok());
    decoded.unwrap_or_else(|| text.to_owned())
}
