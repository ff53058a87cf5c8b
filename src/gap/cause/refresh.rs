//! How often a link is refreshed whose signals stand in between, as its own recording shows.
//!
//! A period that is a little off is a whole one off some periods later, so that a search downhill finds only one that is known to a part of
//! itself over all of them. But what is reported at t is what the machine was at the last multiple of the period: with the period
//! given, that is known of a report which nothing else is wrong with, and the scan is a matched filter over periods, as a radar's is over
//! delays (G. L. Turin, IRE Transactions on Information Theory 6, 1960).
//!
//! Of a period that is far shorter than the cycle of the reports there are millions, and each report says little. But reports that come every c all
//! lie as in one turn of c/T modulo 1: the first harmonic of how late they are, a saw's (T/π)·sin 2πt/T, is that of a periodogram over those turns,
//! which all periods that are a whole turn apart have in common (N. R. Lomb, Astrophysics and Space Science 39, 1976); the phase of the first report says
//! which of them it is.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::scales::slopes;
use super::starts::Clues;
use crate::gap::{Predicted, THRESHOLD};

/// The shortest period looked for, s, and from which on all are: shorter ones only where reports are about as late as half of one.
const SHORTEST_S: f64 = 5e-4;
const ALL_S: f64 = 5e-3;
/// How many samples are looked at to begin with, of the faster half.
const MOST_SAMPLES: usize = 120;
/// Every so many of them say whether a period is worth a look at all: where it takes away less than such a part of what the best one does.
const FEWER: usize = 4;
const AT_A_GLANCE: f64 = 0.3;
/// How much of the reports' lateness must show, as a square in standard deviations.
const SHOWS: f64 = 50.0;
/// Between which shares of what a period would do the recording must hold it, and which share of the error it must take away that no constant
/// lateness does.
const HOLDS: Range<f64> = 0.5..1.5;
const LEAST_SHARE: f64 = 0.1;
/// Of what a period would do so much must be more than being late by the same (a quarter, where reports come at any time of it).
const LEAST_OWN: f64 = 0.05;
/// Within a shorter period than this a machine moves along a line between two of its reports, near enough for a first look, s.
const STRAIGHT_S: f64 = 5e-3;
/// By which part of itself over all its turns a period is found to begin with.
const PART: f64 = 0.12;
/// Between which multiples of how late reports are a shorter period than [`SHORTEST_S`] is looked for: nominal parameters take most of so short a lateness
/// up; no shorter than what shows, s; and how many of the likeliest are looked at sample by sample.
const OF_LATENESS: Range<f64> = 1.5..20.0;
const SHOWN_S: f64 = 1e-4;
const LIKELIEST: usize = 24;

/// A sample of a level: when, by how much it lies off, and how fast it moves, in units of its floor.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Late {
    at: f64,
    off: f64,
    speed: f64,
    /// The place of its signal among the ways.
    way: usize,
}

/// A signal as it would be reported at once: its instants and its values, in units of its floor.
struct Way {
    instants: Vec<f64>,
    values: Vec<f64>,
}

impl Way {
    /// Between two instants along a line.
    fn at(&self, instant: f64) -> f64 {
        let (first, last) = (self.instants[0], self.instants[self.instants.len() - 1]);
        let share = (instant - first) / (last - first) * (self.instants.len() - 1) as f64;
        let place = (share.max(0.0) as usize).min(self.instants.len() - 2);
        let span = self.instants[place + 1] - self.instants[place];
        let along = if span > 0.0 { (instant - self.instants[place]) / span } else { 0.0 };
        self.values[place] + along.clamp(-1.0, 2.0) * (self.values[place + 1] - self.values[place])
    }
}

/// Periods, up to `longest` s, of the candidate's signal, or where it is the whole link's of all signals, and of each alone: one of them may be off by something
/// else as well. None where no level shows one.
pub fn periods(clues: &Clues<'_>, longest: f64) -> Vec<f64> {
    let subject = clues.subject;
    let (mut ways, mut samples) = (Vec::new(), Vec::new());
    let mut cycle = 0.0;
    let Some((run, predicted)) = subject.runs.iter().zip(&clues.nominal.runs).next() else { return Vec::new() };
    for (signal, info) in subject.signals.iter().enumerate() {
        let is_meant = clues.component.is_none_or(|name| info.property == name);
        let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &predicted[signal]) else { continue };
        let floor = run.floors[signal].rms(0.0);
        if !is_meant || values.len() < 3 || values.len() != track.values.len() || floor <= 0.0 {
            continue;
        }
        cycle = if track.grid.is_rebuilt { track.grid.cycle } else { 0.0 };
        let lead = subject.lead(info, run);
        let whole_cycles = &track.grid.instants[track.first..track.first + values.len()];
        let instants: Vec<f64> = whole_cycles.iter().map(|at| at + lead).collect();
        let whole: Vec<f64> = values.iter().map(|value| value / floor).collect();
        let speeds = slopes(&instants, &whole);
        let each = instants.iter().zip(&speeds).zip(track.values.iter().zip(&whole));
        samples.extend(each.filter(|((_, speed), _)| **speed != 0.0).map(|((at, speed), (told, whole))| Late {
            at: *at,
            off: told / floor - whole,
            speed: *speed,
            way: ways.len(),
        }));
        ways.push(Way { instants, values: whole });
    }
    periods_of(&ways, samples, longest, cycle)
}

