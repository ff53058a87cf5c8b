//! An axis that rubs a little, as the tests of this module have it.

use std::fs::File;
use std::io::BufReader;

use super::candidate::Candidate;
use super::library::candidates;
use crate::device::KINDS;
use crate::gap::{Overrides, Predicted, Prediction, Recording, Study, Subject};
use crate::plant::{self, embedded::Embedded};
use crate::trace::Reader;

/// The recorded axis, what it would do without friction, and friction as a candidate.
pub fn rubbing_axis() -> (Subject, Prediction, Vec<Candidate>) {
    let path = "tests/data/axis-that-rubs-a-little.cps.jsonl.zst";
    let plant = plant::load(&Embedded, "models/rig-toleranced", KINDS).expect("the rig");
    let reader = Reader::new(path, BufReader::new(File::open(path).expect("the recording"))).expect("a trace");
    let recording = Recording::read(&plant, path, reader, &[]).expect("a recording");
    let study = Study::new(&plant, &[recording]).expect("a study");
    let subject = study.subject("Axis").expect("it moves").clone();
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
