//! What surrounded a device in a run, from what was recorded of it.
//!
//! - A belt: the parts that its barriers saw (see [`super::parts`]).
//! - A pusher: its beams as they were recorded. Parts come to it and go by the belts, which nobody asks here.
//! - A gripper: a part is sealed at its cups in those spans of suction in which vacuum came. That it never came is no evidence
//!   that the gripper is at fault: there may have been nothing to grip.

use std::sync::Arc;

use super::layout::Beside;
use super::parts::{self, Origin};
use super::seen::{Geometry, is_cut_for_too_long, middle};
use super::subject::{Run, SignalInfo, beam_of};
use super::track::{Edge, Track};
use super::way::Way;
use super::world::{Cut, Script, Surrounding, Told};
use super::{alone, coming};
use crate::device::{Device, Role, Surface};
use crate::plant::{ParameterValue, Parameters, Plant};
use crate::prototype::kind::KindDescriptor;

/// The parts that may come in a plant.
#[derive(Clone, Debug, Default)]
pub(super) struct Sizes {
    /// Length and width, m.
    pub each: Vec<[f64; 2]>,
    /// How far one may be off, as a share of it.
    pub tolerance: f64,
}

/// Every part that may come in this plant.
pub(super) fn part_sizes(plant: &Plant) -> Sizes {
    let tasks = plant.instances.iter().flat_map(|instance| &instance.tasks);
    let bays = tasks.filter(|task| task.kind.name == "kinetwin.LoadingBay");
    let named = bays.flat_map(|task| ["size", "loadSize"].map(|name| task.parameters.0.get(name))).flatten();
    let tolerance = named.clone().map(|parameter| parameter.tolerance).fold(0.0, f64::max);
    let made = named.filter_map(|parameter| match &parameter.value {
        ParameterValue::Numbers(numbers) if numbers.len() == 3 => Some([numbers[0], numbers[1]]),
        _ => None,
    });
    let standing = plant.parts.iter().map(|part| [part.size[0], part.size[1]]);
    let mut sizes: Vec<[f64; 2]> = made.chain(standing).filter(|size| size[0] > 0.0).collect();
    sizes.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sizes.dedup();
    Sizes { each: sizes, tolerance }
}

/// Sets a run's script, and what the edges of its barriers are to a score.
pub(super) fn surround(
    kind: &KindDescriptor,
    parameters: &Parameters,
    signals: &[SignalInfo],
    device: &dyn Device,
    sizes: &Sizes,
    (beside, run): (&Beside, &mut Run),
) {
    let script = match device.role() {
        Role::Carries(belt) => {
            let fed = beside.fed_alone(&belt.barriers);
            let geometry = Geometry {
                beams: belt.barriers,
                lengths: lengths(&belt.surface, &sizes.each),
                tolerance: tolerance(&belt.surface, sizes),
                lane: beside.lane.clone(),
                fed,
                put_front: beside.fed.filter(|_| fed.is_some()).map(|fed| fed.at + 0.5 * fed.length),
                hands: beside.hands.clone(),
            };
            run.part_lengths.clone_from(&geometry.lengths);
            of_belt(&geometry, signals, device, beside, run)
        }
        Role::Pushes(_) => of_pusher(signals, run),
        Role::Holds(cups) if !cups.always_sealed => of_gripper(kind, parameters, signals, run),
        _ => return,
    };
    run.script = Arc::new(script);
}

/// How far beside the middle of a curve a part may lie, m, and how finely that is told.
const ASIDE_M: f64 = 0.1;
const ASIDE_STEPS: i32 = 8;
/// Lengths nearer to one another than this are one, m.
const SAME_M: f64 = 2e-3;

