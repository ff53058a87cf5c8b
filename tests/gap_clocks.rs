//! Recordings of the rig whose reports were stamped by a clock of their own: the clock's offset and drift are found, shared by all
//! devices that it stamped, and no gap is made of them; a device that is late on it stays late.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;

use kinetwin::gap::{Recording, Study, locate};
use kinetwin::plant::Plant;
use kinetwin::run::model;
use kinetwin::trace::{Compression, Reader, Writer};

/// What the logger stamps: all but the axis and the motor, whose drives report with the commands.
const LOGGED: [&str; 3] = ["Robot", "Belt", "Gripper"];

/// The recording of a case, where the logger's clock calls `stamp(t)` what was at t; and said so or not in the header.
fn logged(plant: &Plant, case: u32, stamp: impl Fn(f64) -> f64, says_so: bool) -> Recording {
    let path = format!("../shared/data/rig-sample/case-{case:02}/train.cps.jsonl.zst");
    let file = File::open(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut reader = Reader::new(&path, BufReader::new(file)).expect("a trace");
    let mut lines: Vec<(f64, usize, String)> = Vec::new();
    while let Some(line) = reader.next_line().expect("a line") {
        let at = line.at.seconds();
        let mut whole: serde_json::Value = serde_json::from_str(line.text).expect("a line of JSON");
        let is_report = whole["from"] == "plant";
        let Some(entries) = whole["SendValue"].as_array().cloned().filter(|_| is_report) else {
            lines.push((at, lines.len(), whole.to_string()));
            continue;
        };
        let is_logged = |entry: &serde_json::Value| {
            let name = entry["name"].as_str().unwrap_or_default();
            LOGGED.iter().any(|device| name.split('.').next() == Some(device))
        };
        let (there, here): (Vec<_>, Vec<_>) = entries.into_iter().partition(is_logged);
        for (at, entries) in [(at, here), (stamp(at), there)] {
            if !entries.is_empty() {
                whole["t"] = at.into();
                whole["SendValue"] = entries.into();
                lines.push((at, lines.len(), whole.to_string()));
            }
        }
    }
    lines.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut header = reader.header().clone();
    if says_so {
        header.clocks = BTreeMap::from([("logger".to_owned(), LOGGED.map(str::to_owned).to_vec())]);
    }
    let head = Writer::new(Vec::new(), Compression::None, &header).and_then(Writer::finish).expect("a header");
    let mut text = String::from_utf8(head).expect("UTF-8");
    lines.iter().for_each(|(_, _, line)| text.extend([line, "\n"]));
    Recording::read(plant, "logged", Reader::new("logged", text.as_bytes()).expect("a trace"), &[]).expect("a trace")
}

fn own_gaps(study: &Study) -> Vec<String> {
    locate(study).devices.into_iter().filter(|device| device.own).map(|device| device.device).collect()
}

#[test]
fn a_clock_that_is_off_and_drifts_is_found_and_makes_no_gap() {
    let plant = model::load("models/rig").expect("the rig");
    let recording = logged(&plant, 1, |t| t + 0.137 + 80e-6 * t, true);
    let study = Study::new(&plant, &[recording]).expect("a study");
    let clock = &study.clocks[0][0];
    assert_eq!((clock.name.as_str(), clock.devices), ("logger", 3));
    // The way back: t = (stamp - 0.137) / (1 + 80e-6).
    assert!((clock.offset_s + 0.137).abs() < 1e-3, "{clock:?}");
    assert!((clock.drift + 80e-6).abs() < 15e-6, "{clock:?}");
    assert_eq!(own_gaps(&study), Vec::<String>::new());
}

#[test]
fn a_device_that_is_late_on_it_stays_late() {
    let plant = model::load("models/rig").expect("the rig");
    // The gripper of this case is late by 0.169 s beside the others.
    let study = Study::new(&plant, &[logged(&plant, 3, |t| t + 0.4, true)]).expect("a study");
    assert!((study.clocks[0][0].offset_s + 0.4).abs() < 2e-3, "{:?}", study.clocks);
    assert_eq!(own_gaps(&study), ["Gripper"]);
}

#[test]
fn within_one_clock_nothing_is_moved() {
    let plant = model::load("models/rig").expect("the rig");
    let study = Study::new(&plant, &[logged(&plant, 1, |t| t + 0.2, false)]).expect("a study");
    assert!(study.clocks[0].is_empty());
    let own = own_gaps(&study);
    let mut own = own;
    own.sort();
    assert_eq!(own, ["Belt", "Gripper", "Robot"]);
}
