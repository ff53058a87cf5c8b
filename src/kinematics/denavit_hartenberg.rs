//! Arms by their Denavit-Hartenberg parameters: T = Π Rz(θ) Tz(d) Tx(a) Rx(α) (J. Denavit, R. S. Hartenberg, "A kinematic
//! notation for lower-pair mechanisms based on matrices", Journal of Applied Mechanics 22, 1955).

use super::{DPose3, DQuat, DVec3, Joint};

/// The revolute joints of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DenavitHartenberg<'a> {
    /// Of each joint the way along the next x axis, m.
    pub a: &'a [f64],
    /// Of each joint the way along its axis, m.
    pub d: &'a [f64],
    /// Of each joint the turn about the next x axis, rad.
    pub alpha: &'a [f64],
    /// The least and the greatest angle of each, rad.
    pub limits: [&'a [f64]; 2],
}

impl DenavitHartenberg<'_> {
    /// Of each joint, where it stands at rest in what the one before it moves; and where the flange is in what the last one moves.
    pub fn links(&self) -> (Vec<(DPose3, Joint)>, DPose3) {
        let mut links = Vec::with_capacity(self.a.len());
        let mut behind = DPose3::IDENTITY;
        for (joint, ((a, d), alpha)) in self.a.iter().zip(self.d).zip(self.alpha).enumerate() {
            let limits = self.limits.map(|limits| limits[joint]);
            links.push((behind, Joint::revolute(DVec3::Z, limits)));
            behind = DPose3::translation(*a, 0.0, *d) * DPose3::from_rotation(DQuat::from_rotation_x(*alpha));
        }
        (links, behind)
    }
}
