//! `second-order-lag`: what the drive does follows what it should do as a second-order lag:
//! y'' + 2·damping·ω·y' + ω²·y = ω²·x, with ω the natural frequency; on a servo axis with forces, its force.
//!
//! Source: the oscillator of linear control theory (K. J. Åström, R. M. Murray, Feedback Systems, Princeton 2008, section
//! 6.3). Over a stretch the input is taken to be a parabola, for which the solution is exact.

use super::first_order_lag::Course;
use super::table::{BASE, FREQUENCY, ONE, parameter};
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// The natural frequency from which on it is taken to do nothing, rad/s.
const STIFF: f64 = 1e6;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "second-order-lag",
    summary: "the drive follows its law with a second-order lag, and may ring",
    equation: "y'' + 2·damping·natural_frequency·y' + natural_frequency²·(y − x) = 0",
    source: "Åström, Murray, Feedback Systems, Princeton 2008, 6.3",
    places: &[EffectPlace::Actuator],
    parameters: &[
        parameter("natural_frequency", FREQUENCY, (1.0, STIFF), STIFF, 60.0, "frequency without damping"),
        parameter("damping", ONE, (0.01, 100.0), 1.0, 0.7, "damping ratio; below 1 it rings"),
    ],
    excited_by: "changes of speed",
    build: Build::Stage(|values, _| {
        let decay = values[1] * values[0];
        Box::new(SecondOrderLag { frequency: values[0], decay, ..SecondOrderLag::default() })
    }),
    ..BASE
};

/// The lag and where it is.
#[derive(Clone, Debug, Default)]
struct SecondOrderLag {
    frequency: f64,
    /// Damping ratio times frequency, 1/s.
    decay: f64,
    /// The input at the end of the last stretch.
    input: Motion,
    output: Motion,
    force: f64,
    force_output: Motion,
}

impl SecondOrderLag {
    /// The lag's answer after `span` to an input on `course`: with x'' constant the particular solution is
    /// x − 2ζ/ω·x' + (4ζ² − 1)/ω²·x''; the rest u decays as u'' + 2ζω·u' + ω²·u = 0.
    fn follow(&self, output: Motion, course: Course, span: f64) -> Motion {
        let (frequency, decay) = (self.frequency, self.decay);
        if span <= 0.0 {
            return output;
        }
        let square = frequency * frequency;
        let trail = 2.0 * decay / square;
        let bent = (trail * trail - 1.0 / square) * course.bend;
        let slope = course.slope(span);
        let particular =
            |x: f64, slope: f64| Motion { position: x - trail * slope + bent, velocity: slope - trail * course.bend };
        let start = particular(course.from, slope);
        let end = particular(course.to, slope + course.bend * span);
        let (u, du) = (output.position - start.position, output.velocity - start.velocity);
        let (cosine, sine) = modes(frequency, decay, span);
        Motion {
            position: end.position + u * cosine + (du + decay * u) * sine,
            velocity: end.velocity + du * cosine - (square * u + decay * du) * sine,
        }
    }
}

/// e^(−ζω·t)·cos(ω_d·t) and e^(−ζω·t)·sin(ω_d·t)/ω_d after `span`, with ω the `frequency`, ζω the `decay` and
/// ω_d² = ω² − (ζω)², which may be negative.
pub(super) fn modes(frequency: f64, decay: f64, span: f64) -> (f64, f64) {
    let difference = frequency * frequency - decay * decay;
    let envelope = (-decay * span).exp();
    let turn = difference.abs().sqrt() * span;
    if turn < 1e-6 {
        return (envelope, envelope * span);
    }
    if difference > 0.0 {
        let (sine, cosine) = turn.sin_cos();
        return (envelope * cosine, envelope * sine * span / turn);
    }
    let (slow, fast) = ((turn - decay * span).exp(), (-turn - decay * span).exp());
    (0.5 * (slow + fast), 0.5 * (slow - fast) * span / turn)
}

impl Stage for SecondOrderLag {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        if self.frequency >= STIFF {
            return motion;
        }
        let course = Course::of(self.input, motion, moment.span.max(1e-12));
        self.output = self.follow(self.output, course, moment.span);
        self.input = motion;
        self.output
    }

    fn effort(&mut self, effort: f64, moment: Moment) -> f64 {
        let (before, from) = (self.force_output, self.force);
        if moment.span <= 0.0 {
            self.force = effort;
            return before.position;
        }
        let next = self.follow(before, Course::straight(from, effort), moment.span);
        (self.force, self.force_output) = (effort, next);
        // The oscillator's equation, integrated over the stretch.
        let change = (next.velocity - before.velocity) + 2.0 * self.decay * (next.position - before.position);
        0.5 * (from + effort) - change / (self.frequency * self.frequency * moment.span)
    }

    fn shapes_effort(&self) -> bool {
        self.frequency < STIFF
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        for motion in [self.input, self.output, self.force_output] {
            visit(motion.position);
            visit(motion.velocity);
        }
        visit(self.force);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(damping: f64, exact: impl Fn(f64) -> f64) {
        for span in [1e-3, 1e-2] {
            let mut lag = SecondOrderLag { frequency: 20.0, decay: 20.0 * damping, ..SecondOrderLag::default() };
            lag.motion(Motion { position: 1.0, velocity: 0.0 }, Moment::default());
            for step in 1..=(0.5 / span) as u32 {
                let now = f64::from(step) * span;
                let output = lag.motion(Motion { position: 1.0, velocity: 0.0 }, Moment { now, span });
                assert!((output.position - exact(now)).abs() < 1e-12, "{damping} at {now}: {}", output.position);
            }
        }
    }

    #[test]
    fn a_step_is_the_closed_form_whatever_the_damping() {
        let frequency = 20.0 * (1.0 - 0.3_f64 * 0.3).sqrt();
        check(0.3, |t| 1.0 - (-6.0 * t).exp() * ((frequency * t).cos() + 6.0 / frequency * (frequency * t).sin()));
        check(1.0, |t| 1.0 - (-20.0 * t).exp() * (1.0 + 20.0 * t));
        // Poles at −20·(1.25 ∓ 0.75).
        check(1.25, |t| 1.0 - (40.0 * (-10.0 * t).exp() - 10.0 * (-40.0 * t).exp()) / 30.0);
    }
}
