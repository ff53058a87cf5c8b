//! Motion programs: what the automation tells devices that nothing connects, so that each shows what it can.

use std::f64::consts::TAU;

use crate::chance::Dice;
use crate::plant::Command;
use crate::robot::AXES;

/// The automation's cycle, s.
const CYCLE: f64 = 0.02;

/// Which of the two recordings of a case; they move in other ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Train,
    HeldOut,
}

impl Part {
    /// How long it is, s.
    pub fn seconds(self) -> f64 {
        match self {
            Part::Train => 54.0,
            Part::HeldOut => 42.0,
        }
    }

    /// What its recording is called.
    pub fn file(self) -> &'static str {
        match self {
            Part::Train => "train.cps.jsonl.zst",
            Part::HeldOut => "holdout.cps.jsonl.zst",
        }
    }
}

/// A program for all devices of the rig, in order of time.
pub fn program(part: Part, dice: &mut Dice) -> Vec<Command> {
    let mut program = Program::new(part);
    program.belt("Belt", 1.0, dice);
    program.pusher("Pusher", 1.0, dice);
    program.robot("Robot", [0.5, 0.5, 0.35, 1.4], [1.0; 4], dice);
    program.gripper("Gripper", 1.0, dice);
    program.axis("Axis", 1.0, dice);
    program.motor("Motor", 1.0, dice);
    program.sent(dice)
}

/// A program under way. What is larger, faster or slower than the rig's moves as much further, faster or slower.
pub struct Program {
    end: f64,
    /// The held-out part moves more briskly, and in other shapes.
    brisk: bool,
    commands: Vec<Command>,
}

impl Program {
    /// An empty one.
    pub fn new(part: Part) -> Program {
        Program { end: part.seconds(), brisk: part == Part::HeldOut, commands: Vec::new() }
    }

    fn say(&mut self, at: f64, signal: &str, value: f64) {
        self.commands.push(Command { at, signal: signal.to_owned(), value });
    }

    /// Commands leave with the automation's cycle, a little late, and each signal once in a cycle.
    pub fn sent(mut self, dice: &mut Dice) -> Vec<Command> {
        let lates: Vec<f64> = (0..=(self.end / CYCLE) as usize + 1).map(|_| (1.2e-3 * dice.normal()).abs()).collect();
        self.commands.retain(|command| command.at < self.end);
        for command in &mut self.commands {
            let cycle = (command.at / CYCLE).round();
            // A recorder stamps to the microsecond.
            command.at = ((cycle * CYCLE + lates[cycle as usize].min(8e-3)) * 1e6).round() / 1e6;
        }
        self.commands.retain(|command| command.at < self.end);
        self.commands.sort_by(|a, b| a.at.total_cmp(&b.at));
        let mut kept: Vec<Command> = Vec::new();
        for command in self.commands {
            match kept
                .iter_mut()
                .rev()
                .take_while(|last| last.at == command.at)
                .find(|last| last.signal == command.signal)
            {
                Some(same) => same.value = command.value,
                None => kept.push(command),
            }
        }
        kept
    }

    /// Boxes come by, at several speeds; it stops, starts and turns round.
    pub fn belt(&mut self, name: &str, faster: f64, dice: &mut Dice) {
        let [velocity, direction_of] = ["velocityTarget", "motorDirection"].map(|port| format!("{name}.{port}"));
        let mut at = 0.3;
        self.say(at, &velocity, round(0.2 * faster, 1e-3));
        self.say(at, &direction_of, 1.0);
        let mut direction = 1.0;
        while at < self.end {
            at += dice.between(0.5, if self.brisk { 2.0 } else { 3.0 });
            if dice.is_so(0.22) {
                self.say(at, &direction_of, 0.0);
                at += dice.between(0.2, 1.2);
                direction = if dice.is_so(0.25) { -direction } else { direction };
                self.say(at, &direction_of, direction);
                if direction < 0.0 {
                    at += dice.between(0.5, 1.0);
                    direction = 1.0;
                    self.say(at, &direction_of, direction);
                }
            }
            self.say(at, &velocity, round(dice.between(0.12 * faster, 0.6 * faster), 1e-3));
        }
    }

    /// Strokes, some of them broken off, some of them halted.
    pub fn pusher(&mut self, name: &str, longer: f64, dice: &mut Dice) {
        let command = format!("{name}.command");
        let (mut at, mut out) = (dice.between(0.5, 1.0), false);
        while at < self.end {
            out = !out;
            let way = if out { 1.0 } else { 2.0 };
            self.say(at, &command, way);
            match dice.below(4) {
                0 => {
                    at += dice.between(0.2, 0.6) * longer;
                    self.say(at, &command, 0.0);
                    at += dice.between(0.1, 0.4) * longer;
                    self.say(at, &command, way);
                    at += 1.1 * longer;
                }
                1 => at += dice.between(0.3, 0.9) * longer,
                _ => at += dice.between(1.1, 1.9) * longer,
            }
        }
    }

