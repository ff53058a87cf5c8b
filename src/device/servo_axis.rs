//! `kinetwin.ServoAxis`: one axis under a servo drive, linear or rotary.

use crate::device::law::closing::Closing;
use crate::device::law::moves;
use crate::device::law::profile::{Limits, pursued};
use crate::device::law::servo::{HIGHEST_RATE, Loop, Mechanics, Servo};
use crate::device::law::slope::Slope;
use crate::device::law::transition::Transitions;
use crate::device::path::{Bounds, Moment, Motion, Stages};
use crate::device::servo_path::{self, Exertion, Nominal, Way};
use crate::device::table::{
    EFFORT, LENGTH, LONGEST_M, LONGEST_S, SPEED, TIME, TRAVEL, choice, measure, number, switch, target,
};
use crate::device::{BuildError, Device, Surroundings, joints_where_reported, misfit};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;
use crate::value::Quantity;

const GREATEST: f64 = 1e9;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.ServoAxis",
    summary: "an axis whose drive follows a position, a speed or a force, against inertia, friction and load",
    ports: &[
        target("positionTarget", TRAVEL, "where the axis is to be, in modes ideal and position"),
        target("velocityTarget", SPEED, "how fast it is to move, in mode velocity"),
        target("forceTarget", EFFORT, "what the drive is to exert, before forceGain, in mode force"),
        switch("torqueEnabled", "the drive may exert a force; true where it is not mapped"),
        measure("position", TRAVEL, "position of the load"),
        measure("velocity", SPEED, "speed of the motor"),
        measure("force", EFFORT, "what the drive exerts, after its limit"),
    ],
    parameters: &[
        choice("motion", &["linear", "rotary"], "linear", "whether it counts in m, kg and N or in rad, kg.m2 and N.m"),
        choice("mode", &["ideal", "position", "velocity", "force"], "position", "what the drive follows"),
        choice(
            "loop",
            &["cascade", "proportional"],
            "cascade",
            "in mode position: a speed loop within a position loop, or velocityGain on the position's error alone",
        ),
        number("M", &[Quantity::Mass, Quantity::Inertia], (1e-9, GREATEST), "20", "inertia of motor and load"),
        number("Fv", &[Quantity::LinearDamping, Quantity::AngularDamping], (0.0, GREATEST), "50", "viscous friction"),
        number("positionGain", &[Quantity::Rate], (0.0, GREATEST), "25", "speed asked for each unit of position error"),
        number(
            "velocityGain",
            &[Quantity::LinearDamping, Quantity::AngularDamping, Quantity::LinearStiffness, Quantity::AngularStiffness],
            (0.0, GREATEST),
            "800",
            "force for each unit of speed error; with loop proportional, of position error",
        ),
        number(
            "velocityIntegralTime",
            TIME,
            (0.0, LONGEST_S),
            "0",
            "reset time of the speed loop's integrator; 0: there is none",
        ),
        number(
            "velocityFeedforward",
            &[Quantity::One],
            (0.0, 10.0),
            "0",
            "share of the target's own speed that is added to the speed asked for",
        ),
        number(
            "forceGain",
            &[Quantity::One],
            (-GREATEST, GREATEST),
            "1",
            "force for each unit of forceTarget in mode force",
        ),
        number("forceLimit", EFFORT, (0.0, GREATEST), "500", "greatest force of the drive, either way"),
        number(
            "backEmf",
            &[Quantity::LinearDamping, Quantity::AngularDamping],
            (0.0, GREATEST),
            "0",
            "what the motor's own voltage takes from the drive's force for each unit of speed while torque is on",
        ),
        number("load", EFFORT, (-GREATEST, GREATEST), "0", "constant load; positive opposes positive motion"),
        number(
            "pendulumMass",
            &[Quantity::Mass],
            (0.0, GREATEST),
            "0",
            "mass of a pendulum that loads the axis by m g l sin(position); 0: there is none",
        ),
        number("pendulumLength", LENGTH, (0.0, LONGEST_M), "0", "length of that pendulum, to its centre of mass"),
    ],
};

const POSITION_TARGET: usize = 0;
const VELOCITY_TARGET: usize = 1;
const FORCE_TARGET: usize = 2;
const TORQUE_ENABLED: usize = 3;
const POSITION: usize = 4;
const VELOCITY: usize = 5;
const FORCE: usize = 6;

