//! Where a model parts from a machine: on recordings of a rig that is not ours, and on a line with one slow conveyor.
//!
//! The rig's recordings are not part of the project: where they do not lie beside it, the tests say so and pass.

use std::fs::File;
use std::io::{BufReader, Cursor};
use std::path::Path;
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::gap::{Location, Recording, Span, Study, locate, segments};
use kinetwin::plant::{self, embedded::Embedded};
use kinetwin::run::{self, Connect, Options, RecordTo, Speed};
use kinetwin::time::Instant;
use kinetwin::trace::{self, Compression, Reader, Sender};

const RECORDINGS: &str = "../shared/data/rig-sample";

fn locate_in(model: &str, path: &Path) -> Location {
    let plant = run::model::load(model).expect("the model");
    let name = path.display().to_string();
    let reader = Reader::new(&name, BufReader::new(File::open(path).expect("it opens"))).expect("a trace");
    let recording = Recording::read(&plant, &name, reader, &[]).expect("a recording of the plant");
    let study = Study::new(&plant, &[recording]).expect("a study");
    let location = locate(&study);
    for device in location.devices.iter().filter(|device| device.own) {
        println!("{name}: {device:?}");
    }
    location
}

fn own(location: &Location) -> Vec<&str> {
    location.devices.iter().filter(|device| device.own).map(|device| device.device.as_str()).collect()
}

/// Both recordings of a case name these devices, the largest share first, and no other.
fn check(case: &str, devices: &[&str]) {
    for file in ["train", "holdout"] {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(RECORDINGS).join(case).join(format!("{file}.cps.jsonl.zst"));
        if !path.exists() {
            println!("skipped: no recording at {}", path.display());
            continue;
        }
        let location = locate_in("models/rig", &path);
        assert_eq!(own(&location), devices, "{case} {file}");
        let shares: f64 = location.devices.iter().map(|device| device.share).sum();
        assert!((shares - if devices.is_empty() { 0.0 } else { 1.0 }).abs() < 1e-9);
    }
}

#[test]
fn a_rig_built_to_the_table_has_no_gap() {
    check("case-01", &[]);
    check("case-02", &[]);
}

#[test]
fn a_late_gripper_is_the_grippers_own() {
    check("case-03", &["Gripper"]);
}

#[test]
fn three_parts_in_ten_thousand_of_a_speed_add_up_in_the_encoder() {
    check("case-04", &["Motor"]);
}

#[test]
fn an_axis_that_accelerates_less_is_the_robots() {
    check("case-05", &["Robot"]);
}

#[test]
fn friction_and_a_wobbling_screw_are_the_axis_s() {
    check("case-06", &["Axis"]);
    check("case-08", &["Axis"]);
}

#[test]
fn two_gaps_on_two_devices_are_both_named() {
    check("case-07", &["Robot", "Belt"]);
}

/// A recording of the rig, from its lines.
fn read(lines: &str, masks: &[Span]) -> Result<(Study, Recording), String> {
    let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
    let text = format!("{{\"trace\":\"kinetwin/1\",\"source\":\"plant\"}}\n{lines}");
    let reader = Reader::new("x.cps.jsonl", Cursor::new(text.into_bytes())).map_err(|error| error.to_string())?;
    let recording = Recording::read(&plant, "x.cps.jsonl", reader, masks).map_err(|error| error.to_string())?;
    let study = Study::new(&plant, std::slice::from_ref(&recording)).map_err(|error| error.to_string())?;
    Ok((study, recording))
}

