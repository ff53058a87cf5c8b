//! One device of a case alone: the others do not touch it, so that only what it draws of a common supply has to be known of them.

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
    /// Its own commands, in order.
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
}

/// The standard deviation of what is known of the filter of flags, s: it is drawn up to 1 ms.
const FILTER: f64 = 3e-4;

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

    /// What is heard of it until `end`, with these effects beside the others, and what is unknown so far off.
    pub fn hear(&self, quirks: &[Quirk], unknowns: &Unknowns, end: f64) -> Heard {
        let quirks = &[&self.others, quirks].concat();
        let shares: Vec<f64> = unknowns.measures.iter().map(|off| off * self.share).collect();
        let mut plant = with_larger(self.built, self.device, &shares).plant(quirks, self.seed).telling_parts();
        plant.keep(self.device, self.company.clone());
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
        commands.retain(|command| command.signal.split_once('.').is_some_and(|(device, _)| device == self.device));
        let signals = plant.signals.clone();
        let watched: Vec<bool> = signals.iter().map(|signal| record::passes(quirks, signal).next().is_some()).collect();
        let streams = plant.run(&commands, &samples, &watched, end);
        let streams: Vec<Stream> = streams
            .into_iter()
            .zip(&signals)
            .map(|(stream, signal)| record::reported(stream, signal, quirks, &around, end, &mut dice))
            .collect();
        let values = samples.iter().map(|at| streams.iter().map(|stream| stream.at(*at)).collect()).collect();
        let edges = streams.iter().zip(&signals).map(|(stream, signal)| match signal.kind.is_edge() {
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
