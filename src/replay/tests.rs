//! A recording of ours replays with no difference at all; and what differs is found, named and measured.

use std::io::Cursor;
use std::time::Duration;

use proptest::prelude::*;

use super::*;
use crate::bank::Changes;
use crate::device::KINDS;
use crate::plant::{self, Plant, embedded::Embedded};
use crate::signal_map::RateClass;
use crate::trace::{Compression, Header, Record, Recorder, Source, Writer};
use crate::wire::SendValueText;

const STEP: Duration = Duration::from_millis(1);

fn rig() -> Plant {
    plant::load(&Embedded, "models/rig", KINDS).expect("the rig")
}

fn engine(plant: &Plant) -> Engine {
    Engine::new(plant, STEP, 7).expect("an engine")
}

fn try_replay(plant: &Plant, trace: &str, tolerances: &Tolerances) -> Result<Report, ReplayError> {
    let open = || Reader::new("x.cps.jsonl", Cursor::new(trace.as_bytes().to_vec()));
    let survey = Survey::of(&plant.signal_map, open()?)?;
    run(&mut engine(plant), &plant.signal_map, &survey, open()?, tolerances)
}

fn replay(plant: &Plant, trace: &str) -> Report {
    try_replay(plant, trace, &Tolerances::default()).expect("a replay")
}

/// A live run as the threads of rows 7 and 8 make it, in one: a session, a bank, an engine, a recorder.
struct Live {
    plant: Plant,
    engine: Engine,
    simulation: bank::SimulationSide,
    io: bank::IoSide,
    recorder: Recorder<Vec<u8>>,
    commands: Commands,
    /// Whether the present values went out.
    greeted: bool,
    steps: u64,
}

impl Live {
    fn new() -> Live {
        let plant = rig();
        let (simulation, io) = bank::with_capacity(&plant.signal_map, 1_000, 10_000);
        let header = Header { source: Source::Simulation, step_ns: Some(1_000_000), ..Header::default() };
        let writer = Writer::new(Vec::new(), Compression::None, &header).expect("a header");
        let commands = Commands::new(plant.signal_map.clone());
        let (engine, recorder) = (engine(&plant), Recorder::new(writer));
        Live { plant, engine, simulation, io, recorder, commands, greeted: false, steps: 0 }
    }

    fn record(&mut self, record: Record) {
        self.recorder.record(record).expect("recorded");
    }

    /// The session established, anew if it was before.
    fn connect(&mut self) {
        let text = r#"{"Connect":{"Id":"eA==","enable":true}}"#.to_owned();
        self.record(Record::Exchanged { from: Sender::Plant, text });
        self.greeted = false;
    }

    fn send(&mut self, at: Instant, values: &[(RegisterId, Value)]) {
        let mut text = SendValueText::with_capacity(values.len());
        for (id, value) in values {
            text.push(&self.plant.signal_map.signal(*id).name, value).expect("a number");
        }
        if let Some(text) = text.finish() {
            self.record(Record::Reported { at, text });
        }
    }

    /// The IO thread sends what is new, levels too if their interval is over.
    fn look(&mut self, rates: &[RateClass]) {
        let mut values = Vec::new();
        if !self.greeted {
            if let Some(at) = self.io.all_outputs(&mut values) {
                self.send(at, &values);
                self.greeted = true;
            }
            return;
        }
        let mut groups: Vec<Changes> = Vec::new();
        let reached = self.io.changed(&mut groups).expect("no overflow").expect("a cycle");
        for group in &groups {
            self.send(group.at, &group.values);
        }
        for rate in rates {
            self.io.levels(*rate, &mut values);
        }
        self.send(reached, &values);
        self.record(Record::Reached { at: reached });
    }

    /// A message of the automation's arrives.
    fn command(&mut self, text: &str) {
        let Ok(Message::SendValue(entries)) = Message::decode(text) else { panic!("no message: {text}") };
        let values = self.commands.read(text, &entries, &mut Notices::default());
        let number = self.io.stage(&values).expect("room");
        self.record(Record::Staged { number, text: text.to_owned() });
    }

    fn step(&mut self) {
        let at = self.engine.now();
        let mut inputs = Vec::new();
        if let Some(number) = self.simulation.take(&mut inputs) {
            self.record(Record::Taken { at, number });
        }
        let registers = self.engine.tick(&inputs);
        self.simulation.publish(at, registers);
        self.steps += 1;
    }

