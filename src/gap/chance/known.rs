//! What is known of a device while something else is read off its recording.

use crate::gap::overrides::Overrides;
use crate::gap::prediction::Prediction;
use crate::gap::subject::Subject;
use crate::plant::EffectSpec;

/// Its effects, as far as they were found, and its nominal parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known<'a> {
    pub specs: &'a [EffectSpec],
    pub overrides: &'a Overrides,
}

impl<'a> Known<'a> {
    /// No effect.
    pub fn bare(overrides: &'a Overrides) -> Known<'a> {
        Known { specs: &[], overrides }
    }

    /// What the device does by it; `None` where that cannot be built.
    pub fn predict(self, subject: &Subject) -> Option<Prediction> {
        subject.predict(self.specs, self.overrides).ok()
    }
}
