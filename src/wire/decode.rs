//! Text → message.

use std::borrow::Cow;
use std::time::Duration;

use super::message::{
    Connect, ConnectReply, Entry, Fault, Interface, InterfaceSignal, Message, ResultCode, SignalSelection,
};
use super::number::{NotInteger, integer};
use super::raw::{Raw, Shape, abbreviated};
use super::scan::{ScanError, Scanner};

/// Why a text is no message.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DecodeError {
    /// It is no JSON, or nested too deep.
    #[error(transparent)]
    Json(#[from] ScanError),
    /// It is JSON, but no object.
    #[error("expected an object with one key, the message's type, found {found}")]
    NotAnObject { found: String },
    /// It is an object without a key.
    #[error("expected an object with one key, the message's type, found an empty object")]
    Empty,
    /// It is an object with more than one key.
    #[error("expected an object with one key, the message's type, found {first:?} and {second:?}")]
    SeveralKeys { first: String, second: String },
    /// Its key names none of the protocol's messages.
    #[error("{name:?} is no message of the protocol: expected one of {}", MESSAGE_NAMES.join(", "))]
    UnknownType { name: String },
    /// Its body is not what the message's type asks for.
    #[error("{message} {reason}")]
    Body {
        /// The message's type.
        message: &'static str,
        /// What was expected and what was found, after the type's name.
        reason: String,
    },
}

/// The messages of the protocol, as written; `ConnectionReply` is read as `ConnectReply`.
const MESSAGE_NAMES: [&str; 6] =
    ["Connect", "ConnectReply", "SendValue", "SendValueReply", "QueryAll", "QueryAllReply"];

/// What went wrong within a body whose message is known.
enum BodyError {
    Json(ScanError),
    Reason(String),
}

impl From<ScanError> for BodyError {
    fn from(error: ScanError) -> Self {
        BodyError::Json(error)
    }
}

impl BodyError {
    fn of(self, message: &'static str) -> DecodeError {
        match self {
            BodyError::Json(error) => DecodeError::Json(error),
            BodyError::Reason(reason) => DecodeError::Body { message, reason },
        }
    }
}

fn reason<T>(text: impl Into<String>) -> Result<T, BodyError> {
    Err(BodyError::Reason(text.into()))
}

impl<'a> Message<'a> {
    /// Reads a message from the text of a WebSocket frame.
    ///
    /// Members that the protocol does not know are ignored; a member that stands twice counts as it stands last. The
    /// text's length is the transport's to limit.
    pub fn decode(text: &'a str) -> Result<Message<'a>, DecodeError> {
        let mut scanner = Scanner::new(text);
        if scanner.shape() != Some(Shape::Object) {
            return Err(DecodeError::NotAnObject { found: Raw::new(text)?.described() });
        }
        let mut first: Option<(Cow<'a, str>, Result<Message<'a>, DecodeError>)> = None;
        scanner.object(|scanner, key| {
            let name = key_name(key);
            if let Some((first, _)) = &first {
                let shorten = |name: &str| abbreviated(name).into_owned();
                return Err(DecodeError::SeveralKeys { first: shorten(first), second: shorten(&name) });
            }
            let message = read_body(scanner, &name);
            // A body that the grammar allows has been read to its end even if the protocol refuses it.
            match message {
                Err(DecodeError::Json(error)) => return Err(error.into()),
                message => first = Some((name, message)),
            }
            Ok(())
        })?;
        scanner.end()?;
        first.ok_or(DecodeError::Empty)?.1
    }

    /// Reads the message that stands as member `name` of some object, as in a line of a trace; `body` is its value.
    pub fn from_member(name: &str, body: Raw<'a>) -> Result<Message<'a>, DecodeError> {
        read_body(&mut Scanner::new(body.text()), name)
    }
}

/// The members of the object that `text` is: their names and values, in order. Used by whoever wraps messages in objects
/// of their own, as a trace does.
pub fn members(text: &str) -> Result<Vec<(Cow<'_, str>, Raw<'_>)>, DecodeError> {
    let mut scanner = Scanner::new(text);
    if scanner.shape() != Some(Shape::Object) {
        return Err(DecodeError::NotAnObject { found: Raw::new(text)?.described() });
    }
    let mut members = Vec::new();
    scanner.object(|scanner, key| {
        let value = scanner.value()?;
        members.push((key_name(key), value));
        Ok::<(), ScanError>(())
    })?;
    scanner.end()?;
    Ok(members)
}

/// A key without its quotes and escapes. One that is no Unicode text stays as it is written: it names nothing of ours.
fn key_name(key: Raw<'_>) -> Cow<'_, str> {
    key.as_str().unwrap_or(Cow::Borrowed(key.text()))
}

fn read_body<'a>(scanner: &mut Scanner<'a>, name: &str) -> Result<Message<'a>, DecodeError> {
    let read = |error: BodyError, message| error.of(message);
    match name {
        "Connect" => read_connect(scanner).map(Message::Connect).map_err(|e| read(e, "Connect")),
        "ConnectReply" | "ConnectionReply" => {
            read_connect_reply(scanner).map(Message::ConnectReply).map_err(|e| read(e, "ConnectReply"))
        }
        "SendValue" => read_entries(scanner).map(Message::SendValue).map_err(|e| read(e, "SendValue")),
        "SendValueReply" => read_faults(scanner).map(Message::SendValueReply).map_err(|e| read(e, "SendValueReply")),
        "QueryAll" => read_query(scanner).map(|()| Message::QueryAll).map_err(|e| read(e, "QueryAll")),
        "QueryAllReply" => read_interface(scanner).map(Message::QueryAllReply).map_err(|e| read(e, "QueryAllReply")),
        unknown => {
            scanner.value()?;
            Err(DecodeError::UnknownType { name: abbreviated(unknown).into_owned() })
        }
    }
}

/// The members of a body that are wanted by name, each as it stands last.
fn wanted<'a, const N: usize>(scanner: &mut Scanner<'a>, names: [&str; N]) -> Result<[Option<Raw<'a>>; N], BodyError> {
    let mut found = [None; N];
    if scanner.shape() != Some(Shape::Object) {
        let raw = scanner.value()?;
        return reason(format!("expects an object, found {}", raw.described()));
    }
    scanner.object(|scanner, key| {
        let value = scanner.value()?;
        let name = key_name(key);
        if let Some(place) = names.iter().position(|wanted| *wanted == name) {
            found[place] = Some(value);
        }
        Ok::<(), ScanError>(())
    })?;
    Ok(found)
}

