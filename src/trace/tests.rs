//! What a trace must read as, and what it must not.

use std::collections::VecDeque;
use std::io::Cursor;
use std::time::Duration;

use proptest::prelude::*;

use super::*;
use crate::bank;
use crate::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use crate::time::Instant;
use crate::value::{Unit, Value};
use crate::wire::Message;

const HEADER: &str = r#"{"trace":"kinetwin/1","source":"plant","model":"models/rig"}"#;

fn reader(text: &[u8]) -> Result<Reader<Cursor<Vec<u8>>>, TraceError> {
    Reader::new("x.cps.jsonl", Cursor::new(text.to_vec()))
}

/// Reads all lines; each as its milliseconds, its sender and what it is.
fn read_all(text: &[u8]) -> Result<(Vec<String>, Option<Torn>), TraceError> {
    let mut reader = reader(text)?;
    let mut lines = Vec::new();
    while let Some(line) = reader.next_line()? {
        let body = match &line.body {
            Body::Message(Message::SendValue(entries)) => {
                let entry = |e: &crate::wire::Entry<'_>| {
                    format!("{}={}", e.name.as_deref().unwrap_or("-"), e.value.map_or("-", |value| value.text()))
                };
                entries.iter().map(entry).collect::<Vec<_>>().join(" ")
            }
            Body::Message(message) => message.name().to_owned(),
            Body::Refused { reason } => format!("refused: {reason}"),
            Body::Event(event) => format!("event {}", event.text()),
        };
        lines.push(format!("{} {} {body}", line.at.nanos() as f64 / 1e6, line.from));
    }
    Ok((lines, reader.torn().cloned()))
}

fn check(lines: &str, expect: &[&str]) {
    let (read, torn) = read_all(format!("{HEADER}\n{lines}").as_bytes()).expect("a trace");
    assert_eq!(read, expect);
    assert_eq!(torn, None);
}

/// The last of `lines` is malformed at this column, and there is one more after it.
fn check_malformed(lines: &str, column: usize, part: &str) {
    let text = format!("{HEADER}\n{lines}\n{{\"t\":9,\"from\":\"plant\",\"SendValue\":[]}}\n");
    let error = read_all(text.as_bytes()).expect_err(lines).to_string();
    let place = format!("x.cps.jsonl:{}:{column}: ", lines.lines().count().max(1) + 1);
    assert!(error.starts_with(&place) && error.contains(part), "{lines}\n{error}");
}

#[test]
fn lines_are_messages_with_a_time_and_a_sender() {
    check(
        r#"{"t":0.0,"from":"automation","SendValue":[{"name":"a","value":1.5}]}
{"t":0,"from":"plant","SendValue":[{"name":"b","value":true},{"name":"c","value":[1,2]},{"value":1},{"name":"d"}]}
{"from":"plant","Connect":{"Id":"eA==","enable":true},"t":0.020}
{"t":0.0200001,"from":"automation","ConnectReply":{"Id":"eA==","enable":true,"ServerName":"eA==","result":200}}
{"t":1e3,"from":"operator","Event":{"pause":true}}
{"t":1000,"from":"engine","Event":{}, "seq": 7}
"#,
        &[
            "0 automation a=1.5",
            "0 plant b=true c=[1,2] -=1 d=-",
            "20 plant Connect",
            "20.0001 automation ConnectReply",
            "1000000 operator event {\"pause\":true}",
            "1000000 engine event {}",
        ],
    );
    check("", &[]);
}

#[test]
fn a_refused_message_is_skipped_and_says_why() {
    check(
        r#"{"t":0.0,"from":"automation","SendValues":[]}
{"t":0.0,"from":"automation","SendValue":5}
{"t":0.0,"from":"automation","Unreadable":"garb\"age"}
"#,
        &[
            "0 automation refused: \"SendValues\" is no message of the protocol",
            "0 automation refused: SendValue expects an array of entries, found a number, 5",
            "0 automation refused: \"Unreadable\" is no message of the protocol",
        ],
    );
}

