//! Plants that `withheld-plant` draws at random, as its own tests keep them in `tests/data/drawn-plants`: the library loads them, with
//! the signals that the independent plant has, and their tolerances.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{Plant, load};
use kinetwin::prototype::source::{Layered, Memory};
use kinetwin::signal_map::Direction;

/// The paths of the kept plants' files.
fn kept() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/drawn-plants");
    let entries = fs::read_dir(&folder).expect("the kept plants");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.filter(|path| path.extension().is_some_and(|end| end == "xml")).collect()
}

/// The plant of a file that lies in the folder of a case.
fn plant(path: &Path) -> Plant {
    let text = fs::read_to_string(path).expect("a plant's file");
    let files = Memory([("exam/case-001/plant.xml".to_owned(), text)].into());
    load(&Layered(files, Embedded), "exam/case-001/plant.xml", KINDS).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_drawn_plant_has_the_signals_that_its_machine_takes_and_reports() {
    assert!(kept().len() >= 3, "the kept plants are gone");
    for path in kept() {
        let plant = plant(&path);
        let word = |direction| if direction == Direction::Command { "command" } else { "report" };
        let signals = plant.signal_map.signals().iter();
        let mut found: Vec<String> =
            signals.map(|signal| format!("{} {} {}", word(signal.direction), signal.name, signal.ty)).collect();
        let expected = fs::read_to_string(path.with_extension("signals")).expect("its signals");
        let mut expected: Vec<&str> = expected.lines().collect();
        found.sort();
        expected.sort_unstable();
        assert_eq!(found, expected, "{}", path.display());
    }
}

#[test]
fn a_drawn_plant_declares_its_tolerance_for_every_parameter_and_runs() {
    for path in kept() {
        let plant = plant(&path);
        let tasks = plant.instances.iter().flat_map(|instance| &instance.tasks);
        let mut parameters = tasks.flat_map(|task| task.parameters.0.values());
        assert!(parameters.all(|parameter| parameter.tolerance == 0.01), "{}", path.display());
        let mut engine = Engine::new(&plant, Duration::from_millis(1), 0).expect("an engine");
        assert_eq!(engine.tick(&[]).len(), plant.signal_map.signals().len(), "{}", path.display());
    }
}
