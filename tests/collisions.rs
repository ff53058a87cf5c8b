//! A run sees a collision, tells it with the signals of that moment, and ends with it where it is told to.

use std::fs;
use std::path::Path;
use std::time::Duration;

use kinetwin::run::{Options, RecordTo, Speed, Summary, start};

/// The rig with a conveyor where the robot's carriage lowers the tool: its surface at `height`.
fn rig_with_a_table(folder: &Path, height: f64) -> Options {
    let rig = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/rig/plant.xml");
    let text = fs::read_to_string(&rig).expect("the rig");
    let pose = text.split("name=\"Robot\"").nth(1).and_then(|rest| rest.split("<pose").nth(1)).expect("its place");
    let of = |name: &str| {
        let value = pose.split(&format!(" {name}=\"")).nth(1).and_then(|rest| rest.split('"').next());
        value.map_or(0.0, |value| value.parse::<f64>().expect("a number"))
    };
    let (x, y, z) = (of("x") + 0.2, of("y") + 0.4, of("z") + height);
    let table = format!(
        "  <instance name=\"Table\" prototype=\"StraightConveyor\">\n    <pose x=\"{x}\" y=\"{y}\" z=\"{z}\"/>\n  \
         </instance>\n</plant>"
    );
    // With the table it has other signals than its map says.
    let plant = text.replace("</plant>", &table).replace(" signals-map=\"signals-maps/rig.xml\"", "");
    let path = folder.join("plant.xml");
    fs::write(&path, plant).expect("a plant");
    Options {
        speed: Speed::Max,
        duration: Some(Duration::from_secs(20)),
        step: Duration::from_millis(5),
        ..Options::new(path.to_string_lossy())
    }
}

fn run(options: &Options) -> Summary {
    start(options).expect("a run").finish().expect("its end")
}

#[test]
fn a_run_ends_with_its_first_collision_and_records_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let trace = folder.path().join("session.cps.jsonl");
    let options = Options {
        stop_on_collision: true,
        record: Some(RecordTo { path: trace.clone(), replace: false }),
        ..rig_with_a_table(folder.path(), 0.2)
    };
    let summary = run(&options);
    assert_eq!((summary.collisions, summary.first_collisions.len()), (1, 1), "{summary:?}");
    assert!(summary.sim_s < 20.0, "{}", summary.sim_s);
    let collision = &summary.first_collisions[0];
    assert!(collision.between[0].starts_with("Robot.") && collision.between[1] == "Table", "{collision:?}");
    assert!(collision.signals["Robot.actualPosZ"].as_f64().is_some_and(|z| z < 0.3), "{collision:?}");
    assert!(collision.signals.contains_key("Table.velocityActual"));
    let recorded = fs::read_to_string(&trace).expect("a trace");
    let lines: Vec<&str> = recorded.lines().filter(|line| line.contains("\"from\":\"engine\"")).collect();
    assert_eq!(lines.len(), 1, "{lines:?}");
    let event: serde_json::Value = serde_json::from_str(lines[0]).expect("JSON");
    assert_eq!(event["Event"]["collision"], serde_json::to_value(collision).expect("JSON"));
}

#[test]
fn a_table_below_the_robots_way_is_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let summary = run(&Options { stop_on_collision: true, ..rig_with_a_table(folder.path(), -0.4) });
    assert_eq!(summary.collisions, 0, "{:?}", summary.first_collisions);
    assert_eq!(summary.sim_s, 20.0);
}
