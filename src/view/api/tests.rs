//! The interface over real sockets: a run of the rig, asked as a browser, a test bench and somebody who means harm ask.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use serde_json::{Value, json};

use super::{LARGEST_BODY, OPENAPI, ROUTES};
use crate::run::{self, Handle, Options, Speed};
use crate::view::live::Live;
use crate::view::{self, Server, Stage, Told};

/// A run of the rig in lock-step at an easy pace, viewed.
struct Bench {
    address: SocketAddr,
    live: Live,
    handle: Option<Handle>,
    _server: Server,
}

impl Bench {
    fn start() -> Bench {
        let options = Options { speed: Speed::Max, controlled: true, ..Options::new("models/rig") };
        let handle = run::start(&options).expect("the rig");
        let live = Live::new(&handle, None);
        let scene = handle.steering().expect("control").scene;
        let listening = view::listen(SocketAddr::from(([127, 0, 0, 1], 0)), None).expect("a port");
        let url = listening.url();
        let address = url.trim_start_matches("http://").trim_end_matches('/').parse().expect("an address");
        let stage = Stage::live(live.clone(), scene, Arc::new(Told::default()));
        let server = view::serve(listening, stage).expect("a thread");
        let bench = Bench { address, live, handle: Some(handle), _server: server };
        bench.done("POST", "/api/run/speed", &json!({"factor": 20}));
        bench
    }

    fn ask(&self, method: &str, path: &str, headers: &[&str], body: &[u8]) -> (u16, Value) {
        let mut stream = TcpStream::connect(self.address).expect("a connection");
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a timeout");
        let host = if headers.iter().any(|header| header.starts_with("Host:")) {
            String::new()
        } else {
            format!("Host: {}\r\n", self.address)
        };
        let headers: String = headers.iter().map(|header| format!("{header}\r\n")).collect();
        let head = format!(
            "{method} {path} HTTP/1.1\r\n{host}Connection: close\r\nContent-Length: {}\r\n{headers}\r\n",
            body.len()
        );
        stream.write_all(head.as_bytes()).expect("a sent head");
        // Who refuses a body early closes before all of it is sent.
        let _ = stream.write_all(body);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let text = String::from_utf8_lossy(&answer).into_owned();
        let status = text.split(' ').nth(1).and_then(|code| code.parse().ok()).unwrap_or_else(|| panic!("{text:?}"));
        let body = text.split_once("\r\n\r\n").map_or("", |(_, body)| body);
        (status, serde_json::from_str(body).unwrap_or(Value::String(body.to_owned())))
    }

    fn json(&self, method: &str, path: &str, body: &Value) -> (u16, Value) {
        let body = if body.is_null() { String::new() } else { body.to_string() };
        self.ask(method, path, &["Content-Type: application/json"], body.as_bytes())
    }

    #[track_caller]
    fn done(&self, method: &str, path: &str, body: &Value) -> Value {
        let (status, answer) = self.json(method, path, body);
        assert_eq!(status, 200, "{method} {path}: {answer}");
        answer
    }

    #[track_caller]
    fn refused(&self, method: &str, path: &str, body: &Value, expected: u16, part: &str) {
        let (status, answer) = self.json(method, path, body);
        let error = answer["error"].as_str().unwrap_or_default();
        assert!(status == expected && error.contains(part), "{method} {path}: {status} {answer}");
        assert!(answer["hint"].as_str().is_some_and(|hint| !hint.is_empty()), "what to do: {answer}");
    }

    /// Asks until it is so, once for every picture that is taken of the run.
    #[track_caller]
    fn until(&self, path: &str, is_so: impl Fn(&Value) -> bool) -> Value {
        let runtime = tokio::runtime::Builder::new_current_thread().build().expect("a runtime");
        let mut pictures = self.live.frames();
        for _ in 0..500 {
            let (_, answer) = self.json("GET", path, &Value::Null);
            if is_so(&answer) {
                return answer;
            }
            runtime.block_on(pictures.changed()).expect("the run is looked at");
        }
        panic!("{path} never became so: {}", self.json("GET", path, &Value::Null).1);
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        if let Some(handle) = self.handle.take() {
            handle.stopper().stop();
            assert!(handle.finish().is_ok() || std::thread::panicking(), "the run went on to its end");
        }
        self.live.ended();
    }
}

#[test]
fn the_description_has_every_endpoint_and_no_other() {
    let described: Value = serde_json::from_str(OPENAPI).expect("JSON");
    let mut found: Vec<(String, String)> = Vec::new();
    for (path, methods) in described["paths"].as_object().expect("paths") {
        for (method, operation) in methods.as_object().expect("methods") {
            assert!(operation["summary"].is_string() && operation["responses"].is_object(), "{method} {path}");
            found.push((method.clone(), path.clone()));
        }
    }
    let mut expected: Vec<(String, String)> =
        ROUTES.iter().map(|(method, path)| ((*method).to_owned(), (*path).to_owned())).collect();
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
}

