//! A prediction against what was recorded.

use serde::Serialize;

use super::cost::{self, residual};
use super::edges::{Pair, interval, interval_cost, pair, uncertainty};
use super::ends;
use super::filter::MOST_FILTER_S;
use super::prediction::{PredictedEdge, Pulse, Turn};
use super::samples::{Sample, Samples};
use super::shifts::shifted;
use super::tolerance::Weighed;
use super::track::Track;
use super::turns;

/// What a prediction costs: −2 ln of its likelihood, less that of a perfect one; smaller is better, and a difference of two is
/// a deviance.
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// The sum over all signals.
    pub total: f64,
    /// In the order of the subject's signals, run by run within each.
    pub signals: Vec<SignalScore>,
}

/// What is scored of one signal in one run.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalScore {
    /// The signal's place among the subject's.
    pub signal: usize,
    /// The run's place among the subject's.
    pub run: usize,
    /// The sum of its costs.
    pub cost: f64,
    /// What that would be where nothing is wrong, and the variance of it.
    pub floor_cost: (f64, f64),
    /// Of a level the root mean square difference in the signal's SI unit, of an edge that of its time error in s.
    pub rms: f64,
    /// What that would be where nothing is wrong.
    pub floor: f64,
    pub level: Option<LevelScore>,
    pub edges: Vec<EdgeScore>,
}

/// A level, sample by sample: three lists of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LevelScore {
    /// Instants, s.
    pub at: Vec<f64>,
    /// Costs, 0 or more. A sample that says nothing new (nothing has changed in signal and prediction since the one before,
    /// and no noise shows) costs nothing, so that every rest counts once.
    pub cost: Vec<f64>,
    /// Square roots of the costs, with the sign of recorded less predicted.
    pub residual: Vec<f64>,
    /// Recorded less predicted, SI.
    pub difference: Vec<f64>,
}

/// What is foreseen of a signal that has edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foreseen<'a> {
    /// The state that it begins with.
    pub initial: f64,
    pub edges: &'a [PredictedEdge],
    /// Pulses that no look of the prediction shows.
    pub unseen: &'a [Pulse],
    /// Where a part nearly made one more.
    pub turns: &'a [Turn],
    /// How much further each of the parts that pass was than its first edge said, m.
    pub shifts: &'a [f64],
}

/// An edge: a pair, or one that only one side has.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EdgeScore {
    /// What the signal becomes.
    pub to: f64,
    /// Between which instants the recorded one came, s; `None`: it is missing there (the prediction's is extra).
    pub recorded: Option<(f64, f64)>,
    /// When the predicted one comes, s; `None`: it is missing there.
    pub predicted: Option<f64>,
    /// How far the predicted one lies outside of the recorded one's interval, s: positive where the recorded one is later; 0
    /// within it, and of an edge alone.
    pub error: f64,
    /// How far it may be off in time where nothing is wrong, standard deviation, s.
    pub uncertainty: f64,
    pub cost: f64,
    pub residual: f64,
}

impl EdgeScore {
    /// When it was, s: as recorded, else as predicted.
    pub fn at(&self) -> f64 {
        self.recorded.map(|(_, seen)| seen).or(self.predicted).unwrap_or(0.0)
    }
}

impl Score {
    /// Everything as residuals of least squares, whose squares sum to [`Score::total`]. Their number depends on the recordings
    /// alone: of each level one for each sample, of each edge one for each that was recorded, and one for all that were not.
    pub fn residuals(&self) -> Vec<f64> {
        let mut residuals = Vec::new();
        self.signals.iter().for_each(|signal| signal.add_residuals(&mut residuals));
        residuals
    }

    /// The run and the instant, s, of each of [`Score::residuals`]; `None` of one that stands for edges that nobody recorded.
    pub fn places(&self) -> Vec<Option<(usize, f64)>> {
        let mut places = Vec::new();
        for signal in &self.signals {
            let at = |at: f64| Some((signal.run, at));
            places.extend(signal.level.iter().flat_map(|level| &level.at).map(|instant| at(*instant)));
            let recorded = signal.edges.iter().filter(|edge| edge.recorded.is_some());
            places.extend(recorded.map(|edge| at(edge.at())));
            if signal.level.is_none() {
                places.push(None);
            }
        }
        places
    }

