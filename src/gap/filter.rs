//! The filter that all inputs of a machine pass: flags are seen once they have stood for so long.
//!
//! It is the recording's, as the task is (`task.rs`), and looked for in two ways. Where edges of several devices ask for the same,
//! with each device as its levels have it, that is it. Of a filter much shorter than the cycle few edges tell, and where no level
//! is reported, nominal parameters take up most of it: a cylinder that runs a per mille slower arrives as late. So where a device
//! is left unexplained, filters are tried once more with the nominal parameters of all devices fitted beside each; and again once their
//! effects are known.

use rayon::prelude::*;

use super::cause::Bare;
use super::edges::interval;
use super::grid::median;
use super::locate::{THRESHOLD, are_levels_off, evidence};
use super::prediction::{Predicted, Prediction};
use super::score::Score;
use super::subject::{Subject, beam_of};
use super::task::{LEAST_DEVICES, LEAST_SQUARE, NEARER, Task};

/// How slow the filter of all inputs may be, s.
pub const MOST_FILTER_S: f64 = 6e-3;
/// The step in which filters are tried, s.
const FILTER_STEP_S: f64 = 1e-4;
/// How far an edge may be off, standard deviation, s, and how much a stray counts.
const EDGE_SIGMA_S: f64 = 1.5e-4;
const STRAY: f64 = 9.0;
/// The filters that are tried with nominal parameters beside them, s, and which shares of one that is known; then shares of the best, nearer
/// and nearer: of a cylinder's ways a tenth of a millisecond shows.
const TRIED_S: [f64; 5] = [3e-4, 6e-4, 1e-3, 2e-3, 4e-3];
const NEAR_THE_KNOWN: [f64; 6] = [0.55, 0.75, 0.9, 1.1, 1.33, 1.8];
const SHARES: [[f64; 2]; 3] = [[0.85, 1.18], [0.95, 1.05], [0.98, 1.02]];
/// How many such steps it is gone on at most.
const FURTHEST: usize = 4;
/// By how much no device may be further off under such a filter, in deviance, and by which share more of what is gained by all but the one that gains the
/// most: it is all devices' or none's. (A cylinder whose rod was switched on 6 ms late had a belt's flags, which knew better, come late by 28 of the 567 that it
/// gained.)
const NOT_FURTHER: f64 = 1.0;
const SHARE_NOT_FURTHER: f64 = 0.05;

/// By how much all flags but beams are late beyond the age, s: the same of several devices; 0 where they do not agree on any.
pub(super) fn find(subjects: &[Subject], bare: &[Bare], run: usize) -> f64 {
    let late: Vec<Vec<(f64, f64)>> =
        subjects.iter().zip(bare).map(|(subject, bare)| late(subject, &bare.prediction, run)).collect();
    let late: Vec<Vec<(f64, f64)>> = late.into_iter().filter(|edges| edges.len() >= 4).collect();
    let cost = |edges: &[(f64, f64)], filter: f64| {
        let outside = |(least, most): &(f64, f64)| (least - filter).max(filter - most).max(0.0) / EDGE_SIGMA_S;
        let squares = edges.iter().map(|edge| outside(edge).powi(2).min(STRAY)).sum::<f64>();
        edges.len() as f64 * (LEAST_SQUARE + squares / edges.len() as f64).ln()
    };
    let total = |filter: f64| late.iter().map(|edges| cost(edges, filter)).sum::<f64>();
    let steps = 0..=(MOST_FILTER_S / FILTER_STEP_S) as u32;
    let filters = steps.map(|step| f64::from(step) * FILTER_STEP_S);
    let costs: Vec<(f64, f64)> = filters.map(|filter| (total(filter), filter)).collect();
    let Some(least) = costs.iter().map(|(cost, _)| *cost).min_by(f64::total_cmp) else { return 0.0 };
    // Between looks a span of filters may do equally well: the middle of it.
    let alike: Vec<f64> = costs.iter().filter(|(cost, _)| *cost < least + 1.0).map(|(_, filter)| *filter).collect();
    let best = median(&alike).unwrap_or(0.0);
    let nearer = late.iter().filter(|edges| cost(edges, 0.0) - cost(edges, best) > NEARER).count();
    if nearer >= LEAST_DEVICES && total(0.0) - total(best) > THRESHOLD { best } else { 0.0 }
}

