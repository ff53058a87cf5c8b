//! What a replay looks like, as messages that Foxglove draws: `foxglove.FrameTransforms` on `/tf`, and
//! `foxglove.SceneUpdate` on `/scene` (the devices, once) and `/parts` (whenever a part moved).
//!
//! The schemas beside this file are Foxglove's own (package `@foxglove/schemas` 2.1.0, MIT), their descriptions left out.

use std::collections::BTreeMap;
use std::io::Write;

use mcap::records::MessageHeader;
use mcap::write::NoSeek;
use mcap::{McapError, Writer};
use serde_json::{Value, json};

use crate::engine::{Engine, PartState};
use crate::kinematics::{DPose3, DVec3, Upright};
use crate::mesh::Mesh;
use crate::replay::Reported;
use crate::scene::{Body, Colour, NodeId, Scene, part_colour};
use crate::time::Instant;

const FRAME_TRANSFORMS: &str = include_str!("foxglove/FrameTransforms.json");
const SCENE_UPDATE: &str = include_str!("foxglove/SceneUpdate.json");

/// Pictures a simulated second.
const RATE: i64 = 30;
/// The frame that all others stand in.
const WORLD: &str = "world";

/// Writes what an engine that shows its scene looks like, tick by tick.
pub struct Pictures<'a, W: Write> {
    writer: &'a mut Writer<NoSeek<W>>,
    transforms: u16,
    scene: u16,
    parts: u16,
    sequence: u32,
    next: i64,
    seen: Option<u64>,
    last: Vec<PartState>,
    /// Who stands where it reported; nobody of a simulation.
    machine: Option<Reported>,
    /// Messages written.
    pub written: u64,
}

