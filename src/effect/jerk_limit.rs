//! `jerk-limit`: the drive changes its acceleration no more steeply than `limit`.
//!
//! A motion of constant accelerations ±a, averaged over the time T = a/limit that has passed, has the jerk ±limit where
//! its acceleration changes by a: the S-curve is the trapezoid convolved with a boxcar (L. Biagiotti, C. Melchiorri,
//! Trajectory Planning for Automatic Machines and Robots, Springer 2008, sections 4.5 and 8.3). The average is exact for
//! parabolas. So a robot's profile is eased, which has an end.
//!
//! A speed on its ramp may be told another target before it is at the last: then the drive plans anew from the speed and the
//! acceleration that it has, the quickest way that its jerk and its acceleration allow (the same, section 3.4, of the speed instead of
//! the position). For a whole ramp that is the boxcar's curve.

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
    equation: "|da/dt| ≤ limit; of a profile y(t) = 1/T·∫ x over the last T, T = acceleration/limit",
    source: "Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, Springer 2008, 3.4, 4.5 and 8.3",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&["StraightConveyor", "ConveyorCurve", "CartesianRobot", "EncoderMotor"])],
    // No unit of its own in model files: m/s³ or rad/s³.
    parameters: &[parameter("limit", &[], (1e-3, UNLIMITED), UNLIMITED, 10.0, "greatest jerk, m/s³ or rad/s³")],
    excited_by: "changes of acceleration",
    build: Build::Stage(|values, site| match site.is_robot() {
        true => Box::new(JerkLimit { limit: values[0], ..JerkLimit::default() }),
        false => Box::new(EasedRamp { limit: values[0], ..EasedRamp::default() }),
    }),
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

/// A ramp whose acceleration changes no more steeply than `limit`.
#[derive(Clone, Debug, Default)]
struct EasedRamp {
    limit: f64,
    /// What the drive was told last: its speed, and how steeply that may rise and fall.
    target: f64,
    is_on: bool,
    rising: f64,
    falling: f64,
    /// The speed of the law, which a drive that is not ready yet holds.
    law: f64,
    motion: Motion,
    acceleration: f64,
}

impl EasedRamp {
    /// Moves by `span` towards `target`: its acceleration rises, stays, and is gone when it is there.
    fn advance(&mut self, target: f64, mut span: f64) {
        let Motion { velocity, .. } = self.motion;
        let jerk = self.limit;
        let is_slower = velocity * target < 0.0 || target.abs() < velocity.abs();
        let most = if is_slower { self.falling } else { self.rising };
        // Where it would come to if its acceleration began to go now.
        let coming = velocity + self.acceleration * self.acceleration.abs() / (2.0 * jerk);
        let side = if target >= coming { 1.0 } else { -1.0 };
        let (now, way) = (side * self.acceleration, side * (target - velocity));
        let peak = (jerk * way + 0.5 * now * now).max(0.0).sqrt();
        let [first, held] = match () {
            () if now > most => [(now - most) / jerk, (way - now * now / (2.0 * jerk)) / most],
            () if peak > most => [(most - now) / jerk, (way - (2.0 * most * most - now * now) / (2.0 * jerk)) / most],
            () => [(peak - now) / jerk, 0.0],
        };
        let rise = if now > most { -jerk } else { jerk };
        let last = peak.min(most).max(0.0) / jerk;
        for (jerk, time) in [(rise, first), (0.0, held), (-jerk, last)] {
            let time = time.max(0.0).min(span);
            self.go(side * jerk, time);
            span -= time;
            if span <= 0.0 {
                return;
            }
        }
        self.acceleration = 0.0;
        self.motion.velocity = target;
        self.motion.position += target * span;
    }

    /// Moves by `time` with this jerk.
    fn go(&mut self, jerk: f64, time: f64) {
        let Motion { position, velocity } = self.motion;
        let bend = self.acceleration;
        self.motion.position = position + (velocity + (0.5 * bend + jerk * time / 6.0) * time) * time;
        self.motion.velocity = velocity + (bend + 0.5 * jerk * time) * time;
        self.acceleration = bend + jerk * time;
    }
}

