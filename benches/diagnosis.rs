//! How long a diagnosis takes, from the trace to the report's page, over every effect and device; how many replays of a device
//! it makes in a second, and how much memory it takes at its peak.
//!
//!     cargo bench --bench diagnosis             all of them
//!     cargo bench --bench diagnosis -- axis     those whose name holds the word
//!
//! The goals, on two cores: a trace of 60 s of the line (130 signals, 20 ms) in less than 60 s, a single axis with 25 s at 1 kHz in
//! less than 20 s, and less than 1 GB of memory. The machines are our own engine with one effect added.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufReader, Cursor};
use std::path::Path;
use std::time::{Duration, Instant};

use kinetwin::device::{Device, KINDS};
use kinetwin::effect;
use kinetwin::gap::Recording;
use kinetwin::gap::diagnosis::{Options, diagnose, kept_back};
use kinetwin::gap::page::page;
use kinetwin::plant::{self, EffectPlace, EffectSpec, ParameterValue, Plant, embedded::Embedded};
use kinetwin::run::{self, Connect, RecordTo, Speed};
use kinetwin::trace::Reader;

fn plant(model: &str) -> Plant {
    plant::load(&Embedded, model, KINDS).expect("a model of ours")
}

/// A minute of the line under its automation, with an effect on one of its instances.
fn line(plant: &Plant, instance: &str, effect: &str) -> Recording {
    let folder = tempfile::tempdir().expect("a folder");
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/depalletizer/plant.xml");
    let text = std::fs::read_to_string(base).expect("the line's plant");
    let (before, after) = text.split_once(&format!("<instance name=\"{instance}\"")).expect("the instance");
    let after = after.replacen("</instance>", &format!("{effect}</instance>"), 1);
    let model = folder.path().join("plant.xml");
    std::fs::write(&model, format!("{before}<instance name=\"{instance}\"{after}")).expect("a plant");
    let path = folder.path().join("line.cps.jsonl");
    let options = run::Options {
        connect: Some(Connect::Embedded),
        seed: 5,
        speed: Speed::Max,
        duration: Some(Duration::from_secs(60)),
        record: Some(RecordTo { path: path.clone(), replace: false }),
        ..run::Options::new(model.to_str().expect("a path"))
    };
    run::start(&options).expect("the run starts").finish().expect("the run ends");
    let reader = Reader::new("line", BufReader::new(File::open(&path).expect("it opens"))).expect("a trace");
    Recording::read(plant, "line", reader, &[]).expect("a recording of the line")
}

/// The rig's axis for 25 s with a Coulomb friction of 8 N: it is told where to be and says where it is a thousand times a second.
fn axis(plant: &Plant) -> Recording {
    let instance = plant.instances.iter().find(|instance| instance.name == "Axis").expect("the rig's axis");
    let task = &instance.tasks[0];
    let friction = EffectSpec {
        place: EffectPlace::Mechanics,
        kind: "coulomb-friction".to_owned(),
        component: None,
        parameters: [("force".to_owned(), ParameterValue::Number(8.0))].into(),
    };
    let mut axis = effect::build(task.kind, &task.parameters, "Axis", &[friction], 0).expect("an axis with friction");
    let mut text = "{\"trace\":\"kinetwin/1\",\"source\":\"plant\"}\n".to_owned();
    for step in 0..25_000_u32 {
        milliseconds(&mut text, axis.as_mut(), task.kind.ports.len(), step);
    }
    let reader = Reader::new("axis", Cursor::new(text.into_bytes())).expect("a trace");
    Recording::read(plant, "axis", reader, &[]).expect("a recording of the axis")
}

