//! Effects in models: plants without any are what they were, plants with some run and replay, what is wrong about one is
//! told where it stands, and `docs/effects.md` is what the registry gives.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::effect;
use kinetwin::engine::Engine;
use kinetwin::plant::{self, embedded::Embedded};
use kinetwin::replay::{self, Survey, Tolerances};
use kinetwin::trace::Reader;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// `KINETWIN_BLESS=1` writes the page anew.
#[test]
fn the_page_about_effects_is_what_the_registry_gives() {
    let path = root().join("docs/effects.md");
    if std::env::var_os("KINETWIN_BLESS").is_some() {
        fs::write(&path, effect::page()).expect("a writable folder");
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    let expected = effect::page();
    let differs = found.lines().zip(expected.lines()).position(|(found, expected)| found != expected);
    assert!(found == expected, "docs/effects.md differs at line {differs:?}: KINETWIN_BLESS=1 writes it anew");
}

/// The hash of the state in which `model` ends after a trace.
fn state_after(model: &str, trace: &[u8]) -> String {
    let open = || Reader::new("the trace".to_owned(), trace).expect("a trace");
    let plant = plant::load(&Embedded, model, KINDS).expect("the model");
    let survey = Survey::of(&plant.signal_map, open()).expect("every line is one");
    let seed = survey.header().seed.expect("a seed");
    let mut engine = Engine::new(&plant, Duration::from_millis(1), seed).expect("an engine");
    replay::run(&mut engine, &plant.signal_map, &survey, open(), &Tolerances::default()).expect("a replay").state_hash
}

/// The states in which these runs ended before there were effects of parts, supplies and loads: a change of a law that is
/// meant to be one changes them, nothing else does.
#[test]
fn plants_without_effects_are_what_they_were_to_the_last_bit() {
    let rig = fs::read(root().join("tests/data/rig-good.cps.jsonl.zst")).expect("the recording");
    let ends = [state_after("models/rig", &rig), state_after("models/depalletizer", line().as_bytes())];
    assert_eq!(ends, ["3d9aae0ad3195868", "42d302444b95cb85"]);
}

/// Twenty seconds of the whole line: all belts run, the pushers push one after the other.
fn line() -> String {
    let mut lines = vec![r#"{"trace":"kinetwin/1","source":"unknown","step_ns":1000000,"seed":7}"#.to_owned()];
    let mut line = |at: f64, values: &[String]| {
        lines.push(format!(r#"{{"t":{at:?},"from":"automation","SendValue":[{}]}}"#, values.join(",")));
    };
    let value = |name: &str, value: &str| format!(r#"{{"name":"{name}","value":{value}}}"#);
    let belts = (1..=10).map(|belt| format!("Conveyor{belt}")).chain(["Curve1".to_owned(), "Curve2".to_owned()]);
    let run = belts.flat_map(|belt| {
        [value(&format!("{belt}.velocityTarget"), "0.3"), value(&format!("{belt}.motorDirection"), "1")]
    });
    line(0.0, &run.collect::<Vec<_>>());
    for (at, pusher, command) in
        [(3.0, 1, "1"), (4.5, 1, "2"), (6.0, 2, "1"), (7.5, 2, "2"), (9.0, 3, "1"), (10.5, 3, "2")]
    {
        line(at, &[value(&format!("Pusher{pusher}.command"), command)]);
    }
    line(14.0, &[value("Robot.XTarget", "0.25"), value("Gripper1.suctionOn", "true")]);
    line(20.0, &[value("Conveyor3.velocityTarget", "0.0")]);
    lines.iter().map(|line| format!("{line}\n")).collect()
}

fn kinetwin(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_kinetwin")).args(arguments).current_dir(folder).output().expect("the program")
}

/// A model that changes the rig, in a folder of its own.
fn rig_with(effects: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir_all(folder.path().join("models/rig")).expect("a folder");
    fs::create_dir_all(folder.path().join("models/mine")).expect("a folder");
    fs::copy(root().join("models/rig/plant.xml"), folder.path().join("models/rig/plant.xml")).expect("the rig");
    let plant = format!("<plant name=\"mine\" base=\"../rig/plant.xml\">\n{effects}</plant>\n");
    fs::write(folder.path().join("models/mine/plant.xml"), plant).expect("a file");
    folder
}

const EVERYWHERE: &str = r#"  <instance name="Belt">
    <effect place="command-link" kind="dead-time"><parameter name="time" value="30 ms"/></effect>
    <effect place="actuator" kind="load-dependent-speed"><parameter name="coefficient" value="0.1"/></effect>
    <effect place="actuator" kind="supply-drop"><parameter name="fraction" value="0.05"/></effect>
    <effect place="transmission" kind="belt-slip-above-acceleration"><parameter name="acceleration" value="0.6 m/s2"/></effect>
    <effect place="process" kind="part-slip"><parameter name="acceleration" value="0.5"/></effect>
    <effect place="sensor" kind="on-delay" component="lightBarrierB"><parameter name="time" value="0.02"/></effect>
    <effect place="report-link" kind="lost-messages"><parameter name="probability" value="0.1"/></effect>
  </instance>
  <instance name="Feed">
    <effect place="process" kind="part-length-error"><parameter name="length" value="20 mm"/></effect>
  </instance>
  <instance name="Pusher">
    <effect place="actuator" kind="end-cushioning">
      <parameter name="length" value="0.1"/><parameter name="ratio" value="0.5"/>
    </effect>
    <effect place="actuator" kind="coasting"><parameter name="deceleration" value="4"/></effect>
  </instance>
  <instance name="Robot">
    <effect place="actuator" kind="settling-time" component="X"><parameter name="time" value="0.2"/></effect>
    <effect place="transmission" kind="compliance" component="Y">
      <parameter name="stiffness" value="900"/><parameter name="damping" value="10"/>
    </effect>
  </instance>
  <instance name="Gripper">
    <effect place="process" kind="vacuum-build-up"><parameter name="time" value="0.1"/></effect>
    <effect place="process" kind="leak"><parameter name="rate" value="0.7"/></effect>
  </instance>
  <instance name="Axis">
    <effect place="load" kind="carried-mass">
      <parameter name="mass" value="5 kg"/><parameter name="with" value="Gripper"/>
    </effect>
    <effect place="mechanics" kind="coulomb-friction"><parameter name="force" value="12 N"/></effect>
    <effect place="sensor" kind="noise"><parameter name="sigma" value="0.0001"/></effect>
  </instance>
  <instance name="Motor">
    <effect place="transmission" kind="once-per-revolution-error">
      <parameter name="amplitude" value="0.01"/><parameter name="period" value="6.283"/>
    </effect>
  </instance>
"#;

#[test]
fn a_plant_with_effects_runs_and_replays_without_any_difference() {
    let folder = rig_with(EVERYWHERE);
    let run = ["run", "models/mine", "--for", "12s", "--speed", "max", "--seed", "5", "--record", "run.cps.jsonl.zst"];
    let output = kinetwin(folder.path(), &run);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let replay = kinetwin(folder.path(), &["replay", "run.cps.jsonl.zst", "--model", "models/mine"]);
    let told = String::from_utf8_lossy(&replay.stdout);
    assert!(replay.status.success(), "{told}{}", String::from_utf8_lossy(&replay.stderr));
    // Of the rig without effects it is no replay.
    let other = kinetwin(folder.path(), &["replay", "run.cps.jsonl.zst", "--model", "models/rig"]);
    assert_eq!(other.status.code(), Some(1), "{}", String::from_utf8_lossy(&other.stdout));
}

#[test]
fn what_is_wrong_about_an_effect_is_told_where_it_stands() {
    // Where `at` begins in the effect, which begins at line 3, column 5.
    let check = |effect: &str, at: &str, words: &str| {
        let column = 5 + effect.find(at).expect(at);
        let folder = rig_with(&format!("  <instance name=\"Belt\">\n    {effect}\n  </instance>\n"));
        let output = kinetwin(folder.path(), &["check", "models/mine"]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        // The program's drawing breaks long lines.
        let flat: String = told.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
        let is_told = flat.contains(&format!("models/mine/plant.xml:3:{column}]")) && flat.contains(words);
        assert!(is_told, "expected {words} at column {column}: {told}");
    };
    let slip = |inside: &str| format!("<effect place=\"transmission\" kind=\"belt-slip\">{inside}</effect>");
    let ratio = |value: &str| slip(&format!("<parameter name=\"ratio\" value=\"{value}\"/>"));
    check("<effect place=\"actuator\" kind=\"belt-slop\"/>", "belt-slop", "did you mean \"belt-slip\"?");
    check("<effect place=\"load\" kind=\"belt-slip\"/>", "load", "may stand at transmission");
    check(&slip(""), "effect", "needs its parameter ratio");
    check(&ratio("2"), "2", "ratio is 2, expected a number from 0 to 0.95");
    check(&ratio("2 mm"), "2 mm", "ratio is given in mm, expected a number without");
    check(&slip("<parameter name=\"gap\" value=\"2\"/>"), "2", "no parameter \"gap\"");
    let mass = "<effect place=\"load\" kind=\"added-mass\"><parameter name=\"mass\" value=\"2\"/></effect>";
    check(mass, "added-mass", "not for a StraightConveyor");
    let late =
        "<effect place=\"command-link\" kind=\"dead-time\"><parameter name=\"time\" value=\"2\" unit=\"mm\"/></effect>";
    check(late, "mm\"", "time is given in mm, expected");
    let drop = "<effect place=\"actuator\" kind=\"supply-drop\"><parameter name=\"fraction\" value=\"0.1\"/>\
                <parameter name=\"with\" value=\"Bolt\"/></effect>";
    check(drop, "supply-drop", "with names \"Bolt\", which is no instance of the plant");
}
