//! A belt with boxes and two light barriers.

use crate::belt_drive::BeltDrive;
use crate::chance::Dice;
use crate::plant::Device;
use crate::quirk::{Quirk, Quirks};
use crate::sensor::Along;

/// What a belt and the bay that feeds it are built to.
#[derive(Clone, Debug)]
pub struct BeltParameters {
    pub length: f64,
    pub acceleration: f64,
    pub barriers: [f64; 2],
    /// Of the boxes: length, where their centres are put, the first one's instant, and the time between two.
    pub box_length: f64,
    pub box_at: f64,
    pub first: f64,
    pub interval: f64,
}

/// A belt whose boxes leave at its ends.
#[derive(Clone, Debug)]
pub struct Belt {
    parameters: BeltParameters,
    drive: BeltDrive,
    travel: f64,
    /// Boxes follow no steeper change of speed than this.
    grip: f64,
    boxes: Vec<Box>,
    put: usize,
    beams: [Along; 2],
    /// How much of a box each barrier misses at either end.
    hidden: [f64; 2],
    /// Boxes stick, once each, for about so long.
    sticks: Option<f64>,
    dice: Dice,
}

#[derive(Clone, Debug)]
struct Box {
    centre: f64,
    speed: f64,
    /// Where it will stick, and until when it does.
    sticks_at: f64,
    stuck_until: f64,
}

impl Belt {
    /// A belt called `name`, fed by the bay `feed`, at rest.
    pub fn new(parameters: &BeltParameters, quirks: &[Quirk], name: &str, feed: &str, seed: u64) -> Belt {
        let (all, bay) = (Quirks::of(quirks, name), Quirks::of(quirks, feed));
        let mut parameters = parameters.clone();
        parameters.acceleration = all.parameter("acceleration", parameters.acceleration);
        parameters.barriers[0] = all.parameter("barrierA", parameters.barriers[0]);
        parameters.barriers[1] = all.parameter("barrierB", parameters.barriers[1]);
        parameters.box_length += bay.value("part-length-error", "length").unwrap_or(0.0);
        parameters.interval += bay.value("part-spacing-error", "time").unwrap_or(0.0);
        let beams = ["lightBarrierA", "lightBarrierB"];
        Belt {
            drive: BeltDrive::new(parameters.acceleration, all),
            travel: 0.0,
            grip: all.value("part-slip", "acceleration").unwrap_or(f64::INFINITY),
            boxes: Vec::new(),
            put: 0,
            beams: beams.map(|beam| Along::new(all, beam, false)),
            hidden: beams.map(|beam| all.on(beam).value("x-is-half-hidden", "length").unwrap_or(0.0)),
            sticks: all.value("x-boxes-stick", "time"),
            dice: Dice::new(seed, 11),
            parameters,
        }
    }

    fn feed(&mut self, now: f64) {
        let due = self.parameters.first + self.put as f64 * self.parameters.interval;
        if now + 1e-9 < due {
            return;
        }
        self.put += 1;
        let BeltParameters { box_at, box_length, .. } = self.parameters;
        if self.boxes.iter().all(|other| (other.centre - box_at).abs() >= box_length) {
            let speed = self.drive.belt_speed();
            let sticks_at = self.dice.between(0.4, 1.5);
            self.boxes.push(Box { centre: box_at, speed, sticks_at, stuck_until: 0.0 });
        }
    }

    fn carry(&mut self, now: f64, span: f64, way: f64) {
        let (length, speed) = (self.parameters.length, self.drive.belt_speed());
        for carried in &mut self.boxes {
            if let Some(time) = self.sticks
                && carried.centre >= carried.sticks_at
            {
                carried.sticks_at = f64::INFINITY;
                carried.stuck_until = now + time * self.dice.between(0.5, 1.5);
            }
            if now < carried.stuck_until {
                continue;
            }
            if self.grip.is_infinite() {
                carried.centre += way;
                continue;
            }
            let before = carried.speed;
            let step = self.grip * span * (1.0 + 1e-9);
            carried.speed += (speed - before).clamp(-step, step);
            carried.centre += if carried.speed == speed { way } else { 0.5 * (before + carried.speed) * span };
        }
        self.boxes.retain(|carried| (0.0..=length).contains(&carried.centre));
    }

    fn look(&mut self) {
        for (at, beam) in self.beams.iter_mut().enumerate() {
            let half = 0.5 * self.parameters.box_length - self.hidden[at];
            let place = self.parameters.barriers[at];
            let cut = self.boxes.iter().any(|carried| (carried.centre - place).abs() < half);
            beam.see(cut, self.travel);
        }
    }
}

impl Device for Belt {
    fn command(&mut self, now: f64, port: &str, value: f64) {
        self.drive.command(now, port, value);
    }

    fn advance(&mut self, now: f64, span: f64, others: usize) {
        self.feed(now - span);
        let way = self.drive.advance(now, span, self.boxes.len(), others);
        self.travel += way;
        self.carry(now, span, way);
        self.look();
    }

    fn read(&self, _now: f64, values: &mut Vec<f64>) {
        self.drive.read(values);
        values.extend([self.beams[0].is_on(), self.beams[1].is_on()].map(f64::from));
    }

    fn moving(&self) -> usize {
        usize::from(self.drive.moves())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{axis_quirk, quirk};

    fn parameters() -> BeltParameters {
        BeltParameters {
            length: 2.0,
            acceleration: 1.0,
            barriers: [0.3, 1.7],
            box_length: 0.3,
            box_at: 0.15,
            first: 1.0,
            interval: 6.0,
        }
    }

    /// The instants at which barrier B changes while the belt runs at 0.5 m/s from 0 on.
    fn edges(quirks: &[Quirk]) -> Vec<f64> {
        let mut belt = Belt::new(&parameters(), quirks, "B", "F", 1);
        belt.command(0.0, "velocityTarget", 0.5);
        belt.command(0.0, "motorDirection", 1.0);
        let (mut values, mut was, mut found) = (Vec::new(), 0.0, Vec::new());
        for k in 1..=70_000 {
            let now = f64::from(k) * 1e-4;
            belt.advance(now, 1e-4, 0);
            values.clear();
            belt.read(now, &mut values);
            if values[5] != was {
                was = values[5];
                found.push(now);
            }
        }
        found
    }

    #[test]
    fn a_box_cuts_the_beam_when_way_and_speed_say() {
        let check = |quirks: &[Quirk], expected: [f64; 2]| {
            let found = edges(quirks);
            assert!(found.len() == 2 && found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 2e-4), "{found:?}");
        };
        // It is put at 1 s, its front at 0.3: 1.4 m at 0.5 m/s.
        check(&[], [3.8, 4.4]);
        check(&[quirk("B", "belt-slip", &[("ratio", 0.1)])], [1.0 + 1.4 / 0.45, 1.0 + 1.7 / 0.45]);
        check(&[quirk("F", "part-length-error", &[("length", 0.04)])], [3.76, 4.44]);
        check(&[axis_quirk("B", "lightBarrierB", "blind-range", &[("length", 0.02)])], [3.84, 4.4]);
        check(&[axis_quirk("B", "lightBarrierB", "x-is-half-hidden", &[("length", 0.02)])], [3.84, 4.36]);
        check(&[quirk("B", "load-dependent-speed", &[("coefficient", 0.2)])], [4.5 - 0.0125, 5.25 - 0.0125]);
    }
}
