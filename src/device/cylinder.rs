//! A cylinder with what stands in its signal path.

use super::law::SAME_VALUE;
use super::law::stroke::{Drive, Stroke, StrokeSettings};
use super::path::{Bounds, Moment, Motion, Stages};

/// A cylinder, its piston and its rod. They part only where a stage of the transmission says so.
#[derive(Clone, Debug)]
pub(super) struct Cylinder {
    settings: StrokeSettings,
    stroke: Stroke,
    drive: Drive,
    /// What its valve does, after the actuator's stages.
    valve: Drive,
    pub stages: Stages,
    piston: Motion,
    rod: Motion,
}

impl Cylinder {
    /// A retracted cylinder, held.
    pub fn new(settings: StrokeSettings) -> Cylinder {
        Cylinder {
            settings,
            stroke: Stroke::new(settings),
            drive: Drive::Hold,
            valve: Drive::Hold,
            stages: Stages::default(),
            piston: Motion::default(),
            rod: Motion::default(),
        }
    }

    /// From now on it is driven so.
    pub fn command(&mut self, drive: Drive) {
        let moment = self.stages.moment();
        if !self.stages.is_nominal() && self.drive != drive {
            // The other way has a coil of its own: the one lets go before the other draws.
            self.stages.actuator.switched(false, moment);
        }
        self.drive = drive;
        self.pass(moment);
    }

    /// Lets the command pass the actuator's stages and sets valve and throttles to what comes out.
    fn pass(&mut self, moment: Moment) {
        let Cylinder { settings, stroke, drive, valve, stages, piston, .. } = self;
        if stages.is_nominal() {
            *valve = *drive;
            return;
        }
        let on = stages.actuator.switched(*drive != Drive::Hold, moment);
        *valve = match (on, *drive) {
            (false, _) => Drive::Hold,
            // Told to hold, but not yet off: it goes on as it went.
            (true, Drive::Hold) => *valve,
            (true, drive) => drive,
        };
        let bounds = Bounds {
            velocity: f64::INFINITY,
            acceleration: f64::INFINITY,
            deceleration: f64::INFINITY,
            force: f64::INFINITY,
        };
        let fastest = stages.actuator.bounds(bounds, *piston, moment).velocity;
        let mut speed = |nominal: f64| stages.actuator.reference(nominal, *piston, moment).abs().min(fastest);
        match valve {
            Drive::Hold => {}
            Drive::Extend => stroke.limit(speed(settings.extend_speed), settings.retract_speed),
            Drive::Retract => stroke.limit(settings.extend_speed, speed(-settings.retract_speed)),
        }
    }

    /// The rod's motion: what the plate does, and what the switches see.
    pub fn rod(&self) -> Motion {
        if self.stages.is_nominal() {
            Motion { position: self.stroke.position(), velocity: self.stroke.velocity(self.valve) }
        } else {
            self.rod
        }
    }

    /// Moves by `seconds` and returns the way gone by the rod.
    pub fn advance(&mut self, seconds: f64) -> f64 {
        if self.stages.is_nominal() {
            return self.stroke.advance(self.valve, seconds);
        }
        let start = self.rod.position;
        let mut stages = std::mem::take(&mut self.stages);
        stages.stretches(seconds, |stages, moment| {
            let way = self.stroke.advance(self.valve, moment.span);
            let law = Motion { position: self.stroke.position(), velocity: way / moment.span };
            self.piston = stages.actuator.motion(law, moment);
            self.rod = stages.transmission.motion(self.piston, moment);
            std::mem::swap(&mut self.stages, stages);
            self.pass(moment);
            std::mem::swap(&mut self.stages, stages);
        });
        self.stages = stages;
        self.rod.position - start
    }

    /// Whether the rod is within the tolerance of the extended end, the tolerance included.
    pub fn at_extended(&self) -> bool {
        self.rod().position >= self.settings.length - self.settings.limit_tolerance - SAME_VALUE
    }

    /// Whether it is within the tolerance of the retracted end, the tolerance included.
    pub fn at_retracted(&self) -> bool {
        self.rod().position <= self.settings.limit_tolerance + SAME_VALUE
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.stroke.position());
        visit(f64::from(self.valve as u8));
        self.stages.state(visit);
    }
}
