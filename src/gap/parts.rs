//! Which part made which edge of a belt's barriers, and where each of them really was.
//!
//! A part that barrier A saw is expected at barrier B when the belt has gone the way between them: one that comes near that is
//! the same part. Where it exactly was when A saw it is latent, within what the belt goes in a reporting cycle and whatever a
//! sensor adds: it is where all edges of the part together are likeliest. So no edge of a belt is compared with one that it
//! inherited from the belt before.

use super::lane::{End, Rider, Step};
use super::missed::{Missed, unseen_before};
use super::seen::{
    GATE_M, Geometry, RELIABLE, Seen, cuts, distance, goes_back, is_cut_for_too_long, middle, see_little,
};
use super::shortfall::{self, Passed};
use super::track::Track;
use super::world::{Cut, PAST_M, Script, Surrounding, Told};

/// How far from where it is expected a part may be seen, beside [`GATE_M`], as a share of its way.
const GATE: f64 = 0.08;
/// How far from a known length a part may have cut a beam, as a share.
const LENGTH_GATE: f64 = 0.25;
/// And how far, m, where the part's other cut fits.
const LENGTH_GATE_M: f64 = 0.1;
/// Within how much of the belt's way a part passes a beam that it has passed before, m: less than two parts are apart.
const PASSES_M: f64 = 0.05;
/// How far from where it left a beam a part may be by the belt's way when it comes back, m: it slips where the belt turns, and parts are further
/// apart.
const BACK_M: f64 = 0.25;

/// What an edge of a barrier is to a score.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// It is predicted from other edges of its part.
    Part(usize),
    /// Nothing predicts it: it was played back.
    Input,
}

/// What the barriers of a belt saw, as a script and as the origins of their edges. `travel` gives the belt's nominal way at an
/// instant, m; `tracks` are those of barriers A and B.
pub(super) fn assign(
    geometry: &Geometry,
    tracks: [Option<&Track>; 2],
    travel: &dyn Fn(f64) -> f64,
) -> (Script, [Vec<Origin>; 2]) {
    let mut seen: Vec<Seen> = Vec::new();
    let mut origins = tracks.map(|track| vec![Origin::Input; track.map_or(0, |track| track.edges.len())]);
    let mut script = Script { lane: geometry.lane.clone(), ..Script::default() };
    for (beam, track) in tracks.iter().enumerate() {
        let Some(track) = track else { continue };
        seen.extend(cuts(geometry, beam, track, travel));
        play_initial(geometry, beam, (track, travel), &mut script);
    }
    seen.sort_by(|a, b| a.from.total_cmp(&b.from));
    find_again(geometry, &mut seen, travel);
    let parts = name_parts(geometry, &mut seen, travel);
    let missed = Missed::new(geometry, &seen, parts, travel);
    for (at, cut) in seen.iter().enumerate() {
        script_of(geometry, &seen, at, (&missed, travel), &mut script);
        if let Some(part) = cut.part {
            origins[cut.beam][cut.rise] = Origin::Part(part);
            if let Some(fall) = cut.fall.filter(|_| cut.length.is_some()) {
                origins[cut.beam][fall] = Origin::Part(part);
            }
        }
    }
    let ends = tracks.iter().flatten().filter_map(|track| track.grid.instants.last()).copied().fold(0.0, f64::max);
    for cut in script.cuts.iter_mut().filter(|cut| cut.taken.is_none()) {
        cut.taken = fell_off(geometry, &seen, cut, travel, ends);
    }
    script.cuts.sort_by(|a, b| a.from.total_cmp(&b.from));
    script.told.sort_by(|a, b| a.at.total_cmp(&b.at));
    (script, origins)
}

/// What stood in the beam from the start leaves it as it was recorded; nothing stood in one that the belt never freed, though it went on by more than any part is long.
fn play_initial(geometry: &Geometry, beam: usize, (track, travel): (&Track, &dyn Fn(f64) -> f64), script: &mut Script) {
    let what = if beam == 0 { Surrounding::BarrierA } else { Surrounding::BarrierB };
    let is_never_freed = track.edges.is_empty() && is_cut_for_too_long(geometry, track, travel);
    if track.initial != 0.0 && !is_never_freed {
        script.told.push(Told { at: 0.0, what, is_on: true });
        if let Some(first) = track.edges.first() {
            script.told.push(Told { at: middle(track, first.index), what, is_on: false });
        }
    }
}

