use proptest::prelude::*;

use super::*;

/// The axis of the rig: 25 1/s and 800 N·s/m, 20 kg, 50 N·s/m.
fn rig(limit: f64) -> Servo {
    let drive = Loop { position_gain: 25.0 * 800.0, velocity_gain: 800.0, integral_time: None, limit, back_emf: 0.0 };
    Servo::new(drive, Mechanics { inertia: 20.0, viscous_friction: 50.0, load: 0.0, pendulum: 0.0 })
}

fn check(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} instead of {expected}");
}

#[test]
fn under_a_force_that_nothing_changes_it_glides_as_its_series_has_it() {
    for (viscous_friction, seconds) in
        [(0.0, 0.3), (0.5, 0.3), (50.0, 1e-4), (50.0, 7e-3), (50.0, 9e-3), (3000.0, 0.01)]
    {
        let mut glides = rig(1000.0);
        (glides.position, glides.velocity) = (0.2, -0.7);
        glides.burden(Mechanics { inertia: 20.0, viscous_friction, load: 30.0, pendulum: 0.0 });
        glides.open(80.0);
        let mut series = glides;
        // A limit far off: the same motion, computed as any.
        series.limit(1e9);
        assert!(glides.is_open() && !series.is_open());
        glides.advance(seconds);
        series.advance(seconds);
        check(glides.position, series.position, 1e-14);
        check(glides.velocity, series.velocity, 2e-14);
        assert!((glides.velocity + 0.7).abs() > 1e-5);
    }
}

/// Where a state is after `seconds` that moves by these slopes: classical Runge-Kutta, in steps so short that a limit taken within one does
/// not matter.
pub(super) fn runge_kutta<const STATES: usize>(
    start: [f64; STATES],
    slopes: impl Fn([f64; STATES]) -> [f64; STATES],
    seconds: f64,
    steps: u32,
) -> [f64; STATES] {
    let h = seconds / f64::from(steps);
    let ahead = |state: [f64; STATES], by: [f64; STATES], h: f64| std::array::from_fn(|k| state[k] + h * by[k]);
    (0..steps).fold(start, |state, _| {
        let first = slopes(state);
        let second = slopes(ahead(state, first, 0.5 * h));
        let third = slopes(ahead(state, second, 0.5 * h));
        let fourth = slopes(ahead(state, third, h));
        std::array::from_fn(|k| state[k] + h / 6.0 * (first[k] + 2.0 * (second[k] + third[k]) + fourth[k]))
    })
}

/// The same motion by a method of its own: position, velocity and integrator.
fn by_runge_kutta(servo: &Servo, seconds: f64, steps: u32) -> (f64, f64, f64) {
    let slopes = |[x, v, i]: [f64; 3]| {
        let demand = servo.reference - servo.drive.position_gain * x - servo.drive.velocity_gain * v + i;
        let force = if servo.torque { demand.clamp(-servo.drive.limit, servo.drive.limit) } else { 0.0 };
        let Mechanics { inertia, viscous_friction, load, pendulum } = servo.mechanics;
        let resistance = viscous_friction * v + load + pendulum * GRAVITY * x.sin();
        let reset = servo.drive.integral_time.map_or(0.0, |time| (force - i) / time);
        [v, (force - resistance) / inertia, reset]
    };
    runge_kutta([servo.position, servo.velocity, servo.integral], slopes, seconds, steps).into()
}

#[test]
fn a_step_is_the_closed_form_of_the_second_order_whatever_the_span() {
    for span in [0.001, 0.02, 0.0137] {
        let mut axis = rig(1e9);
        axis.reference = 20_000.0 * 0.01;
        let (stiffness, damping) = (1000.0_f64, 42.5_f64);
        let decay = damping / 2.0;
        let frequency = (stiffness - decay * decay).sqrt();
        for step in 1..=(0.5 / span) as u32 {
            axis.advance(span);
            let time = span * f64::from(step);
            let (sine, cosine) = (frequency * time).sin_cos();
            let envelope = 0.01 * (-decay * time).exp();
            check(axis.position(), 0.01 - envelope * (cosine + decay / frequency * sine), 1e-15);
            check(axis.velocity(), envelope * stiffness / frequency * sine, 1e-13);
        }
    }
}

#[test]
fn at_its_limit_it_is_the_closed_form_of_the_first_order() {
    let mut axis = rig(500.0);
    axis.reference = 20_000.0 * 10.0;
    for step in 1..=40 {
        axis.advance(0.02);
        let time = 0.02 * f64::from(step);
        let decay = (-2.5 * time).exp();
        check(axis.velocity(), 10.0 * (1.0 - decay), 1e-12);
        check(axis.position(), 10.0 * time - 4.0 * (1.0 - decay), 1e-12);
        check(axis.force(), 500.0, 0.0);
    }
}

#[test]
fn a_constant_force_alone_gives_a_parabola() {
    let drive = Loop { position_gain: 0.0, velocity_gain: 0.0, integral_time: None, limit: 500.0, back_emf: 0.0 };
    let mechanics = Mechanics { inertia: 20.0, viscous_friction: 0.0, load: 10.0, pendulum: 0.0 };
    let mut axis = Servo::new(drive, mechanics);
    axis.reference = 50.0;
    axis.advance(10.0);
    check(axis.velocity(), 20.0, 1e-13);
    check(axis.position(), 100.0, 1e-12);
}

