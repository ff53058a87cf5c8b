//! The connector against the protocol's other half, frames in memory and a clock of the test's.

use std::sync::Arc;
use std::task::{Context, Waker};
use std::time::Duration;

use super::in_process::FromPeer;
use super::{Adapter, Endpoint, Event, InProcess, Memory, Peer, Settings, Witness};
use crate::bank::{self, IoSide, SimulationSide};
use crate::session::{ClientEvent, Input, Output, Server, ServerEvent, ServerSettings};
use crate::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use crate::time::Instant;
use crate::trace::Sender;
use crate::value::{ElementaryType, SignalType, Unit, Value};
use crate::wire::ResultCode;

const COMMAND: RegisterId = RegisterId(0);

fn map() -> Arc<SignalMap> {
    let signal = |name: &str, element, direction, kind| Signal {
        name: name.to_owned(),
        ty: SignalType::scalar(element),
        direction,
        kind,
        rate: RateClass::HighFrequency,
        unit: Unit::ONE,
        min: None,
        max: None,
        instance: "Belt".to_owned(),
        task: "Drive".to_owned(),
        property: name.to_owned(),
    };
    let signals = vec![
        signal("Belt.target", ElementaryType::Dint, Direction::Command, Kind::Edge),
        signal("Belt.barrier", ElementaryType::Bool, Direction::Report, Kind::Edge),
        signal("Belt.speed", ElementaryType::Real, Direction::Report, Kind::Level),
    ];
    Arc::new(SignalMap::new("test", signals).expect("three names"))
}

/// A server in memory: answers, remembers what came, and sends what the test queues.
struct TestServer {
    map: Arc<SignalMap>,
    settings: ServerSettings,
    server: Option<Server>,
    outputs: Vec<FromPeer>,
    received: Vec<String>,
}

impl TestServer {
    fn drain(&mut self) {
        let Some(server) = &mut self.server else { return };
        while let Some(output) = server.poll() {
            match output {
                Output::Transmit(text) => self.outputs.push(FromPeer::Text(text)),
                Output::Close { reason, .. } => self.outputs.push(FromPeer::Closed(reason)),
                Output::Event(ServerEvent::Values(staged)) => self.received.push(staged.text),
                Output::Event(_) => {}
            }
        }
    }

    /// Queues one message for each group of values.
    fn command(&mut self, now: Instant, values: &[i32]) {
        for &value in values {
            let server = self.server.as_mut().expect("a connection");
            assert!(server.send(now, &[(COMMAND, Value::Dint(value))]), "a session stands");
        }
        self.drain();
    }
}

impl Peer for TestServer {
    fn open(&mut self, now: Instant) {
        let mut server = Server::new(self.settings.clone(), self.map.clone());
        server.handle(now, Input::Opened);
        self.server = Some(server);
        self.drain();
    }

    fn take(&mut self, now: Instant, text: &str) {
        self.server.as_mut().expect("a connection").handle(now, Input::Text(text));
        self.drain();
    }

    fn give(&mut self, _now: Instant) -> Option<FromPeer> {
        (!self.outputs.is_empty()).then(|| self.outputs.remove(0))
    }

    fn close(&mut self, _now: Instant) {
        self.server = None;
        self.outputs.clear();
    }
}

#[derive(Default)]
struct Record(Vec<String>);

impl Witness for Record {
    fn staged(&mut self, number: u64, text: String) {
        self.0.push(format!("staged {number} {text}"));
    }
    fn reported(&mut self, at: Instant, text: &str) {
        self.0.push(format!("reported {} {text}", at.nanos()));
    }
    fn exchanged(&mut self, from: Sender, text: &str) {
        let name = text.split('"').nth(1).unwrap_or(text);
        self.0.push(format!("{} {name}", from.name()));
    }
    fn reached(&mut self, _at: Instant) {}
}

struct Bench {
    connector: InProcess<TestServer>,
    simulation: SimulationSide,
    bank: IoSide,
    record: Record,
    now: Instant,
}

impl Bench {
    fn new(settings: ServerSettings) -> Bench {
        let map = map();
        let server = TestServer { map: map.clone(), settings, server: None, outputs: Vec::new(), received: Vec::new() };
        let (simulation, bank) = bank::new(&map);
        let mut connector = InProcess::to(server);
        connector.configure(Settings::new(Endpoint::new("localhost", 1), "test")).expect("settings that work");
        connector.init(&map);
        connector.connect();
        Bench { connector, simulation, bank, record: Record::default(), now: Instant::ZERO }
    }

    /// One turn, with the levels due, `ms` later.
    fn turn(&mut self, ms: u64) {
        self.now += Duration::from_millis(ms);
        let mut cx = Context::from_waker(Waker::noop());
        let mut memory = Memory { bank: &mut self.bank, witness: &mut self.record };
        self.connector.hf_io(&mut cx, self.now);
        self.connector.hf_memory_update(self.now, &mut memory, true);
        self.connector.hf_io(&mut cx, self.now);
    }

    fn publish(&mut self, barrier: bool) {
        let values = [Value::Dint(0), Value::Bool(barrier), Value::Real(0.0)];
        self.simulation.publish(self.now, &values);
    }

