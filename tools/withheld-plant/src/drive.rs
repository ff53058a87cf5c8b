//! A drive that ramps its speed: belts and motors.
//!
//! Its own form of what drives do: the ramp is cut where it reaches its target and each piece is solved in closed form; an
//! S-curve comes from a speed loop that knows how soon it must ease off, not from an average; a drive that follows late is a
//! speed loop in closed form over each piece.

use crate::quirk::Quirks;
use crate::switch::Delay;

/// Another value of the speed is none, m/s or rad/s.
const SAME: f64 = 1e-12;

/// What is left of a supply of which each of `others` leaves so much: nearly always all, and it is asked for at each step.
pub fn supplied(share: f64, others: usize) -> f64 {
    if share == 1.0 { 1.0 } else { share.powi(others as i32) }
}

/// A ramped drive and what is wrong with it.
#[derive(Clone, Debug)]
pub struct Drive {
    slope: f64,
    gain: f64,
    asymmetry: f64,
    fastest: f64,
    dead_band: f64,
    jerk: f64,
    coast: Option<f64>,
    lag: Follower,
    switch: Delay,
    /// Loses this share of its speed as it warms up, with this time constant.
    fade: Option<(f64, f64)>,
    heat: f64,
    /// Its speed swings by this share, so many times a second.
    beat: Option<(f64, f64)>,
    /// How long it rests before it turns round.
    changeover: f64,
    rests_until: f64,
    told: f64,
    is_on: bool,
    reference: f64,
    ramp: f64,
    acceleration: f64,
    speed: f64,
    clock: f64,
}

impl Drive {
    /// A drive with this slope of its speed.
    pub fn new(slope: f64, quirks: Quirks<'_>) -> Drive {
        let slope = slope.min(quirks.value("acceleration-limit", "limit").unwrap_or(f64::INFINITY));
        Drive {
            slope,
            gain: quirks.value("gain-error", "gain").unwrap_or(1.0),
            asymmetry: quirks.value("direction-asymmetry", "asymmetry").unwrap_or(0.0),
            fastest: quirks.value("velocity-limit", "limit").unwrap_or(f64::INFINITY),
            dead_band: quirks.value("dead-band", "width").unwrap_or(0.0),
            jerk: quirks.value("jerk-limit", "limit").unwrap_or(f64::INFINITY),
            coast: quirks.value("coasting", "deceleration"),
            lag: Follower::new(quirks),
            switch: Delay::of(quirks, "switch-on-delay", "switch-off-delay"),
            fade: quirks.get("x-fades-with-heat").map(|quirk| (quirk.value("share"), quirk.value("time"))),
            heat: 0.0,
            beat: quirks.get("x-beats-with-the-mains").map(|quirk| (quirk.value("share"), quirk.value("frequency"))),
            changeover: quirks.value("x-rests-before-it-turns", "time").unwrap_or(0.0),
            rests_until: 0.0,
            told: 0.0,
            is_on: false,
            reference: 0.0,
            ramp: 0.0,
            acceleration: 0.0,
            speed: 0.0,
            clock: 0.0,
        }
    }

    /// From `now` on it is switched on or off, and is to run at `reference`.
    pub fn command(&mut self, now: f64, on: bool, reference: f64) {
        if on {
            if reference * self.told < 0.0 {
                self.rests_until = now + self.changeover;
            }
            self.told = reference;
        }
        self.switch.set(now, on);
    }

    /// The speed of its shaft.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Moves on by `span` until `now`; `share` is what load and supply leave of its speed. Gives the way of its shaft.
    pub fn advance(&mut self, now: f64, span: f64, share: f64) -> f64 {
        self.clock = now;
        self.is_on = self.switch.at(now - span);
        self.reference = if self.is_on && now - span >= self.rests_until { self.asked(share) } else { 0.0 };
        let mut way = 0.0;
        let steps = self.steps(span);
        for _ in 0..steps {
            for (span, acceleration) in self.pieces(span / f64::from(steps)) {
                let from = self.ramp;
                self.ramp += acceleration * span;
                way += self.lag.advance(span, from, acceleration, &mut self.speed);
            }
        }
        if let Some((_, time)) = self.fade {
            let load = (self.speed / self.told.abs().max(SAME)).abs().min(1.0);
            self.heat += (load - self.heat) * (span / time);
        }
        way
    }

    fn asked(&self, share: f64) -> f64 {
        let band = if self.told.abs() <= 0.5 * self.dead_band { 0.0 } else { 1.0 };
        let side = if self.told < 0.0 { 1.0 - self.asymmetry } else { 1.0 };
        let fade = self.fade.map_or(1.0, |(share, _)| 1.0 - share * self.heat);
        let beat =
            self.beat.map_or(1.0, |(share, often)| 1.0 + share * (std::f64::consts::TAU * often * self.clock).sin());
        (self.told * self.gain * side * band * share * fade * beat).clamp(-self.fastest, self.fastest)
    }

