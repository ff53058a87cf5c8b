//! `compliance`: the load hangs on a spring with damping: k·(x − y) + d·(x' − y') is what moves it, with the stiffness k and
//! the damping d.
//!
//! On a servo axis with forces the load is half of the axis's M, and pulls back at the motor: two masses and a spring. Where
//! the model knows no mass, stiffness and damping count for each kilogram that hangs there, and the motor does not feel it.
//!
//! Source: the two-mass system (D. Schröder, Elektrische Antriebe: Regelung von Antriebssystemen, Springer 2015, the
//! two-mass system). A servo axis moves together with it, as one linear system ([`Spring`]). Where that is none (a limit is met, friction
//! changes or holds), and behind other devices, the load obeys u'' + (d/m)·u' + (k/m)·u = −x'' with u = y − x; over a stretch x'' is constant
//! and the solution is exact, the force on the motor is its value in the middle of the stretch.

use super::second_order_lag::modes;
use super::table::{BASE, DAMPING, STIFFNESS, UNLIMITED, parameter};
use crate::device::law::servo::Spring;
use crate::device::path::{Burden, Moment, Motion, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// Which share of a servo axis's inertia hangs on the spring.
const LOAD_SHARE: f64 = 0.5;
/// The longest stretch of a motor that feels its load and is not moved together with it, in radians of the spring's oscillation.
const LONGEST_TURN: f64 = 0.05;
/// The shortest stretch, s.
const SHORTEST_S: f64 = 1e-5;
/// The longest stretch of a motor that is moved together with its load, in the same radians: half of what a series is good for, as the
/// drive has rates of its own.
const LONGEST_LEAP: f64 = 1.0;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "compliance",
    summary: "the load hangs on a spring with damping",
    equation: "m·y'' = stiffness·(x − y) + damping·(x' − y')",
    source: "Schröder, Elektrische Antriebe: Regelung von Antriebssystemen, Springer 2015 (two-mass system)",
    places: &[EffectPlace::Transmission],
    parameters: &[
        parameter("stiffness", STIFFNESS, (1.0, UNLIMITED), UNLIMITED, 2e4, "of the spring, N/m or N·m/rad"),
        parameter("damping", DAMPING, (0.0, 1e6), 0.0, 100.0, "of the spring, N·s/m or N·m·s/rad"),
    ],
    excited_by: "changes of speed; on a servo axis the drive's effort as well",
    build: Build::Stage(|values, site| {
        let inertia = if site.has_dynamics() { site.parameters.number("M") } else { 0.0 };
        Box::new(Compliance::new(values[0], values[1], inertia))
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Compliance {
    spring: Spring,
    /// Whether the motor feels it.
    pulls: bool,
    /// The longest stretch of a motor that is moved by itself, and of one that is moved with its load, s.
    stretch: f64,
    leap: f64,
    /// The motor's motion at the end of the last stretch, and its acceleration in it.
    motor: Motion,
    acceleration: f64,
}

impl Compliance {
    /// On an axis that moves `inertia`; 0 where the model knows none.
    fn new(stiffness: f64, damping: f64, inertia: f64) -> Compliance {
        let pulls = inertia > 0.0;
        let mass = if pulls { LOAD_SHARE * inertia } else { 1.0 };
        let spring = Spring::new(stiffness, damping, mass);
        let fastest = spring.rate(mass / LOAD_SHARE - mass);
        let within = |turn: f64| if pulls { (turn / fastest).clamp(SHORTEST_S, STRETCH_S) } else { STRETCH_S };
        let (stretch, leap) = (within(LONGEST_TURN), within(LONGEST_LEAP));
        Compliance { spring, pulls, stretch, leap, motor: Motion::default(), acceleration: 0.0 }
    }

    fn is_rigid(&self) -> bool {
        self.spring.stiffness >= UNLIMITED
    }

    /// How the load moves.
    fn behind(&self) -> Motion {
        let (Motion { position, velocity }, ahead) = (self.motor, self.spring.ahead);
        Motion { position: position + ahead.position, velocity: velocity + ahead.velocity }
    }

    /// What the load gets ahead after `span` of a motor that accelerates evenly.
    fn after(&self, span: f64, acceleration: f64) -> Motion {
        let Spring { stiffness, damping, mass, ahead, .. } = self.spring;
        let (square, decay) = (stiffness / mass, 0.5 * damping / mass);
        let (cosine, sine) = modes(square.sqrt(), decay, span);
        let sag = -acceleration / square;
        let (u, du) = (ahead.position - sag, ahead.velocity);
        Motion {
            position: sag + u * cosine + (du + decay * u) * sine,
            velocity: du * cosine - (square * u + decay * du) * sine,
        }
    }
}

impl Stage for Compliance {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        if self.is_rigid() { f64::INFINITY } else { self.stretch }
    }

    fn leap(&self) -> f64 {
        if self.is_rigid() { f64::INFINITY } else { self.leap }
    }

    fn spring(&mut self) -> Option<&mut Spring> {
        (self.pulls && !self.is_rigid()).then_some(&mut self.spring)
    }

    fn burden(&mut self, burden: Burden, _motion: Motion, moment: Moment) -> Burden {
        if !self.pulls || self.is_rigid() {
            return burden;
        }
        let pull = self.spring.pull_of(self.after(0.5 * moment.span, self.acceleration));
        Burden { inertia: burden.inertia - self.spring.mass, force: burden.force - pull }
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        if self.is_rigid() {
            return motion;
        }
        if moment.span > 0.0 {
            let way = motion.position - self.motor.position;
            let even = 0.5 * (self.motor.velocity + motion.velocity) * moment.span;
            let is_parabola = (way - even).abs() <= 1e-9 + 1e-3 * (way.abs() + even.abs());
            let slope = way / moment.span;
            let (from, to) = if is_parabola { (self.motor.velocity, motion.velocity) } else { (slope, slope) };
            // Where the motor's speed jumps the load's does not.
            self.spring.ahead.velocity -= from - self.motor.velocity;
            self.acceleration = (to - from) / moment.span;
            self.spring.ahead = self.after(moment.span, self.acceleration);
            self.spring.ahead.velocity -= motion.velocity - to;
            self.motor = motion;
        } else {
            // Where the motor jumps the load does not.
            self.spring.ahead.position -= motion.position - self.motor.position;
            self.spring.ahead.velocity -= motion.velocity - self.motor.velocity;
            self.motor = motion;
        }
        self.behind()
    }

    fn leapt(&mut self, motion: Motion, moment: Moment) -> Motion {
        self.acceleration = (motion.velocity - self.motor.velocity) / moment.span;
        self.motor = motion;
        self.behind()
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        let Compliance { motor, acceleration, spring: Spring { ahead, .. }, .. } = self;
        [motor.position, motor.velocity, ahead.position, ahead.velocity, *acceleration].into_iter().for_each(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    fn spring(stiffness: f64, damping: f64) -> [crate::plant::EffectSpec; 1] {
        [spec("transmission", "compliance", None, &[("stiffness", stiffness), ("damping", damping)])]
    }

    #[test]
    fn behind_a_ramp_the_load_swings_as_the_closed_form_says() {
        // 1 kg on 400 N/m with 8 N·s/m: 20 rad/s, damping ratio 0.2; x'' = 1 m/s² from rest.
        let mut belt = with("StraightConveyor", &[], &spring(400.0, 8.0));
        belt.check(&[("velocityTarget", 9.0), ("motorDirection", 1.0)], 0.3, &[("velocityActual", 0.3)]);
        let (decay, turn) = (4.0_f64, (400.0_f64 - 16.0).sqrt());
        let rest = (-decay * 0.3_f64).exp() * ((turn * 0.3).cos() + decay / turn * (turn * 0.3).sin());
        let exact = 0.045 - (1.0 - rest) / 400.0;
        assert!((belt.displacement() - exact).abs() < 1e-12, "{} {exact}", belt.displacement());
    }

    #[test]
    fn two_masses_and_a_spring_swing_about_their_common_centre() {
        // 10 kg and 10 kg on 2 kN/m under 40 N at the motor: the centre goes 1/2·2·t², the load swings about it with
        // sqrt(k/5 kg) = 20 rad/s by −(F/m1)/ω²·(1 − cos ωt)·m1/M.
        let mut axis = with("ServoAxis", &[("mode", "force"), ("Fv", "0")], &spring(2000.0, 0.0));
        axis.check(&[("forceTarget", 40.0)], 0.0, &[]);
        for step in 1..=400 {
            axis.device.advance(0.005);
            let time = 0.005 * f64::from(step);
            let swing = -4.0 / 400.0 * (1.0 - (20.0 * time).cos()) * 0.5;
            let (found, exact) = (axis.report("position"), time * time + swing);
            assert!((found - exact).abs() < 2e-5, "at {time}: {found} {exact}");
        }
    }

    /// Held by friction, at its limit of force and on a stiff spring: as long as the span is short, nothing is left to the leaps.
    #[test]
    fn a_stiff_spring_behind_a_rubbing_axis_swings_the_same_in_long_spans_and_in_short_ones() {
        let effects = [
            spec("mechanics", "coulomb-friction", None, &[("force", 20.0)]),
            spring(5.0 * 448.0_f64.powi(2), 10.0 * 0.05 * 448.0)[0].clone(),
        ];
        let moved = |spans: u32| {
            let mut axis = with("ServoAxis", &[("forceLimit", "300")], &effects);
            let mut seen = Vec::new();
            for target in [0.05, 0.05, -0.02, 0.1, 0.1] {
                axis.check(&[("positionTarget", target)], 0.0, &[]);
                (0..spans).for_each(|_| axis.device.advance(0.2 / f64::from(spans)));
                seen.push((axis.report("position"), axis.report("velocity")));
            }
            seen
        };
        let fine = moved(20_000);
        for spans in [20, 100] {
            for ((position, velocity), (fine_position, fine_velocity)) in moved(spans).into_iter().zip(&fine) {
                assert!((position - fine_position).abs() < 2e-5, "{spans}: {position} {fine_position}");
                assert!((velocity - fine_velocity).abs() < 2e-3, "{spans}: {velocity} {fine_velocity}");
            }
        }
    }
}
