//! The first reading of a trace: is it whole, whom does it speak of, where is it blind?

use std::collections::BTreeMap;
use std::io::BufRead;
use std::time::Duration;

use crate::signal_map::{Direction, Kind, RateClass, SignalMap};
use crate::time::Instant;
use crate::trace::{Body, Header, Line, Reader, Sender, TraceError};
use crate::wire::Message;

/// What a first reading found.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    header: Header,
    lines: u64,
    ends: Instant,
    torn: Option<String>,
    /// Signals that stand in the trace and are left out, each with the reason.
    ignored: BTreeMap<String, String>,
    /// Last reports before a new connection: nobody recorded from there to the next report.
    blind: Vec<Instant>,
    last_report: Option<Instant>,
    /// How often levels were reported, by rate class.
    rhythms: [Rhythm; 2],
}

/// How often something was reported.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Rhythm {
    reports: u32,
    first: Instant,
    last: Instant,
}

impl Rhythm {
    fn beat(&mut self, at: Instant) {
        if self.reports == 0 {
            self.first = at;
        }
        if self.reports == 0 || self.last != at {
            self.reports = self.reports.saturating_add(1);
        }
        self.last = at;
    }

    /// The mean time between two reports; nothing of fewer than two.
    fn interval(&self) -> Duration {
        self.last.since(self.first) / self.reports.saturating_sub(1).max(1)
    }
}

impl Survey {
    /// Reads a trace to its end. `map` is that of the plant it is to be replayed on.
    ///
    /// # Errors
    /// Whatever a [`Reader`] finds: malformed lines, a time that goes back.
    pub fn of<R: BufRead>(map: &SignalMap, mut reader: Reader<R>) -> Result<Survey, TraceError> {
        let mut survey = Survey {
            header: reader.header().clone(),
            lines: 0,
            ends: Instant::ZERO,
            torn: None,
            ignored: BTreeMap::new(),
            blind: Vec::new(),
            last_report: None,
            rhythms: [Rhythm::default(); 2],
        };
        while let Some(line) = reader.next_line()? {
            survey.line(map, &line);
        }
        survey.torn = reader.torn().map(ToString::to_string);
        Ok(survey)
    }

    /// What the trace says about itself.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How many lines there are, the header not counted.
    pub fn lines(&self) -> u64 {
        self.lines
    }

    /// The time of the last line.
    pub fn ends(&self) -> Instant {
        self.ends
    }

    /// What was lost with a torn last line.
    pub fn torn(&self) -> Option<&str> {
        self.torn.as_deref()
    }

    /// The signals of the trace that are left out, each with the reason, by name.
    pub fn ignored(&self) -> &BTreeMap<String, String> {
        &self.ignored
    }

    /// The mean time between two reports of levels of this rate class; nothing if there are not two.
    pub(super) fn interval(&self, rate: RateClass) -> Duration {
        self.rhythms[rate as usize].interval()
    }

    pub(super) fn blind(&self) -> &[Instant] {
        &self.blind
    }

    fn line(&mut self, map: &SignalMap, line: &Line<'_>) {
        self.lines += 1;
        self.ends = line.at;
        match (&line.body, line.from) {
            (Body::Message(Message::SendValue(entries)), from) => {
                for name in entries.iter().filter_map(|entry| entry.name.as_deref()) {
                    self.check(map, name, from);
                    self.listen(map, name, line.at);
                }
                if from == Sender::Plant {
                    self.last_report = Some(line.at);
                }
            }
            // A new session: what changed since the last report of the one before was reported to nobody.
            (Body::Message(Message::Connect(connect)), Sender::Plant) if connect.enable => {
                self.blind.extend(self.last_report.take());
            }
            _ => {}
        }
    }

    fn listen(&mut self, map: &SignalMap, name: &str, at: Instant) {
        let signal = map.register(name).map(|id| map.signal(id));
        if let Some(signal) = signal.filter(|s| s.direction == Direction::Report && s.kind == Kind::Level) {
            self.rhythms[signal.rate as usize].beat(at);
        }
    }

    fn check(&mut self, map: &SignalMap, name: &str, from: Sender) {
        let reason = match map.register(name).map(|id| map.signal(id).direction) {
            Some(Direction::Command) if from == Sender::Plant => "a command that the plant reported",
            // The session refuses this one; the notices of the replay say so.
            Some(_) => return,
            None => "the model has no such signal",
        };
        if !self.ignored.contains_key(name) {
            self.ignored.insert(name.to_owned(), reason.to_owned());
        }
    }
}
