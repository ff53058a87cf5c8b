//! `kinetwin.Pusher`: a plate that a cylinder moves out and back, with a switch at each end and room for two light barriers.

use crate::device::cylinder::Cylinder;
use crate::device::law::moves;
use crate::device::law::stroke::{Drive, StrokeSettings};
use crate::device::path::Stages;
use crate::device::table::{FASTEST, LEAST, LENGTH, LONGEST_M, VELOCITY, code, indicator, number, numbers};
use crate::device::{BuildError, Device, Plate, Role, Surroundings, triple};
use crate::plant::Parameters;
use crate::prototype::kind::{KindDescriptor, ParameterDescriptor};

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.Pusher",
    summary: "a plate that extends and retracts at constant speed between two limit switches",
    ports: &[
        code("command", 0.0, 2.0, "0 hold, 1 extend, 2 retract"),
        indicator("limitExtended", "the plate is within limitTolerance of its stroke's end"),
        indicator("limitRetracted", "the plate is within limitTolerance of its start"),
        indicator("isRunning", "the plate moves faster than 1 mm/s, either way"),
        indicator("lightbarrierA", "a part cuts the beam of barrier A"),
        indicator("lightbarrierB", "a part cuts the beam of barrier B"),
    ],
    parameters: &[
        number("stroke", LENGTH, (0.001, LONGEST_M), "0.5", "way from retracted to extended"),
        number("extendSpeed", VELOCITY, (LEAST, FASTEST), "0.5", "speed of the plate on its way out"),
        number("retractSpeed", VELOCITY, (LEAST, FASTEST), "0.5", "speed of the plate on its way back"),
        number(
            "limitTolerance",
            LENGTH,
            (0.0, LONGEST_M),
            "0.002",
            "how far from an end its switch is still true, this far included",
        ),
        numbers("plateSize", LENGTH, 3, (0.001, LONGEST_M), "0.02;0.5;0.2", "thickness, width and height of the plate"),
        barrier("barrierA"),
        barrier("barrierB"),
        number("beamHeight", LENGTH, (0.0, LONGEST_M), "0.05", "height of both beams above the plate's lower edge"),
    ],
};

const fn barrier(name: &'static str) -> ParameterDescriptor {
    number(
        name,
        LENGTH,
        (-1.0, LONGEST_M),
        "-1",
        "where the barrier's beam crosses the plate's way, from the retracted front face; negative: there is none",
    )
}

const COMMAND: usize = 0;
const LIMIT_EXTENDED: usize = 1;
const LIMIT_RETRACTED: usize = 2;
const IS_RUNNING: usize = 3;
const LIGHTBARRIER_A: usize = 4;
const LIGHTBARRIER_B: usize = 5;

/// A pusher with its plate.
#[derive(Clone, Debug)]
struct Pusher {
    drive: Drive,
    cylinder: Cylinder,
    plate: Plate,
    beams: [bool; 2],
}

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let barrier = |name| Some(parameters.number(name)).filter(|place| *place >= 0.0);
    let plate = Plate {
        position: 0.0,
        displacement: 0.0,
        size: triple(parameters, "plateSize", instance)?,
        barriers: [barrier("barrierA"), barrier("barrierB")],
        beam_height: parameters.number("beamHeight"),
    };
    let cylinder = Cylinder::new(StrokeSettings {
        length: parameters.number("stroke"),
        extend_speed: parameters.number("extendSpeed"),
        retract_speed: parameters.number("retractSpeed"),
        limit_tolerance: parameters.number("limitTolerance"),
    });
    Ok(Box::new(Pusher { drive: Drive::Hold, cylinder, plate, beams: [false; 2] }))
}

impl Device for Pusher {
    /// Codes other than 0, 1 and 2 are refused before they come here; one that comes all the same changes nothing.
    fn command(&mut self, port: usize, value: f64) {
        if port == COMMAND {
            self.drive = match value {
                0.0 => Drive::Hold,
                1.0 => Drive::Extend,
                2.0 => Drive::Retract,
                _ => self.drive,
            };
            self.cylinder.command(self.drive);
        }
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.beams = [surroundings.barrier_a, surroundings.barrier_b];
        self.cylinder.loaded(surroundings.parts, surroundings.queued);
    }

    fn advance(&mut self, seconds: f64) {
        // Actuator and mechanics; the plate sits on the rod.
        self.plate.displacement = self.cylinder.advance(seconds);
        self.plate.position = self.cylinder.rod().position;
    }

    fn report(&mut self, reports: &mut [f64]) {
        reports[LIMIT_EXTENDED] = f64::from(self.cylinder.at_extended());
        reports[LIMIT_RETRACTED] = f64::from(self.cylinder.at_retracted());
        reports[IS_RUNNING] = f64::from(moves(self.cylinder.rod().velocity));
        reports[LIGHTBARRIER_A] = f64::from(self.beams[0] && self.plate.barriers[0].is_some());
        reports[LIGHTBARRIER_B] = f64::from(self.beams[1] && self.plate.barriers[1].is_some());
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(match self.drive {
            Drive::Hold => 0.0,
            Drive::Extend => 1.0,
            Drive::Retract => 2.0,
        });
        self.cylinder.state(visit);
        visit(self.plate.displacement);
        self.beams.iter().for_each(|cut| visit(f64::from(*cut)));
    }

