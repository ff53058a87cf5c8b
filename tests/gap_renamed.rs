//! A diagnosis goes by what moves: a copy of a recording and its model under other names, in another order, with other comments and
//! in other files has the same answer.

use std::io::{BufReader, Cursor, Read};

use kinetwin::gap::Recording;
use kinetwin::gap::diagnosis::{Diagnosis, Options, diagnose};
use kinetwin::gap::report::Report;
use kinetwin::plant::Plant;
use kinetwin::run::model;
use kinetwin::trace::Reader;

/// What each instance is called in the copy: names that sort otherwise and say something else.
const NAMES: [(&str, &str); 7] = [
    ("Belt", "Zange"),
    ("Feed", "Robot2"),
    ("Pusher", "Alpha"),
    ("Robot", "Motor1"),
    ("Gripper", "M3"),
    ("Axis", "Slip"),
    ("Motor", "healthy"),
];
const CASE: &str = "../shared/data/rig-sample/case-04";

fn text(which: &str) -> String {
    let path = format!("{CASE}/{which}.cps.jsonl.zst");
    let file = std::fs::File::open(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut text = String::new();
    zstd::Decoder::new(file).and_then(|mut file| file.read_to_string(&mut text)).expect("a compressed trace");
    text
}

/// The model with other names, the last instance first, and a comment that lies.
fn renamed_model(folder: &std::path::Path) -> Plant {
    let mut xml = std::fs::read_to_string("models/rig/plant.xml").expect("the rig");
    xml = xml.replace(" signals-map=\"signals-maps/rig.xml\"", "").replace("name=\"rig\"", "name=\"another\"");
    for (from, to) in NAMES {
        xml = xml.replace(&format!("\"{from}\""), &format!("\"{to}\""));
        // A prototype keeps its name.
        xml = xml.replace(&format!("prototype=\"{to}\""), &format!("prototype=\"{from}\""));
    }
    let first = xml.find("<instance").expect("an instance");
    let end = xml.rfind("</instance>").expect("its end") + "</instance>".len();
    let mut instances: Vec<&str> = xml[first..end].split_inclusive("</instance>").collect();
    instances.reverse();
    let all =
        format!("{}<!-- Coulomb friction on every device. -->{}{}", &xml[..first], instances.join("\n"), &xml[end..]);
    std::fs::write(folder.join("plant.xml"), all).expect("a folder that can be written to");
    model::load(folder.to_str().expect("a path of letters")).expect("the copy")
}

fn recording(plant: &Plant, name: &str, text: String) -> Vec<Recording> {
    let reader = Reader::new(name, BufReader::new(Cursor::new(text.into_bytes()))).expect("a trace");
    vec![Recording::read(plant, name, reader, &[]).expect("a trace of the plant")]
}

fn diagnosed(plant: &Plant, train: Vec<Recording>, holdout: Vec<Recording>) -> Report {
    let asked = ["direction-asymmetry", "gain-error", "dead-time", "first-order-lag", "scale-error", "clock-drift"];
    let options =
        Options { is_asked: &|id| asked.contains(&id), is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
    let Diagnosis { report, .. } = diagnose(plant, &train, &holdout, &options).expect("a diagnosis");
    report
}

#[test]
fn a_renamed_copy_has_the_same_answer() {
    let folder = tempfile::tempdir().expect("a folder");
    let original = model::load("models/rig").expect("the rig");
    let copy = renamed_model(folder.path());
    let rename = |mut text: String| {
        for (from, to) in NAMES {
            text = text.replace(&format!("\"{from}."), &format!("\"{to}."));
        }
        text.replace("models/rig", "somewhere/else")
    };
    let one =
        diagnosed(&original, recording(&original, "a", text("train")), recording(&original, "b", text("holdout")));
    let other = diagnosed(
        &copy,
        recording(&copy, "coulomb-friction.cps.jsonl", rename(text("train"))),
        recording(&copy, "no-gap.cps.jsonl", rename(text("holdout"))),
    );
    assert_eq!(one.verdict, other.verdict, "{}\n{}", one.to_json(), other.to_json());
    assert!(!one.cause.is_empty(), "{}", one.to_json());
    let renamed = |device: &str| NAMES.iter().find(|(from, _)| *from == device).map_or("", |(_, to)| *to).to_owned();
    for (one, other) in one.cause.iter().zip(&other.cause) {
        assert_eq!((renamed(&one.device), &one.effect, one.place), (other.device.clone(), &other.effect, other.place));
        assert_eq!(one.class.len(), other.class.len());
        assert!((one.weight - other.weight).abs() < 1e-6, "{} {}", one.weight, other.weight);
        for (one, other) in one.parameters.iter().zip(&other.parameters) {
            assert!((one.value - other.value).abs() <= 1e-6 * one.value.abs(), "{one:?} {other:?}");
        }
    }
    assert_eq!(one.cause.len(), other.cause.len());
}
