//! Whether the parts of a bay come as its schedule says.
//!
//! A bay reports nothing. When it puts a part, the part moves with the belt until the first beam sees it, and how far the belt went
//! by when is known where the belt's own model explains all that it reports. So the beam's rising edges are a measurement of the
//! schedule: a subject of its own, the bay, is driven by the belt's way and predicts them. Where the beam exactly is, how long a
//! part is and where it is put are latent together, within their tolerances; the instants themselves are counted, not built, and
//! have none.
//!
//! Only a schedule that explains them is an answer: why parts come to a beam otherwise, nobody says who does not report it.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::alone;
use super::bay::{self, Bay};
use super::cause::Bare;
use super::locate::{THRESHOLD, evidence};
use super::prediction::{Passing, Predicted, PredictedEdge};
use super::study::Study;
use super::subject::{Run, Subject, beam_of};
use super::track::Track;
use super::way::Way;
use super::{Floor, Overrides};
use crate::device::{Device, Role};
use crate::effect::EffectError;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue, Parameters};

/// The effect that is looked for.
pub const PART_SPACING: &str = "part-spacing-error";
/// The effect of a link by which a beam is told later, and no otherwise.
const DEAD_TIME: &str = "dead-time";

/// How finely the belt's way is known, s.
const STEP_S: f64 = 5e-3;
/// Of fewer parts nobody can tell a spacing from where the first one came.
const LEAST_RISES: usize = 4;

/// What the parts of a bay meet in a run.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// How far the belt went, by its model.
    way: Way,
    /// Where the beam is and where the belt ends, m from its start.
    beam: f64,
    end: f64,
    /// How much later than it changes the beam is reported, s.
    late: f64,
}

/// A part on the belt: from when to when, s, and how much further than the belt's way its middle is, m.
#[derive(Clone, Copy, Debug)]
struct Put {
    from: f64,
    to: f64,
    ahead: f64,
}

impl Course {
    /// The rising edges of the beam, of the parts that a bay puts.
    pub fn rises(&self, bay: Box<dyn Device>, track: &Track) -> Predicted {
        let ends = self.way.instants.last().copied().unwrap_or(0.0);
        let (at, length, limit) = match bay.role() {
            Role::Makes(source) => {
                (source.at[0], source.size[0], source.limit.map_or(usize::MAX, |limit| limit as usize))
            }
            _ => (0.0, 0.0, 0),
        };
        let mut puts: Vec<Put> = Vec::new();
        for from in bay::due(bay, ends) {
            let ahead = at - self.way.at(from);
            // Its place is free if no part is within a length of it.
            let is_free = |put: &Put| put.to <= from || (put.ahead - ahead).abs() >= length;
            if puts.len() < limit && puts.iter().all(is_free) {
                puts.push(Put { from, to: self.leaves(from, ahead), ahead });
            }
        }
        let mut cuts: Vec<(f64, f64, usize)> = Vec::new();
        for (part, put) in puts.iter().enumerate() {
            cuts.extend(self.cuts(put, 0.5 * length).into_iter().map(|(from, to)| (from, to, part)));
        }
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut dark = f64::NEG_INFINITY;
        let mut edges = Vec::new();
        for (from, to, part) in cuts {
            if from > dark {
                edges.extend(self.edge(from, part, track));
            }
            dark = dark.max(to);
        }
        Predicted::Edges { initial: 0.0, edges, unseen: Vec::new(), turns: Vec::new() }
    }

    /// When a part is no more on the belt, s.
    fn leaves(&self, from: f64, ahead: f64) -> f64 {
        let after = self.way.instants.partition_point(|at| *at <= from);
        let is_off = |place: &usize| !(0.0..=self.end).contains(&(self.way.metres[*place] + ahead));
        (after..self.way.instants.len()).find(is_off).map_or(f64::INFINITY, |place| self.way.instants[place])
    }