/// How long parts cut a beam that lies across a belt, m of its way: by their length or by their width; on a curve, where nobody knows
/// how far from its middle they lie, by any of many.
fn lengths(surface: &Surface, sizes: &[[f64; 2]]) -> Vec<f64> {
    let along = |[length, width]: [f64; 2]| match *surface {
        Surface::Straight { .. } => vec![length],
        // Its front's inner corner meets the beam first, its rear's leaves it last.
        Surface::Curve { radius, .. } => {
            let aside = (-ASIDE_STEPS..=ASIDE_STEPS).map(|step| ASIDE_M * f64::from(step) / f64::from(ASIDE_STEPS));
            let inner = aside.map(|aside| radius + aside - 0.5 * width).filter(|inner| *inner > 0.0);
            inner.map(|inner| 2.0 * radius * (0.5 * length).atan2(inner)).collect()
        }
    };
    let mut lengths: Vec<f64> = sizes.iter().flat_map(|&[a, b]| [along([a, b]), along([b, a])]).flatten().collect();
    lengths.sort_by(f64::total_cmp);
    let apart = if matches!(surface, Surface::Straight { .. }) { 1e-6 } else { SAME_M };
    lengths.dedup_by(|a, b| (*a - *b).abs() < apart);
    lengths
}

/// How far a part's edges may be off because it lies askew or turns, m: measured on the line as its model has it, where boxes
/// come onto a curve askew, and leave it so; and because it is longer or shorter than it should be, a tolerance being two standard
/// deviations.
fn tolerance(surface: &Surface, sizes: &Sizes) -> f64 {
    let askew: f64 = match surface {
        Surface::Straight { .. } => 1e-3,
        Surface::Curve { .. } => 5e-3,
    };
    let longest = sizes.each.iter().flatten().copied().fold(0.0, f64::max);
    askew.hypot(0.5 * sizes.tolerance * longest)
}

/// The places of the barriers among the signals.
fn barriers(signals: &[SignalInfo]) -> [Option<usize>; 2] {
    [0, 1].map(|beam| signals.iter().position(|info| beam_of(info) == Some(beam)))
}

/// The parts on a belt.
fn of_belt(geometry: &Geometry, signals: &[SignalInfo], device: &dyn Device, beside: &Beside, run: &mut Run) -> Script {
    let places = barriers(signals);
    // By the device's own time: flags are late by what is common to all.
    let late = run.task.age_s + run.task.filter_s;
    let tracks: [Option<Track>; 2] = places.map(|place| Some(run.tracks[place?].as_ref()?.earlier(late)));
    let tracks: [Option<&Track>; 2] = [tracks[0].as_ref(), tracks[1].as_ref()];
    let Some(grid) = tracks.iter().flatten().next().map(|track| track.grid.clone()) else {
        return Script::default();
    };
    let nominal = Way { metres: alone::travel(device.boxed(), run, &grid.instants), instants: grid.instants.clone() };
    // A belt that is slower than its law brings parts to the second barrier when nobody expects them, as if they were others.
    let off = |way: &Way| mismatch((&geometry.beams, &geometry.lengths), tracks, way);
    let is_better = |way: &&Way| {
        off(way).zip(off(&nominal)).is_some_and(|(reported, law)| law > OFF_M && reported < MUCH_LESS * law)
    };
    let way = beside.way.as_ref().filter(is_better).unwrap_or(&nominal);
    let put = if geometry.fed.is_some() { beside.due.as_slice() } else { &[] };
    let ((script, origins), slipped) = reading_with_slip(geometry, tracks, way, put);
    let way = slipped.as_ref().unwrap_or(way);
    let put_front = geometry.put_front;
    let script = Script { beams: geometry.beams, put_front, put: put.to_vec(), way: Arc::new(way.clone()), ..script };
    let script = coming::told_beside(beside, way, script);
    for (place, origins) in places.into_iter().zip(origins) {
        if let Some(track) = place.and_then(|place| run.tracks[place].as_mut()) {
            track.origins = origins;
            track.tolerance = geometry.tolerance;
        }
    }
    script
}

/// How many parts of a known length a barrier must show when it is read the other way round, and how many times more than as it is; how many
/// where it shows none as it is and no part cuts a beam for so long, and all that it then shows are.
const ENOUGH: usize = 3;
const FAR_MORE: usize = 2;
const ENOUGH_WHERE_NONE_FIT: usize = 2;

/// What the barriers of a belt saw, by a script and by what its edges are.
type Reading = (Script, [Vec<Origin>; 2]);

