//! The two sides of the bank: values in, values out.

use std::ops::Range;
use std::sync::Arc;

use crate::signal_map::{Kind, RateClass, RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::{Value, push_reserved};

use super::ring::{Consumer, Producer, ring};
use super::sync::Cell;
use super::triple::{Reader, Writer, triple};
use super::words::{Layout, Place, append, decode, decode_to, encode};

/// How many entries the queue of messages and the log of edges hold each. An entry is one value of one signal.
pub const CAPACITY: usize = 65_536;

/// The most words (of 8 bytes) either of them takes, 32 MiB: a plant whose signals are long texts or arrays reaches
/// this before [`CAPACITY`].
const MOST_WORDS: usize = 1 << 22;

/// A staged message begins with how many entries it has. Each entry is its register's id and its value's words.
const MESSAGE_HEADER: usize = 1;

/// A group in the log of edges begins with its number (1 for the first there was), its instant, and how many entries
/// it has. Each entry is its register's id and its value's words.
const GROUP_HEADER: usize = 3;

/// A cycle begins with its instant, and with how many groups and how many entries the log was given so far, those that
/// it had no room for included.
const CYCLE_HEADER: usize = 3;

/// So many words between two that changed are copied with them: a cache line.
const NEAR: usize = 8;

/// The bank for the signals of `map`: the simulation thread's side and the IO thread's.
pub fn new(map: &SignalMap) -> (SimulationSide, IoSide) {
    with_capacity(map, CAPACITY, MOST_WORDS)
}

/// A bank whose queue and log hold `capacity` entries each, in at most `most_words` words.
pub(crate) fn with_capacity(map: &SignalMap, capacity: usize, most_words: usize) -> (SimulationSide, IoSide) {
    let layout = Arc::new(Layout::new(map));
    // Room for `capacity` records of one entry each, as long as the longest of them may be.
    let room = |places: &mut dyn Iterator<Item = &Place>, header: usize| {
        let longest = places.map(|place| place.words() + 1).max().unwrap_or(1);
        (capacity * (header + longest)).min(most_words)
    };
    let (staged, queue) = ring(room(&mut layout.commands(), MESSAGE_HEADER), capacity);
    let edges = layout.reports.iter().filter(|place| place.kind == Kind::Edge);
    let (log, edges) = ring(room(&mut edges.into_iter(), GROUP_HEADER), capacity);
    let words = layout.report_words();
    let (out, cycle) = triple(CYCLE_HEADER + words);
    let simulation = SimulationSide {
        queue,
        takes: 0,
        messages: 0,
        marks: vec![Mark::default(); layout.registers()],
        cycle: vec![0; CYCLE_HEADER + words],
        changed: Vec::new(),
        started: false,
        group: Vec::new(),
        groups: 0,
        entries: 0,
        log,
        out,
        layout: layout.clone(),
    };
    let io = IoSide {
        staged,
        messages: 0,
        record: Vec::new(),
        cycle,
        published: false,
        log: edges,
        groups: 0,
        entries: 0,
        sent: vec![0; words],
        layout,
    };
    (simulation, io)
}

/// The queue of messages has no room for one more; the message was not staged. Its sender must learn of the loss: close
/// the connection and say so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no room for a message of {entries} values: the simulation has not taken those before it, and the queue holds {CAPACITY}"
)]
pub struct Full {
    /// The values that were lost with it.
    pub entries: usize,
}

/// The log of edges overflowed since it was last read: from here on there is a hole in it. Close the connection, count
/// the loss, and after the next connect start anew with [`IoSide::all_outputs`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("lost {lost} changes of signals: they came faster than they could be sent, and the log holds {CAPACITY}")]
pub struct Overrun {
    /// The entries that will not be seen.
    pub lost: u64,
}

/// What changed about the edge signals in one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Changes {
    /// The step.
    pub at: Instant,
    /// What changed, in the order of the registers.
    pub values: Vec<(RegisterId, Value)>,
}

/// When a command register was last set.
#[derive(Clone, Copy, Debug, Default)]
struct Mark {
    /// In which call of `take`; 0 for never.
    take: u64,
    /// At which place of that call's inputs.
    place: usize,
}

