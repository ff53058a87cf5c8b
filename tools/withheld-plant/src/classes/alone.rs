//! One device of a case alone: where the others do not touch it, only what it draws of a common supply has to be known of them.

use super::candidate::{is_random, numbers};
use crate::chance::Dice;
use crate::machine::{Machine, with_larger};
use crate::plant::{Command, Rest, Signal};
use crate::quirk::Quirk;
use crate::recent::Recent;
use crate::record::{self, Surroundings};
use crate::stream::Stream;

/// A device under the commands of a case's training recording.
pub struct Alone<'a> {
    pub built: &'a dyn Machine,
    pub around: &'a Surroundings,
    /// Its name in the plant.
    pub device: &'a str,
    /// The devices that run so that it does what it does, itself among them.
    pub about: Vec<String>,
    /// Their commands, in order.
    pub script: Vec<Command>,
    /// What else is wrong with the machine, whatever is looked for.
    pub others: Vec<Quirk>,
    /// What all others do.
    pub rest: Rest,
    pub seed: u64,
    /// The standard deviation of its measures, a share of each.
    pub share: f64,
    /// What its sensors saw in the last few runs.
    pub motions: Recent<Moves, Motion>,
}

/// Whether a run is hopeless by what is heard until an instant.
pub type IsHopeless<'a> = dyn Fn(&Heard, f64) -> bool + 'a;

/// After these shares of a run it is looked at whether it is hopeless.
const LOOKS: [f64; 4] = [0.06, 0.15, 0.3, 0.6];

/// How many of those are kept: enough for a step of a search, and few, as a level that is watched is long.
pub const MOTIONS: usize = 3;

/// What a motion follows from: what is wrong before the sensors, the measures, which levels are seen at every step, and until when.
#[derive(Clone, Debug, PartialEq)]
pub struct Moves {
    quirks: Vec<Quirk>,
    shares: Vec<f64>,
    watched: Vec<bool>,
    end: f64,
}

/// What the sensors of a device see.
#[derive(Clone, Debug)]
pub struct Motion {
    streams: Vec<Stream>,
    /// Chance as its commands leave it.
    dice: Dice,
}

/// What is wrong with reports alone, so that nothing moves otherwise. A switch along a way is a part of its device.
pub fn is_of_reports(quirk: &Quirk) -> bool {
    let is_after =
        ["offset", "gain", "drift", "quantisation", "noise", "on-delay", "off-delay"].contains(&quirk.effect.as_str());
    quirk.place == "report-link" || quirk.place == "sensor" && is_after
}

/// What is reported of a device, without noise.
#[derive(Default)]
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
        self.hear_unless(quirks, unknowns, end, None).unwrap_or_default()
    }

    /// The same, unless what is heard until some instant before `end` is hopeless: then nothing.
    pub fn hear_unless(
        &self,
        quirks: &[Quirk],
        unknowns: &Unknowns,
        end: f64,
        is_hopeless: Option<&IsHopeless<'_>>,
    ) -> Option<Heard> {
        let quirks = [self.others(&unknowns.others).as_slice(), quirks].concat();
        let mut shares: Vec<f64> = unknowns.measures.iter().map(|off| off * self.share).collect();
        if shares.iter().all(|share| *share == 0.0) {
            shares.clear();
        }
        let filter = (self.around.filter + FILTER * unknowns.filter).max(0.0);
        let around = Surroundings { filter, ..self.around.clone() };
        let signals = self.signals();
        let is_watched = |signal: &Signal| !signal.kind.is_edge() && record::passes(&quirks, signal).next().is_some();
        let watched: Vec<bool> = signals.iter().map(is_watched).collect();
        let moves: Vec<Quirk> = quirks.iter().filter(|quirk| !is_of_reports(quirk)).cloned().collect();
        let key = Moves { quirks: moves, shares, watched, end };
        // Chance goes by all that passes before it: of a part of that it is another.
        let is_hopeless = is_hopeless.filter(|_| !quirks.iter().any(|quirk| is_random(&quirk.effect)));
        let heard = |motion: &Motion, until: f64| heard(motion, (&signals, &quirks), &around, until);
        let is_left = |motion: &Motion, until: f64| is_hopeless.is_some_and(|is| is(&heard(motion, until), until));
        let looks = if is_hopeless.is_some() { LOOKS.as_slice() } else { &[] };
        let motion = self.motions.find(key.clone(), || self.moves(&key, looks, &is_left))?;
        Some(heard(&motion, end))
    }

    /// What its sensors see, unless that is left after one of these shares of it.
    fn moves(&self, moves: &Moves, looks: &[f64], is_left: &dyn Fn(&Motion, f64) -> bool) -> Option<Motion> {
        let Moves { quirks, shares, watched, end } = moves;
        let mut plant = with_larger(self.built, self.device, shares).plant(quirks, self.seed).telling_parts();
        plant.keep(&self.about, &self.rest);
        // Its own stream: chance is another than in the recording, and of the same kind.
        let mut dice = Dice::new(self.seed, 23);
        let device_of = |signal: &str| signal.split_once('.').unwrap_or_default().0.to_owned();
        plant.commands.retain(|(signal, _)| self.about.contains(&device_of(signal)));
        let commands = record::taken(&self.script, &plant, self.around, *end, &mut dice);
        let is_its: Vec<bool> = plant.signals.iter().map(|signal| signal.parts().0 == self.device).collect();
        let mut own = watched.iter();
        let watched: Vec<bool> = is_its.iter().map(|its| *its && own.next() == Some(&true)).collect();
        let samples = samples(self.around, *end);
        let mut running = plant.begin(&commands, &samples, &watched, *end);
        let seen = |streams: &[Stream]| {
            let own = streams.iter().zip(&is_its).filter(|(_, its)| **its).map(|(stream, _)| stream.clone());
            Motion { streams: own.collect(), dice: dice.clone() }
        };
        for share in looks {
            running.until(share * end);
            if is_left(&seen(&running.streams), share * end) {
                return None;
            }
        }
        running.until(f64::INFINITY);
        Some(seen(&running.streams))
    }
}

/// When the machine is looked at for its reports before `end`.
fn samples(around: &Surroundings, end: f64) -> Vec<f64> {
    let due = (0..).map(|k| around.phase + f64::from(k) * around.cycle);
    due.take_while(|at| *at < end).map(|at| (at - around.age).max(0.0)).collect()
}

/// What is reported of a motion until `end`.
fn heard(motion: &Motion, (signals, quirks): (&[Signal], &[Quirk]), around: &Surroundings, end: f64) -> Heard {
    let samples = samples(around, end);
    let mut dice = motion.dice.clone();
    let report =
        |(stream, signal): (&Stream, &Signal)| record::reported(stream.clone(), signal, quirks, around, end, &mut dice);
    let streams: Vec<Stream> = motion.streams.iter().zip(signals).map(report).collect();
    let values = samples.iter().map(|at| streams.iter().map(|stream| stream.at(*at)).collect()).collect();
    // What comes after the last report nobody hears.
    let is_heard = |(at, _): &&(f64, f64)| samples.last().is_some_and(|last| at <= last);
    let edges = streams.iter().zip(signals).map(|(stream, signal)| match signal.kind.is_edge() {
        true => stream.points().iter().filter(is_heard).copied().collect(),
        false => Vec::new(),
    });
    Heard { values, edges: edges.collect() }
}
