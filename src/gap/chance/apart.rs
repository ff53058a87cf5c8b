//! Which commands say when they came: those that have the device for themselves.
//!
//! Of commands that follow one another sooner than the first has done its work each has a part in what all of them make of the device, and
//! nobody can tell when each of them came. They are left out: a command counts where nothing before it, late as it may have been, changes what
//! is reported from it on, and the next is given later than it may come.

use super::known::Known;
use super::late::{Told, count_anew, ports, put_off};
use crate::gap::prediction::{Predicted, PredictedEdge, Prediction};
use crate::gap::subject::Subject;
use crate::signal_map::Kind;

/// How far an edge has to be moved to be another one, s.
const SAME_EDGE_S: f64 = 1e-4;

/// Commands that are given at once, and until when no other is.
struct Together {
    /// Their places among all.
    places: Vec<usize>,
    run: usize,
    from: f64,
    until: f64,
}

/// Which signals the commands of some ports move, and no others do; and which of those commands have them for themselves.
#[derive(Clone)]
struct Moved {
    ports: Vec<usize>,
    signals: Vec<usize>,
    /// Whether one of them is a level.
    is_seen_all_along: bool,
    /// For all that the device was told, in the order of time: whether it moves these signals.
    moves: Vec<bool>,
    /// The same: whether it has them for itself.
    apart: Vec<bool>,
}

/// Of all that a device was told, what says when it came.
#[derive(Clone)]
pub(super) struct Apart {
    all: Vec<Moved>,
}

impl Apart {
    /// Of all that a device was told, in the order of time, each as much as `most_s` later.
    pub fn of(subject: &Subject, known: Known<'_>, told: &[Told], most_s: f64) -> Option<Apart> {
        let starts: Vec<(usize, f64)> = told.iter().map(|told| (told.run, told.at)).collect();
        let predicted = |is_late: &dyn Fn(usize) -> bool| {
            let late = put_off(subject, told, |at| if is_late(at) { most_s } else { 0.0 });
            let mut prediction = known.predict(&late)?;
            count_anew(&late, &mut prediction, &starts);
            Some(prediction)
        };
        let in_time = predicted(&|_| false)?;
        let mut all: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
        let ports = ports(told);
        let late = ports.iter().map(|port| predicted(&|at| told[at].port == *port)).collect::<Option<Vec<_>>>()?;
        for signal in 0..subject.signals.len() {
            let moving = ports.iter().zip(&late).filter(|(_, late)| !is_one(subject, [&in_time, late], &[signal]));
            let by: Vec<usize> = moving.map(|(port, _)| *port).collect();
            match all.iter_mut().find(|(ports, _)| *ports == by) {
                Some((_, signals)) => signals.push(signal),
                None => all.push((by, vec![signal])),
            }
        }
        let moved = |(ports, signals): (Vec<usize>, Vec<usize>)| {
            let moves: Vec<bool> = told.iter().map(|told| ports.contains(&told.port)).collect();
            let together = together(subject, told, &moves);
            let mut apart = vec![false; told.len()];
            for turn in 0..2 {
                let is_late = |at: usize| together.iter().skip(1 - turn).step_by(2).any(|of| of.places.contains(&at));
                let late = predicted(&is_late)?;
                for of in together.iter().skip(turn).step_by(2) {
                    let is_apart = of.until - of.from >= most_s
                        && is_same(subject, [&in_time, &late], (of.run, &signals, [of.from, of.until]));
                    of.places.iter().for_each(|at| apart[*at] = is_apart);
                }
            }
            let is_level = |signal: &usize| subject.signals[*signal].kind == Kind::Level;
            Some(Moved { is_seen_all_along: signals.iter().any(is_level), ports, signals, moves, apart })
        };
        Some(Apart { all: all.into_iter().map(moved).collect::<Option<_>>()? })
    }

    /// Of commands of one port that moves no levels.
    #[cfg(test)]
    pub fn of_one_port(apart: Vec<bool>) -> Apart {
        let moves = vec![true; apart.len()];
        let moved = Moved { ports: vec![0], signals: Vec::new(), is_seen_all_along: false, moves, apart };
        Apart { all: vec![moved] }
    }

    /// What a command moves: of a device that reports levels, those.
    fn moved_by(&self, at: usize) -> impl Iterator<Item = &Moved> + Clone {
        seen_best(self.all.iter().filter(move |moved| moved.moves[at]))
    }

    /// Whether a command says when it came: whether it has all that it moves for itself.
    pub fn says(&self, at: usize) -> bool {
        let mut all = self.moved_by(at).peekable();
        all.peek().is_some() && all.all(|moved| moved.apart[at])
    }

    /// The same, and that no other that moves the same is given at once: of two the later one starts the device, and the other may have come any time before.
    pub fn says_alone(&self, told: &[Told], at: usize) -> bool {
        let is_at_once = |other: usize| other != at && (told[other].run, told[other].at) == (told[at].run, told[at].at);
        let is_with_another = |moved: &Moved| (0..told.len()).any(|other| moved.moves[other] && is_at_once(other));
        self.says(at) && !self.moved_by(at).any(is_with_another)
    }

    /// The ports whose commands move what two predictions differ in.
    pub fn ports_between(&self, subject: &Subject, predictions: [&Prediction; 2]) -> Vec<usize> {
        let mut ports: Vec<usize> = seen_best(self.all.iter())
            .filter(|moved| !is_one(subject, predictions, &moved.signals))
            .flat_map(|moved| moved.ports.iter().copied())
            .collect();
        ports.sort_unstable();
        ports.dedup();
        ports
    }

