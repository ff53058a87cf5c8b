//! What was drawn, read off the recording: sample by sample of a level, edge by edge of a flag.

use super::tries::{ALIKE, Tries};
use crate::gap::prediction::{Predicted, Prediction};
use crate::gap::statistics::{quantile, wilson};
use crate::gap::subject::{Subject, beam_of};
use crate::gap::track::{Edge, Track};

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Law {
    /// The signal is 0 for whole windows.
    Away,
    /// A report brings nothing new.
    Lost,
}

/// How far from what it should be a sample may be, in standard deviations of its floor; a step is added.
const GATE: f64 = 5.0;
/// Beyond how many such gates apart the two things that a sample may be can be told apart.
pub(super) const APART: f64 = 2.0;
/// How many samples must tell the two apart, and which share of them may be neither.
const LEAST_TELLING: usize = 20;
const STRANGE: f64 = 0.02;
/// By how much likelier a sample must be what was drawn than what was predicted, in deviance.
const LIKELIER: f64 = 2.0;
/// Which quantile of the stretches is one window.
const USUAL: f64 = 0.4;
/// How many samples must have been drawn, in how many stretches; and how many at most, of those that tell.
const LEAST_DRAWN: usize = 6;
const LEAST_STRETCHES: usize = 3;
/// How many where each was drawn amid a motion that went as predicted before and behind it.
const LEAST_AMID: usize = 3;
const MOST_DRAWN: f64 = 0.9;
/// In which share of pairs of a late edge and one on time the late one may have been due sooner.
const SOONER: f64 = 0.75;
/// How many edges of a flag that is late by whole cycles.
const LEAST_EDGES: usize = 3;
/// Which share of its edges may come a cycle early, by parameters that are not known better.
const EARLY: f64 = 0.1;

/// What was drawn of one signal.
#[derive(Clone, Debug, Default)]
pub(super) struct Reading {
    /// By run, the stretches of the grid in which it was: first and last index.
    stretches: Vec<Vec<(usize, usize)>>,
    /// How many samples or edges tell, and how many of them were drawn.
    telling: usize,
    drawn: usize,
    /// How many samples were lost one by one, the ones before and behind telling, and being as predicted.
    pub amid: usize,
    /// How long the stretches last at least and at most, s, and the cycle of the grid. Beside one that ends where nobody could see it go on
    /// it may.
    spans: Vec<[f64; 2]>,
    cycle: f64,
    /// How far from 0 samples that tell were predicted where they were drawn, and where they were not.
    sizes: [Vec<f64>; 2],
    /// How far off what was drawn is, in floors squared.
    pub misfit: f64,
}

fn is_beam(subject: &Subject, signal: usize) -> bool {
    beam_of(&subject.signals[signal]).is_some()
}

impl Law {
    /// Whether a flag could show it: when a beam is cut is known to where a part lay, and not to the cycle in which a report is lost.
    fn shows_in(self, subject: &Subject, signal: usize) -> bool {
        self == Law::Away || !is_beam(subject, signal)
    }

    pub fn id(self) -> &'static str {
        match self {
            Law::Away => "intermittent",
            Law::Lost => "lost-messages",
        }
    }

    /// Its time: of a loose contact the length of a window, of lost reports the cycle, s; with its interval.
    pub fn time(self, reading: &Reading) -> (&'static str, (f64, [f64; 2])) {
        match self {
            Law::Lost => ("cycle", (reading.cycle, [reading.cycle; 2])),
            Law::Away => ("time", reading.window()),
        }
    }
}

