//! The process image: what the automation last heard of the plant and what it last told it, by register; and the typed
//! handles through which function blocks read and write it.
//!
//! Handles are bound to names once, when a program is built. All that a program misses in a signals map is told at once.

use std::fmt;
use std::marker::PhantomData;
use std::sync::Arc;

use crate::signal_map::{Direction, RegisterId, Signal, SignalMap};
use crate::value::Value;

/// What a function block reads or writes: `bool` for BOOL, `i32` for any integer type, `f64` for REAL and LREAL, in SI
/// units whatever the unit on the wire.
pub trait Datum: Copy + PartialEq + fmt::Display + sealed::Sealed {
    /// For people: the signal types that fit.
    const EXPECTED: &'static str;
    /// Whether `signal` can carry it.
    fn fits(signal: &Signal) -> bool;
    /// Reads a value that fits; the initial value for one that does not.
    fn read(value: &Value, to_si: f64) -> Self;
    /// The number that a register of its type is set to, in the signal's unit.
    fn number(self, to_si: f64) -> f64;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for bool {}
    impl Sealed for i32 {}
    impl Sealed for f64 {}
}

impl Datum for bool {
    const EXPECTED: &'static str = "BOOL";

    fn fits(signal: &Signal) -> bool {
        signal.ty.length.is_none() && signal.ty.element == crate::value::ElementaryType::Bool
    }

    fn read(value: &Value, _to_si: f64) -> bool {
        *value == Value::Bool(true)
    }

    fn number(self, _to_si: f64) -> f64 {
        f64::from(u8::from(self))
    }
}

impl Datum for i32 {
    const EXPECTED: &'static str = "an integer type";

    fn fits(signal: &Signal) -> bool {
        signal.ty.length.is_none() && signal.ty.element.integer_range().is_some()
    }

    fn read(value: &Value, _to_si: f64) -> i32 {
        value.to_f64().unwrap_or(0.0) as i32
    }

    fn number(self, _to_si: f64) -> f64 {
        f64::from(self)
    }
}

impl Datum for f64 {
    const EXPECTED: &'static str = "REAL or LREAL";

    fn fits(signal: &Signal) -> bool {
        signal.ty.length.is_none() && signal.ty.element.is_real()
    }

    fn read(value: &Value, to_si: f64) -> f64 {
        value.to_f64().unwrap_or(0.0) * to_si
    }

    fn number(self, to_si: f64) -> f64 {
        self / to_si
    }
}

/// A signal of the plant that a block reads.
#[derive(Clone, Copy, Debug)]
pub struct Input<T> {
    register: RegisterId,
    to_si: f64,
    datum: PhantomData<T>,
}

/// A signal of the plant that a block sets.
#[derive(Clone, Copy, Debug)]
pub struct Output<T> {
    register: RegisterId,
    to_si: f64,
    datum: PhantomData<T>,
}

impl<T> Input<T> {
    /// Its register.
    pub fn register(&self) -> RegisterId {
        self.register
    }
}

/// What a program needs and a signals map does not give.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the control program cannot be bound to the plant {plant:?}: {}", faults.join("; "))]
pub struct BindError {
    /// The plant whose map it was.
    pub plant: String,
    /// One sentence for each signal that is missing or of another type or direction.
    pub faults: Vec<String>,
}

/// Binds handles to names of a signals map, and remembers every name that does not fit.
pub struct Binder<'a> {
    map: &'a SignalMap,
    faults: Vec<String>,
}

impl<'a> Binder<'a> {
    /// Binds to the signals of `map`.
    pub fn new(map: &'a SignalMap) -> Binder<'a> {
        Binder { map, faults: Vec::new() }
    }

    /// The signal `instance.property`, which the plant reports.
    pub fn input<T: Datum>(&mut self, instance: &str, property: &str) -> Input<T> {
        let (register, to_si) = self.bind::<T>(instance, property, Direction::Report);
        Input { register, to_si, datum: PhantomData }
    }

    /// The signal `instance.property`, which the automation sets.
    pub fn output<T: Datum>(&mut self, instance: &str, property: &str) -> Output<T> {
        let (register, to_si) = self.bind::<T>(instance, property, Direction::Command);
        Output { register, to_si, datum: PhantomData }
    }

    fn bind<T: Datum>(&mut self, instance: &str, property: &str, direction: Direction) -> (RegisterId, f64) {
        let name = format!("{instance}.{property}");
        let Some(register) = self.map.register(&name) else {
            self.faults.push(format!("no signal {name:?} (expected {}, {})", T::EXPECTED, spell(direction)));
            return (RegisterId(0), 1.0);
        };
        let signal = self.map.signal(register);
        if signal.direction != direction || !T::fits(signal) {
            self.faults.push(format!(
                "signal {name:?} is {}, {} (expected {}, {})",
                signal.ty,
                spell(signal.direction),
                T::EXPECTED,
                spell(direction)
            ));
        }
        (register, signal.unit.to_si)
    }

    /// `bound`, if every name fitted.
    pub fn finish<B>(self, bound: B) -> Result<B, BindError> {
        if self.faults.is_empty() {
            Ok(bound)
        } else {
            Err(BindError { plant: self.map.plant().to_owned(), faults: self.faults })
        }
    }
}

fn spell(direction: Direction) -> &'static str {
    match direction {
        Direction::Command => "command",
        Direction::Report => "report",
    }
}