/// A pusher's strokes as a machine has them, seen every 20 ms: it goes out by 3 per mille faster than the table says and back by 2 per
/// mille slower, and its flags are reported once they have stood for `filter` seconds. The motor beside it stands still.
fn strokes(filter: f64) -> String {
    let mut lines: Vec<(f64, String)> = Vec::new();
    let value = |signal: &str, value: &str| format!("{{\"name\":\"{signal}\",\"value\":{value}}}");
    let seen = |at: f64| ((at + filter - 0.0031) / 0.02).ceil() * 0.02 + 0.0031;
    let mut flag = |at: f64, name: &str, on: bool| {
        let entry = value(&format!("Pusher.{name}"), if on { "true" } else { "false" });
        lines.push((seen(at), format!("\"plant\",\"SendValue\":[{entry}]")));
    };
    ["limitExtended", "isRunning"].iter().for_each(|name| flag(-filter, name, false));
    flag(-filter, "limitRetracted", true);
    let mut commands = Vec::new();
    for stroke in 0..34 {
        let at = 0.5 + 1.3077 * f64::from(stroke) + 0.0137 * f64::from(stroke * stroke % 11);
        let is_out = stroke % 2 == 0;
        let speed = if is_out { 0.5 * 1.003 } else { 0.5 * 0.998 };
        let [left, reached] =
            if is_out { ["limitRetracted", "limitExtended"] } else { ["limitExtended", "limitRetracted"] };
        let entry = value("Pusher.command", if is_out { "1" } else { "2" });
        commands.push((at, format!("\"automation\",\"SendValue\":[{entry}]")));
        flag(at, "isRunning", true);
        flag(at + 0.002 / speed, left, false);
        flag(at + (0.5 - 0.002) / speed, reached, true);
        flag(at + 0.5 / speed, "isRunning", false);
    }
    lines.extend(commands);
    let speed = value("Motor.speedActual", "0.0");
    lines.extend((0..2300).map(|k| (0.0031 + 0.02 * f64::from(k), format!("\"plant\",\"SendValue\":[{speed}]"))));
    lines.sort_by(|a, b| a.0.total_cmp(&b.0));
    lines.into_iter().map(|(at, line)| format!("{{\"t\":{at:.6},\"from\":{line}}}\n")).collect()
}

/// Of a filter much shorter than the cycle few edges tell, and the pusher's speeds take up most of it.
#[test]
fn a_filter_of_all_flags_is_no_gap_of_the_one_device_that_shows_it() {
    let plant = plant::load(&Embedded, "models/rig-toleranced", KINDS).expect("the rig");
    let study = |lines: String| {
        let text = format!("{{\"trace\":\"kinetwin/1\",\"source\":\"plant\"}}\n{lines}");
        let reader = Reader::new("x", Cursor::new(text.into_bytes())).expect("a trace");
        let recording = Recording::read(&plant, "x", reader, &[]).expect("a recording");
        Study::new(&plant, &[recording]).expect("a study")
    };
    let prompt = study(strokes(0.0));
    assert_eq!((own(&locate(&prompt)), prompt.tasks[0].filter_s), (vec![], 0.0));
    let filtered = study(strokes(0.003));
    assert_eq!(own(&locate(&filtered)), [""; 0]);
    let found = filtered.tasks[0].filter_s;
    assert!((0.002..0.004).contains(&found), "{found}");
    // Later than any filter is the device's own.
    assert_eq!(own(&locate(&study(strokes(0.030)))), ["Pusher"]);
}

/// One report of `value` of the motor's speed each 20 ms, `count` of them, the motor being told nothing.
fn speeds(count: usize, value: impl Fn(usize) -> f64) -> String {
    let line = |k: usize| {
        let (at, value) = (k as f64 * 0.02, value(k));
        format!(
            "{{\"t\":{at:.3},\"from\":\"plant\",\"SendValue\":[{{\"name\":\"Motor.speedActual\",\"value\":{value:.2}}}]}}\n"
        )
    };
    (0..count).map(line).collect()
}

#[test]
fn what_model_and_trace_lack_is_named_and_left_out() {
    let stranger = "{\"t\":9.0,\"from\":\"plant\",\"SendValue\":[{\"name\":\"Oven.heat\",\"value\":1.0}]}\n";
    let (study, recording) = read(&(speeds(300, |_| 0.0) + stranger), &[]).expect("a recording");
    assert_eq!(recording.ignored.keys().collect::<Vec<_>>(), ["Oven.heat"]);
    assert!(recording.absent.contains(&"Belt.velocityActual".to_owned()) && recording.absent.len() == 35);
    assert_eq!(own(&locate(&study)), [""; 0]);
}

