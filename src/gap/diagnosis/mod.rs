//! The diagnosis: from a plant and its recordings to a verdict.
//!
//! Every device is looked at alone. What its recordings hold above their noise floor is explained by as few effects as are
//! worth having ([`crate::gap::cause`]); verdict and parameters are frozen then, and the held-out recordings are opened once, to
//! measure how far the gap shrinks.

mod finding;
mod held_out;
mod refound;
mod scheduled;
mod shrink;
mod states;
mod untrained;
mod verdict;
mod words;

pub use finding::{Conclusion, Finding};
pub use held_out::{Split, kept_back};

use rayon::prelude::*;

use super::cause::{BLOCK_S, Tell};
use super::page::{Added, Evidence, gather};
use super::report::{FoundClock, NotTestable, Report, SignalNames};
use super::{ClockOffset, Recording, Study, StudyError, Subject, evidence};
use crate::effect::EffectError;
use crate::plant::{EffectSpec, Plant};
use held_out::Measured;

/// What is asked of a diagnosis.
pub struct Options<'a> {
    /// Whether an effect, by its id, is looked for.
    pub is_asked: &'a (dyn Fn(&str) -> bool + Sync),
    /// Whether a device, by its instance's name, is looked at.
    pub is_meant: &'a (dyn Fn(&str) -> bool + Sync),
    /// Whether the answer is wanted now: the best so far is given, marked incomplete.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
    /// Told after every candidate.
    pub tell: &'a Tell<'a>,
}

/// The answer.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    pub report: Report,
    /// What was found of each device that was looked at.
    pub findings: Vec<Finding>,
    /// The held-out recordings.
    pub held_out: Study,
}

impl Diagnosis {
    /// What the pictures of the report's page show: of each device with a gap of its own the held-out recordings, and what the
    /// answer adds to them.
    ///
    /// # Errors
    /// What is added does not fit a device: never of an answer that was found.
    pub fn evidence(&self, plant: &Plant) -> Result<Evidence, EffectError> {
        let with_gap = self.findings.iter().filter(|finding| finding.has_gap());
        let added: Vec<_> =
            with_gap.map(|finding| (finding.subject, finding.specs(), &finding.ladder.best.overrides)).collect();
        let added: Vec<Added<'_>> = added
            .iter()
            .map(|(subject, effects, overrides)| Added {
                device: &self.held_out.subjects[*subject].name,
                effects,
                overrides,
            })
            .collect();
        gather(plant, &self.held_out, &added)
    }
}

/// Diagnoses. `train` is what is fitted to; `held_out` is opened once, when all is fixed.
///
/// # Errors
/// No recording; a model whose own effects do not fit its devices.
pub fn diagnose(
    plant: &Plant,
    train: &[Recording],
    held_out: &[Recording],
    options: &Options<'_>,
) -> Result<Diagnosis, StudyError> {
    let study = Study::new(plant, train)?;
    let findings = find_all(plant, &study, options);
    let (study, findings) = match refound::beside_effects(plant, train, (&study, &findings), options)? {
        Some(again) => again,
        None => (study, findings),
    };
    let found = specs_of(study.subjects.len(), &findings);
    let mut held_out = Study::beside(plant, held_out, &study, &found)?;
    let too_fast = untrained::leave_out(&mut held_out, &study);
    let measured = Measured::new(plant, &held_out, &findings);
    let mut report = Report::new(verdict::verdict(&study, &findings));
    verdict::fill(&mut report, plant, &study, &findings);
    measured.fill(&mut report);
    report.incomplete = (options.is_stopped)();
    report.signals = signal_names(train);
    report.left_out = left_out(train);
    report.clocks = found_clocks(&study, train);
    report.not_testable.extend(lone_clocks(&study, train));
    let is_meant = |entry: &NotTestable| findings.iter().any(|finding| is_of(&study, finding, entry));
    report.not_testable.extend(too_fast.into_iter().filter(is_meant));
    report.not_testable.extend(too_short(&study, &findings));
    report.not_testable.extend(still(&study));
    report.not_testable.extend(states::untrained(&study, &held_out));
    Ok(Diagnosis { report, findings, held_out })
}

/// What is found of each device that is meant, in the study's order.
fn find_all(plant: &Plant, study: &Study, options: &Options<'_>) -> Vec<Finding> {
    let meant = study.subjects.iter().zip(&study.bare).enumerate();
    // What a bay makes shows on the belt that it feeds: where the bay alone is meant, its belt is looked at for that.
    let is_meant = |subject: &Subject| (options.is_meant)(&subject.id.instance(plant).name);
    let meant = meant.filter(|(_, (subject, _))| is_meant(subject) || subject.feeder().is_some_and(options.is_meant));
    // Where the answer is wanted before all is looked at, the largest gap has been.
    let mut meant: Vec<_> =
        meant.map(|(place, (subject, bare))| (evidence(subject, &bare.prediction), place, subject, bare)).collect();
    meant.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut findings: Vec<Finding> = meant
        .into_par_iter()
        .with_max_len(1)
        .filter_map(|(_, place, subject, bare)| {
            let is_asked = |id: &str| (is_meant(subject) || subject.maker(id).is_some()) && (options.is_asked)(id);
            finding::find(place, subject, bare, study, &Options { is_asked: &is_asked, ..*options })
        })
        .collect();
    findings.sort_by_key(|finding| finding.subject);
    findings
}

