//! A drive that follows a speed on a ramp, as inverters do: enabling, the ramp, coasting.

use super::ramp::{Ramp, Slopes};
use super::{SAME_INSTANT_S, SAME_VALUE};

/// What is set about a drive; SI units, linear or rotary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveSettings {
    pub slopes: Slopes,
    /// With which slope it slows down while it is off; as the ramp falls, if `None`.
    pub coasting: Option<f64>,
    /// How long it takes from being enabled until it is ready and moves, s.
    pub ready_delay: f64,
}

/// A drive with the mass it moves, at rest and off to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    settings: DriveSettings,
    enabled: bool,
    /// The speed it is to run at while ready, its sign counts.
    reference: f64,
    /// How long it has been enabled, no longer than it takes to be ready.
    waited: f64,
    ramp: Ramp,
}

impl Drive {
    /// A drive at rest, off.
    pub fn new(settings: DriveSettings) -> Drive {
        Drive { settings, enabled: false, reference: 0.0, waited: 0.0, ramp: Ramp::default() }
    }

    /// From now on it is `enabled` or not, and has to run at `reference`.
    pub fn command(&mut self, enabled: bool, reference: f64) {
        if enabled != self.enabled {
            self.waited = 0.0;
        }
        self.enabled = enabled;
        self.reference = reference;
    }

    /// From now on its speed rises and falls with these slopes.
    pub fn limit(&mut self, rising: f64, falling: f64) {
        self.settings.slopes = Slopes { rising, falling };
    }

    /// From now on it slows down so while it is off, whatever its ramp.
    pub fn coast(&mut self, deceleration: f64) {
        self.settings.coasting = Some(deceleration);
    }

    /// For how long from now on its speed keeps its slope if no command comes, s.
    pub fn steady(&self) -> f64 {
        if self.ready() {
            return self.ramp.steady(self.reference, self.settings.slopes);
        }
        let slowing = self.ramp.steady(0.0, self.run_down_slopes());
        if self.enabled { slowing.min(self.settings.ready_delay - self.waited) } else { slowing }
    }

    /// Whether it is enabled and ready: at once without a delay.
    pub fn ready(&self) -> bool {
        self.enabled && self.waited >= self.settings.ready_delay - SAME_INSTANT_S
    }

    /// Whether it stands and will stand until a command comes.
    pub fn rests(&self) -> bool {
        let is_content = if self.ready() { self.reference == 0.0 } else { !self.enabled };
        self.ramp.velocity == 0.0 && is_content
    }

    /// For how long at least it stays ready or not, and moving or not, if no command comes; up to `standstill` it does not count as moving; s.
    pub fn unchanged_for(&self, standstill: f64) -> f64 {
        if self.enabled && !self.ready() {
            return 0.0;
        }
        let (target, slopes) =
            if self.ready() { (self.reference, self.settings.slopes) } else { (0.0, self.run_down_slopes()) };
        let (speed, surely) = (self.ramp.velocity, standstill + 2.0 * SAME_VALUE);
        if speed == target || (speed * target > 0.0 && speed.abs().min(target.abs()) > surely) {
            return f64::INFINITY;
        }
        ((speed.abs() - surely) / slopes.falling - SAME_INSTANT_S).max(0.0)
    }

    /// Present speed.
    pub fn velocity(&self) -> f64 {
        self.ramp.velocity
    }

    /// Moves by `seconds` and returns the way gone.
    pub fn advance(&mut self, seconds: f64) -> f64 {
        if self.ready() {
            return self.ramp.advance(self.reference, self.settings.slopes, seconds);
        }
        if !self.enabled {
            return self.run_down(seconds);
        }
        let wait = seconds.min(self.settings.ready_delay - self.waited);
        self.waited += wait;
        self.run_down(wait)
            + if seconds > wait { self.ramp.advance(self.reference, self.settings.slopes, seconds - wait) } else { 0.0 }
    }

    /// Slows down, as it does while it is not ready.
    fn run_down(&mut self, seconds: f64) -> f64 {
        self.ramp.advance(0.0, self.run_down_slopes(), seconds)
    }

    fn run_down_slopes(&self) -> Slopes {
        let falling = self.settings.coasting.unwrap_or(self.settings.slopes.falling);
        Slopes { falling, ..self.settings.slopes }
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(f64::from(u8::from(self.enabled)));
        visit(self.reference);
        visit(self.waited);
        visit(self.ramp.velocity);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETTINGS: DriveSettings =
        DriveSettings { slopes: Slopes { rising: 1.0, falling: 1.0 }, coasting: None, ready_delay: 0.0 };

    fn check(drive: &Drive, velocity: f64) {
        assert!((drive.velocity() - velocity).abs() < 1e-12, "{} instead of {velocity}", drive.velocity());
    }

    #[test]
    fn at_rest_and_off_until_told_otherwise() {
        let mut drive = Drive::new(SETTINGS);
        assert_eq!(drive.advance(10.0), 0.0);
        assert!(!drive.ready() && drive.velocity() == 0.0);
    }

    #[test]
    fn without_a_delay_it_is_ready_at_once() {
        let mut drive = Drive::new(SETTINGS);
        drive.command(true, 0.5);
        assert!(drive.ready());
        assert!((drive.advance(1.0) - 0.375).abs() < 1e-12);
        drive.command(false, 0.5);
        assert!(!drive.ready());
        assert!((drive.advance(1.0) - 0.125).abs() < 1e-12);
        check(&drive, 0.0);
    }

    #[test]
    fn coasting_replaces_the_ramp_only_while_it_is_off() {
        let mut drive = Drive::new(DriveSettings { coasting: Some(0.1), ..SETTINGS });
        drive.command(true, 0.5);
        drive.advance(1.0);
        drive.command(false, 0.0);
        drive.advance(1.0);
        check(&drive, 0.4);
        drive.command(true, 0.0);
        drive.advance(0.1);
        check(&drive, 0.3);
    }

    #[test]
    fn it_moves_when_it_is_ready_in_the_middle_of_a_span() {
        let mut drive = Drive::new(DriveSettings { ready_delay: 0.25, ..SETTINGS });
        drive.command(true, 1.0);
        assert!(!drive.ready());
        assert!((drive.advance(0.75) - 0.125).abs() < 1e-12);
        check(&drive, 0.5);
        // A change of the target is no new enabling.
        drive.command(true, -1.0);
        assert!(drive.ready());
        drive.command(false, -1.0);
        drive.command(true, 1.0);
        assert!(!drive.ready());
    }

    #[test]
    fn it_is_ready_on_the_step_of_its_delay() {
        let mut drive = Drive::new(DriveSettings { ready_delay: 0.3, ..SETTINGS });
        drive.command(true, 1.0);
        for step in 0..300 {
            assert!(!drive.ready(), "step {step}");
            drive.advance(0.001);
        }
        assert!(drive.ready());
        check(&drive, 0.0);
    }
}
