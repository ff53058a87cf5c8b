//! A cylinder with what stands in its signal path.

use super::law::lagging::Lagging;
use super::law::stroke::{Drive, Stroke, StrokeSettings};
use super::law::{SAME_INSTANT_S, SAME_VALUE, STANDSTILL};
use super::path::{Bounds, Moment, Motion, STRETCH_S, Stages};

/// A cylinder, its piston and its rod. They part only where a stage of the transmission says so.
#[derive(Clone, Debug)]
pub(super) struct Cylinder {
    settings: StrokeSettings,
    stroke: Stroke,
    drive: Drive,
    /// The coil that draws, after the actuator's stages; one that is told to lets go before the other is seen to.
    coil: Drive,
    /// What its valve does.
    valve: Drive,
    pub stages: Stages,
    /// How steeply it slows down while it is held, m/s²: nominally it stands at once.
    coasting: f64,
    /// The speed that it is driven or carried on with, m/s.
    speed: f64,
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
            coil: Drive::Hold,
            valve: Drive::Hold,
            stages: Stages::default(),
            coasting: f64::INFINITY,
            speed: 0.0,
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
        let before = self.speed;
        let Cylinder { settings, stroke, drive, coil, valve, stages, piston, .. } = self;
        if stages.is_nominal() {
            *valve = *drive;
            return;
        }
        let turns_round = *drive != Drive::Hold && *coil != Drive::Hold && *drive != *coil;
        let both_draw = turns_round && stages.actuator.switched(false, moment);
        let on = both_draw || stages.actuator.switched(*drive != Drive::Hold, moment);
        *coil = match (on, *drive) {
            _ if both_draw => *coil,
            (false, _) => Drive::Hold,
            // Told to hold, but not yet off: it goes on as it went.
            (true, Drive::Hold) => *coil,
            (true, drive) => drive,
        };
        // Between two coils that both draw the springs of a valve keep it in its middle.
        *valve = if both_draw { Drive::Hold } else { *coil };
        let bounds = Bounds {
            velocity: f64::INFINITY,
            acceleration: f64::INFINITY,
            deceleration: f64::INFINITY,
            force: f64::INFINITY,
        };
        let bounds = stages.actuator.bounds(bounds, *piston, moment);
        let fastest = bounds.velocity;
        self.coasting = bounds.deceleration;
        let mut speed = |nominal: f64| stages.actuator.reference(nominal, *piston, moment).abs().min(fastest);
        match valve {
            Drive::Hold => {}
            Drive::Extend => stroke.limit(speed(settings.extend_speed), settings.retract_speed),
            Drive::Retract => stroke.limit(settings.extend_speed, speed(-settings.retract_speed)),
        }
        let lags = stages.actuator.lag() > 0.0;
        if !lags && (*valve != Drive::Hold || self.coasting.is_infinite()) {
            self.speed = stroke.velocity(*valve);
        }
        if self.speed != before {
            // There is no ramp: it moves from this very instant.
            self.follow(Moment { span: 0.0, ..moment });
        }
    }

    /// Lets piston and rod follow what the law has come to.
    fn follow(&mut self, moment: Moment) {
        let law = Motion { position: self.stroke.position(), velocity: self.speed };
        self.piston = self.stages.actuator.motion(law, moment);
        self.rod = self.stages.transmission.motion(self.piston, moment);
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
        let mut rest = seconds;
        while let Some(moment) = self.stages.stretch(&mut rest, self.steady()) {
            self.move_by(moment.span);
            self.follow(moment);
            self.pass(moment);
        }
        self.rod.position - start
    }

    /// Moves by `span`, driven by its valve, or carried on while it is held; no further than to where it comes to rest.
    fn move_by(&mut self, span: f64) {
        if let Some(lagging) = self.lagging() {
            let Motion { position, velocity } = lagging.after(span);
            self.stroke.drift(position - self.stroke.position());
            let end = if velocity > 0.0 { self.settings.length } else { 0.0 };
            let left = end - self.stroke.position();
            // What is all but at its end stop is there, and stands: to the last bit, or it would be asked to go on for ever.
            let is_there = velocity != 0.0 && left.abs() < SAME_VALUE;
            self.stroke.drift(if is_there { 2.0 * SAME_VALUE.copysign(velocity) } else { 0.0 });
            self.speed = if is_there || velocity.abs() < SAME_VALUE { 0.0 } else { velocity };
        } else if self.valve != Drive::Hold {
            self.stroke.advance(self.valve, span);
            self.speed = self.stroke.velocity(self.valve);
        } else if self.speed != 0.0 {
            let seconds = span.min(self.steady());
            let lost = self.coasting * seconds;
            let end = self.speed.signum() * (self.speed.abs() - lost).max(0.0);
            let way = 0.5 * (self.speed + end) * seconds;
            let is_stopped = (self.stroke.drift(way) - way).abs() > SAME_VALUE;
            self.speed = if is_stopped || end.abs() < SAME_VALUE { 0.0 } else { end };
        }
    }

    /// Its motion where its speed lags behind what its valve asks for; one that coasts while it is held does not.
    fn lagging(&self) -> Option<Lagging> {
        let time_constant = self.stages.actuator.lag();
        let lags = time_constant > 0.0 && (self.valve != Drive::Hold || self.coasting.is_infinite());
        let from = Motion { position: self.stroke.position(), velocity: self.speed };
        lags.then(|| Lagging { from, asked: self.stroke.velocity(self.valve), time_constant })
    }

    /// For how long it goes on as it does, s.
    fn steady(&self) -> f64 {
        let StrokeSettings { length, limit_tolerance, .. } = self.settings;
        let (steady, speed_changes) = match (self.lagging(), self.valve) {
            (Some(lagging), _) => {
                (lagging.next(&[0.0, limit_tolerance, length - limit_tolerance, length]), lagging.is_under_way())
            }
            (None, Drive::Hold) if self.speed != 0.0 => (self.speed.abs() / self.coasting, true),
            (None, valve) => (self.stroke.steady(valve), false),
        };
        // Other stages foresee their changes by the speed of now.
        if speed_changes && self.stages.count() > 1 { steady.min(STRETCH_S) } else { steady }
    }

    /// See [`Device::rests`](super::Device::rests).
    pub fn rests(&self) -> bool {
        let is_held = self.valve == Drive::Hold || self.stroke.steady(self.valve) <= 0.0;
        self.stages.is_nominal() && is_held
    }

    /// For how long at least its rod stays within the tolerance of an end or not, and moving or not, s. Behind a stage that does not bear any
    /// stretch nobody knows, nor behind one of an uneven transmission, nor behind two while its speed changes.
    pub fn unchanged_for(&self) -> f64 {
        let stays = self.stages.unchanged_for();
        let is_at_rest = match self.valve {
            Drive::Hold => self.speed == 0.0,
            valve => self.stroke.steady(valve) <= 0.0,
        };
        if is_at_rest || stays <= 0.0 {
            return stays;
        }
        if !self.stages.transmission.is_even() {
            return 0.0;
        }
        let StrokeSettings { length, limit_tolerance, .. } = self.settings;
        let places = [0.0, limit_tolerance, length - limit_tolerance, length];
        let next = match self.lagging().filter(Lagging::is_under_way) {
            Some(_) if self.stages.count() > 1 => return 0.0,
            Some(lagging) => {
                let [before, behind] = [-1.0, 1.0].map(|side| places.map(|place| place + side * 4.0 * SAME_VALUE));
                lagging.next(&before).min(lagging.next(&behind)).min(lagging.passes(STANDSTILL, 4.0 * SAME_VALUE))
            }
            None if self.valve == Drive::Hold => return 0.0,
            None => {
                let Motion { position, velocity } = self.rod();
                let ahead = places.map(|place| velocity.signum() * (place - position) + 2.0 * SAME_VALUE);
                let next = ahead.into_iter().filter(|ahead| *ahead >= 0.0).fold(f64::INFINITY, f64::min);
                // A rod that stands in its gap passes nothing.
                let passes = if velocity == 0.0 { f64::INFINITY } else { (next - 4.0 * SAME_VALUE) / velocity.abs() };
                passes.min(self.stroke.steady(self.valve))
            }
        };
        // Stages take what is all but there for there.
        let soon = 2.0 * (SAME_VALUE / self.rod().velocity.abs().max(self.speed.abs())).min(STRETCH_S);
        (stays - soon).min(next - 2.0 * SAME_INSTANT_S).max(0.0)
    }

    /// It pushes so many parts.
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

    /// Whether the rod is within the tolerance of the extended end, the tolerance included.
    pub fn at_extended(&self) -> bool {
        self.rod().position >= self.settings.length - self.settings.limit_tolerance - SAME_VALUE
    }

    /// Whether it is within the tolerance of the retracted end, the tolerance included.
    pub fn at_retracted(&self) -> bool {
        self.rod().position <= self.settings.limit_tolerance + SAME_VALUE
    }

    /// Where the rod is, m, held to where another's switches allow it to be; `None` where a switch has said nothing. Switches that
    /// contradict one another bind nothing.
    pub fn between(&self, extended: Option<bool>, retracted: Option<bool>) -> f64 {
        let (own, tolerance, end) = (self.rod().position, self.settings.limit_tolerance, self.settings.length);
        let [mut low, mut high] = [own.min(0.0), own.max(end)];
        match retracted {
            Some(true) => high = tolerance,
            Some(false) => low = tolerance,
            None => {}
        }
        match extended {
            Some(true) => low = end - tolerance,
            Some(false) => high = high.min(end - tolerance),
            None => {}
        }
        if low <= high { own.clamp(low, high) } else { own }
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.stroke.position());
        visit(f64::from(self.valve as u8));
        if !self.stages.is_nominal() {
            visit(self.speed);
            visit(f64::from(self.coil as u8));
        }
        self.stages.state(visit);
    }
}
