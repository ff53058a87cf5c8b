//! Where the search for an effect's parameters begins.
//!
//! Never at the nominal value, where the effect does nothing and the deviance has no slope: a limit begins below what the
//! device does, a time above 0. What the recording itself shows (how late the edges are, how far a level lies off) is a start as
//! well.

use std::f64::consts::TAU;

use super::candidate::{Candidate, Free};
use super::scales::Scales;
use super::{refresh, rhythm, scan};
use crate::effect::EffectParameter;
use crate::gap::fit::Range;
use crate::gap::schedule::PART_SPACING;
use crate::gap::statistics::{quantile, span};
use crate::gap::{Predicted, Prediction, Score, Subject};
use crate::plant::{EffectPlace, ParameterValue};
use crate::prototype::kind::PortType;
use crate::value::Quantity;

/// What is known before the search.
#[derive(Clone, Copy)]
pub struct Clues<'a> {
    pub subject: &'a Subject,
    pub nominal: &'a Prediction,
    pub score: &'a Score,
    pub scales: Scales,
    pub component: Option<&'static str>,
}

/// How often a link is refreshed at the most, s: what stands for less shows in no report.
const SHORTEST_WINDOW_S: f64 = 1e-4;

/// From which value on a limit is taken to limit nothing.
pub const UNLIMITED: f64 = 1e8;
/// The shortest time in which a drive whose jerk is limited reaches its acceleration, s: what takes it less shows in no report.
const STEEPEST_S: f64 = 1e-5;
/// How fast what hangs on a spring swings where the search for it begins, rad/s, and how fast it may.
const SWINGS: &[f64] = &[7.0, 14.0, 28.0, 56.0, 112.0, 224.0, 448.0, 896.0, 1792.0];
const STIFFEST: f64 = 3000.0;
/// How many times as long as a flag stays it must come later never to come.
const NEVER_COMES: f64 = 1.05;
/// How rarely a flag is looked at that is never seen, s.
const RARELY_S: [f64; 6] = [4.0, 5.0, 6.0, 7.0, 8.5, 10.0];
/// How long vacuum holds where the search for a leak begins, s.
const HOLDS_S: &[f64] = &[0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.3, 1.7, 2.2, 3.0, 5.0, 10.0];
/// The longest time that is searched for, s.
const LONGEST_S: f64 = 3.0;
/// Which ratios of a cushion are tried for how late strokes are, and which quantiles of that.
const CUSHION_RATIOS: [f64; 7] = [0.8, 0.6, 0.45, 0.35, 0.25, 0.17, 0.1];
const CUSHION_LATE: [f64; 2] = [0.5, 0.9];
/// The most starts of one candidate.
const MOST: usize = 48;

/// Ratios of two units that are mistaken for one another. (An inch is 25.4 mm and a foot 0.3048 m: ISO 80000-3:2019, annex.)
const UNITS: &[f64] = &[
    1000.0,
    1e-3,
    100.0,
    0.01,
    10.0,
    0.1,
    60.0,
    1.0 / 60.0,
    57.295_779_513_082_32,
    0.017_453_292_519_943_295,
    9.549_296_585_513_72,
    0.104_719_755_119_659_77,
    3.6,
    1.0 / 3.6,
    // Inches in millimetres, centimetres and metres, feet, turns.
    25.4,
    1.0 / 25.4,
    2.54,
    1.0 / 2.54,
    1e3 / 25.4,
    0.025_4,
    1.0 / 0.304_8,
    0.304_8,
    TAU,
    1.0 / TAU,
];

/// The candidate with its parameters: one for each choice among options, the others free.
pub fn of(base: Candidate, clues: &Clues<'_>) -> Vec<Candidate> {
    match base.effect.id {
        "wrong-unit" => return fixed(base, "factor", UNITS),
        "stuck" => return stuck(base, clues),
        "once-per-revolution-error" | "position-dependent-friction" => return scanned(base, clues),
        _ => {}
    }
    let cushions = (base.effect.id == "end-cushioning").then(|| cushions(clues));
    let mut candidates = vec![base];
    for parameter in candidates[0].effect.parameters {
        if parameter.options.is_empty() {
            for candidate in &mut candidates {
                add(candidate, parameter, clues);
            }
        } else {
            candidates =
                candidates.into_iter().flat_map(|base| fixed(base, parameter.name, parameter.options)).collect();
        }
    }
    for candidate in &mut candidates {
        candidate.starts.extend(cushions.iter().flatten().cloned());
    }
    candidates
}

