//! An axis under a servo drive: the drive's loop, and the mass it moves against friction and load.
//!
//! With command and limits constant this is
//!
//! ```text
//! demand = r − gx·x − gv·v + i            r, gx, gv: from the mode and its gains; i: the integrator
//! F      = demand, kept within ±limit     (0 while torque is off)
//! di/dt  = (F − i) / Ti                   where there is an integrator
//! M·dv/dt = F − Fv·v − load − m·g·l·sin(x)
//! dx/dt  = v
//! ```
//!
//! The integrator is written as automatic reset: inside the limits F − i is the loop's proportional part and i its usual
//! integral; at a limit i tends to the limit with the same time constant and cannot wind up (K. J. Åström, T. Hägglund,
//! Advanced PID Control, ISA 2006, on integrator windup).
//!
//! The motion is computed by its Taylor series from one change of regime (a limit taken or left) to the next, so that it
//! is exact whatever the span: see [`super::taylor`].

use nalgebra::Vector3;

use super::taylor::{ORDER, RECIPROCALS, Series, order_for};
use super::transition::{Linear, Transitions};

/// Standard gravity, m/s² (3rd CGPM, 1901).
const GRAVITY: f64 = 9.80665;

/// The steps a motion is computed in, as a multiple of 1 / ρ, where ρ bounds its rates: what [`ORDER`] is good for.
const LINEAR_STEP: f64 = 2.0;
/// The same with a pendulum, whose series converges only near the start of the step.
const PENDULUM_STEP: f64 = 0.25;
/// How many coefficients the series of a short step has at most, so that it need not carry the room of a long one.
const FEW: usize = 16;
/// How many changes of regime a single span may hold. A motion that touches a limit for an instant may ask for more by
/// rounding alone; what is then left of the span is computed in the regime it has.
const MOST_CHANGES: u32 = 64;
/// The highest rate ρ a drive may have, 1/s: hundred times that of the fastest servo drives' speed loops.
pub const HIGHEST_RATE: f64 = 1e5;

/// What the drive's demand is made of: `reference − position_gain·x − velocity_gain·v + integral`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loop {
    pub position_gain: f64,
    pub velocity_gain: f64,
    /// Reset time of the integrator, s; `None` where there is none.
    pub integral_time: Option<f64>,
    /// Greatest force either way, N or N·m.
    pub limit: f64,
    /// What the motor's own voltage takes from the force for each unit of speed while the drive is on, beyond the limit too;
    /// N·s/m or N·m·s/rad.
    pub back_emf: f64,
}

/// What the drive moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mechanics {
    /// kg or kg·m².
    pub inertia: f64,
    /// N·s/m or N·m·s/rad.
    pub viscous_friction: f64,
    /// Opposes positive motion if positive, N or N·m.
    pub load: f64,
    /// Mass (kg) times length (m) of a pendulum, 0 where there is none.
    pub pendulum: f64,
}

/// An axis with its drive, at rest at 0 to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    drive: Loop,
    mechanics: Mechanics,
    /// A bound of the rates at which both can move, 1/s.
    rate: f64,
    /// The part of the demand that is constant over a span.
    pub reference: f64,
    /// Whether the drive may exert a force at all.
    pub torque: bool,
    position: f64,
    velocity: f64,
    integral: f64,
}

/// Which force the drive exerts over a stretch of time.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Regime {
    /// What the loop demands.
    Free,
    /// Its upper limit.
    Upper,
    /// Its lower limit.
    Lower,
    /// None.
    Off,
}

/// The motion over a stretch of time.
struct Motion<const COUNT: usize> {
    position: Series<COUNT>,
    velocity: Series<COUNT>,
    integral: Series<COUNT>,
    demand: Series<COUNT>,
}

impl<const COUNT: usize> Motion<COUNT> {
    fn new(order: usize) -> Self {
        let zero = Series::zero(order);
        Motion { position: zero, velocity: zero, integral: zero, demand: zero }
    }
}