#[test]
fn every_endpoint_answers() {
    let bench = Bench::start();
    for (method, path) in ROUTES.iter().filter(|(_, path)| !path.ends_with("/stream") && !path.ends_with("/reset")) {
        let path = path.replace("{name}", "Belt.lightBarrierA").replace("{device}", "Belt").replace("{number}", "1");
        let (status, answer) = bench.json(&method.to_uppercase(), &path, &Value::Null);
        assert!(
            ![404, 405, 500].contains(&status) || answer["error"].is_string(),
            "{method} {path}: {status} {answer}"
        );
        assert_ne!(status, 405, "{method} {path}");
    }
}

#[test]
fn a_forced_signal_holds_until_it_is_released_and_two_do_not_force_it_unawares() {
    let bench = Bench::start();
    let force = "/api/signals/Belt.velocityTarget/force";
    bench.done("PUT", force, &json!({"value": 0.125, "client": "a"}));
    let state = bench.until("/api/state", |state| state["forced"][0]["by"] == "a");
    assert_eq!(state["forced"], json!([{"name": "Belt.velocityTarget", "value": 0.125, "by": "a"}]));
    bench.until("/api/signals/Belt.velocityTarget", |signal| signal["value"] == 0.125 && signal["forced"] == true);
    bench.refused("PUT", force, &json!({"value": 0.2, "client": "b"}), 409, "forced by \"a\" already");
    bench.done("PUT", force, &json!({"value": 0.25, "client": "b", "replace": true}));
    bench.until("/api/signals/Belt.velocityTarget", |signal| signal["value"] == 0.25 && signal["by"] == "b");
    bench.done("DELETE", "/api/forces", &Value::Null);
    bench.until("/api/state", |state| state["forced"] == json!([]));
    bench.refused("DELETE", force, &Value::Null, 409, "neither forced nor stuck");
}

#[test]
fn time_halts_steps_and_begins_anew() {
    let mut bench = Bench::start();
    bench.until("/api/state", |state| state["at_s"].as_f64() > Some(0.1));
    let paused = bench.done("POST", "/api/run/pause", &Value::Null)["at_s"].as_f64().expect("an instant");
    let stepped = bench.done("POST", "/api/run/step", &json!({"steps": 7}))["at_s"].as_f64().expect("an instant");
    assert!((stepped - paused - 0.007).abs() < 1e-9, "{paused} {stepped}");
    let again = bench.done("POST", "/api/run/step", &Value::Null)["at_s"].as_f64().expect("an instant");
    assert!((again - stepped - 0.001).abs() < 1e-9, "it had not gone on");
    bench.done("POST", "/api/run/resume", &Value::Null);
    bench.until("/api/state", |state| state["at_s"].as_f64() > Some(again + 0.05));
    // The main loop of the program: one run ends, another takes its place.
    let (live, handle) = (bench.live.clone(), bench.handle.take().expect("a run"));
    let next = std::thread::spawn(move || {
        while handle.notices().recv().is_ok() {}
        handle.finish().expect("ended");
        assert!(live.ended(), "somebody asked for another");
        let options = Options { speed: Speed::Max, controlled: true, ..Options::new("models/rig") };
        let handle = run::start(&options).expect("the rig");
        live.install(&handle);
        handle
    });
    bench.done("POST", "/api/run/reset", &Value::Null);
    bench.handle = Some(next.join().expect("another run"));
    bench.until("/api/state", |state| state["run"] == 2);
}

#[test]
fn parts_come_and_go_by_hand() {
    let bench = Bench::start();
    bench.done("POST", "/api/run/pause", &Value::Null);
    let part = |station: f64| json!({"kind": "box", "size": [0.2, 0.2, 0.2], "on": "Belt", "station": station});
    bench.done("POST", "/api/parts", &part(1.0));
    let state = bench.until("/api/state", |state| !state["parts"].as_array().expect("parts").is_empty());
    let number = state["parts"].as_array().expect("parts").last().expect("a part")["number"].clone();
    bench.refused("POST", "/api/parts", &part(1.05), 409, "a part or a plate is where it is to stand");
    bench.refused("POST", "/api/parts", &part(99.0), 409, "not on the belt");
    bench.refused("POST", "/api/parts", &json!({"kind": "egg"}), 400, "unknown variant `egg`");
    bench.done("DELETE", &format!("/api/parts/{number}"), &Value::Null);
    bench.refused("DELETE", &format!("/api/parts/{number}"), &Value::Null, 404, "no part");
    bench.refused("DELETE", "/api/parts/x", &Value::Null, 400, "no number");
    bench.until("/api/statistics", |statistics| statistics["boxes"]["removed"] == 1);
}

