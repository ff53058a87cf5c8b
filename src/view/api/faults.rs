//! Faults on demand: a report that sticks, a drive without power, a lost message.

use std::sync::Arc;

use axum::extract::{Path, State};

use super::super::Stage;
use super::super::answer::Answer;
use super::parts::done;
use crate::trace::operator::{Broken, Deed};

/// `PUT /api/faults/signals/{name}`.
pub async fn stick(State(stage): State<Arc<Stage>>, Path(name): Path<String>) -> Answer {
    done(&stage, &Deed::Break(Broken::Signal(name))).await
}

/// `DELETE /api/faults/signals/{name}`.
pub async fn unstick(State(stage): State<Arc<Stage>>, Path(name): Path<String>) -> Answer {
    done(&stage, &Deed::Mend(Broken::Signal(name))).await
}

/// `PUT /api/faults/drives/{device}`.
pub async fn stop(State(stage): State<Arc<Stage>>, Path(device): Path<String>) -> Answer {
    done(&stage, &Deed::Break(Broken::Drive(device))).await
}

/// `DELETE /api/faults/drives/{device}`.
pub async fn start(State(stage): State<Arc<Stage>>, Path(device): Path<String>) -> Answer {
    done(&stage, &Deed::Mend(Broken::Drive(device))).await
}

/// `PUT /api/faults/message`.
pub async fn lose(State(stage): State<Arc<Stage>>) -> Answer {
    done(&stage, &Deed::Break(Broken::Message)).await
}

/// `DELETE /api/faults/message`.
pub async fn keep(State(stage): State<Arc<Stage>>) -> Answer {
    done(&stage, &Deed::Mend(Broken::Message)).await
}
