//! The de-palletization line under its automation, in lock-step and in memory: real sessions, real messages, no sockets and
//! no clock. Boxes come, are carried, sorted and leave; none is lost, none gets into another, whatever the seed of the bays.

use std::collections::VecDeque;
use std::time::Duration;

use kinetwin::automation::{Automation, ConnectionId, Control, Output as AutomationOutput};
use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{Plant, load};
use kinetwin::session::{Client, ClientEvent, ClientSettings, Input, Output};
use kinetwin::signal_map::{Direction, Kind, RegisterId};
use kinetwin::value::Value;

const CONNECTION: ConnectionId = ConnectionId(1);
/// Steps from one message with levels to the next.
const REFRESH: u64 = 20;

/// The line, its automation, and what is on its way between them.
struct Line {
    plant: Plant,
    engine: Engine,
    client: Client,
    automation: Automation,
    /// Messages that arrived and have not been taken, oldest first.
    staged: VecDeque<Vec<(RegisterId, Value)>>,
    sent: Vec<Value>,
}

impl Line {
    fn new(seed: u64) -> Line {
        let plant = load(&Embedded, "models/depalletizer", KINDS).expect("the line");
        let engine = Engine::new(&plant, Duration::from_millis(1), seed).expect("a plant that runs");
        let client = Client::new(ClientSettings::new("line"), plant.signal_map.clone());
        let automation = Automation::new(plant.signal_map.clone(), Control::ByPlant).expect("its program");
        let sent = engine.registers().to_vec();
        Line { plant, engine, client, automation, staged: VecDeque::new(), sent }
    }

    /// One step: takes what arrived, moves, sends what changed, and waits for the answer.
    fn step(&mut self) {
        let mut inputs: Vec<(RegisterId, Value)> = Vec::new();
        while let Some(message) = self.staged.front() {
            if message.iter().any(|(register, _)| inputs.iter().any(|(taken, _)| taken == register)) {
                break;
            }
            inputs.extend(self.staged.pop_front().into_iter().flatten());
        }
        let now = self.engine.now();
        let refresh = self.engine.steps().is_multiple_of(REFRESH);
        let registers = self.engine.tick(&inputs);
        let mut changed = Vec::new();
        for (register, signal) in self.plant.signal_map.directed(Direction::Report) {
            let value = &registers[register.index()];
            if (signal.kind == Kind::Edge || refresh) && *value != self.sent[register.index()] {
                changed.push((register, value.clone()));
                self.sent[register.index()] = value.clone();
            }
        }
        if !changed.is_empty() {
            self.client.send(now, &changed);
        }
        self.automation.wake(now);
        self.exchange(now);
    }

    /// Hands messages over until nobody has anything to say.
    fn exchange(&mut self, now: kinetwin::time::Instant) {
        let mut quiet = false;
        while !quiet {
            quiet = true;
            while let Some(output) = self.client.poll() {
                quiet = false;
                match output {
                    Output::Transmit(text) => self.automation.handle(now, CONNECTION, Input::Text(&text)),
                    Output::Close { reason, .. } => panic!("closed: {reason}"),
                    Output::Event(ClientEvent::Dial { .. }) => {
                        self.automation.handle(now, CONNECTION, Input::Opened);
                        self.client.handle(now, Input::Opened);
                    }
                    Output::Event(ClientEvent::Established { .. }) => {
                        let all = self.plant.signal_map.directed(Direction::Report);
                        let all: Vec<_> = all.map(|(id, _)| (id, self.sent[id.index()].clone())).collect();
                        self.client.send(now, &all);
                    }
                    Output::Event(ClientEvent::Values(staged)) => self.staged.push_back(staged.values),
                    Output::Event(event) => panic!("{event:?}"),
                }
            }
            while let Some(output) = self.automation.poll() {
                quiet = false;
                match output {
                    AutomationOutput::Transmit { text, .. } => self.client.handle(now, Input::Text(&text)),
                    AutomationOutput::Close { reason, .. } => panic!("closed: {reason}"),
                }
            }
        }
    }

    fn run_to(&mut self, seconds: f64) {
        while self.engine.now().seconds() < seconds - 1e-9 {
            self.step();
        }
    }

