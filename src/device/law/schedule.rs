//! The due instants of a source.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::SAME_INSTANT_S;
use super::sum::Sum;

/// When a source's parts are due: instant k at `first` + k·`interval` + a delay from 0 to `spread`, evenly at random.
///
/// The delays come from the seed and the source's name alone, one for each instant whether or not a part could be put
/// there: what happens in the plant changes no instant.
#[derive(Clone, Debug)]
pub struct Schedule {
    /// The first instant, s.
    first: f64,
    /// From one to the next without the random delay, s.
    interval: f64,
    /// The greatest delay, s.
    spread: f64,
    random: ChaCha8Rng,
    /// How many instants were given out.
    given: u64,
    /// The next instant, s.
    next: f64,
    now: Sum,
}

impl Schedule {
    /// The schedule of the source called `name` in the run with `seed`, at t = 0; times in seconds.
    pub fn new(first: f64, interval: f64, spread: f64, name: &str, seed: u64) -> Schedule {
        let random = ChaCha8Rng::from_seed(key(name, seed));
        let mut schedule = Schedule { first, interval, spread, random, given: 0, next: 0.0, now: Sum::default() };
        schedule.next = schedule.draw();
        schedule
    }

    /// Moves by `seconds` and adds the instants that fell due to `due`, each as the seconds since it, the oldest first.
    /// An instant at the end of the span belongs to it, one at its start belonged to the span before.
    pub fn advance(&mut self, seconds: f64, due: &mut Vec<f64>) {
        self.now.add(seconds);
        let now = self.now.value();
        while self.next <= now + SAME_INSTANT_S {
            due.push((now - self.next).max(0.0));
            self.given += 1;
            self.next = self.draw();
        }
    }

    fn draw(&mut self) -> f64 {
        // 53 random bits, from 0 up to 1: spelt out, so that no release of the crate can change a recorded run.
        let share = (self.random.random::<u64>() >> 11) as f64 / (1_u64 << 53) as f64;
        self.first + self.given as f64 * self.interval + share * self.spread
    }

    /// Its numbers, for a state's hash.
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.given as f64);
        visit(self.next);
        self.now.state(visit);
    }
}

/// The generator's key: the seed and the name's FNV-1a hash (Fowler, Noll, Vo; 64 bits), which is the same on every
/// machine and in every release.
fn key(name: &str, seed: u64) -> [u8; 32] {
    let hash = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key[8..16].copy_from_slice(&hash.to_le_bytes());
    key
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The instants that fall due in `steps` steps, as seconds from the start.
    fn instants(mut schedule: Schedule, step: f64, steps: u32) -> Vec<f64> {
        let mut instants = Vec::new();
        let mut due = Vec::new();
        schedule.advance(0.0, &mut due);
        instants.extend(due.iter().map(|_| 0.0));
        for k in 1..=steps {
            due.clear();
            schedule.advance(step, &mut due);
            instants.extend(due.iter().map(|age| f64::from(k) * step - age));
        }
        instants
    }

    fn check(found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-9), "{found:?} instead of {expected:?}");
    }

    #[test]
    fn every_interval_from_the_first_whatever_the_step() {
        let schedule = Schedule::new(1.0, 6.0, 0.0, "Feed", 1);
        for (step, steps) in [(0.001, 20_000), (0.02, 1000), (0.0003, 66_667), (20.0, 1)] {
            check(&instants(schedule.clone(), step, steps), &[1.0, 7.0, 13.0, 19.0]);
        }
        check(&instants(Schedule::new(0.0, 6.0, 0.0, "Feed", 1), 0.001, 6000), &[0.0, 6.0]);
    }

    #[test]
    fn an_instant_is_due_at_the_end_of_the_step_it_ends() {
        let mut schedule = Schedule::new(1.0, 6.0, 0.0, "Feed", 1);
        let mut due = Vec::new();
        for step in 0..1000 {
            assert!(due.is_empty(), "step {step}");
            schedule.advance(0.001, &mut due);
        }
        assert_eq!(due.len(), 1);
        assert!(due[0] < 1e-9);
    }

    #[test]
    fn delays_come_from_the_seed_and_the_name_alone() {
        let of = |name: &str, seed| instants(Schedule::new(1.0, 6.0, 2.0, name, seed), 0.5, 200);
        assert_eq!(of("Feed", 1), of("Feed", 1));
        assert_ne!(of("Feed", 1), of("Feed", 2));
        assert_ne!(of("Feed", 1), of("Other", 1));
        for (k, instant) in of("Feed", 1).into_iter().enumerate() {
            let delay = instant - 1.0 - 6.0 * k as f64;
            assert!((-1e-9..=2.0).contains(&delay), "{delay}");
        }
    }

    #[test]
    fn recorded_runs_keep_their_delays() {
        // Written down once: if these change, runs recorded before no longer replay.
        check(
            &instants(Schedule::new(0.0, 1.0, 1.0, "Bay1", 42), 4.0, 1),
            &[0.726410761153685, 1.2388909794964365, 2.025543515784791, 3.0037673751964475],
        );
    }
}
