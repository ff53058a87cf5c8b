//! What is left after the best answer: whether it still depends on something, and on what.

use std::sync::Arc;

use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use super::ladder::{DRAWS, Ladder, Standing};
use super::starts::UNLIMITED;
use super::tangent::{LEAST_OWN, orthonormal, product, take_out};
use crate::gap::fit::{Range, Slopes};
use crate::gap::floor::FLOOR_UNCERTAINTY;
use crate::gap::locate::evidences;
use crate::gap::statistics::{Draws, binned_share, effective_number, quantile, rank_correlation};
use crate::gap::{FAR_BEYOND, Predicted, Prediction, Score, SignalScore, Subject, THRESHOLD, evidence_all_along};
use crate::plant::EffectPlace;
use crate::prototype::kind::PortDescriptor;
use crate::value::Quantity;

/// From which share of a residual's variance on it depends on a quantity, and what the lower bound of it must be.
const DEPENDS: f64 = 0.2;
const SURELY: f64 = 0.1;
/// Bins of equally many samples.
const BINS: usize = 13;
/// Into how many spans of time a parameter is looked at for whether it changes.
const SPANS: usize = 9;
/// By which share a parameter must change over the spans to be no constant, and how monotone that must be.
const CHANGES: f64 = 0.25;
const MONOTONE: f64 = 0.85;
/// The same where it gains as much as this for each span to let it change: more than chance does.
const CHANGES_SURELY: f64 = 0.08;
const MONOTONE_SURELY: f64 = 0.7;
const GAINS: f64 = 8.0;
/// What share of the gap's squares may be left of one that is explained. (Plants with equations of their own left 0.002 and less in most
/// cases where the named effect was the true one, and 0.015 and more where it was none of the library.)
const LEAST_SHARE: f64 = 0.01;
/// The same where friction or play explains at least as much: real ones bend before they let go, which no law of the library does. (By the
/// figures of docs/gap-on-real-data.md two joints of a real arm leave 0.005 to 0.12 of their position's squares.)
const LEAST_SHARE_BESIDE_FRICTION: f64 = 0.12;
/// The same beside a speed that goes with the load: when a part comes and goes is known to some centimetres, and each time a few samples are
/// off. (One was 1.5 % slower for each part, and left 0.018.)
const LEAST_SHARE_BESIDE_PARTS: f64 = 0.02;
/// What lies so many times further off than its floor, root mean square, needs not be known to depend on anything: it is there, and from this
/// share on it is no small part of a gap that is large; what lies so many times as far again, and as far as that, from a smaller one on. (Six couplings that slip once a turn
/// left 0.0005 to 0.004, 195 to 498 floors, when they were taken for a smaller scale, and a seventh 0.0002, 408 floors; of 27 motors with one gross effect of the library, named rightly, none left
/// more than three floors.)
const PLAINLY: [f64; 3] = [10.0, 100.0, 300.0];
const PLAIN_SHARES: [f64; 3] = [0.002, 0.0003, 3e-5];
/// From this share on what is left is most of a gap, and half of what shows one where nothing is known of it shows it: with something in the
/// library as its cause, which leaves that much. (Of 38 effects of the library that were named rightly none left more than 14.5 of it, and the
/// one that left more than a tenth of its gap 0.3.)
const MOST_OF_IT: f64 = 0.3;
const PLAY: [&str; 3] = ["backlash", "dead-band", "hysteresis"];

/// What is left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remainder {
    /// Of the gap's squares above the floor.
    pub share: f64,
    /// What the residual, or the answer's main parameter, still depends on, the strongest first.
    pub depends_on: Vec<String>,
    /// Whether it is more than noise and a few per cent of the gap.
    pub is_large: bool,
    /// Whether it is large and depends on something or lies far beyond the floor, or the answer's main parameter surely changes with time.
    pub is_significant: bool,
    /// In which share of the draws of blocks it is.
    pub certainty: f64,
}

/// The squares of all differences above the floor, each signal in its own floor's units; of an edge its cost above the floor's.
pub fn misfit(score: &Score) -> f64 {
    score.signals.iter().map(misfit_of).sum()
}

