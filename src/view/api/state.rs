//! What is now: time, what is forced and broken, parts; statistics; what happened.

use std::collections::BTreeMap;
use std::sync::Arc;

use axum::Json;
use axum::extract::{Query, State};
use serde::Deserialize;
use serde_json::{Value, json};

use super::super::frame::Frame;
use super::super::{Source, Stage};
use crate::plant::PartKind;
use crate::run::{ServerPlace, Speed};

/// `GET /api/state`.
pub async fn state(State(stage): State<Arc<Stage>>) -> Json<Value> {
    let frame = stage.newest();
    let picture = &frame.picture;
    let map = &stage.plant.signal_map;
    let forcing = stage.forcing().clone();
    let held = |sticks: bool| -> Vec<Value> {
        let of = picture.held.iter().filter(|held| held.sticks == sticks);
        of.map(|held| {
            let name = &map.signal(held.signal).name;
            json!({"name": name, "value": held.value.to_f64(), "by": forcing.get(name)})
        })
        .collect()
    };
    let parts = picture.frame.parts.iter().map(|part| {
        json!({
            "number": part.number,
            "kind": if part.kind == PartKind::Box { "box" } else { "pallet" },
            "size": part.size, "place": part.place, "turn": part.yaw,
        })
    });
    let mut out = json!({
        "run": frame.run,
        "at_s": picture.frame.now.seconds(),
        "speed": frame.speed,
        "paused": picture.paused,
        "forced": held(false),
        "faults": {"signals": held(true), "drives": picture.dead, "message": picture.loses},
        "parts": parts.collect::<Vec<Value>>(),
        "viewers": stage.looking(),
    });
    if let Source::Live(live) = &stage.source {
        out["steps"] = json!(picture.frame.steps);
        out["ended"] = json!(live.has_ended());
        out["connected"] = json!(live.exchange().connected);
        out["recording"] = json!(live.recording().map(|path| path.display().to_string()));
    }
    Json(out)
}

/// `GET /api/statistics`.
pub async fn statistics(State(stage): State<Arc<Stage>>) -> Json<Value> {
    let frame = stage.newest();
    let Frame { picture, .. } = &*frame;
    let (now, counts) = (picture.frame.now.seconds(), &picture.frame.counts);
    let an_hour = |count: u64| if now > 0.0 { json!(count as f64 / now * 3600.0) } else { Value::Null };
    let mut out = json!({
        "at_s": now,
        "boxes": {
            "in": counts.boxes_in, "out": counts.boxes_out, "lost": counts.boxes_lost, "present": counts.boxes_present,
            "removed": counts.boxes_removed, "out_an_hour": an_hour(counts.boxes_out),
        },
        "pallets": {
            "in": counts.pallets_in, "out": counts.pallets_out, "lost": counts.pallets_lost,
            "present": counts.pallets_present, "removed": counts.pallets_removed,
        },
        "collisions": counts.collisions,
        "occupancy": picture.occupancy.iter().map(|(device, busy)| {
            (device.clone(), if now > 0.0 { json!(busy / now) } else { Value::Null })
        }).collect::<BTreeMap<String, Value>>(),
    });
    if let Source::Live(live) = &stage.source {
        let facts = live.facts();
        let traffic = live.exchange().traffic;
        out["steps"] = json!(picture.frame.steps);
        out["step_s"] = json!(facts.step.as_secs_f64());
        out["overruns"] = json!(picture.frame.overruns);
        out["late_steps"] = json!(picture.frame.late_steps);
        out["step_us"] = json!(picture.frame.step_us);
        out["round_trip_us"] = json!(live.round_trip());
        out["messages"] =
            json!({"in": traffic.messages_in, "out": traffic.messages_out, "lost": traffic.messages_lost});
        out["values"] = json!({"in": traffic.values_in, "out": traffic.values_out});
        out["server"] = json!(facts.server.to_string());
        out["lockstep"] = json!(facts.server == ServerPlace::Memory);
        out["can_be_max"] = json!(facts.speed == Speed::Max);
    }
    Json(out)
}

#[derive(Deserialize)]
pub struct After {
    #[serde(default)]
    after: u64,
}

/// `GET /api/events`.
pub async fn events(State(stage): State<Arc<Stage>>, Query(After { after }): Query<After>) -> Json<Value> {
    Json(json!({"events": stage.told.since(after)}))
}
