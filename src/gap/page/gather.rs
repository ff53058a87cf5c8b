//! The pictures' data from a study of held-out recordings.

use crate::effect::EffectError;
use crate::gap::{EdgeScore, Overrides, Predicted, PredictedEdge, Prediction, SignalScore, Study, Subject, Track};
use crate::plant::{EffectSpec, Plant};

use super::evidence::{EdgeError, Evidence, Series, Strip, Switching, sites};

/// How many pictures there are of a device: levels, and truth values.
const LEVELS: usize = 3;
const EDGES: usize = 3;
/// A smaller gain (a difference of −2 ln of likelihoods) is none that a test at 1 % would find with 95 % power: (2.576 + 1.645)².
const LEAST_GAIN: f64 = 17.8;
/// How long the spans are that pictures show, in seconds: long enough for a few motions, short enough to see one.
const SHOWN_S: f64 = 12.0;
const STRIP_S: f64 = 8.0;

/// What is added to a device; nothing where its gap is to be shown as it is.
#[derive(Clone, Copy, Debug)]
pub struct Added<'a> {
    /// The subject's name.
    pub device: &'a str,
    pub effects: &'a [EffectSpec],
    /// The nominal parameters that were refitted with them.
    pub overrides: &'a Overrides,
}

/// The evidence of `study`, whose recordings are held out: of each device of `added` those signals that gain most by what
/// is added (or are the worst, where nothing is), each over the span that shows it best.
///
/// # Errors
/// What is added does not fit.
pub fn gather(plant: &Plant, study: &Study, added: &[Added<'_>]) -> Result<Evidence, EffectError> {
    let mut evidence = Evidence { plant: plant.name.clone(), sites: sites(plant), ..Evidence::default() };
    for added in added {
        let at = study.subjects.iter().position(|subject| subject.name == added.device);
        let Some((subject, nominal)) = at.map(|at| (&study.subjects[at], &study.bare[at].prediction)) else { continue };
        let has_effect = !added.effects.is_empty();
        let predicted = match has_effect {
            true => Some(subject.predict(added.effects, added.overrides)?),
            false => None,
        };
        let device = Device { subject, nominal, with_effect: predicted.as_ref() };
        device.show(&mut evidence);
    }
    Ok(evidence)
}

struct Device<'a> {
    subject: &'a Subject,
    nominal: &'a Prediction,
    with_effect: Option<&'a Prediction>,
}

/// A signal in a run, with what it costs without and with the effect.
struct Shown {
    nominal: SignalScore,
    with_effect: Option<SignalScore>,
    gain: f64,
}

impl Device<'_> {
    fn show(&self, evidence: &mut Evidence) {
        let with_effect = self.with_effect.map(|predicted| self.subject.score(predicted).signals);
        let mut best: Vec<Option<Shown>> = self.subject.signals.iter().map(|_| None).collect();
        for (index, nominal) in self.subject.score(self.nominal).signals.into_iter().enumerate() {
            let with_effect = with_effect.as_ref().map(|scores| scores[index].clone());
            let floor = nominal.floor_cost.0;
            let gain = nominal.cost - with_effect.as_ref().map_or(floor, |score| score.cost);
            let known = &mut best[nominal.signal];
            if known.as_ref().is_none_or(|known| known.gain < gain) {
                *known = Some(Shown { nominal, with_effect, gain });
            }
        }
        let mut shown: Vec<Shown> = best.into_iter().flatten().filter(|shown| shown.gain > LEAST_GAIN).collect();
        shown.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        let (levels, edges): (Vec<Shown>, Vec<Shown>) = shown.into_iter().partition(|s| s.nominal.level.is_some());
        evidence.series.extend(levels.iter().take(LEVELS).filter_map(|shown| self.series(shown)));
        evidence.strips.extend(edges.iter().take(EDGES).filter_map(|shown| self.strip(shown)));
    }

    fn of(&self, shown: &Shown) -> Option<(&Track, &Predicted, Option<&Predicted>, String)> {
        let (run, signal) = (shown.nominal.run, shown.nominal.signal);
        let track = self.subject.runs[run].tracks[signal].as_ref()?;
        let with_effect = self.with_effect.map(|predicted| &predicted.runs[run][signal]);
        Some((track, &self.nominal.runs[run][signal], with_effect, self.subject.runs[run].recording.clone()))
    }

    fn series(&self, shown: &Shown) -> Option<Series> {
        let (track, nominal, with_effect, recording) = self.of(shown)?;
        let level = shown.nominal.level.as_ref()?;
        let costs = level.at.iter().copied().zip(level.cost.iter().copied());
        let [from, to] = worst_span(costs, track.span(), SHOWN_S);
        let info = &self.subject.signals[shown.nominal.signal];
        // A counter that shows 5 stands between 5 and 6.
        let half = if info.is_count { 0.5 } else { 0.0 };
        let instants = &track.grid.instants[track.first..];
        let kept: Vec<usize> = (0..track.values.len()).filter(|at| (from..=to).contains(&instants[*at])).collect();
        let pick = |values: &[f64]| kept.iter().map(|at| values.get(*at).copied().unwrap_or(f64::NAN)).collect();
        let values_of = |predicted: &Predicted| match predicted {
            Predicted::Level(values) => Some(pick(values)),
            _ => None,
        };
        let seen = |at: &usize| if track.is_blind(track.first + at) { f64::NAN } else { track.values[*at] + half };
        Some(Series {
            signal: info.name.clone(),
            unit: info.unit.clone(),
            caption: caption(&recording, [from, to]),
            times: pick(instants),
            measured: kept.iter().map(seen).collect(),
            nominal: values_of(nominal)?,
            with_effect: with_effect.and_then(values_of),
            floor: shown.nominal.floor,
        })
    }

    fn strip(&self, shown: &Shown) -> Option<Strip> {
        let (track, nominal, with_effect, recording) = self.of(shown)?;
        let costs = shown.nominal.edges.iter().map(|edge| (edge.at(), edge.cost));
        let span = worst_span(costs, track.span(), STRIP_S);
        let recorded = track.edges.iter().map(|edge| (track.grid.instants[edge.index], edge.to));
        let with_scores = shown.with_effect.as_ref().map(|score| &score.edges);
        Some(Strip {
            signal: self.subject.signals[shown.nominal.signal].name.clone(),
            caption: caption(&recording, span),
            span,
            measured: switching(track.initial, recorded),
            nominal: predicted_switching(nominal)?,
            with_effect: with_effect.and_then(predicted_switching),
            late: late(&shown.nominal.edges, with_scores.map_or(&[], Vec::as_slice)),
            cycle: track.grid.cycle,
        })
    }
}

