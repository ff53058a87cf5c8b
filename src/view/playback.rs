//! A recorded trace, played: forwards, backwards, at any speed, with a second one laid over it.
//!
//! The trace is replayed once, as fast as the engine can, and what it looked like is kept 60 times a simulated second, as what
//! changed from picture to picture with a whole one now and then ([`Movie`]). So any instant is there at once, and backwards
//! costs what forwards does.
//!
//! Of a trace whose source is a plant the machine is shown as it reported itself ([`Reported`]): its signals, the joints and the
//! light barriers that they tell of, and what hangs from its grippers. The rest follows the model under the recorded commands.

mod movie;
#[cfg(test)]
mod tests;

use std::io::BufRead;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use serde_json::{Value, json};
use tokio::sync::watch;

use super::frame::{Frame, Ghost};
use crate::engine::Engine;
use crate::plant::Plant;
use crate::replay::{self, ReplayError, Reported, Seen, Survey, Tolerances};
use crate::scene::Scene;
use crate::signal_map::RegisterId;
use crate::time::Instant;
use crate::trace::{Reader, TraceError};

pub use movie::Movie;

/// Why a trace cannot be played.
#[derive(Debug, thiserror::Error)]
pub enum BakeError {
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error("{file}: {source}")]
    Replay { file: String, source: ReplayError },
    #[error("{file}: the trace ends at its start: there is nothing to play")]
    Empty { file: String },
}

/// A trace, ready to be played.
pub struct Baked {
    /// The file, or what else it is called.
    pub name: String,
    pub movie: Movie,
}

impl Baked {
    /// Replays the trace that `open` opens through `engine`, which is at its start and shows `scene`.
    pub fn of<R: BufRead>(
        name: &str,
        seen: Seen,
        engine: &mut Engine,
        (plant, scene): (&Plant, &Scene),
        mut open: impl FnMut() -> Result<Reader<R>, TraceError>,
    ) -> Result<Baked, BakeError> {
        let survey = Survey::of(&plant.signal_map, open()?)?;
        if survey.ends() <= Instant::ZERO {
            return Err(BakeError::Empty { file: name.to_owned() });
        }
        let mut movie = match seen {
            Seen::Recorded => Movie::of_machine(Reported::read(&plant.signal_map, open()?)?, &plant.signal_map, scene),
            Seen::Model => Movie::default(),
        };
        let watch = |engine: &mut Engine| movie.take(engine);
        replay::watched(engine, &plant.signal_map, &survey, open()?, &Tolerances::default(), watch)
            .map_err(|source| BakeError::Replay { file: name.to_owned(), source })?;
        Ok(Baked { name: name.to_owned(), movie })
    }

    /// The same by another name.
    pub fn called(self, name: &str) -> Baked {
        Baked { name: name.to_owned(), ..self }
    }
}

/// A trace that is played.
pub struct Playback {
    scene: Arc<Scene>,
    trace: Baked,
    ghost: Option<Baked>,
    head: Mutex<Head>,
    frames: watch::Sender<Arc<Frame>>,
}

/// Where it is, and how time goes by.
#[derive(Clone, Copy, Debug)]
struct Head {
    /// s.
    at: f64,
    /// Backwards where negative.
    speed: f64,
    paused: bool,
}

/// How often a picture is shown.
const LIVELY: Duration = Duration::from_nanos(16_666_667);

impl Playback {
    /// Plays `trace`, with `ghost` over it, from its start.
    pub fn new(scene: Arc<Scene>, trace: Baked, ghost: Option<Baked>) -> Playback {
        let head = Mutex::new(Head { at: 0.0, speed: 1.0, paused: false });
        let playback = Playback { scene, trace, ghost, head, frames: watch::Sender::new(Arc::default()) };
        playback.show();
        playback
    }

    pub(super) fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    pub(super) fn frames(&self) -> watch::Receiver<Arc<Frame>> {
        self.frames.subscribe()
    }

    /// The trace's file.
    pub(super) fn name(&self) -> &str {
        &self.trace.name
    }

    /// The file laid over it; null without one.
    pub(super) fn ghost_name(&self) -> Value {
        json!(self.ghost.as_ref().map(|ghost| &ghost.name))
    }

    /// When the longer of the two ends.
    pub(super) fn ends(&self) -> Instant {
        let ghost = self.ghost.as_ref().map_or(Instant::ZERO, |ghost| ghost.movie.ends());
        self.trace.movie.ends().max(ghost)
    }

    /// What to mark on a time bar.
    pub(super) fn markers(&self) -> Value {
        let one = |(at, text): &(Instant, String)| json!({"at_s": at.seconds(), "text": text});
        json!(self.trace.movie.incidents().iter().map(one).collect::<Vec<Value>>())
    }

    fn head<T>(&self, look: impl FnOnce(&mut Head) -> T) -> T {
        look(&mut self.head.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Changes what is given.
    pub(super) fn set(&self, time_s: Option<f64>, speed: Option<f64>, paused: Option<bool>) {
        let ends = self.ends().seconds();
        self.head(|head| {
            head.at = time_s.map_or(head.at, |at| at.clamp(0.0, ends));
            head.speed = speed.unwrap_or(head.speed);
            head.paused = paused.unwrap_or(head.paused);
        });
        self.show();
    }

    /// Where it is, as `GET /api/playback` has it.
    pub(super) fn describe(&self) -> Value {
        let Head { at, speed, paused } = self.head(|head| *head);
        json!({"time_s": at, "speed": speed, "paused": paused, "ends_s": self.ends().seconds()})
    }

    /// Instants and values of a signal wherever it changed: `[[s, value], …]`.
    pub(super) fn history(&self, register: RegisterId) -> Value {
        json!(self.trace.movie.history(register))
    }

    /// The same of the trace laid over it; null without one.
    pub(super) fn ghost_history(&self, register: RegisterId) -> Value {
        json!(self.ghost.as_ref().map(|ghost| ghost.movie.history(register)))
    }

    /// Shows the picture of where it is.
    fn show(&self) {
        let Head { at, speed, paused } = self.head(|head| *head);
        let at = Instant::from_nanos((at * 1e9).round() as i64);
        let mut picture = self.trace.movie.picture(at);
        picture.paused = paused;
        let ghost = self.ghost.as_ref().map(|ghost| {
            let picture = ghost.movie.picture(at);
            Ghost { poses: picture.poses, parts: picture.frame.parts }
        });
        self.frames.send_replace(Arc::new(Frame { run: 1, picture, ghost, speed }));
    }

    /// Lets time go by for ever. At either end it stands still.
    pub(super) async fn play(&self) {
        let ends = self.ends().seconds();
        let mut last = tokio::time::Instant::now();
        loop {
            tokio::time::sleep(LIVELY).await;
            let now = tokio::time::Instant::now();
            let moved = self.head(|head| {
                let before = head.at;
                if !head.paused {
                    head.at = (head.at + head.speed * (now - last).as_secs_f64()).clamp(0.0, ends);
                    let is_over = head.at == if head.speed > 0.0 { ends } else { 0.0 };
                    head.paused = is_over && head.speed != 0.0;
                }
                head.at != before || head.paused
            });
            last = now;
            if moved {
                self.show();
            }
        }
    }
}
