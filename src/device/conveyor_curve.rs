//! `kinetwin.ConveyorCurve`: a belt that carries parts along an arc; its speed is that of the centre line.

use crate::device::conveyor::{self, Conveyor};
use crate::device::table::{ANGLE, LENGTH, LONGEST_M, number};
use crate::device::{BuildError, Device, Surface, misfit};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.ConveyorCurve",
    summary: "a curved belt with a ramped drive and two light barriers",
    ports: conveyor::PORTS,
    parameters: &[
        number("radius", LENGTH, (0.01, LONGEST_M), "1.0", "radius of the centre line"),
        number(
            "angle",
            ANGLE,
            (-std::f64::consts::TAU, std::f64::consts::TAU),
            "1.5707963267948966",
            "angle the belt turns by from the x direction, to the left if positive; not 0",
        ),
        conveyor::WIDTH,
        conveyor::DRIVE_ACCELERATION,
        conveyor::DRIVE_DECELERATION,
        conveyor::COAST,
        conveyor::COAST_DECELERATION,
        conveyor::READY_DELAY,
        conveyor::barrier("barrierA", "0.2"),
        conveyor::barrier("barrierB", "1.3"),
        conveyor::BEAM_HEIGHT,
        conveyor::TRANSFER,
    ],
};

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let [radius, angle, width] = ["radius", "angle", "width"].map(|name| parameters.number(name));
    if angle == 0.0 {
        return Err(misfit(instance, "angle", "is 0: a conveyor that does not turn is a StraightConveyor"));
    }
    if width > 2.0 * radius {
        let problem = format!("is {width} m, more than twice the radius of {radius} m: the belt would lie on itself");
        return Err(misfit(instance, "width", problem));
    }
    Ok(Box::new(Conveyor::new(Surface::Curve { radius, angle, width }, parameters, instance)?))
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;

    #[test]
    fn the_velocity_is_that_of_the_centre_line() {
        let mut curve = Bench::new("kinetwin.ConveyorCurve", &[("radius", "2"), ("acceleration", "0.5")]);
        let commands = [("velocityTarget", 0.5), ("motorDirection", -1.0)];
        curve.check(&commands, 2.0, &[("velocityActual", -0.5), ("directionalActual", -1.0)]);
        assert!((curve.displacement() + 0.75).abs() < 1e-12);
    }

    #[test]
    fn a_shape_that_cannot_be_is_refused() {
        let check = |parameter, expected| {
            assert_eq!(Bench::error("kinetwin.ConveyorCurve", &[parameter]), format!("Device1: {expected}"));
        };
        check(("angle", "0"), "angle is 0: a conveyor that does not turn is a StraightConveyor");
        check(("width", "3"), "width is 3 m, more than twice the radius of 1 m: the belt would lie on itself");
        check(("angle", "-0.5"), "barrierB stands at 1.3 m of a belt that is 0.5 m long");
    }
}
