//! `leak`: the parts or the cups leak, so that vacuum that has built up is lost again after 1/`rate`, though suction is on.
//! What holds by then is let go.
//!
//! Source: the loss of a vacuum reserve at a constant leak rate (K. Jousten (ed.), Handbook of Vacuum Technology, Wiley-VCH
//! 2016, pressure rise test): the reserve that vacuum has over its switch, taken as 1, falls by `rate` in each second.

use super::table::{BASE, RATE, parameter};
use crate::device::path::{Moment, Stage, VacuumTimes};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "leak",
    summary: "vacuum that has built up is lost again though suction is on",
    equation: "vacuum holds while 1 − rate·t > 0, t since it has built up",
    source: "Jousten (ed.), Handbook of Vacuum Technology, Wiley-VCH 2016 (pressure rise)",
    places: &[EffectPlace::Process],
    fits: &[Fit::Parts(&["SuctionCapGripper"])],
    parameters: &[parameter("rate", RATE, (0.0, 1e3), 0.0, 1.0, "share of its reserve lost in each second")],
    excited_by: "grips held for longer than 1/rate",
    build: Build::Stage(|values, _| Box::new(Leak { rate: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct Leak {
    rate: f64,
}

impl Stage for Leak {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn vacuum(&mut self, times: VacuumTimes, _moment: Moment) -> VacuumTimes {
        if self.rate == 0.0 { times } else { VacuumTimes { hold: times.hold.min(1.0 / self.rate), ..times } }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn vacuum_is_lost_when_its_reserve_is_gone_and_comes_again_with_suction() {
        let leak = spec("process", "leak", None, &[("rate", 2.0)]);
        let mut gripper = with("SuctionCapGripper", &[("alwaysSealed", "true")], &[leak]);
        gripper.check(&[("suctionOn", 1.0)], 0.6499, &[("vacuumOn", 1.0)]);
        gripper.check(&[], 0.0001, &[("vacuumOn", 0.0)]);
        gripper.check(&[], 5.0, &[("vacuumOn", 0.0)]);
        gripper.check(&[("suctionOn", 0.0)], 0.1, &[]);
        gripper.check(&[("suctionOn", 1.0)], 0.2, &[("vacuumOn", 1.0)]);
    }
}
