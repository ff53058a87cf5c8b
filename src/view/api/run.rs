//! How simulated time goes by: pause, step, speed, reset.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use serde::Deserialize;
use serde_json::{Value, json};

use super::super::Stage;
use super::super::answer::{Answer, Refusal};
use super::{Body, read};
use crate::run::Speed;
use crate::time::Instant;

/// The most steps of one request: ten minutes at the usual step.
const MOST_STEPS: u64 = 600_000;

pub(super) fn at(instant: Instant) -> Json<Value> {
    Json(json!({"at_s": instant.seconds()}))
}

/// `POST /api/run/pause`.
pub async fn pause(State(stage): State<Arc<Stage>>) -> Answer {
    Ok(at(stage.run()?.pause(true).await?))
}

/// `POST /api/run/resume`.
pub async fn resume(State(stage): State<Arc<Stage>>) -> Answer {
    Ok(at(stage.run()?.pause(false).await?))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Steps {
    #[serde(default = "one")]
    steps: u64,
}

fn one() -> u64 {
    1
}

/// `POST /api/run/step`.
pub async fn step(State(stage): State<Arc<Stage>>, body: Body) -> Answer {
    let Steps { steps } = read(body)?;
    if !(1..=MOST_STEPS).contains(&steps) {
        return Err(Refusal::malformed(format!("{steps} steps: expected 1 to {MOST_STEPS}"), "ask several times"));
    }
    Ok(at(stage.run()?.step(steps).await?))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Factor {
    factor: Word,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Word {
    Number(f64),
    Text(String),
}

/// `POST /api/run/speed`.
pub async fn speed(State(stage): State<Arc<Stage>>, body: Body) -> Answer {
    let Factor { factor } = read(body)?;
    let run = stage.run()?;
    let is_stepped = run.facts().speed == Speed::Max;
    let speed = match factor {
        Word::Number(factor) if (0.01..=1000.0).contains(&factor) => Speed::Wall(factor),
        Word::Text(word) if word == "max" && is_stepped => Speed::Max,
        Word::Text(word) if word == "max" => {
            return Err(Refusal::conflict(
                "only a run in lock-step can go as fast as the computer can",
                "start it with --speed max; it can be slowed down to any speed then",
            ));
        }
        _ => {
            return Err(Refusal::malformed(
                "the speed is neither a number from 0.01 to 1000 nor max",
                "send {\"factor\":2}",
            ));
        }
    };
    Ok(at(run.set_speed(speed).await?))
}

/// `POST /api/run/reset`.
pub async fn reset(State(stage): State<Arc<Stage>>) -> Answer {
    stage.run()?.reset().await?;
    stage.forcing().clear();
    Ok(at(Instant::ZERO))
}
