//! Values in both directions, the same for either end: from the entries of a `SendValue` to registers and values, fault
//! by fault, and from registers and values to a `SendValue`.

use std::sync::Arc;

use memchr::memchr2;

use super::Staged;
use crate::signal_map::{Direction, RegisterId, Signal, SignalMap};
use crate::value::{ElementaryType, Quantity, SignalType, Unit, Value, push_reserved};
use crate::wire::{Entry, Fault, Message, Raw, ResultCode, SendValueText, TextForm, read_value};

/// The longest `SendValueReply` sent, in bytes: half the limit of a peer that keeps the default. A message of a megabyte
/// with nothing but faults must not be answered with four.
const REPLY_LIMIT_BYTES: usize = 512 * 1024;

/// How many unknown names of one message are looked up among similar ones; for each, every name is compared.
const SUGGESTIONS_PER_MESSAGE: usize = 8;

/// One end of the exchange.
#[derive(Debug)]
pub(crate) struct Exchange {
    map: Arc<SignalMap>,
    /// The direction of the signals that this end sets.
    ours: Direction,
    /// By register.
    rows: Vec<Row>,
    /// What the entries of all registers begin with, one after the other.
    heads: String,
    messages: u64,
    /// The register that the last message began with.
    first: u32,
    /// How many values the last message had.
    common: usize,
}

/// What is looked at for every value, close together: a plant has hundreds of signals, and a cycle is long enough for a
/// processor to forget them all.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Where the beginning of its entry in a message stands in `heads`.
    head: (u32, u32),
    /// The register that followed it in the last message that held it: a peer says its signals in the same order again and
    /// again, and comparing a name is faster than looking it up.
    next: u32,
    /// The number of the last message that held a good value of it, and that value's place.
    message: u64,
    place: u32,
    ty: SignalType,
    is_ours: bool,
    /// Whether its signal declares a range.
    is_bounded: bool,
}

/// What became of one `SendValue`.
#[derive(Debug)]
pub(crate) struct Receipt {
    /// What it brought; or, if it brought nothing, why.
    pub(crate) outcome: Result<Staged, String>,
    /// The `SendValueReply` that it deserves.
    pub(super) reply: Option<String>,
    /// How many entries had no name; they cannot be answered.
    pub(super) nameless: usize,
}

/// What is to be sent.
#[derive(Debug)]
pub(super) struct Sending {
    pub(super) text: Option<String>,
    /// Values that have no JSON form, with a sentence each.
    pub(super) unsendable: Vec<(RegisterId, String)>,
}

impl Exchange {
    pub(crate) fn new(map: Arc<SignalMap>, ours: Direction) -> Exchange {
        let mut heads = String::new();
        let row = |(index, signal): (usize, &Signal)| {
            let start = heads.len() as u32;
            heads.push_str(&SendValueText::begin(&signal.name));
            Row {
                head: (start, heads.len() as u32),
                next: index as u32 + 1,
                message: 0,
                place: 0,
                ty: signal.ty,
                is_ours: signal.direction == ours,
                is_bounded: signal.min.is_some() || signal.max.is_some(),
            }
        };
        let rows = map.signals().iter().enumerate().map(row).collect();
        Exchange { map, ours, rows, heads, messages: 0, first: 0, common: 0 }
    }

    /// What the entry of a register begins with.
    fn head(&self, row: &Row) -> &str {
        &self.heads[row.head.0 as usize..row.head.1 as usize]
    }

    pub(super) fn map(&self) -> &SignalMap {
        &self.map
    }

