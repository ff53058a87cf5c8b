//! The experiment that would tell rivals apart: a motion that the machine can play.
//!
//! A report names, beside its cause, the rivals that its recordings could not tell from it. Here motions of several kinds
//! ([`design`]) are scaled to what the machine may be asked ([`bounds`]) and played on the model with the cause and with each
//! rival. A rival is fitted to the cause's output on the very motion, with all that a diagnosis would leave free: how far
//! apart the two still are, in units of the noise, is what a diagnosis of the recorded experiment would have to go by. The
//! motion that parts the closest pair best is chosen; where another parts another pair better, it follows.
//!
//! A difference of squared distance L is found by a test of 1 % with the power P(χ'²₁(L) > 6.63) = Φ(√L − 2.576) +
//! Φ(−√L − 2.576), the noncentral χ² distribution with one degree of freedom.

pub mod bounds;
pub mod design;
mod rivals;
mod script;

use std::collections::BTreeMap;
use std::io::{self, Write};

use bounds::Bounds;
use design::{Design, JUMPS, STREAMS, SWITCHED};
use rayon::prelude::*;
use rivals::{Pair, pairs};
pub use script::Line;
use script::{Channel, channels};

use super::cause::{Bench, nuisances};
use super::cost::normal;
use super::fit::sum_of_squares;
use super::report::{Member, Report};
use super::{Recording, Study, StudyError, Subject};
use crate::engine::BuildError;
use crate::plant::Plant;
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::trace::{Compression, Header, Sender, Writer};
use crate::wire::SendValueText;

/// A motion, and what it should show.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// What it is made of, in its order.
    pub motions: Vec<&'static str>,
    /// The automation's lines.
    pub lines: Vec<Line>,
    /// How long it takes, s.
    pub span_s: f64,
    /// One for each rival.
    pub separations: Vec<Separation>,
}

/// How far a cause and a rival lie apart on an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Separation {
    pub cause: Member,
    pub rival: Member,
    /// The whitened squared distance that remains when the rival is fitted to the cause's output.
    pub distance: f64,
    /// How probably a test of 1 % error tells them apart.
    pub power: f64,
}

/// Why there is no experiment.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    #[error("the report names no rival: there is nothing to tell apart")]
    NoRival,
    #[error("the report names the device {found:?}, which the model does not have: is it a report of this model?")]
    UnknownDevice { found: String },
    #[error("the report's {found}: {reason}")]
    Effect { found: String, reason: String },
    #[error(
        "nothing says how far {signal} may go: declare it with --bounds {signal}=LEAST..GREATEST, or by min and max in the \
         prototype"
    )]
    Unbounded { signal: String },
    #[error("{device} takes no command: no motion of its own can be asked of it")]
    NoCommand { device: String },
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error("the model cannot be run: {0}")]
    Build(#[from] BuildError),
}

/// Power that is enough. Twice the distance of a class (0.95), because what is planned with parameters that are not quite right
/// must still be found; what more motion adds is not worth the machine's time.
const ENOUGH: f64 = 0.999;
/// A test of 1 % error, both ways: 2.576² = 6.63.
const TWO_SIDED_1_PERCENT: f64 = 2.576;
/// A relative change of a parameter that no recording could show, and that may not change what is seen.
const NUDGE: f64 = 1e-6;
/// The most motions in an experiment.
const MOST_MOTIONS: usize = 3;

/// The power of a test of 1 % error where the squared distance is `distance`.
pub fn power(distance: f64) -> f64 {
    let root = distance.max(0.0).sqrt();
    normal(root - TWO_SIDED_1_PERCENT) + normal(-root - TWO_SIDED_1_PERCENT)
}

