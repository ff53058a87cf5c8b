//! `first-order-lag`: what the drive does follows what it should do as a first-order lag:
//! time_constant · dy/dt + y = x, applied to position and velocity alike.
//!
//! Source: the first-order lag of linear control theory (K. J. Åström, T. Hägglund, Advanced PID Control, ISA 2006,
//! section 2.4). Over a stretch the input is taken to move on a straight line, for which the solution is exact.

use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{EffectDescriptor, EffectParameter, Fit};
use crate::plant::EffectPlace;
use crate::value::Quantity;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "first-order-lag",
    summary: "the drive follows its law with a first-order lag",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&[
        "StraightConveyor",
        "ConveyorCurve",
        "Pusher",
        "CartesianRobot",
        "ServoAxis",
        "EncoderMotor",
    ])],
    parameters: &[EffectParameter {
        name: "time_constant",
        quantities: &[Quantity::Time],
        range: (0.0, 10.0),
        nominal: 0.0,
        typical: 0.05,
        summary: "time after which 63 % of a step have been followed",
    }],
    excited_by: "changes of speed",
    build: |values| Box::new(FirstOrderLag { time_constant: values[0], last: None }),
};

/// The lag and where it is.
#[derive(Clone, Debug)]
struct FirstOrderLag {
    time_constant: f64,
    /// The input at the end of the last stretch, and the output.
    last: Option<(Motion, Motion)>,
}

/// The lag's answer after `span` to an input that goes from `from` to `to` on a straight line, the output being `output`
/// at first. With slope s = (to − from) / span the particular solution is x − time_constant·s; the rest decays.
fn follow(output: f64, from: f64, to: f64, span: f64, time_constant: f64) -> f64 {
    if time_constant <= 0.0 {
        return to;
    }
    if span <= 0.0 {
        return output;
    }
    let trail = time_constant * (to - from) / span;
    to - trail + (output - from + trail) * (-span / time_constant).exp()
}

impl Stage for FirstOrderLag {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        let (input, output) = self.last.unwrap_or((motion, motion));
        let lag = |output, from, to| follow(output, from, to, moment.span, self.time_constant);
        let next = Motion {
            position: lag(output.position, input.position, motion.position),
            velocity: lag(output.velocity, input.velocity, motion.velocity),
        };
        self.last = Some((motion, next));
        next
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        if let Some((input, output)) = self.last {
            for number in [input.position, input.velocity, output.position, output.velocity] {
                visit(number);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_followed_as_the_closed_form_says() {
        // x = t: y = t − T·(1 − e^(−t/T)).
        let mut lag = FirstOrderLag { time_constant: 0.05, last: None };
        lag.motion(Motion::default(), Moment::default());
        for step in 1..=1000 {
            let now = f64::from(step) * 1e-3;
            let output = lag.motion(Motion { position: now, velocity: 1.0 }, Moment { now, span: 1e-3 });
            let exact = now - 0.05 * (1.0 - (-now / 0.05).exp());
            assert!((output.position - exact).abs() < 1e-12, "at {now}: {} instead of {exact}", output.position);
        }
    }

    #[test]
    fn at_its_nominal_value_it_does_nothing() {
        let mut lag = FirstOrderLag { time_constant: 0.0, last: None };
        let motion = Motion { position: 3.0, velocity: 2.0 };
        assert_eq!(lag.motion(motion, Moment { now: 1.0, span: 1e-3 }), motion);
    }
}
