//! `constant-force`: something pulls at the axis all the time: a spring of long travel, a hose, the weight on an axis that
//! is not level. Positive opposes positive motion.
//!
//! Source: Newton's second law.

use super::table::{BASE, EFFORT, SERVO, parameter};
use crate::device::path::{Burden, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "constant-force",
    summary: "something pulls at the axis all the time",
    equation: "M·dv/dt = F − R − force",
    source: "Newton, second law",
    places: &[EffectPlace::Load],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[parameter("force", EFFORT, (-1e6, 1e6), 0.0, 10.0, "opposes positive motion if positive")],
    excited_by: "holding and motion; the drive's effort most of all",
    build: Build::Stage(|values, _| Box::new(ConstantForce { force: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct ConstantForce {
    force: f64,
}

impl Stage for ConstantForce {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn burden(&mut self, burden: Burden, _motion: Motion, _moment: Moment) -> Burden {
        Burden { force: burden.force + self.force, ..burden }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_loop_without_an_integrator_gives_way() {
        let force = spec("load", "constant-force", None, &[("force", 50.0)]);
        with("ServoAxis", &[], &[force]).check(&[], 5.0, &[("position", -0.0025), ("force", 50.0)]);
    }
}
