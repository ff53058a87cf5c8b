//! An exam's answers under lock.
//!
//! An exam is a folder of cases, `DIR/case-NNN/{model, train.cps.jsonl.zst, holdout.cps.jsonl.zst}`, and beside them
//! `DIR/answers.sealed`: the answers, encrypted and authenticated with ChaCha20-Poly1305 (RFC 8439). What is authenticated
//! with them is the hash of all cases, so that answers open only beside the very cases that they are about. The key lies
//! elsewhere, in `DIR.key` if nobody says otherwise.
//!
//! The answers open only against a [`Manifest`]: one line for each case with the SHA-256 of what was answered,
//! `REPORTS/manifest.sha256`, as `sha256sum` writes it. All cases must be in it, and each file must still be what its line
//! says: so no report can be written, or changed, once the answers are known, without the manifest showing it.
//!
//! Before all cases are written, what is known of them is a [`Draft`], under the same lock.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use chacha20poly1305::aead::rand_core::RngCore;
use chacha20poly1305::aead::{Aead, AeadCore, KeyInit, OsRng, Payload};
use chacha20poly1305::{ChaCha20Poly1305, Key, Nonce};
use sha2::{Digest, Sha256};

/// The answers' file in an exam's folder.
pub const ANSWERS: &str = "answers.sealed";
/// The manifest's file in the folder of the reports.
pub const MANIFEST: &str = "manifest.sha256";
/// What sealed answers begin with.
const MAGIC: &[u8] = b"kinetwin-sealed/1\n";
/// What a part of a draft is authenticated with, before its name.
const PART: &str = "part of a draft: ";
const NONCE: usize = 12;

/// Why answers do not open.
#[derive(Debug, thiserror::Error)]
pub enum SealError {
    /// A file could not be read or written.
    #[error("failed to access {}", path.display())]
    File {
        path: PathBuf,
        #[source]
        source: io::Error,
    },
    /// The key's file holds no key.
    #[error("{}: no key: expected 64 hexadecimal digits", path.display())]
    NoKey { path: PathBuf },
    /// There is nothing to go on with.
    #[error(
        "{} was not begun, or is whole: expected the parts of an exam that was interrupted; leave out --resume to begin",
        path.display()
    )]
    NotBegun { path: PathBuf },
    /// What was made of an exam would be lost.
    #[error(
        "{} holds parts of an exam that was interrupted: go on with --resume, or remove it to begin anew", path.display()
    )]
    Begun { path: PathBuf },
    /// The answers' file is of another kind.
    #[error("{}: no sealed answers: expected a file that withheld-plant has written", path.display())]
    NotSealed { path: PathBuf },
    /// Another key, other answers, or other cases than those they were sealed with.
    #[error(
        "{} does not open: the key is another exam's, or the cases are not those that it was sealed with", path.display()
    )]
    WontOpen { path: PathBuf },
    /// Not every case has been answered.
    #[error(
        "answers opened too early: {} of {cases} cases have no answer in {} ({}): diagnose all of them first",
        missing.len(), path.display(), some(missing)
    )]
    TooEarly { path: PathBuf, cases: usize, missing: Vec<String> },
    /// What was answered is not what the manifest says.
    #[error("{}: {file} is not what it was when the manifest was written: an answer was changed afterwards", path.display())]
    Changed { path: PathBuf, file: String },
    /// A line of a manifest is none.
    #[error("{}:{line}: expected a SHA-256 in 64 hexadecimal digits, two blanks and a file", path.display())]
    Malformed { path: PathBuf, line: usize },
}

fn some(names: &[String]) -> String {
    let shown = names.iter().take(3).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > 3 { format!("{shown}, …") } else { shown }
}

/// What went wrong with a file, with its path.
fn at(path: &Path) -> impl Fn(io::Error) -> SealError + '_ {
    |source| SealError::File { path: path.to_owned(), source }
}

