//! Parts that weigh on a belt though none of its beams has seen them: those on their way to the first one, those that are so still when the
//! recording ends, and those behind the last one from the start.

use super::lane::End;
use super::layout::Beside;
use super::way::Way;
use super::world::{Cut, Script, Surrounding, Told};

/// What touches a beam where it is put does so to rounding, m.
const SAME_M: f64 = 1e-9;
/// How finely it is told when a part came or left, s.
const STEP_S: f64 = 0.01;

/// A belt's script, with how many parts no beam sees told beside what it tells already: each that comes from a bay or from the belt before,
/// from when its middle was on this one until a beam saw it, and each that stood behind the last beam until it leaves. `way` is how far
/// the belt went.
pub(super) fn told_beside(beside: &Beside, way: &Way, mut script: Script) -> Script {
    let ends = way.instants.last().copied().unwrap_or(0.0);
    let mut changes: Vec<(f64, i32)> = Vec::new();
    for centre in stand_unseen(beside, &script) {
        let left = first(0.0, ends, |at| way.at(at) - way.at(0.0) >= beside.lane.length - centre);
        changes.extend([(0.0, 1)].into_iter().chain(left.map(|left| (left, -1))));
    }
    changes.extend(stand_before_a_beam(beside, way, &script).into_iter().flat_map(|seen| [(0.0, 1), (seen, -1)]));
    let mut put: Vec<f64> = Vec::new();
    // Every part once: by the beam that saw it first.
    for cut in script.cuts.iter().filter(|cut| cut.ahead == 0.0) {
        let Some(metres) = unseen_way(beside, cut) else { continue };
        let gone = |at: f64| cut.way * (way.at(cut.from) - way.at(at));
        let since = || {
            let before = first(0.0, cut.from, |before| gone(cut.from - before) >= metres)?;
            (metres > SAME_M).then_some(cut.from - before)
        };
        if let Some(since) = due_by(beside, cut, &put, &|at| gone(at) - metres).or_else(since) {
            changes.extend([(since, 1), (cut.from, -1)]);
            put.push(since);
        }
    }
    for (at, left) in put_unseen(beside, way, &script, put) {
        changes.extend([(at, 1)].into_iter().chain(left.map(|left| (left, -1))));
    }
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut held = 0;
    script.told.extend(changes.into_iter().map(|(at, by)| {
        held += by;
        Told { at, what: Surrounding::Held(held.max(0) as u32), is_on: held > 0 }
    }));
    script.told.sort_by(|a, b| a.at.total_cmp(&b.at));
    script
}

/// When the bay put a part that a beam saw first, s: the last time that one was due which is not among `put`, from where the belt took it about
/// as far as the beam is, however often it turned on the way. `beyond`: how much further it took one that was put at an instant, m.
fn due_by(beside: &Beside, cut: &Cut, put: &[f64], beyond: &dyn Fn(f64) -> f64) -> Option<f64> {
    /// By how much a part may be off where the belt's reports have it, m.
    const OFF_M: f64 = 0.05;
    beside.fed.filter(|_| cut.way > 0.0)?;
    let is_it = |at: &&f64| **at <= cut.from && !put.contains(*at) && beyond(**at).abs() < OFF_M;
    beside.due.iter().rev().find(is_it).copied()
}

/// The first instant between two, to a step, at which something is so.
fn first(from: f64, to: f64, is_so: impl Fn(f64) -> bool) -> Option<f64> {
    let steps = ((to - from) / STEP_S) as u32;
    (0..=steps).map(|step| from + STEP_S * f64::from(step)).find(|at| is_so(*at))
}

/// Where the parts have their middles that stand behind the last beam at the start, m from the belt's; none where nobody knows what lies
/// at its end, so that they are this belt's wherever they are.
fn stand_unseen<'a>(beside: &'a Beside, script: &Script) -> impl Iterator<Item = f64> + use<'a> {
    let last = script.beams.iter().flatten().copied().fold(0.0, f64::max);
    let is_shown = beside.lane.ends[1] != End::Unknown;
    beside.stand.iter().copied().filter(move |centre| is_shown && *centre > last)
}

