//! Recorded sessions, a good one and a faulty one, replay without any difference: what the model does and what of a
//! message it takes is what it was when they were recorded. `tests/data/README.md` says how they were.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::plant::{self, embedded::Embedded};
use kinetwin::replay::{self, Report, Survey, Tolerances};
use kinetwin::run::Options;
use kinetwin::trace::{Info, Reader, info};

fn open(name: &str) -> Reader<BufReader<File>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    Reader::new(name, BufReader::new(File::open(path).expect("the trace opens"))).expect("a trace")
}

/// Replays a recording of the rig, which must differ in nothing.
fn check(name: &str) -> (Report, Info) {
    let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
    let survey = Survey::of(&plant.signal_map, open(name)).expect("every line is one");
    let seed = survey.header().seed.expect("the run's seed");
    let mut engine = Engine::new(&plant, Options::STEP, seed).expect("an engine");
    let report = replay::run(&mut engine, &plant.signal_map, &survey, open(name), &Tolerances::default());
    let report = report.expect("a replay");
    assert!(!report.differs && report.torn.is_none() && report.unrecorded.is_empty(), "{report}");
    assert!(report.levels.iter().all(|level| level.largest == 0.0), "{report}");
    (report, info(open(name)).expect("every line is one"))
}

#[test]
fn a_good_session() {
    let (report, info) = check("rig-good.cps.jsonl.zst");
    assert!(report.ignored.is_empty() && report.notices.is_empty(), "{report}");
    assert!(!info.messages.contains_key("Refused") && info.messages["SendValue"] > 500, "{info:?}");
}

#[test]
fn a_faulty_session() {
    let (report, info) = check("rig-faulty.cps.jsonl.zst");
    assert!(report.ignored.contains_key("NoSuchInstance.noSuchSignal"), "{report}");
    let left_out = |part: &str| report.notices.keys().any(|notice| notice.contains(part));
    assert!(left_out("(415)") && left_out("(404)") && left_out("without a name"), "{report}");
    assert!(info.messages["Refused"] > 10 && info.messages["SendValueReply"] > 10, "{info:?}");
    // The first, two after a connection was lost, and the last, which ends the session.
    assert_eq!(info.messages["Connect"], 4, "{info:?}");
}