/// The simulation thread's side.
pub struct SimulationSide {
    layout: Arc<Layout>,
    queue: Consumer,
    takes: u64,
    messages: u64,
    marks: Vec<Mark>,
    /// The cycle as last published: its header, and the words of all report registers.
    cycle: Vec<u64>,
    /// What changed about it, as runs of words.
    changed: Vec<Range<usize>>,
    started: bool,
    group: Vec<u64>,
    groups: u64,
    entries: u64,
    log: Producer,
    out: Writer,
}

impl SimulationSide {
    /// Takes the commands of this step into `inputs` (cleared first): whole messages in the order they were staged, up
    /// to the first that would set a signal already set in this step. That one and all after it wait.
    ///
    /// Gives the number of the last message taken, `None` if there was none. Within one message the last value of a
    /// signal wins; a signal therefore stands in `inputs` once.
    pub fn take(&mut self, inputs: &mut Vec<(RegisterId, Value)>) -> Option<u64> {
        inputs.clear();
        self.takes += 1;
        let before = self.messages;
        self.queue.refresh();
        // The first sets nothing again.
        while self.queue.available() > 0 && (self.messages == before || !self.sets_again()) {
            self.take_message(inputs);
            self.messages += 1;
        }
        (self.messages > before).then_some(self.messages)
    }

    /// Whether the message at the head of the queue sets a signal that was set in this step.
    fn sets_again(&self) -> bool {
        let mut at = MESSAGE_HEADER;
        (0..self.queue.word(0)).any(|_| {
            let place = command(&self.layout, RegisterId(self.queue.word(at) as u32));
            at += 1 + place.words();
            self.marks[place.id.index()].take == self.takes
        })
    }

    fn take_message(&mut self, inputs: &mut Vec<(RegisterId, Value)>) {
        let entries = self.queue.word(0);
        inputs.reserve(entries as usize);
        let mut at = MESSAGE_HEADER;
        for _ in 0..entries {
            let place = command(&self.layout, RegisterId(self.queue.word(at) as u32));
            let word = |word| self.queue.word(at + 1 + word);
            let mark = &mut self.marks[place.id.index()];
            if mark.take == self.takes {
                inputs[mark.place].1 = decode(place.ty, word);
            } else {
                *mark = Mark { take: self.takes, place: inputs.len() };
                decode_to(place.ty, word, |value| push_reserved(inputs, (place.id, value)));
            }
            at += 1 + place.words();
        }
        self.queue.release(at, entries);
    }

    /// Publishes the cycle of step `now`. `registers` holds the values of all registers by id; those of commands are
    /// not looked at.
    ///
    /// Gives whether there is something to send at once: an edge signal changed, or this is the first cycle. Wake the
    /// IO thread then.
    pub fn publish(&mut self, now: Instant, registers: &[Value]) -> bool {
        let layout = Arc::clone(&self.layout);
        self.publish_places(now, registers, layout.reports.iter())
    }

    /// As [`publish`](Self::publish), at the cost of what changed: none but the registers in `changed`, which stand there in
    /// the order of their ids, has another value than at the call before. The first cycle looks at all.
    pub fn publish_changed(&mut self, now: Instant, registers: &[Value], changed: &[RegisterId]) -> bool {
        if !self.started {
            return self.publish(now, registers);
        }
        let layout = Arc::clone(&self.layout);
        self.publish_places(now, registers, changed.iter().filter_map(|id| layout.report(*id)))
    }

