//! The rules under "Values".

use super::*;
use crate::value::Value;
use crate::wire::Message;

/// What the client says to a `SendValue` of these entries.
#[track_caller]
fn check(entries: &str, expect: &[&str]) {
    check_client(&mut established(), at(0), Input::Text(&send_value(entries)), expect);
}

/// That one bad value is refused with `result` and `message`, and sets nothing.
#[track_caller]
fn refused(name: &str, value: &str, result: i64, message: &str) {
    let mut client = established();
    let text = send_value(&format!(r#"{{"name":"{name}","value":{value}}}"#));
    client.handle(at(0), Input::Text(&text));
    let rejected = format!("rejected {text}: {name}: {message} ({result})");
    let quoted = serde_json::json!(message);
    let reply = format!(r#"→ {{"SendValueReply":[{{"name":"{name}","result":{result},"message":{quoted}}}]}}"#);
    assert_eq!(client_outputs(&mut client), [rejected, reply]);
}

#[test]
fn good_entries_act_though_others_are_bad_and_all_faults_stand_in_one_reply() {
    check(
        r#"{"name":"Belt.run","value":1},{"name":"Belt.small","value":7},{"name":"Belt.speed","value":1},{"name":"Belt.recipe","value":"T0s="}"#,
        &[
            "values Belt.small=7 Belt.recipe='OK'",
            r#"→ {"SendValueReply":[{"name":"Belt.run","result":415,"message":"expected BOOL, true or false, found a number, 1"},{"name":"Belt.speed","result":404,"message":"no signal of this name"}]}"#,
        ],
    );
}

#[test]
fn a_message_without_a_fault_is_not_answered() {
    check(r#"{"name":"Belt.run","value":true}"#, &["values Belt.run=true"]);
    let text = send_value(r#"{"name":"Belt.echo","value":1}"#);
    check_server(&mut serving(), at(0), Input::Text(&text), &["values Belt.echo=1"]);
}

#[test]
fn setting_a_signal_that_the_receiver_itself_reports_is_404() {
    refused("Belt.velocityActual", "0.5", 404, "reported by the simulation");
    let text = send_value(r#"{"name":"Belt.run","value":true}"#);
    let expect = [
        &format!("rejected {text}: Belt.run: set by the automation (404)"),
        r#"→ {"SendValueReply":[{"name":"Belt.run","result":404,"message":"set by the automation"}]}"#,
    ];
    check_server(&mut serving(), at(0), Input::Text(&text), &expect);
}

#[test]
fn an_unknown_name_is_404_and_a_similar_one_is_named() {
    refused("Belt.Run", "true", 404, "no signal of this name; did you mean \"Belt.run\"?");
    refused("Belt.velocityTraget", "1", 404, "no signal of this name; did you mean \"Belt.velocityTarget\"?");
    refused("run", "true", 404, "no signal of this name");
    refused("", "true", 404, "no signal of this name");
}

#[test]
fn one_point_zero_is_an_integer() {
    check(r#"{"name":"Belt.motorDirection","value":1.0}"#, &["values Belt.motorDirection=1"]);
}

#[test]
fn null_an_object_and_a_missing_value_are_415() {
    refused("Belt.small", "null", 415, "expected SINT, a whole number, found null");
    refused("Belt.small", "{}", 415, "expected SINT, a whole number, found an object, {}");
    let text = send_value(r#"{"name":"Belt.small"}"#);
    let expect = [
        &format!("rejected {text}: Belt.small: expected SINT, found no value (415)"),
        r#"→ {"SendValueReply":[{"name":"Belt.small","result":415,"message":"expected SINT, found no value"}]}"#,
    ];
    check_client(&mut established(), at(0), Input::Text(&text), &expect);
}

#[test]
fn an_entry_without_a_name_is_logged() {
    check(
        r#"{"value":1},{"name":"Belt.small","value":7},{"name":null,"value":2}"#,
        &["notice: 2 entries of a SendValue had no name", "values Belt.small=7"],
    );
    let text = send_value("5");
    let expect =
        ["notice: 1 entries of a SendValue had no name", &format!("rejected {text}: 1 entries without a name")];
    check_client(&mut established(), at(0), Input::Text(&text), &expect);
}

#[test]
fn ten_to_the_four_hundredth_is_422() {
    refused("Belt.velocityTarget", "1e400", 422, "1e400 is outside REAL, at most 3.4028234663852886e38 either way");
}

#[test]
fn a_value_outside_its_iec_type_is_422() {
    refused("Belt.small", "128", 422, "128 is outside SINT, -128 to 127");
}

#[test]
fn a_fraction_for_an_integer_type_is_422() {
    refused("Belt.small", "0.5", 422, "expected SINT, a whole number, found 0.5");
}

#[test]
fn a_string_that_is_no_base64_is_422() {
    refused("Belt.recipe", r#""a b""#, 422, "expected STRING, as base64, found \"a b\"");
}

#[test]
fn a_value_in_its_type_and_outside_the_declared_range_is_422() {
    refused("Belt.motorDirection", "5", 422, "5 is outside this signal's range, -1 to 1");
    refused("Belt.velocityTarget", "-0.11", 422, "-0.11 is outside this signal's range, -0.1 to 0.1 m/s");
    refused("Belt.matrix", "[0, 1, 10]", 422, "10 is outside this signal's range, 0 to 9");
    refused("Belt.delay", "2000.001", 422, "T#2000.001ms is outside this signal's range, 0 to 2 s");
    check(r#"{"name":"Belt.delay","value":2000}"#, &["values Belt.delay=T#2000ms"]);
    // The REAL nearest to 0.1 is a little more than 0.1, and yet the bound itself.
    check(r#"{"name":"Belt.velocityTarget","value":0.1}"#, &["values Belt.velocityTarget=0.1"]);
}

#[test]
fn of_one_name_twice_in_a_message_the_last_wins() {
    check(
        r#"{"name":"Belt.small","value":1},{"name":"Belt.run","value":true},{"name":"Belt.small","value":2}"#,
        &["values Belt.small=2 Belt.run=true"],
    );
    // The last good one: a bad entry is answered and sets nothing.
    let mut client = established();
    let text = send_value(r#"{"name":"Belt.small","value":1},{"name":"Belt.small","value":null}"#);
    client.handle(at(0), Input::Text(&text));
    assert_eq!(client_outputs(&mut client)[0], "values Belt.small=1");
}

#[test]
fn two_messages_that_set_one_signal_are_two_events_in_order() {
    let mut client = established();
    for value in [1, 2, 1] {
        client.handle(at(0), Input::Text(&send_value(&format!(r#"{{"name":"Belt.small","value":{value}}}"#))));
    }
    assert_eq!(client_outputs(&mut client), ["values Belt.small=1", "values Belt.small=2", "values Belt.small=1"]);
}

#[test]
fn an_accepted_message_keeps_its_text_as_one_line() {
    let mut client = established();
    let text = "\n{ \"SendValue\" : [\r\n\t{\"name\":\"Belt.run\", \"value\": true},{\"name\":\"x\"}\n] }\n";
    client.handle(at(0), Input::Text(text));
    let Some(Output::Event(ClientEvent::Values(staged))) = client.poll() else { panic!("no values") };
    assert_eq!(staged.text, "{ \"SendValue\" : [  \t{\"name\":\"Belt.run\", \"value\": true},{\"name\":\"x\"} ] }");
    assert_eq!(staged.faults.len(), 1);
    assert!(Message::decode(&staged.text).is_ok());
}

#[test]
fn nan_and_the_infinities_are_refused_at_the_sender_with_the_signals_name() {
    let mut client = established();
    let values = [(register("Belt.velocityActual"), Value::Real(f32::NAN)), (register("Belt.echo"), Value::Lint(7))];
    assert!(client.send(at(0), &values));
    let expect = [
        "unsendable: Belt.velocityActual was not sent: NaN has no JSON form",
        r#"→ {"SendValue":[{"name":"Belt.echo","value":7}]}"#,
    ];
    assert_eq!(client_outputs(&mut client), expect);
    // With nothing left to say, nothing is said.
    assert!(!client.send(at(0), &values[..1]));
    assert_eq!(client_outputs(&mut client), [expect[0]]);

    let mut server = serving();
    server.send(at(0), &[(register("Belt.velocityTarget"), Value::Real(f32::INFINITY))]);
    let expect = ["unsendable: Belt.velocityTarget was not sent: inf has no JSON form"];
    assert_eq!(server_outputs(&mut server), expect);
}

#[test]
fn each_side_sends_its_own_signals_only() {
    let mut client = established();
    assert!(!client.send(at(0), &[(register("Belt.run"), Value::Bool(true))]));
    let expect = ["unsendable: Belt.run is the other side's to set, and was not sent"];
    assert_eq!(client_outputs(&mut client), expect);
}

#[test]
fn values_of_one_call_travel_in_one_message_in_their_order() {
    let mut server = serving();
    let values = [
        (register("Belt.run"), Value::Bool(true)),
        (register("Belt.matrix"), Value::Array([1.0, 2.5, 1e-14].map(Value::Lreal).into())),
        (register("Belt.small"), Value::Sint(-1)),
    ];
    assert!(server.send(at(0), &values));
    let text = r#"→ {"SendValue":[{"name":"Belt.run","value":true},{"name":"Belt.matrix","value":[1.0,2.5,1e-14]},{"name":"Belt.small","value":-1}]}"#;
    assert_eq!(server_outputs(&mut server), [text]);
}

#[test]
fn a_send_value_reply_is_given_to_the_owner_and_never_answered() {
    let text = r#"{"SendValueReply":[{"name":"Belt.echo","result":415,"message":"found null"}]}"#;
    let expect = ["faults <Belt.echo: found null (415)>"];
    check_client(&mut established(), at(0), Input::Text(text), &expect);
    check_server(&mut serving(), at(0), Input::Text(text), &expect);
}

#[test]
fn a_megabyte_of_faults_is_not_answered_with_four() {
    let mut client = established();
    let text = send_value(&vec![r#"{"name":"a","value":1}"#; 45_000].join(","));
    client.handle(at(0), Input::Text(&text));
    let replies: Vec<String> = std::iter::from_fn(|| client.poll())
        .filter_map(|o| if let Output::Transmit(t) = o { Some(t) } else { None })
        .collect();
    let [reply] = &replies[..] else { panic!("{} replies", replies.len()) };
    assert!(reply.len() <= 512 * 1024, "{} bytes", reply.len());
    let Ok(Message::SendValueReply(faults)) = Message::decode(reply) else { panic!("no SendValueReply") };
    let last = faults.last().expect("a fault");
    assert_eq!(last.message, format!("{} more faults are not listed", 45_000 - (faults.len() - 1)));
}
