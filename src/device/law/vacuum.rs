//! Vacuum at suction cups: it builds up, is released, is blown off.
//!
//! Blowing wins over suction: the vacuum is lost at once, and building up starts anew when blowing ends. Suction that
//! returns before the release has ended never loses the vacuum; suction shorter than the build-up gives none. Cups that
//! are no longer sealed lose it at once. A command at the very instant at which a time ends comes first: suction that
//! returns then keeps the vacuum, suction that goes then has given none.

use super::SAME_INSTANT_S;

/// Cups, without vacuum to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vacuum {
    /// From suction on sealed cups to vacuum, s.
    build_up_time: f64,
    /// From suction off to the loss of the vacuum, s.
    release_time: f64,
    /// From vacuum to its loss by a leak, though suction is on, s; infinite where nothing leaks.
    hold_time: f64,
    suction: bool,
    blow: bool,
    sealed: bool,
    /// Whether vacuum held when suction, blowing or seal last changed, or when time last began to pass.
    held: bool,
    /// How long suction, blowing and seal have been what they are now, as far as it matters, s.
    elapsed: f64,
}

impl Vacuum {
    /// Cups without vacuum, suction and blowing off, not sealed; times in seconds.
    pub fn new(build_up_time: f64, release_time: f64) -> Vacuum {
        Vacuum {
            build_up_time,
            release_time,
            hold_time: f64::INFINITY,
            suction: false,
            blow: false,
            sealed: false,
            held: false,
            elapsed: 0.0,
        }
    }

    /// From now on building up and release take these times, and vacuum leaks away after `hold_time` under suction; s.
    pub fn limit(&mut self, build_up_time: f64, release_time: f64, hold_time: f64) {
        self.build_up_time = build_up_time;
        self.release_time = release_time;
        self.hold_time = hold_time;
    }

    /// Suction and blowing from now on.
    pub fn command(&mut self, suction: bool, blow: bool) {
        if (suction, blow) != (self.suction, self.blow) {
            self.held = self.held_before();
            self.suction = suction;
            self.blow = blow;
            self.elapsed = 0.0;
        }
    }

    /// Whether the cups are sealed from now on.
    pub fn seal(&mut self, sealed: bool) {
        if sealed != self.sealed {
            self.held = self.held_before();
            self.sealed = sealed;
            self.elapsed = 0.0;
        }
    }

    /// Whether vacuum holds now, what ends at this instant included.
    pub fn holds(&self) -> bool {
        self.held_after(self.elapsed + SAME_INSTANT_S)
    }

    /// Whether it held until now, what ends at this instant not included.
    fn held_before(&self) -> bool {
        self.held_after(self.elapsed - SAME_INSTANT_S)
    }

    /// Whether it holds `elapsed` seconds after the last change.
    fn held_after(&self, elapsed: f64) -> bool {
        if self.blow || !self.sealed {
            return false;
        }
        match (self.held, self.suction) {
            (true, true) => elapsed < self.build_up_time + self.hold_time,
            (true, false) => elapsed < self.release_time,
            (false, true) => (self.build_up_time..self.build_up_time + self.hold_time).contains(&elapsed),
            (false, false) => false,
        }
    }

    /// Whether it stays as it is, however long that lasts, until suction, blowing or seal change.
    pub fn rests(&self) -> bool {
        let is_settled = self.held == self.suction && self.hold_time.is_infinite();
        self.held == self.holds() && (self.blow || !self.sealed || is_settled)
    }

    /// For how long at least vacuum holds or does not, as it does now, if nothing is switched and the seal stays, s.
    pub fn unchanged_for(&self) -> f64 {
        let ends = [self.build_up_time, self.build_up_time + self.hold_time, self.release_time];
        let ahead = ends.map(|end| end - self.elapsed + 2.0 * SAME_INSTANT_S).into_iter().filter(|ahead| *ahead >= 0.0);
        (ahead.fold(f64::INFINITY, f64::min) - 4.0 * SAME_INSTANT_S).max(0.0)
    }

