//! `kinetwin.EncoderMotor`: an inverter motor with an incremental encoder.

use crate::device::conveyor::drive_settings;
use crate::device::driven::Driven;
use crate::device::law::encoder::Encoder;
use crate::device::law::moves;
use crate::device::path::Stages;
use crate::device::table::{
    ANGULAR_ACCELERATION, ANGULAR_VELOCITY, LEAST, LONGEST_S, STEEPEST, TIME, counter, indicator, integer, measure,
    number, option, switch, target,
};
use crate::device::{Device, joints_where_reported};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.EncoderMotor",
    summary: "a motor with a ramped drive whose encoder counts its angle",
    ports: &[
        target("speedTarget", ANGULAR_VELOCITY, "speed the motor is to run at, its sign counts"),
        switch("enable", "lets the motor follow the target; it ramps to 0 without"),
        counter("encoder", "whole counts of the angle, wrapping at the ends of its range"),
        measure("speedActual", ANGULAR_VELOCITY, "speed of the motor"),
        indicator("inverterReady", "the inverter is enabled"),
    ],
    parameters: &[
        number("acceleration", ANGULAR_ACCELERATION, (LEAST, STEEPEST), "20", "slope of the speed towards its target"),
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
            "10",
            "slope at which a coasting motor slows down",
        ),
        number("readyDelay", TIME, (0.0, LONGEST_S), "0", "time from enable until the inverter is ready and moves"),
        integer("countsPerRevolution", (1, 1 << 30), "4096", "counts of the encoder in one turn"),
        integer("encoderBits", (0, 31), "0", "bits of the encoder's count, from 0 up; 0: a DINT that wraps"),
    ],
};

const SPEED_TARGET: usize = 0;
const ENABLE: usize = 1;
const ENCODER: usize = 2;
const SPEED_ACTUAL: usize = 3;
const INVERTER_READY: usize = 4;

/// A motor with its inverter and its encoder.
#[derive(Clone, Debug)]
struct EncoderMotor {
    speed_target: f64,
    enable: bool,
    drive: Driven,
    encoder: Encoder,
    counts_finely: bool,
}

/// Builds one.
pub(super) fn build(parameters: &Parameters) -> Box<dyn Device> {
    let bits = parameters.integer("encoderBits") as u32;
    let encoder = Encoder {
        counts_per_revolution: parameters.integer("countsPerRevolution") as f64,
        bits: Some(bits).filter(|bits| *bits > 0),
    };
    let drive = Driven::new(drive_settings(parameters));
    Box::new(EncoderMotor { speed_target: 0.0, enable: false, drive, encoder, counts_finely: false })
}

impl Device for EncoderMotor {
    fn command(&mut self, port: usize, value: f64) {
        match port {
            SPEED_TARGET => self.speed_target = value,
            ENABLE => self.enable = value != 0.0,
            _ => return,
        }
        self.drive.command(self.enable, self.speed_target);
    }

    fn advance(&mut self, seconds: f64) {
        // Actuator and mechanics; the encoder sits on the load's side of the shaft.
        self.drive.advance(seconds);
    }

    fn report(&mut self, reports: &mut [f64]) {
        let angle = self.drive.load().position;
        reports[ENCODER] = if self.counts_finely { self.encoder.passed(angle) } else { self.encoder.count(angle) };
        reports[SPEED_ACTUAL] = self.drive.velocity();
        reports[INVERTER_READY] = f64::from(self.drive.ready());
    }

    fn count_finely(&mut self) {
        self.counts_finely = true;
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.speed_target);
        self.drive.state(visit);
    }

    fn rests(&self) -> bool {
        self.drive.rests()
    }

    fn unchanged_for(&self) -> f64 {
        self.drive.unchanged_for(0.0)
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn stages(&mut self, _component: Option<&str>) -> Option<&mut Stages> {
        Some(&mut self.drive.stages)
    }

    fn moving(&self) -> u32 {
        u32::from(moves(self.drive.velocity()))
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
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use crate::device::bench::Bench;

    fn motor() -> Bench {
        Bench::new("kinetwin.EncoderMotor", &[])
    }

    const RUN: [(&str, f64); 2] = [("speedTarget", 10.0), ("enable", 1.0)];

    #[test]
    fn at_rest_until_enabled() {
        motor().check(&[("speedTarget", 10.0)], 5.0, &[("speedActual", 0.0), ("encoder", 0.0), ("inverterReady", 0.0)]);
    }

    #[test]
    fn the_encoder_is_the_floor_of_the_angle() {
        // 2.5 rad in the ramp's half second, 10 rad in the second after.
        let counts = (12.5 * 4096.0 / TAU).floor();
        motor().check(&RUN, 1.5, &[("speedActual", 10.0), ("encoder", counts)]);
        let counts = (-12.5 * 4096.0 / TAU).floor();
        motor().check(&[("speedTarget", -10.0), ("enable", 1.0)], 1.5, &[("speedActual", -10.0), ("encoder", counts)]);
    }

    #[test]
    fn the_inverter_is_ready_at_once_and_the_motor_ramps_down_without() {
        let mut motor = motor();
        motor.check(&RUN, 0.0, &[("inverterReady", 1.0), ("speedActual", 0.0)]);
        motor.check(&[], 1.0, &[("speedActual", 10.0)]);
        motor.check(&[("enable", 0.0)], 0.0, &[("inverterReady", 0.0), ("speedActual", 10.0)]);
        motor.check(&[], 0.25, &[("speedActual", 5.0)]);
        motor.check(&[], 0.3, &[("speedActual", 0.0)]);
    }

    #[test]
    fn there_and_back_the_encoder_is_0_again() {
        let mut motor = motor();
        motor.check(&RUN, 0.0, &[]);
        for step in 0..4000 {
            match step {
                1500 => motor.device.command(0, -10.0),
                3500 => motor.device.command(0, 0.0),
                _ => {}
            }
            motor.device.advance(0.001);
        }
        motor.check(&[], 1.0, &[("encoder", 0.0), ("speedActual", 0.0)]);
    }

    #[test]
    fn encoder_bits_wrap_and_a_ready_delay_holds_back() {
        let bits = [("encoderBits", "12"), ("countsPerRevolution", "4096")];
        let counts = (12.5 * 4096.0 / TAU).floor().rem_euclid(4096.0);
        Bench::new("kinetwin.EncoderMotor", &bits).check(&RUN, 1.5, &[("encoder", counts)]);
        let mut slow = Bench::new("kinetwin.EncoderMotor", &[("readyDelay", "0.2")]);
        slow.check(&RUN, 0.1, &[("inverterReady", 0.0)]);
        slow.check(&[], 0.2, &[("inverterReady", 1.0), ("speedActual", 2.0)]);
    }
}