    /// Which of [`Score::residuals`] are samples of levels.
    pub fn are_levels(&self) -> Vec<bool> {
        let of = |signal: &SignalScore| match &signal.level {
            Some(level) => vec![true; level.at.len()],
            None => vec![false; signal.edges.iter().filter(|edge| edge.recorded.is_some()).count() + 1],
        };
        self.signals.iter().flat_map(of).collect()
    }

    /// Every cost with its instant and its run, for sums over spans of time.
    pub fn costs(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        self.signals.iter().flat_map(|signal| {
            let levels = signal.level.iter().flat_map(|level| level.at.iter().zip(&level.cost));
            let levels = levels.map(|(at, cost)| (signal.run, *at, *cost));
            levels.chain(signal.edges.iter().map(|edge| (signal.run, edge.at(), edge.cost)))
        })
    }

    /// What is left above the floor: the cost less what it would be where nothing is wrong.
    pub fn excess(&self) -> f64 {
        self.total - self.signals.iter().map(|signal| signal.floor_cost.0).sum::<f64>()
    }

    pub(super) fn of(signals: Vec<SignalScore>) -> Score {
        Score { total: signals.iter().map(|signal| signal.cost).sum(), signals }
    }
}

impl SignalScore {
    /// How many recorded edges no prediction stands for.
    pub fn missing(&self) -> usize {
        self.edges.iter().filter(|edge| edge.predicted.is_none()).count()
    }

    /// Adds its residuals: see [`Score::residuals`].
    pub(super) fn add_residuals(&self, residuals: &mut Vec<f64>) {
        residuals.extend(self.level.iter().flat_map(|level| &level.residual));
        let recorded = self.edges.iter().filter(|edge| edge.recorded.is_some());
        residuals.extend(recorded.map(|edge| edge.residual));
        if self.level.is_none() {
            let extra = self.edges.iter().filter(|edge| edge.recorded.is_none());
            residuals.push(extra.map(|edge| edge.cost).sum::<f64>().sqrt());
        }
    }

    /// How many predicted edges were not recorded.
    pub fn extra(&self) -> usize {
        self.edges.iter().filter(|edge| edge.recorded.is_none()).count()
    }

    /// A level whose `predicted` values stand for those of its track.
    pub(super) fn level(
        place: (usize, usize),
        track: &Track,
        predicted: &[f64],
        weighed: &Weighed<'_>,
        is_count: bool,
    ) -> Self {
        let (grid, floor) = (&track.grid, weighed.floor);
        let samples = Samples::new(track, predicted, weighed, is_count);
        let mut level = LevelScore::default();
        let (mut squares, mut floors) = (0.0, 0.0);
        let costs = floor.costs();
        let lattice = track.values.first().copied().unwrap_or(0.0) + samples.half();
        let mut floor_cost = (0.0, 0.0);
        samples.each(|sample| {
            let Sample { cost, difference, weight, .. } = sample;
            level.at.push(grid.instants[sample.index]);
            level.cost.push(cost);
            level.residual.push(residual(cost, difference));
            level.difference.push(difference);
            squares += difference * difference;
            floors += floor.rms(sample.slope).powi(2);
            if !sample.is_rest {
                let (mean, variance) = costs.at((sample.predicted - lattice) / floor.step);
                floor_cost =
                    (floor_cost.0 + weight * mean, floor_cost.1 + weight * weight * variance * floor.scatter());
            }
        });
        floor_cost.1 += floor.variance_by_its_noise(floor_cost.0);
        let count = level.at.len().max(1) as f64;
        SignalScore {
            signal: place.0,
            run: place.1,
            cost: level.cost.iter().sum(),
            floor_cost,
            rms: (squares / count).sqrt(),
            floor: (floors / count).sqrt(),
            level: Some(level),
            edges: Vec::new(),
        }
    }

