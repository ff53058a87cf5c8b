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
    fn an_ideal_axis_catches_up_with_a_target_that_runs() {
        // From rest, behind a target of r = 0.1 m/s: it falls back by r²/2a in r/a while it comes up to that speed, and makes
        // that up by √2·r/a of going faster and slower again.
        let (rate, limit) = (0.1_f64, 0.5);
        let limited = [spec("actuator", "acceleration-limit", None, &[("limit", limit)])];
        let mut axis = with("ServoAxis", &[("mode", "ideal")], &limited);
        let mut farthest = 0.0_f64;
        for step in 1..=600_u32 {
            let target = rate * 1e-3 * f64::from(step);
            axis.check(&[("positionTarget", target)], 1e-3, &[]);
            // As the target will be when the millisecond is over.
            let behind = target + rate * 1e-3 - axis.report("position");
            farthest = farthest.max(behind);
            if f64::from(step) * 1e-3 > (1.0 + 2.0_f64.sqrt()) * rate / limit + 5e-3 {
                assert!(behind.abs() < 1e-5, "{step}: {behind}");
                assert!((axis.report("velocity") - rate).abs() < 1e-3, "{step}: {}", axis.report("velocity"));
            }
        }
        assert!((farthest - rate * rate / (2.0 * limit)).abs() < 3e-4, "{farthest}");
    }

    #[test]
    fn it_only_lowers() {
        let limit = [spec("actuator", "acceleration-limit", None, &[("limit", 5.0)])];
        let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        with("StraightConveyor", &[], &limit).check(&run, 0.3, &[("velocityActual", 0.3)]);
    }
}
