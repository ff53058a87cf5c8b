//! What a value costs on its way through codec and session: 400 values in a message, as a plant of 200 function blocks has,
//! beside serde_json and sonic-rs doing the same.
//!
//!     cargo bench --bench wire
//!
//! Criterion prints the times; the last lines are the ratios of one run, which is what can be compared between machines.

#[path = "wire/json.rs"]
mod json;
#[path = "wire/values.rs"]
mod values;

use std::hint::black_box;
use std::time::{Duration, Instant as Clock};

use criterion::{BatchSize, Criterion, criterion_group};
use kinetwin::session::Input;
use kinetwin::time::Instant;
use kinetwin::wire::{Message, SendValueText};

use values::VALUES;

fn wire(c: &mut Criterion) {
    let map = values::map();
    let values = values::values(&map);
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

    let (mut client, mut server) = values::session(&map);
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

/// What is measured, by its name.
type Way<'a> = (&'static str, Box<dyn FnMut() + 'a>);

/// The time of one call, the least of several rounds.
fn least(mut call: impl FnMut()) -> Duration {
    const CALLS: u32 = 200;
    let start = Clock::now();
    (0..CALLS).for_each(|_| call());
    start.elapsed() / CALLS
}

/// The codec and the JSON crates in turns: what each takes at least.
fn ratios() {
    const ROUNDS: usize = 60;
    let map = values::map();
    let values = values::values(&map);
    let message = json::Message::of(&map, &values);
    let begun: Vec<Box<str>> = map.signals().iter().map(|signal| SendValueText::begin(&signal.name)).collect();
    let encode = || {
        let mut text = SendValueText::with_capacity(VALUES);
        for (begun, (_, value)) in begun.iter().zip(&values) {
            text.push_begun(begun, value).expect("a value with a JSON form");
        }
        text.finish().expect("a message")
    };
    let text = encode();
    let (mut client, mut server) = values::session(&map);
    let mut ways: Vec<Way<'_>> = vec![
        ("encode: kinetwin", Box::new(|| drop(black_box(encode())))),
        ("encode: serde_json", Box::new(|| drop(black_box(serde_json::to_string(&message))))),
        ("encode: sonic-rs", Box::new(|| drop(black_box(sonic_rs::to_string(&message))))),
        ("decode: kinetwin", Box::new(|| drop(black_box(Message::decode(&text))))),
        ("decode: serde_json", Box::new(|| drop(black_box(serde_json::from_str::<json::Message<'_>>(&text))))),
        ("decode: sonic-rs", Box::new(|| drop(black_box(sonic_rs::from_str::<json::Message<'_>>(&text))))),
        (
            "session: registers to frame",
            Box::new(|| {
                server.send(Instant::ZERO, black_box(&values));
                while server.poll().is_some() {}
            }),
        ),
        (
            "session: frame to registers",
            Box::new(|| {
                client.handle(Instant::ZERO, Input::Text(black_box(&text)));
                while client.poll().is_some() {}
            }),
        ),
    ];
    let mut found = vec![Duration::MAX; ways.len()];
    for _ in 0..ROUNDS {
        ways.iter_mut().zip(&mut found).for_each(|((_, way), least_yet)| *least_yet = least(way).min(*least_yet));
    }
    println!("\n{VALUES} values, {} bytes, least of {ROUNDS} rounds", text.len());
    ways.iter().zip(&found).for_each(|((name, _), time)| println!("{name:<40} {:>8.2} µs", time.as_secs_f64() * 1e6));
    for (what, at) in [("encode", 0), ("decode", 3)] {
        let ratio = found[at].as_secs_f64() / found[at + 1].min(found[at + 2]).as_secs_f64();
        let met = if ratio <= 1.2 { "met   " } else { "MISSED" };
        println!("{met} {ratio:.2} (at most 1.2): {what}, to the fastest JSON crate");
    }
}

criterion_group!(benches, wire);

fn main() {
    benches();
    ratios();
}
