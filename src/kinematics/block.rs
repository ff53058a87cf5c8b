//! Upright cuboids: how far two of them are apart.

use parry3d_f64::query::sat::cuboid_cuboid_find_local_separating_normal_oneway as face_separation;
use parry3d_f64::shape::Cuboid;

use super::{DPose3, DQuat, DVec2, DVec3, Polygon, Upright};

/// A box whose faces are the axes' of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub low: DVec3,
    pub high: DVec3,
}

impl Bounds {
    /// Of nothing: grows to whatever it is merged with.
    pub const EMPTY: Bounds = Bounds { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// Of both.
    pub fn merged(self, other: Bounds) -> Bounds {
        Bounds { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Grown by `margin` on all sides.
    pub fn grown(self, margin: f64) -> Bounds {
        Bounds { low: self.low - margin, high: self.high + margin }
    }

    /// Whether `other` lies wholly in it.
    pub fn holds(&self, other: &Bounds) -> bool {
        other.low.cmpge(self.low).all() && other.high.cmple(self.high).all()
    }

    /// How far the two are apart at least, m; 0 or less where they share a point.
    pub fn gap(&self, other: &Bounds) -> f64 {
        (other.low - self.high).max(self.low - other.high).max_element()
    }

    /// Whether the two share a point.
    pub fn meet(&self, other: &Bounds) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
            && self.low.z <= other.high.z
            && other.low.z <= self.high.z
    }
}

/// An upright cuboid in its place, with what is asked of it most often already computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Half of its length, width and height.
    half: DVec3,
    upright: Upright,
    rotation: DQuat,
    /// The direction of its length.
    along: DVec2,
    bounds: Bounds,
}

impl Block {
    /// A cuboid of `size` (length, width, height) that stands at `upright`.
    pub fn new(size: DVec3, upright: Upright) -> Block {
        let mut block =
            Block { half: size / 2.0, upright, rotation: DQuat::IDENTITY, along: DVec2::X, bounds: Bounds::EMPTY };
        block.turn_to(upright.yaw);
        block.bound();
        block
    }

    /// Puts it elsewhere.
    pub fn move_to(&mut self, upright: Upright) {
        if upright.yaw != self.upright.yaw {
            self.turn_to(upright.yaw);
        }
        self.upright = upright;
        self.bound();
    }

    fn turn_to(&mut self, yaw: f64) {
        self.along = DVec2::from_angle(yaw);
        self.rotation = DQuat::from_rotation_z(yaw);
    }

    fn bound(&mut self) {
        let along = self.along.abs() * self.half.x;
        let across = self.along.abs() * self.half.y;
        let reach = DVec3::new(along.x + across.y, along.y + across.x, self.half.z);
        let centre = self.centre();
        self.bounds = Bounds { low: centre - reach, high: centre + reach };
    }

    /// Length, width, height.
    pub fn size(&self) -> DVec3 {
        self.half * 2.0
    }

    /// A bound of how far its corners are from its upright axis, m.
    pub fn radius(&self) -> f64 {
        self.half.x + self.half.y
    }

    /// Where it stands.
    pub fn upright(&self) -> Upright {
        self.upright
    }

    /// Its centre.
    pub fn centre(&self) -> DVec3 {
        self.upright.place + DVec3::new(0.0, 0.0, self.half.z)
    }

    /// Height of its top face.
    pub fn top(&self) -> f64 {
        self.upright.place.z + 2.0 * self.half.z
    }

    /// The world's box about it.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Pose of its centre.
    pub fn pose(&self) -> DPose3 {
        DPose3::from_parts(self.centre(), self.rotation)
    }

    /// Its shape about its centre, each face drawn in by `margin`.
    pub fn shape(&self, margin: f64) -> Cuboid {
        Cuboid::new((self.half - margin).max(DVec3::ZERO))
    }

    /// Area of its bottom face, m².
    pub fn area(&self) -> f64 {
        4.0 * self.half.x * self.half.y
    }

    /// The length of its bottom face's outline, m.
    pub fn outline(&self) -> f64 {
        4.0 * (self.half.x + self.half.y)
    }

    /// Its bottom face, seen from above.
    pub fn footprint(&self) -> Polygon {
        let along = self.along * self.half.x;
        let across = self.along.perp() * self.half.y;
        let centre = self.upright.place.truncate();
        Polygon::new(&[
            centre - along - across,
            centre + along - across,
            centre + along + across,
            centre - along + across,
        ])
    }

