//! A recording with its scene as an MCAP file: what stands there is what its schemas, which stand there too, say.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::Value;

use super::table::{ExportArguments, export};

#[test]
fn scene_and_signals_stand_in_the_file_with_their_schemas() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rig.mcap");
    let arguments = ExportArguments {
        trace: PathBuf::from("tests/data/rig-good.cps.jsonl.zst"),
        csv: None,
        mcap: Some(path.clone()),
        model: Some("models/rig".to_owned()),
        scene: true,
        force: false,
        json: true,
    };
    assert!(export(&arguments).is_ok(), "it is written");
    let bytes = std::fs::read(&path).expect("the file");
    let mut seen: BTreeMap<String, u64> = BTreeMap::new();
    let mut validators = BTreeMap::new();
    let mut frames = BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).expect("an MCAP file") {
        let message = message.expect("a message");
        let topic = message.channel.topic.clone();
        let schema = message.channel.schema.as_ref().expect("a schema");
        let validator = validators.entry(schema.name.clone()).or_insert_with(|| {
            let text: Value = serde_json::from_slice(&schema.data).expect("JSON");
            jsonschema::validator_for(&text).expect("a schema")
        });
        let value: Value = serde_json::from_slice(&message.data).expect("JSON");
        assert!(validator.is_valid(&value), "{topic}: {value}");
        if let Some(transforms) = value["transforms"].as_array() {
            for one in transforms {
                frames.insert(one["child_frame_id"].as_str().expect("a name").to_owned(), message.log_time);
            }
        }
        if topic == "/scene" {
            let entities = value["entities"].as_array().expect("devices");
            assert!(entities.iter().all(|one| frames.contains_key(one["frame_id"].as_str().expect("a frame"))));
            assert!(entities.iter().any(|one| !one["triangles"].as_array().expect("triangles").is_empty()));
        }
        *seen.entry(topic).or_default() += 1;
    }
    assert_eq!(seen["/scene"], 1, "the devices stand there once");
    assert!(seen["/tf"] > 100 && seen["/parts"] > 100, "what moves moves: {seen:?}");
    assert!(seen.keys().any(|topic| topic.ends_with("lightBarrierA")), "the signals are there: {seen:?}");
}