    /// From when to when a part cuts the beam, s; `half`: half of its length, m.
    fn cuts(&self, put: &Put, half: f64) -> Vec<(f64, f64)> {
        let apart = |way: f64| (way + put.ahead - self.beam).abs() - half;
        let mut cuts = Vec::new();
        let mut before = (put.from, apart(self.way.at(put.from)));
        let mut since = (before.1 < 0.0).then_some(put.from);
        let after = self.way.instants.partition_point(|at| *at <= put.from);
        for place in after..self.way.instants.len() {
            let now = (self.way.instants[place], apart(self.way.metres[place]));
            if now.0 > put.to {
                break;
            }
            let crossed = before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1);
            match since {
                None if now.1 < 0.0 => since = Some(crossed),
                Some(from) if now.1 >= 0.0 => {
                    cuts.push((from, crossed));
                    since = None;
                }
                _ => {}
            }
            before = now;
        }
        cuts.extend(since.map(|from| (from, put.to)));
        cuts
    }

    /// A rising edge as the track shows it; `None` behind its end.
    fn edge(&self, at: f64, part: usize, track: &Track) -> Option<PredictedEdge> {
        let speed = (self.way.at(at + STEP_S) - self.way.at(at)).abs() / STEP_S;
        let at = at + self.late;
        let index = track.grid.instants.partition_point(|instant| *instant < at);
        let is_seen = index > track.first && index < track.grid.instants.len();
        is_seen.then_some(PredictedEdge { at, index, to: 1.0, part: Some(Passing { part, speed, astray: 0.0 }) })
    }
}

impl Study {
    /// The same with the bays beside the devices that report: those whose belts have no gap of their own, or, where these are
    /// recordings that `trained` has not seen, those that it has.
    pub(super) fn with_bays(mut self, trained: Option<&Study>) -> Result<Study, EffectError> {
        let mut bays = Vec::new();
        for (belt, bare) in self.subjects.iter().zip(&self.bare) {
            let Some(bay) = &belt.bay else { continue };
            let known = trained.map(|trained| {
                let is_it = |subject: &&(&Subject, &Bare)| subject.0.is_bay() && subject.0.id == bay.id;
                trained.subjects.iter().zip(&trained.bare).find(|each| is_it(&each)).map(|(_, bare)| bare)
            });
            let Some(subject) = of_belt(belt, bay, (&[], &bare.overrides))? else { continue };
            let nominal = subject.predict(&[], &Overrides::none())?;
            let bare = match known {
                Some(None) => continue,
                Some(Some(known)) => known.beside(&subject, &nominal),
                None if evidence(belt, &bare.prediction) > THRESHOLD || !is_told(&subject) => continue,
                None => Bare::new(&subject, &nominal),
            };
            bays.push((subject, nominal, bare));
        }
        for (subject, nominal, bare) in bays {
            self.subjects.push(subject);
            self.nominal.push(nominal);
            self.bare.push(bare);
        }
        Ok(self)
    }
}

/// Whether its recordings say how a bay's parts are spaced: enough of them came, and the recordings begin with the schedule.
fn is_told(bay: &Subject) -> bool {
    let rises = |run: &Run| run.tracks.iter().flatten().map(|track| track.edges.len()).sum::<usize>();
    bay.runs.iter().map(rises).sum::<usize>() >= LEAST_RISES && !bay.runs.iter().any(|run| run.settles)
}

/// What the rises of a belt's first beam say of the belt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told {
    /// How far they are from the schedule of the bay, and that from where it may put its parts, in deviance.
    pub cost: f64,
    /// Whether they follow it.
    pub is_followed: bool,
}