    /// Whether the vertical through `point` meets it.
    pub fn is_over(&self, point: DVec2) -> bool {
        let arm = point - self.upright.place.truncate();
        arm.dot(self.along).abs() <= self.half.x && arm.dot(self.along.perp()).abs() <= self.half.y
    }
}

/// How far `a` and `b` are apart (negative: how deep they are in one another), and the direction from `a` to `b` in which that
/// is so.
///
/// The faces' normals of both are all the axes there are to test: the edges of two upright cuboids are parallel to those
/// normals, so that no product of two edges adds a direction.
pub fn separation(a: &Block, b: &Block) -> (f64, DVec3) {
    let (pose_a, pose_b) = (a.pose(), b.pose());
    let (shape_a, shape_b) = (a.shape(0.0), b.shape(0.0));
    let (by_a, normal_a) = face_separation(&shape_a, &shape_b, &pose_a.inv_mul(&pose_b));
    let (by_b, normal_b) = face_separation(&shape_b, &shape_a, &pose_b.inv_mul(&pose_a));
    if by_a >= by_b { (by_a, a.rotation * normal_a) } else { (by_b, -(b.rotation * normal_b)) }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use proptest::prelude::*;

    use super::*;

    fn block(x: f64, y: f64, z: f64, yaw: f64) -> Block {
        Block::new(DVec3::new(0.4, 0.2, 0.1), Upright::new(x, y, z, yaw))
    }

    fn check(a: Block, b: Block, apart: f64) {
        let (found, normal) = separation(&a, &b);
        assert!((found - apart).abs() < 1e-12, "{found} is not {apart}");
        assert!((normal.length() - 1.0).abs() < 1e-12);
        let (back, _) = separation(&b, &a);
        assert!((back - apart).abs() < 1e-12, "the other way: {back} is not {apart}");
    }

    #[test]
    fn cuboids_apart_touching_and_within() {
        let here = block(0.0, 0.0, 0.0, 0.0);
        check(here, block(0.5, 0.0, 0.0, 0.0), 0.1);
        check(here, block(0.4, 0.0, 0.0, 0.0), 0.0);
        check(here, block(0.39, 0.0, 0.0, 0.0), -0.01);
        check(here, block(0.0, 0.31, 0.0, FRAC_PI_2), 0.01);
        check(here, block(0.0, 0.0, 0.1, 0.3), 0.0);
        check(here, block(0.0, 0.0, 0.0, 0.0), -0.1);
    }

    #[test]
    fn a_corner_reaches_further_than_a_face() {
        let turned = block(0.5, 0.0, 0.0, FRAC_PI_4);
        let corner = 0.3 * FRAC_PI_4.cos();
        check(block(0.0, 0.0, 0.0, 0.0), turned, 0.5 - 0.2 - corner);
    }

    #[test]
    fn the_normal_points_to_the_other() {
        let (_, normal) = separation(&block(0.0, 0.0, 0.0, 1.0), &block(-3.0, 0.1, 0.0, 0.2));
        assert!(normal.x < 0.0);
    }

    #[test]
    fn bounds_hold_the_corners() {
        let block = block(1.0, 2.0, 3.0, 0.6);
        for corner in block.footprint().corners() {
            let low = block.bounds().low.truncate() - 1e-12;
            let high = block.bounds().high.truncate() + 1e-12;
            assert!(corner.cmpge(low).all() && corner.cmple(high).all());
        }
        assert_eq!((block.bounds().low.z, block.top()), (3.0, 3.1));
    }

    proptest! {
        /// Where the footprints share no area and the heights overlap, the blocks are apart, and the other way round.
        #[test]
        fn separation_agrees_with_the_clipped_area(
            x in -0.6..0.6f64, y in -0.6..0.6f64, yaw in -4.0..4.0f64, turned in -4.0..4.0f64,
        ) {
            let a = block(0.0, 0.0, 0.0, yaw);
            let b = block(x, y, 0.05, turned);
            let shared = a.footprint().clipped(&b.footprint()).area();
            let (apart, _) = separation(&a, &b);
            prop_assert!(apart < 1e-9 || shared < 1e-12, "{apart} apart, yet {shared} m² in common");
            prop_assert!(apart > -1e-6 || shared > 0.0, "{apart} deep, yet nothing in common");
        }
    }
}
