//! A proportional position loop within the limits of its drive: the axis moves at what is left of its way divided by the loop's
//! time constant, no faster than the drive can, and its speed changes no more steeply than the drive bears:
//!
//! ```text
//! dx/dt = v,    v → clamp((u − x)/T, ±v_max),    |dv/dt| ≤ a_max
//! ```
//!
//! Source: the first-order lag (K. J. Åström, T. Hägglund, Advanced PID Control, ISA 2006, section 2.4) as the loop that makes it, and
//! saturations of its speed and of that speed's change (H. K. Khalil, Nonlinear Systems, Prentice Hall 2002, section 1.2.7). While
//! the target u stands the law is exact but for the steepness, which is computed from one instant to the next.

use crate::device::path::Motion;

/// The longest step in which a speed that may not change faster is computed, s.
const STEP_S: f64 = 1e-3;

/// How an axis closes on its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// s, above 0
    pub time_constant: f64,
    /// m/s or rad/s; may be infinite
    pub velocity: f64,
    /// m/s² or rad/s²; may be infinite
    pub acceleration: f64,
}

impl Closing {
    /// Where the axis is after `span` (s) that was at `from`, while the target stood at `target`.
    pub fn after(&self, from: Motion, target: f64, span: f64) -> Motion {
        if !self.acceleration.is_finite() {
            return self.unhurried(from.position, target, span);
        }
        let steps = (span / STEP_S).ceil().max(1.0);
        (0..steps as u32).fold(from, |motion, _| self.step(motion, target, span / steps))
    }

    /// Without a limit of steepness: at full speed until the loop asks for less, then by its exponential.
    fn unhurried(&self, position: f64, target: f64, span: f64) -> Motion {
        let left = target - position;
        let eases = self.velocity * self.time_constant;
        let fast = if left.abs() > eases { ((left.abs() - eases) / self.velocity).min(span) } else { 0.0 };
        let position = position + if fast > 0.0 { (self.velocity * fast).copysign(left) } else { 0.0 };
        let left = (target - position) * (-(span - fast) / self.time_constant).exp();
        Motion { position: target - left, velocity: self.asked(left) }
    }

    fn step(&self, from: Motion, target: f64, span: f64) -> Motion {
        let free = self.unhurried(from.position, target, span);
        let most = self.acceleration * span;
        let is_held = |asked: f64, speed: f64| (asked - speed).abs() > most;
        let asked = self.asked(target - from.position);
        if !is_held(free.velocity, from.velocity) && !is_held(asked, from.velocity) {
            return free;
        }
        let velocity = free.velocity.clamp(from.velocity - most, from.velocity + most);
        Motion { position: from.position + 0.5 * (from.velocity + velocity) * span, velocity }
    }

    /// The speed that the loop asks for with so much left of its way.
    fn asked(&self, left: f64) -> f64 {
        (left / self.time_constant).clamp(-self.velocity, self.velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_speed_and_then_the_exponential() {
        // 1 m at 2 m/s until 0.2 m are left, 0.4 s; then e^(−t/T).
        let closing = Closing { time_constant: 0.1, velocity: 2.0, acceleration: f64::INFINITY };
        let after = closing.after(Motion::default(), 1.0, 0.4);
        assert!((after.position - 0.8).abs() < 1e-12 && (after.velocity - 2.0).abs() < 1e-12, "{after:?}");
        let after = closing.after(Motion::default(), 1.0, 0.6);
        let left = 0.2 * (-2.0_f64).exp();
        assert!((after.position - (1.0 - left)).abs() < 1e-12 && (after.velocity - 10.0 * left).abs() < 1e-12);
        // In however many parts.
        let parts = (0..600).fold(Motion::default(), |motion, _| closing.after(motion, 1.0, 1e-3));
        assert!((parts.position - after.position).abs() < 1e-12);
    }

    #[test]
    fn a_speed_rises_no_more_steeply_than_it_may() {
        let closing = Closing { time_constant: 0.1, velocity: 2.0, acceleration: 5.0 };
        // 5 m/s² for 0.2 s: half of 5·0.04 m.
        let after = closing.after(Motion::default(), 1.0, 0.2);
        assert!((after.position - 0.1).abs() < 1e-9 && (after.velocity - 1.0).abs() < 1e-9, "{after:?}");
        // It comes to rest at its target all the same, having passed it: dv/dt = −5 cannot follow T = 0.1 s from 2 m/s.
        let farthest = (1..=3000).fold((Motion::default(), 0.0_f64), |(motion, farthest), _| {
            let next = closing.after(motion, 1.0, 1e-3);
            (next, farthest.max(next.position))
        });
        assert!(farthest.1 > 1.05 && (farthest.0.position - 1.0).abs() < 1e-3, "{farthest:?}");
    }

    #[test]
    fn a_steepness_that_is_never_reached_changes_nothing() {
        let free = Closing { time_constant: 0.05, velocity: 3.0, acceleration: f64::INFINITY };
        let steep = Closing { acceleration: 1e6, ..free };
        let [free, steep] = [free, steep].map(|closing| closing.after(Motion::default(), 0.4, 0.33));
        assert!((free.position - steep.position).abs() < 1e-9 && (free.velocity - steep.velocity).abs() < 1e-9);
    }
}