/// A bound of the rates at which an axis can move, 1/s: the sum of the rates that stand for each coupling alone (a norm of
/// the system's matrix in the scaling of its states that makes it least); above 0.
fn rate(drive: &Loop, mechanics: &Mechanics) -> f64 {
    let Loop { position_gain, velocity_gain, integral_time, back_emf, .. } = *drive;
    let Mechanics { inertia, viscous_friction, pendulum, .. } = *mechanics;
    let stiffness = position_gain + pendulum * GRAVITY;
    let reset = integral_time.map_or(0.0, |time| {
        1.0 / time + (velocity_gain / (inertia * time)).sqrt() + (position_gain / (inertia * time)).cbrt()
    });
    let rate = (stiffness / inertia).sqrt() + (velocity_gain + viscous_friction + back_emf) / inertia + reset;
    rate.max(f64::MIN_POSITIVE)
}

impl Servo {
    /// An axis at rest at 0, torque on.
    pub fn new(drive: Loop, mechanics: Mechanics) -> Servo {
        let rate = rate(&drive, &mechanics);
        Servo { drive, mechanics, rate, reference: 0.0, torque: true, position: 0.0, velocity: 0.0, integral: 0.0 }
    }

    /// From now on the drive's greatest force either way is `limit`, N or N·m.
    pub fn limit(&mut self, limit: f64) {
        self.drive.limit = limit;
    }

    /// From now on this is what it moves.
    pub fn burden(&mut self, mechanics: Mechanics) {
        let Mechanics { load, .. } = self.mechanics;
        if (Mechanics { load, ..mechanics }) != self.mechanics {
            self.rate = rate(&self.drive, &mechanics);
        }
        self.mechanics = mechanics;
    }

    /// From now on its loop feeds the position back with `gain`.
    pub fn feed_back(&mut self, gain: f64) {
        if gain != self.drive.position_gain {
            self.drive.position_gain = gain;
            self.rate = rate(&self.drive, &self.mechanics);
        }
    }

    /// What it moves.
    pub fn moved(&self) -> Mechanics {
        self.mechanics
    }

    /// What the drive will exert `seconds` from now if the axis is accelerated with `acceleration` until then; N or N·m.
    pub fn force_after(&self, seconds: f64, acceleration: f64) -> f64 {
        let Loop { position_gain, velocity_gain, limit, .. } = self.drive;
        let gained = acceleration * seconds;
        let way = (self.velocity + 0.5 * gained) * seconds;
        let demand = self.demand() - position_gain * way - velocity_gain * gained;
        if self.torque { demand.clamp(-limit, limit) } else { 0.0 }
    }

    /// From now on the drive exerts `force` whatever its loop demands, N or N·m; the loop's gains stay without effect.
    pub fn open(&mut self, force: f64) {
        let back_emf = self.back_emf();
        self.drive = Loop { position_gain: 0.0, velocity_gain: 0.0, integral_time: None, limit: f64::MAX, back_emf };
        self.rate = rate(&self.drive, &self.mechanics);
        self.reference = force;
        self.integral = 0.0;
        self.torque = true;
    }

    /// Lies still where it is: something holds it.
    pub fn hold(&mut self) {
        self.velocity = 0.0;
    }

    /// Takes position and velocity from `other`, and keeps its own drive and integrator.
    pub fn follow(&mut self, other: &Servo) {
        self.position = other.position;
        self.velocity = other.velocity;
    }

    /// Is elsewhere at once, and faster, by so much; its integrator stays as it is.
    pub fn shift(&mut self, position: f64, velocity: f64) {
        self.position += position;
        self.velocity += velocity;
    }

    /// Lets `seconds` pass at rest: only the integrator moves, towards what the drive exerts.
    pub fn wait(&mut self, seconds: f64) {
        if let (Some(time), true) = (self.drive.integral_time, self.torque) {
            let share = 1.0 - (-seconds / time).exp();
            self.integral += (self.force() - self.integral) * share;
        }
    }

    /// What drives the axis now: the drive's force less load and weight, friction apart; N or N·m.
    pub fn driving(&self) -> f64 {
        self.force() - (self.resistance() - self.damping() * self.velocity)
    }

    /// Present position, m or rad.
    pub fn position(&self) -> f64 {
        self.position
    }

    /// Present velocity, m/s or rad/s.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// What the drive exerts now, after its limit; N or N·m.
    pub fn force(&self) -> f64 {
        if self.torque { self.demand().clamp(-self.drive.limit, self.drive.limit) } else { 0.0 }
    }

