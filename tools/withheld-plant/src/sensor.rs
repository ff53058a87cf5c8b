//! A switch that looks along a way.

use crate::quirk::Quirks;

/// A switch that rises or falls later on its way than it should.
#[derive(Clone, Debug)]
pub struct Along {
    /// It falls so much later on its way.
    width: f64,
    /// It rises so much later on its way.
    blind: f64,
    raw: bool,
    edge_at: f64,
    on: bool,
}

impl Along {
    /// The switch that reports `signal`.
    pub fn new(quirks: Quirks<'_>, signal: &str, on: bool) -> Along {
        let value = |effect: &str, name: &str| {
            let of_signal = quirks.on(signal);
            of_signal.value(effect, name).unwrap_or(0.0)
        };
        Along { width: value("hysteresis", "width"), blind: value("blind-range", "length"), raw: on, edge_at: 0.0, on }
    }

    /// What it should see, and how far that on which it looks has travelled.
    pub fn see(&mut self, raw: bool, travel: f64) {
        self.see_past(raw, travel, travel);
    }

    /// The same of one that changes where that on which it looks has travelled `edge`: exactly there, not where the step ends in which it does so.
    pub fn see_past(&mut self, raw: bool, travel: f64, edge: f64) {
        if raw != self.raw {
            self.raw = raw;
            self.edge_at = edge;
        }
        let late = if raw { self.blind } else { self.width };
        if (travel - self.edge_at).abs() >= late {
            self.on = raw;
        }
    }

    /// What it reports.
    pub fn is_on(&self) -> bool {
        self.on
    }
}