fn caption(recording: &str, [from, to]: [f64; 2]) -> String {
    format!("From {recording}, {from:.1} s to {to:.1} s")
}

/// The span of `length` seconds that holds most of the costs, within that of the recording.
fn worst_span(costs: impl Iterator<Item = (f64, f64)>, (begins, ends): (f64, f64), length: f64) -> [f64; 2] {
    if ends - begins <= length {
        return [begins, ends];
    }
    // Half a second before the first of them, so that it is seen to begin.
    const BEFORE_S: f64 = 0.5;
    let costs: Vec<(f64, f64)> = costs.collect();
    let (mut best, mut sum, mut first) = ((0.0, begins), 0.0, 0);
    for (at, cost) in &costs {
        sum += cost;
        while costs[first].0 < at - (length - 2.0 * BEFORE_S) {
            sum -= costs[first].1;
            first += 1;
        }
        if sum > best.0 {
            best = (sum, costs[first].0);
        }
    }
    let from = (best.1 - BEFORE_S).clamp(begins, ends - length);
    [from, from + length]
}

fn switching(initial: f64, edges: impl Iterator<Item = (f64, f64)>) -> Switching {
    let initial = initial != 0.0;
    let mut state = initial;
    // Of a signal with more than two states, whether it is any but 0.
    let changes = edges.filter_map(|(at, to)| {
        let is_change = (to != 0.0) != state;
        state = to != 0.0;
        is_change.then_some(at)
    });
    Switching { initial, changes: changes.collect() }
}

fn predicted_switching(predicted: &Predicted) -> Option<Switching> {
    let Predicted::Edges { initial, edges, .. } = predicted else { return None };
    Some(switching(*initial, edges.iter().map(|edge: &PredictedEdge| (edge.at, edge.to))))
}

/// How late each recorded edge is, against the middle of the cycle in which it came.
fn late(nominal: &[EdgeScore], with_effect: &[EdgeScore]) -> Vec<EdgeError> {
    let by = |edge: &EdgeScore| {
        let (before, seen) = edge.recorded?;
        Some((seen, edge.predicted.map(|predicted| predicted - (before + seen) / 2.0)))
    };
    let others: Vec<(f64, Option<f64>)> = with_effect.iter().filter_map(by).collect();
    let error = |(at, nominal): (f64, Option<f64>)| {
        let other = others.iter().find(|(other, _)| *other == at).and_then(|(_, late)| *late);
        EdgeError { at, nominal, with_effect: other }
    };
    nominal.iter().filter_map(by).map(error).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_span_is_shown() {
        let costs = || (0..100).map(|k| (f64::from(k), if (40..45).contains(&k) { 9.0 } else { 0.1 }));
        let [from, to] = worst_span(costs(), (0.0, 99.0), 10.0);
        assert!(from <= 40.0 && to >= 44.0 && to - from == 10.0, "{from} to {to}");
        assert_eq!(worst_span(costs(), (0.0, 8.0), 10.0), [0.0, 8.0]);
        assert_eq!(worst_span(std::iter::empty(), (5.0, 99.0), 10.0), [5.0, 15.0]);
    }

    #[test]
    fn a_signal_of_several_states_is_on_or_off() {
        let changes = [(1.0, 1.0), (2.0, -1.0), (3.0, 0.0), (4.0, 0.0)];
        let found = switching(0.0, changes.into_iter());
        assert_eq!(found, Switching { initial: false, changes: vec![1.0, 3.0] });
    }
}
