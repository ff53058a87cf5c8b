//! InverterConveyorFb: a belt on an inverter motor, led by a speed profile and watched by its encoder.

use std::f64::consts::TAU;
use std::time::Duration;

use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context};
use crate::time::Instant;

/// How often the profile's next speed is sent: 100 Hz.
const CYCLE: Duration = Duration::from_millis(10);

/// A way with a trapezoid of speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedProfile {
    /// rad.
    pub way: f64,
    /// The speed between the ramps, rad/s, and their slope, rad/s².
    pub speed: f64,
    pub slope: f64,
}

impl SpeedProfile {
    /// How long it takes, s: way/v + v/a, or 2·√(way/a) where the way is too short for the speed.
    pub fn seconds(&self) -> f64 {
        let peak = self.peak();
        self.way / peak + peak / self.slope
    }

    fn peak(&self) -> f64 {
        self.speed.min((self.way * self.slope).sqrt())
    }

    /// The speed after so many seconds.
    pub fn at(&self, seconds: f64) -> f64 {
        let left = self.seconds() - seconds;
        (self.slope * seconds.min(left)).clamp(0.0, self.peak())
    }
}

/// A belt with its inverter.
#[derive(Debug)]
pub struct InverterConveyorFb {
    name: String,
    speed_target: Output<f64>,
    enable: Output<bool>,
    encoder: Input<i32>,
    ready: Input<bool>,
    running: Input<bool>,
    counts_per_revolution: f64,
    /// The encoder's last count as read, and the counts since the start with its wraps undone.
    counts: (i32, i64),
    profile: Option<(SpeedProfile, Instant)>,
    /// Where the motor is to be when the profile has ended, rad.
    goal: f64,
    due: Option<Instant>,
}

impl InverterConveyorFb {
    /// The block of the conveyor called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str, counts_per_revolution: f64) -> InverterConveyorFb {
        InverterConveyorFb {
            name: name.to_owned(),
            speed_target: binder.output(name, "speedTarget"),
            enable: binder.output(name, "enable"),
            encoder: binder.input(name, "encoder"),
            ready: binder.input(name, "inverterReady"),
            running: binder.input(name, "driveRunning"),
            counts_per_revolution,
            counts: (0, 0),
            profile: None,
            goal: 0.0,
            due: None,
        }
    }

    /// Enables the inverter.
    pub fn enable(&mut self, cx: &mut Context<'_>) {
        cx.set(self.enable, true);
    }

    /// Whether the inverter is ready and nothing is under way.
    pub fn is_free(&self, cx: &Context<'_>) -> bool {
        cx.get(self.ready) && self.profile.is_none() && !cx.get(self.running)
    }

    /// Goes on by `way` rad from where the last way was to end: what the encoder says is missing is made up for.
    pub fn index(&mut self, cx: &mut Context<'_>, way: f64, speed: f64, slope: f64) {
        self.goal += way;
        let rest = self.goal - self.angle();
        self.profile = Some((SpeedProfile { way: rest.max(0.0), speed, slope }, cx.now));
        self.lead(cx);
    }

    /// Where the motor is by its encoder, rad, to a count.
    pub fn angle(&self) -> f64 {
        (self.counts.1 as f64 + 0.5) * TAU / self.counts_per_revolution
    }

    /// Sends the profile's present speed.
    fn lead(&mut self, cx: &mut Context<'_>) {
        let Some((profile, begun)) = self.profile else { return };
        let seconds = cx.now.since(begun).as_secs_f64();
        cx.set(self.speed_target, profile.at(seconds));
        if seconds < profile.seconds() {
            let due = cx.now + CYCLE;
            self.due = Some(due);
            cx.wake_at(due);
        } else {
            cx.noted(&self.name, "IND", format_args!("indexed, {:+.4} rad off", self.angle() - self.goal));
            (self.profile, self.due) = (None, None);
        }
    }
}

impl Block for InverterConveyorFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        let encoder = cx.get(self.encoder);
        // The difference of two counts is right across a wrap as long as they are less than half a range apart.
        self.counts = (encoder, self.counts.1 + i64::from(encoder.wrapping_sub(self.counts.0)));
        if self.due.is_some_and(|due| due <= cx.now) {
            self.lead(cx);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_is_a_trapezoid_that_ends_where_it_should() {
        let profile = SpeedProfile { way: 120.0, speed: 100.0, slope: 200.0 };
        assert!((profile.seconds() - 1.7).abs() < 1e-12);
        assert_eq!(
            [0.0, 0.25, 0.5, 1.0, 1.2, 1.7, 2.0].map(|at| profile.at(at).round()),
            [0.0, 50.0, 100.0, 100.0, 100.0, 0.0, 0.0]
        );
        // Held for 10 ms each, its speeds sum up to the way: its corners lie on whole cycles.
        let sum: f64 = (0..171).map(|k| profile.at(f64::from(k) * 0.01) * 0.01).sum();
        assert!((sum - 120.0).abs() < 1e-9, "{sum}");
    }

    #[test]
    fn a_short_way_never_comes_to_its_speed() {
        let profile = SpeedProfile { way: 2.0, speed: 100.0, slope: 200.0 };
        assert!((profile.seconds() - 0.2).abs() < 1e-12 && (profile.at(0.1) - 20.0).abs() < 1e-9);
    }
}
