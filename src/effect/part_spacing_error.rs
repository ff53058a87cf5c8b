//! `part-spacing-error`: the parts of a loading bay come at longer intervals than the model says, by `time`. The bay is then
//! built with that interval; its first part comes when it should. Only a declared schedule tells this from the schedule itself.
//!
//! Source: a constant error of a period (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 5.2: a parametric
//! fault).

use super::table::{BASE, TIME, parameter};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "part-spacing-error",
    summary: "the parts of a loading bay come at longer intervals than the model says",
    equation: "t(k) = firstTime + k·(interval + time)",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 5.2",
    places: &[EffectPlace::Process],
    fits: &[Fit::Parts(&["LoadingBay"])],
    parameters: &[parameter("time", TIME, (-3600.0, 3600.0), 0.0, 0.2, "how much longer; shorter if negative")],
    excited_by: "several parts, and a declared schedule",
    build: Build::Parameters,
    ..BASE
};

#[cfg(test)]
mod tests {
    use crate::device::Role;
    use crate::effect::bench::{error, spec, with};

    #[test]
    fn each_part_is_later_by_one_more_error() {
        let late = spec("process", "part-spacing-error", None, &[("time", 0.25)]);
        let mut bay = with("LoadingBay", &[("belt", "Belt"), ("interval", "2")], &[late]);
        let mut due = Vec::new();
        for step in 0..8000 {
            let Role::Makes(source) = bay.device.role() else { panic!("a loading bay") };
            if !source.due.is_empty() {
                due.push(step);
            }
            bay.device.advance(0.001);
        }
        assert_eq!(due, [1000, 3250, 5500, 7750]);
    }

    #[test]
    fn an_interval_of_no_time_is_refused() {
        let early = spec("process", "part-spacing-error", None, &[("time", -2.0)]);
        let error = error("LoadingBay", &[("belt", "Belt"), ("interval", "2")], &[early]);
        assert!(error.contains("interval would be") && error.contains("expected 0.001 to"), "{error}");
    }
}
