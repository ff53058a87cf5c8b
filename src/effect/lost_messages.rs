//! `lost-messages`: of the messages of a signal some are lost: a command that is lost is not taken, and the one before stands
//! until the next change; of the reports' cycles some bring nothing new.
//!
//! Source: independent losses, a Bernoulli channel (L. Schenato and others, Foundations of control and estimation over lossy
//! networks, Proc. IEEE 95, 2007).

use super::dice::Dice;
use super::table::{BASE, ONE, TIME, parameter};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "lost-messages",
    summary: "some messages of a signal are lost",
    equation: "message k: y = x with probability 1 − p, else y stays",
    source: "Schenato and others, Proc. IEEE 95 (2007)",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[
        parameter("probability", ONE, (0.0, 1.0), 0.0, 0.05, "share of the messages that are lost"),
        parameter("cycle", TIME, (1e-3, 10.0), 0.02, 0.02, "cycle of the reports").or(0.02),
    ],
    excited_by: "many changes of the signal",
    build: Build::Stage(|values, site| {
        Box::new(LostMessages {
            probability: values[0],
            cycle: values[1],
            dice: Dice::new(site.seed),
            is_command: site.is_command(),
            entry: None,
            exit: 0.0,
            count: 0,
            is_lost: false,
        })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct LostMessages {
    probability: f64,
    cycle: f64,
    dice: Dice,
    is_command: bool,
    entry: Option<f64>,
    exit: f64,
    /// Of the last command, or of the present cycle.
    count: u64,
    is_lost: bool,
}

impl Stage for LostMessages {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn next_change(&self) -> Option<f64> {
        (!self.is_command).then(|| (self.count + 1) as f64 * self.cycle)
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        let is_new = self.entry.replace(value) != Some(value);
        if self.is_command {
            if is_new {
                // What stands there at the start needs no message.
                self.is_lost = self.count > 0 && self.dice.uniform(self.count) < self.probability;
                self.count += 1;
            }
        } else {
            let cycle = ((moment.now + SAME_INSTANT_S) / self.cycle) as u64;
            if cycle != self.count {
                // What stands there when a cycle ends is what the next one shows if it brings nothing.
                if !self.is_lost {
                    self.exit = value;
                }
                (self.count, self.is_lost) = (cycle, self.dice.uniform(cycle) < self.probability);
            }
        }
        if !self.is_lost {
            self.exit = value;
        }
        self.exit
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.entry.into_iter().for_each(&mut *visit);
        visit(self.exit);
        visit(self.count as f64);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn its_share_of_the_commands_is_not_taken() {
        let lost = spec("command-link", "lost-messages", Some("motorDirection"), &[("probability", 0.3)]);
        let mut belt = with("StraightConveyor", &[], &[lost]);
        let mut taken = 0;
        for command in 0..2000 {
            let direction = f64::from(1 - command % 2 * 2);
            belt.device.command(1, direction);
            belt.device.command(0, 1.0);
            belt.device.advance(0.01);
            taken += u32::from(belt.report("velocityActual") * direction >= 0.0 && belt.report("driveEnabled") == 1.0);
        }
        assert!((500..2000).contains(&taken), "{taken}");
    }

    #[test]
    fn its_share_of_the_reports_brings_nothing_new() {
        let lost = spec("report-link", "lost-messages", Some("velocityActual"), &[("probability", 0.3)]);
        let mut belt = with("StraightConveyor", &[("acceleration", "0.01")], &[lost]);
        belt.check(&[("velocityTarget", 1e3), ("motorDirection", 1.0)], 0.03, &[]);
        let (mut last, mut stale) = (0.0, 0);
        for _ in 0..5000 {
            belt.device.advance(0.02);
            let now = belt.report("velocityActual");
            // In the middle of its cycle a lost one shows what was there at its start.
            stale += u32::from(now - last < 0.015 * 0.01);
            last = now;
        }
        assert!((1400..1600).contains(&stale), "{stale}");
    }
}
