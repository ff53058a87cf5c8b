//! A scene is put together: frames under frames, meshes made once, bodies hung up.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{BeamMark, Body, Colour, MeshId, Node, NodeId, Scene};
use crate::kinematics::Joint;
use crate::kinematics::{DPose3, DVec3};
use crate::mesh::Mesh;

/// A scene that is being put together.
#[derive(Debug, Default)]
pub struct Assembly {
    scene: Scene,
    by_key: BTreeMap<String, MeshId>,
    /// Of meshes that the plant holds, which outlive the assembly.
    by_address: BTreeMap<usize, MeshId>,
}

impl Assembly {
    /// Adds the own frame of the instance at `index` of the plant; instances may come in any order, each once.
    pub fn instance(&mut self, index: usize, name: &str, parent: Option<NodeId>, rest: DPose3) -> NodeId {
        let id = self.push(Node { name: name.to_owned(), parent, instance: index, rest, joint: Joint::FIXED, end: 0 });
        if self.scene.instances.len() <= index {
            self.scene.instances.resize(index + 1, id);
        }
        self.scene.instances[index] = id;
        id
    }

    /// Adds a frame called `name` within the instance of `parent`.
    pub fn frame(&mut self, parent: NodeId, name: &str, rest: DPose3, joint: Joint) -> NodeId {
        let instance = self.scene.nodes[parent.index()].instance;
        let own = &self.scene.nodes[self.scene.instances[instance].index()].name;
        let name = format!("{own}.{name}");
        self.push(Node { name, parent: Some(parent), instance, rest, joint, end: 0 })
    }

    fn push(&mut self, node: Node) -> NodeId {
        let id = NodeId(self.scene.nodes.len() as u32);
        self.scene.by_name.insert(node.name.clone(), id);
        self.scene.nodes.push(node);
        id
    }

    /// The frame called so.
    pub fn find(&self, name: &str) -> Option<NodeId> {
        self.scene.find(name)
    }

    /// The mesh that `key` stands for; made by `make` where nobody asked for it before.
    pub fn mesh(&mut self, key: &str, make: impl FnOnce(&mut Mesh)) -> MeshId {
        if let Some(id) = self.by_key.get(key) {
            return *id;
        }
        let mut mesh = Mesh::new(key);
        make(&mut mesh);
        let id = self.take(Arc::new(mesh));
        self.by_key.insert(key.to_owned(), id);
        id
    }

    /// The mesh that others may have as well: the same one is taken in once.
    pub fn shared(&mut self, mesh: &Arc<Mesh>) -> MeshId {
        let key = Arc::as_ptr(mesh).addr();
        if let Some(id) = self.by_address.get(&key) {
            return *id;
        }
        let id = self.take(Arc::clone(mesh));
        self.by_address.insert(key, id);
        id
    }

    fn take(&mut self, mesh: Arc<Mesh>) -> MeshId {
        self.scene.meshes.push(mesh);
        MeshId(self.scene.meshes.len() as u32 - 1)
    }

    /// Hangs a mesh up at `place` of a frame; something that others can run into.
    pub fn solid(&mut self, node: NodeId, mesh: MeshId, place: DPose3, colour: Colour) {
        self.scene.bodies.push(Body { node, mesh, place, colour, is_solid: true, bears_parts: false });
    }

    /// Hangs a mesh up that parts lie on or are pushed by; others can run into it.
    pub fn bearing(&mut self, node: NodeId, mesh: MeshId, place: DPose3, colour: Colour) {
        self.scene.bodies.push(Body { node, mesh, place, colour, is_solid: true, bears_parts: true });
    }

    /// Hangs a mesh up that is there for the eye alone.
    pub fn shown(&mut self, node: NodeId, mesh: MeshId, place: DPose3, colour: Colour) {
        self.scene.bodies.push(Body { node, mesh, place, colour, is_solid: false, bears_parts: false });
    }

    /// Adds the beam that the instance of `node` reports as `report`.
    pub fn beam(&mut self, node: NodeId, report: &str, ends: [DVec3; 2]) {
        let own = &self.scene.nodes[self.scene.instances[self.scene.nodes[node.index()].instance].index()].name;
        self.scene.beams.push(BeamMark { name: format!("{own}.{report}"), node, ends });
    }

    /// The scene, its frames in depth-first order.
    pub fn finish(self) -> Scene {
        let mut scene = self.scene;
        let count = scene.nodes.len();
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); count];
        let mut roots = Vec::new();
        for (index, node) in scene.nodes.iter().enumerate() {
            match node.parent {
                Some(parent) => children[parent.index()].push(index),
                None => roots.push(index),
            }
        }
        let mut order = Vec::with_capacity(count);
        let mut waiting: Vec<usize> = roots.into_iter().rev().collect();
        while let Some(index) = waiting.pop() {
            order.push(index);
            waiting.extend(children[index].iter().rev());
        }
        let mut places = vec![NodeId(0); count];
        order.iter().enumerate().for_each(|(place, index)| places[*index] = NodeId(place as u32));
        let mut nodes: Vec<Option<Node>> = scene.nodes.into_iter().map(Some).collect();
        scene.nodes = order.iter().filter_map(|index| nodes[*index].take()).collect();
        for node in &mut scene.nodes {
            node.parent = node.parent.map(|parent| places[parent.index()]);
        }
        for index in (0..count).rev() {
            let end = scene.nodes[index].end.max(index as u32 + 1);
            scene.nodes[index].end = end;
            if let Some(parent) = scene.nodes[index].parent {
                let parent = &mut scene.nodes[parent.index()];
                parent.end = parent.end.max(end);
            }
        }
        scene.bodies.iter_mut().for_each(|body| body.node = places[body.node.index()]);
        scene.beams.iter_mut().for_each(|beam| beam.node = places[beam.node.index()]);
        scene.instances.iter_mut().for_each(|node| *node = places[node.index()]);
        scene.by_name.values_mut().for_each(|node| *node = places[node.index()]);
        scene
    }
}