#[test]
fn a_limit_is_left_at_its_very_instant() {
    // Until 800·(25·(0.08 − x) − v) falls to 500 the axis accelerates at its limit; both spans cross it.
    let mut fine = rig(500.0);
    let mut coarse = rig(500.0);
    fine.reference = 20_000.0 * 0.08;
    coarse.reference = fine.reference;
    for _ in 0..500 {
        fine.advance(0.001);
    }
    coarse.advance(0.5);
    let (x, v, _) = by_runge_kutta(
        &{
            let mut start = rig(500.0);
            start.reference = 20_000.0 * 0.08;
            start
        },
        0.5,
        500_000,
    );
    for axis in [fine, coarse] {
        check(axis.position(), x, 1e-9);
        check(axis.velocity(), v, 1e-8);
    }
    check(fine.position(), coarse.position(), 1e-14);
}

#[test]
fn an_integrator_holds_a_load_and_does_not_wind_up() {
    let mut axis = rig(500.0);
    axis.drive.integral_time = Some(0.05);
    axis.mechanics.load = 300.0;
    axis.rate = rate(&axis.drive, &axis.mechanics);
    axis.advance(3.0);
    check(axis.position(), 0.0, 1e-9);
    check(axis.force(), 300.0, 1e-6);
    // A long way at the limit: with a wound-up integrator it would shoot far past the target.
    axis.reference = 20_000.0 * 1.0;
    let mut highest = 0.0_f64;
    for _ in 0..5000 {
        axis.advance(0.001);
        highest = highest.max(axis.position());
    }
    check(axis.position(), 1.0, 1e-6);
    assert!(highest < 1.05, "{highest}");
}

#[test]
fn a_pendulum_keeps_its_energy_and_falls_freely_without_torque() {
    let drive = Loop { position_gain: 0.0, velocity_gain: 0.0, integral_time: None, limit: 1.0, back_emf: 0.0 };
    let pendulum = Mechanics { inertia: 0.0049, viscous_friction: 0.0, load: 0.0, pendulum: 0.049 };
    let mut servo = Servo::new(drive, pendulum);
    (servo.torque, servo.position) = (false, 3.0);
    let energy = |servo: &Servo| 0.5 * 0.0049 * servo.velocity.powi(2) - 0.049 * GRAVITY * servo.position.cos();
    let start = energy(&servo);
    for _ in 0..5000 {
        servo.advance(0.005);
        check(energy(&servo), start, 1e-11);
    }
    // Small swings: period 2π·sqrt(l / g), corrected for their amplitude by 1 + θ²/16.
    (servo.position, servo.velocity) = (0.001, 0.0);
    let period = std::f64::consts::TAU * (0.1 / GRAVITY).sqrt() * (1.0 + 1e-6 / 16.0);
    servo.advance(period);
    check(servo.position, 0.001, 1e-13);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn it_is_the_solution_of_its_equations(
        reference in -5000.0..5000.0_f64, position in -0.3..0.3_f64, velocity in -1.0..1.0_f64,
        limit in 1.0..600.0_f64, load in -100.0..100.0_f64, reset in prop::option::of(0.02..1.0_f64),
        pendulum in prop::option::of(0.1..20.0_f64), torque in prop::bool::weighted(0.9),
    ) {
        let mut axis = rig(limit);
        axis.drive.integral_time = reset;
        axis.mechanics.load = load;
        axis.mechanics.pendulum = pendulum.unwrap_or(0.0);
        axis.rate = rate(&axis.drive, &axis.mechanics);
        (axis.reference, axis.position, axis.velocity, axis.torque) = (reference, position, velocity, torque);
        let (x, v, i) = by_runge_kutta(&axis, 0.5, 50_000);
        axis.advance(0.5);
        // What the reference loses in the steps in which a limit is taken.
        prop_assert!((axis.position - x).abs() < 1e-6, "{} {x}", axis.position);
        prop_assert!((axis.velocity - v).abs() < 1e-5, "{} {v}", axis.velocity);
        if torque {
            prop_assert!((axis.integral - i).abs() < 1e-2, "{} {i}", axis.integral);
        }
    }

    #[test]
    fn splitting_a_span_changes_nothing(
        reference in -5000.0..5000.0_f64, position in -0.3..0.3_f64, velocity in -1.0..1.0_f64,
        limit in 0.0..600.0_f64, reset in prop::option::of(0.02..1.0_f64), pendulum in prop::option::of(0.1..20.0_f64),
        parts in 2..200_u32,
    ) {
        let mut axis = rig(limit);
        axis.drive.integral_time = reset;
        axis.mechanics.pendulum = pendulum.unwrap_or(0.0);
        axis.rate = rate(&axis.drive, &axis.mechanics);
        (axis.reference, axis.position, axis.velocity) = (reference, position, velocity);
        let mut split = axis;
        axis.advance(0.5);
        for _ in 0..parts {
            split.advance(0.5 / f64::from(parts));
        }
        prop_assert!((axis.position - split.position).abs() < 1e-9);
        prop_assert!((axis.velocity - split.velocity).abs() < 1e-9);
        prop_assert!((axis.integral - split.integral).abs() < 1e-6);
    }
}