/// When a beam first saw each part that stood before it at the start, s: the one that came to a beam about when the belt had brought it there.
fn stand_before_a_beam(beside: &Beside, way: &Way, script: &Script) -> Vec<f64> {
    /// How much further or less far than its law has it a belt may have gone, as a share, and how far a part's front may be off, m.
    const OFF: f64 = 0.25;
    const FRONT_M: f64 = 0.2;
    let mut first: Vec<&Cut> = script.cuts.iter().filter(|cut| cut.ahead == 0.0 && cut.way > 0.0).collect();
    first.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut stand: Vec<f64> = beside.stand.clone();
    // The nearest to a beam comes first.
    stand.sort_by(|a, b| b.total_cmp(a));
    let mut seen = Vec::new();
    for centre in stand {
        let came = |cut: &&Cut| {
            let gone = way.at(cut.from) - way.at(0.0);
            let half = if cut.length.is_finite() { 0.5 * cut.length } else { 0.0 };
            let missing = cut.front - half - centre;
            missing > 0.0 && (missing - gone).abs() < FRONT_M + OFF * gone.abs()
        };
        if let Some(place) = first.iter().position(came) {
            seen.push(first.remove(place).from);
        }
    }
    seen
}

/// When the bay put each part that no beam has seen by the recording's end, s, and when it left, if it did: when it was due, its place was free,
/// and the belt did not bring it as far as a beam before it took it back over its start. `put`: when those were put that a beam has seen; where
/// one of them was not due then, or there is none, the recording does not follow the bay's own schedule.
fn put_unseen(beside: &Beside, way: &Way, script: &Script, put: Vec<f64>) -> Vec<(f64, Option<f64>)> {
    /// How far from its instant a part is told to have been put, s.
    const OFF_S: f64 = 0.5;
    let Some(fed) = beside.fed else { return Vec::new() };
    let beam = script.beams.iter().flatten().copied().filter(|beam| *beam > fed.at).reduce(f64::min);
    let Some(metres) = beam.map(|beam| beam - fed.at - 0.5 * fed.length) else { return Vec::new() };
    let ends = way.instants.last().copied().unwrap_or(0.0);
    let is_near = |at: f64| put.iter().any(|put| (put - at).abs() < OFF_S);
    if put.is_empty() || !put.iter().all(|at| beside.due.iter().any(|due| (due - at).abs() < OFF_S)) {
        return Vec::new();
    }
    let gone = |from: f64, to: f64| way.at(to) - way.at(from);
    let is_open = matches!(beside.lane.ends[0], End::Open | End::Belt(_));
    let mut unseen: Vec<(f64, Option<f64>)> = Vec::new();
    for &at in &beside.due {
        let is_there = |(_, left): &&(f64, Option<f64>)| left.is_none_or(|left| left > at);
        let mut others = put.iter().chain(unseen.iter().filter(is_there).map(|(put, _)| put));
        let is_free = others.all(|other| gone(*other, at).abs() >= fed.length);
        let is_left = fed.limit.is_none_or(|limit| put.len() + unseen.len() < limit);
        if is_near(at) || !is_free || !is_left {
            continue;
        }
        let is_back = |now: f64| is_open && gone(at, now) <= -fed.at;
        match first(at, ends, |now| gone(at, now) >= metres || is_back(now)) {
            Some(left) if is_back(left) => unseen.push((at, Some(left))),
            // It would have been seen.
            Some(_) => {}
            None => unseen.push((at, None)),
        }
    }
    unseen
}