impl Reading {
    /// What a law drew of a signal: `None` where it does not fit, or draws too little to be seen. Where another signal of the same link
    /// has shown it already (`is_known`) a single draw is enough.
    pub fn of(subject: &Subject, prediction: &Prediction, signal: usize, law: Law, is_known: bool) -> Option<Reading> {
        let mut all = Reading::default();
        for (run, predicted) in subject.runs.iter().zip(&prediction.runs) {
            let Some(track) = &run.tracks[signal] else {
                all.stretches.push(Vec::new());
                continue;
            };
            all.cycle = all.cycle.max(track.grid.cycle);
            match &predicted[signal] {
                Predicted::Level(values) => {
                    let half = if subject.signals[signal].is_count { 0.5 } else { 0.0 };
                    all.level(track, values, half, &run.floors[signal], law)?;
                }
                Predicted::Edges { initial, edges, .. } if law.shows_in(subject, signal) => {
                    let sigma = run.edge_sigmas[signal];
                    let edges: Vec<(f64, usize, f64)> =
                        edges.iter().map(|edge| (edge.at, edge.index, edge.to)).collect();
                    match law {
                        Law::Away => all.flag_away(track, *initial, &edges, is_beam(subject, signal))?,
                        Law::Lost => all.flag_late(track, *initial, &edges, sigma, is_known)?,
                    }
                }
                _ => all.stretches.push(Vec::new()),
            }
        }
        let is_flag = subject.runs.iter().flat_map(|run| &run.tracks[signal]).all(|track| track.values.is_empty());
        let least = match is_flag {
            true => LEAST_EDGES,
            false if all.amid == all.drawn => LEAST_AMID,
            false => LEAST_DRAWN,
        };
        let stretches: usize = all.stretches.iter().map(Vec::len).sum();
        if is_known {
            return (stretches > 0).then_some(all);
        }
        let is_enough = all.drawn >= least
            && stretches >= LEAST_STRETCHES
            && (is_flag || all.telling >= LEAST_TELLING)
            && all.drawn as f64 <= MOST_DRAWN * all.telling as f64;
        is_enough.then_some(all)
    }

    /// Whether a signal moves enough to show what a law draws.
    pub fn could_show(subject: &Subject, prediction: &Prediction, signal: usize, law: Law) -> bool {
        let of = |(run, predicted): (&crate::gap::Run, &Vec<Predicted>)| match (&run.tracks[signal], &predicted[signal])
        {
            (Some(_), Predicted::Level(values)) => {
                let gate = gate(&run.floors[signal], 0.0);
                let tells = |pair: &[f64]| match law {
                    Law::Away => pair[1].abs() > APART * gate,
                    Law::Lost => (pair[1] - pair[0]).abs() > APART * gate,
                };
                values.windows(2).filter(|pair| tells(pair)).count() >= 4 * LEAST_TELLING
            }
            (Some(_), Predicted::Edges { edges, .. }) => {
                law.shows_in(subject, signal) && edges.len() >= 8 * LEAST_EDGES
            }
            _ => false,
        };
        subject.runs.iter().zip(&prediction.runs).any(of)
    }

    fn level(
        &mut self,
        track: &Track,
        predicted: &[f64],
        half: f64,
        floor: &crate::gap::Floor,
        law: Law,
    ) -> Option<()> {
        let instants = &track.grid.instants;
        let (mut telling, mut sure, mut drawn, mut strange) = (0, Vec::new(), Vec::new(), 0);
        // Where a sample tells, and is as predicted.
        let mut fits = vec![false; track.values.len()];
        // Where a sample would be the same drawn and not.
        let mut hidden = vec![true; track.values.len()];
        let mut last = predicted.first().copied()?;
        for (k, (recorded, predicted)) in track.values.iter().zip(predicted).enumerate() {
            let index = track.first + k;
            if track.is_blind(index) {
                continue;
            }
            let instant = |index: usize| instants.get(index).copied().unwrap_or(0.0);
            let span = (instant(index) - instant(index.saturating_sub(1))).max(1e-9);
            let other = match law {
                Law::Away => 0.0,
                Law::Lost => last,
            };
            let slope = ((predicted - last) / span).abs();
            let gate = gate(floor, slope);
            // A contact that is away reads 0 and nothing of a count's half.
            let value = if law == Law::Away && *recorded == 0.0 { 0.0 } else { recorded + half };
            let (off, from_other) = ((value - predicted).abs(), (value - other).abs());
            let tells = (predicted - other).abs() > APART * gate;
            telling += usize::from(tells);
            strange += usize::from(off > gate && from_other > gate);
            hidden[k] = from_other <= gate;
            let square = floor.sigma(slope).powi(2) + floor.step.powi(2) / 12.0;
            if from_other <= gate && off.powi(2) - from_other.powi(2) > LIKELIER * square {
                sure.extend(tells.then_some(k));
                drawn.push(index);
                self.sizes[0].extend(tells.then_some(predicted.abs()));
                self.misfit += off.powi(2) / square;
            } else {
                self.sizes[1].extend(tells.then_some(predicted.abs()));
                fits[k] = tells && off <= gate;
                last = *predicted;
            }
        }
        if strange as f64 > STRANGE * telling as f64 + 2.0 {
            return None;
        }
        self.telling += telling;
        self.drawn += sure.len();
        let is_amid = |k: &&usize| law == Law::Lost && **k > 0 && fits[**k - 1] && fits.get(**k + 1) == Some(&true);
        self.amid += sure.iter().filter(is_amid).count();
        let stretches = stretches(&drawn);
        let shows = |index: usize| index < track.first || hidden.get(index - track.first).is_none_or(|hidden| !hidden);
        let longest = |(from, to): (usize, usize)| {
            let before = (track.first..from).rev().take_while(|index| !shows(*index)).count();
            to - from + 1 + before + (to + 1..).take_while(|index| !shows(*index)).count()
        };
        let long = |samples: usize| samples as f64 * track.grid.cycle;
        self.spans.extend(stretches.iter().map(|&(from, to)| [long(to - from + 1), long(longest((from, to)))]));
        self.stretches.push(stretches);
        Some(())
    }

