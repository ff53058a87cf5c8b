//! One axis under a servo drive with a cascade: a mass, or two with a spring between them, friction by LuGre, and what holds at rest alone by Karnopp.
//!
//! LuGre (C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, A New Model for Control of Systems with Friction, IEEE
//! Trans. Automatic Control 40, 1995): bristles that bend by z,
//!
//! ```text
//! z' = v − σ0·|v|/g(v)·z,    F = σ0·z + σ1·z',    g(v) = Fc + (Fs − Fc)·exp(−(v/vs)²)
//! ```
//!
//! It creeps before it slides, where the library's friction is a set. The bristles are stiff: they are solved in closed form
//! over each step, at the speed in its middle.

use std::f64::consts::TAU;

use crate::drive::supplied;
use crate::plant::Device;
use crate::quirk::{Quirk, Quirks};
use crate::switch::Delay;
use crate::train::Train;

/// The longest step, s.
const STEP: f64 = 5e-5;
/// How far bristles bend before they slide, m: below what the axis reports.
const BEND: f64 = 3e-6;

/// What a servo axis is built to; SI units.
#[derive(Clone, Debug)]
pub struct ServoParameters {
    pub mass: f64,
    pub viscous: f64,
    pub position_gain: f64,
    pub velocity_gain: f64,
    pub force_limit: f64,
}

/// A servo axis in mode position.
#[derive(Clone, Debug)]
pub struct Servo {
    mass: f64,
    viscous: f64,
    position_gain: f64,
    velocity_gain: f64,
    force_limit: f64,
    gain: f64,
    backwards: f64,
    supply: f64,
    dead_band: f64,
    slew: f64,
    lag: Option<f64>,
    pull: f64,
    friction: Friction,
    hold: Hold,
    /// What share of what is asked for arrived in the last step.
    arrives: f64,
    /// What friction opposed with in the last step: without it the first guess of a speed would creep at rest.
    rubbed: f64,
    drag: f64,
    cogging: Option<(f64, f64)>,
    saturates: f64,
    spring: Option<(f64, f64)>,
    fades: Option<(f64, f64)>,
    heat: f64,
    late: Delay,
    train: Train,
    target: f64,
    delivered: f64,
    position: f64,
    speed: f64,
    /// The far mass, where there are two.
    far: (f64, f64),
    clock: f64,
}

impl Servo {
    /// An axis called `name`, at rest at 0.
    pub fn new(parameters: &ServoParameters, quirks: &[Quirk], name: &str) -> Servo {
        let all = Quirks::of(quirks, name);
        let limit = all.parameter("forceLimit", parameters.force_limit);
        let pair = |name: &str, first: &str, second: &str| {
            all.get(name).map(|quirk| (quirk.value(first), quirk.value(second)))
        };
        let mass = all.parameter("M", parameters.mass) + all.value("added-mass", "mass").unwrap_or(0.0);
        let mut rest: Vec<Quirk> = quirks.to_vec();
        rest.retain(|quirk| quirk.effect != "compliance");
        let mut late = Delay::of(all, "switch-on-delay", "switch-off-delay");
        late.set(f64::NEG_INFINITY, true);
        Servo {
            mass,
            viscous: all.parameter("Fv", parameters.viscous)
                + all.value("viscous-friction", "coefficient").unwrap_or(0.0),
            position_gain: all.parameter("positionGain", parameters.position_gain),
            velocity_gain: all.parameter("velocityGain", parameters.velocity_gain),
            force_limit: limit.min(all.value("force-limit", "limit").unwrap_or(f64::INFINITY)),
            gain: all.value("gain-error", "gain").unwrap_or(1.0),
            backwards: 1.0 - all.value("direction-asymmetry", "asymmetry").unwrap_or(0.0),
            supply: 1.0 - all.value("supply-drop", "fraction").unwrap_or(0.0),
            dead_band: all.value("dead-band", "width").unwrap_or(0.0),
            slew: all.value("acceleration-limit", "limit").unwrap_or(f64::INFINITY),
            lag: all.value("first-order-lag", "time_constant"),
            pull: all.value("constant-force", "force").unwrap_or(0.0) + all.value("gravity", "force").unwrap_or(0.0),
            friction: Friction::new(all),
            hold: Hold {
                force: all.value("breakaway-friction", "force").unwrap_or(0.0),
                is_held: true,
                has_slid: false,
            },
            arrives: 1.0,
            rubbed: 0.0,
            drag: all.value("x-drags-with-the-square", "coefficient").unwrap_or(0.0),
            cogging: pair("x-cogs", "force", "period"),
            saturates: all.value("x-iron-saturates", "force").unwrap_or(f64::INFINITY),
            spring: pair("compliance", "stiffness", "damping"),
            fades: pair("x-fades-with-heat", "share", "time"),
            heat: 0.0,
            late,
            train: Train::new(Quirks::of(&rest, name)),
            target: 0.0,
            delivered: 0.0,
            position: 0.0,
            speed: 0.0,
            far: (0.0, 0.0),
            clock: 0.0,
        }
    }