#[test]
fn faults_on_demand_stand_until_they_are_mended() {
    let bench = Bench::start();
    bench.done("PUT", "/api/faults/drives/Belt", &Value::Null);
    bench.done("PUT", "/api/faults/signals/Belt.lightBarrierA", &Value::Null);
    bench.done("PUT", "/api/faults/message", &Value::Null);
    bench.until("/api/state", |state| state["faults"]["drives"] == json!(["Belt"]));
    bench.until("/api/signals/Belt.velocityActual", |signal| signal["value"] == 0.0);
    bench.until("/api/signals/Belt.lightBarrierA", |signal| signal["stuck"] == true);
    bench.done("DELETE", "/api/faults/drives/Belt", &Value::Null);
    bench.done("DELETE", "/api/faults/signals/Belt.lightBarrierA", &Value::Null);
    bench
        .until("/api/state", |state| state["faults"]["drives"] == json!([]) && state["faults"]["signals"] == json!([]));
    bench.refused("DELETE", "/api/faults/drives/Belt", &Value::Null, 409, "not broken");
    bench.refused("PUT", "/api/faults/drives/Feed", &Value::Null, 404, "no drive");
    bench.refused("PUT", "/api/faults/signals/Belt.velocityTarget", &Value::Null, 400, "only what a device reports");
}

#[test]
fn what_is_no_request_is_answered_and_the_run_goes_on() {
    let bench = Bench::start();
    let force = "/api/signals/Belt.velocityTarget/force";
    let check = |method: &str, path: &str, body: &[u8], expected: u16, part: &str| {
        let (status, answer) = bench.ask(method, path, &["Content-Type: application/json"], body);
        assert!(status == expected && answer.to_string().contains(part), "{method} {path}: {status} {answer}");
    };
    check("PUT", force, b"{\"value\":", 400, "EOF");
    check("PUT", force, b"\xff\xfe", 400, "not what this endpoint takes");
    check("PUT", force, b"{}", 400, "missing field `value`");
    check("PUT", force, b"{\"value\":\"fast\"}", 400, "Belt.velocityTarget");
    check("PUT", force, b"{\"value\":1e999}", 400, "out of range");
    check("PUT", force, b"{\"value\":1,\"valu\":2}", 400, "unknown field `valu`");
    check("PUT", "/api/signals/Belt.velocitTarget/force", b"{\"value\":1}", 404, "Belt.velocitTarget");
    check("POST", "/api/run/step", b"{\"steps\":0}", 400, "expected 1 to");
    check("POST", "/api/run/speed", b"{\"factor\":\"fast\"}", 400, "0.01 to 1000");
    check("POST", "/api/playback", b"{\"time_s\":1}", 409, "a run that goes on");
    check("POST", "/api/recording", b"{\"file\":\"../../etc/x.cps.jsonl\"}", 400, "no name for a trace");
    check("GET", "/api/nothing", b"", 404, "openapi.json");
    check("PATCH", "/api/state", b"", 405, "does not take PATCH");
    let huge = vec![b' '; 10 * 1024 * 1024];
    assert!(huge.len() > LARGEST_BODY);
    check("PUT", force, &huge, 413, "longer than");
    for path in [
        "/assets/../Cargo.toml",
        "/assets/..%2f..%2fCargo.toml",
        "/..%2f..%2fetc/passwd",
        "/assets/%00",
        "/../../etc/passwd",
    ] {
        check("GET", path, b"", 404, "there is no");
    }
    let (status, _) = bench.ask("POST", "/api/run/pause", &["Host: evil.example"], b"");
    assert_eq!(status, 403);
    let (status, _) = bench.ask("POST", "/api/run/pause", &["Origin: http://evil.example"], b"");
    assert_eq!(status, 403);
    // What is no HTTP at all.
    let mut stream = TcpStream::connect(bench.address).expect("a connection");
    stream.write_all(b"\x16\x03\x01\x00\xa5 hello\r\n\r\n").expect("sent");
    drop(stream);
    let steps = bench.until("/api/state", |state| state["steps"].as_u64() > Some(0))["steps"].as_u64();
    bench.until("/api/state", |state| state["steps"].as_u64() > steps);
}

#[test]
fn a_browser_that_vanishes_or_does_not_read_keeps_nobody_waiting() {
    let bench = Bench::start();
    let dial = |origin: &str| {
        let mut stream = TcpStream::connect(bench.address).expect("a connection");
        let head = format!(
            "GET /api/stream HTTP/1.1\r\nHost: {0}\r\nOrigin: {origin}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
            bench.address
        );
        stream.write_all(head.as_bytes()).expect("sent");
        let mut start = [0; 12];
        stream.read_exact(&mut start).expect("an answer");
        (String::from_utf8_lossy(&start[9..]).into_owned(), stream)
    };
    let own = format!("http://{}", bench.address);
    let (status, asleep) = dial(&own);
    assert_eq!(status, "101");
    let (status, gone) = dial(&own);
    assert_eq!(status, "101");
    assert_eq!(dial("http://evil.example").0, "403", "no other page may listen");
    bench.until("/api/state", |state| state["viewers"] == 2);
    drop(gone);
    bench.until("/api/state", |state| state["viewers"] == 1);
    let steps = bench.done("GET", "/api/state", &Value::Null)["steps"].as_u64();
    bench.until("/api/state", |state| state["steps"].as_u64() > steps.map(|steps| steps + 200));
    drop(asleep);
    bench.until("/api/state", |state| state["viewers"] == 0);
}

#[test]
fn a_port_that_is_taken_is_told() {
    let bench = Bench::start();
    let error = view::listen(bench.address, None).expect_err("it is taken").to_string();
    assert!(error.contains("another program listens there; choose another port"), "{error}");
}