/// A part that left a beam, and where it is from there.
struct Left {
    /// The place of its first cut of that beam.
    first: usize,
    /// When it left, s.
    at: f64,
    /// How far it had gone since it came, m, as it came.
    gone: f64,
    /// How long it is, m; as the longest, where it never passed the beam.
    length: f64,
    /// Whether it left the way that it came.
    is_back: bool,
}

/// Finds the cuts of parts that the belt brings back to a beam which they had left.
fn find_again(geometry: &Geometry, seen: &mut [Seen], travel: &dyn Fn(f64) -> f64) {
    let longest = geometry.longest();
    let see_little = see_little(seen, travel);
    for beam in 0..2 {
        let mut left: Vec<Left> = Vec::new();
        for at in (0..seen.len()).filter(|at| seen[*at].beam == beam).collect::<Vec<_>>() {
            let cut = seen[at];
            let back = left.iter().rposition(|left| comes_again(geometry, &seen[left.first], left, &cut, travel));
            let before = back.map(|place| left.remove(place));
            seen[at].again = before.as_ref().map(|left| left.first);
            let first = before.as_ref().map_or(at, |left| left.first);
            if cut.fall.is_none() {
                continue;
            }
            let gone = seen[first].way * (travel(cut.to) - seen[first].start);
            let is_back = if first == at { goes_back(&cut, see_little, travel) } else { gone < GATE_M };
            let fed = geometry.fed.filter(|(fed, _)| *fed == beam && seen[first].way > 0.0).map(|(_, length)| length);
            let known = before.map(|left| left.length).or(fed);
            let length = known.unwrap_or(if gone < GATE_M { longest } else { gone });
            left.push(Left { first, at: cut.to, gone, length, is_back });
        }
        left.iter().filter(|left| left.is_back).for_each(|left| seen[left.first].is_back = true);
    }
}

/// Whether a part that left a beam is what cuts it anew: the belt has gone back as far as it had gone on, and the part did not leave it
/// meanwhile.
fn comes_again(geometry: &Geometry, first: &Seen, left: &Left, cut: &Seen, travel: &dyn Fn(f64) -> f64) -> bool {
    const STEP_S: f64 = 0.02;
    let is_past = left.gone > 0.5 * left.length;
    let comes_back = if is_past { cut.way != first.way } else { cut.way == first.way };
    let gone = |at: f64| first.way * (travel(at) - first.start);
    if !comes_back || (gone(cut.from) - left.gone).abs() > BACK_M {
        return false;
    }
    let Some(front) = geometry.beams[first.beam] else { return false };
    let stays_on = |at: f64| {
        let centre = front + first.way * (gone(at) - 0.5 * left.length);
        let [start, end] = &geometry.lane.ends;
        !(*start == End::Open && centre < 0.0 || *end == End::Open && centre > geometry.lane.length + PAST_M)
    };
    let steps = ((cut.from - left.at) / STEP_S).ceil().max(1.0);
    (0..=steps as u32).all(|step| stays_on(left.at + (cut.from - left.at) * f64::from(step) / steps))
}

/// When the part of a cut left the belt at an open end: it came so near to that, the belt then took back what it had, and no beam saw the part
/// again until the recording `ends`, s.
fn fell_off(geometry: &Geometry, seen: &[Seen], cut: &Cut, travel: &dyn Fn(f64) -> f64, ends: f64) -> Option<f64> {
    const STEP_S: f64 = 0.02;
    let of_part = || seen.iter().filter(|seen| seen.part == Some(cut.part));
    let last = of_part().max_by(|a, b| a.to.total_cmp(&b.to)).filter(|last| last.to.is_finite())?;
    let first = of_part().find(|first| first.beam == last.beam)?;
    let front = geometry.beams[last.beam].filter(|_| cut.length.is_finite())?;
    let centre = |at: f64| front + first.way * (first.way * (travel(at) - first.start) - 0.5 * cut.length);
    // It left the beam towards one of the ends.
    let towards = if centre(last.to) > front { 1.0 } else { -1.0 };
    let end = usize::from(towards > 0.0);
    let border = if towards > 0.0 { geometry.lane.length } else { 0.0 };
    let left = |at: f64| towards * (border - centre(at));
    let (mut nearest, mut when) = (left(last.to), last.to);
    for step in 1..=((ends - last.to) / STEP_S).max(0.0) as u32 {
        let at = last.to + STEP_S * f64::from(step);
        let now = left(at);
        if now < nearest {
            (nearest, when) = (now, at);
        }
        if now > left(last.to) + PASSES_M {
            return (geometry.lane.ends[end] == End::Open && nearest < GATE_M).then_some(when);
        }
    }
    None
}

