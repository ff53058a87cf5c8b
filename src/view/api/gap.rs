//! The gap that a diagnosis found.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::header::{CONTENT_TYPE, HeaderValue};
use axum::response::{IntoResponse, Response};
use serde_json::json;

use super::super::answer::{Answer, Refusal};
use super::super::{ReportFiles, Stage, assets};

fn found(stage: &Stage) -> Answer<&ReportFiles> {
    let absent = || Refusal::absent("there is no report of a diagnosis", "start the program with --report FILE");
    stage.report.as_ref().ok_or_else(absent)
}

/// `GET /api/report`.
pub async fn report(State(stage): State<Arc<Stage>>) -> Answer {
    let report = &found(&stage)?.report;
    Ok(Json(json!({"answer": report.answer().place, "cause": report.answer().cause, "report": report})))
}

/// `GET /api/report/page`.
pub async fn page(State(stage): State<Arc<Stage>>) -> Answer<Response> {
    let mut response = found(&stage)?.page.clone().into_response();
    response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static("text/html; charset=utf-8"));
    assets::shield(response.headers_mut());
    Ok(response)
}
