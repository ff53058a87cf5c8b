//! The rules under "Ours, beyond the source": the selection of R007.

use super::*;
use crate::value::Value;
use crate::wire::SignalSelection;

/// A server whose client selected these signals with these intervals in milliseconds.
fn selecting(signals: &str) -> Server {
    let mut server = server();
    let connect = format!(r#"{{"Connect":{{"Id":"{}","enable":true,"Signals":[{signals}]}}}}"#, to_base64("run 1"));
    server.handle(at(0), Input::Text(&connect));
    server
}

fn values(values: &[(&str, i64)]) -> Vec<(RegisterId, Value)> {
    let value = |name, n| if name == "Belt.sequence" { Value::Lint(n) } else { Value::Bool(n != 0) };
    values.iter().map(|&(name, n)| (register(name), value(name, n))).collect()
}

/// What goes out when `sent` is offered at `now`.
#[track_caller]
fn check_send(server: &mut Server, now: Instant, sent: &[(&str, i64)], expect: &[&str]) {
    assert!(server.send(now, &values(sent)));
    assert_eq!(server_outputs(server), expect);
}

#[test]
fn a_client_sends_its_selection_with_connect() {
    let mut settings = ClientSettings::new("run 1");
    let min_interval = Duration::from_millis(100);
    settings.signals = Some(vec![SignalSelection { name: "Belt.run".to_owned(), min_interval }]);
    let mut client = Client::new(settings, map());
    client_outputs(&mut client);
    let connect = r#"→ {"Connect":{"Id":"cnVuIDE=","enable":true,"Signals":[{"name":"Belt.run","minInterval":100}]}}"#;
    check_client(&mut client, at(0), Input::Opened, &[connect]);
    // Ending the session needs none.
    client.disconnect(at(1));
    assert_eq!(client_outputs(&mut client), [r#"→ {"Connect":{"Id":"cnVuIDE=","enable":false}}"#]);
}

#[test]
fn only_what_was_selected_is_sent() {
    let mut server = selecting(r#"{"name":"Belt.run"}"#);
    server_outputs(&mut server);
    let run = r#"→ {"SendValue":[{"name":"Belt.run","value":true}]}"#;
    check_send(&mut server, at(0), &[("Belt.sequence", 1), ("Belt.run", 1)], &[run]);
    check_send(&mut server, at(0), &[("Belt.sequence", 2)], &[]);
}

#[test]
fn an_empty_selection_is_none_of_the_signals_and_no_selection_all() {
    let mut server = selecting("");
    server_outputs(&mut server);
    check_send(&mut server, at(0), &[("Belt.run", 1)], &[]);
    check_send(&mut serving(), at(0), &[("Belt.run", 1)], &[r#"→ {"SendValue":[{"name":"Belt.run","value":true}]}"#]);
}

#[test]
fn with_an_interval_of_zero_every_change_is_sent() {
    let mut server = selecting(r#"{"name":"Belt.run","minInterval":0}"#);
    server_outputs(&mut server);
    for n in [1, 0, 1] {
        let text = format!(r#"→ {{"SendValue":[{{"name":"Belt.run","value":{}}}]}}"#, n != 0);
        check_send(&mut server, at(5), &[("Belt.run", n)], &[&text]);
    }
    assert_eq!(server.timeout(), None);
}

#[test]
fn with_an_interval_the_latest_value_is_sent_no_faster() {
    let mut server = selecting(r#"{"name":"Belt.sequence","minInterval":100},{"name":"Belt.run","minInterval":30}"#);
    server_outputs(&mut server);
    let text = |n: i64| format!(r#"→ {{"SendValue":[{{"name":"Belt.sequence","value":{n}}}]}}"#);
    check_send(&mut server, at(0), &[("Belt.sequence", 1)], &[&text(1)]);
    check_send(&mut server, at(10), &[("Belt.sequence", 2)], &[]);
    check_send(&mut server, at(99), &[("Belt.sequence", 3)], &[]);
    assert_eq!(server.timeout(), Some(at(100)));
    check_server(&mut server, at(99), Input::Timeout, &[]);
    check_server(&mut server, at(100), Input::Timeout, &[&text(3)]);
    assert_eq!(server.timeout(), None);
    // The interval counts from the last value sent.
    check_send(&mut server, at(150), &[("Belt.sequence", 4)], &[]);
    check_server(&mut server, at(200), Input::Timeout, &[&text(4)]);
    check_send(&mut server, at(300), &[("Belt.sequence", 5)], &[&text(5)]);
}

#[test]
fn values_that_fall_due_together_travel_together() {
    let mut server = selecting(r#"{"name":"Belt.sequence","minInterval":100},{"name":"Belt.run","minInterval":100}"#);
    server_outputs(&mut server);
    server.send(at(0), &values(&[("Belt.run", 0), ("Belt.sequence", 0)]));
    server.send(at(1), &values(&[("Belt.run", 1), ("Belt.sequence", 1)]));
    server_outputs(&mut server);
    let both = r#"→ {"SendValue":[{"name":"Belt.run","value":true},{"name":"Belt.sequence","value":1}]}"#;
    check_server(&mut server, at(100), Input::Timeout, &[both]);
}

#[test]
fn a_value_that_is_back_at_what_was_sent_is_not_sent_again() {
    let mut server = selecting(r#"{"name":"Belt.run","minInterval":100}"#);
    server_outputs(&mut server);
    server.send(at(0), &values(&[("Belt.run", 0)]));
    server.send(at(1), &values(&[("Belt.run", 1)]));
    server.send(at(2), &values(&[("Belt.run", 0)]));
    server_outputs(&mut server);
    assert_eq!(server.timeout(), None);
    check_server(&mut server, at(100), Input::Timeout, &[]);
}

#[test]
fn selected_names_that_are_no_outputs_are_named_and_ignored() {
    let mut server = selecting(r#"{"name":"Belt.echo"},{"name":"Belt.run"},{"name":"x"}"#);
    let outputs = server_outputs(&mut server);
    let said = r#"selected, but no output of this automation: "Belt.echo", "x""#;
    assert_eq!(outputs[0], format!("notice: {said}"));
    assert!(
        outputs[1].contains(r#""result":200"#) && outputs[1].contains(&said.replace('"', "\\\"")),
        "{}",
        outputs[1]
    );
    assert_eq!(outputs[2], "connected run 1");

    let mut client = connecting();
    let text = reply(true, 200).replace("200", r#"200,"message":"x is no output""#);
    let expect = ["notice: the server accepted, and said: x is no output", "established with mock"];
    check_client(&mut client, at(0), Input::Text(&text), &expect);
}

#[test]
fn a_new_session_selects_anew() {
    let mut server = selecting(r#"{"name":"Belt.run","minInterval":100}"#);
    server.send(at(0), &values(&[("Belt.run", 0)]));
    server.send(at(1), &values(&[("Belt.run", 1)]));
    server.handle(at(2), Input::Text(&connect("run 1", true)));
    server_outputs(&mut server);
    assert_eq!(server.timeout(), None);
    let text = r#"→ {"SendValue":[{"name":"Belt.sequence","value":1}]}"#;
    check_send(&mut server, at(3), &[("Belt.sequence", 1)], &[text]);
}