    /// A flag that is 0 where it is predicted to be 1, and never the other way round. Of a beam it is not known to the cycle when it is cut, so
    /// that what is short and at an end of that is nothing.
    fn flag_away(&mut self, track: &Track, initial: f64, predicted: &[(f64, usize, f64)], is_beam: bool) -> Option<()> {
        let count = track.grid.instants.len();
        let recorded = states(track.initial, track.edges.iter().map(|edge| (edge.index, edge.to)), count);
        let foreseen = states(initial, predicted.iter().map(|(_, index, to)| (*index, *to)), count);
        let all = || (track.first..count).filter(|at| !track.is_blind(*at));
        let up: Vec<usize> = all().filter(|at| foreseen[*at] != 0.0).collect();
        let drawn: Vec<usize> = up.iter().copied().filter(|at| recorded[*at] == 0.0).collect();
        let wrong = all().filter(|at| foreseen[*at] == 0.0 && recorded[*at] != 0.0).count();
        let mut stretches = stretches(&drawn);
        let is_up = |at: Option<usize>| at.is_some_and(|at| (track.first..count).contains(&at) && foreseen[at] != 0.0);
        let begins_up = |from: usize| is_up(from.checked_sub(1));
        let ends_up = |to: usize| is_up(Some(to + 1));
        if is_beam {
            stretches.retain(|(from, to)| begins_up(*from) && ends_up(*to) || to - from >= WINDOW_CYCLES as usize);
        }
        // Away and back again while nothing changes: what else would do that?
        let inner: Vec<&(usize, usize)> =
            stretches.iter().filter(|(from, to)| to > from && begins_up(*from) && ends_up(*to)).collect();
        let is_by_itself = inner.len() * 2 >= stretches.len() && inner.len() >= 2;
        // Or it begins and ends, where nothing else does, with windows of one length: both, as what comes late or goes early has one of
        // them, at instants that the automation's own cycle may have given.
        let middle = |at: usize| 0.5 * (track.grid.instants[at - 1] + track.grid.instants[at]);
        let of =
            |ends: bool| stretches.iter().filter(move |(from, to)| if ends { ends_up(*to) } else { begins_up(*from) });
        let begins: Vec<f64> = of(false).map(|(from, _)| middle(*from)).collect();
        let ends: Vec<f64> = of(true).map(|(_, to)| middle(to + 1)).collect();
        let are_both = 3 * begins.len().min(ends.len()) >= begins.len().max(ends.len());
        let window = windows(&[begins, ends].concat(), track.grid.cycle).filter(|_| are_both);
        if wrong > predicted.len() || !is_by_itself && window.is_none() {
            return None;
        }
        self.telling += up.len();
        self.drawn += stretches.iter().map(|(from, to)| to - from + 1).sum::<usize>();
        self.misfit += 24.0 * stretches.len() as f64;
        self.spans.extend(match window {
            Some(window) => vec![[window; 2]; stretches.len()],
            None => inner.iter().map(|(from, to)| [(to - from + 1) as f64 * track.grid.cycle; 2]).collect(),
        });
        self.stretches.push(stretches);
        Some(())
    }

