//! What a plant looks like: a tree of named frames with their joints, and the bodies that hang on them.
//!
//! A [`Scene`] is all of it that never changes: frames, joints, meshes (each loaded or built once, and hung up as often as it
//! is needed), beams. Where the frames are at a moment is in its [`Poses`]: set a joint, [`Poses::resolve`], and only the
//! frames under that joint are computed again. Poses are f64 throughout; the vertices of a mesh are f32, in its own frame.
//!
//! A frame is named by its instance and its own name, `Pusher1.Spintore`; its joint by `T` where it is prismatic and by `R`
//! where it is revolute behind that, `Pusher1.Spintore.T`: the form that the reference's section 6.3.1 writes as
//! `$.Spintore.T`.

mod assemble;
mod poses;
mod shape;

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::kinematics::{DPose3, DVec3, Joint};
use crate::mesh::Mesh;
use crate::plant::PartKind;

pub use self::assemble::Assembly;
pub use self::poses::Poses;

/// A frame's place in its scene's list of frames. Frames stand in depth-first order: a frame, then all that is under it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

/// A mesh's place in its scene's list of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshId(pub u32);

impl NodeId {
    /// Its index in [`Scene::nodes`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl MeshId {
    /// Its index in [`Scene::meshes`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Red, green and blue, 0 to 255 (sRGB).
pub type Colour = [u8; 3];

/// A named frame.
#[derive(Clone, Debug)]
pub struct Node {
    /// `Pusher1` for an instance's own frame, `Pusher1.Spintore` for one within it.
    pub name: String,
    /// The frame it stands in; `None` for the world.
    pub parent: Option<NodeId>,
    /// The instance it belongs to, by its place in the plant.
    pub instance: usize,
    /// Where it stands in its parent while its joint is at its zero.
    pub rest: DPose3,
    pub joint: Joint,
    /// Behind the last of the frames under it: `id..end` is the frame with all that hangs on it.
    end: u32,
}

/// A mesh in its place on a frame.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    pub node: NodeId,
    pub mesh: MeshId,
    /// The pose of the mesh's frame in the node's.
    pub place: DPose3,
    pub colour: Colour,
    /// Whether something can run into it. Lamps, cables and markings are there for the eye alone.
    pub is_solid: bool,
    /// Whether parts lie on it or are pushed by it: what they do to each other is the floor's.
    pub bears_parts: bool,
}

/// The beam of a light barrier. What it sees is the report of the same name of its instance.
#[derive(Clone, Debug)]
pub struct BeamMark {
    /// `Conveyor1.lightBarrierA`: the name of the signal that reports it, whether or not one is mapped.
    pub name: String,
    pub node: NodeId,
    /// From the lamp to the receiver, in the node's frame, m.
    pub ends: [DVec3; 2],
}

/// All about a plant's shape that never changes.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    nodes: Vec<Node>,
    meshes: Vec<Arc<Mesh>>,
    bodies: Vec<Body>,
    beams: Vec<BeamMark>,
    /// The frame of each instance, in the order of the plant.
    instances: Vec<NodeId>,
    by_name: BTreeMap<String, NodeId>,
}

impl Scene {
    /// All frames, each before those that stand in it.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// A frame.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// All meshes; bodies name them by their places here. One mesh may hang in many places.
    pub fn meshes(&self) -> &[Arc<Mesh>] {
        &self.meshes
    }

    /// What hangs on the frames.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The beams of light barriers. Those of one instance stand in the order of its barriers.
    pub fn beams(&self) -> &[BeamMark] {
        &self.beams
    }

    /// The own frame of the instance at this place of the plant.
    pub fn instance(&self, index: usize) -> NodeId {
        self.instances[index]
    }

    /// The frame called `Pusher1` or `Pusher1.Spintore`.
    pub fn find(&self, name: &str) -> Option<NodeId> {
        self.by_name.get(name).copied()
    }

    /// The frame whose joint is called `Pusher1.Spintore.T` (prismatic) or `Motor.Shaft.R` (revolute).
    pub fn find_joint(&self, name: &str) -> Option<NodeId> {
        let (frame, joint) = name.rsplit_once('.')?;
        let id = self.find(frame)?;
        (self.node(id).joint.kind.letter() == Some(joint)).then_some(id)
    }

    /// Triangles as they are seen: those of a mesh count once for each body that has it.
    pub fn triangles(&self) -> usize {
        self.bodies.iter().map(|body| self.meshes[body.mesh.index()].triangles.len()).sum()
    }

    /// Triangles as they are stored.
    pub fn stored_triangles(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.triangles.len()).sum()
    }
}

/// The colour of a part, by its kind.
pub fn part_colour(kind: PartKind) -> Colour {
    match kind {
        PartKind::Box => [196, 154, 96],
        PartKind::Pallet => [150, 112, 66],
    }
}
