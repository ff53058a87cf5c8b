//! Everything that the fuzzers found worth keeping, run again as plain tests.

use std::fs;
use std::path::Path;

#[path = "../fuzz/entries.rs"]
mod entries;

/// Runs `entry` on every file of its corpus.
fn replay(name: &str, entry: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(name);
    let files = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut count = 0;
    for file in files {
        let path = file.expect("a readable folder").path();
        let data = fs::read(&path).expect("a file");
        // A panic must name what brought it about.
        let run = std::panic::catch_unwind(|| entry(&data));
        assert!(run.is_ok(), "{} panics", path.display());
        count += 1;
    }
    assert!(count >= 5, "{count} files in {}: the corpus is lost", folder.display());
}

#[test]
fn codec() {
    replay("codec", entries::codec);
}

#[test]
fn session() {
    replay("session", entries::session);
}

#[test]
fn xml() {
    replay("xml", entries::xml);
}

#[test]
fn trace() {
    replay("trace", entries::trace);
}
