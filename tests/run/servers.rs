//! `kinetwin run` as a process against servers that do what a test says: servers that are absent, refuse, talk nonsense,
//! die and return; and how a run ends.

use std::io::Write as _;

use crate::support::{Connection, Host, Running, kinetwin};
use serde_json::{Value, json};

/// A run against `host` that goes on until it is interrupted.
fn run_against(host: &Host) -> Running {
    Running::start(&["run", "models/rig", "--connect", &host.url(), "--json"])
}

/// Ends a run whose session stands on `connection`, in good order, and gives its summary.
fn end(run: Running, connection: Connection) -> Value {
    run.interrupt();
    connection.farewell();
    let ended = run.end();
    assert_eq!(ended.code(), 0, "{}", ended.stderr);
    ended.json()
}

/// The names in the first message of a session: all reports.
fn first_reports(connection: &mut Connection) -> Vec<String> {
    let message = connection.receive("SendValue");
    let names = message.as_array().expect("an array").iter().map(|entry| entry["name"].as_str().expect("a name"));
    names.map(str::to_owned).collect()
}

#[test]
fn a_server_that_is_absent_is_tried_again_and_the_answer_is_no() {
    // The port is free: the host is gone before the run starts.
    let url = Host::new().url();
    let ended = kinetwin(&["run", "models/rig", "--connect", &url, "--for", "1s", "--json"]);
    assert_eq!(ended.code(), 1);
    assert!(ended.stderr.contains(&format!("failed to connect to {url}: nobody listens there")), "{}", ended.stderr);
    assert!(ended.stderr.contains("trying again in 500ms"), "{}", ended.stderr);
    assert!(ended.stderr.contains("trying again in 1s"), "{}", ended.stderr);
    assert!(ended.stderr.contains("the server never accepted a session"), "{}", ended.stderr);
    let summary = ended.json();
    assert_eq!((&summary["sessions"], &summary["sim_s"]), (&json!(0), &json!(1.0)), "simulated time goes on");
}

#[test]
fn a_temporary_refusal_is_asked_again_with_the_same_id() {
    let host = Host::new();
    let mut run = run_against(&host);
    let (mut connection, first) = host.accept_session(409);
    run.line("the server refused with 409");
    let second = connection.receive("Connect");
    assert_eq!(first, second, "on the connection that stands");
    connection.reply(&second, 200);
    assert_eq!(first_reports(&mut connection).len(), 23);
    let summary = end(run, connection);
    assert_eq!(summary["sessions"], 1);
}

#[test]
fn a_permanent_refusal_ends_the_run() {
    let host = Host::new();
    let run = run_against(&host);
    let (mut connection, _) = host.accept_session(503);
    assert_eq!(connection.close_code(), 1000);
    let ended = run.end();
    assert_eq!(ended.code(), 1);
    assert!(ended.stderr.contains("error: the server refused with 503; that is final"), "{}", ended.stderr);
    assert_eq!(ended.json()["refused"], "503");
}

