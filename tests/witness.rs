//! An automation that shares no line with ours, in Python, controls the rig over the real WebSocket: what our two sides
//! might have misread together, it reads for itself. Its checks stand in `tests/witness/server.py`.

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
    let there = Command::new(&python).args(["-c", "import websockets"]).stderr(Stdio::null()).status();
    assert!(
        there.is_ok_and(|status| status.success()),
        "{} cannot import websockets: run tools/test, which installs it, or name a Python that can in KINETWIN_PYTHON",
        python.display()
    );
    python
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
