//! A speed that follows what is asked of it as a first-order lag, and the way that is gone meanwhile:
//!
//! ```text
//! T·dv/dt + v = w,   dx/dt = v   ⇒   v = w + (v₀ − w)·e^(−t/T),   x = x₀ + w·t + (v₀ − w)·T·(1 − e^(−t/T))
//! ```
//!
//! Source: the first-order lag (K. J. Åström, T. Hägglund, Advanced PID Control, ISA 2006, section 2.4).

use crate::device::path::Motion;

/// How many steps the instant at which a place is reached takes at most: where it all but turns round there each halves what is left.
const STEPS: u32 = 60;
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

    /// Whether its speed still changes.
    pub fn is_under_way(&self) -> bool {
        self.from.velocity != self.asked
    }

    /// For how long at least its speed does not come within `unsure` of passing `speed`, either way; s.
    pub fn passes(&self, speed: f64, unsure: f64) -> f64 {
        let Lagging { from, asked, time_constant } = *self;
        let reached = |speed: f64| {
            let left = (speed - asked) / (from.velocity - asked);
            if left > 0.0 && left <= 1.0 { -time_constant * left.ln() } else { f64::INFINITY }
        };
        let edges = [-1.0, 1.0].map(|side| speed + side * unsure);
        edges.into_iter().flat_map(|edge| [reached(edge), reached(-edge)]).fold(f64::INFINITY, f64::min)
    }

    /// For how long it goes the way that it goes now, s; infinite where it does not turn round.
    fn turns_after(&self) -> f64 {
        let Lagging { from, asked, time_constant } = *self;
        if from.velocity * asked < 0.0 { time_constant * (1.0 - from.velocity / asked).ln() } else { f64::INFINITY }
    }

    /// When it first turns round, or reaches one of `places` that lie on its way, s; infinite where it does neither.
    pub fn next(&self, places: &[f64]) -> f64 {
        let Lagging { from, asked, .. } = *self;
        let way = if from.velocity == 0.0 { asked } else { from.velocity }.signum();
        let ahead = places.iter().map(|place| way * (place - from.position)).filter(|left| *left > 0.0);
        let turns = self.turns_after();
        turns.min(self.gone(way, ahead.fold(f64::INFINITY, f64::min), turns))
    }

    /// When it has gone `left` metres its `way`, s; infinite where it never does, or not before it `turns`.
    ///
    /// By Newton's steps from the side from which they never pass the instant: speeds up, from beyond it, slows down, from now.
    fn gone(&self, way: f64, left: f64, turns: f64) -> f64 {
        let Lagging { from, asked, time_constant } = *self;
        if left.is_infinite() || (from.velocity == 0.0 && asked == 0.0) {
            return f64::INFINITY;
        }
        let last = match turns.is_finite() {
            true => turns,
            false if asked == 0.0 => LONG * time_constant,
            false => (left + (from.velocity - asked).abs() * time_constant) / asked.abs(),
        };
        let missing = |motion: Motion| left - way * (motion.position - from.position);
        if missing(self.after(last)) > 0.0 {
            return f64::INFINITY;
        }
        let slows_down = way * (asked - from.velocity) < 0.0;
        let mut at = if slows_down { 0.0 } else { last };
        for _ in 0..STEPS {
            let motion = self.after(at);
            let step = missing(motion) / (way * motion.velocity);
            if !step.is_finite() || step.abs() <= f64::EPSILON * last {
                break;
            }
            at = (at + step).clamp(0.0, last);
        }
        at
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

    #[test]
    fn it_knows_when_its_speed_passes_another() {
        // From rest to 0.5 m/s it has 0.2 after T·ln(0.5/0.3), and 0.1 less 0.01 after T·ln(0.5/0.41); never 0.6.
        let out = at(0.0, 0.5);
        assert!((out.passes(0.2, 0.0) - 0.1 * (0.5_f64 / 0.3).ln()).abs() < 1e-12);
        assert!((out.passes(0.1, 0.01) - 0.1 * (0.5_f64 / 0.41).ln()).abs() < 1e-12);
        assert!(out.passes(0.6, 0.01).is_infinite() && at(0.5, 0.5).passes(0.2, 0.01).is_infinite());
        // Turned round, it passes 0.2 on its way to 0.
        assert!((at(0.5, -0.5).passes(0.2, 0.0) - 0.1 * (1.0_f64 / 0.7).ln()).abs() < 1e-12);
    }

    #[test]
    fn wherever_it_goes_it_is_there_when_it_says_so_and_not_before() {
        for velocity in [-0.7, -3e-6, 0.0, 3e-6, 0.3, 0.6, 2.0] {
            for asked in [-0.4, -1e-3, 0.0, 0.5] {
                for place in [-0.3, -0.05, -1e-7, 1e-7, 0.01, 0.0499, 0.21] {
                    let lagging = at(velocity, asked);
                    let (next, turns) = (lagging.next(&[place]), lagging.turns_after());
                    let gone = |share: f64| lagging.after(share * next).position;
                    if next < turns {
                        assert!((gone(1.0) - place).abs() < 1e-12, "{velocity} {asked} {place}: {next}");
                        let before = (0..100).map(|part| gone(f64::from(part) / 100.0));
                        assert!(
                            before.into_iter().all(|gone| (gone < place) == (place > 0.0)),
                            "{velocity} {asked} {place}"
                        );
                    } else {
                        // It is never there on this way: looked for by small steps, to beyond all that it does of itself.
                        let last = turns.min(5.0);
                        let is_there = |part: u32| {
                            let at = lagging.after(last * f64::from(part) / 20_000.0).position;
                            (at >= place) == (place > 0.0)
                        };
                        assert!(!(0..20_000).any(is_there), "{velocity} {asked} {place}: {next}");
                    }
                }
            }
        }
    }
}
