//! `scale-error`: the transmission is not what the model says (a drum, a pitch, a gear): y = (1 + ratio)·x.
//!
//! Source: the linear error of an axis (ISO 230-2:2014, systematic positional deviation).

use super::table::{BASE, ONE, parameter};
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "scale-error",
    summary: "the transmission is not what the model says",
    equation: "y = (1 + ratio)·x",
    source: "ISO 230-2:2014",
    places: &[EffectPlace::Transmission],
    parameters: &[parameter("ratio", ONE, (-0.9, 10.0), 0.0, 0.02, "share of its way that the load moves more")],
    excited_by: "motion; positions far apart",
    build: Build::Stage(|values, _| Box::new(ScaleError { share: 1.0 + values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct ScaleError {
    share: f64,
}

impl Stage for ScaleError {
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
    fn the_load_moves_in_proportion_and_the_loop_does_not_see_it() {
        let scale = |component| [spec("transmission", "scale-error", component, &[("ratio", 0.02)])];
        let expected = [("actualPosX", 0.51), ("cartesianArrived", 1.0)];
        with("CartesianRobot", &[], &scale(Some("X"))).check(&[("XTarget", 0.5)], 2.0, &expected);
        with("ServoAxis", &[], &scale(None)).check(
            &[("positionTarget", 0.1)],
            5.0,
            &[("position", 0.102), ("force", 0.0)],
        );
        let counts = (12.5 * 1.02 * 4096.0 / std::f64::consts::TAU).floor();
        let run = [("enable", 1.0), ("speedTarget", 10.0)];
        with("EncoderMotor", &[], &scale(None)).check(&run, 1.5, &[("encoder", counts), ("speedActual", 10.0)]);
    }
}
