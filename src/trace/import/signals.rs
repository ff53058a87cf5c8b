//! Which signals an import may make, who sends them, and of which type they are.

use std::collections::BTreeSet;

use crate::signal_map::{Direction, SignalMap};
use crate::trace::Sender;
use crate::value::SignalType;
use crate::xml::nearest;

/// What is known of the signals.
#[derive(Clone, Debug, Default)]
pub struct Signals {
    /// The model's, where there is a model: then there are no others.
    pub map: Option<SignalMap>,
    /// Where there is none: those that the automation sends. All others are the plant's, and of whatever type they are.
    pub commands: BTreeSet<String>,
}

/// A signal that a column becomes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Target {
    pub name: String,
    pub from: Sender,
    pub ty: Option<SignalType>,
}

impl Signals {
    /// The signal called `name`; otherwise what is wrong with it.
    pub(super) fn target(&self, name: &str) -> Result<Target, String> {
        let Some(map) = &self.map else {
            let is_command = self.commands.contains(name);
            let from = if is_command { Sender::Automation } else { Sender::Plant };
            return Ok(Target { name: name.to_owned(), from, ty: None });
        };
        let Some(id) = map.register(name) else {
            let near = nearest(name, map.signals().iter().map(|signal| signal.name.as_str()));
            let hint = near.map(|near| format!("; did you mean {near:?}?")).unwrap_or_default();
            return Err(format!("the model {} has no signal {name:?}{hint}", map.plant()));
        };
        let signal = map.signal(id);
        let from = match signal.direction {
            Direction::Command => Sender::Automation,
            Direction::Report => Sender::Plant,
        };
        Ok(Target { name: name.to_owned(), from, ty: Some(signal.ty) })
    }

    /// Whether a column called so is a signal where no mapping says what it becomes.
    pub(super) fn has(&self, name: &str) -> bool {
        self.map.as_ref().is_none_or(|map| map.register(name).is_some())
    }
}
