//! `transfer-slip`: a part that stands on this belt and on another loses `ratio` of the way that this belt gives it: it is
//! gripped by neither.
//!
//! Source: the slip s = (v1 − v2)/v1 of belts (G. Niemann, H. Winter, Maschinenelemente 3, Springer 1986, section 27.2), of a
//! part at a transfer.

use super::table::{BASE, ONE, parameter};
use crate::device::path::Stage;
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "transfer-slip",
    summary: "a part on two belts loses some of its way",
    equation: "on two belts: part's way = (1 − ratio)·belt's way",
    source: "Niemann, Winter, Maschinenelemente 3, Springer 1986, 27.2 (slip)",
    places: &[EffectPlace::Process],
    fits: &[Fit::Parts(&["StraightConveyor", "ConveyorCurve"])],
    parameters: &[parameter("ratio", ONE, (0.0, 0.95), 0.0, 0.2, "share of its way that is lost")],
    excited_by: "parts that pass from belt to belt",
    build: Build::Stage(|values, _| Box::new(TransferSlip { ratio: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct TransferSlip {
    ratio: f64,
}

impl Stage for TransferSlip {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn transfer_slip(&self) -> f64 {
        self.ratio
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::device::Role;
    use crate::effect::bench::{spec, with};

    // That parts lose it is tested on the floor that carries them.
    #[test]
    fn the_belt_says_what_parts_lose_and_what_two_causes_take_together() {
        let slip = |ratio| spec("process", "transfer-slip", None, &[("ratio", ratio)]);
        let mut belt = with("StraightConveyor", &[], &[slip(0.2), slip(0.5)]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 2.0, &[]);
        assert!((belt.displacement() - 0.875).abs() < 1e-12);
        let Role::Carries(body) = belt.device.role() else { panic!("a belt") };
        assert!((body.transfer_slip - 0.6).abs() < 1e-15);
    }
}
