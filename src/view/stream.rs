//! The WebSocket of one viewer.
//!
//! Its task takes the newest frame, sends what this viewer has not seen of it, and takes the newest again when that is sent:
//! what came in between, it never sees.

use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::State;
use axum::extract::ws::{Message, WebSocket, WebSocketUpgrade};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use tokio::sync::OwnedSemaphorePermit;

use super::answer::Refusal;
use super::frame::Seen;
use super::{Stage, VIEWERS};

/// The longest message that a viewer may send; none is looked at.
const LONGEST: usize = 4096;
/// The least time between two frames of one viewer: 60 a second.
const LIVELY: Duration = Duration::from_nanos(16_000_000);
/// How long a viewer may take for one message until it is given up: a browser that sleeps.
const PATIENCE: Duration = Duration::from_secs(20);

/// `GET /api/stream`.
pub async fn stream(State(stage): State<Arc<Stage>>, upgrade: WebSocketUpgrade) -> Response {
    let Ok(place) = Arc::clone(&stage.viewers).try_acquire_owned() else {
        let error = format!("{VIEWERS} viewers look already");
        let hint = "close one; a test bench can ask GET /api/state instead";
        return Refusal::new(StatusCode::SERVICE_UNAVAILABLE, error, hint).into_response();
    };
    let upgrade = upgrade.max_message_size(LONGEST).max_frame_size(LONGEST);
    upgrade.on_upgrade(move |socket| show(socket, stage, place))
}

async fn show(mut socket: WebSocket, stage: Arc<Stage>, _place: OwnedSemaphorePermit) {
    let mut frames = stage.frames.clone();
    frames.mark_changed();
    let mut seen = Seen::default();
    loop {
        tokio::select! {
            changed = frames.changed() => {
                if changed.is_err() {
                    return;
                }
                let sent = tokio::time::Instant::now();
                let frame = frames.borrow_and_update().clone();
                let message = Message::Binary(Bytes::from(seen.message(&frame)));
                drop(frame);
                match tokio::time::timeout(PATIENCE, socket.send(message)).await {
                    Ok(Ok(())) => tokio::time::sleep_until(sent + LIVELY).await,
                    // Gone, or asleep.
                    _ => return,
                }
            }
            message = socket.recv() => match message {
                // The socket answers pings; a viewer has nothing to say.
                Some(Ok(_)) => {}
                _ => return,
            },
        }
    }
}
