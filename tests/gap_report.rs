//! The report's contract: samples of every verdict are what `docs/gap-report.schema.json` allows and read into its types
//! and back without a change; what breaks the contract is refused by the schema.

use std::fs;
use std::path::{Path, PathBuf};

use jsonschema::Validator;
use kinetwin::gap::report::{Report, Verdict};
use serde_json::{Value, json};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> Value {
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn schema() -> Validator {
    let schema = read(&root().join("docs/gap-report.schema.json"));
    jsonschema::draft202012::meta::validate(&schema).expect("the schema is one");
    jsonschema::validator_for(&schema).expect("the schema compiles")
}

fn sample(verdict: Verdict) -> PathBuf {
    root().join(format!("tests/data/gap-report/{verdict}.json"))
}

fn flaws(schema: &Validator, report: &Value) -> Vec<String> {
    schema.iter_errors(report).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

#[test]
fn a_report_of_every_verdict_reads_back_and_is_what_the_schema_allows() {
    let schema = schema();
    for verdict in Verdict::ALL {
        let path = sample(verdict);
        let text = fs::read_to_string(&path).expect("a sample");
        let report = Report::from_json(&path, &text).expect("a report");
        assert_eq!(report.verdict, verdict, "{}", path.display());
        assert_eq!(report.flaws(), Vec::<String>::new(), "{}", path.display());
        let written: Value = serde_json::from_str(&report.to_json()).expect("JSON");
        assert_eq!(written, read(&path), "{} changes as it is read and written", path.display());
        assert_eq!(flaws(&schema, &written), Vec::<String>::new(), "{}", path.display());
    }
}

#[test]
fn a_report_that_says_as_little_as_it_may_is_allowed() {
    let report = Report::new(Verdict::NotTestable);
    let written: Value = serde_json::from_str(&report.to_json()).expect("JSON");
    assert_eq!(flaws(&schema(), &written), Vec::<String>::new());
    assert_eq!(report.flaws(), Vec::<String>::new());
}

#[test]
fn what_breaks_the_contract_is_refused() {
    let schema = schema();
    // What stands at the pointer becomes another, or is added; `Null` in a place that must not be null is one of them.
    let check = |verdict: Verdict, pointer: &str, value: Value| {
        let mut report = read(&sample(verdict));
        let (parent, member) = pointer.rsplit_once('/').expect("a pointer");
        match report.pointer_mut(parent).expect("the parent is there") {
            Value::Object(members) => drop(members.insert(member.to_owned(), value)),
            Value::Array(items) => items[member.parse::<usize>().expect("an index")] = value,
            other => panic!("{parent} is {other}"),
        }
        assert!(!schema.is_valid(&report), "{verdict}: {pointer} may not be so");
    };
    check(Verdict::Effect, "/verdict", json!("guess"));
    check(Verdict::Effect, "/schema", json!("kinetwin-gap/2"));
    check(Verdict::Effect, "/gap/before", json!(null));
    check(Verdict::Effect, "/gap/unit", json!("m"));
    check(Verdict::Effect, "/cause", json!([]));
    check(Verdict::Effect, "/cause/0/place", json!("gearbox"));
    check(Verdict::Effect, "/cause/0/effect", json!("Acceleration Limit"));
    check(Verdict::Effect, "/cause/0/weight", json!(1.5));
    check(Verdict::Effect, "/cause/0/parameters/0/ci95", json!([1.0]));
    check(Verdict::Effect, "/cause/0/parameter", json!([]));
    check(Verdict::Effect, "/where/0/signals/0/kind", json!("boolean"));
    check(Verdict::Effect, "/where/0/signals/0/missing", json!({"before": 1, "after": 0}));
    check(Verdict::Effect, "/where/0/signals/1/unit", json!("ms"));
    check(Verdict::Effect, "/shrink/ratio", json!(-0.1));
    check(Verdict::Effect, "/shrink/left", json!(0.1));
    check(Verdict::Ambiguous, "/verdict", json!("effect"));
    check(Verdict::Partial, "/remainder", json!(null));
    check(Verdict::NoGap, "/shrink/ci95", json!(null));
    check(Verdict::NotTestable, "/not_testable/0", json!({"reason": "nothing moves"}));
}

#[test]
fn a_report_without_one_of_its_members_is_refused() {
    let schema = schema();
    let whole = read(&sample(Verdict::Effect));
    let report = whole.as_object().expect("an object");
    let beyond = ["outside", "incomplete", "made_from", "signals", "not_testable"];
    for member in report.keys().filter(|member| !beyond.contains(&member.as_str())) {
        let mut broken = report.clone();
        broken.remove(member);
        assert!(!schema.is_valid(&Value::Object(broken)), "a report without {member}");
    }
}

#[test]
fn a_file_that_is_no_report_says_where_and_what_was_expected() {
    let check = |text: &str, part: &str| {
        let error = Report::from_json(Path::new("out/report.json"), text).expect_err(text).to_string();
        assert!(error.contains(part) && error.contains("kinetwin gap diagnose"), "{error}");
    };
    check("", "out/report.json:1:1: no report of a diagnosis: EOF");
    check("{\n  \"schema\": \"kinetwin-gap/9\"}", "out/report.json:2:28: ");
    check("{\"schema\": \"kinetwin-gap/1\", \"verdict\": \"maybe\"}", "unknown variant `maybe`");
    check("[1]", "out/report.json:1:2: ");
}

#[test]
fn what_contradicts_itself_is_named() {
    let of = |verdict: Verdict| {
        let path = sample(verdict);
        Report::from_json(&path, &fs::read_to_string(&path).expect("a sample")).expect("a report")
    };
    let check = |report: Report, part: &str| {
        let flaws = report.flaws();
        assert!(flaws.len() == 1 && flaws[0].contains(part), "{flaws:?}");
    };
    let mut report = of(Verdict::Effect);
    report.cause.clear();
    check(report, "causes stand");
    let mut report = of(Verdict::Effect);
    report.cause[0].parameters[0].ci95 = [2.0, 3.0];
    check(report, "an interval");
    let mut report = of(Verdict::Ambiguous);
    report.cause[0].class.swap(0, 1);
    check(report, "first of its class");
    let mut report = of(Verdict::Partial);
    report.devices.swap(0, 1);
    check(report, "largest share");
    let mut report = of(Verdict::Unknown);
    report.outside = Some(f64::NAN);
    check(report, "a weight");
    let mut report = of(Verdict::Unknown);
    report.remainder = None;
    check(report, "the remainder");
}