fn text_member<'a>(name: &str, member: Option<Raw<'a>>) -> Result<Cow<'a, str>, BodyError> {
    match member {
        None => reason(format!("has no {name:?}")),
        Some(raw) => match raw.as_str() {
            Some(text) => Ok(text),
            None => reason(format!("expects a string as {name:?}, found {}", raw.described())),
        },
    }
}

fn bool_member(name: &str, member: Option<Raw<'_>>) -> Result<bool, BodyError> {
    match member {
        None => reason(format!("has no {name:?}")),
        Some(raw) => match raw.as_bool() {
            Some(value) => Ok(value),
            None => reason(format!("expects true or false as {name:?}, found {}", raw.described())),
        },
    }
}

fn result_member(member: Option<Raw<'_>>) -> Result<ResultCode, BodyError> {
    let Some(raw) = member else { return reason("has no \"result\"") };
    let code = raw.as_number().and_then(|text| integer(text, 0).ok()).and_then(|code| i64::try_from(code).ok());
    match code {
        Some(code) => Ok(ResultCode(code)),
        None => reason(format!("expects a whole number as \"result\", found {}", raw.described())),
    }
}

fn read_connect<'a>(scanner: &mut Scanner<'a>) -> Result<Connect<'a>, BodyError> {
    let [id, enable, signals] = wanted(scanner, ["Id", "enable", "Signals"])?;
    let signals = match signals.filter(|raw| raw.shape() != Shape::Null) {
        None => None,
        Some(raw) => Some(read_selections(raw)?),
    };
    Ok(Connect { id: text_member("Id", id)?, enable: bool_member("enable", enable)?, signals })
}

fn read_selections(raw: Raw<'_>) -> Result<Vec<SignalSelection>, BodyError> {
    let Some(elements) = raw.elements() else {
        return reason(format!("expects an array as \"Signals\", found {}", raw.described()));
    };
    let mut selections = Vec::with_capacity(elements.len());
    for element in elements {
        let [name, min_interval] = wanted(&mut Scanner::new(element.text()), ["name", "minInterval"])?;
        let min_interval = match min_interval {
            None => Duration::ZERO,
            Some(raw) => match interval(raw) {
                Some(interval) => interval,
                None => {
                    return reason(format!(
                        "expects a number of milliseconds, 0 or more, as \"minInterval\", found {}",
                        raw.described()
                    ));
                }
            },
        };
        selections.push(SignalSelection { name: text_member("name", name)?.into_owned(), min_interval });
    }
    Ok(selections)
}

