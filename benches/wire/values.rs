//! A message of 400 values and the two ends of a session, for what measures its time and for what counts its allocations.

use std::sync::Arc;

use kinetwin::session::{Client, ClientSettings, Input, Output, Server, ServerSettings};
use kinetwin::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use kinetwin::time::Instant;
use kinetwin::value::{ElementaryType, SignalType, Unit, Value};

/// Values in a message: those of 200 function blocks.
pub const VALUES: usize = 400;

/// Commands of three types, as conveyors have them.
pub fn map() -> Arc<SignalMap> {
    let signal = |n: usize| {
        let element = [ElementaryType::Real, ElementaryType::Bool, ElementaryType::Dint][n % 3];
        Signal {
            name: format!("Conveyor{}.property{}", n / 8, n % 8),
            ty: SignalType::scalar(element),
            direction: Direction::Command,
            kind: Kind::Level,
            rate: RateClass::HighFrequency,
            unit: Unit::ONE,
            min: None,
            max: None,
            instance: format!("Conveyor{}", n / 8),
            task: "task".to_owned(),
            property: format!("property{}", n % 8),
        }
    };
    Arc::new(SignalMap::new("bench", (0..VALUES).map(signal).collect()).expect("names that differ"))
}

/// A value for each.
pub fn values(map: &SignalMap) -> Vec<(RegisterId, Value)> {
    let numbers = (1..).map(|n| f64::from(n) * 0.137);
    let signals = map.directed(Direction::Command).zip(numbers);
    signals.map(|((register, signal), number)| (register, Value::from_f64(signal.ty.element, number))).collect()
}

/// A client and a server between which a session stands.
pub fn session(map: &Arc<SignalMap>) -> (Client, Server) {
    let mut client = Client::new(ClientSettings::new("bench"), Arc::clone(map));
    let mut server = Server::new(ServerSettings::new("bench"), Arc::clone(map));
    client.handle(Instant::ZERO, Input::Opened);
    while let Some(output) = client.poll() {
        if let Output::Transmit(text) = output {
            server.handle(Instant::ZERO, Input::Text(&text));
        }
    }
    while let Some(output) = server.poll() {
        if let Output::Transmit(text) = output {
            client.handle(Instant::ZERO, Input::Text(&text));
        }
    }
    while client.poll().is_some() {}
    assert!(client.is_established() && server.is_established());
    (client, server)
}