    /// What the drive is to exert, by its cascade.
    fn asked(&self) -> f64 {
        let error = self.target - self.position;
        let error = if error.abs() <= 0.5 * self.dead_band { 0.0 } else { error };
        let wish = self.position_gain * error;
        (self.velocity_gain * (wish - self.speed)).clamp(-self.force_limit, self.force_limit)
    }

    /// What it exerts.
    fn exerted(&self, asked: f64, others: usize) -> f64 {
        let side = if asked < 0.0 { self.backwards } else { 1.0 };
        let fade = self.fades.map_or(1.0, |(share, _)| 1.0 - share * self.heat);
        let force = asked * self.gain * side * fade * supplied(self.supply, others);
        if self.saturates.is_finite() { self.saturates * (force / self.saturates).tanh() } else { force }
    }

    fn step(&mut self, h: f64, others: usize) {
        self.clock += h;
        // The drive looks once in a step, in its middle: by Heun's rule from a first guess of the speed there.
        let guess = self.speed + 0.5 * h * self.acceleration(self.asked(), self.speed, others, self.rubbed);
        let (position, speed) = (self.position, self.speed);
        (self.position, self.speed) = (position + 0.25 * h * (speed + guess), guess);
        let asked = self.asked();
        (self.position, self.speed) = (position, speed);
        let asked = match self.lag {
            Some(time) => {
                self.delivered = asked + (self.delivered - asked) * (-h / time).exp();
                self.delivered
            }
            None => asked,
        };
        let exerted = self.exerted(asked, others);
        if self.slew.is_finite() && asked * exerted > 0.0 {
            self.arrives = exerted / asked;
        }
        let pulls = exerted - self.opposed(0.0, 0.0).1;
        if self.hold.is_held && self.hold.holds(pulls, self.friction.slides(0.0, self.position, exerted)) {
            (self.speed, self.rubbed) = (0.0, pulls);
            self.warm(h, asked);
            self.bend_spring(h, position, 0.0);
            return;
        }
        let rubs = self.friction.step(h, guess, self.position, exerted, &mut self.heat);
        self.rubbed = rubs;
        let a = self.acceleration(asked, guess, others, rubs);
        let (old, new) = (self.speed, self.speed + h * a);
        self.position += 0.5 * h * (old + new);
        self.speed = if self.hold.rests(old, new) { 0.0 } else { new };
        self.bend_spring(h, position, guess);
        self.warm(h, asked);
    }

    /// The far mass over the next `h`, where the near one is at `position` and goes at `guess` in its middle.
    fn bend_spring(&mut self, h: f64, position: f64, guess: f64) {
        if let Some((stiffness, damping)) = self.spring {
            let mass = 0.5 * self.mass;
            let (x, v) = self.far;
            let middle = (x + 0.5 * h * v, position + 0.5 * h * guess);
            let pull = stiffness * (middle.1 - middle.0) + damping * (guess - v);
            self.far.1 += h * pull / mass;
            self.far.0 += 0.5 * h * (v + self.far.1);
        }
    }

    /// How warm the drive is after another `h` of such a force.
    fn warm(&mut self, h: f64, asked: f64) {
        if let Some((_, time)) = self.fades {
            let load = (asked / (0.2 * self.force_limit)).powi(2).min(4.0);
            self.heat += (load - self.heat) * (h / time);
        }
    }