    /// Runs on, and expects at least so many boxes out by then, none lost and none in another.
    fn check(&mut self, seconds: f64, at_least: u64) {
        self.run_to(seconds);
        let counts = self.engine.counts();
        let incidents = self.engine.take_incidents();
        let told: Vec<String> = incidents.iter().map(ToString::to_string).collect();
        assert_eq!((counts.boxes_lost, counts.pallets_lost, counts.collisions), (0, 0, 0), "{told:#?}");
        assert_eq!(counts.boxes_in, counts.boxes_out + counts.boxes_present);
        assert!(counts.boxes_out >= at_least, "after {seconds} s only {counts:?}");
        println!("at {seconds} s: {counts:?}");
    }
}

#[test]
fn boxes_come_out_from_the_start_and_go_on_coming() {
    let mut line = Line::new(1);
    line.check(20.0, 4);
    line.check(60.0, 16);
}

/// `KINETWIN_LINE_SECONDS` and `KINETWIN_LINE_SEEDS` ask for more: ten minutes of twelve seeds take some.
#[test]
fn no_seed_stops_the_line() {
    let asked = |name: &str, default: &str| std::env::var(name).unwrap_or_else(|_| default.to_owned());
    let seconds: f64 = asked("KINETWIN_LINE_SECONDS", "90").parse().expect("a number of seconds");
    for seed in asked("KINETWIN_LINE_SEEDS", "2 3").split_whitespace() {
        let mut line = Line::new(seed.parse().expect("seeds are whole numbers"));
        line.check(seconds, (seconds / 6.0) as u64);
        assert!(line.engine.counts().pallets_out >= (seconds / 60.0) as u64, "{:?}", line.engine.counts());
    }
}

#[test]
fn two_runs_of_one_seed_are_one() {
    let hashes = |seed: u64| {
        let mut line = Line::new(seed);
        let at = |line: &mut Line, seconds: f64| {
            line.run_to(seconds);
            line.engine.state_hash()
        };
        [5.0, 10.0, 15.0].map(|seconds| at(&mut line, seconds))
    };
    assert_eq!(hashes(4), hashes(4));
    assert_ne!(hashes(4)[2], hashes(5)[2]);
}

/// Numbers from a seed (Marsaglia's xorshift), for commands that no automation would give.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.roll() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The robot ploughs through the stacks, pushers push what they should not, belts run anyhow: parts fall and are crushed, and
/// that is counted; nothing panics, no part is counted twice or forgotten, and the run can be repeated.
#[test]
fn whatever_is_commanded_every_part_is_accounted_for() {
    let run = |seed: u64| {
        let Line { plant, mut engine, .. } = Line::new(seed);
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        let commands: Vec<_> = plant.signal_map.directed(Direction::Command).collect();
        for step in 0..20_000_u32 {
            let mut inputs = Vec::new();
            if step.is_multiple_of(20) {
                let (register, signal) = commands[dice.roll() as usize % commands.len()];
                let number = match signal.property.as_str() {
                    "motorDirection" => dice.between(-1.4, 1.9),
                    "command" => dice.between(0.0, 2.4),
                    "velocityTarget" => dice.between(-0.5, 1.0),
                    // Often where boxes are.
                    "ZTarget" => [-1.014, -0.774, -0.704, -0.4][dice.roll() as usize % 4],
                    "YTarget" => [0.0, 0.3, 1.2][dice.roll() as usize % 3],
                    "suctionOn" => f64::from(dice.between(0.0, 1.0) < 0.9),
                    "blowOn" | "grip" => f64::from(dice.between(0.0, 1.0) < 0.1),
                    _ => dice.between(-0.6, 1.6),
                };
                inputs.push((register, Value::from_f64(signal.ty.element, number)));
            }
            engine.tick(&inputs);
        }
        let counts = engine.counts();
        assert_eq!(counts.boxes_in, counts.boxes_out + counts.boxes_lost + counts.boxes_present, "{counts:?}");
        assert_eq!(counts.pallets_in, counts.pallets_out + counts.pallets_lost + counts.pallets_present, "{counts:?}");
        let mut numbers: Vec<u64> = engine.parts().map(|part| part.number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        assert_eq!(numbers.len() as u64, counts.boxes_present + counts.pallets_present);
        println!("seed {seed}: {counts:?}");
        engine.state_hash()
    };
    for seed in 1..4 {
        assert_eq!(run(seed), run(seed));
    }
}