/// What the drive follows, and with which gains.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    /// The axis is where it is told to be.
    Ideal,
    /// A position loop around a speed loop.
    Cascade { position_gain: f64, velocity_gain: f64, feedforward: f64 },
    /// One position loop.
    Proportional { gain: f64 },
    /// A speed loop.
    Velocity { gain: f64 },
    /// No loop.
    Force { gain: f64 },
}

/// An axis.
#[derive(Clone, Debug)]
struct ServoAxis {
    mode: Mode,
    position_target: Slope,
    velocity_target: f64,
    force_target: f64,
    servo: Servo,
    transitions: Transitions,
    nominal: Nominal,
    stages: Stages,
    /// Whether the drive was told that it may exert a force.
    torque: bool,
    exertion: Exertion,
    /// With stages: where an ideal axis is before its transmission, on its way under its drive's limits.
    tracked: Motion,
    motor: Motion,
    load: Motion,
}

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let number = |name| parameters.number(name);
    let mode = mode(parameters);
    let (position_gain, velocity_gain) = match mode {
        Mode::Cascade { position_gain, velocity_gain, .. } => (position_gain * velocity_gain, velocity_gain),
        Mode::Proportional { gain } => (gain, 0.0),
        Mode::Velocity { gain } => (0.0, gain),
        Mode::Ideal | Mode::Force { .. } => (0.0, 0.0),
    };
    // The integrator belongs to the speed loop: there is none where there is no such loop.
    let integral_time = Some(number("velocityIntegralTime")).filter(|time| *time > 0.0 && velocity_gain > 0.0);
    let drive =
        Loop { position_gain, velocity_gain, integral_time, limit: number("forceLimit"), back_emf: number("backEmf") };
    let pendulum = number("pendulumMass") * number("pendulumLength");
    if pendulum > 0.0 && parameters.text("motion") == "linear" {
        return Err(misfit(instance, "pendulumMass", "is set on a linear axis: a pendulum needs motion rotary"));
    }
    let inertia = number("M");
    let mechanics = Mechanics { inertia, viscous_friction: number("Fv"), load: number("load"), pendulum };
    let servo = Servo::new(drive, mechanics);
    if mode != Mode::Ideal && servo.rate() > HIGHEST_RATE {
        let problem = format!(
            "is {inertia}: with these gains and this friction the axis moves at rates up to {:.0} 1/s, more than the \
             {HIGHEST_RATE} 1/s that are computed; raise the inertia or lower the gains",
            servo.rate()
        );
        return Err(misfit(instance, "M", problem));
    }
    let position_target = Slope::default();
    let free = f64::INFINITY;
    let bounds = Bounds { velocity: free, acceleration: free, deceleration: free, force: drive.limit };
    Ok(Box::new(ServoAxis {
        mode,
        position_target,
        velocity_target: 0.0,
        force_target: 0.0,
        servo,
        transitions: Transitions::default(),
        nominal: Nominal { drive, mechanics },
        stages: Stages::default(),
        torque: true,
        exertion: Exertion { bounds, passed: 0.0 },
        tracked: Motion::default(),
        motor: Motion::default(),
        load: Motion::default(),
    }))
}

fn mode(parameters: &Parameters) -> Mode {
    let [position_gain, velocity_gain] = ["positionGain", "velocityGain"].map(|name| parameters.number(name));
    match (parameters.text("mode"), parameters.text("loop")) {
        ("ideal", _) => Mode::Ideal,
        ("velocity", _) => Mode::Velocity { gain: velocity_gain },
        ("force", _) => Mode::Force { gain: parameters.number("forceGain") },
        (_, "proportional") => Mode::Proportional { gain: velocity_gain },
        _ => {
            let feedforward = parameters.number("velocityFeedforward");
            Mode::Cascade { position_gain, velocity_gain, feedforward }
        }
    }
}

impl ServoAxis {
    /// What the commands ask of the loop: the part of its demand that does not depend on the axis.
    fn reference(&self) -> f64 {
        match self.mode {
            Mode::Ideal => 0.0,
            Mode::Cascade { position_gain, velocity_gain, feedforward } => {
                velocity_gain
                    * (position_gain * self.position_target.value() + feedforward * self.position_target.rate())
            }
            Mode::Proportional { gain } => gain * self.position_target.value(),
            Mode::Velocity { gain } => gain * self.velocity_target,
            Mode::Force { gain } => gain * self.force_target,
        }
    }

