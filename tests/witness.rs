//! An automation that shares no line with ours, in Python, controls the rig over the real WebSocket: what our two sides
//! might have misread together, it reads for itself. Its checks stand in `tests/witness/server.py`. And the MCAP files that
//! we write are read, and those that we read are written, by a library that is not ours: `tests/witness/mcap_file.py`.

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// A process that does not outlive the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It has ended already, unless the test fails.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Running {
    fn start(command: &mut Command) -> Running {
        let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
        Running(child.unwrap_or_else(|error| panic!("failed to start {command:?}: {error}")))
    }

    /// As Ctrl-C does. The shell's own `kill`, because a small machine has no other.
    fn interrupt(&self) {
        let status = Command::new("sh").arg("-c").arg(format!("kill -INT {}", self.0.id())).status().expect("a shell");
        assert!(status.success(), "the run was over before it was interrupted");
    }
}

/// The Python that has the witness's packages.
fn python() -> PathBuf {
    let venv = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/witness-venv/bin/python");
    let python = std::env::var_os("KINETWIN_PYTHON").map_or(venv, PathBuf::from);
    let there = Command::new(&python).args(["-c", "import mcap, websockets"]).stderr(Stdio::null()).status();
    assert!(
        there.is_ok_and(|status| status.success()),
        "{} cannot import mcap and websockets: run tools/test, which installs them, or name a Python that can in KINETWIN_PYTHON",
        python.display()
    );
    python
}

/// Runs a command to its good end and gives what it prints.
fn output(command: &mut Command) -> String {
    let ended = command.current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("a program that starts");
    let text = String::from_utf8_lossy(&ended.stdout).into_owned();
    assert!(ended.status.success(), "{command:?}: {}\n{text}{}", ended.status, String::from_utf8_lossy(&ended.stderr));
    text
}

fn kinetwin() -> Command {
    Command::new(env!("CARGO_BIN_EXE_kinetwin"))
}

fn mcap_file() -> Command {
    let mut command = Command::new(python());
    command.arg("tests/witness/mcap_file.py");
    command
}

#[test]
fn a_reader_that_is_not_ours_reads_the_mcap_files_that_we_write() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("rig.mcap");
    let export = ["trace", "export", "tests/data/rig-good.cps.jsonl.zst", "--model", "models/rig", "--mcap"];
    output(kinetwin().args(export).arg(&file));
    let told = output(mcap_file().arg("read").arg(&file));
    let messages: Vec<serde_json::Value> =
        told.lines().map(|line| serde_json::from_str(line).expect("a line of JSON")).collect();

    // The same values, counted by another way.
    let info = output(kinetwin().args(["trace", "info", "tests/data/rig-good.cps.jsonl.zst", "--json"]));
    let info: serde_json::Value = serde_json::from_str(&info).expect("JSON");
    let signals = info["signals"].as_object().expect("signals");
    assert!(signals.len() > 10, "{info}");
    for (name, signal) in signals {
        let of: Vec<_> = messages.iter().filter(|message| message["topic"] == name.as_str()).collect();
        let from = if signal["commands"] == 0 { "plant" } else { "automation" };
        let count = signal["commands"].as_u64().unwrap_or(0) + signal["reports"].as_u64().unwrap_or(0);
        assert_eq!(of.len() as u64, count, "{name}");
        assert!(of.iter().all(|message| message["from"] == from && !message["data"]["value"].is_null()), "{name}");
    }
    let speed = messages.iter().find(|message| message["topic"] == "Belt.velocityActual").expect("a speed");
    assert_eq!(speed["unit"], "m/s");
}

#[test]
fn mcap_files_that_are_not_ours_become_traces() {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, trace) = (folder.path().join("arm.mcap"), folder.path().join("arm.cps.jsonl"));
    output(mcap_file().arg("write").arg(&file));
    let told = output(
        kinetwin()
            .args(["trace", "import", "--from-zero", "--model", "models/rig", "--mcap"])
            .arg(&file)
            .args([
                "--map",
                "/joint.target*0.5=Axis.positionTarget",
                "--map",
                "/joint.state.angle[0]=Axis.position",
                "--map",
                "!/joint.state.word.2=Belt.lightBarrierA",
                "-o",
            ])
            .arg(&trace),
    );
    assert!(told.contains("/joint.state.angle[1]") && told.contains("/camera (cdr)"), "{told}");
    let text = std::fs::read_to_string(&trace).expect("a trace");
    let lines: Vec<&str> = text.lines().skip(1).collect();
    let line = |t: &str, target: f64, angle: f64| {
        [
            format!(
                r#"{{"t":{t},"from":"automation","SendValue":[{{"name":"Axis.positionTarget","value":{target:?}}}]}}"#
            ),
            format!(
                r#"{{"t":{t},"from":"plant","SendValue":[{{"name":"Axis.position","value":{angle:?}}},{{"name":"Belt.lightBarrierA","value":false}}]}}"#
            ),
        ]
    };
    let expected: Vec<String> = [line("0.0", 0.0, 0.0), line("0.02", 0.1, 0.02), line("0.04", 0.2, 0.04)].concat();
    assert_eq!(lines, expected);
}

#[test]
fn an_automation_that_is_not_ours_controls_the_rig() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut witness =
        Running::start(Command::new(python()).arg("-u").arg(root.join("tests/witness/server.py")).arg("--box"));
    let mut log = BufReader::new(witness.0.stdout.take().expect("a pipe")).lines();
    let mut log_line = || -> Option<String> {
        let line = log.next()?.expect("a line of the witness's log");
        println!("witness: {line}");
        Some(line)
    };
    let first = log_line().expect("the witness says where it listens");
    let (_, url) = first.split_once("listening on ").expect("the witness says where it listens");

    // It ends long before, unless something is stuck.
    let mut run = Running::start(Command::new(env!("CARGO_BIN_EXE_kinetwin")).current_dir(root).args([
        "run",
        "models/rig",
        "--connect",
        url,
        "--for",
        "2m",
        "--json",
    ]));
    while let Some(line) = log_line() {
        if line.ends_with("all checks passed") {
            run.interrupt();
        }
    }
    let verdict = witness.0.wait().expect("the witness ends");
    assert!(verdict.success(), "the witness saw what should not be: its log stands above");

    let mut summary = String::new();
    run.0.stdout.take().expect("a pipe").read_to_string(&mut summary).expect("a summary");
    let status = run.0.wait().expect("the run ends");
    assert!(status.success(), "kinetwin run: {status}\n{summary}");
    assert!(summary.replace(' ', "").contains("\"messages_lost\":0"), "{summary}");
}
