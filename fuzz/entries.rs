//! What is fuzzed: one function for each place at which somebody else's bytes come in. Each must come to an end without a
//! panic, whatever the bytes, and keep what is asserted here.
//!
//! The fuzzers in `fuzz_targets` call them, and so does `tests/fuzz_corpora.rs`, with everything the fuzzers ever found worth
//! keeping.

use std::collections::BTreeMap;
use std::io::BufReader;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{self, effects_file};
use kinetwin::prototype::source::{Layered, Memory};
use kinetwin::session::{Client, ClientSettings, Input, Limits, Output, Query, Server, ServerSettings};
use kinetwin::signal_map::{Direction, RegisterId, SignalMap, xml};
use kinetwin::time::Instant;
use kinetwin::trace::Reader;
use kinetwin::value::{ElementaryType, SignalType, Value};
use kinetwin::wire::{Message, TextForm, io_data, read_value};

/// The codec: a message of the CPS-Protocol, and the same bytes as a payload of the IO data model.
pub fn codec(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    // Whatever it makes of it, it reads.
    let _ = io_data::decode(text);
    let Ok(message) = Message::decode(text) else { return };
    assert!(
        serde_json::from_str::<serde_json::Value>(text).is_ok() || has_odd_numbers(text),
        "it took what is no JSON"
    );
    let again = message.encode();
    let read = Message::decode(&again).expect("what it wrote itself");
    assert_eq!(read.encode(), again, "what is written and read is written the same");
    let Message::SendValue(entries) = message else { return };
    for raw in entries.iter().filter_map(|entry| entry.value) {
        for element in &ElementaryType::ALL {
            for (ty, form) in
                [(SignalType::scalar(*element), TextForm::Base64), (SignalType::scalar(*element), TextForm::Plain)]
            {
                if let Ok(value) = read_value(raw, ty, form) {
                    assert!(value.to_f64().is_none_or(f64::is_finite), "{value:?}");
                }
            }
        }
    }
}

/// serde_json refuses a number that no f64 holds; the protocol answers it with 422, entry by entry.
fn has_odd_numbers(text: &str) -> bool {
    text.contains(['e', 'E']) || text.len() > 300
}

static RIG: LazyLock<Arc<SignalMap>> =
    LazyLock::new(|| Arc::clone(&plant::load(&Embedded, "models/rig", KINDS).expect("the rig").signal_map));

/// The session, both ends and the query: the bytes are a script of what happens to them.
pub fn session(data: &[u8]) {
    let limits = Limits { values: 64, messages_a_second: 50 };
    let mut client = Client::new(ClientSettings { limits, ..ClientSettings::new("fuzz") }, Arc::clone(&RIG));
    let mut server = Server::new(ServerSettings { limits, ..ServerSettings::new("fuzz") }, Arc::clone(&RIG));
    let mut query = Query::new(Duration::from_secs(5));
    let mut now = Instant::ZERO;
    let mut to_server = Vec::new();
    let mut to_client = Vec::new();
    let mut script = data;
    while let Some((&step, rest)) = script.split_first() {
        script = rest;
        now += Duration::from_millis(u64::from(step >> 4) * 40);
        let mut tell = |input: Input<'_>| {
            client.handle(now, input);
            server.handle(now, input);
            query.handle(now, input);
        };
        match step & 0xf {
            0 => tell(Input::Opened),
            1 => tell(Input::Closed),
            2 => tell(Input::Timeout),
            3 => tell(Input::Binary),
            4 => tell(Input::InvalidUtf8),
            5 => tell(Input::TooLong { limit: 9 }),
            6 => client.disconnect(now),
            7 => server.close(1000, "the script says so"),
            8 => _ = client.send(now, &some_values(script, Direction::Report)),
            9 => _ = server.send(now, &some_values(script, Direction::Command)),
            // What the ends said to each other arrives.
            10 | 11 => {
                std::mem::take(&mut to_server).iter().for_each(|text: &String| server.handle(now, Input::Text(text)));
                std::mem::take(&mut to_client).iter().for_each(|text: &String| client.handle(now, Input::Text(text)));
            }
            12 => server = Server::new(ServerSettings { limits, ..ServerSettings::new("fuzz") }, Arc::clone(&RIG)),
            // A text follows, up to the next line break.
            _ => {
                let end = script.iter().position(|byte| *byte == b'\n').unwrap_or(script.len());
                let (text, rest) = script.split_at(end);
                script = rest;
                if let Ok(text) = std::str::from_utf8(text) {
                    tell(Input::Text(text));
                }
            }
        }
        let mut said = 0;
        while let Some(output) = client.poll() {
            said += 1;
            if let Output::Transmit(text) = output {
                to_server.push(text);
            }
        }
        while let Some(output) = server.poll() {
            said += 1;
            if let Output::Transmit(text) = output {
                to_client.push(text);
            }
        }
        while query.poll().is_some() {
            said += 1;
        }
        assert!(said < 10_000, "one step made them say {said} things");
        assert!(
            client.timeout().is_none_or(|due| !client.is_ended() || due > now),
            "an ended client waits for nothing"
        );
    }
}

/// A value for each of the first few signals that `direction` sets, of the bytes that follow.
fn some_values(bytes: &[u8], direction: Direction) -> Vec<(RegisterId, Value)> {
    let signals = RIG.directed(direction).zip(bytes.iter().take(8));
    let odd = |byte: u8| [f64::from(byte), f64::NAN, f64::INFINITY, -1e300][usize::from(byte & 3)];
    signals.map(|((register, signal), byte)| (register, Value::from_f64(signal.ty.element, odd(*byte)))).collect()
}

/// The XML readers: a plant, a prototype's two files, a signals map, effects; the first byte says which.
pub fn xml(data: &[u8]) {
    let Some((which, text)) = data.split_first() else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    let with = |path: &str| {
        let files = BTreeMap::from([(path.to_owned(), text.to_owned())]);
        let model = if path.contains("catalogue") { "models/rig" } else { path };
        // A file that is refused is refused in words.
        if let Err(error) = plant::load(&Layered(Memory(files), Embedded), model, KINDS) {
            assert!(!error.to_string().is_empty());
        }
    };
    match which % 5 {
        0 => with("models/fuzz/plant.xml"),
        1 => with("models/catalogue/StraightConveyor/prototype.xml"),
        2 => with("models/catalogue/StraightConveyor/avatar.xml"),
        3 => {
            if let Ok(map) = xml::read("fuzz.xml", text) {
                let again = xml::read("again.xml", &xml::write(&map)).expect("what it wrote itself");
                assert!(xml::differences(&map, &again).is_empty(), "what is written and read is the same");
            }
        }
        _ => _ = effects_file::read("fuzz.xml", text),
    }
}

/// The trace reader, compressed traces included.
pub fn trace(data: &[u8]) {
    let Ok(mut reader) = Reader::new("fuzz.cps.jsonl", BufReader::new(data)) else { return };
    let mut last = None;
    // A few bytes may unpack to very many lines.
    for _ in 0..100_000 {
        match reader.next_line() {
            Ok(Some(line)) => {
                assert!(last.is_none_or(|last| last <= line.at), "time goes on");
                last = Some(line.at);
            }
            Ok(None) | Err(_) => return,
        }
    }
}
