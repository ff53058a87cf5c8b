//! What the program says, and with which exit code, when it is asked for what it cannot do.

use std::process::Command;

fn check(arguments: &[&str], expected: &str) {
    let run = Command::new(env!("CARGO_BIN_EXE_withheld-plant")).args(arguments).output().expect("it starts");
    let said = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(2), "{arguments:?}: {said}");
    assert!(said.contains(expected), "{arguments:?}: {said}");
}

#[test]
fn what_cannot_be_recorded_ends_with_2_before_anything_is_written() {
    let place = tempfile::tempdir().expect("a folder");
    let path = |name: &str| place.path().join(name).to_string_lossy().into_owned();
    let (there, pairs) = (path(""), path("pairs"));
    check(&["socket", &there, "--seed", "1"], "exists: expected a folder that is not there yet");
    check(&["socket", &pairs, "--seed", "1", "--answers", &path("pairs/answers.json")], "name a file outside of it");
    check(&["socket", &pairs, "--seed", "1", "--answers", &path("nowhere/answers.json")], "failed to write");
    check(&["socket", &pairs, "--seed", "1", "--jobs", "0"], "invalid value '0'");
    assert!(place.path().read_dir().expect("a folder").next().is_none(), "something was written");
}