    /// What the loop asks for now, before the limit.
    fn demand(&self) -> f64 {
        let Loop { position_gain, velocity_gain, .. } = self.drive;
        self.reference - position_gain * self.position - velocity_gain * self.velocity + self.integral
    }

    /// A bound of the rates at which loop and mechanics can move, 1/s.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Moves by `seconds`, as [`advance`](Self::advance) does, and faster where that span came before: `transitions` are those
    /// of this axis. Which of the two it was shows in the last digit at most.
    pub fn advance_again(&mut self, seconds: f64, transitions: &mut Transitions) {
        if !self.leap(seconds, transitions) {
            self.advance(seconds);
        }
    }

    /// Moves by `seconds` by one product, if that is known and no limit comes near on the way.
    fn leap(&mut self, seconds: f64, transitions: &mut Transitions) -> bool {
        let Loop { position_gain, velocity_gain, integral_time, limit, .. } = self.drive;
        let Mechanics { inertia, pendulum, .. } = self.mechanics;
        let reaches = self.rate * seconds <= LINEAR_STEP;
        if !self.torque || pendulum != 0.0 || !reaches || self.is_open() {
            return false;
        }
        let reset = integral_time.map_or(0.0, |time| 1.0 / time);
        let (damping, rate) = (self.damping(), self.rate);
        let linear = Linear { span: seconds, position_gain, velocity_gain, damping, inertia, reset, rate };
        let demand = self.demand();
        let slopes = Vector3::new(self.velocity, self.acceleration(), (self.force() - self.integral) * reset);
        let Some(known) = transitions.of(linear) else { return false };
        if !known.keeps_within(limit - demand.abs(), slopes) {
            return false;
        }
        let [position, velocity, integral] = known.change(slopes).into();
        self.position += position;
        self.velocity += velocity;
        self.integral += integral;
        true
    }

    /// Moves by `seconds`.
    pub fn advance(&mut self, seconds: f64) {
        if self.is_open() {
            return self.glide(seconds);
        }
        let mut rest = seconds;
        let mut changes = 0;
        while rest > 0.0 {
            let (rate, longest) = self.pace();
            let step = rest.min(longest);
            let order = order_for(rate * step);
            let may_change = changes < MOST_CHANGES;
            let change = if order < FEW {
                self.advance_by::<FEW>(step, order, may_change)
            } else {
                self.advance_by::<{ ORDER + 1 }>(step, order, may_change)
            };
            changes += u32::from(change.is_some());
            rest -= change.unwrap_or(step);
        }
    }

    /// Moves by `step`, or to where the motion leaves its regime before that; gives when it did.
    fn advance_by<const COUNT: usize>(&mut self, step: f64, order: usize, may_change: bool) -> Option<f64> {
        let regime = self.regime();
        let motion = self.motion::<COUNT>(regime, order);
        let change = if may_change { self.change(regime, &motion, step) } else { None };
        let taken = change.unwrap_or(step);
        self.position = motion.position.at(taken);
        self.velocity = motion.velocity.at(taken);
        self.integral = motion.integral.at(taken);
        change
    }

    /// Whether a force drives it that nothing changes, against friction and a constant load alone.
    fn is_open(&self) -> bool {
        let Loop { position_gain, velocity_gain, integral_time, limit, .. } = self.drive;
        limit == f64::MAX
            && position_gain == 0.0
            && velocity_gain == 0.0
            && integral_time.is_none()
            && self.mechanics.pendulum == 0.0
    }

    /// Moves by `seconds` where it [is open](Self::is_open): M·dv/dt = F − load − d·v, whose solution with r = d/M·t is
    /// v + (dv/dt)·t·φ₁(r) and x + v·t + (dv/dt)·t²·φ₂(r), with φ₁ = (1 − e⁻ʳ)/r and φ₂ = (1 − φ₁)/r.
    fn glide(&mut self, seconds: f64) {
        let slope = self.acceleration();
        let r = self.damping() / self.mechanics.inertia * seconds;
        let (first, second) = if r.abs() < 0.02 {
            // Their series: the first neglected terms are below 10⁻¹⁵.
            let second = 0.5 - r * (1.0 / 6.0 - r * (1.0 / 24.0 - r * (1.0 / 120.0 - r * (1.0 / 720.0 - r / 5040.0))));
            (1.0 - r * second, second)
        } else {
            let first = -(-r).exp_m1() / r;
            (first, (1.0 - first) / r)
        };
        self.position += self.velocity * seconds + slope * seconds * seconds * second;
        self.velocity += slope * seconds * first;
    }

