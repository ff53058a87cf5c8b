//! `kinetwin.SuctionCapGripper`: cups that hold a part by vacuum.

use crate::device::law::vacuum::Vacuum;
use crate::device::path::{Moment, Stages, VacuumTimes};
use crate::device::table::{LENGTH, LONGEST_M, LONGEST_S, TIME, indicator, instance, number, numbers, option, switch};
use crate::device::{BuildError, Cups, Device, Role, Surroundings, triple};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.SuctionCapGripper",
    summary: "suction cups that hold the part they are sealed on while vacuum holds",
    ports: &[
        switch("suctionOn", "draws vacuum"),
        switch("blowOn", "blows off; wins over suction"),
        indicator("vacuumOn", "vacuum holds"),
    ],
    parameters: &[
        number("buildUpTime", TIME, (0.0, LONGEST_S), "0.15", "time from suction on a sealed part to vacuum"),
        number("releaseTime", TIME, (0.0, LONGEST_S), "0.08", "time from suction off to the loss of the vacuum"),
        option("alwaysSealed", "a part is taken to be sealed at the cups always, with none in the model"),
        instance("robot", "the robot that carries the gripper; without one it stays where its instance stands"),
        numbers(
            "cupOffset",
            LENGTH,
            3,
            (-LONGEST_M, LONGEST_M),
            "0;0;0",
            "where the cups' rim lies from the robot's tool: x, y, z",
        ),
        number("reach", LENGTH, (0.0, 1.0), "0.01", "how far below the rim a part's top may lie and still be sealed"),
    ],
};

const SUCTION_ON: usize = 0;
const BLOW_ON: usize = 1;
const VACUUM_ON: usize = 2;

/// A gripper with its cups.
#[derive(Clone, Debug)]
struct SuctionCapGripper {
    suction: bool,
    blow: bool,
    vacuum: Vacuum,
    times: VacuumTimes,
    stages: Stages,
    cups: Cups,
}

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let times = VacuumTimes {
        build_up: parameters.number("buildUpTime"),
        release: parameters.number("releaseTime"),
        hold: f64::INFINITY,
    };
    let mut vacuum = Vacuum::new(times.build_up, times.release);
    let always_sealed = parameters.boolean("alwaysSealed");
    vacuum.seal(always_sealed);
    let offset = triple(parameters, "cupOffset", instance)?;
    let cups = Cups { offset, reach: parameters.number("reach"), vacuum: false, always_sealed };
    Ok(Box::new(SuctionCapGripper { suction: false, blow: false, vacuum, times, stages: Stages::default(), cups }))
}

impl SuctionCapGripper {
    fn pass(&mut self, moment: Moment) {
        pass(&mut self.vacuum, self.times, (self.suction, self.blow), &mut self.stages, moment);
    }
}

/// Gives the cups what the stages leave of the command and of their times.
fn pass(vacuum: &mut Vacuum, nominal: VacuumTimes, (suction, blow): (bool, bool), stages: &mut Stages, moment: Moment) {
    let times = stages.process.vacuum(nominal, moment);
    vacuum.limit(times.build_up, times.release, times.hold);
    vacuum.command(stages.actuator.switched(suction, moment), blow);
}

impl Device for SuctionCapGripper {
    fn command(&mut self, port: usize, value: f64) {
        match port {
            SUCTION_ON => self.suction = value != 0.0,
            BLOW_ON => self.blow = value != 0.0,
            _ => return,
        }
        self.pass(self.stages.moment());
        self.cups.vacuum = self.vacuum.holds();
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.vacuum.seal(surroundings.sealed || self.cups.always_sealed);
        self.cups.vacuum = self.vacuum.holds();
    }

    fn advance(&mut self, seconds: f64) {
        if self.rests() {
            // How long it has been so does not matter.
        } else if self.stages.is_nominal() {
            self.vacuum.advance(seconds);
        } else {
            let mut rest = seconds;
            while let Some(moment) = self.stages.stretch(&mut rest, f64::INFINITY) {
                self.vacuum.advance(moment.span);
                pass(&mut self.vacuum, self.times, (self.suction, self.blow), &mut self.stages, moment);
            }
        }
        self.cups.vacuum = self.vacuum.holds();
    }

    fn report(&mut self, reports: &mut [f64]) {
        reports[VACUUM_ON] = f64::from(self.cups.vacuum);
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.vacuum.state(visit);
        self.stages.state(visit);
    }

    fn rests(&self) -> bool {
        self.stages.is_nominal() && self.vacuum.rests()
    }

    fn unchanged_for(&self) -> f64 {
        self.vacuum.unchanged_for().min(self.stages.unchanged_for())
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn stages(&mut self, _component: Option<&str>) -> Option<&mut Stages> {
        Some(&mut self.stages)
    }

    fn role(&self) -> Role<'_> {
        Role::Holds(&self.cups)
    }
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;

    #[test]
    fn vacuum_needs_a_sealed_part_unless_one_always_is() {
        let mut gripper = Bench::new("kinetwin.SuctionCapGripper", &[]);
        gripper.check(&[("suctionOn", 1.0)], 1.0, &[("vacuumOn", 0.0)]);
        gripper.seal(true);
        gripper.check(&[], 0.149, &[("vacuumOn", 0.0)]);
        gripper.check(&[], 0.001, &[("vacuumOn", 1.0)]);
        gripper.seal(false);
        gripper.check(&[], 0.0, &[("vacuumOn", 0.0)]);
        let mut gripper = Bench::new("kinetwin.SuctionCapGripper", &[("alwaysSealed", "true")]);
        gripper.check(&[("suctionOn", 1.0)], 0.15, &[("vacuumOn", 1.0)]);
        gripper.seal(false);
        gripper.check(&[], 0.0, &[("vacuumOn", 1.0)]);
    }

    #[test]
    fn vacuum_is_lost_at_once_on_blow_off_and_later_without_suction() {
        let mut gripper = Bench::new("kinetwin.SuctionCapGripper", &[("alwaysSealed", "true")]);
        gripper.check(&[("suctionOn", 1.0)], 1.0, &[("vacuumOn", 1.0)]);
        gripper.check(&[("suctionOn", 0.0)], 0.079, &[("vacuumOn", 1.0)]);
        gripper.check(&[("suctionOn", 1.0)], 1.0, &[("vacuumOn", 1.0)]);
        gripper.check(&[("suctionOn", 0.0)], 0.08, &[("vacuumOn", 0.0)]);
        gripper.check(&[("suctionOn", 1.0)], 1.0, &[("vacuumOn", 1.0)]);
        gripper.check(&[("blowOn", 1.0)], 0.0, &[("vacuumOn", 0.0)]);
        gripper.check(&[], 1.0, &[("vacuumOn", 0.0)]);
        gripper.check(&[("blowOn", 0.0)], 0.149, &[("vacuumOn", 0.0)]);
        gripper.check(&[], 0.001, &[("vacuumOn", 1.0)]);
    }
}