    /// A flag that stands in some cycles as it did in the one before, though it should have changed, and changes where it should not in few.
    /// Where the link is known to lose reports, a few edges need not show that it is by chance.
    fn flag_late(
        &mut self,
        track: &Track,
        initial: f64,
        predicted: &[(f64, usize, f64)],
        sigma: f64,
        is_known: bool,
    ) -> Option<()> {
        let instants = &track.grid.instants;
        let count = instants.len();
        let recorded = states(track.initial, track.edges.iter().map(|edge| (edge.index, edge.to)), count);
        let foreseen = states(initial, predicted.iter().map(|(_, index, to)| (*index, *to)), count);
        let due = |k: usize| predicted.iter().find(|(_, index, _)| *index == k);
        // What may be due at the next look, or at the one before.
        let may_be_later = |k: usize| due(k).is_some_and(|(at, ..)| at + 3.0 * sigma > instants[k]);
        let may_be_sooner = |k: usize| due(k + 1).is_some_and(|(at, ..)| at - 3.0 * sigma <= instants[k]);
        let (mut tries, mut since, mut late, mut early) = ([Tries::default(); 2], None, Vec::new(), 0);
        let (mut room, mut room_of_late) = ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()]);
        for k in track.first + 1..count {
            let last = recorded[k - 1];
            let (is_due, comes) = (foreseen[k] != last, recorded[k] != last);
            if track.is_blind(k) {
                since = None;
                continue;
            }
            early += usize::from(comes && !is_due && !may_be_sooner(k));
            if is_due && !comes && may_be_later(k) {
                continue;
            }
            if is_due {
                tries[usize::from(since.is_some())].count(!comes);
                if let (None, Some((at, _, to))) = (since, due(k)) {
                    let room = if comes { &mut room } else { &mut room_of_late };
                    room[usize::from(*to != 0.0)].push(instants[k] - at);
                }
            }
            match since {
                None if is_due && !comes => since = Some(k),
                // It came at last, or what should have come went unseen.
                Some(from) if comes || !is_due => {
                    late.push((from, k));
                    since = None;
                }
                _ => {}
            }
        }
        if early as f64 > EARLY * predicted.len() as f64 {
            return None;
        }
        let is_drawn = is_known || (is_by_chance(&room, &room_of_late) && tries[0].is_like(&tries[1]));
        if !is_drawn {
            return None;
        }
        self.telling += tries[0].made() + tries[1].made();
        self.drawn += tries[0].failed() + tries[1].failed();
        self.misfit += 12.0 * late.len() as f64;
        self.stretches.push(late);
        Some(())
    }

    /// Takes what the law drew out of the recording of a signal.
    pub fn take_out(&self, subject: &mut Subject, signal: usize, law: Law) {
        // A flag is away only where it should be up.
        let should = (law == Law::Away).then_some(1.0);
        for (run, stretches) in subject.runs.iter_mut().zip(&self.stretches) {
            let Some(track) = &mut run.tracks[signal] else { continue };
            if track.values.is_empty() {
                take_out_of_flag(track, stretches, should);
            }
            track.blind.extend(stretches.iter().copied());
            track.blind.sort_unstable();
        }
    }

    /// Whether what was drawn was so whatever should have been read: what sticks stands still where it should be slow.
    pub fn is_whatever_is_read(&self) -> bool {
        let [drawn, others] = &self.sizes;
        sooner(drawn, others) < SOONER
    }

    /// How many samples or edges were drawn.
    pub fn drawn(&self) -> usize {
        self.drawn
    }

    /// Whether what was drawn came as chance has it, and not in turn: as often in a row as by itself it would. Few draws do not say.
    pub fn is_drawn_each_time(&self) -> bool {
        /// Of a turn that is never in a row one sees by so many runs that there should have been, and by so many deviations.
        const SHOULD_BE: f64 = 6.5;
        const ALIKE: f64 = 2.5;
        const MOST: f64 = 0.5;
        let runs = self.stretches.iter().flatten();
        let (count, longer) =
            runs.fold((0.0, 0.0), |(count, longer), (from, to)| (count + 1.0, longer + f64::from(u8::from(to > from))));
        let share = self.drawn as f64 / self.telling.max(1) as f64;
        let deviation = (count * share * (1.0 - share)).sqrt();
        share <= MOST && count * share >= SHOULD_BE && (longer - count * share).abs() <= ALIKE * deviation
    }

    /// Several signals' readings as one.
    pub fn sum<'a>(readings: impl Iterator<Item = &'a Reading>) -> Reading {
        let mut sum = Reading::default();
        for reading in readings {
            sum.telling += reading.telling;
            sum.drawn += reading.drawn;
            sum.misfit += reading.misfit;
            sum.spans.extend(&reading.spans);
            sum.cycle = sum.cycle.max(reading.cycle);
        }
        sum
    }

    /// Which share was drawn, between Wilson's bounds of 95 %. What lasts for several samples was drawn once.
    pub fn share(&self) -> (f64, f64, f64) {
        let share = self.drawn as f64 / self.telling.max(1) as f64;
        let each = match self.spans.is_empty() || self.cycle <= 0.0 {
            true => 1.0,
            false => {
                (self.spans.iter().map(|span| span[0]).sum::<f64>() / self.spans.len() as f64).max(self.window().0)
                    / self.cycle
            }
        };
        let each = each.max(1.0);
        let count = self.telling.max(1) as f64 / each;
        let [least, most] = wilson(share * count, count);
        (least, share, most)
    }

    /// How long a window is, s, and its interval: what most stretches last, within a cycle.
    fn window(&self) -> (f64, [f64; 2]) {
        if self.spans.is_empty() {
            return (self.cycle, [self.cycle; 2]);
        }
        let off = self.cycle;
        let is_whole = |span: &&[f64; 2]| span[1] - span[0] < 0.5 * self.cycle;
        let whole: Vec<f64> = self.spans.iter().filter(is_whole).map(|span| span[0]).collect();
        if whole.len() >= LEAST_STRETCHES {
            // Some are cut short by where the signal is 0 anyway; most are one window long.
            let single = quantile(&whole, USUAL).max(self.cycle);
            return (single, [(single - off).max(0.0), single + off]);
        }
        // As long as the longest that was seen, and no longer than the shortest may have been.
        let least = self.spans.iter().map(|span| span[0]).fold(self.cycle, f64::max);
        let most = self.spans.iter().map(|span| span[1]).fold(f64::INFINITY, f64::min).max(least);
        ((least * most).sqrt(), [(least - off).max(0.0), most + off])
    }
}

