//! EncoderMotorFb: an inverter-driven motor whose shaft carries an encoder.

use std::time::Duration;

use crate::automation::image::{Binder, Input, Output};
use crate::automation::network::{Block, Context, Delay};

/// How near to its target the speed must be reported, rad/s, to have been reached.
const NEAR: f64 = 0.05;
/// How long a ramp may take.
const PATIENCE: Duration = Duration::from_secs(10);

/// A motor with an encoder.
#[derive(Debug)]
pub struct EncoderMotorFb {
    name: String,
    speed_target: Output<f64>,
    enable: Output<bool>,
    encoder: Input<i32>,
    speed_actual: Input<f64>,
    inverter_ready: Input<bool>,
    target: f64,
    enabled: bool,
    ready: bool,
    at_speed: bool,
    /// The encoder's last count as read, and the counts since the start with its wraps undone.
    counts: (i32, i64),
    supervision: Delay,
}

impl EncoderMotorFb {
    /// The block of the motor called `name`.
    pub fn bind(binder: &mut Binder<'_>, name: &str) -> EncoderMotorFb {
        EncoderMotorFb {
            name: name.to_owned(),
            speed_target: binder.output(name, "speedTarget"),
            enable: binder.output(name, "enable"),
            encoder: binder.input(name, "encoder"),
            speed_actual: binder.input(name, "speedActual"),
            inverter_ready: binder.input(name, "inverterReady"),
            target: 0.0,
            enabled: false,
            ready: false,
            at_speed: true,
            counts: (0, 0),
            supervision: Delay::default(),
        }
    }

    /// Enables the inverter and asks for `speed`, rad/s, signed.
    pub fn run(&mut self, cx: &mut Context<'_>, speed: f64) {
        self.target = speed;
        self.enabled = true;
        cx.set(self.speed_target, speed);
        cx.set(self.enable, true);
        self.at_speed = false;
        self.supervision.start(cx, PATIENCE);
    }

    /// Disables the inverter: the motor ramps down.
    pub fn stop(&mut self, cx: &mut Context<'_>) {
        self.target = 0.0;
        self.enabled = false;
        cx.set(self.speed_target, 0.0);
        cx.set(self.enable, false);
        self.at_speed = false;
        self.supervision.start(cx, PATIENCE);
    }

    /// Whether it turns as was asked, and the inverter agrees.
    pub fn at_speed(&self) -> bool {
        self.at_speed
    }

    /// The encoder's counts since the start, its wraps undone.
    pub fn counts(&self) -> i64 {
        self.counts.1
    }
}

impl Block for EncoderMotorFb {
    fn name(&self) -> &str {
        &self.name
    }

    fn update(&mut self, cx: &mut Context<'_>) {
        let encoder = cx.get(self.encoder);
        // The difference of two counts is right across a wrap as long as they are less than half a range apart.
        self.counts = (encoder, self.counts.1 + i64::from(encoder.wrapping_sub(self.counts.0)));
        let ready = cx.get(self.inverter_ready);
        if ready != self.ready {
            self.ready = ready;
            cx.noted(&self.name, "IND", if ready { "inverter ready" } else { "inverter off" });
        }
        let at_speed = ready == self.enabled && (cx.get(self.speed_actual) - self.target).abs() <= NEAR;
        if at_speed != self.at_speed {
            self.at_speed = at_speed;
            let verb = if at_speed { "turns at" } else { "leaves its speed for" };
            cx.noted(&self.name, "IND", format_args!("{verb} {:.2} rad/s, encoder {encoder}", self.target));
        }
        if at_speed {
            self.supervision.stop();
        } else if self.supervision.elapsed(cx) {
            cx.warned(&self.name, "TIMEOUT", "the motor does not reach its speed");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automation::bench::Bench;

    fn motor() -> (Bench, EncoderMotorFb) {
        Bench::with(|binder| EncoderMotorFb::bind(binder, "Motor"))
    }

    #[test]
    fn a_speed_profile() {
        let (mut bench, mut motor) = motor();
        assert_eq!(bench.event(|cx| motor.run(cx, 10.0)), ["Motor.speedTarget=10", "Motor.enable=true"]);
        bench.report(&[("Motor.inverterReady", 1.0)], &mut motor);
        assert!(!motor.at_speed());
        bench.report(&[("Motor.speedActual", 9.98)], &mut motor);
        assert!(motor.at_speed());
        assert_eq!(bench.event(|cx| motor.stop(cx)), ["Motor.speedTarget=0", "Motor.enable=false"]);
        bench.report(&[("Motor.inverterReady", 0.0), ("Motor.speedActual", 0.0)], &mut motor);
        assert!(motor.at_speed());
    }

    #[test]
    fn the_encoder_counts_on_across_its_wrap() {
        let (mut bench, mut motor) = motor();
        for count in [1_500_000_000, 2_147_483_647, -2_147_483_648, -2_147_483_548] {
            bench.report(&[("Motor.encoder", f64::from(count))], &mut motor);
        }
        assert_eq!(motor.counts(), 2_147_483_748);
    }
}