/// Plans the experiment for `report`, a diagnosis of `plant` by `recordings`: these say how the machine reports, how noisy it
/// is, and what it has been asked. `declared` bounds of commands count before those.
///
/// # Errors
/// A report without rivals, or of another model; a command without bounds.
pub fn plan(
    plant: &Plant,
    report: &Report,
    recordings: &[Recording],
    declared: &BTreeMap<RegisterId, Bounds>,
) -> Result<Experiment, PlanError> {
    let pairs = pairs(plant, report)?;
    let trained = Study::new(plant, recordings)?;
    let mut tried: Vec<Tried> = Vec::new();
    let mut devices: Vec<&str> = pairs.iter().map(|pair| pair.device()).collect();
    devices.dedup();
    for device in devices {
        let own: Vec<(usize, &Pair)> = pairs.iter().enumerate().filter(|(_, pair)| pair.device() == device).collect();
        let subject = trained.subject(pairs[own[0].0].subject()).expect("the pairs name subjects of the study");
        let channels = channels(plant, subject, own[0].1.axis(), recordings, declared)?;
        let designs: Vec<&Design> = match channels.iter().find_map(Channel::jumps) {
            None => SWITCHED.iter().collect(),
            Some(true) => JUMPS.iter().collect(),
            Some(false) => JUMPS.iter().chain(STREAMS).collect(),
        };
        let found: Vec<Tried> = designs
            .par_iter()
            .map(|design| attempt(plant, subject, design, &channels, &own, recordings))
            .collect::<Result<_, PlanError>>()?;
        tried.extend(found);
    }
    Ok(choose(&tried, &pairs))
}

/// A motion that was tried.
struct Tried {
    name: &'static str,
    lines: Vec<Line>,
    /// By the pairs' places; 0 for a pair of another device.
    distances: Vec<f64>,
}

/// Plays a motion on the model with each cause, and fits each rival to it.
fn attempt(
    plant: &Plant,
    trained: &Subject,
    design: &Design,
    channels: &[Channel],
    pairs: &[(usize, &Pair)],
    recordings: &[Recording],
) -> Result<Tried, PlanError> {
    let lines = script::lines(design, channels);
    let recording = script::play(plant, &lines, script::LENGTH_S, recordings)?;
    let study = Study::new(plant, &[recording])?;
    let mut subject = study.subject(&trained.name).expect("the same plant has the same subjects").clone();
    for run in &mut subject.runs {
        // The machine's noise, not that of a model without any.
        run.floors.clone_from(&trained.runs[0].floors);
        run.edge_sigmas.clone_from(&trained.runs[0].edge_sigmas);
    }
    let last = pairs.iter().map(|(place, _)| *place).max().unwrap_or(0);
    let mut distances = vec![0.0; last + 1];
    for (place, pair) in pairs {
        distances[*place] = distance(&subject, pair).unwrap_or(0.0);
    }
    Ok(Tried { name: design.name, lines, distances })
}

/// What is left between a cause and a rival that was fitted to it, whitened and squared. `None` where the motion tells
/// nothing: where the device is driven harder than it can follow, its way hangs on less than anybody can know.
fn distance(subject: &Subject, pair: &Pair) -> Option<f64> {
    let nominal = subject.predict(&[], &super::Overrides::none()).ok()?;
    let bench = Bench::new(subject, nuisances(subject, &nominal), &|| false);
    let output = bench.predict(&pair.cause.set, &pair.cause.at)?;
    let nudged: Vec<f64> = pair.cause.at.iter().map(|value| value * (1.0 + NUDGE)).collect();
    if sum_of_squares(&subject.apart(&output, &*bench.predict(&pair.cause.set, &nudged)?)) > 1.0 {
        return None;
    }
    let set = &pair.rival.set;
    let mut at = pair.rival.at.clone();
    at.extend(bench.nominal(set));
    bench.distance(&output, set, &at)
}

