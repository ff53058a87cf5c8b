//! The bay that feeds a belt. It reports nothing: what it makes of its parts shows at the light barriers of that belt.
//!
//! A part that is longer than the model says darkens every barrier for longer, and no sensor's effect does: those are of one
//! barrier. So a wrong length is a candidate of the belt that the parts come to, and an answer of the bay.

use super::layout::Fed;
use super::recording::TaskId;
use super::subject::Subject;
use crate::device::{Device, Role};
use crate::effect::{self, EffectError};
use crate::plant::{EffectSpec, Parameters, Plant};
use crate::prototype::kind::KindDescriptor;

/// The effect of a bay that the belt shows in whatever it reports of parts.
const PART_LENGTH: &str = "part-length-error";

/// When a bay's parts are due up to an instant, s.
pub(super) fn due(mut bay: Box<dyn Device>, ends: f64) -> Vec<f64> {
    let mut due = Vec::new();
    for span in [0.0, ends] {
        if span > 0.0 {
            bay.advance(span);
        }
        if let Role::Makes(source) = bay.role() {
            due.extend(source.due.iter().map(|age| span - age));
        }
    }
    due
}

/// A bay, as the belt that it feeds knows it.
#[derive(Clone, Debug)]
pub(super) struct Bay {
    pub id: TaskId,
    /// The instance's name.
    pub name: String,
    /// Where it puts the middles of its parts, m from the belt's start.
    pub at: f64,
    /// How long its parts are along the belt by its own parameters, m.
    pub declared: f64,
    pub kind: &'static KindDescriptor,
    pub parameters: Parameters,
    /// What the model already adds to it.
    pub effects: Vec<EffectSpec>,
}

impl Bay {
    /// The one that feeds a belt of a plant so; `None` where its parts lie across it.
    pub fn of(plant: &Plant, fed: &Fed) -> Option<Bay> {
        let (instance, task) = (fed.bay.instance(plant), fed.bay.task(plant));
        let tasks: Vec<&str> = instance.tasks.iter().map(|task| task.name.as_str()).collect();
        fed.is_along.then(|| Bay {
            id: fed.bay,
            name: instance.name.clone(),
            at: fed.at,
            declared: fed.length,
            kind: task.kind,
            parameters: task.parameters.clone(),
            effects: effect::of_task(&instance.effects, &task.name, &tasks),
        })
    }

    /// Whether an effect, by its id, is one of a bay that the belt shows.
    pub fn is_of(effect: &str) -> bool {
        effect == PART_LENGTH
    }

    /// How long its parts are, m, with those of `effects` that are its own beside the model's.
    ///
    /// # Errors
    /// Parts without a length.
    pub fn length(&self, effects: &[EffectSpec]) -> Result<f64, EffectError> {
        let own = effects.iter().filter(|spec| Bay::is_of(&spec.kind));
        let all: Vec<EffectSpec> = self.effects.iter().chain(own).cloned().collect();
        let device = effect::build(self.kind, &self.parameters, &self.name, &all, 0)?;
        match device.role() {
            Role::Makes(source) => Ok(source.size[0]),
            _ => Ok(0.0),
        }
    }
}

impl Subject {
    /// The bay that feeds this belt, by its name.
    pub(super) fn feeder(&self) -> Option<&str> {
        self.bay.as_ref().map(|bay| bay.name.as_str())
    }

    /// The bay whose effect one is, by the effect's id, that this device shows and does not have.
    pub(super) fn maker(&self, effect: &str) -> Option<&str> {
        self.feeder().filter(|_| Bay::is_of(effect))
    }
}
