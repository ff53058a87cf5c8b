//! The sim-to-real gap: where a model parts from its machine, which unmodelled effect causes it, and how far it shrinks on
//! data that no fit saw, once that effect is added.
//!
//! ```text
//! trace → recording → grid → subject ⇄ effects and parameters → prediction → score → locate
//! ```
//!
//! A [`Recording`] is a trace as typed commands and reports. A [`Study`] is a plant with its recordings: the clocks and ticks
//! of the machine, the noise of its signals, and one [`Subject`] for each device. A subject is the device alone, driven by
//! the recorded commands at their exact times and by what its neighbours reported. It predicts its own reports, with any
//! [`EffectSpec`] and any other nominal parameters, and scores the prediction against the recording: −2 ln likelihood, sample
//! by sample and edge by edge. [`locate`](fn@locate) says which devices have a gap of their own.
//!
//! A fit is a function of parameters to residuals, whose squares sum to the cost:
//!
//! ```ignore
//! let residuals = |p: &[f64]| subject.score(&subject.predict(&[lag(p[0])], &Overrides::default())?).residuals();
//! ```
//!
//! and a bootstrap is made of sums over spans of time of what [`Score`] holds. Everything here may be shared between threads.
//! The work of a study is spread over the cores with rayon, whose threads no line of ours starts or names.

mod age;
mod alone;
mod apart;
mod apply;
mod bay;
mod beginning;
pub mod cause;
mod chance;
mod clocks;
mod coming;
mod cost;
pub mod diagnosis;
mod early;
mod edges;
mod effects;
mod ends;
mod filter;
pub mod fit;
mod floor;
mod grid;
mod lane;
mod layout;
mod link;
mod locate;
mod looks;
mod mask;
mod missed;
mod neighbours;
mod noise;
mod overrides;
pub mod page;
mod parts;
pub mod plan;
mod prediction;
pub mod production;
mod recording;
mod regimes;
pub mod report;
mod restarts;
mod samples;
mod schedule;
mod score;
mod seen;
mod shifts;
mod shortfall;
mod silence;
mod stamps;
pub mod statistics;
mod study;
mod subject;
mod surroundings;
mod tape;
mod task;
mod tick;
mod tolerance;
mod track;
mod turns;
mod way;
mod world;

#[cfg(doc)]
use crate::plant::EffectSpec;
pub use apply::{Applied, apply};
pub use clocks::ClockOffset;
pub use cost::{STRAY, STRAY_SPAN_S, unmatched};
pub use effects::effects_xml;
pub use floor::{Floor, FloorCosts};
pub use grid::Grid;
pub use locate::{
    FAR_BEYOND, Located, LocatedSignal, Location, THRESHOLD, evidence, evidence_all_along, gains_with_motion, locate,
};
pub use mask::{MaskError, read_mask};
pub use overrides::Overrides;
pub use parts::Origin;
pub use prediction::{Passing, Predicted, PredictedEdge, Prediction, Pulse, Turn};
pub use recording::{Beat, OtherClock, Recording, RecordingError, Span, Stamped, TaskId};
pub use restarts::WINDOW_S;
pub use score::{EdgeScore, LevelScore, Score, SignalScore};
pub use silence::segments;
pub use study::{Study, StudyError};
pub use subject::{Run, SignalInfo, Subject};
pub use task::Task;
pub use track::{Edge, Track};
pub use world::{Cut, Script, Surrounding, Told};

#[cfg(test)]
mod recorded_tests;