    /// A bound of the rates at which the motion changes from here on, 1/s, and how far its series is good for, s.
    fn pace(&self) -> (f64, f64) {
        if self.mechanics.pendulum > 0.0 {
            let rate = self.rate + self.velocity.abs() + self.acceleration().abs().sqrt();
            // The sine's series has a radius of convergence: its terms fall like a geometric series, and all are used.
            (f64::INFINITY, PENDULUM_STEP / rate)
        } else {
            (self.rate, LINEAR_STEP / self.rate)
        }
    }

    /// The regime that the present state is in or is about to enter.
    fn regime(&self) -> Regime {
        if !self.torque {
            return Regime::Off;
        }
        let demand = self.demand();
        let rounding = 1e-9 * self.drive.limit;
        let excess = demand.abs() - self.drive.limit;
        // On a limit the way the demand moves decides; the force is the same on both sides.
        let beyond = if excess.abs() <= rounding { self.demand_rate() * demand > 0.0 } else { excess > 0.0 };
        match (beyond, demand > 0.0) {
            (false, _) => Regime::Free,
            (true, true) => Regime::Upper,
            (true, false) => Regime::Lower,
        }
    }

    /// How fast the demand changes now.
    fn demand_rate(&self) -> f64 {
        let force = self.force();
        let reset = self.drive.integral_time.map_or(0.0, |time| (force - self.integral) / time);
        reset - self.drive.position_gain * self.velocity - self.drive.velocity_gain * self.acceleration()
    }

    /// How fast the velocity changes now.
    fn acceleration(&self) -> f64 {
        (self.force() - self.resistance()) / self.mechanics.inertia
    }

    /// What the motor's own voltage takes from the force for each unit of speed, as long as the drive is on.
    pub fn back_emf(&self) -> f64 {
        if self.torque { self.drive.back_emf } else { 0.0 }
    }

    /// What opposes the motion in proportion to its speed.
    fn damping(&self) -> f64 {
        self.mechanics.viscous_friction + self.back_emf()
    }

    /// Friction and load now, N or N·m; what the motor's own voltage takes counts as friction.
    pub fn resistance(&self) -> f64 {
        let Mechanics { load, pendulum, .. } = self.mechanics;
        let weight = if pendulum == 0.0 { 0.0 } else { pendulum * GRAVITY * self.position.sin() };
        self.damping() * self.velocity + load + weight
    }

    /// When within `step` the motion leaves its regime.
    fn change<const COUNT: usize>(&self, regime: Regime, motion: &Motion<COUNT>, step: f64) -> Option<f64> {
        let limit = self.drive.limit;
        match regime {
            Regime::Off => None,
            Regime::Upper => motion.demand.crossing(limit, false, step),
            Regime::Lower => motion.demand.crossing(-limit, true, step),
            Regime::Free => {
                let upper = motion.demand.crossing(limit, true, step);
                let lower = motion.demand.crossing(-limit, false, upper.unwrap_or(step));
                lower.or(upper)
            }
        }
    }

