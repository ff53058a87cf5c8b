//! Which effect causes the gap, and what else could.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::plant::EffectPlace;

/// An effect that is added to the model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cause {
    pub device: String,
    /// The axis, signal, or (of a `parameter-error`) parameter that it acts on; `None` where the device has but one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    /// The effect's id.
    pub effect: String,
    pub place: EffectPlace,
    /// Of the set of effects it belongs to, from 0 to 1: it stands on each member of the set.
    pub weight: f64,
    /// All effects that these data cannot tell from this one, itself first.
    pub class: Vec<Member>,
    pub parameters: Vec<FittedParameter>,
    /// Beyond the contract: properties that are no numbers, such as the signal that another changed places with.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub texts: BTreeMap<String, String>,
}

/// An effect of an equivalence class.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Member {
    pub device: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    pub effect: String,
    pub place: EffectPlace,
}

/// A parameter of an effect, with its interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FittedParameter {
    /// As in the effect's table.
    pub name: String,
    /// In `unit`, which is SI.
    pub value: f64,
    pub unit: String,
    /// The interval that holds it with 95 %, by profile likelihood; where it runs into a bound of the parameter's range,
    /// that bound.
    pub ci95: [f64; 2],
    /// Beyond the contract: the interval runs into a bound, so that the data do not fix the value.
    #[serde(default, skip_serializing_if = "super::is_false")]
    pub not_identifiable: bool,
}

/// A nominal parameter of a device with a cause: what it is within its tolerance, as it was fitted beside the cause.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FittedNominal {
    pub device: String,
    /// As a `parameter-error`'s component names it.
    pub parameter: String,
    /// As the model has it, in `unit`, which is SI.
    pub nominal: f64,
    pub value: f64,
    pub unit: String,
}

/// Something else that could cause the gap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rival {
    pub device: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    pub effect: String,
    pub place: EffectPlace,
    /// Of the set of effects it belongs to, from 0 to 1.
    pub weight: f64,
    /// What would part it from the cause: `a step of at least 0.4 m/s with the belt empty`.
    pub told_apart_by: String,
    /// Beyond the contract: its set, where several effects rival the cause together; sets count from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub set: Option<u32>,
    /// Beyond the contract: fitted in the cause's place, so that an experiment can be planned with it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<FittedParameter>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub texts: BTreeMap<String, String>,
}

impl Cause {
    /// Itself, as a member of its class.
    pub fn member(&self) -> Member {
        Member {
            device: self.device.clone(),
            component: self.component.clone(),
            effect: self.effect.clone(),
            place: self.place,
        }
    }
}
