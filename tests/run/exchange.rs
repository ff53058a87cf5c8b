//! What goes between a running model and its automation arrives: every edge, in order, the same for everybody; and what
//! was recorded of it replays with no difference.

use std::path::Path;
use std::sync::Arc;

use crate::support::{Host, Running, kinetwin};
use kinetwin::automation::fault::Fault;
use kinetwin::automation::server::{ListenSettings, Server};
use kinetwin::automation::{Automation, Control, Faulty};
use kinetwin::device::KINDS;
use kinetwin::plant::{embedded::Embedded, load};
use serde_json::{Value, json};
use tempfile::TempDir;

/// The automation of the rig, on a free port, with `faults`.
fn automation(faults: &[Fault]) -> (Server, String) {
    let plant = load(&Embedded, "models/rig", KINDS).expect("the rig");
    let automation = Automation::new(Arc::clone(&plant.signal_map), Control::ByPlant).expect("its program");
    let server = Server::start(ListenSettings::loopback(), Faulty::new(automation, faults, 1)).expect("a free port");
    let url = format!("ws://{}", server.address());
    (server, url)
}

fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().expect("a path in UTF-8").to_owned()
}

/// The automation's values in a trace, message by message.
fn commands(trace: &str) -> Vec<String> {
    let text = std::fs::read_to_string(trace).expect("a trace");
    let lines = text.lines().filter(|line| line.contains(r#""from":"automation","SendValue""#));
    lines.map(|line| line.split_once(r#""SendValue":"#).expect("values").1.to_owned()).collect()
}

/// A belt at 2 m/s with a part on it that is 3 mm long: it cuts a beam for a step or two of 1 ms.
const FLASH: &str = r#"<plant name="flash">
  <adapter hf="20ms"/>
  <instance name="Belt" prototype="StraightConveyor">
    <pose x="0" y="0" z="0.8"/>
    <property name="length" value="4 m"/>
    <property name="acceleration" value="20 m/s2"/>
    <property name="barrierA" value="1 m"/>
    <property name="barrierB" value="3 m"/>
  </instance>
  <part kind="box" at="Belt" x="0.2" size="0.003;0.2;0.2"/>
</plant>
"#;

#[test]
fn a_flash_of_a_light_barrier_within_a_cycle_reaches_the_automation() {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("plant.xml"), FLASH).expect("a plant's file");
    let trace = path(&folder, "flash.cps.jsonl");
    let host = Host::new();
    let model = folder.path().to_str().expect("a path in UTF-8");
    let run = Running::start(&["run", model, "--connect", &host.url(), "--record", &trace, "--json"]);
    let (mut connection, _) = host.accept_session(200);
    assert_eq!(connection.receive_value("Belt.lightBarrierA"), false);
    let start = json!([{ "name": "Belt.velocityTarget", "value": 2.0 }, { "name": "Belt.motorDirection", "value": 1 }]);
    connection.send(&json!({ "SendValue": start }).to_string());
    for barrier in ["Belt.lightBarrierA", "Belt.lightBarrierB"] {
        // In two messages, in order: each gives the first value that it finds in a message of its own.
        assert_eq!(connection.receive_value(barrier), true);
        assert_eq!(connection.receive_value(barrier), false);
    }
    run.interrupt();
    connection.farewell();
    assert_eq!(run.end().code(), 0);
    let text = std::fs::read_to_string(&trace).expect("a trace");
    let times = |value: bool| -> f64 {
        let entry = format!(r#"{{"name":"Belt.lightBarrierA","value":{value}}}"#);
        let line = text.lines().rfind(|line| line.contains(&entry)).expect("an edge");
        serde_json::from_str::<Value>(line).expect("JSON")["t"].as_f64().expect("a time")
    };
    let flash = times(false) - times(true);
    assert!((0.0009..0.0021).contains(&flash), "cut for one step or two, not for {flash} s");
}

#[test]
fn two_simulations_of_one_automation_receive_the_same_messages_in_the_same_order() {
    let folder = TempDir::new().expect("a folder");
    let (_server, url) = automation(&[]);
    let traces = [path(&folder, "first.cps.jsonl"), path(&folder, "second.cps.jsonl")];
    let start = |trace: &str| {
        let mut run = Running::start(&["run", "rig", "--connect", &url, "--for", "5s", "--record", trace, "--json"]);
        run.line("stands");
        run
    };
    let first = start(&traces[0]);
    let second = start(&traces[1]);
    assert_eq!((first.end().code(), second.end().code()), (0, 0));
    let (first, second) = (commands(&traces[0]), commands(&traces[1]));
    // The second came later: it heard the present values, then all that the first heard from there on. The first left
    // earlier.
    let heard = &second[1..];
    let together = (0..first.len()).map(|from| &first[from..]).find(|rest| heard.starts_with(rest)).unwrap_or_default();
    assert!(together.len() >= 10, "first: {first:#?}\nsecond: {second:#?}");
}

#[test]
fn a_recorded_session_replays_with_no_difference_on_the_wall_clock_and_in_lock_step() {
    for speed in ["1.0", "max"] {
        let folder = TempDir::new().expect("a folder");
        let trace = path(&folder, "session.cps.jsonl.zst");
        let ended = kinetwin(&["run", "models/rig", "--for", "3s", "--speed", speed, "--record", &trace, "--json"]);
        assert_eq!(ended.code(), 0, "{}", ended.stderr);
        let summary = ended.json();
        let [once, again] = [0; 2].map(|_| {
            let ended = kinetwin(&["replay", &trace, "--model", "models/rig", "--json"]);
            assert_eq!(ended.code(), 0, "{}{}", ended.stdout, ended.stderr);
            assert_eq!(ended.stderr, "", "the model is the one that was recorded with");
            ended.json()
        });
        assert_eq!(once, again);
        assert_eq!(once["state_hash"], summary["state_hash"], "at speed {speed}");
        assert_eq!(once["unrecorded"], json!([]));
        assert!(!Path::new(&format!("{trace}.partial")).exists());
    }
}

#[test]
fn a_recorded_session_with_a_faulty_automation_replays_with_no_difference() {
    let folder = TempDir::new().expect("a folder");
    let trace = path(&folder, "faulty.cps.jsonl");
    let faults = ["wrong-type", "unknown-name", "garbage", "drop:1"].map(|fault| fault.parse().expect(fault));
    let (_server, url) = automation(&faults);
    let ended = kinetwin(&["run", "rig", "--connect", &url, "--for", "5s", "--record", &trace, "--json"]);
    assert_eq!(ended.code(), 0, "{}", ended.stderr);
    let sessions = ended.json()["sessions"].as_u64().expect("a number");
    assert!(sessions >= 2, "each connection lasts for a second: {sessions}");
    let ended = kinetwin(&["replay", &trace, "--model", "rig", "--json"]);
    assert_eq!(ended.code(), 0, "{}{}", ended.stdout, ended.stderr);
}

#[test]
fn a_run_as_fast_as_possible_does_not_depend_on_how_fast_that_is() {
    let run = || kinetwin(&["run", "rig", "--speed", "max", "--for", "20s", "--seed", "7", "--json"]);
    let [one, other] = [run().json(), run().json()];
    for field in ["state_hash", "messages_in", "messages_out", "values_in", "values_out", "parts_in", "sim_s"] {
        assert_eq!(one[field], other[field], "{field}");
    }
    assert_eq!((&one["overruns"], &one["messages_lost"]), (&json!(0), &json!(0)));
}

#[test]
fn a_check_asks_the_server_for_its_interface() {
    let (_server, url) = automation(&[]);
    let ended = kinetwin(&["check", "models/rig", "--connect", &url, "--json"]);
    assert_eq!((ended.code(), &ended.json()["mismatches"]), (0, &json!([])), "{}", ended.stderr);
    let ended = kinetwin(&["check", "models/curve", "--connect", &url, "--json"]);
    let mismatches = ended.json()["mismatches"].to_string();
    assert_eq!(ended.code(), 1);
    for part in ["Curve.velocityTarget: the server lacks it", "Robot.XTarget: the server has it as an output of type"] {
        assert!(mismatches.contains(part), "{part}: {mismatches}");
    }
    let url = Host::new().url();
    let ended = kinetwin(&["check", "models/rig", "--connect", &url]);
    assert_eq!((ended.code(), ended.stdout.as_str()), (2, ""));
    assert!(ended.stderr.contains("nobody listens there"), "{}", ended.stderr);
}

/// A pusher beside a belt that leads nowhere: what it pushes falls.
const SPILL: &str = r#"<plant name="spill">
  <instance name="Belt" prototype="StraightConveyor">
    <pose x="0" y="0" z="0.8"/>
    <property name="length" value="2 m"/>
  </instance>
  <instance name="Pusher" prototype="Pusher">
    <pose x="1" y="-0.45" z="0.8" rz="90 deg"/>
    <property name="stroke" value="0.8 m"/>
    <property name="extendSpeed" value="2 m/s"/>
  </instance>
  <part kind="box" at="Belt" x="1" size="0.2;0.2;0.2"/>
</plant>
"#;

#[test]
fn what_befalls_a_part_is_told_with_its_place() {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("plant.xml"), SPILL).expect("written");
    let host = Host::new();
    let model = folder.path().to_str().expect("a path in UTF-8");
    let mut run = Running::start(&["run", model, "--connect", &host.url(), "--json"]);
    let (mut connection, _) = host.accept_session(200);
    connection.send_value("Pusher.command", json!(1));
    let line = run.line("fell from");
    assert!(line.contains("warning: at ") && line.contains("box 1 fell from Belt at x 1.000, y 0."), "{line}");
    run.interrupt();
    connection.farewell();
    assert_eq!(run.end().json()["parts_lost"], 1);
}

/// R007: a selection of signals, and of how often they come at most.
#[test]
fn a_run_asks_for_the_signals_that_it_wants_no_faster_than_it_wants_them() {
    let host = Host::new();
    let select = ["--select", "Belt.velocityTarget=100ms", "--select", "Pusher.command"];
    let mut run = Running::start(&[&["run", "models/rig", "--connect", &host.url()], &select[..]].concat());
    let (connection, connect) = host.accept_session(200);
    let expect = json!([
        { "name": "Belt.velocityTarget", "minInterval": 100 },
        { "name": "Pusher.command", "minInterval": 0 }
    ]);
    assert_eq!(connect["Signals"], expect);
    // Before it stands there is no session to be ended in good order.
    run.line("stands");
    run.interrupt();
    connection.farewell();
    assert_eq!(run.end().code(), 0);
    // A server that knows the selection keeps to it.
    let (_server, url) = automation(&[]);
    let folder = TempDir::new().expect("a folder");
    let trace = path(&folder, "selected.cps.jsonl");
    let arguments =
        ["run", "models/rig", "--connect", &url, "--for", "2s", "--record", &trace, "--select", "Belt.velocityTarget"];
    assert_eq!(kinetwin(&arguments).code(), 0);
    let heard = commands(&trace);
    assert!(!heard.is_empty());
    assert!(
        heard.iter().all(|text| text.matches("\"name\"").count() == 1 && text.contains("Belt.velocityTarget")),
        "{heard:?}"
    );
}
