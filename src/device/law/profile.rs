//! A trapezoidal profile that may be given another target at any time.
//!
//! From the present position and velocity the profile is the time-optimal motion to rest at the target under a maximum
//! velocity v and a maximum acceleration a. With p* = p + v·|v| / 2a, where full braking would end, the motion first
//! heads for the side of p* on which the target lies: ±a until the peak speed, then that speed, then ∓a into the target.
//! A target that is too near or behind lies on the other side of p*: the axis brakes at full deceleration, passes it and
//! returns. A velocity above the maximum first falls to it.

use super::SAME_INSTANT_S;
use super::sum::Sum;
use crate::device::path::Motion;

/// What an axis may do: m/s and m/s², or rad/s and rad/s²; both above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    pub velocity: f64,
    pub acceleration: f64,
}

/// A stretch of constant acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Segment {
    seconds: f64,
    acceleration: f64,
    /// Position and velocity where it begins.
    position: f64,
    velocity: f64,
}

impl Segment {
    fn position(&self, seconds: f64) -> f64 {
        self.position + (self.velocity + 0.5 * self.acceleration * seconds) * seconds
    }

    fn velocity(&self, seconds: f64) -> f64 {
        self.velocity + self.acceleration * seconds
    }
}

/// An axis on its profile, at rest at 0 to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    limits: Limits,
    target: f64,
    /// The way to the target: up to the peak speed, at that speed, and into the target; some may take no time.
    segments: [Segment; 3],
    /// Since the plan was made, s.
    elapsed: Sum,
}

impl Profile {
    /// An axis at rest at 0.
    pub fn new(limits: Limits) -> Profile {
        Profile { limits, target: 0.0, segments: [Segment::default(); 3], elapsed: Sum::default() }
    }

    /// An axis at rest at `position`.
    pub fn at(limits: Limits, position: f64) -> Profile {
        Profile { target: position, ..Profile::new(limits) }
    }

    /// An axis that is at `position` with `velocity` and heads for `target`.
    pub fn under_way(limits: Limits, position: f64, velocity: f64, target: f64) -> Profile {
        let mut profile = Profile::new(limits);
        profile.segments[0] = Segment { seconds: f64::INFINITY, acceleration: 0.0, position, velocity };
        profile.plan(target);
        profile
    }

    /// Where it is to go.
    pub fn target(&self) -> f64 {
        self.target
    }

    /// Makes a new plan from the present position and velocity to `target`; the same target leaves the plan as it is.
    pub fn retarget(&mut self, target: f64) {
        if target != self.target {
            self.plan(target);
        }
    }

    /// From now on other limits hold. A velocity above a lowered maximum falls to it at full deceleration.
    pub fn limit(&mut self, limits: Limits) {
        if limits != self.limits {
            self.limits = limits;
            self.plan(self.target);
        }
    }

    /// Moves by `seconds`.
    pub fn advance(&mut self, seconds: f64) {
        if !self.has_ended() {
            self.elapsed.add(seconds);
        }
    }

    /// Whether it is at its target for good.
    pub fn has_ended(&self) -> bool {
        self.now().is_none()
    }

    /// Present position: the target itself once the plan has ended.
    pub fn position(&self) -> f64 {
        self.motion().position
    }

    /// Present velocity: 0 once the plan has ended.
    pub fn velocity(&self) -> f64 {
        self.motion().velocity
    }

    /// Present position and velocity.
    pub fn motion(&self) -> Motion {
        let there = Motion { position: self.target, velocity: 0.0 };
        self.now().map_or(there, |(segment, seconds)| Motion {
            position: segment.position(seconds),
            velocity: segment.velocity(seconds),
        })
    }

    /// The present segment, and the time since it began; `None` once the plan has ended.
    fn now(&self) -> Option<(&Segment, f64)> {
        let mut seconds = self.elapsed.value();
        for segment in &self.segments {
            if seconds < segment.seconds - SAME_INSTANT_S {
                return Some((segment, seconds));
            }
            seconds -= segment.seconds;
        }
        None
    }

