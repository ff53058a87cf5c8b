//! The laws of motion that devices are made of, each exact over any span with a constant command.
//!
//! A device strings them along its signal path: command → actuator → mechanics → transmission → load → sensor → report.

pub mod closing;
pub mod drive;
pub mod encoder;
pub mod follower;
pub mod lagging;
pub mod profile;
pub mod ramp;
pub mod schedule;
pub mod servo;
pub mod slope;
pub mod stroke;
pub mod sum;
pub mod taylor;
pub mod transition;
pub mod vacuum;

/// What two times may differ by and still be the same, s. The project's clocks count whole nanoseconds: an event within
/// half of one of a span's end belongs to the span, whatever the rounding of the steps that led there.
pub const SAME_INSTANT_S: f64 = 0.5e-9;

/// What two positions (m, rad) or speeds (m/s, rad/s) may differ by and still be the same where a law compares them with
/// a limit: far below what any report resolves, far above what rounding adds up to.
pub const SAME_VALUE: f64 = 1e-9;

/// Whether what moves with `speed` is where it is to come, with `left` to go: so near that it is the same place, or that time would not move.
pub fn is_there(left: f64, speed: f64) -> bool {
    left <= SAME_VALUE.max(SAME_INSTANT_S * speed.abs())
}

/// The speed above which a drive counts as moving, m/s or rad/s (the table of the device kinds: 1 mm/s, 1 mrad/s).
pub const STANDSTILL: f64 = 1e-3;

/// Whether a drive at `velocity` counts as moving: faster than [`STANDSTILL`], that speed itself not included.
pub fn moves(velocity: f64) -> bool {
    velocity.abs() > STANDSTILL + SAME_VALUE
}

/// Which way a drive at `velocity` moves: -1, 1, or 0 where it does not count as moving.
pub fn direction(velocity: f64) -> f64 {
    if moves(velocity) { velocity.signum() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_millimetre_a_second_is_standstill_however_it_was_summed() {
        let mut velocity = 0.5;
        for _ in 0..499 {
            velocity -= 0.001;
        }
        assert!(velocity != 0.001 && !moves(velocity) && !moves(-velocity));
        assert!(moves(0.00100001) && moves(-0.00100001));
    }
}
