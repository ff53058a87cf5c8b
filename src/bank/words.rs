//! Values as runs of `u64` words, and where each register's run lies.
//!
//! A number is one word: integers sign-extended, REAL and LREAL by their bits, BOOL as 0 or 1. A text is its length and
//! then room for [`STRING_CAPACITY`] characters, eight (STRING) or four (WSTRING) to a word, zero past its end. An array
//! is its elements. Two values are equal exactly if their words are (a NaN equals itself here, and 0.0 is not -0.0).

use crate::signal_map::{Direction, Kind, RateClass, RegisterId, SignalMap};
use crate::value::{ElementaryType, STRING_CAPACITY, SignalType, Value};

/// Words of one element of type `element`.
const fn element_words(element: ElementaryType) -> usize {
    match element {
        ElementaryType::String => 1 + STRING_CAPACITY.div_ceil(8),
        ElementaryType::Wstring => 1 + STRING_CAPACITY.div_ceil(4),
        _ => 1,
    }
}

/// Words of a value of type `ty`.
fn value_words(ty: SignalType) -> usize {
    element_words(ty.element) * usize::from(ty.length.unwrap_or(1))
}

/// Where a register lies among its direction's words, and how its changes travel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub id: RegisterId,
    pub ty: SignalType,
    pub start: usize,
    pub words: usize,
    pub kind: Kind,
    pub rate: RateClass,
}

/// Where all registers lie. Commands and reports are laid out apart, each from 0.
#[derive(Debug)]
pub(super) struct Layout {
    /// By register id: the direction, and the place among that direction's.
    by_id: Vec<(Direction, usize)>,
    pub commands: Vec<Place>,
    pub reports: Vec<Place>,
}

impl Layout {
    pub fn new(map: &SignalMap) -> Layout {
        let mut layout = Layout { by_id: Vec::new(), commands: Vec::new(), reports: Vec::new() };
        for (index, signal) in map.signals().iter().enumerate() {
            let places = match signal.direction {
                Direction::Command => &mut layout.commands,
                Direction::Report => &mut layout.reports,
            };
            layout.by_id.push((signal.direction, places.len()));
            places.push(Place {
                id: RegisterId(index as u32),
                ty: signal.ty,
                start: total_words(places),
                words: value_words(signal.ty),
                kind: signal.kind,
                rate: signal.rate,
            });
        }
        layout
    }

    /// The place of command register `id`; `None` if it is none.
    pub fn command(&self, id: RegisterId) -> Option<&Place> {
        match self.by_id.get(id.index()) {
            Some((Direction::Command, at)) => self.commands.get(*at),
            _ => None,
        }
    }

    /// The place of report register `id`; `None` if it is none.
    pub fn report(&self, id: RegisterId) -> Option<&Place> {
        match self.by_id.get(id.index()) {
            Some((Direction::Report, at)) => self.reports.get(*at),
            _ => None,
        }
    }

    /// How many registers there are, of both directions.
    pub fn registers(&self) -> usize {
        self.by_id.len()
    }
}

/// Words that `places` take together.
pub(super) fn total_words(places: &[Place]) -> usize {
    places.last().map_or(0, |last| last.start + last.words)
}

/// Writes `value` into `words`, which are as many as its type takes, and says whether any of them changed.
///
/// The bank's registers have the types of its signals, and both sides hand in values of those types only: the session
/// types what it decodes, the engine what it reports. Another type is a bug and panics.
pub(super) fn encode(ty: SignalType, value: &Value, words: &mut [u64]) -> bool {
    match (ty.length, value) {
        (None, _) => encode_element(ty.element, value, words),
        (Some(length), Value::Array(elements)) if elements.len() == usize::from(length) => {
            let each = words.chunks_exact_mut(element_words(ty.element));
            each.zip(elements)
                .fold(false, |changed, (words, element)| encode_element(ty.element, element, words) | changed)
        }
        _ => unreachable!("a register of type {ty} was given {value}, a {}", value.signal_type()),
    }
}