    /// An edge whose changes as they are `foreseen` stand for those of its track; `sigma` is how far a sensor may be off in time, s.
    pub(super) fn edges(place: (usize, usize), track: &Track, foreseen: &Foreseen<'_>, sigma: f64) -> Self {
        let Foreseen { edges: predicted, unseen, turns, shifts, .. } = *foreseen;
        let mut pairs = pair(track, predicted, sigma);
        leave_out_pulses(&mut pairs, predicted, track, sigma);
        let with_pulses = pair_with_pulses(&mut pairs, (predicted, unseen), track, sigma);
        let sigma_of = |pair: &Pair| match pair.predicted {
            Some(at) if at >= predicted.len() => sigma.hypot(PULSE_OFF_S),
            _ => sigma,
        };
        let sigmas: Vec<f64> = pairs.iter().map(sigma_of).collect();
        let predicted = with_pulses.as_deref().unwrap_or(predicted);
        let kept = pairs.iter().zip(&sigmas).map(|(pair, sigma)| edge(track, predicted, shifts, pair, *sigma));
        let mut edges: Vec<EdgeScore> = kept.flatten().collect();
        turns::weigh_unrecorded(&mut edges);
        turns::weigh_unforeseen(&mut edges, turns, shifts, track.tolerance);
        ends::weigh(&mut edges, track, foreseen);
        let errors: Vec<f64> =
            edges.iter().filter(|e| e.recorded.is_some() && e.predicted.is_some()).map(|e| e.error).collect();
        let count = errors.len().max(1) as f64;
        let floor_of = |edge: &EdgeScore| {
            let cycle = track.grid.cycle;
            let start = edge.recorded.map_or(0.0, |(before, _)| before);
            let at = edge.predicted.map_or(0.5 * cycle, |at| (at - start).rem_euclid(cycle.max(1e-9)));
            edge_floor(cycle, edge.uncertainty, at)
        };
        let recorded = edges.iter().filter(|edge| edge.recorded.is_some());
        let floor_cost = recorded.map(floor_of).fold((0.0, 0.0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
        SignalScore {
            signal: place.0,
            run: place.1,
            cost: edges.iter().map(|edge| edge.cost).sum(),
            floor_cost,
            rms: (errors.iter().map(|error| error * error).sum::<f64>() / count).sqrt(),
            floor: edges_floor(&edges, track.grid.cycle),
            level: None,
            edges,
        }
    }
}

/// Within how many standard deviations of where it is predicted an edge comes.
const SURELY: f64 = 5.0;

/// Leaves out predicted pulses that nobody recorded: such as an input's filter may hide, and such as one report alone would have shown that
/// may have been made before the pulse, which a filter may have made later, or after it.
fn leave_out_pulses(pairs: &mut Vec<Pair>, predicted: &[PredictedEdge], track: &Track, sigma: f64) {
    let alone = |pair: &Pair| pair.predicted.filter(|_| pair.recorded.is_none());
    let off = |edge: &PredictedEdge| SURELY * uncertainty(track, edge, sigma);
    let is_missed = |on: &PredictedEdge, and_off: &PredictedEdge| {
        let shown = track.grid.instants.get(on.index);
        let is_late = |at: &f64| at - on.at < off(on).max(MOST_FILTER_S) || and_off.at - at < off(and_off);
        and_off.index == on.index + 1 && shown.is_some_and(is_late)
    };
    let mut at = 0;
    while at + 1 < pairs.len() {
        let both = alone(&pairs[at]).zip(alone(&pairs[at + 1])).filter(|(on, off)| *off == on + 1);
        let is_hidden = |(on, off): (usize, usize)| {
            predicted[off].at - predicted[on].at < MOST_FILTER_S || is_missed(&predicted[on], &predicted[off])
        };
        if both.is_some_and(is_hidden) {
            pairs.drain(at..at + 2);
        } else {
            at += 1;
        }
    }
}

/// How far off, standard deviation, s, a pulse may be predicted that one report alone shows: a speed that passes 0 does so sooner by as much
/// as its slope is known no better, a millisecond of half a second.
const PULSE_OFF_S: f64 = 1.5e-3;

/// Recorded pulses of a single report that nothing was predicted for, each paired with what the prediction has between two looks, where that is
/// likelier. All predicted edges, those of such pulses behind the others; `None` where there are none.
fn pair_with_pulses(
    pairs: &mut [Pair],
    (predicted, unseen): (&[PredictedEdge], &[Pulse]),
    track: &Track,
    sigma: f64,
) -> Option<Vec<PredictedEdge>> {
    let mut all = None;
    for at in 1..pairs.len().max(1) {
        let alone = |pair: &Pair| pair.recorded.filter(|_| pair.predicted.is_none());
        let Some((on, off)) = alone(&pairs[at - 1]).zip(alone(&pairs[at])) else { continue };
        let (came, went) = (track.edges[on], track.edges[off]);
        if off != on + 1 || went.index != came.index + 1 {
            continue;
        }
        let edges = |pulse: &Pulse| {
            let edge = |at: f64, index: usize, to: f64| PredictedEdge { at, index, to, part: None };
            [edge(pulse.from, came.index, came.to), edge(pulse.until, went.index, went.to)]
        };
        let cost = |[on, off]: &[PredictedEdge; 2]| {
            let sigma = sigma.hypot(PULSE_OFF_S);
            interval_cost(track, on.index, on, sigma) + interval_cost(track, off.index, off, sigma)
        };
        let same = unseen.iter().filter(|pulse| pulse.to == came.to).map(edges);
        let likeliest = same.map(|edges| (cost(&edges), edges)).min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, edges)) = likeliest.filter(|(cost, _)| *cost < cost::unmatched()) {
            let all = all.get_or_insert_with(|| predicted.to_vec());
            (pairs[at - 1].predicted, pairs[at].predicted) = (Some(all.len()), Some(all.len() + 1));
            all.extend(edges);
        }
    }
    all
}

