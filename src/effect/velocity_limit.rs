//! `velocity-limit`: the drive goes no faster than `limit`; only lowers what the drive may do.
//!
//! Source: saturation (H. K. Khalil, Nonlinear Systems, Prentice Hall 2002, section 1.2.7), of a speed.

use super::table::{BASE, SPEED, UNLIMITED, parameter};
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "velocity-limit",
    summary: "the drive goes no faster than this",
    equation: "|v| ≤ limit",
    source: "Khalil, Nonlinear Systems, Prentice Hall 2002, 1.2.7 (saturation)",
    places: &[EffectPlace::Actuator],
    needs: Needs::Speed,
    parameters: &[parameter("limit", SPEED, (1e-6, UNLIMITED), UNLIMITED, 0.4, "highest speed")],
    excited_by: "speeds above the limit",
    build: Build::Stage(|values, _| Box::new(VelocityLimit { limit: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct VelocityLimit {
    limit: f64,
}

impl Stage for VelocityLimit {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        if self.limit >= UNLIMITED { bounds } else { Bounds { velocity: bounds.velocity.min(self.limit), ..bounds } }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn every_drive_keeps_to_it() {
        let limit = |component| [spec("actuator", "velocity-limit", component, &[("limit", 0.25)])];
        let run = [("velocityTarget", 0.5), ("motorDirection", -1.0)];
        with("StraightConveyor", &[], &limit(None)).check(&run, 1.0, &[("velocityActual", -0.25)]);
        // 0.25 m/s after 1/8 s and 1/64 m: at 1/64 + 0.25·(1 − 1/8).
        with("CartesianRobot", &[], &limit(Some("Y"))).check(&[("YTarget", 2.0)], 1.0, &[("actualPosY", 0.234375)]);
        let ideal = [("mode", "ideal")];
        with("ServoAxis", &ideal, &limit(None)).check(&[("positionTarget", 1.0)], 1.0, &[("position", 0.25)]);
        // The speed loop gives way to viscous friction: v = 0.25·800/850.
        let mut axis = with("ServoAxis", &[], &limit(None));
        axis.check(&[("positionTarget", 5.0)], 2.0, &[("velocity", 0.25 * 800.0 / 850.0)]);
        let mut pusher = with("Pusher", &[], &limit(None));
        pusher.check(&[("command", 1.0)], 1.991, &[("limitExtended", 0.0)]);
        pusher.check(&[], 0.002, &[("limitExtended", 1.0)]);
    }
}
