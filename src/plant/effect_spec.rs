//! What a plant's file says about effects. What an effect does is not this row's business.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::ParameterValue;

/// Where along a device's signal path an effect acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EffectPlace {
    CommandLink,
    Actuator,
    Mechanics,
    Transmission,
    Load,
    Sensor,
    ReportLink,
    /// The parts themselves.
    Process,
}

impl EffectPlace {
    /// All of them, in the order of the signal path.
    pub const ALL: [EffectPlace; 8] = [
        EffectPlace::CommandLink,
        EffectPlace::Actuator,
        EffectPlace::Mechanics,
        EffectPlace::Transmission,
        EffectPlace::Load,
        EffectPlace::Sensor,
        EffectPlace::ReportLink,
        EffectPlace::Process,
    ];

    /// As written in files and reports.
    pub const fn name(self) -> &'static str {
        match self {
            EffectPlace::CommandLink => "command-link",
            EffectPlace::Actuator => "actuator",
            EffectPlace::Mechanics => "mechanics",
            EffectPlace::Transmission => "transmission",
            EffectPlace::Load => "load",
            EffectPlace::Sensor => "sensor",
            EffectPlace::ReportLink => "report-link",
            EffectPlace::Process => "process",
        }
    }
}

/// An `<effect>` of an instance: something that a real device adds to its nominal law.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectSpec {
    pub place: EffectPlace,
    /// The effect's id: `belt-slip`.
    pub kind: String,
    /// The axis, signal or other component of the device that it acts on, where it acts on one only.
    pub component: Option<String>,
    /// Numbers in SI units, and texts.
    pub parameters: BTreeMap<String, ParameterValue>,
}
