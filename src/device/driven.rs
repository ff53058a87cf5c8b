//! A ramped drive with what stands in its signal path: what conveyors and motors are moved by.

use super::law::drive::{Drive, DriveSettings};
use super::law::sum::Sum;
use super::path::{Bounds, Moment, Motion, Stages};

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
    /// How far what the load carries has moved, m or rad.
    carried: f64,
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
            carried: 0.0,
        }
    }

    /// From now on it is `enabled` or not, and has to run at `reference`.
    pub fn command(&mut self, enabled: bool, reference: f64) {
        self.enabled = enabled;
        if self.stages.is_nominal() {
            self.reference = reference;
            self.drive.command(enabled, reference);
        } else {
            // A drive that is still on though told to be off goes on as it went.
            self.reference = if enabled { reference } else { self.reference };
            self.pass(self.stages.moment());
        }
    }

    /// See [`Device::rests`](super::Device::rests).
    pub fn rests(&self) -> bool {
        self.stages.is_nominal() && self.drive.rests()
    }

    /// For how long at least it stays ready or not, and moving or not, up to a speed of `standstill`; s. Behind a stage nobody knows.
    pub fn unchanged_for(&self, standstill: f64) -> f64 {
        if self.stages.is_nominal() { self.drive.unchanged_for(standstill) } else { 0.0 }
    }

    /// Whether it is enabled and ready. What switches late behind it, it does not know.
    pub fn ready(&self) -> bool {
        let follows_at_once = !self.stages.is_nominal() && self.settings.ready_delay == 0.0;
        if follows_at_once { self.enabled } else { self.enabled && self.drive.ready() }
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

    /// How far what the load carries has moved since the start.
    pub fn carried(&self) -> f64 {
        if self.stages.is_nominal() { self.travel.value() } else { self.carried }
    }

    /// So many parts stand on what it moves, so many of them held back.
    pub fn loaded(&mut self, parts: u32, queued: u32) {
        if self.stages.loaded(f64::from(parts), f64::from(queued)) {
            self.pass(self.stages.moment());
        }
    }

    /// So many others on its supply move.
    pub fn shared(&mut self, others: u32) {
        if self.stages.shared(f64::from(others)) {
            self.pass(self.stages.moment());
        }
    }

    /// Moves by `seconds` and returns the way gone by what the load carries: nominally that of the load's side.
    pub fn advance(&mut self, seconds: f64) -> f64 {
        if self.stages.is_nominal() {
            let way = self.drive.advance(seconds);
            self.travel.add(way);
            return way;
        }
        let start = self.carried;
        let mut rest = seconds;
        while let Some(moment) = self.stages.stretch(&mut rest, self.drive.steady()) {
            self.travel.add(self.drive.advance(moment.span));
            let law = Motion { position: self.travel.value(), velocity: self.drive.velocity() };
            self.motor = self.stages.actuator.motion(law, moment);
            let before = self.load;
            self.load = self.stages.transmission.motion(self.motor, moment);
            let way = self.load.position - before.position;
            self.carried += self.stages.process.carried(way);
            self.pass(moment);
        }
        self.carried - start
    }

    /// Lets the command pass the actuator's stages and gives the drive what comes out.
    fn pass(&mut self, moment: Moment) {
        let Driven { settings, drive, enabled, reference, stages, motor, .. } = self;
        let on = stages.actuator.switched(*enabled, moment);
        let coasting = settings.coasting.filter(|_| !on);
        let bounds = Bounds {
            velocity: f64::INFINITY,
            acceleration: settings.slopes.rising,
            deceleration: coasting.unwrap_or(settings.slopes.falling),
            force: f64::INFINITY,
        };
        let bounds = stages.actuator.bounds(bounds, *motor, moment);
        let reference = stages.actuator.reference(*reference, *motor, moment);
        match coasting {
            Some(_) => drive.coast(bounds.deceleration),
            None => drive.limit(bounds.acceleration, bounds.deceleration),
        }
        drive.command(on, reference.clamp(-bounds.velocity, bounds.velocity));
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.drive.state(visit);
        self.travel.state(visit);
        self.stages.state(visit);
        if !self.stages.is_nominal() {
            visit(self.carried);
        }
    }
}