    /// Each axis by itself, within its reach either way; its pauses are longer where its ways take longer.
    pub fn robot(&mut self, name: &str, reaches: [f64; 4], longer: [f64; 4], dice: &mut Dice) {
        for (at_axis, axis) in AXES.iter().enumerate() {
            let (reach, longer) = (reaches[at_axis], longer[at_axis]);
            let signal = format!("{name}.{axis}Target");
            let mut at = dice.between(0.2, 0.6);
            while at < self.end {
                let target = match dice.below(5) {
                    0 => 0.08 * reach,
                    1 => 0.4 * reach,
                    _ => 2.0 * reach,
                };
                self.say(at, &signal, round(dice.between(-target, target).clamp(-reach, reach), 1e-4));
                // Some targets are never reached, some are rested at.
                let pause = if dice.is_so(0.25) { dice.between(0.15, 0.7) } else { dice.between(1.2, 2.8) };
                at += pause * longer;
            }
        }
        let mut at = 1.0;
        while at < self.end {
            let grips = f64::from(dice.is_so(0.5));
            self.say(at, &format!("{name}.grip"), grips);
            at += dice.between(1.0, 4.0);
        }
    }

    /// Grips, some too short for a vacuum, some blown off.
    pub fn gripper(&mut self, name: &str, longer: f64, dice: &mut Dice) {
        let [suction, blow] = ["suctionOn", "blowOn"].map(|port| format!("{name}.{port}"));
        let mut at = dice.between(0.3, 0.6);
        while at < self.end {
            self.say(at, &suction, 1.0);
            at += longer * if dice.is_so(0.15) { dice.between(0.06, 0.2) } else { dice.between(0.3, 1.0) };
            let blows = dice.is_so(0.35);
            if blows {
                self.say(at, &blow, 1.0);
                at += dice.between(0.05, 0.2);
            }
            self.say(at, &suction, 0.0);
            at += dice.between(0.15, 0.6) * longer;
            if blows {
                self.say(at, &blow, 0.0);
                at += 0.04;
            }
        }
    }

    /// Slow and quick sines, ramps, small and large steps, rests.
    pub fn axis(&mut self, name: &str, further: f64, dice: &mut Dice) {
        let signal = format!("{name}.positionTarget");
        let (mut at, mut base) = (0.4, 0.0);
        while at < self.end {
            let length = dice.between(2.5, 5.0);
            let kind = dice.below(if self.brisk { 4 } else { 5 });
            let shape = Shape::draw(kind, self.brisk, dice);
            let steps = (length / CYCLE) as usize;
            let mut value = base;
            for k in 0..steps {
                let t = k as f64 * CYCLE;
                let next = round((base + further * shape.at(t)).clamp(-0.45 * further, 0.45 * further), 1e-5);
                if next != value || k == 0 {
                    self.say(at + t, &signal, next);
                }
                value = next;
            }
            base = value;
            at += length + if dice.is_so(0.3) { dice.between(0.3, 1.0) } else { 0.0 };
        }
    }

    /// Runs at several speeds, swings, loses its enable.
    pub fn motor(&mut self, name: &str, faster: f64, dice: &mut Dice) {
        let [target, enable] = ["speedTarget", "enable"].map(|port| format!("{name}.{port}"));
        let mut at = 0.44;
        self.say(at, &enable, 1.0);
        while at < self.end {
            if dice.is_so(0.2) {
                let (top, often) = (dice.between(3.0, 16.0), dice.between(0.2, 0.6));
                let from = at;
                while at < from + 3.0 {
                    self.say(at, &target, round(faster * top * (TAU * often * (at - from)).sin(), 1e-3));
                    at += 0.1;
                }
            }
            let speed = faster * dice.between(-24.0, 24.0);
            self.say(at, &target, round(speed, 1e-3));
            at += dice.between(0.4, if self.brisk { 1.6 } else { 3.0 });
            if dice.is_so(0.2) {
                self.say(at, &enable, 0.0);
                at += dice.between(0.3, 1.5);
                self.say(at, &enable, 1.0);
            }
        }
    }
}

/// A motion of the axis about where it is.
enum Shape {
    Sine { size: f64, often: f64 },
    Two { size: f64, often: [f64; 2] },
    Ramp { speed: f64, turn: f64 },
    Step { size: f64, every: f64 },
}

impl Shape {
    fn draw(kind: usize, brisk: bool, dice: &mut Dice) -> Shape {
        match kind {
            0 if !brisk => Shape::Sine { size: dice.between(0.01, 0.1), often: dice.between(0.15, 0.8) },
            0 | 1 => {
                let often = [dice.between(0.3, 0.9), dice.between(1.1, 3.0)];
                Shape::Two { size: dice.between(0.005, 0.04), often }
            }
            2 => Shape::Ramp { speed: dice.log_between(0.004, 0.3), turn: dice.between(0.6, 1.6) },
            _ => Shape::Step { size: dice.log_between(0.002, 0.09), every: dice.between(0.4, 1.0) },
        }
    }

    fn at(&self, t: f64) -> f64 {
        match self {
            Shape::Sine { size, often } => size * (TAU * often * t).sin(),
            Shape::Two { size, often } => size * ((TAU * often[0] * t).sin() + 0.5 * (TAU * often[1] * t).sin()),
            Shape::Ramp { speed, turn } => {
                let whole = t / (2.0 * turn);
                let part = whole - whole.floor();
                2.0 * turn * speed * part.min(1.0 - part)
            }
            Shape::Step { size, every } => {
                if ((t / every) as usize).is_multiple_of(2) {
                    *size
                } else {
                    0.0
                }
            }
        }
    }
}

fn round(value: f64, grid: f64) -> f64 {
    (value / grid).round() * grid
}
