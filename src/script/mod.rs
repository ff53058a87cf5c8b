//! The scripts of prototypes, `customizer.js` and `builder.js`, run where they can do no harm: plain ECMAScript without
//! files, network, clock or modules, with an end to its memory, its stack and its time.
//!
//! Time is counted in the interpreter's own beats, some ten thousand operations each, and not on a clock: whether a script ends
//! in time does not depend on the computer.
//!
//! Without the feature `javascript` no script runs, and a prototype that needs one is refused with a message that says so.

#[cfg(feature = "javascript")]
mod sandbox;
#[cfg(all(test, feature = "javascript"))]
mod tests;

use serde_json::Value;

/// Why a script gave nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct ScriptError {
    /// Where in the script; `None` where the script as a whole is wrong.
    pub line: Option<usize>,
    pub message: String,
}

/// Runs `function` of the script `text`, which is called `name` in errors, on `argument`, and gives what it returned. `prelude` is
/// there before it: the functions that the script may call.
#[cfg(feature = "javascript")]
pub fn call(name: &str, prelude: &str, text: &str, function: &str, argument: &Value) -> Result<Value, ScriptError> {
    sandbox::call(name, prelude, text, function, argument)
}

/// Refuses to run a script: this build has no interpreter.
#[cfg(not(feature = "javascript"))]
pub fn call(_: &str, _: &str, _: &str, _: &str, _: &Value) -> Result<Value, ScriptError> {
    let message =
        "this program was built without the feature javascript and runs no scripts: expected one built with it";
    Err(ScriptError { line: None, message: message.to_owned() })
}
