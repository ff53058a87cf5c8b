//! The interpreter (QuickJS) and its limits.

use std::cell::Cell;
use std::rc::Rc;

use rquickjs::context::EvalOptions;
use rquickjs::{CatchResultExt, CaughtError, Context, Runtime};
use serde_json::Value;

use super::ScriptError;

/// The most memory that a script may have at a time.
const MOST_MEMORY: usize = 64 << 20;
const MOST_STACK: usize = 512 << 10;
/// The most beats of the interpreter: some hundred million operations, seconds of a computer's time.
const MOST_BEATS: u32 = 20_000;

pub(super) fn call(
    name: &str,
    prelude: &str,
    text: &str,
    function: &str,
    argument: &Value,
) -> Result<Value, ScriptError> {
    let broken =
        |error: rquickjs::Error| ScriptError { line: None, message: format!("the interpreter failed: {error}") };
    let runtime = Runtime::new().map_err(broken)?;
    runtime.set_memory_limit(MOST_MEMORY);
    runtime.set_max_stack_size(MOST_STACK);
    let beats = Rc::new(Cell::new(0u32));
    let counted = Rc::clone(&beats);
    runtime.set_interrupt_handler(Some(Box::new(move || {
        counted.set(counted.get() + 1);
        counted.get() > MOST_BEATS
    })));
    let context = Context::full(&runtime).map_err(broken)?;
    context.with(|ctx| {
        let run = |file: &str, source: String| {
            let mut options = EvalOptions::default();
            options.strict = true;
            options.filename = Some(file.to_owned());
            let result: Result<Option<String>, _> = ctx.eval_with_options(source, options);
            result.catch(&ctx).map_err(|error| explain(name, &error, beats.get() > MOST_BEATS))
        };
        // The same each time: no clock, no chance.
        run("kinetwin", format!("delete globalThis.Date; delete Math.random;\n{prelude}\nvoid 0"))?;
        run(name, format!("{text}\nvoid 0"))?;
        let known = run("kinetwin", format!("typeof {function}"))?;
        if known.as_deref() != Some("function") {
            let message = format!("there is no function {function}: expected one");
            return Err(ScriptError { line: None, message });
        }
        let json = run("kinetwin", format!("JSON.stringify({function}({argument})) ?? \"null\""))?;
        let json = json.unwrap_or_else(|| "null".to_owned());
        let unreadable = |error| ScriptError { line: None, message: format!("it gave no plain values: {error}") };
        serde_json::from_str(&json).map_err(unreadable)
    })
}

fn explain(name: &str, error: &CaughtError<'_>, is_late: bool) -> ScriptError {
    let (message, stack) = match error {
        CaughtError::Exception(exception) => {
            (exception.message().unwrap_or_default(), exception.stack().unwrap_or_default())
        }
        CaughtError::Value(value) => (format!("it threw {value:?}"), String::new()),
        CaughtError::Error(error) => (error.to_string(), String::new()),
    };
    let message = match () {
        () if is_late => "it does not end: expected it to be done in some hundred million operations".to_owned(),
        () if message.contains("out of memory") => format!("it takes more than {} MiB of memory", MOST_MEMORY >> 20),
        () => message,
    };
    ScriptError { line: line_in(&stack, name), message }
}

/// The line of the innermost place in the script of that name: `    at build (builder.js:12:7)`.
fn line_in(stack: &str, name: &str) -> Option<usize> {
    let place = format!("{name}:");
    let after = stack.lines().find_map(|line| line.split_once(&place)).map(|(_, after)| after)?;
    after.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}