    fn publish_places<'p>(
        &mut self,
        now: Instant,
        registers: &[Value],
        places: impl Iterator<Item = &'p Place>,
    ) -> bool {
        let edges = self.update(registers, places);
        let news = edges > 0 || !self.started;
        self.started = true;
        if edges > 0 {
            self.groups += 1;
            self.entries += edges;
            self.group[..GROUP_HEADER].copy_from_slice(&[self.groups, now.nanos() as u64, edges]);
            // A group without room leaves a hole in the numbers: that is how the reader learns of it.
            self.log.push(&self.group, edges);
        }
        // After the log: whoever has this cycle in hand finds all its groups there.
        self.cycle[..CYCLE_HEADER].copy_from_slice(&[now.nanos() as u64, self.groups, self.entries]);
        self.out.publish(&self.cycle, &self.changed);
        news
    }

    /// Brings the cycle up to date as far as `places` go, notes which of its words changed, puts what changed about edge
    /// signals into the group, and says how many did.
    fn update<'p>(&mut self, registers: &[Value], places: impl Iterator<Item = &'p Place>) -> u64 {
        assert_eq!(registers.len(), self.layout.registers(), "one value for every register of the signals map");
        self.group.clear();
        self.group.resize(GROUP_HEADER, 0);
        self.changed.clear();
        self.changed.push(0..CYCLE_HEADER);
        let mut edges = 0;
        for place in places {
            let run = CYCLE_HEADER + place.start()..CYCLE_HEADER + place.start() + place.words();
            let words = &mut self.cycle[run.clone()];
            if !encode(place.ty, &registers[place.id.index()], words) {
                continue;
            }
            if self.started && place.kind == Kind::Edge {
                self.group.push(u64::from(place.id.0));
                match words {
                    [word] => self.group.push(*word),
                    words => self.group.extend_from_slice(words),
                }
                edges += 1;
            }
            match self.changed.last_mut() {
                // What lies near one another is one run: to copy a few words more is cheaper than to begin anew.
                Some(last) if last.end <= run.start && run.start - last.end <= NEAR => last.end = run.end,
                _ => self.changed.push(run),
            }
        }
        edges
    }
}

/// The place of a command that was staged.
fn command(layout: &Layout, id: RegisterId) -> &Place {
    layout.command(id).unwrap_or_else(|| unreachable!("register {} is no command", id.0))
}

/// The IO thread's side.
pub struct IoSide {
    layout: Arc<Layout>,
    staged: Producer,
    messages: u64,
    record: Vec<u64>,
    cycle: Reader,
    /// Whether a cycle is in hand.
    published: bool,
    log: Consumer,
    /// The number of the last group that was read, superseded or lost.
    groups: u64,
    /// The entries up to that group.
    entries: u64,
    /// The words of all report registers as last given out by `levels` and `all_outputs`.
    sent: Vec<u64>,
}

impl IoSide {
    /// Stages one message for the simulation, whole, and gives its number: 1 for the first. An empty message counts too.
    ///
    /// All registers are commands, and their values of their signals' types: the session saw to that.
    pub fn stage(&mut self, values: &[(RegisterId, Value)]) -> Result<u64, Full> {
        self.record.clear();
        self.record.push(values.len() as u64);
        for (id, value) in values {
            let place = command(&self.layout, *id);
            self.record.push(u64::from(id.0));
            append(place, value, &mut self.record);
        }
        if !self.staged.push(&self.record, values.len() as u64) {
            return Err(Full { entries: values.len() });
        }
        self.messages += 1;
        Ok(self.messages)
    }

    /// Takes the newest cycle in hand, and puts what changed about edge signals since the last call into `out` (cleared
    /// first): one group for each step in which something did, in order, none skipped. Gives the cycle's instant, at or
    /// after the last group's; `None` while nothing was published.
    ///
    /// # Errors
    /// The log overflowed: `out` holds the groups before the hole, and all after it up to this cycle are lost. Said once
    /// for each overflow; the next call goes on after it.
    pub fn changed(&mut self, out: &mut Vec<Changes>) -> Result<Option<Instant>, Overrun> {
        out.clear();
        self.published |= self.cycle.refresh();
        let Some(cycle) = self.snapshot().map(|snapshot| snapshot.at()) else { return Ok(None) };
        let (groups, entries) = (self.cycle.word(1), self.cycle.word(2));
        if self.groups == groups {
            return Ok(Some(cycle));
        }
        self.log.refresh();
        // Groups newer than the cycle in hand stay: what is sent keeps the order of time, levels and edges together.
        while self.log.available() > 0 && self.log.word(0) == self.groups + 1 && self.groups < groups {
            out.push(self.read_group());
        }
        if self.groups == groups {
            return Ok(Some(cycle));
        }
        let lost = entries - self.entries;
        self.skip_to_cycle();
        Err(Overrun { lost })
    }

    /// Reads the group at the head of the log.
    fn read_group(&mut self) -> Changes {
        let (number, at, entries) = (self.log.word(0), self.log.word(1), self.log.word(2));
        let mut values = Vec::with_capacity(entries as usize);
        let mut word = GROUP_HEADER;
        for _ in 0..entries {
            let place = self.logged(word);
            decode_to(place.ty, |i| self.log.word(word + 1 + i), |value| push_reserved(&mut values, (place.id, value)));
            word += 1 + place.words();
        }
        self.log.release(word, entries);
        self.groups = number;
        self.entries += entries;
        Changes { at: Instant::from_nanos(at as i64), values }
    }

