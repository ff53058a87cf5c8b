//! Two masses and a spring: an axis under its drive, and a load that hangs behind it on a spring with damping.
//!
//! ```text
//! m₁·dv/dt = F − d·v − load + pull,   m₂·d(v + w)/dt = −pull,   du/dt = w,   pull = k·u + c·w
//! ```
//!
//! where u is how far the load is ahead of the axis. With F what the loop demands, or a limit of it, that is one linear system, moved
//! by its transition however stiff the spring is: see [`Transitions`].
//!
//! Source: D. Schröder, Elektrische Antriebe: Regelung von Antriebssystemen, Springer 2015, the two-mass system.

use nalgebra::{SMatrix, SVector};

use super::{Course, Linear, Mechanics, Servo, Transitions};
use crate::device::law::transition::System;
use crate::device::path::Motion;

/// Position, velocity, integrator; how far the load is ahead, and how fast it gets ahead.
const STATES: usize = 5;

/// A spring with what hangs on it.
#[derive(Clone, Debug)]
pub struct Spring {
    /// N/m or N·m/rad.
    pub stiffness: f64,
    /// N·s/m or N·m·s/rad.
    pub damping: f64,
    /// What hangs on it, kg or kg·m².
    pub mass: f64,
    /// How far that is ahead of the axis, and how fast it gets ahead.
    pub ahead: Motion,
    transitions: Transitions<Sprung, STATES>,
}

/// An axis and its spring over a span.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sprung {
    servo: Linear,
    stiffness: f64,
    damping: f64,
    mass: f64,
}

impl System<STATES> for Sprung {
    fn span(&self) -> f64 {
        self.servo.span
    }

    fn matrix(&self) -> SMatrix<f64, STATES, STATES> {
        let Sprung { servo, stiffness, damping, mass } = *self;
        let ([by_position, by_velocity, by_integrator], [first, second, third]) = (servo.forces(), servo.resets());
        let speeds_up =
            [by_position, by_velocity, by_integrator, stiffness, damping].map(|force| force / servo.inertia);
        let hangs = [0.0, 0.0, 0.0, stiffness / mass, damping / mass];
        let gets_ahead = std::array::from_fn(|k| -speeds_up[k] - hangs[k]);
        let moves = [0.0, 1.0, 0.0, 0.0, 0.0];
        let leads = [0.0, 0.0, 0.0, 0.0, 1.0];
        let rows = [moves, speeds_up, [first, second, third, 0.0, 0.0], leads, gets_ahead];
        SMatrix::from_fn(|row, column| rows[row][column])
    }

    fn demand(&self) -> SVector<f64, STATES> {
        SVector::from([self.servo.position_gain, self.servo.velocity_gain, 1.0, 0.0, 0.0])
    }
}

impl Spring {
    /// One that is at rest.
    pub fn new(stiffness: f64, damping: f64, mass: f64) -> Spring {
        Spring { stiffness, damping, mass, ahead: Motion::default(), transitions: Transitions::default() }
    }

    /// What it does to the axis now, N or N·m.
    pub fn pull(&self) -> f64 {
        self.pull_of(self.ahead)
    }

    /// The same where the load is so far ahead.
    pub fn pull_of(&self, ahead: Motion) -> f64 {
        self.stiffness * ahead.position + self.damping * ahead.velocity
    }

    /// A bound of the rates at which it swings behind an axis of `inertia`, 1/s.
    pub fn rate(&self, inertia: f64) -> f64 {
        let reduced = self.mass * inertia / (self.mass + inertia);
        (self.stiffness / reduced).sqrt() + self.damping / reduced
    }
}