    /// Steps with the default intervals, the IO thread waking at every edge or some time later.
    fn run(&mut self, steps: u64, lazy: u64) {
        for _ in 0..steps {
            self.step();
            let (fast, slow) = (self.steps.is_multiple_of(20), self.steps.is_multiple_of(500));
            if fast || slow || self.steps.is_multiple_of(lazy) {
                let rates: &[_] = match (fast, slow) {
                    (true, true) => &[RateClass::HighFrequency, RateClass::LowFrequency],
                    (true, false) => &[RateClass::HighFrequency],
                    _ => &[],
                };
                self.look(rates);
            }
        }
    }

    fn finish(self) -> String {
        String::from_utf8(self.recorder.finish().expect("an end")).expect("UTF-8")
    }
}

fn set(values: &[(&str, &str)]) -> String {
    let entry = |(name, value): &(&str, &str)| format!("{{\"name\":\"{name}\",\"value\":{value}}}");
    format!("{{\"SendValue\":[{}]}}", values.iter().map(entry).collect::<Vec<_>>().join(","))
}

/// A recording in which everything moves.
fn recording() -> String {
    let mut live = Live::new();
    live.run(3, 1);
    live.connect();
    live.run(7, 1);
    live.command(&set(&[("Belt.motorDirection", "1"), ("Belt.velocityTarget", "0.8"), ("Motor.enable", "true")]));
    live.command(&set(&[("Pusher.command", "1"), ("Motor.speedTarget", "12.5"), ("Axis.positionTarget", "0.3")]));
    live.command(&set(&[("Robot.XTarget", "0.4"), ("Gripper.suctionOn", "true")]));
    live.run(400, 3);
    // The same signal twice: the second message waits for the next step.
    live.command(&set(&[("Pusher.command", "2")]));
    live.command(&set(&[("Pusher.command", "0"), ("Robot.XTarget", "0.1")]));
    live.run(3_000, 7);
    live.command(&set(&[("Belt.motorDirection", "-1"), ("Gripper.blowOn", "true"), ("Nobody.knows", "1")]));
    live.command(&set(&[("Axis.positionTarget", "\"far\"")]));
    live.run(2_000, 1);
    live.finish()
}

#[test]
fn a_recording_of_ours_replays_without_any_difference() {
    let report = replay(&rig(), &recording());
    assert!(!report.differs, "{report}");
    assert!(report.levels.iter().all(|level| level.largest == 0.0 && level.silent == 0), "{report}");
    assert_eq!(report.levels.len() + report.edges.len(), 23, "{report}");
    let matched: u64 = report.edges.iter().map(|edge| edge.matched).sum();
    assert!(matched >= 15, "{report}");
    assert_eq!(report.notices.len(), 2, "{report}");
}

#[test]
fn two_replays_end_in_the_same_state() {
    let trace = recording();
    let plant = rig();
    let (one, other) = (replay(&plant, &trace), replay(&plant, &trace));
    assert_eq!(one, other);
    let changed = trace.replace("\"value\":12.5", "\"value\":12.6");
    assert_ne!(one.state_hash, replay(&plant, &changed).state_hash);
}

/// Replays the recording with its text changed, and compares what differs.
fn check_differs(change: impl Fn(String) -> String, differing: &[&str]) -> Report {
    let report = replay(&rig(), &change(recording()));
    assert_eq!(report.differing, differing, "{report}");
    assert!(report.differs);
    report
}

#[test]
fn a_level_that_differs_is_named_and_measured() {
    let report = check_differs(
        |trace| {
            let line = trace.lines().find(|line| line.contains("Motor.encoder\",\"value\":6")).expect("it turns");
            let (before, value) = line.split_once("Motor.encoder\",\"value\":").expect("the encoder");
            let wrong = format!("{before}Motor.encoder\",\"value\":99{value}");
            trace.replace(line, &wrong)
        },
        &["Motor.encoder"],
    );
    let level = report.levels.iter().find(|level| level.name == "Motor.encoder").expect("compared");
    assert!(level.largest > 9_000.0 && level.rms > level.largest / 50.0 && level.rms < level.largest, "{level:?}");
}

#[test]
fn an_edge_that_is_not_there_is_missing_and_one_that_is_not_recorded_is_extra() {
    let edge = "{\"name\":\"Belt.lightBarrierA\",\"value\":true}";
    let cut = |trace: String| {
        assert_eq!(trace.matches(edge).count(), 1, "the box passes once:\n{trace}");
        trace.replace(edge, "{\"name\":\"Belt.lightBarrierA\",\"value\":false}")
    };
    let report = check_differs(cut, &["Belt.lightBarrierA"]);
    let counts = |report: &Report| {
        let edge = report.edges.iter().find(|edge| edge.name == "Belt.lightBarrierA").expect("compared");
        (edge.matched, edge.early, edge.late, edge.missing, edge.extra)
    };
    // The false after it was no change then, so that the model's two edges are both extra.
    assert_eq!(counts(&report), (0, 0, 0, 0, 2), "{report}");
    let add = |trace: String| trace + "{\"t\":5.5,\"from\":\"plant\",\"SendValue\":[" + edge + "]}\n";
    let report = check_differs(add, &["Belt.lightBarrierA"]);
    assert_eq!(counts(&report), (2, 0, 0, 1, 0), "{report}");
}

