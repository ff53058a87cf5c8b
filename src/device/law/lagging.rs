//! A speed that follows what is asked of it as a first-order lag, and the way that is gone meanwhile:
//!
//! ```text
//! T·dv/dt + v = w,   dx/dt = v   ⇒   v = w + (v₀ − w)·e^(−t/T),   x = x₀ + w·t + (v₀ − w)·T·(1 − e^(−t/T))
//! ```
//!
//! Source: the first-order lag (K. J. Åström, T. Hägglund, Advanced PID Control, ISA 2006, section 2.4).

use crate::device::path::Motion;

/// How often the instant at which a place is reached is halved: to the last digits of a time.
const HALVINGS: u32 = 60;
/// After so many time constants nothing of the speed at first is left.
const LONG: f64 = 50.0;

/// A motion under way, and what is asked of it.
#[derive(Clone, Copy, Debug)]
pub struct Lagging {
    pub from: Motion,
    /// m/s.
    pub asked: f64,
    /// s, above 0.
    pub time_constant: f64,
}

impl Lagging {
    /// Where it is after `seconds`, and how fast.
    pub fn after(&self, seconds: f64) -> Motion {
        let Lagging { from, asked, time_constant } = *self;
        let ahead = from.velocity - asked;
        // 1 − e^(−t/T), whole for short times too.
        let done = -(-seconds / time_constant).exp_m1();
        Motion {
            position: from.position + asked * seconds + ahead * time_constant * done,
            velocity: asked + ahead * (1.0 - done),
        }
    }

    /// For how long it goes the way that it goes now, s; infinite where it does not turn round.
    fn turns_after(&self) -> f64 {
        let Lagging { from, asked, time_constant } = *self;
        if from.velocity * asked < 0.0 { time_constant * (1.0 - from.velocity / asked).ln() } else { f64::INFINITY }
    }

    /// When it first turns round, or reaches one of `places` that lie on its way, s; infinite where it does neither.
    pub fn next(&self, places: &[f64]) -> f64 {
        let Lagging { from, asked, time_constant } = *self;
        let way = if from.velocity == 0.0 { asked } else { from.velocity }.signum();
        let turns = self.turns_after();
        let reach = |place: &f64| {
            let left = way * (place - from.position);
            if left <= 0.0 || (from.velocity == 0.0 && asked == 0.0) {
                return f64::INFINITY;
            }
            let last = match turns.is_finite() {
                true => turns,
                false if asked == 0.0 => LONG * time_constant,
                false => (left + (from.velocity - asked).abs() * time_constant) / asked.abs(),
            };
            let is_there = |seconds: f64| way * (self.after(seconds).position - from.position) >= left;
            if !is_there(last) {
                return f64::INFINITY;
            }
            let (mut before, mut there) = (0.0, last);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (before + there);
                if is_there(middle) { there = middle } else { before = middle }
            }
            there
        };
        places.iter().map(reach).fold(turns, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(velocity: f64, asked: f64) -> Lagging {
        Lagging { from: Motion { position: 0.0, velocity }, asked, time_constant: 0.1 }
    }

    #[test]
    fn it_moves_as_its_equation_has_it() {
        // By small steps of the equation itself.
        for (velocity, asked) in [(0.0, 0.5), (0.5, -0.5), (0.3, 0.0)] {
            let lagging = at(velocity, asked);
            let (mut x, mut v) = (0.0, velocity);
            for _ in 0..200_000 {
                let half = v + 0.5e-6 * (asked - v) / 0.1;
                (x, v) = (x + 1e-6 * half, v + 1e-6 * (asked - half) / 0.1);
            }
            let found = lagging.after(0.2);
            assert!((found.position - x).abs() < 1e-9 && (found.velocity - v).abs() < 1e-9, "{found:?} {x} {v}");
        }
    }

    #[test]
    fn it_knows_when_it_is_there_and_when_it_turns() {
        let out = at(0.0, 0.5);
        let there = out.next(&[-1.0, 0.0, 0.2, 0.7]);
        assert!((out.after(there).position - 0.2).abs() < 1e-12, "{there}");
        // From 0.5 m/s to −0.5: it stands after T·ln 2, 0.05 − 0.05·ln 2 = 0.0153 m further.
        let back = at(0.5, -0.5);
        assert!((back.next(&[0.02]) - 0.1 * 2.0_f64.ln()).abs() < 1e-12);
        assert!((back.after(back.next(&[0.01])).position - 0.01).abs() < 1e-12);
        // Let go, it comes 0.05 m further and no more.
        assert!(at(0.5, 0.0).next(&[0.0501]).is_infinite() && at(0.5, 0.0).next(&[0.0499]).is_finite());
        assert!(at(0.0, 0.0).next(&[0.1]).is_infinite());
    }
}
