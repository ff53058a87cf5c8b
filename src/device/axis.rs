//! One axis of a robot on its profile, with what stands in its signal path.

use super::law::profile::{Limits, Profile};
use super::law::{SAME_INSTANT_S, SAME_VALUE, STANDSTILL, moves};
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

/// How many of a robot's axes move.
pub(super) fn moving(axes: &[Axis]) -> u32 {
    axes.iter().map(|axis| u32::from(moves(axis.motor().velocity))).sum()
}

/// How long a robot reports the same, s: it has not arrived until its last axis has.
pub(super) fn unchanged_for(axes: &[Axis]) -> f64 {
    if axes.iter().all(Axis::rests) { f64::INFINITY } else { axes.iter().map(Axis::away_for).fold(0.0, f64::max) }
}

/// A robot's axes are on one supply with each other, and with so many others that move.
pub(super) fn share(axes: &mut [Axis], others: u32) {
    let all = others + moving(axes);
    for axis in axes {
        axis.shared(all - u32::from(moves(axis.motor().velocity)));
    }
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

    /// An axis at rest at `position`.
    pub fn at(position: f64, limits: Limits, tolerance: f64) -> Axis {
        let at = Motion { position, velocity: 0.0 };
        let profile = Profile::at(limits, position);
        Axis { profile, target: position, motor: at, load: at, ..Axis::new(limits, tolerance) }
    }

    /// Within its tolerance of where it was last told to go, the tolerance included, and slower than 1 mm/s or 1 mrad/s.
    pub fn arrived(&mut self) -> bool {
        let is_there = self.is_there(self.motor());
        let moment = self.stages.moment();
        self.stages.actuator.arrived(is_there, moment)
    }

    /// Where it is to go from now on.
    pub fn retarget(&mut self, target: f64) {
        self.target = target;
        if self.stages.is_nominal() {
            self.profile.retarget(target);
        } else {
            self.pass(self.stages.moment());
        }
    }

    /// The motor's side: what the axis's own controller sees.
    pub fn motor(&self) -> Motion {
        if self.stages.is_nominal() { self.profile.motion() } else { self.motor }
    }

    /// The load's side: where the tool is.
    pub fn load(&self) -> Motion {
        if self.stages.is_nominal() { self.motor() } else { self.load }
    }

    /// See [`Device::rests`](super::Device::rests).
    pub fn rests(&self) -> bool {
        self.stages.is_nominal() && self.profile.has_ended()
    }

    /// For how long at least it is away from its target, s. Behind a stage nobody knows.
    pub fn away_for(&self) -> f64 {
        if !self.stages.is_nominal() {
            return 0.0;
        }
        let near = self.tolerance + 2.0 * SAME_VALUE;
        let away = self.profile.away_for(near, STANDSTILL + SAME_VALUE).unwrap_or_else(|| {
            let away = (self.profile.position() - self.target).abs() - near;
            away / self.limits.velocity
        });
        (away - SAME_INSTANT_S).max(0.0)
    }

    /// It holds so many parts.
    pub fn loaded(&mut self, parts: u32) {
        if self.stages.loaded(f64::from(parts), 0.0) {
            self.pass(self.stages.moment());
        }
    }

    /// So many others on its supply move.
    pub fn shared(&mut self, others: u32) {
        if self.stages.shared(f64::from(others)) {
            self.pass(self.stages.moment());
        }
    }

    /// Moves by `seconds`.
    pub fn advance(&mut self, seconds: f64) {
        if self.stages.is_nominal() {
            return self.profile.advance(seconds);
        }
        let mut rest = seconds;
        while let Some(moment) = self.stages.stretch(&mut rest, self.profile.steady()) {
            let start = self.profile;
            let was_there = self.is_there(self.motor);
            self.profile.advance(moment.span);
            let law = self.profile.motion();
            self.motor = self.stages.actuator.motion(law, moment);
            self.load = self.stages.transmission.motion(self.motor, moment);
            // A stage that waits for the arrival sees it at its instant.
            let is_there = self.is_there(self.motor);
            if is_there && !was_there && self.motor == law {
                let now = moment.now - moment.span + self.arrival(start, moment.span);
                self.stages.actuator.arrived(true, Moment { now, span: 0.0 });
            }
            self.stages.actuator.arrived(is_there, moment);
            self.pass(moment);
        }
    }

    fn is_there(&self, motion: Motion) -> bool {
        (motion.position - self.target).abs() <= self.tolerance + SAME_VALUE && motion.velocity.abs() < STANDSTILL
    }

    /// When within `span` the profile that starts as `start` is there.
    fn arrival(&self, start: Profile, span: f64) -> f64 {
        let (mut before, mut after) = (0.0, span);
        while after - before > SAME_INSTANT_S {
            let middle = 0.5 * (before + after);
            let mut profile = start;
            profile.advance(middle);
            if self.is_there(profile.motion()) { after = middle } else { before = middle }
        }
        after
    }

    /// Lets the target pass the actuator's stages and gives the profile what comes out.
    fn pass(&mut self, moment: Moment) {
        let Axis { limits: Limits { velocity, acceleration }, profile, target, stages, motor, .. } = self;
        let (velocity, acceleration) = (*velocity, *acceleration);
        let bounds = Bounds { velocity, acceleration, deceleration: acceleration, force: f64::INFINITY };
        let bounds = stages.actuator.bounds(bounds, *motor, moment);
        let bounds = stages.load.bounds(bounds, *motor, moment);
        profile.limit(Limits { velocity: bounds.velocity, acceleration: bounds.acceleration.min(bounds.deceleration) });
        profile.retarget(stages.actuator.reference(*target, *motor, moment));
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.profile.state(visit);
        self.stages.state(visit);
    }
}
