//! Parts put in and taken out.

use std::sync::Arc;

use axum::extract::{Path, State};

use super::super::Stage;
use super::super::answer::{Answer, Refusal};
use super::run::at;
use super::{Body, read};
use crate::trace::operator::{Deed, NewPart};

/// `POST /api/parts`.
pub async fn insert(State(stage): State<Arc<Stage>>, body: Body) -> Answer {
    let part: NewPart = read(body)?;
    done(&stage, &Deed::Insert(part)).await
}

/// `DELETE /api/parts/{number}`.
pub async fn remove(State(stage): State<Arc<Stage>>, Path(number): Path<String>) -> Answer {
    let expected =
        || Refusal::malformed(format!("{number:?} is no number of a part"), "GET /api/state lists the parts");
    let number = number.parse().map_err(|_| expected())?;
    done(&stage, &Deed::Remove(number)).await
}

/// Does it to the plant of the run.
pub(super) async fn done(stage: &Stage, deed: &Deed) -> Answer {
    let run = stage.run()?;
    let Some(act) = deed.act(&stage.plant.signal_map)? else { unreachable!("this is an act") };
    Ok(at(run.operate(deed, act).await?))
}
