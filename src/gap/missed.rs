//! What a barrier should have seen and did not: parts that come to it with their belt, and parts that must have passed it.
//!
//! Other hands may take a part away before it comes to a barrier, or put one behind it, and nobody recorded that. So a part is
//! missed only where other things say that it was there.

use super::seen::{Geometry, RELIABLE, Seen, distance};

/// In how many of its parts both barriers must have been reached; where one then stayed cut, which no part does, in this many.
const ENOUGH: usize = 3;
const ENOUGH_BEFORE_IT_STAYED: usize = 1;
/// How near to where a part must have passed a beam, beside how long parts are, what that saw may be that part, m.
const NEAR_M: f64 = 0.25;

/// At which barriers of a belt parts are missed.
pub(super) struct Missed {
    /// Whether what passes the first beam reaches the second.
    is_reliable: bool,
    /// The beam that saw none of the parts of the bay whose belt it is.
    blind: Option<usize>,
    /// The beams that are cut to the end by no part: parts passed them meanwhile.
    passed: [bool; 2],
    /// The beam at which parts are due and that is cut to the end by what never came there from the other.
    made_by_none: Option<usize>,
}

impl Missed {
    /// Of what the barriers of a belt saw, which were so many parts; `travel` gives the belt's way at an instant, m.
    pub fn new(geometry: &Geometry, seen: &[Seen], parts: usize, travel: &dyn Fn(f64) -> f64) -> Missed {
        let passed = |beam: usize| {
            let first = |cut: &&Seen| cut.beam != beam && cut.length.is_some() && cut.is_alone(seen);
            let passes = |cut: &Seen| passed_unseen(geometry, seen, cut, travel).is_some();
            let stays = seen.iter().any(|cut| cut.beam == beam && cut.stays && cut.is_alone(seen));
            stays && seen.iter().filter(first).any(passes)
        };
        let is_reliable = is_reliable(geometry, seen, parts, travel);
        let made_by_none = seen.iter().find(|cut| is_reliable && is_made_by_none(geometry, seen, cut));
        Missed {
            is_reliable,
            blind: blind(geometry, seen),
            passed: [passed(0), passed(1)],
            made_by_none: made_by_none.map(|cut| cut.beam),
        }
    }

    /// Whether the other barrier's parts are due at a beam, and missed where they do not come.
    pub fn are_due_at(&self, beam: usize) -> bool {
        self.is_reliable || self.blind == Some(beam)
    }

    /// Whether a cut is none of a part: what sees no part stays cut.
    pub fn is_of_no_part(&self, cut: &Seen) -> bool {
        let none_passed = self.blind == Some(cut.beam) || cut.length.is_none() && self.passed[cut.beam];
        cut.stays && (none_passed || self.made_by_none == Some(cut.beam))
    }
}

/// Whether what passes the first beam reaches the second: as far as that still showed anything.
fn is_reliable(geometry: &Geometry, seen: &[Seen], parts: usize, travel: &dyn Fn(f64) -> f64) -> bool {
    const STEP_S: f64 = 0.1;
    let until = [0, 1].map(|beam| {
        let of_beam = seen.iter().filter(|cut| cut.beam == beam);
        of_beam.map(|cut| if cut.to.is_finite() { cut.to } else { cut.from }).fold(f64::NEG_INFINITY, f64::max)
    });
    let mut beams = vec![0; parts];
    let mut could = vec![false; parts];
    for cut in seen.iter().filter(|cut| cut.again.is_none() && !is_made_by_none(geometry, seen, cut)) {
        let part = cut.part.unwrap_or(0);
        beams[part] += 1;
        let until = until[1 - cut.beam];
        let comes = |between: f64| {
            let steps = ((until - cut.from) / STEP_S).ceil().max(1.0);
            let at = |step: u32| cut.from + (until - cut.from) * f64::from(step) / steps;
            (0..=steps as u32).any(|step| cut.way * (travel(at(step)) - cut.start) >= between)
        };
        could[part] |= cut.from <= until && distance(geometry, cut.beam, cut.way).is_none_or(comes);
    }
    let both = beams.iter().filter(|count| **count == 2).count();
    let all = could.iter().filter(|could| **could).count();
    let enough = if seen.iter().any(|cut| cut.stays) { ENOUGH_BEFORE_IT_STAYED } else { ENOUGH };
    both as f64 >= RELIABLE * all as f64 && both >= enough
}

