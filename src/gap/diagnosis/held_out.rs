//! Recordings that no fit saw: opened once, to measure.

use super::Finding;
use super::shrink::{Squares, shrink};
use crate::gap::regimes::regimes;
use crate::gap::report::{DeviceGap, EdgeCounts, Gap, InWindows, Report, SignalGap, SignalKind, Verdict};
use crate::gap::{Recording, Score, SignalScore, Span, Study, Subject, THRESHOLD, WINDOW_S, evidence};
use crate::plant::{EffectSpec, Plant};
use crate::signal_map::Kind;

/// Recordings divided into what is fitted to and what is held out.
#[derive(Clone, Debug)]
pub struct Split {
    pub train: Vec<Recording>,
    pub held_out: Vec<Recording>,
}

/// Spans of each recording, and which of them are kept back.
const SPANS: usize = 8;
const KEPT_BACK: [usize; 2] = [2, 6];
/// Between the two, s: longer than residuals remember.
const PURGED_S: f64 = 1.0;

/// Where no recordings are held out: a quarter of each, in two spans, is kept back; a second beside them is used for neither.
pub fn kept_back(recordings: &[Recording]) -> Split {
    let with = |blind: &dyn Fn(f64) -> Vec<Span>| {
        let blinded = recordings.iter().map(|recording| {
            let mut recording = recording.clone();
            recording.blind.extend(blind(recording.ends));
            recording
        });
        blinded.collect()
    };
    let span = |ends: f64, at: usize, wider: f64| {
        let length = ends / SPANS as f64;
        Span { from: at as f64 * length - wider, to: (at + 1) as f64 * length + wider }
    };
    let train = with(&|ends| KEPT_BACK.iter().map(|at| span(ends, *at, PURGED_S)).collect());
    let others = |ends: f64| (0..SPANS).filter(|at| !KEPT_BACK.contains(at)).map(|at| span(ends, at, 0.0)).collect();
    Split { train, held_out: with(&others) }
}

/// Whose gap it is: the device's own, or that of the bay that feeds it, where all that was found is the bay's.
fn device(plant: &Plant, subject: &Subject, finding: &Finding) -> String {
    let specs = finding.specs();
    let maker = |spec: &EffectSpec| subject.maker(&spec.kind);
    let makers: Option<Vec<&str>> = specs.iter().map(maker).collect();
    let maker = makers.and_then(|makers| makers.first().copied().map(str::to_owned));
    maker.unwrap_or_else(|| subject.id.instance(plant).name.clone())
}

/// What the held-out recordings say.
pub(super) struct Measured {
    devices: Vec<DeviceGap>,
    squares: Squares,
}

impl Measured {
    /// Scores every device of the held-out study without and with what the findings add.
    pub fn new(plant: &Plant, held_out: &Study, findings: &[Finding]) -> Measured {
        let mut measured = Measured { devices: Vec::new(), squares: Squares::default() };
        let all: f64 = findings.iter().filter(|finding| finding.has_gap()).map(|finding| finding.misfit).sum();
        for (place, subject) in held_out.subjects.iter().enumerate() {
            // What was not looked at is not measured either.
            let Some(finding) = findings.iter().find(|finding| finding.subject == place) else { continue };
            let specs = finding.specs();
            let without = finding.chance.as_ref().and_then(|chance| chance.judged_without(subject));
            let subject = without.as_ref().unwrap_or(subject);
            let (bare, best) = (&finding.ladder.bare.overrides, &finding.ladder.best.overrides);
            let with = |subject: &Subject| match specs.is_empty() {
                true => None,
                false => subject.predict(&specs, best).ok().map(|with| subject.score(&with)),
            };
            // What was drawn there is read off as in the training; how it is drawn is as it was found there.
            let others = finding.chance.as_ref().and_then(|chance| chance.taken_out(subject, &specs, best));
            let after = match &others {
                Some(other) => with(other).or_else(|| Some(other.score(&other.predict(&[], best).ok()?))),
                None => with(subject),
            };
            // What lies within the tolerances of nominal parameters is no gap: they are as the training has them.
            let nominal = subject.predict(&[], bare).unwrap_or_else(|_| held_out.bare[place].prediction.clone());
            let before = subject.score(&nominal);
            let after = after.as_ref().unwrap_or(&before);
            let windows = subject.is_taken_up_again().then(|| subject.in_windows()).and_then(|windowed| {
                let before = windowed.score(&windowed.predict(&[], bare).ok()?);
                let after = with(&windowed);
                Some((before.clone(), after.unwrap_or(before)))
            });
            // Many signals that are in order lie above and below their floors by chance: no part of a gap is that.
            match finding.has_gap() || evidence(subject, &nominal) > THRESHOLD {
                true => measured.squares.add(subject, &before, after),
                false => measured.squares.add_floor(subject, &before),
            }
            if finding.has_gap() {
                measured.devices.push(DeviceGap {
                    device: device(plant, subject, finding),
                    share: finding.misfit / all.max(1e-12),
                    signals: signals(plant, subject, (&before, after), windows.as_ref()),
                    regimes: regimes(subject, &nominal, &before),
                });
            }
        }
        measured.devices.sort_by(|a, b| b.share.total_cmp(&a.share));
        measured
    }

