//! Plants drawn at random from the kinds of devices: 3 to 8 of them, each to figures of its own.

mod figures;
mod names;
mod sizes;
mod unit;
mod xml;

use std::collections::BTreeMap;

use crate::chance::Dice;
use crate::machine::Machine;
use crate::plant::{Command, Kind, Plant};
use crate::quirk::Quirk;
use crate::script::{Part, Program};
use figures::KINDS;
pub use sizes::fitted;
pub use unit::{Figures, Unit, measures};

/// The fewest and the most devices of a plant.
const FEWEST: usize = 3;
const MOST: usize = 8;

/// A plant as it is designed, or as one was built.
#[derive(Clone, Debug)]
pub struct Drawn {
    name: String,
    units: Vec<Unit>,
    /// For each of the rig's devices the one that stands for it: where an effect of the catalogue is put.
    hosts: BTreeMap<&'static str, usize>,
}

impl Drawn {
    /// A plant that has at least one device for each of the rig's devices `wanted`.
    pub fn draw(wanted: &[&str], dice: &mut Dice) -> Drawn {
        let is_wanted = |kind: &&str| wanted.contains(kind) || *kind == "Belt" && wanted.contains(&"Feed");
        let mut kinds: Vec<&str> = KINDS.into_iter().filter(is_wanted).collect();
        let count = FEWEST + dice.below(MOST - FEWEST + 1);
        while kinds.len() < count {
            kinds.push(KINDS[dice.below(KINDS.len())]);
        }
        dice.shuffle(&mut kinds);
        let mut taken = Vec::new();
        let mut name = |kind: &str, dice: &mut Dice| {
            let name = names::draw(kind, &taken, dice);
            taken.push(name.clone());
            name
        };
        let mut units = Vec::new();
        for kind in kinds {
            let own = name(kind, dice);
            let feed = if kind == "Belt" { name("Feed", dice) } else { String::new() };
            units.push(Unit { name: own, figures: Figures::draw(kind, feed, dice) });
        }
        let mut hosts = BTreeMap::new();
        for kind in KINDS {
            let all: Vec<usize> = (0..units.len()).filter(|at| units[*at].figures.kind() == kind).collect();
            if !all.is_empty() {
                hosts.insert(kind, *dice.one_of(&all));
            }
        }
        Drawn { name: format!("cell-{}", 100 + dice.below(900)), units, hosts }
    }

    /// As one is built: every measure anywhere within its `tolerance`, a share of itself.
    pub fn built(&self, tolerance: f64, dice: &mut Dice) -> Drawn {
        let mut built = self.clone();
        for measure in built.units.iter_mut().flat_map(|unit| unit.figures.measures()) {
            *measure *= 1.0 + dice.between(-tolerance, tolerance);
        }
        built
    }

    /// Its file.
    pub fn xml(&self, tolerance: f64) -> String {
        xml::plant(&self.name, &self.units, tolerance)
    }

    /// The device that stands for one of the rig's.
    fn host(&self, device: &str) -> Option<&Unit> {
        let kind = if device == "Feed" { "Belt" } else { device };
        self.hosts.get(kind).map(|at| &self.units[*at])
    }
}

impl Machine for Drawn {
    fn plant(&self, quirks: &[Quirk], seed: u64) -> Plant {
        let device =
            |(at, unit): (usize, &Unit)| (unit.name.clone(), unit.device(quirks, seed.wrapping_add(at as u64)));
        let signals = self.units.iter().flat_map(Unit::signals).collect();
        Plant::new(self.units.iter().enumerate().map(device).collect(), self.commands(), signals, quirks)
    }

    fn commands(&self) -> Vec<(String, Kind)> {
        self.units.iter().flat_map(Unit::commands).collect()
    }

    fn program(&self, part: Part, _quirks: &[Quirk], _seed: u64, dice: &mut Dice) -> Vec<Command> {
        let mut program = Program::new(part);
        for unit in &self.units {
            unit.program(&mut program, dice);
        }
        program.sent(dice)
    }

    fn boxed(&self) -> Box<dyn Machine> {
        Box::new(self.clone())
    }

    fn measures(&mut self, device: &str) -> Vec<&mut f64> {
        measures(&mut self.units, device)
    }

    fn has(&self, device: &str) -> bool {
        self.host(device).is_some()
    }

    fn reporter<'a>(&'a self, device: &'a str) -> &'a str {
        let feeds = |unit: &&Unit| matches!(&unit.figures, Figures::Belt { feed, .. } if feed == device);
        self.units.iter().find(feeds).map_or(device, |unit| &unit.name)
    }

    fn kind(&self, device: &str) -> String {
        let unit = self.units.iter().find(|unit| unit.name == device);
        // What is no device of it is the bay that feeds one.
        unit.map_or("Feed", |unit| unit.figures.kind()).to_owned()
    }

    fn fitted(&self, quirk: Quirk) -> Quirk {
        let Some(host) = self.host(&quirk.device) else { return quirk };
        let name = match (&host.figures, quirk.device.as_str()) {
            (Figures::Belt { feed, .. }, "Feed") => feed,
            _ => &host.name,
        };
        Quirk { device: name.clone(), ..fitted(quirk, &host.figures) }
    }
}

#[cfg(test)]
mod tests;