/// The effects that were found of each of so many devices, in their order.
fn specs_of(devices: usize, findings: &[Finding]) -> Vec<Vec<EffectSpec>> {
    let specs = |place: usize| {
        let finding = findings.iter().find(|finding| finding.subject == place);
        finding.map_or_else(Vec::new, Finding::specs)
    };
    (0..devices).map(specs).collect()
}

/// Whether an entry is of the device that was looked at.
fn is_of(study: &Study, finding: &Finding, entry: &NotTestable) -> bool {
    finding.has_gap() && entry.device.as_ref() == Some(&study.subjects[finding.subject].name)
}

/// Signals on which model and traces do not agree.
fn signal_names(train: &[Recording]) -> SignalNames {
    let mut missing: Vec<String> = train.iter().flat_map(|recording| recording.absent.iter().cloned()).collect();
    let mut ignored: Vec<String> = train.iter().flat_map(|recording| recording.ignored.keys().cloned()).collect();
    for names in [&mut missing, &mut ignored] {
        names.sort();
        names.dedup();
    }
    SignalNames { missing, ignored }
}

/// How far other clocks were off.
fn found_clocks(study: &Study, train: &[Recording]) -> Vec<FoundClock> {
    let each = train.iter().zip(&study.clocks);
    let found = |(recording, clocks): (&Recording, &Vec<ClockOffset>)| {
        let of = |clock: &ClockOffset| FoundClock {
            trace: recording.name.clone(),
            name: clock.name.clone(),
            offset_s: clock.offset_s,
            drift: clock.drift,
        };
        clocks.iter().map(of).collect::<Vec<_>>()
    };
    each.flat_map(found).collect()
}

/// Of a clock with one device alone an offset is the same as a dead time of its links.
fn lone_clocks(study: &Study, train: &[Recording]) -> Vec<NotTestable> {
    let alone = study.clocks.iter().zip(train).flat_map(|(clocks, recording)| {
        let lone = |(place, clock): (usize, &ClockOffset)| {
            let register = recording.clocks.get(place)?.registers.first().filter(|_| clock.devices < 2)?;
            let of = |subject: &&Subject| subject.signals.iter().any(|signal| signal.register == *register);
            Some((clock.name.clone(), study.subjects.iter().find(of)?.name.clone()))
        };
        clocks.iter().enumerate().filter_map(lone).collect::<Vec<_>>()
    });
    let entry = |(clock, device): (String, String)| NotTestable {
        device: Some(device),
        effect: Some("dead-time".to_owned()),
        reason: format!(
            "it is the only device that the clock {clock} stamped: a dead time is the same as that clock's offset"
        ),
        needs: "a second device on that clock, or its reports by the clock of the commands".to_owned(),
        ..NotTestable::default()
    };
    alone.map(entry).collect()
}

/// What else of the traces was left out.
fn left_out(train: &[Recording]) -> Vec<String> {
    let of = |recording: &Recording| {
        let torn = recording.torn.iter().cloned();
        let notices = recording.notices.iter().map(|(words, count)| match count {
            1 => format!("{}: {words}", recording.name),
            _ => format!("{}: {words} ({count} times)", recording.name),
        });
        notices.chain(torn).collect::<Vec<_>>()
    };
    train.iter().flat_map(of).collect()
}

/// Devices whose gap something in the library explains, in too little motion to be sure of it.
fn too_short(study: &Study, findings: &[Finding]) -> Vec<NotTestable> {
    let short = findings.iter().filter(|finding| finding.conclusion == Conclusion::TooShort);
    let entry = |finding: &Finding| {
        let blocks = finding.ladder.too_few_blocks.unwrap_or_default();
        NotTestable {
            device: Some(study.subjects[finding.subject].name.clone()),
            reason: format!(
                "it has a gap, and all that shows it lies within {:.0} s of motion: too little to say which effect it is",
                (blocks * BLOCK_S).ceil()
            ),
            needs: format!("a recording in which it moves like that for {:.0} s or more", 4.0 * BLOCK_S),
            ..NotTestable::default()
        }
    };
    short.map(entry).collect()
}

/// Devices that never move in the training: nothing can be said of them.
fn still(study: &Study) -> Vec<NotTestable> {
    let still = study.subjects.iter().filter(|subject| !verdict::moves(subject));
    still
        .map(|subject| NotTestable {
            device: Some(subject.name.clone()),
            reason: "nothing it reports changes in the training".to_owned(),
            needs: "a recording in which it is commanded and moves".to_owned(),
            ..NotTestable::default()
        })
        .collect()
}