    fn rests(&self) -> bool {
        self.cylinder.rests()
    }

    fn unchanged_for(&self) -> f64 {
        self.cylinder.unchanged_for()
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn stages(&mut self, _component: Option<&str>) -> Option<&mut Stages> {
        Some(&mut self.cylinder.stages)
    }

    /// Switches and beams look along the rod.
    fn travel(&self, port: usize) -> Option<f64> {
        let looks = [LIMIT_EXTENDED, LIMIT_RETRACTED, LIGHTBARRIER_A, LIGHTBARRIER_B].contains(&port);
        looks.then(|| self.cylinder.rod().position)
    }

    fn moving(&self) -> u32 {
        u32::from(moves(self.cylinder.rod().velocity))
    }

    fn share(&mut self, others: u32) {
        self.cylinder.shared(others);
    }

    fn joints(&self, visit: &mut dyn FnMut(&'static str, f64)) {
        visit("Spintore.T", self.plate.position);
    }

    /// The switches tell only where the plate may be.
    fn reported_joints(&self, reports: &[Option<f64>], visit: &mut dyn FnMut(&'static str, f64)) {
        let [extended, retracted] = [LIMIT_EXTENDED, LIMIT_RETRACTED].map(|port| reports[port].map(|is| is != 0.0));
        visit("Spintore.T", self.cylinder.between(extended, retracted));
    }

    fn role(&self) -> Role<'_> {
        Role::Pushes(&self.plate)
    }
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;

    fn pusher() -> Bench {
        Bench::new("kinetwin.Pusher", &[])
    }

    #[test]
    fn it_starts_retracted_and_at_rest() {
        pusher().check(&[], 1.0, &[("limitRetracted", 1.0), ("limitExtended", 0.0), ("isRunning", 0.0)]);
    }

    #[test]
    fn there_is_no_ramp() {
        pusher().check(&[("command", 1.0)], 0.0, &[("isRunning", 1.0), ("limitRetracted", 1.0)]);
        pusher().check(&[("command", 1.0)], 0.0041, &[("isRunning", 1.0), ("limitRetracted", 0.0)]);
    }

    #[test]
    fn running_means_the_actual_speed_not_the_command() {
        let mut pusher = pusher();
        pusher.check(&[("command", 1.0)], 0.99, &[("isRunning", 1.0)]);
        pusher.check(&[], 0.02, &[("isRunning", 0.0), ("limitExtended", 1.0)]);
        pusher.check(&[("command", 2.0)], 0.0, &[("isRunning", 1.0), ("limitExtended", 1.0)]);
        pusher.check(&[("command", 0.0)], 0.0, &[("isRunning", 0.0)]);
        let slow = [("extendSpeed", "0.001")];
        Bench::new("kinetwin.Pusher", &slow).check(&[("command", 1.0)], 1.0, &[("isRunning", 0.0)]);
    }

    #[test]
    fn limits_are_inclusive() {
        pusher().check(&[("command", 1.0)], 0.996, &[("limitExtended", 1.0), ("isRunning", 1.0)]);
        pusher().check(&[("command", 1.0)], 0.9959, &[("limitExtended", 0.0)]);
        pusher().check(&[("command", 1.0)], 0.004, &[("limitRetracted", 1.0)]);
    }

    #[test]
    fn other_codes_change_nothing() {
        let mut pusher = pusher();
        pusher.check(&[("command", 1.0)], 0.5, &[]);
        pusher.check(&[("command", 3.0)], 0.6, &[("limitExtended", 1.0)]);
    }

    #[test]
    fn hold_keeps_the_plate_where_it_is() {
        let mut pusher = pusher();
        pusher.check(&[("command", 1.0)], 0.5, &[]);
        pusher.check(&[("command", 0.0)], 9.0, &[("isRunning", 0.0), ("limitExtended", 0.0), ("limitRetracted", 0.0)]);
        pusher.check(&[("command", 2.0)], 0.497, &[("limitRetracted", 1.0), ("isRunning", 1.0)]);
    }

    #[test]
    fn without_barriers_they_are_constant_false() {
        let mut pusher = pusher();
        pusher.cut(true, true);
        pusher.check(&[], 1.0, &[("lightbarrierA", 0.0), ("lightbarrierB", 0.0)]);
        let mut pusher = Bench::new("kinetwin.Pusher", &[("barrierA", "0.1")]);
        pusher.cut(true, true);
        pusher.check(&[], 1.0, &[("lightbarrierA", 1.0), ("lightbarrierB", 0.0)]);
    }
}