    pub fn fill(self, report: &mut Report) {
        let adds = matches!(report.verdict, Verdict::Effect | Verdict::Ambiguous | Verdict::Partial);
        let (gap, measured) = shrink(&self.squares, adds);
        (report.gap, report.shrink) = (gap, measured);
        if report.verdict == Verdict::NotTestable {
            report.gap = Gap::default();
        } else {
            report.devices = self.devices;
        }
    }
}

impl Finding {
    /// Whether the device has a gap of its own.
    pub fn has_gap(&self) -> bool {
        self.conclusion != super::Conclusion::NoGap
    }
}

/// The device's signals that are off, before or after; in one go, and where it is taken up again after every window.
fn signals(
    plant: &Plant,
    subject: &Subject,
    (before, after): (&Score, &Score),
    windows: Option<&(Score, Score)>,
) -> Vec<SignalGap> {
    let mut gaps = Vec::new();
    for (place, info) in subject.signals.iter().enumerate() {
        let of =
            |score: &Score| score.signals.iter().filter(|signal| signal.signal == place).cloned().collect::<Vec<_>>();
        let (before, after) = (of(before), of(after));
        if before.is_empty() {
            continue;
        }
        let windows = windows.map(|(before, after)| (of(before), of(after)));
        let unit = plant.signal_map.signal(info.register).unit;
        let is_edge = info.kind == Kind::Edge;
        let in_unit = |si: f64| if is_edge { si } else { si / unit.to_si };
        let rms = |scores: &[SignalScore], of: fn(&SignalScore) -> f64| {
            let counts = scores.iter().map(|score| (samples(score) as f64, of(score)));
            let (count, squares) = counts.fold((0.0, 0.0), |sum, (n, rms)| (sum.0 + n, sum.1 + n * rms * rms));
            (count > 0.0).then(|| in_unit((squares / count).sqrt()))
        };
        let counts = |of: fn(&SignalScore) -> usize| EdgeCounts {
            before: before.iter().map(of).sum::<usize>() as u64,
            after: after.iter().map(of).sum::<usize>() as u64,
        };
        gaps.push(SignalGap {
            name: info.name.clone(),
            kind: if is_edge { SignalKind::Edge } else { SignalKind::Level },
            before: rms(&before, |score| score.rms),
            after: rms(&after, |score| score.rms),
            floor: rms(&before, |score| score.floor),
            unit: if is_edge { "s".to_owned() } else { unit.symbol.to_owned() },
            missing: is_edge.then(|| counts(SignalScore::missing)),
            extra: is_edge.then(|| counts(SignalScore::extra)),
            in_windows: windows.filter(|_| !is_edge).and_then(|(before, after)| {
                let (before, after) = (rms(&before, |score| score.rms)?, rms(&after, |score| score.rms)?);
                Some(InWindows { every_s: WINDOW_S, before, after })
            }),
        });
    }
    gaps
}

/// Samples of a level, pairs of an edge.
fn samples(score: &SignalScore) -> usize {
    let pairs = || score.edges.iter().filter(|edge| edge.recorded.is_some() && edge.predicted.is_some()).count();
    score.level.as_ref().map_or_else(pairs, |level| level.at.len())
}
