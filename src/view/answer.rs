//! What a request is answered with: JSON, and for what cannot be done what, why, and what to do instead.

use std::time::Duration;

use axum::Json;
use axum::http::StatusCode;
use axum::http::header::{CONTENT_TYPE, HeaderValue};
use axum::response::{IntoResponse, Response};
use serde_json::{Value, json};

use crate::engine::ActError;
use crate::run::control::{Busy, Receipt};
use crate::time::Instant;
use crate::trace::operator::DeedError;

/// Why a request was not done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    pub status: StatusCode,
    /// What is wrong, in a sentence.
    pub error: String,
    /// What to do.
    pub hint: String,
}

/// What a handler gives.
pub type Answer<T = Json<Value>> = Result<T, Refusal>;

impl Refusal {
    /// A refusal of this status.
    pub fn new(status: StatusCode, error: impl Into<String>, hint: impl Into<String>) -> Refusal {
        Refusal { status, error: error.into(), hint: hint.into() }
    }

    /// A request that says nothing that could be done.
    pub fn malformed(error: impl Into<String>, hint: impl Into<String>) -> Refusal {
        Refusal::new(StatusCode::BAD_REQUEST, error, hint)
    }

    /// Something that is not there.
    pub fn absent(error: impl Into<String>, hint: impl Into<String>) -> Refusal {
        Refusal::new(StatusCode::NOT_FOUND, error, hint)
    }

    /// Something that goes against what is.
    pub fn conflict(error: impl Into<String>, hint: impl Into<String>) -> Refusal {
        Refusal::new(StatusCode::CONFLICT, error, hint)
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        let body = json!({"error": self.error, "hint": self.hint});
        let mut response = (self.status, Json(body)).into_response();
        response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static("application/json"));
        response
    }
}

impl From<DeedError> for Refusal {
    fn from(error: DeedError) -> Refusal {
        let text = error.to_string();
        match error {
            DeedError::Unknown { .. } => Refusal::absent(text, "GET /api/signals lists all signals"),
            DeedError::Form(_) | DeedError::Value { .. } => {
                Refusal::malformed(text, "send a value of the signal's type; GET /api/plant says which that is")
            }
        }
    }
}

impl From<ActError> for Refusal {
    fn from(error: ActError) -> Refusal {
        let text = error.to_string();
        match error {
            ActError::Unfit => Refusal::malformed(text, "send a finite number, or true or false"),
            ActError::NotHeld | ActError::Whole => Refusal::conflict(text, "GET /api/state says what is"),
            ActError::NoReport => Refusal::malformed(text, "force a command instead"),
            ActError::NoBelt { .. } | ActError::NoDrive { .. } => {
                Refusal::absent(text, "GET /api/plant lists all devices with their kinds")
            }
            ActError::NoRoom(_) => Refusal::conflict(text, "GET /api/state lists the parts and where they stand"),
            ActError::NoPart { .. } => Refusal::absent(text, "GET /api/state lists the parts"),
        }
    }
}

impl From<Busy> for Refusal {
    fn from(error: Busy) -> Refusal {
        Refusal::new(StatusCode::SERVICE_UNAVAILABLE, error.to_string(), "send fewer requests at a time")
    }
}

/// How often an answer of the simulation is looked for.
const LOOK: Duration = Duration::from_millis(2);

/// Waits until the simulation has come to an order. The simulated time from which on it counts.
pub async fn settled(receipt: Receipt, patience: Duration) -> Answer<Instant> {
    let looked = async {
        loop {
            if let Some(outcome) = receipt.outcome() {
                return outcome.clone();
            }
            tokio::time::sleep(LOOK).await;
        }
    };
    match tokio::time::timeout(patience, looked).await {
        Ok(outcome) => Ok(outcome?),
        Err(_) => Err(Refusal::new(
            StatusCode::GATEWAY_TIMEOUT,
            format!("the simulation did not come to it within {patience:?}"),
            "GET /api/state says whether the run goes on",
        )),
    }
}
