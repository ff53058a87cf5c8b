//! The automation's side of a recorded trace: its commands again, word by word, at their recorded times.
//!
//! The trace is read as it is played, so that its length does not matter. Its time 0 is the moment at which the first
//! simulation connects. What the simulation reports is not looked at.

use std::fs::File;
use std::io::BufReader;
use std::iter::Peekable;
use std::path::PathBuf;
use std::sync::Arc;

use super::network::{Context, Program};
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::Instant;
use crate::trace::{Body, Reader, Sender, TraceError};
use crate::value::Value;
use crate::wire::{Entry, Message, TextForm, members, read_value};

/// What the automation once sent: when, since the start of the trace, and the message as it was: `{"SendValue":[…]}`.
pub type Line = (Instant, String);

/// The automation's lines of a trace, in order of time; the text of an error says where in the trace it is.
pub type Lines = Box<dyn Iterator<Item = Result<Line, String>> + Send>;

/// Opens the trace from its beginning.
pub type Opener = dyn FnMut() -> Result<Lines, String> + Send;

/// The trace at `path`, `*.cps.jsonl` or `*.cps.jsonl.zst`.
pub fn of_file(path: PathBuf) -> Box<Opener> {
    Box::new(move || {
        let name = path.display().to_string();
        let file = File::open(&path).map_err(|error| format!("failed to read {name}: {error}"))?;
        let reader = Reader::new(name, BufReader::new(file)).map_err(|error| told(&error))?;
        Ok(Box::new(OfReader(reader)) as Lines)
    })
}

/// The automation's lines of a trace. Handshakes are left out: the sessions of today make their own.
struct OfReader(Reader<BufReader<File>>);

impl Iterator for OfReader {
    type Item = Result<Line, String>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let line = match self.0.next_line() {
                Ok(line) => line?,
                Err(error) => return Some(Err(told(&error))),
            };
            let played = match line.body {
                Body::Message(Message::SendValue(_)) | Body::Refused { .. } => line.from == Sender::Automation,
                _ => false,
            };
            if let (true, Some(text)) = (played, message(line.text)) {
                return Some(Ok((line.at, text)));
            }
        }
    }
}

/// The message in a line of a trace: the line without its time and its sender, or the text that could not stand in it.
fn message(line: &str) -> Option<String> {
    let members = members(line).ok()?;
    let (name, body) = members.iter().find(|(name, _)| !["t", "from"].contains(&name.as_ref()))?;
    if name == "Unreadable" {
        return body.as_str().map(|text| text.into_owned());
    }
    Some(format!("{{\"{name}\":{}}}", body.text()))
}

fn told(error: &TraceError) -> String {
    match error {
        TraceError::Read { source, .. } => format!("{error}: {source}"),
        TraceError::Malformed { .. } => error.to_string(),
    }
}

/// A trace that cannot be played.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("failed to play a trace: {0}")]
pub struct PlaybackError(String);

/// A program that plays a trace.
pub struct Playback {
    map: Arc<SignalMap>,
    lines: Peekable<Lines>,
    start: Instant,
    played: u64,
    over: bool,
}

impl Playback {
    /// Plays the trace that `open` gives, from its beginning.
    pub fn open(open: &mut Opener, map: Arc<SignalMap>) -> Result<Playback, PlaybackError> {
        let lines = open().map_err(PlaybackError)?.peekable();
        Ok(Playback { map, lines, start: Instant::ZERO, played: 0, over: false })
    }

    /// The next line if it is due at `now`, and asks to be woken for the one that is not.
    fn due(&mut self, cx: &mut Context<'_>) -> Option<Line> {
        if self.over {
            return None;
        }
        let due = match self.lines.peek() {
            Some(Ok((at, _))) => self.start + at.since(Instant::ZERO),
            Some(Err(_)) => cx.now,
            None => {
                self.over = true;
                cx.decided("playback", "END", format_args!("the trace is over after {} messages", self.played));
                return None;
            }
        };
        if due > cx.now {
            cx.wake_at(due);
            return None;
        }
        match self.lines.next()? {
            Ok(line) => {
                self.played += 1;
                Some(line)
            }
            Err(error) => {
                self.over = true;
                cx.warned("playback", "ERROR", format_args!("the rest of the trace cannot be played: {error}"));
                None
            }
        }
    }
}

