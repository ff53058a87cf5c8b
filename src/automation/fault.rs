//! Misbehaviour on demand: what a real runtime does on a bad day, so that a simulation can be shown to bear it.
//!
//! [`Faulty`] lies between the automation and its transport and has the automation's shape; without faults it changes
//! nothing. Like the automation it does no IO and reads no clock, and what it picks by chance follows from a seed.

use std::collections::{BTreeSet, VecDeque};
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Automation, ConnectionId, Output};
use crate::session::Input;
use crate::signal_map::Direction;
use crate::time::{Instant, format_duration, parse_duration};
use crate::value::{ElementaryType, Value};
use crate::wire::{ResultCode, SendValueText};

/// A way to misbehave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Everything leaves so much later.
    Late(Duration),
    /// Handling a message takes so long, one after the other.
    Slow(Duration),
    /// Every `SendValue` holds one more entry, of a known signal and a wrong type.
    WrongType,
    /// Every `SendValue` holds one more entry, of a signal that does not exist.
    UnknownName,
    /// Every connection breaks off, without a word, so long after it was opened.
    Drop(Duration),
    /// Every `Connect` is refused with this result.
    Refuse(i64),
    /// Connections are taken, and nothing is ever said.
    Silent,
    /// Every `SendValue` is followed by something that is no message.
    Garbage,
    /// The first `SendValue` is followed by a message of 100 MB.
    Huge,
}

/// How long the message of [`Fault::Huge`] is, bytes.
pub const HUGE_BYTES: usize = 100_000_000;

/// A text that names no fault.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseFaultError {
    #[error(
        "{found:?} is no fault: expected late:MS, slow:MS, wrong-type, unknown-name, drop:S, refuse:CODE, silent, garbage or huge"
    )]
    Unknown { found: String },
    #[error("{found:?} is no fault: {kind} needs {needs}")]
    Argument { found: String, kind: &'static str, needs: &'static str },
}

impl FromStr for Fault {
    type Err = ParseFaultError;

    /// Reads a fault as `nxt-mock --fault` takes it: `late:200` (milliseconds), `drop:5` (seconds), `refuse:503`. Times
    /// may also be written with their unit: `late:200ms`, `drop:1.5s`.
    fn from_str(text: &str) -> Result<Fault, ParseFaultError> {
        let (kind, argument) = text.split_once(':').map_or((text, None), |(kind, argument)| (kind, Some(argument)));
        let refuse = |kind, needs| ParseFaultError::Argument { found: text.to_owned(), kind, needs };
        // A plain number is in the unit that the command line fixes for this fault.
        let time = |unit: &str| {
            let argument = argument?;
            parse_duration(argument).or_else(|_| parse_duration(&format!("{argument}{unit}"))).ok()
        };
        match (kind, argument) {
            ("late", _) => time("ms").map(Fault::Late).ok_or_else(|| refuse("late", "milliseconds, as late:200")),
            ("slow", _) => time("ms").map(Fault::Slow).ok_or_else(|| refuse("slow", "milliseconds, as slow:50")),
            ("drop", _) => {
                let after = time("s").filter(|after| !after.is_zero());
                after.map(Fault::Drop).ok_or_else(|| refuse("drop", "seconds above 0, as drop:5"))
            }
            ("refuse", _) => {
                let code = argument.and_then(|code| code.parse().ok()).filter(|code| (400..600).contains(code));
                code.map(Fault::Refuse).ok_or_else(|| refuse("refuse", "a result from 400 to 599, as refuse:503"))
            }
            ("wrong-type", None) => Ok(Fault::WrongType),
            ("unknown-name", None) => Ok(Fault::UnknownName),
            ("silent", None) => Ok(Fault::Silent),
            ("garbage", None) => Ok(Fault::Garbage),
            ("huge", None) => Ok(Fault::Huge),
            _ => Err(ParseFaultError::Unknown { found: text.to_owned() }),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Late(span) => write!(f, "late:{}", format_duration(*span)),
            Fault::Slow(span) => write!(f, "slow:{}", format_duration(*span)),
            Fault::WrongType => f.write_str("wrong-type"),
            Fault::UnknownName => f.write_str("unknown-name"),
            Fault::Drop(span) => write!(f, "drop:{}", format_duration(*span)),
            Fault::Refuse(code) => write!(f, "refuse:{code}"),
            Fault::Silent => f.write_str("silent"),
            Fault::Garbage => f.write_str("garbage"),
            Fault::Huge => f.write_str("huge"),
        }
    }
}