impl<'a, W: Write> Pictures<'a, W> {
    /// Adds the channels to `writer`. Where it is a `machine`'s recording, the machine is seen as far as it reported itself.
    pub fn new(writer: &'a mut Writer<NoSeek<W>>, machine: Option<Reported>) -> Result<Pictures<'a, W>, McapError> {
        let of_frames = writer.add_schema("foxglove.FrameTransforms", "jsonschema", FRAME_TRANSFORMS.as_bytes())?;
        let of_scene = writer.add_schema("foxglove.SceneUpdate", "jsonschema", SCENE_UPDATE.as_bytes())?;
        let none = BTreeMap::new();
        let transforms = writer.add_channel(of_frames, "/tf", "json", &none)?;
        let scene = writer.add_channel(of_scene, "/scene", "json", &none)?;
        let parts = writer.add_channel(of_scene, "/parts", "json", &none)?;
        Ok(Pictures {
            writer,
            transforms,
            scene,
            parts,
            sequence: 0,
            next: 0,
            seen: None,
            last: Vec::new(),
            machine,
            written: 0,
        })
    }

    /// Writes what changed since the last picture, where another is due.
    pub fn take(&mut self, engine: &mut Engine) -> Result<(), McapError> {
        let now = engine.now();
        if now.nanos() < self.next {
            return Ok(());
        }
        let parts = match &self.machine {
            Some(machine) => machine.show(engine),
            None => engine.parts().collect(),
        };
        let Some(poses) = engine.poses() else { return Ok(()) };
        self.next = (now.nanos() * RATE / 1_000_000_000 + 1) * 1_000_000_000 / RATE;
        let scene = poses.scene();
        let moved: Vec<(NodeId, &DPose3)> = match self.seen {
            Some(version) => poses.moved_since(version).collect(),
            None => (0u32..).map(NodeId).zip(poses.all()).collect(),
        };
        let transforms: Vec<Value> =
            moved.iter().map(|(node, pose)| transform(now, &scene.node(*node).name, pose)).collect();
        if !transforms.is_empty() {
            self.write(self.transforms, now, &json!({"transforms": transforms}))?;
        }
        if self.seen.is_none() {
            self.write(self.scene, now, &json!({"deletions": [], "entities": devices(now, scene)}))?;
        }
        self.seen = Some(poses.version());
        if parts != self.last {
            self.write(self.parts, now, &parts_update(now, &self.last, &parts))?;
            self.last = parts;
        }
        Ok(())
    }

    fn write(&mut self, channel_id: u16, at: Instant, message: &Value) -> Result<(), McapError> {
        let time = at.nanos().unsigned_abs();
        let header = MessageHeader { channel_id, sequence: self.sequence, log_time: time, publish_time: time };
        self.sequence += 1;
        self.written += 1;
        self.writer.write_to_known_channel(&header, message.to_string().as_bytes())
    }
}

fn time(at: Instant) -> Value {
    let nanos = at.nanos().unsigned_abs();
    json!({"sec": nanos / 1_000_000_000, "nsec": nanos % 1_000_000_000})
}

fn vector([x, y, z]: [f64; 3]) -> Value {
    json!({"x": x, "y": y, "z": z})
}

fn pose(pose: &DPose3) -> Value {
    let turn = pose.rotation;
    json!({
        "position": vector(pose.translation.to_array()),
        "orientation": {"x": turn.x, "y": turn.y, "z": turn.z, "w": turn.w},
    })
}

fn transform(at: Instant, name: &str, pose: &DPose3) -> Value {
    let turn = pose.rotation;
    json!({
        "timestamp": time(at), "parent_frame_id": WORLD, "child_frame_id": name,
        "translation": vector(pose.translation.to_array()),
        "rotation": {"x": turn.x, "y": turn.y, "z": turn.z, "w": turn.w},
    })
}

fn colour([r, g, b]: Colour) -> Value {
    let share = |part: u8| f64::from(part) / 255.0;
    json!({"r": share(r), "g": share(g), "b": share(b), "a": 1.0})
}

/// An entity of the frame called `frame`, with nothing in it yet.
fn entity(at: Instant, frame: &str, id: &str) -> Value {
    json!({
        "timestamp": time(at), "frame_id": frame, "id": id, "lifetime": {"sec": 0, "nsec": 0}, "frame_locked": true,
        "metadata": [], "arrows": [], "cubes": [], "spheres": [], "cylinders": [], "lines": [], "triangles": [],
        "texts": [], "models": [],
    })
}

/// One entity for every frame that something hangs on.
fn devices(at: Instant, scene: &Scene) -> Vec<Value> {
    let mut of_node: BTreeMap<u32, Vec<&Body>> = BTreeMap::new();
    for body in scene.bodies() {
        of_node.entry(body.node.0).or_default().push(body);
    }
    let one = |(node, bodies): (&u32, &Vec<&Body>)| {
        let name = &scene.node(NodeId(*node)).name;
        let mut entity = entity(at, name, name);
        entity["triangles"] = bodies.iter().map(|body| triangles(&scene.meshes()[body.mesh.index()], body)).collect();
        entity
    };
    of_node.iter().map(one).collect()
}

fn triangles(mesh: &Mesh, body: &Body) -> Value {
    let points: Vec<Value> = mesh.vertices.iter().map(|place| vector(place.map(f64::from))).collect();
    let indices: Vec<u32> = mesh.triangles.iter().flatten().copied().collect();
    json!({
        "pose": pose(&body.place), "points": points, "color": colour(body.colour), "colors": [], "indices": indices,
    })
}

/// The parts that are new or moved, and those that have gone.
fn parts_update(at: Instant, before: &[PartState], now: &[PartState]) -> Value {
    let gone = before.iter().filter(|part| !now.iter().any(|other| other.number == part.number));
    let deletions: Vec<Value> =
        gone.map(|part| json!({"timestamp": time(at), "type": 0, "id": format!("part {}", part.number)})).collect();
    let moved = now.iter().filter(|part| !before.contains(part));
    let entities: Vec<Value> = moved
        .map(|part| {
            let mut entity = entity(at, WORLD, &format!("part {}", part.number));
            let upright = Upright { place: DVec3::from_array(part.place), yaw: part.yaw };
            let mut centre = upright.pose();
            centre.translation.z += part.size[2] / 2.0;
            entity["cubes"] =
                json!([{"pose": pose(&centre), "size": vector(part.size), "color": colour(part_colour(part.kind))}]);
            entity
        })
        .collect();
    json!({"deletions": deletions, "entities": entities})
}
