//! The endpoints. `openapi.json` describes them; a test holds the two together.

mod faults;
mod gap;
mod parts;
mod record;
mod run;
mod signals;
mod state;
#[cfg(test)]
mod tests;
mod time;

use std::sync::Arc;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{DefaultBodyLimit, State};
use axum::http::header::{CACHE_CONTROL, CONTENT_TYPE, HeaderName, HeaderValue};
use axum::http::{Method, StatusCode, Uri};
use axum::response::{IntoResponse, Response};
use axum::routing::{delete, get, post, put};
use axum::{Json, Router, middleware};
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::answer::{Answer, Refusal};
use super::guard::{self, Guard};
use super::live::Live;
use super::playback::Playback;
use super::{Source, Stage, assets, description, stream};

/// The largest body that is read. What a request has to say fits into a hundredth of it.
pub(super) const LARGEST_BODY: usize = 64 * 1024;

/// Every endpoint: its method, and its path as the description has it.
pub const ROUTES: &[(&str, &str)] = &[
    ("get", "/api/openapi.json"),
    ("get", "/api/plant"),
    ("get", "/api/meshes"),
    ("get", "/api/stream"),
    ("get", "/api/state"),
    ("get", "/api/statistics"),
    ("get", "/api/events"),
    ("get", "/api/signals"),
    ("get", "/api/signals/{name}"),
    ("put", "/api/signals/{name}/force"),
    ("delete", "/api/signals/{name}/force"),
    ("get", "/api/signals/{name}/history"),
    ("delete", "/api/forces"),
    ("post", "/api/run/pause"),
    ("post", "/api/run/resume"),
    ("post", "/api/run/step"),
    ("post", "/api/run/speed"),
    ("post", "/api/run/reset"),
    ("post", "/api/parts"),
    ("delete", "/api/parts/{number}"),
    ("put", "/api/faults/signals/{name}"),
    ("delete", "/api/faults/signals/{name}"),
    ("put", "/api/faults/drives/{device}"),
    ("delete", "/api/faults/drives/{device}"),
    ("put", "/api/faults/message"),
    ("delete", "/api/faults/message"),
    ("post", "/api/recording"),
    ("delete", "/api/recording"),
    ("get", "/api/playback"),
    ("post", "/api/playback"),
    ("get", "/api/report"),
    ("get", "/api/report/page"),
];

/// All that is served of `stage`, behind `guard`.
pub(super) fn router(stage: Arc<Stage>, guard: Arc<Guard>) -> Router {
    Router::new()
        .route("/", get(assets::index))
        .route("/assets/{file}", get(assets::asset))
        .route("/api/openapi.json", get(openapi))
        .route("/api/plant", get(plant))
        .route("/api/meshes", get(meshes))
        .route("/api/stream", get(stream::stream))
        .route("/api/state", get(state::state))
        .route("/api/statistics", get(state::statistics))
        .route("/api/events", get(state::events))
        .route("/api/signals", get(signals::all))
        .route("/api/signals/{name}", get(signals::one))
        .route("/api/signals/{name}/force", put(signals::force).delete(signals::release))
        .route("/api/signals/{name}/history", get(time::history))
        .route("/api/forces", delete(signals::release_all))
        .route("/api/run/pause", post(run::pause))
        .route("/api/run/resume", post(run::resume))
        .route("/api/run/step", post(run::step))
        .route("/api/run/speed", post(run::speed))
        .route("/api/run/reset", post(run::reset))
        .route("/api/parts", post(parts::insert))
        .route("/api/parts/{number}", delete(parts::remove))
        .route("/api/faults/signals/{name}", put(faults::stick).delete(faults::unstick))
        .route("/api/faults/drives/{device}", put(faults::stop).delete(faults::start))
        .route("/api/faults/message", put(faults::lose).delete(faults::keep))
        .route("/api/recording", post(record::begin).delete(record::end))
        .route("/api/playback", get(time::playback).post(time::set))
        .route("/api/report", get(gap::report))
        .route("/api/report/page", get(gap::page))
        .fallback(nothing)
        .method_not_allowed_fallback(not_so)
        .layer(DefaultBodyLimit::max(LARGEST_BODY))
        .layer(middleware::from_fn_with_state(guard, guard::watch))
        .with_state(stage)
}

const OPENAPI: &str = include_str!("../openapi.json");

async fn openapi() -> Response {
    ([(CONTENT_TYPE, "application/json"), (CACHE_CONTROL, "no-cache")], OPENAPI).into_response()
}

async fn plant(State(stage): State<Arc<Stage>>) -> Json<Value> {
    Json(description::plant(&stage))
}

async fn meshes(State(stage): State<Arc<Stage>>) -> Response {
    let plain: [(HeaderName, HeaderValue); 1] = [(CONTENT_TYPE, HeaderValue::from_static("application/octet-stream"))];
    (plain, description::meshes(&stage.scene)).into_response()
}

async fn nothing(uri: Uri) -> Refusal {
    Refusal::absent(format!("there is no {:?}", uri.path()), "GET /api/openapi.json describes what there is")
}

async fn not_so(method: Method, uri: Uri) -> Refusal {
    Refusal::new(
        StatusCode::METHOD_NOT_ALLOWED,
        format!("{:?} does not take {method}", uri.path()),
        "GET /api/openapi.json describes what there is",
    )
}

/// A body, or why it was not read.
type Body = Result<Bytes, BytesRejection>;

/// Reads a body as JSON; one that is empty as `{}`.
fn read<T: DeserializeOwned>(body: Body) -> Answer<T> {
    let bytes = body.map_err(|rejection| match rejection.status() {
        StatusCode::PAYLOAD_TOO_LARGE => Refusal::new(
            StatusCode::PAYLOAD_TOO_LARGE,
            format!("the body is longer than {LARGEST_BODY} bytes"),
            "no request of this interface needs as much",
        ),
        status => Refusal::new(status, rejection.body_text(), "send the body whole"),
    })?;
    let text = if bytes.is_empty() { b"{}" } else { bytes.as_ref() };
    serde_json::from_slice(text).map_err(|error| {
        Refusal::malformed(
            format!("the body is not what this endpoint takes: {error}"),
            "GET /api/openapi.json describes the body; it is JSON",
        )
    })
}

impl Stage {
    /// The run, where one is looked at.
    fn run(&self) -> Answer<&Live> {
        match &self.source {
            Source::Live(live) => Ok(live),
            Source::Playback(_) => Err(Refusal::conflict(
                "this is a recorded trace: it cannot be changed",
                "kinetwin run MODEL --view serves a run that can",
            )),
        }
    }

    /// The recorded trace, where one is looked at.
    fn trace(&self) -> Answer<&Playback> {
        match &self.source {
            Source::Playback(playback) => Ok(playback),
            Source::Live(_) => Err(Refusal::conflict(
                "this is a run that goes on: its time is only its own",
                "kinetwin view TRACE --model MODEL serves a trace",
            )),
        }
    }
}
