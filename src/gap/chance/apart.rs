//! Which commands say when they came: those that have the device for themselves.
//!
//! Of commands that follow one another sooner than the first has done its work each has a part in what all of them make of the device, and
//! nobody can tell when each of them came. They are left out: a command counts where nothing before it, late as it may have been, changes what
//! is reported from it on, and the next is given later than it may come.

use super::known::Known;
use super::late::{MOST_S, Told, count_anew, put_off};
use crate::gap::prediction::{Predicted, PredictedEdge, Prediction};
use crate::gap::subject::Subject;

/// How far an edge has to be moved to be another one, s.
const SAME_EDGE_S: f64 = 1e-4;

/// Commands that are given at once, and until when no other is.
struct Together {
    /// The place of the first of them, and behind the last, among all.
    places: std::ops::Range<usize>,
    run: usize,
    from: f64,
    until: f64,
}

/// Of all that a device was told, in the order of time, what says when it came.
pub(super) fn apart(subject: &Subject, known: Known<'_>, told: &[Told]) -> Option<Vec<bool>> {
    let together = together(subject, told);
    let starts: Vec<(usize, f64)> = together.iter().map(|of| (of.run, of.from)).collect();
    let others_late = |turn: usize| {
        let is_late: Vec<bool> =
            together.iter().enumerate().flat_map(|(k, of)| of.places.clone().map(move |_| k % 2 != turn)).collect();
        let late = put_off(subject, told, |at| if is_late[at] { MOST_S } else { 0.0 });
        let mut prediction = known.predict(&late)?;
        count_anew(&late, &mut prediction, &starts);
        Some(prediction)
    };
    let mut in_time = known.predict(subject)?;
    count_anew(subject, &mut in_time, &starts);
    let late = [others_late(0)?, others_late(1)?];
    let mut apart = vec![false; told.len()];
    for (k, of) in together.iter().enumerate() {
        let is_apart = of.until - of.from >= MOST_S && is_same(subject, [&in_time, &late[k % 2]], of);
        apart[of.places.clone()].fill(is_apart);
    }
    Some(apart)
}

/// Lets nothing count from a command that is not apart until the next.
pub(super) fn seen(subject: &Subject, told: &[Told], apart: &[bool]) -> Subject {
    let mut seen = subject.clone();
    for of in together(subject, told).into_iter().filter(|of| !apart[of.places.start]) {
        for track in seen.runs[of.run].tracks.iter_mut().flatten() {
            let index = |at: f64| track.grid.instants.partition_point(|instant| *instant < at);
            let (from, until) = (index(of.from), index(of.until));
            if from == until {
                continue;
            }
            match track.blind.last_mut().filter(|last| last.1 + 1 == from) {
                Some(last) => last.1 = until - 1,
                None => track.blind.push((from, until - 1)),
            }
            track.anew.retain(|anew| *anew < from);
            track.anew.push(until);
        }
    }
    seen
}

fn together(subject: &Subject, told: &[Told]) -> Vec<Together> {
    let mut all: Vec<Together> = Vec::new();
    for (at, command) in told.iter().enumerate() {
        let (run, from) = (command.run, command.at);
        match all.last_mut().filter(|last| (last.run, last.from) == (run, from)) {
            Some(last) => last.places.end = at + 1,
            None => {
                if let Some(last) = all.iter_mut().rfind(|last| last.run == run) {
                    last.until = from;
                }
                all.push(Together { places: at..at + 1, run, from, until: subject.runs[run].ends });
            }
        }
    }
    all
}

/// Whether two predictions are one from these commands to the next. Where parts stand is what all commands before have made of it.
fn is_same(subject: &Subject, [one, other]: [&Prediction; 2], of: &Together) -> bool {
    let run = &subject.runs[of.run];
    let is_within = |at: f64| at >= of.from && at < of.until;
    let is_same = |signal: usize| match (&one.runs[of.run][signal], &other.runs[of.run][signal], &run.tracks[signal]) {
        (Predicted::Level(one), Predicted::Level(other), Some(track)) => {
            let instants = track.grid.instants.get(track.first..).unwrap_or_default();
            let within = |at: f64| instants.partition_point(|instant| *instant < at).min(one.len());
            let span = within(of.from)..within(of.until);
            let most = run.floors[signal].rms(0.0);
            one[span.clone()].iter().zip(&other[span]).all(|(one, other)| (one - other).abs() <= most)
        }
        (Predicted::Edges { edges: one, .. }, Predicted::Edges { edges: other, .. }, Some(_)) => {
            let own = |edges: &[PredictedEdge]| -> Vec<(f64, f64)> {
                let own = edges.iter().filter(|edge| edge.part.is_none() && is_within(edge.at));
                own.map(|edge| (edge.at, edge.to)).collect()
            };
            let (one, other) = (own(one), own(other));
            let is_one = |(a, b): (&(f64, f64), &(f64, f64))| a.1 == b.1 && (a.0 - b.0).abs() <= SAME_EDGE_S;
            one.len() == other.len() && one.iter().zip(&other).all(is_one)
        }
        _ => true,
    };
    (0..subject.signals.len()).all(is_same)
}

#[cfg(test)]
mod tests {
    use super::super::late::told;
    use super::*;
    use crate::gap::recorded_tests::{RUBBING_AXIS, study};

    /// A motor that is told another speed every tenth of a second, and at other times every second or two.
    #[test]
    fn commands_that_follow_one_another_closely_do_not_say_when_they_came() {
        let study = study(RUBBING_AXIS);
        let place = study.subjects.iter().position(|subject| subject.name == "Motor").expect("it moves");
        let (subject, known) = (&study.subjects[place], Known::bare(&study.bare[place].overrides));
        let told = told(subject);
        let apart = apart(subject, known, &told).expect("predictions");
        let nearest = |at: f64| {
            let others = told.iter().map(|other| (other.at - at).abs()).filter(|apart| *apart > 0.0);
            others.fold(f64::INFINITY, f64::min)
        };
        assert!(told.iter().zip(&apart).all(|(told, is_apart)| !is_apart || nearest(told.at) >= MOST_S));
        assert!(apart.iter().filter(|is_apart| **is_apart).count() > 10, "{apart:?}");
        // Where they do not nothing counts, and the shaft is found anew behind it.
        let seen = seen(subject, &told, &apart);
        let tracks: Vec<_> = seen.runs[0].tracks.iter().flatten().collect();
        for (command, is_apart) in told.iter().zip(&apart) {
            let sees = |at: f64| tracks.iter().all(|track| !track.is_blind(track.grid.index(at)));
            assert_eq!(sees(command.at + 0.05), *is_apart, "{command:?}");
        }
        assert!(tracks.iter().all(|track| track.anew.len() == track.blind.len()));
    }
}
