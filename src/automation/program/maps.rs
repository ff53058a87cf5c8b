//! The signals maps that the automation carries with it, so that it can serve a plant by its name alone.

use std::sync::Arc;

use crate::signal_map::{SignalMap, xml};

macro_rules! maps {
    ($($plant:literal),* $(,)?) => {
        &[$(($plant, include_str!(concat!("../../../signals-maps/", $plant, ".xml")))),*]
    };
}

/// Every map under `signals-maps/`, by the name of its file; a test sees to it that none is forgotten.
static MAPS: &[(&str, &str)] = maps![
    "curve",
    "depalletizer",
    "packaging",
    "r001",
    "rig",
    "rig-toleranced",
    "servo-arm",
    "servo-pendulum",
    "servo-pendulum-kp100",
    "servo-pendulum-kp200",
    "servo-pendulum-kp400",
    "servo-pendulum-kp800",
];

/// The plants whose maps are known.
pub fn plants() -> impl Iterator<Item = &'static str> {
    MAPS.iter().map(|(plant, _)| *plant)
}

/// The signals map of `plant`; `None` if it is none of [`plants`].
pub fn map_of(plant: &str) -> Option<Arc<SignalMap>> {
    let (_, text) = MAPS.iter().find(|(known, _)| *known == plant)?;
    let map = xml::read(&format!("signals-maps/{plant}.xml"), text).expect("the tests read every map that we carry");
    Some(Arc::new(map))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_map_of_the_project_is_carried_and_read() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/signals-maps");
        let files = std::fs::read_dir(folder).expect("the folder of maps");
        let names = files.map(|file| file.expect("a file").file_name().to_string_lossy().into_owned());
        let mut found: Vec<String> = names.filter_map(|name| name.strip_suffix(".xml").map(str::to_owned)).collect();
        found.sort();
        assert_eq!(found, plants().collect::<Vec<_>>());
        for plant in plants() {
            assert!(map_of(plant).is_some(), "{plant}");
        }
        assert!(map_of("no-such-plant").is_none());
    }
}
