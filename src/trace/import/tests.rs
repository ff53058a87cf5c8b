//! Tables in, lines out; and traces out and in again.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::*;
use crate::time::Instant;
use crate::trace::{Body, Compression, Header, Reader, Sender, Writer, export, info};
use crate::wire::Message;

fn seconds(name: &str) -> Clock {
    Clock::Column { name: name.to_owned(), unit: TimeUnit::Seconds }
}

fn maps(maps: &[&str]) -> Settings {
    Settings { maps: maps.iter().map(|map| map.parse().expect("a mapping")).collect(), ..Settings::default() }
}

fn with_commands(mut settings: Settings, commands: &[&str]) -> Settings {
    settings.signals.commands = commands.iter().map(|name| (*name).to_owned()).collect();
    settings
}

/// Imports CSV texts called a.csv, b.csv, … and gives the lines without the header.
fn import(texts: &[&str], clock: &Clock, shape: &Shape, settings: &Settings) -> Result<Vec<String>, String> {
    let tables = texts.iter().zip("abcdef".chars()).map(|(text, name)| Table {
        file: format!("data/{name}.csv"),
        input: text.as_bytes(),
        clock: clock.clone(),
    });
    let mut out = Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a writer");
    csv(tables.collect(), shape, settings, &mut out).map_err(|error| error.to_string())?;
    let text = String::from_utf8(out.finish().expect("a trace")).expect("UTF-8");
    Ok(text.lines().skip(1).map(str::to_owned).collect())
}

fn check(texts: &[&str], settings: &Settings, expected: &[&str]) {
    let lines = import(texts, &seconds("t"), &Shape::Wide, settings).expect("an import");
    assert_eq!(lines, expected);
}

fn check_refused(texts: &[&str], settings: &Settings, words: &str) {
    let error = import(texts, &seconds("t"), &Shape::Wide, settings).expect_err("what is wrong is refused");
    assert_eq!(error, words);
}

#[test]
fn a_wide_table_becomes_lines() {
    let settings = with_commands(maps(&["target=A.target", "x_mm*0.001=A.x", "!w.1=A.open"]), &["A.target"]);
    check(
        &["t,target,x_mm,w\n0.0,1.50,10,2\n0.020,,11.5,0\n0.04,,,\n0.06,2,,\n"],
        &settings,
        &[
            r#"{"t":0.0,"from":"automation","SendValue":[{"name":"A.target","value":1.50}]}"#,
            r#"{"t":0.0,"from":"plant","SendValue":[{"name":"A.x","value":0.01},{"name":"A.open","value":false}]}"#,
            r#"{"t":0.02,"from":"plant","SendValue":[{"name":"A.x","value":0.0115},{"name":"A.open","value":true}]}"#,
            r#"{"t":0.06,"from":"automation","SendValue":[{"name":"A.target","value":2}]}"#,
        ],
    );
}

