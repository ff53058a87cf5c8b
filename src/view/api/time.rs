//! The time of a recorded trace: where it is, how it goes by, and what a signal was at all times.

use std::sync::Arc;

use axum::Json;
use axum::extract::{Path, State};
use serde::Deserialize;
use serde_json::json;

use super::super::Stage;
use super::super::answer::{Answer, Refusal};
use super::{Body, read};

/// `GET /api/playback`.
pub async fn playback(State(stage): State<Arc<Stage>>) -> Answer {
    Ok(Json(stage.trace()?.describe()))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Setting {
    time_s: Option<f64>,
    speed: Option<f64>,
    paused: Option<bool>,
}

/// `POST /api/playback`.
pub async fn set(State(stage): State<Arc<Stage>>, body: Body) -> Answer {
    let Setting { time_s, speed, paused } = read(body)?;
    let playback = stage.trace()?;
    let is_speed = |speed: f64| (-1000.0..=1000.0).contains(&speed);
    if !time_s.is_none_or(f64::is_finite) || !speed.is_none_or(is_speed) {
        return Err(Refusal::malformed(
            "expected a finite time, and a speed from -1000 to 1000",
            "send {\"speed\":-1}",
        ));
    }
    playback.set(time_s, speed, paused);
    Ok(Json(playback.describe()))
}

/// `GET /api/signals/{name}/history`.
pub async fn history(State(stage): State<Arc<Stage>>, Path(name): Path<String>) -> Answer {
    let playback = stage.trace()?;
    let unknown = || Refusal::absent(format!("the plant has no signal {name:?}"), "GET /api/signals lists all signals");
    let register = stage.plant.signal_map.register(&name).ok_or_else(unknown)?;
    Ok(Json(json!({
        "name": name,
        "ends_s": playback.ends().seconds(),
        "trace": playback.history(register),
        "ghost": playback.ghost_history(register),
    })))
}
