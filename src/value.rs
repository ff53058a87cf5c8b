//! The elementary types of IEC 61499 (those of IEC 61131-3, clause 6.4), their values and ranges, and the units that
//! signals and properties are declared in. Words, no logic: what a value *does* is other modules' business.

use std::fmt;
use std::str::FromStr;

/// An elementary data type of IEC 61131-3 as a signal may have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ElementaryType {
    Bool,
    Sint,
    Int,
    Dint,
    Lint,
    Usint,
    Uint,
    Udint,
    Ulint,
    Real,
    Lreal,
    Byte,
    Word,
    Dword,
    Lword,
    String,
    Wstring,
    /// A duration. Inside, whole nanoseconds; on the wire, a JSON number of milliseconds.
    Time,
}

impl ElementaryType {
    /// All of them, in the order of the standard's tables.
    pub const ALL: [ElementaryType; 18] = [
        ElementaryType::Bool,
        ElementaryType::Sint,
        ElementaryType::Int,
        ElementaryType::Dint,
        ElementaryType::Lint,
        ElementaryType::Usint,
        ElementaryType::Uint,
        ElementaryType::Udint,
        ElementaryType::Ulint,
        ElementaryType::Real,
        ElementaryType::Lreal,
        ElementaryType::Byte,
        ElementaryType::Word,
        ElementaryType::Dword,
        ElementaryType::Lword,
        ElementaryType::String,
        ElementaryType::Wstring,
        ElementaryType::Time,
    ];

    /// The type's keyword, as the standard spells it.
    pub const fn name(self) -> &'static str {
        match self {
            ElementaryType::Bool => "BOOL",
            ElementaryType::Sint => "SINT",
            ElementaryType::Int => "INT",
            ElementaryType::Dint => "DINT",
            ElementaryType::Lint => "LINT",
            ElementaryType::Usint => "USINT",
            ElementaryType::Uint => "UINT",
            ElementaryType::Udint => "UDINT",
            ElementaryType::Ulint => "ULINT",
            ElementaryType::Real => "REAL",
            ElementaryType::Lreal => "LREAL",
            ElementaryType::Byte => "BYTE",
            ElementaryType::Word => "WORD",
            ElementaryType::Dword => "DWORD",
            ElementaryType::Lword => "LWORD",
            ElementaryType::String => "STRING",
            ElementaryType::Wstring => "WSTRING",
            ElementaryType::Time => "TIME",
        }
    }

    /// The integers a value of this type may be, both ends included; `None` for what is no integer.
    ///
    /// Bit strings (BYTE to LWORD) count as unsigned integers here: that is how they travel.
    pub const fn integer_range(self) -> Option<(i128, i128)> {
        Some(match self {
            ElementaryType::Sint => (i8::MIN as i128, i8::MAX as i128),
            ElementaryType::Int => (i16::MIN as i128, i16::MAX as i128),
            ElementaryType::Dint => (i32::MIN as i128, i32::MAX as i128),
            ElementaryType::Lint => (i64::MIN as i128, i64::MAX as i128),
            ElementaryType::Usint | ElementaryType::Byte => (0, u8::MAX as i128),
            ElementaryType::Uint | ElementaryType::Word => (0, u16::MAX as i128),
            ElementaryType::Udint | ElementaryType::Dword => (0, u32::MAX as i128),
            ElementaryType::Ulint | ElementaryType::Lword => (0, u64::MAX as i128),
            _ => return None,
        })
    }

    /// Whether values of this type are numbers with a fraction.
    pub const fn is_real(self) -> bool {
        matches!(self, ElementaryType::Real | ElementaryType::Lreal)
    }
}

impl fmt::Display for ElementaryType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The type of a signal: an elementary type, or a one-dimensional array of one.
///
/// Written `REAL`, or `REAL[16]` for sixteen of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SignalType {
    /// The type, or that of each element.
    pub element: ElementaryType,
    /// How many elements an array has, at least one; `None` for a single value.
    pub length: Option<u16>,
}

/// The most bytes a STRING, and the most UTF-16 units a WSTRING of ours holds: the default maximum length of
/// IEC 61131-3 programming systems (the standard leaves it to the implementation), enough for a status text.
pub const STRING_CAPACITY: usize = 254;

impl SignalType {
    /// A single value of `element`.
    pub const fn scalar(element: ElementaryType) -> Self {
        SignalType { element, length: None }
    }

