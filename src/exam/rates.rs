//! What an exam says as a whole.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::answer::{Magnitude, Sort};
use super::judge::Judged;
use crate::gap::statistics::wilson;

/// A share of cases, or a mean over them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// `None` where there was no case to count.
    pub value: Option<f64>,
    /// Over so many cases.
    pub n: usize,
    /// Of a share, Wilson's interval.
    pub ci95: Option<[f64; 2]>,
}

impl Rate {
    /// The share of those that are so.
    pub fn share(is_so: impl IntoIterator<Item = bool>) -> Rate {
        let (mut yes, mut n) = (0, 0);
        for one in is_so {
            yes += usize::from(one);
            n += 1;
        }
        if n == 0 {
            return Rate::default();
        }
        Rate { value: Some(yes as f64 / n as f64), n, ci95: Some(wilson(yes as f64, n as f64)) }
    }
}

/// The rates that have targets, at magnitudes clear and gross.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rates {
    pub device_right: Rate,
    pub single_right: Rate,
    pub false_alarm: Rate,
    pub outside_right: Rate,
    pub outside_sure_wrong: Rate,
    pub both_of_two: Rate,
    /// The mean of what the diagnosis shrank over what the oracle did.
    pub shrink_of_oracle: Rate,
    pub interval_cover: Rate,
    /// The debiased calibration error of the weights.
    pub ece: Rate,
    /// Beside the targets: the truth among causes, classes and rivals; sure and wrong at faint.
    pub truth_named: Rate,
    /// `single_right` without asking for just the class: the truth alone, or in whatever class was named.
    #[serde(default)]
    pub truth_in_class: Rate,
    pub faint_sure_wrong: Rate,
}

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

/// A whole exam: `exam.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exam {
    pub schema: String,
    pub seed: u64,
    /// When its answers were opened, by the calendar: 2026-01-31.
    pub date: String,
    /// How many cases it has.
    pub cases: usize,
    pub rates: Rates,
    /// `single_right` by magnitude, and at magnitudes that count by kind of device.
    pub by_magnitude: BTreeMap<String, Rate>,
    pub by_device: BTreeMap<String, Rate>,
    /// What was answered, by what was true; each with how often.
    pub confusion: BTreeMap<String, BTreeMap<String, usize>>,
    /// The median number of members of the classes that were named where one effect was the truth.
    pub median_class: Option<usize>,
    /// Of single effects that count: the sizes of the classes that these recordings cannot part by anyone, and of those that were named
    /// for them.
    #[serde(default)]
    pub true_classes: Spread,
    #[serde(default)]
    pub named_classes: Spread,
    pub seconds_per_case: Option<f64>,
    pub judged: Vec<Judged>,
    /// Cases without a verdict, and why.
    pub failed: BTreeMap<String, String>,
}