    /// In how many steps `span` is taken: a ramp that eases in or out within less than a step of the plant's takes finer ones while it does.
    fn steps(&self, span: f64) -> u32 {
        let left = self.reference - self.ramp;
        let slope = if self.is_on { self.slope } else { self.coast.unwrap_or(self.slope) };
        let rests = left == 0.0 && self.acceleration == 0.0;
        let rises_on =
            self.acceleration == left.signum() * slope && 2.0 * self.jerk * (left.abs() - slope * span) > slope * slope;
        if !self.jerk.is_finite() || rests || rises_on {
            return 1;
        }
        (EASED_IN * span * self.jerk / slope).ceil().clamp(1.0, MOST_STEPS) as u32
    }

    /// The ramp over `span`, in pieces of constant acceleration.
    fn pieces(&mut self, span: f64) -> [(f64, f64); 2] {
        let slope = if self.is_on { self.slope } else { self.coast.unwrap_or(self.slope) };
        let left = self.reference - self.ramp;
        if self.jerk.is_finite() {
            // To come to rest at the target the acceleration must be gone by then: a²/2j is what it still adds.
            let wish = left.signum() * slope.min((2.0 * self.jerk * left.abs()).sqrt());
            let step = self.jerk * span;
            self.acceleration += (wish - self.acceleration).clamp(-step, step);
            let lands = left.abs() <= step * span && self.acceleration.abs() <= 2.0 * step;
            if lands {
                self.acceleration = 0.0;
                self.ramp = self.reference;
            }
            return [(span, self.acceleration), (0.0, 0.0)];
        }
        let until = left.abs() / slope;
        if until >= span {
            return [(span, slope * left.signum()), (0.0, 0.0)];
        }
        [(until, if until > 0.0 { left / until } else { 0.0 }), (span - until, 0.0)]
    }
}

/// In how many steps at least the acceleration of a limited jerk comes or goes, and the most of one of the plant's own.
const EASED_IN: f64 = 50.0;
const MOST_STEPS: f64 = 200.0;

/// How the shaft follows the ramp.
#[derive(Clone, Debug)]
enum Follower {
    AtOnce,
    /// A speed loop with this time constant.
    Lag(f64),
    /// A speed loop that rings: natural frequency and damping, and its acceleration.
    Ring(f64, f64, f64),
}

impl Follower {
    fn new(quirks: Quirks<'_>) -> Follower {
        if let Some(time) = quirks.value("first-order-lag", "time_constant") {
            return Follower::Lag(time);
        }
        match quirks.get("second-order-lag") {
            Some(quirk) => Follower::Ring(quirk.value("natural_frequency"), quirk.value("damping"), 0.0),
            None => Follower::AtOnce,
        }
    }

    /// Follows `from + acceleration·t` for `span`; gives the way.
    fn advance(&mut self, span: f64, from: f64, acceleration: f64, speed: &mut f64) -> f64 {
        match self {
            Follower::AtOnce => {
                *speed = from + acceleration * span;
                (from + 0.5 * acceleration * span) * span
            }
            Follower::Lag(time) => {
                let (behind, keep) = (acceleration * *time, (-span / *time).exp());
                let apart = *speed - from + behind;
                *speed = from + acceleration * span - behind + apart * keep;
                (from + 0.5 * acceleration * span - behind) * span + apart * *time * (1.0 - keep)
            }
            Follower::Ring(frequency, damping, slope) => {
                ring(*frequency, *damping, (from, acceleration), span, speed, slope)
            }
        }
    }
}

/// What swings after a line: x'' = w²·(from + slope·t − x) − 2·z·w·x' for `span`, in closed form, however fast it swings; gives ∫x dt.
pub fn ring(w: f64, z: f64, (from, slope): (f64, f64), span: f64, x: &mut f64, v: &mut f64) -> f64 {
    // It settles this far behind the line; what is apart from there swings and fades.
    let behind = 2.0 * z * slope / w;
    let (e0, s0) = (*x - from + behind, *v - slope);
    let (d, spread) = (z * w, 1.0 - z * z);
    let (e, s) = if spread.abs() < 1e-9 {
        let keep = (-d * span).exp();
        (keep * (e0 + (s0 + d * e0) * span), keep * (s0 - d * (s0 + d * e0) * span))
    } else if spread > 0.0 {
        let often = w * spread.sqrt();
        let (keep, (sin, cos)) = ((-d * span).exp(), (often * span).sin_cos());
        (keep * (e0 * cos + (s0 + d * e0) / often * sin), keep * (s0 * cos - (w * w * e0 + d * s0) / often * sin))
    } else {
        let apart = w * (-spread).sqrt();
        // The slow one of two roots whose product is w², without a difference of nearly equal numbers.
        let fast = -d - apart;
        let slow = w * w / fast;
        let of_slow = (s0 - fast * e0) / (slow - fast);
        let (slowly, quickly) = (of_slow * (slow * span).exp(), (e0 - of_slow) * (fast * span).exp());
        (slowly + quickly, slow * slowly + fast * quickly)
    };
    (*x, *v) = (from + slope * span - behind + e, slope + s);
    // The swing's own equation says what its integral is.
    (from + 0.5 * slope * span - behind) * span - ((s - s0) + 2.0 * d * (e - e0)) / (w * w)
}