/// How the rises of the beam that first sees the parts of a bay fit its schedule, where the belt has these effects and nominal parameters. `None` where
/// no bay feeds it, too few parts came, or an effect changes what the beam shows in another way than by a delay of its report.
///
/// # Errors
/// Effects that the belt cannot have.
pub(super) fn told(
    belt: &Subject,
    (specs, overrides): (&[EffectSpec], &Overrides),
) -> Result<Option<Told>, EffectError> {
    let is_seen_through = |spec: &EffectSpec| {
        spec.place == EffectPlace::ReportLink && spec.kind != DEAD_TIME || spec.place == EffectPlace::Sensor
    };
    let Some(bay) = belt.bay.as_ref().filter(|_| !specs.iter().any(is_seen_through)) else { return Ok(None) };
    let Some(subject) = of_belt(belt, bay, (specs, overrides))?.filter(is_told) else { return Ok(None) };
    let bare = Bare::new(&subject, &subject.predict(&[], &Overrides::none())?);
    let strains = bare.nuisances.iter().zip(&bare.at).map(|(nuisance, at)| nuisance.strain(*at).powi(2));
    Ok(Some(Told {
        cost: subject.score(&bare.prediction).total + strains.sum::<f64>(),
        is_followed: evidence(&subject, &bare.prediction) <= THRESHOLD,
    }))
}

/// How much later effects have a port reported, s.
fn later(specs: &[EffectSpec], port: &str) -> f64 {
    let is_its = |spec: &&EffectSpec| {
        spec.kind == DEAD_TIME
            && spec.place == EffectPlace::ReportLink
            && spec.component.as_deref().is_none_or(|component| component == port)
    };
    let time = |spec: &EffectSpec| match spec.parameters.get("time") {
        Some(ParameterValue::Number(time)) => *time,
        _ => 0.0,
    };
    specs.iter().filter(is_its).map(time).sum()
}

/// The bay that feeds a belt which has these effects and nominal parameters, as a subject of its own; `None` where no beam that is reported is ahead of its
/// parts.
fn of_belt(
    belt: &Subject,
    bay: &Bay,
    (specs, overrides): (&[EffectSpec], &Overrides),
) -> Result<Option<Subject>, EffectError> {
    let device = belt.device(specs, overrides)?;
    let Role::Carries(of) = device.role() else { return Ok(None) };
    let at = bay.at;
    let ahead = belt.signals.iter().enumerate().filter_map(|(signal, info)| {
        let beam = of.barriers[beam_of(info)?].filter(|beam| *beam > at)?;
        Some((signal, beam))
    });
    let Some((signal, beam)) = ahead.min_by(|a, b| a.1.total_cmp(&b.1)) else { return Ok(None) };
    let run = |run: &Run| -> Run {
        let instants: Vec<f64> = (0..=(run.ends / STEP_S) as u32).map(|step| f64::from(step) * STEP_S).collect();
        let way = Way { metres: alone::travel(device.boxed(), run, &instants), instants };
        let late = later(specs, &belt.signals[signal].property) - belt.lead(&belt.signals[signal], run);
        Run {
            commands: Vec::new(),
            tracks: vec![run.tracks[signal].as_ref().map(rising)],
            floors: vec![Floor { step: 1.0, ..Floor::default() }],
            edge_sigmas: vec![run.edge_sigmas[signal]],
            rests: vec![Vec::new()],
            repeated: vec![Vec::new()],
            script: Arc::default(),
            among_neighbours: Arc::default(),
            part_lengths: Vec::new(),
            settings: BTreeMap::new(),
            course: Some(Arc::new(Course { way, beam, end: of.surface.length(), late })),
            ..run.clone()
        }
    };
    Ok(Some(Subject {
        id: bay.id,
        name: bay.name.clone(),
        kind: bay.kind,
        parameters: exact(&bay.parameters, beam, belt),
        effects: bay.effects.clone(),
        signals: vec![belt.signals[signal].clone()],
        runs: belt.runs.iter().map(run).collect(),
        bay: None,
        likely: Overrides::none(),
        instance: bay.name.clone(),
        commanded: Vec::new(),
    }))
}

/// The rising edges of a barrier.
fn rising(track: &Track) -> Track {
    let mut rising = track.clone();
    rising.initial = 0.0;
    rising.edges.retain(|edge| edge.to != 0.0);
    rising.origins.clear();
    rising
}

