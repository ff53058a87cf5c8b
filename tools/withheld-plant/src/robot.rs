//! A robot of four axes that each run their own trapezoid, planned anew at every target.
//!
//! A plan is a list of pieces of constant acceleration from where the axis is to its target, found in closed form when the
//! target comes; an axis that is too fast for its target brakes, passes it and comes back.

use std::collections::VecDeque;

use crate::drive::ring;
use crate::plant::Device;
use crate::quirk::{Quirk, Quirks};
use crate::switch::Delay;
use crate::train::Train;

/// The axes' names.
pub const AXES: [&str; 4] = ["X", "Y", "Z", "R"];
/// An axis that is slower than this is at rest, m/s or rad/s.
const REST: f64 = 1e-3;

/// What a robot is built to.
#[derive(Clone, Debug)]
pub struct RobotParameters {
    pub fastest: [f64; 4],
    pub steepest: [f64; 4],
    pub tolerance: [f64; 4],
}

/// A robot.
#[derive(Clone, Debug)]
pub struct Robot {
    axes: [Axis; 4],
    /// When each axis counts as arrived.
    arrived: [Delay; 4],
    /// A share of X's way that Y makes as well.
    crosstalk: f64,
}

#[derive(Clone, Debug)]
struct Axis {
    fastest: f64,
    steepest: f64,
    tolerance: f64,
    backwards: f64,
    gain: f64,
    dead_band: f64,
    target: f64,
    told: f64,
    position: f64,
    speed: f64,
    plan: VecDeque<(f64, f64)>,
    follower: Follower,
    /// Where the drive is, and how fast, after all that makes it late.
    shaft: (f64, f64),
    train: Train,
}

impl Robot {
    /// A robot called `name`, at rest at 0.
    pub fn new(parameters: &RobotParameters, quirks: &[Quirk], name: &str) -> Robot {
        let all = Quirks::of(quirks, name);
        let axis = |at: usize| {
            let own = all.on(AXES[at]);
            let fastest = all.parameter(&format!("maxVelocity{}", AXES[at]), parameters.fastest[at]);
            let steepest = all.parameter(&format!("maxAcceleration{}", AXES[at]), parameters.steepest[at]);
            let steepest = steepest.min(own.value("acceleration-limit", "limit").unwrap_or(f64::INFINITY));
            Axis {
                fastest: fastest.min(own.value("velocity-limit", "limit").unwrap_or(f64::INFINITY)),
                steepest,
                tolerance: parameters.tolerance[at],
                backwards: 1.0 - own.value("direction-asymmetry", "asymmetry").unwrap_or(0.0),
                gain: own.value("gain-error", "gain").unwrap_or(1.0),
                dead_band: own.value("dead-band", "width").unwrap_or(0.0),
                target: 0.0,
                told: 0.0,
                position: 0.0,
                speed: 0.0,
                plan: VecDeque::new(),
                follower: Follower::new(own, steepest),
                shaft: (0.0, 0.0),
                train: Train::new(own),
            }
        };
        let arrived = AXES.map(|name| {
            let mut arrived = Delay::new(all.on(name).value("settling-time", "time").unwrap_or(0.0), 0.0);
            arrived.set(f64::NEG_INFINITY, true);
            arrived
        });
        Robot {
            axes: std::array::from_fn(axis),
            arrived,
            crosstalk: all.value("x-axes-are-not-square", "share").unwrap_or(0.0),
        }
    }
}

impl Device for Robot {
    fn command(&mut self, _now: f64, port: &str, value: f64) {
        if let Some(at) = AXES.iter().position(|axis| port.strip_suffix("Target") == Some(axis)) {
            self.axes[at].aim(value);
        }
    }

    fn advance(&mut self, now: f64, span: f64, _others: usize) {
        self.axes.iter_mut().for_each(|axis| axis.advance(span));
        self.arrived.iter_mut().zip(&self.axes).for_each(|(arrived, axis)| arrived.set(now, axis.has_arrived()));
    }

    fn read(&self, now: f64, values: &mut Vec<f64>) {
        let mut each = self.axes.iter().zip(&self.arrived);
        values.push(f64::from(each.all(|(axis, arrived)| axis.has_arrived() && arrived.at(now))));
        let [x, y, z, r] = [0, 1, 2, 3].map(|at| self.axes[at].train.load());
        values.extend([x, y + self.crosstalk * x, z, r]);
    }

    fn moving(&self) -> usize {
        self.axes.iter().filter(|axis| axis.speed.abs() > REST).count()
    }
}