impl Stage for EasedRamp {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn switched(&mut self, on: bool, _moment: Moment) -> bool {
        self.is_on = on;
        on
    }

    fn reference(&mut self, reference: f64, _motion: Motion, _moment: Moment) -> f64 {
        self.target = reference;
        reference
    }

    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        (self.rising, self.falling) = (bounds.acceleration, bounds.deceleration);
        bounds
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        if self.limit >= UNLIMITED {
            return motion;
        }
        let waits = motion.velocity == self.law;
        self.law = motion.velocity;
        let target = match () {
            () if waits => motion.velocity,
            () if self.is_on => self.target,
            () => 0.0,
        };
        if moment.span > 0.0 {
            self.advance(target, moment.span);
        }
        self.motion
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        for number in [self.law, self.motion.position, self.motion.velocity, self.acceleration] {
            visit(number);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::effect::bench::{spec, with};

    fn ramp(limit: f64, velocity: f64, acceleration: f64) -> EasedRamp {
        let motion = Motion { position: 0.0, velocity };
        EasedRamp { limit, rising: 2.0, falling: 2.0, motion, acceleration, ..EasedRamp::default() }
    }

    /// To 1 m/s with 2 m/s² and 10 m/s³: 0.2 s of rise, 0.3 s at full acceleration, 0.2 s of fall; and to 0.1 m/s, which needs no more
    /// than √(10·0.1) = 1 m/s².
    #[test]
    fn a_ramp_is_an_s_and_a_short_one_does_not_reach_its_slope() {
        let mut long = ramp(10.0, 0.0, 0.0);
        long.advance(1.0, 0.2);
        assert!((long.motion.velocity - 0.2).abs() < 1e-12 && (long.acceleration - 2.0).abs() < 1e-12);
        long.advance(1.0, 0.5);
        assert!((long.motion.velocity - 1.0).abs() < 1e-12 && (long.motion.position - 0.35).abs() < 1e-12, "{long:?}");
        let mut short = ramp(10.0, 0.0, 0.0);
        short.advance(0.1, 0.1);
        assert!((short.motion.velocity - 0.05).abs() < 1e-12 && (short.acceleration - 1.0).abs() < 1e-12);
        short.advance(0.1, 0.1);
        assert!((short.motion.velocity - 0.1).abs() < 1e-12 && short.acceleration.abs() < 1e-12, "{short:?}");
    }

    /// Told to turn round at full acceleration, it first loses that.
    #[test]
    fn a_ramp_that_is_told_otherwise_goes_on_from_its_acceleration() {
        let mut turned = ramp(10.0, 0.2, 2.0);
        turned.advance(-1.0, 0.2);
        assert!((turned.motion.velocity - 0.4).abs() < 1e-12 && turned.acceleration.abs() < 1e-12, "{turned:?}");
        turned.advance(-1.0, 10.0);
        assert!((turned.motion.velocity + 1.0).abs() < 1e-12 && turned.acceleration == 0.0);
    }

    proptest! {
        /// In one go or in two, it comes to the same, within its limits.
        #[test]
        fn splitting_a_span_changes_nothing(
            start in -2.0..2.0_f64, target in -2.0..2.0_f64, bend in -2.0..2.0_f64, limit in 1.0..100.0_f64, span in 0.0..3.0_f64,
            cut in 0.0..1.0_f64,
        ) {
            let [mut whole, mut split] = [ramp(limit, start, bend), ramp(limit, start, bend)];
            whole.advance(target, span);
            split.advance(target, cut * span);
            prop_assert!(split.acceleration.abs() <= 2.0 + 1e-9);
            prop_assert!((split.acceleration - bend).abs() <= limit * cut * span + 1e-9);
            split.advance(target, span - cut * span);
            let apart = (whole.motion.velocity - split.motion.velocity).abs() + (whole.motion.position - split.motion.position).abs();
            prop_assert!(apart < 1e-7, "{whole:?} {split:?}");
        }
    }

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