    /// For how long the reference stays as it is: until the target's own speed is no longer believed in.
    fn steady(&self) -> f64 {
        match (self.mode, self.position_target.lasts()) {
            (Mode::Cascade { feedforward, .. }, lasts) if feedforward != 0.0 && lasts > 0.0 => lasts,
            (Mode::Ideal, lasts) if lasts > 0.0 => lasts,
            _ => f64::INFINITY,
        }
    }
}

/// What a position loop makes of its control error, over a range of it: one that passes stages and a speed limit is a
/// broken line, and a line on each of its pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Piece {
    /// The loop sees the error, shifted by so much.
    Sees { shift: f64 },
    /// It sees none.
    Blind,
    /// It asks for its highest speed, this way.
    Fastest { way: f64 },
}

/// How many pieces a stretch may pass: one that rounding makes flicker is computed on as it is.
const MOST_PIECES: u32 = 8;
/// How often the instant at which a piece is left is halved: a millionth of a stretch.
const HALVINGS: u32 = 20;

/// With stages in the path.
impl ServoAxis {
    fn advance_with_stages(&mut self, seconds: f64) {
        let mut stages = std::mem::take(&mut self.stages);
        let mut rest = seconds;
        // What is left of a stretch in which the axis cannot be moved together with its spring.
        let mut apart = 0.0;
        while rest > 0.0 {
            if apart <= 0.0
                && let Some(moment) = stages.leap(rest, self.steady())
            {
                if self.leap(&mut stages, moment) {
                    rest -= moment.span;
                    continue;
                }
                apart = moment.span;
            }
            let Some(moment) = stages.stretch(&mut rest, self.steady()) else { break };
            apart -= moment.span;
            if self.mode == Mode::Ideal {
                self.motor = self.track(&mut stages, moment);
                self.load = stages.transmission.motion(self.motor, moment);
                self.position_target.advance(moment.span);
                // Its speed may end with the stretch.
                let end = Moment { span: 0.0, ..moment };
                self.motor = self.track(&mut stages, end);
                self.load = stages.transmission.motion(self.motor, end);
            } else {
                self.motor = self.drive(&mut stages, moment);
                self.position_target.advance(moment.span);
                self.load = stages.transmission.motion(self.motor, moment);
            }
        }
        self.stages = stages;
    }

    /// Moves by the whole stretch that ends at `moment` together with the spring that the load hangs on; returns false, and moves
    /// nothing, where something on the way keeps that from being one linear system.
    fn leap(&mut self, stages: &mut Stages, moment: Moment) -> bool {
        if self.mode == Mode::Ideal {
            return false;
        }
        let start = Moment { now: moment.now - moment.span, span: moment.span };
        self.exertion.bounds = servo_path::bounds(stages, &self.nominal, self.motion(), moment);
        let piece = self.piece(stages, start);
        self.close_loop(piece, stages, start);
        let Some(ahead) = stages.transmission.spring().map(|spring| spring.ahead) else { return false };
        let before = self.servo;
        let ServoAxis { servo, nominal, exertion, transitions, .. } = self;
        let moves = Way { servo, nominal, exertion, stages, transitions }.leap(moment);
        if !moves || self.piece(stages, moment) != piece {
            self.servo = before;
            if let Some(spring) = stages.transmission.spring() {
                spring.ahead = ahead;
            }
            return false;
        }
        stages.pass_time(moment.span);
        // What switches at the end of the stretch drives the next.
        self.servo.torque = stages.actuator.switched(self.torque, moment);
        self.motor = self.motion();
        self.position_target.advance(moment.span);
        self.load = stages.transmission.leapt(self.motor, moment);
        true
    }

    /// Takes a command up at once, as far as that is possible.
    fn take_up(&mut self) {
        let mut stages = std::mem::take(&mut self.stages);
        let moment = stages.moment();
        if self.mode == Mode::Ideal {
            self.motor = self.track(&mut stages, moment);
            self.load = stages.transmission.motion(self.motor, moment);
        } else {
            self.servo.torque = stages.actuator.switched(self.torque, moment);
            let piece = self.piece(&mut stages, moment);
            self.close_loop(piece, &mut stages, moment);
        }
        self.stages = stages;
    }

