//! The six messages of the CPS-Protocol, as data.

use std::borrow::Cow;
use std::fmt;
use std::time::Duration;

use super::raw::Raw;

/// A message of the CPS-Protocol. What can be borrowed from the text it was read from, is.
#[derive(Clone, Debug, PartialEq)]
pub enum Message<'a> {
    /// Client → server: opens the session, or ends it.
    Connect(Connect<'a>),
    /// Server → client: the answer to either.
    ConnectReply(ConnectReply<'a>),
    /// Both ways: values of the sender's outputs.
    SendValue(Vec<Entry<'a>>),
    /// Both ways: what was wrong with the values of one `SendValue`. Never sent for a message without a fault.
    SendValueReply(Vec<Fault>),
    /// Client → server: asks for the server's interface.
    QueryAll,
    /// Server → client: the server's interface.
    QueryAllReply(Interface),
}

impl Message<'_> {
    /// The message's type, as the one key of its object spells it.
    pub fn name(&self) -> &'static str {
        match self {
            Message::Connect(_) => "Connect",
            Message::ConnectReply(_) => "ConnectReply",
            Message::SendValue(_) => "SendValue",
            Message::SendValueReply(_) => "SendValueReply",
            Message::QueryAll => "QueryAll",
            Message::QueryAllReply(_) => "QueryAllReply",
        }
    }
}

/// The body of `Connect`.
#[derive(Clone, Debug, PartialEq)]
pub struct Connect<'a> {
    /// Who connects: base64 as it travels, the same for all connections of one run, unique across runs.
    pub id: Cow<'a, str>,
    /// Whether the session is opened or ended.
    pub enable: bool,
    /// The signals that the client wants to be sent, and how often at most (requirement R007; ours, and ignored by a
    /// plain server). `None`: all of them, at every change.
    pub signals: Option<Vec<SignalSelection>>,
}

/// A signal that a client selects when it connects.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalSelection {
    /// The signal's name.
    pub name: String,
    /// The least time between two values of it; zero sends every change. Milliseconds on the wire (`minInterval`).
    pub min_interval: Duration,
}

/// The body of `ConnectReply` (which Table 5 of the reference also calls `ConnectionReply`).
#[derive(Clone, Debug, PartialEq)]
pub struct ConnectReply<'a> {
    /// The `Id` of the `Connect` it answers.
    pub id: Cow<'a, str>,
    /// The `enable` of the `Connect` it answers.
    pub enable: bool,
    /// Who answers: base64 as it travels.
    pub server_name: Cow<'a, str>,
    pub result: ResultCode,
    /// What was wrong, for people (ours).
    pub message: Option<Cow<'a, str>>,
}

/// One `{"name", "value"}` of a `SendValue`.
///
/// Nothing is decided here about its worth: a missing name, a missing value, a value of the wrong type are each their own
/// kind of fault, which the session reports by entry.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry<'a> {
    /// The signal's name; `None` if there is none, or it is no string.
    pub name: Option<Cow<'a, str>>,
    /// The value's JSON text; `None` if there is none.
    pub value: Option<Raw<'a>>,
}

/// What was wrong with one entry of a `SendValue`: one element of a `SendValueReply`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The signal's name, as the faulty message spelt it.
    pub name: String,
    /// 404 unknown signal, 415 wrong type, 422 wrong value.
    pub result: ResultCode,
    /// What was found and what was expected, for people.
    pub message: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({})", self.name, self.message, self.result)
    }
}

/// The body of `QueryAllReply`: what a server says of its interface. Directions are as the **automation** sees them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Interface {
    /// Who answers: base64 as it travels.
    pub server_name: String,
    pub result: ResultCode,
    /// What the automation reads: the plant's reports.
    pub inputs: Vec<InterfaceSignal>,
    /// What the automation sets: the plant's commands.
    pub outputs: Vec<InterfaceSignal>,
}

/// One signal of an [`Interface`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InterfaceSignal {
    pub name: String,
    /// The type as the server writes it; `REAL`, `REAL[16]` if it spells as the standard does.
    pub ty: String,
}

/// The `result` of a reply: an HTTP status code by the reference's words ("HTTP OK code to indicate no errors").
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ResultCode(pub i64);

impl ResultCode {
    /// Accepted.
    pub const OK: ResultCode = ResultCode(200);
    /// No signal, or no session, of that name.
    pub const NOT_FOUND: ResultCode = ResultCode(404);
    /// Another client, or another of this client's sessions, is in the way.
    pub const CONFLICT: ResultCode = ResultCode(409);
    /// A value of another type than the signal's.
    pub const WRONG_TYPE: ResultCode = ResultCode(415);
    /// A value of the right type that the signal cannot have.
    pub const WRONG_VALUE: ResultCode = ResultCode(422);

    /// 200, and nothing else.
    pub const fn is_accepted(self) -> bool {
        self.0 == 200
    }

    /// 400 to 499: worth another try.
    pub const fn is_temporary(self) -> bool {
        self.0 >= 400 && self.0 <= 499
    }

    /// 500 to 599: no use in trying again.
    pub const fn is_permanent(self) -> bool {
        self.0 >= 500 && self.0 <= 599
    }
}

impl fmt::Display for ResultCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}