#[test]
fn a_masked_span_is_no_evidence() {
    let jam = speeds(300, |k| if (100..150).contains(&k) { 3.0 } else { 0.0 });
    assert_eq!(own(&locate(&read(&jam, &[]).expect("a recording").0)), ["Motor"]);
    let mask = [Span { from: 1.99, to: 3.01 }];
    assert_eq!(own(&locate(&read(&jam, &mask).expect("a recording").0)), [""; 0]);
}

#[test]
fn a_trace_that_says_little_is_read_all_the_same() {
    for count in [1, 2, 5, 20] {
        let (study, _) = read(&speeds(count, |_| 0.0), &[]).expect("a recording");
        assert_eq!(own(&locate(&study)), [""; 0], "{count}");
    }
}

#[test]
fn a_trace_that_cannot_be_used_is_refused_with_the_place() {
    let check = |lines: &str, words: &str| {
        let error = read(lines, &[]).expect_err("no recording");
        assert!(error.contains(words), "{error}");
    };
    check("", "none of the model's signals");
    check(
        "{\"t\":0.1,\"from\":\"plant\",\"SendValue\":[{\"name\":\"Oven.heat\",\"value\":1.0}]}\n",
        "1 signals that the model lacks",
    );
    check(&(speeds(3, |_| 0.0) + &speeds(1, |_| 0.0)), "time goes back");
    check(
        "{\"t\":0.1,\"from\":\"plant\",\"SendValue\":[{\"name\":\"Motor.speedActual\",\"value\":NaN}]}\n{}\n",
        "x.cps.jsonl:2",
    );
}

/// Runs the line, with `effect` on its Conveyor5, under its automation, and records it.
fn record_line(folder: &Path, effect: &str) -> std::path::PathBuf {
    record("models/depalletizer", "Conveyor5", folder, effect)
}