/// A look at the axis, and 0.4 ms later its next target: slow and quick sines, and a rest of a second in every five.
fn milliseconds(text: &mut String, axis: &mut dyn Device, ports: usize, step: u32) {
    let mut reports = vec![0.0; ports];
    axis.report(&mut reports);
    let at = f64::from(step) * 1e-3;
    let round = |value: f64, to: f64| (value / to).round() * to;
    let [position, velocity, force] = [round(reports[4], 1e-5), round(reports[5], 1e-3), round(reports[6], 0.5)];
    let told = if at % 5.0 < 4.0 { at } else { at - at % 5.0 + 4.0 };
    let target = 0.2 * (0.9 * told).sin() + 0.05 * (4.3 * told).sin() + 0.01 * (11.0 * told).sin();
    let report = |name: &str, value: f64| format!("{{\"name\":\"Axis.{name}\",\"value\":{value:.6}}}");
    let reports = [report("position", position), report("velocity", velocity), report("force", force)].join(",");
    let written = writeln!(text, "{{\"t\":{at:.4},\"from\":\"plant\",\"SendValue\":[{reports}]}}").and_then(|()| {
        let target = report("positionTarget", target);
        writeln!(text, "{{\"t\":{:.4},\"from\":\"automation\",\"SendValue\":[{target}]}}", at + 4e-4)
    });
    written.expect("a string takes all");
    axis.advance(4e-4);
    axis.command(0, round(target, 1e-6));
    axis.advance(6e-4);
}

/// The most memory that the process has held since [`forget`], MB; `None` where the system does not say.
fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}

/// How long all processors worked for the process so far, s: on a machine that does other things too, what counts.
fn processor() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name in brackets: user and system time are the 12th and the 13th, in hundredths of a second.
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut next = || fields.next()?.parse::<f64>().ok();
    Some((next()? + next()?) / 100.0)
}

/// Begins a new peak where the system can.
fn forget() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

fn measure(name: &str, goal: f64, plant: &Plant, recording: &Recording) {
    forget();
    let (start, used) = (Instant::now(), processor());
    let split = kept_back(std::slice::from_ref(recording));
    let options = Options { is_asked: &|_| true, is_meant: &|_| true, is_stopped: &|| false, tell: &|_| {} };
    let answer = diagnose(plant, &split.train, &split.held_out, &options).expect("a diagnosis");
    let evidence = answer.evidence(plant).expect("pictures");
    let page = page(&answer.report, &evidence);
    let seconds = start.elapsed().as_secs_f64();
    let used = processor().zip(used).map_or("?".to_owned(), |(now, before)| format!("{:.1}", now - before));
    let replays: usize = answer.findings.iter().map(|finding| finding.replays).sum();
    let memory = peak().map_or("?".to_owned(), |peak| format!("{peak:.0}"));
    println!(
        "{name:26} {seconds:6.1} s of {goal:.0}  {used:>6} s of processors  {replays:7} replays  {:7.0} a second  {memory:>5} MB   page {} kB",
        replays as f64 / seconds,
        page.len() / 1000
    );
    for finding in answer.findings.iter().filter(|finding| finding.replays > 100) {
        println!("  {}: {} replays", answer.held_out.subjects[finding.subject].name, finding.replays);
    }
    let causes = answer.report.cause.iter().map(|cause| format!("{} of {}", cause.effect, cause.device));
    println!("  {} {}", answer.report.verdict, causes.collect::<Vec<_>>().join(", "));
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_asked = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
    let rig = plant("models/rig");
    if is_asked("axis") {
        measure("axis, 25 s at 1 kHz", 20.0, &rig, &axis(&rig));
    }
    let depalletizer = plant("models/depalletizer");
    let slip = r#"<effect place="transmission" kind="belt-slip"><parameter name="ratio" value="0.06"/></effect>"#;
    let slow = r#"<effect place="actuator" kind="acceleration-limit" component="Y"><parameter name="limit" value="0.8"/></effect>"#;
    for (name, instance, effect) in
        [("line, a belt that slips", "Conveyor5", slip), ("line, a slow robot", "Robot", slow)]
    {
        if is_asked(name) {
            measure(name, 60.0, &depalletizer, &line(&depalletizer, instance, effect));
        }
    }
}
