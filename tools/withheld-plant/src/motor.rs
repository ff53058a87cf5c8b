//! An inverter motor with an encoder.

use std::f64::consts::TAU;

use crate::drive::{Drive, supplied};
use crate::plant::Device;
use crate::quirk::{Quirk, Quirks};
use crate::train::Train;

/// What a motor is built to.
#[derive(Clone, Debug)]
pub struct MotorParameters {
    pub acceleration: f64,
    pub counts: f64,
}

/// A motor.
#[derive(Clone, Debug)]
pub struct Motor {
    counts: f64,
    drive: Drive,
    train: Train,
    shaft: f64,
    target: f64,
    enable: bool,
    supply: f64,
    /// Above a speed the encoder loses counts, so many a second.
    skips: Option<(f64, f64)>,
    skipped: f64,
    /// Whether its encoder tells parts of a count.
    tells_parts: bool,
}

impl Motor {
    /// A motor called `name`, at rest.
    pub fn new(parameters: &MotorParameters, quirks: &[Quirk], name: &str) -> Motor {
        let all = Quirks::of(quirks, name);
        Motor {
            counts: parameters.counts,
            drive: Drive::new(all.parameter("acceleration", parameters.acceleration), all),
            train: Train::new(all),
            shaft: 0.0,
            target: 0.0,
            enable: false,
            supply: 1.0 - all.value("supply-drop", "fraction").unwrap_or(0.0),
            skips: all.get("x-encoder-skips").map(|quirk| (quirk.value("speed"), quirk.value("rate"))),
            skipped: 0.0,
            tells_parts: false,
        }
    }
}

impl Device for Motor {
    fn command(&mut self, now: f64, port: &str, value: f64) {
        match port {
            "speedTarget" => self.target = value,
            "enable" => self.enable = value != 0.0,
            _ => {}
        }
        self.drive.command(now, self.enable, self.target);
    }

    fn advance(&mut self, now: f64, span: f64, others: usize) {
        self.shaft += self.drive.advance(now, span, supplied(self.supply, others));
        let speed = self.drive.speed();
        self.train.advance(span, self.shaft, speed);
        if let Some((above, rate)) = self.skips
            && speed.abs() > above
        {
            self.skipped += rate * span * speed.signum();
        }
    }

    fn read(&self, _now: f64, values: &mut Vec<f64>) {
        // A count that is reached exactly is reached, whatever the last place of a sum says.
        let counts = self.train.load() / TAU * self.counts - self.skipped.trunc() + 1e-7;
        let counts = if self.tells_parts { counts } else { counts.floor() };
        values.extend([counts, self.drive.speed(), f64::from(self.enable)]);
    }

    fn moving(&self) -> usize {
        usize::from(self.drive.speed().abs() > 1e-3)
    }

    fn tell_parts(&mut self) {
        self.tells_parts = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_encoder_tells_parts_of_a_count_where_it_is_asked_to() {
        let mut motor = Motor::new(&MotorParameters { acceleration: 20.0, counts: 4096.0 }, &[], "Motor");
        motor.command(0.0, "enable", 1.0);
        motor.command(0.0, "speedTarget", 1.0);
        (1..=600).for_each(|k| motor.advance(1e-4 * f64::from(k), 1e-4, 0));
        let read = |motor: &Motor| {
            let mut values = Vec::new();
            motor.read(0.06, &mut values);
            values[0]
        };
        let whole = read(&motor);
        motor.tell_parts();
        // 0.05 s up to 1 rad/s, and 0.01 s at it: 0.035 rad, and 22.8 counts.
        assert!(whole == 22.0 && (read(&motor) - 0.035 / TAU * 4096.0).abs() < 1e-3, "{whole} {}", read(&motor));
    }
}
