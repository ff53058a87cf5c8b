//! The composition root: builds a run out of the rows above, owns its threads and its end, and yields a handle.
//!
//! ```text
//! model ─▶ plant ─▶ engine ─▶ simulation ═ bank ═ exchange ─▶ adapter ─▶ automation
//!                    └────────── the simulation's thread ──┘ └── the IO thread ──┘
//! ```
//!
//! On the wall clock ([`start`]) the simulation and the exchange have a thread each, the automation, where it is embedded,
//! has another, and they meet over a real WebSocket. As fast as possible, or stepped by a caller ([`Stepper`]), all three
//! take turns on one thread, in lock-step and in memory: each step waits until the automation has handled what was sent.

mod ask;
pub mod control;
#[cfg(test)]
mod control_tests;
mod ledger;
pub mod live;
pub mod model;
mod notice;
mod observe;
mod options;
mod recording;
mod stepped;
mod summary;
mod wall;

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use crossbeam::channel::Receiver;

use crate::adapter::{Endpoint, SettingsError};
use crate::automation;
use crate::engine::BuildError;
use crate::pace::Rates;
use crate::plant::{ModelError, Plant};
use crate::scene::Scene;

pub use ask::{Asked, ask};
pub use notice::{Gravity, Notice};
pub use observe::observe;
pub use options::{Connect, Options, RecordTo, Speed};
pub use recording::{RecordControl, Recorded, date_and_time};
pub use stepped::Stepper;
pub use summary::{Quantiles, Summary};

use control::Controls;
use live::{ExchangeFrame, SimulationFrame, Viewer};
use model::MapState;

/// Why a run cannot start, or could not be brought to its end.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    #[error(transparent)]
    Model(#[from] ModelError),
    #[error(
        "{path} is not the signals map that the plant gives; kinetwin signals-map {model} -o {path} writes that one:\n  {}",
        differences.join("\n  ")
    )]
    Map { model: String, path: String, differences: Vec<String> },
    #[error(transparent)]
    Build(#[from] BuildError),
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error("{0}")]
    Option(String),
    #[error(
        "--speed max needs the embedded automation: the clock of {0} cannot be stepped; leave --connect out, or give a \
         number as --speed"
    )]
    ForeignMax(Endpoint),
    #[error("failed to start the embedded automation: {0}")]
    Program(#[from] automation::program::StartError),
    #[error("failed to start the embedded automation: {0}")]
    Listen(#[from] automation::server::ListenError),
    #[error("{} is there already; choose another file, or replace it with --force", .0.display())]
    RecordingExists(PathBuf),
    #[error("failed to record to {}: {reason}", path.display())]
    Recording { path: PathBuf, reason: String },
    #[error("failed to start a thread: {0}")]
    Thread(#[source] std::io::Error),
    #[error("the {0} thread died; this is a fault of the program")]
    Died(&'static str),
}

/// What does not change about a run.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The model, as it was named.
    pub model: String,
    pub plant: Arc<Plant>,
    pub step: Duration,
    pub rates: Rates,
    pub speed: Speed,
    pub duration: Option<Duration>,
    pub seed: u64,
    /// Where the automation is.
    pub server: ServerPlace,
}

/// Where the automation is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServerPlace {
    /// In this process, in lock-step.
    Memory,
    /// In this process, over a WebSocket on this address.
    Embedded(SocketAddr),
    /// Somewhere else.
    Foreign(Endpoint),
}

impl Facts {
    fn new(options: &Options, plant: Arc<Plant>, server: ServerPlace) -> Facts {
        Facts {
            model: options.model.clone(),
            rates: options.rates(&plant),
            plant,
            step: options.step,
            speed: options.speed,
            duration: options.duration,
            seed: options.seed,
            server,
        }
    }

    /// Prototypes in use.
    pub fn prototypes(&self) -> usize {
        Facts::prototypes_of(&self.plant)
    }

    /// Prototypes that instances of `plant` use.
    pub fn prototypes_of(plant: &Plant) -> usize {
        let names = plant.instances.iter().map(|instance| instance.prototype.as_str());
        names.collect::<std::collections::BTreeSet<&str>>().len()
    }
}

impl std::fmt::Display for ServerPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ServerPlace::Memory => write!(f, "the embedded automation, in lock-step"),
            ServerPlace::Embedded(address) => write!(f, "the embedded automation at ws://{address}"),
            ServerPlace::Foreign(endpoint) => write!(f, "{endpoint}"),
        }
    }
}

