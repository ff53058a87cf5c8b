//! Trace → lines, one at a time.

use std::borrow::Cow;
use std::fmt;
use std::io::{self, BufRead, BufReader, Chain, Cursor, Read};

use crate::time::Instant;
use crate::wire::{DecodeError, Message, Raw, ScanError, members};

use super::header::{Header, read_header};
use super::seconds::read_seconds;

/// The longest line read, in bytes: 64 times the default limit of a message. What is longer is no trace.
pub const LINE_LIMIT: usize = 64 * 1024 * 1024;

/// The bytes that a zstd frame begins with (RFC 8878, section 3.1.1).
const ZSTD_MAGIC: [u8; 4] = [0x28, 0xB5, 0x2F, 0xFD];

/// Why a trace could not be read.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    /// The file could not be read.
    #[error("failed to read {file}")]
    Read {
        file: String,
        #[source]
        source: io::Error,
    },
    /// A line, not the last and torn, is no line of a trace. Lines and columns (characters) count from 1.
    #[error("{file}:{line}:{column}: {problem}")]
    Malformed { file: String, line: u64, column: usize, problem: String },
}

/// Who sent a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Sender {
    /// The automation: commands.
    Automation,
    /// Somebody at the simulation's controls: forcing, a part put in or taken out, a pause.
    Operator,
    /// The simulation about itself: a collision.
    Engine,
    /// The plant, or the simulation in its place: reports.
    Plant,
}

impl Sender {
    const ALL: [Sender; 4] = [Sender::Automation, Sender::Operator, Sender::Engine, Sender::Plant];

    /// The word in a line's `from`.
    pub const fn name(self) -> &'static str {
        match self {
            Sender::Automation => "automation",
            Sender::Operator => "operator",
            Sender::Engine => "engine",
            Sender::Plant => "plant",
        }
    }
}

impl fmt::Display for Sender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What a line holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Body<'a> {
    /// A message of the protocol.
    Message(Message<'a>),
    /// A message that its receiver refused as a whole: of no type of the protocol, or with a body that its type does not
    /// have. Recorded as it came, and skipped.
    Refused {
        /// Why, for people.
        reason: String,
    },
    /// What an operator did, or the engine saw.
    Event(Raw<'a>),
}

/// One line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line<'a> {
    /// Its number in the file; the header is line 1.
    pub number: u64,
    /// Its time, `t`.
    pub at: Instant,
    pub from: Sender,
    pub body: Body<'a>,
    /// The whole line as it stands.
    pub text: &'a str,
}

/// A last line that a recorder did not end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Torn {
    /// Its number.
    pub line: u64,
    /// Why it is no line.
    pub problem: String,
}

impl fmt::Display for Torn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, the last, is torn and was left out: {}", self.line, self.problem)
    }
}

type Peeked<R> = Chain<Cursor<Vec<u8>>, R>;

enum Input<R: BufRead> {
    Plain(Peeked<R>),
    Zstd(Box<BufReader<zstd::Decoder<'static, Peeked<R>>>>),
}

impl<R: BufRead> Input<R> {
    fn new(mut input: R) -> io::Result<Input<R>> {
        let mut first = Vec::with_capacity(ZSTD_MAGIC.len());
        input.by_ref().take(ZSTD_MAGIC.len() as u64).read_to_end(&mut first)?;
        let compressed = first == ZSTD_MAGIC;
        let input = Cursor::new(first).chain(input);
        Ok(match compressed {
            false => Input::Plain(input),
            true => Input::Zstd(Box::new(BufReader::new(zstd::Decoder::with_buffer(input)?))),
        })
    }