impl Program for Playback {
    /// A first line at time 0 becomes the values that the simulation receives when it connects: a recording begins with
    /// them. Were it sent after them, it would act one step later than it did.
    fn start(&mut self, cx: &mut Context<'_>) {
        self.start = cx.now;
        cx.decided("playback", "COLD", "the trace begins");
        if let Some(Ok((Instant::ZERO, _))) = self.lines.peek()
            && let Some((_, text)) = self.due(cx)
        {
            for (register, value) in commands(&self.map, &text) {
                cx.set_value(register, value);
            }
        }
        cx.wake_at(cx.now);
    }

    fn event(&mut self, cx: &mut Context<'_>) {
        while let Some((at, text)) = self.due(cx) {
            cx.noted("playback", "LINE", format_args!("recorded at {at}"));
            let sets = commands(&self.map, &text);
            cx.send_verbatim(text, sets);
        }
    }
}

/// The good values of a message: what a simulation will hold after it. The rest it refuses now as it did then.
fn commands(map: &SignalMap, text: &str) -> Vec<(RegisterId, Value)> {
    let Ok(Message::SendValue(entries)) = Message::decode(text) else { return Vec::new() };
    let value = |entry: &Entry<'_>| {
        let register = map.register(entry.name.as_deref()?)?;
        let signal = map.signal(register);
        let value = read_value(entry.value?, signal.ty, TextForm::Base64).ok()?;
        let number = value.to_f64();
        let within =
            number.is_none_or(|n| signal.min.is_none_or(|min| n >= min) && signal.max.is_none_or(|max| n <= max));
        (signal.direction == Direction::Command && within).then_some((register, value))
    };
    entries.iter().filter_map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(trace: &str) -> Vec<Result<Line, String>> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.cps.jsonl");
        std::fs::write(&path, trace).expect("written");
        let lines: Vec<_> = of_file(path)().expect("opened").collect();
        let name = folder.path().display().to_string();
        lines.into_iter().map(|line| line.map_err(|error| error.replace(&name, ""))).collect()
    }

    fn at(seconds: f64, text: &str) -> Result<Line, String> {
        Ok((Instant::from_seconds(seconds), text.to_owned()))
    }

    #[test]
    fn the_automations_lines_are_played_and_no_others() {
        let trace = r#"{"trace":"kinetwin/1"}
{"t":0,"from":"plant","Connect":{"Id":"b25l","enable":true}}
{"t":0,"from":"automation","ConnectReply":{"Id":"b25l","enable":true,"ServerName":"eA==","result":200}}
{"t":0.5,"from":"automation","SendValue":[{"name":"A.x","value":1.50}, {"name":"A.y","value":true}]}
{"t":0.5,"from":"plant","SendValue":[{"name":"A.z","value":1}]}
{"t":0.6,"from":"automation","NoSuchMessage":{"a":[1]}}
{"t":0.7,"from":"automation","Unreadable":"hello \"there\""}
{"t":0.8,"from":"operator","Event":{}}
"#;
        let expected = [
            at(0.5, r#"{"SendValue":[{"name":"A.x","value":1.50}, {"name":"A.y","value":true}]}"#),
            at(0.6, r#"{"NoSuchMessage":{"a":[1]}}"#),
            at(0.7, "hello \"there\""),
        ];
        assert_eq!(lines(trace), expected);
    }

    #[test]
    fn a_malformed_line_is_told_with_its_place() {
        let trace = "{\"trace\":\"kinetwin/1\"}\n{\"t\":0,\"from\":\"nobody\",\"SendValue\":[]}\n{}\n";
        let told = lines(trace).remove(0).expect_err("an error");
        assert!(told.starts_with("/a.cps.jsonl:2:15: \"from\" is"), "{told}");
    }

    #[test]
    fn a_trace_that_is_not_there_is_told_at_the_start() {
        let map = Arc::new(SignalMap::new("p", Vec::new()).expect("no name twice"));
        let error = Playback::open(&mut of_file(PathBuf::from("no/such.cps.jsonl")), map).err().expect("an error");
        let told = error.to_string();
        assert!(told.starts_with("failed to play a trace: failed to read no/such.cps.jsonl: No such file"), "{told}");
    }
}