/// Cushions' lengths and ratios that all make a stroke as late as it is: a way of L at r times the speed v takes L/v·(1/r − 1) longer.
/// Along them only strokes that turn round within tell one from the other, and no slope leads there.
fn cushions(clues: &Clues<'_>) -> Vec<Vec<f64>> {
    let number = |name: &str| match clues.subject.parameters.0.get(name).map(|parameter| &parameter.value) {
        Some(ParameterValue::Number(number)) => *number,
        _ => 0.0,
    };
    let late = late(clues);
    let speed = 0.5 * (number("extendSpeed") + number("retractSpeed"));
    let with = |ratio: f64, late: f64| late * speed * ratio / (1.0 - ratio);
    let each = CUSHION_LATE
        .map(|share| quantile(&late, share))
        .into_iter()
        .flat_map(|late| CUSHION_RATIOS.map(|ratio| vec![with(ratio, late), ratio]));
    each.filter(|start| (1e-6..number("stroke")).contains(&start[0])).collect()
}

fn fixed(base: Candidate, name: &'static str, values: &[f64]) -> Vec<Candidate> {
    let with = |value: &f64| {
        let mut candidate = base.clone();
        candidate.fixed.push((name, *value));
        candidate
    };
    values.iter().map(with).collect()
}

/// A signal that stands still: where the recording shows it, or, of a command, at 0.
fn stuck(base: Candidate, clues: &Clues<'_>) -> Vec<Candidate> {
    let signals = clues.subject.signals.iter().enumerate();
    let report =
        signals.filter(|(_, info)| Some(info.property.as_str()) == clues.component).map(|(signal, _)| signal).next();
    let shown = report.and_then(|signal| {
        let track = clues.subject.runs.iter().find_map(|run| run.tracks[signal].as_ref())?;
        // What still moves is not stuck.
        let last = track.values.last().copied();
        let is_still = last
            .is_some_and(|last| track.values.iter().filter(|value| **value == last).count() * 2 > track.values.len());
        match last {
            Some(last) => is_still.then_some(last),
            None => track.edges.is_empty().then_some(track.initial),
        }
    });
    if let Some(since) = report.and_then(|signal| stuck_since(base.clone(), signal, clues)) {
        return vec![since];
    }
    match (report, shown) {
        (Some(_), None) => Vec::new(),
        (_, value) => fixed(Candidate { fixed: vec![("from", 0.0)], ..base }, "value", &[value.unwrap_or(0.0)]),
    }
}

/// A flag of one recording that changed before it stuck: in what it shows at the end, either from its last change on, which nothing
/// but its getting stuck made, or from a later instant.
fn stuck_since(base: Candidate, signal: usize, clues: &Clues<'_>) -> Option<Candidate> {
    let [run] = clues.subject.runs.as_slice() else { return None };
    let track = run.tracks[signal].as_ref()?;
    let last = track.edges.last()?;
    let instant = |index: usize| track.grid.instants.get(index).copied();
    let (seen, before) = (instant(last.index)?, instant(last.index.checked_sub(1)?)?);
    // From when on the prediction shows what it never became.
    let missed = clues.nominal.runs.first().and_then(|predicted| match &predicted[signal] {
        Predicted::Edges { edges, .. } => edges.iter().map(|edge| edge.at).find(|at| *at > seen),
        _ => None,
    })?;
    let cycle = track.grid.cycle.max(1e-3);
    let range = Range { least: (before - 2.0 * cycle).max(0.0), greatest: run.ends, scale: cycle };
    Some(Candidate {
        fixed: vec![("value", last.to)],
        free: vec![Free { name: "from", range, is_time: true }],
        starts: vec![vec![0.5 * (before + seen)], vec![0.5 * (seen + missed)]],
        ..base
    })
}

