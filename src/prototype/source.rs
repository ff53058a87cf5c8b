//! Where the files of models come from. This row opens none: whoever loads a model hands a [`Source`] in.

use std::collections::BTreeMap;

/// Gives the texts of a model's files.
pub trait Source {
    /// The text of the file at `path`, which has `/` between its parts: `models/rig/plant.xml`.
    fn read(&self, path: &str) -> Result<String, SourceError>;

    /// The bytes of the file at `path`, which need not be text.
    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, SourceError> {
        self.read(path).map(String::into_bytes)
    }
}

/// Why a source gives no text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SourceError {
    /// There is no such file; another place may be tried.
    #[error("there is no file {path}")]
    NotFound { path: String },
    /// It is there and cannot be read: rights, not UTF-8, a failing disk.
    #[error("failed to read {path}: {reason}")]
    Unreadable { path: String, reason: String },
}

impl Source for &dyn Source {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        (**self).read(path)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, SourceError> {
        (**self).read_bytes(path)
    }
}

/// Files held in memory, by path.
#[derive(Clone, Debug, Default)]
pub struct Memory(pub BTreeMap<String, String>);

impl Source for Memory {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        self.0.get(path).cloned().ok_or_else(|| SourceError::NotFound { path: path.to_owned() })
    }
}

/// Two sources: what the first has not, the second may have.
#[derive(Clone, Debug)]
pub struct Layered<A, B>(pub A, pub B);

impl<A: Source, B: Source> Source for Layered<A, B> {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        match self.0.read(path) {
            Err(SourceError::NotFound { .. }) => self.1.read(path),
            read => read,
        }
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, SourceError> {
        match self.0.read_bytes(path) {
            Err(SourceError::NotFound { .. }) => self.1.read_bytes(path),
            read => read,
        }
    }
}

/// `path` as seen from `folder`, with `.` and `..` worked out: `../rig/plant.xml` from `models/curve` is
/// `models/rig/plant.xml`. A `..` that leads out of a relative folder stays.
pub fn join(folder: &str, path: &str) -> String {
    if path.starts_with('/') {
        return path.to_owned();
    }
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(path.split('/')) {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    let root = if folder.starts_with('/') { "/" } else { "" };
    format!("{root}{}", parts.join("/"))
}

/// The folder that `path` lies in; empty for a bare file name.
pub fn folder(path: &str) -> &str {
    match path.rsplit_once('/') {
        Some(("", _)) => "/",
        Some((folder, _)) => folder,
        None => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_joined_in_words_alone() {
        let check =
            |folder: &str, path: &str, expect: &str| assert_eq!(join(folder, path), expect, "{folder} + {path}");
        check("models/curve", "../rig/plant.xml", "models/rig/plant.xml");
        check("models/rig", "./plant.xml", "models/rig/plant.xml");
        check("", "plant.xml", "plant.xml");
        check("a", "../../b", "../b");
        check("/srv/models", "../b", "/srv/b");
        check("a/b", "/c", "/c");
    }

    #[test]
    fn folders_of_paths() {
        let check = |path: &str, expect: &str| assert_eq!(folder(path), expect, "{path}");
        check("models/rig/plant.xml", "models/rig");
        check("plant.xml", "");
        check("/plant.xml", "/");
    }

    #[test]
    fn the_second_layer_is_asked_only_where_the_first_has_nothing() {
        struct Broken;
        impl Source for Broken {
            fn read(&self, path: &str) -> Result<String, SourceError> {
                Err(SourceError::Unreadable { path: path.to_owned(), reason: "disk".to_owned() })
            }
        }
        let memory = Memory(BTreeMap::from([("a".to_owned(), "A".to_owned())]));
        assert_eq!(Layered(Memory::default(), memory.clone()).read("a").as_deref(), Ok("A"));
        assert!(matches!(Layered(Broken, memory).read("a"), Err(SourceError::Unreadable { .. })));
    }
}