    fn read_until_break(&mut self, line: &mut Vec<u8>) -> io::Result<usize> {
        match self {
            Input::Plain(input) => input.take(LINE_LIMIT as u64 + 1).read_until(b'\n', line),
            Input::Zstd(input) => input.take(LINE_LIMIT as u64 + 1).read_until(b'\n', line),
        }
    }
}

/// Reads a trace line by line, in constant memory.
pub struct Reader<R: BufRead> {
    file: String,
    input: Input<R>,
    header: Header,
    line: Vec<u8>,
    number: u64,
    last: Instant,
    torn: Option<Torn>,
}

impl<R: BufRead> Reader<R> {
    /// Begins to read `input`, compressed with zstd or not, and reads its header. `file` is what errors call it.
    pub fn new(file: impl Into<String>, input: R) -> Result<Reader<R>, TraceError> {
        let file = file.into();
        let input = match Input::new(input) {
            Ok(input) => input,
            Err(source) => return Err(TraceError::Read { file, source }),
        };
        let last = Instant::from_nanos(0);
        let header = Header::default();
        let mut reader = Reader { file, input, header, line: Vec::new(), number: 0, last, torn: None };
        if reader.fill()? == Filled::Nothing {
            return Err(reader.malformed(1, "an empty file: expected the header of a trace".to_owned()));
        }
        let line = std::str::from_utf8(&reader.line).map_err(|_| reader.malformed(1, NOT_UTF8.to_owned()))?;
        reader.header = read_header(line).map_err(|(column, problem)| reader.malformed(column, problem))?;
        Ok(reader)
    }

    /// What the trace says about itself.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The last line, if it was torn. Known once [`next_line`](Self::next_line) gave `None`.
    pub fn torn(&self) -> Option<&Torn> {
        self.torn.as_ref()
    }

    /// The next line; `None` at the end.
    pub fn next_line(&mut self) -> Result<Option<Line<'_>>, TraceError> {
        if self.torn.is_some() {
            return Ok(None);
        }
        let filled = self.fill()?;
        if filled == Filled::Nothing {
            return Ok(None);
        }
        match parse(&self.line, self.last) {
            Ok((at, from, body, text)) => {
                self.last = at;
                Ok(Some(Line { number: self.number, at, from, body, text }))
            }
            Err(problem) => {
                if filled == Filled::Torn {
                    self.torn = Some(Torn { line: self.number, problem: problem.text });
                    return Ok(None);
                }
                Err(self.malformed(problem.column(&self.line), problem.text))
            }
        }
    }

    /// Reads a line into the buffer, without its break.
    fn fill(&mut self) -> Result<Filled, TraceError> {
        self.line.clear();
        self.number += 1;
        let read = self.input.read_until_break(&mut self.line);
        match read {
            // A compressed file that ends in the middle of a frame: its recorder died.
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                if self.number == 1 {
                    return Err(self.malformed(1, "the compressed file is cut short in its header".to_owned()));
                }
                if self.line.is_empty() {
                    self.torn =
                        Some(Torn { line: self.number, problem: "the compressed file is cut short".to_owned() });
                    return Ok(Filled::Nothing);
                }
                Ok(Filled::Torn)
            }
            Err(source) => Err(TraceError::Read { file: self.file.clone(), source }),
            Ok(0) => Ok(Filled::Nothing),
            Ok(_) if self.line.last() == Some(&b'\n') => {
                self.line.pop();
                Ok(Filled::Whole)
            }
            Ok(length) if length > LINE_LIMIT => {
                Err(self.malformed(1, format!("a line of more than {LINE_LIMIT} bytes: this is no trace")))
            }
            Ok(_) => Ok(Filled::Torn),
        }
    }

    fn malformed(&self, column: usize, problem: String) -> TraceError {
        TraceError::Malformed { file: self.file.clone(), line: self.number, column, problem }
    }
}

const NOT_UTF8: &str = "bytes that are not UTF-8";

/// What is in the buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Filled {
    /// Nothing: the file has ended.
    Nothing,
    /// A line that ended with a line break.
    Whole,
    /// A line that ended with the file. It may be whole all the same.
    Torn,
}

/// What is wrong with a line, and at which byte.
struct Problem {
    at: usize,
    text: String,
}

impl Problem {
    /// The character, from 1, that the byte belongs to.
    fn column(&self, line: &[u8]) -> usize {
        String::from_utf8_lossy(&line[..self.at.min(line.len())]).chars().count() + 1
    }
}

fn problem<T>(at: usize, text: impl Into<String>) -> Result<T, Problem> {
    Err(Problem { at, text: text.into() })
}

type Parsed<'a> = (Instant, Sender, Body<'a>, &'a str);