/// One step of x' = v, v' = f(t, x, v) (Kutta 1901).
pub fn rk4(t: f64, h: f64, x: &mut f64, v: &mut f64, f: &dyn Fn(f64, f64, f64) -> f64) {
    let (x0, v0) = (*x, *v);
    let a1 = f(t, x0, v0);
    let (x2, v2) = (x0 + 0.5 * h * v0, v0 + 0.5 * h * a1);
    let a2 = f(t + 0.5 * h, x2, v2);
    let (x3, v3) = (x0 + 0.5 * h * v2, v0 + 0.5 * h * a2);
    let a3 = f(t + 0.5 * h, x3, v3);
    let (x4, v4) = (x0 + h * v3, v0 + h * a3);
    let a4 = f(t + h, x4, v4);
    *x = x0 + h / 6.0 * (v0 + 2.0 * v2 + 2.0 * v3 + v4);
    *v = v0 + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::quirk;

    #[test]
    fn what_rings_goes_as_its_equation_says() {
        for z in [0.1, 1.0, 3.0] {
            let (w, line) = (40.0, (0.3, 2.0));
            let (mut x, mut v) = (0.5, -1.0);
            let way = ring(w, z, line, 0.1, &mut x, &mut v);
            let (mut y, mut u, mut sum) = (0.5, -1.0, 0.0);
            let pull = |t: f64, y: f64, u: f64| w * w * (line.0 + line.1 * t - y) - 2.0 * z * w * u;
            let h = 1e-5;
            for k in 0..10_000 {
                let before = y;
                rk4(f64::from(k) * h, h, &mut y, &mut u, &pull);
                sum += 0.5 * h * (before + y);
            }
            assert!(
                (x - y).abs() < 1e-9 && (v - u).abs() < 1e-7 && (way - sum).abs() < 1e-8,
                "{z}: {x} {y} {way} {sum}"
            );
        }
        // Far faster than it is looked at, it is where the line is.
        let (mut x, mut v) = (0.0, 0.0);
        ring(1e9, 0.5, (1.0, 2.0), 1e-4, &mut x, &mut v);
        assert!((x - 1.0002).abs() < 1e-7 && (v - 2.0).abs() < 1e-3);
    }

    /// Way and speed after `seconds` from rest towards `reference` with the slope 2.
    fn runs(quirks: &[crate::quirk::Quirk], reference: f64, seconds: f64) -> (f64, f64) {
        let mut drive = Drive::new(2.0, Quirks::of(quirks, "D"));
        drive.command(0.0, true, reference);
        let steps = (seconds * 1e4_f64).round() as usize;
        let way = (1..=steps).map(|k| drive.advance(k as f64 * 1e-4, 1e-4, 1.0)).sum();
        (way, drive.speed())
    }

    #[test]
    fn a_ramp_is_exact() {
        let (way, speed) = runs(&[], 1.0, 1.0);
        assert!((way - 0.75).abs() < 1e-9 && (speed - 1.0).abs() < 1e-12, "{way} {speed}");
    }

    #[test]
    fn a_lag_behind_a_ramp_is_its_time_constant_late() {
        let lag = [quirk("D", "first-order-lag", &[("time_constant", 0.05)])];
        // x = 2·(t²/2 − τ·t + τ²·(1 − e^(−t/τ))) while the ramp still rises.
        let exact = 2.0 * (0.08 - 0.05 * 0.4 + 0.0025 * (1.0 - (-8.0_f64).exp()));
        let (way, _) = runs(&lag, 1.0, 0.4);
        assert!((way - exact).abs() < 1e-9, "{way} {exact}");
    }

    #[test]
    fn a_ring_overshoots_by_what_its_damping_leaves() {
        let ring = [quirk("D", "second-order-lag", &[("natural_frequency", 40.0), ("damping", 0.5)])];
        let mut drive = Drive::new(1e6, Quirks::of(&ring, "D"));
        drive.command(0.0, true, 1.0);
        let top =
            (1..5000).map(|k| (drive.advance(f64::from(k) * 1e-4, 1e-4, 1.0), drive.speed()).1).fold(0.0, f64::max);
        let exact = 1.0 + (-std::f64::consts::PI * 0.5 / 0.75_f64.sqrt()).exp();
        assert!((top - exact).abs() < 1e-4, "{top} {exact}");
    }

    #[test]
    fn an_s_curve_takes_slope_over_jerk_longer() {
        let eased = [quirk("D", "jerk-limit", &[("limit", 20.0)])];
        let (way, speed) = runs(&eased, 1.0, 2.0);
        // 0.5 s of ramp and 0.1 s of easing, symmetrical about its middle.
        assert!((speed - 1.0).abs() < 1e-6 && (way - (2.0 - 0.3)).abs() < 1e-4, "{way} {speed}");
        // Eased in within less than one of its steps: half of that more than the ramp alone.
        let eased = [quirk("D", "jerk-limit", &[("limit", 4e4)])];
        let (way, _) = runs(&eased, 1.0, 2.0);
        assert!((way - (2.0 - 0.25 - 2.5e-5)).abs() < 1e-6, "{way}");
    }
}