/// What friction may give a belt or parts that slip, m/s²; the least slip first.
const GRIPS: [f64; 13] = [1.0, 0.8, 0.65, 0.5, 0.4, 0.33, 0.27, 0.23, 0.2, 0.16, 0.13, 0.1, 0.08];
/// Between which of them, as factors of the likeliest.
const NEARER: [f64; 6] = [0.88, 0.92, 0.96, 1.04, 1.08, 1.12];
/// Which share of the cuts of parts that may have passed both barriers must be known for a slip to be needless, or to be believed; and of how many
/// parts.
const KNOWN: f64 = 0.8;
const ENOUGH_KNOWN: usize = 3;
/// Which share of what is not known without slip may be so with it, and of how far parts are off.
const STILL_UNKNOWN: f64 = 0.5;
const STILL_OFF: f64 = 0.5;

/// The parts on a belt as its barriers show them; and where they slip so far that most are not known as if each were where the belt took it, or that
/// they are far from where it took them, the way that they went. Parts that slip each take the belt's speed where they are put, what lies on a belt
/// that slips does not.
fn reading_with_slip(
    geometry: &Geometry,
    tracks: [Option<&Track>; 2],
    way: &Way,
    put: &[f64],
) -> (Reading, Option<Way>) {
    let plain = likeliest_reading(geometry, tracks, &|at| way.at(at));
    let known = known(&plain);
    let off = |way: &Way| mismatch((&geometry.beams, &geometry.lengths), tracks, way);
    let came = |beam: usize| plain.1[beam].len() / 2;
    let could = 2 * came(0).min(came(1));
    let is_enough = |known: usize| known as f64 >= KNOWN * could as f64;
    let plainly_off = off(way).filter(|off| *off > OFF_M);
    if could < 2 * ENOUGH_KNOWN || is_enough(known) && plainly_off.is_none() {
        return (plain, None);
    }
    let try_out = |grip: f64, are_put: bool| {
        let put = if are_put { put } else { &[] };
        let slipped = way.of_parts(grip, put);
        let reading = parts::assign(geometry, tracks, &|at| slipped.at(at));
        let off = off(&slipped).unwrap_or(f64::INFINITY);
        let known = self::known(&reading);
        let others = reading.0.cuts.len() - known;
        Slipped { grip, are_put, known, others, off, reading, way: slipped }
    };
    // Where nothing is put both are one.
    let either = [true, false].into_iter().filter(|are_put| !are_put || !put.is_empty());
    let courses = either.flat_map(|are_put| GRIPS.map(|grip| try_out(grip, are_put)));
    let Some(best) = courses.min_by(Slipped::by_fit) else { return (plain, None) };
    let nearer = NEARER.map(|factor| try_out(factor * best.grip, best.are_put));
    let best = nearer.into_iter().fold(best, |best, other| if other.by_fit(&best).is_lt() { other } else { best });
    let unknown = |known: usize| could.saturating_sub(known) as f64;
    let explains = is_enough(best.known) && unknown(best.known) <= STILL_UNKNOWN * unknown(known);
    let fits = best.known >= known && plainly_off.is_some_and(|off| best.off <= STILL_OFF * off);
    if !is_enough(known) && explains || fits { (best.reading, Some(best.way)) } else { (plain, None) }
}

/// A reading of what slips.
struct Slipped {
    /// What friction gives, m/s².
    grip: f64,
    /// Whether parts take the belt's speed where they are put.
    are_put: bool,
    /// How many cuts are known, and how many there are beside those.
    known: usize,
    others: usize,
    /// See [`mismatch`].
    off: f64,
    reading: Reading,
    way: Way,
}

impl Slipped {
    /// The better first.
    fn by_fit(&self, other: &Slipped) -> std::cmp::Ordering {
        other.known.cmp(&self.known).then(self.others.cmp(&other.others)).then(self.off.total_cmp(&other.off))
    }
}

