//! A plant of any size: machines of every kind that stand still, each where it touches no other. Of [`LARGE`] devices it has about
//! two million triangles.

use std::fmt::Write as _;

/// The devices of the large plant.
pub const LARGE: usize = 2000;

/// What stands in a row, again and again: prototypes with a property that counts.
const ROW: [(&str, &str); 20] = [
    ("StraightConveyor", "<property name=\"length\" value=\"1.2 m\"/><property name=\"barrierB\" value=\"1 m\"/>"),
    ("ProximitySensor", ""),
    ("BoxSensor", ""),
    ("ProximitySensor", ""),
    ("VisionSensor", ""),
    ("Pusher", ""),
    ("ProximitySensor", ""),
    ("BoxSensor", ""),
    ("ProximitySensor", ""),
    ("VisionSensor", ""),
    ("EncoderMotor", ""),
    ("ProximitySensor", ""),
    ("BoxSensor", ""),
    ("ProximitySensor", ""),
    ("VisionSensor", ""),
    ("ServoAxis", ""),
    ("ProximitySensor", ""),
    ("BoxSensor", ""),
    ("ProximitySensor", ""),
    ("ProximitySensor", ""),
];

/// The plant's file with so many devices, 4 m from each to the next.
pub fn plant_xml(devices: usize) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {devices} devices that stand still, written by `kinetwin bench devices`. \
         -->\n<plant name=\"devices-{devices}\">\n  <adapter host=\"embedded\" timeout=\"5s\" hf=\"20ms\" lf=\"500ms\"/>\n\n"
    );
    for device in 0..devices {
        let (prototype, properties) = ROW[device % ROW.len()];
        let (x, y) = (device % 50 * 4, device / 50 * 4);
        writeln!(
            text,
            "  <instance name=\"Device{:05}\" prototype=\"{prototype}\"><pose x=\"{x}\" y=\"{y}\" z=\"0.8\"/>{properties}</instance>",
            device + 1
        )
        .expect("a String takes everything");
    }
    text.push_str("</plant>\n");
    text
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::device::KINDS;
    use crate::engine::Engine;
    use crate::plant::embedded::Embedded;
    use crate::plant::load;
    use crate::prototype::source::{Layered, Memory};
    use crate::scene::Scene;

    #[test]
    fn the_large_plant_has_two_million_triangles_and_runs() {
        let path = "devices/plant.xml";
        let files = BTreeMap::from([(path.to_owned(), plant_xml(LARGE))]);
        let plant = load(&Layered(Memory(files), Embedded), path, KINDS).expect("what is generated is right");
        let mut engine = Engine::new(&plant, Duration::from_millis(1), 1).expect("a plant that runs");
        let scene = Arc::new(Scene::of(&plant));
        assert_eq!(plant.instances.len(), LARGE);
        assert!((1_900_000..=2_200_000).contains(&scene.triangles()), "{}", scene.triangles());
        engine.show(&plant, scene);
        engine.watch();
        for _ in 0..100 {
            engine.tick(&[]);
        }
        assert_eq!(engine.collisions(), 0);
        // A servo's loop is never quite at rest; the others sleep.
        assert_eq!(engine.awake(), LARGE / ROW.len());
    }
}
