//! A plant that runs while it is told what to do.

use std::collections::VecDeque;

use super::link::Link;
use crate::chance::Dice;
use crate::plant::{Command, Kind, Plant, STEP};
use crate::quirk::{Quirk, Quirks};
use crate::record::{self, Surroundings};

/// A plant at an instant, with all that lies between it and its automation but the socket.
pub struct Running {
    plant: Plant,
    around: Surroundings,
    now: f64,
    inputs: Vec<Input>,
    /// Commands that their task has yet to take, in the order of time.
    coming: VecDeque<Command>,
    /// By signal.
    ways: Vec<Vec<Link>>,
    /// What sensors see.
    sensed: Vec<f64>,
    /// What has come of it at the end of each signal's way.
    values: Vec<f64>,
}

/// A command's way to its device.
struct Input {
    name: String,
    /// The command that it is taken for.
    arrives_at: String,
    kind: Kind,
    links: Vec<Link>,
    /// What the automation said last.
    held: f64,
    /// What the device was told last.
    told: Option<f64>,
}

impl Running {
    /// At its beginning, every command 0. `seed` is that of all that its links leave to chance.
    pub fn new(plant: Plant, around: &Surroundings, seed: u64) -> Running {
        let mut dice = Dice::new(seed, 23);
        let inputs = plant.commands.iter();
        let inputs = inputs.map(|(name, kind)| Input::new(name, *kind, &plant.quirks, &mut dice)).collect();
        let mut links = |signal| {
            let way = record::way(&plant.quirks, signal, around);
            let (kind, is_edge) = (signal.kind, signal.kind.is_edge());
            way.iter().filter_map(|quirk| Link::of(quirk, kind, is_edge, dice.seed())).collect()
        };
        let ways = plant.signals.iter().map(&mut links).collect();
        let around = around.clone();
        let (sensed, values, coming) = (Vec::new(), Vec::new(), VecDeque::new());
        let mut running = Running { plant, around, now: 0.0, inputs, coming, ways, sensed, values };
        running.settle();
        running
    }

    /// Where in time it is, s.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// Moves on to `until`, or stays where that has passed.
    pub fn run_until(&mut self, until: f64) {
        while self.now < until {
            let next = (self.now + STEP).min(until);
            let next = self.coming.front().map_or(next, |command| next.min(command.at)).max(self.now);
            self.plant.advance(next, next - self.now);
            self.now = next;
            self.settle();
        }
    }

    /// At `at`, which it runs to, a command arrives. Says whether there is one of that name.
    #[must_use]
    pub fn hear(&mut self, at: f64, name: &str, value: f64) -> bool {
        self.run_until(at);
        let Some(input) = self.inputs.iter_mut().find(|input| input.name == name) else { return false };
        input.held = value;
        self.settle();
        true
    }

    /// What its reports would say, in the order of its signals, but for noise and rounding.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Lets everything see what there is now.
    fn settle(&mut self) {
        let now = self.now;
        for input in &mut self.inputs {
            if let Some(value) = input.says(now) {
                let at = self.around.taken_at(now);
                self.coming.push_back(Command { at, signal: input.arrives_at.clone(), value });
            }
        }
        while let Some(command) = self.coming.pop_front_if(|command| command.at <= now) {
            self.plant.tell(now, &command);
        }
        self.plant.read(now, &mut self.sensed);
        self.values.clear();
        for (way, sensed) in self.ways.iter_mut().zip(&self.sensed) {
            self.values.push(way.iter_mut().fold(*sensed, |value, link| link.pass(now, value)));
        }
        record::swap(&mut self.values, &self.plant.signals, &self.plant.quirks);
    }
}

impl Input {
    fn new(name: &str, kind: Kind, quirks: &[Quirk], dice: &mut Dice) -> Input {
        let (device, port) = name.split_once('.').unwrap_or_default();
        let on_its_way = Quirks::of(quirks, device).at("command-link", port);
        let links = on_its_way.filter_map(|quirk| Link::of(quirk, kind, true, dice.seed()));
        let (links, arrives_at) = (links.collect(), record::arrives_at(quirks, name));
        Input { name: name.to_owned(), arrives_at, kind, links, held: 0.0, told: None }
    }

    /// What its device is to be told at `now`, if that is news.
    fn says(&mut self, now: f64) -> Option<f64> {
        let said = self.links.iter_mut().fold(self.held, |value, link| link.pass(now, value));
        let said = if self.kind == Kind::Code { said.round() } else { said };
        (self.told.replace(said) != Some(said)).then_some(said)
    }
}