    /// The mass at the motor, and what opposes it at this speed with this friction.
    fn opposed(&self, speed: f64, rubs: f64) -> (f64, f64) {
        let cogs = self.cogging.map_or(0.0, |(force, period)| force * (TAU * self.position / period).sin());
        let drag = self.viscous * speed + self.drag * speed * speed.abs() + cogs;
        let opposes = drag + rubs + self.pull;
        match self.spring {
            Some((stiffness, damping)) => {
                let bent = stiffness * (self.position - self.far.0) + damping * (speed - self.far.1);
                (0.5 * self.mass, opposes + bent)
            }
            None => (self.mass, opposes),
        }
    }

    fn acceleration(&self, asked: f64, speed: f64, others: usize, rubs: f64) -> f64 {
        let (mass, opposes) = self.opposed(speed, rubs);
        ((self.exerted(asked, others) - opposes) / mass).clamp(-self.slew, self.slew)
    }

    /// What the drive reports that it exerts: what its cascade asks for, after its limits. A drive that accelerates no more steeply than it
    /// may asks its motor for no more than that takes.
    fn reported(&self) -> f64 {
        let asked = self.asked();
        if self.slew.is_infinite() {
            return asked;
        }
        let (mass, opposes) = self.opposed(self.speed, self.rubbed);
        let [least, most] = [-1.0, 1.0].map(|way| (opposes + way * mass * self.slew) / self.arrives);
        asked.clamp(least, most)
    }
}

impl Device for Servo {
    fn command(&mut self, now: f64, port: &str, value: f64) {
        match port {
            "positionTarget" => self.target = value,
            "torqueEnabled" => self.late.set(now, value != 0.0),
            _ => {}
        }
    }

    fn advance(&mut self, _now: f64, span: f64, others: usize) {
        let steps = (span / STEP).ceil().max(1.0);
        for _ in 0..steps as usize {
            self.step(span / steps, others);
        }
        self.train.advance(span, self.position, self.speed);
    }

    fn read(&self, _now: f64, values: &mut Vec<f64>) {
        let position = if self.spring.is_some() { self.far.0 } else { self.train.load() };
        values.extend([position, self.speed, self.reported()]);
    }

    fn moving(&self) -> usize {
        usize::from(self.speed.abs() > 1e-3)
    }
}

/// exp(−x), and nothing where that is less than a number can say: the slow way to nothing is taken at each step of a slide.
fn fades(x: f64) -> f64 {
    const GONE: f64 = 700.0;
    if x < GONE { (-x).exp() } else { 0.0 }
}

/// Bristles.
#[derive(Clone, Debug)]
struct Friction {
    coulomb: f64,
    stribeck: f64,
    stribeck_speed: f64,
    by_load: f64,
    along: Option<[f64; 3]>,
    /// Grows by this share as it warms up, with this time constant.
    warms: Option<(f64, f64)>,
    bend: f64,
    clock: f64,
}

/// What holds at rest alone, beyond what rubs: nothing moves until more than all of it pulls, and once it moves it is gone.
///
/// Source: D. Karnopp, Computer simulation of stick-slip friction in mechanical dynamic systems, J. Dynamic Systems, Measurement and Control 107,
/// 1985. (Bristles that bend and are damped take some milliseconds to let go, or ring and let go too soon: another force than the one sealed.)
#[derive(Clone, Copy, Debug)]
struct Hold {
    /// N.
    force: f64,
    is_held: bool,
    /// Whether it has slid since it was let go: what only begins to move is not held again at once.
    has_slid: bool,
}

/// Slower than this, m/s, what has slid is held again, as it is where it turns round; and from which speed on it slides.
const HELD_BELOW: f64 = 1e-4;
const SLIDES_ABOVE: f64 = 1e-3;

impl Hold {
    /// Whether it is held against such a pull, N, where what rubs stands against so much of it before it slides.
    fn holds(&mut self, pull: f64, rubs: f64) -> bool {
        self.is_held &= self.force > 0.0 && pull.abs() <= self.force + rubs;
        self.is_held
    }