/// How far from what it should be a sample may lie.
pub(super) fn gate(floor: &crate::gap::Floor, slope: f64) -> f64 {
    GATE * floor.sigma(slope) + floor.step
}

/// Whether edges that came late are no others than those on time: by how long before a look each came, falls and rises apart. Whether a
/// message gets lost does not depend on how soon it is due; what is late by a part of a cycle shows where it was due soon. And it
/// befalls both what comes and what goes.
fn is_by_chance(on_time: &[Vec<f64>; 2], late: &[Vec<f64>; 2]) -> bool {
    let is_alike = |side: usize| {
        late[side].is_empty() || !on_time[side].is_empty() && sooner(&late[side], &on_time[side]) < SOONER
    };
    let counts = [0, 1].map(|side| (on_time[side].len() + late[side].len()).max(1) as f64);
    let shares = [0, 1].map(|side| late[side].len() as f64 / counts[side]);
    let mean = (shares[0] * counts[0] + shares[1] * counts[1]) / (counts[0] + counts[1]);
    let deviation = (mean * (1.0 - mean) * (1.0 / counts[0] + 1.0 / counts[1])).sqrt();
    is_alike(0) && is_alike(1) && (shares[0] - shares[1]).abs() <= ALIKE * deviation.max(1e-9)
}

/// In which share of all pairs the one of `these` is the smaller: a half where both are drawn alike (H. B. Mann, D. R. Whitney, Ann. Math.
/// Statist. 18, 1947).
fn sooner(these: &[f64], those: &[f64]) -> f64 {
    let wins = |this: &f64| those.iter().filter(|that| this < *that).count();
    these.iter().map(wins).sum::<usize>() as f64 / (these.len() * those.len()).max(1) as f64
}

/// How many cycles a window lasts at least, and how long at most, s.
const WINDOW_CYCLES: f64 = 3.0;
const LONGEST_WINDOW_S: f64 = 0.5;
/// How much rarer than all lengths that are tried together it must be by chance that instants lie so on the borders of windows.
const RARER: f64 = 100.0;