impl Axis {
    fn aim(&mut self, target: f64) {
        if (target - self.told).abs() <= 0.5 * self.dead_band && self.dead_band > 0.0 {
            return;
        }
        self.told = target;
        self.target = target;
        let fastest = if target < self.position { self.fastest * self.backwards } else { self.fastest };
        self.plan = plan(self.position, self.speed, target, fastest, self.steepest).into();
    }

    fn advance(&mut self, span: f64) {
        if self.rests() {
            return;
        }
        let mut left = span;
        while left > 0.0 {
            let Some((piece, acceleration)) = self.plan.front_mut() else { break };
            let step = left.min(*piece);
            self.position += (self.speed + 0.5 * *acceleration * step) * step;
            self.speed += *acceleration * step;
            *piece -= step;
            left -= step;
            if *piece <= 1e-15 {
                self.plan.pop_front();
                if self.plan.is_empty() {
                    (self.position, self.speed) = (self.target, 0.0);
                }
            }
        }
        self.shaft = self.follower.follow(span, self.gain * self.position, self.gain * self.speed);
        self.train.advance(span, self.shaft.0, self.shaft.1);
    }

    /// Whether another step would change nothing: it has come to its target, and nothing follows it or stands between it and its load.
    fn rests(&self) -> bool {
        let at_once = matches!(self.follower, Follower::AtOnce);
        at_once && self.plan.is_empty() && self.shaft.1 == 0.0 && self.train.rests_at(self.shaft.0)
    }

    fn has_arrived(&self) -> bool {
        (self.shaft.0 - self.target).abs() <= self.tolerance && self.shaft.1.abs() < REST
    }
}

/// The pieces (s, m/s²) of the quickest way from `position` at `speed` to rest at `target`, never steeper than `steepest`.
///
/// What remains after braking at once has a sign; a trapezoid, or a triangle, goes that way. An axis that is above its
/// highest speed comes down to it first.
fn plan(position: f64, speed: f64, target: f64, fastest: f64, steepest: f64) -> Vec<(f64, f64)> {
    let stops_at = position + speed * speed.abs() / (2.0 * steepest);
    let side = if stops_at > target { -1.0 } else { 1.0 };
    // From here on as if it went forwards.
    let (way, from) = (side * (target - position), side * speed);
    let top = (steepest * way + 0.5 * from * from).max(0.0).sqrt().min(fastest);
    let (rise, fall) = ((top - from) / steepest, top / steepest);
    let gone = 0.5 * (from + top) * rise.abs() + 0.5 * top * fall;
    let cruise = if top > 0.0 { (way - gone).max(0.0) / top } else { 0.0 };
    vec![(rise.abs(), side * steepest * rise.signum()), (cruise, 0.0), (fall, -side * steepest)]
}

/// How the axis follows its plan.
#[derive(Clone, Debug)]
enum Follower {
    AtOnce,
    Lag {
        time: f64,
        from: f64,
        at: f64,
    },
    Ring {
        frequency: f64,
        damping: f64,
        from: f64,
        at: f64,
        speed: f64,
    },
    /// Setpoints that pass through a moving average: what motion controllers offer as a limit of the jerk.
    Smooth {
        window: f64,
        past: VecDeque<(f64, f64)>,
        clock: f64,
        sum: f64,
    },
}

impl Follower {
    fn new(quirks: Quirks<'_>, steepest: f64) -> Follower {
        if let Some(time) = quirks.value("first-order-lag", "time_constant") {
            return Follower::Lag { time, from: 0.0, at: 0.0 };
        }
        if let Some(quirk) = quirks.get("second-order-lag") {
            let (frequency, damping) = (quirk.value("natural_frequency"), quirk.value("damping"));
            return Follower::Ring { frequency, damping, from: 0.0, at: 0.0, speed: 0.0 };
        }
        match quirks.value("jerk-limit", "limit") {
            Some(limit) => {
                let past = VecDeque::from([(f64::NEG_INFINITY, 0.0)]);
                Follower::Smooth { window: steepest / limit, past, clock: 0.0, sum: 0.0 }
            }
            None => Follower::AtOnce,
        }
    }