/// By which factors a belt may carry less or more than nominally; the nearest to 1 first.
const FACTORS: [f64; 9] = [1.0, 0.92, 1.08, 0.85, 1.16, 0.78, 1.25, 0.7, 1.35];

/// Gives every cut its part; returns how many there are. A belt that carries far less than nominally still brings what the first
/// barrier saw to the second.
fn name_parts(geometry: &Geometry, seen: &mut [Seen], travel: &dyn Fn(f64) -> f64) -> usize {
    let (mut best, mut fit) = link(geometry, seen, FACTORS[0]);
    let could = seen.iter().filter(|cut| cut.beam == 0).count().min(seen.iter().filter(|cut| cut.beam == 1).count());
    for factor in &FACTORS[1..] {
        if best.iter().flatten().count() as f64 >= RELIABLE * could as f64 {
            break;
        }
        let (links, how) = link(geometry, seen, *factor);
        (best, fit) = if how > fit { (links, how) } else { (best, fit) };
    }
    let mut parts = 0;
    for at in 0..seen.len() {
        seen[at].part = seen[at].part.or(seen[at].again.and_then(|first| seen[first].part));
        if seen[at].part.is_none() {
            seen[at].part = Some(parts);
            parts += 1;
        }
        if let Some(other) = best[at] {
            seen[other].part = seen[at].part;
        }
    }
    give_lengths(geometry, seen, parts, travel);
    // What comes again to a beam out of which other hands took it is another part.
    for at in 0..seen.len() {
        if seen[at].again.is_some_and(|first| seen[first].length.is_none()) {
            (seen[at].again, seen[at].part, seen[at].length) = (None, Some(parts), None);
            parts += 1;
        }
    }
    parts
}

/// For each cut the one of the same part at the barrier that follows, where the belt carries `factor` times as far as nominally; and how well that
/// fits: the sum over all of 1 for one that comes where it is expected, and 0 for one that just may be the same.
fn link(geometry: &Geometry, seen: &[Seen], factor: f64) -> (Vec<Option<usize>>, f64) {
    let (mut links, mut fit) = (vec![None; seen.len()], 0.0);
    let mut is_taken = vec![false; seen.len()];
    for at in 0..seen.len() {
        let first = seen[at];
        let is_free = !is_taken[at] && first.again.is_none() && !first.is_back;
        let between = distance(geometry, first.beam, first.way).filter(|way| *way > 0.0 && is_free);
        let Some(between) = between else { continue };
        let expected = first.start + first.way * between / factor;
        let gate = GATE_M + GATE * between;
        let comes = |cut: &Seen| {
            cut.beam != first.beam
                && cut.again.is_none()
                && cut.from > first.from
                && cut.way == first.way
                && (cut.start - expected).abs() <= gate
        };
        let nearest = (at + 1..seen.len())
            .filter(|&other| !is_taken[other] && comes(&seen[other]))
            .min_by(|a, b| (seen[*a].start - expected).abs().total_cmp(&(seen[*b].start - expected).abs()));
        // On a belt that turns a part passes a beam several times at the same way: the first time it comes from the beam before.
        let first_time = nearest.map(|nearest| {
            let is_there = |cut: &Seen| comes(cut) && (cut.start - seen[nearest].start).abs() < PASSES_M;
            (at + 1..nearest).find(|&other| !is_taken[other] && is_there(&seen[other])).unwrap_or(nearest)
        });
        if let Some(other) = first_time {
            (links[at], is_taken[other]) = (Some(other), true);
            fit += 1.0 - (seen[other].start - expected).abs() / gate;
        }
    }
    (links, fit)
}

