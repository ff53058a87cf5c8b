//! A body that friction drags along: it goes as what carries it goes, as long as that changes its speed no more steeply than
//! friction can; beyond, it slides, and its speed changes by what friction gives.
//!
//! Source: sliding on a moving support (any textbook of mechanics): |dw/dt| ≤ μ·g; for belts G. Niemann, H. Winter,
//! Maschinenelemente 3, Springer 1986, section 27.

/// Speeds that differ by less are one, m/s.
const SAME_SPEED: f64 = 1e-12;

/// A body that is dragged along, at rest to begin with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Follower {
    /// The steepest change of its speed that friction gives, m/s².
    limit: f64,
    velocity: f64,
}

impl Follower {
    pub fn new(limit: f64) -> Follower {
        Follower { limit, velocity: 0.0 }
    }

    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// How far it goes while what carries it goes `way` in `span`, its speed changing evenly from `from` to `to`.
    pub fn follow(&mut self, way: f64, from: f64, to: f64, span: f64) -> f64 {
        if span <= 0.0 {
            return way;
        }
        let slope = (to - from) / span;
        // Rounding of a slope is no slip.
        let is_borne = slope.abs() <= self.limit * (1.0 + 1e-9) + SAME_SPEED / span;
        let behind = from - self.velocity;
        if behind.abs() < SAME_SPEED && is_borne {
            self.velocity = to;
            return way;
        }
        let sign = if behind.abs() < SAME_SPEED { slope.signum() } else { behind.signum() };
        let own = sign * self.limit;
        // Behind by v(t) − w(t): when is that gone?
        let closing = own - slope;
        let caught = if closing * sign > 0.0 { behind / closing } else { f64::INFINITY };
        if caught >= span {
            let gone = (self.velocity + 0.5 * own * span) * span;
            self.velocity += own * span;
            return gone;
        }
        let gone = (self.velocity + 0.5 * own * caught) * caught;
        let there = from + slope * caught;
        self.velocity = there;
        let rest = span - caught;
        gone + self.follow(0.5 * (there + to) * rest, there, to, rest)
    }

    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.velocity);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_borne_is_followed_and_what_is_not_is_caught_up_with() {
        let mut slow = Follower::new(1.0);
        assert_eq!(slow.follow(0.125, 0.0, 0.5, 0.5), 0.125);
        assert_eq!(slow.velocity(), 0.5);
        // 0.25 s at 4 m/s² up to 1 m/s: it takes 0.5 s of its own for the same change.
        let mut fast = Follower::new(2.0);
        let first = fast.follow(0.125, 0.0, 1.0, 0.25);
        assert!((first - 0.0625).abs() < 1e-15 && (fast.velocity() - 0.5).abs() < 1e-15);
        let second = fast.follow(0.75, 1.0, 1.0, 0.75);
        assert!((second - (0.1875 + 0.5)).abs() < 1e-15 && fast.velocity() == 1.0, "{second}");
    }

    #[test]
    fn spans_may_be_split() {
        let course = |parts: u32| {
            let mut follower = Follower::new(0.7);
            let (mut way, mut speed) = (0.0, 0.0);
            for (slope, seconds) in [(3.0, 0.3), (0.0, 0.2), (-2.0, 0.9), (0.0, 2.0)] {
                let span = seconds / f64::from(parts);
                for _ in 0..parts {
                    let next = speed + slope * span;
                    way += follower.follow(0.5 * (speed + next) * span, speed, next, span);
                    speed = next;
                }
            }
            (way, follower.velocity())
        };
        let (whole, fine) = (course(1), course(997));
        assert!((whole.0 - fine.0).abs() < 1e-9 && (whole.1 - fine.1).abs() < 1e-9, "{whole:?} {fine:?}");
    }
}
