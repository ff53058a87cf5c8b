//! Where the gap is: the whole, each device's share, and each signal's part.

use serde::{Deserialize, Serialize};

/// The gap of the whole plant, a normalised RMS: 1 where a signal is at its noise floor. `None` where nothing could be
/// measured, in a verdict `not-testable` alone.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// Of the model as it is.
    pub before: Option<f64>,
    /// Of the model with the causes added; the same as `before` where nothing is.
    pub after: Option<f64>,
    /// Of a perfect model.
    pub floor: Option<f64>,
    pub unit: NormalisedRms,
}

/// The unit of a gap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum NormalisedRms {
    #[default]
    #[serde(rename = "normalised RMS")]
    NormalisedRms,
}

/// A device with a gap of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceGap {
    /// The instance's name.
    pub device: String,
    /// Its part of the whole plant's own gaps, from 0 to 1; the shares of all devices sum to 1 at most.
    pub share: f64,
    pub signals: Vec<SignalGap>,
    /// The regimes of its motion that hold most of it, the largest first.
    pub regimes: Vec<Regime>,
}

/// The part of a device's gap that falls into a regime.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Regime {
    /// `starting`, `cruising`, `stopping`, `reversing`, `holding`, `loaded`, `empty`, a span of positions or of times.
    pub when: String,
    /// From 0 to 1, of the device's gap.
    pub share: f64,
}

/// How far a signal of the model is from the machine's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SignalGap {
    /// The signal's whole name: `Conveyor7.velocityActual`.
    pub name: String,
    pub kind: SignalKind,
    /// RMS error in `unit`; `None` for an edge of which no two could be paired.
    pub before: Option<f64>,
    pub after: Option<f64>,
    pub floor: Option<f64>,
    /// The signal's own unit for a level, `s` for an edge.
    pub unit: String,
    /// Beyond the contract, and for edges alone: those that the model did not make, and those that it alone made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub missing: Option<EdgeCounts>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extra: Option<EdgeCounts>,
    /// Beyond the contract, and for levels of a device that is taken up again and again where its machine was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub in_windows: Option<InWindows>,
}

/// How far a level is off where its device is taken up again after every so many seconds, RMS in the signal's unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InWindows {
    pub every_s: f64,
    pub before: f64,
    pub after: f64,
}

/// How a signal is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SignalKind {
    /// By its value over time.
    Level,
    /// By the times of its changes.
    Edge,
}

/// Edges counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct EdgeCounts {
    pub before: u64,
    pub after: u64,
}
