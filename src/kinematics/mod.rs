//! Frames, upright bodies, conveyor surfaces, light beams: the geometry the engine's phases ask. Pure functions on poses;
//! no names, no devices, no time.
//!
//! Lengths are metres, angles radians, the world's z points up. Parts are cuboids that stand upright: their pose is a place
//! and a heading. What is asked about their shapes (how far apart, is the beam cut) is answered by parry3d.

mod beam;
mod block;
mod chain;
mod denavit_hartenberg;
mod frame;
mod joint;
mod polygon;
mod surface;

pub use beam::Beam;
pub use block::{Block, Bounds, separation};
pub use chain::{Chain, OutOfReach};
pub use denavit_hartenberg::DenavitHartenberg;
pub use frame::{Frame, FrameId, FrameTree};
pub use joint::{Joint, JointKind};
pub use parry3d_f64::glamx::{DPose3, DQuat, DVec2, DVec3};
pub use polygon::Polygon;
pub use surface::{Along, Shape, Surface};

/// What counts as touching, m: a nanometre.
///
/// Places are sums of some hundred thousand steps and carry rounding of about 1e-11 m; the shortest way that anything moves in
/// a step that matters is some 1e-7 m. A nanometre lies between: a box whose front stands exactly in a beam does not cut it
/// and two boxes that stand side by side do not collide, whatever the rounding was.
pub const TOUCH_M: f64 = 1e-9;

/// Where an upright body stands: the centre of its bottom face, and its heading (about z, from the world's x).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Upright {
    pub place: DVec3,
    pub yaw: f64,
}

impl Upright {
    /// At x, y, z, heading `yaw`.
    pub fn new(x: f64, y: f64, z: f64, yaw: f64) -> Upright {
        Upright { place: DVec3::new(x, y, z), yaw }
    }

    /// As a pose in space.
    pub fn pose(self) -> DPose3 {
        DPose3::from_parts(self.place, DQuat::from_rotation_z(self.yaw))
    }

    /// The upright pose that `pose` is, if its z axis is the world's; what tilt there is, is dropped.
    pub fn from_pose(pose: &DPose3) -> Upright {
        let x = pose.rotation * DVec3::X;
        Upright { place: pose.translation, yaw: x.y.atan2(x.x) }
    }

    /// Moved by `motion` of a body whose centre stands at `centre`.
    pub fn moved(self, motion: Motion, centre: DVec2) -> Upright {
        let mut arm = self.place.truncate() - centre;
        if motion.turn != 0.0 {
            arm = DVec2::from_angle(motion.turn).rotate(arm);
        }
        let place = centre + arm + motion.shift;
        Upright { place: place.extend(self.place.z), yaw: self.yaw + motion.turn }
    }
}

/// A small planar motion of a body: its centre is shifted, and it turns about its centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    pub shift: DVec2,
    pub turn: f64,
}

impl Motion {
    /// No motion.
    pub const NONE: Motion = Motion { shift: DVec2::ZERO, turn: 0.0 };

    /// Its first part, `fraction` of the whole. On an arc the centre goes along the chord: of a step's motion that is off
    /// by less than a micrometre.
    pub fn scaled(self, fraction: f64) -> Motion {
        Motion { shift: self.shift * fraction, turn: self.turn * fraction }
    }

    /// Whether nothing moves.
    pub fn is_none(self) -> bool {
        self == Motion::NONE
    }
}

/// Whether the z axis of `pose` is the world's, up or down, so that what it carries stays upright.
pub fn is_level(pose: &DPose3) -> bool {
    let z = pose.rotation * DVec3::Z;
    z.x.abs() < 1e-9 && z.y.abs() < 1e-9
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn an_upright_pose_survives_the_way_through_space() {
        let upright = Upright::new(1.0, 2.0, 3.0, 0.7);
        let back = Upright::from_pose(&upright.pose());
        assert!((back.place - upright.place).length() < 1e-15);
        assert!((back.yaw - upright.yaw).abs() < 1e-15);
    }

    #[test]
    fn a_rider_turns_about_its_carrier() {
        let rider = Upright::new(2.0, 0.0, 0.5, 0.0);
        let turned = rider.moved(Motion { shift: DVec2::new(0.0, 1.0), turn: FRAC_PI_2 }, DVec2::new(1.0, 0.0));
        assert!((turned.place - DVec3::new(1.0, 2.0, 0.5)).length() < 1e-15);
        assert_eq!(turned.yaw, FRAC_PI_2);
    }

    #[test]
    fn level_is_upright_or_upside_down() {
        assert!(is_level(&Upright::new(0.0, 0.0, 0.0, 1.0).pose()));
        assert!(is_level(&DPose3::from_rotation(DQuat::from_rotation_x(std::f64::consts::PI))));
        assert!(!is_level(&DPose3::from_rotation(DQuat::from_rotation_y(0.01))));
    }
}
