//! Light beams.

use parry3d_f64::query::{Ray, RayCast};

use super::{Block, Bounds, DVec3, TOUCH_M};

/// The beam of a light barrier, from its lamp to its receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    from: DVec3,
    way: DVec3,
    bounds: Bounds,
}

impl Beam {
    /// The beam from `from` to `to`.
    pub fn new(from: DVec3, to: DVec3) -> Beam {
        Beam { from, way: to - from, bounds: Bounds { low: from.min(to), high: from.max(to) } }
    }

    /// Its two ends.
    pub fn ends(&self) -> [DVec3; 2] {
        [self.from, self.from + self.way]
    }

    /// The world's box about it.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Whether `block` cuts it, strictly: a block that only touches it with a face, an edge or a corner does not. The ray is
    /// cast at the block with its faces drawn in by [`TOUCH_M`].
    pub fn is_cut_by(&self, block: &Block) -> bool {
        self.way_to(block).is_some()
    }

    /// Which share of its way the beam goes until `block` cuts it, 0 to 1; `None` where it does not.
    pub fn way_to(&self, block: &Block) -> Option<f64> {
        if !self.bounds.meet(block.bounds()) {
            return None;
        }
        let ray = Ray::new(self.from, self.way);
        block.shape(TOUCH_M).cast_ray(&block.pose(), &ray, 1.0, true)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Upright;
    use super::*;

    /// A beam across a belt at x = 0.3, 0.05 high, and a box 0.3 long whose centre is at `x`, its bottom at `z`.
    fn check(x: f64, z: f64, yaw: f64, cut: bool) {
        let beam = Beam::new(DVec3::new(0.3, 0.3, 0.05), DVec3::new(0.3, -0.3, 0.05));
        let block = Block::new(DVec3::new(0.3, 0.2, 0.2), Upright::new(x, 0.0, z, yaw));
        assert_eq!(beam.is_cut_by(&block), cut, "centre at {x}, bottom at {z}, turned by {yaw}");
    }

    #[test]
    fn a_beam_is_cut_strictly_between_rear_and_front() {
        check(0.3, 0.0, 0.0, true);
        check(0.15, 0.0, 0.0, false);
        check(0.15 + 1e-8, 0.0, 0.0, true);
        check(0.45 - 1e-8, 0.0, 0.0, true);
        check(0.45, 0.0, 0.0, false);
    }

    #[test]
    fn the_sum_of_many_steps_touches_as_the_exact_place_does() {
        let mut x = -0.85;
        for _ in 0..1000 {
            x += 0.001;
        }
        check(x, 0.0, 0.0, false);
    }

    #[test]
    fn a_beam_passes_over_and_under() {
        check(0.3, -0.15, 0.0, false);
        check(0.3, 0.05, 0.0, false);
        check(0.3, 0.049, 0.0, true);
    }

    #[test]
    fn a_turned_box_cuts_with_its_corner() {
        check(0.12, 0.0, 0.0, false);
        check(0.12, 0.0, 0.6, true);
    }

    #[test]
    fn a_beam_ends_at_its_receiver() {
        let beam = Beam::new(DVec3::new(0.0, 0.0, 0.1), DVec3::new(1.0, 0.0, 0.1));
        let beyond = Block::new(DVec3::splat(0.2), Upright::new(1.2, 0.0, 0.0, 0.0));
        assert!(!beam.is_cut_by(&beyond));
    }
}
