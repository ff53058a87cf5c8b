//! `kinetwin.InverterConveyor`: a straight belt whose drum an inverter motor turns through a gear, with an encoder on the motor.

use crate::device::conveyor::{self, belt, drive_settings, moved};
use crate::device::driven::Driven;
use crate::device::law::encoder::Encoder;
use crate::device::law::{STANDSTILL, moves};
use crate::device::path::Stages;
use crate::device::table::{
    ANGULAR_ACCELERATION, ANGULAR_VELOCITY, LEAST, LENGTH, LONGEST_M, LONGEST_S, ONE, STEEPEST, TIME, VELOCITY,
    counter, indicator, integer, measure, number, option, switch, target,
};
use crate::device::{Belt, BuildError, Device, Role, Surface, Surroundings, joints_where_reported};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.InverterConveyor",
    summary: "a straight belt on the drum of an inverter motor, whose encoder counts the motor's angle",
    ports: &[
        target("speedTarget", ANGULAR_VELOCITY, "speed the motor is to run at, its sign counts"),
        switch("enable", "lets the motor follow the target; it ramps to 0 without"),
        counter("encoder", "whole counts of the motor's angle, wrapping at the ends of its range"),
        measure("speedActual", ANGULAR_VELOCITY, "speed of the motor"),
        indicator("inverterReady", "the inverter is enabled"),
        measure("velocityActual", VELOCITY, "speed of the belt"),
        indicator("driveRunning", "the belt moves faster than 1 mm/s, either way"),
        indicator("lightBarrierA", "a part cuts the beam of barrier A"),
        indicator("lightBarrierB", "a part cuts the beam of barrier B"),
    ],
    parameters: &[
        number("length", LENGTH, (0.01, LONGEST_M), "2.0", "length of the belt, from x = 0 of its instance"),
        conveyor::WIDTH,
        number("drumDiameter", LENGTH, (0.001, LONGEST_M), "0.1", "diameter of the drum with the belt on it"),
        number("gearRatio", ONE, (LEAST, 1e6), "10", "turns of the motor in one of the drum"),
        number("acceleration", ANGULAR_ACCELERATION, (LEAST, STEEPEST), "400", "slope of the motor's speed"),
        number(
            "deceleration",
            ANGULAR_ACCELERATION,
            (0.0, STEEPEST),
            "0",
            "slope while the speed falls towards 0; 0 means as acceleration",
        ),
        option("coast", "without enable the motor coasts instead of following the ramp"),
        number(
            "coastDeceleration",
            ANGULAR_ACCELERATION,
            (LEAST, STEEPEST),
            "100",
            "slope at which a coasting motor slows down",
        ),
        number("readyDelay", TIME, (0.0, LONGEST_S), "0", "time from enable until the inverter is ready and moves"),
        integer("countsPerRevolution", (1, 1 << 30), "4096", "counts of the encoder in one turn of the motor"),
        integer("encoderBits", (0, 31), "0", "bits of the encoder's count, from 0 up; 0: a DINT that wraps"),
        conveyor::barrier("barrierA", "0.3"),
        conveyor::barrier("barrierB", "1.7"),
        conveyor::BEAM_HEIGHT,
        conveyor::TRANSFER,
    ],
};

const SPEED_TARGET: usize = 0;
const ENABLE: usize = 1;
const ENCODER: usize = 2;
const SPEED_ACTUAL: usize = 3;
const INVERTER_READY: usize = 4;
const VELOCITY_ACTUAL: usize = 5;
const DRIVE_RUNNING: usize = 6;
const LIGHT_BARRIER_A: usize = 7;
const LIGHT_BARRIER_B: usize = 8;

/// A belt with its motor.
#[derive(Clone, Debug)]
struct InverterConveyor {
    speed_target: f64,
    enable: bool,
    drive: Driven,
    encoder: Encoder,
    counts_finely: bool,
    /// How far the belt goes while the motor turns by a radian, m.
    reach: f64,
    belt: Belt,
    beams: [bool; 2],
}

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let surface = Surface::Straight { length: parameters.number("length"), width: parameters.number("width") };
    let bits = parameters.integer("encoderBits") as u32;
    Ok(Box::new(InverterConveyor {
        speed_target: 0.0,
        enable: false,
        drive: Driven::new(drive_settings(parameters)),
        encoder: Encoder {
            counts_per_revolution: parameters.integer("countsPerRevolution") as f64,
            bits: Some(bits).filter(|bits| *bits > 0),
        },
        counts_finely: false,
        reach: parameters.number("drumDiameter") / 2.0 / parameters.number("gearRatio"),
        belt: belt(surface, parameters, instance)?,
        beams: [false; 2],
    }))
}