/// Effects that repeat along the way: the scan says with which period.
fn scanned(base: Candidate, clues: &Clues<'_>) -> Vec<Candidate> {
    let is_friction = base.effect.id == "position-dependent-friction";
    let found = scan::periods(clues, is_friction, 3);
    if found.is_empty() {
        return Vec::new();
    }
    let scale = if is_friction { clues.scales.effort } else { clues.scales.travel };
    let period = clues.scales.travel;
    let free = vec![
        Free { name: "amplitude", range: Range { least: 0.0, greatest: scale, scale: 0.01 * scale }, is_time: false },
        Free {
            name: "period",
            range: Range { least: 1e-5, greatest: 10.0 * period, scale: 1e-3 * period },
            is_time: false,
        },
        Free { name: "phase", range: Range { least: -7.0, greatest: 7.0, scale: 0.3 }, is_time: false },
    ];
    let starts = found.iter().map(|wave| vec![wave.amplitude.clamp(1e-9, scale), wave.period, wave.phase]).collect();
    vec![Candidate { free, starts, ..base }]
}

/// Adds a free parameter: every start so far with each of its own.
fn add(candidate: &mut Candidate, parameter: &'static EffectParameter, clues: &Clues<'_>) {
    let (range, mut values) = parameter_starts(candidate, parameter, clues);
    let is_of_edges = candidate.effect.id == "stale-hold" && !clues.subject.has_levels();
    if is_of_edges && candidate.place == EffectPlace::ReportLink {
        let shown = rhythm::period(clues);
        candidate.shown.extend(shown.map(|period| vec![period]));
        values.extend(shown);
    }
    // What a slow device has little of may begin below what an effect takes: it would not even be built.
    values.iter_mut().for_each(|value| *value = value.clamp(range.least, range.greatest));
    values.dedup();
    let is_time = parameter.quantities.contains(&Quantity::Time);
    candidate.free.push(Free { name: parameter.name, range, is_time });
    let starts =
        candidate.starts.iter().flat_map(|start| values.iter().map(|value| [start.as_slice(), &[*value]].concat()));
    candidate.starts = starts.take(MOST).collect();
}

