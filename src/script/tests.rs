//! Scripts that do what they should, and those that would not stop.

use serde_json::json;

use super::*;

fn run(text: &str) -> Result<Value, String> {
    let said = |error: ScriptError| match error.line {
        Some(line) => format!("{line}: {}", error.message),
        None => error.message,
    };
    call("builder.js", "const twice = x => 2 * x;", text, "build", &json!({"length": 1.5, "names": ["a", "b"]}))
        .map_err(said)
}

#[track_caller]
fn refused(text: &str, expect: &str) {
    let error = run(text).expect_err("no value");
    assert!(error.contains(expect), "{error}");
}

#[test]
fn a_script_gives_what_it_returns() {
    let given = run("function build(p) {\n  return { length: twice(p.length), count: p.names.length };\n}");
    assert_eq!(given, Ok(json!({"length": 3, "count": 2})));
    assert_eq!(run("function build() {}"), Ok(Value::Null));
}

#[test]
fn what_goes_wrong_is_told_with_its_line() {
    refused("function build(p) {\n  const x = 1;\n  return p.missing.length;\n}", "3: ");
    refused("function build() {\n  throw new Error('too short');\n}", "2: too short");
    refused("function build() {\n  let = 3;\n", "2: variable name expected");
    refused("const build = 3;", "there is no function build");
    refused("function build() { return undeclared; }", "undeclared is not defined");
    refused("function build() { throw 7; }", "it threw");
}

#[test]
fn a_script_that_does_not_end_is_ended() {
    refused("function build() {\n  for (;;) {}\n}", "it does not end");
    refused("while (true) {}", "it does not end");
    refused("function build() { const all = []; for (;;) all.push(new Array(100000).fill(7)); }", "more than 64 MiB");
    refused("function build() { return 'x'.repeat(1 << 29); }", "");
    refused("function build() { return build(); }", "stack");
    refused("function build() { try { for (;;) {} } catch (e) { for (;;) {} } }", "it does not end");
}

#[test]
fn the_world_outside_is_not_there() {
    for name in ["require", "process", "fetch", "std", "os", "setTimeout", "console", "Deno", "XMLHttpRequest"] {
        assert_eq!(run(&format!("function build() {{ return typeof {name}; }}")), Ok(json!("undefined")), "{name}");
    }
    refused("function build() { return import('fs'); }\nimport x from 'fs';", "");
    // The same each time: no clock, no chance.
    assert_eq!(
        run("function build() { return [typeof Date, typeof Math.random]; }"),
        Ok(json!(["undefined", "undefined"]))
    );
}