/// A trace of the belt's start alone: the model's drive runs from 0.002 s on, 1 mm/s after 1 ms of 1 m/s².
fn start_of_belt(reports: &str) -> String {
    let start = set(&[("Belt.motorDirection", "1"), ("Belt.velocityTarget", "0.1")]);
    format!(
        "{{\"trace\":\"kinetwin/1\"}}\n{{\"t\":0.0,\"from\":\"automation\",{}\n{}{}",
        &start[1..],
        r#"{"t":0.0,"from":"plant","SendValue":[{"name":"Belt.driveRunning","value":false},{"name":"Belt.velocityActual","value":0}]}"#,
        reports,
    )
}

fn check_start(at: &str, tolerance: Duration, expect: (u64, u64, u64), differs: bool) {
    let trace = start_of_belt(&format!(
        "\n{{\"t\":{at},\"from\":\"plant\",\"SendValue\":[{{\"name\":\"Belt.driveRunning\",\"value\":true}}]}}\n\
         {{\"t\":4,\"from\":\"operator\",\"Event\":{{}}}}\n"
    ));
    let tolerances = Tolerances { edge: tolerance, level: 1.0, ..Tolerances::default() };
    let report = try_replay(&rig(), &trace, &tolerances).expect("a replay");
    let edge = &report.edges[0];
    assert_eq!((edge.matched, edge.early, edge.late), expect, "{report}");
    assert_eq!((edge.missing, edge.extra, report.differs), (0, 0, differs), "{report}");
}

#[test]
fn edges_are_paired_by_time_within_the_tolerance() {
    check_start("0.002", Duration::ZERO, (1, 0, 0), false);
    check_start("0.0215", Duration::from_millis(20), (1, 0, 0), false);
    check_start("0.0225", Duration::from_millis(20), (0, 1, 0), true);
    check_start("0.0005", Duration::ZERO, (0, 0, 1), true);
}

#[test]
fn a_level_that_the_recording_never_mentions_again_is_compared_all_the_same() {
    let silent = start_of_belt("\n{\"t\":3.5,\"from\":\"operator\",\"Event\":{}}\n");
    let report = replay(&rig(), &silent);
    let level = &report.levels[0];
    assert!(level.differs && level.silent == 1 && (level.largest - 0.1).abs() < 1e-6, "{report}");
    // A recording that reports every 3 s is not silent for 3 s.
    let slow = start_of_belt(
        r#"
{"t":3,"from":"plant","SendValue":[{"name":"Belt.velocityActual","value":0.1}]}
{"t":3,"from":"automation","SendValue":[{"name":"Belt.velocityTarget","value":0}]}
{"t":6,"from":"plant","SendValue":[{"name":"Belt.velocityActual","value":0}]}
"#,
    );
    let report = replay(&rig(), &slow);
    assert!(!report.levels[0].differs && report.levels[0].compared == 3, "{report}");
    // Until the silence is long, it is no evidence: it may be the time between two reports.
    let silent = start_of_belt("\n{\"t\":1.9,\"from\":\"operator\",\"Event\":{}}\n");
    assert!(!replay(&rig(), &silent).levels[0].differs);
}

#[test]
fn what_happened_between_two_sessions_was_reported_to_nobody() {
    let mut live = Live::new();
    live.connect();
    live.run(100, 1);
    live.command(&set(&[("Pusher.command", "1")]));
    live.run(100, 1);
    // The connection is lost; the pusher reaches its end, and nobody is told until the next session stands.
    for _ in 0..4_000 {
        live.step();
    }
    live.connect();
    live.run(300, 1);
    live.command(&set(&[("Pusher.command", "2")]));
    live.run(2_000, 1);
    let trace = live.finish();
    let report = replay(&rig(), &trace);
    assert!(!report.differs, "{report}");
    // Without the line that says so, it is a difference.
    let lines: Vec<_> = trace.lines().filter(|line| !line.contains("Connect")).collect();
    assert!(replay(&rig(), &(lines.join("\n") + "\n")).differs);
}