fn parameter_starts(candidate: &Candidate, parameter: &EffectParameter, clues: &Clues<'_>) -> (Range, Vec<f64>) {
    let (least, greatest) = parameter.range;
    let scale = parameter.quantities.iter().find_map(|quantity| clues.scales.of_quantity(*quantity));
    let unit = scale.unwrap_or_else(|| signal_scale(clues));
    let range = |least: f64, greatest: f64, scale: f64| Range { least, greatest, scale };
    let times = |shares: &[f64], of: f64| shares.iter().map(|share| share * of).collect::<Vec<f64>>();
    if candidate.effect.id == PART_SPACING {
        let longest = greatest.min(LONGEST_S);
        return (range(-longest, longest, 0.02), spacing_starts(clues, longest));
    }
    if parameter.quantities.contains(&Quantity::Time) {
        let longest = greatest.min(LONGEST_S);
        let mut starts: Vec<f64> = time_starts(clues).into_iter().filter(|time| *time < longest).collect();
        let stay = match candidate.effect.id {
            "on-delay" => longest_stay(clues, true),
            "off-delay" => longest_stay(clues, false),
            // A flag has to stand as long as that.
            "input-filter" if candidate.place == EffectPlace::ReportLink => longest_stay(clues, true),
            _ => None,
        };
        let never = stay.map(|stay| (NEVER_COMES * stay).min(greatest));
        let mut longest = never.map_or(longest, |never| longest.max(2.0 * never).min(greatest));
        starts.extend(never);
        if candidate.effect.id == "stale-hold" && candidate.place == EffectPlace::ReportLink {
            starts.extend(refresh::periods(clues, longest));
            // A flag that is never told may be looked at only while it is off.
            if longest_stay(clues, true).is_some() {
                longest = greatest;
                starts.extend(RARELY_S.iter().filter(|period| **period <= greatest));
            }
        }
        // A replay takes as many steps as there are windows.
        let least = if candidate.effect.id == "stale-hold" { least.max(SHORTEST_WINDOW_S) } else { least };
        return (range(least, longest, 0.02), starts);
    }
    if let ("compliance", name) = (candidate.effect.id, parameter.name) {
        // Of two masses, half of the inertia each, a quarter swings; where no inertia is known a kilogram does.
        let mass = if clues.scales.inertia == 1.0 { 1.0 } else { 0.25 * clues.scales.inertia };
        let stiffness = |turn: &f64| mass * turn * turn;
        return match name {
            "stiffness" => {
                let starts = SWINGS.iter().rev().map(stiffness).collect();
                (range(least, stiffness(&STIFFEST), 0.1 * stiffness(&SWINGS[2])), starts)
            }
            _ => (range(0.0, mass * STIFFEST, 0.1 * mass * SWINGS[2]), times(&[2.0, 20.0, 200.0], mass)),
        };
    }
    if parameter.nominal >= UNLIMITED {
        // Above what the device does it would do nothing. What it drives with between two reports may be more than they show.
        const PEAKS: [f64; 8] = [1.04, 1.08, 1.14, 1.22, 1.35, 1.5, 1.75, 2.0];
        let is_of_force = parameter.quantities.iter().any(|of| [Quantity::Force, Quantity::Torque].contains(of));
        let peaks: &[f64] = if is_of_force { &PEAKS } else { &[] };
        let unit = if parameter.quantities.is_empty() { clues.scales.acceleration / STEEPEST_S } else { unit };
        let shares: &[f64] = match parameter.quantities.is_empty() {
            true => &[0.3, 0.1, 0.01, 1e-3, 1e-4, 3e-5],
            false => &[0.999, 0.99, 0.9, 0.7, 0.4, 0.2, 0.1, 0.03, 0.01],
        };
        let most = peaks.last().map_or(1.02, |peak| *peak);
        return (range(least, most * unit, 0.05 * unit), times(&[peaks, shares].concat(), unit));
    }
    match (candidate.effect.id, parameter.name) {
        ("second-order-lag", "natural_frequency") => (range(least, 1e5, 10.0), vec![10.0, 50.0, 300.0, 2000.0, 2e4]),
        ("second-order-lag", "damping") => (range(0.05, 20.0, 0.2), vec![0.3, 1.0, 2.0]),
        ("stribeck-friction", "velocity") => {
            let most = clues.scales.speed;
            (range(1e-3, most.max(2e-3), 0.02 * most), times(&[0.003, 0.03, 0.2], most))
        }
        // How long vacuum holds: a leak that lets go after any grip's end does nothing.
        ("leak", _) => (range(least, 100.0, 0.1), HOLDS_S.iter().rev().map(|hold| 1.0 / hold).collect()),
        // As a share of what the bay declares.
        ("part-length-error", _) => {
            let unit = clues.subject.bay.as_ref().map_or(unit, |bay| bay.declared);
            let starts = times(&[0.01, 0.03, 0.1, 0.25, -0.01, -0.03, -0.1, -0.25], unit);
            (range(least.max(-0.9 * unit), greatest.min(2.0 * unit), 0.01 * unit), starts)
        }
        // Each time that a joint lets go is an event of its own, and no slope leads from one to the next.
        ("breakaway-friction", _) => {
            const FINER: f64 = 1.4;
            let shares =
                std::iter::successors(Some(1e-4), |share| Some(FINER * share)).take_while(|share| *share < 0.6);
            (range(least, greatest.min(10.0 * unit), 0.01 * unit), shares.map(|share| share * unit).collect())
        }
        ("gravity", "angle") => (range(-3.2, 3.2, 0.3), vec![0.0, 1.6, -1.6, 3.1]),
        ("clock-drift", _) => {
            // By the end of a minute a clock that is slow by a thousandth more is late by as much as a short motion takes.
            (range(least, greatest, 1e-4), vec![1e-6, 1e-5, 1e-4, 1e-3, 2e-3, 4e-3, 6e-3, 8e-3, 1e-2])
        }
        ("drift", _) => (range(-unit, unit, 1e-3 * unit), times(&[1e-4, -1e-4, 1e-2, -1e-2], unit)),
        // Of a short way only the greater part is limited by its speed: a little less of that changes nothing.
        ("direction-asymmetry", _) => {
            (range(least, greatest, 0.02), vec![5e-4, -5e-4, 0.02, -0.02, 0.07, -0.07, 0.13, -0.13, 0.2, -0.2])
        }
        ("dead-band", "width") => match speeds_asked(clues).as_slice() {
            // A loop about a band is off by its width, whichever that is, and moves on or off at instants that leap with it.
            [] => {
                let shares = [3e-4, 1e-3, 3e-3, 6e-3, 0.01, 0.015, 0.02, 0.03, 0.05, 0.1, 0.2, 0.4];
                (range(least, greatest.min(10.0 * unit), 0.01 * unit), times(&shares, unit))
            }
            // Of a drive that is asked for speeds half of the band is one: that below it is not done, and of those above it, if it shifts, so much is missing.
            asked @ [.., fastest] => {
                const SHARES: [f64; 13] = [3e-4, 1e-3, 3e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95];
                const SLOWEST: usize = 6;
                let widest = 2.0 * fastest;
                let slowest = asked.iter().take(SLOWEST).map(|speed| 2.0 * 1.02 * speed);
                let starts = times(&SHARES, widest).into_iter().chain(slowest).collect();
                (range(least, greatest.min(1.1 * widest), 0.01 * widest), starts)
            }
        },
        ("offset", _) => (range(least, greatest, 0.01 * unit), vec![middle_difference(clues)]),
        _ if parameter.nominal == 1.0 => {
            (range(least, greatest, 0.02), vec![0.999, 1.001, 0.99, 1.01, 0.9, 1.1, 0.6, 1.6])
        }
        _ if scale.is_none() && parameter.quantities.contains(&Quantity::One) && greatest <= 10.0 => {
            let shares: &[f64] =
                if least < 0.0 { &[5e-4, -5e-4, 0.02, -0.02, 0.2, -0.2] } else { &[5e-4, 0.01, 0.05, 0.2] };
            (range(least, greatest, 0.02), shares.to_vec())
        }
        _ => {
            let shares: &[f64] = match least < 0.0 {
                true => &[0.003, -0.003, 0.03, -0.03, 0.3, -0.3],
                false => &[3e-4, 0.003, 0.02, 0.1, 0.4],
            };
            (range(least.max(-10.0 * unit), greatest.min(10.0 * unit), 0.01 * unit), times(shares, unit))
        }
    }
}

