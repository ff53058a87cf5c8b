//! Convex polygons seen from above: how much of a part stands on what.

use super::DVec2;

/// The most corners a polygon has: two quadrilaterals cut each other in at most eight.
const CAPACITY: usize = 8;

/// A convex polygon of at most eight corners, counter-clockwise. Fewer than three corners are an empty one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polygon {
    corners: [DVec2; CAPACITY],
    count: usize,
}

impl Polygon {
    /// The polygon of these corners, counter-clockwise; at most eight, more are dropped.
    pub fn new(corners: &[DVec2]) -> Polygon {
        let mut polygon = Polygon { corners: [DVec2::ZERO; CAPACITY], count: 0 };
        corners.iter().for_each(|corner| polygon.push(*corner));
        polygon
    }

    fn push(&mut self, corner: DVec2) {
        // A ninth corner can come of rounding alone, beside one that is already there.
        if self.count < CAPACITY {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }

    /// Its corners.
    pub fn corners(&self) -> &[DVec2] {
        &self.corners[..self.count]
    }

    /// Its area, m².
    pub fn area(&self) -> f64 {
        let corners = self.corners();
        let Some(&first) = corners.first() else { return 0.0 };
        // Taken from the first corner, so that places far from the origin cost no digits.
        let twice: f64 = corners.windows(2).map(|edge| (edge[0] - first).perp_dot(edge[1] - first)).sum();
        (twice / 2.0).max(0.0)
    }

    /// What it has in common with `other`, by the algorithm of Sutherland and Hodgman: it is cut by the line of each of the
    /// other's edges in turn.
    pub fn clipped(&self, other: &Polygon) -> Polygon {
        let mut left = *self;
        let edges = other.corners();
        for (index, &from) in edges.iter().enumerate() {
            if left.count == 0 {
                break;
            }
            left = left.cut(from, edges[(index + 1) % edges.len()] - from);
        }
        left
    }

    /// The part of it to the left of the line through `from` along `direction`.
    fn cut(&self, from: DVec2, direction: DVec2) -> Polygon {
        let mut kept = Polygon { corners: [DVec2::ZERO; CAPACITY], count: 0 };
        let corners = self.corners();
        let Some(&last) = corners.last() else { return kept };
        let mut before = last;
        let mut height_before = direction.perp_dot(before - from);
        for &corner in corners {
            let height = direction.perp_dot(corner - from);
            if (height >= 0.0) != (height_before >= 0.0) {
                kept.push(before + (corner - before) * (height_before / (height_before - height)));
            }
            if height >= 0.0 {
                kept.push(corner);
            }
            (before, height_before) = (corner, height);
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn square(x: f64, y: f64, half: f64, turn: f64) -> Polygon {
        let arm = DVec2::from_angle(turn + std::f64::consts::FRAC_PI_4) * half * std::f64::consts::SQRT_2;
        let centre = DVec2::new(x, y);
        Polygon::new(&[centre + arm, centre + arm.perp(), centre - arm, centre - arm.perp()])
    }

    fn check(a: Polygon, b: Polygon, area: f64) {
        let found = a.clipped(&b).area();
        assert!((found - area).abs() < 1e-12, "{found} is not {area}");
    }

    #[test]
    fn what_two_squares_have_in_common() {
        let unit = square(0.0, 0.0, 0.5, 0.0);
        check(unit, unit, 1.0);
        check(unit, square(0.5, 0.0, 0.5, 0.0), 0.5);
        check(unit, square(0.5, 0.5, 0.5, 0.0), 0.25);
        check(unit, square(1.0, 0.0, 0.5, 0.0), 0.0);
        check(unit, square(5.0, 0.0, 0.5, 0.0), 0.0);
        check(unit, square(0.1, 0.1, 0.1, 0.3), 0.04);
    }

    #[test]
    fn an_octagon_is_left_of_two_squares_turned_against_each_other() {
        let turned = square(0.0, 0.0, 0.5, std::f64::consts::FRAC_PI_4);
        check(square(0.0, 0.0, 0.5, 0.0), turned, 2.0 * (std::f64::consts::SQRT_2 - 1.0));
    }

    #[test]
    fn a_point_has_no_area() {
        assert_eq!(Polygon::new(&[DVec2::ONE]).area(), 0.0);
        assert_eq!(Polygon::new(&[]).area(), 0.0);
    }

    proptest! {
        #[test]
        fn cutting_is_mutual_and_takes_nothing_twice(
            x in -1.0..1.0f64, y in -1.0..1.0f64, turn in -4.0..4.0f64, other in -4.0..4.0f64, cut in -0.4..0.4f64,
        ) {
            let (a, b) = (square(0.0, 0.0, 0.5, turn), square(x, y, 0.3, other));
            let (ab, ba) = (a.clipped(&b).area(), b.clipped(&a).area());
            prop_assert!((ab - ba).abs() < 1e-12);
            // Two halves of the plane share what there is.
            let right = Polygon::new(&[DVec2::new(cut, -9.0), DVec2::new(9.0, -9.0), DVec2::new(9.0, 9.0), DVec2::new(cut, 9.0)]);
            let left = Polygon::new(&[DVec2::new(-9.0, -9.0), DVec2::new(cut, -9.0), DVec2::new(cut, 9.0), DVec2::new(-9.0, 9.0)]);
            let halves = a.clipped(&left).area() + a.clipped(&right).area();
            prop_assert!((halves - 1.0).abs() < 1e-12, "{halves}");
        }
    }
}
