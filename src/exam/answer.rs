//! The truth about cases, as `withheld-plant` seals it.

use serde::{Deserialize, Serialize};

/// Why opened answers are none.
#[derive(Debug, thiserror::Error)]
#[error("the answers cannot be read: {0}: expected what withheld-plant sealed, schema kinetwin-answers/1")]
pub struct AnswersError(#[from] serde_json::Error);

/// What sort of case one is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sort {
    /// One effect of the library.
    Single,
    /// Nothing is wrong.
    None,
    TwoOnOneDevice,
    OneOnEachOfTwo,
    /// An effect that no file of the library describes.
    Outside,
}

/// How much of it the recording shows: the distance of the machine with and without the effect, in units of the noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Magnitude {
    None,
    BelowNoise,
    Faint,
    Clear,
    Gross,
}

impl Magnitude {
    /// Whether the targets count it.
    pub fn counts(self) -> bool {
        matches!(self, Magnitude::Clear | Magnitude::Gross)
    }

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Magnitude::None => "none",
            Magnitude::BelowNoise => "below-noise",
            Magnitude::Faint => "faint",
            Magnitude::Clear => "clear",
            Magnitude::Gross => "gross",
        }
    }
}

/// One effect that the machine had.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrueEffect {
    pub device: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    /// The library's id; of what it lacks, a name that begins with `x-`.
    pub effect: String,
    pub place: String,
    /// In SI units, by the library's names.
    pub parameters: Vec<(String, f64)>,
}

/// One of the effects that the case's recording cannot tell apart.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClassMember {
    pub device: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    pub effect: String,
    pub place: String,
}

impl TrueEffect {
    /// Its names.
    pub fn member(&self) -> ClassMember {
        let TrueEffect { device, component, effect, place, .. } = self.clone();
        ClassMember { device, component, effect, place }
    }
}

/// The truth about one case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    pub case: String,
    pub sort: Sort,
    pub magnitude: Magnitude,
    pub effects: Vec<TrueEffect>,
    /// All effects that nobody can tell from the one effect in this recording, itself included. Empty where it was not computed:
    /// of faint cases, on the line, and in answers that were sealed before there were classes.
    #[serde(default)]
    pub class: Vec<ClassMember>,
    /// Of several effects, in their order: the same of each, beside the others.
    #[serde(default)]
    pub classes: Vec<Vec<ClassMember>>,
    /// What kind of device the first effect is on, by the names of the rig: plants give their devices names of their own.
    #[serde(default)]
    pub kind: Option<String>,
    /// The model that it is diagnosed by: a folder's or a file's path.
    #[serde(default)]
    pub model: Option<String>,
}

impl Answer {
    /// Whether there is one effect of the library to be told to an oracle, of a magnitude that counts.
    pub fn has_an_oracle(&self) -> bool {
        self.sort == Sort::Single && self.magnitude.counts() && self.effects.len() == 1
    }
}

/// All of them, with the exam's seed.
#[derive(Deserialize)]
struct Answers {
    seed: u64,
    cases: Vec<Answer>,
}

/// Reads opened answers: the exam's seed and each case's truth.
pub fn read_answers(text: &[u8]) -> Result<(u64, Vec<Answer>), AnswersError> {
    let Answers { seed, cases } = serde_json::from_slice(text)?;
    Ok((seed, cases))
}