    /// `length` values of `element`.
    pub const fn array(element: ElementaryType, length: u16) -> Self {
        SignalType { element, length: Some(length) }
    }

    /// The value a register of this type holds before anything was written to it: 0, FALSE, the empty string.
    pub fn initial(self) -> Value {
        let one = match self.element {
            ElementaryType::Bool => Value::Bool(false),
            ElementaryType::Sint => Value::Sint(0),
            ElementaryType::Int => Value::Int(0),
            ElementaryType::Dint => Value::Dint(0),
            ElementaryType::Lint => Value::Lint(0),
            ElementaryType::Usint => Value::Usint(0),
            ElementaryType::Uint => Value::Uint(0),
            ElementaryType::Udint => Value::Udint(0),
            ElementaryType::Ulint => Value::Ulint(0),
            ElementaryType::Real => Value::Real(0.0),
            ElementaryType::Lreal => Value::Lreal(0.0),
            ElementaryType::Byte => Value::Byte(0),
            ElementaryType::Word => Value::Word(0),
            ElementaryType::Dword => Value::Dword(0),
            ElementaryType::Lword => Value::Lword(0),
            ElementaryType::String => Value::String(Box::default()),
            ElementaryType::Wstring => Value::Wstring(Box::default()),
            ElementaryType::Time => Value::Time(0),
        };
        match self.length {
            None => one,
            Some(length) => Value::Array(vec![one; usize::from(length)].into()),
        }
    }
}

impl fmt::Display for SignalType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.length {
            None => write!(f, "{}", self.element),
            Some(length) => write!(f, "{}[{length}]", self.element),
        }
    }
}

/// A text that names no type a signal can have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found:?} is no signal type: expected one of {}, or an array of one as REAL[16]", ElementaryType::ALL.map(ElementaryType::name).join(", "))]
pub struct ParseTypeError {
    found: String,
}

impl FromStr for SignalType {
    type Err = ParseTypeError;

    fn from_str(text: &str) -> Result<Self, ParseTypeError> {
        let refuse = || ParseTypeError { found: text.to_owned() };
        let (name, length) = match text.split_once('[') {
            None => (text, None),
            Some((name, rest)) => {
                let length: u16 = rest.strip_suffix(']').and_then(|n| n.parse().ok()).ok_or_else(refuse)?;
                if length == 0 {
                    return Err(refuse());
                }
                (name, Some(length))
            }
        };
        let element = ElementaryType::ALL.into_iter().find(|ty| ty.name() == name).ok_or_else(refuse)?;
        Ok(SignalType { element, length })
    }
}

/// A value of a signal, with its type.
///
/// REAL is 32 bits wide as the standard has it: what leaves the engine is rounded to it once, here, and compared after.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Bool(bool),
    Sint(i8),
    Int(i16),
    Dint(i32),
    Lint(i64),
    Usint(u8),
    Uint(u16),
    Udint(u32),
    Ulint(u64),
    Real(f32),
    Lreal(f64),
    Byte(u8),
    Word(u16),
    Dword(u32),
    Lword(u64),
    /// Single-byte characters, at most [`STRING_CAPACITY`].
    String(Box<[u8]>),
    /// UTF-16 code units, at most [`STRING_CAPACITY`].
    Wstring(Box<[u16]>),
    /// Nanoseconds.
    Time(i64),
    /// Elements of one elementary type, at least one.
    Array(Box<[Value]>),
}

impl Value {
    /// The type of this value. An empty array, which no register can hold, counts as one of BOOL.
    pub fn signal_type(&self) -> SignalType {
        let element = match self {
            Value::Bool(_) => ElementaryType::Bool,
            Value::Sint(_) => ElementaryType::Sint,
            Value::Int(_) => ElementaryType::Int,
            Value::Dint(_) => ElementaryType::Dint,
            Value::Lint(_) => ElementaryType::Lint,
            Value::Usint(_) => ElementaryType::Usint,
            Value::Uint(_) => ElementaryType::Uint,
            Value::Udint(_) => ElementaryType::Udint,
            Value::Ulint(_) => ElementaryType::Ulint,
            Value::Real(_) => ElementaryType::Real,
            Value::Lreal(_) => ElementaryType::Lreal,
            Value::Byte(_) => ElementaryType::Byte,
            Value::Word(_) => ElementaryType::Word,
            Value::Dword(_) => ElementaryType::Dword,
            Value::Lword(_) => ElementaryType::Lword,
            Value::String(_) => ElementaryType::String,
            Value::Wstring(_) => ElementaryType::Wstring,
            Value::Time(_) => ElementaryType::Time,
            Value::Array(values) => {
                let element = values.first().map_or(ElementaryType::Bool, |v| v.signal_type().element);
                return SignalType::array(element, u16::try_from(values.len()).unwrap_or(u16::MAX));
            }
        };
        SignalType::scalar(element)
    }

