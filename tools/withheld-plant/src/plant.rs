//! A plant: devices under one clock.

use std::fmt;

use crate::quirk::Quirk;
use crate::stream::Stream;

/// The longest step, s. Steps end at every command and every sample besides.
pub const STEP: f64 = 1e-4;

/// One machine.
pub trait Device: fmt::Debug + Send {
    /// A command arrives at its port: SI units, a BOOL as 0 or 1.
    fn command(&mut self, now: f64, port: &str, value: f64);
    /// Moves on by `span` until `now`, while so many others move.
    fn advance(&mut self, now: f64, span: f64, others: usize);
    /// Appends what its sensors see, in the order of its signals.
    fn read(&self, now: f64, values: &mut Vec<f64>);
    /// How many of its drives move, and so draw from a common supply: of a robot each axis is one.
    fn moving(&self) -> usize;
    /// Its counters tell parts of a count from now on: what a distance is measured in, whose unit is what rounding leaves unsure.
    fn tell_parts(&mut self) {}
    /// Every part that one belt has handed on to the next, in order.
    fn handed_on(&self) -> Vec<Entry> {
        Vec::new()
    }
    /// Only the devices `kept` are there: what other belts hand on to theirs comes as it did in a run of all.
    fn confine(&mut self, _kept: &[String], _entries: &[Entry]) {}
}

/// A part that came from one belt onto the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    pub at: f64,
    /// The next belt, by its place among the plant's belts.
    pub belt: usize,
    /// Where its centre lay then, along and across, and half its length, m.
    pub place: f64,
    pub across: f64,
    pub half: f64,
}

/// What the rest of a plant did in a run of all: what has to be known of it where a few devices run without it.
#[derive(Clone, Debug, Default)]
pub struct Rest {
    /// How many of its drives moved, from when on.
    pub company: Vec<(f64, usize)>,
    pub entries: Vec<Entry>,
}

/// What a report is, and how its sensor scatters.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// `Belt.velocityActual`
    pub name: String,
    pub kind: Kind,
    /// What it is rounded to; 0 for a flag.
    pub quantum: f64,
    /// The standard deviation of its noise where a recording's noise is 1.
    pub sigma: f64,
}

/// The type of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// BOOL
    Flag,
    /// DINT of a few values.
    Code,
    /// DINT that counts.
    Count,
    /// REAL
    Level,
}

impl Kind {
    /// Whether it jumps, so that all its changes are kept.
    pub fn is_edge(self) -> bool {
        matches!(self, Kind::Flag | Kind::Code)
    }
}

impl Signal {
    /// The device and the port.
    pub fn parts(&self) -> (&str, &str) {
        self.name.split_once('.').unwrap_or((&self.name, ""))
    }
}

/// A command at its instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    pub at: f64,
    /// `Belt.velocityTarget`
    pub signal: String,
    pub value: f64,
}

/// A plant with what is wrong with it.
#[derive(Debug)]
pub struct Plant {
    pub devices: Vec<(String, Box<dyn Device>)>,
    /// What it can be told, in the order of the first message.
    pub commands: Vec<(String, Kind)>,
    pub signals: Vec<Signal>,
    pub quirks: Vec<Quirk>,
    /// How many drives besides those of these devices move, each from its instant on; sorted.
    company: Vec<(f64, usize)>,
    /// So many of those instants have come.
    come: usize,
    /// How many drives of each device move at the step under way.
    moving: Vec<usize>,
    /// How many drives of each device moved, from when on: as it has run so far.
    pub moved: Vec<(f64, Vec<usize>)>,
    /// Whether its counters tell parts of a count.
    tells_parts: bool,
}

impl Plant {
    /// One that has not run yet, and has no company.
    pub fn new(
        devices: Vec<(String, Box<dyn Device>)>,
        commands: Vec<(String, Kind)>,
        signals: Vec<Signal>,
        quirks: &[Quirk],
    ) -> Plant {
        Plant {
            devices,
            commands,
            signals,
            quirks: quirks.to_vec(),
            company: Vec::new(),
            come: 0,
            moving: Vec::new(),
            moved: Vec::new(),
            tells_parts: false,
        }
    }

    /// What all devices but `kept` did, as it has run so far.
    pub fn rest_of(&self, kept: &[String]) -> Rest {
        let is_rest: Vec<bool> = self.devices.iter().map(|(name, _)| !kept.contains(name)).collect();
        let count =
            |moved: &[usize]| moved.iter().zip(&is_rest).filter(|(_, rest)| **rest).map(|(count, _)| count).sum();
        let company = self.moved.iter().map(|(from, moved)| (*from, count(moved))).collect();
        Rest { company, entries: self.devices.iter().flat_map(|(_, device)| device.handed_on()).collect() }
    }

    /// With only some of its devices, which no other touches but by what `rest` did.
    pub fn keep(&mut self, kept: &[String], rest: &Rest) {
        self.devices.retain(|(name, _)| kept.contains(name));
        self.devices.iter_mut().for_each(|(_, device)| device.confine(kept, &rest.entries));
        self.signals.retain(|signal| kept.iter().any(|name| name == signal.parts().0));
        (self.company, self.come) = (rest.company.clone(), 0);
    }

    /// With counters that tell parts of a count.
    pub fn telling_parts(mut self) -> Plant {
        self.tells_parts = true;
        self.devices.iter_mut().for_each(|(_, device)| device.tell_parts());
        self
    }

    /// Runs under `commands`, sorted by their instants, until `end`; gives what each sensor sees: of edges and of
    /// whatever is `watched` at every step, of everything else at the sorted `samples` only.
    pub fn run(&mut self, commands: &[Command], samples: &[f64], watched: &[bool], end: f64) -> Vec<Stream> {
        let mut running = self.begin(commands, samples, watched, end);
        running.until(f64::INFINITY);
        running.seen()
    }