/// Runs a model, with `effect` on an instance, under its automation, and records it; the plant stays in `folder`.
fn record(model: &str, instance: &str, folder: &Path, effect: &str) -> std::path::PathBuf {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join(model).join("plant.xml");
    let text = std::fs::read_to_string(base).expect("the plant");
    let model = folder.join("plant.xml");
    let begin = format!(r#"<instance name="{instance}""#);
    let (before, after) = text.split_once(&begin).expect("the instance");
    let after = after.replacen("</instance>", &format!("{effect}</instance>"), 1);
    std::fs::write(&model, format!("{before}{begin}{after}")).expect("a plant");
    let path = folder.join("machine.cps.jsonl");
    let options = Options {
        connect: Some(Connect::Embedded),
        seed: 5,
        speed: Speed::Max,
        duration: Some(Duration::from_secs(60)),
        record: Some(RecordTo { path: path.clone(), replace: false }),
        ..Options::new(model.to_str().expect("a path"))
    };
    run::start(&options).expect("the run starts").finish().expect("the run ends");
    path
}

#[test]
fn a_line_built_to_its_model_has_no_gap() {
    let folder = tempfile::tempdir().expect("a folder");
    let location = locate_in("models/depalletizer", &record_line(folder.path(), ""));
    assert_eq!(own(&location), [""; 0]);
}

#[test]
fn a_slow_conveyor_is_named_and_none_behind_it() {
    let slip = r#"<effect place="transmission" kind="belt-slip"><parameter name="ratio" value="0.06"/></effect>"#;
    let folder = tempfile::tempdir().expect("a folder");
    let location = locate_in("models/depalletizer", &record_line(folder.path(), slip));
    assert_eq!(own(&location), ["Conveyor5"]);
}

/// A robot whose axis is weaker while others on its supply move: replayed alone it is told of them as they reported.
#[test]
fn what_neighbours_reported_moves_a_device_that_shares_their_supply() {
    let drop = r#"<effect place="actuator" kind="supply-drop" component="Y"><parameter name="fraction" value="0.12"/></effect>"#;
    let folder = tempfile::tempdir().expect("a folder");
    let path = record("models/rig", "Robot", folder.path(), drop);
    let off = |model: &str| {
        let location = locate_in(model, &path);
        let robot = location.devices.into_iter().find(|device| device.device == "Robot").expect("the robot");
        robot.signals.into_iter().find(|signal| signal.name == "Robot.actualPosY").expect("its axis").before
    };
    let (without, with) = (off("models/rig"), off(folder.path().join("plant.xml").to_str().expect("a path")));
    // When others start and stop is known to half a cycle: 10 ms, 12 % of 1 m/s.
    assert!(without > 0.01 && with < 0.2 * without, "{without} {with}");
}

/// A recording of a rig without a gap, of which these lines alone were written.
fn without(is_written: impl Fn(f64, bool) -> bool) -> Option<(Study, Vec<Recording>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(RECORDINGS).join("case-01/train.cps.jsonl.zst");
    if !path.exists() {
        println!("skipped: no recording at {}", path.display());
        return None;
    }
    let mut reader = Reader::new("x", BufReader::new(File::open(path).expect("it opens"))).expect("a trace");
    let mut text = "{\"trace\":\"kinetwin/1\",\"source\":\"plant\"}\n".to_owned();
    while let Some(line) = reader.next_line().expect("a line") {
        if is_written(line.at.seconds(), line.from == Sender::Plant) {
            text.extend([line.text, "\n"]);
        }
    }
    let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
    let reader = Reader::new("x", Cursor::new(text.into_bytes())).expect("a trace");
    let recordings = segments(&plant, Recording::read(&plant, "x", reader, &[]).expect("a recording"));
    Some((Study::new(&plant, &recordings).expect("a study"), recordings))
}

#[test]
fn reports_that_nobody_wrote_down_make_no_gap() {
    let Some((study, recordings)) = without(|at, is_report| !is_report || !(15.0..27.0).contains(&at)) else { return };
    assert_eq!((recordings.len(), recordings[0].lost.len()), (1, 1));
    assert_eq!(own(&locate(&study)), [""; 0]);
}

/// Where the commands are missing too, what follows is a recording of its own.
#[test]
fn a_recorder_that_was_away_makes_no_gap() {
    for (from, to) in [(12.0, 22.0), (15.0, 27.0)] {
        let Some((study, recordings)) = without(|at, _| !(from..to).contains(&at)) else { return };
        assert_eq!(recordings.len(), 2);
        assert!(recordings[1].name.contains(&format!("from {to}")), "{}", recordings[1].name);
        let compared = study.scores().iter().flat_map(|score| &score.signals).filter(|signal| signal.run == 1).count();
        assert!(compared > 10, "the second part is looked at: {compared}");
        assert_eq!(own(&locate(&study)), [""; 0]);
    }
}

/// A recording that begins while everything moves.
#[test]
fn a_recording_that_begins_under_way_makes_no_gap() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(RECORDINGS).join("case-01/train.cps.jsonl.zst");
    if !path.exists() {
        println!("skipped: no recording at {}", path.display());
        return;
    }
    let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
    for from in [20.0, 23.0, 28.0] {
        let reader = Reader::new("x", BufReader::new(File::open(&path).expect("it opens"))).expect("a trace");
        let span =
            trace::Span { from: Instant::from_seconds(from), to: Instant::from_seconds(54.0), warm_up: Duration::ZERO };
        let cut = trace::cut(reader, Vec::new(), Compression::None, span).expect("a cut");
        let reader = Reader::new("cut", Cursor::new(cut)).expect("a trace");
        let recording = Recording::read(&plant, "cut", reader, &[]).expect("a recording");
        let study = Study::new(&plant, &[recording]).expect("a study");
        assert_eq!(own(&locate(&study)), [""; 0], "from {from} s on");
    }
}