/// What a faulty automation wants done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Delivery {
    /// Send this text message.
    Text { connection: ConnectionId, text: String },
    /// Send this binary message.
    Binary { connection: ConnectionId, bytes: Vec<u8> },
    /// Close the connection with this WebSocket status code and reason.
    Close { connection: ConnectionId, code: u16, reason: String },
    /// Drop the connection without a word.
    Abort { connection: ConnectionId },
}

impl Delivery {
    /// The connection it is for.
    pub fn connection(&self) -> ConnectionId {
        match *self {
            Delivery::Text { connection, .. }
            | Delivery::Binary { connection, .. }
            | Delivery::Close { connection, .. }
            | Delivery::Abort { connection } => connection,
        }
    }
}

/// What came in, kept until it is handled.
#[derive(Debug)]
enum Arrival {
    Opened,
    Text(String),
    Binary,
    InvalidUtf8,
    TooLong { limit: usize },
    Closed,
}

impl Arrival {
    fn keep(input: Input<'_>) -> Option<Arrival> {
        Some(match input {
            Input::Opened => Arrival::Opened,
            Input::Text(text) => Arrival::Text(text.to_owned()),
            Input::Binary => Arrival::Binary,
            Input::InvalidUtf8 => Arrival::InvalidUtf8,
            Input::TooLong { limit } => Arrival::TooLong { limit },
            Input::Closed => Arrival::Closed,
            Input::Timeout => return None,
        })
    }

    fn input(&self) -> Input<'_> {
        match self {
            Arrival::Opened => Input::Opened,
            Arrival::Text(text) => Input::Text(text),
            Arrival::Binary => Input::Binary,
            Arrival::InvalidUtf8 => Input::InvalidUtf8,
            Arrival::TooLong { limit } => Input::TooLong { limit: *limit },
            Arrival::Closed => Input::Closed,
        }
    }
}

/// Past so many messages that wait to be handled, no more should be read: see [`Faulty::is_congested`].
const MOST_WAITING: usize = 1_024;

/// An automation that misbehaves as told. Drive it as an [`Automation`].
pub struct Faulty {
    automation: Automation,
    late: Duration,
    slow: Option<Duration>,
    drop_after: Option<Duration>,
    wrong_type: bool,
    unknown_name: bool,
    silent: bool,
    garbage: bool,
    /// A huge message is still to be sent.
    huge: bool,
    random: ChaCha8Rng,
    /// What waits to be handled, and when the first of it will have been.
    waiting: VecDeque<(ConnectionId, Arrival)>,
    handled_at: Option<Instant>,
    /// What waits to leave, and when each may; due instants never fall.
    leaving: VecDeque<(Instant, Delivery)>,
    ready: VecDeque<Delivery>,
    drops: BTreeSet<(Instant, ConnectionId)>,
}

