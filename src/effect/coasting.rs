//! `coasting`: a drive that is switched off coasts instead of following its ramp: it slows down by `deceleration`, no more
//! steeply than nominally. A cylinder, which nominally stands at once when it is held, drifts on.
//!
//! Source: Coulomb friction alone, m·dv/dt = −F_r (any textbook of mechanics).

use super::table::{ACCELERATION, BASE, UNLIMITED, parameter};
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "coasting",
    summary: "a drive that is switched off coasts instead of following its ramp",
    equation: "off: |dv/dt| = deceleration until v = 0",
    source: "Newton, second law, with Coulomb friction",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&["StraightConveyor", "ConveyorCurve", "Pusher", "EncoderMotor"])],
    parameters: &[parameter(
        "deceleration",
        ACCELERATION,
        (1e-6, UNLIMITED),
        UNLIMITED,
        0.5,
        "how steeply it slows down while it is off",
    )],
    excited_by: "switching off while in motion",
    build: Build::Stage(|values, _| Box::new(Coasting { deceleration: values[0], on: false })),
    ..BASE
};

#[derive(Clone, Debug)]
struct Coasting {
    deceleration: f64,
    on: bool,
}

impl Stage for Coasting {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn switched(&mut self, on: bool, _moment: Moment) -> bool {
        self.on = on;
        on
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        if self.on || self.deceleration >= UNLIMITED {
            return bounds;
        }
        Bounds { deceleration: bounds.deceleration.min(self.deceleration), ..bounds }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(f64::from(u8::from(self.on)));
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    fn coasting(deceleration: f64) -> [crate::plant::EffectSpec; 1] {
        [spec("actuator", "coasting", None, &[("deceleration", deceleration)])]
    }

    const RUN: [(&str, f64); 2] = [("velocityTarget", 0.5), ("motorDirection", 1.0)];

    #[test]
    fn a_belt_coasts_while_it_is_off_and_brakes_while_it_is_on() {
        let mut belt = with("StraightConveyor", &[], &coasting(0.2));
        belt.check(&RUN, 1.0, &[("velocityActual", 0.5)]);
        belt.check(&[("motorDirection", 0.0)], 1.0, &[("velocityActual", 0.3), ("driveEnabled", 0.0)]);
        assert!((belt.displacement() - 0.4).abs() < 1e-12);
        belt.check(&[("motorDirection", 1.0), ("velocityTarget", 0.1)], 0.1, &[("velocityActual", 0.2)]);
    }

    #[test]
    fn it_never_slows_down_more_steeply() {
        let mut belt = with("StraightConveyor", &[("coast", "true"), ("coastDeceleration", "0.1")], &coasting(0.2));
        belt.check(&RUN, 1.0, &[]);
        belt.check(&[("motorDirection", 0.0)], 1.0, &[("velocityActual", 0.4)]);
    }

    #[test]
    fn a_held_cylinder_drifts_on_as_far_as_its_speed_carries_it() {
        // 0.5 m/s and 5 m/s²: 0.025 m in 0.1 s; then retracting from there takes 0.525 m / 0.5 m/s to the switch's 2 mm.
        let mut pusher = with("Pusher", &[("stroke", "1")], &coasting(5.0));
        pusher.check(&[("command", 1.0)], 1.0, &[("isRunning", 1.0)]);
        pusher.check(&[("command", 0.0)], 0.09, &[("isRunning", 1.0)]);
        pusher.check(&[], 0.02, &[("isRunning", 0.0)]);
        pusher.check(&[("command", 2.0)], 2.0 * (0.525 - 0.002) - 1e-6, &[("limitRetracted", 0.0)]);
        pusher.check(&[], 2e-6, &[("limitRetracted", 1.0)]);
    }
}