    /// For how long from now on its acceleration stays as it is if no target comes, s.
    pub fn steady(&self) -> f64 {
        self.now().map_or(f64::INFINITY, |(segment, seconds)| segment.seconds - seconds)
    }

    /// For how long from now on it is further than `near` from its target or not slower than `slow`, s. `None` where it still turns round, or does not
    /// brake all the way in from `near`.
    pub fn away_for(&self, near: f64, slow: f64) -> Option<f64> {
        let (segment, since) = self.now()?;
        let last = &self.segments[2];
        let (peak, acceleration) = (last.velocity, last.acceleration.abs());
        let turns_round = segment.velocity(since) * peak < 0.0;
        if turns_round || near > 0.5 * peak * peak / acceleration {
            return None;
        }
        let left = self.segments.iter().map(|segment| segment.seconds).sum::<f64>() - self.elapsed.value();
        Some(left - f64::min(slow / acceleration, (2.0 * near / acceleration).sqrt()))
    }

    fn plan(&mut self, target: f64) {
        let (position, velocity) = (self.position(), self.velocity());
        let Limits { velocity: fastest, acceleration } = self.limits;
        let braked = position + velocity * velocity.abs() / (2.0 * acceleration);
        // Computed as if the way led forwards: `speed` is negative while the axis still moves the other way.
        let side = if target >= braked { 1.0 } else { -1.0 };
        let (distance, speed) = (side * (target - position), side * velocity);
        // Up with a and down with a over the distance: 2·peak² = 2·a·distance + speed². At least the present speed, or
        // rounding would turn a brake into a jolt.
        let square = acceleration * distance + 0.5 * speed * speed;
        let peak = square.max(0.0).sqrt().max(speed).min(fastest);
        let first = Segment {
            seconds: (peak - speed).abs() / acceleration,
            acceleration: side * acceleration.copysign(peak - speed),
            position,
            velocity,
        };
        let peaked = first.position(first.seconds);
        let cruise = side * (target - peaked) - peak * peak / (2.0 * acceleration);
        let second = Segment {
            seconds: if peak > 0.0 { (cruise / peak).max(0.0) } else { 0.0 },
            acceleration: 0.0,
            position: peaked,
            velocity: side * peak,
        };
        let third = Segment {
            seconds: peak / acceleration,
            acceleration: -side * acceleration,
            position: second.position(second.seconds),
            velocity: side * peak,
        };
        self.segments = [first, second, third];
        self.target = target;
        self.elapsed = Sum::default();
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.target);
        for segment in &self.segments {
            visit(segment.seconds);
            visit(segment.acceleration);
            visit(segment.position);
            visit(segment.velocity);
        }
        self.elapsed.state(visit);
    }
}

