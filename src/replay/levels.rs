//! A level over time: the largest and the RMS difference.

use crate::signal_map::{RateClass, RegisterId, Signal};
use crate::time::Instant;
use crate::value::Value;

use super::Tolerances;
use super::report::LevelReport;

/// One level signal.
pub(super) struct LevelTrack {
    pub id: RegisterId,
    pub rate: RateClass,
    tolerances: Tolerances,
    /// What was recorded last; `None` before the first report, and while nobody records.
    held: Option<Value>,
    /// Since when the recording has said nothing of a model that lies beyond the tolerance.
    silent_since: Instant,
    compared: u64,
    squares: f64,
    largest: f64,
    largest_at: Instant,
    /// Compared where the recording was silent for too long.
    silent: u64,
}

impl LevelTrack {
    pub fn new(id: RegisterId, rate: RateClass, tolerances: Tolerances) -> LevelTrack {
        LevelTrack {
            id,
            rate,
            tolerances,
            held: None,
            silent_since: Instant::ZERO,
            compared: 0,
            squares: 0.0,
            largest: 0.0,
            largest_at: Instant::ZERO,
            silent: 0,
        }
    }

    /// Nobody records until the next report.
    pub fn blind(&mut self) {
        self.held = None;
    }

    /// A report.
    pub fn recorded(&mut self, value: &Value) {
        self.held = Some(value.clone());
    }

    /// Compares what was recorded last with the model, at a report of this rate class.
    pub fn compare(&mut self, now: Instant, registers: &[Value]) {
        let Some(held) = &self.held else { return };
        let difference = difference(held, &registers[self.id.index()]);
        self.compared += 1;
        self.squares += difference * difference;
        if difference > self.largest {
            self.largest = difference;
            self.largest_at = now;
        }
        self.silent_since = now;
    }

    /// Looks at the model between reports: where it has been away for long and nobody said so, it is compared.
    pub fn silence(&mut self, now: Instant, registers: &[Value]) {
        let Some(held) = &self.held else { return };
        if difference(held, &registers[self.id.index()]) <= self.tolerances.level {
            self.silent_since = now;
        } else if now.since(self.silent_since) > self.tolerances.silence {
            self.compare(now, registers);
            self.silent += 1;
        }
    }

    /// The result; `None` for a signal that was never recorded.
    pub fn finish(&self, signal: &Signal) -> Option<LevelReport> {
        (self.compared > 0).then(|| LevelReport {
            name: signal.name.clone(),
            unit: signal.unit.symbol,
            compared: self.compared,
            largest: self.largest,
            largest_at_s: self.largest_at.seconds(),
            rms: (self.squares / self.compared as f64).sqrt(),
            silent: self.silent,
            differs: self.largest > self.tolerances.level,
        })
    }
}

/// How far two values of one type lie apart: for numbers in the signal's unit, for an array the largest of its elements,
/// for a text 0 or 1.
fn difference(recorded: &Value, model: &Value) -> f64 {
    match (recorded, model) {
        (Value::Array(recorded), Value::Array(model)) => {
            recorded.iter().zip(model).map(|(recorded, model)| difference(recorded, model)).fold(0.0, f64::max)
        }
        // The wire has milliseconds.
        (Value::Time(recorded), Value::Time(model)) => recorded.abs_diff(*model) as f64 / 1e6,
        _ => match (recorded.to_f64(), model.to_f64()) {
            (Some(recorded), Some(model)) => (recorded - model).abs(),
            _ => f64::from(u8::from(recorded != model)),
        },
    }
}