/// The names of an exam's cases, sorted: its folders that hold a `model`.
pub fn cases(exam: &Path) -> Result<Vec<String>, SealError> {
    let mut names = Vec::new();
    for entry in fs::read_dir(exam).map_err(at(exam))? {
        let entry = entry.map_err(at(exam))?;
        if entry.path().join("model").is_file() {
            names.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

/// One hash for all cases: names and contents of all their files, in order.
fn hash_of_cases(exam: &Path) -> Result<[u8; 32], SealError> {
    let mut hash = Sha256::new();
    for case in cases(exam)? {
        let folder = exam.join(&case);
        let entries = fs::read_dir(&folder).map_err(at(&folder))?.collect::<Result<Vec<_>, _>>();
        let mut files: Vec<_> = entries.map_err(at(&folder))?.into_iter().map(|entry| entry.path()).collect();
        files.sort();
        for file in files.iter().filter(|file| file.is_file()) {
            let content = Sha256::digest(fs::read(file).map_err(at(file))?);
            hash.update(case.as_bytes());
            hash.update([0]);
            hash.update(file.file_name().unwrap_or_default().as_encoded_bytes());
            hash.update([0]);
            hash.update(content);
        }
    }
    Ok(hash.finalize().into())
}

/// Where an exam's key lies if nobody says otherwise: beside its folder.
pub fn default_key(exam: &Path) -> PathBuf {
    beside(exam, ".key")
}

fn beside(exam: &Path, ending: &str) -> PathBuf {
    let mut name = exam.file_name().unwrap_or_default().to_owned();
    name.push(ending);
    exam.with_file_name(name)
}

/// A number that nobody knew.
pub fn random_seed() -> u64 {
    OsRng.next_u64()
}

/// Seals `answers` into an exam's folder, all cases of which are written, under a new key, written to `key`.
pub fn seal(exam: &Path, key: &Path, answers: &[u8]) -> Result<(), SealError> {
    seal_under(&new_key(key)?, exam, answers)
}

fn seal_under(secret: &Key, exam: &Path, answers: &[u8]) -> Result<(), SealError> {
    lock(secret, &hash_of_cases(exam)?, answers, &exam.join(ANSWERS))
}

/// Opens the answers of an exam against the manifest of what was answered in `reports`.
pub fn open(exam: &Path, key: &Path, reports: &Path) -> Result<Vec<u8>, SealError> {
    Manifest::read(reports)?.check(exam, reports)?;
    let path = exam.join(ANSWERS);
    let sealed = fs::read(&path).map_err(at(&path))?;
    let sealed = Sealed::of(&sealed, &path)?;
    sealed.unlocked(&read_key(key)?, &hash_of_cases(exam)?)
}

fn new_key(path: &Path) -> Result<Key, SealError> {
    let secret = ChaCha20Poly1305::generate_key(&mut OsRng);
    fs::write(path, format!("{}\n", hex(&secret))).map_err(at(path))?;
    Ok(secret)
}

fn read_key(path: &Path) -> Result<Key, SealError> {
    let text = fs::read_to_string(path).map_err(at(path))?;
    unhex(text.trim()).map(Key::from).ok_or_else(|| SealError::NoKey { path: path.to_owned() })
}

/// Encrypts `text`, authenticated together with `associated`, into the file `path`: the whole of it or nothing.
fn lock(secret: &Key, associated: &[u8], text: &[u8], path: &Path) -> Result<(), SealError> {
    let nonce = ChaCha20Poly1305::generate_nonce(&mut OsRng);
    let sealed = ChaCha20Poly1305::new(secret)
        .encrypt(&nonce, Payload { msg: text, aad: associated })
        .map_err(|_| SealError::WontOpen { path: path.to_owned() })?;
    let new = path.with_extension("new");
    fs::write(&new, [MAGIC, &nonce, &sealed].concat()).map_err(at(&new))?;
    fs::rename(&new, path).map_err(at(path))
}

/// What stands in a file that was locked.
struct Sealed<'a> {
    nonce: &'a [u8],
    text: &'a [u8],
    path: &'a Path,
}

impl<'a> Sealed<'a> {
    fn of(content: &'a [u8], path: &'a Path) -> Result<Sealed<'a>, SealError> {
        let rest = content.strip_prefix(MAGIC).filter(|rest| rest.len() > NONCE);
        let (nonce, text) = rest.ok_or_else(|| SealError::NotSealed { path: path.to_owned() })?.split_at(NONCE);
        Ok(Sealed { nonce, text, path })
    }

    fn unlocked(&self, secret: &Key, associated: &[u8]) -> Result<Vec<u8>, SealError> {
        ChaCha20Poly1305::new(secret)
            .decrypt(Nonce::from_slice(self.nonce), Payload { msg: self.text, aad: associated })
            .map_err(|_| SealError::WontOpen { path: self.path.to_owned() })
    }
}

/// The answers to the cases that are written so far, in files of `DIR.part` beside the exam's folder, each sealed under the exam's own key: an exam
/// whose making was interrupted goes on from there.
#[derive(Debug)]
pub struct Draft {
    exam: PathBuf,
    folder: PathBuf,
    secret: Key,
}

impl Draft {
    /// Of an exam of which nothing is written yet, under a new key, written to `key`: not beside the parts of another, whose key that would replace.
    pub fn begin(exam: &Path, key: &Path) -> Result<Draft, SealError> {
        Draft::none_of(exam)?;
        let folder = beside(exam, ".part");
        fs::create_dir_all(&folder).map_err(at(&folder))?;
        Ok(Draft { exam: exam.to_owned(), folder, secret: new_key(key)? })
    }

    /// Nothing, where none was begun.
    pub fn none_of(exam: &Path) -> Result<(), SealError> {
        let path = beside(exam, ".part");
        if path.exists() { Err(SealError::Begun { path }) } else { Ok(()) }
    }

    /// Of one that was begun, and is not whole.
    pub fn resume(exam: &Path, key: &Path) -> Result<Draft, SealError> {
        let folder = beside(exam, ".part");
        if !folder.is_dir() {
            return Err(SealError::NotBegun { path: exam.to_owned() });
        }
        Ok(Draft { exam: exam.to_owned(), folder, secret: read_key(key)? })
    }

    fn part(&self, name: &str) -> (PathBuf, String) {
        (self.folder.join(format!("{name}.sealed")), format!("{PART}{name}"))
    }

    /// Keeps what is known of one part.
    pub fn keep(&self, name: &str, content: &[u8]) -> Result<(), SealError> {
        let (path, associated) = self.part(name);
        lock(&self.secret, associated.as_bytes(), content, &path)
    }

    /// What was kept of a part, if anything was.
    pub fn kept(&self, name: &str) -> Result<Option<Vec<u8>>, SealError> {
        let (path, associated) = self.part(name);
        let sealed = match fs::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(at(&path))?,
        };
        Sealed::of(&sealed, &path)?.unlocked(&self.secret, associated.as_bytes()).map(Some)
    }

    /// Seals all `answers` into the exam's folder, and does away with the parts.
    pub fn seal(self, answers: &[u8]) -> Result<(), SealError> {
        seal_under(&self.secret, &self.exam, answers)?;
        fs::remove_dir_all(&self.folder).map_err(at(&self.folder))
    }
}

