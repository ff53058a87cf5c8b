//! One device of a case alone: where the others do not touch it, only what it draws of a common supply has to be known of them.

use super::candidate::numbers;
use crate::chance::Dice;
use crate::machine::{Machine, with_larger};
use crate::plant::{Command, Signal};
use crate::quirk::Quirk;
use crate::record::{self, Surroundings};
use crate::stream::Stream;

/// A device under the commands of a case's training recording.
pub struct Alone<'a> {
    pub built: &'a dyn Machine,
    pub around: &'a Surroundings,
    /// Its name in the plant.
    pub device: &'a str,
    /// Whether no other device touches it; else all of them run, and it is what is listened to.
    pub is_apart: bool,
    /// Its own commands, in order; those of all devices where they touch it.
    pub script: Vec<Command>,
    /// What else is wrong with the machine, whatever is looked for.
    pub others: Vec<Quirk>,
    /// How many other devices move, from when on.
    pub company: Vec<(f64, usize)>,
    pub seed: u64,
    /// The standard deviation of its measures, a share of each.
    pub share: f64,
}

/// What is reported of a device, without noise.
pub struct Heard {
    /// By report, then by signal.
    pub values: Vec<Vec<f64>>,
    /// By signal, the instants of its changes and what it changes to; none of a level.
    pub edges: Vec<Vec<(f64, f64)>>,
}

/// What is not known of a machine beside its effect, in standard deviations.
#[derive(Clone, Debug, Default)]
pub struct Unknowns {
    pub measures: Vec<f64>,
    /// Of the filter of flags.
    pub filter: f64,
    /// Of the numbers of what else is wrong with the device, in their order.
    pub others: Vec<f64>,
}

impl Unknowns {
    /// Of `measures` measures, the filter and the numbers of others, in this order.
    pub fn of(off: &[f64], measures: usize) -> Unknowns {
        let (own, rest) = off.split_at(measures.min(off.len()));
        let filter = rest.first().copied().unwrap_or(0.0);
        Unknowns { measures: own.to_vec(), filter, others: rest.get(1..).unwrap_or_default().to_vec() }
    }
}

/// The standard deviation of what is known of the filter of flags, s: it is drawn up to 1 ms.
const FILTER: f64 = 3e-4;

/// A number of one of several effects: the effect's place among them, the number's name and where it does nothing.
pub type Number = (usize, (&'static str, f64));

/// The numbers of those of `others` that show at `device`.
pub fn numbers_at(machine: &dyn Machine, others: &[Quirk], device: &str) -> Vec<Number> {
    let own = others.iter().enumerate().filter(|(_, other)| machine.reporter(&other.device) == device);
    own.flat_map(|(at, other)| numbers(other).map(move |number| (at, number))).collect()
}

/// The same effects with a number so far off, of which nothing is known but its order of magnitude: a standard deviation makes e times as much of it.
pub fn with_number(others: &[Quirk], (at, (name, neutral)): Number, off: f64) -> Vec<Quirk> {
    let mut others = others.to_vec();
    let own = others[at].parameters.iter_mut().filter(|(own, _)| own == name);
    own.for_each(|(_, value)| *value = neutral + (*value - neutral) * off.exp());
    others
}

impl Alone<'_> {
    /// Its signals, in the order of its readings.
    pub fn signals(&self) -> Vec<Signal> {
        let mut signals = self.built.plant(&[], 0).signals;
        signals.retain(|signal| signal.parts().0 == self.device);
        signals
    }

    /// How many of its measures are built to a tolerance.
    pub fn measures(&self) -> usize {
        if self.share > 0.0 { self.built.boxed().measures(self.device).len() } else { 0 }
    }

    /// The numbers of what else is wrong with it.
    pub fn numbers(&self) -> Vec<Number> {
        numbers_at(self.built, &self.others, self.device)
    }

    /// The others, their numbers so far off.
    fn others(&self, off: &[f64]) -> Vec<Quirk> {
        let moved = self.numbers().into_iter().zip(off).filter(|(_, off)| **off != 0.0);
        moved.fold(self.others.clone(), |others, (number, off)| with_number(&others, number, *off))
    }

    /// How many things are not known of it.
    pub fn unknown(&self) -> usize {
        self.measures() + 1 + self.numbers().len()
    }

    /// What is heard of it until `end`, with these effects beside the others, and what is unknown so far off.
    pub fn hear(&self, quirks: &[Quirk], unknowns: &Unknowns, end: f64) -> Heard {
        let quirks = &[self.others(&unknowns.others).as_slice(), quirks].concat();
        let shares: Vec<f64> = unknowns.measures.iter().map(|off| off * self.share).collect();
        let mut plant = with_larger(self.built, self.device, &shares).plant(quirks, self.seed).telling_parts();
        if self.is_apart {
            plant.keep(self.device, self.company.clone());
        }
        let filter = (self.around.filter + FILTER * unknowns.filter).max(0.0);
        let around = Surroundings { filter, ..self.around.clone() };
        // Its own stream: chance is another than in the recording, and of the same kind.
        let mut dice = Dice::new(self.seed, 23);
        let samples: Vec<f64> = (0..)
            .map(|k| around.phase + f64::from(k) * around.cycle)
            .take_while(|at| *at < end)
            .map(|at| (at - around.age).max(0.0))
            .collect();
        let mut commands = record::taken(&self.script, &plant, &around, end, &mut dice);
        let is_its = |signal: &str| signal.split_once('.').is_some_and(|(device, _)| device == self.device);
        commands.retain(|command| !self.is_apart || is_its(&command.signal));
        let signals = plant.signals.clone();
        let watched: Vec<bool> = signals.iter().map(|signal| record::passes(quirks, signal).next().is_some()).collect();
        let streams = plant.run(&commands, &samples, &watched, end);
        let streams: Vec<Stream> = streams
            .into_iter()
            .zip(&signals)
            .filter(|(_, signal)| is_its(&signal.name))
            .map(|(stream, signal)| record::reported(stream, signal, quirks, &around, end, &mut dice))
            .collect();
        let values = samples.iter().map(|at| streams.iter().map(|stream| stream.at(*at)).collect()).collect();
        let own = signals.iter().filter(|signal| is_its(&signal.name));
        let edges = streams.iter().zip(own).map(|(stream, signal)| match signal.kind.is_edge() {
            // What comes after the last report nobody hears.
            true => stream
                .points()
                .iter()
                .filter(|(at, _)| samples.last().is_some_and(|last| at <= last))
                .copied()
                .collect(),
            false => Vec::new(),
        });
        Heard { values, edges: edges.collect() }
    }
}
