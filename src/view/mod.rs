//! The view in the browser: one page, served from the program itself, on a run that goes on or on a recorded trace.
//!
//! ```text
//! simulation ══ two lock-free queues ══ hub ─ newest frame ─▶ one task a viewer ─▶ WebSocket ─▶ page
//!      ◀═══════ orders ════════════════ HTTP ◀───────────────────────────────────────────────── page, test bench
//! ```
//!
//! The server has a thread of its own. It asks the simulation for a picture at most 60 times a second, and only while
//! somebody looks; each viewer's task takes the newest and sends what this viewer has not seen of it. A slow browser misses
//! frames, and nobody waits for it.
//!
//! All that the page can do is an endpoint that `openapi.json` beside this file describes; see [`guard`] for who may use it.

mod answer;
mod api;
mod assets;
mod description;
pub mod frame;
pub mod guard;
pub mod live;
mod playback;
mod report;
mod stream;

use std::collections::{BTreeMap, VecDeque};
use std::io;
use std::net::{SocketAddr, TcpListener};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use tokio::sync::{Semaphore, oneshot, watch};

pub use api::ROUTES;
pub use playback::{BakeError, Baked, Movie, Playback};
pub use report::ReportFiles;

use frame::Frame;
use guard::Guard;
use live::Live;

use crate::plant::Plant;
use crate::run::{Gravity, Notice};
use crate::scene::Scene;

/// The most who may look at once; more are told so.
pub const VIEWERS: usize = 32;
/// Notices that are kept for those who come later.
const NOTICES: usize = 200;

/// Why nothing can be served.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    #[error("failed to listen on {address}: {}", explain(source))]
    Bind { address: SocketAddr, source: io::Error },
    #[error("failed to start the view's thread")]
    Thread(#[source] io::Error),
}

fn explain(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::AddrInUse => {
            "another program listens there; choose another port, or leave it out for a free one".to_owned()
        }
        io::ErrorKind::AddrNotAvailable => "this machine has no such address".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied; ports below 1024 are the administrator's".to_owned(),
        _ => error.to_string(),
    }
}

/// Where it listens, before anything is served.
#[derive(Debug)]
pub struct Listening {
    listener: TcpListener,
    guard: Guard,
}

/// Listens at `address`; port 0 takes a free one. `token` is what writing needs beyond the loopback interface.
pub fn listen(address: SocketAddr, token: Option<String>) -> Result<Listening, ViewError> {
    let bound = |source| ViewError::Bind { address, source };
    let listener = TcpListener::bind(address).map_err(bound)?;
    listener.set_nonblocking(true).map_err(bound)?;
    let guard = Guard::new(listener.local_addr().map_err(bound)?, token);
    Ok(Listening { listener, guard })
}

impl Listening {
    /// The address for people, with the token where one is needed.
    pub fn url(&self) -> String {
        self.guard.url()
    }
}

/// What is looked at.
pub enum Source {
    /// A run that goes on.
    Live(Live),
    /// A recorded trace.
    Playback(Box<Playback>),
}

/// All that requests are answered from.
pub struct Stage {
    pub(crate) model: String,
    pub(crate) plant: Arc<Plant>,
    pub(crate) scene: Arc<Scene>,
    pub(crate) source: Source,
    pub(crate) frames: watch::Receiver<Arc<Frame>>,
    pub(crate) report: Option<ReportFiles>,
    needs_token: bool,
    told: Arc<Told>,
    /// Who forces which signal, as they call themselves.
    pub(crate) forcing: Mutex<BTreeMap<String, String>>,
    pub(crate) viewers: Arc<Semaphore>,
}

/// What happened, the newest last, each with its number.
#[derive(Debug, Default)]
pub struct Told(Mutex<VecDeque<(u64, Notice)>>);

impl Told {
    /// Takes what happened.
    pub fn note(&self, notice: Notice) {
        let mut told = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let number = told.back().map_or(0, |(number, _)| *number) + 1;
        told.push_back((number, notice));
        if told.len() > NOTICES {
            told.pop_front();
        }
    }

    /// What happened after the notice `after`.
    pub(crate) fn since(&self, after: u64) -> Vec<serde_json::Value> {
        let told = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let json = |(number, notice): &(u64, Notice)| {
            let gravity = match notice.gravity {
                Gravity::Information => "information",
                Gravity::Warning => "warning",
                Gravity::Error => "error",
            };
            serde_json::json!({
                "number": number, "at_s": notice.at.seconds(), "gravity": gravity, "text": notice.text, "place": notice.place,
            })
        };
        told.iter().filter(|(number, _)| *number > after).map(json).collect()
    }
}

impl Stage {
    /// A run that goes on; `told` hears what happens.
    pub fn live(live: Live, scene: Arc<Scene>, told: Arc<Told>) -> Stage {
        let facts = live.facts();
        Stage::new(facts.model.clone(), facts.plant.clone(), scene, live.frames(), Source::Live(live), told)
    }

    /// A recorded trace.
    pub fn playback(model: &str, plant: Arc<Plant>, playback: Playback, report: Option<ReportFiles>) -> Stage {
        let (scene, frames) = (playback.scene().clone(), playback.frames());
        let stage =
            Stage::new(model.to_owned(), plant, scene, frames, Source::Playback(Box::new(playback)), Arc::default());
        Stage { report, ..stage }
    }

    fn new(
        model: String,
        plant: Arc<Plant>,
        scene: Arc<Scene>,
        frames: watch::Receiver<Arc<Frame>>,
        source: Source,
        told: Arc<Told>,
    ) -> Stage {
        Stage {
            model,
            plant,
            scene,
            source,
            frames,
            report: None,
            needs_token: false,
            told,
            forcing: Mutex::default(),
            viewers: Arc::new(Semaphore::new(VIEWERS)),
        }
    }

    /// With the gap that a diagnosis found.
    #[must_use]
    pub fn with_report(self, report: Option<ReportFiles>) -> Stage {
        Stage { report, ..self }
    }

    /// How many look.
    pub(crate) fn looking(&self) -> usize {
        VIEWERS - self.viewers.available_permits()
    }
}

/// A server that runs. Dropping it stops it.
#[derive(Debug)]
pub struct Server {
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// Serves `stage` on a thread of its own.
pub fn serve(listening: Listening, stage: Stage) -> Result<Server, ViewError> {
    let Listening { listener, guard } = listening;
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(ViewError::Thread)?;
    let (stop, stopped) = oneshot::channel();
    let stage = Arc::new(Stage { needs_token: guard.needs_token(), ..stage });
    let work = move || {
        runtime.block_on(async {
            let Ok(listener) = tokio::net::TcpListener::from_std(listener) else { return };
            let router = api::router(stage.clone(), Arc::new(guard));
            let pictures = async {
                match &stage.source {
                    Source::Live(live) => live.take_pictures(&stage.viewers).await,
                    Source::Playback(playback) => playback.play().await,
                }
            };
            tokio::select! {
                // Fails only where listening fails for good, and then nobody can be told.
                _ = axum::serve(listener, router) => {}
                () = pictures => {}
                // Also where whoever would have stopped it is gone.
                _ = stopped => {}
            }
        });
    };
    let thread = std::thread::Builder::new().name("view".to_owned()).spawn(work).map_err(ViewError::Thread)?;
    Ok(Server { stop: Some(stop), thread: Some(thread) })
}

impl Drop for Server {
    fn drop(&mut self) {
        // Gone already where the thread has ended by itself.
        let _ = self.stop.take().map(|stop| stop.send(()));
        if let Some(thread) = self.thread.take() {
            // A thread that died has said why.
            let _ = thread.join();
        }
    }
}
