//! `bounce`: a contact bounces: after every edge of the signal it opens and closes again `count` times within `time`, at
//! instants drawn at random.
//!
//! Source: contact bounce (IEC 61810-7:2006, 4.12), its instants a Poisson process's.

use super::dice::Dice;
use super::table::{BASE, ONE, TIME, parameter};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// The most that it may open again.
const MOST: usize = 8;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "bounce",
    summary: "a contact bounces after every edge",
    equation: "after an edge: count pulses of the other state within time",
    source: "IEC 61810-7:2006, 4.12",
    places: &[EffectPlace::Sensor],
    fits: &[Fit::Signals(SignalClass::Boolean)],
    parameters: &[
        parameter("time", TIME, (0.0, 1.0), 0.0, 0.01, "how long it bounces"),
        parameter("count", ONE, (0.0, 8.0), 0.0, 2.0, "how often it opens again"),
    ],
    excited_by: "edges of the signal, seen at a fine cycle",
    build: Build::Stage(|values, site| {
        Box::new(Bounce {
            time: values[0],
            count: values[1].round() as usize,
            dice: Dice::new(site.seed),
            entry: None,
            edges: 0,
            instants: [0.0; 2 * MOST],
            passed: 2 * MOST,
        })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Bounce {
    time: f64,
    count: usize,
    dice: Dice,
    entry: Option<f64>,
    edges: u64,
    /// When it opens and closes after the last edge, in order.
    instants: [f64; 2 * MOST],
    /// How many of them have passed.
    passed: usize,
}

impl Stage for Bounce {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn next_change(&self) -> Option<f64> {
        self.instants[..2 * self.count].get(self.passed).copied()
    }

    fn signal(&mut self, value: f64, Moment { now, .. }: Moment) -> f64 {
        let toggles = 2 * self.count;
        if self.entry.replace(value).is_some_and(|before| before != value) {
            self.edges += 1;
            self.passed = 0;
            for (index, instant) in self.instants[..toggles].iter_mut().enumerate() {
                let draw = self.edges * (2 * MOST) as u64 + index as u64;
                *instant = now + self.time * self.dice.uniform(draw);
            }
            self.instants[..toggles].sort_by(f64::total_cmp);
        }
        while self.passed < toggles && self.instants[self.passed] <= now + SAME_INSTANT_S {
            self.passed += 1;
        }
        // After an odd number it is open though it should be closed.
        if self.passed < toggles && self.passed % 2 == 1 { 1.0 - value } else { value }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.entry.into_iter().for_each(&mut *visit);
        visit(self.edges as f64);
        visit(self.passed as f64);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn after_an_edge_it_opens_so_often_and_no_longer() {
        let bounce = spec("sensor", "bounce", Some("lightBarrierA"), &[("time", 0.02), ("count", 3.0)]);
        let mut belt = with("StraightConveyor", &[], &[bounce]);
        belt.check(&[], 0.1, &[("lightBarrierA", 0.0)]);
        belt.cut(true, false);
        let (mut opened, mut last) = (0, 1.0);
        for step in 0..4000 {
            let now = belt.report("lightBarrierA");
            opened += u32::from(now < last);
            assert!(step < 2000 || now == 1.0, "step {step}");
            last = now;
            belt.device.advance(1e-5);
        }
        assert_eq!(opened, 3);
    }
}