    /// The motion from here on in `regime`, by the recurrences of its equations' coefficients.
    fn motion<const COUNT: usize>(&self, regime: Regime, order: usize) -> Motion<COUNT> {
        let Loop { position_gain, velocity_gain, integral_time, limit, .. } = self.drive;
        let Mechanics { inertia, load, pendulum, .. } = self.mechanics;
        let damping = self.damping();
        let mobility = 1.0 / inertia;
        let reset = integral_time.filter(|_| self.torque).map_or(0.0, |time| 1.0 / time);
        let mut motion = Motion::new(order);
        let (x, v) = (&mut motion.position.coefficients, &mut motion.velocity.coefficients);
        let (i, demand) = (&mut motion.integral.coefficients, &mut motion.demand.coefficients);
        let mut weight = (pendulum > 0.0).then(|| Pendulum::new(pendulum * GRAVITY, self.position));
        (x[0], v[0], i[0]) = (self.position, self.velocity, if self.torque { self.integral } else { 0.0 });
        // What is constant enters the coefficients of power 0 alone.
        let (mut reference, mut constant_load) = (self.reference, load);
        let mut constant_force = match regime {
            Regime::Free | Regime::Off => 0.0,
            Regime::Upper => limit,
            Regime::Lower => -limit,
        };
        for k in 0..order {
            demand[k] = reference - position_gain * x[k] - velocity_gain * v[k] + i[k];
            let force = if regime == Regime::Free { demand[k] } else { constant_force };
            let weighs = weight.as_ref().map_or(0.0, |weight| weight.coefficient(k));
            let resistance = damping * v[k] + constant_load + weighs;
            let share = RECIPROCALS[k + 1];
            x[k + 1] = v[k] * share;
            v[k + 1] = (force - resistance) * mobility * share;
            i[k + 1] = (force - i[k]) * reset * share;
            if let Some(weight) = &mut weight {
                weight.extend(k, x);
            }
            (reference, constant_load, constant_force) = (0.0, 0.0, 0.0);
        }
        demand[order] = i[order] - position_gain * x[order] - velocity_gain * v[order];
        motion
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.reference);
        visit(f64::from(u8::from(self.torque)));
        visit(self.position);
        visit(self.velocity);
        visit(self.integral);
    }
}

/// The coefficients of weight·sin(x) along a motion: s' = c·x', c' = −s·x'.
struct Pendulum<const COUNT: usize> {
    weight: f64,
    sine: [f64; COUNT],
    cosine: [f64; COUNT],
}

impl<const COUNT: usize> Pendulum<COUNT> {
    fn new(weight: f64, position: f64) -> Self {
        let mut pendulum = Pendulum { weight, sine: [0.0; COUNT], cosine: [0.0; COUNT] };
        (pendulum.sine[0], pendulum.cosine[0]) = position.sin_cos();
        pendulum
    }

    fn coefficient(&self, k: usize) -> f64 {
        self.weight * self.sine[k]
    }

    /// Coefficient k + 1 of sine and cosine, from those up to k and the position's up to k + 1.
    fn extend(&mut self, k: usize, position: &[f64; COUNT]) {
        let (mut sine, mut cosine) = (0.0, 0.0);
        for j in 0..=k {
            let rate = (j + 1) as f64 * position[j + 1];
            sine += rate * self.cosine[k - j];
            cosine -= rate * self.sine[k - j];
        }
        (self.sine[k + 1], self.cosine[k + 1]) = (sine * RECIPROCALS[k + 1], cosine * RECIPROCALS[k + 1]);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The axis of the rig: 25 1/s and 800 N·s/m, 20 kg, 50 N·s/m.
    fn rig(limit: f64) -> Servo {
        let drive =
            Loop { position_gain: 25.0 * 800.0, velocity_gain: 800.0, integral_time: None, limit, back_emf: 0.0 };
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

    /// The same motion by a method of its own: classical Runge-Kutta in steps so short that a limit taken within one
    /// does not matter.
    fn by_runge_kutta(servo: &Servo, seconds: f64, steps: u32) -> (f64, f64, f64) {
        let slope = |(x, v, i): (f64, f64, f64)| {
            let demand = servo.reference - servo.drive.position_gain * x - servo.drive.velocity_gain * v + i;
            let force = if servo.torque { demand.clamp(-servo.drive.limit, servo.drive.limit) } else { 0.0 };
            let Mechanics { inertia, viscous_friction, load, pendulum } = servo.mechanics;
            let resistance = viscous_friction * v + load + pendulum * GRAVITY * x.sin();
            let reset = servo.drive.integral_time.map_or(0.0, |time| (force - i) / time);
            (v, (force - resistance) / inertia, reset)
        };
        let add = |a: (f64, f64, f64), b: (f64, f64, f64), h: f64| (a.0 + h * b.0, a.1 + h * b.1, a.2 + h * b.2);
        let mut state = (servo.position, servo.velocity, servo.integral);
        let h = seconds / f64::from(steps);
        for _ in 0..steps {
            let k1 = slope(state);
            let k2 = slope(add(state, k1, h / 2.0));
            let k3 = slope(add(state, k2, h / 2.0));
            let k4 = slope(add(state, k3, h));
            for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                state = add(state, k, h * weight / 6.0);
            }
        }
        state
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
}
