//! `vacuum-build-up`: on these parts vacuum takes longer to build up, by `time`: their surface is rough, or their volume
//! under the cups is large. A longer time and an error of the gripper's `buildUpTime` are one class.
//!
//! Source: evacuation of a volume takes a time in proportion to it, t = V/S·ln(p0/p) (K. Jousten (ed.), Handbook of Vacuum
//! Technology, Wiley-VCH 2016, pump-down at constant pumping speed).

use super::table::{BASE, time};
use crate::device::path::{Moment, Stage, VacuumTimes};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "vacuum-build-up",
    summary: "on these parts vacuum takes longer to build up",
    equation: "T = buildUpTime + time",
    source: "Jousten (ed.), Handbook of Vacuum Technology, Wiley-VCH 2016 (pump-down)",
    places: &[EffectPlace::Process],
    fits: &[Fit::Parts(&["SuctionCapGripper"])],
    parameters: &[time("time", 0.05, "how much longer")],
    excited_by: "grips",
    build: Build::Stage(|values, _| Box::new(VacuumBuildUp { time: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct VacuumBuildUp {
    time: f64,
}

impl Stage for VacuumBuildUp {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn vacuum(&mut self, times: VacuumTimes, _moment: Moment) -> VacuumTimes {
        VacuumTimes { build_up: times.build_up + self.time, ..times }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn vacuum_comes_later_and_goes_as_ever() {
        let slow = spec("process", "vacuum-build-up", None, &[("time", 0.05)]);
        let mut gripper = with("SuctionCapGripper", &[("alwaysSealed", "true")], &[slow]);
        gripper.check(&[("suctionOn", 1.0)], 0.1999, &[("vacuumOn", 0.0)]);
        gripper.check(&[], 0.0001, &[("vacuumOn", 1.0)]);
        gripper.check(&[], 1.0, &[]);
        gripper.check(&[("suctionOn", 0.0)], 0.0799, &[("vacuumOn", 1.0)]);
        gripper.check(&[], 0.0001, &[("vacuumOn", 0.0)]);
    }
}
