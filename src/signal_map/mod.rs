//! The signals map: every signal that automation and simulation exchange, by name, with all that both sides must agree on.
//!
//! A signal's place in the map is its register's id. The session turns names into ids once, when a message arrives, and
//! nothing below it knows names. The map follows from the plant (`kinetwin signals-map MODEL` writes it) and stands as
//! XML under `signals-maps/`, as the connector of the reference expects it (section 5.3.2.3, `signals-map`).

pub mod xml;

use std::collections::HashMap;

use crate::value::{SignalType, Unit};

/// The register of a signal: its place in the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RegisterId(pub u32);

impl RegisterId {
    /// The id as an index.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Who sets a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// The automation sets it, the plant obeys.
    Command,
    /// The plant reports it, the automation reads.
    Report,
}

/// How a signal's changes travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Sent at every change, at once, none skipped: BOOL and coded integers.
    Edge,
    /// Its latest value, at most once per refresh interval, not at all while unchanged: REAL, counters.
    Level,
}

/// Which refresh interval a level keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RateClass {
    /// The high-frequency loop, 20 ms unless set.
    HighFrequency,
    /// The low-frequency loop, 500 ms unless set.
    LowFrequency,
}

/// One signal.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Fully qualified: `Conveyor1.velocityTarget`. The name in every message.
    pub name: String,
    pub ty: SignalType,
    pub direction: Direction,
    pub kind: Kind,
    pub rate: RateClass,
    /// The unit its values have on the wire. The engine converts to SI.
    pub unit: Unit,
    /// The least value allowed, in `unit`, within the type's own range.
    pub min: Option<f64>,
    /// The greatest value allowed, in `unit`, within the type's own range.
    pub max: Option<f64>,
    /// The instance it belongs to.
    pub instance: String,
    /// The task of that instance's prototype that takes or gives it.
    pub task: String,
    /// The property of that task.
    pub property: String,
}

/// All signals of a plant; a signal's index is its [`RegisterId`].
#[derive(Clone, Debug, PartialEq)]
pub struct SignalMap {
    plant: String,
    signals: Vec<Signal>,
    by_name: HashMap<String, RegisterId>,
}

/// Two signals of one name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("two signals are called {name:?}: each name may stand once in a plant")]
pub struct DuplicateSignal {
    pub name: String,
}

impl SignalMap {
    /// The map of `plant`, its registers in the order of `signals`.
    pub fn new(plant: impl Into<String>, signals: Vec<Signal>) -> Result<SignalMap, DuplicateSignal> {
        let mut by_name = HashMap::with_capacity(signals.len());
        for (index, signal) in signals.iter().enumerate() {
            if by_name.insert(signal.name.clone(), RegisterId(index as u32)).is_some() {
                return Err(DuplicateSignal { name: signal.name.clone() });
            }
        }
        Ok(SignalMap { plant: plant.into(), signals, by_name })
    }

    /// The plant's name.
    pub fn plant(&self) -> &str {
        &self.plant
    }

    /// All signals, in the order of their registers.
    pub fn signals(&self) -> &[Signal] {
        &self.signals
    }

    /// The signal of a register. Ids come from this map; another's is a bug.
    pub fn signal(&self, id: RegisterId) -> &Signal {
        &self.signals[id.index()]
    }

    /// The register of the signal called `name`.
    pub fn register(&self, name: &str) -> Option<RegisterId> {
        self.by_name.get(name).copied()
    }

    /// Registers and signals of one direction.
    pub fn directed(&self, direction: Direction) -> impl Iterator<Item = (RegisterId, &Signal)> {
        let ids = (0u32..).map(RegisterId);
        ids.zip(&self.signals).filter(move |(_, signal)| signal.direction == direction)
    }
}