/// How many cuts there are of parts that both barriers saw, and that are as long as a part.
fn known((script, origins): &Reading) -> usize {
    let seen_by = |beam: usize, part: usize| origins[beam].contains(&Origin::Part(part));
    let is_known = |cut: &&Cut| cut.length.is_finite() && seen_by(0, cut.part) && seen_by(1, cut.part);
    script.cuts.iter().filter(is_known).count()
}

/// The parts on a belt as its barriers show them; where one shows next to nothing that is as long as a part, and the gaps between are,
/// its signal is inverted: then what it stands for is told, so that the signal is off and not the parts.
fn likeliest_reading(geometry: &Geometry, tracks: [Option<&Track>; 2], travel: &dyn Fn(f64) -> f64) -> Reading {
    let counted = |read: &Reading, beam: usize| {
        let of_beam = || read.0.cuts.iter().filter(|cut| cut.beam == beam);
        (of_beam().filter(|cut| cut.length.is_finite()).count(), of_beam().count())
    };
    let mut best = parts::assign(geometry, tracks, travel);
    for beam in [0, 1] {
        let (plainly, _) = counted(&best, beam);
        let Some(track) = tracks[beam] else { continue };
        let inverted = track.inverted();
        let mut read = tracks;
        read[beam] = Some(&inverted);
        let other = parts::assign(geometry, read, travel);
        let (fitting, all) = counted(&other, beam);
        let none_fits = || plainly == 0 && is_cut_for_too_long(geometry, track, travel);
        let all_fit = fitting >= ENOUGH_WHERE_NONE_FIT && fitting == all;
        if fitting >= ENOUGH.max(FAR_MORE * plainly + 1) || all_fit && none_fits() {
            best = other;
        }
    }
    best
}

/// How much nearer a belt's own report of its speed must bring what came to its barriers than its law does.
const MUCH_LESS: f64 = 0.5;
/// From which mismatch on a law may take one part for another, m.
const OFF_M: f64 = 0.02;
/// Beyond this much two sightings are of two parts, m.
const APART_M: f64 = 0.15;

/// How far from the way between its beams a belt went between what came to one and what came to the other next, and from the length of a part
/// while one cut a beam, m, in the mean of all; `None` where there are fewer than three of them.
fn mismatch((beams, lengths): (&[Option<f64>; 2], &[f64]), tracks: [Option<&Track>; 2], way: &Way) -> Option<f64> {
    const ENOUGH: usize = 3;
    let instant = |track: &Track, edge: &Edge| way.at(middle(track, edge.index));
    let came = |track: Option<&Track>| -> Vec<f64> {
        let Some(track) = track else { return Vec::new() };
        track.edges.iter().filter(|edge| edge.to != 0.0).map(|edge| instant(track, edge)).collect()
    };
    let [here, there] = tracks.map(came);
    let between = beams[0].zip(beams[1]).map(|(first, second)| second - first);
    // Where a belt turns, that is further than where it is at last.
    let gone = way.metres.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let off = |from: &f64| {
        // What is still under way has come nowhere.
        let between = between.filter(|between| from + between <= gone)?;
        (!there.is_empty()).then(|| there.iter().map(|to| (to - from - between).abs()).fold(APART_M, f64::min))
    };
    let passed = |track: &Track| -> Vec<f64> {
        let pairs = track.edges.windows(2).filter(|pair| pair[0].to != 0.0 && pair[1].to == 0.0);
        let gone = pairs.map(|pair| instant(track, &pair[1]) - instant(track, &pair[0]));
        // What the belt takes back the way it came, or hands take out of the beam, has gone no part's length.
        let least = 0.5 * lengths.iter().copied().fold(f64::INFINITY, f64::min);
        gone.filter(|gone| *gone > least)
            .map(|gone| lengths.iter().map(|length| (gone - length).abs()).fold(APART_M, f64::min))
            .collect()
    };
    let all: Vec<f64> = here.iter().filter_map(off).chain(tracks.into_iter().flatten().flat_map(passed)).collect();
    (all.len() >= ENOUGH).then(|| all.iter().sum::<f64>() / all.len() as f64)
}