    /// Reads the entries of a `SendValue` whose text is `text`.
    pub(crate) fn receive(&mut self, text: &str, entries: &[Entry<'_>]) -> Receipt {
        self.messages += 1;
        let mut values: Vec<(RegisterId, Value)> = Vec::with_capacity(entries.len());
        let mut faults = Vec::new();
        let mut nameless = 0;
        let mut suggestions = SUGGESTIONS_PER_MESSAGE;
        let mut last = None;
        for entry in entries {
            let Some(name) = &entry.name else {
                nameless += 1;
                continue;
            };
            match self.entry(name, entry, &mut last, &mut suggestions) {
                Err((result, message)) => faults.push(Fault { name: name.to_string(), result, message }),
                Ok((register, value)) => {
                    let row = &mut self.rows[register.index()];
                    if row.message == self.messages {
                        values[row.place as usize].1 = value;
                    } else {
                        (row.message, row.place) = (self.messages, values.len() as u32);
                        values.push((register, value));
                    }
                }
            }
        }
        let reply = (!faults.is_empty()).then(|| reply(&faults));
        let outcome = match values.is_empty() {
            false => Ok(Staged { values, text: one_line(text), faults }),
            true => Err(rejection(&faults, nameless)),
        };
        Receipt { outcome, reply, nameless }
    }

    /// As [`receive`](Self::receive), of a message that is spelt as this project spells one, is free of faults, and sets no
    /// signal twice: what nearly every message is. `None` where it is not, or holds more than `limit` values.
    ///
    /// One pass over the text: what an entry begins with is compared with what it begins with where this end writes it.
    pub(super) fn receive_plain(&mut self, text: &str, limit: usize) -> Option<Staged> {
        let mut rest = text.strip_prefix(SendValueText::HEAD)?;
        self.messages += 1;
        let mut values = Vec::with_capacity(self.common);
        let mut last = None;
        loop {
            let guess = self.guess(last);
            let begins = |row: &Row| rest.strip_prefix(self.head(row));
            let (register, value) = match self.rows.get(guess.index()).and_then(begins) {
                Some(value) => (guess, value),
                None => {
                    let register = self.map.register(plain_name(rest)?)?;
                    (register, begins(&self.rows[register.index()])?)
                }
            };
            self.follow(register, &mut last);
            let row = &mut self.rows[register.index()];
            let seen = std::mem::replace(&mut row.message, self.messages);
            row.place = values.len() as u32;
            if row.is_ours || seen == self.messages || values.len() == limit {
                return None;
            }
            // Most signals of a plant are these, and nothing but two words is one.
            values.reserve(1);
            let after = if row.ty != SignalType::scalar(ElementaryType::Bool) || row.is_bounded {
                let (raw, after) = Raw::leading(value)?;
                let value = read_value(raw, row.ty, TextForm::Base64).ok()?;
                if row.is_bounded {
                    within_range(self.map.signal(register), &value).ok()?;
                }
                values.push((register, value));
                after
            } else if let Some(after) = value.strip_prefix("true") {
                push_reserved(&mut values, (register, Value::Bool(true)));
                after
            } else {
                push_reserved(&mut values, (register, Value::Bool(false)));
                value.strip_prefix("false")?
            };
            let after = after.strip_prefix('}')?;
            match after.strip_prefix(',') {
                Some(after) => rest = after,
                None if after == "]}" => break,
                None => return None,
            }
        }
        self.common = values.len();
        Some(Staged { values, text: one_line(text), faults: Vec::new() })
    }

    /// The register that probably follows `last`, or that a message probably begins with.
    fn guess(&self, last: Option<RegisterId>) -> RegisterId {
        RegisterId(last.map_or(self.first, |last| self.rows[last.index()].next))
    }

    /// Remembers that `register` followed `last`, or that the message began with it; it is the last from now on.
    fn follow(&mut self, register: RegisterId, last: &mut Option<RegisterId>) {
        match last.replace(register) {
            Some(last) => self.rows[last.index()].next = register.0,
            None => self.first = register.0,
        }
    }

    /// The register of the signal called `name`, after that of the entry before it.
    fn look_up(&mut self, name: &str, last: &mut Option<RegisterId>) -> Option<RegisterId> {
        let guess = self.guess(*last);
        let guessed = self.map.signals().get(guess.index()).is_some_and(|signal| signal.name == name);
        let register = if guessed { guess } else { self.map.register(name)? };
        self.follow(register, last);
        Some(register)
    }

    fn entry(
        &mut self,
        name: &str,
        entry: &Entry<'_>,
        last: &mut Option<RegisterId>,
        suggestions: &mut usize,
    ) -> Result<(RegisterId, Value), (ResultCode, String)> {
        let Some(register) = self.look_up(name, last) else {
            let similar = (*suggestions > 0).then(|| similar(&self.map, name)).flatten();
            *suggestions = suggestions.saturating_sub(1);
            let hint = similar.map(|name| format!("; did you mean {name:?}?")).unwrap_or_default();
            return Err((ResultCode::NOT_FOUND, format!("no signal of this name{hint}")));
        };
        let signal = self.map.signal(register);
        if signal.direction == self.ours {
            let whose = match self.ours {
                Direction::Report => "reported by the simulation",
                Direction::Command => "set by the automation",
            };
            return Err((ResultCode::NOT_FOUND, whose.to_owned()));
        }
        let Some(raw) = entry.value else {
            return Err((ResultCode::WRONG_TYPE, format!("expected {}, found no value", signal.ty)));
        };
        let value = read_value(raw, signal.ty, TextForm::Base64).map_err(|unfit| (unfit.result, unfit.message))?;
        within_range(signal, &value).map_err(|message| (ResultCode::WRONG_VALUE, message))?;
        Ok((register, value))
    }

    /// Writes a `SendValue` of those of `values` that this end sets and that have a JSON form.
    pub(super) fn send<'v>(&self, values: impl ExactSizeIterator<Item = &'v (RegisterId, Value)>) -> Sending {
        let mut text = SendValueText::with_capacity(values.len());
        let mut unsendable = Vec::new();
        for (register, value) in values {
            let row = &self.rows[register.index()];
            let name = || &self.map.signal(*register).name;
            if !row.is_ours {
                unsendable.push((*register, format!("{} is the other side's to set, and was not sent", name())));
            } else if let Err(error) = text.push_begun(self.head(row), value) {
                unsendable.push((*register, format!("{} was not sent: {error}", name())));
            }
        }
        Sending { text: text.finish(), unsendable }
    }
}

