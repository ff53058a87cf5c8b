//! The page of a report, made of real evidence: a rig that was recorded with an effect, its model without, and both beside
//! each other. Pages are left in the folder of the tests' files, for whoever wants to look at one.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

use kinetwin::device::KINDS;
use kinetwin::gap::page::{Added, Evidence, gather, page};
use kinetwin::gap::report::{
    Cause, DeviceGap, FittedParameter, MadeFrom, NotTestable, Regime, Report, Rival, SignalGap, SignalKind, Verdict,
};
use kinetwin::gap::{Overrides, Recording, Study, Subject};
use kinetwin::plant::{self, EffectPlace, EffectSpec, ParameterValue, Plant, embedded::Embedded};
use kinetwin::trace::Reader;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn rig() -> Plant {
    plant::load(&Embedded, "models/rig", KINDS).expect("the rig")
}

fn study(plant: &Plant, trace: &Path) -> Study {
    let file = BufReader::new(File::open(trace).expect("a trace"));
    let reader = Reader::new(trace.display().to_string(), file).expect("a trace");
    let name = trace.file_name().expect("a name").to_string_lossy().into_owned();
    let recording = Recording::read(plant, &name, reader, &[]).expect("a recording");
    Study::new(plant, &[recording]).expect("a study")
}

fn effect(kind: &str, place: EffectPlace, component: Option<&str>, name: &str, value: f64) -> EffectSpec {
    EffectSpec {
        place,
        kind: kind.to_owned(),
        component: component.map(str::to_owned),
        parameters: BTreeMap::from([(name.to_owned(), ParameterValue::Number(value))]),
    }
}

fn cause(device: &str, spec: &EffectSpec, unit: &str, spread: f64) -> Cause {
    let parameter = |(name, value): (&String, &ParameterValue)| {
        let ParameterValue::Number(value) = *value else { panic!("a number") };
        let ci95 = [value - spread, value + spread];
        FittedParameter { name: name.clone(), value, unit: unit.to_owned(), ci95, not_identifiable: false }
    };
    let mut cause = Cause {
        device: device.to_owned(),
        component: spec.component.clone(),
        effect: spec.kind.clone(),
        place: spec.place,
        weight: 0.97,
        class: Vec::new(),
        parameters: spec.parameters.iter().map(parameter).collect(),
        texts: BTreeMap::new(),
    };
    cause.class.push(cause.member());
    cause
}

/// The gap of a device without and with an effect, as its scores have it.
fn device_gap(subject: &Subject, added: &[EffectSpec], share: f64) -> DeviceGap {
    let score = |effects: &[EffectSpec]| {
        let predicted = subject.predict(effects, &Overrides::none()).expect("a prediction");
        subject.score(&predicted).signals
    };
    let (before, after) = (score(&[]), score(added));
    let signals =
        before.iter().zip(&after).filter(|(before, after)| before.cost > after.cost).map(|(before, after)| {
            let info = &subject.signals[before.signal];
            let is_edge = before.level.is_none();
            SignalGap {
                name: info.name.clone(),
                kind: if is_edge { SignalKind::Edge } else { SignalKind::Level },
                before: Some(before.rms),
                after: Some(after.rms),
                floor: Some(before.floor),
                unit: if is_edge { "s".to_owned() } else { info.unit.clone() },
                missing: None,
                extra: None,
                in_windows: None,
            }
        });
    let regimes =
        vec![Regime { when: "starting".to_owned(), share: 0.52 }, Regime { when: "stopping".to_owned(), share: 0.41 }];
    DeviceGap { device: subject.name.clone(), share, signals: signals.collect(), regimes }
}

