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

    /// Keeps what the automation commands.
    pub fn command(&mut self, register: RegisterId, value: Value) {
        self.values[register.index()] = value;
    }

    /// Sets what is reported.
    pub fn report(&mut self, register: RegisterId, value: Value) {
        let place = &mut self.values[register.index()];
        if *place != value && !std::mem::replace(&mut self.listed[register.index()], true) {
            self.changed.push(register);
        }
        *place = value;
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
        for (register, value) in [(3, 7), (1, 1), (3, 8), (2, 0), (1, 0)] {
            registers.report(RegisterId(register), Value::Int(value));
        }
        let mut changed = vec![RegisterId(0)];
        registers.take_changed(&mut changed);
        // 1 is again what it was: that it may have changed is all that is said.
        assert_eq!(changed, [RegisterId(1), RegisterId(3)]);
        assert_eq!(registers.all(), [0, 0, 0, 8].map(Value::Int));
        registers.take_changed(&mut changed);
        assert!(changed.is_empty());
        registers.command(RegisterId(0), Value::Int(9));
        registers.report(RegisterId(3), Value::Int(9));
        registers.take_changed(&mut changed);
        assert_eq!(changed, [RegisterId(3)]);
    }
}