/// Those of all ways together and of each alone.
fn periods_of(ways: &[Way], samples: Vec<Late>, longest: f64, cycle: f64) -> Vec<f64> {
    let of_one = |way: usize| {
        let own = samples.iter().filter(|sample| sample.way == way).map(|sample| Late { way: 0, ..*sample });
        period_of(&ways[way..=way], own.collect(), longest, cycle)
    };
    let each: Vec<f64> = if ways.len() > 1 { (0..ways.len()).filter_map(of_one).collect() } else { Vec::new() };
    let ends = samples.iter().map(|sample| sample.at).fold(0.0, f64::max);
    let mut periods: Vec<f64> = period_of(ways, samples, longest, cycle).into_iter().collect();
    for period in each {
        if periods.iter().all(|known| (known - period).abs() * ends > PART * period * period) {
            periods.push(period);
        }
    }
    periods
}

/// `cycle`: from one instant of the reports to the next, s; 0 where they come at any.
fn period_of(ways: &[Way], mut samples: Vec<Late>, longest: f64, cycle: f64) -> Option<f64> {
    let along: f64 = samples.iter().map(|sample| sample.off * sample.speed).sum();
    let squares: f64 = samples.iter().map(|sample| sample.speed * sample.speed).sum();
    if squares <= 0.0 || along >= 0.0 || along * along < SHOWS * squares {
        return None;
    }
    // On the average half a period, less what the nominal parameters have taken up of it.
    let late = -along / squares;
    let end = samples.iter().map(|sample| sample.at).fold(0.0, f64::max);
    if OF_LATENESS.start * late < SHORTEST_S && cycle > 0.0 {
        let short = short_period(&samples, late, cycle);
        if short.is_some() {
            return short;
        }
    }
    samples.sort_by(|a, b| b.speed.abs().total_cmp(&a.speed.abs()));
    // Of the faster half every so many, from all over the recording: what comes in bursts holds many a period.
    let every = (samples.len() / 2 / MOST_SAMPLES).max(1);
    let few: Vec<Late> = samples.iter().step_by(every).take(MOST_SAMPLES).copied().collect();
    let fewer: Vec<Late> = few.iter().step_by(FEWER).copied().collect();
    let mut best = (0.0, 0.0);
    let mut period = (1.7 * late).clamp(SHORTEST_S, ALL_S);
    while period < longest {
        let is_straight = period < STRAIGHT_S;
        let shows = |samples: &[Late]| match is_straight {
            true => share_by(samples, period, |Late { at, speed, .. }, told| (told - at) * speed),
            false => share(ways, samples, period),
        };
        if shows(&fewer) > AT_A_GLANCE * best.0 {
            let share = shows(&few);
            best = if share > best.0 { (share, period) } else { best };
        }
        period += PART * period * period / end;
    }
    let (known, most) = nearer(best.1, end, |period| share(ways, &samples, period));
    (most > LEAST_SHARE).then_some(known)
}

/// The period about `first` that holds the greatest share, over recordings that last until `end`; and that share.
fn nearer(first: f64, end: f64, share: impl Fn(f64) -> f64) -> (f64, f64) {
    let (mut known, mut step) = (first, PART * first * first / end);
    let mut most = share(known);
    while step > 1e-3 * known * known / end {
        for there in [known - step, known + step] {
            let share = share(there);
            (known, most) = if share > most { (there, share) } else { (known, most) };
        }
        step *= 0.7;
    }
    (known, most)
}

