//! `end-cushioning`: over the last `length` before either end of its stroke a cylinder moves at `ratio` times its speed: its
//! exhaust is throttled there.
//!
//! Source: pneumatic end cushioning with a constant throttle (P. Beater, Pneumatic Drives, Springer 2007, cushioning), its
//! transient left out.

use super::table::{BASE, LENGTH, ONE, parameter};
use crate::device::law::is_there;
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "end-cushioning",
    summary: "before its ends a cylinder slows down",
    equation: "way to the end ≤ length: v = ratio·v",
    source: "Beater, Pneumatic Drives, Springer 2007 (cushioning)",
    places: &[EffectPlace::Actuator],
    fits: &[Fit::Drives(&["Pusher"])],
    parameters: &[
        parameter("length", LENGTH, (0.0, 1e3), 0.0, 0.05, "way before the end from which on it is slower"),
        parameter("ratio", ONE, (0.01, 1.0), 1.0, 0.4, "share of its speed that is left there"),
    ],
    excited_by: "whole strokes, and the time from the last of it to the switch",
    build: Build::Stage(|values, site| {
        let stroke = site.parameters.number("stroke");
        Box::new(EndCushioning { length: values[0], ratio: values[1], stroke, entry: None })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct EndCushioning {
    length: f64,
    ratio: f64,
    stroke: f64,
    /// When it will come to its cushion, if nothing changes, s.
    entry: Option<f64>,
}

impl Stage for EndCushioning {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn reference(&mut self, reference: f64, motion: Motion, moment: Moment) -> f64 {
        let left = if reference < 0.0 { motion.position } else { self.stroke - motion.position };
        let until = left - self.length;
        if is_there(until, reference) {
            self.entry = None;
            return self.ratio * reference;
        }
        self.entry = Some(moment.now + until / reference.abs());
        reference
    }

    fn next_change(&self) -> Option<f64> {
        self.entry
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.entry.into_iter().for_each(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn the_last_of_the_way_takes_longer() {
        // 0.4 m at 0.5 m/s, then 0.1 m less the switch's 2 mm at 0.2 m/s; and so back.
        let cushion = spec("actuator", "end-cushioning", None, &[("length", 0.1), ("ratio", 0.4)]);
        let mut pusher = with("Pusher", &[], &[cushion]);
        for (command, limit) in [(1.0, "limitExtended"), (2.0, "limitRetracted")] {
            // It leaves an end as it would without: the cushion's valve is a check valve.
            pusher.check(&[("command", command)], 0.8 + 0.49 - 1e-6, &[(limit, 0.0)]);
            pusher.check(&[], 2e-6, &[(limit, 1.0)]);
            pusher.check(&[], 1.0, &[("isRunning", 0.0)]);
        }
    }
}
