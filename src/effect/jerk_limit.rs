//! `jerk-limit`: the drive changes its acceleration no more steeply than `limit`.
//!
//! A motion of constant accelerations ±a, averaged over the time T = a/limit that has passed, has the jerk ±limit where
//! its acceleration changes by a: the S-curve is the trapezoid convolved with a boxcar (L. Biagiotti, C. Melchiorri,
//! Trajectory Planning for Automatic Machines and Robots, Springer 2008, sections 4.5 and 8.3). The average is exact for
//! parabolas.

use std::collections::VecDeque;

use super::table::{BASE, UNLIMITED, parameter};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Bounds, Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "jerk-limit",
    summary: "the drive changes its acceleration no more steeply than this",
    equation: "y(t) = 1/T·∫ x over the last T, T = acceleration/limit",
    source: "Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, Springer 2008, 4.5 and 8.3",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&["StraightConveyor", "ConveyorCurve", "CartesianRobot", "EncoderMotor"])],
    // No unit of its own in model files: m/s³ or rad/s³.
    parameters: &[parameter("limit", &[], (1e-3, UNLIMITED), UNLIMITED, 10.0, "greatest jerk, m/s³ or rad/s³")],
    excited_by: "changes of acceleration",
    build: Build::Stage(|values, _| Box::new(JerkLimit { limit: values[0], ..JerkLimit::default() })),
    ..BASE
};

/// The motion at an instant, and the integral of its position until then.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    at: f64,
    motion: Motion,
    integral: f64,
}

#[derive(Clone, Debug, Default)]
struct JerkLimit {
    limit: f64,
    /// What the drive may do, as it was told last.
    acceleration: f64,
    samples: VecDeque<Sample>,
}

impl JerkLimit {
    /// Integral and position of the motion at `instant`, at rest before all samples.
    fn at(&mut self, instant: f64) -> (f64, f64) {
        while self.samples.len() > 1 && self.samples[1].at <= instant {
            self.samples.pop_front();
        }
        let (Some(&before), next) = (self.samples.front(), self.samples.get(1)) else { return (0.0, 0.0) };
        let elapsed = instant - before.at;
        if elapsed <= 0.0 {
            return (before.integral + before.motion.position * elapsed, before.motion.position);
        }
        // Between two samples the position is the parabola through both with the first one's velocity.
        let bend = next.map_or(0.0, |next| {
            let span = next.at - before.at;
            2.0 * (next.motion.position - before.motion.position - before.motion.velocity * span) / (span * span)
        });
        let Motion { position, velocity } = before.motion;
        let there = position + (velocity + 0.5 * bend * elapsed) * elapsed;
        (before.integral + (position + (0.5 * velocity + bend * elapsed / 6.0) * elapsed) * elapsed, there)
    }
}

impl Stage for JerkLimit {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        self.acceleration = bounds.acceleration;
        bounds
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        let window = self.acceleration / self.limit;
        if self.limit >= UNLIMITED || window <= SAME_INSTANT_S || !window.is_finite() {
            return motion;
        }
        let last = self.samples.back().copied().unwrap_or(Sample { at: moment.now - moment.span, ..Sample::default() });
        if self.samples.is_empty() {
            self.samples.push_back(last);
        }
        let span = moment.now - last.at;
        if span > 0.0 {
            // The trapezoid of the position and the correction of its velocities: exact for a parabola.
            let correction = (last.motion.velocity - motion.velocity) * span / 12.0;
            let mean = 0.5 * (last.motion.position + motion.position) + correction;
            self.samples.push_back(Sample { at: moment.now, motion, integral: last.integral + mean * span });
        }
        let whole = self.samples.back().map_or(0.0, |sample| sample.integral);
        let (part, there) = self.at(moment.now - window);
        Motion { position: (whole - part) / window, velocity: (motion.position - there) / window }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        for Sample { at, motion, integral } in &self.samples {
            for number in [*at, motion.position, motion.velocity, *integral] {
                visit(number);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_ramp_begins_as_a_cubic_and_ends_where_it_should() {
        // Jerk 10 m/s³ up to 2 m/s²: x = 10·t³/6 for 0.2 s, then the parabola, 0.1 s late.
        let limit = [spec("actuator", "jerk-limit", Some("X"), &[("limit", 10.0)])];
        let mut robot = with("CartesianRobot", &[], &limit);
        robot.check(&[("XTarget", 1.0)], 0.1, &[]);
        assert!((robot.report("actualPosX") - 10.0 * 0.001 / 6.0).abs() < 1e-9);
        robot.check(&[], 0.2, &[]);
        // v = 2·(0.3 − 0.1), and x is the cubic's end and the parabola's way.
        let exact = 10.0 * 0.008 / 6.0 + 0.2 * 0.1 + 0.01;
        assert!((robot.report("actualPosX") - exact).abs() < 1e-9);
        robot.check(&[], 3.0, &[("actualPosX", 1.0), ("cartesianArrived", 1.0)]);
    }
}
