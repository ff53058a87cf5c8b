//! The registers' values, and which reports among them changed since somebody asked: of ten thousand devices that stand
//! still, nobody downstream should have to look at each.

use crate::signal_map::RegisterId;
use crate::value::Value;

/// One value for each register, by its id.
pub(super) struct Registers {
    values: Vec<Value>,
    /// The reports that changed since this was asked last, in no order, each once.
    changed: Vec<RegisterId>,
    /// By register id, whether it stands in `changed`.
    listed: Vec<bool>,
}

impl Registers {
    /// With these values, none of which has changed.
    pub fn new(values: Vec<Value>) -> Registers {
        let listed = vec![false; values.len()];
        Registers { values, changed: Vec::new(), listed }
    }

    /// All values, by register id.
    pub fn all(&self) -> &[Value] {
        &self.values
    }

    /// The value of one.
    pub fn get(&self, register: RegisterId) -> &Value {
        &self.values[register.index()]
    }

    /// Keeps what the automation commands, in the register's type, and gives what is kept; `None` where that is no number.
    #[inline]
    pub fn command(&mut self, register: RegisterId, number: f64) -> Option<f64> {
        let place = &mut self.values[register.index()];
        place.set_f64(number);
        place.to_f64()
    }

    /// Sets what is reported.
    #[inline]
    pub fn report(&mut self, register: RegisterId, number: f64) {
        if self.values[register.index()].set_f64(number) {
            self.list(register);
        }
    }

    /// Sets what is held in the place of what would be reported.
    pub fn hold(&mut self, register: RegisterId, value: &Value) {
        let place = &mut self.values[register.index()];
        if place != value {
            place.clone_from(value);
            self.list(register);
        }
    }

    #[inline]
    fn list(&mut self, register: RegisterId) {
        if !std::mem::replace(&mut self.listed[register.index()], true) {
            self.changed.push(register);
        }
    }

    /// Puts the reports that were set to another value since the last call into `out` (cleared first), in the order of their ids.
    pub fn take_changed(&mut self, out: &mut Vec<RegisterId>) {
        out.clear();
        std::mem::swap(out, &mut self.changed);
        // Mostly they are in order: a plant's registers are numbered as its instances stand.
        if !out.is_sorted() {
            out.sort_unstable();
        }
        out.iter().for_each(|register| self.listed[register.index()] = false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_changed_is_said_once_and_in_order() {
        let mut registers = Registers::new(vec![Value::Int(0); 4]);
        for (register, value) in [(3, 7.0), (1, 1.0), (3, 8.0), (2, 0.0), (1, 0.0)] {
            registers.report(RegisterId(register), value);
        }
        let mut changed = vec![RegisterId(0)];
        registers.take_changed(&mut changed);
        // 1 is again what it was: that it may have changed is all that is said.
        assert_eq!(changed, [RegisterId(1), RegisterId(3)]);
        assert_eq!(registers.all(), [0, 0, 0, 8].map(Value::Int));
        registers.take_changed(&mut changed);
        assert!(changed.is_empty());
        assert_eq!(registers.command(RegisterId(0), 9.2), Some(9.0));
        registers.report(RegisterId(3), 8.0);
        registers.hold(RegisterId(3), &Value::Int(9));
        registers.hold(RegisterId(2), &Value::Int(0));
        registers.take_changed(&mut changed);
        assert_eq!(changed, [RegisterId(3)]);
    }
}