    /// Whether what went at one speed and goes at another is at rest, and held from now on.
    fn rests(&mut self, old: f64, new: f64) -> bool {
        self.has_slid |= new.abs() > SLIDES_ABOVE;
        let rests = self.force > 0.0 && (old * new < 0.0 || (self.has_slid && new.abs() < HELD_BELOW));
        if rests {
            (self.is_held, self.has_slid) = (true, false);
        }
        rests
    }
}

impl Friction {
    fn new(quirks: Quirks<'_>) -> Friction {
        let value = |effect, parameter| quirks.value(effect, parameter).unwrap_or(0.0);
        let warms = quirks.get("x-friction-warms-up");
        let along = quirks.get("position-dependent-friction");
        Friction {
            coulomb: value("coulomb-friction", "force") + warms.map_or(0.0, |quirk| quirk.value("force")),
            stribeck: value("stribeck-friction", "force"),
            stribeck_speed: value("stribeck-friction", "velocity").max(1e-3),
            by_load: value("load-dependent-friction", "coefficient"),
            along: along.map(|quirk| ["amplitude", "period", "phase"].map(|name| quirk.value(name))),
            warms: warms.map(|quirk| (quirk.value("rise"), quirk.value("time"))),
            bend: 0.0,
            clock: 0.0,
        }
    }

    /// What it takes to slide at `speed`, N.
    fn slides(&self, speed: f64, position: f64, drive: f64) -> f64 {
        let warmth = self.warms.map_or(0.0, |(rise, time)| rise * (1.0 - (-self.clock / time).exp()));
        let along =
            self.along.map_or(0.0, |[amplitude, period, phase]| amplitude * (TAU * position / period + phase).sin());
        let falls =
            if self.stribeck == 0.0 { 0.0 } else { self.stribeck * fades((speed / self.stribeck_speed).powi(2)) };
        (self.coulomb * (1.0 + warmth) + along + falls + self.by_load * drive.abs()).max(0.0)
    }

