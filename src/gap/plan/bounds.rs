//! What a machine may be asked to do: position, speed and acceleration of a command.

use crate::gap::{Recording, Stamped};
use crate::prototype::quantity::to_si;
use crate::signal_map::{RegisterId, Signal};

/// The bounds of a command that takes any value, in the SI unit of the signal, and of its changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub least: f64,
    pub greatest: f64,
    /// The fastest change, for each second; infinite where it may jump.
    pub speed: f64,
    /// The fastest change of that, for each s²; infinite where its speed may jump.
    pub acceleration: f64,
}

/// Commands closer to one another than this belong to one motion that was streamed, s.
const STREAMED_S: f64 = 0.1;
/// Of a command's range: a change as large as this, all at once, is a jump.
const JUMP: f64 = 0.2;

impl Bounds {
    /// Those that the signal declares, where it declares them; else those of what it was asked in `recordings`. `None` where
    /// neither says anything.
    pub fn of(signal: &Signal, recordings: &[&[Stamped]]) -> Option<Bounds> {
        let asked = Bounds::asked(recordings);
        let declared = |bound: Option<f64>| bound.map(|bound| to_si(bound, signal.unit));
        let least = declared(signal.min).or(asked.map(|asked| asked.least))?;
        let greatest = declared(signal.max).or(asked.map(|asked| asked.greatest))?;
        let free = Bounds { least, greatest, speed: f64::INFINITY, acceleration: f64::INFINITY };
        Some(asked.map_or(free, |asked| Bounds { least, greatest, ..asked }))
            .filter(|bounds| bounds.greatest > bounds.least)
    }