/// What was answered, file by file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Manifest {
    /// The SHA-256 and the path below the folder of the reports: `case-001/report.json`.
    lines: Vec<(String, String)>,
}

impl Manifest {
    /// Of these files below `reports`, one for each case.
    pub fn of(reports: &Path, files: &[String]) -> Result<Manifest, SealError> {
        let mut lines = Vec::new();
        for file in files {
            lines.push((hash_of(&reports.join(file))?, file.clone()));
        }
        Ok(Manifest { lines })
    }

    /// Writes it into the folder of the reports.
    pub fn write(&self, reports: &Path) -> Result<(), SealError> {
        let mut text = String::new();
        for (hash, file) in &self.lines {
            let _ = writeln!(text, "{hash}  {file}");
        }
        let path = reports.join(MANIFEST);
        fs::write(&path, text).map_err(at(&path))
    }

    /// Reads it from the folder of the reports; empty where there is none.
    pub fn read(reports: &Path) -> Result<Manifest, SealError> {
        let path = reports.join(MANIFEST);
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            read => read.map_err(at(&path))?,
        };
        let mut lines = Vec::new();
        for (number, line) in text.lines().enumerate() {
            let parts = line.split_once("  ").filter(|(hash, _)| unhex(hash).is_some());
            let (hash, file) = parts.ok_or_else(|| SealError::Malformed { path: path.clone(), line: number + 1 })?;
            lines.push((hash.to_owned(), file.to_owned()));
        }
        Ok(Manifest { lines })
    }

    /// Every case of the exam must be answered, and every answer be what its line says.
    fn check(&self, exam: &Path, reports: &Path) -> Result<(), SealError> {
        let all = cases(exam)?;
        let is_answered =
            |case: &String| self.lines.iter().any(|(_, file)| Path::new(file).parent() == Some(Path::new(case)));
        let missing: Vec<String> = all.iter().filter(|case| !is_answered(case)).cloned().collect();
        let path = reports.join(MANIFEST);
        if !missing.is_empty() || all.is_empty() {
            return Err(SealError::TooEarly { path, cases: all.len(), missing });
        }
        for (hash, file) in &self.lines {
            if hash_of(&reports.join(file))? != *hash {
                return Err(SealError::Changed { path, file: file.clone() });
            }
        }
        Ok(())
    }
}