/// A period that is shorter than [`SHORTEST_S`], of reports every `cycle` s that are `late` on the average.
fn short_period(samples: &[Late], late: f64, cycle: f64) -> Option<f64> {
    let first = samples.iter().map(|sample| sample.at).fold(f64::INFINITY, f64::min);
    let end = samples.iter().map(|sample| sample.at).fold(0.0, f64::max);
    let turns = ((end - first) / cycle).round() as usize + 1;
    // What a report that is later than others by a second would be off by more, times what it is.
    let mut along = vec![0.0; turns];
    let mut squares = 0.0;
    for Late { at, off, speed, .. } in samples {
        along[(((at - first) / cycle).round() as usize).min(turns - 1)] += (off + late * speed) * speed;
        squares += speed * speed;
    }
    let count = (turns as f64 / PART).ceil();
    let gathered = gathered(&along, count as usize);
    let mut likeliest: Vec<(f64, f64)> = Vec::new();
    let shortest = (OF_LATENESS.start * late).max(SHOWN_S);
    let longest = (OF_LATENESS.end * late).min(2.0 * SHORTEST_S);
    if shortest >= longest {
        return None;
    }
    let (slowest, fastest) = (1.0 / longest, 1.0 / shortest);
    let (from, to) = ((slowest * cycle * count).ceil() as usize, (fastest * cycle * count).floor() as usize);
    for place in from..=to {
        let rate = place as f64 / (count * cycle);
        let (re, im) = gathered[place % count as usize];
        let (sin, cos) = (TAU * (rate * first).fract()).sin_cos();
        let amplitude = 1.0 / (PI * rate);
        let gain = 2.0 * amplitude * (sin * re + cos * im) - 0.5 * amplitude * amplitude * squares;
        if likeliest.last().is_none_or(|least| gain > least.0) || likeliest.len() < LIKELIEST {
            let behind = likeliest.partition_point(|other| other.0 > gain);
            likeliest.insert(behind, (gain, 1.0 / rate));
            likeliest.truncate(LIKELIEST);
        }
    }
    let straight = |period: f64| share_by(samples, period, |Late { at, speed, .. }, told| (told - at) * speed);
    let found = likeliest.iter().map(|(_, period)| nearer(*period, end, straight).0);
    // Of periods a turn apart the share is nearly the same: what is left says which of them is as long as its saw is high.
    let left = |period: f64| {
        let of = Gathered::of(samples, |Late { at, speed, .. }| ((at / period).floor() * period - at) * speed);
        (2.0 * of.along - of.squares, period)
    };
    let (gain, period) = found.map(left).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let is_no_chance = gain > THRESHOLD + 2.0 * ((to - from) as f64).max(1.0).ln();
    is_no_chance.then_some(period)
}

/// The sums of `values` that each turn on by a `count`th of a turn more from one to the next: real and imaginary parts.
fn gathered(values: &[f64], count: usize) -> Vec<(f64, f64)> {
    // The other half is this one's mirror.
    let half = count / 2 + 1;
    let turns: Vec<(f64, f64)> = (0..half).map(|place| (TAU * place as f64 / count as f64).sin_cos()).collect();
    let mut phases = vec![(0.0, 1.0); half];
    let mut sums = vec![(0.0, 0.0); half];
    for value in values {
        for (((re, im), (sin, cos)), (turn_sin, turn_cos)) in sums.iter_mut().zip(&mut phases).zip(&turns) {
            *re += value * *cos;
            *im += value * *sin;
            (*sin, *cos) = (*sin * turn_cos + *cos * turn_sin, *cos * turn_cos - *sin * turn_sin);
        }
    }
    let mirrored = (half..count).map(|place| sums[count - place]).map(|(re, im)| (re, -im)).collect::<Vec<_>>();
    sums.into_iter().chain(mirrored).collect()
}

/// Which share of the errors' squares goes with what a period would do, beyond what goes with being late by the same each time; 0 where it
/// would do much more or less.
fn share(ways: &[Way], samples: &[Late], period: f64) -> f64 {
    share_by(samples, period, |Late { at, way, .. }, told| ways[*way].at(told) - ways[*way].at(*at))
}

/// The same where `does` says by how much a sample is another that tells of an instant before.
fn share_by(samples: &[Late], period: f64, does: impl Fn(&Late, f64) -> f64) -> f64 {
    let of = Gathered::of(samples, |sample| does(sample, (sample.at / period).floor() * period));
    // Where every report is late by nearly the same nothing is said of a period.
    let is_told = of.squares > LEAST_OWN * of.whole && of.all > 0.0;
    let is_held = is_told && HOLDS.contains(&(of.along / of.squares));
    if is_held { of.along * of.along / (of.squares * of.all) } else { 0.0 }
}

/// What a period does and the errors, gathered beyond what goes with being late by the same each time.
struct Gathered {
    /// Their products, and the squares of each.
    along: f64,
    squares: f64,
    all: f64,
    /// The squares of all that the period does.
    whole: f64,
}