impl Faulty {
    /// `automation` with `faults`; of two faults of one kind the later counts. Chance follows from `seed`.
    pub fn new(mut automation: Automation, faults: &[Fault], seed: u64) -> Faulty {
        let (mut late, mut slow, mut drop_after) = (Duration::ZERO, None, None);
        for fault in faults {
            match *fault {
                Fault::Late(span) => late = span,
                Fault::Slow(span) => slow = Some(span),
                Fault::Drop(span) => drop_after = Some(span),
                Fault::Refuse(code) => {
                    automation.refuse(Some((ResultCode(code), "refused, as the fault asks".to_owned())));
                }
                _ => {}
            }
        }
        let has = |fault| faults.contains(&fault);
        Faulty {
            late,
            slow,
            drop_after,
            wrong_type: has(Fault::WrongType),
            unknown_name: has(Fault::UnknownName),
            silent: has(Fault::Silent),
            garbage: has(Fault::Garbage),
            huge: has(Fault::Huge),
            automation,
            random: ChaCha8Rng::seed_from_u64(seed),
            waiting: VecDeque::new(),
            handled_at: None,
            leaving: VecDeque::new(),
            ready: VecDeque::new(),
            drops: BTreeSet::new(),
        }
    }

    /// The automation.
    pub fn automation(&self) -> &Automation {
        &self.automation
    }

    /// Whether so much waits to be handled that its owner should leave messages unread until there is room.
    pub fn is_congested(&self) -> bool {
        self.waiting.len() >= MOST_WAITING
    }

    /// Takes what happened on a connection.
    pub fn handle(&mut self, now: Instant, connection: ConnectionId, input: Input<'_>) {
        if let (Input::Opened, Some(after)) = (input, self.drop_after) {
            self.drops.insert((now + after, connection));
        }
        match (self.slow, Arrival::keep(input)) {
            (Some(slow), Some(arrival)) => {
                self.waiting.push_back((connection, arrival));
                self.handled_at.get_or_insert(now + slow);
                self.catch_up(now);
            }
            _ => self.automation.handle(now, connection, input),
        }
        self.collect(now);
    }

    /// The instant that [`timeout`](Faulty::timeout) named has come. Called too early, it does nothing.
    pub fn wake(&mut self, now: Instant) {
        while let Some(&(due, connection)) = self.drops.first()
            && due <= now
        {
            self.drops.pop_first();
            self.abort(now, connection);
        }
        self.catch_up(now);
        self.automation.wake(now);
        self.collect(now);
    }

    /// Ends every connection with this WebSocket status code and reason, at once, whatever the faults.
    pub fn close(&mut self, now: Instant, code: u16, reason: &str) {
        self.late = Duration::ZERO;
        self.silent = false;
        self.automation.close(now, code, reason);
        self.collect(now);
    }

    /// What to do next; `None` when all is said.
    pub fn poll(&mut self) -> Option<Delivery> {
        self.ready.pop_front()
    }

    /// When [`wake`](Faulty::wake) is due; `None` if nothing is awaited.
    pub fn timeout(&self) -> Option<Instant> {
        let leaving = self.leaving.front().map(|(due, _)| *due);
        let drop = self.drops.first().map(|(due, _)| *due);
        [self.automation.timeout(), self.handled_at, leaving, drop].into_iter().flatten().min()
    }

    /// Hands on what has waited long enough.
    fn catch_up(&mut self, now: Instant) {
        while let (Some(slow), Some(due)) = (self.slow, self.handled_at)
            && due <= now
        {
            if let Some((connection, arrival)) = self.waiting.pop_front() {
                self.automation.handle(due, connection, arrival.input());
            }
            self.handled_at = (!self.waiting.is_empty()).then_some(due + slow);
        }
    }

    /// Breaks a connection off.
    fn abort(&mut self, now: Instant, connection: ConnectionId) {
        tracing::info!(target: "automation", "{now:>11} fault: connection {} breaks off", connection.0);
        self.waiting.retain(|(other, _)| *other != connection);
        if self.waiting.is_empty() {
            self.handled_at = None;
        }
        self.leaving.retain(|(_, delivery)| delivery.connection() != connection);
        self.ready.push_back(Delivery::Abort { connection });
        self.automation.handle(now, connection, Input::Closed);
    }