fn hash_of(path: &Path) -> Result<String, SealError> {
    Ok(hex(&Sha256::digest(fs::read(path).map_err(at(path))?)))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

fn unhex(text: &str) -> Option<[u8; 32]> {
    let mut bytes = [0; 32];
    if text.len() != 64 || !text.is_ascii() {
        return None;
    }
    for (byte, pair) in bytes.iter_mut().zip(text.as_bytes().chunks(2)) {
        *byte = u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok()?;
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An exam of two sealed cases, its key, and a folder for reports.
    fn exam(folder: &Path) -> [PathBuf; 3] {
        let [exam, reports] = ["exam", "reports"].map(|name| folder.join(name));
        for case in ["case-001", "case-002"] {
            fs::create_dir_all(exam.join(case)).expect("a folder");
            fs::create_dir_all(reports.join(case)).expect("a folder");
            fs::write(exam.join(case).join("model"), "models/rig\n").expect("a file");
        }
        let key = default_key(&exam);
        seal(&exam, &key, b"the truth").expect("sealed");
        [exam, key, reports]
    }

    fn answer(reports: &Path, cases: &[&str]) {
        let files: Vec<String> = cases.iter().map(|case| format!("{case}/report.json")).collect();
        files.iter().for_each(|file| fs::write(reports.join(file), file).expect("a file"));
        Manifest::of(reports, &files).and_then(|manifest| manifest.write(reports)).expect("a manifest");
    }

    #[track_caller]
    fn refuses(exam: &[PathBuf; 3], part: &str) {
        let [exam, key, reports] = exam;
        let text = open(exam, key, reports).expect_err("it stays shut").to_string();
        assert!(text.contains(part), "{text}");
    }

    #[test]
    fn answers_open_when_all_cases_are_answered_and_not_before() {
        let folder = tempfile::tempdir().expect("a folder");
        let exam = exam(folder.path());
        refuses(&exam, "answers opened too early: 2 of 2 cases have no answer");
        answer(&exam[2], &["case-001"]);
        refuses(&exam, "(case-002)");
        answer(&exam[2], &["case-001", "case-002"]);
        assert_eq!(open(&exam[0], &exam[1], &exam[2]).expect("open"), b"the truth");
    }

    #[test]
    fn neither_answers_nor_cases_change_unseen() {
        let folder = tempfile::tempdir().expect("a folder");
        let exam = exam(folder.path());
        answer(&exam[2], &["case-001", "case-002"]);
        fs::write(exam[2].join("case-002/report.json"), "better").expect("a file");
        refuses(&exam, "case-002/report.json is not what it was");
        answer(&exam[2], &["case-001", "case-002"]);
        fs::write(exam[0].join("case-001/model"), "models/rig-toleranced\n").expect("a file");
        refuses(&exam, "the cases are not those");
    }

    #[test]
    fn another_key_opens_nothing_and_what_is_none_is_said_to_be_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let exam = exam(folder.path());
        answer(&exam[2], &["case-001", "case-002"]);
        fs::write(&exam[1], format!("{}\n", hex(&[7; 32]))).expect("a file");
        refuses(&exam, "the key is another exam's");
        fs::write(&exam[1], "key").expect("a file");
        refuses(&exam, "expected 64 hexadecimal digits");
        fs::write(exam[0].join(ANSWERS), "answers").expect("a file");
        refuses(&exam, "no sealed answers");
    }

    #[test]
    fn a_draft_goes_on_and_is_sealed_as_a_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let [path, key, reports] = exam(folder.path());
        assert!(matches!(Draft::resume(&path, &key), Err(SealError::NotBegun { .. })));
        Draft::begin(&path, &key).and_then(|draft| draft.keep("case-001", b"the first truth")).expect("kept");
        let part = folder.path().join("exam.part").join("case-001.sealed");
        assert!(!fs::read(&part).expect("a part").windows(5).any(|window| window == b"truth"));
        assert!(matches!(Draft::begin(&path, &key), Err(SealError::Begun { .. })));
        let draft = Draft::resume(&path, &key).expect("what was begun");
        assert_eq!(draft.kept("case-001").expect("it opens"), Some(b"the first truth".to_vec()));
        assert_eq!(draft.kept("case-002").expect("nothing yet"), None);
        // A part stands for nothing but what it was kept for.
        fs::rename(&part, part.with_file_name("case-002.sealed")).expect("renamed");
        assert!(matches!(draft.kept("case-002"), Err(SealError::WontOpen { .. })));
        draft.seal(b"both").expect("sealed");
        answer(&reports, &["case-001", "case-002"]);
        assert_eq!(open(&path, &key, &reports).expect("open"), b"both");
        assert!(matches!(Draft::resume(&path, &key), Err(SealError::NotBegun { .. })));
    }

    #[test]
    fn sealed_answers_cannot_be_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let [exam, ..] = exam(folder.path());
        let sealed = fs::read(exam.join(ANSWERS)).expect("a file");
        assert!(!sealed.windows(5).any(|window| window == b"truth"));
    }
}