/// Between which delays each flag's edge lies behind its predicted instant, s.
fn late(subject: &Subject, nominal: &Prediction, run: usize) -> Vec<(f64, f64)> {
    let mut late = Vec::new();
    for (place, info) in subject.signals.iter().enumerate() {
        let (Some(track), Predicted::Edges { edges, .. }) =
            (&subject.runs[run].tracks[place], &nominal.runs[run][place])
        else {
            continue;
        };
        if beam_of(info).is_some() || !subject.is_filtered(info) {
            continue;
        }
        for edge in track.edges.iter().filter(|edge| !track.is_blind(edge.index)) {
            let (before, seen) = interval(track, edge.index);
            let same = edges.iter().filter(|other| other.to == edge.to);
            let nearest = same.min_by(|a, b| (a.at - seen).abs().total_cmp(&(b.at - seen).abs()));
            late.extend(nearest.map(|nearest| (before - nearest.at, seen - nearest.at)));
        }
    }
    late
}

/// A filter, with what the devices are under it.
struct Tried {
    filter_s: f64,
    cost: f64,
    bare: Vec<Bare>,
}

impl Tried {
    /// That of the two which costs less.
    fn or(self, other: Tried) -> Tried {
        if other.cost < self.cost { other } else { self }
    }
}

/// The best of what is tried about `first`, nearer and nearer to it, and on as far as that leads: of two filters of which the one is twice the
/// other, the shorter may be too short for one device and the longer too long for another.
fn nearest(first: Tried, under: impl Fn(f64) -> Tried) -> Tried {
    let mut best = first;
    for shares in SHARES {
        for _ in 0..FURTHEST {
            let about = best.filter_s;
            best = shares.into_iter().map(|share| under(share * about)).fold(best, Tried::or);
            if best.filter_s == about {
                break;
            }
        }
    }
    best
}

/// Tries filters with nominal parameters fitted beside each, in all runs, and sets the one that explains more than chance does: in
/// `subjects`, and what they are under it in `bare`. What it is; `None` where there is none. Where one is `known`, 0 if none is, it is
/// one of the delays between two looks that do equally well with the nominal parameters as they were: filters about it are tried too.
pub(super) fn find_beside_parameters(
    known_s: f64,
    subjects: &mut [Subject],
    nominal: &[Prediction],
    bare: &mut [Bare],
) -> Option<f64> {
    let flagged = with_a_say(subjects, bare);
    if flagged.is_empty() {
        return None;
    }
    let scores = |subjects: &[Subject], bare: &[Bare]| -> Vec<Score> {
        subjects.iter().zip(bare).map(|(subject, bare)| subject.score(&bare.prediction)).collect()
    };
    let total = |scores: &[Score]| scores.iter().map(|score| score.total).sum::<f64>();
    let picked: Vec<Subject> = flagged.iter().map(|at| subjects[*at].clone()).collect();
    let known: Vec<Bare> = flagged.iter().map(|at| bare[*at].clone()).collect();
    let before = scores(&picked, &known);
    // Of a device that reports levels they say what its nominal parameters are, whatever becomes of its flags: while filters are tried those
    // stay as they are, and are fitted beside the best of them.
    let have_levels: Vec<bool> = picked.iter().map(|subject| subject.has_levels()).collect();
    let fitted_under = |filter_s: f64, are_all: bool| -> Tried {
        let each = picked.par_iter().zip(&known).zip(&flagged).zip(&have_levels).with_max_len(1);
        let each = each.map(|(((subject, bare), at), has_levels)| {
            let mut subject = subject.clone();
            set(&mut subject, filter_s);
            let bare = match are_all || !has_levels {
                true => bare.again(&subject, &nominal[*at]),
                false => bare.held(&subject),
            };
            (subject, bare)
        });
        let (subjects, bare): (Vec<Subject>, Vec<Bare>) = each.collect::<Vec<_>>().into_iter().unzip();
        let after = scores(&subjects, &bare);
        let cost = total(&after);
        let flags = before.iter().zip(&after).map(|(before, after)| [of_flags(before), of_flags(after)]);
        let cost = if is_of_all(&flags.collect::<Vec<_>>()) { cost } else { f64::INFINITY };
        Tried { filter_s, cost, bare }
    };
    let under = |filter_s: f64| fitted_under(filter_s, false);
    let near = NEAR_THE_KNOWN.map(|share| share * known_s).into_iter().filter(|filter_s| *filter_s > 0.0);
    let mut best = near.chain(TRIED_S).map(under).reduce(Tried::or)?;
    best = nearest(best, under);
    let explains = |filter_s: f64, bare: &[Bare]| {
        picked.iter().zip(bare).all(|(subject, bare)| {
            let mut subject = subject.clone();
            set(&mut subject, filter_s);
            evidence(&subject, &bare.prediction) <= THRESHOLD
        })
    };
    if !is_one(total(&before) - best.cost, known_s > 0.0, || explains(best.filter_s, &best.bare)) {
        return None;
    }
    if have_levels.contains(&true) {
        let fitted = fitted_under(best.filter_s, true);
        best = best.or(fitted);
    }
    // Where only one device has flags, nobody can say whether a filter is its own or all inputs': it is no gap where nothing else is left.
    if flagged.len() < LEAST_DEVICES && !explains(best.filter_s, &best.bare) {
        return None;
    }
    subjects.iter_mut().for_each(|subject| set(subject, best.filter_s));
    for (subject, bare) in subjects.iter().zip(bare.iter_mut()) {
        *bare = bare.held(subject);
    }
    for (at, found) in flagged.into_iter().zip(best.bare) {
        bare[at] = found;
    }
    Some(best.filter_s)
}

