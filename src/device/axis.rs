//! One axis of a robot on its profile, with what stands in its signal path.

use super::law::profile::{Limits, Profile};
use super::law::{SAME_VALUE, STANDSTILL};
use super::path::{Bounds, Moment, Motion, Stages};

/// An axis, its motor's side and its load's side.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    limits: Limits,
    /// How far it may be from its target and have arrived, m or rad.
    tolerance: f64,
    profile: Profile,
    target: f64,
    pub stages: Stages,
    motor: Motion,
    load: Motion,
}

impl Axis {
    /// An axis at rest at 0.
    pub fn new(limits: Limits, tolerance: f64) -> Axis {
        Axis {
            limits,
            tolerance,
            profile: Profile::new(limits),
            target: 0.0,
            stages: Stages::default(),
            motor: Motion::default(),
            load: Motion::default(),
        }
    }

    /// Within its tolerance of where it was last told to go, the tolerance included, and slower than 1 mm/s or 1 mrad/s.
    pub fn arrived(&mut self) -> bool {
        let is_there = is_there(self.motor(), self.target, self.tolerance);
        let moment = self.stages.moment();
        self.stages.actuator.arrived(is_there, moment)
    }

    /// Where it is to go from now on.
    pub fn retarget(&mut self, target: f64) {
        self.target = target;
        if self.stages.is_nominal() {
            self.profile.retarget(target);
        } else {
            let moment = self.stages.moment();
            pass(&mut self.stages, &mut self.profile, self.limits, target, self.motor, moment);
        }
    }

    /// The motor's side: what the axis's own controller sees.
    pub fn motor(&self) -> Motion {
        if self.stages.is_nominal() {
            Motion { position: self.profile.position(), velocity: self.profile.velocity() }
        } else {
            self.motor
        }
    }

    /// The load's side: where the tool is.
    pub fn load(&self) -> Motion {
        if self.stages.is_nominal() { self.motor() } else { self.load }
    }

    /// Moves by `seconds`.
    pub fn advance(&mut self, seconds: f64) {
        if self.stages.is_nominal() {
            return self.profile.advance(seconds);
        }
        let Axis { limits, tolerance, profile, target, stages, motor, load } = self;
        stages.stretches(seconds, |stages, moment| {
            profile.advance(moment.span);
            let law = Motion { position: profile.position(), velocity: profile.velocity() };
            *motor = stages.actuator.motion(law, moment);
            *load = stages.transmission.motion(*motor, moment);
            // A stage that waits for the arrival sees it at the end of every stretch.
            stages.actuator.arrived(is_there(*motor, *target, *tolerance), moment);
            pass(stages, profile, *limits, *target, *motor, moment);
        });
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.profile.state(visit);
        self.stages.state(visit);
    }
}

fn is_there(motion: Motion, target: f64, tolerance: f64) -> bool {
    (motion.position - target).abs() <= tolerance + SAME_VALUE && motion.velocity.abs() < STANDSTILL
}

/// Lets the target pass the actuator's stages and gives the profile what comes out.
fn pass(stages: &mut Stages, profile: &mut Profile, limits: Limits, target: f64, motion: Motion, moment: Moment) {
    let Limits { velocity, acceleration } = limits;
    let bounds = Bounds { velocity, acceleration, deceleration: acceleration, force: f64::INFINITY };
    let bounds = stages.actuator.bounds(bounds, motion, moment);
    profile.limit(Limits { velocity: bounds.velocity, acceleration: bounds.acceleration.min(bounds.deceleration) });
    profile.retarget(stages.actuator.reference(target, motion, moment));
}
