//! An exam as a whole: its rates, and the same by magnitude, by device and by effect.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::answer::Sort;
use super::calibration::{self, Bin};
use super::judge::Judged;
use super::rates::{Rate, Rates};
use super::sittings::Sitting;

/// How large several things are.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spread {
    pub n: usize,
    /// The lower one of two.
    pub median: Option<usize>,
    /// How many there are of each size.
    pub counts: BTreeMap<usize, usize>,
}

impl Spread {
    /// Of these.
    pub fn of(sizes: impl IntoIterator<Item = usize>) -> Spread {
        let mut sizes: Vec<usize> = sizes.into_iter().collect();
        sizes.sort_unstable();
        let mut counts = BTreeMap::new();
        sizes.iter().for_each(|size| *counts.entry(*size).or_default() += 1);
        Spread { n: sizes.len(), median: sizes.get(sizes.len().saturating_sub(1) / 2).copied(), counts }
    }
}

/// Groups of cases by their name, and of each the rates that it has a case for, by their names.
pub type Groups = BTreeMap<String, BTreeMap<String, Rate>>;

/// The format of `exam.json`.
pub const SCHEMA: &str = "kinetwin-exam/2";

/// A whole exam: `exam.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exam {
    pub schema: String,
    /// Of several sittings that of the last one, as its date is.
    pub seed: u64,
    /// When its answers were opened, by the calendar: 2026-01-31.
    pub date: String,
    /// The sittings that it was taken in, where they were several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sittings: Vec<Sitting>,
    /// How many cases it has.
    pub cases: usize,
    pub rates: Rates,
    /// The calibration curve of the weights, at magnitudes clear and gross.
    pub calibration: Vec<Bin>,
    /// The rates at each magnitude.
    pub by_magnitude: Groups,
    /// At magnitudes clear and gross those by the kind of the device that something is wrong with, of the first of two.
    pub by_device: Groups,
    /// The same by the effect, where it is one, in the library or outside of it.
    pub by_effect: Groups,
    /// The same by the plant, and how long a case of it took on average, s.
    pub by_plant: Groups,
    pub seconds: BTreeMap<String, Rate>,
    /// What was answered, by what was true; each with how often.
    pub confusion: BTreeMap<String, BTreeMap<String, usize>>,
    /// The median number of members of the classes that were named where one effect was the truth.
    pub median_class: Option<usize>,
    /// Of single effects that count: the sizes of the classes that these recordings cannot part by anyone, and of those that were named
    /// for them.
    pub true_classes: Spread,
    pub named_classes: Spread,
    pub seconds_per_case: Option<f64>,
    pub judged: Vec<Judged>,
    /// Cases without a verdict, and why.
    pub failed: BTreeMap<String, String>,
}

impl Exam {
    /// Of all that was judged. What `failed` is among it as a case without an answer, which is wrong; here stands why.
    pub fn new(seed: u64, date: String, judged: Vec<Judged>, failed: BTreeMap<String, String>) -> Exam {
        let all: Vec<&Judged> = judged.iter().collect();
        let counted: Vec<&Judged> = judged.iter().filter(|one| one.magnitude.counts()).collect();
        let mut sizes: Vec<usize> =
            judged.iter().filter(|one| one.truth_in_class == Some(true)).map(|j| j.class_size).collect();
        sizes.sort_unstable();
        let named = counted.iter().filter(|one| one.true_class_size.is_some() && one.class_size > 0);
        let seconds = judged.iter().map(|one| one.seconds).sum::<f64>() / judged.len().max(1) as f64;
        Exam {
            schema: SCHEMA.to_owned(),
            seed,
            date,
            sittings: Vec::new(),
            cases: judged.len() + failed.keys().filter(|case| judged.iter().all(|one| one.case != **case)).count(),
            rates: Rates::of(&all, |magnitude| magnitude.counts()),
            calibration: calibration::curve(counted.iter().filter_map(|one| one.weighed())),
            by_magnitude: grouped(&all, |one| Some(one.magnitude.name())),
            by_device: grouped(&counted, |one| {
                let device = one.truth.first()?.split(['.', ':']).next();
                one.kind.as_deref().or(device)
            }),
            by_effect: grouped(&counted, |one| match one.truth.as_slice() {
                [truth] => Some(effect_of(truth)),
                _ => None,
            }),
            by_plant: grouped(&counted, |one| one.model.as_deref().map(plant_of)),
            seconds: seconds_by_plant(&judged),
            confusion: confusion(&judged),
            true_classes: Spread::of(counted.iter().filter_map(|one| one.true_class_size)),
            named_classes: Spread::of(named.map(|one| one.class_size)),
            median_class: sizes.get(sizes.len() / 2).copied(),
            seconds_per_case: (!judged.is_empty()).then_some(seconds),
            judged,
            failed,
        }
    }
}

/// The effect of `Axis: coulomb-friction`.
pub fn effect_of(words: &str) -> &str {
    words.rsplit(": ").next().unwrap_or(words)
}

/// Which plant a model is of: its folder's name, or that it was drawn for its case alone.
fn plant_of(model: &str) -> &str {
    match model.rsplit('/').next() {
        Some(name) if name != "plant.xml" => name,
        _ => "drawn at random",
    }
}

fn seconds_by_plant(judged: &[Judged]) -> BTreeMap<String, Rate> {
    let mut plants: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for one in judged {
        if let Some(model) = &one.model {
            plants.entry(plant_of(model)).or_default().push(one.seconds);
        }
    }
    plants.into_iter().map(|(plant, all)| (plant.to_owned(), Rate::mean(all.into_iter()))).collect()
}

fn grouped<'a>(judged: &[&'a Judged], group: impl Fn(&'a Judged) -> Option<&'a str>) -> Groups {
    let mut groups: BTreeMap<&str, Vec<&Judged>> = BTreeMap::new();
    for one in judged {
        if let Some(name) = group(one) {
            groups.entry(name).or_default().push(one);
        }
    }
    let has_a_case = |rates: Rates| {
        // Of a few weights no error of theirs is known.
        let counted = rates.shown().into_iter().filter(|shown| shown.rate.n > 0 && shown.id != "ece");
        counted.map(|shown| (shown.id.to_owned(), *shown.rate)).collect()
    };
    groups.into_iter().map(|(name, all)| (name.to_owned(), has_a_case(Rates::of(&all, |_| true)))).collect()
}

fn confusion(judged: &[Judged]) -> BTreeMap<String, BTreeMap<String, usize>> {
    let effects = |words: &[String]| words.iter().map(|one| effect_of(one)).collect::<Vec<_>>().join(" + ");
    let mut table: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for one in judged.iter().filter(|one| one.magnitude.counts() || one.sort == Sort::None) {
        let truth = if one.truth.is_empty() { "none".to_owned() } else { effects(&one.truth) };
        let answered = match one.answered.is_empty() {
            true => one.verdict.clone(),
            false => format!("{}: {}", one.verdict, effects(&one.answered)),
        };
        *table.entry(truth).or_default().entry(answered).or_default() += 1;
    }
    table
}
