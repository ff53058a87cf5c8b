//! Where models come from: a folder on disk, or the catalogue that is compiled in.

use std::io::ErrorKind;

use crate::device;
use crate::plant::embedded::Embedded;
use crate::plant::{self, ModelError, Plant};
use crate::prototype::source::{Layered, Source, SourceError};

/// Files of the disk, from the working folder.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

impl Source for Disk {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        std::fs::read_to_string(path).map_err(|error| match error.kind() {
            // A folder in place of a file, or a file in place of a folder: there is no such file.
            ErrorKind::NotFound | ErrorKind::NotADirectory | ErrorKind::IsADirectory => {
                SourceError::NotFound { path: path.to_owned() }
            }
            ErrorKind::InvalidData => {
                SourceError::Unreadable { path: path.to_owned(), reason: "it is not UTF-8".to_owned() }
            }
            _ => SourceError::Unreadable { path: path.to_owned(), reason: error.to_string() },
        })
    }
}

/// Where a run looks for files: on the disk first, then among those compiled in.
pub const SOURCE: Layered<Disk, Embedded> = Layered(Disk, Embedded);

/// Loads a model: a folder or a plant's file on the disk, or a name of the catalogue (`models/rig`, `rig`), which works
/// from any folder.
pub fn load(model: &str) -> Result<Plant, ModelError> {
    plant::load(&SOURCE, model, device::KINDS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_no_file() {
        assert!(matches!(Disk.read("src"), Err(SourceError::NotFound { .. })));
        assert!(matches!(Disk.read("src/lib.rs/plant.xml"), Err(SourceError::NotFound { .. })));
    }
}