/// Whether so much gained, in deviance, makes a filter one: how long one is that is there is no further thing to be found, and one that leaves no gap
/// is none of a device's either, as every machine has one.
fn is_one(gained: f64, is_there: bool, leaves_nothing: impl Fn() -> bool) -> bool {
    gained > THRESHOLD || gained > NEARER && (is_there || leaves_nothing())
}

/// Whether a filter may be that of all devices, by what the flags of each cost above their floors without it and with it.
fn is_of_all(flags: &[[f64; 2]]) -> bool {
    let gains = || flags.iter().map(|[before, after]| before - after);
    let most = gains().fold(0.0, f64::max);
    let others = (gains().sum::<f64>() - most).max(0.0);
    gains().fold(0.0, f64::min) >= -(NOT_FURTHER + SHARE_NOT_FURTHER * others)
}

/// The devices whose flags tell of a filter. One whose levels are off is so whatever the filter is, and when its flags come goes with that.
fn with_a_say(subjects: &[Subject], bare: &[Bare]) -> Vec<usize> {
    let has_flags = |subject: &Subject| {
        let flag = |info: &super::subject::SignalInfo| subject.is_filtered(info) && beam_of(info).is_none();
        subject.signals.iter().any(flag)
    };
    let has_say = |at: &usize| has_flags(&subjects[*at]) && !are_levels_off(&subjects[*at], &bare[*at].prediction);
    (0..subjects.len()).filter(has_say).collect()
}

/// What a device's flags cost above their floors. What comes just before a look that shows it costs something too, the more the nearer, and
/// is not off.
fn of_flags(score: &Score) -> f64 {
    let flags = score.signals.iter().filter(|signal| signal.level.is_none());
    flags.map(|signal| (signal.cost - signal.floor_cost.0).max(0.0)).sum()
}