fn misfit_of(signal: &SignalScore) -> f64 {
    match &signal.level {
        Some(level) => level.at.len() as f64 * ((signal.rms / signal.floor.max(1e-12)).powi(2) - 1.0).max(0.0),
        None => (signal.cost - signal.floor_cost.0).max(0.0),
    }
}

/// Whether of no signal more is left than a law of the library is off by that is the machine's own: a seventieth of what was off, root mean square, and not ten
/// times as evident as what is no chance. (What seemed a second effect beside a filter of 67 ms, and delays of tenths of a millisecond beside commands that jitter
/// by 16 and 45 ms and beside reports that get lost, had been 1e-6 to 4e-5 of the squares, and at most four times as evident; of 13 pairs that were found so, the
/// second had been 0.04 and more.)
pub fn is_laws_own(subject: &Subject, prediction: &Prediction, gap: &Score) -> bool {
    let (left, evidences) = (subject.score(prediction), evidences(subject, prediction));
    left.signals.iter().zip(&gap.signals).all(|(left, gap)| {
        let is_little = misfit_of(left) <= LAWS_OWN * misfit_of(gap);
        evidences[left.signal] <= if is_little { LAWS_EVIDENCE * THRESHOLD } else { THRESHOLD }
    })
}

/// What share of the squares of a signal's gap that is, and how many times as evident it may be.
pub const LAWS_OWN: f64 = 2e-4;
const LAWS_EVIDENCE: f64 = 10.0;

/// What the best answer of a ladder leaves.
pub fn remainder(bench: &Bench<'_>, ladder: &Ladder) -> Option<Remainder> {
    let best = &bench.trial(&ladder.best.set, ladder.best.at.clone())?;
    let prediction = bench.predict(&best.set, &best.at)?;
    let score = bench.subject.score(&prediction);
    let bare = bench.subject.score(&*bench.predict(&[], &ladder.bare.at)?);
    let of_gap = |score: &Score| (misfit(score) / misfit(&bare).max(1e-9)).min(1.0);
    let share = of_gap(&score);
    let left = best.cost - ladder.floor.0;
    let is_beyond = |left: f64, variance: f64| left > 18.0 * best.inflation() && left > 5.0 * variance.sqrt();
    // Late edges of one signal drown in what thousands of samples of a level cost less than their floor.
    let Standing { worst, above, .. } = Standing::of(&score);
    let by_friction = of_gap(&bench.subject.score(&*without_friction(bench, best)?)) - share;
    let mut depends = dependences(bench, &prediction, &score);
    // What several floors were each thought to be a little too low is left of no gap: by itself no signal shows that anything is off.
    let beyond_chance = evidence_all_along(bench.subject, &prediction);
    let shows = !depends.is_empty() || shows_by_itself(beyond_chance, share);
    let levels = score.signals.iter().filter(|signal| signal.level.is_some());
    let floors = levels.map(|signal| signal.rms / signal.floor.max(1e-12)).fold(0.0, f64::max);
    let is_plain = floors > PLAINLY[0];
    let least_share = may_be_left(by_friction, floors).max(left_by_parts(best));
    let is_large = share > least_share
        && (is_beyond(left, ladder.floor.1)
            || is_beyond(above - FLOOR_UNCERTAINTY * worst.0, worst.1)
            || beyond_chance > FAR_BEYOND * THRESHOLD)
        && shows;
    let trend = if best.set.is_empty() { None } else { trend(bench, best) };
    let (is_steady, is_surely_not) = trend.as_ref().map_or((true, false), Trend::judged);
    let drifts = !best.set.is_empty() && drift(bench, best).is_some_and(|drift| drift.is_sure(best, ladder.floor.0));
    let (is_steady, is_surely_not) = (is_steady && !drifts, is_surely_not || drifts);
    if !is_steady {
        depends.insert(0, ("time".to_owned(), 1.0, 1.0));
    }
    let is_significant = is_large && (is_plain || !depends.is_empty()) || is_surely_not;
    let certainty = match is_significant {
        true if depends.is_empty() => 1.0,
        true => depends.iter().map(|(_, _, certainty)| *certainty).fold(0.0, f64::max),
        false => 0.0,
    };
    let mut names: Vec<String> = Vec::new();
    for (name, ..) in &depends {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    Some(Remainder { share, is_large, is_significant, depends_on: names, certainty })
}

/// Whether what is so far beyond chance, and such a share of a gap, is there though nothing says what it depends on.
fn shows_by_itself(beyond_chance: f64, share: f64) -> bool {
    beyond_chance > if share > MOST_OF_IT { 0.5 * THRESHOLD } else { THRESHOLD }
}

/// What share of a gap may be left of which friction and play explain such a share; of one of which a level lies so many `floors` off, less.
fn may_be_left(by_friction: f64, floors: f64) -> f64 {
    let plain = PLAINLY.into_iter().zip(PLAIN_SHARES).rfind(|(least, _)| floors > *least);
    let least = plain.map_or(LEAST_SHARE, |(_, share)| share);
    least.max(LEAST_SHARE_BESIDE_FRICTION.min(by_friction))
}

/// What share may be left because it is not known to the moment when parts come and go.
fn left_by_parts(best: &Trial) -> f64 {
    if best.set.iter().any(|candidate| candidate.effect.id == "load-dependent-speed") {
        LEAST_SHARE_BESIDE_PARTS
    } else {
        0.0
    }
}

/// How much an answer so far leaves to a further effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// Next to nothing of the gap, and little beyond chance, an edge or two; or no more than the law itself is off by.
    Nothing,
    /// No more of it than a law leaves that is only nearly the machine's: how real joints bend, when parts come and go. Where a further effect is the
    /// cause, it takes away nearly all of that.
    Little,
    /// What a further effect may explain a part of.
    Much,
}