    /// The same, to be run a piece at a time.
    pub fn begin<'a>(
        &'a mut self,
        commands: &'a [Command],
        samples: &'a [f64],
        watched: &[bool],
        end: f64,
    ) -> Running<'a> {
        let streams = self.signals.iter().map(|signal| Stream::new(signal.kind.is_edge())).collect();
        let is_kept: Vec<bool> =
            self.signals.iter().zip(watched).map(|(signal, watched)| *watched || signal.kind.is_edge()).collect();
        let is_count = |signal: &Signal| signal.kind == Kind::Count && !self.tells_parts;
        let counts: Vec<bool> = self.signals.iter().map(is_count).collect();
        let are_watched = counts.iter().zip(&is_kept).any(|(count, kept)| *count && *kept);
        // What a link does to a count it does to whole counts, each when it is reached: which a counter's parts say.
        if are_watched {
            self.devices.iter_mut().for_each(|(_, device)| device.tell_parts());
        }
        Running { plant: self, commands, samples, is_kept, counts, end, now: 0.0, values: Vec::new(), streams }
    }

    /// What all sensors see, in the order of the signals.
    pub fn read(&self, now: f64, values: &mut Vec<f64>) {
        values.clear();
        for (_, device) in &self.devices {
            device.read(now, values);
        }
    }

    /// Hands a command to its device; what no device knows goes nowhere.
    pub fn tell(&mut self, now: f64, command: &Command) {
        let Some((device, port)) = command.signal.split_once('.') else { return };
        if let Some((_, told)) = self.devices.iter_mut().find(|(name, _)| name == device) {
            told.command(now, port, command.value);
        }
    }

    /// Everything moves on by `span` until `now`.
    pub fn advance(&mut self, now: f64, span: f64) {
        self.moving.clear();
        self.moving.extend(self.devices.iter().map(|(_, device)| device.moving()));
        // Element by element: of so few a call that compares memory costs more than all else here.
        if self.moved.last().is_none_or(|(_, last)| !last.iter().eq(&self.moving)) {
            self.moved.push((now - span, self.moving.clone()));
        }
        let own: usize = self.moving.iter().sum();
        while self.company.get(self.come).is_some_and(|(from, _)| *from <= now - span + 1e-12) {
            self.come += 1;
        }
        let company = self.come.checked_sub(1).map_or(0, |at| self.company[at].1);
        for ((_, device), moving) in self.devices.iter_mut().zip(&self.moving) {
            device.advance(now, span, own + company - moving);
        }
    }
}

/// A run of a plant that is under way.
pub struct Running<'a> {
    plant: &'a mut Plant,
    /// What is still to come.
    commands: &'a [Command],
    samples: &'a [f64],
    is_kept: Vec<bool>,
    /// Which are whole counts.
    counts: Vec<bool>,
    end: f64,
    now: f64,
    values: Vec<f64>,
    /// What each sensor has seen so far.
    pub streams: Vec<Stream>,
}

impl Running<'_> {
    /// What each sensor has seen.
    pub fn seen(self) -> Vec<Stream> {
        let each = self.streams.into_iter().zip(self.is_kept.iter().zip(&self.counts));
        each.map(|(stream, (is_kept, is_count))| if *is_kept && *is_count { stream.counted() } else { stream })
            .collect()
    }

    /// Runs on, to the first step that ends at `time` or later, or to its end; whether it has come there.
    pub fn until(&mut self, time: f64) -> bool {
        let is_any_kept = self.is_kept.contains(&true);
        while self.now < time {
            while let Some((command, rest)) = self.commands.split_first().filter(|(command, _)| command.at <= self.now)
            {
                self.plant.tell(self.now, command);
                self.commands = rest;
            }
            let due = self.samples.split_first().filter(|(sample, _)| **sample <= self.now);
            let is_sample = due.is_some();
            self.samples = due.map_or(self.samples, |(_, rest)| rest);
            if is_sample || is_any_kept {
                self.plant.read(self.now, &mut self.values);
                let each = self.streams.iter_mut().zip(&self.values).zip(self.is_kept.iter().zip(&self.counts));
                for ((stream, value), (is_kept, is_count)) in each {
                    if is_sample || *is_kept {
                        stream.push(self.now, if *is_count && !is_kept { value.floor() } else { *value });
                    }
                }
            }
            if self.now >= self.end {
                return true;
            }
            let next = (self.now + STEP).min(self.end);
            let next = self.commands.first().map_or(next, |command| next.min(command.at));
            let next = self.samples.first().map_or(next, |sample| next.min(*sample));
            self.plant.advance(next, next - self.now);
            self.now = next;
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use crate::chance::Dice;
    use crate::rig::RigParameters;
    use crate::script::{self, Part};

    #[test]
    fn a_run_in_pieces_is_the_run() {
        let (rig, commands) = (RigParameters::nominal(), script::program(Part::Train, &mut Dice::new(1, 1)));
        let samples: Vec<f64> = (0..200).map(|k| 0.0037 + 0.01 * f64::from(k)).collect();
        let mut plant = rig.plant(&[], 1);
        let watched: Vec<bool> = (0..plant.signals.len()).map(|at| at % 2 == 0).collect();
        let whole = plant.run(&commands, &samples, &watched, 2.0);
        let mut plant = rig.plant(&[], 1);
        let mut running = plant.begin(&commands, &samples, &watched, 2.0);
        assert!(!running.until(0.5) && !running.until(1.23456) && running.until(f64::INFINITY));
        assert!(running.seen() == whole);
    }
}