    /// Spoils what the automation says, and lets go what is due.
    fn collect(&mut self, now: Instant) {
        while let Some(output) = self.automation.poll() {
            let due = now + self.late;
            match output {
                _ if self.silent => {}
                Output::Close { connection, code, reason } => {
                    self.leaving.push_back((due, Delivery::Close { connection, code, reason }));
                }
                Output::Transmit { connection, text } => self.transmit(due, connection, text),
            }
        }
        while let Some((_, delivery)) = self.leaving.pop_front_if(|(due, _)| *due <= now) {
            self.ready.push_back(delivery);
        }
    }

    fn transmit(&mut self, due: Instant, connection: ConnectionId, mut text: String) {
        let values = text.starts_with(SEND_VALUE);
        if values {
            if self.wrong_type
                && let Some(entry) = self.entry_of_wrong_type()
            {
                append(&mut text, &entry);
            }
            if self.unknown_name {
                append(&mut text, &entry("NoSuchInstance.noSuchSignal", &Value::Bool(true)));
            }
        }
        self.leaving.push_back((due, Delivery::Text { connection, text }));
        if values && self.garbage {
            let garbage = self.some_garbage(connection);
            self.leaving.push_back((due, garbage));
        }
        if values && std::mem::take(&mut self.huge) {
            let text = format!("{SEND_VALUE}{{\"name\":\"{}\"}}]}}", "x".repeat(HUGE_BYTES));
            self.leaving.push_back((due, Delivery::Text { connection, text }));
        }
    }

    fn pick(&mut self, of: usize) -> usize {
        self.random.next_u32() as usize % of
    }

    /// An entry of some command whose value has a JSON type that the command does not take.
    fn entry_of_wrong_type(&mut self) -> Option<String> {
        let commands = self.automation.map().directed(Direction::Command).count();
        if commands == 0 {
            return None;
        }
        let place = self.pick(commands);
        let (_, signal) = self.automation.map().directed(Direction::Command).nth(place)?;
        let wrong = match signal.ty.element {
            ElementaryType::Bool => Value::Real(0.5),
            _ => Value::Bool(true),
        };
        Some(entry(&signal.name, &wrong))
    }

    fn some_garbage(&mut self, connection: ConnectionId) -> Delivery {
        let place = self.pick(GARBAGE.len() + 1);
        match GARBAGE.get(place) {
            Some(text) => Delivery::Text { connection, text: (*text).to_owned() },
            None => Delivery::Binary { connection, bytes: vec![0xDE, 0xAD, 0xBE, 0xEF] },
        }
    }
}

/// What is no message, in several ways.
const GARBAGE: &[&str] = &[
    "",
    "hello?",
    "{\"SendValue\":[{\"name\":\"Bel",
    "[1,2,3]",
    "{\"SendValue\":[],\"QueryAll\":{}}",
    "{\"NoSuchMessage\":{}}",
    "{\"SendValue\":[{\"value\":1},{\"name\":7,\"value\":1},null,[]]}",
    "{\"SendValue\":[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    "{\"ConnectReply\":{\"Id\":\"c29tZW9uZSBlbHNl\",\"enable\":true,\"ServerName\":\"PyM=\",\"result\":200}}",
];

/// How a `SendValue` of ours begins.
const SEND_VALUE: &str = "{\"SendValue\":[";

/// The text of one entry. Empty for a value that has no JSON form; the callers' have.
fn entry(name: &str, value: &Value) -> String {
    let mut text = SendValueText::with_capacity(1);
    if text.push(name, value).is_err() {
        return String::new();
    }
    let text = text.finish().unwrap_or_default();
    let inside = text.strip_prefix(SEND_VALUE).and_then(|rest| rest.strip_suffix("]}"));
    inside.unwrap_or_default().to_owned()
}

/// Adds an entry to a `SendValue` of ours.
fn append(text: &mut String, entry: &str) {
    let end = text.len() - "]}".len();
    let comma = if text[..end].ends_with('[') { "" } else { "," };
    text.insert_str(end, &format!("{comma}{entry}"));
}