#[test]
fn semicolons_decimal_commas_and_a_byte_order_mark() {
    check(
        &["\u{feff}t;\"x; in m\"\n0,5;-1,25\n1,5;3\n"],
        &maps(&["x; in m=A.x"]),
        &[
            r#"{"t":0.5,"from":"plant","SendValue":[{"name":"A.x","value":-1.25}]}"#,
            r#"{"t":1.5,"from":"plant","SendValue":[{"name":"A.x","value":3}]}"#,
        ],
    );
    check(
        &["t\tx\n1\t2\n"],
        &maps(&["x=A.x"]),
        &[r#"{"t":1.0,"from":"plant","SendValue":[{"name":"A.x","value":2}]}"#],
    );
}

#[test]
fn files_are_merged_by_time_and_equal_times_share_a_line() {
    let settings = with_commands(maps(&["u=A.u", "a:y=A.y", "b.csv:y=B.y"]), &["A.u"]);
    check(
        &["t,y\n0.1,1\n0.3,3\n", "t,y,u\n0.1,10,7\n0.2,20,\n0.2,21,\n"],
        &settings,
        &[
            r#"{"t":0.1,"from":"automation","SendValue":[{"name":"A.u","value":7}]}"#,
            r#"{"t":0.1,"from":"plant","SendValue":[{"name":"A.y","value":1},{"name":"B.y","value":10}]}"#,
            r#"{"t":0.2,"from":"plant","SendValue":[{"name":"B.y","value":20}]}"#,
            r#"{"t":0.2,"from":"plant","SendValue":[{"name":"B.y","value":21}]}"#,
            r#"{"t":0.3,"from":"plant","SendValue":[{"name":"A.y","value":3}]}"#,
        ],
    );
}

#[test]
fn a_long_table_becomes_lines() {
    let shape = Shape::Long { name: "tag".to_owned(), value: "val".to_owned() };
    let text = "t;tag;val\n0;x;1,5\n0;w;3\n0;other;9\n0;x;1,6\n0,5;w;0\n";
    let settings = maps(&["x*2=A.x", "w.0=A.on", "w.1=A.up"]);
    let lines = import(&[text], &seconds("t"), &shape, &settings).expect("an import");
    assert_eq!(
        lines,
        [
            r#"{"t":0.0,"from":"plant","SendValue":[{"name":"A.x","value":3.0},{"name":"A.on","value":true},{"name":"A.up","value":true}]}"#,
            r#"{"t":0.0,"from":"plant","SendValue":[{"name":"A.x","value":3.2}]}"#,
            r#"{"t":0.5,"from":"plant","SendValue":[{"name":"A.on","value":false},{"name":"A.up","value":false}]}"#,
        ]
    );
    let error = import(&[text], &seconds("t"), &shape, &Settings::default()).expect_err("nothing says what is what");
    assert!(error.contains("expected at least one, or --model"), "{error}");
}

#[test]
fn rows_at_a_rate_need_no_times() {
    let lines = import(&["x\n1\n2\n"], &Clock::Rate(1000.0), &Shape::Wide, &maps(&["x=A.x"])).expect("an import");
    assert!(lines[1].starts_with(r#"{"t":0.001,"#), "{lines:?}");
}

#[test]
fn times_can_be_counted_from_the_first() {
    let dates = ["t,x\n1700000000.25,1\n1700000000.5,2\n"];
    check_refused(
        &dates,
        &maps(&["x=A.x"]),
        "data/a.csv:2: the first time is 1700000000.25 s, more than a day after the start: is it a date, or in another \
         --unit?; --from-zero counts from the first row",
    );
    let settings = Settings { from_zero: true, ..maps(&["x=A.x"]) };
    check(
        &dates,
        &settings,
        &[
            r#"{"t":0.0,"from":"plant","SendValue":[{"name":"A.x","value":1}]}"#,
            r#"{"t":0.25,"from":"plant","SendValue":[{"name":"A.x","value":2}]}"#,
        ],
    );
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let x = maps(&["x=A.x"]);
    check_refused(
        &["t,x\n0.1,1\n0.3,2\n0.2,3\n"],
        &x,
        "data/a.csv:4: time goes back, from 0.3 s to 0.2 s: expected rows in the order of their times",
    );
    check_refused(
        &["t,x\n0,1\n1,NaN\n"],
        &x,
        "data/a.csv:3: column x: \"NaN\" cannot stand in a trace: leave the cell empty, or say --missing NaN",
    );
    check_refused(&["t,x\n0,1\n1\n"], &x, "data/a.csv:3: 1 cells: expected 2, as in the header");
    check_refused(
        &["t,x\nsoon,1\n"],
        &x,
        "data/a.csv:2: column t: \"soon\" is no time: expected a number (--time, --unit)",
    );
    check_refused(&[""], &x, "data/a.csv:1: no header: expected the columns' names in the first line");
    check_refused(
        &["time,position\n0,1\n"],
        &x,
        "data/a.csv:1: there is no column \"t\" for the time: expected one of time, position",
    );
    check_refused(
        &["t,position\n0,1\n"],
        &maps(&["positon=A.x"]),
        "--map positon=A.x: there is no column \"positon\": expected one of position; did you mean \"position\"?",
    );
    check_refused(
        &["t,x\n0,1\n", "t,x\n0,1\n"],
        &x,
        "--map x=A.x: column \"x\" stands in data/a.csv and again in data/b.csv: name one file, a.csv:x",
    );
    check_refused(
        &["t,x,y\n0,1,2\n"],
        &maps(&["x=A.x", "y=A.x"]),
        "--map y=A.x: A.x has a column already: expected each signal once",
    );
    check_refused(&["t,x,x\n0,1,2\n"], &x, "--map x=A.x: column \"x\" stands twice in data/a.csv");
    let missing = Settings { missing: vec!["NaN".to_owned()], ..x };
    check(&["t,x\n0,1\n1,NaN\n"], &missing, &[r#"{"t":0.0,"from":"plant","SendValue":[{"name":"A.x","value":1}]}"#]);
}

/// The values of a trace's lines, those of a line by name.
fn lines(trace: &[u8]) -> Vec<(Instant, Sender, BTreeMap<String, String>)> {
    let mut reader = Reader::new("trace", trace).expect("a trace");
    let mut lines = Vec::new();
    while let Some(line) = reader.next_line().expect("a line") {
        let Body::Message(Message::SendValue(entries)) = line.body else { panic!("only values: {}", line.text) };
        let value = |entry: &crate::wire::Entry<'_>| {
            let name = entry.name.as_deref().expect("a name").to_owned();
            (name, entry.value.expect("a value").text().to_owned())
        };
        lines.push((line.at, line.from, entries.iter().map(value).collect()));
    }
    lines
}

/// A trace's lines: a step of time, whether it is the automation's, and its values by the number of their signal.
type Plan = Vec<(i64, bool, BTreeMap<u8, String>)>;

fn written(plan: &Plan) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a writer");
    let mut at = Instant::ZERO;
    for (step, is_command, values) in plan {
        at = Instant::from_nanos(at.nanos() + step);
        let (from, sender) = if *is_command { ("c", Sender::Automation) } else { ("r", Sender::Plant) };
        let entries: Vec<String> = values
            .iter()
            .map(|(signal, value)| format!("{{\"name\":\"{from}{signal}, \\\"q\\\"\",\"value\":{value}}}"))
            .collect();
        writer.message(at, sender, &format!("{{\"SendValue\":[{}]}}", entries.join(","))).expect("a line");
    }
    writer.finish().expect("a trace")
}

fn commands() -> Settings {
    let names = (0..4u8).map(|signal| format!("c{signal}, \"q\"")).collect();
    Settings { signals: Signals { map: None, commands: names }, ..Settings::default() }
}

fn plans() -> impl Strategy<Value = Plan> {
    let value = prop_oneof![
        any::<i32>().prop_map(|number| number.to_string()),
        any::<f64>().prop_filter("finite", |number| number.is_finite()).prop_map(|n| serde_json::json!(n).to_string()),
        any::<bool>().prop_map(|truth| truth.to_string()),
        "[a-z;,\"\n ]{0,6}".prop_map(|text| serde_json::json!(text).to_string()),
        Just("[1,2.5]".to_owned()),
    ];
    let values = prop::collection::btree_map(0..4u8, value, 1..4);
    prop::collection::vec((prop_oneof![Just(0i64), 1..2_000_000_000i64], any::<bool>(), values), 0..20)
}

proptest! {
    #[test]
    fn a_trace_goes_through_csv_unchanged(plan in plans()) {
        let trace = written(&plan);
        let info = info(Reader::new("trace", &trace[..]).expect("a trace")).expect("an info");
        let mut table = Vec::new();
        export::csv(Reader::new("trace", &trace[..]).expect("a trace"), &info, &mut table).expect("an export");
        let tables = vec![Table { file: "a.csv".to_owned(), input: &table[..], clock: seconds("t_s") }];
        let mut out = Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a writer");
        csv(tables, &Shape::Wide, &commands(), &mut out).expect("an import");
        prop_assert_eq!(lines(&out.finish().expect("a trace")), lines(&trace));
    }

    #[test]
    fn a_trace_goes_through_mcap_with_every_value(plan in plans()) {
        let trace = written(&plan);
        let reader = Reader::new("trace", &trace[..]).expect("a trace");
        let (file, _) = export::mcap(reader, None, Vec::new()).expect("an export");
        let mut out = Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a writer");
        // Who sends what stands in the file.
        mcap("a.mcap", &file[..], &Settings::default(), &mut out).expect("an import");
        let by_signal = |trace: &[u8]| {
            let mut signals: BTreeMap<String, Vec<(Instant, Sender, serde_json::Value)>> = BTreeMap::new();
            for (at, from, values) in lines(trace) {
                for (name, value) in values {
                    let value = serde_json::from_str(&value).expect("JSON");
                    signals.entry(name).or_default().push((at, from, value));
                }
            }
            signals
        };
        prop_assert_eq!(by_signal(&out.finish().expect("a trace")), by_signal(&trace));
    }
}

proptest! {
    #[test]
    fn no_table_brings_it_down(text in "[t,;x0-9.eE+\\-\n\"NaÄ\u{0}\u{feff} ]{0,80}", map in "[x!*/+.=0-9Aä:-]{0,12}") {
        let mut settings = Settings { from_zero: true, ..Settings::default() };
        settings.maps.extend(map.parse());
        let shapes = [Shape::Wide, Shape::Long { name: "x".to_owned(), value: "t".to_owned() }];
        for clock in [seconds("t"), Clock::Rate(1e-300), Clock::Rate(1e300)] {
            for shape in &shapes {
                let _ = import(&[&text], &clock, shape, &settings);
                let _ = import(&[&format!("t,x\n{text}"), &text], &clock, shape, &settings);
            }
        }
    }

    #[test]
    fn no_broken_mcap_file_brings_it_down(plan in plans(), at in 0usize..4096, byte in any::<u8>(), cut in 0usize..4096) {
        let trace = written(&plan);
        let (mut file, _) =
            export::mcap(Reader::new("trace", &trace[..]).expect("a trace"), None, Vec::new()).expect("a file");
        let at = at % file.len();
        file[at] = byte;
        file.truncate(file.len() - cut % (file.len() / 4));
        let mut out = Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a writer");
        let _ = mcap("a.mcap", &file[..], &Settings::default(), &mut out);
    }
}

#[test]
fn what_is_no_mcap_file_is_refused() {
    let check = |file: &[u8], words: &str| {
        let mut out = Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a writer");
        let error = mcap("a.mcap", file, &Settings::default(), &mut out).expect_err("no MCAP").to_string();
        assert!(error.starts_with("a.mcap: ") && error.contains(words), "{error}");
    };
    check(b"", "MCAP");
    check(b"t,x\n0,1\n2,3\n", "Bad magic number");
    let trace = written(&vec![(0, true, BTreeMap::from([(1, "1".to_owned())]))]);
    let (file, _) = export::mcap(Reader::new("trace", &trace[..]).expect("a trace"), None, Vec::new()).expect("a file");
    check(&file[..file.len() / 2], "no MCAP file that can be read");
}