/// The name in an entry that `text` begins with, where it is written without an escape.
fn plain_name(text: &str) -> Option<&str> {
    text.strip_prefix("{\"name\":\"")?.split_once('"').map(|(name, _)| name)
}

/// A message as one line, so that it can stand in a trace. Within JSON, a line break stands only where a blank may.
pub(super) fn one_line(text: &str) -> String {
    let text = text.trim();
    match memchr2(b'\n', b'\r', text.as_bytes()) {
        Some(_) => text.replace(['\n', '\r'], " "),
        None => text.to_owned(),
    }
}

/// Why a message brought no value.
fn rejection(faults: &[Fault], nameless: usize) -> String {
    match (faults.first(), faults.len(), nameless) {
        (None, _, 0) => "the message holds no entry".to_owned(),
        (None, _, nameless) => format!("{nameless} entries without a name"),
        (Some(fault), 1, _) => fault.to_string(),
        (Some(fault), count, _) => format!("{fault}; and {} more faults", count - 1),
    }
}

/// The `SendValueReply` with all of `faults`, or with as many as keep it within its limit and the number of the others.
fn reply(faults: &[Fault]) -> String {
    let mut listed = faults.len();
    loop {
        let mut shown = faults[..listed].to_vec();
        if listed < faults.len() {
            let message = format!("{} more faults are not listed", faults.len() - listed);
            shown.push(Fault { name: String::new(), result: faults[listed].result, message });
        }
        let text = Message::SendValueReply(shown).encode();
        if text.len() <= REPLY_LIMIT_BYTES || listed == 0 {
            return text;
        }
        listed /= 2;
    }
}

/// Whether `value`, or every element of it, lies in the range that the signal declares.
fn within_range(signal: &Signal, value: &Value) -> Result<(), String> {
    if signal.min.is_none() && signal.max.is_none() {
        return Ok(());
    }
    if let Value::Array(values) = value {
        return values.iter().try_for_each(|value| within_range(signal, value));
    }
    let Some(number) = in_unit(signal, value) else { return Ok(()) };
    // A bound of 0.1 is no REAL; the REAL nearest to it must be allowed.
    let bound = |bound: f64| if matches!(value, Value::Real(_)) { f64::from(bound as f32) } else { bound };
    if signal.min.is_some_and(|min| number < bound(min)) || signal.max.is_some_and(|max| number > bound(max)) {
        let end = |end: Option<f64>, open: &str| end.map_or(open.to_owned(), |end| end.to_string());
        let unit = if signal.unit == Unit::ONE { String::new() } else { format!(" {}", signal.unit) };
        let (min, max) = (end(signal.min, "any"), end(signal.max, "any"));
        return Err(format!("{value} is outside this signal's range, {min} to {max}{unit}"));
    }
    Ok(())
}

/// The number in the signal's unit. A TIME says itself what it is in.
fn in_unit(signal: &Signal, value: &Value) -> Option<f64> {
    let number = value.to_f64()?;
    let is_time = matches!(value, Value::Time(_)) && signal.unit.quantity == Quantity::Time;
    Some(if is_time { number / signal.unit.to_si } else { number })
}

/// The signal whose name is spelt most like `name`, if one is spelt nearly so.
fn similar<'m>(map: &'m SignalMap, name: &str) -> Option<&'m str> {
    const LONGEST: usize = 80;
    const MOST_EDITS: usize = 2;
    if name.len() > LONGEST {
        return None;
    }
    let lower = name.to_lowercase();
    let names = map.signals().iter().map(|signal| signal.name.as_str()).filter(|name| name.len() <= LONGEST);
    let rated = names.map(|name| (edits(&lower, &name.to_lowercase()), name));
    rated.filter(|(edits, _)| *edits <= MOST_EDITS).min_by_key(|(edits, _)| *edits).map(|(_, name)| name)
}

/// The number of characters to insert, delete or replace between two texts (Levenshtein's distance).
fn edits(from: &str, to: &str) -> usize {
    if from.len().abs_diff(to.len()) > 8 {
        return usize::MAX;
    }
    let mut row: Vec<usize> = (0..=to.chars().count()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, b) in to.chars().enumerate() {
            let replaced = diagonal + usize::from(a != b);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row.last().copied().unwrap_or(0)
}
