//! `blind-range`: a sensor does not see what is too near. A number reads 0 below `length`; a switch rises only after what it
//! looks along has moved on by `length`.
//!
//! Source: the blind zone of ranging sensors (IEC 60947-5-7:2003, 3.1).

use super::table::{BASE, ONE, parameter};
use super::way::Way;
use crate::device::path::{Moment, STEPS_STRETCH_S, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "blind-range",
    summary: "a sensor does not see what is too near",
    equation: "number: |x| < length: y = 0; switch: rises length later on its way",
    source: "IEC 60947-5-7:2003, 3.1",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Motion)],
    parameters: &[parameter("length", ONE, (0.0, 1e3), 0.0, 0.01, "the range, in the signal's or the way's SI unit")],
    excited_by: "readings near 0; rising edges of switches",
    build: Build::Stage(|values, site| {
        let way = site.is_boolean().then(|| Way::new(values[0], true));
        Box::new(BlindRange { length: values[0], way })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct BlindRange {
    length: f64,
    /// Of a switch.
    way: Option<Way>,
}

impl Stage for BlindRange {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        if self.way.is_some() { STEPS_STRETCH_S } else { STRETCH_S }
    }

    fn next_change(&self) -> Option<f64> {
        self.way.as_ref().and_then(Way::next)
    }

    fn travelled(&mut self, travel: f64) {
        if let Some(way) = &mut self.way {
            way.travelled(travel);
        }
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        match &mut self.way {
            Some(way) => f64::from(u8::from(way.pass(value != 0.0, moment.now))),
            None => {
                if value.abs() < self.length {
                    0.0
                } else {
                    value
                }
            }
        }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        if let Some(way) = &self.way {
            way.state(visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn what_is_too_near_reads_0() {
        let blind = spec("sensor", "blind-range", Some("actualPosX"), &[("length", 0.1)]);
        let mut robot = with("CartesianRobot", &[], &[blind]);
        robot.check(&[("XTarget", 0.09)], 2.0, &[("actualPosX", 0.0)]);
        robot.check(&[("XTarget", 0.11)], 2.0, &[("actualPosX", 0.11)]);
    }

    #[test]
    fn a_light_barrier_sees_a_part_after_its_way() {
        let blind = spec("sensor", "blind-range", Some("lightBarrierA"), &[("length", 0.01)]);
        let mut belt = with("StraightConveyor", &[], &[blind]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 1.0, &[("lightBarrierA", 0.0)]);
        belt.cut(true, false);
        belt.check(&[], 0.0, &[("lightBarrierA", 0.0)]);
        belt.check(&[], 0.019, &[("lightBarrierA", 0.0)]);
        belt.check(&[], 0.002, &[("lightBarrierA", 1.0)]);
    }
}