#[test]
fn what_is_left_out_is_named() {
    let trace = start_of_belt(
        r#"
{"t":0.1,"from":"plant","SendValue":[{"name":"Ghost.position","value":1},{"name":"Belt.motorDirection","value":1}]}
{"t":0.2,"from":"automation","SendValue":[{"name":"Belt.velocityActual","value":1},{"name":"Pusher.command","value":9},{"name":"Gripper.blowOn","value":false}]}
{"t":0.3,"from":"plant","SendValue":[{"name":"Belt.velocityActual","value":true}]}
{"t":0.4,"from":"plant","SendValues":[]}
{"t":0.5,"from":"plant","SendV"#,
    );
    let text = replay(&rig(), &trace).to_string();
    for part in [
        "left out: Belt.motorDirection: a command that the plant reported",
        "left out: Ghost.position: the model has no such signal",
        "a command was left out: Belt.velocityActual: reported by the simulation (404)",
        "Pusher.command: 9 is outside this signal's range, 0 to 2 (422)",
        "Belt.velocityActual: a report was left out: expected REAL",
        "\"SendValues\" is no message of the protocol",
        "line 8, the last, is torn and was left out",
        "not in the trace: Belt.driveEnabled, ",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn a_trace_is_checked_before_the_engine_moves() {
    let plant = rig();
    let check = |trace: &str, part: &str| {
        let error = try_replay(&plant, trace, &Tolerances::default()).expect_err(part).to_string();
        assert!(error.contains(part), "{error}");
    };
    let go_back = r#"{"t":0.5,"from":"plant","SendValue":[]}
{"t":0.4,"from":"plant","SendValue":[]}"#;
    check(&start_of_belt(&format!("\n{go_back}\n")), "x.cps.jsonl:5:6: time goes back");
    check(&start_of_belt("\n{\"t\":1.7e9,\"from\":\"plant\",\"SendValue\":[]}\n"), "after 30 days");
    check("{}", "no header");

    let trace = recording();
    let open = || Reader::new("x", Cursor::new(trace.as_bytes().to_vec())).expect("a trace");
    let survey = Survey::of(&plant.signal_map, open()).expect("whole");
    let mut moved = engine(&plant);
    moved.tick(&[]);
    let error = run(&mut moved, &plant.signal_map, &survey, open(), &Tolerances::default()).expect_err("it moved");
    assert!(error.to_string().contains("has made 1 steps"), "{error}");
    let shorter = start_of_belt("\n");
    let other = Reader::new("x", Cursor::new(shorter.into_bytes())).expect("a trace");
    let error = run(&mut engine(&plant), &plant.signal_map, &survey, other, &Tolerances::default());
    assert!(matches!(error, Err(ReplayError::Changed)));
}

/// Commands that keep the rig moving, by a number each.
fn any_command(pick: u8, amount: u8) -> String {
    let share = f64::from(amount) / 255.0;
    let number = |scale: f64| format!("{}", scale * share);
    match pick % 8 {
        0 => set(&[("Belt.motorDirection", ["-1", "0", "1"][usize::from(amount % 3)])]),
        1 => set(&[("Belt.velocityTarget", &number(0.9)), ("Gripper.suctionOn", "true")]),
        2 => set(&[("Pusher.command", ["0", "1", "2"][usize::from(amount % 3)])]),
        3 => set(&[("Robot.XTarget", &number(1.0)), ("Robot.RTarget", &number(-1.5))]),
        4 => set(&[("Gripper.suctionOn", "false"), ("Gripper.blowOn", if amount > 128 { "true" } else { "false" })]),
        5 => set(&[("Axis.positionTarget", &number(0.5))]),
        6 => set(&[("Motor.enable", "true"), ("Motor.speedTarget", &number(-60.0))]),
        _ => set(&[("Motor.enable", "false"), ("Robot.YTarget", &number(0.2))]),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn whatever_was_recorded_replays_without_any_difference(
        program in prop::collection::vec((any::<u8>(), any::<u8>(), 0..300u64, 1..30u64), 1..20),
        reconnect in any::<prop::sample::Index>(),
    ) {
        let mut live = Live::new();
        live.connect();
        let reconnect = reconnect.index(program.len());
        for (index, (pick, amount, steps, lazy)) in program.into_iter().enumerate() {
            if index == reconnect {
                live.connect();
            }
            live.command(&any_command(pick, amount));
            live.run(steps, lazy);
        }
        let report = replay(&rig(), &live.finish());
        prop_assert!(!report.differs, "{}", report);
        let is_exact = report.levels.iter().all(|level| level.largest == 0.0 && level.silent == 0);
        prop_assert!(is_exact && report.notices.is_empty(), "{}", report);
    }
}
