//! OPC UA by Python's asyncua: values are written, and as many are read.

use std::io::{self, BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

use super::row::Peer;

/// A client and its server, in processes of their own; they end with this.
pub struct OpcUa {
    child: Child,
    /// None once there is nothing more to ask.
    ask: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl OpcUa {
    /// With so many nodes each way; `None` where Python or asyncua is not installed. `KINETWIN_PYTHON` names another Python.
    pub fn start(nodes: usize) -> Option<OpcUa> {
        let python = std::env::var("KINETWIN_PYTHON").unwrap_or_else(|_| "python3".to_owned());
        let mut child = Command::new(python)
            .args(["-c", include_str!("opcua.py"), &nodes.to_string()])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        let answers = BufReader::new(child.stdout.take()?);
        let ask = child.stdin.take();
        let mut peer = OpcUa { child, ask, answers };
        (peer.line().ok()? == "ready").then_some(peer)
    }

    fn line(&mut self) -> io::Result<String> {
        let mut line = String::new();
        match self.answers.read_line(&mut line)? {
            0 => Err(io::ErrorKind::UnexpectedEof.into()),
            _ => Ok(line.trim().to_owned()),
        }
    }
}

impl Peer for OpcUa {
    fn call(&mut self) -> io::Result<()> {
        self.calls(1, None).map(drop)
    }

    fn calls(&mut self, count: usize, pace: Option<Duration>) -> io::Result<Vec<u64>> {
        let ask = self.ask.as_mut().ok_or(io::ErrorKind::BrokenPipe)?;
        writeln!(ask, "{count} {}", pace.unwrap_or_default().as_secs_f64())?;
        let line = self.line()?;
        line.split(' ').map(|ns| ns.parse().map_err(io::Error::other)).collect()
    }
}

impl Drop for OpcUa {
    fn drop(&mut self) {
        // At the end of its input it ends in good order, and its server with it; killed, it would leave the server behind.
        drop(self.ask.take());
        let _ = self.child.wait();
    }
}
