//! Two threads' knowledge → one trace.
//!
//! The IO thread knows what was said, the simulation thread knows when it counted: a command's time is that of the step
//! that took it, a report's that of the step that produced it. Both send [`Record`]s into a channel, and whoever holds
//! its other end feeds them to a [`Recorder`]; nobody waits for it. (The simulation's may come through a channel of their
//! own, if that is emptied before each record of the IO thread's.)
//!
//! # Order
//!
//! Lines are written in the order of time, the automation's first among equals. What holds that together:
//!
//! - The simulation thread sends [`Record::Taken`] and [`Record::Event`] of a step before it publishes that step's cycle,
//!   and in the order of time.
//! - The IO thread sends [`Record::Staged`] right after the bank staged the message, and sends a report after it saw the
//!   report's cycle; its reports are in the order of time too.
//!
//! So when a report of step `t` comes out of the channel, all commands taken up to `t` have come out before it: they are
//! written, then the report. Commands taken later wait, because reports of earlier steps may follow, and so do commands
//! whose message has not come out yet: nothing that the IO thread sent before it belongs behind it. Nothing else is ever
//! reordered, and what waits is at most what the simulation took while the IO thread slept.

use std::collections::VecDeque;
use std::io::{self, Write};

use crate::time::Instant;

use super::reader::Sender;
use super::writer::Writer;

/// One piece of knowledge for a [`Recorder`].
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// IO thread: the bank staged a message of the automation's under this number.
    Staged { number: u64, text: String },
    /// Simulation thread: the step at `at` took the messages up to this number.
    Taken { at: Instant, number: u64 },
    /// IO thread: this `SendValue` was sent; its values are those of the cycle at `at`.
    Reported { at: Instant, text: String },
    /// IO thread: all reports before the cycle at `at` have been sent. Says that time goes on where nothing else does.
    Reached { at: Instant },
    /// IO thread: any other message, received or sent, a refused one included. It stands at the cycle last heard of.
    Exchanged { from: Sender, text: String },
    /// Simulation thread: what an operator did or the engine saw in the step at `at`; `event` is one JSON object.
    Event { at: Instant, from: Sender, event: String },
}

/// Joins the records of a run into its trace.
pub struct Recorder<W: Write> {
    writer: Writer<W>,
    /// Messages that were staged and not yet taken, or taken and not yet written.
    staged: VecDeque<(u64, String)>,
    /// The number of the last message that was staged.
    last_staged: u64,
    taken: VecDeque<(Instant, u64)>,
    events: VecDeque<(Instant, Sender, String)>,
    /// The time of the last line, or of the cycle last heard of from the IO thread.
    reached: Instant,
}

impl<W: Write> Recorder<W> {
    /// A recorder that writes to `writer`.
    pub fn new(writer: Writer<W>) -> Recorder<W> {
        Recorder {
            writer,
            staged: VecDeque::new(),
            last_staged: 0,
            taken: VecDeque::new(),
            events: VecDeque::new(),
            reached: Instant::ZERO,
        }
    }

    /// Takes the next record out of the channel.
    pub fn record(&mut self, record: Record) -> io::Result<()> {
        match record {
            Record::Staged { number, text } => {
                self.staged.push_back((number, text));
                self.last_staged = number;
            }
            Record::Taken { at, number } => self.taken.push_back((at, number)),
            Record::Event { at, from, event } => self.events.push_back((at, from, event)),
            Record::Reached { at } => self.write_until(at)?,
            Record::Reported { at, text } => {
                self.write_until(at)?;
                self.writer.message(self.reached, Sender::Plant, &text)?;
            }
            Record::Exchanged { from, text } => {
                self.write_until(self.reached)?;
                self.writer.received(self.reached, from, &text)?;
            }
        }
        Ok(())
    }

    /// Writes what the simulation thread told up to `until`.
    fn write_until(&mut self, until: Instant) -> io::Result<()> {
        self.reached = self.reached.max(until);
        loop {
            let taken = self.taken.front().filter(|(at, _)| *at <= until);
            if taken.is_some_and(|(_, number)| *number > self.last_staged) {
                return Ok(());
            }
            let taken = taken.map(|(at, _)| *at);
            let event = self.events.front().map(|(at, ..)| *at).filter(|at| *at <= until);
            match (taken, event) {
                (None, None) => return Ok(()),
                (Some(taken), event) if event.is_none_or(|event| taken <= event) => self.write_taken()?,
                _ => self.write_event()?,
            }
        }
    }

    fn write_taken(&mut self) -> io::Result<()> {
        let Some((at, last)) = self.taken.pop_front() else { return Ok(()) };
        while self.staged.front().is_some_and(|(number, _)| *number <= last) {
            if let Some((_, text)) = self.staged.pop_front() {
                self.writer.message(at, Sender::Automation, &text)?;
            }
        }
        Ok(())
    }

    fn write_event(&mut self) -> io::Result<()> {
        match self.events.pop_front() {
            Some((at, from, event)) => self.writer.event(at, from, &event),
            None => Ok(()),
        }
    }

    /// Hands all lines so far on, so that they outlive a crash.
    pub fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }

    /// Writes what still waits and ends the trace. Messages that no step took are left out: they never acted.
    pub fn finish(mut self) -> io::Result<W> {
        self.last_staged = u64::MAX;
        self.write_until(Instant::FAR)?;
        self.writer.finish()
    }
}
