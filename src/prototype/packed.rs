//! Folders in one file: where there is no folder `catalogue`, `catalogue.zip` beside it is looked into.

use std::io::{Cursor, Read};

use zip::ZipArchive;
use zip::result::ZipError;

use super::source::{Source, SourceError};

/// The largest file that is taken out of a packed folder, bytes: what is packed small may be large.
const LARGEST: u64 = 256 << 20;

/// The files of a source, and those in its packed folders: `models/catalogue.zip` stands for the folder `models/catalogue`
/// wherever that has not the file asked for. Its files stand in it as they would in the folder, or in one folder of its name.
#[derive(Clone, Debug, Default)]
pub struct Packed<S>(pub S);

impl<S: Source> Source for Packed<S> {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        match self.0.read(path) {
            Err(SourceError::NotFound { .. }) => {
                let bytes = self.unpack(path)?;
                String::from_utf8(bytes).map_err(|_| unreadable(path, "it is not UTF-8"))
            }
            read => read,
        }
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, SourceError> {
        match self.0.read_bytes(path) {
            Err(SourceError::NotFound { .. }) => self.unpack(path),
            read => read,
        }
    }
}

impl<S: Source> Packed<S> {
    /// The file at `path` out of the nearest packed folder above it that has it.
    fn unpack(&self, path: &str) -> Result<Vec<u8>, SourceError> {
        let cuts = path.match_indices('/').map(|(at, _)| at).filter(|at| *at > 0);
        for cut in cuts.collect::<Vec<_>>().into_iter().rev() {
            let (folder, file) = (&path[..cut], &path[cut + 1..]);
            let archive = format!("{folder}.zip");
            let bytes = match self.0.read_bytes(&archive) {
                Ok(bytes) => bytes,
                Err(SourceError::NotFound { .. }) => continue,
                Err(error) => return Err(error),
            };
            let name = folder.rsplit('/').next().unwrap_or(folder);
            for entry in [file.to_owned(), format!("{name}/{file}")] {
                match take(&bytes, &entry) {
                    Ok(Some(bytes)) => return Ok(bytes),
                    Ok(None) => {}
                    Err(reason) => return Err(unreadable(&archive, &reason)),
                }
            }
        }
        Err(SourceError::NotFound { path: path.to_owned() })
    }
}

fn unreadable(path: &str, reason: &str) -> SourceError {
    SourceError::Unreadable { path: path.to_owned(), reason: reason.to_owned() }
}

/// One file out of an archive; `None` where there is none of that name.
fn take(archive: &[u8], entry: &str) -> Result<Option<Vec<u8>>, String> {
    let said = |error: ZipError| format!("{error}: expected a whole .zip");
    let mut archive = ZipArchive::new(Cursor::new(archive)).map_err(said)?;
    let mut file = match archive.by_name(entry) {
        Ok(file) => file,
        Err(ZipError::FileNotFound) => return Ok(None),
        Err(error) => return Err(said(error)),
    };
    let mut bytes = Vec::new();
    file.by_ref().take(LARGEST + 1).read_to_end(&mut bytes).map_err(|error| format!("{entry} in it: {error}"))?;
    if bytes.len() as u64 > LARGEST {
        return Err(format!("{entry} in it is larger than {} MiB", LARGEST >> 20));
    }
    Ok(Some(bytes))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::io::Write;

    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    use super::*;

    /// Bytes by path.
    struct Files(BTreeMap<String, Vec<u8>>);

    impl Source for Files {
        fn read(&self, path: &str) -> Result<String, SourceError> {
            self.read_bytes(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
        }

        fn read_bytes(&self, path: &str) -> Result<Vec<u8>, SourceError> {
            self.0.get(path).cloned().ok_or_else(|| SourceError::NotFound { path: path.to_owned() })
        }
    }

    fn packed(entries: &[(&str, &str)]) -> Vec<u8> {
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, text) in entries {
            writer.start_file(*name, SimpleFileOptions::default()).expect("an entry");
            writer.write_all(text.as_bytes()).expect("its text");
        }
        writer.finish().expect("an archive").into_inner()
    }

    fn source(archive: Vec<u8>) -> Packed<Files> {
        let own = ("models/catalogue/Belt/prototype.xml".to_owned(), b"unpacked".to_vec());
        Packed(Files(BTreeMap::from([("models/catalogue.zip".to_owned(), archive), own])))
    }

    #[test]
    fn what_the_folder_has_not_the_archive_may_have() {
        let archive =
            [("Belt/prototype.xml", "packed"), ("Pusher/prototype.xml", "pusher"), ("catalogue/Bay/a.xml", "bay")];
        let source = source(packed(&archive));
        let read = |path: &str| source.read(path);
        assert_eq!(read("models/catalogue/Belt/prototype.xml").as_deref(), Ok("unpacked"));
        assert_eq!(read("models/catalogue/Pusher/prototype.xml").as_deref(), Ok("pusher"));
        assert_eq!(read("models/catalogue/Bay/a.xml").as_deref(), Ok("bay"));
        assert!(matches!(read("models/catalogue/Bay/b.xml"), Err(SourceError::NotFound { .. })));
        assert!(matches!(read("models/catalogue/../../etc/passwd"), Err(SourceError::NotFound { .. })));
    }

    #[test]
    fn a_torn_archive_is_told() {
        let mut archive = packed(&[("Pusher/prototype.xml", "pusher")]);
        archive.truncate(40);
        let error = source(archive).read("models/catalogue/Pusher/prototype.xml").expect_err("torn").to_string();
        assert!(error.contains("failed to read models/catalogue.zip") && error.contains("a whole .zip"), "{error}");
    }
}