    /// The value as a number, for a device's law: BOOL as 0 or 1, TIME in seconds. `None` for texts and arrays.
    ///
    /// 64-bit integers beyond 2^53 lose their last bits.
    pub fn to_f64(&self) -> Option<f64> {
        Some(match *self {
            Value::Bool(v) => f64::from(u8::from(v)),
            Value::Sint(v) => f64::from(v),
            Value::Int(v) => f64::from(v),
            Value::Dint(v) => f64::from(v),
            Value::Lint(v) => v as f64,
            Value::Usint(v) | Value::Byte(v) => f64::from(v),
            Value::Uint(v) | Value::Word(v) => f64::from(v),
            Value::Udint(v) | Value::Dword(v) => f64::from(v),
            Value::Ulint(v) | Value::Lword(v) => v as f64,
            Value::Real(v) => f64::from(v),
            Value::Lreal(v) => v,
            Value::Time(ns) => ns as f64 / 1e9,
            Value::String(_) | Value::Wstring(_) | Value::Array(_) => return None,
        })
    }

    /// The value of type `element` nearest to `number`: rounded and saturated for integers, `!= 0` for BOOL, seconds
    /// for TIME. A text type gives the empty text. NaN gives 0 for integers.
    pub fn from_f64(element: ElementaryType, number: f64) -> Value {
        let mut value = SignalType::scalar(element).initial();
        value.set_f64(number);
        value
    }

    /// Becomes the value of its own type that is nearest to `number`, as [`from_f64`](Self::from_f64) has it, and says whether
    /// that is another. Texts and arrays stay as they are.
    ///
    /// In place: a value that is put together in one place and moved to another at once costs several times as much.
    #[inline]
    pub fn set_f64(&mut self, number: f64) -> bool {
        fn put<T: PartialEq>(place: &mut T, new: T) -> bool {
            let is_new = *place != new;
            *place = new;
            is_new
        }
        let rounded = || number.round();
        match self {
            Value::Bool(v) => put(v, number != 0.0),
            Value::Sint(v) => put(v, rounded() as i8),
            Value::Int(v) => put(v, rounded() as i16),
            Value::Dint(v) => put(v, rounded() as i32),
            Value::Lint(v) => put(v, rounded() as i64),
            Value::Usint(v) | Value::Byte(v) => put(v, rounded() as u8),
            Value::Uint(v) | Value::Word(v) => put(v, rounded() as u16),
            Value::Udint(v) | Value::Dword(v) => put(v, rounded() as u32),
            Value::Ulint(v) | Value::Lword(v) => put(v, rounded() as u64),
            // Adding 0.0 turns -0.0 into 0.0: the two are equal, and must be one on the wire and in a hash.
            Value::Real(v) => put(v, number as f32 + 0.0),
            Value::Lreal(v) => put(v, number + 0.0),
            Value::Time(v) => put(v, (number * 1e9).round() as i64),
            Value::String(_) | Value::Wstring(_) | Value::Array(_) => false,
        }
    }
}