/// What `trial` leaves of the gap that is there with the nominal parameters at `bare`.
pub fn left_by(bench: &Bench<'_>, trial: &Trial, bare: &[f64]) -> Left {
    let Some(own) = bench.predict(&trial.set, &trial.at).filter(|_| !trial.set.is_empty()) else { return Left::Much };
    let Some(nominal) = bench.predict(&[], bare) else { return Left::Much };
    let [left, gap] = [&own, &nominal].map(|prediction| bench.subject.score(prediction));
    let share = misfit(&left) / misfit(&gap).max(1e-9);
    let excess = Standing::of(&left).excess(left.total);
    match () {
        () if share > LEAST_SHARE.max(left_by_parts(trial)) => Left::Much,
        () if excess <= FAR_BEYOND * THRESHOLD || is_laws_own(bench.subject, &own, &gap) => Left::Nothing,
        () => Left::Little,
    }
}

/// Whether an effect rubs or has play. A friction that waves along the way takes up much of what is no friction, and one that warms up left a tenth of
/// itself beside it: what it leaves is not how friction bends.
fn sticks(candidate: &Candidate) -> bool {
    let waves = candidate.effect.id == "position-dependent-friction";
    candidate.place == EffectPlace::Mechanics && !waves || PLAY.contains(&candidate.effect.id)
}

/// What is predicted where nothing rubs or has play of what `best` names, and the rest is as it was fitted.
fn without_friction(bench: &Bench<'_>, best: &Trial) -> Option<Arc<Prediction>> {
    let (set, own): (Vec<Candidate>, Vec<&[f64]>) = best
        .values()
        .filter(|(candidate, _)| !sticks(candidate))
        .map(|(candidate, at)| (candidate.clone(), at))
        .unzip();
    let at = [own.concat(), bench.carried(&set, &best.overrides)].concat();
    bench.predict(&set, &at)
}

/// A quantity that a residual may depend on, sample by sample.
struct Regressor {
    name: &'static str,
    values: Vec<f64>,
}

