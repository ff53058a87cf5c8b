//! How a frame can move in its parent.

use super::{DPose3, DQuat, DVec3};

/// What a joint lets a frame do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Nothing.
    Fixed,
    /// Slide along the axis, m.
    Prismatic,
    /// Turn about the axis, rad.
    Revolute,
}

impl JointKind {
    /// What stands for it behind the last dot of its name: `T` as translation, `R` as rotation.
    pub fn letter(self) -> Option<&'static str> {
        match self {
            JointKind::Fixed => None,
            JointKind::Prismatic => Some("T"),
            JointKind::Revolute => Some("R"),
        }
    }
}

/// A joint: how a frame moves from its rest pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    pub kind: JointKind,
    /// A unit vector in the frame at rest.
    pub axis: DVec3,
    /// The least and the greatest value, m or rad; infinite where it has no end.
    pub limits: [f64; 2],
    /// The value at which the frame is at rest, m or rad.
    pub zero: f64,
}

impl Joint {
    /// No joint.
    pub const FIXED: Joint = Joint { kind: JointKind::Fixed, axis: DVec3::X, limits: [0.0, 0.0], zero: 0.0 };

    /// A slide along `axis`, which need not be of length 1.
    pub fn prismatic(axis: DVec3, limits: [f64; 2]) -> Joint {
        Joint { kind: JointKind::Prismatic, axis: axis.normalize(), limits, zero: 0.0 }
    }

    /// A turn about `axis`, which need not be of length 1.
    pub fn revolute(axis: DVec3, limits: [f64; 2]) -> Joint {
        Joint { kind: JointKind::Revolute, axis: axis.normalize(), limits, zero: 0.0 }
    }

    /// A turn about `axis` without end.
    pub fn endless(axis: DVec3) -> Joint {
        Joint::revolute(axis, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// The motion from rest at `value`: T(axis · (value − zero)), or a turn by value − zero about the axis.
    pub fn motion(&self, value: f64) -> DPose3 {
        let way = value - self.zero;
        match self.kind {
            JointKind::Fixed => DPose3::IDENTITY,
            JointKind::Prismatic => DPose3::from_translation(self.axis * way),
            JointKind::Revolute => DPose3::from_rotation(DQuat::from_axis_angle(self.axis, way)),
        }
    }

    /// Whether `value` lies within its limits.
    pub fn reaches(&self, value: f64) -> bool {
        (self.limits[0]..=self.limits[1]).contains(&value)
    }
}