/// Which speeds a drive is asked for that is asked for nothing else, without their signs, the slowest first.
fn speeds_asked(clues: &Clues<'_>) -> Vec<f64> {
    let commands = || clues.subject.runs.iter().flat_map(|run| &run.commands);
    let asks = |port: usize, wanted: [Quantity; 2]| {
        clues.subject.kind.ports[port].quantities.iter().any(|quantity| wanted.contains(quantity))
    };
    if commands().any(|(port, _)| asks(*port, [Quantity::Length, Quantity::Angle])) {
        return Vec::new();
    }
    let speeds = commands().filter(|(port, _)| asks(*port, [Quantity::Velocity, Quantity::AngularVelocity]));
    let mut speeds: Vec<f64> = speeds.map(|(_, told)| told.value.abs()).filter(|speed| *speed > 0.0).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// How large the signal of the component is.
fn signal_scale(clues: &Clues<'_>) -> f64 {
    let mut scale: f64 = 0.0;
    for (signal, info) in clues.subject.signals.iter().enumerate() {
        if clues.component.is_none_or(|component| component == info.property) {
            let tracks = clues.subject.runs.iter().filter_map(|run| run.tracks[signal].as_ref());
            scale = tracks.map(|track| span(&track.values)).filter(|span| span.is_finite()).fold(scale, f64::max);
        }
    }
    if scale > 0.0 { scale } else { clues.scales.travel }
}

/// How far the component's level lies off in the middle.
fn middle_difference(clues: &Clues<'_>) -> f64 {
    let is_meant = |signal: usize| clues.component.is_none_or(|name| clues.subject.signals[signal].property == name);
    let levels =
        clues.score.signals.iter().filter(|signal| is_meant(signal.signal)).filter_map(|signal| signal.level.as_ref());
    let differences: Vec<f64> = levels.flat_map(|level| level.difference.iter().copied()).collect();
    if differences.is_empty() { 0.01 * clues.scales.travel } else { quantile(&differences, 0.5) }
}

/// How much longer than it should be a bay's interval may be, either way, s: what would bring one of its next parts to where one came, and
/// from milliseconds up.
fn spacing_starts(clues: &Clues<'_>, longest: f64) -> Vec<f64> {
    const LEAST_S: f64 = 3e-3;
    const FURTHER: f64 = 1.5;
    const NEXT: std::ops::RangeInclusive<usize> = 1..=3;
    let mut starts = Vec::new();
    for (run, predicted) in clues.subject.runs.iter().zip(&clues.nominal.runs) {
        let (Some(Some(track)), Some(Predicted::Edges { edges, .. })) = (run.tracks.first(), predicted.first()) else {
            continue;
        };
        for edge in edges {
            let Some(part) = edge.part.map(|passing| passing.part).filter(|part| NEXT.contains(part)) else { continue };
            let came = track.edges.iter().map(|edge| track.grid.instants[edge.index]);
            starts.extend(came.map(|at| (at - 0.5 * track.grid.cycle - edge.at) / part as f64));
        }
    }
    starts.retain(|start: &f64| start.abs() < longest);
    starts.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    starts.truncate(MOST / 2);
    let sizes = std::iter::successors(Some(LEAST_S), |size| Some(FURTHER * size)).take_while(|size| *size < longest);
    starts.extend(sizes.flat_map(|size| [size, -size]));
    starts
}

/// Times from a tenth of a millisecond up, steps of half a cycle where edges are seen in cycles, and how late the edges are.
fn time_starts(clues: &Clues<'_>) -> Vec<f64> {
    let mut times = vec![3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.06, 0.1, 0.17, 0.3, 0.6];
    let has_levels = clues.subject.signals.iter().any(|info| info.descriptor.ty != PortType::Boolean);
    if !has_levels {
        let step = (0.5 * clues.scales.cycle).clamp(2e-3, 0.02);
        times.extend((1..=30).map(|k| f64::from(k) * step));
    }
    let late = late(clues);
    if !late.is_empty() {
        times.extend([0.25, 0.5, 0.75, 0.9].map(|share| quantile(&late, share)));
    }
    times.sort_by(f64::total_cmp);
    times
}

/// How long the component's flag is predicted to stay up, or down, at the longest, s; `None` where it came to be so in a recording.
fn longest_stay(clues: &Clues<'_>, is_up: bool) -> Option<f64> {
    let signal = clues.subject.signals.iter().position(|info| Some(info.property.as_str()) == clues.component)?;
    let mut longest: Option<f64> = None;
    for (predicted, run) in clues.nominal.runs.iter().zip(&clues.subject.runs) {
        let (Predicted::Edges { edges, .. }, Some(track)) = (&predicted[signal], &run.tracks[signal]) else { continue };
        if track.edges.iter().any(|edge| (edge.to > 0.5) == is_up) {
            return None;
        }
        let until = edges.iter().skip(1).map(|edge| edge.at).chain([run.ends]);
        let stays = edges.iter().zip(until).filter(|(edge, _)| (edge.to > 0.5) == is_up);
        longest = stays.map(|(edge, until)| until - edge.at).chain(longest).max_by(f64::total_cmp);
    }
    longest
}

/// How late the edges are that are, s.
fn late(clues: &Clues<'_>) -> Vec<f64> {
    let edges = clues.score.signals.iter().flat_map(|signal| &signal.edges);
    let late = edges.filter_map(|edge| Some(0.5 * (edge.recorded?.0 + edge.recorded?.1) - edge.predicted?));
    late.filter(|late| *late > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::cause::library::candidates;
    use crate::gap::recorded_tests::{
        BLIND_SWITCH, LAGGING_ROBOT, RUBBING_AXIS, SLIPPING_PARTS, SLOW_PUSHER, TOLD_LATE, study,
    };
    use crate::gap::{Overrides, Prediction, Score, Subject};

    /// A device of a recording, what is predicted of it, and how that does.
    fn moving(recording: &str, device: &str) -> (Subject, Prediction, Score) {
        let subject = study(recording).subject(device).expect("it moves").clone();
        let nominal = subject.predict(&[], &Overrides::none()).expect("a prediction");
        let score = subject.score(&nominal);
        (subject, nominal, score)
    }

    /// A switch that is told late enough never comes, and one that is told for long enough never goes; this one went.
    #[test]
    fn a_flag_that_never_comes_may_be_late() {
        let (pusher, nominal, score) = moving(BLIND_SWITCH, "Pusher");
        let longest = |component, is_up| {
            let scales = Scales::of(&pusher, &nominal, None);
            longest_stay(
                &Clues { subject: &pusher, nominal: &nominal, score: &score, scales, component: Some(component) },
                is_up,
            )
        };
        assert!(longest("limitRetracted", true).is_some_and(|stay| (0.1..3.0).contains(&stay)));
        assert_eq!(longest("limitRetracted", false), None);
        // It may as well be filtered for longer than it stands.
        let stay = longest("limitRetracted", true).expect("a stay");
        let begins_at = |id: &str, place: EffectPlace, time: f64| {
            let all = candidates(&pusher, &nominal, &score, &|known| known == id);
            let is_meant = |of: &&Candidate| of.component.as_deref() == Some("limitRetracted") && of.place == place;
            let found = all.iter().find(is_meant).expect("a candidate");
            found.starts.iter().any(|start| (start[0] - time).abs() < 1e-9)
        };
        assert!(begins_at("on-delay", EffectPlace::Sensor, NEVER_COMES * stay));
        assert!(begins_at("input-filter", EffectPlace::ReportLink, NEVER_COMES * stay));
        // Or be looked at too rarely.
        assert!(begins_at("stale-hold", EffectPlace::ReportLink, 10.0));
    }

    /// A belt is asked for speeds: its dead band is tried just above twice the slowest of them, and never far above twice the fastest. A robot is asked for
    /// ways.
    #[test]
    fn a_dead_band_of_a_belt_is_one_of_the_speeds_it_is_asked_for() {
        let starts = |recording: &str, device: &str| {
            let (subject, nominal, score) = moving(recording, device);
            let scales = Scales::of(&subject, &nominal, None);
            let asked =
                speeds_asked(&Clues { subject: &subject, nominal: &nominal, score: &score, scales, component: None });
            let found = candidates(&subject, &nominal, &score, &|id| id == "dead-band").swap_remove(0);
            (asked, found.free[0].range.greatest, found.starts.iter().map(|start| start[0]).collect::<Vec<_>>())
        };
        let (asked, greatest, widths) = starts(SLIPPING_PARTS, "Belt");
        let (slowest, fastest) = (asked[0], asked[asked.len() - 1]);
        assert!(0.0 < slowest && slowest < fastest && fastest < 1.0, "{asked:?}");
        assert!(widths.iter().any(|width| (width / slowest - 2.04).abs() < 1e-9), "{widths:?}");
        assert!((greatest / fastest - 2.2).abs() < 1e-9 && widths.iter().all(|width| *width < greatest));
        assert!(starts(LAGGING_ROBOT, "Robot").0.is_empty());
    }

    /// A drive that takes 46 µs to reach its acceleration lags by half of that, which a counter shows: it is looked for from both sides.
    #[test]
    fn a_jerk_limit_may_be_steep() {
        let (motor, nominal, score) = moving(TOLD_LATE, "Motor");
        let found = candidates(&motor, &nominal, &score, &|id| id == "jerk-limit").swap_remove(0);
        let limit = 20.0 / 46e-6;
        let starts = || found.starts.iter().map(|start| start[0]);
        assert!(found.free[0].range.greatest > limit, "{:?}", found.free[0].range);
        assert!(starts().any(|start| start > limit) && starts().any(|start| start < limit), "{:?}", found.starts);
    }

    /// A servo's force goes beyond what its reports show, between two of them: a limit there shows as well.
    #[test]
    fn a_force_limit_may_be_above_what_any_report_shows() {
        let (axis, nominal, score) = moving(RUBBING_AXIS, "Axis");
        let shown = Scales::of(&axis, &nominal, None).effort;
        let found = candidates(&axis, &nominal, &score, &|id| id == "force-limit").swap_remove(0);
        let above = |least: f64| found.starts.iter().filter(|start| start[0] > least * shown).count();
        assert!(found.free[0].range.greatest > 1.5 * shown, "{:?} {shown}", found.free[0].range);
        assert!(above(1.0) > 3 && above(1.5) > 0 && above(0.0) > above(1.0), "{:?} {shown}", found.starts);
    }

    /// Each takes as much longer as the strokes of a pusher that is a per cent slow are late, whatever its ratio.
    #[test]
    fn cushions_are_tried_that_make_strokes_as_late_as_they_are() {
        let (pusher, nominal, score) = moving(SLOW_PUSHER, "Pusher");
        let scales = Scales::of(&pusher, &nominal, None);
        let clues = Clues { subject: &pusher, nominal: &nominal, score: &score, scales, component: None };
        let late = CUSHION_LATE.map(|share| quantile(&late(&clues), share));
        let cushions = cushions(&clues);
        assert_eq!(cushions.len(), CUSHION_LATE.len() * CUSHION_RATIOS.len());
        for cushion in cushions {
            let takes = cushion[0] / 0.5 * (1.0 / cushion[1] - 1.0);
            assert!(late.iter().any(|late| (takes - late).abs() < 1e-9), "{cushion:?} {late:?}");
        }
        let (motor, nominal, score) = moving(SLOW_PUSHER, "Motor");
        assert!(super::cushions(&Clues { subject: &motor, nominal: &nominal, score: &score, ..clues }).is_empty());
    }
}