/// What the residuals of all levels depend on: the name, the share explained, and in how many draws that is enough.
fn dependences(bench: &Bench<'_>, prediction: &Prediction, score: &Score) -> Vec<(String, f64, f64)> {
    let mut found: Vec<(String, f64, f64)> = Vec::new();
    for signal in &score.signals {
        let Some(level) = &signal.level else { continue };
        // What lies at its floor holds nothing that could depend on anything.
        if level.at.len() < 10 * BINS || signal.rms < 1.2 * signal.floor {
            continue;
        }
        let Some(regressors) = regressors(bench, prediction, signal.run, signal.signal) else { continue };
        let signs: Vec<f64> =
            regressors.iter().find(|r| r.name == "speed sign").map_or_else(Vec::new, |r| r.values.clone());
        let signed: Vec<f64> = level.difference.iter().zip(&signs).map(|(e, sign)| e * sign).collect();
        for residual in [level.difference.as_slice(), signed.as_slice()] {
            for regressor in &regressors {
                let moving: Vec<usize> = (0..residual.len().min(regressor.values.len()))
                    .filter(|k| signs.get(*k).is_some_and(|sign| *sign != 0.0))
                    .collect();
                let pick = |of: &[f64]| moving.iter().map(|k| of[*k]).collect::<Vec<f64>>();
                let (values, by) = (pick(residual), pick(&regressor.values));
                if values.len() < 10 * BINS {
                    continue;
                }
                let counts = effective_number(&values) / values.len() as f64;
                let share = binned_share(&values, &by, BINS, counts);
                if share > DEPENDS {
                    let sure = certainty(&values, &by);
                    if sure > 0.95 {
                        found.push((regressor.name.to_owned(), share, sure));
                    }
                }
            }
        }
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found
}

/// In how many draws of blocks the share explained stays above what is sure.
fn certainty(values: &[f64], by: &[f64]) -> f64 {
    let block = values.len().div_ceil(24).max(1);
    let blocks = values.len() / block;
    let draws = Draws::new(blocks.max(1), DRAWS / 8, 3);
    let shares = draws.picks(|order| {
        let of = |source: &[f64]| {
            order.iter().flat_map(|b| source[b * block..(b + 1) * block].iter().copied()).collect::<Vec<_>>()
        };
        binned_share(&of(values), &of(by), BINS, 1.0)
    });
    shares.iter().filter(|share| **share > SURELY).count() as f64 / shares.len().max(1) as f64
}

/// Time, way and motion of the device in a run, at the instants of a signal.
fn regressors(bench: &Bench<'_>, prediction: &Prediction, run: usize, signal: usize) -> Option<Vec<Regressor>> {
    let subject = bench.subject;
    let track = subject.runs[run].tracks[signal].as_ref()?;
    let count = track.values.len();
    let instants = &track.grid.instants[track.first..track.first + count];
    let port = |at: usize| subject.signals[at].descriptor;
    let own = port(signal);
    // Of a robot's axis only its own report says anything.
    let is_alone = subject.signals.iter().filter(|info| is_a(info.descriptor, POSITIONS)).count() > 1;
    let level = |wanted: [Quantity; 2]| {
        let of = (0..subject.signals.len()).find(|at| match is_alone {
            true => *at == signal && is_a(own, wanted),
            false => is_a(port(*at), wanted) && !subject.signals[*at].is_count,
        })?;
        match &prediction.runs[run][of] {
            Predicted::Level(values) if values.len() == count => Some(values.clone()),
            _ => None,
        }
    };
    let position = level(POSITIONS);
    let speed = level([Quantity::Velocity, Quantity::AngularVelocity])
        .or_else(|| position.as_ref().map(|position| padded(super::scales::slopes(instants, position))))?;
    let acceleration = padded(super::scales::slopes(instants, &speed));
    let force = level([Quantity::Force, Quantity::Torque]);
    let fast = 1e-3 * super::scales::largest(&speed);
    let sign = speed.iter().map(|v| if v.abs() <= fast { 0.0 } else { v.signum() }).collect();
    let mut way = 0.0;
    let distance: Vec<f64> = speed
        .iter()
        .zip(instants.windows(2).map(|pair| pair[1] - pair[0]).chain([0.0]))
        .map(|(v, span)| {
            way += v.abs() * span;
            way
        })
        .collect();
    let magnitude = |values: &[f64]| values.iter().map(|value| value.abs()).collect::<Vec<f64>>();
    let mut regressors = vec![
        Regressor { name: "time", values: instants.to_vec() },
        Regressor { name: "distance travelled", values: distance },
        Regressor { name: "speed", values: magnitude(&speed) },
        Regressor { name: "speed sign", values: sign },
        Regressor { name: "acceleration", values: magnitude(&acceleration) },
    ];
    regressors.extend(force.map(|values| Regressor { name: "load", values }));
    regressors.extend(position.map(|values| Regressor { name: "position", values }));
    regressors.retain(|regressor| regressor.values.len() == count);
    Some(regressors)
}

const POSITIONS: [Quantity; 2] = [Quantity::Length, Quantity::Angle];

fn is_a(port: &PortDescriptor, wanted: [Quantity; 2]) -> bool {
    port.quantities.iter().any(|quantity| wanted.contains(quantity))
}

/// One more at the end, as the last.
fn padded(mut values: Vec<f64>) -> Vec<f64> {
    values.push(values.last().copied().unwrap_or(0.0));
    values
}

/// How the answer's main parameter changes over the spans of the recordings.
#[derive(Clone, Copy, Debug)]
struct Trend {
    /// The spread of its values as a share of the value.
    spread: f64,
    /// How monotone they are in time, -1 to 1.
    monotone: f64,
    /// What it gains to let it have a value for each span, in deviance for each of them.
    gain: f64,
}

impl Trend {
    /// Whether it is a constant, and whether it surely is none.
    fn judged(&self) -> (bool, bool) {
        let goes = self.spread >= CHANGES && self.monotone.abs() >= MONOTONE;
        let is_surely_not =
            self.gain > GAINS && self.spread >= CHANGES_SURELY && self.monotone.abs() >= MONOTONE_SURELY;
        (!goes && !is_surely_not, is_surely_not)
    }
}

/// How the answer's main parameter goes with time over all recordings together, to first order, all others fitted beside that: of an effect
/// that is little in all of them no span says anything by itself.
#[derive(Clone, Copy, Debug)]
struct Drift {
    /// By which share of what it does it changes from the recordings' begin to their end.
    change: f64,
    /// What that gains in deviance.
    gain: f64,
}

/// In one of ten thousand recordings a constant gains as much as that (chi squared of one degree of freedom): what is fitted is a law of the
/// library, and what rubs is not, so that a constant friction beneath the noise once gained 14.5.
const GAINS_BY_CHANCE: f64 = 15.1;

impl Drift {
    /// Whether the parameter of `best` is surely no constant, where the floor is `floor`: what is left above it is the law's own error, and
    /// gains as much more.
    fn is_sure(&self, best: &Trial, floor: f64) -> bool {
        let dispersion = if floor > 0.0 { (best.cost / floor).max(1.0) } else { 1.0 };
        self.change.abs() >= CHANGES_SURELY && self.gain > GAINS_BY_CHANCE * best.inflation() * dispersion
    }
}

/// Where the answer's main parameter does nothing, and how far it is from there: a gain of 0.994 is a change of 0.006. Of what is nominally
/// without limit, and of a nominal parameter, all of it. `None` where the answer has none.
fn amount(best: &Trial) -> Option<(f64, f64)> {
    let value = *best.at.first().filter(|_| best.parameters() > 0)?;
    let (candidate, free) = best.set.iter().find_map(|candidate| Some((candidate, candidate.free.first()?)))?;
    let parameter = candidate.effect.parameters.iter().find(|parameter| parameter.name == free.name);
    let nominal = parameter.map(|parameter| parameter.nominal).filter(|_| !candidate.is_parameter_error());
    let nominal = nominal.filter(|nominal| nominal.abs() < UNLIMITED).unwrap_or(0.0);
    Some((nominal, value - nominal)).filter(|(_, amount)| *amount != 0.0)
}

/// The drift of the answer's main parameter. `None` where it has none, or no level has a slope.
///
/// Source: the score test of a parameter that is left out, here the rate (C. R. Rao, Proc. Camb. Phil. Soc. 44, 1948, 50–57).
fn drift(bench: &Bench<'_>, best: &Trial) -> Option<Drift> {
    let (_, amount) = amount(best)?;
    let score = bench.subject.score(&*bench.predict(&best.set, &best.at)?);
    let (places, levels) = (score.places(), score.are_levels());
    let slopes = Slopes::of(&|at: &[f64]| bench.residuals(&best.set, at), &best.at, &best.ranges)?;
    // Edges have no slopes; what lies behind the residuals of signals is the parameters' own.
    let of_levels = |parameter: usize| {
        let mut column = slopes.column(parameter);
        column.iter_mut().zip(&levels).filter(|(_, is_level)| !**is_level).for_each(|(slope, _)| *slope = 0.0);
        column
    };
    let columns: Vec<Vec<f64>> = (0..best.at.len()).map(of_levels).collect();
    let mut along = columns.first()?.clone();
    let later =
        |place: Option<(usize, f64)>| place.map_or(0.0, |(run, at)| at / bench.subject.runs[run].ends.max(1e-9) - 0.5);
    let when = places.into_iter().map(later).chain(std::iter::repeat(0.0));
    along.iter_mut().zip(when).for_each(|(slope, when)| *slope *= when);
    let whole = product(&along, &along);
    take_out(&mut along, &orthonormal(&columns));
    let own = product(&along, &along);
    if own <= LEAST_OWN * whole {
        return None;
    }
    let rate = -product(slopes.here(), &along) / own;
    Some(Drift { change: rate / amount, gain: rate * rate * own })
}

/// The trend of the answer's main parameter. `None` where it has none, or too few spans say anything.
fn trend(bench: &Bench<'_>, best: &Trial) -> Option<Trend> {
    let (nominal, amount) = amount(best)?;
    let Range { least, greatest, .. } = best.ranges[0];
    let shares = [0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.5, 1.75, 2.0];
    let grid: Vec<f64> =
        shares.iter().map(|share| nominal + share * amount).filter(|at| (least..=greatest).contains(at)).collect();
    let costs: Vec<Vec<f64>> = grid
        .iter()
        .map(|value| {
            let mut at = best.at.clone();
            at[0] = *value;
            Some(spans(bench, &bench.subject.score(&*bench.predict(&best.set, &at)?)))
        })
        .collect::<Option<_>>()?;
    let inflation = best.inflation();
    let (mut times, mut values) = (Vec::new(), Vec::new());
    let (mut each, mut together) = (0.0, vec![0.0; grid.len()]);
    for span in 0..costs.first()?.len() {
        let along: Vec<f64> = costs.iter().map(|costs| costs[span] / inflation).collect();
        let least = (0..along.len()).min_by(|a, b| along[*a].total_cmp(&along[*b]))?;
        let most = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // A span that does not say anything of the parameter is left out.
        if most - along[least] > 9.0 {
            each += along[least];
            together.iter_mut().zip(&along).for_each(|(sum, cost)| *sum += cost);
            times.push(span as f64);
            values.push(vertex(&grid, &along, least));
        }
    }
    if values.len() < 6 {
        return None;
    }
    let spread = (quantile(&values, 0.9) - quantile(&values, 0.1)) / amount.abs();
    let gain = (together.into_iter().fold(f64::INFINITY, f64::min) - each) / values.len() as f64;
    Some(Trend { spread, monotone: rank_correlation(&values, &times), gain })
}

/// Where a parabola through the least of the costs and its neighbours is least.
fn vertex(grid: &[f64], costs: &[f64], least: usize) -> f64 {
    if least == 0 || least + 1 == grid.len() {
        return grid[least];
    }
    let (a, b, c) = (least - 1, least, least + 1);
    let left = (grid[b] - grid[a]) * (costs[b] - costs[c]);
    let right = (grid[b] - grid[c]) * (costs[b] - costs[a]);
    let below = left - right;
    if below.abs() < 1e-12 {
        return grid[b];
    }
    grid[b] - 0.5 * ((grid[b] - grid[a]) * left - (grid[b] - grid[c]) * right) / below
}

/// The deviance of each span of each run.
fn spans(bench: &Bench<'_>, score: &Score) -> Vec<f64> {
    let mut spans = vec![0.0; SPANS * bench.subject.runs.len()];
    for (run, at, cost) in score.costs() {
        let inside = (at / bench.subject.runs[run].ends.max(1e-9) * SPANS as f64) as usize;
        spans[run * SPANS + inside.min(SPANS - 1)] += cost;
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Subject;
    use crate::gap::cause::axis_tests::{report_as, rubbing_axis};
    use crate::gap::cause::ladder::anew;
    use crate::gap::cause::library::candidates;
    use crate::gap::cause::nuisance::nuisances;

    /// What friction explains to the last step leaves nothing for a second effect; without it all is left.
    #[test]
    fn friction_that_explains_a_gap_asks_for_no_second_effect() {
        let (mut subject, nominal, rubs) = rubbing_axis();
        let stop = || false;
        let at = |bench: &Bench<'_>| [vec![30.0], bench.nominal(&rubs)].concat();
        let bench = Bench::new(&subject, nuisances(&subject, &nominal), &stop);
        let recorded = bench.predict(&rubs, &at(&bench)).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, nuisances(&subject, &nominal), &stop);
        let nothing = bench.nominal(&[]);
        let left = |set: &[Candidate], at: Vec<f64>| left_by(&bench, &bench.trial(set, at).expect("a trial"), &nothing);
        assert_eq!(left(&rubs, at(&bench)), Left::Nothing);
        assert_eq!(left(&rubs, [vec![10.0], bench.nominal(&rubs)].concat()), Left::Much);
        assert_eq!(left(&[], nothing.clone()), Left::Much);
    }

    /// Beside a force that explains nearly all of a gap, what a sensor rounds away is no gap of its own; more of it is.
    #[test]
    fn next_to_nothing_of_a_gap_asks_for_no_second_effect() {
        let (mut subject, nominal, _) = rubbing_axis();
        let one = |id: &str, of: Option<&str>| {
            let all = candidates(&subject, &nominal, &subject.score(&nominal), &|known| known == id);
            all.into_iter().find(|found| of.is_none() || found.component.as_deref() == of).expect("a candidate")
        };
        let set = [one("constant-force", None), one("offset", Some("position"))];
        let step = subject.runs[0].floors.iter().map(|floor| floor.step).fold(f64::INFINITY, f64::min);
        let stop = || false;
        let mut left = |off: f64| {
            let at = [80.0, off * step];
            let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&set, &at).expect("a prediction");
            report_as(&mut subject, &recorded);
            let bench = Bench::new(&subject, Vec::new(), &stop);
            let alone = bench.trial(&set[..1], at[..1].to_vec()).expect("a trial");
            left_by(&bench, &alone, &[])
        };
        // A constant that goes on all along shows beyond chance as soon as it moves what is rounded, which a law may as well be off by.
        assert_eq!([0.3, 0.5, 0.55, 3.0].map(&mut left), [Left::Nothing, Left::Nothing, Left::Nothing, Left::Little]);
    }

    /// Beside a hundred times as much, three fifths of a step that go on all along are evident, and are no more than a law is off by; three steps are too evident for
    /// that, and beside twenty steps it is too much.
    #[test]
    fn what_a_law_is_off_by_is_no_gap() {
        let (mut subject, nominal, _) = rubbing_axis();
        let offsets = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "offset");
        let offset = offsets.into_iter().find(|of| of.component.as_deref() == Some("position")).expect("an offset");
        let step = subject.runs[0].floors.iter().map(|floor| floor.step).fold(f64::INFINITY, f64::min);
        let set = [offset];
        let stop = || false;
        let predict = |subject: &Subject, steps: f64| {
            Bench::new(subject, Vec::new(), &stop).predict(&set, &[steps * step]).expect("a prediction")
        };
        let mut is_own = |off: f64, of: f64| {
            let recorded = predict(&subject, off);
            report_as(&mut subject, &recorded);
            let left = predict(&subject, 0.0);
            assert!(crate::gap::evidence(&subject, &left) > THRESHOLD);
            is_laws_own(&subject, &left, &subject.score(&predict(&subject, off + of)))
        };
        assert!(is_own(0.6, 60.0) && !is_own(0.6, 20.0) && !is_own(3.0, 3000.0));
    }

    /// Friction too little to show in any level by itself: where it grows to nine times what it was that is said, where it stays as it is
    /// nothing is.
    #[test]
    fn friction_that_grows_is_no_constant() {
        let (mut subject, nominal, rubs) = rubbing_axis();
        let fitted = |subject: &Subject| -> (Trial, bool) {
            let stop = || false;
            let bench = Bench::new(subject, nuisances(subject, &nominal), &stop);
            let start = [vec![0.07], bench.nominal(&rubs)].concat();
            let best = bench.fit(&rubs, &[start], anew(1)).expect("a fit");
            let is_sure = drift(&bench, &best).expect("levels").is_sure(&best, best.cost);
            (best, is_sure)
        };
        let (best, is_sure) = fitted(&subject);
        assert!(!is_sure, "{best:?}");
        let rubbing = |force: f64| {
            let stop = || false;
            let bench = Bench::new(&subject, nuisances(&subject, &nominal), &stop);
            let mut at = best.at.clone();
            at[0] = force;
            bench.predict(&rubs, &at).expect("a prediction")
        };
        let [less, more] = [0.2 * best.at[0], 1.8 * best.at[0]].map(rubbing);
        let as_found = rubbing(best.at[0]);
        for (signal, track) in subject.runs[0].tracks.iter_mut().enumerate() {
            let Some(track) = track else { continue };
            let (Predicted::Level(less), Predicted::Level(more), Predicted::Level(as_found)) =
                (&less.runs[0][signal], &more.runs[0][signal], &as_found.runs[0][signal])
            else {
                continue;
            };
            let count = track.values.len() as f64;
            for (at, value) in track.values.iter_mut().enumerate() {
                let late = at as f64 / count;
                *value += less[at] * (1.0 - late) + more[at] * late - as_found[at];
            }
        }
        let (best, is_sure) = fitted(&subject);
        assert!(is_sure, "{best:?}");
    }

    /// Of a gain what it is beyond 1 goes with time, of a friction all of it; a gain of 1 does nothing.
    #[test]
    fn an_amount_is_how_far_a_parameter_is_from_doing_nothing() {
        let (subject, nominal, rubs) = rubbing_axis();
        let gains = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "gain");
        let gains = vec![gains.into_iter().next().expect("a sensor's gain")];
        let stop = || false;
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let of = |set: &[Candidate], value: f64| amount(&bench.trial(set, vec![value]).expect("a trial"));
        let (at_nothing, beyond) = of(&gains, 1.006).expect("an amount");
        assert!(at_nothing == 1.0 && (beyond - 0.006).abs() < 1e-12, "{beyond}");
        assert_eq!(of(&rubs, 30.0), Some((0.0, 30.0)));
        assert_eq!(of(&gains, 1.0), None);
    }

    /// A play of which nobody would notice that it is gone excuses nothing that is left beside it.
    #[test]
    fn friction_leaves_no_more_than_it_explains() {
        let left = |floors: f64| [0.0, 0.005, 0.05, 0.5].map(|by_friction| may_be_left(by_friction, floors));
        assert_eq!(left(9.0), [0.01, 0.01, 0.05, 0.12]);
        assert_eq!(left(11.0), [0.002, 0.005, 0.05, 0.12]);
        assert_eq!(left(101.0), [0.0003, 0.005, 0.05, 0.12]);
        assert_eq!(left(301.0), [3e-5, 0.005, 0.05, 0.12]);
    }

    #[test]
    fn most_of_a_gap_shows_sooner_than_a_part_of_it() {
        let shows = |share: f64| [0.4, 0.6, 1.1].map(|by| shows_by_itself(by * THRESHOLD, share));
        assert_eq!((shows(0.2), shows(0.4)), ([false, false, true], [false, true, true]));
    }

    #[test]
    fn the_vertex_of_a_parabola_is_found() {
        let grid = [1.0, 2.0, 4.0, 5.0];
        let costs: Vec<f64> = grid.iter().map(|x| (x - 3.1_f64).powi(2)).collect();
        assert!((vertex(&grid, &costs, 2) - 3.1).abs() < 1e-9);
        assert_eq!(vertex(&grid, &costs, 0), 1.0);
    }
}