/// A bay's parameters with the tolerances of where its parts' fronts are, by the beam, all in where it puts them, and with none of
/// its instants.
fn exact(parameters: &Parameters, beam: f64, belt: &Subject) -> Parameters {
    let mut exact = parameters.clone();
    let tolerance = |of: &Parameters, name: &str| of.0.get(name).map_or(0.0, |parameter| parameter.tolerance);
    let at = parameters.number("at");
    let length = parameters.numbers("size").first().copied().unwrap_or(0.0);
    let beams = ["barrierA", "barrierB"].map(|name| tolerance(&belt.parameters, name));
    let off = (tolerance(parameters, "at") * at)
        .hypot(beams[0].max(beams[1]) * beam)
        .hypot(0.5 * tolerance(parameters, "size") * length);
    for (name, parameter) in &mut exact.0 {
        parameter.tolerance = if *name == "at" { off / at.max(1e-3) } else { 0.0 };
    }
    exact
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::recorded_tests::{PUT_AT_A_BEAM, study};
    use crate::gap::statistics::SAME_CLASS;

    /// A part that is put into a beam cuts it from then on, however deep in it. That the beam is 3 mm further on, which is within its tolerance, shows all the
    /// same: by 5 to 15 ms while the belt runs, and by 0.4 s where it stops right then.
    #[test]
    fn a_beam_may_be_a_little_ahead_of_where_parts_are_put() {
        let study = study(PUT_AT_A_BEAM);
        let bay = study.subjects.iter().position(Subject::is_bay).expect("a bay");
        let (subject, bare) = (&study.subjects[bay], &study.bare[bay]);
        assert!(evidence(subject, &study.nominal[bay]) > THRESHOLD);
        assert!(evidence(subject, &bare.prediction) <= THRESHOLD, "{:?}", bare.overrides);
        let at = bare.overrides.0.get("at").copied().expect("where parts are put");
        assert!((2.5e-3..4.5e-3).contains(&(0.15 - at)), "{at}");
    }

    /// When a bay put parts into the first beam is known: reports that come 30 ms late do not fit that, nor does a beam that stands 50 mm further on, as the other
    /// beam might.
    #[test]
    fn a_schedule_tells_what_a_belt_does_not_report() {
        let study = study(PUT_AT_A_BEAM);
        let place = study.subjects.iter().position(|subject| subject.bay.is_some()).expect("a belt");
        let (belt, overrides) = (&study.subjects[place], &Overrides::none());
        let spec = |place, kind: &str, component: Option<&str>, (name, value): (&str, f64)| EffectSpec {
            place,
            kind: kind.to_owned(),
            component: component.map(str::to_owned),
            parameters: [(name.to_owned(), ParameterValue::Number(value))].into(),
        };
        let told = |specs: &[EffectSpec]| told(belt, (specs, overrides)).expect("its effects").expect("a bay");
        let off = |beam: &str, by: f64| {
            let value = belt.parameters.number(beam) + by;
            told(&[spec(EffectPlace::Actuator, "parameter-error", Some(beam), ("value", value))])
        };
        let plain = told(&[]);
        assert!(plain.is_followed);
        let same = off("barrierB", 0.05);
        assert!(same.is_followed && (same.cost - plain.cost).abs() < 1.0, "{same:?} {plain:?}");
        let late = told(&[spec(EffectPlace::ReportLink, DEAD_TIME, None, ("time", 0.03))]);
        for other in [late, off("barrierA", 0.05)] {
            assert!(!other.is_followed && other.cost > plain.cost + SAME_CLASS, "{other:?} {plain:?}");
        }
        let blind = spec(EffectPlace::Sensor, "blind-range", Some("lightBarrierA"), ("length", 0.05));
        assert!(super::told(belt, (&[blind], overrides)).expect("its effects").is_none());
    }
}
