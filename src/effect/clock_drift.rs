//! `clock-drift`: the device's clock is slow, so that its reports fall behind, or its commands come later and later, by `rate`
//! for each second: y(t) = x(t/(1 + rate)). A clock that is fast would have to know the future; a diagnosis moves its
//! samples instead.
//!
//! Source: the linear clock model (D. L. Mills, Computer Network Time Synchronization, CRC Press 2010, section 4.1).

use super::line::{History, Mail};
use super::table::{BASE, ONE, parameter};
use crate::device::path::{Moment, STEPS_STRETCH_S, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "clock-drift",
    summary: "the device's clock is slow: reports fall behind more and more",
    equation: "y(t) = x(t/(1 + rate))",
    source: "Mills, Computer Network Time Synchronization, CRC Press 2010, 4.1",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[parameter("rate", ONE, (0.0, 0.1), 0.0, 1e-4, "seconds behind for each second")],
    excited_by: "changes of the signal, late in a long trace",
    build: Build::Stage(|values, site| {
        Box::new(ClockDrift {
            rate: values[0],
            is_smooth: site.is_smooth(),
            history: History::new(true, site.is_whole()),
            mail: Mail::default(),
        })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct ClockDrift {
    rate: f64,
    is_smooth: bool,
    history: History,
    mail: Mail,
}

impl Stage for ClockDrift {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        // A step is told at its instant, and passed on at one.
        if self.is_smooth { STRETCH_S } else { STEPS_STRETCH_S }
    }

    fn next_change(&self) -> Option<f64> {
        self.mail.next()
    }

    fn count_finely(&mut self) {
        self.history.count_finely();
    }

    fn signal(&mut self, value: f64, Moment { now, .. }: Moment) -> f64 {
        if self.rate == 0.0 {
            return value;
        }
        if !self.is_smooth {
            if self.mail.is_new(value) {
                self.mail.send(value, now * (1.0 + self.rate));
            }
            return self.mail.arrived(now);
        }
        self.history.note(now, value);
        let then = now / (1.0 + self.rate);
        self.history.at(then, then)
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.mail.state(visit);
        self.history.state(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_report_is_late_by_its_share_of_the_time() {
        let drift = spec("report-link", "clock-drift", Some("velocityActual"), &[("rate", 0.01)]);
        let mut belt = with("StraightConveyor", &[("acceleration", "0.01")], &[drift]);
        belt.check(&[("velocityTarget", 1e3), ("motorDirection", 1.0)], 50.5, &[("velocityActual", 0.5)]);
    }

    #[test]
    fn a_step_of_a_report_is_late_by_its_share_of_the_time() {
        let drift = spec("report-link", "clock-drift", Some("driveEnabled"), &[("rate", 0.01)]);
        let mut belt = with("StraightConveyor", &[], &[drift]);
        belt.check(&[], 10.0, &[]);
        belt.check(&[("motorDirection", 1.0)], 0.0999, &[("driveEnabled", 0.0)]);
        belt.check(&[], 0.0002, &[("driveEnabled", 1.0)]);
    }

    #[test]
    fn a_command_is_late_by_its_share_of_the_time() {
        let drift = spec("command-link", "clock-drift", Some("motorDirection"), &[("rate", 0.01)]);
        let mut belt = with("StraightConveyor", &[], &[drift]);
        belt.check(&[], 10.0, &[]);
        belt.check(&[("motorDirection", 1.0)], 0.0999, &[("driveEnabled", 0.0)]);
        belt.check(&[], 0.0002, &[("driveEnabled", 1.0)]);
    }
}
