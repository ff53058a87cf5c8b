//! What is common to all devices, found again beside the effects of each.
//!
//! The filter of all inputs is looked for before any device is. A cylinder that is slower one way than the other is late with all of its flags, and that had
//! been taken for a filter; where a vacuum is late as well, nobody else says how slow the filter is, and a robot's arrivals seem to be late by themselves. So
//! once it is known what each device has, the filter is found anew beside that, and where it is another, all devices are looked at again.

use super::{Conclusion, Finding, Options, find_all};
use crate::gap::filter::{find_beside_effects, with_filter};
use crate::gap::{Study, StudyError};
use crate::plant::Plant;

/// The study with the filter that is found beside the effects of `findings`, and what is found with it; `None` where it is as it was, or no more is explained
/// by as few effects.
pub(super) fn beside_effects(
    plant: &Plant,
    study: &Study,
    findings: &[Finding],
    options: &Options<'_>,
) -> Result<Option<(Study, Vec<Finding>)>, StudyError> {
    // What draws anew each time makes flags late, too, and says nothing of a filter.
    let is_told = findings.iter().any(|finding| !finding.specs().is_empty());
    let is_drawn = findings.iter().any(|finding| finding.chance.is_some());
    if !is_told || is_drawn || (options.is_stopped)() {
        return Ok(None);
    }
    let found = study.bare.iter().enumerate().map(|(place, bare)| {
        let finding = findings.iter().find(|finding| finding.subject == place);
        let named = finding.map(|finding| (finding.specs(), finding)).filter(|(specs, _)| !specs.is_empty());
        match named {
            Some((specs, finding)) => (specs, finding.ladder.best.overrides.clone()),
            None => (Vec::new(), bare.overrides.clone()),
        }
    });
    let found: Vec<_> = found.collect();
    let Some(filter_s) = find_beside_effects(study, &found) else { return Ok(None) };
    let again = with_filter(study, filter_s)?;
    let anew = find_all(plant, &again, options);
    Ok((is_better(&anew, findings)).then_some((again, anew)))
}

/// Whether more devices are explained, or as many by no more effects.
fn is_better(anew: &[Finding], before: &[Finding]) -> bool {
    let is_explained = |finding: &&Finding| matches!(finding.conclusion, Conclusion::NoGap | Conclusion::Explained);
    let explained = |findings: &[Finding]| findings.iter().filter(is_explained).count();
    let effects = |findings: &[Finding]| findings.iter().map(|finding| finding.specs().len()).sum::<usize>();
    let more = explained(anew).cmp(&explained(before));
    more.is_gt() || more.is_eq() && effects(anew) <= effects(before)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::recorded_tests::{LEAK_BEHIND_A_FILTER, rig, study};

    /// What the filter of all inputs is found to be beside a leak, s, and what is found of each device with it, where there are these effects.
    fn found_beside(asked: &[&str], study: &Study) -> Option<(f64, Vec<String>)> {
        let is_asked = |id: &str| asked.contains(&id);
        let options = Options { is_asked: &is_asked, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
        let findings = find_all(&rig(), study, &options);
        let (again, anew) = beside_effects(&rig(), study, &findings, &options).expect("a model that fits")?;
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
    }
}
