//! Arguments in, words out.
//!
//! Exit codes: 0 when the command did what was asked, 1 when the answer is no (a check fails, a comparison differs, a run
//! that never had a session), 2 on bad input or use.

mod apply;
mod arguments;
mod bench;
mod check;
mod credentials;
mod diagnose;
mod exam;
mod experiment;
#[cfg(test)]
mod foxglove_tests;
mod info;
mod locate;
mod log;
mod output;
mod picture;
mod plan;
mod replay;
mod report;
mod run;
mod signals;
mod status;
mod table;
mod terminal;
#[cfg(feature = "view")]
mod view;
mod words;

use std::io::IsTerminal;
use std::process::ExitCode;

use clap::Parser;
use miette::GraphicalTheme;

use crate::plant::ModelError;
use crate::run::RunError;
use arguments::{Arguments, Command, GapCommand, RunArguments, TraceCommand};

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
        Some(Command::Bench { command }) => bench::bench(&command),
        Some(Command::Check(arguments)) => check::check(&arguments),
        Some(Command::SignalsMap(arguments)) => check::signals_map(&arguments),
        Some(Command::Replay(arguments)) => replay::replay(&arguments),
        Some(Command::Trace { command: TraceCommand::Info(arguments) }) => info::info(&arguments),
        Some(Command::Gap { command: GapCommand::Locate(arguments) }) => locate::run(&arguments),
        Some(Command::Gap { command: GapCommand::Diagnose(arguments) }) => diagnose::run(&arguments),
        Some(Command::Gap { command: GapCommand::Plan(arguments) }) => experiment::run(&arguments),
        Some(Command::Gap { command: GapCommand::Exam(arguments) }) => exam::run(&arguments),
        Some(Command::Trace { command: TraceCommand::Cut(arguments) }) => replay::cut(&arguments),
        Some(Command::Trace { command: TraceCommand::Import(arguments) }) => table::import(&arguments),
        Some(Command::Trace { command: TraceCommand::Export(arguments) }) => table::export(&arguments),
        #[cfg(feature = "view")]
        Some(Command::View(arguments)) => view::view(&arguments),
        Some(Command::Gap { command: GapCommand::Apply(arguments) }) => apply::apply(&arguments),
    };
    match answer {
        Ok(Answer::Yes) => ExitCode::SUCCESS,
        Ok(Answer::No) => ExitCode::from(1),
        Err(Failure(text)) => {
            words::tell(text.trim_end());
            ExitCode::from(2)
        }
    }
}

impl Failure {
    /// An error with what brought it about.
    fn of(error: &dyn std::error::Error) -> Failure {
        let mut text = format!("error: {error}");
        let mut cause = error.source();
        while let Some(error) = cause {
            text.push_str(&format!(": {error}"));
            cause = error.source();
        }
        Failure(text)
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Failure {
        Failure(format!("error: {error}"))
    }
}

impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Failure {
        Failure(format!("error: {error}"))
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Failure {
        match error {
            RunError::Model(error) => error.into(),
            error => Failure::of(&error),
        }
    }
}

impl From<ModelError> for Failure {
    fn from(error: ModelError) -> Failure {
        let width = crossterm::terminal::size().map_or(100, |(columns, _)| usize::from(columns).clamp(60, 120));
        let colours = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|no| no.is_empty());
        let theme = if colours { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        match &error {
            ModelError::Faulty(_) => Failure(error.render(theme, width)),
            error => Failure(format!("error: {error}")),
        }
    }
}
