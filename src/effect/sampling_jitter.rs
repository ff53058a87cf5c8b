//! `sampling-jitter`: a report shows the state of a little earlier, a command is taken a little later, by |N(0, sigma)| drawn
//! anew for every cycle of the reports and for every command; commands keep their order.
//!
//! Source: the half-normal delay of a task that is never early (F. C. Leone, L. S. Nelson, R. B. Nottingham, The folded
//! normal distribution, Technometrics 3, 1961).

use super::dice::Dice;
use super::line::{History, Mail};
use super::table::{BASE, TIME, parameter};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "sampling-jitter",
    summary: "reports and commands are late by a little, at random",
    equation: "y(t) = x(t − |N(0, sigma)|)",
    source: "Leone, Nelson, Nottingham, Technometrics 3 (1961)",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[
        parameter("sigma", TIME, (0.0, 1.0), 0.0, 0.002, "scale of the delay; its mean is 0.8 of it"),
        parameter("cycle", TIME, (1e-3, 10.0), 0.02, 0.02, "cycle of the reports").or(0.02),
    ],
    excited_by: "changes of the signal",
    build: Build::Stage(|values, site| {
        Box::new(SamplingJitter {
            sigma: values[0],
            cycle: values[1],
            dice: Dice::new(site.seed),
            sent: 0,
            is_command: site.is_command(),
            history: History::new(site.is_smooth(), site.is_whole()),
            mail: Mail::default(),
        })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct SamplingJitter {
    sigma: f64,
    cycle: f64,
    dice: Dice,
    sent: u64,
    is_command: bool,
    history: History,
    mail: Mail,
}

impl Stage for SamplingJitter {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn next_change(&self) -> Option<f64> {
        self.mail.next()
    }

    fn count_finely(&mut self) {
        self.history.count_finely();
    }

    fn signal(&mut self, value: f64, Moment { now, .. }: Moment) -> f64 {
        if self.sigma == 0.0 {
            return value;
        }
        if self.is_command {
            if self.mail.is_new(value) {
                self.mail.send(value, now + self.sigma * self.dice.normal(self.sent).abs());
                self.sent += 1;
            }
            return self.mail.arrived(now);
        }
        let cycle = ((now + SAME_INSTANT_S) / self.cycle) as u64;
        let delay = self.sigma * self.dice.normal(cycle).abs();
        self.history.note(now, value);
        // A draw beyond 8 sigma is as good as none.
        self.history.at(now - delay, now - 8.0 * self.sigma)
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.sent as f64);
        self.mail.state(visit);
        self.history.state(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn the_mean_delay_is_that_of_the_half_normal_distribution() {
        let jitter = spec("report-link", "sampling-jitter", Some("velocityActual"), &[("sigma", 0.005)]);
        let mut belt = with("StraightConveyor", &[("acceleration", "0.01")], &[jitter]);
        belt.check(&[("velocityTarget", 1e3), ("motorDirection", 1.0)], 1.0, &[]);
        let mut late = 0.0;
        for cycle in 1..=2000 {
            belt.device.advance(0.02);
            late += 1.0 + 0.02 * f64::from(cycle) - belt.report("velocityActual") / 0.01;
        }
        let mean = late / 2000.0;
        let exact = 0.005 * (2.0 / std::f64::consts::PI).sqrt();
        assert!((mean / exact - 1.0).abs() < 0.05, "{mean} instead of {exact}");
    }
}