/// Ends a run in good order, from any thread.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<OnceLock<()>>);

impl Stop {
    /// Asks the run to end: no further step is made, the session is closed.
    pub fn stop(&self) {
        // Asked already: it is on its way.
        let _ = self.0.set(());
    }

    /// Whether it was asked.
    pub fn is_asked(&self) -> bool {
        self.0.get().is_some()
    }
}

/// A run that goes on.
pub struct Handle {
    facts: Facts,
    stop: Stop,
    notices: Receiver<Notice>,
    simulation: Viewer<SimulationFrame>,
    exchange: Viewer<ExchangeFrame>,
    round_trip: Arc<dyn Fn() -> Quantiles + Send + Sync>,
    steering: Option<Steering>,
    /// Waits for the run's threads, and sums up.
    end: Box<dyn FnOnce() -> Result<Summary, RunError> + Send>,
}

/// What steers a run whose options ask for control.
#[derive(Clone)]
pub struct Steering {
    /// What the plant looks like; the pictures have its poses.
    pub scene: Arc<Scene>,
    pub controls: Controls,
    pub record: RecordControl,
    /// Lets the clock of the embedded automation go by with simulated time: so many seconds to a second. Nothing where the
    /// automation is not ours, or is in lock-step anyway.
    pub tempo: Arc<dyn Fn(f64) + Send + Sync>,
    /// The round trip so far; see [`Handle::round_trip`].
    pub round_trip: Arc<dyn Fn() -> Quantiles + Send + Sync>,
}

impl Handle {
    /// What steers it, where its options asked for that.
    pub fn steering(&self) -> Option<Steering> {
        self.steering.clone()
    }

    /// What does not change.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// What ends it.
    pub fn stopper(&self) -> Stop {
        self.stop.clone()
    }

    /// What happens, as it happens. Disconnected when the run has ended.
    pub fn notices(&self) -> &Receiver<Notice> {
        &self.notices
    }

    /// The newest state of the simulation, if there is one since it was last asked for.
    pub fn simulation(&self) -> Option<SimulationFrame> {
        self.simulation.take()
    }

    /// The newest state of the exchange, if there is one since it was last asked for.
    pub fn exchange(&self) -> Option<ExchangeFrame> {
        self.exchange.take()
    }

    /// The round trip so far, as the embedded automation measures it; all `None` with another.
    pub fn round_trip(&self) -> Quantiles {
        (self.round_trip)()
    }

    /// Waits for the end of the run.
    pub fn finish(self) -> Result<Summary, RunError> {
        // The end waits for threads that may ask for these.
        drop((self.round_trip, self.steering, self.notices));
        (self.end)()
    }
}

/// Starts a run.
///
/// # Errors
/// Nothing has been started, opened or written where one is given.
pub fn start(options: &Options) -> Result<Handle, RunError> {
    start_until(options, Stop::default())
}

/// The same of a run that `stop` ends, also where it is asked before the run has begun.
pub fn start_until(options: &Options, stop: Stop) -> Result<Handle, RunError> {
    let plant = Arc::new(model::load(&options.model)?);
    options.validate()?;
    if let MapState::Differs { path, differences } = model::map_state(&plant)? {
        return Err(RunError::Map { model: options.model.clone(), path, differences });
    }
    begin(options, plant, stop)
}

/// Starts a run of `plant`, which is there already; the options' model is only its name, and no signals map is compared.
pub fn start_plant(options: &Options, plant: Arc<Plant>) -> Result<Handle, RunError> {
    options.validate()?;
    begin(options, plant, Stop::default())
}

fn begin(options: &Options, plant: Arc<Plant>, stop: Stop) -> Result<Handle, RunError> {
    match (options.speed, options.automation_of(&plant)) {
        (Speed::Wall(speed), connect) => wall::start(options, plant, (connect, speed), stop),
        (Speed::Max, Connect::Embedded) => stepped::start(options, plant, stop),
        (Speed::Max, Connect::Server(endpoint)) => Err(RunError::ForeignMax(endpoint)),
    }
}
