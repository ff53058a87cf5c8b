//! Lines → trace.

use std::io::{self, Write};

use crate::time::Instant;
use crate::wire::members;

use super::header::{Header, write_header};
use super::reader::Sender;
use super::seconds::write_seconds;

/// Whether a trace is compressed as it is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// `*.cps.jsonl`
    #[default]
    None,
    /// `*.cps.jsonl.zst`
    Zstd,
}

impl Compression {
    /// What a file of this name has: by its ending, `.zst` or not.
    pub fn of(file: &str) -> Compression {
        if file.ends_with(".zst") { Compression::Zstd } else { Compression::None }
    }
}

enum Output<W: Write> {
    Plain(W),
    Zstd(Box<zstd::Encoder<'static, W>>),
}

impl<W: Write> Write for Output<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Output::Plain(out) => out.write(bytes),
            Output::Zstd(out) => out.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Output::Plain(out) => out.flush(),
            Output::Zstd(out) => out.flush(),
        }
    }
}

/// Writes a trace. Each line is one `write`: hand in a buffered writer where that costs.
pub struct Writer<W: Write> {
    out: Output<W>,
    line: String,
    last: Instant,
}

impl<W: Write> Writer<W> {
    /// Begins a trace: writes `header`.
    pub fn new(out: W, compression: Compression, header: &Header) -> io::Result<Writer<W>> {
        let out = match compression {
            Compression::None => Output::Plain(out),
            Compression::Zstd => Output::Zstd(Box::new(zstd::Encoder::new(out, zstd::DEFAULT_COMPRESSION_LEVEL)?)),
        };
        let mut writer = Writer { out, line: write_header(header), last: Instant::ZERO };
        writer.end_line()?;
        Ok(writer)
    }

    /// Writes a message of the protocol: `text` is one object with one key, `{"SendValue":[…]}`, on one line.
    ///
    /// A time before that of the line before is a bug of the caller's; the line is stamped with that time then.
    pub fn message(&mut self, at: Instant, from: Sender, text: &str) -> io::Result<()> {
        self.begin_line(at, from);
        let text = text.trim();
        debug_assert!(text.starts_with('{') && !text.contains(['\n', '\r']), "a message on one line: {text}");
        self.line.push_str(text.get(1..).unwrap_or_default());
        self.end_line()
    }

    /// Writes whatever was received in place of a message. What is an object with one key stands as it came, like any
    /// message; what is not cannot stand in a line, and becomes the string of a member `Unreadable`.
    pub fn received(&mut self, at: Instant, from: Sender, text: &str) -> io::Result<()> {
        let one_key = members(text).ok().filter(|members| members.len() == 1);
        let reserved = ["t", "from", "Event"];
        if one_key.is_some_and(|members| !reserved.contains(&&*members[0].0)) && !text.contains(['\n', '\r']) {
            return self.message(at, from, text);
        }
        self.begin_line(at, from);
        self.line.push_str("\"Unreadable\":");
        self.line.push_str(&serde_json::to_string(text)?);
        self.line.push('}');
        self.end_line()
    }

    /// Writes what an operator did or the engine saw: `event` is one JSON object on one line.
    pub fn event(&mut self, at: Instant, from: Sender, event: &str) -> io::Result<()> {
        self.begin_line(at, from);
        self.line.push_str("\"Event\":");
        self.line.push_str(event);
        self.line.push('}');
        self.end_line()
    }

    /// Writes a line of another trace as it stands.
    pub(crate) fn line(&mut self, at: Instant, text: &str) -> io::Result<()> {
        self.last = self.last.max(at);
        self.line.push_str(text);
        self.end_line()
    }

    /// Hands all lines so far on, so that they outlive a crash. (A compressed trace grows by each call.)
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }

    /// Ends the trace and gives the writer back. A compressed trace that is not ended so reads as torn.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        match self.out {
            Output::Plain(out) => Ok(out),
            Output::Zstd(out) => {
                let mut out = out.finish()?;
                out.flush()?;
                Ok(out)
            }
        }
    }

    fn begin_line(&mut self, at: Instant, from: Sender) {
        debug_assert!(at >= self.last, "a trace's time never goes back: {at} after {}", self.last);
        self.last = self.last.max(at);
        self.line.push_str("{\"t\":");
        write_seconds(&mut self.line, self.last);
        self.line.push_str(",\"from\":\"");
        self.line.push_str(from.name());
        self.line.push_str("\",");
    }

    fn end_line(&mut self) -> io::Result<()> {
        self.line.push('\n');
        let written = self.out.write_all(self.line.as_bytes());
        self.line.clear();
        written
    }
}