/// Whether a cut of the second beam of a belt that a bay alone feeds is of no part: it stays cut though the belt goes on, nothing came there from the first,
/// and no plate reaches over it.
fn is_made_by_none(geometry: &Geometry, seen: &[Seen], cut: &Seen) -> bool {
    let is_second = geometry.fed.is_some_and(|(first, _)| first != cut.beam) && cut.way > 0.0;
    cut.stays && is_second && geometry.hands[cut.beam].is_empty() && cut.is_alone(seen)
}

/// The second beam of a belt that a bay alone feeds, where no plate reaches over it and it saw none of several parts that the first did: nothing,
/// or what stays cut though the belt goes on.
fn blind(geometry: &Geometry, seen: &[Seen]) -> Option<usize> {
    let (first, _) = geometry.fed?;
    let second = 1 - first;
    let came = seen.iter().filter(|cut| cut.beam == first && cut.way > 0.0 && cut.again.is_none());
    let saw_none = seen.iter().filter(|cut| cut.beam == second).all(|cut| is_made_by_none(geometry, seen, cut));
    (saw_none && geometry.hands[second].is_empty() && came.count() >= ENOUGH).then_some(second)
}

/// The beam that the part of a cut, the first that was seen of it, must have passed unseen, and when, s. `travel` gives the belt's way at an instant, m.
pub(super) fn unseen_before(
    geometry: &Geometry,
    seen: &[Seen],
    first: &Seen,
    travel: &dyn Fn(f64) -> f64,
) -> Option<(usize, f64)> {
    passed_unseen(geometry, seen, first, travel).or_else(|| came_unseen(geometry, seen, first, travel))
}

/// The same of a beam that stayed cut then, where the belt leads from it to where the part was seen, and no plate reaches over either.
fn passed_unseen(
    geometry: &Geometry,
    seen: &[Seen],
    first: &Seen,
    travel: &dyn Fn(f64) -> f64,
) -> Option<(usize, f64)> {
    let beam = 1 - first.beam;
    let stay =
        seen.iter().find(|cut| cut.beam == beam && cut.stays && cut.way == first.way && cut.from < first.from)?;
    passed_since(stay.from, geometry, first, travel)
}

/// The same of the beam at which a bay puts all that comes forwards, where no plate reaches over either and that beam saw nothing near it.
fn came_unseen(geometry: &Geometry, seen: &[Seen], first: &Seen, travel: &dyn Fn(f64) -> f64) -> Option<(usize, f64)> {
    let (beam, _) = geometry.fed.filter(|(fed, _)| *fed != first.beam && first.way > 0.0)?;
    if first.is_back || first.stays || geometry.is_put_into(beam) {
        return None;
    }
    let (beam, at) = passed_since(0.0, geometry, first, travel).filter(|(passed, _)| *passed == beam)?;
    let near = geometry.longest() + NEAR_M;
    let is_near = |cut: &Seen| cut.beam == beam && (cut.start - travel(at)).abs() < near;
    (!seen.iter().any(is_near)).then_some((beam, at))
}

