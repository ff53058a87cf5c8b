//! Arguments in, words out.
//!
//! Exit codes: 0 when the command did what was asked, 1 when the answer is no (a check fails, a comparison differs, a run
//! that never had a session), 2 on bad input or use.

mod arguments;
mod run;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command, RunArguments};

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Answer {
    /// It did what was asked.
    Yes,
    /// It did what was asked, and the answer is no.
    No,
}

/// Why a command could not do what was asked: what is printed on standard error, whole.
#[derive(Debug)]
struct Failure(String);

/// Reads the arguments, does what they ask, and says how it ended.
pub fn main() -> ExitCode {
    // `--help` and `--version` end here with 0, a mistake in the arguments with 2.
    let arguments = Arguments::parse();
    let answer = match arguments.command {
        None => run::run(&RunArguments::main_job()),
        Some(Command::Run(arguments)) => run::run(&arguments),
    };
    match answer {
        Ok(Answer::Yes) => ExitCode::SUCCESS,
        Ok(Answer::No) => ExitCode::from(1),
        Err(Failure(text)) => {
            eprintln!("{}", text.trim_end());
            ExitCode::from(2)
        }
    }
}

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Failure {
        Failure(format!("error: {error}"))
    }
}