    /// Lets nothing count from a command that has not the device for itself until the next, and counters go on from wherever they are at each: by how much a
    /// delay is not known stays in them for ever after.
    pub fn seen(&self, subject: &Subject, told: &[Told]) -> Subject {
        let mut seen = subject.clone();
        for moved in &self.all {
            for of in together(subject, told, &moved.moves) {
                let tracks = &mut seen.runs[of.run].tracks;
                for signal in &moved.signals {
                    let Some(track) = tracks[*signal].as_mut() else { continue };
                    let index = |at: f64| track.grid.instants.partition_point(|instant| *instant < at);
                    let (from, until) = (index(of.from), index(of.until));
                    if from == until {
                        continue;
                    }
                    track.anew.retain(|anew| *anew < from);
                    if moved.apart[of.places[0]] {
                        track.anew.push(from);
                        continue;
                    }
                    match track.blind.last_mut().filter(|last| last.1 + 1 == from) {
                        Some(last) => last.1 = until - 1,
                        None => track.blind.push((from, until - 1)),
                    }
                    track.anew.push(until);
                }
            }
        }
        seen
    }
}

/// Those of what is moved that are levels, where any is: they are seen all along, and flags only as they change.
fn seen_best<'a>(all: impl Iterator<Item = &'a Moved> + Clone) -> impl Iterator<Item = &'a Moved> + Clone {
    let has_levels = all.clone().any(|moved| moved.is_seen_all_along);
    all.filter(move |moved| moved.is_seen_all_along || !has_levels)
}

/// The commands that move some signals, those together that are given at once.
fn together(subject: &Subject, told: &[Told], moves: &[bool]) -> Vec<Together> {
    let mut all: Vec<Together> = Vec::new();
    for (at, command) in told.iter().enumerate().filter(|(at, _)| moves[*at]) {
        let (run, from) = (command.run, command.at);
        match all.last_mut().filter(|last| (last.run, last.from) == (run, from)) {
            Some(last) => last.places.push(at),
            None => {
                if let Some(last) = all.iter_mut().rfind(|last| last.run == run) {
                    last.until = from;
                }
                all.push(Together { places: vec![at], run, from, until: subject.runs[run].ends });
            }
        }
    }
    all
}

/// Whether two predictions are one of these signals.
fn is_one(subject: &Subject, predictions: [&Prediction; 2], signals: &[usize]) -> bool {
    const ALWAYS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
    (0..subject.runs.len()).all(|run| is_same(subject, predictions, (run, signals, ALWAYS)))
}

/// Whether two predictions are one of these signals of a run, from when to when. Where parts stand is what all commands before have made of it.
fn is_same(
    subject: &Subject,
    [one, other]: [&Prediction; 2],
    (of, signals, [from, until]): (usize, &[usize], [f64; 2]),
) -> bool {
    let run = &subject.runs[of];
    let is_within = |at: f64| at >= from && at < until;
    let is_same = |signal: &usize| {
        let signal = *signal;
        match (&one.runs[of][signal], &other.runs[of][signal], &run.tracks[signal]) {
            (Predicted::Level(one), Predicted::Level(other), Some(track)) => {
                let instants = track.grid.instants.get(track.first..).unwrap_or_default();
                let within = |at: f64| instants.partition_point(|instant| *instant < at).min(one.len());
                let span = within(from)..within(until);
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
        }
    };
    signals.iter().all(is_same)
}

#[cfg(test)]
mod tests {
    use super::super::late::{MOST_S, told};
    use super::*;
    use crate::gap::recorded_tests::{RUBBING_AXIS, study};
    use crate::gap::track::Track;

    /// A motor that is told another speed every tenth of a second, and at other times every second or two.
    #[test]
    fn commands_that_follow_one_another_closely_do_not_say_when_they_came() {
        let study = study(RUBBING_AXIS);
        let place = study.subjects.iter().position(|subject| subject.name == "Motor").expect("it moves");
        let (subject, known) = (&study.subjects[place], Known::bare(&study.bare[place].overrides));
        let told = told(subject);
        let apart = Apart::of(subject, known, &told, MOST_S).expect("predictions");
        let is_apart: Vec<bool> = (0..told.len()).map(|at| apart.says(at)).collect();
        let nearest = |at: f64| {
            let others = told.iter().map(|other| (other.at - at).abs()).filter(|apart| *apart > 0.0);
            others.fold(f64::INFINITY, f64::min)
        };
        assert!(told.iter().zip(&is_apart).all(|(told, is_apart)| !is_apart || nearest(told.at) >= MOST_S));
        assert!(is_apart.iter().filter(|is_apart| **is_apart).count() > 10, "{is_apart:?}");
        // Where they do not nothing counts, and the shaft is found anew behind it.
        let seen = apart.seen(subject, &told);
        let tracks: Vec<_> = seen.runs[0].tracks.iter().flatten().collect();
        for (command, is_apart) in told.iter().zip(&is_apart) {
            let sees = |at: f64| tracks.iter().all(|track| !track.is_blind(track.grid.index(at)));
            assert_eq!(sees(command.at + 0.05), *is_apart, "{command:?}");
        }
        let begins = |track: &&Track| track.blind.iter().all(|(_, last)| track.anew.contains(&(last + 1)));
        assert!(tracks.iter().all(begins));
    }
}