/// The length of the windows on whose borders `instants` lie, s, each known to within a cycle; `None` where they lie anywhere. By chance the
/// mean of n unit vectors is as long as r with a probability of exp(−n·r²) (Lord Rayleigh, Phil. Mag. 37, 1919).
fn windows(instants: &[f64], cycle: f64) -> Option<f64> {
    let n = instants.len() as f64;
    let span = instants.iter().copied().fold(0.0, f64::max) - instants.iter().copied().fold(f64::INFINITY, f64::min);
    if instants.len() < LEAST_DRAWN || span <= LONGEST_WINDOW_S {
        return None;
    }
    let (most, least) = (1.0 / (WINDOW_CYCLES * cycle), 1.0 / LONGEST_WINDOW_S);
    let tried = ((most - least).max(0.0) * 4.0 * span).ceil();
    let length = |rate: f64| {
        let angles = || instants.iter().map(|at| std::f64::consts::TAU * rate * at);
        let (x, y) = (angles().map(f64::cos).sum::<f64>(), angles().map(f64::sin).sum::<f64>());
        x.hypot(y) / n
    };
    let rates = (0..=tried as usize).map(|k| least + k as f64 / (4.0 * span));
    let (seen, rate) = rates.map(|rate| (length(rate), rate)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    // Borders of long windows are those of their halves and thirds as well.
    let longer = (2..=4).rev().map(|times| rate / f64::from(times)).find(|rate| length(*rate) > 0.9 * seen);
    (n * seen * seen > (RARER * tried.max(1.0)).ln()).then(|| 1.0 / longer.unwrap_or(rate))
}

/// Neighbouring places as stretches.
fn stretches(places: &[usize]) -> Vec<(usize, usize)> {
    let mut stretches: Vec<(usize, usize)> = Vec::new();
    for place in places {
        match stretches.last_mut() {
            Some(last) if last.1 + 1 == *place => last.1 = *place,
            _ => stretches.push((*place, *place)),
        }
    }
    stretches
}

/// A flag at each instant.
fn states(initial: f64, edges: impl Iterator<Item = (usize, f64)>, count: usize) -> Vec<f64> {
    let mut states = vec![initial; count];
    for (index, to) in edges {
        states[index.min(count)..].fill(to);
    }
    states
}

/// Makes a flag in each stretch what it `should` have been, or else what it becomes behind it: an edge that was late is where it belongs, and one that was
/// not there is none.
fn take_out_of_flag(track: &mut Track, stretches: &[(usize, usize)], should: Option<f64>) {
    let count = track.grid.instants.len();
    let mut states = states(track.initial, track.edges.iter().map(|edge| (edge.index, edge.to)), count);
    for (from, to) in stretches {
        let behind = states.get(to + 1).or(states.get(*to)).copied().unwrap_or(0.0);
        states[*from..(to + 1).min(count)].fill(should.unwrap_or(behind));
    }
    let mut before = track.initial;
    track.edges.clear();
    for (index, state) in states.into_iter().enumerate().skip(track.first) {
        if state != before {
            track.edges.push(Edge { index, to: state });
            before = state;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gap::{Floor, Grid};

    fn read(values: Vec<f64>, predicted: &[f64], law: Law) -> (Option<()>, Reading) {
        let floor = Floor { step: 0.01, noise: 0.01, ..Floor::default() };
        let mut reading = Reading { cycle: 0.01, ..Reading::default() };
        (reading.level(&Track::of_values(values), predicted, 0.0, &floor, law), reading)
    }

    /// A level that climbs by a step a cycle; samples 20 to 29 and 60 to 69 are away.
    #[test]
    fn what_reads_nothing_for_whole_windows_is_away() {
        let predicted: Vec<f64> = (0..100).map(|k| 1.0 + 0.1 * f64::from(k)).collect();
        let is_away = |k: usize| (20..30).contains(&k) || (60..70).contains(&k);
        let values = predicted.iter().enumerate().map(|(k, x)| if is_away(k) { 0.0 } else { *x }).collect();
        let (fits, reading) = read(values, &predicted, Law::Away);
        assert!(fits.is_some());
        assert_eq!(reading.stretches, [vec![(20, 29), (60, 69)]]);
        let (value, [least, most]) = reading.window();
        assert!((value - 0.1).abs() < 1e-9 && least < 0.1 && most > 0.1);
    }

    /// What is 0 but for three samples of twenty, and away for windows of ten: of each window at most three samples show.
    #[test]
    fn a_window_of_which_little_shows_may_be_longer() {
        let is_away = |k: usize| (k / 10) % 7 == 2;
        let predicted: Vec<f64> = (0..1200).map(|k| if k % 20 < 3 { 5.0 } else { 0.0 }).collect();
        let values = predicted.iter().enumerate().map(|(k, x)| if is_away(k) { 0.0 } else { *x }).collect();
        let (fits, reading) = read(values, &predicted, Law::Away);
        assert!(fits.is_some());
        let (value, [least, most]) = reading.window();
        assert!(least <= 0.1 && 0.1 <= most && (least..most).contains(&value), "{value} {least} {most}");
        let (least, share, most) = reading.share();
        assert!(least < 1.0 / 7.0 && 1.0 / 7.0 < most, "{least} {share} {most}");
    }

    /// A speed that rises and falls; of an axis that sticks where it is slow nothing is away, whatever is so for windows.
    #[test]
    fn what_stands_still_where_it_should_be_slow_is_not_away() {
        let predicted: Vec<f64> = (0..1200).map(|k| 5.0 * (f64::from(k) * 0.05).sin().abs()).collect();
        let of = |is_drawn: &dyn Fn(usize, f64) -> bool| {
            let value = |(k, law): (usize, &f64)| if is_drawn(k, *law) { 0.0 } else { *law };
            let (fits, reading) = read(predicted.iter().enumerate().map(value).collect(), &predicted, Law::Away);
            fits.is_some() && reading.is_whatever_is_read()
        };
        assert!(!of(&|_, law| law < 1.0));
        assert!(of(&|k, _| k / 10 % 7 == 2));
    }

    /// Every fifth report brings what the one before it brought.
    #[test]
    fn what_repeats_the_report_before_was_lost() {
        let predicted: Vec<f64> = (0..100).map(|k| 0.3 * f64::from(k)).collect();
        let values = (0..100).map(|k| predicted[if k % 5 == 4 { k - 1 } else { k }]).collect();
        let (fits, reading) = read(values, &predicted, Law::Lost);
        assert!(fits.is_some());
        assert_eq!((reading.drawn, reading.stretches[0].len()), (20, 20));
        let (least, share, most) = reading.share();
        assert!(least < 0.2 && most > 0.2 && (share - 0.2).abs() < 0.01, "{least} {share} {most}");
    }

    /// Three of a hundred reports of a level that climbs, and the first of one that begins to.
    #[test]
    fn few_reports_that_were_lost_amid_a_motion_are_sure() {
        let climbs = |from: usize| (0..100).map(|k| 0.3 * k.max(from) as f64).collect::<Vec<f64>>();
        let predicted = climbs(0);
        let values = (0..100).map(|k| predicted[if [20, 50, 80].contains(&k) { k - 1 } else { k }]).collect();
        let (fits, lost) = read(values, &predicted, Law::Lost);
        assert!(fits.is_some() && (lost.drawn, lost.amid) == (3, 3), "{lost:?}");
        let late = (0..100).map(|k| climbs(50)[if k == 51 { 50 } else { k }]).collect();
        let (fits, begins) = read(late, &climbs(50), Law::Lost);
        assert!(fits.is_some() && (begins.drawn, begins.amid) == (1, 0), "{begins:?}");
    }

    /// A flag of which two reports in five are lost: it is seen where it should be in the end, and a short pulse not at all.
    #[test]
    fn a_flag_tells_how_many_of_its_reports_are_lost() {
        let mut flag = Track::of_values(Vec::new());
        flag.grid = Arc::new(Grid::of_steps(0.05, 80.0));
        let (mut predicted, mut state) = (Vec::new(), vec![0.0; 1601]);
        for k in 0..50_usize {
            let on = 30 * k + 10;
            // Each third time for two cycles.
            let off = on + if k % 3 == 0 { 2 } else { 12 };
            let early = 0.05 * (((k * 23) % 50) as f64 + 0.5) / 50.0;
            predicted.extend([(0.05 * on as f64 - early, on, 1.0), (0.05 * off as f64 - early, off, 0.0)]);
            state[on..off].fill(1.0);
        }
        // Numbers that look drawn: those of D. H. Lehmer's generator.
        let (mut drawn, mut last) = (20_261_126_u64, 0.0);
        for (k, shown) in state.into_iter().enumerate().take(1600).skip(1) {
            drawn = drawn * 48_271 % 2_147_483_647;
            if drawn % 5 > 1 && shown != last {
                last = shown;
                flag.edges.push(Edge { index: k, to: last });
            }
        }
        let mut reading = Reading { cycle: 0.05, ..Reading::default() };
        reading.flag_late(&flag, 0.0, &predicted, 1e-4, false).expect("lost reports");
        let (least, share, most) = reading.share();
        assert!(least < 0.4 && 0.4 < most && most - least < 0.25, "{least} {share} {most}");
    }

    /// A level that is a tenth too low is neither.
    #[test]
    fn what_is_neither_fits_no_law() {
        let predicted: Vec<f64> = (0..100).map(|k| 1.0 + 0.3 * f64::from(k)).collect();
        let low = || predicted.iter().map(|x| 0.9 * x).collect::<Vec<f64>>();
        assert!(read(low(), &predicted, Law::Away).0.is_none());
        assert!(read(low(), &predicted, Law::Lost).0.is_none());
    }

    /// Of edges that are due anywhere within a cycle of 10 ms and come 3 ms late, those due within the last 3 ms are seen a cycle late; of
    /// reports that get lost, any.
    #[test]
    fn what_is_late_by_a_part_of_a_cycle_was_not_lost() {
        let read = |is_late: &dyn Fn(usize, f64) -> bool| {
            let mut flag = Track::of_values(Vec::new());
            flag.grid = Arc::new(Grid::of_steps(0.01, 20.0));
            let mut predicted = Vec::new();
            for k in 0..60_usize {
                let (index, share) = (20 * (k + 1), ((k * 37) % 60) as f64 / 60.0);
                let to = f64::from(u8::from(k % 2 == 0));
                predicted.push((0.01 * (index as f64 - share), index, to));
                flag.edges.push(Edge { index: index + usize::from(is_late(k, share)), to });
            }
            Reading::default().flag_late(&flag, 0.0, &predicted, 1e-4, false)
        };
        assert!(read(&|_, share| share < 0.3).is_none());
        // Of half that are late half would have been lost once more.
        assert!(read(&|k, _| k % 4 < 2).is_none());
        assert!(read(&|k, _| k % 5 == 0).is_some());
    }

    /// A flag that is up for two to four tenths of a second each time, of which each tenth may be away: few of those lie within. One that
    /// comes late by multiples of 5 ms is not away by windows.
    #[test]
    fn a_flag_that_is_up_for_few_windows_is_away_by_windows() {
        let read_as = |late: &dyn Fn(usize) -> f64, is_away: &dyn Fn(usize) -> bool, is_beam: bool| {
            let mut flag = Track::of_values(Vec::new());
            flag.grid = Arc::new(Grid::of_steps(0.01, 60.0));
            let index = |at: f64| (at / 0.01).ceil() as usize;
            let mut state = vec![0.0; 6100];
            let mut predicted = Vec::new();
            for k in 0..40_usize {
                let on = 1.0 + 1.437 * k as f64;
                let off = on + 0.2 + 0.05 * (k % 5) as f64;
                predicted.extend([(on, index(on), 1.0), (off, index(off), 0.0)]);
                let shown = index(on + late(k))..index(off);
                shown.for_each(|at| state[at] = f64::from(u8::from(!is_away(at / 10))));
            }
            let change = |at: &usize| state[*at] != state[at - 1];
            flag.edges = (1..6000).filter(change).map(|index| Edge { index, to: state[index] }).collect();
            let mut reading = Reading { cycle: 0.01, ..Reading::default() };
            reading.flag_away(&flag, 0.0, &predicted, is_beam).map(|()| reading)
        };
        let read = |late: &dyn Fn(usize) -> f64, is_away: &dyn Fn(usize) -> bool| read_as(late, is_away, false);
        let by_windows = read(&|_| 0.0, &|window| (window * 7) % 10 < 3).expect("windows");
        let (least, share, most) = by_windows.share();
        assert!((by_windows.window().0 - 0.1).abs() < 1e-3, "{:?}", by_windows.window());
        assert!(least < 0.3 && 0.3 < most && (share - 0.3).abs() < 0.1, "{share}");
        assert!(read(&|k| 0.2 * ((k * 17) % 40) as f64 / 40.0, &|_| false).is_none());
        // A part that comes to a beam up to 20 ms late is not away for that long.
        let of_beam = read_as(&|k| 0.005 * (k % 5) as f64, &|window| (window * 7) % 10 < 3, true).expect("windows");
        assert!((of_beam.window().0 - 0.1).abs() < 1e-3 && of_beam.drawn <= by_windows.drawn);
    }

    /// Of a flag that goes up at 10 and down at 50, and up at 70 until 80, and is away from 20 to 29, from 45 on, and from 70 to 79, nothing but its own four
    /// edges is left; one whose fall came late falls where it is taken out.
    #[test]
    fn a_flag_is_mended_where_it_was_away() {
        let flag = |edges: &[(usize, f64)]| {
            let mut flag = Track::of_values(Vec::new());
            flag.grid = Arc::new(Grid::of_steps(0.01, 0.99));
            flag.edges = edges.iter().map(|(index, to)| Edge { index: *index, to: *to }).collect();
            flag
        };
        let mut away = flag(&[(10, 1.0), (20, 0.0), (30, 1.0), (45, 0.0)]);
        take_out_of_flag(&mut away, &[(20, 29), (45, 49), (70, 79)], Some(1.0));
        assert_eq!(away.edges, flag(&[(10, 1.0), (50, 0.0), (70, 1.0), (80, 0.0)]).edges);
        let mut late = flag(&[(10, 1.0), (52, 0.0)]);
        take_out_of_flag(&mut late, &[(50, 51)], None);
        assert_eq!(late.edges, flag(&[(10, 1.0), (50, 0.0)]).edges);
    }
}
