//! Signals: their values, and forcing them.

use std::collections::BTreeMap;
use std::sync::{Arc, MutexGuard, PoisonError};

use axum::Json;
use axum::extract::{Path, Query, State};
use serde::Deserialize;
use serde_json::{Value, json};

use super::super::Stage;
use super::super::answer::{Answer, Refusal};
use super::super::frame::Frame;
use super::run::at;
use super::{Body, read};
use crate::signal_map::RegisterId;
use crate::trace::operator::{Deed, NamedValue};
use crate::wire::{TextForm, write_value};

impl Stage {
    /// Who forces which signal.
    pub(super) fn forcing(&self) -> MutexGuard<'_, BTreeMap<String, String>> {
        self.forcing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn newest(&self) -> Arc<Frame> {
        self.frames.borrow().clone()
    }

    fn register(&self, name: &str) -> Answer<RegisterId> {
        let unknown =
            || Refusal::absent(format!("the plant has no signal {name:?}"), "GET /api/signals lists all signals");
        self.plant.signal_map.register(name).ok_or_else(unknown)
    }
}

/// A signal's value as it stands on the wire; null before there is one.
fn value(frame: &Frame, register: RegisterId) -> Value {
    let Some(value) = frame.picture.frame.registers.get(register.index()) else { return Value::Null };
    let mut text = String::new();
    match write_value(&mut text, value, TextForm::Base64) {
        Ok(()) => serde_json::from_str(&text).unwrap_or(Value::Null),
        Err(_) => Value::Null,
    }
}

#[derive(Deserialize)]
pub struct Filter {
    filter: Option<String>,
}

/// `GET /api/signals`.
pub async fn all(State(stage): State<Arc<Stage>>, Query(Filter { filter }): Query<Filter>) -> Json<Value> {
    let frame = stage.newest();
    let filter = filter.unwrap_or_default().to_lowercase();
    let signals = (0u32..).map(RegisterId).zip(stage.plant.signal_map.signals());
    let wanted = signals.filter(|(_, signal)| signal.name.to_lowercase().contains(&filter));
    let values: serde_json::Map<String, Value> =
        wanted.map(|(register, signal)| (signal.name.clone(), value(&frame, register))).collect();
    Json(json!({"at_s": frame.picture.frame.now.seconds(), "values": values}))
}

/// `GET /api/signals/{name}`.
pub async fn one(State(stage): State<Arc<Stage>>, Path(name): Path<String>) -> Answer {
    let register = stage.register(&name)?;
    let frame = stage.newest();
    let held = frame.picture.held.iter().find(|held| held.signal == register);
    Ok(Json(json!({
        "at_s": frame.picture.frame.now.seconds(),
        "name": name,
        "value": value(&frame, register),
        "forced": held.is_some_and(|held| !held.sticks),
        "stuck": held.is_some_and(|held| held.sticks),
        "by": stage.forcing().get(&name),
    })))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Force {
    value: Value,
    /// How whoever forces calls themselves.
    #[serde(default)]
    client: String,
    /// Whether to take over what another forces.
    #[serde(default)]
    replace: bool,
}

/// `PUT /api/signals/{name}/force`.
pub async fn force(State(stage): State<Arc<Stage>>, Path(name): Path<String>, body: Body) -> Answer {
    let Force { value, client, replace } = read(body)?;
    let run = stage.run()?;
    stage.register(&name)?;
    let client: String = client.chars().filter(|c| !c.is_control()).take(64).collect();
    let other = stage.forcing().get(&name).filter(|other| **other != client).cloned();
    if let Some(other) = other.filter(|_| !replace) {
        let who = if other.is_empty() { "somebody else".to_owned() } else { format!("{other:?}") };
        return Err(Refusal::conflict(
            format!("{name} is forced by {who} already"),
            "release it first, or send \"replace\":true to take it over",
        ));
    }
    let deed = Deed::Force(NamedValue { name: name.clone(), value });
    let Some(act) = deed.act(&stage.plant.signal_map)? else { unreachable!("to force is an act") };
    let since = run.operate(&deed, act).await?;
    stage.forcing().insert(name, client);
    Ok(at(since))
}

/// `DELETE /api/signals/{name}/force`.
pub async fn release(State(stage): State<Arc<Stage>>, Path(name): Path<String>) -> Answer {
    stage.run()?;
    stage.register(&name)?;
    let since = let_go(&stage, name).await?;
    Ok(at(since))
}

async fn let_go(stage: &Stage, name: String) -> Answer<crate::time::Instant> {
    let deed = Deed::Release(name.clone());
    let Some(act) = deed.act(&stage.plant.signal_map)? else { unreachable!("to release is an act") };
    let since = stage.run()?.operate(&deed, act).await;
    stage.forcing().remove(&name);
    since
}

/// `DELETE /api/forces`.
pub async fn release_all(State(stage): State<Arc<Stage>>) -> Answer {
    stage.run()?;
    let names: Vec<String> = stage.forcing().keys().cloned().collect();
    let mut released = Vec::new();
    for name in names {
        // Released by somebody else meanwhile: as wanted.
        if let_go(&stage, name.clone()).await.is_ok() {
            released.push(name);
        }
    }
    Ok(Json(json!({"released": released})))
}
