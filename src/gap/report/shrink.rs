//! How far the gap shrinks, what is left, and what it means for production.

use serde::{Deserialize, Serialize};

/// How far the gap shrinks on traces, or blocks of time, that no fit saw.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shrink {
    /// The gap of the model as it is, normalised RMS; `None` where nothing could be measured.
    pub holdout_before: Option<f64>,
    /// The gap of the model with the causes.
    pub holdout_after: Option<f64>,
    /// After ÷ before of what is above the noise floor; 1 where nothing is added.
    pub ratio: Option<f64>,
    /// Of the ratio, by block bootstrap.
    pub ci95: Option<[f64; 2]>,
    /// What remains above the floor, normalised RMS.
    pub explainable_left: Option<f64>,
}

/// What nothing in the library explains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Remainder {
    /// Of the gap above the floor, from 0 to 1.
    pub share: f64,
    /// `command`, `speed sign`, `position`, `load`, `time`, …: what the residual is still correlated with.
    pub depends_on: Vec<String>,
}

/// What the gap means for production.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Consequence {
    pub parts_per_hour: Beside,
    /// The cycle time in seconds.
    pub cycle_s: Beside,
    /// Beyond the contract: each device's cycle.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub devices: Vec<DeviceConsequence>,
}

/// What was recorded, and what the model makes of it without and with the causes; `None` where there is no such number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Beside {
    pub recorded: Option<f64>,
    pub before: Option<f64>,
    pub after: Option<f64>,
}

/// A device's part in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceConsequence {
    pub device: String,
    pub parts_per_hour: Beside,
    pub cycle_s: Beside,
}
