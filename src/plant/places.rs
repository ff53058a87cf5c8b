//! Where in the model's files things were said: for whoever finds something wrong only when the plant is built.

use std::collections::BTreeMap;

use crate::xml::Place;

/// The places of a plant's instances, of what they set, and of its parts. A plant that was read from no file has none.
#[derive(Clone, Debug, Default)]
pub struct Places {
    pub(super) instances: BTreeMap<String, Place>,
    /// By instance and parameter of its tasks; parameters that the plant's file leaves alone are not among them.
    pub(super) parameters: BTreeMap<(String, &'static str), Place>,
    pub(super) parts: Vec<Place>,
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

    /// Where the part at `index` of the plant's parts is declared.
    pub fn part(&self, index: usize) -> Option<&Place> {
        self.parts.get(index)
    }
}