impl Servo {
    /// Moves by `seconds` together with what hangs on `spring`, whose pull its load need not hold, at once. Returns false, and moves
    /// nothing, where a limit of the drive comes near on the way, for the first time with a span and a spring, and over what is no
    /// linear system or too long.
    pub fn leap_with(&mut self, spring: &mut Spring, seconds: f64) -> bool {
        let Mechanics { inertia, load, .. } = self.mechanics;
        let pull = spring.pull();
        self.mechanics.load = load - pull;
        let course = self.course(seconds, spring.rate(inertia));
        self.mechanics.load = load;
        let Some(Course { linear, margin, slopes }) = course else { return false };
        let Spring { stiffness, damping, mass, ahead, .. } = *spring;
        let [moves, speeds_up, resets] = slopes.into();
        let slopes = SVector::from([moves, speeds_up, resets, ahead.velocity, -speeds_up - pull / mass]);
        let sprung = Sprung { servo: linear, stiffness, damping, mass };
        let Some(known) = spring.transitions.of(sprung) else { return false };
        if !known.keeps_within(margin, slopes) {
            return false;
        }
        let [position, velocity, integral, gained, gaining] = known.change(slopes).into();
        self.gain(position, velocity, integral);
        spring.ahead.position += gained;
        spring.ahead.velocity += gaining;
        true
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::device::law::servo::Loop;
    use crate::device::law::servo::tests::runge_kutta;

    /// Position, velocity, integrator, ahead, getting ahead: the equations by themselves.
    fn by_runge_kutta(servo: &Servo, spring: &Spring, seconds: f64, steps: u32) -> [f64; STATES] {
        let slopes = |y: [f64; STATES]| {
            let mut there = *servo;
            (there.position, there.velocity, there.integral) = (y[0], y[1], y[2]);
            let pull = spring.pull_of(Motion { position: y[3], velocity: y[4] });
            let acceleration = (there.force() - there.resistance() + pull) / there.mechanics.inertia;
            let reset = there.drive.integral_time.filter(|_| there.torque).map_or(0.0, |time| 1.0 / time);
            [y[1], acceleration, (there.force() - y[2]) * reset, y[4], -acceleration - pull / spring.mass]
        };
        let start = [servo.position, servo.velocity, servo.integral, spring.ahead.position, spring.ahead.velocity];
        runge_kutta(start, slopes, seconds, steps)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn both_move_as_their_equations_have_it(
            reference in -5000.0..5000.0_f64, velocity in -1.0..1.0_f64, limit in 100.0..6000.0_f64, swing in 7.0..1000.0_f64,
            ratio in 0.0..0.5_f64, span in 1e-4..1e-3_f64, integral_time in prop::option::of(0.02..1.0_f64), load in -50.0..50.0_f64,
            torque in prop::bool::weighted(0.9), stretched in -1e-4..1e-4_f64,
        ) {
            let drive = Loop { position_gain: 20_000.0, velocity_gain: 800.0, integral_time, limit, back_emf: 0.0 };
            let mechanics = Mechanics { inertia: 10.0, viscous_friction: 50.0, load, pendulum: 0.0 };
            let mut servo = Servo::new(drive, mechanics);
            servo.shift(0.0, velocity);
            (servo.reference, servo.torque) = (reference, torque);
            let mut spring = Spring::new(5.0 * swing * swing, 10.0 * ratio * swing, 10.0);
            spring.ahead.position = stretched;
            for _ in 0..40 {
                let exact = by_runge_kutta(&servo, &spring, span, 20);
                let before = servo;
                if !servo.leap_with(&mut spring, span) {
                    // A limit is near, or the span new: the equations go on alone.
                    prop_assert_eq!(servo.position, before.position);
                    [servo.position, servo.velocity, servo.integral, spring.ahead.position, spring.ahead.velocity] = exact;
                    continue;
                }
                let found = [servo.position, servo.velocity, servo.integral, spring.ahead.position, spring.ahead.velocity];
                for (k, bound) in [1e-9, 1e-6, 1e-4, 1e-9, 1e-6].into_iter().enumerate() {
                    prop_assert!((found[k] - exact[k]).abs() < bound, "{k}: {found:?} {exact:?}");
                }
            }
        }
    }

    #[test]
    fn what_hangs_on_a_stiff_spring_is_moved_in_long_stretches() {
        let drive = Loop { position_gain: 0.0, velocity_gain: 0.0, integral_time: None, limit: 500.0, back_emf: 0.0 };
        let mechanics = Mechanics { inertia: 10.0, viscous_friction: 0.0, load: 0.0, pendulum: 0.0 };
        let mut servo = Servo::new(drive, mechanics);
        servo.reference = 40.0;
        // Two masses of 10 kg, 1500 rad/s: the centre goes 1/2·2·t², the load is behind by (F/m₁)/ω²·(1 − cos ωt).
        let mut spring = Spring::new(5.0 * 1500.0 * 1500.0, 0.0, 10.0);
        let leaps = (0..1000).filter(|_| servo.leap_with(&mut spring, 1e-3)).count();
        assert_eq!(leaps, 999, "all but the first");
        let time = 0.999_f64;
        let behind = 4.0 / (1500.0 * 1500.0) * (1.0 - (1500.0 * time).cos());
        assert!((spring.ahead.position + behind).abs() < 1e-15, "{} {behind}", spring.ahead.position);
        assert!((servo.position() - (time * time + 0.5 * behind)).abs() < 1e-12, "{}", servo.position());
    }
}