    /// The loop moves the axis, piece by piece of what it makes of its error.
    fn drive(&mut self, stages: &mut Stages, moment: Moment) -> Motion {
        let motion = self.motion();
        self.exertion.bounds = servo_path::bounds(stages, &self.nominal, motion, moment);
        let mut rest = moment.span;
        for left in (0..MOST_PIECES).rev() {
            let start = Moment { now: moment.now - rest, span: rest };
            let piece = self.piece(stages, start);
            self.close_loop(piece, stages, start);
            let taken =
                if left > 0 { self.along(piece, stages, moment, rest) } else { self.move_by(stages, moment, rest) };
            rest -= taken;
            if rest <= 0.0 {
                break;
            }
        }
        // What switches at the end of the stretch drives the next.
        self.servo.torque = stages.actuator.switched(self.torque, moment);
        self.motion()
    }

    /// Moves on `piece` by `span`, or to the instant at which it is left; returns how long that took.
    fn along(&mut self, piece: Option<Piece>, stages: &mut Stages, moment: Moment, span: f64) -> f64 {
        let (servo, exertion) = (self.servo, self.exertion);
        self.move_by(stages, moment, span);
        if stages.shapes_effort() || self.piece(stages, moment) == piece {
            return span;
        }
        let (mut on, mut off) = (0.0, span);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (on + off);
            (self.servo, self.exertion) = (servo, exertion);
            self.move_by(stages, moment, middle);
            if self.piece(stages, moment) == piece { on = middle } else { off = middle }
        }
        (self.servo, self.exertion) = (servo, exertion);
        self.move_by(stages, moment, off);
        off
    }

    fn move_by(&mut self, stages: &mut Stages, moment: Moment, span: f64) -> f64 {
        let moment = Moment { span, ..moment };
        let ServoAxis { servo, nominal, exertion, transitions, .. } = self;
        Way { servo, nominal, exertion, stages, transitions }.advance(moment);
        span
    }

    fn motion(&self) -> Motion {
        Motion { position: self.servo.position(), velocity: self.servo.velocity() }
    }

    /// The piece that the present error lies on; `None` where there is no position loop.
    fn piece(&self, stages: &mut Stages, moment: Moment) -> Option<Piece> {
        let (gain, fastest) = match self.mode {
            Mode::Cascade { position_gain, .. } => (position_gain, self.exertion.bounds.velocity),
            Mode::Proportional { .. } => (0.0, f64::INFINITY),
            _ => return None,
        };
        let error = self.position_target.value() - self.servo.position();
        let seen = stages.actuator.reference(error, self.motion(), moment);
        Some(match seen {
            0.0 if error != 0.0 => Piece::Blind,
            _ if (gain * seen).abs() > fastest => Piece::Fastest { way: seen.signum() },
            // Rounding apart, the shift is one on all of the piece.
            _ => Piece::Sees { shift: rounded(seen - error) },
        })
    }

    /// Lets the loop demand what it makes of its error on `piece`.
    fn close_loop(&mut self, piece: Option<Piece>, stages: &mut Stages, moment: Moment) {
        let reference = self.reference();
        let fastest = self.exertion.bounds.velocity;
        let gain = self.nominal.drive.position_gain;
        let target = self.position_target.value();
        let (gain, reference) = match (piece, self.mode) {
            (Some(Piece::Sees { shift }), _) => (gain, reference + gain * shift),
            (Some(Piece::Blind), _) => (0.0, reference - gain * target),
            (Some(Piece::Fastest { way }), Mode::Cascade { velocity_gain, .. }) => {
                (0.0, reference - gain * target + velocity_gain * way * fastest)
            }
            (None, Mode::Velocity { gain }) => {
                let asked = stages.actuator.reference(self.velocity_target, self.motion(), moment);
                (0.0, gain * asked.clamp(-fastest, fastest))
            }
            (None, Mode::Force { gain }) => {
                (0.0, gain * stages.actuator.reference(self.force_target, self.motion(), moment))
            }
            _ => (gain, reference),
        };
        self.servo.feed_back(gain);
        self.servo.reference = reference;
    }

    /// An ideal axis follows its target as fast as its drive's limits let it: at once where there are none.
    fn track(&mut self, stages: &mut Stages, moment: Moment) -> Motion {
        let before = self.tracked;
        let bounds = servo_path::bounds(stages, &self.nominal, before, moment);
        let error = self.position_target.value() - before.position;
        let error = stages.actuator.reference(error, before, moment);
        let time_constant = stages.actuator.lag();
        if time_constant > 0.0 {
            let closing = Closing { time_constant, velocity: bounds.velocity, acceleration: bounds.acceleration };
            self.tracked = closing.after(before, before.position + error, moment.span);
        } else if bounds.acceleration.is_finite() {
            let target = &self.position_target;
            let target = Motion { position: before.position + error + target.lead(), velocity: target.rate() };
            let limits = Limits { velocity: bounds.velocity, acceleration: bounds.acceleration };
            self.tracked = pursued(limits, before, target, moment.span);
        } else if bounds.velocity.is_finite() {
            let most = bounds.velocity * moment.span;
            let step = error.clamp(-most, most);
            self.tracked.position += step;
            let is_behind = error.abs() > most;
            let rate = self.position_target.rate().clamp(-bounds.velocity, bounds.velocity);
            self.tracked.velocity = if is_behind { bounds.velocity.copysign(error) } else { rate };
        } else {
            // Unless a stage holds it back it is where it is told to be, to the last bit.
            let target = self.position_target.value();
            let position = if error == target - before.position { target } else { before.position + error };
            self.tracked = Motion { position, velocity: self.position_target.rate() };
        }
        stages.actuator.motion(self.tracked, moment)
    }
}

