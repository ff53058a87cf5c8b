//! `back-pressure`: parts that queue on a belt press back on what still moves there: every queued part takes `coefficient` of
//! the way of those that are not held. A hundredth of it is always left.
//!
//! Source: the line pressure of an accumulating conveyor grows with the number of queued parts, each adding its own friction
//! (μ·m·g each), taken as a loss of way to first order.

use super::table::{BASE, ONE, parameter};
use crate::device::path::Stage;
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// The least share of its way that is left.
const LEAST: f64 = 0.01;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "back-pressure",
    summary: "parts that queue on a belt slow down what still moves there",
    equation: "part's way = max(0.01, 1 − coefficient·queued)·belt's way",
    source: "line pressure of accumulating conveyors, μ·m·g for each part queued",
    places: &[EffectPlace::Process],
    fits: &[Fit::Parts(&["StraightConveyor", "ConveyorCurve"])],
    parameters: &[parameter("coefficient", ONE, (0.0, 0.95), 0.0, 0.1, "share of its way lost for each part queued")],
    excited_by: "parts that come up while others queue",
    build: Build::Stage(|values, _| Box::new(BackPressure { coefficient: values[0], queued: 0.0 })),
    ..BASE
};

#[derive(Clone, Debug)]
struct BackPressure {
    coefficient: f64,
    queued: f64,
}

impl Stage for BackPressure {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn loaded(&mut self, _parts: f64, queued: f64) {
        self.queued = queued;
    }

    fn carried(&mut self, displacement: f64) -> f64 {
        (1.0 - self.coefficient * self.queued).max(LEAST) * displacement
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.queued);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn every_queued_part_takes_its_share_and_none_stops_the_rest() {
        let pressure = spec("process", "back-pressure", None, &[("coefficient", 0.3)]);
        let mut belt = with("StraightConveyor", &[], &[pressure]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 1.0, &[]);
        for (queued, way) in [(0, 0.5), (1, 0.35), (3, 0.05), (4, 0.005)] {
            belt.load(5, queued);
            belt.check(&[], 1.0, &[("velocityActual", 0.5)]);
            assert!((belt.displacement() - way).abs() < 1e-12, "{queued}: {}", belt.displacement());
        }
    }
}
