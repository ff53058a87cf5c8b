//! `part-length-error`: the parts that a loading bay puts on its belt are longer than the model says, by `length`: they cut
//! a beam for longer, and queue further apart. The bay is then built with that size.
//!
//! Source: the dimensional tolerance of goods (ISO 2768-1:1989), as a constant.

use super::table::{BASE, LENGTH, parameter};
use crate::effect::{Build, EffectDescriptor, Fit};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "part-length-error",
    summary: "the parts of a loading bay are longer than the model says",
    equation: "L = size + length",
    source: "ISO 2768-1:1989",
    places: &[EffectPlace::Process],
    fits: &[Fit::Parts(&["LoadingBay"])],
    parameters: &[parameter("length", LENGTH, (-1.0, 1.0), 0.0, 0.01, "how much longer; shorter if negative")],
    excited_by: "parts that pass a light barrier at a known speed",
    build: Build::Parameters,
    ..BASE
};

#[cfg(test)]
mod tests {
    use crate::device::Role;
    use crate::effect::bench::{error, spec, with};

    #[test]
    fn only_the_length_is_another() {
        let longer = spec("process", "part-length-error", None, &[("length", 0.02)]);
        let bay = with("LoadingBay", &[("belt", "Belt"), ("size", "0.3;0.2;0.1")], &[longer]);
        let Role::Makes(source) = bay.device.role() else { panic!("a loading bay") };
        assert_eq!(source.size, [0.32, 0.2, 0.1]);
    }

    #[test]
    fn a_part_without_length_is_refused() {
        let shorter = spec("process", "part-length-error", None, &[("length", -0.3)]);
        let error = error("LoadingBay", &[("belt", "Belt"), ("size", "0.3;0.2;0.1")], &[shorter]);
        assert!(error.contains("size would be") && error.contains("expected 0.001 to"), "{error}");
    }
}