    fn received(&mut self) -> Vec<String> {
        std::mem::take(&mut self.connector.transport().peer().received)
    }

    fn events(&mut self) -> Vec<Event> {
        std::iter::from_fn(|| self.connector.poll_event()).collect()
    }
}

fn accepting() -> ServerSettings {
    ServerSettings::new("test server")
}

#[test]
fn a_session_begins_with_all_reports_and_edges_follow_one_by_one() {
    let mut bench = Bench::new(accepting());
    bench.publish(false);
    bench.turn(0);
    bench.turn(0);
    assert!(bench.connector.is_connected());
    let all = r#"{"SendValue":[{"name":"Belt.barrier","value":false},{"name":"Belt.speed","value":0.0}]}"#;
    assert_eq!(bench.received(), [all]);
    bench.publish(true);
    bench.publish(false);
    bench.turn(1);
    let edge = |value: bool| format!(r#"{{"SendValue":[{{"name":"Belt.barrier","value":{value}}}]}}"#);
    assert_eq!(bench.received(), [edge(true), edge(false)]);
    assert_eq!(bench.connector.traffic().messages_out, 3);
}

#[test]
fn commands_are_staged_and_witnessed_in_order() {
    let mut bench = Bench::new(accepting());
    bench.turn(0);
    bench.turn(0);
    bench.connector.transport().peer().command(Instant::ZERO, &[1, 2]);
    bench.turn(1);
    let mut inputs = Vec::new();
    assert_eq!(bench.simulation.take(&mut inputs), Some(1));
    assert_eq!(inputs, [(COMMAND, Value::Dint(1))]);
    assert_eq!(bench.simulation.take(&mut inputs), Some(2));
    assert_eq!(inputs, [(COMMAND, Value::Dint(2))]);
    let text = |n: i32| format!(r#"staged {n} {{"SendValue":[{{"name":"Belt.target","value":{n}}}]}}"#);
    assert_eq!(bench.record.0, ["plant Connect", "automation ConnectReply", &text(1), &text(2)]);
    assert_eq!(bench.connector.traffic().values_in, 2);
}

#[test]
fn a_lost_session_is_made_again_and_begins_with_all_reports() {
    let mut bench = Bench::new(accepting());
    bench.publish(false);
    bench.turn(0);
    bench.turn(0);
    bench.received();
    bench.connector.transport().peer().outputs.push(FromPeer::Closed("gone".to_owned()));
    bench.turn(1);
    assert!(!bench.connector.is_connected());
    let lost = |event: &Event| matches!(event, Event::Session(ClientEvent::Lost { reason, .. }) if reason == "gone");
    assert!(bench.events().iter().any(lost), "in the transport's words");
    bench.publish(true);
    bench.turn(1);
    let due = bench.connector.deadline().expect("a pause before the next try");
    bench.turn(due.since(bench.now).as_millis() as u64);
    bench.turn(0);
    assert!(bench.connector.is_connected());
    let all = r#"{"SendValue":[{"name":"Belt.barrier","value":true},{"name":"Belt.speed","value":0.0}]}"#;
    assert_eq!(bench.received(), [all]);
    let session = ["plant Connect", "automation ConnectReply"];
    let reported = |ns: i64, barrier: bool| {
        let values = format!(r#"{{"name":"Belt.barrier","value":{barrier}}},{{"name":"Belt.speed","value":0.0}}"#);
        format!(r#"reported {ns} {{"SendValue":[{values}]}}"#)
    };
    let expected = [session[0], session[1], &reported(0, false), session[0], session[1], &reported(1_000_000, true)];
    assert_eq!(bench.record.0, expected, "the edge that nobody heard stands in no message");
}

#[test]
fn commands_faster_than_the_simulation_are_counted_as_lost_and_end_the_connection() {
    let mut bench = Bench::new(accepting());
    bench.turn(0);
    bench.turn(0);
    let many: Vec<i32> = (0..=bank::CAPACITY as i32).collect();
    for some in many.chunks(10_000) {
        bench.connector.transport().peer().command(Instant::ZERO, some);
        for _ in 0..20 {
            bench.turn(0);
        }
    }
    assert_eq!(bench.connector.traffic().messages_lost, 1);
    assert_eq!(bench.connector.traffic().messages_in, bank::CAPACITY as u64);
    assert!(bench.events().contains(&Event::CommandsLost { values: 1 }));
    assert!(!bench.connector.is_connected());
}

#[test]
fn a_final_refusal_ends_the_connector() {
    let mut settings = accepting();
    settings.refuse = Some((ResultCode(503), "closed for good".to_owned()));
    let mut bench = Bench::new(settings);
    bench.turn(0);
    assert!(bench.events().iter().any(Event::is_final_refusal));
    assert!(bench.connector.is_done());
}

#[test]
fn a_disconnection_is_said_and_acknowledged() {
    let mut bench = Bench::new(accepting());
    bench.turn(0);
    bench.turn(0);
    bench.connector.disconnect(bench.now);
    assert!(!bench.connector.is_done());
    bench.turn(0);
    assert!(bench.connector.is_done());
    let ended = ClientEvent::Ended(crate::session::Ending::Disconnected);
    assert!(bench.events().contains(&Event::Session(ended)));
}