/// When the part of a cut passed the beam before, s, and which that is, where it did so after `since`, s, and no plate reaches over either.
fn passed_since(since: f64, geometry: &Geometry, first: &Seen, travel: &dyn Fn(f64) -> f64) -> Option<(usize, f64)> {
    const STEP_S: f64 = 0.02;
    const HALVINGS: u32 = 16;
    let beam = 1 - first.beam;
    let between = distance(geometry, beam, first.way).filter(|between| *between > 0.0)?;
    if geometry.hands.iter().any(|spans| !spans.is_empty()) {
        return None;
    }
    // How far it had come from the beam.
    let gone = |at: f64| between - first.way * (first.start - travel(at));
    let mut after = first.from;
    while gone(after - STEP_S) > 0.0 {
        after -= STEP_S;
        if after <= since {
            return None;
        }
    }
    let mut before = after - STEP_S;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (before + after);
        if gone(middle) > 0.0 { after = middle } else { before = middle }
    }
    (after > since).then_some((beam, after))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::parts::{Origin, assign};
    use crate::gap::track::Track;
    use crate::gap::world::Script;

    const COMING: [(f64, f64); 3] = [(1.01, 1.61), (7.01, 7.61), (13.01, 13.61)];

    /// What stays cut from the first of these on.
    fn stuck(cuts: &[(f64, f64)]) -> Track {
        let mut track = Track::of_cuts(cuts);
        track.edges.pop();
        track
    }

    /// A belt of the rig's that always runs at 0.5 m/s.
    fn script(geometry: &Geometry, a: &Track, b: &Track) -> (Script, [Vec<Origin>; 2]) {
        assign(geometry, [Some(a), Some(b)], &|at| 0.5 * at)
    }

    /// Which parts are to be seen by a beam, how long they are, and how far before it when.
    fn at(script: &Script, beam: usize) -> Vec<(usize, f64)> {
        script.cuts.iter().filter(|cut| cut.beam == beam).map(|cut| (cut.part, cut.length)).collect()
    }

    /// The first part stays in barrier B, which the belt leaves behind; those after it never leave it.
    #[test]
    fn parts_are_missed_at_a_barrier_that_stays_cut_and_only_there() {
        let (a, b) = (Track::of_cuts(&COMING), stuck(&[(3.81, 4.41)]));
        let (found, _) = script(&Geometry::of_rig(), &a, &b);
        assert_eq!(at(&found, 1), [(0, 0.3), (1, 0.3), (2, 0.3)]);
        assert!(found.cuts.iter().all(|cut| cut.taken.is_none()), "{:?}", found.cuts);
        // One that never came there may have been taken away.
        let (found, _) = script(&Geometry::of_rig(), &a, &Track::of_cuts(&[]));
        assert!(found.cuts.iter().all(|cut| cut.beam == 0));
    }

    /// Parts that a bay has put come to barrier B, over which no plate reaches; it sees nothing, or is cut for good before the first comes.
    #[test]
    fn a_bays_parts_are_missed_at_a_barrier_that_sees_none() {
        let fed = Geometry { fed: Some((0, 0.3)), ..Geometry::of_rig() };
        let a = Track::of_cuts(&COMING);
        for b in [Track::of_cuts(&[]), stuck(&[(2.51, 3.0)])] {
            let (found, _) = script(&fed, &a, &b);
            assert_eq!(at(&found, 1).iter().map(|(_, length)| *length).collect::<Vec<_>>(), [0.3; 3]);
            assert!(found.cuts.iter().all(|cut| cut.taken.is_none()), "{:?}", found.cuts);
        }
        let reached = Geometry { hands: [vec![], vec![(2.0, 3.0)]], ..fed.clone() };
        assert!(at(&script(&reached, &a, &Track::of_cuts(&[])).0, 1).is_empty());
        // Of two it is not said.
        assert!(at(&script(&fed, &Track::of_cuts(&COMING[..2]), &Track::of_cuts(&[])).0, 1).is_empty());
    }

    /// Barrier B sees the first part, and is cut for good by none, 1.5 m before the second: that comes there, and the third.
    #[test]
    fn what_is_cut_for_good_before_a_part_comes_is_cut_by_none() {
        let fed = Geometry { fed: Some((0, 0.3)), ..Geometry::of_rig() };
        let (a, b) = (Track::of_cuts(&COMING), stuck(&[(3.81, 4.41), (6.81, 7.41)]));
        let (found, origins) = script(&fed, &a, &b);
        assert_eq!(at(&found, 1).iter().map(|(_, length)| *length).collect::<Vec<_>>(), [0.3; 3]);
        assert!(found.cuts.iter().all(|cut| cut.taken.is_none()), "{:?}", found.cuts);
        assert!(matches!(origins[1][2], Origin::Part(part) if found.cuts.iter().all(|cut| cut.part != part)));
        // Where others put parts on the belt, or take them, it may be one of theirs.
        let is_there = |geometry: &Geometry| {
            let (found, _) = script(geometry, &a, &b);
            at(&found, 1).iter().any(|(_, length)| length.is_infinite())
        };
        let reached = Geometry { hands: [vec![], vec![(2.0, 3.0)]], ..fed };
        assert!(is_there(&reached) && is_there(&Geometry::of_rig()));
    }

    /// Barrier B stays cut from the second part on, when the third has passed A and is still on its way: that says nothing of whether parts come from A to B.
    #[test]
    fn what_was_still_on_its_way_is_not_missed() {
        let later = [(1.01, 1.61), (3.01, 3.61), (4.21, 4.81), (9.01, 9.61)];
        let (found, _) = script(&Geometry::of_rig(), &Track::of_cuts(&later), &stuck(&[(3.81, 4.41), (5.81, 6.41)]));
        assert_eq!(at(&found, 1), [(0, 0.3), (1, 0.3), (2, 0.3), (3, 0.3)]);
    }

    /// Of five parts that a bay puts before barrier A that sees the first two, and is blind then; B sees all, and the others have been at A as well.
    #[test]
    fn what_a_bays_barrier_did_not_see_is_missed_there() {
        let fed = Geometry { fed: Some((0, 0.3)), ..Geometry::of_rig() };
        let a = Track::of_cuts(&COMING[..2]);
        let b = Track::of_cuts(&[0.0, 6.0, 12.0, 18.0, 24.0].map(|later| (3.81 + later, 4.41 + later)));
        let (found, _) = script(&fed, &a, &b);
        assert_eq!(at(&found, 0).iter().map(|(_, length)| *length).collect::<Vec<_>>(), [0.3; 5]);
        assert_eq!(at(&found, 1).len(), 5);
        let third: Vec<f64> = found.cuts.iter().filter(|cut| cut.part == 2).map(|cut| cut.from).collect();
        assert!(third.iter().all(|from| (from - 13.01).abs() < 0.02), "{third:?}");
        // Where others put parts on the belt, or reach over it, they may be theirs.
        assert_eq!(at(&script(&Geometry::of_rig(), &a, &b).0, 0).len(), 2);
        let reached = Geometry { hands: [vec![], vec![(2.0, 3.0)]], ..fed };
        assert_eq!(at(&script(&reached, &a, &b).0, 0).len(), 2);
    }

    /// Barrier A is cut for good by nothing, 1.2 m behind the first part; those after it come to B, and have been where A is cut.
    #[test]
    fn what_is_cut_for_good_where_parts_pass_is_cut_by_none() {
        let a = stuck(&[(1.01, 1.61), (3.41, 4.01)]);
        let b = Track::of_cuts(&COMING.map(|(from, to)| (from + 2.8, to + 2.8)));
        let (found, origins) = script(&Geometry::of_rig(), &a, &b);
        assert_eq!(at(&found, 0).iter().map(|(_, length)| *length).collect::<Vec<_>>(), [0.3; 3]);
        assert_eq!(at(&found, 1).len(), 3);
        // What cut it is recorded, and predicted by nothing.
        assert!(matches!(origins[0][2], Origin::Part(part) if found.cuts.iter().all(|cut| cut.part != part)));
    }

    /// Barrier A stays cut from the second part on; that and the third come to B, 2.8 s later, and the third has been where A is cut still.
    #[test]
    fn parts_are_missed_at_a_barrier_that_they_must_have_passed() {
        let (a, b) = (stuck(&COMING[..2]), Track::of_cuts(&COMING.map(|(from, to)| (from + 2.8, to + 2.8))));
        let (found, origins) = script(&Geometry::of_rig(), &a, &b);
        assert_eq!(at(&found, 0), [(0, 0.3), (1, 0.3), (2, 0.3)]);
        assert_eq!(at(&found, 1), [(0, 0.3), (1, 0.3), (2, 0.3)]);
        let third: Vec<_> = found.cuts.iter().filter(|cut| cut.part == 2).collect();
        let is_from_a = |from: f64, front: f64| (from - 13.01).abs() < 0.02 && front == 0.3;
        assert!(third.iter().all(|cut| is_from_a(cut.from, cut.front)), "{third:?}");
        assert!(third.iter().all(|cut| (cut.ahead - 1.4 * cut.beam as f64).abs() < 1e-9), "{third:?}");
        assert_eq!(origins[1][4..], [Origin::Part(2); 2]);
        let reached = Geometry { hands: [vec![], vec![(2.0, 3.0)]], ..Geometry::of_rig() };
        assert_eq!(at(&script(&reached, &a, &b).0, 0).len(), 2);
    }
}
