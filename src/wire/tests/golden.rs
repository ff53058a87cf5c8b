//! The messages printed in the reference (section 5.3), byte for byte once blanks and the spelling of numbers are made one.

use crate::value::Value;
use crate::wire::io_data::{self, PayloadText};
use crate::wire::*;

/// The text without blanks outside of strings, and its numbers as f64 has them (`9` and `9.0` are one).
fn normalised(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let taken = match c {
            '"' => {
                let quote = rest[1..].find('"').expect("no quotes are escaped here") + 2;
                out.push_str(&rest[..quote]);
                quote
            }
            '-' | '0'..='9' => {
                let end = rest.find(|c: char| !c.is_ascii_digit() && !".eE+-".contains(c)).unwrap_or(rest.len());
                out.push_str(&rest[..end].parse::<f64>().expect("a number").to_string());
                end
            }
            c => {
                out.extend(Some(c).filter(|c| !c.is_whitespace()));
                c.len_utf8()
            }
        };
        rest = &rest[taken..];
    }
    out
}

/// The `Id` and the `ServerName` of the reference's examples.
const ID: &str = "U2ltQ2xpZx50IHFwNDEyIHRlc3RTaW1DJ25BcHAgcjEwMjY=";
const SERVER_NAME: &str = "VGVzdEpzb25Xc1NpbUNvbm5lY3Rpb24=";

#[track_caller]
fn golden(printed: &str, message: Message<'_>) {
    assert_eq!(Message::decode(printed).as_ref(), Ok(&message));
    assert_eq!(normalised(&message.encode()), normalised(printed));
}

fn connect(enable: bool) -> Message<'static> {
    Message::Connect(Connect { id: ID.into(), enable, signals: None })
}

fn connect_reply(enable: bool) -> Message<'static> {
    Message::ConnectReply(ConnectReply {
        id: ID.into(),
        enable,
        server_name: SERVER_NAME.into(),
        result: ResultCode::OK,
        message: None,
    })
}

#[test]
fn reference_connect() {
    let printed = r#"
{
  "Connect" : {
    "Id" : "U2ltQ2xpZx50IHFwNDEyIHRlc3RTaW1DJ25BcHAgcjEwMjY=",
    "enable" : true
  }
}
"#;
    golden(printed, connect(true));
}

#[test]
fn reference_connect_to_close() {
    let printed = r#"
{
  "Connect" : {
    "Id" : "U2ltQ2xpZx50IHFwNDEyIHRlc3RTaW1DJ25BcHAgcjEwMjY=",
    "enable" : false
  }
}
"#;
    golden(printed, connect(false));
}

#[test]
fn reference_connect_reply() {
    let printed = r#"
{
  "ConnectReply" : {
    "Id" : "U2ltQ2xpZx50IHFwNDEyIHRlc3RTaW1DJ25BcHAgcjEwMjY=",
    "enable" : true,
    "ServerName" : "VGVzdEpzb25Xc1NpbUNvbm5lY3Rpb24=",
    "result" : 200
  }
}
"#;
    golden(printed, connect_reply(true));
}

#[test]
fn reference_connect_reply_to_close() {
    let printed = r#"
{
  "ConnectReply" : {
    "Id" : "U2ltQ2xpZx50IHFwNDEyIHRlc3RTaW1DJ25BcHAgcjEwMjY=",
    "enable" : false,
    "ServerName" : "VGVzdEpzb25Xc1NpbUNvbm5lY3Rpb24=",
    "result" : 200
  }
}
"#;
    golden(printed, connect_reply(false));
    assert_eq!(from_base64(SERVER_NAME), "TestJsonWsSimConnection");
}

#[test]
fn reference_send_value() {
    let printed = r#"
{
  "SendValue" : [
    {
      "name" : "TC1.Position",
      "value" : 0.5776
    },
    {
      "name" : "TC1.H1matrix",
      "value" : [ 9, 1, -23.4, 1e-14 ]
    },
    {
      "name" : "TC1.status",
      "value" : "T0s="
    }
  ]
}
"#;
    let matrix = [9.0, 1.0, -23.4, 1e-14].map(Value::Real);
    let values = [
        ("TC1.Position", Value::Real(0.5776)),
        ("TC1.H1matrix", Value::Array(matrix.into())),
        ("TC1.status", Value::String((*b"OK").into())),
    ];
    let mut text = SendValueText::with_capacity(values.len());
    for (name, value) in &values {
        text.push(name, value).expect("a value with a JSON form");
    }
    assert_eq!(normalised(&text.finish().expect("a message")), normalised(printed));

    let Ok(Message::SendValue(entries)) = Message::decode(printed) else { panic!("no SendValue") };
    let read = entries.iter().zip(&values).map(|(entry, (_, value))| {
        let raw = entry.value.expect("a value");
        (
            entry.name.as_deref().expect("a name"),
            read_value(raw, value.signal_type(), TextForm::Base64).expect("a value"),
        )
    });
    assert_eq!(read.collect::<Vec<_>>(), values);
}

#[track_caller]
fn golden_payload(printed: &str, block: &str, signals: &[(&str, Value)]) {
    let mut payload = PayloadText::new();
    let mut text = payload.function_block(block, 0);
    for (name, value) in signals {
        text.signal(name, value).expect("a value with a JSON form");
    }
    assert_eq!(normalised(&payload.finish().expect("a payload")), normalised(printed));

    let blocks = io_data::decode(printed).expect("a payload");
    assert_eq!((blocks.len(), blocks[0].name.as_ref(), blocks[0].timestamp_ms), (1, block, 0));
    for ((name, raw), (expect_name, expect)) in blocks[0].signals.iter().zip(signals) {
        let value = read_value(*raw, expect.signal_type(), TextForm::Plain);
        assert_eq!((name.as_ref(), value.as_ref()), (*expect_name, Ok(expect)));
    }
}

#[test]
fn reference_payload_of_a_pusher() {
    let printed = r#"
{
  "Field_QSS.PusherA": {
    "ts": 0,
    "Param": {
      "command": 1
    }
  }
}
"#;
    golden_payload(printed, "Field_QSS.PusherA", &[("command", Value::Int(1))]);
}

#[test]
fn reference_payload_of_a_cartesian_robot() {
    let printed = r#"
{
  "FI_QDP.FieldInterface_Cartesia": {
    "ts": 0,
    "Param": {
      "XTarget": 900.0,
      "YTarget": 800.0,
      "ZTarget": 300.0,
      "RTarget": 0.0
    }
  }
}
"#;
    let targets = [("XTarget", 900.0), ("YTarget", 800.0), ("ZTarget", 300.0), ("RTarget", 0.0)];
    golden_payload(printed, "FI_QDP.FieldInterface_Cartesia", &targets.map(|(name, v)| (name, Value::Real(v))));
}