/// The motion that parts the closest pair best; then, while a pair is not parted, the one that adds most to it.
fn choose(tried: &[Tried], pairs: &[Pair]) -> Experiment {
    let mut sums = vec![0.0; pairs.len()];
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < MOST_MOTIONS && sums.iter().any(|sum| power(*sum) < ENOUGH) {
        let worst = |at: &usize| {
            let with = (0..pairs.len())
                .map(|pair| power(sums[pair] + tried[*at].distances.get(pair).copied().unwrap_or_default()));
            // The least power counts; among equals, all of it.
            let all: Vec<f64> = with.collect();
            all.iter().copied().fold(f64::INFINITY, f64::min) + 1e-3 * all.iter().sum::<f64>()
        };
        let left = (0..tried.len()).filter(|at| !chosen.contains(at));
        let Some(best) = left.max_by(|a, b| worst(a).total_cmp(&worst(b))) else { break };
        chosen.push(best);
        for (sum, distance) in sums.iter_mut().zip(&tried[best].distances) {
            *sum += distance;
        }
    }
    let mut lines = Vec::new();
    for (place, at) in chosen.iter().enumerate() {
        let start = place as f64 * script::LENGTH_S;
        lines.extend(tried[*at].lines.iter().map(|line| Line { at: line.at + start, ..line.clone() }));
    }
    let separations = pairs.iter().zip(&sums).map(|(pair, distance)| Separation {
        cause: pair.members[0].clone(),
        rival: pair.members[1].clone(),
        distance: *distance,
        power: power(*distance),
    });
    Experiment {
        motions: chosen.iter().map(|at| tried[*at].name).collect(),
        lines,
        span_s: chosen.len() as f64 * script::LENGTH_S,
        separations: separations.collect(),
    }
}