/// To a part in 2³⁰: shifts that differ by rounding alone are one shift.
fn rounded(shift: f64) -> f64 {
    (shift * 1_073_741_824.0).round() / 1_073_741_824.0
}

impl Device for ServoAxis {
    fn command(&mut self, port: usize, value: f64) {
        match port {
            POSITION_TARGET => self.position_target.set(value),
            VELOCITY_TARGET => self.velocity_target = value,
            FORCE_TARGET => self.force_target = value,
            TORQUE_ENABLED => (self.torque, self.servo.torque) = (value != 0.0, value != 0.0),
            _ => return,
        }
        if self.stages.is_nominal() {
            self.servo.reference = self.reference();
        } else {
            self.take_up();
        }
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.stages.loaded(f64::from(surroundings.parts), 0.0);
    }

    fn moving(&self) -> u32 {
        let velocity = match (self.stages.is_nominal(), self.mode) {
            (true, Mode::Ideal) => self.position_target.rate(),
            (true, _) => self.servo.velocity(),
            (false, _) => self.motor.velocity,
        };
        u32::from(moves(velocity))
    }

    /// With a transmission between, it is the motor that is shifted, and the load as far as it follows.
    fn shift(&mut self, by: Motion) -> bool {
        if self.mode == Mode::Ideal {
            return false;
        }
        self.servo.shift(by.position, by.velocity);
        if !self.stages.is_nominal() {
            self.motor = self.motion();
            let moment = self.stages.moment();
            self.load = self.stages.transmission.motion(self.motor, moment);
        }
        true
    }

    fn share(&mut self, others: u32) {
        self.stages.shared(f64::from(others));
    }

    fn advance(&mut self, seconds: f64) {
        if !self.stages.is_nominal() {
            return self.advance_with_stages(seconds);
        }
        let mut rest = seconds;
        while rest > 0.0 {
            let span = rest.min(self.steady());
            // Actuator, mechanics and load are one loop.
            if self.mode != Mode::Ideal {
                self.servo.advance_again(span, &mut self.transitions);
            }
            self.position_target.advance(span);
            self.servo.reference = self.reference();
            rest -= span;
        }
    }

