//! `acceleration-limit`: the drive accelerates and brakes no more steeply than `limit`; only lowers what it may do. A servo
//! drive then exerts at most F = M·limit + R, with R what resists.
//!
//! Source: saturation (H. K. Khalil, Nonlinear Systems, Prentice Hall 2002, section 1.2.7), of an acceleration.

use super::table::{ACCELERATION, BASE, UNLIMITED, parameter};
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "acceleration-limit",
    summary: "the drive accelerates and brakes no more steeply than this",
    equation: "|dv/dt| ≤ limit",
    source: "Khalil, Nonlinear Systems, Prentice Hall 2002, 1.2.7 (saturation)",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&["StraightConveyor", "ConveyorCurve", "CartesianRobot", "ServoAxis", "EncoderMotor"])],
    parameters: &[parameter("limit", ACCELERATION, (1e-6, UNLIMITED), UNLIMITED, 0.8, "highest acceleration")],
    excited_by: "changes of speed steeper than the limit",
    build: Build::Stage(|values, site| {
        let stretch = if site.is_servo() { 1e-3 } else { f64::INFINITY };
        Box::new(AccelerationLimit { limit: values[0], stretch })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct AccelerationLimit {
    limit: f64,
    stretch: f64,
}

impl Stage for AccelerationLimit {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        self.stretch
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        if self.limit >= UNLIMITED {
            return bounds;
        }
        let acceleration = bounds.acceleration.min(self.limit);
        Bounds { acceleration, deceleration: bounds.deceleration.min(self.limit), ..bounds }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn drives_and_axes_keep_to_it() {
        let limit = |component| [spec("actuator", "acceleration-limit", component, &[("limit", 0.5)])];
        let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        with("StraightConveyor", &[], &limit(None)).check(&run, 0.6, &[("velocityActual", 0.3)]);
        with("CartesianRobot", &[], &limit(Some("Y"))).check(&[("YTarget", 2.0)], 1.0, &[("actualPosY", 0.25)]);
        let ideal = [("mode", "ideal")];
        with("ServoAxis", &ideal, &limit(None)).check(&[("positionTarget", 1.0)], 1.0, &[("position", 0.25)]);
        let mut axis = with("ServoAxis", &[], &limit(None));
        axis.check(&[("positionTarget", 5.0)], 0.5, &[]);
        assert!((axis.report("velocity") - 0.25).abs() < 1e-6, "{}", axis.report("velocity"));
    }

    #[test]
    fn it_only_lowers() {
        let limit = [spec("actuator", "acceleration-limit", None, &[("limit", 5.0)])];
        let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        with("StraightConveyor", &[], &limit).check(&run, 0.3, &[("velocityActual", 0.3)]);
    }
}
