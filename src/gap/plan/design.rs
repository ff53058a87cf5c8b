//! Motions that tell causes apart: each a shape between −1 and 1 over time, and what it shows.
//!
//! A dead time and a lag part at the onset of a step, or in the phase of a chirp; backlash, hysteresis and a stiction band by
//! their amplitude; Coulomb and Stribeck friction at low speeds; a gain and a limit by amplitudes; a delay and a lag of a
//! switch by pulses shorter than both. No one motion shows all, so that each is tried on the rivals at hand.

use std::f64::consts::TAU;

/// How long each motion takes, s.
pub const SPAN_S: f64 = 20.0;

/// A shape.
#[derive(Clone, Copy, Debug)]
pub struct Design {
    pub name: &'static str,
    /// The value, from −1 to 1, at a time from 0 to [`SPAN_S`].
    pub shape: fn(f64) -> f64,
}

/// Motions of something that takes any value, in jumps.
pub const JUMPS: &[Design] = &[
    Design { name: "steps of growing size, both ways", shape: stairs },
    Design { name: "small steps", shape: small_steps },
    Design { name: "pulses of growing length", shape: pulses },
    Design { name: "steps one way, then the other way", shape: one_way },
];

/// Motions beside these of something that follows a target as it moves. A device that goes to each target by a profile of its
/// own is no such thing: driven by one that moves faster than it can, its way hangs on less than anybody can know.
pub const STREAMS: &[Design] = &[
    Design { name: "slow ramps up and down", shape: |t| 0.8 * triangle(t / SPAN_S) },
    Design { name: "fast ramps up and down", shape: |t| 0.8 * triangle(t / 2.0) },
    Design { name: "a chirp from 0.2 Hz to 4 Hz", shape: chirp },
];

/// Sequences of something that is on or off, or goes one way or the other: above 0 is on or forwards, below is backwards.
pub const SWITCHED: &[Design] = &[
    Design { name: "long strokes", shape: |t| square(t / 5.0) },
    Design { name: "short strokes", shape: |t| square(t / 1.2) },
    Design { name: "pulses of growing length", shape: switched_pulses },
];

/// −1 to 1 and back once a turn, 0 at its start.
fn triangle(turns: f64) -> f64 {
    let turn = (turns + 0.25).rem_euclid(1.0);
    if turn < 0.5 { 4.0 * turn - 1.0 } else { 3.0 - 4.0 * turn }
}

fn square(turns: f64) -> f64 {
    if turns.rem_euclid(1.0) < 0.5 { 1.0 } else { -1.0 }
}

fn stairs(t: f64) -> f64 {
    const SIZES: [f64; 6] = [0.1, 0.2, 0.4, 0.6, 0.8, 1.0];
    let step = (t / SPAN_S * 2.0 * SIZES.len() as f64) as usize;
    let size = SIZES[(step / 2).min(SIZES.len() - 1)];
    if step.is_multiple_of(2) { size } else { -size }
}

fn small_steps(t: f64) -> f64 {
    const SIZES: [f64; 10] = [0.01, -0.01, 0.02, 0.0, 0.03, -0.03, 0.05, -0.02, 0.08, 0.0];
    SIZES[(t / SPAN_S * 2.0 * SIZES.len() as f64) as usize % SIZES.len()]
}

/// The frequency grows evenly; the size falls with it, so that the speed does not grow.
fn chirp(t: f64) -> f64 {
    let (from, to) = (0.2, 4.0);
    let frequency = from + (to - from) * t / SPAN_S;
    let phase = TAU * (from * t + 0.5 * (to - from) * t * t / SPAN_S);
    0.5 * (from / frequency) * phase.sin()
}

/// On for 20 ms, then half as long again each time, with pauses of a second.
fn pulses(t: f64) -> f64 {
    let (mut start, mut length) = (0.5, 0.02);
    while start <= t {
        if t < start + length {
            return 1.0;
        }
        start += length + 1.0;
        length *= 1.5;
    }
    0.0
}

fn switched_pulses(t: f64) -> f64 {
    if pulses(t) > 0.0 { 1.0 } else { -1.0 }
}

fn one_way(t: f64) -> f64 {
    let forwards = if t < 0.5 * SPAN_S { 1.0 } else { -1.0 };
    if (t / 1.25).rem_euclid(2.0) < 1.0 { forwards } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_stays_within_its_bounds_and_moves() {
        for design in JUMPS.iter().chain(STREAMS).chain(SWITCHED) {
            let values: Vec<f64> = (0..2_000).map(|i| (design.shape)(f64::from(i) * SPAN_S / 2_000.0)).collect();
            assert!(values.iter().all(|value| (-1.0..=1.0).contains(value)), "{}", design.name);
            assert!(values.iter().any(|value| *value != values[0]), "{}", design.name);
        }
    }

    #[test]
    fn pulses_grow_by_half() {
        let lengths = |from: f64, to: f64| {
            let on = (0..((to - from) * 1e4) as i32).filter(|i| pulses(from + f64::from(*i) * 1e-4) > 0.0);
            on.count() as f64 * 1e-4
        };
        assert!((lengths(0.4, 1.4) - 0.02).abs() < 2e-4);
        assert!((lengths(1.5, 2.5) - 0.03).abs() < 2e-4);
    }
}