fn parse(line: &[u8], last: Instant) -> Result<Parsed<'_>, Problem> {
    let text = match std::str::from_utf8(line) {
        Ok(text) => text,
        Err(error) => return problem(error.valid_up_to(), NOT_UTF8),
    };
    let members = match members(text) {
        Ok(members) => members,
        Err(DecodeError::Json(error)) => return problem(place(&error), reason(&error)),
        Err(_) => return problem(0, "expected an object, {\"t\":…,\"from\":…,\"SendValue\":[…]}"),
    };
    let at = time(text, find(&members, "t"), last)?;
    let from = sender(text, find(&members, "from"))?;
    // The first `t` and `from` are the line's own; what a recorder put behind them is the message.
    let rest = members.iter().filter(|(name, _)| !["t", "from"].contains(&&**name));
    let body = body(text, from, rest)?;
    Ok((at, from, body, text))
}

fn find<'a>(members: &[(Cow<'_, str>, Raw<'a>)], wanted: &str) -> Option<Raw<'a>> {
    members.iter().find(|(name, _)| name == wanted).map(|(_, value)| *value)
}

/// Where `part`, which was borrowed from `line`, begins in it.
fn offset(line: &str, part: Raw<'_>) -> usize {
    (part.text().as_ptr() as usize).saturating_sub(line.as_ptr() as usize)
}

fn time(line: &str, member: Option<Raw<'_>>, last: Instant) -> Result<Instant, Problem> {
    let Some(raw) = member else { return problem(0, "no time: expected \"t\", seconds since the start") };
    let at = offset(line, raw);
    let Some(time) = raw.as_number().and_then(read_seconds) else {
        return problem(at, format!("\"t\" is {}: expected seconds since the start", raw.described()));
    };
    if time < Instant::ZERO {
        return problem(at, format!("\"t\" is {}, before the start: expected seconds since the start", raw.text()));
    }
    if time < last {
        let before = last.seconds();
        return problem(at, format!("time goes back: \"t\" is {} after a line at {before}", raw.text()));
    }
    Ok(time)
}

fn sender(line: &str, member: Option<Raw<'_>>) -> Result<Sender, Problem> {
    let expected = || Sender::ALL.map(Sender::name).join(", ");
    let Some(raw) = member else { return problem(0, format!("no sender: expected \"from\", one of {}", expected())) };
    let found = raw.as_str().and_then(|word| Sender::ALL.into_iter().find(|sender| sender.name() == word));
    match found {
        Some(sender) => Ok(sender),
        None => problem(offset(line, raw), format!("\"from\" is {}: expected one of {}", raw.described(), expected())),
    }
}

/// The messages that may stand in a line, and `Event`.
const NAMES: [&str; 8] =
    ["SendValue", "SendValueReply", "Connect", "ConnectReply", "ConnectionReply", "QueryAll", "QueryAllReply", "Event"];

fn body<'l, 'a: 'l>(
    line: &str,
    from: Sender,
    rest: impl Iterator<Item = &'l (Cow<'a, str>, Raw<'a>)> + Clone,
) -> Result<Body<'a>, Problem> {
    let mut known = rest.clone().filter(|(name, _)| NAMES.contains(&&**name));
    let (name, raw) = match (known.next(), known.next()) {
        (Some(one), None) => one,
        (Some((first, _)), Some((second, raw))) => {
            return problem(offset(line, *raw), format!("two messages in one line, {first} and {second}"));
        }
        (None, _) => match rest.clone().next() {
            Some((name, _)) => return Ok(Body::Refused { reason: format!("{name:?} is no message of the protocol") }),
            None => return problem(0, "no message: expected \"SendValue\", another message, or \"Event\""),
        },
    };
    if name == "Event" {
        return Ok(Body::Event(*raw));
    }
    if !matches!(from, Sender::Automation | Sender::Plant) {
        return problem(offset(line, *raw), format!("the {from} sends \"Event\", found {name:?}"));
    }
    Ok(match Message::from_member(name, *raw) {
        Ok(message) => Body::Message(message),
        Err(error) => Body::Refused { reason: error.to_string() },
    })
}

fn place(error: &ScanError) -> usize {
    match error {
        ScanError::Syntax { at, .. } | ScanError::TooDeep { at } => *at,
    }
}

/// The error without its place, which stands in the column.
fn reason(error: &ScanError) -> String {
    match error {
        ScanError::Syntax { expected, found, .. } => format!("malformed JSON: expected {expected}, found {found}"),
        ScanError::TooDeep { .. } => "JSON nested too deep".to_owned(),
    }
}
