//! Cases that are made again are the same: an exam's whose making was interrupted, and those that are asked for by their numbers.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

const SEED: &str = "5";

fn cases(folder: &Path, seed: &str, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withheld-plant"));
    command.arg("cases").arg(folder).args(["--exam", "training", "--seed", seed, "--cases", "6", "--no-classes"]);
    command.args(more);
    command
}

fn run(folder: &Path, more: &[&str]) -> Output {
    cases(folder, SEED, more).output().expect("it starts")
}

/// What it says where it does nothing.
fn said_of(mut command: Command) -> String {
    let run = command.output().expect("it starts");
    assert_eq!(run.status.code(), Some(2));
    String::from_utf8_lossy(&run.stderr).into_owned()
}

/// What all files of the cases hold, by their paths.
fn files(exam: &Path) -> BTreeMap<String, Vec<u8>> {
    let names = |folder: &Path| -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("a folder");
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect()
    };
    let cases = names(exam).into_iter().filter(|name| name.starts_with("case-"));
    let all = cases.flat_map(|case| names(&exam.join(&case)).into_iter().map(move |file| format!("{case}/{file}")));
    all.map(|file| (file.clone(), std::fs::read(exam.join(&file)).expect("a file"))).collect()
}

#[test]
fn what_was_interrupted_goes_on_and_is_the_same() {
    let place = tempfile::tempdir().expect("a folder");
    let [whole, cut] = ["whole", "cut"].map(|name| place.path().join(name));
    assert!(run(&whole, &[]).status.success());
    let said = |more: &[&str]| said_of(cases(&cut, SEED, more));
    assert!(said(&["--resume"]).contains("was not begun, or is whole"));

    let mut making = cases(&cut, SEED, &[]).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    // What the exam follows from, and two cases.
    let kept = || std::fs::read_dir(place.path().join("cut.part")).map_or(0, Iterator::count);
    while kept() < 3 && making.try_wait().expect("a child").is_none() {
        std::thread::sleep(Duration::from_millis(5));
    }
    making.kill().expect("it ends");
    making.wait().expect("it has ended");
    assert!(!cut.join("answers.sealed").exists(), "it was made before it was interrupted");

    assert!(said(&[]).contains("go on with --resume, or remove it to begin anew"));
    assert!(said_of(cases(&cut, "6", &["--resume"])).contains("was begun with other arguments"));
    assert!(run(&cut, &["--resume"]).status.success());
    assert!(files(&whole) == files(&cut), "another exam came of it");
    again_by_their_numbers(place.path(), &files(&whole));
    assert!(cut.join("answers.sealed").exists() && !place.path().join("cut.part").exists());
    assert!(said(&["--resume"]).contains("was not begun, or is whole"));
    assert!(said(&[]).contains("exists: expected a folder that is not there yet"));
}

/// Two of the cases of `whole`, in the open.
fn again_by_their_numbers(place: &Path, whole: &BTreeMap<String, Vec<u8>>) {
    let [again, answers] = ["again", "again.json"].map(|name| place.join(name));
    let practice = |numbers: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_withheld-plant"));
        command.args(["--seed", SEED, "--cases", "6", "--no-classes", "--only", numbers]);
        command.arg("--out").arg(&again).arg("--answers").arg(&answers);
        command
    };
    for (number, numbers) in [("7", "2,7"), ("0", "0")] {
        let said = said_of(practice(numbers));
        assert!(said.contains(&format!("--only {number}: expected a number from 1 to 6")), "{said}");
    }
    assert!(!again.exists() && !answers.exists());
    assert!(practice("5,2").status().expect("it starts").success());
    let asked = |file: &str| ["case-002", "case-005"].iter().any(|case| file.starts_with(case));
    let expected = whole.iter().filter(|(file, _)| asked(file)).map(|(file, held)| (file.clone(), held.clone()));
    assert!(files(&again) == expected.collect(), "other cases came of it");
    let said = std::fs::read_to_string(&answers).expect("a file");
    let told: Vec<&str> = said.lines().filter(|line| line.contains("\"case\"")).collect();
    assert!(told.len() == 2 && told[0].contains("case-002") && told[1].contains("case-005"), "{told:?}");
}
