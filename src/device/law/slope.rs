//! The speed of a target that arrives as a staircase.
//!
//! An automation sends positions, one a cycle, each constant until the next: their derivative is 0 but for jumps. What a
//! drive takes for the target's speed is the last jump divided by the time since the jump before it, for as long as the
//! next may reasonably be waited for. A jump after a pause is a step and has no speed.

use super::SAME_INSTANT_S;

/// The longest time between two jumps that still belong to one motion, s: commands of a motion come at 10 Hz or more.
const LONGEST_CYCLE_S: f64 = 0.1;
/// For how much longer than the last time between jumps the next is waited for, as a factor.
const PATIENCE: f64 = 1.5;

/// A staircase and its speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    value: f64,
    /// What it was before the last jump.
    before: f64,
    /// Time from the jump before to the last one; 0 where the last one came after a pause.
    interval: f64,
    /// Time since the last jump, s.
    age: f64,
}

impl Default for Slope {
    /// A staircase that has stood at 0 for ever.
    fn default() -> Slope {
        Slope { value: 0.0, before: 0.0, interval: 0.0, age: f64::INFINITY }
    }
}

impl Slope {
    /// The target is `value` from now on.
    pub fn set(&mut self, value: f64) {
        if value == self.value {
            return;
        }
        // Two jumps at one instant are one.
        if self.age > SAME_INSTANT_S {
            self.before = self.value;
            self.interval = if self.age <= LONGEST_CYCLE_S + SAME_INSTANT_S { self.age } else { 0.0 };
            self.age = 0.0;
        }
        self.value = value;
    }

    /// The target.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Its speed now.
    pub fn rate(&self) -> f64 {
        if self.lasts() > 0.0 { (self.value - self.before) / self.interval } else { 0.0 }
    }

    /// How far a motion at that speed would have gone since the last jump.
    pub fn lead(&self) -> f64 {
        if self.lasts() > 0.0 { self.rate() * self.age } else { 0.0 }
    }

    /// For how long the present speed lasts if no jump comes, s; 0 if it is 0 and stays so.
    pub fn lasts(&self) -> f64 {
        let rest = PATIENCE * self.interval - self.age;
        if rest > SAME_INSTANT_S { rest } else { 0.0 }
    }

    /// Moves by `seconds`.
    pub fn advance(&mut self, seconds: f64) {
        self.age += seconds;
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.value);
        visit(self.before);
        visit(self.interval);
        visit(self.age);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_staircase_has_the_speed_of_its_ramp() {
        let mut slope = Slope::default();
        slope.set(0.01);
        assert_eq!(slope.rate(), 0.0, "the first jump after a pause is a step");
        for k in 2..10 {
            slope.advance(0.02);
            slope.set(0.01 * f64::from(k));
            assert!((slope.rate() - 0.5).abs() < 1e-12, "{}", slope.rate());
        }
        slope.advance(0.029);
        assert!((slope.rate() - 0.5).abs() < 1e-12 && (slope.lasts() - 0.001).abs() < 1e-12);
        slope.advance(0.001);
        assert_eq!((slope.rate(), slope.lasts()), (0.0, 0.0));
    }

    #[test]
    fn a_step_has_none() {
        let mut slope = Slope::default();
        slope.set(1.0);
        slope.advance(0.2);
        slope.set(2.0);
        assert_eq!((slope.value(), slope.rate()), (2.0, 0.0));
    }

    #[test]
    fn two_jumps_at_one_instant_are_one() {
        let mut slope = Slope::default();
        slope.set(0.01);
        slope.advance(0.02);
        slope.set(0.5);
        slope.set(0.02);
        assert!((slope.rate() - 0.5).abs() < 1e-12, "{}", slope.rate());
    }
}