    /// What was asked: a machine that did it once can do it again.
    fn asked(recordings: &[&[Stamped]]) -> Option<Bounds> {
        let values = || recordings.iter().flat_map(|run| run.iter().map(|stamped| stamped.value));
        let least = values().fold(f64::INFINITY, f64::min);
        let greatest = values().fold(f64::NEG_INFINITY, f64::max);
        if greatest.partial_cmp(&least) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        let pairs = || recordings.iter().flat_map(|run| run.windows(2)).map(|pair| (pair[0], pair[1]));
        let jumps = pairs().any(|(a, b)| (b.value - a.value).abs() >= JUMP * (greatest - least));
        if jumps {
            return Some(Bounds { least, greatest, speed: f64::INFINITY, acceleration: f64::INFINITY });
        }
        let mut slopes: Vec<Vec<(f64, f64)>> = Vec::new();
        for run in recordings {
            let streamed = run.windows(2).filter(|pair| (1e-6..STREAMED_S).contains(&(pair[1].at - pair[0].at)));
            slopes.push(
                streamed
                    .map(|pair| (pair[1].at, (pair[1].value - pair[0].value) / (pair[1].at - pair[0].at)))
                    .collect(),
            );
        }
        let speed = slopes.iter().flatten().map(|(_, slope)| slope.abs()).fold(0.0, f64::max);
        let changes = slopes.iter().flat_map(|run| run.windows(2));
        let accelerations = changes.filter(|pair| pair[1].0 - pair[0].0 < 2.0 * STREAMED_S);
        let acceleration = accelerations.map(|pair| ((pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).abs());
        let acceleration = acceleration.fold(0.0, f64::max);
        let or_free = |bound: f64| if bound > 0.0 { bound } else { f64::INFINITY };
        Some(Bounds { least, greatest, speed: or_free(speed), acceleration: or_free(acceleration) })
    }

    /// The same, where the value may jump.
    pub fn jumping(self) -> Bounds {
        Bounds { speed: f64::INFINITY, acceleration: f64::INFINITY, ..self }
    }

    /// What lies at −1 to 1 of a shape.
    pub fn at(&self, shape: f64) -> f64 {
        0.5 * (self.least + self.greatest) + 0.5 * shape * (self.greatest - self.least)
    }

    /// Samples `wanted` every `every` seconds for `span` seconds, from `start`, within the bounds: the nearest motion that
    /// brakes in time for where it is wanted.
    pub fn follow(&self, wanted: impl Fn(f64) -> f64, start: f64, span: f64, every: f64) -> Vec<(f64, f64)> {
        let (mut position, mut speed) = (start, 0.0_f64);
        let steps = (span / every).round() as usize;
        let mut motion = Vec::with_capacity(steps);
        for step in 0..steps {
            let at = step as f64 * every;
            let goal = wanted(at).clamp(self.least, self.greatest);
            let way = goal - position;
            let most = self.acceleration * every;
            speed += (way.signum() * self.braking(way.abs(), every) - speed).clamp(-most, most);
            position = (position + speed * every).clamp(self.least, self.greatest);
            motion.push((at, position));
        }
        motion
    }
}

impl Bounds {
    /// The greatest speed from which it can still be stopped within `way`, when a step of `every` goes by before it brakes:
    /// v·every + v²/2a = way.
    fn braking(&self, way: f64, every: f64) -> f64 {
        let speed = match self.acceleration.is_finite() {
            true => self.acceleration * ((every * every + 2.0 * way / self.acceleration).sqrt() - every),
            false => way / every,
        };
        speed.min(self.speed).min(way / every)
    }
}

/// What recordings asked of a command.
pub fn asked(recordings: &[Recording], register: RegisterId) -> Vec<&[Stamped]> {
    recordings.iter().map(|recording| recording.values(register)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamped(values: &[(f64, f64)]) -> Vec<Stamped> {
        values.iter().map(|&(at, value)| Stamped { at, value }).collect()
    }

    #[test]
    fn a_machine_that_was_asked_to_jump_may_jump() {
        let run = stamped(&[(0.0, 0.0), (1.0, 0.5), (3.0, -0.5)]);
        let bounds = Bounds::asked(&[&run]).expect("it moves");
        assert_eq!((bounds.least, bounds.greatest, bounds.speed), (-0.5, 0.5, f64::INFINITY));
    }

    #[test]
    fn a_motion_that_was_streamed_bounds_speed_and_acceleration() {
        let run: Vec<Stamped> =
            (0..500).map(|i| f64::from(i) * 0.02).map(|at| Stamped { at, value: (2.0 * at).sin() }).collect();
        let bounds = Bounds::asked(&[&run]).expect("it moves");
        assert!((bounds.speed - 2.0).abs() < 0.01 && (bounds.acceleration - 4.0).abs() < 0.05, "{bounds:?}");
        assert_eq!(Bounds::asked(&[&stamped(&[(0.0, 1.0), (1.0, 1.0)])]), None);
    }

    #[test]
    fn what_follows_keeps_every_bound() {
        let bounds = Bounds { least: -0.4, greatest: 0.6, speed: 0.5, acceleration: 2.0 };
        let wanted = |t: f64| if (t as u32 / 4).is_multiple_of(2) { 1.0 } else { -1.0 };
        let motion = bounds.follow(wanted, 0.0, 12.0, 0.01);
        let speeds: Vec<f64> = motion.windows(2).map(|pair| (pair[1].1 - pair[0].1) / 0.01).collect();
        let accelerations = speeds.windows(2).map(|pair| ((pair[1] - pair[0]) / 0.01).abs());
        assert!(motion.iter().all(|(_, x)| (-0.4..=0.6).contains(x)));
        assert!(speeds.iter().all(|speed| speed.abs() <= 0.5 + 1e-9));
        assert!(accelerations.fold(0.0, f64::max) <= 2.0 + 1e-6);
        assert!(
            motion.iter().any(|(_, x)| *x > 0.59) && motion.iter().any(|(_, x)| *x < -0.39),
            "it goes where it can"
        );
        let free = Bounds { speed: f64::INFINITY, acceleration: f64::INFINITY, ..bounds };
        assert_eq!(free.follow(wanted, 0.0, 0.05, 0.01)[0].1, 0.6, "where it may jump it jumps");
    }
}
