//! What is common to all devices, found again beside the effects of each.
//!
//! When commands are taken up, how old reports are and how slow the filter of all inputs is are looked for before any device is. A motor that follows slowly
//! counts as if its commands were taken up a cycle of the task later; a cylinder that is slower one way than the other is late with all of its flags, and that had
//! been taken for a filter. So where something is left beside what devices have, or more than one effect was needed, what is common is found anew as if the model
//! had those effects, and where that is another, all devices are looked at again.

use std::cmp::Reverse;

use super::{Conclusion, Finding, Options, find_all, specs_of};
use crate::gap::study::told_beside;
use crate::gap::{Recording, Study, StudyError, THRESHOLD, evidence};
use crate::plant::{EffectPlace, EffectSpec, ParameterValue, Plant};

/// How often.
const ROUNDS: usize = 3;
/// How late a task makes anything at most, s: its cycle, or the age of what is reported.
const LONGEST_S: f64 = 4e-3;

/// The study with what is common to all as it is found beside the effects of `findings`, and what is found with it; `None` where it is as it was, or no more
/// is explained by as few effects.
pub(super) fn beside_effects(
    plant: &Plant,
    train: &[Recording],
    (study, findings): (&Study, &[Finding]),
    options: &Options<'_>,
) -> Result<Option<(Study, Vec<Finding>)>, StudyError> {
    let mut best: Option<(Study, Vec<Finding>)> = None;
    for _ in 0..ROUNDS {
        let (study, findings) = best.as_ref().map_or((study, findings), |(study, findings)| (study, findings));
        if !is_asked(study, findings) {
            break;
        }
        let mut better = None;
        for added in added(study.subjects.len(), findings) {
            if (options.is_stopped)() {
                break;
            }
            let beside = Study::beside_effects(plant, train, &added)?;
            if study.is_told_like(&beside) {
                continue;
            }
            let again = Study::under(plant, train, &beside)?;
            let anew = find_all(plant, &again, options);
            // What was broken off says nothing.
            if !(options.is_stopped)() && is_better(&anew, findings) {
                better = Some((again, anew));
                break;
            }
        }
        if better.is_none() {
            break;
        }
        best = better;
    }
    Ok(best)
}

/// The effects beside which what is common to all is found, device by device: those that are no task's doing, where some may be, and all.
fn added(devices: usize, findings: &[Finding]) -> Vec<Vec<Vec<EffectSpec>>> {
    let all = specs_of(devices, findings);
    let others: Vec<Vec<EffectSpec>> =
        all.iter().map(|each| each.iter().filter(|spec| !may_be_a_tasks(spec)).cloned().collect()).collect();
    if others == all { vec![all] } else { vec![others, all] }
}

/// Whether an effect is one that the task of a machine has on all of its devices: what a link or an input is late by, or how often it is refreshed.
fn may_be_a_tasks(spec: &EffectSpec) -> bool {
    const LATE: [&str; 5] = ["dead-time", "stale-hold", "on-delay", "off-delay", "input-filter"];
    const PLACES: [EffectPlace; 3] = [EffectPlace::CommandLink, EffectPlace::ReportLink, EffectPlace::Sensor];
    let is_short = |value: &ParameterValue| matches!(value, ParameterValue::Number(time) if *time <= LONGEST_S);
    PLACES.contains(&spec.place) && LATE.contains(&spec.kind.as_str()) && spec.parameters.values().all(is_short)
}

/// Whether what was found leaves room for something else: what is common to all.
fn is_asked(study: &Study, findings: &[Finding]) -> bool {
    let effects = findings.iter().map(|finding| finding.specs().len()).sum::<usize>();
    // What draws anew each time makes reports late, too, and says nothing of when they are.
    let is_drawn = findings.iter().any(|finding| finding.chance.is_some());
    let leaves = |finding: &Finding| {
        let subject = &study.subjects[finding.subject];
        let predicted = subject.predict(&finding.specs(), &finding.ladder.best.overrides);
        predicted.is_ok_and(|predicted| evidence(subject, &predicted) > THRESHOLD)
    };
    let is_open = |finding: &Finding| match finding.conclusion {
        Conclusion::Partial | Conclusion::Unknown => true,
        Conclusion::Explained => leaves(finding),
        Conclusion::NoGap | Conclusion::TooShort => false,
    };
    let is_told = findings.iter().any(|finding| told_beside(&finding.specs()).next().is_some());
    is_told && !is_drawn && (effects > 1 || findings.iter().any(is_open))
}