/// A report that names `causes`, its figures those of the scores.
fn report(study: &Study, causes: &[(&str, EffectSpec, &str, f64)]) -> Report {
    let mut report = Report::new(Verdict::Effect);
    let share = 1.0 / causes.len() as f64;
    let (mut before, mut after, mut floor) = (0.0, 0.0, 0.0);
    for (device, spec, unit, spread) in causes {
        let subject = study.subject(device).expect("a subject");
        let score = |effects: &[EffectSpec]| {
            subject.score(&subject.predict(effects, &Overrides::none()).expect("a prediction"))
        };
        let nominal = score(&[]);
        before += nominal.total;
        after += score(std::slice::from_ref(spec)).total;
        floor += nominal.signals.iter().map(|signal| signal.floor_cost.0).sum::<f64>();
        report.cause.push(cause(device, spec, unit, *spread));
        report.devices.push(device_gap(subject, std::slice::from_ref(spec), share));
    }
    let normalised = |cost: f64| (cost / floor).sqrt();
    report.gap.before = Some(normalised(before));
    report.gap.after = Some(normalised(after));
    report.gap.floor = Some(1.0);
    report.shrink.holdout_before = report.gap.before;
    report.shrink.holdout_after = report.gap.after;
    let ratio = ((after - floor) / (before - floor)).max(0.0).sqrt();
    report.shrink.ratio = Some(ratio);
    report.shrink.ci95 = Some([ratio * 0.6, ratio * 1.5]);
    report.shrink.explainable_left = Some(normalised(after) - 1.0);
    report.outside = Some(0.01);
    report
}

fn evidence(plant: &Plant, study: &Study, causes: &[(&str, EffectSpec, &str, f64)]) -> Evidence {
    let none = Overrides::none();
    let added: Vec<Added<'_>> = causes
        .iter()
        .map(|(device, spec, ..)| Added { device, effects: std::slice::from_ref(spec), overrides: &none })
        .collect();
    gather(plant, study, &added).expect("evidence")
}

/// Leaves a page for people, and checks what holds for all of them: nothing is fetched, every picture is well-formed, and
/// nothing in it is no number.
fn keep(name: &str, page: &str) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    fs::write(folder.join(name), page).expect("a written page");
    let without_names = page.replace("http://www.w3.org/2000/svg", "");
    for word in ["http://", "https://", "<script", "<link", "src=", "url(", "NaN", "inf "] {
        assert!(!without_names.contains(word), "{name}: {word}");
    }
    for picture in page.split("<svg").skip(1) {
        let picture = format!("<svg{}</svg>", picture.split("</svg>").next().expect("a picture"));
        kinetwin::xml::parse(name, &picture).expect("a well-formed picture");
    }
}

#[test]
fn a_page_shows_what_was_measured_and_what_the_effect_does() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    fs::write(
        path("effects.xml"),
        r#"<effects><instance name="Axis"><effect kind="backlash" place="transmission"><parameter name="gap" value="0.002"/></effect></instance>
           <instance name="Belt"><effect kind="on-delay" place="sensor" component="lightBarrierB"><parameter name="time" value="0.05"/></effect></instance></effects>"#,
    )
    .expect("a file of effects");
    let kinetwin = |arguments: &[&str]| {
        let ended = Command::new(env!("CARGO_BIN_EXE_kinetwin")).args(arguments).current_dir(root()).output();
        let ended = ended.expect("kinetwin starts");
        assert!(ended.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&ended.stderr));
    };
    kinetwin(&["gap", "apply", "--model", "models/rig", "--effects", &path("effects.xml"), "-o", &path("machine")]);
    kinetwin(&["run", &path("machine"), "--for", "20s", "--speed", "max", "--record", &path("machine.cps.jsonl")]);

    let plant = rig();
    let study = study(&plant, Path::new(&path("machine.cps.jsonl")));
    let causes = [
        ("Axis", effect("backlash", EffectPlace::Transmission, None, "gap", 0.002), "m", 2e-5),
        ("Belt", effect("on-delay", EffectPlace::Sensor, Some("lightBarrierB"), "time", 0.05), "s", 1e-3),
    ];
    let (report, evidence) = (report(&study, &causes), evidence(&plant, &study, &causes));
    assert_eq!(evidence.sites.len(), plant.instances.len());
    let position = evidence.series.iter().find(|series| series.signal == "Axis.position").expect("the position");
    let worst = |model: &[f64]| model.iter().zip(&position.measured).map(|(m, y)| (m - y).abs()).fold(0.0, f64::max);
    assert!((worst(&position.nominal) - 0.001).abs() < 1e-4, "half the play: {}", worst(&position.nominal));
    assert!(worst(position.with_effect.as_ref().expect("with the effect")) < 1e-6);
    let barrier = evidence.strips.iter().find(|strip| strip.signal == "Belt.lightBarrierB").expect("the barrier");
    let late: Vec<f64> = barrier.late.iter().filter_map(|error| error.nominal).collect();
    assert!(late.iter().any(|late| (late + 0.05).abs() < 0.002), "rising edges are 50 ms early: {late:?}");

    let text = page(&report, &evidence);
    keep("rig.html", &text);
    for words in [
        "backlash on Axis (transmission), gap 2 mm; and on delay on Belt.lightBarrierB (sensor), time 50 ms",
        "Axis.position",
        "Belt.lightBarrierB",
        "the load follows only after a gap is crossed",
        "On data that no fit saw",
        "(95 %: ",
    ] {
        assert!(text.contains(words), "{words}");
    }
    // Map, weights, gap, what is left, and the signals.
    let pictures = 4 + evidence.series.len() + evidence.strips.len();
    assert_eq!(text.matches("<figure>").count(), pictures);
}