#[test]
fn a_malformed_line_is_named_with_its_column() {
    check_malformed(r#"{"t":0.0,"from":"plant","SendVal"#, 33, "malformed JSON: expected the string's closing quote");
    check_malformed(r#"{"t":0.0,"from":"plant","SendValue":[}"#, 38, "expected a value");
    check_malformed("", 1, "expected");
    check_malformed("[]", 1, "expected an object");
    check_malformed(r#"{"from":"plant","SendValue":[]}"#, 1, "no time");
    check_malformed(r#"{"t":"0","from":"plant","SendValue":[]}"#, 6, "\"t\" is a string");
    check_malformed(r#"{"t":-1,"from":"plant","SendValue":[]}"#, 6, "before the start");
    check_malformed(r#"{"t":1e99,"from":"plant","SendValue":[]}"#, 6, "expected seconds");
    check_malformed(r#"{"t":0,"SendValue":[]}"#, 1, "no sender: expected \"from\", one of automation");
    check_malformed(r#"{"t":0,"from":"me","SendValue":[]}"#, 15, "expected one of automation, operator");
    check_malformed(r#"{"t":0,"from":"plant"}"#, 1, "no message");
    check_malformed(r#"{"t":0,"from":"operator","SendValue":[]}"#, 38, "the operator sends \"Event\"");
    check_malformed(r#"{"t":0,"from":"plant","SendValue":[],"QueryAll":{}}"#, 49, "two messages in one line");
    check_malformed(
        "{\"t\":2,\"from\":\"plant\",\"SendValue\":[]}\n{\"t\":1.5,\"from\":\"plant\",\"SendValue\":[]}",
        6,
        "time goes back: \"t\" is 1.5 after a line at 2",
    );
    // Columns count characters, not bytes.
    check_malformed(r#"{"from":"äöü","t":0,"SendValue":[]}"#, 9, "expected one of");
    check_malformed(r#"{"x":"äöü","t":"0","from":"plant","SendValue":[]}"#, 16, "\"t\" is a string");
}

#[test]
fn a_torn_last_line_is_lost_alone_and_told() {
    let whole = r#"{"t":0.1,"from":"plant","SendValue":[{"name":"ä","value":1}]}"#;
    let text = format!("{HEADER}\n{whole}\n{whole}");
    let (read, torn) = read_all(text.as_bytes()).expect("a trace");
    assert_eq!((read.len(), torn), (2, None), "a last line that is whole is a line, break or no break");
    let first = HEADER.len() + 1 + whole.len() + 1;
    for cut in first + 1..text.len() {
        let (read, torn) = read_all(&text.as_bytes()[..cut]).expect("a trace");
        assert_eq!(read.len(), 1, "{cut}");
        assert_eq!(torn.map(|torn| torn.line), Some(3), "{cut}");
    }
    let torn = read_all(&text.as_bytes()[..first + 12]).expect("a trace").1.expect("torn").to_string();
    assert!(torn.starts_with("line 3, the last, is torn and was left out: malformed JSON"), "{torn}");
}

#[test]
fn a_file_without_a_header_is_no_trace() {
    let check = |text: &[u8], part: &str| {
        let error = reader(text).err().expect("no trace").to_string();
        assert!(error.starts_with("x.cps.jsonl:1:") && error.contains(part), "{error}");
    };
    check(b"", "an empty file");
    check(b"hello\n", "no header of a trace");
    check(b"\xff\n", "not UTF-8");
    check(b"{\"trace\":\"kinetwin/9\"}\n", "format \"kinetwin/9\"");
    check(&HEADER.as_bytes()[..20], "no header of a trace");
}

/// A header, and 40 lines of the plant's, 10 ms apart.
fn forty_lines(compression: Compression) -> Vec<u8> {
    let header = Header { source: Source::Simulation, ..Header::default() };
    let mut writer = Writer::new(Vec::new(), compression, &header).expect("a header");
    for i in 0..40 {
        let text = format!("{{\"SendValue\":[{{\"name\":\"x\",\"value\":{i}}}]}}");
        writer.message(Instant::from_nanos(i * 10_000_000), Sender::Plant, &text).expect("a line");
        writer.flush().expect("flushed");
    }
    writer.finish().expect("an end")
}

#[test]
fn a_compressed_trace_is_known_by_its_first_bytes() {
    let (plain, compressed) = (forty_lines(Compression::None), forty_lines(Compression::Zstd));
    assert_eq!(read_all(&plain).expect("a trace"), read_all(&compressed).expect("a trace"));
    assert_ne!(plain, compressed);
    // Whatever is missing at its end, the lines before are there.
    let mut fewest = 40;
    for end in (1..compressed.len()).rev() {
        let Ok((read, torn)) = read_all(&compressed[..end]) else { break };
        assert!(read.len() <= fewest && fewest - read.len() <= 1, "{end}: {} after {fewest}", read.len());
        assert!(torn.is_some(), "{end}");
        fewest = read.len();
    }
    assert_eq!(fewest, 1, "the header was compressed with the first line");
    let error = read_all(&compressed[..20]).expect_err("too short").to_string();
    assert_eq!(error, "x.cps.jsonl:1:1: the compressed file is cut short in its header");
}

#[test]
fn a_cut_knows_the_last_value_of_every_signal_before_it() {
    let whole = format!(
        "{HEADER}\n{}",
        r#"{"t":0,"from":"automation","SendValue":[{"name":"go","value":true},{"name":"v","value":0.50}]}
{"t":1,"from":"plant","SendValue":[{"name":"p","value":1},{"name":"b","value":false}]}
{"t":2,"from":"plant","SendValue":[{"name":"p","value":2}]}
{"t":3,"from":"automation","SendValue":[{"name":"v","value":0.75}]}
{"t":4,"from":"plant","SendValue":[{"name":"p","value":4}]}
{"t":5,"from":"plant","SendValue":[{"name":"p","value":5}]}
"#
    );
    let cut_to = |from: f64, to: f64, warm_up: u64| {
        let span = Span {
            from: Instant::from_seconds(from),
            to: Instant::from_seconds(to),
            warm_up: Duration::from_secs(warm_up),
        };
        cut(reader(whole.as_bytes()).expect("a trace"), Vec::new(), Compression::None, span)
    };
    let check = |from: f64, to: f64, warm_up: u64, expect: &[&str]| {
        let cut = cut_to(from, to, warm_up).expect("a cut");
        assert_eq!(read_all(&cut).expect("a trace").0, expect);
        String::from_utf8(cut).expect("UTF-8")
    };
    let text = check(4.0, 4.5, 0, &["3000 automation go=true v=0.75", "3000 plant p=2 b=false", "4000 plant p=4"]);
    assert!(text.contains("\"note\":\"cut from 4s to 4.5s\"") && text.contains("\"model\":\"models/rig\""), "{text}");
    let with_warm_up = check(
        4.0,
        9.0,
        1,
        &[
            "2000 automation go=true v=0.50",
            "2000 plant p=2 b=false",
            "3000 automation v=0.75",
            "4000 plant p=4",
            "5000 plant p=5",
        ],
    );
    assert!(with_warm_up.contains("cut from 4s to 9s with 1s before it"));
    check(0.0, 1.0, 0, &["0 automation go=true v=0.50", "1000 plant p=1 b=false"]);
    assert!(matches!(cut_to(2.5, 2.6, 0), Err(CutError::Outside { .. })));
    assert!(matches!(cut_to(3.0, 2.0, 0), Err(CutError::Empty { .. })));
}

#[test]
fn info_counts_what_stands_in_a_trace() {
    let text = format!(
        "{HEADER}\n{}",
        r#"{"t":0.5,"from":"automation","SendValue":[{"name":"go","value":true}]}
{"t":1,"from":"plant","SendValue":[{"name":"p","value":1},{"name":"go","value":1}]}
{"t":2.25,"from":"plant","Nonsense":0}
{"t":3"#
    );
    let info = info(reader(text.as_bytes()).expect("a trace")).expect("counted");
    assert_eq!((info.lines, info.begins_s, info.ends_s), (3, 0.5, 2.25));
    assert_eq!((info.signals["go"].commands, info.signals["go"].reports), (1, 1));
    assert_eq!(info.senders["plant"], 2);
    assert_eq!(info.messages["Refused"], 1);
    assert!(info.torn.is_some_and(|torn| torn.contains("line 5")));
}

#[test]
fn what_cannot_stand_in_a_line_is_recorded_as_a_string() {
    let mut recorder = Recorder::new(Writer::new(Vec::new(), Compression::None, &Header::default()).expect("header"));
    for text in ["no JSON", "{\"A\":1,\"B\":2}", "[1]", "{\"t\":5}", "{\"Foo\":\n1}", "{\"SendValue\":null}"] {
        let record = Record::Exchanged { from: Sender::Automation, text: text.to_owned() };
        recorder.record(record).expect("recorded");
    }
    let (lines, torn) = read_all(&recorder.finish().expect("an end")).expect("a trace");
    assert_eq!((lines.len(), torn), (6, None));
    assert!(lines[..5].iter().all(|line| line.starts_with("0 automation refused: \"Unreadable\"")), "{lines:?}");
    assert!(lines[5].contains("refused: SendValue expects"), "{lines:?}");
}

/// A command and an edge.
fn map() -> SignalMap {
    let signal = |name: &str, direction| Signal {
        name: name.to_owned(),
        ty: "DINT".parse().expect("a type"),
        direction,
        kind: Kind::Edge,
        rate: RateClass::HighFrequency,
        unit: Unit::ONE,
        min: None,
        max: None,
        instance: String::new(),
        task: String::new(),
        property: String::new(),
    };
    SignalMap::new("two", vec![signal("c", Direction::Command), signal("r", Direction::Report)]).expect("two names")
}

proptest! {
    /// Whatever stands in a file, reading it ends, in lines or in an error.
    #[test]
    fn a_damaged_trace_is_read_or_refused(
        compression in prop::sample::select(vec![Compression::None, Compression::Zstd]),
        damages in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        cut in any::<prop::sample::Index>(),
    ) {
        let mut bytes = forty_lines(compression);
        for (place, byte) in damages {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        bytes.truncate(cut.index(bytes.len()) + 1);
        if let Ok((lines, _)) = read_all(&bytes) {
            prop_assert!(lines.len() <= 40);
        }
    }
}

/// What happens next in a run of two threads.
#[derive(Clone, Copy, Debug)]
enum Turn {
    /// The simulation makes a step.
    Step,
    /// The IO thread stages a message.
    Stage,
    /// The IO thread tells the recorder of what it staged: at once in its own order, later in that of others.
    Tell,
    /// The IO thread sends what changed.
    Look,
    /// Another message passes.
    Exchange,
    /// The recorder takes a record.
    Record,
}

proptest! {
    /// The trace holds every command and every report, each with its step's time, in order, whatever the threads' turns.
    #[test]
    fn a_recorder_joins_two_threads_in_the_order_of_time(
        turns in prop::collection::vec(
            prop::sample::select(
                [Turn::Step, Turn::Stage, Turn::Tell, Turn::Look, Turn::Exchange, Turn::Record].as_slice(),
            ),
            0..120,
        ),
        one_channel in any::<bool>(),
    ) {
        let (mut simulation, mut io) = bank::with_capacity(&map(), 200, 2_000);
        let mut recorder =
            Recorder::new(Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a header"));
        let mut channel = VecDeque::new();
        let (mut of_simulation, mut untold) = (VecDeque::new(), VecDeque::new());
        let (mut step, mut inputs, mut groups) = (0i64, Vec::new(), Vec::new());
        let mut registers = vec![Value::Dint(0), Value::Dint(0)];
        let mut expect: Vec<(i64, Sender, String)> = Vec::new();
        let (mut commands, mut started) = (0, false);
        for turn in turns.into_iter().chain([Turn::Step, Turn::Step, Turn::Look]) {
            match turn {
                Turn::Step => {
                    let at = Instant::from_nanos(step * 1_000_000);
                    if let Some(number) = simulation.take(&mut inputs) {
                        expect.push((step, Sender::Automation, format!("c={number}")));
                        let of_simulation = if one_channel { &mut channel } else { &mut of_simulation };
                        of_simulation.push_back(Record::Taken { at, number });
                    }
                    // An edge in two of three steps.
                    registers[1] = Value::Dint((step - step / 3) as i32);
                    simulation.publish(at, &registers);
                    step += 1;
                }
                Turn::Stage => {
                    // A thread tells before it goes on.
                    channel.extend(untold.drain(..));
                    commands += 1;
                    let values = [(RegisterId(0), Value::Dint(commands))];
                    let number = io.stage(&values).expect("room");
                    let text = format!("{{\"SendValue\":[{{\"name\":\"c\",\"value\":{commands}}}]}}");
                    untold.push_back(Record::Staged { number, text });
                }
                Turn::Tell => channel.extend(untold.drain(..)),
                Turn::Look => {
                    channel.extend(untold.drain(..));
                    if !started {
                        started = io.all_outputs(&mut inputs).is_some();
                        continue;
                    }
                    let reached = io.changed(&mut groups).expect("no overflow").expect("a cycle");
                    for group in &groups {
                        let value = group.values[0].1.to_f64().expect("a number");
                        expect.push((group.at.nanos() / 1_000_000, Sender::Plant, format!("r={value}")));
                        let text = format!("{{\"SendValue\":[{{\"name\":\"r\",\"value\":{value}}}]}}");
                        channel.push_back(Record::Reported { at: group.at, text });
                    }
                    channel.push_back(Record::Reached { at: reached });
                }
                Turn::Exchange => {
                    channel.extend(untold.drain(..));
                    let text = "{\"QueryAll\":{}}".to_owned();
                    channel.push_back(Record::Exchanged { from: Sender::Plant, text });
                }
                Turn::Record => {
                    for record in of_simulation.drain(..).chain(channel.pop_front()) {
                        recorder.record(record).expect("written");
                    }
                }
            }
        }
        for record in of_simulation.into_iter().chain(channel) {
            recorder.record(record).expect("written");
        }
        expect.sort_by_key(|(step, from, _)| (*step, *from));
        let expect: Vec<_> = expect.into_iter().map(|(step, from, what)| format!("{step} {from} {what}")).collect();
        let (mut lines, _) = read_all(&recorder.finish().expect("an end")).expect("a trace");
        lines.retain(|line| !line.ends_with("QueryAll"));
        prop_assert_eq!(lines, expect);
    }
}
