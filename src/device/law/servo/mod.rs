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

mod sprung;
#[cfg(test)]
mod tests;

pub use sprung::Spring;

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

/// The linear system that an axis moves by, as long as its demand changes by less than `margin`; N or N·m.
struct Course {
    linear: Linear,
    margin: f64,
    /// How fast position, velocity and integrator change now.
    slopes: Vector3<f64>,
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

    /// Moves by `seconds` by one product, if that is known and its drive neither meets nor leaves a limit on the way.
    fn leap(&mut self, seconds: f64, transitions: &mut Transitions) -> bool {
        let Some(Course { linear, margin, slopes }) = self.course(seconds, 0.0) else { return false };
        let Some(known) = transitions.of(linear) else { return false };
        if !known.keeps_within(margin, slopes) {
            return false;
        }
        let [position, velocity, integral] = known.change(slopes).into();
        self.gain(position, velocity, integral);
        true
    }

    fn gain(&mut self, position: f64, velocity: f64, integral: f64) {
        self.position += position;
        self.velocity += velocity;
        self.integral = if self.torque { self.integral + integral } else { 0.0 };
    }

    /// The linear system that it moves by for `seconds`, with what hangs on it at rates up to `rate`, 1/s; `None` where there is none, or where
    /// a series is not good for that long.
    fn course(&self, seconds: f64, rate: f64) -> Option<Course> {
        let Loop { position_gain, velocity_gain, integral_time, limit, .. } = self.drive;
        let Mechanics { inertia, pendulum, .. } = self.mechanics;
        let reaches = (self.rate + rate) * seconds <= LINEAR_STEP;
        if pendulum != 0.0 || !reaches || self.is_open() {
            return None;
        }
        let demand = self.demand();
        let (is_free, margin) = match self.torque {
            false => (false, f64::INFINITY),
            true if demand.abs() <= limit => (true, limit - demand.abs()),
            true => (false, demand.abs() - limit),
        };
        let reset = integral_time.filter(|_| self.torque).map_or(0.0, |time| 1.0 / time);
        let linear =
            Linear { span: seconds, position_gain, velocity_gain, damping: self.damping(), inertia, reset, is_free };
        let slopes = Vector3::new(self.velocity, self.acceleration(), (self.force() - self.integral) * reset);
        Some(Course { linear, margin, slopes })
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
