//! Where the frames of a scene are at a moment.

use std::sync::Arc;

use super::{NodeId, Scene};
use crate::kinematics::DPose3;
use crate::kinematics::JointKind;

/// The joints' values and the frames' poses in the world. Nothing here allocates once it is made.
#[derive(Clone, Debug)]
pub struct Poses {
    scene: Arc<Scene>,
    values: Vec<f64>,
    world: Vec<DPose3>,
    /// In which resolution each frame moved last.
    versions: Vec<u64>,
    version: u64,
    /// Frames whose joint was set since the last resolution.
    set: Vec<NodeId>,
    is_set: Vec<bool>,
    moved: Vec<NodeId>,
}

impl Poses {
    /// All joints at 0.
    pub fn new(scene: Arc<Scene>) -> Poses {
        let count = scene.nodes.len();
        let mut poses = Poses {
            values: vec![0.0; count],
            world: vec![DPose3::IDENTITY; count],
            versions: vec![0; count],
            version: 0,
            set: Vec::with_capacity(count),
            is_set: vec![false; count],
            moved: Vec::with_capacity(count),
            scene,
        };
        poses.compute(0, count);
        poses
    }

    /// What it is the poses of.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Sets the joint of a frame, m or rad; a value that it has already, or a frame without a joint, changes nothing. Limits are
    /// not asked: a machine that overruns them is shown where it is.
    pub fn set(&mut self, node: NodeId, value: f64) {
        let now = &mut self.values[node.index()];
        if *now != value && self.scene.nodes[node.index()].joint.kind != JointKind::Fixed {
            // A NaN differs from itself, and would move its frame for ever.
            debug_assert!(value.is_finite(), "a joint at {value}");
            *now = value;
            if !std::mem::replace(&mut self.is_set[node.index()], true) {
                self.set.push(node);
            }
        }
    }

    /// The value of a frame's joint, m or rad.
    pub fn value(&self, node: NodeId) -> f64 {
        self.values[node.index()]
    }

    /// Computes the poses of what was set and of all that hangs on it, and of nothing else.
    pub fn resolve(&mut self) {
        self.moved.clear();
        if self.set.is_empty() {
            return;
        }
        self.version += 1;
        self.set.sort_unstable();
        let mut done = 0;
        for index in 0..self.set.len() {
            let start = self.set[index].index();
            self.is_set[start] = false;
            if start >= done {
                done = self.scene.nodes[start].end as usize;
                self.compute(start, done);
            }
        }
        self.set.clear();
    }

    fn compute(&mut self, start: usize, end: usize) {
        let scene = Arc::clone(&self.scene);
        for (index, node) in scene.nodes.iter().enumerate().take(end).skip(start) {
            let local = match node.joint.kind {
                JointKind::Fixed => node.rest,
                _ => node.rest * node.joint.motion(self.values[index]),
            };
            self.world[index] = match node.parent {
                Some(parent) => self.world[parent.index()] * local,
                None => local,
            };
            self.versions[index] = self.version;
            self.moved.push(NodeId(index as u32));
        }
    }

    /// The pose of a frame in the world, as of the last resolution.
    pub fn world(&self, node: NodeId) -> &DPose3 {
        &self.world[node.index()]
    }

    /// The poses of all frames, by [`NodeId`].
    pub fn all(&self) -> &[DPose3] {
        &self.world
    }

    /// The frames that the last resolution moved, in their order.
    pub fn moved(&self) -> &[NodeId] {
        &self.moved
    }

    /// How many resolutions moved something.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The frames that moved after `version`, with their poses: what a viewer that has seen that version is missing.
    pub fn moved_since(&self, version: u64) -> impl Iterator<Item = (NodeId, &DPose3)> {
        let later = move |(index, changed): (usize, &u64)| (*changed > version).then_some(NodeId(index as u32));
        self.versions.iter().enumerate().filter_map(later).map(|node| (node, self.world(node)))
    }
}