/// Appends `item` to a list that has room for it: the caller has reserved that, and without, `item` is lost.
///
/// `Vec::push` puts an item together on the stack, in case it has to make room first, and then moves it; for a [`Value`],
/// written a byte here and a byte there and read back whole, that takes several times as long as all the rest.
#[inline(always)]
pub fn push_reserved<T>(list: &mut Vec<T>, item: T) {
    debug_assert!(list.len() < list.capacity(), "no room was reserved");
    if list.len() < list.capacity() {
        list.push(item);
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Bool(v) => write!(f, "{v}"),
            Value::Sint(v) => write!(f, "{v}"),
            Value::Int(v) => write!(f, "{v}"),
            Value::Dint(v) => write!(f, "{v}"),
            Value::Lint(v) => write!(f, "{v}"),
            Value::Usint(v) | Value::Byte(v) => write!(f, "{v}"),
            Value::Uint(v) | Value::Word(v) => write!(f, "{v}"),
            Value::Udint(v) | Value::Dword(v) => write!(f, "{v}"),
            Value::Ulint(v) | Value::Lword(v) => write!(f, "{v}"),
            Value::Real(v) => write!(f, "{v}"),
            Value::Lreal(v) => write!(f, "{v}"),
            Value::Time(ns) => write!(f, "T#{}ms", *ns as f64 / 1e6),
            Value::String(bytes) => write!(f, "'{}'", bytes.escape_ascii()),
            Value::Wstring(units) => write!(f, "\"{}\"", String::from_utf16_lossy(units)),
            Value::Array(values) => {
                f.write_str("[")?;
                for (i, value) in values.iter().enumerate() {
                    if i > 0 {
                        f.write_str(", ")?;
                    }
                    write!(f, "{value}")?;
                }
                f.write_str("]")
            }
        }
    }
}

/// What a physical quantity is a measure of. The SI unit of each is what the engine computes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// A pure number, a ratio, a count.
    One,
    /// m
    Length,
    /// rad
    Angle,
    /// s
    Time,
    /// m/s
    Velocity,
    /// rad/s
    AngularVelocity,
    /// m/s²
    Acceleration,
    /// rad/s²
    AngularAcceleration,
    /// kg
    Mass,
    /// kg·m²
    Inertia,
    /// N
    Force,
    /// N·m
    Torque,
    /// 1/s
    Rate,
    /// N·s/m
    LinearDamping,
    /// N·m·s/rad
    AngularDamping,
    /// N/m
    LinearStiffness,
    /// N·m/rad
    AngularStiffness,
}

/// A unit that a file may declare: its quantity, and the factor that takes a number in it to SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    pub symbol: &'static str,
    pub quantity: Quantity,
    /// SI value = declared value · `to_si`.
    pub to_si: f64,
}

impl Unit {
    /// The unit of pure numbers.
    pub const ONE: Unit = Unit { symbol: "1", quantity: Quantity::One, to_si: 1.0 };

