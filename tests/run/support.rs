//! Processes of ours, and a server that does what a test says, message by message.
//!
//! Nothing here sleeps: tests wait for lines and messages. What never comes ends a test by a time limit that no passing
//! test gets near.

use std::io::{BufRead, BufReader, Lines, Read};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, ExitStatus, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::{self, Message, WebSocket};

/// How long a test waits for what must come.
const LIMIT: Duration = Duration::from_secs(60);

/// A `kinetwin` that runs, and does not outlive its test.
pub struct Running {
    child: Child,
    errors: Lines<BufReader<ChildStderr>>,
    /// What it said on standard error so far.
    pub said: Vec<String>,
}

/// How a `kinetwin` ended.
pub struct Ended {
    pub status: ExitStatus,
    pub stdout: String,
    pub stderr: String,
}

impl Running {
    /// Starts `kinetwin` with `arguments`, in the project's folder.
    pub fn start(arguments: &[&str]) -> Running {
        Running::start_with(arguments, &[])
    }

    /// As [`Running::start`], with these variables in its environment.
    pub fn start_with(arguments: &[&str], environment: &[(&str, &str)]) -> Running {
        let mut child = Command::new(env!("CARGO_BIN_EXE_kinetwin"))
            .args(arguments)
            .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")))
            .env_remove("KINETWIN_TOKEN")
            .env_remove("KINETWIN_LOG")
            .envs(environment.iter().copied())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("kinetwin starts");
        let errors = BufReader::new(child.stderr.take().expect("a pipe")).lines();
        Running { child, errors, said: Vec::new() }
    }

    /// Its process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Waits for a line on standard error that holds `part`, and gives it.
    pub fn line(&mut self, part: &str) -> String {
        for line in self.errors.by_ref() {
            let line = line.expect("a line of text");
            self.said.push(line.clone());
            if line.contains(part) {
                return line;
            }
        }
        panic!("kinetwin ended and never said {part:?}; it said:\n{}", self.said.join("\n"));
    }

    /// As Ctrl-C does.
    pub fn interrupt(&self) {
        // The shell's own `kill`: a small machine has no other.
        let status = Command::new("sh").arg("-c").arg(format!("kill -INT {}", self.child.id())).status();
        assert!(status.expect("a shell").success(), "kinetwin was over before it was interrupted");
    }

    /// Reads no more of its standard output, as `head` does when it has enough.
    pub fn leave(&mut self) {
        self.child.stdout = None;
    }

    /// Waits for its end.
    pub fn end(mut self) -> Ended {
        for line in self.errors.by_ref() {
            self.said.push(line.expect("a line of text"));
        }
        let mut stdout = String::new();
        if let Some(mut pipe) = self.child.stdout.take() {
            pipe.read_to_string(&mut stdout).expect("text");
        }
        let status = self.child.wait().expect("an end");
        Ended { status, stdout, stderr: self.said.join("\n") }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // It has ended already, unless the test fails.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Runs `kinetwin` to its end.
pub fn kinetwin(arguments: &[&str]) -> Ended {
    Running::start(arguments).end()
}

impl Ended {
    /// Its exit code.
    pub fn code(&self) -> i32 {
        self.status.code().unwrap_or_else(|| panic!("ended by a signal: {}", self.stderr))
    }

    /// The one JSON object on standard output.
    pub fn json(&self) -> Value {
        let parsed = serde_json::from_str(&self.stdout);
        parsed.unwrap_or_else(|error| panic!("no JSON on standard output, {error}: {}\n{}", self.stdout, self.stderr))
    }
}

/// A place to listen, on the loopback interface.
pub struct Host {
    listener: TcpListener,
}

impl Host {
    /// On a free port.
    pub fn new() -> Host {
        Host { listener: TcpListener::bind("127.0.0.1:0").expect("a free port") }
    }

    /// Its address, as `--connect` takes it.
    pub fn url(&self) -> String {
        format!("ws://{}", self.listener.local_addr().expect("an address"))
    }

    /// The next connection, its WebSocket handshake done.
    pub fn accept(&self) -> Connection {
        let (stream, _) = self.listener.accept().expect("a connection");
        stream.set_read_timeout(Some(LIMIT)).expect("a time limit");
        stream.set_nodelay(true).expect("no delay");
        Connection { socket: tungstenite::accept(stream).expect("a WebSocket handshake") }
    }

    /// The next connection, accepted with `result`; and what its `Connect` said.
    pub fn accept_session(&self, result: u16) -> (Connection, Value) {
        let mut connection = self.accept();
        let connect = connection.receive("Connect");
        connection.reply(&connect, result);
        (connection, connect)
    }
}

/// A server's end of a connection.
pub struct Connection {
    socket: WebSocket<TcpStream>,
}

impl Connection {
    /// The body of the next message, which is a `kind`.
    pub fn receive(&mut self, kind: &str) -> Value {
        let text = self.receive_text();
        let mut message: Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
        message.get_mut(kind).unwrap_or_else(|| panic!("not a {kind}: {text}")).take()
    }

    /// The next text.
    pub fn receive_text(&mut self) -> String {
        match self.socket.read().expect("a message") {
            Message::Text(text) => text.as_str().to_owned(),
            other => panic!("not a text: {other:?}"),
        }
    }

    /// The value of `name` in the next message that has one; those before it are passed over.
    pub fn receive_value(&mut self, name: &str) -> Value {
        loop {
            let message = self.receive("SendValue");
            let entries = message.as_array().expect("an array of values");
            if let Some(entry) = entries.iter().find(|entry| entry["name"] == name) {
                return entry["value"].clone();
            }
        }
    }

    /// Answers `connect`.
    pub fn reply(&mut self, connect: &Value, result: u16) {
        let reply =
            json!({ "Id": connect["Id"], "enable": connect["enable"], "ServerName": "dGVzdA==", "result": result });
        self.send(&json!({ "ConnectReply": reply }).to_string());
    }

    /// Sends one value.
    pub fn send_value(&mut self, name: &str, value: Value) {
        self.send(&json!({ "SendValue": [{ "name": name, "value": value }] }).to_string());
    }

    /// Sends a text.
    pub fn send(&mut self, text: &str) {
        self.socket.send(Message::text(text)).expect("a message that can be sent");
    }

    /// Sends a binary message.
    pub fn send_binary(&mut self, bytes: &[u8]) {
        self.socket.send(Message::binary(bytes.to_vec())).expect("a message that can be sent");
    }

    /// The socket below, for what no WebSocket would send.
    pub fn stream(&mut self) -> &mut TcpStream {
        self.socket.get_mut()
    }

    /// Waits for the other side's close frame, passing over what comes before, and gives its code.
    pub fn close_code(&mut self) -> u16 {
        loop {
            match self.socket.read() {
                Ok(Message::Close(Some(frame))) => return frame.code.into(),
                Ok(Message::Close(None)) => panic!("closed without a code"),
                Ok(_) => {}
                Err(error) => panic!("the connection ended without a close frame: {error}"),
            }
        }
    }

    /// Waits for the end of the session: answers the disconnection and waits for the close frame.
    pub fn farewell(mut self) {
        loop {
            let text = self.receive_text();
            let message: Value = serde_json::from_str(&text).expect("JSON");
            if let Some(connect) = message.get("Connect") {
                assert_eq!(connect["enable"], false, "the end of the session: {text}");
                let connect = connect.clone();
                self.reply(&connect, 200);
                assert_eq!(self.close_code(), 1000);
                return;
            }
        }
    }
}