/// Where an axis is after `span` that was at `from` and pursues `target`, a motion of constant speed, as fast as its limits let
/// it: as the target sees it, a way to rest at the target ([`Profile`]), in a frame that moves no faster than the axis may.
pub fn pursued(within: Limits, from: Motion, target: Motion, span: f64) -> Motion {
    let most = within.velocity.min(1e9);
    let pace = target.velocity.clamp(-most, most);
    // What the frame's own speed leaves of the limit, on the side that the axis has to go to.
    let ahead = target.position - from.position;
    let limits = Limits { velocity: (most - pace * ahead.signum()).max(1e-9), acceleration: within.acceleration };
    let mut profile = Profile::under_way(limits, from.position, from.velocity - pace, target.position);
    profile.advance(span);
    Motion { position: profile.position() + pace * span, velocity: profile.velocity() + pace }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const LIMITS: Limits = Limits { velocity: 1.0, acceleration: 2.0 };

    /// An axis that moves with `velocity` through `position`.
    fn moving(position: f64, velocity: f64) -> Profile {
        let segment = Segment { seconds: 1e9, acceleration: 0.0, position, velocity };
        Profile { segments: [segment; 3], ..Profile::new(LIMITS) }
    }

    /// Where the axis is after so many seconds, and how fast.
    fn check(profile: &Profile, expected: &[(f64, f64, f64)]) {
        for &(seconds, position, velocity) in expected {
            let mut axis = *profile;
            axis.advance(seconds);
            let place = format!("after {seconds} s at {} with {}", axis.position(), axis.velocity());
            assert!((axis.position() - position).abs() < 1e-12, "{place}, not at {position}");
            assert!((axis.velocity() - velocity).abs() < 1e-12, "{place}, not with {velocity}");
        }
    }

    #[test]
    fn at_rest_at_the_start() {
        check(&Profile::new(LIMITS), &[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)]);
    }

    #[test]
    fn a_long_way_is_a_trapezoid() {
        let mut axis = Profile::new(LIMITS);
        axis.retarget(2.0);
        check(&axis, &[(0.25, 0.0625, 0.5), (0.5, 0.25, 1.0), (1.5, 1.25, 1.0), (2.0, 1.75, 1.0)]);
        check(&axis, &[(2.25, 1.9375, 0.5), (2.5, 2.0, 0.0), (9.0, 2.0, 0.0)]);
    }

    #[test]
    fn a_short_way_is_a_triangle() {
        let mut axis = Profile::new(LIMITS);
        axis.retarget(-0.125);
        check(
            &axis,
            &[(0.125, -0.015625, -0.25), (0.25, -0.0625, -0.5), (0.375, -0.109375, -0.25), (0.5, -0.125, 0.0)],
        );
    }

    #[test]
    fn a_further_target_is_taken_up_in_motion() {
        let mut axis = moving(1.0, 0.5);
        axis.retarget(3.0);
        // Up from 0.5 to 1 in 0.25 s over 0.1875 m, down over 0.25 m, and 1.5625 m between.
        check(&axis, &[(0.25, 1.1875, 1.0), (1.8125, 2.75, 1.0), (2.3125, 3.0, 0.0)]);
    }

    #[test]
    fn a_target_too_near_is_passed_and_returned_to() {
        let mut axis = moving(0.0, 1.0);
        axis.retarget(0.125);
        // Braking ends at 0.25 after 0.5 s; back over 0.125 m with a peak of 0.5 m/s.
        check(&axis, &[(0.25, 0.1875, 0.5), (0.5, 0.25, 0.0), (0.75, 0.1875, -0.5), (1.0, 0.125, 0.0)]);
    }

    #[test]
    fn a_target_behind_is_returned_to_without_a_stop() {
        let mut axis = moving(0.0, 1.0);
        axis.retarget(-2.0);
        check(&axis, &[(0.5, 0.25, 0.0), (1.0, 0.0, -1.0), (2.5, -1.5, -1.0), (2.75, -1.75, -1.0), (3.25, -2.0, 0.0)]);
    }

    #[test]
    fn the_target_where_braking_ends_is_reached_by_braking() {
        let mut axis = moving(0.0, 1.0);
        axis.retarget(0.25);
        check(&axis, &[(0.25, 0.1875, 0.5), (0.5, 0.25, 0.0), (0.6, 0.25, 0.0)]);
        let mut axis = moving(0.0, -1.0);
        axis.retarget(-0.25);
        check(&axis, &[(0.25, -0.1875, -0.5), (0.5, -0.25, 0.0), (0.6, -0.25, 0.0)]);
    }

    #[test]
    fn a_velocity_above_a_lowered_maximum_falls_to_it() {
        let mut axis = Profile::new(LIMITS);
        axis.retarget(2.0);
        axis.advance(0.5);
        axis.limit(Limits { velocity: 0.5, acceleration: 2.0 });
        // From 0.25 m: down to 0.5 m/s in 0.25 s over 0.1875 m, cruise 1.5 m in 3 s, brake over 0.0625 m in 0.25 s.
        check(&axis, &[(0.25, 0.4375, 0.5), (3.25, 1.9375, 0.5), (3.5, 2.0, 0.0)]);
    }

    #[test]
    fn the_same_target_again_changes_nothing() {
        let mut axis = Profile::new(LIMITS);
        axis.retarget(1.0);
        axis.advance(0.3);
        let before = axis;
        axis.retarget(1.0);
        assert_eq!(axis, before);
    }

    proptest! {
        #[test]
        fn it_never_exceeds_its_limits_and_always_arrives(
            velocity in 0.01..5.0_f64, acceleration in 0.01..20.0_f64,
            targets in prop::collection::vec((-3.0..3.0_f64, 0.0..2.0_f64), 1..12),
        ) {
            let mut axis = Profile::new(Limits { velocity, acceleration });
            let step = 0.001;
            for (target, seconds) in targets {
                axis.retarget(target);
                let mut rest = seconds;
                while rest > 0.0 {
                    let before = axis;
                    axis.advance(step);
                    rest -= step;
                    prop_assert!(axis.velocity().abs() <= velocity * (1.0 + 1e-12));
                    let change = (axis.velocity() - before.velocity()).abs();
                    prop_assert!(change <= acceleration * step + 1e-9, "{}", change / step);
                    let way = (axis.position() - before.position()).abs();
                    prop_assert!(way <= velocity * step + 1e-9);
                }
            }
            // The longest way there may be, at the peak speed and at the acceleration.
            axis.advance(10.0 / velocity + 4.0 * velocity / acceleration + 4.0 * (10.0 / acceleration).sqrt());
            prop_assert_eq!((axis.position(), axis.velocity()), (axis.target(), 0.0));
        }

        #[test]
        fn it_is_steady_into_its_target(target in -3.0..3.0_f64, velocity in -1.0..1.0_f64) {
            let mut axis = moving(0.0, velocity);
            axis.retarget(target);
            let end = axis.segments.iter().map(|segment| segment.seconds).sum::<f64>();
            axis.advance(end - 1e-8);
            prop_assert!((axis.position() - target).abs() < 1e-12);
            prop_assert!(axis.velocity().abs() < 1e-7);
        }

        #[test]
        fn it_is_there_when_it_is_no_longer_away(
            target in -3.0..3.0_f64, velocity in -1.0..1.0_f64, near in 1e-6..1e-2_f64, slow in 1e-4..1e-1_f64, after in 0.0..1.0_f64,
        ) {
            let mut axis = moving(0.0, velocity);
            axis.retarget(target);
            axis.advance(after);
            let Some(away) = axis.away_for(near, slow) else { return Ok(()) };
            let is_there = |seconds: f64| {
                let mut axis = axis;
                axis.advance(seconds);
                (axis.position() - target).abs() <= near && axis.velocity().abs() < slow
            };
            for part in [0.0, 0.3, 0.7, 0.99, 1.0] {
                let at = part * away - 1e-7;
                prop_assert!(at < 0.0 || !is_there(at), "{part} of {away}");
            }
            prop_assert!(is_there(away.max(0.0) + 1e-7));
        }

        #[test]
        fn splitting_a_span_changes_nothing(
            target in -3.0..3.0_f64, velocity in -1.0..1.0_f64, span in 0.0..5.0_f64, cuts in 1..50_u32,
        ) {
            let mut whole = moving(0.0, velocity);
            whole.retarget(target);
            let mut split = whole;
            whole.advance(span);
            for _ in 0..cuts {
                split.advance(span / f64::from(cuts));
            }
            prop_assert!((whole.position() - split.position()).abs() < 1e-9);
            prop_assert!((whole.velocity() - split.velocity()).abs() < 1e-8);
        }
    }
}
