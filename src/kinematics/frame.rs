//! A tree of frames: where an instance stands, and what moves with what.

use super::DPose3;

/// A frame's place in its tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FrameId(u32);

/// One frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The frame it stands in; `None` for the world.
    pub parent: Option<FrameId>,
    /// Its pose in its parent.
    pub local: DPose3,
    /// Its pose in the world, as of the last resolution.
    pub world: DPose3,
}

/// Frames, each after the one it stands in.
#[derive(Clone, Debug, Default)]
pub struct FrameTree {
    frames: Vec<Frame>,
}

impl FrameTree {
    /// Adds a frame at `local` of `parent`. A parent is there before its children, so that one pass resolves all and no
    /// circle can be made.
    pub fn add(&mut self, parent: Option<FrameId>, local: DPose3) -> FrameId {
        let world = self.under(parent, local);
        self.frames.push(Frame { parent, local, world });
        FrameId(self.frames.len() as u32 - 1)
    }

    /// Moves a frame within its parent; its world pose and those under it follow with the next [`FrameTree::resolve`], or one by
    /// one with [`FrameTree::resolve_one`].
    pub fn set_local(&mut self, id: FrameId, local: DPose3) {
        self.frames[id.0 as usize].local = local;
    }

    /// Computes all world poses.
    pub fn resolve(&mut self) {
        for index in 0..self.frames.len() {
            let Frame { parent, local, .. } = self.frames[index];
            self.frames[index].world = self.under(parent, local);
        }
    }

    /// Computes the world pose of one frame from that of its parent.
    pub fn resolve_one(&mut self, id: FrameId) {
        let Frame { parent, local, .. } = self.frames[id.0 as usize];
        self.frames[id.0 as usize].world = self.under(parent, local);
    }

    fn under(&self, parent: Option<FrameId>, local: DPose3) -> DPose3 {
        match parent {
            Some(parent) => self.frames[parent.0 as usize].world * local,
            None => local,
        }
    }

    /// The pose of a frame in the world, as of the last resolution.
    pub fn world(&self, id: FrameId) -> &DPose3 {
        &self.frames[id.0 as usize].world
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::super::{DQuat, DVec3};
    use super::*;

    #[test]
    fn a_tool_follows_its_robot() {
        let mut tree = FrameTree::default();
        let robot = tree.add(None, DPose3::translation(1.0, 0.0, 2.0));
        let tool = tree.add(Some(robot), DPose3::IDENTITY);
        let cups = tree.add(Some(tool), DPose3::translation(0.2, 0.0, -0.1));
        tree.set_local(tool, DPose3::from_parts(DVec3::new(0.0, 3.0, 0.0), DQuat::from_rotation_z(FRAC_PI_2)));
        assert_eq!(tree.world(cups).translation, DVec3::new(1.2, 0.0, 1.9));
        tree.resolve();
        assert!((tree.world(cups).translation - DVec3::new(1.0, 3.2, 1.9)).length() < 1e-12);
    }
}
