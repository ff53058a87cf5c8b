//! What an operator does in a run stands in its trace, and a replay of the trace does it again.

use std::fs::File;
use std::io::BufReader;
use std::time::Duration;

use super::control::Order;
use super::{Options, RecordTo, Speed, model, start};
use crate::engine::Act;
use crate::replay::{self, Survey, Tolerances};
use crate::trace::Reader;
use crate::trace::operator::Deed;

fn record(deeds: &[(u64, &str)]) -> (replay::Report, String, u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.cps.jsonl");
    let options = Options {
        speed: Speed::Max,
        duration: Some(Duration::from_secs(12)),
        record: Some(RecordTo { path: path.clone(), replace: false }),
        controlled: true,
        ..Options::new("models/rig")
    };
    let plant = model::load(&options.model).expect("the rig");
    let handle = start(&options).expect("a run");
    let controls = handle.steering().expect("it can be controlled").controls;
    // Steps between the deeds, so that each has its place.
    for (steps, deed) in deeds {
        let deed = Deed::read(deed).expect("a deed");
        let act: Option<Act> = deed.act(&plant.signal_map).expect("of the rig");
        let order = Order::Operate { act: act.expect("an act"), deed: deed.text() };
        for order in [Order::Steps(*steps), order] {
            let receipt = controls.order(order).expect("room");
            while receipt.outcome().is_none() {
                std::thread::sleep(Duration::from_micros(200));
            }
            receipt.outcome().expect("looked").as_ref().expect("it can be done");
        }
    }
    controls.order(Order::Resume).expect("room");
    let summary = handle.finish().expect("a whole run");
    let open = || Reader::new("run", BufReader::new(File::open(&path).expect("a trace"))).expect("a header");
    let survey = Survey::of(&plant.signal_map, open()).expect("a good trace");
    let mut engine = model::engine(&plant, Options::STEP, 0).expect("an engine");
    let report =
        replay::run(&mut engine, &plant.signal_map, &survey, open(), &Tolerances::default()).expect("replayed");
    (report, summary.state_hash, summary.steps)
}

#[test]
fn a_replay_does_again_what_an_operator_did() {
    let (report, _, steps) = record(&[
        (800, r#"{"force":{"name":"Belt.velocityTarget","value":0.125}}"#),
        (700, r#"{"insert":{"kind":"box","size":[0.2,0.2,0.2],"on":"Belt","station":1.2}}"#),
        (900, r#"{"break":{"signal":"Belt.lightBarrierA"}}"#),
        (500, r#"{"release":"Belt.velocityTarget"}"#),
        (400, r#"{"break":{"drive":"Belt"}}"#),
        (600, r#"{"mend":{"drive":"Belt"}}"#),
        (300, r#"{"mend":{"signal":"Belt.lightBarrierA"}}"#),
        (10, r#"{"break":"message"}"#),
    ]);
    assert_eq!(steps, 12_000);
    assert!(!report.differs, "{report}");
    assert!(!report.levels.is_empty() && !report.edges.is_empty(), "something was compared");
}

#[test]
fn a_run_that_was_only_looked_at_is_the_run() {
    let (_, looked, _) = record(&[]);
    let options = Options { speed: Speed::Max, duration: Some(Duration::from_secs(12)), ..Options::new("models/rig") };
    let plain = start(&options).expect("a run").finish().expect("a whole run");
    assert_eq!(looked, plain.state_hash);
}
