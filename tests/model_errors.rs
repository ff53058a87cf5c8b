//! Faulty models, each with the message it gives: in `tests/faulty-models/NAME/` stand the model and, as `error.txt`, what
//! its user reads. `KINETWIN_BLESS=1` writes the messages anew; read each of them as somebody who has to act on it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{ModelError, load};
use kinetwin::prototype::source::{Layered, Source, SourceError};
use miette::GraphicalTheme;

/// The files of the project, from its root.
struct Disk;

impl Source for Disk {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        fs::read_to_string(root().join(path)).map_err(|_| SourceError::NotFound { path: path.to_owned() })
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn cases() -> Vec<String> {
    let folder = fs::read_dir(root().join("tests/faulty-models")).expect("the folder of faulty models");
    let mut cases: Vec<String> =
        folder.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    cases.sort();
    cases
}

fn error(case: &str) -> ModelError {
    let model = format!("tests/faulty-models/{case}");
    let plant = match load(&Layered(Disk, Embedded), &model, KINDS) {
        Ok(plant) => plant,
        Err(error) => return error,
    };
    // What only shows when the plant is built is told in its file as well.
    let error = Engine::new(&plant, Duration::from_millis(1), 0).err();
    let fault = error.and_then(|error| error.fault(&plant)).unwrap_or_else(|| panic!("{case} is no faulty model"));
    ModelError::Faulty(fault.into())
}

#[test]
fn every_faulty_model_is_told_as_it_should_be() {
    let mut changed = Vec::new();
    for case in cases() {
        let path: PathBuf = root().join("tests/faulty-models").join(&case).join("error.txt");
        let rendered = error(&case).render(GraphicalTheme::unicode_nocolor(), 100);
        if std::env::var_os("KINETWIN_BLESS").is_some() {
            fs::write(&path, &rendered).expect("a writable folder");
        }
        let expect = fs::read_to_string(&path).unwrap_or_default();
        if expect != rendered {
            changed.push(format!("{case}: expected\n{expect}\nfound\n{rendered}"));
        }
    }
    assert!(changed.is_empty(), "{}", changed.join("\n"));
}

#[test]
fn every_fault_says_file_line_column_what_was_found_and_what_was_expected() {
    for case in cases() {
        let ModelError::Faulty(faults) = error(&case) else { panic!("{case} has no faults") };
        for fault in faults.iter() {
            let line = fault.line();
            let (place, text) = line.split_once(": ").expect("a place");
            let mut parts = place.rsplitn(3, ':');
            let position: Vec<Option<usize>> = parts.by_ref().take(2).map(|part| part.parse().ok()).collect();
            assert!(position.iter().all(|part| part.is_some_and(|part| part > 0)), "{case}: {line}");
            assert!(parts.next().is_some_and(|file| file.ends_with(".xml")), "{case}: {line}");
            assert!(text.contains(": expected "), "{case}: {line}");
        }
    }
}

#[test]
fn the_program_refuses_every_faulty_model_with_2_and_starts_nothing() {
    for case in cases() {
        let model = format!("tests/faulty-models/{case}");
        for command in ["check", "run"] {
            let mut program = Command::new(env!("CARGO_BIN_EXE_kinetwin"));
            let output = program.args([command, &model]).current_dir(root()).output().expect("the program");
            let told = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{command} {case}: {told}");
            assert!(output.stdout.is_empty(), "{command} {case} says something on standard output");
            assert!(told.contains("plant.xml:") || told.contains("prototypes/"), "{command} {case}: {told}");
            assert!(!told.contains("session"), "{command} {case} started: {told}");
        }
    }
}