#[test]
fn a_page_of_every_verdict_needs_no_evidence() {
    for verdict in Verdict::ALL {
        let path = root().join(format!("tests/data/gap-report/{verdict}.json"));
        let report = Report::from_json(&path, &fs::read_to_string(&path).expect("a sample")).expect("a report");
        let evidence = Evidence { plant: "a <b> & \"c\"".to_owned(), ..Evidence::default() };
        let text = page(&report, &evidence);
        keep(&format!("{verdict}.html"), &text);
        assert!(text.contains("a &lt;b&gt; &amp;") && !text.contains("<b>"), "names are escaped");
        let answer = report.answer();
        assert!(text.contains(&kinetwin::xml::escape(&answer.shrink)), "{verdict}: {answer:?}");
    }
}

#[test]
fn the_line_is_drawn_as_it_stands() {
    let plant = plant::load(&Embedded, "models/depalletizer", KINDS).expect("the line");
    let mut report = Report::new(Verdict::NoGap);
    for (device, share) in [("Conveyor7", 0.6), ("Conveyor9", 0.25), ("Robot", 0.1)] {
        let gap = DeviceGap { device: device.to_owned(), share, signals: Vec::new(), regimes: Vec::new() };
        report.devices.push(gap);
    }
    let sites = kinetwin::gap::page::sites(&plant);
    let shaped = sites.iter().filter(|site| site.outline.len() > 2).count();
    let evidence = Evidence { plant: plant.name.clone(), sites, ..Evidence::default() };
    let text = page(&report, &evidence);
    keep("line.html", &text);
    assert_eq!(text.matches("<polygon").count(), shaped);
    assert!(text.contains("Conveyor7 60 %"));
}

#[test]
fn a_recording_of_another_simulation_on_a_page() {
    let trace = root().join("../shared/data/rig-sample/case-07/holdout.cps.jsonl.zst");
    if !trace.exists() {
        eprintln!("rig-sample is not there: nothing was tested");
        return;
    }
    let plant = rig();
    let study = study(&plant, &trace);
    let causes = [
        ("Robot", effect("first-order-lag", EffectPlace::Actuator, Some("Y"), "time_constant", 0.002_864), "s", 5e-5),
        ("Belt", effect("on-delay", EffectPlace::Sensor, Some("lightBarrierB"), "time", 0.0561), "s", 1.7e-3),
    ];
    let mut report = report(&study, &causes);
    report.rivals.push(Rival {
        device: "Robot".to_owned(),
        component: Some("Y".to_owned()),
        effect: "dead-time".to_owned(),
        place: EffectPlace::CommandLink,
        weight: 0.02,
        told_apart_by: "a step's onset: a dead time shows nothing at first, a lag at once".to_owned(),
        set: None,
        parameters: Vec::new(),
        texts: BTreeMap::new(),
    });
    report.not_testable.push(NotTestable {
        device: Some("Pusher".to_owned()),
        component: Some("lightbarrierA".to_owned()),
        effect: None,
        reason: "it never changes".to_owned(),
        needs: "a part that passes it".to_owned(),
    });
    report.made_from = Some(MadeFrom {
        model: "models/rig".to_owned(),
        train: vec!["train.cps.jsonl.zst".to_owned()],
        holdout: vec!["holdout.cps.jsonl.zst".to_owned()],
        mask: None,
    });
    let evidence = evidence(&plant, &study, &causes);
    assert!(evidence.series.iter().any(|series| series.signal == "Robot.actualPosY"));
    keep("case-07.html", &page(&report, &evidence));
}
