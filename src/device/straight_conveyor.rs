//! `kinetwin.StraightConveyor`: a belt that carries parts along a straight line, with a light barrier near each end.

use crate::device::conveyor::{self, Conveyor};
use crate::device::table::{LENGTH, LONGEST_M, number};
use crate::device::{BuildError, Device, Surface};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.StraightConveyor",
    summary: "a straight belt with a ramped drive and two light barriers",
    ports: conveyor::PORTS,
    parameters: &[
        number("length", LENGTH, (0.01, LONGEST_M), "2.0", "length of the belt, from x = 0 of its instance"),
        conveyor::WIDTH,
        conveyor::DRIVE_ACCELERATION,
        conveyor::DRIVE_DECELERATION,
        conveyor::COAST,
        conveyor::COAST_DECELERATION,
        conveyor::READY_DELAY,
        conveyor::barrier("barrierA", "0.3"),
        conveyor::barrier("barrierB", "1.7"),
        conveyor::BEAM_HEIGHT,
        conveyor::TRANSFER,
    ],
};

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let surface = Surface::Straight { length: parameters.number("length"), width: parameters.number("width") };
    Ok(Box::new(Conveyor::new(surface, parameters, instance)?))
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;

    fn belt() -> Bench {
        Bench::new("kinetwin.StraightConveyor", &[])
    }

    #[test]
    fn at_rest_until_told_otherwise() {
        belt().check(
            &[],
            5.0,
            &[("velocityActual", 0.0), ("driveEnabled", 0.0), ("driveRunning", 0.0), ("directionalActual", 0.0)],
        );
    }

    #[test]
    fn the_velocity_tends_to_direction_times_target() {
        let commands = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        belt().check(&commands, 0.2, &[("velocityActual", 0.2)]);
        belt().check(&commands, 2.0, &[("velocityActual", 0.5), ("driveRunning", 1.0), ("directionalActual", 1.0)]);
        let mut moved = belt();
        moved.check(&commands, 2.0, &[]);
        assert!((moved.displacement() - 0.875).abs() < 1e-12);
    }

    #[test]
    fn the_sign_of_direction_times_target_counts() {
        for (target, direction, velocity) in [(0.5, -1.0, -0.5), (-0.5, 1.0, -0.5), (-0.5, -1.0, 0.5)] {
            let commands = [("velocityTarget", target), ("motorDirection", direction)];
            let sign = ("directionalActual", f64::signum(velocity));
            belt().check(&commands, 1.0, &[("velocityActual", velocity), sign, ("driveEnabled", 1.0)]);
        }
    }

    #[test]
    fn with_direction_0_the_belt_ramps_down() {
        let mut belt = belt();
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 1.0, &[]);
        belt.check(&[("motorDirection", 0.0)], 0.3, &[("velocityActual", 0.2), ("driveEnabled", 0.0)]);
        belt.check(&[], 0.3, &[("velocityActual", 0.0), ("driveRunning", 0.0)]);
    }

    #[test]
    fn the_drive_is_enabled_at_once() {
        belt().check(&[("motorDirection", -1.0)], 0.0, &[("driveEnabled", 1.0), ("driveRunning", 0.0)]);
    }

    #[test]
    fn one_millimetre_a_second_is_not_running() {
        let commands = [("velocityTarget", 0.001), ("motorDirection", 1.0)];
        belt().check(&commands, 1.0, &[("velocityActual", 0.001), ("driveRunning", 0.0), ("directionalActual", 0.0)]);
        let commands = [("velocityTarget", 0.00101), ("motorDirection", -1.0)];
        belt().check(&commands, 1.0, &[("driveRunning", 1.0), ("directionalActual", -1.0)]);
    }

    #[test]
    fn deceleration_coast_and_ready_delay_are_options() {
        let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        let mut belt = Bench::new("kinetwin.StraightConveyor", &[("deceleration", "2")]);
        belt.check(&run, 1.0, &[]);
        belt.check(&[("velocityTarget", 0.1)], 0.1, &[("velocityActual", 0.3)]);
        let mut belt = Bench::new("kinetwin.StraightConveyor", &[("coast", "true"), ("coastDeceleration", "0.1")]);
        belt.check(&run, 1.0, &[]);
        belt.check(&[("motorDirection", 0.0)], 1.0, &[("velocityActual", 0.4)]);
        let mut belt = Bench::new("kinetwin.StraightConveyor", &[("readyDelay", "0.2")]);
        belt.check(&run, 0.1, &[("velocityActual", 0.0), ("driveEnabled", 0.0)]);
        belt.check(&[], 0.2, &[("velocityActual", 0.1), ("driveEnabled", 1.0)]);
    }

    #[test]
    fn a_barrier_is_true_while_a_part_cuts_its_beam() {
        let mut belt = belt();
        belt.cut(true, false);
        belt.check(&[], 0.0, &[("lightBarrierA", 1.0), ("lightBarrierB", 0.0)]);
        belt.cut(false, true);
        belt.check(&[], 0.0, &[("lightBarrierA", 0.0), ("lightBarrierB", 1.0)]);
        let mut blind = Bench::new("kinetwin.StraightConveyor", &[("barrierA", "-1")]);
        blind.cut(true, true);
        blind.check(&[], 0.0, &[("lightBarrierA", 0.0), ("lightBarrierB", 1.0)]);
    }

    #[test]
    fn a_barrier_beyond_the_belt_is_refused() {
        let error = Bench::error("kinetwin.StraightConveyor", &[("length", "1.5")]);
        assert_eq!(error, "Device1: barrierB stands at 1.7 m of a belt that is 1.5 m long");
    }
}
