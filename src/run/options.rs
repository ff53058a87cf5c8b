//! What a run is to be.

use std::path::PathBuf;
use std::time::Duration;

use super::RunError;
use crate::adapter::{Endpoint, Settings};
use crate::pace::Rates;
use crate::plant::{EMBEDDED_HOST, Plant};
use crate::security::{ClientTls, Token};
use crate::session::Limits;
use crate::time::format_duration;
use crate::wire::SignalSelection;

/// Everything about a run that its caller decides. What is `None` is as the plant's file says.
#[derive(Clone, Debug)]
pub struct Options {
    /// The model: a plant's folder or file, or the name of one of the catalogue.
    pub model: String,
    /// The automation to connect to.
    pub connect: Option<Connect>,
    /// How much simulated time to run; `None` until it is stopped.
    pub duration: Option<Duration>,
    /// The engine's step.
    pub step: Duration,
    /// The refresh interval of the high-frequency loop.
    pub high: Option<Duration>,
    /// The refresh interval of the low-frequency loop.
    pub low: Option<Duration>,
    pub speed: Speed,
    /// Whether the system is asked to run simulation and exchange before all that shares the processors by turns; where it
    /// refuses, a notice says so, and the run goes on.
    pub realtime: bool,
    /// The seed of all that is random in the plant.
    pub seed: u64,
    /// Whether the bodies of the scene are watched for collisions, beside the parts.
    pub collisions: bool,
    /// Whether the run ends with the first collision.
    pub stop_on_collision: bool,
    /// Where to record the session.
    pub record: Option<RecordTo>,
    /// Whether it can be controlled while it goes on; see [`control`](super::control).
    pub controlled: bool,
    /// How long an answer of the automation may take.
    pub timeout: Option<Duration>,
    /// The longest message that is taken in, bytes.
    pub max_message: usize,
    /// How many values a message may bring, and how many messages a second may.
    pub limits: Limits,
    /// The signals that the automation is to send, and how often at most; `None` for all, at every change.
    pub signals: Option<Vec<SignalSelection>>,
    /// A bearer token for the automation's server.
    pub token: Option<Token>,
    /// How a `wss://` server is reached.
    pub tls: Option<ClientTls>,
}

/// An automation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Connect {
    /// The automation of the same process, on a free loopback port.
    Embedded,
    /// A server.
    Server(Endpoint),
}

/// How simulated time goes by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// So many simulated seconds in a second of the wall clock.
    Wall(f64),
    /// As fast as the computer can, in lock-step with the embedded automation.
    Max,
}

impl Default for Speed {
    fn default() -> Speed {
        Speed::Wall(1.0)
    }
}

/// A file to record to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordTo {
    pub path: PathBuf,
    /// Whether a file that is there already may be replaced.
    pub replace: bool,
}

impl Options {
    /// The engine's step where nobody says otherwise.
    pub const STEP: Duration = Duration::from_millis(1);

    /// A run of `model` as its plant's file says, on the wall clock, until it is stopped.
    pub fn new(model: impl Into<String>) -> Options {
        Options {
            model: model.into(),
            connect: None,
            duration: None,
            step: Options::STEP,
            high: None,
            low: None,
            speed: Speed::Wall(1.0),
            realtime: false,
            seed: 0,
            collisions: true,
            stop_on_collision: false,
            record: None,
            controlled: false,
            timeout: None,
            max_message: Settings::MAX_MESSAGE,
            limits: Limits::default(),
            signals: None,
            token: None,
            tls: None,
        }
    }
}

impl Options {
    /// Refuses numbers that no run can have.
    pub(super) fn validate(&self) -> Result<(), RunError> {
        let refuse = |text: String| Err(RunError::Option(text));
        let between = |name: &str, span: Duration, least: Duration, most: Duration| {
            if (least..=most).contains(&span) {
                return Ok(());
            }
            let [span, least, most] = [span, least, most].map(format_duration);
            Err(RunError::Option(format!("{name} is {span}: expected {least} to {most}")))
        };
        between("--step", self.step, Duration::from_micros(10), Duration::from_secs(1))?;
        for (name, interval) in [("--hf", self.high), ("--lf", self.low)] {
            between(
                name,
                interval.unwrap_or(Duration::from_secs(1)),
                Duration::from_millis(1),
                Duration::from_secs(3600),
            )?;
        }
        match self.speed {
            Speed::Wall(speed) if !(0.01..=1000.0).contains(&speed) => {
                refuse(format!("--speed is {speed}: expected 0.01 to 1000, or max"))
            }
            Speed::Max if self.realtime => refuse(
                "--realtime with --speed max: steps that keep to no clock are never late; leave out one of them"
                    .to_owned(),
            ),
            _ => Ok(()),
        }
    }

    /// The automation to connect to: that of the options, else the plant's.
    pub(super) fn automation_of(&self, plant: &Plant) -> Connect {
        match &self.connect {
            Some(connect) => connect.clone(),
            None if plant.adapter.host == EMBEDDED_HOST => Connect::Embedded,
            None => Connect::Server(Endpoint::new(plant.adapter.host.clone(), plant.adapter.port)),
        }
    }

    /// The refresh intervals: those of the options, else the plant's.
    pub(super) fn rates(&self, plant: &Plant) -> Rates {
        Rates {
            high: self.high.unwrap_or(plant.adapter.high_frequency),
            low: self.low.unwrap_or(plant.adapter.low_frequency),
        }
    }

    /// The connector's settings for a server at `endpoint`.
    pub(super) fn settings(&self, plant: &Plant, endpoint: Endpoint) -> Settings {
        // The same for all connections of this run, and no other run's.
        let id = format!("kinetwin {} {}", plant.name, uuid::Uuid::new_v4());
        Settings {
            timeout: self.timeout.unwrap_or(plant.adapter.timeout),
            max_message: self.max_message,
            limits: self.limits,
            signals: self.signals.clone(),
            token: self.token.clone(),
            tls: self.tls.clone(),
            ..Settings::new(endpoint, id)
        }
    }

    /// How many steps the run makes; `None` without an end. A duration between two steps counts as the longer.
    pub(super) fn steps(&self) -> Option<u64> {
        let duration = self.duration?;
        Some(duration.as_nanos().div_ceil(self.step.as_nanos()).try_into().unwrap_or(u64::MAX))
    }
}