impl Exam {
    /// Of all that was judged. What `failed` is among it as a case without an answer, which is wrong; here stands why.
    pub fn new(seed: u64, date: String, judged: Vec<Judged>, failed: BTreeMap<String, String>) -> Exam {
        let of = |sort: Sort| judged.iter().filter(move |one| one.sort == sort);
        let counts = |one: &&Judged| one.magnitude.counts();
        let rates = Rates {
            device_right: Rate::share(judged.iter().filter(counts).filter_map(|one| one.device_right)),
            single_right: Rate::share(judged.iter().filter(counts).filter_map(|one| one.single_right)),
            false_alarm: Rate::share(of(Sort::None).map(|one| one.verdict != "no-gap")),
            outside_right: Rate::share(of(Sort::Outside).filter(counts).map(Judged::is_unknown)),
            outside_sure_wrong: Rate::share(of(Sort::Outside).filter(counts).map(|one| one.verdict == "effect")),
            both_of_two: Rate::share(judged.iter().filter(counts).filter_map(|one| one.both_right)),
            shrink_of_oracle: mean(judged.iter().filter(counts).filter_map(of_oracle)),
            interval_cover: Rate::share(judged.iter().filter(counts).flat_map(|one| {
                let [inside, all] = one.covered;
                (0..all).map(move |k| k < inside)
            })),
            ece: calibration(judged.iter().filter(counts).filter_map(|one| Some((one.weight?, one.truth_in_class?)))),
            truth_in_class: Rate::share(judged.iter().filter(counts).filter_map(|one| one.truth_in_class)),
            truth_named: Rate::share(judged.iter().filter(counts).filter_map(|one| one.truth_named)),
            faint_sure_wrong: Rate::share(
                of(Sort::Single).filter(|one| one.magnitude == Magnitude::Faint).map(Judged::is_wrong),
            ),
        };
        let mut sizes: Vec<usize> =
            judged.iter().filter(|one| one.truth_in_class == Some(true)).map(|j| j.class_size).collect();
        sizes.sort_unstable();
        let seconds = judged.iter().map(|one| one.seconds).sum::<f64>() / judged.len().max(1) as f64;
        Exam {
            schema: "kinetwin-exam/1".to_owned(),
            seed,
            date,
            cases: judged.len() + failed.keys().filter(|case| judged.iter().all(|one| one.case != **case)).count(),
            rates,
            by_magnitude: grouped(&judged, |one| Some(one.magnitude.name().to_owned())),
            by_device: grouped(&judged, |one| {
                let device = one.truth.first().filter(|_| one.magnitude.counts())?.split(['.', ':']).next();
                one.kind.clone().or(device.map(str::to_owned))
            }),
            confusion: confusion(&judged),
            true_classes: Spread::of(judged.iter().filter(counts).filter_map(|one| one.true_class_size)),
            named_classes: Spread::of(
                judged
                    .iter()
                    .filter(counts)
                    .filter(|one| one.true_class_size.is_some() && one.class_size > 0)
                    .map(|one| one.class_size),
            ),
            median_class: sizes.get(sizes.len() / 2).copied(),
            seconds_per_case: (!judged.is_empty()).then_some(seconds),
            judged,
            failed,
        }
    }
}

fn of_oracle(judged: &Judged) -> Option<f64> {
    let oracle = judged.oracle_shrink.filter(|shrink| *shrink > 0.0)?;
    Some((judged.shrink.unwrap_or(0.0) / oracle).clamp(0.0, 1.0))
}

fn mean(values: impl Iterator<Item = f64>) -> Rate {
    let values: Vec<f64> = values.collect();
    let n = values.len();
    if n == 0 {
        return Rate::default();
    }
    let mean = values.iter().sum::<f64>() / n as f64;
    let spread = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n.max(2) - 1) as f64;
    let half = 1.96 * (spread / n as f64).sqrt();
    Rate { value: Some(mean), n, ci95: Some([mean - half, mean + half]) }
}

/// The calibration error of weights: the root of the mean squared distance between weight and share of right answers in
/// ten bins of equal width, less what chance adds to it (A. Kumar, P. Liang, T. Ma, Verified Uncertainty Calibration, NeurIPS
/// 2019, section 5).
fn calibration(answers: impl Iterator<Item = (f64, bool)>) -> Rate {
    let mut bins = vec![(0.0, 0.0, 0.0); 10];
    for (weight, is_right) in answers {
        let bin = &mut bins[((weight * 10.0) as usize).min(9)];
        *bin = (bin.0 + 1.0, bin.1 + weight, bin.2 + f64::from(is_right));
    }
    let n: f64 = bins.iter().map(|bin| bin.0).sum();
    if n == 0.0 {
        return Rate::default();
    }
    let squared = |&(count, weights, right): &(f64, f64, f64)| {
        if count < 2.0 {
            return 0.0;
        }
        let (weight, share) = (weights / count, right / count);
        count / n * ((weight - share).powi(2) - share * (1.0 - share) / (count - 1.0))
    };
    let error = bins.iter().map(squared).sum::<f64>().max(0.0).sqrt();
    Rate { value: Some(error), n: n as usize, ci95: None }
}

fn grouped(judged: &[Judged], group: impl Fn(&Judged) -> Option<String>) -> BTreeMap<String, Rate> {
    let mut groups: BTreeMap<String, Vec<bool>> = BTreeMap::new();
    for one in judged {
        if let (Some(name), Some(is_right)) = (group(one), one.single_right) {
            groups.entry(name).or_default().push(is_right);
        }
    }
    groups.into_iter().map(|(name, all)| (name, Rate::share(all))).collect()
}

fn confusion(judged: &[Judged]) -> BTreeMap<String, BTreeMap<String, usize>> {
    let effects = |words: &[String]| {
        let effects: Vec<&str> = words.iter().map(|one| one.rsplit(": ").next().unwrap_or(one)).collect();
        effects.join(" + ")
    };
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