#[test]
fn nonsense_is_named_and_changes_nothing() {
    let host = Host::new();
    let mut run = run_against(&host);
    let (mut connection, _) = host.accept_session(200);
    first_reports(&mut connection);
    connection.send_binary(&[0, 1, 2]);
    run.line("a binary message was ignored");
    connection.send("no JSON at all");
    run.line("a message was refused");
    connection.send(&format!("{}1{}", "[".repeat(40), "]".repeat(40)));
    run.line("a message was refused");
    connection.send(r#"{"SendValue":[],"Connect":{}}"#);
    run.line("a message was refused");
    let mixed = json!([
        { "name": "Nobody.knows", "value": 1 },
        { "name": "Belt.velocityTarget", "value": "fast" },
        { "name": "Belt.motorDirection", "value": 5 },
        { "name": "Belt.lightBarrierA", "value": true },
        { "name": "Motor.enable", "value": true },
    ]);
    connection.send(&json!({ "SendValue": mixed }).to_string());
    let refused = run.line("refused values");
    assert!(refused.contains("Nobody.knows") && refused.contains("and 1 more"), "{refused}");
    let replies = connection.receive("SendValueReply");
    let results: Vec<_> = replies.as_array().expect("an array").iter().map(|fault| fault["result"].clone()).collect();
    assert_eq!(results, [404, 415, 422, 404]);
    // The good entry acted all the same.
    assert_eq!(connection.receive_value("Motor.inverterReady"), true);
    let summary = end(run, connection);
    assert_eq!((&summary["sessions"], &summary["values_in"]), (&json!(1), &json!(1)));
}

#[test]
fn a_message_of_100_mb_closes_the_connection_and_the_next_session_hears_all() {
    let host = Host::new();
    let mut run = run_against(&host);
    let (mut connection, first) = host.accept_session(200);
    first_reports(&mut connection);
    // Only its head: whoever waited for the rest would wait for ever.
    let length = 100_000_000u64;
    let mut head = vec![0x81, 127];
    head.extend(length.to_be_bytes());
    head.extend(b"{\"SendValue\":[");
    connection.stream().write_all(&head).expect("a head that can be sent");
    run.line("a message was longer than 1048576 bytes");
    assert_eq!(connection.close_code(), 1009);
    drop(connection);
    let (mut connection, second) = host.accept_session(200);
    assert_eq!(first["Id"], second["Id"], "one run, one Id");
    assert_eq!(first_reports(&mut connection).len(), 23);
    assert_eq!(end(run, connection)["sessions"], 2);
}

#[test]
fn a_message_that_is_not_utf_8_closes_the_connection() {
    let host = Host::new();
    let mut run = run_against(&host);
    let (mut connection, _) = host.accept_session(200);
    first_reports(&mut connection);
    connection.stream().write_all(&[0x81, 2, 0xC3, 0x28]).expect("bytes that can be sent");
    run.line("a message was not UTF-8");
    assert_eq!(connection.close_code(), 1007);
    drop(connection);
    let (connection, _) = host.accept_session(200);
    assert_eq!(end(run, connection)["sessions"], 2);
}

#[test]
fn a_server_that_dies_and_returns_finds_the_plant_where_it_is() {
    let host = Host::new();
    let mut run = run_against(&host);
    let (mut connection, _) = host.accept_session(200);
    first_reports(&mut connection);
    connection.send_value("Motor.enable", json!(true));
    assert_eq!(connection.receive_value("Motor.inverterReady"), true);
    drop(connection);
    run.line("trying again in 500ms");
    let (mut connection, _) = host.accept_session(200);
    assert_eq!(connection.receive_value("Motor.inverterReady"), true, "its first message holds the present outputs");
    connection.send_value("Motor.enable", json!(false));
    assert_eq!(connection.receive_value("Motor.inverterReady"), false);
    assert_eq!(end(run, connection)["sessions"], 2);
}

#[test]
fn ctrl_c_waits_for_the_answer_no_longer_than_the_timeout() {
    let host = Host::new();
    let url = host.url();
    let run = Running::start(&["run", "models/rig", "--connect", &url, "--timeout", "100ms", "--json"]);
    let (mut connection, _) = host.accept_session(200);
    first_reports(&mut connection);
    run.interrupt();
    // The disconnection is never answered.
    let ended = run.end();
    assert_eq!(ended.code(), 0);
    assert!(ended.stderr.contains("the server did not acknowledge it"), "{}", ended.stderr);
    assert_eq!(ended.json()["sessions"], 1);
}

/// Who is called upon may want an end at once: it was listened for before.
#[test]
fn ctrl_c_at_the_first_sign_of_life_ends_in_good_order() {
    let host = Host::new();
    let run = run_against(&host);
    let _connection = host.accept();
    run.interrupt();
    assert_eq!(run.end().json()["sessions"], 0);
}

#[test]
fn a_second_ctrl_c_ends_at_once() {
    let host = Host::new();
    let mut run = Running::start(&["run", "models/rig", "--connect", &host.url(), "--timeout", "10m", "--json"]);
    let (mut connection, _) = host.accept_session(200);
    run.line("stands");
    first_reports(&mut connection);
    run.interrupt();
    loop {
        let text = connection.receive_text();
        if text.contains(r#""enable":false"#) {
            break;
        }
    }
    // The run waits for an answer, for ten minutes if need be.
    run.interrupt();
    let ended = run.end();
    assert_eq!((ended.code(), ended.stdout.as_str()), (130, ""));
}

#[test]
fn mistakes_in_arguments_and_models_end_with_2_and_start_nothing() {
    let check = |arguments: &[&str], part: &str| {
        let ended = kinetwin(arguments);
        assert_eq!((ended.code(), ended.stdout.as_str()), (2, ""), "{arguments:?}: {}", ended.stderr);
        assert!(ended.stderr.contains(part), "{arguments:?}: {}", ended.stderr);
    };
    check(&["run"], "<MODEL>");
    check(&["run", "nowhere"], "there is no model \"nowhere\"");
    check(&["run", "tests/faulty-models/malformed-xml"], "plant.xml:");
    check(&["run", "rig", "--for", "20"], "write a number and a unit");
    check(&["run", "rig", "--speed", "fast"], "expected a number from 0.01 to 1000, or max");
    check(&["run", "rig", "--step", "0s"], "--step is 0s: expected 10us to 1s");
    check(&["run", "rig", "--hf", "0s"], "--hf is 0s: expected 1ms to 3600s");
    check(&["run", "rig", "--connect", "http://localhost:1"], "expected ws://HOST:PORT");
    check(&["run", "rig", "--speed", "max", "--connect", "ws://127.0.0.1:9"], "needs the embedded automation");
    check(&["run", "rig", "--speed", "max", "--realtime"], "--realtime with --speed max");
    check(&["run", "rig", "--max-message", "10"], "expected at least 1024");
    check(&["run", "rig", "--token-file", "nowhere"], "failed to read the token from nowhere");
    check(&["run", "rig", "--record", "Cargo.toml"], "Cargo.toml is there already");
    check(&["run", "rig", "--record", "nowhere/trace"], "failed to record to nowhere/trace");
    check(&["fly"], "unrecognized subcommand");
}

/// The real-time priority of each thread of a process, by the thread's name (proc_pid_stat(5): field 40); 0 is none.
#[cfg(target_os = "linux")]
fn priorities(process: u32) -> Vec<(String, u32)> {
    let tasks = std::fs::read_dir(format!("/proc/{process}/task")).expect("a process that runs");
    let of = |task: std::io::Result<std::fs::DirEntry>| {
        let stat = std::fs::read_to_string(task.ok()?.path().join("stat")).ok()?;
        let (head, rest) = stat.rsplit_once(") ")?;
        Some((head.split_once('(')?.1.to_owned(), rest.split(' ').nth(40 - 3)?.parse().ok()?))
    };
    tasks.filter_map(of).collect()
}

#[test]
#[cfg(target_os = "linux")]
fn simulation_and_exchange_are_scheduled_in_real_time_or_the_run_says_why_not() {
    let host = Host::new();
    let run = Running::start(&["run", "rig", "--realtime", "--connect", &host.url()]);
    let (mut connection, _) = host.accept_session(200);
    // A step of the simulation answers what the exchange has brought: both threads have had work.
    connection.send_value("Robot.XTarget", json!(0.3));
    while connection.receive_value("Robot.cartesianArrived") != false {}
    let found = priorities(run.id());
    let of = |name: &str| found.iter().find(|(thread, _)| thread == name).expect(name).1;
    let scheduled = (of("simulation"), of("io"));
    run.interrupt();
    connection.farewell();
    let ended = run.end();
    let is_refused = ended.stderr.contains("warning: the system refuses real-time scheduling");
    assert_eq!(scheduled, if is_refused { (0, 0) } else { (20, 10) }, "{}", ended.stderr);
    assert_eq!(ended.code(), 0);
}

#[test]
fn a_reader_who_leaves_early_does_no_harm() {
    // It is gone before the program has anything to say.
    let mut run = Running::start(&["signals-map", "models/depalletizer"]);
    run.leave();
    let ended = run.end();
    assert_eq!((ended.code(), ended.stderr.as_str()), (0, ""));
}
