//! What a value costs on its way through codec and session: 400 values in a message, as a plant of 200 function blocks has.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use kinetwin::session::{Client, ClientSettings, Input, Server, ServerSettings};
use kinetwin::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use kinetwin::time::Instant;
use kinetwin::value::{ElementaryType, SignalType, Unit, Value};
use kinetwin::wire::{Message, SendValueText};

const VALUES: usize = 400;

fn map() -> Arc<SignalMap> {
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

fn values(map: &SignalMap) -> Vec<(RegisterId, Value)> {
    let numbers = (1..).map(|n| f64::from(n) * 0.137);
    let signals = map.directed(Direction::Command).zip(numbers);
    signals.map(|((register, signal), number)| (register, Value::from_f64(signal.ty.element, number))).collect()
}

/// A client and a server between which a session stands.
fn session(map: &Arc<SignalMap>) -> (Client, Server) {
    let mut client = Client::new(ClientSettings::new("bench"), Arc::clone(map));
    let mut server = Server::new(ServerSettings::new("bench"), Arc::clone(map));
    client.handle(Instant::ZERO, Input::Opened);
    while let Some(output) = client.poll() {
        if let kinetwin::session::Output::Transmit(text) = output {
            server.handle(Instant::ZERO, Input::Text(&text));
        }
    }
    while let Some(output) = server.poll() {
        if let kinetwin::session::Output::Transmit(text) = output {
            client.handle(Instant::ZERO, Input::Text(&text));
        }
    }
    while client.poll().is_some() {}
    assert!(client.is_established() && server.is_established());
    (client, server)
}

fn wire(c: &mut Criterion) {
    let map = map();
    let values = values(&map);
    let names: Vec<&str> = map.signals().iter().map(|signal| signal.name.as_str()).collect();
    let encode = || {
        let mut text = SendValueText::with_capacity(VALUES);
        for (name, (_, value)) in names.iter().zip(&values) {
            text.push(name, value).expect("a value with a JSON form");
        }
        text.finish().expect("a message")
    };
    let text = encode();
    c.bench_function("encode 400 values", |b| b.iter(encode));
    c.bench_function("decode 400 entries", |b| b.iter(|| Message::decode(black_box(&text)).expect("a message")));

    let (client, server) = session(&map);
    let (mut client, mut server) = (client, server);
    c.bench_function("session: 400 values from frame to registers", |b| {
        b.iter_batched(
            || (),
            |()| {
                client.handle(Instant::ZERO, Input::Text(black_box(&text)));
                client.poll()
            },
            BatchSize::SmallInput,
        );
    });
    c.bench_function("session: 400 values from registers to frame", |b| {
        b.iter(|| {
            server.send(Instant::ZERO, black_box(&values));
            server.poll()
        });
    });
}

criterion_group!(benches, wire);
criterion_main!(benches);
