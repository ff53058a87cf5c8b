//! `dead-time`: a signal arrives later by a constant time: y(t) = x(t − time).
//!
//! Source: the transport delay of linear control theory, e^(−s·time) (K. J. Åström, T. Hägglund, Advanced PID Control,
//! ISA 2006, section 2.5). Before the first input the signal holds what it held at the start. A measured quantity is
//! looked up on straight lines between samples a millisecond apart; a step of a command or a report is late by `time` exactly.

use super::line::{History, Mail};
use super::table::{BASE, time};
use crate::device::path::{Moment, STEPS_STRETCH_S, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass, Site};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "dead-time",
    summary: "a signal arrives later by a constant time",
    equation: "y(t) = x(t − time)",
    source: "Åström, Hägglund, Advanced PID Control, ISA 2006, 2.5",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[time("time", 0.05, "how much later")],
    excited_by: "changes of the signal",
    build: Build::Stage(|values, site| DeadTime::stage(values[0], site)),
    ..BASE
};

/// A signal on its way.
#[derive(Clone, Debug)]
struct DeadTime {
    time: f64,
    way: Way,
    /// How long a stretch it bears, s.
    stretch: f64,
}

#[derive(Clone, Debug)]
enum Way {
    Mail(Mail),
    History(History),
}

impl DeadTime {
    fn stage(time: f64, site: &Site) -> Box<dyn Stage> {
        let way = match site.is_smooth() {
            true => Way::History(History::new(true, site.is_whole())),
            false => Way::Mail(Mail::default()),
        };
        let stretch = match &way {
            _ if site.is_command() => f64::INFINITY,
            Way::Mail(_) => STEPS_STRETCH_S,
            Way::History(_) => STRETCH_S,
        };
        Box::new(DeadTime { time, way, stretch })
    }
}

impl Stage for DeadTime {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        self.stretch
    }

    fn count_finely(&mut self) {
        if let Way::History(history) = &mut self.way {
            history.count_finely();
        }
    }

    fn signal(&mut self, value: f64, Moment { now, .. }: Moment) -> f64 {
        if self.time == 0.0 {
            return value;
        }
        match &mut self.way {
            Way::Mail(mail) => {
                if mail.is_new(value) {
                    mail.send(value, now + self.time);
                }
                mail.arrived(now)
            }
            Way::History(history) => {
                history.note(now, value);
                history.at(now - self.time, now - self.time)
            }
        }
    }

    fn next_change(&self) -> Option<f64> {
        match &self.way {
            Way::Mail(mail) => mail.next(),
            Way::History(_) => None,
        }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        match &self.way {
            Way::Mail(mail) => mail.state(visit),
            Way::History(history) => history.state(visit),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn what_goes_in_comes_out_later_and_in_order() {
        let late = spec("command-link", "dead-time", Some("motorDirection"), &[("time", 0.25)]);
        let mut belt = with("StraightConveyor", &[], &[late]);
        belt.check(&[("motorDirection", 1.0)], 0.1, &[("driveEnabled", 0.0)]);
        belt.check(&[("motorDirection", 0.0)], 0.1499, &[("driveEnabled", 0.0)]);
        belt.check(&[], 0.0001, &[("driveEnabled", 1.0)]);
        belt.check(&[], 0.0999, &[("driveEnabled", 1.0)]);
        belt.check(&[], 0.0001, &[("driveEnabled", 0.0)]);
    }

    /// A step of a report that comes by itself, between all looks at the device, is late by its time and no more.
    #[test]
    fn a_step_is_late_by_its_time_to_the_microsecond_whatever_the_spans() {
        // Extended but for 2 mm after 0.996 s.
        for time in [0.0137, 0.013_71, 0.2] {
            for span in [1.0 / 3.0, 0.0171, 0.02] {
                let late = spec("report-link", "dead-time", Some("limitExtended"), &[("time", time)]);
                let mut pusher = with("Pusher", &[], &[late]);
                pusher.check(&[("command", 1.0)], 0.0, &[]);
                let (whole, end) = (((0.996 + time - 1e-6) / span).floor(), 0.996 + time);
                for _ in 0..whole as u32 {
                    pusher.device.advance(span);
                }
                pusher.check(&[], end - 1e-6 - whole * span, &[("limitExtended", 0.0)]);
                pusher.check(&[], 2e-6, &[("limitExtended", 1.0)]);
            }
        }
    }

    #[test]
    fn a_late_count_is_a_whole_number_of_its_own_time() {
        let late = spec("report-link", "dead-time", Some("encoder"), &[("time", 0.05)]);
        let mut motor = with("EncoderMotor", &[], &[late]);
        motor.check(&[("enable", 1.0), ("speedTarget", 10.0)], 1.5, &[]);
        let exact = ((2.5 + 10.0 * 0.95) * 4096.0 / std::f64::consts::TAU).floor();
        assert!((motor.report("encoder") - exact).abs() <= 1.0);
    }
}
