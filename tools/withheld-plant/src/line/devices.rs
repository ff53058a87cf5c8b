//! The line's belts and pushers, which share what lies on the belts.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::BELTS;
use super::floor::Floor;
use crate::belt::BeltParameters;
use crate::belt_drive::BeltDrive;
use crate::plant::{Device, Entry};
use crate::pusher::Pusher;
use crate::quirk::Quirks;

/// What lies on the belts, for all devices.
pub type Shared = Arc<Mutex<Floor>>;

fn floor(shared: &Shared) -> MutexGuard<'_, Floor> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A belt of the line.
#[derive(Debug)]
pub struct LineBelt {
    at: usize,
    drive: BeltDrive,
    shared: Shared,
}

impl LineBelt {
    /// The belt at this place of the floor, at rest.
    pub fn new(parameters: &BeltParameters, quirks: Quirks<'_>, at: usize, shared: Shared) -> LineBelt {
        let drive = BeltDrive::new(quirks.parameter("acceleration", parameters.acceleration), quirks);
        LineBelt { at, drive, shared }
    }
}

impl Device for LineBelt {
    fn command(&mut self, now: f64, port: &str, value: f64) {
        self.drive.command(now, port, value);
    }

    fn advance(&mut self, now: f64, span: f64, others: usize) {
        let mut floor = floor(&self.shared);
        let boxes = if self.drive.minds_load() { floor.load(self.at) } else { 0 };
        let way = self.drive.advance(now, span, boxes, others);
        let bed = &mut floor.beds[self.at];
        bed.way = way;
        bed.travel += way;
    }

    fn read(&self, _now: f64, values: &mut Vec<f64>) {
        self.drive.read(values);
        let floor = floor(&self.shared);
        values.extend([0, 1].map(|barrier| f64::from(floor.is_cut(self.at, barrier))));
    }

    fn moving(&self) -> usize {
        usize::from(self.drive.moves())
    }
}

/// A pusher of the line: one that meets boxes, and has two beams.
#[derive(Debug)]
pub struct LinePusher {
    at: usize,
    pusher: Pusher,
    shared: Shared,
}

impl LinePusher {
    /// The pusher of the plate at this place of the floor.
    pub fn new(pusher: Pusher, at: usize, shared: Shared) -> LinePusher {
        LinePusher { at, pusher, shared }
    }
}

impl Device for LinePusher {
    fn command(&mut self, now: f64, port: &str, value: f64) {
        self.pusher.command(now, port, value);
    }

    fn advance(&mut self, now: f64, span: f64, others: usize) {
        let before = self.pusher.out();
        self.pusher.advance(now, span, others);
        if self.pusher.out() != before {
            floor(&self.shared).plates[self.at].out = self.pusher.out();
        }
    }

    fn read(&self, now: f64, values: &mut Vec<f64>) {
        self.pusher.read(now, values);
        let own = values.len() - 2;
        for (value, cut) in values[own..].iter_mut().zip(floor(&self.shared).plates[self.at].cut) {
            *value = f64::from(cut);
        }
    }

    fn moving(&self) -> usize {
        self.pusher.moving()
    }
}

/// What moves the parts when all belts and plates have moved: the last of the line's devices.
#[derive(Debug)]
pub struct Parts(pub Shared);

impl Device for Parts {
    fn command(&mut self, _now: f64, _port: &str, _value: f64) {}

    fn advance(&mut self, now: f64, span: f64, _others: usize) {
        floor(&self.0).advance(now, span);
    }

    fn read(&self, _now: f64, _values: &mut Vec<f64>) {}

    fn moving(&self) -> usize {
        0
    }

    fn handed_on(&self) -> Vec<Entry> {
        floor(&self.0).handed_on().to_vec()
    }

    fn confine(&mut self, kept: &[String], entries: &[Entry]) {
        let is_kept = BELTS.map(|(name, ..)| kept.iter().any(|kept| kept == name));
        floor(&self.0).confine(is_kept.to_vec(), entries);
    }
}
