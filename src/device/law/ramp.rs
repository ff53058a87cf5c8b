//! A speed that tends to its target with constant slope.

/// How steeply a speed changes, m/s² or rad/s²; both above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// While the magnitude of the speed rises.
    pub rising: f64,
    /// While it falls. A reversal falls to 0 with this slope and rises from 0 with the other.
    pub falling: f64,
}

/// A speed on its ramp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ramp {
    /// Present speed, m/s or rad/s.
    pub velocity: f64,
}

impl Ramp {
    /// Moves by `seconds` towards `target` and returns the way gone, the exact integral of the speed.
    pub fn advance(&mut self, target: f64, slopes: Slopes, seconds: f64) -> f64 {
        let mut rest = seconds;
        let mut way = 0.0;
        let reversing = self.velocity * target < 0.0;
        if reversing || target.abs() < self.velocity.abs() {
            way += self.leg(if reversing { 0.0 } else { target }, slopes.falling, &mut rest);
        }
        if rest > 0.0 && target != self.velocity {
            way += self.leg(target, slopes.rising, &mut rest);
        }
        way + self.velocity * rest
    }

    /// For how long from now on it keeps its slope if the target stays: until it is there, or at 0 on its way to the other
    /// side; s.
    pub fn steady(&self, target: f64, slopes: Slopes) -> f64 {
        let way = (target - self.velocity).abs();
        if self.velocity * target < 0.0 {
            self.velocity.abs() / slopes.falling
        } else if target.abs() < self.velocity.abs() {
            way / slopes.falling
        } else if way > 0.0 {
            way / slopes.rising
        } else {
            f64::INFINITY
        }
    }

    /// Goes to `goal` with `slope`, or as far as `rest` reaches; takes the time it needed off `rest`.
    fn leg(&mut self, goal: f64, slope: f64, rest: &mut f64) -> f64 {
        let start = self.velocity;
        let needed = (goal - start).abs() / slope;
        if needed > *rest {
            self.velocity += slope.copysign(goal - start) * *rest;
            let way = (start + self.velocity) / 2.0 * *rest;
            *rest = 0.0;
            return way;
        }
        self.velocity = goal;
        *rest -= needed;
        (start + goal) / 2.0 * needed
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Speed and way after `seconds` from `start` towards `target`, rising with 1 and falling with 2.
    fn check((start, target, seconds): (f64, f64, f64), (velocity, way): (f64, f64)) {
        let mut ramp = Ramp { velocity: start };
        let gone = ramp.advance(target, Slopes { rising: 1.0, falling: 2.0 }, seconds);
        let place = format!("from {start} to {target} for {seconds} s: {} m/s, {gone} m", ramp.velocity);
        assert!((ramp.velocity - velocity).abs() < 1e-12 && (gone - way).abs() < 1e-12, "{place}");
    }

    #[test]
    fn a_ramp_is_a_triangle_and_a_rectangle() {
        check((0.0, 0.5, 0.2), (0.2, 0.02));
        check((0.0, 0.5, 0.5), (0.5, 0.125));
        check((0.0, 0.5, 2.0), (0.5, 0.125 + 0.75));
        check((0.0, -0.5, 2.0), (-0.5, -0.125 - 0.75));
        check((0.3, 0.3, 2.0), (0.3, 0.6));
        check((0.0, 0.0, 2.0), (0.0, 0.0));
        check((0.2, 0.5, 0.0), (0.2, 0.0));
    }

    #[test]
    fn it_slows_down_with_the_falling_slope() {
        check((1.0, 0.0, 0.25), (0.5, 0.1875));
        check((1.0, 0.5, 1.0), (0.5, 0.1875 + 0.375));
        check((-1.0, 0.0, 3.0), (0.0, -0.25));
    }

    #[test]
    fn a_reversal_falls_to_standstill_and_rises_from_it() {
        check((1.0, -1.0, 0.5), (0.0, 0.25));
        check((1.0, -1.0, 1.0), (-0.5, 0.25 - 0.125));
        check((1.0, -1.0, 2.0), (-1.0, 0.25 - 0.5 - 0.5));
    }

    proptest! {
        #[test]
        fn splitting_a_span_changes_nothing(
            start in -2.0..2.0_f64, target in -2.0..2.0_f64, span in 0.0..5.0_f64, cut in 0.0..1.0_f64,
            rising in 0.1..10.0_f64, falling in 0.1..10.0_f64,
        ) {
            let slopes = Slopes { rising, falling };
            let mut whole = Ramp { velocity: start };
            let way = whole.advance(target, slopes, span);
            let mut split = Ramp { velocity: start };
            let parts = split.advance(target, slopes, span * cut) + split.advance(target, slopes, span - span * cut);
            prop_assert!((whole.velocity - split.velocity).abs() < 1e-9);
            prop_assert!((way - parts).abs() < 1e-9);
        }

        #[test]
        fn it_arrives_and_never_passes(start in -2.0..2.0_f64, target in -2.0..2.0_f64) {
            let mut ramp = Ramp { velocity: start };
            for _ in 0..5000 {
                ramp.advance(target, Slopes { rising: 1.0, falling: 2.0 }, 0.001);
                let (low, high) = (start.min(target), start.max(target));
                prop_assert!((low..=high).contains(&ramp.velocity));
            }
            prop_assert_eq!(ramp.velocity, target);
        }
    }
}
