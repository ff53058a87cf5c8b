//! The rules under "Frames".

use super::*;

/// That the session outlives a message of garbage, which is logged with `reason`.
#[track_caller]
fn refused(text: &str, reason: &str) {
    let expect = format!("rejected {text}: {reason}");
    let mut client = established();
    check_client(&mut client, at(0), Input::Text(text), &[&expect]);
    assert!(client.is_established());
    let mut server = serving();
    check_server(&mut server, at(0), Input::Text(text), &[&expect]);
    assert!(server.is_established());
}

#[test]
fn an_object_with_several_keys_is_refused_and_logged() {
    refused(
        r#"{"SendValue":[],"Connect":{}}"#,
        "expected an object with one key, the message's type, found \"SendValue\" and \"Connect\"",
    );
}

#[test]
fn an_unknown_message_type_is_logged_and_never_ends_the_session() {
    let known = "Connect, ConnectReply, SendValue, SendValueReply, QueryAll, QueryAllReply";
    refused(r#"{"Hello":{}}"#, &format!("\"Hello\" is no message of the protocol: expected one of {known}"));
}

#[test]
fn what_is_no_json_is_logged_and_never_ends_the_session() {
    refused("hello", "malformed JSON at byte 0: expected a value, found 'h'");
    refused("", "malformed JSON at byte 0: expected a value, found the end of the text");
}

#[test]
fn json_nested_deeper_than_32_is_refused() {
    let deep = format!(r#"{{"SendValue":{}{}}}"#, "[".repeat(32), "]".repeat(32));
    refused(&deep, "JSON nested deeper than 32 at byte 44");
    let shallow = format!(r#"{{"SendValue":{}{}}}"#, "[".repeat(31), "]".repeat(31));
    let mut client = established();
    client.handle(at(0), Input::Text(&shallow));
    assert!(!client_outputs(&mut client)[0].contains("nested"));
}

#[test]
fn an_empty_send_value_is_logged() {
    refused(r#"{"SendValue":[]}"#, "the message holds no entry");
}

#[test]
fn what_only_the_other_side_says_is_logged() {
    let text = connect("run 1", true);
    let expect = format!("rejected {text}: Connect is nothing that a client was waiting for");
    check_client(&mut established(), at(0), Input::Text(&text), &[&expect]);
    let text = reply(true, 200);
    let expect = format!("rejected {text}: ConnectReply is nothing that a server was waiting for");
    check_server(&mut serving(), at(0), Input::Text(&text), &[&expect]);
}

#[test]
fn a_binary_frame_is_logged_and_ignored() {
    let notice = "notice: a binary message was ignored: the protocol speaks JSON text";
    check_client(&mut established(), at(0), Input::Binary, &[notice]);
    check_server(&mut serving(), at(0), Input::Binary, &[notice]);
}

#[test]
fn invalid_utf_8_closes_with_1007_and_the_client_comes_back() {
    let mut client = established();
    let expect = ["close 1007: a message was not UTF-8", "session lost: a message was not UTF-8, retry 0.500 s"];
    check_client(&mut client, at(0), Input::InvalidUtf8, &expect);
    check_client(&mut client, at(500), Input::Timeout, &["dial 1"]);
    check_server(
        &mut serving(),
        at(0),
        Input::InvalidUtf8,
        &["close 1007: a message was not UTF-8", "session lost: a message was not UTF-8"],
    );
}

#[test]
fn a_message_over_the_limit_closes_with_1009_and_the_client_comes_back() {
    let mut client = established();
    let reason = "a message was longer than 1048576 bytes";
    let expect = [format!("close 1009: {reason}"), format!("session lost: {reason}, retry 0.500 s")];
    check_client(&mut client, at(0), Input::TooLong { limit: 1_048_576 }, &[&expect[0], &expect[1]]);
    check_client(&mut client, at(500), Input::Timeout, &["dial 1"]);
    let expect = [format!("close 1009: {reason}"), format!("session lost: {reason}")];
    check_server(&mut serving(), at(0), Input::TooLong { limit: 1_048_576 }, &[&expect[0], &expect[1]]);
}

#[test]
fn an_owner_that_does_not_poll_loses_the_connection_and_not_the_order() {
    let mut client = established();
    let text = |n: usize| send_value(&format!(r#"{{"name":"Belt.sequence","value":{n}}}"#));
    for n in 0..OUTPUT_LIMIT + 10 {
        client.handle(at(0), Input::Text(&text(n)));
    }
    let outputs = client_outputs(&mut client);
    assert_eq!(outputs.len(), OUTPUT_LIMIT + 2);
    for (n, output) in outputs[..OUTPUT_LIMIT].iter().enumerate() {
        assert_eq!(*output, format!("values Belt.sequence={n}"));
    }
    assert_eq!(outputs[OUTPUT_LIMIT], "close 1008: 65536 outputs were not fetched");

    let mut server = serving();
    let value = [(register("Belt.run"), crate::value::Value::Bool(true))];
    assert_eq!((0..OUTPUT_LIMIT + 10).filter(|_| server.send(at(0), &value)).count(), OUTPUT_LIMIT);
    let outputs = server_outputs(&mut server);
    assert_eq!(outputs[OUTPUT_LIMIT], "close 1008: 65536 outputs were not fetched");
}

#[test]
fn more_messages_in_a_second_than_the_limit_close_the_connection() {
    let limits = Limits { messages_a_second: 10, ..Limits::default() };
    let mut client = established_as(ClientSettings { limits, ..ClientSettings::new("run 1") });
    let mut server = Server::new(ServerSettings { limits, ..ServerSettings::new("automation") }, map());
    for _ in 0..20 {
        client.handle(at(0), Input::Binary);
        server.handle(at(0), Input::Binary);
    }
    let close = "close 1008: more than 10 messages came within a second";
    let client_said = client_outputs(&mut client);
    assert!(client_said.iter().any(|said| said == close), "{client_said:?}");
    let server_said = server_outputs(&mut server);
    assert!(server_said.iter().any(|said| said == close), "{server_said:?}");
}

#[test]
fn more_values_in_a_message_than_the_limit_are_refused_whole() {
    let limits = Limits { values: 2, ..Limits::default() };
    let mut client = established_as(ClientSettings { limits, ..ClientSettings::new("run 1") });
    let entry = r#"{"name":"Belt.run","value":true}"#;
    let text = format!(r#"{{"SendValue":[{entry},{entry},{entry}]}}"#);
    let expect = format!("rejected {text}: the message holds 3 values, more than the limit of 2");
    check_client(&mut client, at(0), Input::Text(&text), &[&expect]);
}
