//! What a diagnosis answers: `report.json`, of which [`Report`] is the shape and `docs/gap-report.schema.json` the schema.
//!
//! The contract is `kinetwin-gap/1`. What is optional in these types goes beyond it and is left out of the JSON where it says
//! nothing; a reader of the contract alone may skip it. Every `before`, `after` and `floor` is on the held-out data: for a
//! level its RMS error in the signal's own unit, for an edge the RMS of its time error in seconds, and for the whole gap
//! (see [`Gap`]) the normalised RMS, in which a signal at its noise floor counts 1.

mod answer;
mod cause;
mod flaws;
pub mod number;
mod read;
mod shrink;
mod verdict;
mod whereabouts;

use serde::{Deserialize, Serialize};

pub use answer::{Answer, on, words};
pub use cause::{Cause, FittedNominal, FittedParameter, Member, Rival};
pub use read::ReportError;
pub use shrink::{Beside, Consequence, DeviceConsequence, Remainder, Shrink};
pub use verdict::Verdict;
pub use whereabouts::{DeviceGap, EdgeCounts, Gap, InWindows, NormalisedRms, Regime, SignalGap, SignalKind};

/// The name and version of the contract.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Schema {
    #[default]
    #[serde(rename = "kinetwin-gap/1")]
    One,
}

/// The answer of one diagnosis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    pub schema: Schema,
    pub verdict: Verdict,
    pub gap: Gap,
    /// Every device that has a gap of its own, the largest share first.
    #[serde(rename = "where")]
    pub devices: Vec<DeviceGap>,
    /// One entry for each effect added, on whichever device; empty where nothing is.
    pub cause: Vec<Cause>,
    /// What else it could be, the heaviest first.
    pub rivals: Vec<Rival>,
    /// What is left that nothing in the library explains, and what it depends on.
    pub remainder: Option<Remainder>,
    /// What it means for production; `None` where no automation can run, or no whole cycle was recorded.
    pub consequence: Option<Consequence>,
    pub shrink: Shrink,

    /// Beyond the contract: the weight of "nothing in the library". It and the weights of all disjoint sets sum to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outside: Option<f64>,
    /// Beyond the contract: the search was ended before its end, and this is the best of what was tried.
    #[serde(default, skip_serializing_if = "is_false")]
    pub incomplete: bool,
    /// Beyond the contract: what it was made from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub made_from: Option<MadeFrom>,
    /// Beyond the contract: signals on which model and trace do not agree.
    #[serde(default, skip_serializing_if = "SignalNames::is_empty")]
    pub signals: SignalNames,
    /// Beyond the contract: nominal parameters that were fitted within their tolerances, with the causes in place.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fitted: Vec<FittedNominal>,
    /// Beyond the contract: what these traces do not excite.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub not_testable: Vec<NotTestable>,
    /// Beyond the contract: how far clocks beside that of the commands were off, in the training.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub clocks: Vec<FoundClock>,
    /// Beyond the contract: what else of the traces was left out, a sentence each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
}

impl Report {
    /// A report that has looked at nothing yet: nothing was measured, nothing is added. What a diagnosis fills in.
    pub fn new(verdict: Verdict) -> Report {
        Report {
            schema: Schema::One,
            verdict,
            gap: Gap::default(),
            devices: Vec::new(),
            cause: Vec::new(),
            rivals: Vec::new(),
            remainder: None,
            consequence: None,
            shrink: Shrink::default(),
            outside: None,
            incomplete: false,
            made_from: None,
            signals: SignalNames::default(),
            fitted: Vec::new(),
            not_testable: Vec::new(),
            clocks: Vec::new(),
            left_out: Vec::new(),
        }
    }
}

/// The inputs of a diagnosis, as their paths were given.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MadeFrom {
    pub model: String,
    pub train: Vec<String>,
    /// Empty where blocks of time of the training were kept back instead.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holdout: Vec<String>,
    /// Spans in which the machine was not driven by its automation alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask: Option<String>,
}

/// A clock beside that of the commands: what it called t was at t + offset + drift·t.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundClock {
    /// The trace, as it was given.
    pub trace: String,
    pub name: String,
    /// s.
    pub offset_s: f64,
    /// Seconds for each second.
    pub drift: f64,
}

/// Signals on which model and trace do not agree.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SignalNames {
    /// The model has them and the trace does not: diagnosed without them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missing: Vec<String>,
    /// The trace has them and the model does not: left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignored: Vec<String>,
}

impl SignalNames {
    fn is_empty(&self) -> bool {
        self.missing.is_empty() && self.ignored.is_empty()
    }
}

/// Something that these traces cannot show.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct NotTestable {
    /// The device; `None` where it holds for the whole trace.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The component of the device, where it holds for one only: `Y`, `lightBarrierB`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    /// The effect's id; `None` where it holds for all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effect: Option<String>,
    /// Why it cannot be told: `the chirp runs at up to 3.5 rad/s, the training at up to 0.44 rad/s`.
    pub reason: String,
    /// What a trace would have to hold: `a training motion above 0.44 rad/s`.
    pub needs: String,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn is_false(value: &bool) -> bool {
    !value
}
