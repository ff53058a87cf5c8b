//! A body that friction drags along: it goes as what carries it goes, as long as that changes its speed no more steeply than
//! friction can; beyond, it slides, and its speed changes by what friction gives.
//!
//! Source: sliding on a moving support (any textbook of mechanics): |dw/dt| ≤ μ·g; for belts G. Niemann, H. Winter,
//! Maschinenelemente 3, Springer 1986, section 27.

/// Speeds that differ by less are one, m/s.
const SAME_SPEED: f64 = 1e-12;

/// A body that is dragged along, at rest to begin with.
#[derive(Clone, Copy, Debug)]
pub struct Follower {
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

/// How a belt moved for a while, its speed changing evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// m.
    pub way: f64,
    /// Its speed when that began and when it ended, m/s.
    pub speeds: [f64; 2],
    /// s.
    pub span: f64,
}

/// What a part that lies on a belt does there: it goes with it, or slides because the belt changed its speed more steeply than
/// friction bears. One that was put there, wherever it came from, goes with it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slider {
    /// The part's own speed while it slides, m/s.
    velocity: Option<f64>,
}

impl Slider {
    /// The part's own speed while it slides, m/s.
    pub fn velocity(&self) -> Option<f64> {
        self.velocity
    }

    /// How far the part goes while its belt does a `stretch`, m, where friction gives it at most `grip`, m/s²; infinite where
    /// nothing slips.
    pub fn ride(&mut self, grip: f64, stretch: &Stretch) -> f64 {
        let Stretch { way, speeds: [from, to], span } = *stretch;
        if grip.is_infinite() {
            self.velocity = None;
            return way;
        }
        let mut follower = Follower { limit: grip, velocity: self.velocity.unwrap_or(from) };
        let gone = follower.follow(way, from, to, span);
        self.velocity = Some(follower.velocity).filter(|own| (own - to).abs() >= SAME_SPEED);
        gone
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

    /// Up to 1 m/s within 0.5 s, and half that from the friction: one that was there is 0.5 m behind when it has caught up; one that was put when
    /// the belt ran at 0.5 m/s goes on from there, and loses a quarter of that.
    #[test]
    fn parts_of_one_belt_slide_each_by_itself() {
        let stretch = |way, speeds, span| Stretch { way, speeds, span };
        let ride = |slider: &mut Slider, stretches: &[Stretch]| -> f64 {
            stretches.iter().map(|stretch| slider.ride(1.0, stretch)).sum()
        };
        let (mut first, mut second) = (Slider::default(), Slider::default());
        let start = stretch(0.0625, [0.0, 0.5], 0.25);
        let rest = [stretch(0.1875, [0.5, 1.0], 0.25), stretch(0.5, [1.0, 1.0], 0.5)];
        let behind = [ride(&mut first, &[&[start], &rest[..]].concat()), ride(&mut second, &rest)];
        assert_eq!(behind, [0.75 - 0.25, 0.6875 - 0.0625]);
        assert_eq!([first, second], [Slider::default(); 2]);
        let mut held = Slider::default();
        assert_eq!((held.ride(f64::INFINITY, &start), held.velocity()), (0.0625, None));
        assert_eq!((held.ride(1.0, &start), held.velocity()), (0.03125, Some(0.25)));
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
