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
    /// How many drives of each device moved, from when on: as it has run so far.
    pub moved: Vec<(f64, Vec<usize>)>,
}

impl Plant {
    /// One that has not run yet, and has no company.
    pub fn new(
        devices: Vec<(String, Box<dyn Device>)>,
        commands: Vec<(String, Kind)>,
        signals: Vec<Signal>,
        quirks: &[Quirk],
    ) -> Plant {
        Plant { devices, commands, signals, quirks: quirks.to_vec(), company: Vec::new(), come: 0, moved: Vec::new() }
    }

    /// How many drives besides those of `device` moved, from when on, as it has run so far.
    pub fn company_of(&self, device: &str) -> Vec<(f64, usize)> {
        let own = self.devices.iter().position(|(name, _)| name == device).unwrap_or_default();
        self.moved.iter().map(|(from, moved)| (*from, moved.iter().sum::<usize>() - moved[own])).collect()
    }

    /// With only one of its devices, which no other touches, in this company.
    pub fn keep(&mut self, device: &str, company: Vec<(f64, usize)>) {
        self.devices.retain(|(name, _)| name == device);
        self.signals.retain(|signal| signal.parts().0 == device);
        (self.company, self.come) = (company, 0);
    }

    /// With counters that tell parts of a count.
    pub fn telling_parts(mut self) -> Plant {
        self.devices.iter_mut().for_each(|(_, device)| device.tell_parts());
        self
    }

    /// Runs under `commands`, sorted by their instants, until `end`; gives what each sensor sees: of edges and of
    /// whatever is `watched` at every step, of everything else at the sorted `samples` only.
    pub fn run(&mut self, commands: &[Command], samples: &[f64], watched: &[bool], end: f64) -> Vec<Stream> {
        let mut streams: Vec<Stream> = self.signals.iter().map(|signal| Stream::new(signal.kind.is_edge())).collect();
        let is_kept: Vec<bool> =
            self.signals.iter().zip(watched).map(|(signal, watched)| *watched || signal.kind.is_edge()).collect();
        let is_any_kept = is_kept.contains(&true);
        let (mut now, mut values) = (0.0, Vec::new());
        let (mut commands, mut samples) = (commands.iter().peekable(), samples.iter().peekable());
        loop {
            while let Some(command) = commands.next_if(|command| command.at <= now) {
                self.tell(now, command);
            }
            let is_sample = samples.next_if(|sample| **sample <= now).is_some();
            if is_sample || is_any_kept {
                self.read(now, &mut values);
                for ((stream, value), is_kept) in streams.iter_mut().zip(&values).zip(&is_kept) {
                    if is_sample || *is_kept {
                        stream.push(now, *value);
                    }
                }
            }
            if now >= end {
                return streams;
            }
            let next = (now + STEP).min(end);
            let next = commands.peek().map_or(next, |command| next.min(command.at));
            let next = samples.peek().map_or(next, |sample| next.min(**sample));
            self.advance(next, next - now);
            now = next;
        }
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
        let moving = || self.devices.iter().map(|(_, device)| device.moving());
        if self.moved.last().is_none_or(|(_, last)| !moving().eq(last.iter().copied())) {
            self.moved.push((now - span, moving().collect()));
        }
        let own: usize = moving().sum();
        while self.company.get(self.come).is_some_and(|(from, _)| *from <= now - span + 1e-12) {
            self.come += 1;
        }
        let company = self.come.checked_sub(1).map_or(0, |at| self.company[at].1);
        let moving = own + company;
        for (_, device) in &mut self.devices {
            let others = moving - device.moving();
            device.advance(now, span, others);
        }
    }
}