    fn follow(&mut self, span: f64, to: f64, speed: f64) -> (f64, f64) {
        match self {
            Follower::AtOnce => (to, speed),
            Follower::Lag { time, from, at } => {
                if span > 0.0 {
                    let slope = (to - *from) / span;
                    let apart = *at - *from + slope * *time;
                    *at = to - slope * *time + apart * (-span / *time).exp();
                    *from = to;
                }
                (*at, (to - *at) / *time)
            }
            Follower::Ring { frequency, damping, from, at, speed } => {
                if span > 0.0 {
                    ring(*frequency, *damping, (*from, (to - *from) / span), span, at, speed);
                    *from = to;
                }
                (*at, *speed)
            }
            Follower::Smooth { window, past, clock, sum } => {
                let last = past.back().map_or(0.0, |(_, value)| *value);
                *clock += span;
                // Each entry holds from the one before it until its own instant, at the mean of its ends.
                *sum += span * 0.5 * (last + to);
                past.push_back((*clock, to));
                let mut value = *sum / *window;
                let mut older = past.front().copied().unwrap_or_default();
                while let Some(&(at, there)) = past.get(1)
                    && at <= *clock - *window
                {
                    let begun = if older.0.is_finite() { older.0 } else { at };
                    *sum -= (at - begun) * 0.5 * (older.1 + there);
                    past.pop_front();
                    older = (at, there);
                    value = *sum / *window;
                }
                // The oldest entry still counted reaches a little beyond the window.
                if older.0.is_finite() {
                    value -= (*clock - *window - older.0).max(0.0) * older.1 / *window;
                }
                let then = older.1;
                (value, (to - then) / *window)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::axis_quirk;

    fn parameters() -> RobotParameters {
        RobotParameters { fastest: [1.0, 1.0, 1.0, 2.0], steepest: [2.0, 2.0, 2.0, 8.0], tolerance: [5e-4; 4] }
    }

    /// X after these seconds, having been sent to each target at its instant.
    fn x(quirks: &[Quirk], targets: &[(f64, f64)], seconds: f64) -> f64 {
        let mut robot = Robot::new(&parameters(), quirks, "R");
        let mut values = Vec::new();
        for k in 0..(seconds * 1e4_f64).round() as usize {
            let now = k as f64 * 1e-4;
            for (_, target) in targets.iter().filter(|(at, _)| (at - now).abs() < 5e-5) {
                robot.command(now, "XTarget", *target);
            }
            robot.advance(now + 1e-4, 1e-4, 0);
        }
        robot.read(seconds, &mut values);
        values[1]
    }

    #[test]
    fn a_trapezoid_and_a_triangle() {
        let check = |target: f64, seconds: f64, there: f64| {
            let found = x(&[], &[(0.0, target)], seconds);
            assert!((found - there).abs() < 1e-9, "{found} {there}");
        };
        check(1.0, 0.5, 0.25);
        check(1.0, 1.0, 0.75);
        check(1.0, 1.5, 1.0);
        check(-0.32, 0.4, -0.16);
        check(-0.32, 0.8, -0.32);
    }

    #[test]
    fn a_target_behind_is_passed_and_come_back_to() {
        // At 0.5 s it is at 0.25 with 1 m/s: it stops at 0.5 after another 0.5 s.
        let check = |seconds: f64, there: f64| {
            let found = x(&[], &[(0.0, 1.0), (0.5, 0.25)], seconds);
            assert!((found - there).abs() < 1e-9, "{seconds} {found} {there}");
        };
        check(1.0, 0.5);
        check(2.0, 0.25);
    }

    #[test]
    fn a_smoothed_ramp_begins_as_a_cubic() {
        let eased = [axis_quirk("R", "X", "jerk-limit", &[("limit", 10.0)])];
        let found = x(&eased, &[(0.0, 1.0)], 0.1);
        assert!((found - 10.0 * 0.001 / 6.0).abs() < 2e-6, "{found}");
        // Past the window it is the parabola half of it late, and (2/24)·0.2² above.
        let found = x(&eased, &[(0.0, 1.0)], 0.4);
        assert!((found - (0.09 + 0.04 / 12.0)).abs() < 2e-5, "{found}");
    }

    #[test]
    fn a_lag_behind_a_parabola() {
        let late = [axis_quirk("R", "X", "first-order-lag", &[("time_constant", 0.05)])];
        // a·(t²/2 − τ·t + τ²·(1 − e^(−t/τ))) for a = 2.
        let exact = 2.0 * (0.08 - 0.02 + 0.0025 * (1.0 - (-8.0_f64).exp()));
        let found = x(&late, &[(0.0, 1.0)], 0.4);
        assert!((found - exact).abs() < 1e-8, "{found} {exact}");
    }
}