/// Whether more devices are explained, or as many and of fewer nothing is, or as many by no more effects.
fn is_better(anew: &[Finding], before: &[Finding]) -> bool {
    let merit = |findings: &[Finding]| {
        let count = |conclusions: &[Conclusion]| {
            findings.iter().filter(|finding| conclusions.contains(&finding.conclusion)).count()
        };
        let effects = findings.iter().map(|finding| finding.specs().len()).sum::<usize>();
        let explained = count(&[Conclusion::NoGap, Conclusion::Explained]);
        (explained, Reverse(count(&[Conclusion::Unknown])), Reverse(effects))
    };
    merit(anew) >= merit(before)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::recorded_tests::{LEAK_BEHIND_A_FILTER, of_folder, recording, rig, study};

    /// What the filter of all inputs is found to be beside a leak, s, and what is found of each device with it, where there are these effects.
    fn found_beside(asked: &[&str], study: &Study) -> Option<(f64, Vec<String>)> {
        let is_asked = |id: &str| asked.contains(&id);
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let findings = find_all(&rig(), study, &options);
        let found = beside_effects(&rig(), &[recording(LEAK_BEHIND_A_FILTER)], (study, &findings), &options);
        let (again, anew) = found.expect("a model that fits")?;
        let named = |finding: &Finding| finding.specs().into_iter().map(|spec| spec.kind).collect::<Vec<_>>();
        Some((again.tasks[0].filter_s, anew.iter().flat_map(named).collect()))
    }

    /// The gripper's flags, late by its leak, said nothing of the filter, and the robot's alone were said to be late by themselves.
    #[test]
    fn a_filter_is_found_beside_a_leak() {
        let study = study(LEAK_BEHIND_A_FILTER);
        assert_eq!(study.tasks[0].filter_s, 0.0);
        let (filter_s, named) = found_beside(&["leak", "on-delay"], &study).expect("a filter");
        assert!((5e-4..2e-3).contains(&filter_s), "{filter_s}");
        assert_eq!(named, ["leak"]);
        // Where nothing is found there is nothing to find it beside.
        assert!(found_beside(&["jerk-limit"], &study).is_none());
    }

    /// A belt shows that its bay makes longer parts, and has no such effect; and what is on a spring is not asked beside it.
    #[test]
    fn neither_what_a_bay_makes_nor_a_spring_is_put_on_a_device() {
        let (plant, train) = (rig(), [recording(LEAK_BEHIND_A_FILTER)]);
        let study = study(LEAK_BEHIND_A_FILTER);
        let spec = |place, kind: &str, parameters: &[(&str, f64)]| EffectSpec {
            place,
            kind: kind.to_owned(),
            component: None,
            parameters: parameters
                .iter()
                .map(|(name, value)| ((*name).to_owned(), ParameterValue::Number(*value)))
                .collect(),
        };
        let of = |name: &str| match name {
            "Belt" => vec![spec(EffectPlace::Process, "part-length-error", &[("length", 0.02)])],
            "Axis" => vec![spec(EffectPlace::Transmission, "compliance", &[("stiffness", 1e6), ("damping", 100.0)])],
            _ => Vec::new(),
        };
        let added: Vec<_> = study.subjects.iter().map(|subject| of(&subject.name)).collect();
        assert_eq!(added.iter().filter(|each| !each.is_empty()).count(), 2);
        let beside = Study::beside_effects(&plant, &train, &added).expect("a model that fits");
        assert!(study.is_told_like(&beside) && beside.subjects.iter().all(|subject| subject.effects.is_empty()));
    }

    /// A motor that follows its commands slowly counts as if they were taken up elsewhere in the task's cycle: 1 µs of its phase decides for some of them, and beside
    /// what was found of the motor it is found. What is held out is told so as well.
    #[test]
    fn a_phase_is_found_beside_a_motor_that_follows_slowly() {
        let (plant, recording) = of_folder("tests/data/motor-that-follows-slowly");
        let train = [recording];
        let study = Study::new(&plant, &train).expect("a study");
        let is_asked = |id: &str| id == "second-order-lag";
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let findings = find_all(&plant, &study, &options);
        let found = beside_effects(&plant, &train, (&study, &findings), &options).expect("a model that fits");
        let (again, anew) = found.expect("another phase");
        let frequency = |findings: &[Finding]| {
            let named = findings.iter().find(|finding| !finding.specs().is_empty()).expect("a lag");
            assert_eq!(named.specs()[0].kind, "second-order-lag");
            (named.ladder.best.at[0] / 37.03 - 1.0).abs()
        };
        assert!(
            frequency(&findings) > 0.01 && frequency(&anew) < 0.005,
            "{} {}",
            frequency(&findings),
            frequency(&anew)
        );
        // Of what is held out, too, more is explained with the phase that is found beside it.
        let left = |found: &[_]| {
            let held_out = Study::beside(&plant, &train, &again, found).expect("a study");
            let named = anew.iter().find(|finding| !finding.specs().is_empty()).expect("a lag");
            let subject = &held_out.subjects[named.subject];
            let predicted = subject.predict(&named.specs(), &named.ladder.best.overrides).expect("a prediction");
            subject.score(&predicted).total
        };
        let (with, without) = (left(&specs_of(again.subjects.len(), &anew)), left(&[]));
        assert!(with < without - 10.0, "{with} {without}");
    }

    /// A delay of a millisecond of a link or an input may be the task's own; one of ten, or of a drive, is not.
    #[test]
    fn what_a_task_does_is_short_and_of_a_link() {
        let spec = |place: EffectPlace, kind: &str, time: f64| EffectSpec {
            place,
            kind: kind.to_owned(),
            component: None,
            parameters: [("time".to_owned(), ParameterValue::Number(time))].into(),
        };
        let asked = [
            (EffectPlace::CommandLink, "stale-hold", 1e-3),
            (EffectPlace::ReportLink, "dead-time", 1e-3),
            (EffectPlace::CommandLink, "stale-hold", 1e-2),
            (EffectPlace::Actuator, "dead-time", 1e-3),
            (EffectPlace::Sensor, "on-delay", 1e-3),
            (EffectPlace::Sensor, "drift", 1e-3),
        ];
        let are = asked.map(|(place, kind, time)| may_be_a_tasks(&spec(place, kind, time)));
        assert_eq!(are, [true, true, false, false, true, false]);
    }

    /// As many devices explained by fewer effects are better, fewer devices are not.
    #[test]
    fn what_explains_as_many_devices_by_fewer_effects_is_better() {
        let study = study(LEAK_BEHIND_A_FILTER);
        let is_asked = |id: &str| ["leak", "on-delay"].contains(&id);
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let both = find_all(&rig(), &study, &options);
        let with = |conclusion: Conclusion, is_named: bool| {
            let mut findings = both.clone();
            let last = findings.iter_mut().rfind(|finding| !finding.specs().is_empty()).expect("an effect");
            last.conclusion = conclusion;
            if !is_named {
                (last.ladder.best.set, last.ladder.best.at) = (Vec::new(), Vec::new());
            }
            findings
        };
        let fewer = with(Conclusion::NoGap, false);
        assert!(is_better(&fewer, &both) && is_better(&both, &both) && !is_better(&both, &fewer));
        assert!(!is_better(&with(Conclusion::Unknown, false), &both));
        assert!(is_better(&both, &with(Conclusion::Partial, true)));
        assert!(!is_better(&with(Conclusion::Unknown, false), &with(Conclusion::Partial, true)));
    }
}