impl Device for InverterConveyor {
    fn command(&mut self, port: usize, value: f64) {
        match port {
            SPEED_TARGET => self.speed_target = value,
            ENABLE => self.enable = value != 0.0,
            _ => return,
        }
        self.drive.command(self.enable, self.speed_target);
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.beams = [surroundings.barrier_a, surroundings.barrier_b];
        self.drive.loaded(surroundings.parts, surroundings.queued);
    }

    fn advance(&mut self, seconds: f64) {
        // The drive is that of the motor; the belt follows the drum.
        let way = self.drive.advance(seconds);
        moved(&mut self.belt, &self.drive, way, self.reach);
    }

    fn report(&mut self, reports: &mut [f64]) {
        let angle = self.drive.load().position;
        let velocity = self.drive.velocity() * self.reach;
        reports[ENCODER] = if self.counts_finely { self.encoder.passed(angle) } else { self.encoder.count(angle) };
        reports[SPEED_ACTUAL] = self.drive.velocity();
        reports[INVERTER_READY] = f64::from(self.drive.ready());
        reports[VELOCITY_ACTUAL] = velocity;
        reports[DRIVE_RUNNING] = f64::from(moves(velocity));
        reports[LIGHT_BARRIER_A] = f64::from(self.beams[0] && self.belt.barriers[0].is_some());
        reports[LIGHT_BARRIER_B] = f64::from(self.beams[1] && self.belt.barriers[1].is_some());
    }

    fn count_finely(&mut self) {
        self.counts_finely = true;
    }

    fn rests(&self) -> bool {
        self.drive.rests()
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.speed_target);
        self.drive.state(visit);
        visit(self.belt.displacement);
        self.beams.iter().for_each(|cut| visit(f64::from(*cut)));
    }

    fn unchanged_for(&self) -> f64 {
        self.drive.unchanged_for(STANDSTILL / self.reach)
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn stages(&mut self, _component: Option<&str>) -> Option<&mut Stages> {
        Some(&mut self.drive.stages)
    }

    /// Both beams look along the belt.
    fn travel(&self, port: usize) -> Option<f64> {
        matches!(port, LIGHT_BARRIER_A | LIGHT_BARRIER_B).then(|| self.drive.carried() * self.reach)
    }

    fn moving(&self) -> u32 {
        u32::from(moves(self.drive.velocity() * self.reach))
    }

    fn share(&mut self, others: u32) {
        self.drive.shared(others);
    }

    fn joints(&self, visit: &mut dyn FnMut(&'static str, f64)) {
        visit("Shaft.R", self.drive.load().position);
    }

    fn reported_joints(&self, reports: &[Option<f64>], visit: &mut dyn FnMut(&'static str, f64)) {
        let angle = reports[ENCODER].map(|count| self.encoder.angle_near(count, self.drive.load().position));
        joints_where_reported(self, &[angle], visit);
    }

    fn role(&self) -> Role<'_> {
        Role::Carries(&self.belt)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use crate::device::bench::Bench;

    const RUN: [(&str, f64); 2] = [("speedTarget", 60.0), ("enable", 1.0)];

    fn belt() -> Bench {
        Bench::new("kinetwin.InverterConveyor", &[("acceleration", "100")])
    }

    #[test]
    fn the_belt_goes_with_the_drum() {
        // 60 rad/s behind a gear of 10 on a drum of 0.1 m: 0.3 m/s; 18 rad in the ramp's 0.6 s and 24 in the 0.4 s after.
        let counts = (42.0 * 4096.0 / TAU).floor();
        let mut belt = belt();
        belt.check(&RUN, 1.0, &[("speedActual", 60.0), ("velocityActual", 0.3), ("encoder", counts)]);
        assert!((belt.displacement() - 42.0 * 0.005).abs() < 1e-12);
    }

    #[test]
    fn it_stands_without_enable_and_is_ready_at_once_with_it() {
        belt().check(
            &[("speedTarget", 60.0)],
            5.0,
            &[("velocityActual", 0.0), ("encoder", 0.0), ("inverterReady", 0.0)],
        );
        belt().check(&RUN, 0.0, &[("inverterReady", 1.0), ("driveRunning", 0.0)]);
    }

    #[test]
    fn a_profile_there_and_back_ends_where_it_began() {
        let mut belt = belt();
        belt.check(&RUN, 1.0, &[("driveRunning", 1.0)]);
        belt.check(&[("speedTarget", -60.0)], 1.6, &[]);
        belt.check(&[("speedTarget", 0.0)], 1.0, &[("encoder", 0.0), ("driveRunning", 0.0)]);
    }

    #[test]
    fn a_barrier_beyond_the_belt_is_refused() {
        let error = Bench::error("kinetwin.InverterConveyor", &[("length", "1.5")]);
        assert_eq!(error, "Device1: barrierB stands at 1.7 m of a belt that is 1.5 m long");
    }
}
