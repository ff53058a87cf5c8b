//! What drives a belt: an inverter's ramp, and the drum that the belt may slip on.

use crate::drive::{Drive, supplied};
use crate::quirk::Quirks;
use crate::train::Train;

/// The drive of one belt, from its commands to the belt's own way.
#[derive(Clone, Debug)]
pub struct BeltDrive {
    drive: Drive,
    train: Train,
    shaft: f64,
    target: f64,
    direction: f64,
    /// By how much of its speed each box slows it, and what each other device on the supply leaves of it.
    slower: f64,
    supply: f64,
}

impl BeltDrive {
    /// At rest, on ramps of `acceleration`, m/s².
    pub fn new(acceleration: f64, quirks: Quirks<'_>) -> BeltDrive {
        BeltDrive {
            drive: Drive::new(acceleration, quirks),
            train: Train::new(quirks),
            shaft: 0.0,
            target: 0.0,
            direction: 0.0,
            slower: quirks.value("load-dependent-speed", "coefficient").unwrap_or(0.0),
            supply: 1.0 - quirks.value("supply-drop", "fraction").unwrap_or(0.0),
        }
    }

    /// A command arrives at its port.
    pub fn command(&mut self, now: f64, port: &str, value: f64) {
        match port {
            "velocityTarget" => self.target = value,
            "motorDirection" => self.direction = value,
            _ => {}
        }
        self.drive.command(now, self.direction != 0.0, self.direction * self.target);
    }

    /// Moves on by `span` until `now` under so many boxes; the belt's way, m.
    pub fn advance(&mut self, now: f64, span: f64, boxes: usize, others: usize) -> f64 {
        let share = (1.0 - self.slower * boxes as f64).max(0.0) * supplied(self.supply, others);
        self.shaft += self.drive.advance(now, span, share);
        self.train.advance(span, self.shaft, self.drive.speed())
    }

    /// Whether it goes slower under boxes.
    pub fn minds_load(&self) -> bool {
        self.slower != 0.0
    }

    /// How fast the belt goes, m/s.
    pub fn belt_speed(&self) -> f64 {
        self.train.load_speed()
    }

    /// Appends what it reports: speed, enabled, running and direction.
    pub fn read(&self, values: &mut Vec<f64>) {
        let speed = self.drive.speed();
        let sign = if self.moves() { speed.signum() } else { 0.0 };
        values.extend([speed, f64::from(self.direction != 0.0), f64::from(self.moves()), sign]);
    }

    /// Whether it draws from a supply.
    pub fn moves(&self) -> bool {
        self.drive.speed().abs() > 1e-3
    }
}