    /// Moves by `seconds`.
    pub fn advance(&mut self, seconds: f64) {
        if seconds > 0.0 {
            self.held = self.holds();
            self.elapsed += seconds;
        }
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        for flag in [self.suction, self.blow, self.sealed, self.held] {
            visit(f64::from(u8::from(flag)));
        }
        visit(self.elapsed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Commands (time, suction, blow) in ms on sealed cups, and the times at which the vacuum is seen to change, found
    /// with steps of 1 ms; build-up takes 150 ms, release 80 ms.
    fn check(commands: &[(u32, bool, bool)], changes: &[(u32, bool)]) {
        let mut cups = Vacuum::new(0.15, 0.08);
        cups.seal(true);
        let mut seen = Vec::new();
        let mut last = false;
        for time in 0..2000 {
            for &(_, suction, blow) in commands.iter().filter(|command| command.0 == time) {
                cups.command(suction, blow);
            }
            if cups.holds() != last {
                last = !last;
                seen.push((time, last));
            }
            cups.advance(0.001);
        }
        assert_eq!(seen, changes, "{commands:?}");
    }

    #[test]
    fn vacuum_builds_up_and_is_released() {
        check(&[(100, true, false)], &[(250, true)]);
        check(&[(100, true, false), (400, false, false)], &[(250, true), (480, false)]);
    }

    #[test]
    fn blowing_takes_it_at_once_and_wins_over_suction() {
        check(&[(100, true, false), (400, true, true)], &[(250, true), (400, false)]);
        check(&[(100, true, true)], &[]);
        check(&[(100, true, false), (400, false, false), (450, false, true)], &[(250, true), (450, false)]);
    }

    #[test]
    fn building_up_starts_anew_when_blowing_ends() {
        check(&[(100, true, false), (200, true, true), (220, true, false)], &[(370, true)]);
    }

    #[test]
    fn suction_that_returns_in_time_never_loses_the_vacuum() {
        check(&[(100, true, false), (400, false, false), (480, true, false)], &[(250, true)]);
        check(
            &[(100, true, false), (400, false, false), (481, true, false)],
            &[(250, true), (480, false), (631, true)],
        );
    }

    #[test]
    fn a_pulse_too_short_gives_none() {
        check(&[(100, true, false), (250, false, false)], &[]);
        check(&[(100, true, false), (249, false, false), (260, true, false)], &[(410, true)]);
        check(&[(100, true, false), (251, false, false)], &[(250, true), (331, false)]);
    }

    #[test]
    fn the_same_command_again_starts_nothing_anew() {
        check(&[(100, true, false), (200, true, false)], &[(250, true)]);
    }

    #[test]
    fn without_a_seal_there_is_none() {
        let mut cups = Vacuum::new(0.15, 0.08);
        cups.command(true, false);
        cups.advance(10.0);
        assert!(!cups.holds());
        cups.seal(true);
        assert!(!cups.holds());
        cups.advance(0.15);
        assert!(cups.holds());
        cups.seal(false);
        assert!(!cups.holds());
    }

    #[test]
    fn no_time_means_at_once() {
        let mut cups = Vacuum::new(0.0, 0.0);
        cups.seal(true);
        cups.command(true, false);
        assert!(cups.holds());
        cups.advance(1.0);
        cups.command(false, false);
        assert!(!cups.holds());
    }

    #[test]
    fn one_long_span_holds_all_that_happens_in_it() {
        let mut cups = Vacuum::new(0.15, 0.08);
        cups.seal(true);
        cups.command(true, false);
        cups.advance(100.0);
        assert!(cups.holds());
        cups.command(false, false);
        cups.advance(100.0);
        assert!(!cups.holds());
        cups.advance(100.0);
        assert!(!cups.holds());
    }
}
