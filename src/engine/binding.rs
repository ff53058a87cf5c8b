//! Between registers and ports: which signal is which device's, and the units on the wire become SI units here.

use smallvec::SmallVec;

use crate::prototype::quantity::{from_si, to_si};
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::value::{ElementaryType, Unit, Value};

/// A port that takes commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Target {
    pub unit: usize,
    pub port: usize,
}

/// A port that reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ReportPort {
    pub port: usize,
    pub register: RegisterId,
    unit: Unit,
    /// The bits of what was last reported; `None` where the register may hold something else.
    said: Option<u64>,
}

impl ReportPort {
    /// The port `port` of a device, bound to `register`.
    pub fn new(port: usize, register: RegisterId, map: &SignalMap) -> ReportPort {
        ReportPort { port, register, unit: map.signal(register).unit, said: None }
    }

    /// Whether `number` is not what was reported last. From now on it is.
    pub fn is_news(&mut self, number: f64) -> bool {
        self.said.replace(number.to_bits()) != Some(number.to_bits())
    }

    /// Whatever is reported next is news: the register was set by others.
    pub fn forget(&mut self) {
        self.said = None;
    }

    /// What the device reports where the register holds `value`, in SI units; `None` for what is no finite number.
    pub fn number(&self, value: &Value) -> Option<f64> {
        let number = value.to_f64().filter(|number| number.is_finite())?;
        Some(if self.unit.to_si == 1.0 { number } else { to_si(number, self.unit) })
    }

    /// What the register is told when the device reports `number`, in SI units: the same in the signal's own.
    pub fn on_the_wire(&self, number: f64) -> f64 {
        // Where no unit is changed, no digit is.
        if self.unit.to_si == 1.0 { number } else { from_si(number, self.unit) }
    }
}

/// What each register commands.
#[derive(Clone, Debug, Default)]
pub(super) struct CommandTable {
    rows: Vec<CommandRow>,
}

#[derive(Clone, Debug)]
struct CommandRow {
    element: ElementaryType,
    unit: Unit,
    is_command: bool,
    /// Nearly always one.
    targets: SmallVec<[Target; 1]>,
}

impl CommandTable {
    /// A row for every register of `map`, without targets yet.
    pub fn new(map: &SignalMap) -> CommandTable {
        let row = |signal: &crate::signal_map::Signal| CommandRow {
            element: signal.ty.element,
            unit: signal.unit,
            is_command: signal.direction == Direction::Command,
            targets: SmallVec::new(),
        };
        CommandTable { rows: map.signals().iter().map(row).collect() }
    }

    /// Lets `register` command a port.
    pub fn bind(&mut self, register: RegisterId, target: Target) {
        self.rows[register.index()].targets.push(target);
    }

    /// Whether the automation sets `register`.
    pub fn is_command(&self, register: RegisterId) -> bool {
        self.rows.get(register.index()).is_some_and(|row| row.is_command)
    }

    /// What a value for `register` becomes where somebody holds it: of the register's type. `None` for what is no finite
    /// number, and for a register that holds none.
    pub fn fit(&self, register: RegisterId, value: &Value) -> Option<Value> {
        let row = self.rows.get(register.index())?;
        let kept = Value::from_f64(row.element, finite(value)?);
        kept.to_f64().map(|_| kept)
    }

    /// The number of a value for `register` as it came. `None` for a register that takes no commands, and for what is no
    /// finite number.
    #[inline]
    pub fn number(&self, register: RegisterId, value: &Value) -> Option<f64> {
        self.rows.get(register.index()).filter(|row| row.is_command)?;
        finite(value)
    }

    /// What devices take where `register` keeps `number`: in SI units.
    #[inline]
    pub fn si(&self, register: RegisterId, number: f64) -> f64 {
        let unit = self.rows[register.index()].unit;
        if unit.to_si == 1.0 { number } else { to_si(number, unit) }
    }

    /// The ports that `register` commands.
    pub fn targets(&self, register: RegisterId) -> &[Target] {
        self.rows.get(register.index()).map_or(&[], |row| &row.targets)
    }
}

#[inline]
fn finite(value: &Value) -> Option<f64> {
    value.to_f64().filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal_map::{Kind, RateClass, Signal};
    use crate::value::{SignalType, Unit};

    const SPEED: RegisterId = RegisterId(0);
    const PLACE: RegisterId = RegisterId(1);

    fn map() -> SignalMap {
        let signal = |name: &str, direction, unit: &str| Signal {
            name: name.to_owned(),
            ty: SignalType::scalar(ElementaryType::Real),
            direction,
            kind: Kind::Level,
            rate: RateClass::HighFrequency,
            unit: Unit::named(unit).expect("a unit"),
            min: None,
            max: None,
            instance: "I".to_owned(),
            task: "T".to_owned(),
            property: name.to_owned(),
        };
        let signals = vec![signal("speed", Direction::Command, "mm/s"), signal("place", Direction::Report, "mm")];
        SignalMap::new("p", signals).expect("two names")
    }

    fn check(value: Value, expect: Option<(Value, f64)>) {
        let table = CommandTable::new(&map());
        let mut kept = Value::Real(0.0);
        let taken = table.number(SPEED, &value).map(|number| {
            kept.set_f64(number);
            table.si(SPEED, kept.to_f64().expect("a number"))
        });
        assert_eq!(taken.map(|number| (kept.clone(), number)), expect);
        assert_eq!(table.fit(SPEED, &value), expect.map(|(kept, _)| kept));
    }

    #[test]
    fn commands_come_in_the_wires_unit_and_type() {
        check(Value::Real(250.0), Some((Value::Real(250.0), 0.25)));
        check(Value::Dint(3), Some((Value::Real(3.0), 0.003)));
        check(Value::Real(f32::NAN), None);
        check(Value::String(Box::default()), None);
    }

    #[test]
    fn a_reported_register_takes_no_command() {
        let table = CommandTable::new(&map());
        assert_eq!(table.number(PLACE, &Value::Real(1.0)), None);
        assert_eq!(table.number(RegisterId(99), &Value::Real(1.0)), None);
    }

    #[test]
    fn reports_leave_in_the_wires_unit() {
        assert_eq!(ReportPort::new(0, PLACE, &map()).on_the_wire(1.25), 1250.0);
    }
}
