//! An axis that rubs a little, as the tests of this module have it.

use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use super::ladder::{Ladder, floor};
use super::library::candidates;
use super::unseen::Folds;
use crate::gap::recorded_tests::{RUBBING_AXIS, study};
use crate::gap::{Overrides, Predicted, Prediction, Subject};

/// The recorded axis, what it would do without friction, and friction as a candidate.
pub fn rubbing_axis() -> (Subject, Prediction, Vec<Candidate>) {
    let subject = study(RUBBING_AXIS).subject("Axis").expect("it moves").clone();
    let nominal = subject.predict(&[], &Overrides::none()).expect("a prediction");
    let found = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "coulomb-friction");
    let rubs = vec![found.into_iter().next().expect("friction")];
    (subject, nominal, rubs)
}

/// Has the levels of a device be what is predicted.
pub fn report_as(subject: &mut Subject, prediction: &Prediction) {
    for (track, predicted) in subject.runs[0].tracks.iter_mut().zip(&prediction.runs[0]) {
        if let (Some(track), Predicted::Level(values)) = (track, predicted) {
            track.values.clone_from(values);
        }
    }
}

/// A ladder that ends at such a set.
pub fn ending_at(bench: &Bench<'_>, nominal: &Prediction, best: Trial) -> Ladder {
    Ladder {
        floor: floor(&bench.subject.score(nominal)),
        bare: bench.trial(&[], Vec::new()).expect("a trial"),
        beneath: 0.0,
        beyond_rounding: 0.0,
        best,
        ends: None,
        subject: bench.subject.clone(),
        singles: Vec::new(),
        near: Vec::new(),
        tried: 0,
        too_few_blocks: None,
        folds: Folds::Long,
    }
}
