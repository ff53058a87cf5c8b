//! `gravity`: the weight of what an axis carries. On a linear axis a constant force, as `constant-force`; on a rotary one the
//! moment of an arm, force·sin(x − angle), that hangs down at `angle`.
//!
//! Source: the pendulum (any textbook of mechanics).

use super::table::{ANGLE, BASE, EFFORT, SERVO, parameter};
use crate::device::path::{Burden, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "gravity",
    summary: "the weight of what an axis carries",
    equation: "linear: M·dv/dt = F − R − force; rotary: … − force·sin(x − angle)",
    source: "the equation of the pendulum",
    places: &[EffectPlace::Load],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[
        parameter("force", EFFORT, (-1e6, 1e6), 0.0, 10.0, "weight, or greatest moment of it"),
        parameter("angle", ANGLE, (-7.0, 7.0), 0.0, 1.0, "where a rotary axis hangs down").or(0.0),
    ],
    excited_by: "positions far apart, held or slowly passed",
    build: Build::Stage(|values, site| {
        Box::new(Gravity { force: values[0], angle: values[1], is_rotary: site.parameters.text("motion") == "rotary" })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Gravity {
    force: f64,
    angle: f64,
    is_rotary: bool,
}

impl Stage for Gravity {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        if self.is_rotary { 1e-3 } else { f64::INFINITY }
    }

    fn burden(&mut self, burden: Burden, motion: Motion, moment: Moment) -> Burden {
        // Where it will be in the middle of the stretch.
        let middle = motion.position + 0.5 * motion.velocity * moment.span;
        let share = if self.is_rotary { (middle - self.angle).sin() } else { 1.0 };
        Burden { force: burden.force + self.force * share, ..burden }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn an_arm_swings_as_a_pendulum_does() {
        // Small swings about π/2 of 1 kg·m² under 4 N·m: 2 rad/s.
        let arm = spec("load", "gravity", None, &[("force", 4.0), ("angle", 1.0)]);
        let rotary = [("mode", "force"), ("motion", "rotary"), ("M", "1"), ("Fv", "0")];
        let mut axis = with("ServoAxis", &rotary, &[arm]);
        axis.check(&[], 0.0, &[("position", 0.0)]);
        let energy = |axis: &mut crate::device::bench::Bench| {
            let (x, v) = (axis.report("position"), axis.report("velocity"));
            0.5 * v * v - 4.0 * (x - 1.0).cos()
        };
        let start = energy(&mut axis);
        for _ in 0..5000 {
            axis.device.advance(1e-3);
            let now = energy(&mut axis);
            assert!((now - start).abs() < 1e-3, "{now} {start}");
        }
    }

    #[test]
    fn a_linear_axis_gives_way_to_its_weight() {
        let weight = spec("load", "gravity", None, &[("force", 50.0)]);
        with("ServoAxis", &[], &[weight]).check(&[], 5.0, &[("position", -0.0025), ("force", 50.0)]);
    }
}