/// A number of milliseconds, 0 or more, to the nearest nanosecond.
fn interval(raw: Raw<'_>) -> Option<Duration> {
    let ns = match integer(raw.as_number()?, 6) {
        Ok(ns) | Err(NotInteger::Fraction { nearest: ns }) => ns,
        Err(NotInteger::TooLarge) => return None,
    };
    u64::try_from(ns).ok().map(Duration::from_nanos)
}

fn read_connect_reply<'a>(scanner: &mut Scanner<'a>) -> Result<ConnectReply<'a>, BodyError> {
    let names = ["Id", "enable", "ServerName", "result", "message"];
    let [id, enable, server_name, result, message] = wanted(scanner, names)?;
    Ok(ConnectReply {
        id: text_member("Id", id)?,
        enable: bool_member("enable", enable)?,
        // Only for people: a server without a name is no reason to refuse it.
        server_name: server_name.and_then(Raw::as_str).unwrap_or_default(),
        result: result_member(result)?,
        message: message.and_then(Raw::as_str),
    })
}

fn read_entries<'a>(scanner: &mut Scanner<'a>) -> Result<Vec<Entry<'a>>, BodyError> {
    if scanner.shape() != Some(Shape::Array) {
        let raw = scanner.value()?;
        return reason(format!("expects an array of entries, found {}", raw.described()));
    }
    let mut entries = Vec::new();
    scanner.array(|scanner| {
        let mut entry = Entry { name: None, value: None };
        if scanner.shape() == Some(Shape::Object) {
            scanner.object(|scanner, key| {
                let value = scanner.value()?;
                match key.text() {
                    "\"name\"" => entry.name = value.as_str(),
                    "\"value\"" => entry.value = Some(value),
                    // A key may be written with escapes, though nobody does.
                    _ => match key_name(key).as_ref() {
                        "name" => entry.name = value.as_str(),
                        "value" => entry.value = Some(value),
                        _ => {}
                    },
                }
                Ok::<(), ScanError>(())
            })?;
        } else {
            scanner.value()?;
        }
        entries.push(entry);
        Ok::<(), ScanError>(())
    })?;
    Ok(entries)
}

/// Reads a `SendValueReply`. The source gives its existence and not its body, so that whatever a foreign server puts into
/// it is worth more than an error: what is not of our form becomes a fault that quotes it.
fn read_faults(scanner: &mut Scanner<'_>) -> Result<Vec<Fault>, BodyError> {
    let body = scanner.value()?;
    let elements = body.elements().unwrap_or_else(|| vec![body]);
    Ok(elements.into_iter().map(read_fault).collect())
}

fn read_fault(element: Raw<'_>) -> Fault {
    let members = wanted(&mut Scanner::new(element.text()), ["name", "result", "message"]);
    let [name, result, message] = members.unwrap_or_default();
    let text = |member: Option<Raw<'_>>| member.and_then(Raw::as_str).map(Cow::into_owned);
    Fault {
        name: text(name).unwrap_or_default(),
        result: result_member(result).unwrap_or_default(),
        message: text(message).unwrap_or_else(|| abbreviated(element.text()).into_owned()),
    }
}

/// Reads the empty body of `QueryAll`: `{}`, `[]` or `null`; the source gives the message's name alone.
fn read_query(scanner: &mut Scanner<'_>) -> Result<(), BodyError> {
    let raw = scanner.value()?;
    match raw.shape() {
        Shape::Object | Shape::Array | Shape::Null => Ok(()),
        _ => reason(format!("expects an empty body, found {}", raw.described())),
    }
}

fn read_interface(scanner: &mut Scanner<'_>) -> Result<Interface, BodyError> {
    let [server_name, result, inputs, outputs] = wanted(scanner, ["ServerName", "result", "inputs", "outputs"])?;
    Ok(Interface {
        server_name: server_name.and_then(Raw::as_str).unwrap_or_default().into_owned(),
        result: result_member(result)?,
        inputs: read_interface_signals("inputs", inputs)?,
        outputs: read_interface_signals("outputs", outputs)?,
    })
}

fn read_interface_signals(side: &str, member: Option<Raw<'_>>) -> Result<Vec<InterfaceSignal>, BodyError> {
    let Some(raw) = member else { return Ok(Vec::new()) };
    let Some(elements) = raw.elements() else {
        return reason(format!("expects an array as {side:?}, found {}", raw.described()));
    };
    let mut signals = Vec::with_capacity(elements.len());
    for element in elements {
        let [name, ty] = wanted(&mut Scanner::new(element.text()), ["name", "type"])?;
        let (name, ty) = (text_member("name", name)?.into_owned(), text_member("type", ty)?.into_owned());
        signals.push(InterfaceSignal { name, ty });
    }
    Ok(signals)
}
