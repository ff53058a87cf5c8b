//! What does not change about what is looked at: the plant's devices, signals and shape, as JSON, and its meshes as they are
//! drawn.

use serde_json::{Value, json};

use super::{Source, Stage};
use crate::kinematics::DPose3;
use crate::mesh::Mesh;
use crate::plant::{EffectSpec, Instance, ParameterValue, PartKind, Plant};
use crate::prototype::quantity::si_unit;
use crate::scene::{Scene, part_colour};
use crate::signal_map::{Direction, Kind, RateClass, Signal};

/// `GET /api/plant`.
pub fn plant(stage: &Stage) -> Value {
    let Stage { plant, scene, source, .. } = stage;
    let (mode, ends_s, ghost) = match source {
        Source::Live(_) => ("live", Value::Null, Value::Null),
        Source::Playback(playback) => ("playback", json!(playback.ends().seconds()), playback.ghost_name()),
    };
    let (trace, markers) = match source {
        Source::Live(_) => (Value::Null, json!([])),
        Source::Playback(playback) => (json!(playback.name()), playback.markers()),
    };
    json!({
        "model": stage.model,
        "name": plant.name,
        "mode": mode,
        "trace": trace,
        "markers": markers,
        "ghost": ghost,
        "ends_s": ends_s,
        "needs_token": stage.needs_token,
        "has_report": stage.report.is_some(),
        "devices": plant.instances.iter().map(device).collect::<Vec<Value>>(),
        "signals": plant.signal_map.signals().iter().map(signal).collect::<Vec<Value>>(),
        "scene": shape(plant, scene),
    })
}

fn device(instance: &Instance) -> Value {
    let tasks = instance.tasks.iter().map(|task| {
        let parameters = task.kind.parameters.iter().filter_map(|declared| {
            let parameter = task.parameters.0.get(declared.name)?;
            let unit = declared.quantities.first().map(|quantity| si_unit(*quantity).symbol);
            Some(json!({
                "name": declared.name, "value": value(&parameter.value), "unit": unit, "summary": declared.summary,
            }))
        });
        json!({
            "name": task.name, "kind": task.kind.name, "summary": task.kind.summary,
            "parameters": parameters.collect::<Vec<Value>>(),
        })
    });
    let effects = instance.effects.iter().map(|EffectSpec { place, kind, component, parameters }| {
        let parameters: serde_json::Map<String, Value> =
            parameters.iter().map(|(name, parameter)| (name.clone(), value(parameter))).collect();
        json!({"place": format!("{place:?}"), "kind": kind, "component": component, "parameters": parameters})
    });
    json!({
        "name": instance.name, "prototype": instance.prototype,
        "tasks": tasks.collect::<Vec<Value>>(), "effects": effects.collect::<Vec<Value>>(),
    })
}

fn value(value: &ParameterValue) -> Value {
    match value {
        ParameterValue::Number(number) => json!(number),
        ParameterValue::Integer(number) => json!(number),
        ParameterValue::Boolean(is) => json!(is),
        ParameterValue::Text(text) => json!(text),
        ParameterValue::Numbers(numbers) => json!(numbers),
    }
}

fn signal(signal: &Signal) -> Value {
    json!({
        "name": signal.name,
        "type": signal.ty.to_string(),
        "direction": match signal.direction { Direction::Command => "command", Direction::Report => "report" },
        "kind": match signal.kind { Kind::Edge => "edge", Kind::Level => "level" },
        "rate": match signal.rate { RateClass::HighFrequency => "hf", RateClass::LowFrequency => "lf" },
        "unit": signal.unit.symbol,
        "min": signal.min, "max": signal.max,
        "device": signal.instance, "task": signal.task, "property": signal.property,
    })
}

fn shape(plant: &Plant, scene: &Scene) -> Value {
    let nodes = scene.nodes().iter().map(|node| json!({"name": node.name, "device": node.instance}));
    let bodies = scene.bodies().iter().map(
        |body| json!({"node": body.node.0, "mesh": body.mesh.0, "place": pose(&body.place), "colour": body.colour}),
    );
    let beams = scene.beams().iter().map(|beam| {
        let signal = plant.signal_map.register(&beam.name).map(|register| register.0);
        json!({
            "name": beam.name, "node": beam.node.0, "ends": beam.ends.map(|end| end.to_array()), "signal": signal,
        })
    });
    json!({
        "nodes": nodes.collect::<Vec<Value>>(), "bodies": bodies.collect::<Vec<Value>>(),
        "beams": beams.collect::<Vec<Value>>(), "triangles": scene.triangles(),
        "parts": {"box": part_colour(PartKind::Box), "pallet": part_colour(PartKind::Pallet)},
    })
}

fn pose(pose: &DPose3) -> [f64; 7] {
    let (place, turn) = (pose.translation, pose.rotation);
    [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]
}

/// `GET /api/meshes`: little-endian; u32 how many, then for each u32 vertices, u32 triangles, f32 × 3 a vertex, u32 × 3 a
/// triangle.
pub fn meshes(scene: &Scene) -> Vec<u8> {
    let mut out = Vec::with_capacity(scene.meshes().iter().map(|mesh| mesh.vertices.len() * 36 + 8).sum());
    out.extend((scene.meshes().len() as u32).to_le_bytes());
    for mesh in scene.meshes() {
        let Mesh { vertices, triangles, .. } = &**mesh;
        out.extend((vertices.len() as u32).to_le_bytes());
        out.extend((triangles.len() as u32).to_le_bytes());
        vertices.iter().flatten().for_each(|number| out.extend(number.to_le_bytes()));
        triangles.iter().flatten().for_each(|index| out.extend(index.to_le_bytes()));
    }
    out
}
