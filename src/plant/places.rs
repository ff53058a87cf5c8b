//! Where in the model's files things were said: for whoever finds something wrong only when the plant is built.

use std::collections::BTreeMap;

use crate::value::Unit;
use crate::xml::{Located, Place};

/// The places of a plant's instances, of what they set, and of its parts. A plant that was read from no file has none.
#[derive(Clone, Debug, Default)]
pub struct Places {
    pub(super) instances: BTreeMap<String, Place>,
    /// By instance and parameter of its tasks; parameters that the plant's file leaves alone are not among them.
    pub(super) parameters: BTreeMap<(String, &'static str), Place>,
    pub(super) parts: Vec<Place>,
    /// By instance, in the order of its effects.
    pub(super) effects: BTreeMap<String, Vec<EffectPlaces>>,
}

/// Where an `<effect>` says what.
#[derive(Clone, Debug)]
pub struct EffectPlaces {
    /// The element.
    pub element: Place,
    /// Its attribute `kind`.
    pub kind: Place,
    /// Its attribute `place`.
    pub place: Place,
    /// Its attribute `component`, where there is one.
    pub component: Option<Place>,
    /// By name: the value of each parameter, and its unit where one is given.
    pub parameters: BTreeMap<String, (Place, Option<Located<Unit>>)>,
}

impl Places {
    /// Where the instance called `name` is declared.
    pub fn instance(&self, name: &str) -> Option<&Place> {
        self.instances.get(name)
    }

    /// Where the plant's file sets a parameter of one of the instance's tasks; `None` where it does not.
    pub fn parameter(&self, instance: &str, name: &'static str) -> Option<&Place> {
        self.parameters.get(&(instance.to_owned(), name))
    }

    /// Where the effect at `index` of an instance's effects is declared.
    pub fn effect(&self, instance: &str, index: usize) -> Option<&EffectPlaces> {
        self.effects.get(instance)?.get(index)
    }

    /// Where the part at `index` of the plant's parts is declared.
    pub fn part(&self, index: usize) -> Option<&Place> {
        self.parts.get(index)
    }
}