fn encode_element(element: ElementaryType, value: &Value, words: &mut [u64]) -> bool {
    let word = match (element, value) {
        (ElementaryType::Bool, Value::Bool(v)) => u64::from(*v),
        (ElementaryType::Sint, Value::Sint(v)) => i64::from(*v) as u64,
        (ElementaryType::Int, Value::Int(v)) => i64::from(*v) as u64,
        (ElementaryType::Dint, Value::Dint(v)) => i64::from(*v) as u64,
        (ElementaryType::Lint, Value::Lint(v)) => *v as u64,
        (ElementaryType::Usint, Value::Usint(v)) => u64::from(*v),
        (ElementaryType::Uint, Value::Uint(v)) => u64::from(*v),
        (ElementaryType::Udint, Value::Udint(v)) => u64::from(*v),
        (ElementaryType::Ulint, Value::Ulint(v)) => *v,
        (ElementaryType::Byte, Value::Byte(v)) => u64::from(*v),
        (ElementaryType::Word, Value::Word(v)) => u64::from(*v),
        (ElementaryType::Dword, Value::Dword(v)) => u64::from(*v),
        (ElementaryType::Lword, Value::Lword(v)) => *v,
        (ElementaryType::Real, Value::Real(v)) => u64::from(v.to_bits()),
        (ElementaryType::Lreal, Value::Lreal(v)) => v.to_bits(),
        (ElementaryType::Time, Value::Time(v)) => *v as u64,
        (ElementaryType::String, Value::String(bytes)) => {
            return encode_text(bytes.len(), bytes.chunks(8), |byte| u64::from(*byte), 8, words);
        }
        (ElementaryType::Wstring, Value::Wstring(units)) => {
            return encode_text(units.len(), units.chunks(4), |unit| u64::from(*unit), 16, words);
        }
        _ => unreachable!("a register of type {element} was given {value}, a {}", value.signal_type()),
    };
    replace(&mut words[0], word)
}

/// Packs a text's characters, each `bits` wide, into `words`: its length first. What exceeds the capacity is cut off.
fn encode_text<'a, T: 'a>(
    length: usize,
    chunks: impl Iterator<Item = &'a [T]>,
    widen: impl Fn(&T) -> u64,
    bits: u32,
    words: &mut [u64],
) -> bool {
    debug_assert!(length <= STRING_CAPACITY, "a text of {length} characters: the codec lets {STRING_CAPACITY} pass");
    let mut changed = replace(&mut words[0], length.min(STRING_CAPACITY) as u64);
    let packed = chunks.map(|chunk| chunk.iter().rev().fold(0, |word, character| (word << bits) | widen(character)));
    for (place, word) in words[1..].iter_mut().zip(packed.chain(std::iter::repeat(0))) {
        changed |= replace(place, word);
    }
    changed
}

/// Puts `word` in `place` and says whether that changed it.
fn replace(place: &mut u64, word: u64) -> bool {
    std::mem::replace(place, word) != word
}

/// Reads a value of type `ty` from its words: `word(0)` is the first.
pub(super) fn decode(ty: SignalType, word: impl Fn(usize) -> u64) -> Value {
    match ty.length {
        None => decode_element(ty.element, &word, 0),
        Some(length) => {
            let each = element_words(ty.element);
            Value::Array((0..usize::from(length)).map(|i| decode_element(ty.element, &word, i * each)).collect())
        }
    }
}

fn decode_element(element: ElementaryType, word: &impl Fn(usize) -> u64, start: usize) -> Value {
    let first = word(start);
    match element {
        ElementaryType::Bool => Value::Bool(first != 0),
        ElementaryType::Sint => Value::Sint(first as i8),
        ElementaryType::Int => Value::Int(first as i16),
        ElementaryType::Dint => Value::Dint(first as i32),
        ElementaryType::Lint => Value::Lint(first as i64),
        ElementaryType::Usint => Value::Usint(first as u8),
        ElementaryType::Uint => Value::Uint(first as u16),
        ElementaryType::Udint => Value::Udint(first as u32),
        ElementaryType::Ulint => Value::Ulint(first),
        ElementaryType::Byte => Value::Byte(first as u8),
        ElementaryType::Word => Value::Word(first as u16),
        ElementaryType::Dword => Value::Dword(first as u32),
        ElementaryType::Lword => Value::Lword(first),
        ElementaryType::Real => Value::Real(f32::from_bits(first as u32)),
        ElementaryType::Lreal => Value::Lreal(f64::from_bits(first)),
        ElementaryType::Time => Value::Time(first as i64),
        ElementaryType::String => {
            let at = |i: usize| (word(start + 1 + i / 8) >> (i % 8 * 8)) as u8;
            Value::String((0..first as usize).map(at).collect())
        }
        ElementaryType::Wstring => {
            let at = |i: usize| (word(start + 1 + i / 4) >> (i % 4 * 16)) as u16;
            Value::Wstring((0..first as usize).map(at).collect())
        }
    }
}
