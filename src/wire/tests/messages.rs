//! Messages of every type there and back, and what is refused and with what words.

use std::borrow::Cow;
use std::time::Duration;

use proptest::prelude::*;

use super::texts;
use crate::value::{ElementaryType, SignalType, Value};
use crate::wire::*;

#[test]
fn connection_reply_is_another_name_of_connect_reply() {
    let body = r#"{"Id":"T0s=","enable":true,"ServerName":"T0s=","result":200}"#;
    let (short, long) = (format!("{{\"ConnectReply\":{body}}}"), format!("{{\"ConnectionReply\":{body}}}"));
    assert!(matches!(Message::decode(&short), Ok(Message::ConnectReply(_))));
    assert_eq!(Message::decode(&long), Message::decode(&short));
}

#[test]
fn query_all_may_have_any_empty_body() {
    for body in ["{}", "null", "[]", " { } "] {
        assert_eq!(Message::decode(&format!("{{\"QueryAll\":{body}}}")), Ok(Message::QueryAll), "{body}");
    }
    assert_eq!(Message::QueryAll.encode(), r#"{"QueryAll":{}}"#);
}

#[test]
fn messages_of_ours_read_back_as_they_were_written() {
    let check = |message: Message<'_>, text: &str| {
        assert_eq!(message.encode(), text);
        assert_eq!(Message::decode(text), Ok(message));
    };
    let selection = |name: &str, us| SignalSelection { name: name.to_owned(), min_interval: Duration::from_micros(us) };
    let signals = Some(vec![selection("A.x", 20_000), selection("A.y", 500), selection("A.z", 0)]);
    check(
        Message::Connect(Connect { id: "T0s=".into(), enable: true, signals }),
        r#"{"Connect":{"Id":"T0s=","enable":true,"Signals":[{"name":"A.x","minInterval":20},{"name":"A.y","minInterval":0.5},{"name":"A.z","minInterval":0}]}}"#,
    );
    check(
        Message::ConnectReply(ConnectReply {
            id: "T0s=".into(),
            enable: false,
            server_name: "".into(),
            result: ResultCode::NOT_FOUND,
            message: Some("no \"such\" session".into()),
        }),
        r#"{"ConnectReply":{"Id":"T0s=","enable":false,"ServerName":"","result":404,"message":"no \"such\" session"}}"#,
    );
    let fault = Fault { name: "A.x".into(), result: ResultCode::WRONG_TYPE, message: "found null".into() };
    check(
        Message::SendValueReply(vec![fault]),
        r#"{"SendValueReply":[{"name":"A.x","result":415,"message":"found null"}]}"#,
    );
    let signal = |name: &str, ty: &str| InterfaceSignal { name: name.to_owned(), ty: ty.to_owned() };
    check(
        Message::QueryAllReply(Interface {
            server_name: "T0s=".into(),
            result: ResultCode::OK,
            inputs: vec![signal("A.x", "REAL[16]"), signal("A.y", "BOOL")],
            outputs: vec![],
        }),
        r#"{"QueryAllReply":{"ServerName":"T0s=","result":200,"inputs":[{"name":"A.x","type":"REAL[16]"},{"name":"A.y","type":"BOOL"}],"outputs":[]}}"#,
    );
}

#[test]
fn unknown_members_are_ignored_and_of_two_the_last_counts() {
    let text = r#"{"Connect":{"more":[{"deep":null}],"Id":"QQ==","enable":false,"Id":"T0s=","enable":true}}"#;
    let connect = Connect { id: "T0s=".into(), enable: true, signals: None };
    assert_eq!(Message::decode(text), Ok(Message::Connect(connect)));
}

#[test]
fn entries_keep_what_they_have() {
    let text = r#"{"SendValue":[{"name":"a","value":1e400,"unit":"m"},{"value":1},{"name":7,"value":[1]},{"na\u006de":"b"},5,{}]}"#;
    let Ok(Message::SendValue(entries)) = Message::decode(text) else { panic!("no SendValue") };
    let seen: Vec<_> =
        entries.iter().map(|entry| (entry.name.as_deref(), entry.value.map(|value| value.text()))).collect();
    let expect = [
        (Some("a"), Some("1e400")),
        (None, Some("1")),
        (None, Some("[1]")),
        (Some("b"), None),
        (None, None),
        (None, None),
    ];
    assert_eq!(seen, expect);
}