impl Experiment {
    /// Writes it as a trace that a machine, or a server that plays traces, can be driven by: the automation's side alone.
    /// It lasts until the machine has come to rest.
    ///
    /// # Errors
    /// What writing to `out` gives.
    pub fn write<W: Write>(&self, map: &SignalMap, model: &str, out: W, compression: Compression) -> io::Result<W> {
        let note = Some(format!("an experiment: {}", self.motions.join("; ")));
        let header = Header { model: Some(model.to_owned()), note, ..Header::default() };
        let mut writer = Writer::new(out, compression, &header)?;
        let mut instant = |lines: &[Line]| {
            let mut text = SendValueText::with_capacity(lines.len());
            for line in lines {
                text.push(&map.signal(line.register).name, &line.value).map_err(io::Error::other)?;
            }
            text.finish()
                .map_or(Ok(()), |text| writer.message(Instant::from_seconds(lines[0].at), Sender::Automation, &text))
        };
        for lines in self.lines.chunk_by(|a, b| a.at == b.at) {
            instant(lines)?;
        }
        // Silence after the last line is no evidence: the last command is said once more when all is over.
        if let Some(last) = self.lines.last() {
            instant(&[Line { at: self.span_s, ..last.clone() }])?;
        }
        writer.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::KINDS;
    use crate::gap::report::{Cause, FittedParameter, Rival, Verdict};
    use crate::plant::{EffectPlace, embedded::Embedded, load};

    fn rig() -> Plant {
        load(&Embedded, "models/rig", KINDS).expect("the rig")
    }

    fn time(name: &str, value: f64) -> Vec<FittedParameter> {
        let ci95 = [0.9 * value, 1.1 * value];
        vec![FittedParameter { name: name.to_owned(), value, unit: "s".to_owned(), ci95, not_identifiable: false }]
    }

    fn cause(
        device: &str,
        component: Option<&str>,
        effect: &str,
        place: EffectPlace,
        at: Vec<FittedParameter>,
    ) -> Cause {
        let component = component.map(str::to_owned);
        let (device, effect) = (device.to_owned(), effect.to_owned());
        let texts = Default::default();
        Cause { device, component, effect, place, weight: 0.5, class: Vec::new(), parameters: at, texts }
    }

    fn rival(of: Cause) -> Rival {
        let Cause { device, component, effect, place, weight, parameters, texts, .. } = of;
        Rival {
            device,
            component,
            effect,
            place,
            weight,
            told_apart_by: String::new(),
            set: Some(1),
            parameters,
            texts,
        }
    }

    /// A dead time of the robot's Y and a lag with the same delay.
    fn lag_or_dead_time() -> Report {
        let mut report = Report::new(Verdict::Ambiguous);
        let place = EffectPlace::Actuator;
        report.cause = vec![cause("Robot", Some("Y"), "first-order-lag", place, time("time_constant", 0.02))];
        let place = EffectPlace::CommandLink;
        report.rivals = vec![rival(cause("Robot", Some("YTarget"), "dead-time", place, time("time", 0.02)))];
        report
    }

    /// What the rig was asked: two steps of its axis Y, reported every 10 ms.
    fn trained(plant: &Plant) -> Recording {
        let target = plant.signal_map.register("Robot.YTarget").expect("a target");
        let step = |at: f64, value: f32| Line { at, register: target, value: crate::value::Value::Real(value) };
        script::play(plant, &[step(0.5, 0.4), step(2.0, -0.3)], 4.0, &[]).expect("the rig runs")
    }

    #[test]
    fn an_experiment_tells_a_lag_from_a_dead_time_within_what_the_axis_was_asked() {
        let plant = rig();
        let experiment = plan(&plant, &lag_or_dead_time(), &[trained(&plant)], &BTreeMap::new()).expect("a plan");
        assert!(experiment.separations[0].power > 0.95, "{:?}", experiment.separations);
        let target = plant.signal_map.register("Robot.YTarget").expect("a target");
        assert!(experiment.lines.iter().all(|line| line.register == target), "the other axes rest");
        let values: Vec<f64> = experiment.lines.iter().filter_map(|line| line.value.to_f64()).collect();
        assert!(values.iter().all(|value| (-0.3 - 1e-6..=0.4 + 1e-6).contains(value)), "{values:?}");
        assert!(values.len() > 3 && experiment.lines.windows(2).all(|pair| pair[0].at <= pair[1].at));
    }

    #[test]
    fn what_no_motion_can_tell_apart_is_said_to_be_so() {
        let plant = rig();
        let mut report = lag_or_dead_time();
        let (place, delay) = (EffectPlace::CommandLink, || time("time", 0.17));
        report.cause = vec![cause("Gripper", Some("suctionOn"), "dead-time", place, delay())];
        report.rivals = vec![rival(cause("Gripper", Some("vacuumOn"), "dead-time", EffectPlace::ReportLink, delay()))];
        let experiment = plan(&plant, &report, &[trained(&plant)], &BTreeMap::new()).expect("a plan");
        assert!(experiment.separations[0].power < 0.1, "{:?}", experiment.separations);
    }

    #[test]
    fn a_report_without_rivals_or_of_another_plant_has_no_experiment() {
        let plant = rig();
        let mut report = lag_or_dead_time();
        report.rivals.clear();
        assert!(matches!(plan(&plant, &report, &[trained(&plant)], &BTreeMap::new()), Err(PlanError::NoRival)));
        let mut report = lag_or_dead_time();
        report.cause[0].device = "Crane".to_owned();
        report.rivals[0].device = "Crane".to_owned();
        assert!(matches!(
            plan(&plant, &report, &[trained(&plant)], &BTreeMap::new()),
            Err(PlanError::UnknownDevice { .. })
        ));
    }

    #[test]
    fn an_axis_that_nobody_bounded_is_not_moved() {
        let plant = rig();
        let mut report = lag_or_dead_time();
        report.cause[0].component = Some("X".to_owned());
        report.rivals[0].component = Some("XTarget".to_owned());
        let error = plan(&plant, &report, &[trained(&plant)], &BTreeMap::new()).expect_err("no bounds").to_string();
        assert!(error.contains("Robot.XTarget") && error.contains("--bounds"), "{error}");
    }

    #[test]
    fn the_power_is_that_of_the_noncentral_distribution() {
        // 17.8 = (2.576 + 1.645)²: 95 % by construction; at 0 it is the error.
        assert!((power(17.8) - 0.95).abs() < 1e-3 && (power(0.0) - 0.01).abs() < 1e-4);
    }
}
