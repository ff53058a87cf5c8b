//! Sensors that look at parts: `kinetwin.BoxSensor`, `kinetwin.ProximitySensor`, `kinetwin.VisionSensor`. They look from the frame
//! of their instance, which is level, and see parts alone.

use crate::device::table::{LENGTH, LONGEST_M, indicator, measure, number, numbers, state};
use crate::device::{BuildError, Device, Look, Role, Sensed, Surroundings, triple};
use crate::plant::{Parameters, PartKind};
use crate::prototype::kind::{KindDescriptor, ParameterDescriptor, PortDescriptor};
use crate::scene::part_colour;

/// The most parts that a sensor counts.
const MOST: f64 = 1e6;

const DETECTED: PortDescriptor = indicator("detected", "a part is where the sensor looks");
const BOX_POSITION: ParameterDescriptor = numbers(
    "boxPosition",
    LENGTH,
    3,
    (-LONGEST_M, LONGEST_M),
    "0;0;0",
    "centre of the box that it looks into: x, y, z in its frame",
);
const BOX_DIMENSIONS: ParameterDescriptor =
    numbers("boxDimensions", LENGTH, 3, (0.001, LONGEST_M), "0.1;0.1;0.1", "size of that box: x, y, z");

/// The box sensor's table.
pub static BOX: KindDescriptor = KindDescriptor {
    name: "kinetwin.BoxSensor",
    summary: "sees the parts that are in a box",
    ports: &[DETECTED, state("count", 0.0, MOST, "how many parts are in the box, touching it not counted")],
    parameters: &[BOX_POSITION, BOX_DIMENSIONS],
};

/// The proximity sensor's table.
pub static PROXIMITY: KindDescriptor = KindDescriptor {
    name: "kinetwin.ProximitySensor",
    summary: "measures how far the nearest part before it is, along its x axis",
    ports: &[DETECTED, measure("distance", LENGTH, "how far the nearest part is; the range where there is none")],
    parameters: &[number("range", LENGTH, (0.001, LONGEST_M), "0.1", "how far it looks along x")],
};

/// The vision sensor's table.
pub static VISION: KindDescriptor = KindDescriptor {
    name: "kinetwin.VisionSensor",
    summary: "says what kind of part is in its window, and of what colour",
    ports: &[
        DETECTED,
        state("kind", 0.0, 2.0, "the part nearest to the window's centre: 1 a box, 2 a pallet; 0 where there is none"),
        state(
            "colour",
            0.0,
            16_777_215.0,
            "its colour as 65536 red + 256 green + blue, each 0 to 255; 0 where there is none",
        ),
    ],
    parameters: &[BOX_POSITION, BOX_DIMENSIONS],
};

/// What a sensor reports of what it sees, behind `detected`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reports {
    Count,
    Distance,
    Kind,
}

/// A sensor.
#[derive(Clone, Debug)]
struct Sensor {
    look: Look,
    reports: Reports,
    sensed: Sensed,
}

/// Builds one of the three.
pub(super) fn build(kind: &str, parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let reports = match kind {
        "kinetwin.BoxSensor" => Reports::Count,
        "kinetwin.ProximitySensor" => Reports::Distance,
        _ => Reports::Kind,
    };
    let look = match reports {
        Reports::Distance => Look::Ray { range: parameters.number("range") },
        _ => Look::Box {
            centre: triple(parameters, "boxPosition", instance)?,
            size: triple(parameters, "boxDimensions", instance)?,
        },
    };
    Ok(Box::new(Sensor { look, reports, sensed: Sensed::default() }))
}

/// As the port has it: 65536 red + 256 green + blue.
fn colour(kind: PartKind) -> f64 {
    part_colour(kind).iter().fold(0.0, |sum, channel| sum * 256.0 + f64::from(*channel))
}

impl Device for Sensor {
    fn command(&mut self, _port: usize, _value: f64) {}

    fn sense(&mut self, surroundings: &Surroundings) {
        self.sensed = surroundings.sensed;
    }

    fn advance(&mut self, _seconds: f64) {}

    fn report(&mut self, reports: &mut [f64]) {
        let Sensed { count, distance, nearest } = self.sensed;
        reports[0] = f64::from(count > 0);
        match (self.reports, &self.look) {
            (Reports::Count, _) => reports[1] = f64::from(count),
            (Reports::Distance, Look::Ray { range }) => reports[1] = distance.unwrap_or(*range),
            (Reports::Distance, _) => {}
            (Reports::Kind, _) => {
                reports[1] = match nearest {
                    None => 0.0,
                    Some(PartKind::Box) => 1.0,
                    Some(PartKind::Pallet) => 2.0,
                };
                reports[2] = nearest.map_or(0.0, colour);
            }
        }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(f64::from(self.sensed.count));
        visit(self.sensed.distance.unwrap_or(-1.0));
    }

    fn rests(&self) -> bool {
        true
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn role(&self) -> Role<'_> {
        Role::Looks(&self.look)
    }
}
