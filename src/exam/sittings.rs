//! An exam in several sittings: each with machines of a seed of its own, opened when all of its cases had been answered.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::whole::{Exam, SCHEMA};

/// One of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sitting {
    pub seed: u64,
    /// When its answers were opened, by the calendar: 2026-01-31.
    pub date: String,
    /// How many cases it has.
    pub cases: usize,
}

/// Why two exams are not counted as one.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum SittingError {
    #[error("no exam of this program: {0}; expected the exam.json of another sitting")]
    Unreadable(String),
    #[error("is of the format {0}; expected {SCHEMA}, which an exam.json of this program has")]
    Schema(String),
    #[error("is of several sittings itself; name the exam.json of each of them instead")]
    Several,
    #[error("has the seed {0}, and so has a sitting that is counted already; nothing is counted twice")]
    Twice(u64),
}

impl Exam {
    /// One that was written as `exam.json`, of one sitting.
    ///
    /// # Errors
    /// It is none, or one of several sittings.
    pub fn of_sitting(json: &str) -> Result<Exam, SittingError> {
        #[derive(Deserialize)]
        struct Format {
            schema: String,
        }
        let unreadable = |error: serde_json::Error| SittingError::Unreadable(error.to_string());
        let Format { schema } = serde_json::from_str(json).map_err(unreadable)?;
        if schema != SCHEMA {
            return Err(SittingError::Schema(schema));
        }
        let exam: Exam = serde_json::from_str(json).map_err(unreadable)?;
        if exam.sittings.is_empty() { Ok(exam) } else { Err(SittingError::Several) }
    }

    /// This and `earlier` sittings as one exam, in the order of their dates, those of one day as they are named and this one last: every rate is of all their
    /// cases. A case is named by its sitting, too: `2/case-001`.
    ///
    /// # Errors
    /// Two have one seed: they are the same machines.
    pub fn with(self, earlier: Vec<Exam>) -> Result<Exam, SittingError> {
        if earlier.is_empty() {
            return Ok(self);
        }
        let mut all = earlier;
        all.push(self);
        all.sort_by(|one, next| one.date.cmp(&next.date));
        let twice = |place: &usize| all[..*place].iter().any(|earlier| earlier.seed == all[*place].seed);
        if let Some(place) = (1..all.len()).find(twice) {
            return Err(SittingError::Twice(all[place].seed));
        }
        let of = |exam: &Exam| Sitting { seed: exam.seed, date: exam.date.clone(), cases: exam.cases };
        let sittings: Vec<Sitting> = all.iter().map(of).collect();
        let last = sittings[sittings.len() - 1].clone();
        let named = |place: usize, case: &str| format!("{}/{case}", place + 1);
        let (mut judged, mut failed) = (Vec::new(), BTreeMap::new());
        for (place, exam) in all.into_iter().enumerate() {
            failed.extend(exam.failed.into_iter().map(|(case, why)| (named(place, &case), why)));
            judged.extend(exam.judged.into_iter().map(|mut one| {
                one.case = named(place, &one.case);
                one
            }));
        }
        Ok(Exam { sittings, ..Exam::new(last.seed, last.date, judged, failed) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exam::{Answer, Magnitude, Sort, judge, unanswered};
    use crate::gap::report::{Report, Verdict};

    /// Of a healthy machine each, answered so; the last one has no answer.
    fn sitting(seed: u64, date: &str, verdicts: &[Verdict]) -> Exam {
        let answer = |case: usize| Answer {
            case: format!("case-00{case}"),
            sort: Sort::None,
            magnitude: Magnitude::None,
            effects: Vec::new(),
            class: Vec::new(),
            classes: Vec::new(),
            kind: None,
            model: None,
        };
        let each = verdicts.iter().enumerate();
        let mut judged: Vec<_> =
            each.map(|(case, verdict)| judge(&answer(case + 1), &Report::new(*verdict), 2.0)).collect();
        let last = answer(verdicts.len() + 1);
        judged.push(unanswered(&last, 8.0));
        let failed = BTreeMap::from([(last.case, "no report".to_owned())]);
        Exam::new(seed, date.to_owned(), judged, failed)
    }

    fn sitting_of(seed: u64, date: &str) -> Exam {
        sitting(seed, date, &[Verdict::NoGap])
    }

    #[test]
    fn the_cases_of_all_sittings_count() {
        let [first, second] = [
            sitting(7, "2026-01-30", &[Verdict::NoGap, Verdict::Effect, Verdict::NoGap]),
            sitting(8, "2026-01-31", &[Verdict::NoGap]),
        ];
        let json = serde_json::to_string(&first).expect("JSON");
        let read = Exam::of_sitting(&json).expect("a sitting");
        assert_eq!(read, first);
        let one = second.clone().with(vec![read]).expect("one exam");
        assert_eq!((one.seed, one.date.as_str(), one.cases), (8, "2026-01-31", 6));
        assert_eq!((one.rates.false_alarm.value, one.rates.false_alarm.n), (Some(0.5), 6));
        assert_eq!(one.seconds_per_case, Some((2.0 * 4.0 + 8.0 * 2.0) / 6.0));
        let cases: Vec<&str> = one.judged.iter().map(|one| one.case.as_str()).collect();
        assert_eq!(cases, ["1/case-001", "1/case-002", "1/case-003", "1/case-004", "2/case-001", "2/case-002"]);
        assert_eq!(one.failed.keys().collect::<Vec<_>>(), ["1/case-004", "2/case-002"]);
        let sitting = |seed, date: &str, cases| Sitting { seed, date: date.to_owned(), cases };
        assert_eq!(one.sittings, [sitting(7, "2026-01-30", 4), sitting(8, "2026-01-31", 2)]);
        let page = crate::exam::page(&one);
        assert!(
            page.contains("6 cases in 2 sittings, answers opened: 4 on 2026-01-30, seed 7; 2 on 2026-01-31, seed 8.")
        );
        // Whichever of them is scored last, it is the same exam.
        assert_eq!(first.with(vec![second.clone()]), Ok(one));
        // Of one day, the one that is named first comes first.
        let [morning, noon] = [9, 8].map(|seed| sitting_of(seed, "2026-01-30"));
        let day = sitting_of(7, "2026-01-30").with(vec![morning, noon]).expect("one exam");
        assert_eq!(day.sittings.iter().map(|sitting| sitting.seed).collect::<Vec<_>>(), [9, 8, 7]);
        // One sitting alone stays what it is.
        assert_eq!(second.clone().with(Vec::new()), Ok(second));
    }

    #[test]
    fn what_is_no_other_sitting_is_refused() {
        let [first, second] = [7, 8].map(|seed| sitting(seed, "2026-01-30", &[]));
        assert_eq!(first.clone().with(vec![first.clone()]), Err(SittingError::Twice(7)));
        let both = second.clone().with(vec![first.clone()]).expect("one exam");
        let json = |exam: &Exam| serde_json::to_string(exam).expect("JSON");
        assert_eq!(Exam::of_sitting(&json(&both)), Err(SittingError::Several));
        let old = json(&first).replace(SCHEMA, "kinetwin-exam/1");
        assert_eq!(Exam::of_sitting(&old), Err(SittingError::Schema("kinetwin-exam/1".to_owned())));
        for text in ["", "{}", "[1]", "{\"schema\":\"kinetwin-exam/2\"}"] {
            assert!(matches!(Exam::of_sitting(text), Err(SittingError::Unreadable(_))), "{text}");
        }
    }
}
