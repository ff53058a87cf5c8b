//! `swapped`: two signals of a device have changed places, as their wires may. The component is the one, the property `with`
//! the other; both commands or both reports, of one type.
//!
//! Source: a permutation of the terminals.

use super::table::BASE;
use crate::effect::{Build, EffectDescriptor, EffectText, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "swapped",
    summary: "two signals of a device have changed places",
    equation: "y1 = x2, y2 = x1",
    source: "a permutation of the terminals",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    texts: &[EffectText { name: "with", required: true, summary: "the other signal's name" }],
    acts_always: true,
    excited_by: "one signal changing while the other does not",
    build: Build::Swap,
    ..BASE
};

#[cfg(test)]
mod tests {
    // What it does is tested where it is done: in `attach`.
    #[test]
    fn it_names_the_other_signal() {
        assert!(super::EFFECT.texts.iter().any(|text| text.name == "with" && text.required));
    }
}
