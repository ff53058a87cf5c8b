//! The automation's side of a recorded trace: its commands again, word by word, at their recorded times.
//!
//! The trace is read as it is played, so that its length does not matter. Its time 0 is the moment at which the first
//! simulation connects. What the simulation reports is not looked at.

use std::iter::Peekable;
use std::sync::Arc;

use super::network::{Context, Program};
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;
use crate::wire::{Message, TextForm, read_value};

/// What the automation once sent: when, since the start of the trace, and the message as it was: `{"SendValue":[…]}`.
pub type Line = (Instant, String);

/// The automation's lines of a trace, in order of time; the text of an error says where in the trace it is.
pub type Lines = Box<dyn Iterator<Item = Result<Line, String>> + Send>;

/// Opens the trace from its beginning.
pub type Opener = dyn FnMut() -> Result<Lines, String> + Send;

/// A trace that cannot be played.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("failed to play the trace: {0}")]
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
    let value = |entry: &crate::wire::Entry<'_>| {
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
