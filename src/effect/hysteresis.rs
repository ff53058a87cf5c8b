//! `hysteresis`: a sensor's reading depends on where it came from. A number stays until the quantity has left a band of
//! `width` about it; a switch falls only after what it looks along has moved on by `width`.
//!
//! Source: the play operator and the switch with a hysteresis (M. A. Krasnosel'skii, A. V. Pokrovskii, Systems with
//! Hysteresis, Springer 1989, sections 2 and 28; IEC 60947-5-2:2019, differential travel).

use super::play::Play;
use super::table::{BASE, ONE, parameter};
use super::way::Way;
use crate::device::path::{Moment, STEPS_STRETCH_S, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "hysteresis",
    summary: "a sensor's reading depends on where it came from",
    equation: "number: |y − x| ≤ width/2; switch: falls width later on its way",
    source: "Krasnosel'skii, Pokrovskii, Systems with Hysteresis, Springer 1989; IEC 60947-5-2:2019",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Motion)],
    parameters: &[parameter(
        "width",
        ONE,
        (0.0, 1e3),
        0.0,
        0.005,
        "the whole band, or the way, in the signal's or the way's SI unit",
    )],
    excited_by: "reversals; falling edges of switches",
    build: Build::Stage(|values, site| {
        let way = site.is_boolean().then(|| Way::new(values[0], false));
        Box::new(Hysteresis { play: Play::new(values[0]), way })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Hysteresis {
    play: Play,
    /// Of a switch.
    way: Option<Way>,
}

impl Stage for Hysteresis {
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
            None => self.play.pass(value),
        }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.play.state(visit);
        if let Some(way) = &self.way {
            way.state(visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_position_lags_by_half_the_band() {
        let band = spec("sensor", "hysteresis", Some("actualPosX"), &[("width", 0.02)]);
        let mut robot = with("CartesianRobot", &[], &[band]);
        robot.check(&[("XTarget", 0.5)], 2.0, &[("actualPosX", 0.49)]);
        robot.check(&[("XTarget", 0.485)], 2.0, &[("actualPosX", 0.49)]);
        robot.check(&[("XTarget", 0.4)], 2.0, &[("actualPosX", 0.41)]);
    }

    #[test]
    fn a_limit_switch_falls_after_its_way() {
        let band = spec("sensor", "hysteresis", Some("limitRetracted"), &[("width", 0.01)]);
        let mut pusher = with("Pusher", &[], &[band]);
        // 2 mm of tolerance and 10 mm of hysteresis at 0.5 m/s, and the millisecond in which it is seen.
        pusher.check(&[("command", 1.0)], 0.0239, &[("limitRetracted", 1.0)]);
        pusher.check(&[], 0.003, &[("limitRetracted", 0.0)]);
        pusher.check(&[("command", 2.0)], 0.0269 - 0.0039, &[("limitRetracted", 1.0)]);
    }
}
