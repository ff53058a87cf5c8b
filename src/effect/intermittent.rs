//! `intermittent`: a loose contact: of windows of `time` each, a share `probability` (drawn at random) is without the signal,
//! which then reads 0 or false.
//!
//! Source: the intermittent fault as a Bernoulli process (R. Isermann, Fault-Diagnosis Systems, Springer 2006, section 2.3).

use super::dice::Dice;
use super::table::{BASE, ONE, TIME, parameter};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "intermittent",
    summary: "a loose contact: the signal is away at times",
    equation: "window k: y = 0 with the given probability, else x",
    source: "Isermann, Fault-Diagnosis Systems, Springer 2006, 2.3",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[
        parameter("probability", ONE, (0.0, 1.0), 0.0, 0.05, "share of the windows without the signal"),
        parameter("time", TIME, (1e-3, 1e3), 0.1, 0.1, "length of a window").or(0.1),
    ],
    excited_by: "the signal being anything but 0 for many windows",
    build: Build::Stage(|values, site| {
        Box::new(Intermittent {
            probability: values[0],
            time: values[1],
            dice: Dice::new(site.seed),
            window: (0, false),
        })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Intermittent {
    probability: f64,
    time: f64,
    dice: Dice,
    /// The present window, and whether the signal is away in it.
    window: (u64, bool),
}

impl Stage for Intermittent {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn next_change(&self) -> Option<f64> {
        Some((self.window.0 + 1) as f64 * self.time)
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        let window = ((moment.now + SAME_INSTANT_S) / self.time) as u64;
        if moment.now == 0.0 || window != self.window.0 {
            self.window = (window, self.dice.uniform(window) < self.probability);
        }
        if self.window.1 { 0.0 } else { value }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.window.0 as f64);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_is_away_for_its_share_of_the_windows() {
        let loose = spec("report-link", "intermittent", Some("driveEnabled"), &[("probability", 0.2), ("time", 0.1)]);
        let mut belt = with("StraightConveyor", &[], &[loose]);
        belt.check(&[("motorDirection", 1.0)], 0.05, &[]);
        let mut away = 0;
        for _ in 0..5000 {
            away += u32::from(belt.report("driveEnabled") == 0.0);
            belt.device.advance(0.1);
        }
        assert!((900..1100).contains(&away), "{away}");
    }
}