    fn report(&mut self, reports: &mut [f64]) {
        if !self.stages.is_nominal() {
            reports[POSITION] = self.load.position;
            reports[VELOCITY] = self.motor.velocity;
            reports[FORCE] = if self.mode == Mode::Ideal { 0.0 } else { self.servo.force() };
            return;
        }
        (reports[POSITION], reports[VELOCITY], reports[FORCE]) = match self.mode {
            Mode::Ideal => (self.position_target.value(), self.position_target.rate(), 0.0),
            _ => (self.servo.position(), self.servo.velocity(), self.servo.force()),
        };
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.position_target.state(visit);
        visit(self.velocity_target);
        visit(self.force_target);
        self.servo.state(visit);
        self.stages.state(visit);
        visit(self.exertion.passed);
        for motion in [self.tracked, self.motor, self.load] {
            visit(motion.position);
            visit(motion.velocity);
        }
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn stages(&mut self, _component: Option<&str>) -> Option<&mut Stages> {
        Some(&mut self.stages)
    }

    fn joints(&self, visit: &mut dyn FnMut(&'static str, f64)) {
        let position = match (self.stages.is_nominal(), self.mode) {
            (false, _) => self.load.position,
            (true, Mode::Ideal) => self.position_target.value(),
            (true, _) => self.servo.position(),
        };
        // Its shape has the one or the other, by its motion.
        visit("Slide.T", position);
        visit("Shaft.R", position);
    }

    fn reported_joints(&self, reports: &[Option<f64>], visit: &mut dyn FnMut(&'static str, f64)) {
        joints_where_reported(self, &[reports[POSITION]; 2], visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;

    fn axis(parameters: &[(&str, &str)]) -> Bench {
        Bench::new("kinetwin.ServoAxis", parameters)
    }

    #[test]
    fn at_rest_until_told_otherwise() {
        axis(&[]).check(&[], 5.0, &[("position", 0.0), ("velocity", 0.0), ("force", 0.0)]);
    }

    #[test]
    fn ideal_is_where_it_is_told_to_be_with_the_speed_of_its_targets() {
        let mut axis = axis(&[("mode", "ideal")]);
        axis.check(&[("positionTarget", 0.3)], 0.0, &[("position", 0.3), ("velocity", 0.0), ("force", 0.0)]);
        axis.check(&[], 0.02, &[]);
        axis.check(&[("positionTarget", 0.31)], 0.01, &[("position", 0.31), ("velocity", 0.5)]);
        axis.check(&[], 0.1, &[("position", 0.31), ("velocity", 0.0)]);
    }

    #[test]
    fn a_motor_brakes_itself_by_its_own_voltage_as_long_as_it_is_on() {
        let mut axis = axis(&[("mode", "force"), ("backEmf", "150")]);
        // 100 N against 50 N.s/m of friction and 150 of its own: 0.5 m/s, in 20 kg / 200 N.s/m.
        let velocity = 0.5 * (1.0 - (-10.0_f64 * 0.3).exp());
        axis.check(&[("forceTarget", 100.0)], 0.3, &[("velocity", velocity), ("force", 100.0)]);
        axis.check(&[("torqueEnabled", 0.0)], 0.4, &[("velocity", velocity * (-2.5_f64 * 0.4).exp()), ("force", 0.0)]);
    }

    #[test]
    fn a_step_is_the_closed_form_of_the_cascade() {
        // v' = (20 000·(0.01 − x) − 850·v) / 20: decay 21.25 1/s, 1 000 1/s².
        let frequency = (1000.0_f64 - 21.25 * 21.25).sqrt();
        let time = 0.1_f64;
        let (sine, cosine) = (frequency * time).sin_cos();
        let envelope = 0.01 * (-21.25 * time).exp();
        let position = 0.01 - envelope * (cosine + 21.25 / frequency * sine);
        let velocity = envelope * 1000.0 / frequency * sine;
        let force = 800.0 * (25.0 * (0.01 - position) - velocity);
        for spans in [1, 5, 100] {
            let mut axis = axis(&[]);
            axis.check(&[("positionTarget", 0.01)], 0.0, &[("force", 200.0)]);
            for _ in 0..spans {
                axis.device.advance(time / f64::from(spans));
            }
            axis.check(&[], 0.0, &[("position", position), ("velocity", velocity), ("force", force)]);
        }
    }

    #[test]
    fn force_is_the_command_after_clamping() {
        axis(&[]).check(&[("positionTarget", -1.0)], 0.0, &[("force", -500.0)]);
        // At the limit v = −10·(1 − exp(−2.5 t)).
        let velocity = -10.0 * (1.0 - (-0.25_f64).exp());
        axis(&[]).check(&[("positionTarget", -1.0)], 0.1, &[("force", -500.0), ("velocity", velocity)]);
    }

    #[test]
    fn in_mode_velocity_the_reference_is_the_target() {
        let velocity = 800.0 / 850.0 * 0.5 * (1.0 - (-42.5_f64 * 0.1).exp());
        axis(&[("mode", "velocity")]).check(&[("velocityTarget", 0.5)], 0.1, &[("velocity", velocity)]);
        let integral = [("mode", "velocity"), ("velocityIntegralTime", "0.05")];
        axis(&integral).check(&[("velocityTarget", 0.5)], 5.0, &[("velocity", 0.5), ("force", 25.0)]);
    }

    #[test]
    fn in_mode_force_the_command_times_the_gain_is_exerted() {
        let velocity = 200.0 / 50.0 * (1.0 - (-2.5_f64).exp());
        let parameters = [("mode", "force"), ("forceGain", "2")];
        axis(&parameters).check(&[("forceTarget", 100.0)], 1.0, &[("velocity", velocity), ("force", 200.0)]);
        axis(&parameters).check(&[("forceTarget", 1000.0)], 0.0, &[("force", 500.0)]);
    }

    #[test]
    fn a_positive_load_opposes_positive_motion() {
        let velocity = -(1.0 - (-2.5_f64).exp());
        axis(&[("mode", "force"), ("load", "50")]).check(&[], 1.0, &[("velocity", velocity), ("force", 0.0)]);
        // The cascade without an integrator gives way by load / (positionGain · velocityGain).
        axis(&[("load", "50")]).check(&[], 5.0, &[("position", -0.0025), ("force", 50.0)]);
    }

    #[test]
    fn a_pendulum_on_one_proportional_loop_hangs_where_gain_and_gravity_balance() {
        let parameters = [
            ("motion", "rotary"),
            ("loop", "proportional"),
            ("velocityGain", "2"),
            ("M", "0.01"),
            ("Fv", "0.1"),
            ("forceLimit", "10"),
            ("pendulumMass", "0.49"),
            ("pendulumLength", "0.1"),
        ];
        let mut servo = axis(&parameters);
        servo.check(&[("positionTarget", 1.0)], 0.0, &[("force", 2.0)]);
        servo.device.advance(10.0);
        let position = servo.report("position");
        let balance = 2.0 * (1.0 - position) - 0.49 * 0.1 * 9.80665 * position.sin();
        assert!(position > 0.7 && balance.abs() < 1e-9, "{position} {balance}");
        servo.check(&[("torqueEnabled", 0.0)], 0.0, &[("force", 0.0)]);
        servo.check(&[], 20.0, &[("position", 0.0), ("velocity", 0.0), ("force", 0.0)]);
    }

    #[test]
    fn feedforward_takes_the_lag_out_of_a_ramp() {
        // Behind a ramp of 0.2 m/s the cascade lags by v/kp · (1 + Fv/velocityGain); feedforward leaves the friction's.
        for (feedforward, lag) in [("0", 0.2 / 25.0 * (1.0 + 50.0 / 800.0)), ("1", 0.2 / 25.0 * 50.0 / 800.0)] {
            let mut axis = axis(&[("velocityFeedforward", feedforward)]);
            for k in 1..=1000 {
                axis.device.command(0, 0.2 * 0.002 * f64::from(k));
                axis.device.advance(0.002);
            }
            // The staircase stands half a step ahead of its ramp on average.
            let found = 0.2 * 2.0 + 0.2 * 0.001 - axis.report("position");
            assert!((found - lag).abs() < 0.2 * 0.0011, "{found} instead of {lag}");
        }
    }

    #[test]
    fn what_cannot_be_computed_is_refused() {
        let pendulum = [("pendulumMass", "1"), ("pendulumLength", "1")];
        let error = Bench::error("kinetwin.ServoAxis", &pendulum);
        assert_eq!(error, "Device1: pendulumMass is set on a linear axis: a pendulum needs motion rotary");
        let error = Bench::error("kinetwin.ServoAxis", &[("M", "0.001")]);
        assert!(error.starts_with("Device1: M is 0.001: with these gains"), "{error}");
    }
}