/// Gives every part the length that its cuts fit best: one for both barriers, so that a barrier that is late at one edge shows.
fn give_lengths(geometry: &Geometry, seen: &mut [Seen], parts: usize, travel: &dyn Fn(f64) -> f64) {
    let mut best: Vec<Option<(f64, f64)>> = vec![None; parts];
    let known: Vec<Option<f64>> = (0..parts).map(|part| known_length(geometry, seen, part)).collect();
    let made = made_length(geometry, seen, travel);
    let by_hands = |cut: &Seen| geometry.hands[cut.beam].iter().any(|(from, to)| (*from..=*to).contains(&cut.to));
    let by_belt = |cut: &Seen| cut.fall.is_some() && !by_hands(cut);
    // What the belt brings again, or takes back the way it came, says nothing of a length.
    let see_little = see_little(seen, travel);
    let turns_back = |cut: &Seen| goes_back(cut, see_little, travel);
    for cut in seen.iter().filter(|cut| by_belt(cut) && cut.again.is_none() && !turns_back(cut)) {
        let Some(part) = cut.part.filter(|part| *part < parts) else { continue };
        let (best, known) = (&mut best[part], &known[part]);
        let as_made = |length: f64| made.filter(|_| known.is_some()).unwrap_or(length);
        let off = |length: f64| misses(geometry, cut, as_made(length), travel);
        let lengths = known.as_ref().map_or(geometry.lengths.as_slice(), std::slice::from_ref);
        let Some((least, length)) = nearest(lengths, off) else { continue };
        // Two that touch cut it as one.
        let sums =
            geometry.lengths.iter().flat_map(|a| geometry.lengths.iter().map(move |b| as_made(*a) + as_made(*b)));
        let is_one = least < LENGTH_GATE_M.min(0.5 * LENGTH_GATE * length)
            || sums.map(|sum| misses(geometry, cut, sum, travel)).all(|sum| least < sum);
        if is_one && least <= LENGTH_GATE * length && best.is_none_or(|(found, _)| least < found) {
            *best = Some((least, length));
        }
    }
    let known_of = |cut: &Seen| cut.part.and_then(|part| known.get(part).copied().flatten());
    let found_of = |cut: &Seen| Some(best.get(cut.part?)?.as_ref()?.1);
    let of_part = |cut: &Seen| found_of(cut).or(known_of(cut));
    let beyond = |cut: &Seen, length: f64| {
        let made = made.filter(|_| known_of(cut).is_some()).unwrap_or(length);
        Passed { beyond: goes_beyond(geometry, cut, made, travel), length }
    };
    let all_are_off = [0, 1].map(|beam| {
        let passes = |cut: &&Seen| cut.beam == beam && by_belt(cut) && cut.again.is_none() && !turns_back(cut);
        let all: Vec<Passed> = seen.iter().filter(passes).filter_map(|cut| Some(beyond(cut, of_part(cut)?))).collect();
        shortfall::of_nearly_all(&all).filter(|_| !geometry.is_put_into(beam))
    });
    for cut in seen.iter_mut().filter(|cut| by_belt(cut) || cut.stays) {
        let length = found_of(cut).or(known_of(cut).filter(|_| turns_back(cut)));
        if cut.stays || cut.again.is_some() || turns_back(cut) {
            cut.length = length;
            continue;
        }
        let passed = |length: f64| beyond(cut, length);
        let fits = |length: &f64| passed(*length).beyond.abs() <= LENGTH_GATE_M.max(LENGTH_GATE * length);
        let is_as_all = |length: &f64| all_are_off[cut.beam].is_some_and(|off| passed(*length).agrees(off));
        let as_all = of_part(cut).filter(is_as_all);
        cut.length = length.filter(fits).or(as_all);
    }
}