impl Gathered {
    fn of(samples: &[Late], does: impl Fn(&Late) -> f64) -> Gathered {
        let (mut off_does, mut off_speed, mut does_speed) = (0.0, 0.0, 0.0);
        let (mut off_off, mut does_does, mut speed_speed) = (0.0, 0.0, 0.0);
        for sample in samples {
            let Late { off, speed, .. } = sample;
            let does = does(sample);
            off_does += off * does;
            off_speed += off * speed;
            does_speed += does * speed;
            off_off += off * off;
            does_does += does * does;
            speed_speed += speed * speed;
        }
        let beyond = |one: f64, other: f64, both: f64| both - one * other / speed_speed;
        Gathered {
            along: beyond(off_speed, does_speed, off_does),
            squares: beyond(does_speed, does_speed, does_does),
            all: beyond(off_speed, off_speed, off_off),
            whole: does_does,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A way to and fro, reported each 20 ms as `told` of the instant.
    fn found(told: impl Fn(f64) -> f64, noise: f64) -> Option<f64> {
        found_over(1000.0, told, noise)
    }

    fn found_over(span: f64, told: impl Fn(f64) -> f64, noise: f64) -> Option<f64> {
        let way = |at: f64| span * ((0.9 * at).sin() + 0.3 * (2.3 * at).sin());
        let instants: Vec<f64> = (0..2500).map(|k| 0.0137 + 0.02 * f64::from(k)).collect();
        let values: Vec<f64> = instants.iter().map(|at| way(*at)).collect();
        let speeds = slopes(&instants, &values);
        let late = |(k, (at, speed)): (usize, (&f64, &f64))| {
            let off = way(told(*at)) - way(*at) + noise * (((k * k * 7919) % 1000) as f64 / 500.0 - 1.0);
            Late { at: *at, off, speed: *speed, way: 0 }
        };
        let samples = instants.iter().zip(&speeds).enumerate().map(late).collect();
        period_of(&[Way { instants: instants.clone(), values }], samples, 3.0, 0.02)
    }

    #[test]
    fn the_period_of_a_link_is_known_to_a_part_of_itself_over_all_of_them() {
        for (told, noise) in [(1.460_7e-3, 0.3), (5.334_1e-3, 1.5), (0.037_222_9, 1.5), (0.141_546_7, 1.5), (0.62, 1.5)]
        {
            let found = found(|at| (at / told).floor() * told, noise);
            let found = found.unwrap_or_else(|| panic!("none for {told}"));
            assert!((found - told).abs() * 50.0 / told < 0.25 * told, "{found} for {told}");
        }
    }

    /// Of reports a hundred times less often, that are off by less than their noise.
    #[test]
    fn a_period_far_shorter_than_the_reports_cycle_is_found() {
        for (told, noise) in [(1.687e-4, 1.0), (3.913_4e-4, 1.0)] {
            let found = found_over(1e4, |at| (at / told).floor() * told, noise);
            let found = found.unwrap_or_else(|| panic!("none for {told}"));
            // Periods a turn of the reports' cycle apart make each of them as late, nearly.
            let late = |k: u32, period: f64| (0.0137 + 0.02 * f64::from(k)).rem_euclid(period);
            let apart = (0..2500).map(|k| (late(k, found) - late(k, told)).powi(2)).sum::<f64>() / 2500.0;
            assert!(apart.sqrt() < 0.15 * told, "{found} for {told}");
        }
    }

    /// One of two axes lags by 0.3 s beside, and is as late by that as if the link were refreshed at another rate.
    #[test]
    fn a_link_is_asked_by_each_of_its_signals() {
        const TOLD: f64 = 0.155_5;
        let instants: Vec<f64> = (0..2500).map(|k| 0.0137 + 0.02 * f64::from(k)).collect();
        let way = |axis: usize, at: f64| 1000.0 * ((0.9 * at + axis as f64).sin() + 0.3 * (2.3 * at).sin());
        let ways = [0, 1]
            .map(|axis| Way { instants: instants.clone(), values: instants.iter().map(|at| way(axis, *at)).collect() });
        let late = |axis: usize| {
            let speeds = slopes(&ways[axis].instants, &ways[axis].values);
            let each = instants.iter().copied().zip(speeds).collect::<Vec<_>>();
            each.into_iter().map(move |(at, speed)| {
                let lag = if axis == 0 { 0.3 } else { 0.0 };
                let told = (at / TOLD).floor() * TOLD;
                Late { at, off: way(axis, told - lag) - way(axis, at), speed, way: axis }
            })
        };
        let samples: Vec<Late> = late(0).chain(late(1)).collect();
        let is_told = |period: f64| (period - TOLD).abs() * 50.0 < 0.25 * TOLD * TOLD;
        assert!(!period_of(&ways, samples.clone(), 3.0, 0.02).is_some_and(is_told));
        assert!(periods_of(&ways, samples, 3.0, 0.02).into_iter().any(is_told));
    }

    #[test]
    fn what_is_late_by_the_same_or_not_at_all_has_none() {
        assert_eq!(found(|at| at, 1.5), None);
        assert_eq!(found(|at| at - 0.03, 1.5), None);
        assert_eq!(found_over(1e4, |at| at - 1e-4, 0.5), None);
    }
}
