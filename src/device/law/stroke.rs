//! A motion at constant speed between two end stops, as of a cylinder with throttles.

use super::{SAME_INSTANT_S, SAME_VALUE};

/// Which way it is driven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Drive {
    #[default]
    Hold,
    Extend,
    Retract,
}

/// What is set about it: m and m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeSettings {
    /// Way between the end stops.
    pub length: f64,
    pub extend_speed: f64,
    pub retract_speed: f64,
    /// How far from an end its switch is still true.
    pub limit_tolerance: f64,
}

/// A cylinder, retracted to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    settings: StrokeSettings,
    position: f64,
}

impl Stroke {
    /// A retracted cylinder.
    pub fn new(settings: StrokeSettings) -> Stroke {
        Stroke { settings, position: 0.0 }
    }

    /// From now on it moves at these speeds.
    pub fn limit(&mut self, extend_speed: f64, retract_speed: f64) {
        self.settings.extend_speed = extend_speed;
        self.settings.retract_speed = retract_speed;
    }

    /// From 0, retracted, to the stroke's length.
    pub fn position(&self) -> f64 {
        self.position
    }

    /// The speed it moves with now if driven so: there is no ramp, and none at the end stop.
    pub fn velocity(&self, drive: Drive) -> f64 {
        match drive {
            Drive::Extend if self.position < self.settings.length => self.settings.extend_speed,
            Drive::Retract if self.position > 0.0 => -self.settings.retract_speed,
            _ => 0.0,
        }
    }

    /// Moves by `seconds`, driven so all along, and returns the way gone.
    pub fn advance(&mut self, drive: Drive, seconds: f64) -> f64 {
        let start = self.position;
        let (end, speed) = match drive {
            Drive::Hold => return 0.0,
            Drive::Extend => (self.settings.length, self.settings.extend_speed),
            Drive::Retract => (0.0, self.settings.retract_speed),
        };
        let needed = (end - start).abs() / speed;
        self.position =
            if needed <= seconds + SAME_INSTANT_S { end } else { start + speed.copysign(end - start) * seconds };
        self.position - start
    }

    /// For how long from now on it keeps its speed if it is driven so: until it is at its end stop, s.
    pub fn steady(&self, drive: Drive) -> f64 {
        match drive {
            Drive::Hold => f64::INFINITY,
            Drive::Extend => (self.settings.length - self.position) / self.settings.extend_speed,
            Drive::Retract => self.position / self.settings.retract_speed,
        }
    }

    /// Moves by `way`, no further than to an end stop, and returns the way gone: what carries it on when nothing drives it.
    pub fn drift(&mut self, way: f64) -> f64 {
        let start = self.position;
        self.position = (start + way).clamp(0.0, self.settings.length);
        self.position - start
    }

    /// Whether it is within the tolerance of the extended end, the tolerance included.
    pub fn at_extended(&self) -> bool {
        self.position >= self.settings.length - self.settings.limit_tolerance - SAME_VALUE
    }

    /// Whether it is within the tolerance of the retracted end, the tolerance included.
    pub fn at_retracted(&self) -> bool {
        self.position <= self.settings.limit_tolerance + SAME_VALUE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETTINGS: StrokeSettings =
        StrokeSettings { length: 0.5, extend_speed: 0.5, retract_speed: 0.25, limit_tolerance: 0.002 };

    fn check(stroke: &Stroke, position: f64) {
        assert!((stroke.position() - position).abs() < 1e-12, "{} instead of {position}", stroke.position());
    }

    #[test]
    fn each_way_has_its_speed_and_holding_none() {
        let mut stroke = Stroke::new(SETTINGS);
        assert!((stroke.advance(Drive::Extend, 0.4) - 0.2).abs() < 1e-12);
        check(&stroke, 0.2);
        assert_eq!(stroke.advance(Drive::Hold, 1.0), 0.0);
        assert!((stroke.advance(Drive::Retract, 0.4) + 0.1).abs() < 1e-12);
        check(&stroke, 0.1);
        assert_eq!([Drive::Extend, Drive::Retract, Drive::Hold].map(|drive| stroke.velocity(drive)), [0.5, -0.25, 0.0]);
    }

    #[test]
    fn it_stands_at_the_end_stops_in_the_middle_of_a_span() {
        let mut stroke = Stroke::new(SETTINGS);
        assert_eq!(stroke.velocity(Drive::Retract), 0.0);
        assert_eq!(stroke.advance(Drive::Extend, 5.0), 0.5);
        assert_eq!((stroke.position(), stroke.velocity(Drive::Extend)), (0.5, 0.0));
        assert_eq!(stroke.advance(Drive::Retract, 5.0), -0.5);
        assert_eq!((stroke.position(), stroke.velocity(Drive::Retract)), (0.0, 0.0));
    }

    #[test]
    fn limits_are_inclusive_whatever_the_step() {
        let mut stroke = Stroke::new(SETTINGS);
        for step in 0..996 {
            assert_eq!((stroke.at_retracted(), stroke.at_extended()), (step <= 4, false), "step {step}");
            stroke.advance(Drive::Extend, 0.001);
        }
        assert!(stroke.at_extended(), "{}", stroke.position());
        for _ in 996..1000 {
            assert_eq!(stroke.velocity(Drive::Extend), 0.5);
            stroke.advance(Drive::Extend, 0.001);
        }
        assert_eq!(stroke.velocity(Drive::Extend), 0.0);
    }
}
