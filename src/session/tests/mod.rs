//! Every rule of the protocol as a plain test, named by the rule; and two peers under one virtual clock.

mod connecting;
mod dice;
mod frames;
mod ours;
mod pair;
mod plain;
mod querying;
mod sweep;
mod values;

use std::sync::{Arc, LazyLock};
use std::time::Duration;

use super::*;
use crate::signal_map::{Direction, Kind, RateClass, Signal, SignalMap};
use crate::time::Instant;
use crate::value::Unit;
use crate::wire::to_base64;

/// Commands and reports of several types.
fn map() -> Arc<SignalMap> {
    static MAP: LazyLock<Arc<SignalMap>> = LazyLock::new(build_map);
    Arc::clone(&MAP)
}

fn build_map() -> Arc<SignalMap> {
    let signal = |name: &str, ty: &str, direction, range: Option<(f64, f64)>, unit: &str| {
        let (instance, property) = name.split_once('.').expect("an instance and a property");
        Signal {
            name: name.to_owned(),
            ty: ty.parse().expect("a type"),
            direction,
            kind: Kind::Level,
            rate: RateClass::HighFrequency,
            unit: if unit.is_empty() { Unit::ONE } else { Unit::named(unit).expect("a unit") },
            min: range.map(|range| range.0),
            max: range.map(|range| range.1),
            instance: instance.to_owned(),
            task: "task".to_owned(),
            property: property.to_owned(),
        }
    };
    let signals = vec![
        signal("Belt.velocityTarget", "REAL", Direction::Command, Some((-0.1, 0.1)), "m/s"),
        signal("Belt.motorDirection", "DINT", Direction::Command, Some((-1.0, 1.0)), ""),
        signal("Belt.recipe", "STRING", Direction::Command, None, ""),
        signal("Belt.matrix", "LREAL[3]", Direction::Command, Some((0.0, 9.0)), ""),
        signal("Belt.small", "SINT", Direction::Command, None, ""),
        signal("Belt.run", "BOOL", Direction::Command, None, ""),
        signal("Belt.sequence", "LINT", Direction::Command, None, ""),
        signal("Belt.delay", "TIME", Direction::Command, Some((0.0, 2.0)), "s"),
        signal("Belt.velocityActual", "REAL", Direction::Report, None, "m/s"),
        signal("Belt.lightBarrierA", "BOOL", Direction::Report, None, ""),
        signal("Belt.echo", "LINT", Direction::Report, None, ""),
    ];
    Arc::new(SignalMap::new("test", signals).expect("names that differ"))
}

fn register(name: &str) -> RegisterId {
    map().register(name).expect(name)
}

/// So many milliseconds after the start.
fn at(ms: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(ms)
}

fn client() -> Client {
    Client::new(ClientSettings::new("run 1"), map())
}

fn server() -> Server {
    Server::new(ServerSettings::new("mock"), map())
}

/// A client that has dialled, opened and said `Connect`, at t = 0.
fn connecting() -> Client {
    let mut client = client();
    client.handle(at(0), Input::Opened);
    client_outputs(&mut client);
    client
}

/// A client whose session stands since t = 0.
fn established() -> Client {
    established_as(ClientSettings::new("run 1"))
}

fn established_as(settings: ClientSettings) -> Client {
    let mut client = Client::new(settings, map());
    client.handle(at(0), Input::Opened);
    client.handle(at(0), Input::Text(&reply(true, 200)));
    client_outputs(&mut client);
    assert!(client.is_established());
    client
}

/// A server with a session.
fn serving() -> Server {
    let mut server = server();
    server.handle(at(0), Input::Text(&connect("run 1", true)));
    server_outputs(&mut server);
    assert!(server.is_established());
    server
}