#[test]
fn a_send_value_reply_of_another_form_is_quoted() {
    let check = |body: &str, expect: &[(&str, i64, &str)]| {
        let text = format!("{{\"SendValueReply\":{body}}}");
        let Ok(Message::SendValueReply(faults)) = Message::decode(&text) else { panic!("{text}") };
        let seen: Vec<_> = faults.iter().map(|f| (f.name.as_str(), f.result.0, f.message.as_str())).collect();
        assert_eq!(seen, expect, "{text}");
    };
    check(r#"{"name":"A.x","result":404}"#, &[("A.x", 404, r#"{"name":"A.x","result":404}"#)]);
    check(r#"["A.x"]"#, &[("", 0, "\"A.x\"")]);
    check("500", &[("", 0, "500")]);
    check("[]", &[]);
}

#[track_caller]
fn refused(text: &str, expect: &str) {
    assert_eq!(Message::decode(text).expect_err(text).to_string(), expect, "{text}");
}

#[test]
fn what_is_no_message_is_refused_with_the_reason() {
    const NAMES: &str = "Connect, ConnectReply, SendValue, SendValueReply, QueryAll, QueryAllReply";
    refused("{}", "expected an object with one key, the message's type, found an empty object");
    refused("[]", "expected an object with one key, the message's type, found an array, []");
    refused("7", "expected an object with one key, the message's type, found a number, 7");
    refused("", "malformed JSON at byte 0: expected a value, found the end of the text");
    refused(r#"{"Hello":1}"#, &format!("\"Hello\" is no message of the protocol: expected one of {NAMES}"));
    refused(r#"{"connect":{}}"#, &format!("\"connect\" is no message of the protocol: expected one of {NAMES}"));
    refused(
        r#"{"QueryAll":{},"Connect":{}}"#,
        "expected an object with one key, the message's type, found \"QueryAll\" and \"Connect\"",
    );
    refused(
        r#"{"Hello":{},"Hello":{}}"#,
        "expected an object with one key, the message's type, found \"Hello\" and \"Hello\"",
    );
    refused(r#"{"QueryAll":{}} x"#, "malformed JSON at byte 16: expected nothing more, found 'x'");
    refused(
        r#"{"SendValue":[{"name":"a","value":01}]}"#,
        "malformed JSON at byte 35: expected a comma or the object's closing brace, found '1'",
    );
    // Refused for its body, and still read to the end: what follows must be JSON all the same.
    refused(
        r#"{"Connect":5"#,
        "malformed JSON at byte 12: expected a comma or the object's closing brace, found the end of the text",
    );
}

#[test]
fn a_body_that_lacks_something_says_what() {
    refused(r#"{"Connect":null}"#, "Connect expects an object, found null");
    refused(r#"{"Connect":{"enable":true}}"#, "Connect has no \"Id\"");
    refused(r#"{"Connect":{"Id":"T0s="}}"#, "Connect has no \"enable\"");
    refused(
        r#"{"Connect":{"Id":"T0s=","enable":1}}"#,
        "Connect expects true or false as \"enable\", found a number, 1",
    );
    refused(r#"{"Connect":{"Id":1,"enable":true}}"#, "Connect expects a string as \"Id\", found a number, 1");
    refused(
        r#"{"Connect":{"Id":"","enable":true,"Signals":[{"name":"a","minInterval":-1}]}}"#,
        "Connect expects a number of milliseconds, 0 or more, as \"minInterval\", found a number, -1",
    );
    refused(r#"{"ConnectReply":{"Id":"T0s=","enable":true}}"#, "ConnectReply has no \"result\"");
    refused(
        r#"{"ConnectionReply":{"Id":"T0s=","enable":true,"result":"200"}}"#,
        "ConnectReply expects a whole number as \"result\", found a string, \"200\"",
    );
    refused(r#"{"SendValue":{"name":"a"}}"#, r#"SendValue expects an array of entries, found an object, {"name":"a"}"#);
    refused(r#"{"QueryAll":1}"#, "QueryAll expects an empty body, found a number, 1");
    refused(
        r#"{"QueryAllReply":{"result":200,"inputs":5}}"#,
        "QueryAllReply expects an array as \"inputs\", found a number, 5",
    );
}

#[test]
fn json_nested_deeper_than_thirty_two_is_refused() {
    let message = |depth: usize| {
        format!(r#"{{"SendValue":[{{"name":"a","value":{}{}}}]}}"#, "[".repeat(depth - 3), "]".repeat(depth - 3))
    };
    assert!(Message::decode(&message(32)).is_ok());
    assert_eq!(Message::decode(&message(33)), Err(DecodeError::Json(ScanError::TooDeep { at: 63 })));
}

#[test]
fn a_line_of_a_trace_is_taken_apart() {
    let line = r#"{"t":0.020,"from":"automation","SendValue":[{"name":"Conveyor1.velocityTarget","value":0.5}]}"#;
    let members = members(line).expect("an object");
    let names: Vec<_> = members.iter().map(|(name, _)| name.as_ref()).collect();
    assert_eq!(names, ["t", "from", "SendValue"]);
    assert_eq!(members[0].1.as_number(), Some("0.020"));
    let Ok(Message::SendValue(entries)) = Message::from_member("SendValue", members[2].1) else { panic!("{line}") };
    assert_eq!(entries[0].value.map(|value| value.text()), Some("0.5"));
    assert!(matches!(Message::from_member("t", members[0].1), Err(DecodeError::UnknownType { .. })));
}

#[test]
fn a_send_value_without_values_is_not_sent() {
    let mut text = SendValueText::with_capacity(1);
    assert!(text.push("A.x", &Value::Lreal(f64::NAN)).is_err());
    assert_eq!((text.entries(), text.finish()), (0, None));
}

/// Texts that look like messages.
fn nearly_messages() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(vec![
        "{",
        "}",
        "[",
        "]",
        ":",
        ",",
        "\"Connect\"",
        "\"ConnectReply\"",
        "\"SendValue\"",
        "\"SendValueReply\"",
        "\"QueryAll\"",
        "\"QueryAllReply\"",
        "\"Id\"",
        "\"enable\"",
        "\"result\"",
        "\"name\"",
        "\"value\"",
        "\"inputs\"",
        "\"ts\"",
        "\"Param\"",
        "true",
        "null",
        "1",
        "-1.5e3",
        "1e400",
        "\"T0s=\"",
        "\"\\ud800\"",
        "é",
        " ",
    ]);
    prop::collection::vec(piece, 0..24).prop_map(|pieces| pieces.concat())
}

/// Any message of the protocol, with any texts in it. Values of a `SendValue` have a property of their own.
fn messages() -> impl Strategy<Value = Message<'static>> {
    let code = || any::<i64>().prop_map(ResultCode);
    let selection =
        (texts(), any::<u64>()).prop_map(|(name, ns)| SignalSelection { name, min_interval: Duration::from_nanos(ns) });
    let selections = prop::option::of(prop::collection::vec(selection, 0..4));
    let connect = (texts(), any::<bool>(), selections)
        .prop_map(|(id, enable, signals)| Message::Connect(Connect { id: id.into(), enable, signals }));
    let reply = (texts(), any::<bool>(), texts(), code(), prop::option::of(texts()));
    let reply = reply.prop_map(|(id, enable, name, result, message)| {
        let (id, server_name, message) = (id.into(), name.into(), message.map(Cow::Owned));
        Message::ConnectReply(ConnectReply { id, enable, server_name, result, message })
    });
    let fault = (texts(), code(), texts()).prop_map(|(name, result, message)| Fault { name, result, message });
    let faults = prop::collection::vec(fault, 0..4).prop_map(Message::SendValueReply);
    let signal = || (texts(), texts()).prop_map(|(name, ty)| InterfaceSignal { name, ty });
    let side = || prop::collection::vec(signal(), 0..4);
    let interface = (texts(), code(), side(), side()).prop_map(|(server_name, result, inputs, outputs)| {
        Message::QueryAllReply(Interface { server_name, result, inputs, outputs })
    });
    prop_oneof![connect, reply, faults, interface, Just(Message::QueryAll)]
}

proptest! {
    #[test]
    fn no_text_makes_a_reader_panic(text in prop_oneof![texts(), nearly_messages()]) {
        if let Err(error) = Message::decode(&text) {
            prop_assert!(!error.to_string().is_empty());
        }
        let _ = members(&text);
        let _ = io_data::decode(&text);
    }

    #[test]
    fn every_message_reads_back_as_it_was_written(message in messages()) {
        let text = message.encode();
        prop_assert_eq!(Message::decode(&text), Ok(message), "{}", text);
    }

    #[test]
    fn a_send_value_brings_back_names_and_values(values in prop::collection::vec((texts(), any::<f32>()), 1..9)) {
        let mut text = SendValueText::with_capacity(values.len());
        let mut expect = Vec::new();
        for (name, number) in &values {
            match text.push(name, &Value::Real(*number)) {
                Ok(()) => expect.push((Some(Cow::Borrowed(name.as_str())), Ok(Value::Real(*number)))),
                Err(_) => prop_assert!(!number.is_finite()),
            }
        }
        let text = text.finish();
        prop_assert_eq!(text.is_none(), expect.is_empty());
        let Some(text) = text else { return Ok(()) };
        let Ok(Message::SendValue(entries)) = Message::decode(&text) else { panic!("{text}") };
        let real = SignalType::scalar(ElementaryType::Real);
        let seen: Vec<_> = entries
            .into_iter()
            .map(|entry| (entry.name, read_value(entry.value.expect("a value"), real, TextForm::Base64)))
            .collect();
        prop_assert_eq!(seen, expect);
    }
}
