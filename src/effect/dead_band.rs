//! `dead-band`: a band about nothing in which nothing happens: of the speed asked of a ramped drive or a cylinder, of the
//! change of a robot axis's target, of the control error of a servo axis.
//!
//! With x in ±width/2 the exit is 0; beyond it is x itself, or with `shift` 1 what x exceeds the band by, as the stiction
//! band of a proportional servo is (then an ideal axis with it and one with play are the same).
//!
//! Source: the dead zone (H. K. Khalil, Nonlinear Systems, Prentice Hall 2002, section 1.2.7).

use super::table::{BASE, ONE, TRAVEL, parameter};
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "dead-band",
    summary: "a band of the drive's reference, of the target's change, or of the control error in which nothing happens",
    equation: "|x| ≤ width/2: y = 0; else y = x − shift·sign(x)·width/2",
    source: "Khalil, Nonlinear Systems, Prentice Hall 2002, 1.2.7 (dead zone)",
    places: &[EffectPlace::Actuator],
    parameters: &[
        parameter("width", TRAVEL, (0.0, 1e3), 0.0, 0.02, "the whole band; on a ramped drive or a cylinder a speed"),
        parameter(
            "shift",
            ONE,
            (0.0, 1.0),
            0.0,
            1.0,
            "1: what lies beyond the band is less by half of it; 0: it passes",
        )
        .or(0.0)
        .one_of(&[0.0, 1.0]),
    ],
    excited_by: "small references, small changes of a target, small errors",
    build: Build::Stage(|values, site| {
        Box::new(DeadBand { half: 0.5 * values[0], shift: values[1], accepted: site.is_robot().then_some(0.0) })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct DeadBand {
    half: f64,
    shift: f64,
    /// The target that a robot's axis has taken.
    accepted: Option<f64>,
}

impl DeadBand {
    fn pass(&self, value: f64) -> f64 {
        if self.half == 0.0 {
            value
        } else if value.abs() <= self.half {
            0.0
        } else {
            value - self.shift * self.half.copysign(value)
        }
    }
}

impl Stage for DeadBand {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    /// A loop that enters or leaves the band looks for the instant at the end of every stretch.
    fn stretch(&self) -> f64 {
        5e-3
    }

    fn reference(&mut self, reference: f64, _motion: Motion, _moment: Moment) -> f64 {
        let Some(accepted) = self.accepted else { return self.pass(reference) };
        let change = reference - accepted;
        let passed = self.pass(change);
        // To the last bit where all of it passes.
        let target = if passed == change { reference } else { accepted + passed };
        self.accepted = Some(target);
        target
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.accepted.into_iter().for_each(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn small_things_are_not_followed() {
        let band = |component, shift| [spec("actuator", "dead-band", component, &[("width", 0.02), ("shift", shift)])];
        let run = |speed| [("velocityTarget", speed), ("motorDirection", 1.0)];
        let mut belt = with("StraightConveyor", &[], &band(None, 0.0));
        belt.check(&run(0.009), 1.0, &[("velocityActual", 0.0)]);
        belt.check(&run(0.5), 1.0, &[("velocityActual", 0.5)]);
        with("StraightConveyor", &[], &band(None, 1.0)).check(&run(0.5), 1.0, &[("velocityActual", 0.49)]);
        let mut robot = with("CartesianRobot", &[], &band(Some("X"), 0.0));
        robot.check(&[("XTarget", 0.5)], 2.0, &[("actualPosX", 0.5)]);
        robot.check(&[("XTarget", 0.505)], 2.0, &[("actualPosX", 0.5)]);
        robot.check(&[("XTarget", 0.512)], 2.0, &[("actualPosX", 0.512)]);
    }

    #[test]
    fn a_servo_comes_to_rest_at_the_edge_of_its_band() {
        let band = [spec("actuator", "dead-band", None, &[("width", 0.02), ("shift", 1.0)])];
        // The loop is overdamped by far with these gains: it creeps to the edge.
        let gains = [("positionGain", "5")];
        let mut axis = with("ServoAxis", &gains, &band);
        axis.check(&[("positionTarget", 0.1)], 10.0, &[("position", 0.09), ("force", 0.0)]);
    }

    #[test]
    fn on_an_ideal_axis_it_is_play() {
        let band = [spec("actuator", "dead-band", None, &[("width", 0.02), ("shift", 1.0)])];
        let mut axis = with("ServoAxis", &[("mode", "ideal")], &band);
        for (target, position) in [(0.1, 0.09), (0.085, 0.09), (0.06, 0.07), (0.09, 0.08)] {
            axis.check(&[("positionTarget", target)], 0.1, &[("position", position)]);
        }
    }
}
