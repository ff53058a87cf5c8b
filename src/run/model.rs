//! Where models come from: a folder on disk, or the catalogue that is compiled in.

use std::io::ErrorKind;
use std::time::Duration;

use super::RunError;
use crate::device;
use crate::engine::Engine;
use crate::plant::embedded::Embedded;
use crate::plant::{self, Instance, ModelError, Plant};
use crate::prototype::packed::Packed;
use crate::prototype::source::{Layered, Source, SourceError};
use crate::signal_map::xml;

/// Files of the disk, from the working folder.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

impl Source for Disk {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        std::fs::read_to_string(path).map_err(|error| unreadable(path, &error))
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, SourceError> {
        std::fs::read(path).map_err(|error| unreadable(path, &error))
    }
}

fn unreadable(path: &str, error: &std::io::Error) -> SourceError {
    match error.kind() {
        // A folder in place of a file, or a file in place of a folder: there is no such file.
        ErrorKind::NotFound | ErrorKind::NotADirectory | ErrorKind::IsADirectory => {
            SourceError::NotFound { path: path.to_owned() }
        }
        ErrorKind::InvalidData => {
            SourceError::Unreadable { path: path.to_owned(), reason: "it is not UTF-8".to_owned() }
        }
        _ => SourceError::Unreadable { path: path.to_owned(), reason: error.to_string() },
    }
}

/// Where a run looks for files: on the disk first, then among those compiled in.
pub const SOURCE: Layered<Packed<Disk>, Embedded> = Layered(Packed(Disk), Embedded);

/// Loads a model: a folder or a plant's file on the disk, or a name of the catalogue (`models/rig`, `rig`), which works
/// from any folder.
pub fn load(model: &str) -> Result<Plant, ModelError> {
    plant::load(&SOURCE, model, device::KINDS)
}

/// Builds the engine of `plant`. What the plant's files have to do with a failure is told as an error of the model, with
/// file and line.
pub fn engine(plant: &Plant, step: Duration, seed: u64) -> Result<Engine, RunError> {
    Engine::new(plant, step, seed).map_err(|error| match error.fault(plant) {
        Some(fault) => ModelError::Faulty(fault.into()).into(),
        None => error.into(),
    })
}

/// Tells models of one name apart: 16 hexadecimal digits made of all that the plant's behaviour follows from.
pub fn hash(plant: &Plant) -> String {
    let mut text = xml::write(&plant.signal_map);
    // Shapes are left out: what they do to behaviour, the tasks' parameters say.
    for Instance { name, prototype, pose, tasks, effects, shape: _, structure: _ } in &plant.instances {
        text.push_str(&format!("{name} {prototype} {pose:?} {effects:?}\n"));
        for task in tasks {
            text.push_str(&format!("{} {} {:?} {:?}\n", task.name, task.kind.name, task.parameters, task.ports));
        }
    }
    text.push_str(&format!("{:?}", plant.parts));
    let (high, _) = uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_OID, text.as_bytes()).as_u64_pair();
    format!("{high:016x}")
}

/// What of a plant's signals map, as its file has it, is not as the plant gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum MapState {
    /// The plant's file names no map: it follows from the plant alone.
    Unnamed,
    /// There is no such file.
    Absent(String),
    /// The file is what the plant gives.
    Same(String),
    /// It is not; the differences, one line each.
    Differs { path: String, differences: Vec<String> },
}

/// Compares the signals map that the file of `plant` names with the one that the plant gives.
///
/// # Errors
/// There is a map, and it is none.
pub fn map_state(plant: &Plant) -> Result<MapState, ModelError> {
    let Some(path) = plant.adapter.signals_map.clone() else { return Ok(MapState::Unnamed) };
    let text = match Disk.read(&path) {
        Ok(text) => text,
        Err(SourceError::NotFound { .. }) => return Ok(MapState::Absent(path)),
        Err(error) => return Err(ModelError::Unreadable(error)),
    };
    let found = xml::read(&path, &text)?;
    let differences = xml::differences(&plant.signal_map, &found);
    Ok(if differences.is_empty() { MapState::Same(path) } else { MapState::Differs { path, differences } })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_shows_only_when_the_plant_is_built_is_told_in_its_file() {
        let plant = load("tests/faulty-models/barrier-beyond-the-belt").expect("a plant");
        let error = engine(&plant, Duration::from_millis(1), 0).err().expect("no engine").to_string();
        assert!(
            error.starts_with("tests/faulty-models/barrier-beyond-the-belt/plant.xml:2:19: Short: barrierB"),
            "{error}"
        );
    }

    #[test]
    fn a_folder_is_no_file() {
        assert!(matches!(Disk.read("src"), Err(SourceError::NotFound { .. })));
        assert!(matches!(Disk.read("src/lib.rs/plant.xml"), Err(SourceError::NotFound { .. })));
    }
}