    /// The place of the register whose id is the log's word `at`.
    fn logged(&self, at: usize) -> &Place {
        let id = RegisterId(self.log.word(at) as u32);
        self.layout.report(id).unwrap_or_else(|| unreachable!("register {} is no report", id.0))
    }

    /// Drops all groups up to the cycle in hand.
    fn skip_to_cycle(&mut self) {
        self.log.refresh();
        self.groups = self.cycle.word(1);
        self.entries = self.cycle.word(2);
        while self.log.available() > 0 && self.log.word(0) <= self.groups {
            let entries = self.log.word(2);
            let words = (0..entries).fold(GROUP_HEADER, |word, _| word + 1 + self.logged(word).words());
            self.log.release(words, entries);
        }
    }

    /// Appends to `out` all level signals of rate class `rate` whose value in the cycle in hand is not the one last
    /// given out, and gives the cycle's instant; `None` while nothing was published.
    ///
    /// The cycle in hand is that of the last [`changed`](Self::changed): call it first, and send its groups first.
    pub fn levels(&mut self, rate: RateClass, out: &mut Vec<(RegisterId, Value)>) -> Option<Instant> {
        let at = self.snapshot()?.at();
        let cells = &self.cycle.cells()[CYCLE_HEADER..];
        for place in self.layout.levels(rate) {
            let run = place.start()..place.start() + place.words();
            let (cells, sent) = (&cells[run.clone()], &mut self.sent[run]);
            let is_new = match (cells, &mut *sent) {
                // As nearly every signal is.
                ([cell], [word]) => renew(cell, word),
                _ => cells.iter().zip(sent.iter_mut()).fold(false, |new, (cell, word)| renew(cell, word) | new),
            };
            if is_new {
                out.reserve(1);
                decode_to(place.ty, |word| sent[word], |value| push_reserved(out, (place.id, value)));
            }
        }
        Some(at)
    }

    /// Takes the newest cycle in hand and puts all its values into `out` (cleared first): the first message after a
    /// connect. Gives the cycle's instant; `None` while nothing was published (the first publication wakes: ask again).
    ///
    /// It makes up for every edge before it, an overflow of the log included: those are dropped, and what
    /// [`changed`](Self::changed) and [`levels`](Self::levels) give next are changes against it.
    pub fn all_outputs(&mut self, out: &mut Vec<(RegisterId, Value)>) -> Option<Instant> {
        out.clear();
        self.published |= self.cycle.refresh();
        let at = self.snapshot()?.at();
        self.skip_to_cycle();
        for (i, word) in self.sent.iter_mut().enumerate() {
            *word = self.cycle.word(CYCLE_HEADER + i);
        }
        out.extend(self.snapshot()?.iter());
        Some(at)
    }

    /// The cycle in hand: that of the last [`changed`](Self::changed) or [`all_outputs`](Self::all_outputs), the newest
    /// then. `None` while nothing was published.
    pub fn snapshot(&self) -> Option<Snapshot<'_>> {
        self.published.then_some(Snapshot { side: self })
    }
}

/// Brings a word up to date and says whether it was not.
fn renew(cell: &Cell, word: &mut u64) -> bool {
    let now = cell.read();
    std::mem::replace(word, now) != now
}

/// One cycle: all report registers as one step published them.
#[derive(Clone, Copy)]
pub struct Snapshot<'a> {
    side: &'a IoSide,
}

impl Snapshot<'_> {
    /// The step.
    pub fn at(&self) -> Instant {
        Instant::from_nanos(self.side.cycle.word(0) as i64)
    }

    /// The value of report register `id`; `None` if it is none.
    pub fn value(&self, id: RegisterId) -> Option<Value> {
        self.side.layout.report(id).map(|place| self.read(place))
    }

    /// All report registers in the order of their ids.
    pub fn iter(&self) -> impl Iterator<Item = (RegisterId, Value)> {
        self.side.layout.reports.iter().map(|place| (place.id, self.read(place)))
    }

    fn read(&self, place: &Place) -> Value {
        decode(place.ty, |word| self.side.cycle.word(CYCLE_HEADER + place.start() + word))
    }
}