fn connect(id: &str, enable: bool) -> String {
    format!(r#"{{"Connect":{{"Id":"{}","enable":{enable}}}}}"#, to_base64(id))
}

/// The server's answer to the client of [`connecting`].
fn reply(enable: bool, result: i64) -> String {
    reply_to("run 1", enable, result)
}

fn reply_to(id: &str, enable: bool, result: i64) -> String {
    let (id, name) = (to_base64(id), to_base64("mock"));
    format!(r#"{{"ConnectReply":{{"Id":"{id}","enable":{enable},"ServerName":"{name}","result":{result}}}}}"#)
}

fn send_value(entries: &str) -> String {
    format!(r#"{{"SendValue":[{entries}]}}"#)
}

/// All outputs, one line each.
fn client_outputs(client: &mut Client) -> Vec<String> {
    std::iter::from_fn(|| client.poll()).map(|output| line(output, client_event)).collect()
}

fn server_outputs(server: &mut Server) -> Vec<String> {
    std::iter::from_fn(|| server.poll()).map(|output| line(output, server_event)).collect()
}

fn line<E>(output: Output<E>, event: impl Fn(E) -> String) -> String {
    match output {
        Output::Transmit(text) => format!("→ {text}"),
        Output::Close { code, reason } => format!("close {code}: {reason}"),
        Output::Event(e) => event(e),
    }
}

fn staged(staged: &Staged) -> String {
    let map = map();
    let values = staged.values.iter().map(|(register, value)| format!(" {}={value}", map.signal(*register).name));
    format!("values{}", values.collect::<String>())
}

fn client_event(event: ClientEvent) -> String {
    match event {
        ClientEvent::Dial { attempt } => format!("dial {attempt}"),
        ClientEvent::Established { server_name } => format!("established with {server_name}"),
        ClientEvent::Refused { result, message, retry_at } => {
            format!("refused {result} {} retry {}", message.unwrap_or_default(), instant(retry_at))
        }
        ClientEvent::Lost { reason, was_established, retry_at } => {
            let was = if was_established { "session lost" } else { "no session" };
            format!("{was}: {reason}, retry {}", instant(Some(retry_at)))
        }
        ClientEvent::Values(values) => staged(&values),
        ClientEvent::Rejected { text, reason } => format!("rejected {text}: {reason}"),
        ClientEvent::Faults(faults) => {
            format!("faults {}", faults.iter().map(|f| format!("<{f}>")).collect::<String>())
        }
        ClientEvent::Unsendable { reason, .. } => format!("unsendable: {reason}"),
        ClientEvent::Notice(text) => format!("notice: {text}"),
        ClientEvent::Ended(ending) => format!("ended: {ending:?}"),
    }
}

fn server_event(event: ServerEvent) -> String {
    match event {
        ServerEvent::Connected { id } => format!("connected {id}"),
        ServerEvent::Refused { id, result } => format!("refused {id} with {result}"),
        ServerEvent::Values(values) => staged(&values),
        ServerEvent::Rejected { text, reason } => format!("rejected {text}: {reason}"),
        ServerEvent::Faults(faults) => {
            format!("faults {}", faults.iter().map(|f| format!("<{f}>")).collect::<String>())
        }
        ServerEvent::Unsendable { reason, .. } => format!("unsendable: {reason}"),
        ServerEvent::Notice(text) => format!("notice: {text}"),
        ServerEvent::Disconnected => "disconnected".to_owned(),
        ServerEvent::Ended { reason, was_established } => {
            format!("{}: {reason}", if was_established { "session lost" } else { "ended" })
        }
    }
}

fn instant(instant: Option<Instant>) -> String {
    instant.map_or("never".to_owned(), |instant| instant.to_string())
}

/// What the client says when told `input` at `now`.
#[track_caller]
fn check_client(client: &mut Client, now: Instant, input: Input<'_>, expect: &[&str]) {
    client.handle(now, input);
    assert_eq!(client_outputs(client), expect);
}

/// What the server says when told `input` at `now`.
#[track_caller]
fn check_server(server: &mut Server, now: Instant, input: Input<'_>, expect: &[&str]) {
    server.handle(now, input);
    assert_eq!(server_outputs(server), expect);
}
