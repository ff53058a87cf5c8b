//! How much an effect shows: measured, not intended.
//!
//! The machine runs twice under the same commands, with the effect and without, heard in the same way and without noise. The
//! distance is that of the two runs in units of what noise and rounding leave unsure, summed over all reports:
//!
//! ```text
//! D² = Σ (y₁ − y₀)²/(σ²·φ + q²/12),    φ = (1 + r)/(1 − r)
//! ```
//!
//! with the noise's correlation r from one report to the next; of a flag, every report in which it differs counts 12 (a time
//! error of one cycle, in units of the cycle's own scatter). A test of 1 % error finds D = 4.2 in 95 of 100 cases.

use serde::{Deserialize, Serialize};

use crate::plant::{Kind, Signal};
use crate::record::{Seen, Surroundings};

/// How much an effect shows, in words that were fixed before any case was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Magnitude {
    None,
    BelowNoise,
    Faint,
    Clear,
    Gross,
}

impl Magnitude {
    /// The distances that it means.
    pub fn range(self) -> (f64, f64) {
        match self {
            Magnitude::None => (0.0, 0.0),
            Magnitude::BelowNoise => (0.0, 1.0),
            Magnitude::Faint => (5.0, 12.0),
            Magnitude::Clear => (30.0, 150.0),
            Magnitude::Gross => (300.0, f64::INFINITY),
        }
    }

    /// What a distance is called, where it has a name.
    pub fn of(distance: f64) -> Option<Magnitude> {
        let all = [Magnitude::BelowNoise, Magnitude::Faint, Magnitude::Clear, Magnitude::Gross];
        all.into_iter().find(|magnitude| {
            let (low, high) = magnitude.range();
            (low..=high).contains(&distance)
        })
    }
}

/// The distance D of two runs.
pub fn distance(one: &Seen, other: &Seen, signals: &[Signal], around: &Surroundings) -> f64 {
    let r = (-around.cycle / around.noise_time.max(1e-9)).exp();
    let wide = (1.0 + r) / (1.0 - r);
    let mut sum = 0.0;
    for (a, b) in one.values.iter().zip(&other.values) {
        for ((signal, a), b) in signals.iter().zip(a).zip(b) {
            let noise = (around.noise * signal.sigma).powi(2) * wide + signal.quantum.powi(2) / 12.0;
            sum += match signal.kind {
                Kind::Flag | Kind::Code => {
                    if a == b {
                        0.0
                    } else {
                        12.0
                    }
                }
                Kind::Level | Kind::Count => (a - b).powi(2) / noise,
            };
        }
    }
    sum.sqrt()
}