/// The last value of every signal, and which changed in the event that is being handled.
#[derive(Debug)]
pub struct Image {
    map: Arc<SignalMap>,
    values: Vec<Value>,
    /// Commands set since the event began, in order, each with the value before it.
    set: Vec<(RegisterId, Value)>,
}

impl Image {
    /// The image before anything was exchanged: 0, FALSE, the empty string.
    pub fn new(map: Arc<SignalMap>) -> Image {
        let values = map.signals().iter().map(|signal| signal.ty.initial()).collect();
        Image { map, values, set: Vec::new() }
    }

    /// The signals it holds.
    pub fn map(&self) -> &Arc<SignalMap> {
        &self.map
    }

    /// The last value of a register.
    pub fn value(&self, register: RegisterId) -> &Value {
        &self.values[register.index()]
    }

    /// Takes values that are known to both sides: what the plant reported, what was sent by other ways.
    pub fn take(&mut self, values: &[(RegisterId, Value)]) {
        for (register, value) in values {
            self.values[register.index()].clone_from(value);
        }
    }

    /// Reads a report.
    pub fn get<T: Datum>(&self, input: Input<T>) -> T {
        T::read(self.value(input.register), input.to_si)
    }

    /// The value that a command was last set to.
    pub fn last<T: Datum>(&self, output: Output<T>) -> T {
        T::read(self.value(output.register), output.to_si)
    }

    /// Sets a command. It leaves when the event is over, if it differs then from what was sent before.
    pub fn set<T: Datum>(&mut self, output: Output<T>, datum: T) {
        let element = self.map.signal(output.register).ty.element;
        self.set_value(output.register, Value::from_f64(element, datum.number(output.to_si)));
    }

    /// Sets a command by its register.
    pub fn set_value(&mut self, register: RegisterId, value: Value) {
        let place = &mut self.values[register.index()];
        if *place == value {
            return;
        }
        let before = std::mem::replace(place, value);
        if self.set.iter().all(|(other, _)| *other != register) {
            self.set.push((register, before));
        }
    }

    /// Ends the event: every command that it changed, in the order in which they were first set.
    pub fn take_changed(&mut self) -> Vec<(RegisterId, Value)> {
        let values = &self.values;
        self.set
            .drain(..)
            .filter(|(register, before)| values[register.index()] != *before)
            .map(|(register, _)| (register, values[register.index()].clone()))
            .collect()
    }

    /// The present value of every command, in the order of their registers.
    pub fn commands(&self) -> Vec<(RegisterId, Value)> {
        let commands = self.map.directed(Direction::Command);
        commands.map(|(register, _)| (register, self.value(register).clone())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench;

    #[test]
    fn a_handle_speaks_si_whatever_the_unit_on_the_wire() {
        let map = Arc::new(bench::map(&[("Robot.XTarget REAL mm", Direction::Command)]));
        let mut binder = Binder::new(&map);
        let target = binder.output::<f64>("Robot", "XTarget");
        let target = binder.finish(target).expect("bound");
        let mut image = Image::new(map);
        image.set(target, 0.25);
        assert_eq!(image.take_changed(), [(RegisterId(0), Value::Real(250.0))]);
        assert!((image.last(target) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn what_a_program_misses_is_told_all_at_once() {
        let map = bench::map(&[("Belt.motorDirection REAL", Direction::Command), ("Belt.go BOOL", Direction::Report)]);
        let mut binder = Binder::new(&map);
        binder.output::<i32>("Belt", "motorDirection");
        binder.output::<bool>("Belt", "go");
        binder.input::<bool>("Belt", "lightBarrierA");
        let error = binder.finish(()).expect_err("three faults");
        assert_eq!(
            error.faults,
            [
                "signal \"Belt.motorDirection\" is REAL, command (expected an integer type, command)",
                "signal \"Belt.go\" is BOOL, report (expected BOOL, command)",
                "no signal \"Belt.lightBarrierA\" (expected BOOL, report)",
            ]
        );
    }

    #[test]
    fn a_command_set_and_set_back_within_one_event_does_not_leave() {
        let map = Arc::new(bench::map(&[("A.x DINT", Direction::Command), ("A.y BOOL", Direction::Command)]));
        let mut binder = Binder::new(&map);
        let (x, y) = (binder.output::<i32>("A", "x"), binder.output::<bool>("A", "y"));
        binder.finish(()).expect("bound");
        let mut image = Image::new(map.clone());
        image.set(y, true);
        image.set(x, 1);
        image.set(x, 0);
        assert_eq!(image.take_changed(), [(RegisterId(1), Value::Bool(true))]);
        assert_eq!(image.take_changed(), []);
    }
}
