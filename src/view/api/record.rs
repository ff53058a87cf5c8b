//! Recording the session, begun and ended while the run goes on.

use std::path::PathBuf;
use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use serde::Deserialize;
use serde_json::json;

use super::super::Stage;
use super::super::answer::{Answer, Refusal};
use super::{Body, read};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Recording {
    file: String,
}

/// A file of the folder that the program was started in, and no other: whoever may record may not write elsewhere.
fn plain(file: &str) -> Answer<PathBuf> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "._- ".contains(c);
    let is_trace = file.ends_with(".cps.jsonl") || file.ends_with(".cps.jsonl.zst");
    if is_trace && file.len() <= 120 && !file.starts_with(['.', '-', ' ']) && file.chars().all(is_plain) {
        return Ok(PathBuf::from(file));
    }
    Err(Refusal::malformed(
        format!("{file:?} is no name for a trace"),
        "name a file without a folder, of letters, digits, dots and dashes, that ends with .cps.jsonl or .cps.jsonl.zst",
    ))
}

/// `POST /api/recording`.
pub async fn begin(State(stage): State<Arc<Stage>>, body: Body) -> Answer {
    let Recording { file } = read(body)?;
    stage.run()?.record(plain(&file)?).await?;
    Ok(Json(json!({"recording": file})))
}

/// `DELETE /api/recording`.
pub async fn end(State(stage): State<Arc<Stage>>) -> Answer {
    match stage.run()?.stop_recording().await? {
        Some(path) => Ok(Json(json!({"recorded": path.display().to_string()}))),
        None => Err(Refusal::conflict("nothing is being recorded", "POST /api/recording begins")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_plain_name_is_recorded_to() {
        for good in ["a.cps.jsonl", "run 2026-01-31.cps.jsonl.zst"] {
            assert_eq!(plain(good), Ok(PathBuf::from(good)));
        }
        for bad in ["../a.cps.jsonl", "/tmp/a.cps.jsonl", "a.txt", ".cps.jsonl", "a/b.cps.jsonl", "a\\b.cps.jsonl", ""]
        {
            assert!(plain(bad).is_err(), "{bad}");
        }
    }
}