/// One pair; `None` where it lies in a span without evidence, or is one that was played back.
fn edge(track: &Track, predicted: &[PredictedEdge], shifts: &[f64], pair: &Pair, sigma: f64) -> Option<EdgeScore> {
    let recorded = pair.recorded.map(|at| track.edges[at]);
    let shift = pair.recorded.and_then(|at| track.part(at)).and_then(|part| shifts.get(part));
    let foreseen = pair
        .predicted
        .map(|at| PredictedEdge { at: shifted(&predicted[at], shift.copied().unwrap_or(0.0)), ..predicted[at] });
    if pair.recorded.is_some_and(|at| track.is_input(at)) {
        return None;
    }
    // What was recorded decides, so that the number of residuals does not depend on the prediction.
    let shown = recorded.map(|edge| edge.index).or(foreseen.map(|edge| edge.index));
    if shown.is_some_and(|index| track.is_blind(index)) {
        return None;
    }
    let within = recorded.map(|edge| interval(track, edge.index));
    let (cost, error) = match (recorded, within, foreseen) {
        (Some(recorded), Some((before, seen)), Some(foreseen)) => {
            let error = if foreseen.at > seen { seen - foreseen.at } else { (before - foreseen.at).max(0.0) };
            (interval_cost(track, recorded.index, &foreseen, sigma), error)
        }
        _ => (cost::unmatched(), 0.0),
    };
    let middle = within.map_or(0.0, |(before, seen)| 0.5 * (before + seen));
    let side = foreseen.map_or(1.0, |foreseen| middle - foreseen.at);
    let to = recorded.map(|edge| edge.to).or(foreseen.map(|edge| edge.to)).unwrap_or(0.0);
    let predicted = foreseen.map(|edge| edge.at);
    let uncertainty = foreseen.map_or(sigma, |foreseen| uncertainty(track, &foreseen, sigma));
    Some(EdgeScore { to, recorded: within, predicted, error, uncertainty, cost, residual: residual(cost, side) })
}

/// The root mean square of how far edges lie outside of their cycles where nothing is wrong: of a cycle that is long beside the
/// uncertainty u, those within u of its ends are, by about u.
fn edges_floor(edges: &[EdgeScore], cycle: f64) -> f64 {
    let square = |edge: &EdgeScore| edge.uncertainty.powi(2) * (edge.uncertainty / cycle.max(edge.uncertainty));
    (edges.iter().map(square).sum::<f64>() / edges.len().max(1) as f64).sqrt()
}

