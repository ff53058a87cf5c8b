//! MQTT 3.1.1 (OASIS) through mosquitto: a message is published, the other client publishes it back.
//!
//! The clients are as small as the protocol allows, so that what is measured is the broker and the way.

use std::io::{self, Read as _, Write as _};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::row::Peer;
use super::serde_loop::{Blocks, Caller};

/// A broker of our own, on a free port; it ends with this.
pub struct Broker {
    child: Child,
    port: u16,
    /// Its configuration, for as long as it runs.
    _settings: Settings,
}

/// A file that is gone with this.
struct Settings(PathBuf);

impl Settings {
    /// The broker's own default lets small packets wait for the acknowledgement of those before (Nagle's algorithm), which
    /// costs 40 ms a message of QoS 1; nobody who measures leaves it so.
    fn write(port: u16) -> io::Result<Settings> {
        let path = std::env::temp_dir().join(format!("kinetwin-mosquitto-{}-{port}.conf", std::process::id()));
        std::fs::write(&path, format!("listener {port} 127.0.0.1\nallow_anonymous true\nset_tcp_nodelay true\n"))?;
        Ok(Settings(path))
    }
}

impl Drop for Settings {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

impl Broker {
    /// Starts mosquitto; `None` where it is not installed.
    pub fn start() -> Option<Broker> {
        let port = std::net::TcpListener::bind("127.0.0.1:0").ok()?.local_addr().ok()?.port();
        let settings = Settings::write(port).ok()?;
        let found = ["mosquitto", "/usr/sbin/mosquitto"].into_iter().find_map(|program| {
            Command::new(program).arg("-c").arg(&settings.0).stdout(Stdio::null()).stderr(Stdio::null()).spawn().ok()
        });
        let broker = Broker { child: found?, port, _settings: settings };
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_secs(5) {
            if TcpStream::connect(("127.0.0.1", port)).is_ok() {
                return Some(broker);
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        None
    }
}

impl Drop for Broker {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Two clients of a broker; one answers what the other publishes.
pub struct Mqtt {
    client: Client,
    work: Work,
}

/// What is done at either end.
enum Work {
    /// The same bytes come back.
    Echo(Vec<u8>),
    /// So many blocks are set and report, in JSON.
    Blocks(Caller),
}

impl Mqtt {
    /// Through `broker` with quality of service `qos` (0 or 1), so many bytes and back. `name` tells it from the broker's
    /// other clients.
    pub fn echo(broker: &Broker, qos: u8, name: &str, bytes: usize) -> io::Result<Mqtt> {
        let client = answered(broker, qos, name, |payload| Ok(payload.to_vec()))?;
        Ok(Mqtt { client, work: Work::Echo(vec![b'x'; bytes]) })
    }

    /// The same with the work of so many blocks: both ends write and read JSON with serde_json.
    pub fn blocks(broker: &Broker, qos: u8, name: &str, blocks: usize) -> io::Result<Mqtt> {
        let mut plant = Blocks::new(blocks);
        let client = answered(broker, qos, name, move |payload| {
            let text = std::str::from_utf8(payload).map_err(io::Error::other)?;
            Ok(plant.answer(text)?.into_bytes())
        })?;
        Ok(Mqtt { client, work: Work::Blocks(Caller::new(blocks)) })
    }
}

/// A client whose messages another one answers as `answer` says.
fn answered(
    broker: &Broker,
    qos: u8,
    name: &str,
    mut answer: impl FnMut(&[u8]) -> io::Result<Vec<u8>> + Send + 'static,
) -> io::Result<Client> {
    let name = format!("{qos}-{name}");
    let mut other = Client::connect(broker.port, &format!("echo-{name}"), &format!("there/{name}"), qos)?;
    let client = Client::connect(broker.port, &format!("call-{name}"), &format!("back/{name}"), qos)?;
    let back = format!("back/{name}");
    std::thread::spawn(move || -> io::Result<()> {
        loop {
            let payload = other.receive()?;
            other.publish(&back, &answer(&payload)?)?;
        }
    });
    Ok(client)
}

impl Peer for Mqtt {
    fn call(&mut self) -> io::Result<()> {
        let Mqtt { client, work } = self;
        let topic = client.partner.clone();
        match work {
            Work::Echo(payload) => {
                client.publish(&topic, payload)?;
                client.receive().map(drop)
            }
            Work::Blocks(caller) => {
                client.publish(&topic, caller.ask()?.as_bytes())?;
                let answer = client.receive()?;
                caller.hear(std::str::from_utf8(&answer).map_err(io::Error::other)?)
            }
        }
    }
}

struct Client {
    stream: TcpStream,
    qos: u8,
    packet: u16,
    partner: String,
}

const CONNECT: u8 = 0x10;
const PUBLISH: u8 = 0x30;
const PUBACK: u8 = 0x40;
const SUBSCRIBE: u8 = 0x82;

impl Client {
    fn connect(port: u16, id: &str, topic: &str, qos: u8) -> io::Result<Client> {
        let stream = TcpStream::connect(("127.0.0.1", port))?;
        stream.set_nodelay(true)?;
        let mut client = Client { stream, qos, packet: 0, partner: topic.replace("back/", "there/") };
        // MQTT, level 4, a clean session, no keep-alive.
        let hello = [&text("MQTT")[..], &[4, 2, 0, 0], &text(id)].concat();
        client.send(CONNECT, &hello)?;
        client.read()?;
        client.send(SUBSCRIBE, &[&[0, 1][..], &text(topic), &[qos]].concat())?;
        client.read()?;
        Ok(client)
    }

    fn publish(&mut self, topic: &str, payload: &[u8]) -> io::Result<()> {
        let mut body = text(topic);
        if self.qos > 0 {
            self.packet = self.packet.wrapping_add(1).max(1);
            body.extend(self.packet.to_be_bytes());
        }
        body.extend(payload);
        self.send(PUBLISH | self.qos << 1, &body)
    }

    /// The next message; acknowledges it where that is asked for.
    fn receive(&mut self) -> io::Result<Vec<u8>> {
        loop {
            let (kind, mut body) = self.read()?;
            if kind & 0xf0 != PUBLISH {
                continue;
            }
            let topic = 2 + usize::from(u16::from_be_bytes([body[0], body[1]]));
            let start = if kind & 0b110 == 0 { topic } else { topic + 2 };
            if start > topic {
                let packet = [body[topic], body[topic + 1]];
                self.send(PUBACK, &packet)?;
            }
            return Ok(body.split_off(start));
        }
    }

    fn send(&mut self, kind: u8, body: &[u8]) -> io::Result<()> {
        let mut packet = vec![kind];
        let mut length = body.len();
        loop {
            let digit = (length % 128) as u8;
            length /= 128;
            packet.push(if length > 0 { digit | 0x80 } else { digit });
            if length == 0 {
                break;
            }
        }
        packet.extend(body);
        self.stream.write_all(&packet)
    }

    fn read(&mut self) -> io::Result<(u8, Vec<u8>)> {
        let mut byte = [0];
        self.stream.read_exact(&mut byte)?;
        let kind = byte[0];
        let (mut length, mut shift) = (0, 0);
        loop {
            self.stream.read_exact(&mut byte)?;
            length |= usize::from(byte[0] & 0x7f) << shift;
            shift += 7;
            if byte[0] & 0x80 == 0 || shift > 21 {
                break;
            }
        }
        let mut body = vec![0; length];
        self.stream.read_exact(&mut body)?;
        Ok((kind, body))
    }
}

/// A text as MQTT writes it, its length before it.
fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u16).to_be_bytes()[..], text.as_bytes()].concat()
}