fn of_pusher(signals: &[SignalInfo], run: &mut Run) -> Script {
    let mut script = Script::default();
    for (beam, place) in barriers(signals).into_iter().enumerate() {
        let Some(track) = place.and_then(|place| run.tracks[place].as_mut()) else { continue };
        let what = if beam == 0 { Surrounding::BarrierA } else { Surrounding::BarrierB };
        script.told.push(Told { at: 0.0, what, is_on: track.initial != 0.0 });
        for edge in &track.edges {
            script.told.push(Told { at: middle(track, edge.index), what, is_on: edge.to != 0.0 });
        }
        track.origins = vec![Origin::Input; track.edges.len()];
    }
    script.told.sort_by(|a, b| a.at.total_cmp(&b.at));
    script
}

fn of_gripper(kind: &KindDescriptor, parameters: &Parameters, signals: &[SignalInfo], run: &mut Run) -> Script {
    let mut script = Script::default();
    let vacuum = signals.iter().position(|info| info.property == "vacuumOn");
    let Some(track) = vacuum.and_then(|place| run.tracks[place].as_ref()) else { return script };
    let came: Vec<f64> =
        track.edges.iter().filter(|edge| edge.to != 0.0).map(|edge| track.grid.instants[edge.index]).collect();
    let suction = kind.port("suctionOn");
    let drawn = run.commands.iter().filter(|(port, _)| Some(*port) == suction);
    let changes: Vec<(f64, bool)> = drawn.map(|(_, told)| (told.at, told.value != 0.0)).collect();
    for (at, (from, is_on)) in changes.iter().enumerate() {
        let until = changes.get(at + 1).map_or(f64::INFINITY, |next| next.0);
        // A late report of it still belongs to this span.
        let until = until + parameters.number("releaseTime");
        let came_now = *is_on && came.iter().any(|came| came > from && *came <= until);
        if *is_on {
            script.told.push(Told { at: *from, what: Surrounding::Sealed, is_on: came_now });
        }
    }
    script
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At 0.5 m/s a part of 0.3 m takes 0.6 s through a beam, and 2.8 s to the next. One that has not come there by the end is not amiss; one
    /// that came 0.1 m late is, also where the belt has turned back since.
    #[test]
    fn what_is_still_under_way_is_not_amiss() {
        let here = Track::of_cuts(&[(1.0, 1.6), (18.0, 18.6)]);
        let off = |there: &Track, instants: &[f64], metres: &[f64]| {
            let way = Way { instants: instants.to_vec(), metres: metres.to_vec() };
            mismatch((&[Some(0.3), Some(1.7)], &[0.3]), [Some(&here), Some(there)], &way).expect("parts enough")
        };
        let in_time = Track::of_cuts(&[(3.8, 4.4)]);
        assert!(off(&in_time, &[0.0, 20.0], &[0.0, 10.0]) < OFF_M);
        let late = Track::of_cuts(&[(4.0, 4.6), (21.0, 21.6)]);
        assert!(off(&late, &[0.0, 22.0], &[0.0, 11.0]) > OFF_M);
        assert!(off(&late, &[0.0, 22.0, 44.0], &[0.0, 11.0, 0.0]) > OFF_M);
    }

    /// Every 6 s a belt runs at 0.5 m/s for 3 s and stands for 3 s; what lies on it follows 0.25 m/s². A part comes to the first beam 0.1 s before a
    /// stop, and has slid out of that 0.59 s after it; it comes to the second one 0.3 s before the next stop, and slides out of that. By the belt's way
    /// it cuts them for 50 mm and for 0.15 m.
    #[test]
    fn parts_that_slip_past_a_barrier_while_the_belt_stands_are_known_again() {
        let instants: Vec<f64> = (0..=3000).map(|k| 0.02 * f64::from(k)).collect();
        let gone = |at: f64| 1.5 * (at / 6.0).floor() + 0.5 * (at % 6.0).min(3.0);
        let way = Way { metres: instants.iter().map(|at| gone(*at)).collect(), instants };
        let cuts =
            |from: f64, to: f64| (1..6).map(|k| 6.0 * f64::from(k)).map(|at| (at + from, at + to)).collect::<Vec<_>>();
        let (a, b) = (Track::of_cuts(&cuts(2.9, 3.5858)), Track::of_cuts(&cuts(8.7, 9.3267)));
        let geometry = Geometry::of_rig();
        let plain = likeliest_reading(&geometry, [Some(&a), Some(&b)], &|at| way.at(at));
        let (slipped, course) = reading_with_slip(&geometry, [Some(&a), Some(&b)], &way, &[]);
        assert_eq!((known(&plain), known(&slipped), course.is_some()), (0, 10, true));
    }

    /// Every 9 s a belt runs at 0.2 m/s for 5 s and at 0.5 m/s for 4 s; what lies on it follows 0.5 m/s², and is 90 mm further back while that is
    /// faster. Seen by the one beam at 0.2 m/s and by the other at 0.5 m/s, each part is as long as it should be, and late.
    #[test]
    fn parts_that_come_too_late_though_they_are_known_slip() {
        let instants: Vec<f64> = (0..=3150).map(|k| 0.02 * f64::from(k)).collect();
        let gone = |at: f64| 3.0 * (at / 9.0).floor() + 0.2 * (at % 9.0) + 0.3 * (at % 9.0 - 5.0).max(0.0);
        let way = Way { metres: instants.iter().map(|at| gone(*at)).collect(), instants };
        let cuts =
            |from: f64, to: f64| (1..6).map(|k| 9.0 * f64::from(k)).map(|at| (at + from, at + to)).collect::<Vec<_>>();
        let (a, b) = (Track::of_cuts(&cuts(3.0, 4.5)), Track::of_cuts(&cuts(7.18, 7.78)));
        let geometry = Geometry::of_rig();
        let plain = likeliest_reading(&geometry, [Some(&a), Some(&b)], &|at| way.at(at));
        let (slipped, course) = reading_with_slip(&geometry, [Some(&a), Some(&b)], &way, &[]);
        assert_eq!((known(&plain), known(&slipped)), (10, 10));
        let course = course.expect("parts slip");
        assert!((course.at(16.18) - course.at(12.0) - 1.4).abs() < 5e-3, "{}", course.at(16.18) - course.at(12.0));
        // As they do not where each comes as the belt takes it.
        let b = Track::of_cuts(&cuts(7.0, 7.6));
        assert_eq!(reading_with_slip(&geometry, [Some(&a), Some(&b)], &way, &[]).1, None);
    }

    #[test]
    fn an_inverted_barrier_is_read_the_other_way_round() {
        let geometry = Geometry::of_rig();
        let came = |start: f64| [0.0, 6.0, 12.0, 18.0].map(|at| (start + at, start + at + 0.6));
        let (a, b) = (Track::of_cuts(&came(1.01)), Track::of_cuts(&came(3.81)));
        let plain = likeliest_reading(&geometry, [Some(&a), Some(&b)], &|at| 0.5 * at);
        let other = likeliest_reading(&geometry, [Some(&a.inverted()), Some(&b)], &|at| 0.5 * at);
        assert_eq!(plain.0.cuts.len(), 8);
        assert_eq!(plain.0.cuts, other.0.cuts);
    }

    /// Two parts are enough where a barrier is cut as far as no part is long; one is not, nor are two between which a part could have passed.
    #[test]
    fn a_barrier_that_hardly_any_part_passes_is_read_the_other_way_round() {
        let geometry = Geometry::of_rig();
        let read = |cuts: &[(f64, f64)]| {
            let inverted = Track::of_cuts(cuts).inverted();
            let (script, _) = likeliest_reading(&geometry, [Some(&inverted), None], &|at| 0.5 * at);
            script
                .cuts
                .iter()
                .filter(|cut| cut.beam == 0 && cut.length.is_finite())
                .map(|cut| cut.from)
                .collect::<Vec<_>>()
        };
        assert_eq!(read(&[(19.01, 19.61), (41.01, 41.61)]).len(), 2);
        assert!(read(&[(19.01, 19.61)]).is_empty());
        assert_eq!(read(&[(19.01, 19.61), (20.21, 20.81)]).len(), 1);
    }
}