/// Mean and variance of the cost of an edge where nothing is wrong that comes `at` after its cycle's start, s, its sensor off by
/// `sigma`: nothing in the middle of a cycle, and something at its ends.
fn edge_floor(cycle: f64, sigma: f64, at: f64) -> (f64, f64) {
    let reach = if cycle > 0.0 { ((6.0 * sigma / cycle).ceil() as i32).min(64) } else { 0 };
    let (mut mean, mut square) = (0.0, 0.0);
    for shown in -reach..=reach {
        let (before, seen) = (f64::from(shown) * cycle, f64::from(shown + 1) * cycle);
        let share = cost::normal((seen - at) / sigma) - cost::normal((before - at) / sigma);
        let cost = cost::edge(before, seen, at, sigma);
        mean += share * cost;
        square += share * cost * cost;
    }
    (mean, (square - mean * mean).max(1e-6))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::track::Edge;

    fn alone(at: usize) -> Pair {
        Pair { recorded: None, predicted: Some(at) }
    }

    /// A flag's track in a cycle of 50 ms, with what was recorded of it.
    fn track(edges: Vec<Edge>) -> Track {
        let grid = std::sync::Arc::new(crate::gap::Grid::of_steps(0.05, 60.0));
        Track {
            grid,
            first: 0,
            values: Vec::new(),
            initial: 0.0,
            edges,
            origins: Vec::new(),
            tolerance: 0.0,
            blind: Vec::new(),
            anew: Vec::new(),
        }
    }

    /// What is left of predicted pulses, on and off in turn, that nobody recorded in a cycle of 50 ms; a sensor is off by 10 µs.
    fn left_of(edges: &[f64]) -> Vec<usize> {
        let track = track(Vec::new());
        let index = |at: f64| track.grid.instants.partition_point(|instant| *instant < at);
        let to = |place: usize| f64::from(u8::from(place.is_multiple_of(2)));
        let edge = |(place, at): (usize, &f64)| PredictedEdge { at: *at, to: to(place), index: index(*at), part: None };
        let predicted: Vec<PredictedEdge> = edges.iter().enumerate().map(edge).collect();
        let mut pairs: Vec<Pair> = (0..edges.len()).map(alone).collect();
        leave_out_pulses(&mut pairs, &predicted, &track, 1e-5);
        pairs.iter().filter_map(|pair| pair.predicted).collect()
    }

    #[test]
    fn a_pulse_that_a_filter_hides_is_no_difference() {
        assert_eq!(left_of(&[1.0, 1.003, 2.01, 2.5]), [2, 3]);
    }

    /// Shown by one report, 30 µs after it came or before it went, or 4 ms after it came, which a filter may be; or by one that would not
    /// miss it; and by two.
    #[test]
    fn a_pulse_that_one_report_may_miss_is_no_difference() {
        assert_eq!(left_of(&[0.99997, 1.04, 1.96, 2.00003, 2.996, 3.03, 3.97, 4.03, 4.96, 5.07]), [6, 7, 8, 9]);
    }

    /// The first report shows one that the model has from 12 ms after it to 30 ms after, the next one that it has from 1 ms after to 20 ms
    /// after, and two one that it has after the first of them.
    #[test]
    fn a_pulse_that_one_report_showed_may_lie_between_two_of_a_prediction() {
        let recorded = [(20, 1.0), (21, 0.0), (40, 1.0), (41, 0.0), (60, 1.0), (62, 0.0)];
        let track = track(recorded.map(|(index, to)| Edge { index, to }).into());
        let at = |index: usize| track.grid.instants[index];
        let pulse = |from: f64, until: f64| Pulse { from, until, to: 1.0 };
        let unseen = [
            pulse(at(20) + 1.2e-2, at(20) + 3e-2),
            pulse(at(40) + 1e-3, at(40) + 2e-2),
            pulse(at(60) + 1e-5, at(60) + 2e-2),
        ];
        let score = SignalScore::edges(
            (0, 0),
            &track,
            &Foreseen { initial: 0.0, edges: &[], unseen: &unseen, turns: &[], shifts: &[] },
            1e-5,
        );
        assert_eq!(score.missing(), 4);
        assert_eq!(score.edges.len(), recorded.len());
        assert!(score.edges[2].predicted.is_some() && score.edges[2].cost < 16.0, "{:?}", score.edges[2]);
        assert!(score.edges[3].cost < 0.1, "{:?}", score.edges[3]);
    }
}