/// How long a part is that only a bay can have put, m.
fn known_length(geometry: &Geometry, seen: &[Seen], part: usize) -> Option<f64> {
    let first = seen.iter().find(|cut| cut.part == Some(part))?;
    let (beam, length) = geometry.fed?;
    (first.beam == beam && first.way > 0.0).then_some(length)
}

/// How long the parts of a bay are by how far they went while they cut a beam, m, where several agree: they may be made otherwise than declared by
/// more than one part may be off.
fn made_length(geometry: &Geometry, seen: &[Seen], travel: &dyn Fn(f64) -> f64) -> Option<f64> {
    const ENOUGH: usize = 3;
    /// How far from one another those that agree may be, and from what was declared, as shares.
    const AGREE: f64 = 0.1;
    const FURTHEST: f64 = 0.5;
    let (fed, declared) = geometry.fed?;
    let of_beam = |beam: usize| -> Option<f64> {
        let is_whole = |cut: &&Seen| cut.beam == beam && cut.way > 0.0 && cut.fall.is_some() && cut.again.is_none();
        let mut gone: Vec<f64> = seen.iter().filter(is_whole).map(|cut| travel(cut.to) - cut.start).collect();
        gone.retain(|gone| (gone - declared).abs() <= FURTHEST * declared);
        gone.sort_by(f64::total_cmp);
        let middle = *gone.get(gone.len() / 2)?;
        let agree = gone.iter().filter(|gone| (*gone - middle).abs() <= AGREE * declared).count();
        (agree >= ENOUGH && 2 * agree > gone.len()).then_some(middle)
    };
    // Where the other beam has another length the sensor is to blame.
    let (made, beyond) = (of_beam(fed)?, of_beam(1 - fed));
    beyond.is_none_or(|beyond| (beyond - made).abs() <= AGREE * declared).then_some(made)
}

/// The length that is off the least, with how far it is off.
fn nearest(lengths: &[f64], off: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
    lengths.iter().map(|length| (off(*length), *length)).min_by(|a, b| a.0.total_cmp(&b.0))
}

/// How far a part of this length would have gone too far or not far enough while it cut the beam, m.
fn misses(geometry: &Geometry, cut: &Seen, length: f64, travel: &dyn Fn(f64) -> f64) -> f64 {
    goes_beyond(geometry, cut, length, travel).abs()
}

/// The same, less than 0 where it did not go far enough.
fn goes_beyond(geometry: &Geometry, cut: &Seen, length: f64, travel: &dyn Fn(f64) -> f64) -> f64 {
    const STEP_S: f64 = 0.02;
    let Some(front) = geometry.beams[cut.beam] else { return f64::INFINITY };
    let centre = front - 0.5 * cut.way * length;
    let mut rider = Rider::new(0, centre, length);
    let steps = ((cut.to - cut.from) / STEP_S).ceil().max(1.0);
    let at = |step: f64| cut.from + (cut.to - cut.from) * step / steps;
    for step in 0..steps as u32 {
        let (from, to) = (at(f64::from(step)), at(f64::from(step + 1)));
        geometry.lane.carry(&mut rider, &Step::even(from, to, travel(to) - travel(from)));
    }
    // It leaves an open end before all of it has passed the beam.
    let left = match (&geometry.lane.ends, cut.way > 0.0) {
        ([_, End::Open], true) => geometry.lane.length + 0.5 * length - front,
        ([End::Open, _], false) => front + 0.5 * length,
        _ => length,
    };
    rider.gone.abs() - length.min(left)
}

