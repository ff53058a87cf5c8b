//! The rates of an exam, each with the interval that its number of cases leaves.

use serde::{Deserialize, Serialize};

use super::answer::{Magnitude, Sort};
use super::calibration;
use super::judge::Judged;
use super::target::Target;
use crate::gap::statistics::wilson;

/// A share of cases, or a mean over them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// `None` where there was no case to count.
    pub value: Option<f64>,
    /// Over so many cases.
    pub n: usize,
    /// Its 95 % interval: of a share, Wilson's.
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

    /// The share as people write it, `91.3 %`; a dash where there was no case.
    pub fn percent(&self) -> String {
        self.value.map_or("–".to_owned(), |value| format!("{:.1} %", 100.0 * value))
    }

    /// The bounds of its interval likewise: `85.9 to 98.2 %`.
    pub fn within(&self) -> String {
        self.ci95.map_or(String::new(), |[low, high]| format!("{:.1} to {:.1} %", 100.0 * low, 100.0 * high))
    }

    /// The mean of numbers, with the interval of its standard error.
    pub fn mean(values: impl Iterator<Item = f64>) -> Rate {
        let values: Vec<f64> = values.collect();
        let n = values.len();
        if n == 0 {
            return Rate::default();
        }
        let mean = values.iter().sum::<f64>() / n as f64;
        let spread = |n: usize| values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1) as f64;
        // One alone says nothing of how others would be.
        let half = (n > 1).then(|| 1.96 * (spread(n) / n as f64).sqrt());
        Rate { value: Some(mean), n, ci95: half.map(|half| [mean - half, mean + half]) }
    }

    /// The mean of parts of a whole: its interval holds nothing else.
    fn of_parts(self) -> Rate {
        Rate { ci95: self.ci95.map(|ends| ends.map(|end| end.clamp(0.0, 1.0))), ..self }
    }
}

/// The rates that have targets, at magnitudes clear and gross, and some beside them.
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
    /// The truth among causes, classes and rivals.
    pub truth_named: Rate,
    /// `single_right` without asking for just the class: the truth alone, or in whatever class was named.
    #[serde(default)]
    pub truth_in_class: Rate,
    /// Of faint single effects.
    pub faint_sure_wrong: Rate,
}

/// One of the rates as it is shown.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// Its name in `exam.json`.
    pub id: &'static str,
    /// Its name in a column of 20 letters, and in full.
    pub name: &'static str,
    pub words: &'static str,
    pub target: Option<Target>,
    pub rate: &'a Rate,
}

impl Shown<'_> {
    /// Its target and whether that is met: `at least 95 %: met`; nothing where it has none.
    pub fn stands(&self) -> String {
        match self.target.map(|target| (target, target.reached(self.rate))) {
            None => String::new(),
            Some((target, None)) => target.to_string(),
            Some((target, Some(reached))) => format!("{target}: {}", reached.words()),
        }
    }
}

impl Rates {
    /// Of these cases, as far as each rate is about them; `counts`: at which magnitudes effects do.
    pub fn of(judged: &[&Judged], counts: impl Fn(Magnitude) -> bool) -> Rates {
        let all = || judged.iter().copied();
        let of = |sort: Sort| all().filter(move |one| one.sort == sort);
        let counted = || all().filter(|one| counts(one.magnitude));
        let outside = || of(Sort::Outside).filter(|one| counts(one.magnitude));
        Rates {
            device_right: Rate::share(counted().filter_map(|one| one.device_right)),
            single_right: Rate::share(counted().filter_map(|one| one.single_right)),
            false_alarm: Rate::share(of(Sort::None).map(Judged::is_wrong)),
            outside_right: Rate::share(outside().map(Judged::is_unknown)),
            outside_sure_wrong: Rate::share(outside().map(|one| one.verdict == "effect")),
            both_of_two: Rate::share(counted().filter_map(|one| one.both_right)),
            shrink_of_oracle: Rate::mean(counted().filter_map(of_oracle)).of_parts(),
            interval_cover: Rate::share(counted().flat_map(|one| {
                let [inside, all] = one.covered;
                (0..all).map(move |k| k < inside)
            })),
            ece: calibration::error(&calibration::curve(counted().filter_map(Judged::weighed))),
            truth_named: Rate::share(counted().filter_map(|one| one.truth_named)),
            truth_in_class: Rate::share(counted().filter_map(|one| one.truth_in_class)),
            faint_sure_wrong: Rate::share(
                of(Sort::Single).filter(|one| one.magnitude == Magnitude::Faint).map(Judged::is_wrong),
            ),
        }
    }

    /// All of them as they are shown, with their targets.
    pub fn shown(&self) -> [Shown<'_>; 12] {
        use Target::{AtLeast, AtMost, Within};
        let one = |id, (name, words), target, rate| Shown { id, name, words, target, rate };
        [
            one("device_right", ("device right", "device right"), Some(AtLeast(0.99)), &self.device_right),
            one("single_right", ("single right", "single effect right"), Some(AtLeast(0.95)), &self.single_right),
            one(
                "truth_in_class",
                ("truth in class", "single effect in whatever class was named"),
                None,
                &self.truth_in_class,
            ),
            one("truth_named", ("truth named", "truth among causes, classes and rivals"), None, &self.truth_named),
            one(
                "false_alarm",
                ("false alarm", "false alarms where nothing is wrong"),
                Some(AtMost(0.02)),
                &self.false_alarm,
            ),
            one(
                "outside_right",
                ("outside right", "outside of the library: unknown or partial"),
                Some(AtLeast(0.85)),
                &self.outside_right,
            ),
            one(
                "outside_sure_wrong",
                ("outside sure, wrong", "outside of the library: a sure effect"),
                Some(AtMost(0.05)),
                &self.outside_sure_wrong,
            ),
            one("both_of_two", ("both of two", "both of two"), Some(AtLeast(0.85)), &self.both_of_two),
            one(
                "shrink_of_oracle",
                ("shrink, of oracle's", "shrink, of the oracle's"),
                Some(AtLeast(0.95)),
                &self.shrink_of_oracle,
            ),
            one(
                "interval_cover",
                ("interval cover", "parameters in their interval"),
                Some(Within(0.90, 0.98)),
                &self.interval_cover,
            ),
            one("ece", ("calibration error", "calibration error of the weights"), Some(AtMost(0.05)), &self.ece),
            one(
                "faint_sure_wrong",
                ("faint sure, wrong", "faint: sure and wrong"),
                Some(AtMost(0.05)),
                &self.faint_sure_wrong,
            ),
        ]
    }
}

fn of_oracle(judged: &Judged) -> Option<f64> {
    let oracle = judged.oracle_shrink.filter(|shrink| *shrink > 0.0)?;
    Some((judged.shrink.unwrap_or(0.0) / oracle).clamp(0.0, 1.0))
}
