//! How often a link is refreshed whose signals stand in between, as its own recording shows.
//!
//! A period that is a little off is a whole one off some periods later, so that a search downhill finds only one that is known to a part of
//! itself over all of them. But what is reported at t is what the machine was at the last multiple of the period: with the period
//! given, that is known of a report which nothing else is wrong with, and the scan is a matched filter over periods, as a radar's is over
//! delays (G. L. Turin, IRE Transactions on Information Theory 6, 1960).

use std::ops::Range;

use super::scales::slopes;
use super::starts::Clues;
use crate::gap::Predicted;

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

/// The period of the candidate's signal, or of all where it is the whole link's, up to `longest` s. `None` where no level shows one.
pub fn period(clues: &Clues<'_>, longest: f64) -> Option<f64> {
    let subject = clues.subject;
    let (mut ways, mut samples) = (Vec::new(), Vec::new());
    let (run, predicted) = subject.runs.iter().zip(&clues.nominal.runs).next()?;
    for (signal, info) in subject.signals.iter().enumerate() {
        let is_meant = clues.component.is_none_or(|name| info.property == name);
        let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &predicted[signal]) else { continue };
        let floor = run.floors[signal].rms(0.0);
        if !is_meant || values.len() < 3 || values.len() != track.values.len() || floor <= 0.0 {
            continue;
        }
        let instants = track.grid.instants[track.first..track.first + values.len()].to_vec();
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
    period_of(&ways, samples, longest)
}

fn period_of(ways: &[Way], mut samples: Vec<Late>, longest: f64) -> Option<f64> {
    let along: f64 = samples.iter().map(|sample| sample.off * sample.speed).sum();
    let squares: f64 = samples.iter().map(|sample| sample.speed * sample.speed).sum();
    if squares <= 0.0 || along >= 0.0 || along * along < SHOWS * squares {
        return None;
    }
    // On the average half a period, less what the nominal parameters have taken up of it.
    let late = -along / squares;
    let end = samples.iter().map(|sample| sample.at).fold(0.0, f64::max);
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
    let (mut known, mut step) = (best.1, PART * best.1 * best.1 / end);
    let mut most = share(ways, &samples, known);
    while step > 1e-3 * known * known / end {
        for there in [known - step, known + step] {
            let share = share(ways, &samples, there);
            (known, most) = if share > most { (there, share) } else { (known, most) };
        }
        step *= 0.7;
    }
    (most > LEAST_SHARE).then_some(known)
}

/// Which share of the errors' squares goes with what a period would do, beyond what goes with being late by the same each time; 0 where it
/// would do much more or less.
fn share(ways: &[Way], samples: &[Late], period: f64) -> f64 {
    share_by(samples, period, |Late { at, way, .. }, told| ways[*way].at(told) - ways[*way].at(*at))
}

/// The same where `does` says by how much a sample is another that tells of an instant before.
fn share_by(samples: &[Late], period: f64, does: impl Fn(&Late, f64) -> f64) -> f64 {
    let (mut off_does, mut off_speed, mut does_speed) = (0.0, 0.0, 0.0);
    let (mut off_off, mut does_does, mut speed_speed) = (0.0, 0.0, 0.0);
    for sample in samples {
        let Late { at, off, speed, .. } = sample;
        let does = does(sample, (at / period).floor() * period);
        off_does += off * does;
        off_speed += off * speed;
        does_speed += does * speed;
        off_off += off * off;
        does_does += does * does;
        speed_speed += speed * speed;
    }
    let beyond = |one: f64, other: f64, both: f64| both - one * other / speed_speed;
    let along = beyond(off_speed, does_speed, off_does);
    let squares = beyond(does_speed, does_speed, does_does);
    let all = beyond(off_speed, off_speed, off_off);
    // Where every report is late by nearly the same nothing is said of a period.
    let is_told = squares > LEAST_OWN * does_does && all > 0.0;
    if is_told && HOLDS.contains(&(along / squares)) { along * along / (squares * all) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A way to and fro, reported each 20 ms as `told` of the instant.
    fn found(told: impl Fn(f64) -> f64, noise: f64) -> Option<f64> {
        let way = |at: f64| 1000.0 * ((0.9 * at).sin() + 0.3 * (2.3 * at).sin());
        let instants: Vec<f64> = (0..2500).map(|k| 0.0137 + 0.02 * f64::from(k)).collect();
        let values: Vec<f64> = instants.iter().map(|at| way(*at)).collect();
        let speeds = slopes(&instants, &values);
        let late = |(k, (at, speed)): (usize, (&f64, &f64))| {
            let off = way(told(*at)) - way(*at) + noise * (((k * k * 7919) % 1000) as f64 / 500.0 - 1.0);
            Late { at: *at, off, speed: *speed, way: 0 }
        };
        let samples = instants.iter().zip(&speeds).enumerate().map(late).collect();
        period_of(&[Way { instants: instants.clone(), values }], samples, 3.0)
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

    #[test]
    fn what_is_late_by_the_same_or_not_at_all_has_none() {
        assert_eq!(found(|at| at, 1.5), None);
        assert_eq!(found(|at| at - 0.03, 1.5), None);
    }
}
