//! The two programs: the automation that is killed and restarted, and the run that has to bear it.

use std::io::{BufRead as _, BufReader, Read as _};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;
use std::time::Duration;

use serde_json::Value;

/// `nxt-mock` with the program of 200 blocks.
pub struct Automation {
    child: Child,
    pub port: u16,
}

impl Automation {
    /// At `port`; 0 takes a free one.
    pub fn start(programs: &Path, port: u16) -> Result<Automation, String> {
        let mut child = Command::new(programs.join("nxt-mock"))
            .args(["--plant", "r001", "--quiet", "--listen", &format!("127.0.0.1:{port}")])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .map_err(|error| format!("failed to start nxt-mock in {}: {error}", programs.display()))?;
        let mut line = String::new();
        let mut out = BufReader::new(child.stdout.as_mut().expect("a pipe"));
        out.read_line(&mut line).map_err(|error| error.to_string())?;
        let port = line.trim().rsplit(':').next().and_then(|port| port.parse().ok());
        Ok(Automation { child, port: port.ok_or(format!("nxt-mock does not listen: {line}"))? })
    }

    pub fn kill(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }

    /// Ends it in good order; what it said.
    pub fn stop(mut self) -> String {
        signal(self.child.id(), "INT");
        let mut said = String::new();
        let _ = self.child.stdout.take().map(|mut out| out.read_to_string(&mut said));
        let _ = self.child.wait();
        said
    }
}

/// `kinetwin run models/r001`.
pub struct Run {
    child: Child,
    errors: JoinHandle<String>,
}

/// How a run ended.
pub struct Ended {
    code: Option<i32>,
    errors: String,
    pub summary: String,
}

impl Run {
    pub fn start(programs: &Path, port: u16, record: Option<&Path>) -> Result<Run, String> {
        let mut command = Command::new(programs.join("kinetwin"));
        command.args([
            "run",
            "models/r001",
            "--connect",
            &format!("ws://127.0.0.1:{port}"),
            "--timeout",
            "2s",
            "--json",
        ]);
        record.map(|path| command.arg("--record").arg(path));
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|error| format!("failed to start kinetwin: {error}"))?;
        let mut stream = child.stderr.take().expect("a pipe");
        let errors = std::thread::spawn(move || {
            let mut said = String::new();
            let _ = stream.read_to_string(&mut said);
            said
        });
        Ok(Run { child, errors })
    }

    /// Its memory, bytes.
    pub fn memory(&self) -> Option<u64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).ok()?;
        let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
        line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib * 1024)
    }

    pub fn has_ended(&mut self) -> Option<String> {
        self.child.try_wait().ok().flatten().map(|status| status.to_string())
    }

    /// Takes the processor away for `span`.
    pub fn freeze(&self, span: Duration) {
        signal(self.child.id(), "STOP");
        std::thread::sleep(span);
        signal(self.child.id(), "CONT");
    }

    /// Ends it in good order.
    pub fn stop(mut self) -> Result<Ended, String> {
        signal(self.child.id(), "INT");
        let mut summary = String::new();
        let out = self.child.stdout.take().map(|mut out| out.read_to_string(&mut summary));
        out.transpose().map_err(|error| error.to_string())?;
        let status = self.child.wait().map_err(|error| error.to_string())?;
        Ok(Ended {
            code: status.code(),
            errors: self.errors.join().unwrap_or_default(),
            summary: summary.trim().to_owned(),
        })
    }
}

fn signal(process: u32, name: &str) {
    // The shell's own `kill`: a small machine has no other.
    let _ = Command::new("sh").arg("-c").arg(format!("kill -{name} {process}")).status();
}

impl Ended {
    /// What is wrong with a run whose trace's disk was full, in sentences: it has to go on to its end and to say so there.
    pub fn faults_of_a_full_disk(&self) -> Vec<String> {
        let mut faults = self.panics();
        if self.code != Some(2) || !self.errors.contains("No space left") {
            faults.push(format!("a full disk: the run ended with {:?} and said {}", self.code, self.last_words()));
        }
        faults
    }

    fn panics(&self) -> Vec<String> {
        let panicked = self.errors.contains("panicked");
        panicked.then(|| format!("the run panicked: {}", self.errors)).into_iter().collect()
    }

    /// What is wrong with it, in sentences.
    pub fn faults(&self, seconds: u64) -> Vec<String> {
        let mut faults = self.panics();
        if self.code != Some(0) {
            faults.push(format!("the run ended with {:?}: {}", self.code, self.last_words()));
        }
        let Ok(summary) = serde_json::from_str::<Value>(&self.summary) else {
            faults.push("the run left no summary".to_owned());
            return faults;
        };
        let count = |name: &str| summary[name].as_u64().unwrap_or(0);
        // What the docs do not promise to keep is told, and its connection closed; silence would be a loss.
        if count("messages_lost") > 0 && self.losses_told() == 0 {
            faults.push(format!("{} messages were lost and nobody was told", count("messages_lost")));
        }
        // Simulated time goes on whatever happens.
        if count("steps") < (seconds - seconds / 10) * 1_000 {
            faults.push(format!("{} steps in {seconds} s", count("steps")));
        }
        if count("messages_in") < seconds * 20 {
            faults.push(format!("{} messages came in {seconds} s", count("messages_in")));
        }
        faults
    }

    /// How often the run said that more had waited than it promises to keep.
    pub fn losses_told(&self) -> usize {
        self.errors.lines().filter(|line| line.contains("warning: lost ")).count()
    }

    fn last_words(&self) -> String {
        let lines: Vec<&str> = self.errors.lines().rev().take(5).collect();
        lines.join(" | ")
    }
}