/// Sets the filter of all runs.
fn set(subject: &mut Subject, filter_s: f64) {
    for run in 0..subject.runs.len() {
        let task = subject.runs[run].task;
        subject.set_task(run, Task { filter_s, ..task });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::recorded_tests::{SLOW_PUSHER, study};
    use crate::gap::score::SignalScore;
    use crate::gap::{Overrides, Study};

    /// Begun at 0.3 ms, where 0.6 ms may not be: 0.5 ms.
    #[test]
    fn a_filter_is_looked_for_as_far_as_that_leads() {
        let under = |filter_s: f64| {
            let cost = if filter_s > 5.6e-4 { f64::INFINITY } else { (filter_s / 1e-4 - 5.0).abs() };
            Tried { filter_s, cost, bare: Vec::new() }
        };
        let found = nearest(under(3e-4), under).filter_s;
        assert!((found / 5e-4 - 1.0).abs() < 0.02, "{found}");
    }

    /// What one device gains, however much, is no reason for another to be off; what three gain is one to bear a little.
    #[test]
    fn a_filter_is_all_devices_or_none() {
        assert!(!is_of_all(&[[0.0, 28.0], [0.0, 0.0], [4377.0, 3683.0]]));
        assert!(is_of_all(&[[0.0, 0.98], [0.0, 0.0], [4377.0, 3927.0]]));
        assert!(is_of_all(&[[0.0, 9.0], [200.0, 20.0], [300.0, 40.0]]));
        assert!(!is_of_all(&[[0.0, 12.0], [200.0, 20.0], [300.0, 40.0]]));
    }

    /// A robot arrived 0.2 ms late, 33 of deviance beyond chance; a filter left half of it, which is none.
    #[test]
    fn a_filter_that_leaves_no_gap_is_one() {
        assert!(is_one(16.2, false, || true) && is_one(5.0, true, || false) && is_one(18.0, false, || false));
        assert!(!is_one(16.2, false, || false) && !is_one(3.9, true, || true));
    }

    /// A motor that is faster is so under any filter.
    #[test]
    fn a_device_whose_levels_are_off_has_no_say() {
        let mut study = study(SLOW_PUSHER);
        let named = |study: &Study| -> Vec<String> {
            with_a_say(&study.subjects, &study.bare).iter().map(|at| study.subjects[*at].name.clone()).collect()
        };
        let before = named(&study);
        assert!(before.contains(&"Motor".to_owned()) && before.contains(&"Pusher".to_owned()), "{before:?}");
        let motor = study.subjects.iter_mut().find(|subject| subject.name == "Motor").expect("the motor");
        let tracks = motor.runs.iter_mut().flat_map(|run| run.tracks.iter_mut().flatten());
        tracks.for_each(|track| track.values.iter_mut().for_each(|value| *value *= 1.2));
        let others: Vec<String> = before.into_iter().filter(|name| name != "Motor").collect();
        assert_eq!(named(&study), others);
    }

    #[test]
    fn what_flags_cost_by_chance_is_not_off() {
        let of = |cost: f64, level: Option<crate::gap::LevelScore>| SignalScore {
            signal: 0,
            run: 0,
            cost,
            floor_cost: (50.0, 20.0),
            rms: 0.0,
            floor: 0.0,
            level,
            edges: Vec::new(),
        };
        let score = |cost: f64| Score::of(vec![of(cost, None), of(1000.0, Some(crate::gap::LevelScore::default()))]);
        assert_eq!([46.0, 49.0, 60.0].map(|cost| of_flags(&score(cost))), [0.0, 0.0, 10.0]);
    }

    /// Of a pusher that is a per cent slow no edge asks for a filter before its speed is known, and for none of its speeds without it. What
    /// edges asked for with the nominal speeds may be less than half of what it is.
    #[test]
    fn a_filter_is_found_with_the_speeds_that_it_hides_whatever_was_known_of_it() {
        let study = study(SLOW_PUSHER);
        for known in [0.0, 1.5e-4] {
            let mut subjects = study.subjects.clone();
            subjects.iter_mut().for_each(|subject| set(subject, known));
            let predict = |subject: &Subject| subject.predict(&[], &Overrides::none()).expect("a prediction");
            let nominal: Vec<Prediction> = subjects.iter().map(predict).collect();
            let mut bare: Vec<Bare> =
                subjects.iter().zip(&nominal).map(|(subject, nominal)| Bare::new(subject, nominal)).collect();
            let found = find_beside_parameters(known, &mut subjects, &nominal, &mut bare);
            assert!(found.is_some_and(|found| (4e-4..8e-4).contains(&found)), "{found:?}, with {known} known");
            let off =
                subjects.iter().zip(&bare).filter(|(subject, bare)| evidence(subject, &bare.prediction) > THRESHOLD);
            assert_eq!(off.map(|(subject, _)| subject.name.as_str()).collect::<Vec<_>>(), [""; 0]);
        }
    }
}
