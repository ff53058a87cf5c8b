//! A ramped drive with what stands in its signal path: what conveyors and motors are moved by.

use super::law::drive::{Drive, DriveSettings};
use super::law::sum::Sum;
use super::path::{Bounds, Motion, Stages};

/// A drive, its motor's side and its load's side. They part only where a stage of the transmission says so.
#[derive(Clone, Debug)]
pub(super) struct Driven {
    settings: DriveSettings,
    drive: Drive,
    enabled: bool,
    reference: f64,
    /// How far the drive's law has moved since the start, m or rad.
    travel: Sum,
    pub stages: Stages,
    motor: Motion,
    load: Motion,
}

impl Driven {
    /// A drive at rest, off.
    pub fn new(settings: DriveSettings) -> Driven {
        Driven {
            settings,
            drive: Drive::new(settings),
            enabled: false,
            reference: 0.0,
            travel: Sum::default(),
            stages: Stages::default(),
            motor: Motion::default(),
            load: Motion::default(),
        }
    }

    /// From now on it is `enabled` or not, and has to run at `reference`.
    pub fn command(&mut self, enabled: bool, reference: f64) {
        self.enabled = enabled;
        self.reference = reference;
        if self.stages.is_nominal() {
            self.drive.command(enabled, reference);
        } else {
            let moment = self.stages.moment();
            pass(&mut self.stages, &mut self.drive, self.settings, (enabled, reference), self.motor, moment);
        }
    }

    /// Whether it is enabled and ready.
    pub fn ready(&self) -> bool {
        self.drive.ready()
    }

    /// The speed its own sensor sees: the motor's side.
    pub fn velocity(&self) -> f64 {
        if self.stages.is_nominal() { self.drive.velocity() } else { self.motor.velocity }
    }

    /// The motion of the load's side, its position counted from the start.
    pub fn load(&self) -> Motion {
        if self.stages.is_nominal() {
            Motion { position: self.travel.value(), velocity: self.drive.velocity() }
        } else {
            self.load
        }
    }

    /// Moves by `seconds` and returns the way gone by the load's side.
    pub fn advance(&mut self, seconds: f64) -> f64 {
        if self.stages.is_nominal() {
            let way = self.drive.advance(seconds);
            self.travel.add(way);
            return way;
        }
        let start = self.load.position;
        let Driven { settings, drive, enabled, reference, travel, stages, motor, load } = self;
        stages.stretches(seconds, |stages, moment| {
            travel.add(drive.advance(moment.span));
            let law = Motion { position: travel.value(), velocity: drive.velocity() };
            *motor = stages.actuator.motion(law, moment);
            *load = stages.transmission.motion(*motor, moment);
            pass(stages, drive, *settings, (*enabled, *reference), *motor, moment);
        });
        self.load.position - start
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.drive.state(visit);
        self.travel.state(visit);
        self.stages.state(visit);
    }
}

/// Lets the command pass the actuator's stages and gives the drive what comes out.
fn pass(
    stages: &mut Stages,
    drive: &mut Drive,
    settings: DriveSettings,
    (enabled, reference): (bool, f64),
    motion: Motion,
    moment: super::path::Moment,
) {
    let on = stages.actuator.switched(enabled, moment);
    let bounds = Bounds {
        velocity: f64::INFINITY,
        acceleration: settings.slopes.rising,
        deceleration: settings.slopes.falling,
        force: f64::INFINITY,
    };
    let bounds = stages.actuator.bounds(bounds, motion, moment);
    let reference = stages.actuator.reference(reference, motion, moment);
    drive.limit(bounds.acceleration, bounds.deceleration);
    drive.command(on, reference.clamp(-bounds.velocity, bounds.velocity));
}
