//! `force-limit`: the drive exerts no more than `limit`; only lowers what it may do. The reported force is after it.
//!
//! Source: saturation (H. K. Khalil, Nonlinear Systems, Prentice Hall 2002, section 1.2.7), of a force.

use super::table::{BASE, EFFORT, SERVO, UNLIMITED, parameter};
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "force-limit",
    summary: "the drive exerts no more than this",
    equation: "|F| ≤ limit",
    source: "Khalil, Nonlinear Systems, Prentice Hall 2002, 1.2.7 (saturation)",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[parameter("limit", EFFORT, (1e-6, UNLIMITED), UNLIMITED, 100.0, "greatest force either way")],
    excited_by: "forces above the limit: steep or long steps",
    build: Build::Stage(|values, _| Box::new(ForceLimit { limit: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct ForceLimit {
    limit: f64,
}

impl Stage for ForceLimit {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        Bounds { force: bounds.force.min(self.limit), ..bounds }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn at_the_limit_it_is_the_closed_form_of_the_first_order() {
        let limit = [spec("actuator", "force-limit", None, &[("limit", 100.0)])];
        let velocity = 2.0 * (1.0 - (-2.5_f64 * 0.2).exp());
        let mut axis = with("ServoAxis", &[], &limit);
        axis.check(&[("positionTarget", 5.0)], 0.2, &[("velocity", velocity), ("force", 100.0)]);
    }
}
