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

/// Where a register lies among its direction's words, and how its changes travel. Small: every value passes by one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub id: RegisterId,
    start: u32,
    words: u32,
    pub ty: SignalType,
    pub direction: Direction,
    pub kind: Kind,
    pub rate: RateClass,
}

impl Place {
    /// The first of its words.
    pub fn start(&self) -> usize {
        self.start as usize
    }

    /// How many words it has.
    pub fn words(&self) -> usize {
        self.words as usize
    }
}

/// Where all registers lie. Commands and reports are laid out apart, each from 0.
#[derive(Debug)]
pub(super) struct Layout {
    /// By register id.
    places: Vec<Place>,
    /// The reports, in the order of their ids.
    pub reports: Vec<Place>,
    /// The level signals among them, by their rate.
    high: Vec<Place>,
    low: Vec<Place>,
}

impl Layout {
    pub fn new(map: &SignalMap) -> Layout {
        let mut places = Vec::with_capacity(map.signals().len());
        let [mut of_commands, mut of_reports] = [0; 2];
        for (index, signal) in map.signals().iter().enumerate() {
            let next = match signal.direction {
                Direction::Command => &mut of_commands,
                Direction::Report => &mut of_reports,
            };
            let place = Place {
                id: RegisterId(index as u32),
                start: *next,
                words: value_words(signal.ty) as u32,
                ty: signal.ty,
                direction: signal.direction,
                kind: signal.kind,
                rate: signal.rate,
            };
            *next += place.words;
            places.push(place);
        }
        let is_report = |place: &&Place| place.direction == Direction::Report;
        let reports: Vec<Place> = places.iter().filter(is_report).copied().collect();
        let levels = |rate| {
            let is_meant = |place: &&Place| place.kind == Kind::Level && place.rate == rate;
            reports.iter().filter(is_meant).copied().collect()
        };
        let (high, low) = (levels(RateClass::HighFrequency), levels(RateClass::LowFrequency));
        Layout { places, reports, high, low }
    }

    /// The place of command register `id`; `None` if it is none.
    pub fn command(&self, id: RegisterId) -> Option<&Place> {
        self.place(id, Direction::Command)
    }

    /// The place of report register `id`; `None` if it is none.
    pub fn report(&self, id: RegisterId) -> Option<&Place> {
        self.place(id, Direction::Report)
    }

    fn place(&self, id: RegisterId, direction: Direction) -> Option<&Place> {
        self.places.get(id.index()).filter(|place| place.direction == direction)
    }

    /// The level signals of a rate.
    pub fn levels(&self, rate: RateClass) -> &[Place] {
        match rate {
            RateClass::HighFrequency => &self.high,
            RateClass::LowFrequency => &self.low,
        }
    }

    /// The commands.
    pub fn commands(&self) -> impl Iterator<Item = &Place> {
        self.places.iter().filter(|place| place.direction == Direction::Command)
    }

    /// How many registers there are, of both directions.
    pub fn registers(&self) -> usize {
        self.places.len()
    }

    /// Words that all reports take together.
    pub fn report_words(&self) -> usize {
        self.reports.last().map_or(0, |last| last.start() + last.words())
    }
}

/// Writes `value` into `words`, which are as many as its type takes, and says whether any of them changed.
///
/// The bank's registers have the types of its signals, and both sides hand in values of those types only: the session
/// types what it decodes, the engine what it reports. Another type is a bug and panics.
#[inline]
pub(super) fn encode(ty: SignalType, value: &Value, words: &mut [u64]) -> bool {
    match scalar(ty, value) {
        Some(word) => replace(&mut words[0], word),
        None => encode_long(ty, value, words),
    }
}

/// As [`encode`], at the end of `words`.
#[inline]
pub(super) fn append(place: &Place, value: &Value, words: &mut Vec<u64>) {
    match scalar(place.ty, value) {
        Some(word) => words.push(word),
        None => {
            let start = words.len();
            words.resize(start + place.words(), 0);
            encode_long(place.ty, value, &mut words[start..]);
        }
    }
}

/// The word of a number by itself, as nearly every signal is one.
#[inline]
fn scalar(ty: SignalType, value: &Value) -> Option<u64> {
    if ty.length.is_none() { number(ty.element, value) } else { None }
}

/// The word of a number of type `element`.
#[inline(always)]
fn number(element: ElementaryType, value: &Value) -> Option<u64> {
    Some(match (element, value) {
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
        _ => return None,
    })
}

#[inline(never)]
fn encode_long(ty: SignalType, value: &Value, words: &mut [u64]) -> bool {
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
    match (element, value) {
        (ElementaryType::String, Value::String(bytes)) => {
            encode_text(bytes.len(), bytes.chunks(8), |byte| u64::from(*byte), 8, words)
        }
        (ElementaryType::Wstring, Value::Wstring(units)) => {
            encode_text(units.len(), units.chunks(4), |unit| u64::from(*unit), 16, words)
        }
        _ => {
            let word = number(element, value).unwrap_or_else(|| {
                unreachable!("a register of type {element} was given {value}, a {}", value.signal_type())
            });
            replace(&mut words[0], word)
        }
    }
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
    decode_to(ty, word, |value| value)
}

/// As [`decode`], and gives the value to `take` in each arm by itself, so that it is put together where it is to stay.
#[inline]
pub(super) fn decode_to<R>(ty: SignalType, word: impl Fn(usize) -> u64, take: impl FnOnce(Value) -> R) -> R {
    if ty.length.is_some() {
        return take(decode_long(ty, &word));
    }
    let first = word(0);
    match ty.element {
        ElementaryType::Bool => take(Value::Bool(first != 0)),
        ElementaryType::Sint => take(Value::Sint(first as i8)),
        ElementaryType::Int => take(Value::Int(first as i16)),
        ElementaryType::Dint => take(Value::Dint(first as i32)),
        ElementaryType::Lint => take(Value::Lint(first as i64)),
        ElementaryType::Usint => take(Value::Usint(first as u8)),
        ElementaryType::Uint => take(Value::Uint(first as u16)),
        ElementaryType::Udint => take(Value::Udint(first as u32)),
        ElementaryType::Ulint => take(Value::Ulint(first)),
        ElementaryType::Byte => take(Value::Byte(first as u8)),
        ElementaryType::Word => take(Value::Word(first as u16)),
        ElementaryType::Dword => take(Value::Dword(first as u32)),
        ElementaryType::Lword => take(Value::Lword(first)),
        ElementaryType::Real => take(Value::Real(f32::from_bits(first as u32))),
        ElementaryType::Lreal => take(Value::Lreal(f64::from_bits(first))),
        ElementaryType::Time => take(Value::Time(first as i64)),
        ElementaryType::String | ElementaryType::Wstring => take(decode_long(ty, &word)),
    }
}

/// A text or an array.
fn decode_long(ty: SignalType, word: &dyn Fn(usize) -> u64) -> Value {
    let Some(length) = ty.length else { return decode_text(ty.element, word) };
    let each = element_words(ty.element);
    let element = |i: usize| decode(SignalType::scalar(ty.element), |offset| word(i * each + offset));
    Value::Array((0..usize::from(length)).map(element).collect())
}

fn decode_text(element: ElementaryType, word: &dyn Fn(usize) -> u64) -> Value {
    let length = word(0) as usize;
    if element == ElementaryType::Wstring {
        let at = |i: usize| (word(1 + i / 4) >> (i % 4 * 16)) as u16;
        return Value::Wstring((0..length).map(at).collect());
    }
    let at = |i: usize| (word(1 + i / 8) >> (i % 8 * 8)) as u8;
    Value::String((0..length).map(at).collect())
}
