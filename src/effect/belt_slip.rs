//! `belt-slip`: the belt creeps on its drum, so that the load moves a little less than the motor: y = (1 − ratio)·x. The
//! drive itself does not see it.
//!
//! Source: elastic creep of belts (G. Niemann, H. Winter, Maschinenelemente 3, Springer 1986, section 27.2; slip
//! s = (v1 − v2)/v1).

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "belt-slip",
    summary: "the belt creeps on its drum: the load moves less than the motor",
    equation: "y = (1 − ratio)·x",
    source: "Niemann, Winter, Maschinenelemente 3, Springer 1986, 27.2",
    places: &[EffectPlace::Transmission],
    fits: &[Fit::Drives(&["StraightConveyor", "ConveyorCurve", "CartesianRobot", "ServoAxis", "EncoderMotor"])],
    parameters: &[parameter("ratio", ONE, (0.0, 0.95), 0.0, 0.05, "share of its way that is lost")],
    excited_by: "motion; passages between two light barriers",
    build: Build::Stage(|values, _| Box::new(BeltSlip { share: 1.0 - values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct BeltSlip {
    share: f64,
}

impl Stage for BeltSlip {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn motion(&mut self, motion: Motion, _moment: Moment) -> Motion {
        Motion { position: self.share * motion.position, velocity: self.share * motion.velocity }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn parts_move_less_than_the_drive_says() {
        let slip = spec("transmission", "belt-slip", None, &[("ratio", 0.06)]);
        let mut belt = with("StraightConveyor", &[], &[slip]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 2.0, &[("velocityActual", 0.5)]);
        assert!((belt.displacement() - 0.94 * 0.875).abs() < 1e-12);
    }
}