    /// All units known, the SI unit of each quantity first among its own.
    pub const ALL: &'static [Unit] = &[
        Unit::ONE,
        Unit { symbol: "%", quantity: Quantity::One, to_si: 0.01 },
        Unit { symbol: "m", quantity: Quantity::Length, to_si: 1.0 },
        Unit { symbol: "mm", quantity: Quantity::Length, to_si: 1e-3 },
        Unit { symbol: "rad", quantity: Quantity::Angle, to_si: 1.0 },
        Unit { symbol: "mrad", quantity: Quantity::Angle, to_si: 1e-3 },
        Unit { symbol: "deg", quantity: Quantity::Angle, to_si: std::f64::consts::PI / 180.0 },
        Unit { symbol: "s", quantity: Quantity::Time, to_si: 1.0 },
        Unit { symbol: "ms", quantity: Quantity::Time, to_si: 1e-3 },
        Unit { symbol: "m/s", quantity: Quantity::Velocity, to_si: 1.0 },
        Unit { symbol: "mm/s", quantity: Quantity::Velocity, to_si: 1e-3 },
        Unit { symbol: "m/min", quantity: Quantity::Velocity, to_si: 1.0 / 60.0 },
        Unit { symbol: "rad/s", quantity: Quantity::AngularVelocity, to_si: 1.0 },
        Unit { symbol: "deg/s", quantity: Quantity::AngularVelocity, to_si: std::f64::consts::PI / 180.0 },
        Unit { symbol: "rpm", quantity: Quantity::AngularVelocity, to_si: std::f64::consts::TAU / 60.0 },
        Unit { symbol: "m/s2", quantity: Quantity::Acceleration, to_si: 1.0 },
        Unit { symbol: "mm/s2", quantity: Quantity::Acceleration, to_si: 1e-3 },
        Unit { symbol: "rad/s2", quantity: Quantity::AngularAcceleration, to_si: 1.0 },
        Unit { symbol: "deg/s2", quantity: Quantity::AngularAcceleration, to_si: std::f64::consts::PI / 180.0 },
        Unit { symbol: "kg", quantity: Quantity::Mass, to_si: 1.0 },
        Unit { symbol: "g", quantity: Quantity::Mass, to_si: 1e-3 },
        Unit { symbol: "kg.m2", quantity: Quantity::Inertia, to_si: 1.0 },
        Unit { symbol: "N", quantity: Quantity::Force, to_si: 1.0 },
        Unit { symbol: "N.m", quantity: Quantity::Torque, to_si: 1.0 },
        Unit { symbol: "1/s", quantity: Quantity::Rate, to_si: 1.0 },
        Unit { symbol: "N.s/m", quantity: Quantity::LinearDamping, to_si: 1.0 },
        Unit { symbol: "N.m.s/rad", quantity: Quantity::AngularDamping, to_si: 1.0 },
        Unit { symbol: "N/m", quantity: Quantity::LinearStiffness, to_si: 1.0 },
        Unit { symbol: "N.m/rad", quantity: Quantity::AngularStiffness, to_si: 1.0 },
    ];

    /// The unit written `symbol`; `²` and `·` are taken for `2` and `.`.
    pub fn named(symbol: &str) -> Option<Unit> {
        let plain = symbol.replace('²', "2").replace('·', ".");
        Unit::ALL.iter().find(|unit| unit.symbol == plain).copied()
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_reads_back_as_it_is_written() {
        for element in ElementaryType::ALL {
            for ty in [SignalType::scalar(element), SignalType::array(element, 16)] {
                assert_eq!(ty.to_string().parse(), Ok(ty));
                assert_eq!(ty.initial().signal_type(), ty);
            }
        }
    }

    #[test]
    fn what_is_no_type_is_refused_with_the_list_of_those_that_are() {
        for text in ["", "real", "FLOAT", "REAL[", "REAL[0]", "REAL[-1]", "REAL[70000]", "REAL[2][2]", "ARRAY"] {
            let error = text.parse::<SignalType>().expect_err(text).to_string();
            assert!(error.contains("BOOL, SINT") && error.contains(&format!("{text:?}")), "{error}");
        }
    }

    #[test]
    fn numbers_saturate_at_the_ends_of_their_type() {
        for element in ElementaryType::ALL {
            let Some((low, high)) = element.integer_range() else { continue };
            assert_eq!(Value::from_f64(element, f64::INFINITY).to_f64(), Some(high as f64), "{element}");
            assert_eq!(Value::from_f64(element, f64::NEG_INFINITY).to_f64(), Some(low as f64), "{element}");
            assert_eq!(Value::from_f64(element, 41.6).to_f64(), Some(42.0), "{element}");
        }
    }

    #[test]
    fn a_value_becomes_another_of_its_type_in_place() {
        for element in ElementaryType::ALL {
            let mut value = SignalType::scalar(element).initial();
            let is_number = value.to_f64().is_some();
            for number in [1.0, 1.0, 0.0, 0.4, 7.0] {
                let before = value.clone();
                let is_new = value.set_f64(number);
                assert_eq!(value, Value::from_f64(element, number), "{element} {number}");
                assert_eq!(is_new, value != before, "{element} {number}");
                assert_eq!(value.signal_type(), SignalType::scalar(element));
            }
            assert_eq!(value.to_f64().is_some_and(|number| number != 0.0), is_number, "{element}");
        }
        let mut list = SignalType::array(ElementaryType::Int, 2).initial();
        assert!(!list.set_f64(3.0));
        assert_eq!(list, SignalType::array(ElementaryType::Int, 2).initial());
    }

    #[test]
    fn negative_zero_is_zero() {
        let Value::Real(zero) = Value::from_f64(ElementaryType::Real, -0.0) else { panic!("not a REAL") };
        assert_eq!(zero.to_bits(), 0);
        // A number so small that REAL cannot hold it must not leave its sign behind.
        let Value::Real(zero) = Value::from_f64(ElementaryType::Real, -1e-60) else { panic!("not a REAL") };
        assert_eq!(zero.to_bits(), 0);
    }

    #[test]
    fn units_convert_to_si() {
        let check = |symbol: &str, to_si: f64| {
            let unit = Unit::named(symbol).expect(symbol);
            assert!((unit.to_si - to_si).abs() < 1e-15, "{symbol}: {}", unit.to_si);
        };
        check("mm", 1e-3);
        check("m/min", 1.0 / 60.0);
        check("deg", 0.017453292519943295);
        check("m/s²", 1.0);
        check("N·s/m", 1.0);
        assert_eq!(Unit::named("furlong"), None);
    }
}