    /// What it opposes with over the next `h`, N.
    fn step(&mut self, h: f64, speed: f64, position: f64, drive: f64, _heat: &mut f64) -> f64 {
        self.clock += h;
        let most = self.slides(speed, position, drive);
        if most <= 0.0 {
            self.bend = 0.0;
            return 0.0;
        }
        let stiffness = most.max(self.coulomb + self.stribeck) / BEND;
        let before = self.bend;
        let decay = speed.abs() * stiffness / most;
        self.bend = if decay * h < 1e-9 {
            self.bend + speed * h
        } else {
            let settles = speed.signum() * most / stiffness;
            settles + (self.bend - settles) * fades(decay * h)
        };
        let rate = (self.bend - before) / h;
        // Damping of the bristles, so that a mass of some kilograms does not ring on them.
        let damping = 2.0 * stiffness.sqrt();
        stiffness * 0.5 * (self.bend + before) + damping * rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::quirk;

    fn parameters() -> ServoParameters {
        ServoParameters { mass: 20.0, viscous: 50.0, position_gain: 25.0, velocity_gain: 800.0, force_limit: 500.0 }
    }

    /// Position, speed and force after these seconds with the target at `target`.
    fn after(quirks: &[Quirk], target: f64, seconds: f64) -> [f64; 3] {
        let mut servo = Servo::new(&parameters(), quirks, "A");
        servo.command(0.0, "positionTarget", target);
        for k in 1..=(seconds * 1e4_f64).round() as usize {
            servo.advance(k as f64 * 1e-4, 1e-4, 0);
        }
        let mut values = Vec::new();
        servo.read(seconds, &mut values);
        [values[0], values[1], values[2]]
    }

    #[test]
    fn a_step_is_the_linear_systems() {
        // 20·x'' + 850·x' + 20000·(x − 0.01) = 0: w = 10·√10, z = 850/(2·20·w).
        let w = 1000.0_f64.sqrt();
        let d = 850.0 / 40.0;
        let wd = (w * w - d * d).sqrt();
        let t: f64 = 0.06;
        let exact = 0.01 * (1.0 - (-d * t).exp() * ((wd * t).cos() + d / wd * (wd * t).sin()));
        let [x, ..] = after(&[], 0.01, t);
        assert!((x - exact).abs() < 1e-8, "{x} {exact}");
    }

    #[test]
    fn dry_friction_leaves_an_error_within_its_band() {
        let rubs = [quirk("A", "coulomb-friction", &[("force", 10.0)])];
        // 20 kN/m · 0.4 mm are 8 N: the bristles bend and hold. Bent monotonously by F the axis has gone -BEND·ln(1 - F/Fc); the
        // step overshoots its 8 N, to 95 % of what slides at most.
        let [x, v, force] = after(&rubs, 4e-4, 2.0);
        assert!(
            x > 0.0 && x < -BEND * (1.0_f64 - 0.95).ln() && v.abs() < 1e-5 && (force - 8.0).abs() < 0.2,
            "{x} {v} {force}"
        );
        let [x, v, force] = after(&rubs, 0.01, 2.0);
        assert!(
            v.abs() < 1e-5 && force.abs() <= 10.01 && (x - 0.01 + force / 20_000.0).abs() < 1e-5,
            "{x} {v} {force}"
        );
    }

    #[test]
    fn sliding_takes_what_is_declared() {
        let mut servo = Servo::new(&parameters(), &[quirk("A", "coulomb-friction", &[("force", 10.0)])], "A");
        for k in 1..=20_000 {
            let now = f64::from(k) * 1e-4;
            servo.command(now, "positionTarget", 0.1 * now);
            servo.advance(now, 1e-4, 0);
        }
        let mut values = Vec::new();
        servo.read(2.0, &mut values);
        // 10 N and 50 N·s/m at 0.1 m/s.
        assert!((values[2] - 15.0).abs() < 0.1, "{}", values[2]);
    }

    /// 20 kg at 2 m/s² and 50 N·s/m at 0.2 m/s, of the 500 N that the cascade would ask for: with a motor of 0.8 of its force, 62.5 N of them.
    #[test]
    fn a_limited_drive_asks_for_what_it_takes() {
        for (gain, takes) in [(1.0, 50.0), (0.8, 62.5)] {
            let limited =
                [quirk("A", "acceleration-limit", &[("limit", 2.0)]), quirk("A", "gain-error", &[("gain", gain)])];
            let [_, v, force] = after(&limited, 1.0, 0.1);
            assert!((v - 0.2).abs() < 1e-9 && (force - takes).abs() < 0.05, "{v} {force}");
        }
    }

    /// However fast it is pulled, by 40 N in a second or by 400.
    #[test]
    fn what_is_at_rest_is_held_until_all_that_holds_it_is_used_up() {
        for pulled in [0.002, 0.02] {
            let holds = [quirk("A", "breakaway-friction", &[("force", 15.0)])];
            let mut servo = Servo::new(&parameters(), &holds, "A");
            let (mut values, mut most) = (Vec::new(), 0.0_f64);
            for k in 1..=60_000 {
                let now = f64::from(k) * 1e-4;
                servo.command(now, "positionTarget", pulled * now);
                servo.advance(now, 1e-4, 0);
                values.clear();
                servo.read(now, &mut values);
                if values[0] > 1.05 * BEND {
                    break;
                }
                most = most.max(values[2]);
            }
            assert!(values[0] > BEND && (most - 15.0).abs() < 0.1, "{most} N when pulled by {pulled} m/s");
        }
    }

    /// A pull that comes at once swings no higher than itself: nine tenths of what holds let nothing go, and a tenth more than that does.
    #[test]
    fn what_is_pulled_at_once_is_held_as_well() {
        let holds = [quirk("A", "breakaway-friction", &[("force", 15.0)])];
        let gone = |force: f64| after(&holds, force / 20_000.0, 1.0)[0];
        assert!(gone(0.9 * 15.0) < 1.05 * BEND, "{}", gone(0.9 * 15.0));
        assert!(gone(1.1 * 15.0) > 10.0 * BEND, "{}", gone(1.1 * 15.0));
    }

    #[test]
    fn two_masses_come_to_rest_where_one_does() {
        let spring = [quirk("A", "compliance", &[("stiffness", 20_000.0), ("damping", 100.0)])];
        let [x, ..] = after(&spring, 0.01, 3.0);
        assert!((x - 0.01).abs() < 1e-6, "{x}");
    }
}