/// How far a part went on this belt before its first beam saw it, m: from where its bay put it, or from the belt before.
fn unseen_way(beside: &Beside, cut: &Cut) -> Option<f64> {
    let fed = beside.fed.filter(|_| cut.way > 0.0).map(|fed| cut.front - fed.at - 0.5 * fed.length);
    let comes_from_belt =
        matches!(beside.lane.ends[usize::from(cut.way < 0.0)], End::Belt(_)) && cut.length.is_finite();
    let from_belt = comes_from_belt.then(|| {
        let centre = cut.front - 0.5 * cut.way * cut.length;
        if cut.way > 0.0 { centre } else { beside.lane.length - centre }
    });
    [fed, from_belt].into_iter().flatten().find(|metres| *metres >= -SAME_M)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gap::TaskId;
    use crate::gap::lane::Lane;
    use crate::gap::layout::Fed;

    /// A belt that always runs at 0.5 m/s.
    fn way() -> Way {
        let instants: Vec<f64> = (0..400).map(|k| 0.01 * f64::from(k)).collect();
        Way { metres: instants.iter().map(|at| 0.5 * at).collect(), instants }
    }

    /// A part that a beam saw at 2 s.
    fn seen_at(front: f64) -> Cut {
        Cut { part: 0, beam: 0, from: 2.0, ahead: 0.0, front, way: 1.0, length: 0.3, is_known: false, taken: None }
    }

    fn assert_held(told: &[Told], expected: &[(f64, u32)]) {
        assert_eq!(told.len(), expected.len(), "{told:?}");
        for (told, (at, count)) in told.iter().zip(expected) {
            assert!((told.at - at).abs() < 0.02 && told.what == Surrounding::Held(*count), "{told:?}");
        }
    }

    /// One that a bay put at 0.2 m and the first beam, at 0.7 m, saw; a box that stood in the other beam until 1.5 s is played back all the
    /// same.
    #[test]
    fn what_a_bay_put_weighs_beside_what_is_played_back() {
        let bay = TaskId { instance: 0, task: 0 };
        let fed = Some(Fed { bay, at: 0.2, length: 0.3, is_along: true, limit: None });
        let beam = |at: f64, is_on: bool| Told { at, what: Surrounding::BarrierB, is_on };
        let told = vec![beam(0.0, true), beam(1.5, false)];
        let script = Script { cuts: vec![seen_at(0.7)], told, ..Script::default() };
        let mut told = told_beside(&Beside { fed, ..Beside::default() }, &way(), script).told;
        assert_eq!([told.remove(0), told.remove(1)], [beam(0.0, true), beam(1.5, false)]);
        assert_held(&told, &[(1.3, 1), (2.0, 0)]);
    }

    /// One that was due 0.5 s before the recording's end has not come to the beam, 0.35 m on; it weighs if the one before it was put when that
    /// was due, and has left its place.
    #[test]
    fn what_a_bay_put_last_weighs_though_no_beam_sees_it_any_more() {
        let bay = TaskId { instance: 0, task: 0 };
        let held = |due: &[f64], limit: Option<usize>| {
            let fed = Some(Fed { bay, at: 0.2, length: 0.3, is_along: true, limit });
            let script = Script { cuts: vec![seen_at(0.7)], beams: [Some(0.7), None], ..Script::default() };
            told_beside(&Beside { fed, due: due.to_vec(), ..Beside::default() }, &way(), script).told
        };
        assert_held(&held(&[1.3, 3.5], None), &[(1.3, 1), (2.0, 0), (3.5, 1)]);
        assert_held(&held(&[1.3, 3.5], Some(1)), &[(1.3, 1), (2.0, 0)]);
        assert_held(&held(&[0.5, 2.7], None), &[(1.3, 1), (2.0, 0)]);
        // At 1.88 s its place is taken, and what was put at 2.46 s would have been seen.
        assert_held(&held(&[1.3, 1.88, 2.46, 3.04, 3.62], None), &[(1.3, 1), (2.0, 0), (3.62, 1)]);
    }

    /// Of a belt that runs back for a second from 2 s on: one that was due just before that has left over the belt's start, and does not stand in
    /// the way of the next; one that was due earlier was carried to the beam's side of its place first, and leaves a little later.
    #[test]
    fn what_a_belt_takes_back_over_its_start_weighs_until_then() {
        let bay = TaskId { instance: 0, task: 0 };
        let fed = Some(Fed { bay, at: 0.2, length: 0.3, is_along: true, limit: None });
        let way = way();
        let back = |at: &f64| if *at < 2.0 { 0.5 * at } else { 1.0 - 0.5 * (at - 2.0) };
        let way = Way { metres: way.instants.iter().map(back).collect(), ..way };
        let lane = Lane { length: 2.0, shares: false, ends: [End::Open, End::Open] };
        let held = |due: &[f64]| {
            let script =
                Script { cuts: vec![Cut { from: 1.0, ..seen_at(0.7) }], beams: [Some(0.7), None], ..Script::default() };
            let due = [&[0.3], due].concat();
            told_beside(&Beside { fed, due, lane: Arc::new(lane.clone()), ..Beside::default() }, &way, script).told
        };
        assert_held(&held(&[2.1]), &[(0.3, 1), (1.0, 0), (2.1, 1), (2.5, 0)]);
        assert_held(&held(&[1.9, 2.6]), &[(0.3, 1), (1.0, 0), (1.9, 1), (2.5, 0), (2.6, 1), (3.0, 0)]);
    }

    /// One that was put before its belt turned, and was seen when it had come back to where it was put; without its schedule nobody knows.
    #[test]
    fn what_was_put_before_the_belt_turned_weighs_from_then_on() {
        let bay = TaskId { instance: 0, task: 0 };
        let fed = Some(Fed { bay, at: 0.55, length: 0.3, is_along: true, limit: None });
        let way = way();
        let there = |at: &f64| if *at < 1.5 { -0.5 * at } else { 0.5 * at - 1.5 };
        let way = Way { metres: way.instants.iter().map(there).collect(), ..way };
        let held = |due: &[f64]| {
            let script = Script { cuts: vec![seen_at(0.7)], beams: [Some(0.7), None], ..Script::default() };
            told_beside(&Beside { fed, due: due.to_vec(), ..Beside::default() }, &way, script).told
        };
        assert_held(&held(&[0.0, 1.0]), &[(1.0, 1), (2.0, 0)]);
        assert_held(&held(&[0.3]), &[]);
    }

    /// One that stood 0.8 m before its beam until the belt had brought it there weighs from the start on; one that came from elsewhere does not.
    #[test]
    fn what_stood_before_a_beam_weighs_until_it_is_seen() {
        let lane = Lane { length: 2.0, shares: false, ends: [End::Open, End::Open] };
        let beside = |stand: f64| Beside { lane: Arc::new(lane.clone()), stand: vec![stand], ..Beside::default() };
        let script = || Script { cuts: vec![seen_at(1.7)], beams: [Some(0.3), Some(1.7)], ..Script::default() };
        assert_held(&told_beside(&beside(0.65), &way(), script()).told, &[(0.0, 1), (2.0, 0)]);
        assert_held(&told_beside(&beside(0.05), &way(), script()).told, &[]);
    }

    /// One that comes from a belt before weighs from when its middle is on this one: 0.15 m at 0.5 m/s. One that stood behind barrier B does
    /// so until it has gone the 0.1 m to the end; one before it is seen there.
    #[test]
    fn what_comes_from_a_belt_before_and_what_stood_there_weigh() {
        let lane = Lane { length: 2.0, shares: false, ends: [End::Belt(Default::default()), End::Open] };
        let beside = Beside { lane: Arc::new(lane), stand: vec![1.9, 1.2], ..Beside::default() };
        let script = Script { cuts: vec![seen_at(0.3)], beams: [Some(0.3), Some(1.7)], ..Script::default() };
        assert_held(&told_beside(&beside, &way(), script).told, &[(0.0, 1), (0.2, 0), (1.7, 1), (2.0, 0)]);
    }
}