/// What one cut is in the script: moved with the belt from the part's first edge, or played back.
fn script_of(
    geometry: &Geometry,
    seen: &[Seen],
    at: usize,
    (missed, travel): (&Missed, &dyn Fn(f64) -> f64),
    script: &mut Script,
) {
    let cut = seen[at];
    // What comes again goes on with the cut that it came with first.
    let Some(part) = cut.part.filter(|_| cut.again.is_none() && !missed.is_of_no_part(&cut)) else { return };
    let first = seen[..at].iter().find(|other| other.part == cut.part).copied().unwrap_or(cut);
    let before = cut.length.and_then(|_| unseen_before(geometry, seen, &first, travel));
    let (beam, from) = before.unwrap_or((first.beam, first.from));
    let ahead = if beam == cut.beam { 0.0 } else { (cut.start - first.start).abs() };
    let ahead = match distance(geometry, beam, first.way) {
        Some(between) if beam != cut.beam => between,
        _ => ahead,
    };
    let taken = if cut.length.is_some() { None } else { Some(cut.to).filter(|to| to.is_finite()) };
    let length = cut.length.unwrap_or(f64::INFINITY);
    let front = geometry.beams[beam].unwrap_or_default();
    let is_known = known_length(geometry, seen, part).is_some();
    let own = Cut { part, beam: cut.beam, from, ahead, front, way: first.way, length, is_known, taken };
    script.cuts.push(own);
    if before.is_some() && first.beam == cut.beam {
        script.cuts.push(Cut { beam, ahead: 0.0, ..own });
    }
    if seen.iter().any(|other| other.again == Some(at)) {
        script.back.push(part);
    }
    // One that should have come to the other beam and did not is missed there.
    let is_alone = cut.is_alone(seen);
    if let (true, true, Some(length), Some(between)) =
        (is_alone, missed.are_due_at(1 - cut.beam), cut.length, distance(geometry, cut.beam, cut.way))
        && between > 0.0
    {
        let beam = 1 - cut.beam;
        script.cuts.push(Cut { beam, from: cut.from, ahead: between, way: cut.way, length, taken: None, ..own });
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gap::lane::Lane;

    /// A belt of the rig's that always runs at 0.5 m/s.
    fn of_rig(a: &[(f64, f64)], b: &[(f64, f64)]) -> (Script, [Vec<Origin>; 2]) {
        of_rig_that(&|at| 0.5 * at, a, b)
    }

    /// The same that goes this way.
    fn of_rig_that(travel: &dyn Fn(f64) -> f64, a: &[(f64, f64)], b: &[(f64, f64)]) -> (Script, [Vec<Origin>; 2]) {
        let lane = Arc::new(Lane { length: 2.0, shares: false, ends: [End::Open, End::Open] });
        assign(&Geometry { lane, ..Geometry::of_rig() }, [Some(&Track::of_cuts(a)), Some(&Track::of_cuts(b))], travel)
    }

    /// A barrier that is cut from the first look to the last, on a belt that goes on and on, sees nothing; on one that stands a part may stand in it.
    #[test]
    fn what_no_part_can_have_left_is_cut_by_none() {
        let always = Track { initial: 1.0, ..Track::of_cuts(&[]) };
        let told = |speed: f64| {
            let lane = Arc::new(Lane { length: 2.0, shares: false, ends: [End::Open, End::Open] });
            let geometry = Geometry { lane, ..Geometry::of_rig() };
            let travel = |at: f64| speed * at;
            assign(&geometry, [Some(&always), Some(&Track::of_cuts(&[]))], &travel).0.told.len()
        };
        assert_eq!((told(0.5), told(0.0)), (0, 1));
    }

    #[test]
    fn a_part_is_known_again_at_the_second_barrier() {
        let (script, origins) = of_rig(&[(1.01, 1.61), (7.01, 7.61)], &[(3.81, 4.41), (9.81, 10.41)]);
        let parts = [0, 0, 1, 1].map(Origin::Part);
        assert_eq!(origins, [parts.to_vec(), parts.to_vec()]);
        assert_eq!(script.cuts.len(), 4);
        let ways: Vec<f64> = script.cuts.iter().map(|cut| cut.ahead).collect();
        assert!(ways.iter().all(|way| *way == 0.0 || (*way - 1.4).abs() < 1e-9), "{ways:?}");
        assert!(script.cuts.iter().all(|cut| cut.length == 0.3 && cut.taken.is_none()));
    }

    /// Out of the beam the way that it came and in again; and so far back that it leaves the belt before another comes.
    #[test]
    fn a_part_that_a_belt_takes_back_is_the_same_until_it_has_left() {
        let travel = |turns: f64| {
            move |at: f64| match at {
                at if at < 1.31 => 0.5 * at,
                at if at < turns => 0.655 - 0.5 * (at - 1.31),
                at => 0.655 - 0.5 * (turns - 1.31) + 0.5 * (at - turns),
            }
        };
        let (script, origins) = of_rig_that(&travel(1.71), &[(1.01, 1.61), (1.81, 2.41)], &[(4.61, 5.21)]);
        assert_eq!(origins, [vec![Origin::Part(0); 4], vec![Origin::Part(0); 2]]);
        assert_eq!(script.cuts.len(), 2);
        assert!(script.cuts.iter().all(|cut| cut.length == 0.3 && cut.taken.is_none()), "{:?}", script.cuts);
        let (script, origins) = of_rig_that(&travel(2.31), &[(1.01, 1.61), (3.01, 3.61)], &[(5.81, 6.41)]);
        assert_eq!(origins[0][2..], [Origin::Part(1); 2]);
        assert_eq!(origins[1], [Origin::Part(1); 2]);
        assert_eq!(script.cuts.len(), 3);
    }

    /// One that seems to have gone 10 mm past the end of the belt, and is in the last beam again when the belt has come back, has not left; 40 mm past
    /// it, it has, and what comes is another.
    #[test]
    fn a_part_that_comes_back_from_the_end_had_not_left() {
        let again = |turns: f64| {
            let travel = move |at: f64| 0.5 * if at < turns { at } else { 2.0 * turns - at };
            let (script, origins) =
                of_rig_that(&travel, &[(1.01, 1.61)], &[(3.81, 4.41), (2.0 * turns - 4.41, 2.0 * turns - 3.81)]);
            (script.back, origins[1].clone())
        };
        assert_eq!(again(4.73), (vec![0], vec![Origin::Part(0); 4]));
        let (back, origins) = again(4.79);
        assert!(back.is_empty() && origins[2] != Origin::Part(0), "{back:?} {origins:?}");
    }

    /// 10 mm before the end of the belt it may have left, and 11 cm before it not.
    #[test]
    fn a_part_that_came_to_the_end_and_never_came_back_has_left() {
        let taken = |turns: f64| {
            let travel = move |at: f64| 0.5 * if at < turns { at } else { 2.0 * turns - at };
            let (script, _) = of_rig_that(&travel, &[(1.01, 1.61)], &[(3.81, 4.41)]);
            script.cuts.iter().map(|cut| cut.taken).collect::<Vec<_>>()
        };
        let near = taken(4.69);
        assert!(near.len() == 2 && near.iter().all(|at| at.is_some_and(|at| (at - 4.69).abs() < 0.03)), "{near:?}");
        assert_eq!(taken(4.5), [None, None]);
    }

    #[test]
    fn a_part_that_passes_a_barrier_again_came_there_the_first_time() {
        // To and fro at 0.5 m/s: it turns at 4.5 s and at 5.4 s. The first time barrier B sees it 10 mm late.
        let travel = |at: f64| match at {
            at if at < 4.5 => 0.5 * at,
            at if at < 5.4 => 2.25 - 0.5 * (at - 4.5),
            at => 1.8 + 0.5 * (at - 5.4),
        };
        let (script, origins) = of_rig_that(&travel, &[(1.01, 1.61)], &[(3.83, 4.41), (4.59, 5.19), (5.61, 6.21)]);
        assert_eq!(origins[0], [Origin::Part(0); 2]);
        assert_eq!(origins[1], [Origin::Part(0); 6]);
        assert_eq!(script.cuts.len(), 2);
    }

    /// Of three parts the last is taken away before barrier B, which sees three that bays have put behind barrier A, each some 0.2 to 0.5 m behind where
    /// one of A's is due.
    #[test]
    fn parts_from_elsewhere_do_not_make_a_belt_that_slips() {
        let a = [(1.01, 1.61), (4.01, 4.61), (7.01, 7.61)];
        let b = [(3.81, 4.41), (4.43, 5.03), (6.81, 7.41), (7.9, 8.5), (10.3, 10.9)];
        let (_, origins) = of_rig(&a, &b);
        let parts = |beam: usize| -> Vec<Origin> { origins[beam].iter().copied().step_by(2).collect() };
        assert_eq!(parts(0), [0, 1, 3].map(Origin::Part));
        assert_eq!(parts(1), [0, 2, 1, 4, 5].map(Origin::Part));
    }

    #[test]
    fn a_late_sensor_does_not_make_another_part() {
        // Barrier B comes on 56 ms late: the cut is shorter than the part.
        let (script, origins) = of_rig(&[(1.01, 1.61)], &[(3.87, 4.41)]);
        assert_eq!(origins, [[0, 0].map(Origin::Part).to_vec(), [0, 0].map(Origin::Part).to_vec()]);
        assert!(script.cuts.iter().all(|cut| cut.length == 0.3));
    }

    /// Barrier A sees each of five parts for 40 mm of the 0.3 m that it is long, and B as it is; of one that is taken out of A's beam elsewhere the way on is not
    /// known, and of two cuts alone nothing is said.
    #[test]
    fn a_sensor_that_sees_all_parts_late_does_not_stand_for_other_hands() {
        let cuts = |count: u32, (from, lasts): (f64, f64)| {
            let cut = |k: u32| (from + 6.0 * f64::from(k), from + lasts + 6.0 * f64::from(k));
            (0..count).map(cut).collect::<Vec<_>>()
        };
        let known = |count: u32, other: f64| {
            let mut a = cuts(count, (1.53, 0.08));
            a[0].1 += other;
            let (script, origins) = of_rig(&a, &cuts(count, (3.81, 0.6)));
            assert_eq!(
                origins[0].iter().step_by(2).collect::<Vec<_>>(),
                origins[1].iter().step_by(2).collect::<Vec<_>>()
            );
            script.cuts.iter().filter(|cut| cut.beam == 0 && cut.length == 0.3).count()
        };
        assert_eq!((known(5, 0.0), known(5, 0.2), known(2, 0.0)), (5, 4, 0));
    }

    #[test]
    fn what_came_from_elsewhere_is_a_part_of_its_own_and_what_was_taken_is_played_back() {
        // Nothing at A is 1.4 m before this; and it leaves the beam after 0.05 m, by other hands.
        let (script, origins) = of_rig(&[(1.01, 1.61)], &[(8.0, 8.1)]);
        assert_eq!(origins[1], [Origin::Part(1), Origin::Input]);
        let cut = script.cuts.iter().find(|cut| cut.part == 1).expect("its cut");
        assert!(cut.taken.is_some_and(|taken| (taken - 8.1).abs() < 0.02) && cut.ahead == 0.0);
    }

    #[test]
    fn how_long_a_part_is_says_the_bay_that_alone_can_have_put_it() {
        // It cuts both beams for 0.26 m: nearer to another part of the plant.
        let (a, b) = (Track::of_cuts(&[(1.01, 1.53)]), Track::of_cuts(&[(3.81, 4.33)]));
        let lengths = |fed: Option<(usize, f64)>| -> Vec<f64> {
            let geometry = Geometry { lengths: vec![0.24, 0.3], fed, ..Geometry::of_rig() };
            let (script, _) = assign(&geometry, [Some(&a), Some(&b)], &|at| 0.5 * at);
            script.cuts.iter().map(|cut| cut.length).collect()
        };
        assert_eq!(lengths(None), [0.24, 0.24]);
        assert_eq!(lengths(Some((0, 0.3))), [0.3, 0.3]);
    }

    #[test]
    fn a_bays_parts_may_all_be_of_another_length_than_declared() {
        // They cut both beams for 0.2 m.
        let lengths = |parts: u32| -> Vec<f64> {
            let all = |from: f64| {
                (0..parts).map(|k| (from + 6.0 * f64::from(k), from + 6.0 * f64::from(k) + 0.4)).collect::<Vec<_>>()
            };
            let (a, b) = (Track::of_cuts(&all(1.01)), Track::of_cuts(&all(3.81)));
            let geometry = Geometry { fed: Some((0, 0.3)), ..Geometry::of_rig() };
            let (script, _) = assign(&geometry, [Some(&a), Some(&b)], &|at| 0.5 * at);
            script.cuts.iter().map(|cut| cut.length).collect()
        };
        assert_eq!(lengths(3), [0.3; 6]);
        // One alone may be anything.
        assert!(lengths(1).iter().all(|length| length.is_infinite()), "{:?}", lengths(1));
    }
}
